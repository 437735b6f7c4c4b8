//! How long a number is.

use edgewalk_netlist::Signal;

/// The place of the highest 1; 0 if there is none.
pub(super) fn top(bits: Signal<'_>) -> Signal<'_> {
    let width = bits.width();
    if width == 1 {
        return bits.module().lit(1, 0);
    }
    let half = width.next_power_of_two() / 2;
    if half == 1 {
        return bits.bit(1);
    }
    let places = half.ilog2();
    let (high, low) = (bits.slice(width - 1, half), bits.trunc(half));
    let any = high.any();
    let below = any.mux(top(high).zext(places), top(low).zext(places));
    bits.module().cat(&[any, below])
}
