//! Registers that change under the same conditions: what stands in one `always` block.

use edgewalk_netlist::netlist::{Netlist, NodeId};

use crate::simplify::is_same;

/// Conditions are compared this deep.
const CONDITION_DEPTH: u32 = 5;

/// Registers with the same conditions in the same order, and all with reset or all without.
pub(crate) struct Group {
    pub registers: Vec<usize>,
    pub has_reset: bool,
    pub conditions: Vec<Option<NodeId>>,
}

impl Group {
    /// The registers of a section in groups, in the order of the first of each.
    pub fn of(netlist: &Netlist, registers: &[usize]) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for &index in registers {
            let register = &netlist.registers[index];
            let has_reset = register.reset.is_some();
            let conditions: Vec<_> = register.updates.iter().map(|update| update.when).collect();
            let alike = |(one, two): (&Option<NodeId>, &Option<NodeId>)| match (one, two) {
                (Some(one), Some(two)) => is_same(netlist, *one, *two, CONDITION_DEPTH),
                (one, two) => one == two,
            };
            let same = |group: &&mut Group| {
                group.has_reset == has_reset
                    && group.conditions.len() == conditions.len()
                    && group.conditions.iter().zip(&conditions).all(alike)
            };
            match groups.iter_mut().find(same) {
                Some(group) => group.registers.push(index),
                None => groups.push(Group { registers: vec![index], has_reset, conditions }),
            }
        }
        groups
    }
}
