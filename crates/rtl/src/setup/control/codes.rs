//! The operations of a machine in their order, and the constants that stand for them.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use crate::setup::steps::Op;

/// The operations in their order: those on edges, then those on channels.
#[derive(Clone)]
pub(super) struct Codes<'m> {
    ops: Vec<(Op, Signal<'m>)>,
    /// Place of the last operation on an edge.
    pub last_edge: usize,
}

impl<'m> Codes<'m> {
    /// A constant an operation, its place.
    pub fn new(m: &'m Module, plan: &Plan) -> Codes<'m> {
        let last_edge = Op::of_edges(plan).len() - 1;
        let bits = (Op::all(plan).count() as u32).next_power_of_two().ilog2();
        let constant = |(place, op)| (op, m.constant(&name_of(op), bits, place as u128));
        Codes { ops: Op::all(plan).enumerate().map(constant).collect(), last_edge }
    }

    /// Bits of the place.
    pub fn bits(&self) -> u32 {
        self.ops[0].1.width()
    }

    /// The operations with their constants.
    pub fn iter(&self) -> impl Iterator<Item = &(Op, Signal<'m>)> {
        self.ops.iter()
    }

    /// The constant at a place.
    pub fn at(&self, place: usize) -> Signal<'m> {
        self.ops[place].1
    }

    /// The constant of an operation that the machine has.
    pub fn of(&self, op: Op) -> Signal<'m> {
        self.at(self.ops.iter().position(|(other, _)| *other == op).unwrap_or(0))
    }

    /// Place of the last operation of all.
    pub fn last_channel(&self) -> usize {
        self.ops.len() - 1
    }
}

/// `FixDx` as `FIX_DX`.
fn name_of(op: Op) -> String {
    let mut name = String::new();
    for c in format!("{op:?}").chars() {
        if c.is_ascii_uppercase() && !name.is_empty() {
            name.push('_');
        }
        name.push(c.to_ascii_uppercase());
    }
    name
}
