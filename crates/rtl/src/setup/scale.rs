//! The modulus of the channels: the area, fourfold until all differences of values fit.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Reg, Signal};

use super::area::Area;
use super::control::Control;
use super::lane::{modulus_bits, plus};
use super::steps::{Op, longest_value, rounds};

/// While these are named the lanes are shown the differences of the first round of channels: c1 - c2, c1 -
/// c0, c0 - c2.
pub(super) const SHOWN_FIRST: [Op; 3] = [Op::Subtract, Op::TakeDx, Op::DoubleDx];

/// While these are, those of the round after: the lanes take in none.
pub(super) const SHOWN_NEXT: [Op; 3] = [Op::Wait, Op::SumX, Op::DoubleX];

/// The area scaled for a round of channels, and how the differences come to be known.
pub(super) struct Scale<'m> {
    /// -M, or its complement -M - 1 where the area is above 0.
    pub modulus: Signal<'m>,
    /// Of a round: each bit is set in one of the differences or their complements.
    differences: Reg<'m>,
}

impl<'m> Scale<'m> {
    /// The registers; what they are scaled for is gathered by [`Scale::gather`].
    pub fn new(m: &'m Module, plan: &Plan, control: &Control<'m>, area: &Area<'m>) -> Scale<'m> {
        m.comment(
            "The area as modulus: fourfold, i times, until the differences of the next round's values fit.",
        );
        let (bits, rounds) = (modulus_bits(plan), rounds(plan)[1]);
        let differences =
            m.reg("differences", longest_value(plan)).doc("their bits, or those of complements");
        let scaled = m.reg("scaled", bits).doc("-M or -M - 1, signed");
        let taken = m.reg("scale_taken", 1).doc("the area is taken");
        let scaling = m.reg("scaling", 1).doc("the scaled modulus is compared with the differences");
        let i = m
            .reg("scale_next", control.feedback.scale.q().width())
            .doc("how many times the modulus is multiplied by 4");
        let mut takes = area.ends;
        if let Some(last) = control.way.named.in_round(rounds - 1) {
            let behind_gradient =
                control.way.named.one_of(&[Op::SignLine, Op::RoundX]) & control.sequence.first;
            takes = takes | (behind_gradient & !last);
        }
        taken.set(takes & !control.sequence.begin);
        let short = !area.negative;
        let of_area = area.signed.sext(bits);
        let less = plus("less_m", differences.q().zext(bits), scaled.q(), m.lit(1, 1));
        let fits = area.signed.any().mux(less.msb(), 1).named("fits");
        let grows = (scaling.q() & !fits).named("grows");
        scaling.when(fits, 0).when(taken.q(), 1);
        scaled
            .when(grows, m.cat(&[scaled.q().trunc(bits - 2), short, short]))
            .when(taken.q(), short.mux(!of_area, of_area));
        i.when(grows, i.q() + 1).when(taken.q(), 0);
        control.feedback.area_known.drive(!area.adds & !taken.q() & !scaling.q());
        control.feedback.scale.drive(if rounds > 1 {
            m.reg("scale_now", i.q().width()).doc("of the round").when(control.way.next.is(Op::Take12), i).q()
        } else {
            i.q()
        });
        Scale { modulus: scaled.q(), differences }
    }

    /// Takes the differences that the lanes are shown: all three of a round.
    pub fn gather(&self, plan: &Plan, control: &Control<'m>, numbers: &[Signal<'m>]) {
        let bits = self.differences.q().width();
        let magnitude = |number: &Signal<'m>| {
            let low = number.width().min(bits);
            (number.trunc(low) ^ number.msb().sext(low)).zext(bits)
        };
        let any = numbers.iter().map(magnitude).reduce(|any, one| any | one);
        let Some(any) = any.map(|any| any.named("shown")) else { return };
        let more = self.differences.q() | any;
        if rounds(plan)[1] > 1 {
            let shown = control.way.next.one_of(&[SHOWN_FIRST, SHOWN_NEXT].concat());
            self.differences
                .when(shown, more)
                .when(control.sequence.begin | control.way.next.is(Op::Take12), 0);
        } else {
            // Until the channels begin nothing else is shown.
            self.differences.set(more).when(control.sequence.begin, 0);
        }
    }
}
