//! Asks for pixels before they are drawn.

use crate::prefetch;

/// A cache line, bytes.
const LINE: usize = 64;

/// Brings `count` elements from `place` on into the cache, where the processor knows how.
#[inline(always)]
pub(super) fn prefetch<T>(memory: &[T], place: usize, count: usize) {
    let step = LINE / size_of::<T>();
    // Wherever in a line the first element lies, the last is met.
    for at in (place..place + count + step - 1).step_by(step) {
        prefetch::prefetch(memory, at);
    }
}
