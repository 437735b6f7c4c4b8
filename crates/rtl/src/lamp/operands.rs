//! What the one multiplier multiplies, step by step.

use edgewalk_netlist::{Module, Signal};

use super::beside::Beside;
use super::made::Results;
use super::multiply::Chosen;
use super::root::Root;
use super::turns::Turns;
use super::zeros_behind;
use crate::cut::cut;
use crate::roots::Roots;

/// The steps whose first operand is a slope.
const LOOKS: [i32; 5] = [2, 3, 7, 9, 12];

/// Where operands come from.
pub(super) struct Operands<'a, 'm> {
    pub m: &'m Module,
    pub turns: &'a Turns<'m>,
    pub results: &'a Results<'m>,
    pub root: &'a Root<'m>,
    pub beside: &'a Beside<'m>,
}

impl<'m> Operands<'_, 'm> {
    fn first(&self, step: i32) -> Signal<'m> {
        self.turns.first(step)
    }

    /// The operands of a step, at the end of its second half.
    pub fn choose(&self, roots: &Roots<'m>) -> Chosen<'m> {
        let Operands { m, turns, root, .. } = *self;
        let any = |steps: &[Signal<'m>]| steps.iter().copied().reduce(|any, one| any | one).expect("some");
        m.comment("First half of a step: the entry of a table, or a number and its factor.");
        let [of_r, place] = [root.m.here(), self.beside.place];
        let (in_a, in_c) = (self.first(3), self.first(9));
        let in_tables = m.cat(&[m.lit(2, 1), place.slice(15, 8)]);
        let in_tables = in_c.mux(in_tables, m.cat(&[m.lit(2, 0), of_r.slice(15, 8)]));
        let entry = in_a.mux(m.cat(&[m.lit(1, 1), root.k.here(), of_r.slice(15, 10)]), in_tables);
        let word = roots.read(turns.turns, entry.named("entry"));
        let low = in_c.mux(zeros_behind(place.trunc(8), 2), zeros_behind(of_r.trunc(8), 2));
        let low = in_a.mux(of_r.trunc(10), low).named_doc("low", "distance beyond the entry, 2^-10 entry");
        let number = turns.between("number", "2^-23, or 2^-16 in steps 13 and 15", self.number());
        let looks = any(&LOOKS.map(|step| turns.first(step)));
        let factor = turns.between("factor", "second operand", self.factor(looks, low));

        m.comment(
            "Second half: the slope of the entry, or the number over the root as far as its exponent goes.",
        );
        let slopes = any(&LOOKS.map(|step| turns.second(step))).named("slopes");
        let whole = (turns.second(13) | turns.second(15)).named("whole");
        // Of 25 bits, shifted by 7 at most: a half more overflows nothing.
        let shifted = number.sext(32).shl_by(root.k.there()) + m.lit(32, 1 << 6);
        let near = cut(m, "near", shifted.slice(31, 7).named_doc("shifted", "2^-16"), 18);
        let (v, slope) = (word.slice(32, 16), word.slice(15, 0));
        let a = slopes.mux(slope.zext(18), whole.mux(number.trunc(18), near));
        Chosen { a, b: factor, v }
    }

    /// The dividend of the root, 2^-23; or a factor, 2^-16.
    fn number(&self) -> Signal<'m> {
        let Operands { turns, results, .. } = *self;
        let both = results.diffuse.here().sext(19) + results.viewed.here().sext(19);
        let numbers = [
            (4, turns.of("pl")),
            (5, turns.of("dv")),
            (6, turns.of("da")),
            (10, zeros_behind(results.toward.here(), 7)),
            (11, turns.of("pv")),
            (13, results.attenuation.here().zext(25)),
            (15, results.diffuse.here().sext(25)),
        ];
        let both = zeros_behind(both, 6);
        numbers.into_iter().rev().fold(both, |other, (step, number)| self.first(step).mux(number, other))
    }

    /// The second factor of the number, or of a slope if `looks`.
    fn factor(&self, looks: Signal<'m>, low: Signal<'m>) -> Signal<'m> {
        let results = self.results;
        let others = self.first(15).mux(results.beam.here(), results.y.here());
        looks.mux(low.zext(17), self.first(13).mux(results.cone.here(), others))
    }
}
