//! Asks the memory for pixels before they are drawn.

/// Brings `count` elements from `place` on into the cache, where the processor knows how.
#[inline(always)]
pub(super) fn prefetch<T>(memory: &[T], place: usize, count: usize) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        /// Bytes.
        const LINE: usize = 64;
        let step = LINE / size_of::<T>();
        let mut at = place;
        // Wherever in a line the first element lies, the last is met.
        while at < place + count + step - 1 {
            // SAFETY: a prefetch is a hint: it reads and writes nothing a program can see and cannot fault, whatever the
            // address; `wrapping_add` may form one behind the end.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(memory.as_ptr().wrapping_add(at).cast()) };
            at += step;
        }
    }
}
