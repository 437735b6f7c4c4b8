//! Uses of names and operators: names that are taken, how often an operator is used, which bits of a signal the text mentions.

use std::collections::{BTreeMap, BTreeSet};

use edgewalk_netlist::netlist::{Netlist, NodeId, Source};
use edgewalk_netlist::ops::mask;

use crate::groups::Group;

/// Every name in the module, those made up here included.
pub(crate) struct Names(BTreeSet<String>);

impl Names {
    pub fn of(netlist: &Netlist) -> Self {
        let nodes = netlist.ids().filter_map(|id| netlist.name_of(id));
        let outputs = netlist.outputs.iter().map(|output| output.name.clone());
        let memories = netlist.memories.iter().map(|memory| memory.name.clone());
        let instances = netlist.instances.iter().map(|instance| instance.name.clone());
        let implicit = ["clk", "rst", "unused"].map(String::from);
        Names(nodes.chain(outputs).chain(memories).chain(instances).chain(implicit).collect())
    }

    /// The stem itself if it is free, else with the first number that is.
    pub fn fresh(&mut self, stem: &str) -> String {
        let numbered = (2..).map(|number| format!("{stem}_{number}"));
        let name = std::iter::once(stem.to_string()).chain(numbered).find(|name| !self.0.contains(name));
        let name = name.unwrap_or_default(); // never: the numbers do not end
        self.0.insert(name.clone());
        name
    }
}

/// For every node in how many places of the text it is wanted.
pub(crate) fn fanout(netlist: &Netlist, groups: &[Group]) -> Vec<usize> {
    let mut count = vec![0; netlist.nodes.len()];
    let mut todo: Vec<NodeId> = Vec::new();
    todo.extend(netlist.outputs.iter().map(|output| output.driver));
    todo.extend(netlist.wires.iter().map(|wire| wire.driver));
    for group in groups {
        // A condition is written once for the whole group.
        todo.extend(group.conditions.iter().flatten());
        for register in &group.registers {
            todo.extend(netlist.registers[*register].updates.iter().map(|update| update.value));
        }
    }
    for memory in &netlist.memories {
        todo.extend(memory.writes.iter().flat_map(|port| [port.en, port.addr, port.data]));
        todo.extend(memory.reads.iter().flat_map(|port| [port.en, port.addr]));
    }
    todo.extend(netlist.instances.iter().flat_map(|instance| instance.connections.iter().copied()));
    while let Some(id) = todo.pop() {
        count[id.index()] += 1;
        // Its operands are wanted once by its own text, however often that is used.
        if count[id.index()] == 1
            && let Source::Op(_, operands) = &netlist.node(id).source
        {
            todo.extend(operands);
        }
    }
    count
}

/// The bits of each declared signal that the text mentions.
#[derive(Default)]
pub(crate) struct Mentioned(BTreeMap<NodeId, u128>);

impl Mentioned {
    pub fn bits(&mut self, id: NodeId, hi: u32, lo: u32) {
        *self.0.entry(id).or_default() |= mask(hi + 1) & !(if lo == 0 { 0 } else { mask(lo) });
    }

    /// The ranges (hi, lo) of a signal that are never mentioned, the highest first.
    pub fn missing(&self, id: NodeId, width: u32) -> Vec<(u32, u32)> {
        let used = self.0.get(&id).copied().unwrap_or(0);
        let mut ranges: Vec<(u32, u32)> = Vec::new();
        for bit in (0..width).rev().filter(|bit| used >> bit & 1 == 0) {
            match ranges.last_mut() {
                Some((_, lo)) if *lo == bit + 1 => *lo = bit,
                _ => ranges.push((bit, bit)),
            }
        }
        ranges
    }
}
