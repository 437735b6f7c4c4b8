//! Twice the area of the triangle: a serial product beside the lanes.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use super::control::Control;
use super::sort::Vertices;
use super::top::top;

/// The triangle's area.
pub(super) struct Area<'m> {
    /// du1·dv2 - du2·dv1, twice the area, in 1/2^(2t) px², signed; t are the fraction bits of centre coordinates.
    pub signed: Signal<'m>,
    /// The area is below 0: the major edge lies right.
    pub negative: Signal<'m>,
    /// The area is summed up.
    pub adds: Signal<'m>,
    /// In the last clock of that.
    pub ends: Signal<'m>,
}

impl<'m> Area<'m> {
    /// The sum over the bits of dv2 and dv1, the highest first.
    pub fn new(m: &'m Module, plan: &Plan, control: &Control<'m>, vertices: &Vertices<'m>) -> Area<'m> {
        m.comment("Twice the area: du1 dv2 - du2 dv1, over the bits of dv2 and dv1.");
        let bits = area_bits(plan);
        let [tall, upper] = [vertices.heights[0], vertices.heights[1]];
        let digit = m.reg("area_digit", tall.width().ilog2() + 1).doc("place of the digits added");
        let adds = m.reg("area_adds", 1).doc("digits are added");
        let last = digit.q().eq(0);
        // Two digits at least: until then not all differences are there that the area is scaled for.
        digit.set(digit.q() - 1).when(control.sequence.begin, top(vertices.tall | 2).zext(digit.q().width()));
        adds.when(last, 0).when(control.sequence.begin, 1);
        let part = |of: Signal<'m>, value: Signal<'m>| {
            of.shr_by(digit.q()).bit(0).mux(value.sext(value.width() + 1), 0)
        };
        let added = (part(tall, vertices.across[1]) - part(upper, vertices.across[0])).named("area_part");
        let parts = 2 * plan.widths().center_fraction;
        let area = m.reg("area", bits).doc(&format!("twice the area, 1/{} px^2, signed", 1u64 << parts));
        area.when(adds.q(), area.q().shl(1) + added.sext(bits)).when(control.sequence.begin, 0);
        control.feedback.no_area.drive(!area.q().any());
        Area { signed: area.q(), negative: area.q().msb(), adds: adds.q(), ends: adds.q() & last }
    }
}

/// Bits of twice the area, signed: at most the square of the longest difference of coordinates, which has a
/// bit less than with its sign.
pub(super) fn area_bits(plan: &Plan) -> u32 {
    2 * (plan.widths().difference - 1) + 1
}
