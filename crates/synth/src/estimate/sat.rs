//! Whether literals can all be true at once, whatever the leaves are: a search with propagation.

use super::graph::{Graph, Lit, Node, QuickMap};

/// Decisions after which the answer is taken to be yes.
const BUDGET: usize = 2000;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Value {
    Open,
    Known(bool),
}

/// What a node is computed from.
struct Inputs {
    lits: [Lit; 3],
    count: usize,
}

impl Inputs {
    fn iter(&self) -> impl Iterator<Item = Lit> {
        self.lits.into_iter().take(self.count)
    }
}

struct Search<'g> {
    graph: &'g Graph,
    /// Nodes of the cone, and where each stands.
    nodes: Vec<u32>,
    places: QuickMap<u32, usize>,
    readers: Vec<Vec<usize>>,
    values: Vec<Value>,
    trail: Vec<usize>,
    equal: Vec<(Lit, Lit)>,
    budget: usize,
}

/// Whether all of `wanted` can be true, and the two of each pair equal, in one clock. A search that takes too long says
/// yes.
pub(super) fn possible(graph: &Graph, wanted: &[Lit], equal: &[(Lit, Lit)]) -> bool {
    if wanted.contains(&0) {
        return false;
    }
    let wanted: Vec<Lit> = wanted.iter().copied().filter(|lit| *lit != 1).collect();
    let mut search = Search {
        graph,
        nodes: Vec::new(),
        places: QuickMap::default(),
        readers: Vec::new(),
        values: Vec::new(),
        trail: Vec::new(),
        equal: equal.to_vec(),
        budget: BUDGET,
    };
    let mut stack: Vec<u32> =
        wanted.iter().chain(equal.iter().flat_map(|(a, b)| [a, b])).map(|lit| lit >> 1).collect();
    while let Some(node) = stack.pop() {
        if node == 0 || search.places.contains_key(&node) {
            continue;
        }
        search.places.insert(node, search.nodes.len());
        search.nodes.push(node);
        stack.extend(search.inputs(node).iter().map(|lit| lit >> 1));
    }
    search.values = vec![Value::Open; search.nodes.len()];
    search.readers = vec![Vec::new(); search.nodes.len()];
    for place in 0..search.nodes.len() {
        for lit in search.inputs(search.nodes[place]).iter() {
            if let Some(input) = search.places.get(&(lit >> 1)) {
                search.readers[*input].push(place);
            }
        }
    }
    wanted.iter().all(|lit| search.set(*lit, true)) && search.equals() && search.goes()
}

impl Search<'_> {
    fn inputs(&self, node: u32) -> Inputs {
        match self.graph.nodes[node as usize] {
            Node::And(a, b) => Inputs { lits: [a, b, 0], count: 2 },
            Node::Sum(place) | Node::Carry(place) => {
                Inputs { lits: self.graph.carries[place as usize].inputs, count: 3 }
            }
            Node::Leaf | Node::Register(_) | Node::Memory(_) => Inputs { lits: [0; 3], count: 0 },
        }
    }

    fn value(&self, lit: Lit) -> Value {
        let inverted = lit & 1 == 1;
        match self.places.get(&(lit >> 1)) {
            None => Value::Known(inverted),
            Some(place) => match self.values[*place] {
                Value::Known(value) => Value::Known(value != inverted),
                Value::Open => Value::Open,
            },
        }
    }

    /// Sets a literal, and all that follows; false where that contradicts.
    fn set(&mut self, lit: Lit, value: bool) -> bool {
        let mut queue = vec![(lit, value)];
        while let Some((lit, value)) = queue.pop() {
            match self.value(lit) {
                Value::Known(known) if known == value => continue,
                Value::Known(_) => return false,
                Value::Open => {}
            }
            let Some(place) = self.places.get(&(lit >> 1)).copied() else { return false };
            self.values[place] = Value::Known(value != (lit & 1 == 1));
            self.trail.push(place);
            let around: Vec<usize> = self.readers[place].iter().copied().chain([place]).collect();
            for place in around {
                if !self.follow(place, &mut queue) {
                    return false;
                }
            }
        }
        true
    }

    /// Sets what follows from the pairs.
    fn equals(&mut self) -> bool {
        loop {
            let before = self.trail.len();
            for place in 0..self.equal.len() {
                let (a, b) = self.equal[place];
                let fits = match (self.value(a), self.value(b)) {
                    (Value::Known(a), Value::Known(b)) => a == b,
                    (Value::Known(value), Value::Open) => self.set(b, value),
                    (Value::Open, Value::Known(value)) => self.set(a, value),
                    (Value::Open, Value::Open) => a != b ^ 1,
                };
                if !fits {
                    return false;
                }
            }
            if self.trail.len() == before {
                return true;
            }
        }
    }

    /// What follows at a node from what is known of it and its inputs.
    fn follow(&self, place: usize, queue: &mut Vec<(Lit, bool)>) -> bool {
        let node = self.nodes[place];
        let inputs = self.inputs(node);
        if inputs.count == 0 {
            return true;
        }
        let function: fn(u32) -> bool = match self.graph.nodes[node as usize] {
            Node::And(..) => |bits| bits == 3,
            Node::Sum(_) => |bits| bits.count_ones() % 2 == 1,
            _ => |bits| bits.count_ones() >= 2,
        };
        // Over all ways to complete it: for each pin which values it takes.
        let count = inputs.count;
        let mut seen = [[false; 2]; 4];
        let values = inputs.lits.map(|lit| self.value(lit));
        for bits in 0..1u32 << count {
            let fits = |at: usize| match values[at] {
                Value::Known(value) => value == (bits >> at & 1 == 1),
                Value::Open => true,
            };
            let out = function(bits);
            let out_fits = match self.values[place] {
                Value::Known(value) => value == out,
                Value::Open => true,
            };
            if !out_fits || !(0..count).all(fits) {
                continue;
            }
            for (at, seen) in seen.iter_mut().enumerate().take(count) {
                seen[(bits >> at & 1) as usize] = true;
            }
            seen[count][usize::from(out)] = true;
        }
        for (at, seen) in seen.iter().enumerate().take(count + 1) {
            let lit = if at < count { inputs.lits[at] } else { node * 2 };
            match seen {
                [false, false] => return false,
                [true, true] => {}
                [_, true] if self.value(lit) == Value::Open => queue.push((lit, true)),
                [true, _] if self.value(lit) == Value::Open => queue.push((lit, false)),
                _ => {}
            }
        }
        true
    }

    /// Tries all values of what is open.
    fn goes(&mut self) -> bool {
        let Some(open) = (0..self.nodes.len()).find(|place| self.values[*place] == Value::Open) else {
            return true;
        };
        if self.budget == 0 {
            return true;
        }
        self.budget -= 1;
        let before = self.trail.len();
        for value in [false, true] {
            if self.set(self.nodes[open] * 2, value) && self.equals() && self.goes() {
                return true;
            }
            for place in self.trail.drain(before..) {
                self.values[place] = Value::Open;
            }
        }
        false
    }
}
