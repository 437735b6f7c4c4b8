//! The longest path from register to register: how many look-up tables and bits of carry it has, by delays that were
//! fitted to placed designs.

use super::build::Built;
use super::cover::Cover;
use super::graph::{Lit, Node};
use super::merge::Merges;
use serde::{Deserialize, Serialize};

/// What a path consists of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Look-up tables, with the wire to each.
    pub tables: f64,
    /// Steps of a carry chain.
    pub carries: f64,
    /// Ways into a carry chain.
    pub entries: f64,
    /// Binary logarithms of the readers of each wire on it, added up.
    pub fanout: f64,
}

/// Delays of an iCE40 HX8K, ns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Delays {
    /// From the clock to a register's output, and what a register wants before the clock.
    pub register: f64,
    /// A table with a wire to it.
    pub table: f64,
    /// A step of a carry chain.
    pub carry: f64,
    /// The way into a carry chain.
    pub entry: f64,
    /// A doubling of a wire's readers.
    pub fanout: f64,
    /// A doubling of the module's cells.
    pub size: f64,
}

/// A module has so many cells where [`Delays::size`] adds nothing.
const USUAL_CELLS: f64 = 1000.0;

impl Delays {
    /// Of a path in a module of so many cells, ns.
    #[must_use]
    pub fn of(&self, path: &Path, cells: f64) -> f64 {
        self.parts(path, cells).iter().sum()
    }

    /// What each delay adds.
    #[must_use]
    pub fn parts(&self, path: &Path, cells: f64) -> [f64; 6] {
        let weights = Delays::weights(path, cells);
        let delays = [self.register, self.table, self.carry, self.entry, self.fanout, self.size];
        std::array::from_fn(|at| delays[at] * weights[at])
    }

    /// How often each delay counts on a path, in the order of the fields.
    #[must_use]
    pub fn weights(path: &Path, cells: f64) -> [f64; 6] {
        let size = (cells.max(1.0) / USUAL_CELLS).log2();
        [1.0, path.tables, path.carries, path.entries, path.fanout, size]
    }
}

/// When a node's value is there, and by which node before it.
#[derive(Clone, Copy, Default)]
struct Arrival {
    ns: f32,
    from: u32,
    /// 0: nothing before; 1: a table; 2: a step of carry; 3: into a carry chain; 4: at no cost.
    kind: u8,
}

/// The longest path.
pub(super) fn longest(built: &Built, cover: &Cover, merges: &Merges, delays: &Delays) -> Path {
    let nodes = &built.graph.nodes;
    let mut arrivals = vec![Arrival::default(); nodes.len()];
    let wire = |node: usize| delays.fanout as f32 * fanout(cover, node) as f32;
    let hop = |arrivals: &[Arrival], from: u32, kind: u8, delay: f64| {
        let node = from as usize;
        let ns = if kind == 2 || kind == 4 { 0.0 } else { wire(node) };
        Arrival { ns: arrivals[node].ns + ns + delay as f32, from, kind }
    };
    let later = |a: Arrival, b: Arrival| if b.ns > a.ns { b } else { a };
    for index in 0..nodes.len() {
        if !cover.live[index] {
            continue;
        }
        let mut latest = Arrival::default();
        match nodes[index] {
            Node::Sum(place) | Node::Carry(place) => {
                let is_sum = matches!(nodes[index], Node::Sum(_));
                for lit in built.graph.carries[place as usize].inputs {
                    let from = lit >> 1;
                    let on_chain = matches!(nodes[from as usize], Node::Carry(_));
                    let next = match (on_chain, is_sum) {
                        (true, false) => hop(&arrivals, from, 2, delays.carry),
                        (true, true) => hop(&arrivals, from, 1, delays.table),
                        (false, true) => hop(&arrivals, from, 1, delays.table),
                        (false, false) => hop(&arrivals, from, 3, delays.entry),
                    };
                    latest = later(latest, next);
                }
            }
            _ => {
                if let Some(table) = &cover.tables[index] {
                    for leaf in table.leaves() {
                        let free = merges.before[index] || merges.behind[index] == Some(*leaf);
                        let (kind, delay) = if free { (4, 0.0) } else { (1, delays.table) };
                        latest = later(latest, hop(&arrivals, *leaf, kind, delay));
                    }
                }
            }
        }
        arrivals[index] = latest;
    }
    let mut end = 0;
    let mut at = |lit: Lit| {
        let node = (lit >> 1) as usize;
        if arrivals[node].ns + wire(node) > arrivals[end].ns + wire(end) {
            end = node;
        }
    };
    for (index, node) in nodes.iter().enumerate().filter(|(index, _)| cover.live[*index]) {
        match node {
            Node::Register(place) => {
                let flip_flop = built.flip_flops[*place as usize];
                [flip_flop.d, flip_flop.enable, flip_flop.reset].into_iter().for_each(&mut at);
            }
            Node::Memory(place) => built.memories[*place as usize].inputs.iter().copied().for_each(&mut at),
            _ => debug_assert!(cover.live[index]),
        }
    }
    built.outputs.iter().copied().for_each(&mut at);
    let mut path = Path { fanout: fanout(cover, end), ..Path::default() };
    let mut node = end;
    while arrivals[node].kind != 0 {
        let Arrival { from, kind, .. } = arrivals[node];
        match kind {
            1 => path.tables += 1.0,
            2 => path.carries += 1.0,
            3 => path.entries += 1.0,
            _ => {}
        }
        if kind == 1 || kind == 3 {
            path.fanout += fanout(cover, from as usize);
        }
        node = from as usize;
    }
    path
}

fn fanout(cover: &Cover, node: usize) -> f64 {
    f64::from(cover.readers[node].max(1)).log2()
}
