//! The longest ways through a module's logic: between its registers, from and to its ports, and from port to port.

use super::build::Built;
use super::builder::{Kind, UNKNOWN};
use super::cover::Cover;
use super::delay::{Delays, Path};
use super::graph::{Lit, Node};
use super::merge::Merges;
use std::collections::BTreeMap;

/// A way, and how long it takes by the delays of the day.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Way {
    pub ns: f64,
    pub path: Path,
}

impl Way {
    /// One behind the other.
    pub fn then(&self, next: &Way) -> Way {
        let (a, b) = (&self.path, &next.path);
        Way {
            ns: self.ns + next.ns,
            path: Path {
                tables: a.tables + b.tables,
                carries: a.carries + b.carries,
                entries: a.entries + b.entries,
                fanout: a.fanout + b.fanout,
            },
        }
    }
}

/// The longer of two ways.
pub(super) fn longer(way: &mut Option<Way>, other: Way) {
    if way.is_none_or(|way| other.ns > way.ns) {
        *way = Some(other);
    }
}

/// The longest ways of a module. Bits are numbered through the ports.
#[derive(Debug, Default)]
pub(super) struct Ways {
    /// From register to register.
    pub within: Way,
    /// By input bit: to a register.
    pub ends: Vec<(u32, Way)>,
    /// By output bit: from a register.
    pub begins: BTreeMap<u32, Way>,
    /// By output bit: from input bits.
    pub through: BTreeMap<u32, Vec<(u32, Way)>>,
}

struct Walk<'w> {
    built: &'w Built,
    cover: &'w Cover,
    merges: &'w Merges,
    delays: &'w Delays,
}

/// Finds them; `wanted` tells which output bit each of the module's outputs is.
pub(super) fn ways(built: &Built, cover: &Cover, merges: &Merges, delays: &Delays, wanted: &[u32]) -> Ways {
    let walk = Walk { built, cover, merges, delays };
    let count = built.graph.nodes.len();
    let mut input = vec![u32::MAX; count];
    for (bit, lit) in built.inputs.iter().enumerate().filter(|(_, lit)| **lit != UNKNOWN && **lit > 1) {
        let node = (lit >> 1) as usize;
        if matches!(built.graph.nodes[node], Node::Leaf) && input[node] == u32::MAX {
            input[node] = bit as u32;
        }
    }
    // From registers, and whether an input has a way to the node.
    let mut from: Vec<Option<Way>> = vec![None; count];
    let mut open = vec![false; count];
    for index in (0..count).filter(|index| cover.live[*index]) {
        open[index] = input[index] != u32::MAX;
        let begins = match built.graph.nodes[index] {
            Node::Leaf | Node::Register(_) => true,
            Node::Memory(place) => built.memories[place as usize].kind != Kind::Distributed,
            _ => false,
        };
        if begins && !open[index] {
            from[index] = Some(Way::default());
        }
        walk.hops(index, |before, hop| {
            if let Some(way) = &from[before] {
                let way = way.then(&hop);
                longer(&mut from[index], way);
            }
            open[index] |= open[before];
        });
    }
    let mut found = Ways::default();
    // To registers.
    let mut to: Vec<Option<Way>> = vec![None; count];
    for lit in walk.ends() {
        let node = (lit >> 1) as usize;
        let last = walk.wire(node);
        to[node] = Some(last);
        if let Some(way) = from[node].map(|way| way.then(&last)).filter(|way| way.ns > found.within.ns) {
            found.within = way;
        }
    }
    for index in (0..count).rev() {
        let Some(way) = to[index] else { continue };
        walk.hops(index, |before, hop| longer(&mut to[before], hop.then(&way)));
    }
    let ended = |index: &usize| Some((input[*index], to[*index].filter(|_| input[*index] != u32::MAX)?));
    found.ends = (0..count).filter_map(|index| ended(&index)).collect();
    for (lit, bit) in built.outputs.iter().zip(wanted) {
        let node = lit >> 1;
        if let Some(way) = from[node as usize] {
            found.begins.insert(*bit, way);
        }
        if open[node as usize] && !found.through.contains_key(bit) {
            found.through.insert(*bit, walk.through(node, &open, &input));
        }
    }
    found
}

impl Walk<'_> {
    /// The wire behind a node.
    fn wire(&self, node: usize) -> Way {
        let fanout = f64::from(self.cover.readers[node].max(1)).log2();
        Way { ns: self.delays.fanout * fanout, path: Path { fanout, ..Path::default() } }
    }

    /// What a node is computed from, and the way from there.
    fn hops(&self, index: usize, mut each: impl FnMut(usize, Way)) {
        let nodes = &self.built.graph.nodes;
        let step = |carry: bool| match carry {
            true => Way { ns: self.delays.carry, path: Path { carries: 1.0, ..Path::default() } },
            false => Way::default(),
        };
        let wired = |from: usize, delay: f64, path: Path| self.wire(from).then(&Way { ns: delay, path });
        let table = Path { tables: 1.0, ..Path::default() };
        match nodes[index] {
            Node::Sum(place) | Node::Carry(place) => {
                let is_sum = matches!(nodes[index], Node::Sum(_));
                for lit in self.built.graph.carries[place as usize].inputs {
                    let from = (lit >> 1) as usize;
                    let on_chain = matches!(nodes[from], Node::Carry(_));
                    let entry = Path { entries: 1.0, ..Path::default() };
                    each(
                        from,
                        match (on_chain, is_sum) {
                            (true, false) => step(true),
                            (_, true) => wired(from, self.delays.table, table),
                            (false, false) => wired(from, self.delays.entry, entry),
                        },
                    );
                }
            }
            // Look-up tables of a memory are read without a clock.
            Node::Memory(place) if self.built.memories[place as usize].kind == Kind::Distributed => {
                let addresses = self.built.memories[place as usize].reads.iter().flat_map(|(_, word)| word);
                addresses.for_each(|lit| {
                    let from = (lit >> 1) as usize;
                    each(from, wired(from, self.delays.table, table));
                });
            }
            _ => {
                for leaf in self.cover.tables[index].iter().flat_map(|table| table.leaves()) {
                    let free = self.merges.before[index] || self.merges.behind[index] == Some(*leaf);
                    let from = *leaf as usize;
                    each(from, if free { step(false) } else { wired(from, self.delays.table, table) });
                }
            }
        }
    }

    /// What registers and memories take.
    fn ends(&self) -> Vec<Lit> {
        let mut ends = Vec::new();
        let nodes = self.built.graph.nodes.iter().enumerate();
        for (_, node) in nodes.filter(|(index, _)| self.cover.live[*index]) {
            match node {
                Node::Register(place) => {
                    let flip_flop = self.built.flip_flops[*place as usize];
                    ends.extend([flip_flop.d, flip_flop.enable, flip_flop.reset]);
                }
                Node::Memory(place) => ends.extend(&self.built.memories[*place as usize].inputs),
                _ => {}
            }
        }
        ends
    }

    /// The ways from input bits to a node.
    fn through(&self, node: u32, open: &[bool], input: &[u32]) -> Vec<(u32, Way)> {
        let mut found = Vec::new();
        let mut cone = BTreeMap::from([(node as usize, Some(Way::default()))]);
        while let Some((index, way)) = cone.pop_last() {
            let Some(way) = way else { continue };
            if input[index] != u32::MAX {
                found.push((input[index], way));
            }
            self.hops(index, |before, hop| {
                if open[before] {
                    longer(cone.entry(before).or_default(), hop.then(&way));
                }
            });
        }
        found
    }
}
