//! The arithmetic: base + (own - base) * weight, to nearest, with the multipliers there are.

use edgewalk_netlist::{Module, Signal};

/// For the header.
pub(super) fn doc(multipliers: u32) -> &'static str {
    match multipliers {
        3 => "Timing: all three colours are mixed in one clock.",
        1 => "Timing: the three colours are mixed one after the other, a clock each. A fragment with weight 0 takes one clock.",
        _ => {
            "Timing: two bits of the weight a clock, the lowest first. A fragment with weight 0 takes one clock.
The partial result begins with base. A bit of 1 adds own, a bit of 0 adds base; then the sum is halved. So the result
never leaves the range between own and base."
        }
    }
}

/// What is to be added to a base: the bits above the fraction, modulo the colour's range, and the one below for rounding.
#[derive(Clone, Copy)]
pub(super) struct Part<'m> {
    pub whole: Signal<'m>,
    pub half: Signal<'m>,
}

/// (own - base) * weight.
pub(super) fn product<'m>(
    m: &'m Module,
    own: Signal<'m>,
    base: Signal<'m>,
    weight: Signal<'m>,
    name: &str,
) -> Part<'m> {
    let (bits, fraction) = (own.width(), weight.width());
    let far = (own.zext(bits + 1) - base.zext(bits + 1)).named_doc(&format!("far{name}"), "signed");
    let product = far.smul(m.cat(&[m.lit(1, 0), weight])).named_doc(&format!("product{name}"), "signed");
    Part { whole: product.slice(fraction + bits - 1, fraction), half: product.bit(fraction - 1) }
}

/// The sum lies between own and base, so it needs no more bits than they.
pub(super) fn sum<'m>(base: Signal<'m>, part: Part<'m>) -> Signal<'m> {
    base + part.whole + part.half.zext(base.width())
}

/// Two bits of the weight: after each the mean of what is there and of own or base. `last` rounds to nearest, else down.
pub(super) fn two_bits<'m>(
    made: Signal<'m>,
    [own, base]: [Signal<'m>; 2],
    bits: [Signal<'m>; 2],
    last: Signal<'m>,
) -> Signal<'m> {
    let width = own.width();
    let mean = |made: Signal<'m>, bit: Signal<'m>| made.zext(width + 1) + bit.mux(own, base).zext(width + 1);
    let halve = |sum: Signal<'m>| sum.slice(width, 1);
    let first = halve(mean(made, bits[0]));
    halve(mean(first, bits[1]) + last.zext(width + 1))
}
