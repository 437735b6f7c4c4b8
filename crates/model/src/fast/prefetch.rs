//! Asks for pixels before they are drawn.

use crate::prefetch;

/// A cache line, bytes.
const LINE: usize = 64;

/// Brings `count` elements from `place` on into the cache, where the processor knows how.
#[inline(always)]
pub(super) fn prefetch<T>(memory: &[T], place: usize, count: usize) {
    let step = LINE / size_of::<T>();
    let mut at = place;
    // Wherever in a line the first element lies, the last is met. A `step_by` here costs 30 instructions a span.
    while at < place + count + step - 1 {
        prefetch::prefetch(memory, at);
        at += step;
    }
}
