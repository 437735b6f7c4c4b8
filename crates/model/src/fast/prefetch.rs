//! Asks for pixels before they are drawn.

use crate::prefetch::prefetch as one;

/// A cache line, bytes.
const LINE: usize = 64;

/// Brings `count` elements from `place` on into the cache, where the processor knows how; if there are none, no matter what.
#[inline(always)]
pub(super) fn prefetch<T>(memory: &[T], place: usize, count: i32) {
    // First and last always: how many lines lie between them is not worth a guess of the processor where there are none.
    let last = place.wrapping_add_signed(count as isize - 1);
    one(memory, place);
    one(memory, last);
    let step = LINE / size_of::<T>();
    if count > step as i32 {
        let mut at = place + step;
        while at < last {
            one(memory, at);
            at += step;
        }
    }
}
