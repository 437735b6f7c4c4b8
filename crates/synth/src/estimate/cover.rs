//! Logic as look-up tables of four inputs: cuts of each node, the quickest first, then fewer tables where time is left.

use super::build::Built;
use super::graph::{Lit, Node};

/// Cuts kept of a node.
const KEPT: usize = 5;
const INPUTS: usize = 4;
/// The leaf behind the last one.
const NONE: u32 = u32::MAX;
/// Flows no further apart are equal.
const NEAR: f32 = 1e-4;

/// A way to compute a node: a table of these.
#[derive(Clone, Copy, Debug)]
struct Cut {
    /// In order, then [`NONE`].
    leaves: [u32; INPUTS + 1],
    len: u8,
    depth: u16,
    flow: f32,
    /// A bit for each leaf, by its last bits.
    sign: u32,
}

/// The chosen tables.
pub(super) struct Cover {
    /// By node: it is live.
    pub live: Vec<bool>,
    /// By node: the table that computes it, if it is the output of one.
    pub tables: Vec<Option<Table>>,
    /// By node: who reads it, tables and all else.
    pub readers: Vec<u32>,
    /// Tables that only invert.
    pub inverters: Vec<u32>,
}

/// A table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Table {
    leaves: [u32; INPUTS],
    len: u8,
}

impl Table {
    pub fn leaves(&self) -> &[u32] {
        &self.leaves[..self.len as usize]
    }
}

impl Cut {
    const EMPTY: Cut = Cut { leaves: [NONE; INPUTS + 1], len: 0, depth: 0, flow: 0.0, sign: 0 };

    fn leaves(&self) -> &[u32] {
        &self.leaves[..self.len as usize]
    }

    /// The node itself.
    fn of(node: u32, cost: Cost) -> Cut {
        let Cost { depth, flow } = cost;
        Cut {
            leaves: [node, NONE, NONE, NONE, NONE],
            len: 1,
            depth: depth + 1,
            flow: flow + 1.0,
            sign: 1 << (node & 31),
        }
    }

    /// Makes the cut both of two together, if they have no more than four leaves; whether it did.
    #[inline]
    fn join(&mut self, a: &Cut, b: &Cut) -> bool {
        let sign = a.sign | b.sign;
        if sign.count_ones() > INPUTS as u32 {
            return false;
        }
        let (mut i, mut j, mut len) = (0, 0, 0);
        // A leaf of no node ends each.
        loop {
            let (x, y) = (a.leaves[i], b.leaves[j]);
            let next = x.min(y);
            if next == NONE {
                break;
            }
            if len == INPUTS {
                return false;
            }
            self.leaves[len] = next;
            (i, j, len) = (i + usize::from(x <= y), j + usize::from(y <= x), len + 1);
        }
        self.leaves[len..].fill(NONE);
        (self.len, self.sign) = (len as u8, sign);
        true
    }

    fn within(&self, other: &Cut) -> bool {
        self.len <= other.len
            && self.sign & !other.sign == 0
            && self.leaves().iter().all(|leaf| other.leaves().contains(leaf))
    }
}

/// What a node costs by its chosen cut: tables one behind another, and tables by reader.
#[derive(Clone, Copy, Default)]
struct Cost {
    depth: u16,
    flow: f32,
}

struct Mapper<'b> {
    nodes: &'b [Node],
    live: Vec<bool>,
    /// By live node of two: its cuts, the chosen one first.
    cuts: Vec<[Cut; KEPT]>,
    /// By node: where its cuts stand.
    place: Vec<u32>,
    count: Vec<u8>,
    cost: Vec<Cost>,
    /// Estimated readers.
    share: Vec<f32>,
    required: Vec<u16>,
    readers: Vec<u32>,
    /// What is wanted of the logic.
    roots: Vec<Lit>,
}

/// All that leads to the outputs: by node whether it does.
pub(super) fn live(built: &Built) -> Vec<bool> {
    let graph = &built.graph;
    let mut live = vec![false; graph.nodes.len()];
    let mut stack: Vec<Lit> = built.outputs.clone();
    while let Some(lit) = stack.pop() {
        let node = (lit >> 1) as usize;
        if std::mem::replace(&mut live[node], true) {
            continue;
        }
        match graph.nodes[node] {
            Node::Leaf => {}
            Node::And(a, b) => stack.extend([a, b]),
            Node::Sum(place) | Node::Carry(place) => stack.extend(graph.carries[place as usize].inputs),
            Node::Register(place) => {
                let flip_flop = built.flip_flops[place as usize];
                stack.extend([flip_flop.d, flip_flop.enable, flip_flop.reset]);
            }
            Node::Memory(place) => stack.extend(&built.memories[place as usize].inputs),
        }
    }
    live
}

/// What the logic between has to give: outputs, what drives live flip-flops, memories and carry chains.
pub(super) fn roots(built: &Built, live: &[bool]) -> Vec<Lit> {
    let mut roots = built.outputs.clone();
    let mut memories = vec![false; built.memories.len()];
    let mut carries = vec![false; built.graph.carries.len()];
    for (index, node) in built.graph.nodes.iter().enumerate().filter(|(index, _)| live[*index]) {
        match node {
            Node::Register(place) => {
                let flip_flop = built.flip_flops[*place as usize];
                roots.extend([flip_flop.d, flip_flop.enable, flip_flop.reset]);
            }
            Node::Memory(place) if !std::mem::replace(&mut memories[*place as usize], true) => {
                roots.extend(&built.memories[*place as usize].inputs);
            }
            Node::Sum(place) | Node::Carry(place)
                if !std::mem::replace(&mut carries[*place as usize], true) =>
            {
                roots.extend(built.graph.carries[*place as usize].inputs);
            }
            _ => debug_assert!(live[index]),
        }
    }
    roots.retain(|root| *root > 1);
    roots
}

/// Covers the live logic.
pub(super) fn cover(built: &Built) -> Cover {
    let live = live(built);
    let roots = roots(built, &live);
    let count = built.graph.nodes.len();
    let mut cuts = 0;
    let mut place = vec![0; count];
    for (node, place) in place.iter_mut().enumerate() {
        if live[node] && matches!(built.graph.nodes[node], Node::And(..)) {
            *place = cuts;
            cuts += 1;
        }
    }
    let mut mapper = Mapper {
        nodes: &built.graph.nodes,
        live,
        cuts: vec![[Cut::EMPTY; KEPT]; cuts as usize],
        place,
        count: vec![0; count],
        cost: vec![Cost::default(); count],
        share: vec![1.0; count],
        required: vec![u16::MAX; count],
        readers: vec![0; count],
        roots,
    };
    mapper.count_fanouts();
    mapper.enumerate(true);
    mapper.choose();
    mapper.enumerate(false);
    mapper.choose();
    mapper.finish()
}

impl Mapper<'_> {
    /// The cuts of a node; none before they are enumerated.
    fn cuts_of(&self, node: usize) -> &[Cut] {
        match self.count[node] as usize {
            0 => &[],
            count => &self.cuts[self.place[node] as usize][..count],
        }
    }

    fn count_fanouts(&mut self) {
        let mut fanouts = vec![0u32; self.nodes.len()];
        for (index, node) in self.nodes.iter().enumerate() {
            if let Node::And(a, b) = node
                && self.live[index]
            {
                fanouts[(a >> 1) as usize] += 1;
                fanouts[(b >> 1) as usize] += 1;
            }
        }
        self.roots.iter().for_each(|root| fanouts[(root >> 1) as usize] += 1);
        self.share = fanouts.iter().map(|count| (*count).max(1) as f32).collect();
    }

    /// The best cuts of each node: the quickest, or those of the fewest tables among those that are quick enough.
    fn enumerate(&mut self, quickest: bool) {
        for index in 0..self.nodes.len() {
            if !self.live[index] {
                continue;
            }
            let Node::And(a, b) = self.nodes[index] else {
                continue;
            };
            let (a, b) = ((a >> 1) as usize, (b >> 1) as usize);
            let mut best = [Cut::EMPTY; KEPT];
            let mut cut = Cut::EMPTY;
            let mut kept = 0;
            let limit = if quickest { u16::MAX } else { self.required[index] };
            let (own_a, own_b) = (Cut::of(a as u32, self.cost[a]), Cut::of(b as u32, self.cost[b]));
            let (cuts_a, cuts_b) = (self.cuts_of(a), self.cuts_of(b));
            for i in 0..=cuts_a.len() {
                let one = if i == 0 { &own_a } else { &cuts_a[i - 1] };
                for j in 0..=cuts_b.len() {
                    let two = if j == 0 { &own_b } else { &cuts_b[j - 1] };
                    // Both together are no quicker than either, and no smaller.
                    let (depth, flow) = (one.depth.max(two.depth), one.flow.max(two.flow));
                    let worse = |known: &Cut| match quickest {
                        true => known.depth < depth,
                        false => known.flow < flow - 2.0 * NEAR,
                    };
                    if depth > limit || (kept == KEPT && worse(&best[KEPT - 1])) {
                        continue;
                    }
                    if !cut.join(one, two) {
                        continue;
                    }
                    let mut flow = 1.0;
                    let mut depth = 0;
                    for leaf in cut.leaves() {
                        let cost = self.cost[*leaf as usize];
                        depth = depth.max(cost.depth);
                        flow += cost.flow;
                    }
                    (cut.depth, cut.flow) = (depth + 1, flow);
                    if cut.depth > limit {
                        continue;
                    }
                    let before = |known: &Cut| {
                        let by_flow = |a: &Cut, b: &Cut| {
                            a.flow < b.flow - NEAR || (a.flow < b.flow + NEAR && a.len <= b.len)
                        };
                        match quickest {
                            true => {
                                known.depth < cut.depth || (known.depth == cut.depth && by_flow(known, &cut))
                            }
                            false => by_flow(known, &cut),
                        }
                    };
                    let place = best[..kept].iter().position(|known| !before(known)).unwrap_or(kept);
                    if place == KEPT || best[..kept].iter().any(|known| known.within(&cut)) {
                        continue;
                    }
                    let end = kept.min(KEPT - 1);
                    best.copy_within(place..end, place + 1);
                    best[place] = cut;
                    kept = (kept + 1).min(KEPT);
                }
            }
            if kept == 0 {
                continue; // the cuts found before stay
            }
            self.cuts[self.place[index] as usize] = best;
            self.count[index] = kept as u8;
            self.cost[index] = Cost { depth: best[0].depth, flow: best[0].flow / self.share[index] };
        }
    }

    /// Takes the first cut of each node that is needed; counts readers and how late each may be.
    fn choose(&mut self) {
        self.readers.fill(0);
        self.required.fill(u16::MAX);
        let deepest = self.roots.iter().map(|root| self.cost[(root >> 1) as usize].depth).max().unwrap_or(0);
        for root in &self.roots {
            let node = (root >> 1) as usize;
            self.readers[node] += 1;
            self.required[node] = self.required[node].min(deepest);
        }
        for index in (0..self.nodes.len()).rev() {
            if self.readers[index] == 0 || self.count[index] == 0 {
                continue;
            }
            let cut = self.cuts_of(index)[0];
            let required = self.required[index].saturating_sub(1);
            for leaf in cut.leaves() {
                let leaf = *leaf as usize;
                self.readers[leaf] += 1;
                self.required[leaf] = self.required[leaf].min(required);
            }
        }
        for (share, readers) in self.share.iter_mut().zip(&self.readers) {
            *share = ((*share + 2.0 * *readers as f32) / 3.0).max(1.0);
        }
    }

    fn finish(mut self) -> Cover {
        let tables: Vec<Option<Table>> = (0..self.nodes.len())
            .map(|index| {
                let cut = self.cuts_of(index).first().filter(|_| self.readers[index] > 0)?;
                Some(Table { leaves: std::array::from_fn(|leaf| cut.leaves[leaf]), len: cut.len })
            })
            .collect();
        // What is wanted inverted: a table can give that, but not both, and what is no table has to be inverted by one.
        let (mut plain, mut inverted) = (vec![false; self.nodes.len()], vec![false; self.nodes.len()]);
        for root in &self.roots {
            let of = if root & 1 == 0 { &mut plain } else { &mut inverted };
            of[(root >> 1) as usize] = true;
        }
        let inverters: Vec<u32> = (0..self.nodes.len())
            .filter(|index| inverted[*index] && (plain[*index] || tables[*index].is_none()))
            .map(|index| index as u32)
            .collect();
        for inverter in &inverters {
            self.readers[*inverter as usize] += 1;
        }
        Cover { live: self.live, tables, readers: self.readers, inverters }
    }
}
