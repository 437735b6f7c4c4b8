//! What a netlist comes to, before any factor is applied.

use super::build::{Built, build};
use super::cover::{Cover, cover};
use super::delay::{Delays, Path, longest};
use super::graph::Node;
use super::merge::{Merges, merges};
use super::narrow::narrow;
use super::words::Words;
use edgewalk_netlist::Netlist;

/// Counts of a module.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// A number for what the netlist computes; names and comments are no part of it.
    pub shape: u64,
    /// Whether all units were asked for, and no part of the machine.
    pub whole: bool,
    /// Look-up tables of each unit, the top module's own first.
    pub tables: Vec<UnitTables>,
    /// Bits of carry chains.
    pub carry: u64,
    /// Flip-flops.
    pub ff: u64,
    /// Memory blocks.
    pub ram: u64,
    /// Flip-flops that share no cell with the table before them.
    pub lone_ff: u64,
    /// Cells that a carry chain takes beside its sums: carries without a sum, and ways in and out.
    pub lone_carry: u64,
    /// The longest path.
    pub path: Path,
}

/// Look-up tables of a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitTables {
    /// The unit's name.
    pub unit: String,
    /// How many of its own.
    pub tables: u64,
}

impl Structure {
    /// Of a module with all that is in it; the longest path is that by these delays.
    #[must_use]
    pub fn of(netlist: &Netlist, delays: &Delays) -> Structure {
        let mut words = Words::of(netlist);
        narrow(&mut words);
        let built = build(&words);
        let cover = cover(&built);
        let merges = merges(&built, &cover);
        let mut counts =
            Counter { built: &built, cover: &cover, merges: &merges, tables: vec![0; words.units.len()] };
        counts.tables();
        let tables = words.units.iter().zip(&counts.tables);
        let tables =
            tables.map(|(unit, tables)| UnitTables { unit: unit.clone(), tables: *tables }).collect();
        let (carry, lone_carry) = counts.carries();
        let (ff, lone_ff) = counts.flip_flops();
        Structure {
            shape: words.shape(),
            whole: true,
            tables,
            carry,
            ff,
            ram: counts.blocks(),
            lone_ff,
            lone_carry,
            path: longest(&built, &cover, &merges, delays),
        }
    }

    /// All look-up tables.
    #[must_use]
    pub fn lut4(&self) -> u64 {
        self.tables.iter().map(|unit| unit.tables).sum()
    }
}

struct Counter<'c> {
    built: &'c Built,
    cover: &'c Cover,
    merges: &'c Merges,
    /// By unit.
    tables: Vec<u64>,
}

impl Counter<'_> {
    fn live(&self) -> impl Iterator<Item = (usize, Node)> {
        let nodes = self.built.graph.nodes.iter().copied().enumerate();
        nodes.filter(|(index, _)| self.cover.live[*index])
    }

    fn tables(&mut self) {
        let mut tables = vec![0; self.tables.len()];
        let own = |node: usize| self.built.graph.units[node] as usize;
        for (index, node) in self.live() {
            let merged = self.merges.before[index] || self.merges.behind[index].is_some();
            let is_table = matches!(node, Node::Sum(_)) || (self.cover.tables[index].is_some() && !merged);
            tables[own(index)] += u64::from(is_table);
        }
        for inverter in &self.cover.inverters {
            tables[own(*inverter as usize)] += 1;
        }
        self.tables = tables;
    }

    /// Bits of carry chains, and the cells that these take beside tables.
    fn carries(&self) -> (u64, u64) {
        let graph = &self.built.graph;
        let (mut carries, mut lone) = (0, 0);
        for (index, node) in self.live() {
            let Node::Carry(place) = node else { continue };
            carries += 1;
            let has_sum = matches!(graph.nodes[index - 1], Node::Sum(_)) && self.cover.live[index - 1];
            lone += u64::from(!has_sum);
            let first = graph.carries[place as usize].inputs[2];
            let begins = first > 1 && !matches!(graph.nodes[(first >> 1) as usize], Node::Carry(_));
            lone += u64::from(begins);
            lone += u64::from(self.cover.readers[index] > 0 && self.read_as_logic(index));
        }
        (carries, lone)
    }

    /// Whether somebody beside the next step of the chain reads a carry.
    fn read_as_logic(&self, carry: usize) -> bool {
        let chain = |node: usize| match self.built.graph.nodes.get(node) {
            Some(Node::Sum(place) | Node::Carry(place)) => {
                self.built.graph.carries[*place as usize].inputs[2] >> 1 == carry as u32
            }
            _ => false,
        };
        let next = (chain(carry + 1) && self.cover.live[carry + 1])
            || (chain(carry + 2) && self.cover.live[carry + 2]);
        self.cover.readers[carry] > u32::from(next)
    }

    /// Flip-flops, and those among them that share no cell with a table.
    fn flip_flops(&self) -> (u64, u64) {
        let (mut all, mut lone) = (0, 0);
        for (_, node) in self.live() {
            let Node::Register(place) = node else { continue };
            all += 1;
            let d = self.built.flip_flops[place as usize].d;
            let before = (d >> 1) as usize;
            let is_sum = matches!(self.built.graph.nodes[before], Node::Sum(_)) && d & 1 == 0;
            let is_table = is_sum || self.cover.tables[before].is_some() || (d & 1 == 1 && d > 1);
            lone += u64::from(!(is_table && self.cover.readers[before] == 1));
        }
        (all, lone)
    }

    fn blocks(&self) -> u64 {
        let mut live = vec![false; self.built.memories.len()];
        for (_, node) in self.live() {
            if let Node::Memory(place) = node {
                live[place as usize] = true;
            }
        }
        self.built
            .memories
            .iter()
            .zip(live)
            .filter(|(_, live)| *live)
            .map(|(memory, _)| u64::from(memory.blocks))
            .sum()
    }
}
