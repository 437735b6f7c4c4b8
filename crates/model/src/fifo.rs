//! A first-in first-out queue of fixed size, for SPAN, DEPTH and the memory.

/// Up to `N` items (a power of two) in place, oldest first.
#[derive(Clone, Debug)]
pub struct Fifo<T, const N: usize> {
    slots: [T; N],
    head: usize,
    len: usize,
}

impl<T: Copy + Default, const N: usize> Default for Fifo<T, N> {
    fn default() -> Self {
        const { assert!(N.is_power_of_two(), "places are found by masking") };
        Fifo { slots: [T::default(); N], head: 0, len: 0 }
    }
}

impl<T: Copy + Default, const N: usize> Fifo<T, N> {
    /// Items held.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Nothing held.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The oldest item; a stale one if empty.
    #[inline]
    #[must_use]
    pub fn head(&self) -> &T {
        &self.slots[self.head & (N - 1)]
    }

    /// The item `place` behind the oldest.
    #[inline]
    #[must_use]
    pub fn at(&self, place: usize) -> &T {
        &self.slots[self.head.wrapping_add(place) & (N - 1)]
    }

    /// The item `place` behind the oldest.
    #[inline]
    pub fn at_mut(&mut self, place: usize) -> &mut T {
        &mut self.slots[self.head.wrapping_add(place) & (N - 1)]
    }

    /// Appends. The unit's ready keeps it from being called when full.
    #[inline]
    pub fn push(&mut self, item: T) {
        debug_assert!(self.len < N);
        *self.at_mut(self.len) = item;
        self.len = self.len.wrapping_add(1);
    }

    /// Drops the oldest.
    #[inline]
    pub fn pop(&mut self) {
        debug_assert!(self.len > 0);
        self.head = self.head.wrapping_add(1) & (N - 1);
        self.len = self.len.wrapping_sub(1);
    }

    /// Drops all.
    pub fn clear(&mut self) {
        self.len = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_order_over_the_wrap() {
        let mut fifo = Fifo::<u32, 4>::default();
        for i in 0..10 {
            fifo.push(i);
            fifo.push(i + 100);
            assert_eq!((*fifo.head(), *fifo.at(1), fifo.len()), (i, i + 100, 2));
            fifo.pop();
            assert_eq!(*fifo.head(), i + 100);
            fifo.pop();
            assert!(fifo.is_empty());
        }
    }
}
