//! Where the walk stands, and which way the span lies.

use edgewalk_netlist::{Module, Reg, Signal};

use super::record::{REF_X, REF_Y, Record};
use crate::wires::Token;

/// The pixel that the words are those of.
pub(super) struct Place<'m> {
    x: Reg<'m>,
    y: Reg<'m>,
    leftward: Signal<'m>,
    /// The pixel is the span's first.
    pub reached: Signal<'m>,
    /// The next step, where it is not: of these one, or else back.
    pub down: Signal<'m>,
    pub forward: Signal<'m>,
}

impl<'m> Place<'m> {
    /// Against the span that is offered.
    pub fn new(m: &'m Module, span: &Token<'m>) -> Place<'m> {
        m.comment("Position of the walk, and its target: first down the lines, then along the line.");
        let x = m.reg("x", span["x"].width()).doc("column of the walk, signed");
        let y = m.reg("y", span["y"].width()).doc("line");
        let down = y.q().ne(span["y"]).named_doc("down", "the walk steps to the next line");
        let (to, bits) = (span["x"], span["x"].width() - 1);
        let ahead = (to - x.q()).named_doc("ahead", "columns from the walk to the target, signed");
        // Whether it stands there does not wait for how far it is.
        let (low, high) =
            (x.q().trunc(bits).ne(to.trunc(bits)).named("columns_differ"), x.q().msb() ^ to.msb());
        let leftward = span["leftward"];
        // The least number has no opposite: it is negative either way, and differs from 0 in its highest bit alone.
        let left = ahead.msb();
        let forward = leftward.mux(left & low, !left);
        let forward = (!down & forward).named_doc("forward", "the walk steps to the next column");
        let reached = (!down & !low & !high).named("reached");
        Place { x, y, leftward, reached, down, forward }
    }

    /// The place goes on when a step is done, and to the reference pixel of a record.
    pub fn step(&self, stepped: Signal<'m>, record: &Record<'m>) {
        let right =
            (self.forward ^ self.leftward).named_doc("rightward", "direction of a step along the line");
        // Both are there before the way is known.
        let (one_right, one_left) = (self.x.q() + 1, self.x.q() - 1);
        self.x.when(stepped & !self.down, right.mux(one_right, one_left));
        self.y.when(stepped & self.down, self.y.q() + 1);
        record.load(self.x, REF_X);
        record.load(self.y, REF_Y);
    }
}
