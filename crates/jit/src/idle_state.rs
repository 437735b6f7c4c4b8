//! What bits are in an idle machine: after a reset, with all inputs 0 or all inputs 1, since a memory that is
//! ready gives 1. A condition that holds then, such as "the place is free", does not mean that what changes
//! under it gets a new value. A condition that does not hold then, such as "a token enters", means that
//! something is going on.

use edgewalk_netlist::ops::{Bits, mask};

use crate::design::Design;
use crate::graph::{Kind, ValueId};

/// Of each value, whether it is a bit that is 1 in an idle machine.
#[derive(Clone, Debug, Default)]
pub(crate) struct IdleState(Vec<bool>);

impl IdleState {
    /// All values of the design; a register without reset counts as 0.
    pub fn of(design: &Design) -> IdleState {
        let [no, yes] = [0, u128::MAX].map(|inputs| after_reset(design, inputs));
        let holds = |id: ValueId| design.graph.width(id) == 1 && (no[id.index()] | yes[id.index()]) == 1;
        IdleState(design.graph.ids().map(holds).collect())
    }

    /// Whether this condition holds in an idle machine.
    pub fn holds(&self, condition: ValueId) -> bool {
        self.0.get(condition.index()).copied().unwrap_or(false)
    }
}

/// All values after a reset, with these bits at each input but `rst`.
fn after_reset(design: &Design, inputs: u128) -> Vec<u128> {
    let graph = &design.graph;
    let mut values = vec![0; graph.len()];
    for input in design.inputs.values().filter(|input| **input != design.reset) {
        values[input.index()] = inputs & mask(graph.width(*input));
    }
    for register in &design.registers {
        values[register.q.index()] = register.reset.unwrap_or(0);
    }
    for id in graph.ids() {
        match graph.kind(id) {
            Kind::Stored => {}
            Kind::Constant(value) => values[id.index()] = *value,
            Kind::Op(op, operands) => {
                let bits = |id: &ValueId| Bits { value: values[id.index()], width: graph.width(*id) };
                let operands: Vec<Bits> = operands.iter().map(bits).collect();
                values[id.index()] = op.value(graph.width(id), &operands);
            }
        }
    }
    values
}
