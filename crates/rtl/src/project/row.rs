//! A row of restoring division.

use edgewalk_netlist::Signal;

/// A row: of a rest below the divisor the next place of the quotient, and the next rest.
pub(super) struct Row<'m> {
    twice: Signal<'m>,
    less: Signal<'m>,
}

impl<'m> Row<'m> {
    /// The difference is `name`.
    pub fn new(name: &str, rest: Signal<'m>, divisor: Signal<'m>) -> Row<'m> {
        let m = rest.module();
        let twice = m.cat(&[rest, m.lit(1, 0)]);
        let less = (twice - divisor.zext(twice.width())).named_doc(name, "2 * rest - divisor, signed");
        Row { twice, less }
    }

    /// The place of the quotient, behind those before it.
    pub fn behind(&self, quotient: Option<Signal<'m>>) -> Signal<'m> {
        let digit = !self.less.msb();
        quotient.map_or(digit, |quotient| quotient.module().cat(&[quotient, digit]))
    }

    /// The rest.
    pub fn rest(&self) -> Signal<'m> {
        let bits = self.twice.width() - 1;
        self.less.msb().mux(self.twice.trunc(bits), self.less.trunc(bits))
    }
}
