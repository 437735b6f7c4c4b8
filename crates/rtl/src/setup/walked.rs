//! Which edges are walked.

use edgewalk_netlist::Signal;

use crate::wires::Registers;

/// Whether an edge or a part has lines: n1 and n2 of the prim say so, and with POLY the sides that count.
pub(super) struct Walked<'m> {
    lines: [Signal<'m>; 2],
    sides: Option<Signal<'m>>,
}

impl<'m> Walked<'m> {
    /// By the registers of the prim.
    pub fn new(prim: &Registers<'m>) -> Walked<'m> {
        Walked {
            lines: ["n1", "n2"].map(|lines| prim[lines].q()),
            sides: prim.get("sides").map(|sides| sides.q()),
        }
    }

    /// The upper or the lower part has lines.
    pub fn part(&self, part: usize) -> Signal<'m> {
        self.lines[part].any()
    }

    /// The major, first or second minor edge counts and has lines; `None`: always.
    pub fn edge(&self, edge: usize) -> Option<Signal<'m>> {
        match (edge, self.sides) {
            (0, None) => None,
            (0, Some(sides)) => Some((self.part(0) | self.part(1)) & sides.bit(0)),
            (_, None) => Some(self.part(edge - 1)),
            (_, Some(sides)) => Some(self.part(edge - 1) & sides.bit(edge as u32)),
        }
    }
}
