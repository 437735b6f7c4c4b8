//! A module by itself: its counts, its longest ways, and what is known of its ports then.

use super::build::{Built, build};
use super::builder::{Kind, UNKNOWN};
use super::cover::{Cover, cover, live, roots};
use super::delay::Delays;
use super::family::Family;
use super::graph::{Lit, Node, QuickMap, TRUE};
use super::merge::{Merges, merges};
use super::narrow::narrow;
use super::ports::{Seen, View};
use super::states::state_machines;
use super::ways::{Ways, ways};
use super::words::Words;
use edgewalk_netlist::Netlist;

/// What is found of an output bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Gives {
    /// Nothing.
    Own,
    /// The bit never changes.
    Constant(bool),
    /// The bit is that of an input.
    Input(u32),
    /// An output bit before is equal.
    Same(u32),
}

/// What a module says of its ports.
#[derive(Debug)]
pub(super) struct Ports {
    /// Of output bits that are read.
    pub gives: Vec<(u32, Gives)>,
    /// By input bit: how often it is read, at most [`OFTEN`].
    pub reads: Vec<u8>,
}

/// What a module comes to.
#[derive(Debug)]
pub(super) struct Module {
    /// The module and its instances, and the look-up tables of each.
    pub tables: Vec<(String, u64)>,
    pub carry: u64,
    pub ff: u64,
    /// Memory blocks, memories in look-up tables, multipliers.
    pub ram: u64,
    pub distributed: u64,
    pub products: u64,
    pub lone_ff: u64,
    pub lone_carry: u64,
    pub ways: Ways,
}

/// More readers of a bit at a port are not counted.
pub(super) const OFTEN: u8 = 2;

/// A module as logic that no table covers so far.
pub(super) struct Logic {
    words: Words,
    built: Built,
}

impl Logic {
    /// Of a netlist, seen so.
    pub fn of(netlist: &Netlist, view: &View) -> Logic {
        let mut words = Words::of(netlist, view);
        words.machines = state_machines(&words);
        narrow(&mut words);
        let built = build(&words);
        Logic { words, built }
    }

    pub fn ports(&self, view: &View) -> Ports {
        let Built { graph, inputs, .. } = &self.built;
        let live = live(&self.built);
        let mut readers = vec![0u8; graph.nodes.len()];
        let mut read = |lit: Lit| {
            let readers = &mut readers[(lit >> 1) as usize];
            *readers = (*readers + 1).min(OFTEN);
        };
        for (node, _) in graph.nodes.iter().zip(&live).filter(|(_, live)| **live) {
            if let Node::And(a, b) = node {
                [*a, *b].into_iter().for_each(&mut read);
            }
        }
        let gives = gives(&self.built, &self.words.wanted, view);
        roots(&self.built, &live).into_iter().for_each(&mut read);
        let mut reads: Vec<u8> = vec![0; inputs.len()];
        for (bit, lit) in inputs.iter().enumerate() {
            // A bit that equals another is not read: the other is read in its place.
            if view.seen(bit) == Seen::Own && *lit != UNKNOWN {
                reads[bit] = readers[(lit >> 1) as usize];
            }
        }
        Ports { gives, reads }
    }

    /// Covers the logic with tables.
    pub fn module(&self, delays: &Delays) -> Module {
        let Logic { words, built } = self;
        let cover = cover(built);
        let merges = merges(built, &cover);
        let mut counts =
            Counter { built, cover: &cover, merges: &merges, tables: vec![0; words.units.len()] };
        counts.tables();
        let tables = words.units.iter().cloned().zip(counts.tables.iter().copied()).collect();
        let (ff, lone_ff) = counts.flip_flops();
        let ((carry, lone_carry), lone_ff) = match built.graph.family {
            Family::Ice40 => (counts.carries(), lone_ff),
            Family::Ecp5 | Family::Gates => (counts.pairs(), 0), // a flip-flop of an ECP5 takes no look-up table's place
        };
        Module {
            tables,
            carry,
            ff,
            ram: counts.cells_of(Kind::Block),
            distributed: counts.cells_of(Kind::Distributed),
            products: counts.cells_of(Kind::Product),
            lone_ff,
            lone_carry,
            ways: ways(built, &cover, &merges, delays, &words.wanted),
        }
    }
}

fn gives(built: &Built, wanted: &[u32], view: &View) -> Vec<(u32, Gives)> {
    let mut first: QuickMap<Lit, Gives> = QuickMap::default();
    for (bit, lit) in built.inputs.iter().enumerate() {
        if *lit != UNKNOWN && view.seen(bit) == Seen::Own {
            first.insert(*lit, Gives::Input(bit as u32));
        }
    }
    let mut found: Vec<(u32, Gives)> = Vec::new();
    for (lit, bit) in built.outputs.iter().zip(wanted) {
        if found.last().is_some_and(|(last, _)| last == bit) {
            continue; // read more than once
        }
        let gives = match lit {
            ..=TRUE => Gives::Constant(*lit == TRUE),
            _ => *first.entry(*lit).or_insert(Gives::Same(*bit)),
        };
        found.push((*bit, if gives == Gives::Same(*bit) { Gives::Own } else { gives }));
    }
    found
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
            let sums = self.built.graph.family == Family::Ice40;
            let is_table =
                (sums && matches!(node, Node::Sum(_))) || (self.cover.tables[index].is_some() && !merged);
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

    /// Carry cells of an ECP5, and the places of look-up tables that these and small memories take.
    fn pairs(&self) -> (u64, u64) {
        let cell = |node| match node {
            Node::Sum(place) | Node::Carry(place) => Some(self.built.graph.carries[place as usize].cell),
            _ => None,
        };
        let mut cells: Vec<u32> = self.live().filter_map(|(_, node)| cell(node)).collect();
        cells.dedup();
        let carries = cells.len() as u64;
        (carries, 2 * carries + 4 * self.cells_of(Kind::Distributed))
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

    /// Memory cells or multipliers of a kind.
    fn cells_of(&self, kind: Kind) -> u64 {
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
            .filter(|(memory, live)| *live && memory.kind == kind)
            .map(|(memory, _)| u64::from(memory.blocks))
            .sum()
    }
}
