//! The values of a design without its hierarchy: every value is computed once, however often the modules ask
//! for it.

use std::collections::HashMap;

use edgewalk_netlist::Op;
use edgewalk_netlist::ops::mask;

/// A value's place in a [`Graph`]; operands come before what is computed from them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct ValueId(u32);

impl ValueId {
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Where a value comes from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    /// An input, a register or the output of a memory: kept in the state.
    Stored,
    /// Below 2^width.
    Constant(u128),
    /// An operator and its operands.
    Op(Op, Box<[ValueId]>),
}

/// All values.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    values: Vec<(Kind, u32)>,
    known: HashMap<(Kind, u32), ValueId>,
}

impl Graph {
    /// How many values there are.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// All values, operands first.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = ValueId> + use<> {
        (0..self.values.len() as u32).map(ValueId)
    }

    /// Where the value comes from.
    pub fn kind(&self, id: ValueId) -> &Kind {
        &self.values[id.index()].0
    }

    /// Bits of the value, 1 to 128.
    pub fn width(&self, id: ValueId) -> u32 {
        self.values[id.index()].1
    }

    /// Operands of the value; none unless it is computed.
    pub fn operands(&self, id: ValueId) -> &[ValueId] {
        match self.kind(id) {
            Kind::Op(_, operands) => operands,
            _ => &[],
        }
    }

    /// Whether the value must be computed to be read; else it is in the state all the time.
    pub fn is_computed(&self, id: ValueId) -> bool {
        matches!(self.kind(id), Kind::Op(..))
    }

    /// The value, if it is a constant.
    pub fn as_constant(&self, id: ValueId) -> Option<u128> {
        match self.kind(id) {
            Kind::Constant(value) => Some(*value),
            _ => None,
        }
    }

    /// The operands, if this operator computes the value.
    pub fn as_op(&self, id: ValueId, op: Op) -> Option<&[ValueId]> {
        match self.kind(id) {
            Kind::Op(found, operands) if *found == op => Some(operands),
            _ => None,
        }
    }

    /// A new value of the state.
    pub fn stored(&mut self, width: u32) -> ValueId {
        self.push(Kind::Stored, width)
    }

    /// The constant, cut to `width` bits.
    pub fn constant(&mut self, width: u32, value: u128) -> ValueId {
        self.shared(Kind::Constant(value & mask(width)), width)
    }

    /// The value of this kind: the one that is there already, or a new one.
    pub fn shared(&mut self, kind: Kind, width: u32) -> ValueId {
        let key = (kind, width);
        if let Some(id) = self.known.get(&key) {
            return *id;
        }
        let id = self.push(key.0.clone(), width);
        self.known.insert(key, id);
        id
    }

    fn push(&mut self, kind: Kind, width: u32) -> ValueId {
        self.values.push((kind, width));
        ValueId((self.values.len() - 1) as u32)
    }
}
