//! The stages of a unit that all move in the same clock, for BUMP, NORMAL and PROJECT.

/// Stages as a ring: what is held stays where it is, and the place of the last stage moves on.
#[derive(Clone, Debug)]
pub(crate) struct Stages<T> {
    ring: Vec<Option<T>>,
    /// Place of the last stage; the stage before it is one place further.
    last: usize,
    held: usize,
}

impl<T> Stages<T> {
    /// So many empty stages, at least 1.
    pub fn new(count: usize) -> Self {
        Stages { ring: (0..count).map(|_| None).collect(), last: 0, held: 0 }
    }

    /// Empties all stages.
    pub fn clear(&mut self) {
        self.ring.fill_with(|| None);
        self.held = 0;
    }

    /// Stages that hold something.
    #[inline]
    pub fn held(&self) -> usize {
        self.held
    }

    /// What the last stage holds.
    #[inline]
    pub fn last(&self) -> Option<&T> {
        self.ring[self.last].as_ref()
    }

    /// All stages, the first stage first.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = Option<&T>> {
        let (new, old) = self.ring.split_at(self.last);
        new.iter().rev().chain(old.iter().rev()).map(Option::as_ref)
    }

    /// Clock edge: all stages move on, `entering` into the first.
    #[inline]
    pub fn shift(&mut self, entering: Option<T>) {
        let place = &mut self.ring[self.last];
        self.held = self.held + usize::from(entering.is_some()) - usize::from(place.is_some());
        *place = entering;
        self.last = if self.last + 1 == self.ring.len() { 0 } else { self.last + 1 };
    }
}
