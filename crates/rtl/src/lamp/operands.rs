//! What the one multiplier multiplies, step by step.

use edgewalk_netlist::{Module, Signal};

use super::beside::Beside;
use super::made::Made;
use super::root::Root;
use super::steps::Steps;
use super::zeros_behind;
use crate::cut::cut;
use crate::roots::Roots;

/// Where operands come from.
pub(super) struct Operands<'a, 'm> {
    pub m: &'m Module,
    pub steps: &'a Steps<'m>,
    pub made: &'a Made<'m>,
    pub root: &'a Root<'m>,
    pub beside: &'a Beside<'m>,
}

impl<'m> Operands<'_, 'm> {
    fn at(&self, step: i32) -> Signal<'m> {
        self.steps.at(step)
    }

    /// The entry of the tables, `{v, slope}`, a step after it was asked for.
    pub fn entry(&self, roots: &Roots<'m>) -> Signal<'m> {
        let Operands { m, root, .. } = *self;
        m.comment(
            "Table entries: R for the root in progress, A for its exponent, C for the place beside the axis.",
        );
        let (in_a, in_c) = (self.at(1), self.at(7));
        let of_a = m.cat(&[m.lit(1, 1), root.k, root.m.slice(15, 10)]);
        let of_c = m.cat(&[m.lit(2, 1), self.beside.place.slice(15, 8)]);
        let of_r = m.cat(&[m.lit(2, 0), root.entry]);
        let entry = in_a.mux(of_a, in_c.mux(of_c, of_r)).named("entry");
        roots.read(root.begins | in_a | in_c, entry)
    }

    /// Both operands: `slope` is that of the entry.
    pub fn factors(&self, slope: Signal<'m>) -> [Signal<'m>; 2] {
        let Operands { m, made, root, .. } = *self;
        m.comment("Operands: a slope and the distance beyond its entry, or a number of 2^-23 and the root, or an earlier result.");
        let (low_a, low_c) = (root.m.trunc(10), zeros_behind(self.beside.place.trunc(8), 2));
        let low = self
            .at(2)
            .mux(low_a, self.at(8).mux(low_c, zeros_behind(root.m.trunc(8), 2)))
            .named_doc("low", "distance beyond the entry, 2^-10 entry");
        let near = self.over_root();
        let looks = [1, 2, 6, 8, 11].map(|step| self.at(step)).into_iter().reduce(|any, one| any | one);
        let looks = looks.expect("five").named_doc("looks", "one operand is a slope");
        let (of_beam, of_light) = (self.at(12), self.at(14));
        let others = of_beam.mux(made.attenuation.q().zext(18), of_light.mux(made.diffuse.q(), near));
        let a = looks.mux(slope.zext(18), others);
        let others = of_beam.mux(made.cone.q(), of_light.mux(made.beam.q(), made.y.q()));
        [a, looks.mux(low.zext(17), others)]
    }

    /// What is divided by the root, as far as its exponent goes, 2^-16.
    fn over_root(&self) -> Signal<'m> {
        let Operands { m, steps, made, .. } = *self;
        let both = made.diffuse.q().sext(19) + made.viewed.q().sext(19);
        let both = zeros_behind(both, 6);
        let numbers = [
            (3, steps.of("pl")),
            (4, steps.of("dv")),
            (5, steps.of("da")),
            (9, zeros_behind(made.toward.q(), 7)),
            (10, steps.of("pv")),
        ];
        let number =
            numbers.into_iter().rev().fold(both, |other, (step, number)| self.at(step).mux(number, other));
        let number = number.named_doc("number", "2^-23");
        // Of 25 bits, shifted by 7 at most: a half more overflows nothing.
        let shifted = number.sext(32).shl_by(self.root.k) + m.lit(32, 1 << 6);
        cut(m, "near", shifted.slice(31, 7).named_doc("shifted", "2^-16"), 18)
    }
}
