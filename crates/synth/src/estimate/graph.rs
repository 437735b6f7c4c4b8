//! Logic as two-input ANDs with inverters on their inputs, bits of carry chains, and leaves.

use super::family::Family;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A node, inverted where the lowest bit is 1: node · 2 + inverted.
pub(super) type Lit = u32;
pub(super) const FALSE: Lit = 0;
pub(super) const TRUE: Lit = 1;

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Node {
    /// The constant 0, an input of the module, or a bit of a memory's output.
    Leaf,
    /// A flip-flop, by its number.
    Register(u32),
    /// The output of a memory, by its number.
    Memory(u32),
    /// Both of two.
    And(Lit, Lit),
    /// The sum of a bit of a carry chain, by its place in [`Graph::carries`].
    Sum(u32),
    /// The carry out of it.
    Carry(u32),
}

/// A bit of a carry chain: a + b + carry in.
#[derive(Clone, Copy, Debug)]
pub(super) struct CarryBit {
    pub inputs: [Lit; 3],
    /// The carry cell that the bit lies in. On an ECP5 two bits share one.
    pub cell: u32,
}

/// A hash that is quick for small numbers.
#[derive(Default)]
pub(super) struct Quick(u64);

impl Hasher for Quick {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u64(u64::from_le_bytes(word));
        }
    }
    fn write_u32(&mut self, value: u32) {
        self.write_u64(u64::from(value));
    }
    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 ^= self.0 >> 29;
    }
    fn write_usize(&mut self, value: usize) {
        self.write_u64(value as u64);
    }
}

pub(super) type QuickMap<K, V> = HashMap<K, V, BuildHasherDefault<Quick>>;

/// An AND of two literals, the lower one first, if that is no node of its own.
fn simple_and(a: Lit, b: Lit) -> Option<Lit> {
    match (a, b) {
        (FALSE, _) => Some(FALSE),
        (TRUE, _) => Some(b),
        _ if a == b => Some(a),
        _ if a == b ^ 1 => Some(FALSE),
        _ => None,
    }
}

/// Two literals as a key.
fn pair(a: Lit, b: Lit) -> u64 {
    u64::from(a) << 32 | u64::from(b)
}

/// The logic of a module.
pub(super) struct Graph {
    pub nodes: Vec<Node>,
    /// By node: the unit it was made for.
    pub units: Vec<u8>,
    pub carries: Vec<CarryBit>,
    /// The unit that nodes are made for now.
    pub unit: u8,
    pub family: Family,
    /// By the inputs of an AND, the lower one first: the AND.
    same: QuickMap<u64, Lit>,
    /// By node: it is `if .0 { .1 } else { .2 }`.
    pub choices: QuickMap<u32, (Lit, Lit, Lit)>,
}

impl Graph {
    /// With room for so many nodes.
    pub fn new(room: usize, family: Family) -> Graph {
        Graph {
            nodes: vec![Node::Leaf],
            units: vec![0],
            carries: Vec::new(),
            unit: 0,
            family,
            same: QuickMap::with_capacity_and_hasher(room, Default::default()),
            choices: QuickMap::default(),
        }
    }

    pub fn node(&mut self, node: Node) -> Lit {
        self.nodes.push(node);
        self.units.push(self.unit);
        (self.nodes.len() as Lit - 1) * 2
    }

    pub fn and(&mut self, a: Lit, b: Lit) -> Lit {
        let (a, b) = (a.min(b), a.max(b));
        if let Some(simple) = simple_and(a, b) {
            return simple;
        }
        let next = self.nodes.len() as Lit * 2;
        let lit = *self.same.entry(pair(a, b)).or_insert(next);
        if lit == next {
            self.node(Node::And(a, b));
        }
        lit
    }

    /// What the ANDs are where other nodes are known to be equal, by node.
    pub fn follow(&self, is: &mut [Lit]) {
        let mut new: QuickMap<u64, Lit> = QuickMap::default();
        for (index, node) in self.nodes.iter().enumerate() {
            let Node::And(a, b) = node else { continue };
            let [new_a, new_b] = [a, b].map(|lit| is[(lit >> 1) as usize] ^ (lit & 1));
            if (new_a, new_b) != (*a, *b) {
                let (a, b) = (new_a.min(new_b), new_a.max(new_b));
                let known = simple_and(a, b).or_else(|| self.same.get(&pair(a, b)).copied());
                let known = known.unwrap_or_else(|| *new.entry(pair(a, b)).or_insert(index as Lit * 2));
                is[index] = is[(known >> 1) as usize] ^ (known & 1);
            }
        }
    }

    pub fn or(&mut self, a: Lit, b: Lit) -> Lit {
        self.and(a ^ 1, b ^ 1) ^ 1
    }

    pub fn xor(&mut self, a: Lit, b: Lit) -> Lit {
        let both = self.and(a, b);
        let none = self.and(a ^ 1, b ^ 1);
        self.and(both ^ 1, none ^ 1)
    }

    /// `if c { t } else { e }`.
    pub fn mux(&mut self, c: Lit, t: Lit, e: Lit) -> Lit {
        match (c, t, e) {
            (TRUE, ..) => return t,
            (FALSE, ..) => return e,
            _ if t == e => return t,
            _ if t == e ^ 1 => return self.xor(c, e),
            _ => {}
        }
        let (on, off) = (self.and(c, t), self.and(c ^ 1, e));
        let lit = self.or(on, off);
        if [c, t, e].iter().all(|of| of >> 1 != lit >> 1) {
            self.choices.insert(lit >> 1, if lit & 1 == 0 { (c, t, e) } else { (c, t ^ 1, e ^ 1) });
        }
        lit
    }

    /// What a literal chooses from, if it is a choice.
    pub fn choice(&self, lit: Lit) -> Option<(Lit, Lit, Lit)> {
        let (c, t, e) = *self.choices.get(&(lit >> 1))?;
        Some((c, t ^ (lit & 1), e ^ (lit & 1)))
    }

    /// All of them, as a balanced tree.
    pub fn all(&mut self, lits: &[Lit]) -> Lit {
        match lits {
            [] => TRUE,
            [one] => *one,
            _ => {
                let (low, high) = lits.split_at(lits.len().div_ceil(2));
                let (low, high) = (self.all(low), self.all(high));
                self.and(low, high)
            }
        }
    }

    /// One of them at least.
    pub fn any(&mut self, lits: &[Lit]) -> Lit {
        let inverted: Vec<Lit> = lits.iter().map(|lit| lit ^ 1).collect();
        self.all(&inverted) ^ 1
    }

    pub fn parity(&mut self, lits: &[Lit]) -> Lit {
        match lits {
            [] => FALSE,
            [one] => *one,
            _ => {
                let (low, high) = lits.split_at(lits.len().div_ceil(2));
                let (low, high) = (self.parity(low), self.parity(high));
                self.xor(low, high)
            }
        }
    }

    /// Sum and carry of three bits in look-up tables.
    pub fn full_adder(&mut self, a: Lit, b: Lit, c: Lit) -> (Lit, Lit) {
        let half = self.xor(a, b);
        let sum = self.xor(half, c);
        let (both, through) = (self.and(a, b), self.and(half, c));
        (sum, self.or(both, through))
    }
}
