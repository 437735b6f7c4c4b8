//! What bits are while nothing is to be done: after a reset, with inputs that all say no, or all yes, as a memory that is ready does. A
//! condition that holds then, as "the place is free" does, says of what changes under it only that it may be another value; one
//! that does not, as "a token enters", says that something is going on.

use edgewalk_netlist::ops::{Bits, mask};

use crate::design::Design;
use crate::graph::{Kind, ValueId};

/// Of each value, whether it is a bit that is 1 then.
#[derive(Clone, Debug, Default)]
pub(crate) struct Idle(Vec<bool>);

impl Idle {
    /// Of all values of the design; what is not reset is taken as 0.
    pub fn of(design: &Design) -> Idle {
        let [no, yes] = [0, u128::MAX].map(|inputs| after_reset(design, inputs));
        let holds = |id: ValueId| design.graph.width(id) == 1 && (no[id.index()] | yes[id.index()]) == 1;
        Idle(design.graph.ids().map(holds).collect())
    }

    /// Whether this condition holds then.
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
