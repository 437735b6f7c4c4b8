//! Operators as Yosys' `techmap` does them, and sums with the sums that they are made of.

use super::arithmetic::{Term, may_overflow, reduced};
use super::builder::{BlockMemory, Builder, Kind};
use super::comparison::{Operand, Relation};
use super::family::Family;
use super::graph::{FALSE, Graph, Lit, Node, TRUE};
use super::words::{Cell, ONE};
use edgewalk_netlist::ops::Op;

/// Bits of a factor of a multiplier.
const MULTIPLIER: usize = 18;

impl Builder<'_> {
    pub fn cell(&mut self, cell: &Cell) {
        if let Some(lit) = self.state_compared(cell) {
            self.lits[cell.first as usize] = lit;
            return;
        }
        let operands: Vec<Vec<Lit>> = cell.operands.iter().map(|place| self.word(place)).collect();
        let result = self.result(cell, &operands);
        for (at, lit) in result.into_iter().enumerate() {
            self.lits[cell.first as usize + at] = lit;
        }
    }

    /// A state machine's register beside a constant is that state's flip-flop.
    fn state_compared(&self, cell: &Cell) -> Option<Lit> {
        if !matches!(cell.op, Op::Eq | Op::Ne) {
            return None;
        }
        let [a, b] = [0, 1].map(|operand| self.words.at(&cell.operands[operand]));
        let (states, constant) = match (self.states.get(&a[0]), self.states.get(&b[0])) {
            (Some(states), _) => (states, b),
            (None, Some(states)) => (states, a),
            (None, None) => return None,
        };
        let value = constant.iter().rev().fold(0, |value, bit| value << 1 | u128::from(*bit == ONE));
        let is = states.iter().find(|(state, _)| *state == value).map_or(FALSE, |(_, lit)| *lit);
        Some(is ^ Lit::from(cell.op == Op::Ne))
    }

    fn result(&mut self, cell: &Cell, operands: &[Vec<Lit>]) -> Vec<Lit> {
        let graph = &mut self.graph;
        let bits = |graph: &mut Graph, of: fn(&mut Graph, Lit, Lit) -> Lit| -> Vec<Lit> {
            operands[0].iter().zip(&operands[1]).map(|(a, b)| of(graph, *a, *b)).collect()
        };
        let relation = |op| match op {
            Op::Lt | Op::LtSigned => Relation::Less,
            Op::Le | Op::LeSigned => Relation::LessOrEqual,
            Op::Gt | Op::GtSigned => Relation::Greater,
            _ => Relation::GreaterOrEqual,
        };
        match cell.op {
            Op::And => bits(graph, Graph::and),
            Op::Or => bits(graph, Graph::or),
            Op::Xor => bits(graph, Graph::xor),
            Op::Not => operands[0].iter().map(|lit| lit ^ 1).collect(),
            Op::Mux => {
                let choose = |(t, e): (&Lit, &Lit)| graph.mux(operands[0][0], *t, *e);
                operands[1].iter().zip(&operands[2]).map(choose).collect()
            }
            Op::Eq => vec![graph.equal(&operands[0], &operands[1])],
            Op::Ne => vec![graph.equal(&operands[0], &operands[1]) ^ 1],
            Op::Any => vec![graph.any(&operands[0])],
            Op::All => vec![graph.all(&operands[0])],
            Op::Parity => vec![graph.parity(&operands[0])],
            Op::Lt | Op::Le | Op::Gt | Op::Ge => vec![self.compare(cell, relation(cell.op), operands, false)],
            Op::LtSigned | Op::LeSigned | Op::GtSigned | Op::GeSigned => {
                vec![self.compare(cell, relation(cell.op), operands, true)]
            }
            Op::ShlBy => self.shifted(&operands[0], &operands[1], FALSE, true),
            Op::ShrBy => self.shifted(&operands[0], &operands[1], FALSE, false),
            Op::SarBy => self.shifted(&operands[0], &operands[1], operands[0][cell.width - 1], false),
            Op::Add | Op::Sub | Op::Neg | Op::Mul | Op::MulSigned => self.sum(cell, operands),
            // Wiring, which no cell does.
            Op::Shl(_)
            | Op::Shr(_)
            | Op::Sar(_)
            | Op::Slice { .. }
            | Op::ZeroExtend(_)
            | Op::SignExtend(_)
            | Op::Concat => operands[0].clone(),
        }
    }

    fn compare(&mut self, cell: &Cell, relation: Relation, words: &[Vec<Lit>], signed: bool) -> Lit {
        let operands = [0, 1].map(|at| self.operand(cell, at, &words[at], signed));
        self.graph.compare(relation, operands, signed, &mut self.differences)
    }

    /// An operand as `wreduce` leaves it. That looks at the cells of a unit in the machine from the last to the first. So
    /// a comparison is looked at before the choice in front of it loses the bits that are constant on top.
    fn operand(&self, cell: &Cell, at: usize, word: &[Lit], signed: bool) -> Operand {
        let bits = self.words.at(&cell.operands[at]);
        let late = |at: usize| cell.backwards && self.words.chosen[bits[at] as usize];
        let constant = |at: usize| word[at] <= TRUE && !late(at);
        let one_signal = |at: usize| word[at] > TRUE && !self.words.bitwise[bits[at] as usize];
        let same = |a: usize, b: usize| {
            let both = (constant(a) && constant(b)) || (one_signal(a) && one_signal(b));
            bits[a] == bits[b] || (word[a] == word[b] && both)
        };
        let mut size = word.len();
        while size > 1
            && if signed { same(size - 1, size - 2) } else { word[size - 1] == FALSE && constant(size - 1) }
        {
            size -= 1;
        }
        let ends = |at: usize| match (word[at - 1] <= TRUE, word[at] <= TRUE) {
            (false, false) => bits[at] != bits[at - 1] + 1,
            (before, here) => before != here,
        };
        Operand { word: word[..size].to_vec(), pieces: (1..size).filter(|at| ends(*at)).count() }
    }

    /// Stages of choices, one for each bit of the distance.
    fn shifted(&mut self, word: &[Lit], by: &[Lit], fill: Lit, left: bool) -> Vec<Lit> {
        let mut word = word.to_vec();
        for (stage, by) in by.iter().enumerate() {
            let distance = 1usize.checked_shl(stage as u32).unwrap_or(usize::MAX);
            word = (0..word.len())
                .map(|at| {
                    let from = if left { at.checked_sub(distance) } else { at.checked_add(distance) };
                    let moved = from.and_then(|from| word.get(from)).copied().unwrap_or(fill);
                    self.graph.mux(*by, moved, word[at])
                })
                .collect();
        }
        word
    }

    /// A product of an ECP5: multipliers of 18 by 18 bits, and sums of what they give. None where a factor is a single
    /// bit, or on another family.
    fn multiplied(&mut self, cell: &Cell, operands: &[Vec<Lit>]) -> Option<Vec<Lit>> {
        let is_product = matches!(cell.op, Op::Mul | Op::MulSigned) && self.words.family == Family::Ecp5;
        let (terms, width, _) = is_product.then(|| self.terms(cell, operands, cell.width))?;
        let (a, b) = (&terms[0].a, terms[0].b.as_ref()?);
        if a.len() < 2 || b.len() < 2 {
            return None;
        }
        let mut sum: Option<Vec<Lit>> = None;
        for (above_a, a) in a.chunks(MULTIPLIER).enumerate() {
            for (above_b, b) in b.chunks(MULTIPLIER).enumerate() {
                let place = self.memories.len() as u32;
                self.memories.push(BlockMemory {
                    kind: Kind::Product,
                    place: 0,
                    port: 0,
                    bits: Vec::new(),
                    blocks: 1,
                    inputs: a.iter().chain(b).copied().collect(),
                    reads: Vec::new(),
                    writes: Vec::new(),
                });
                let shift = (above_a + above_b) * MULTIPLIER;
                let bit = |at: usize| at >= shift && at < shift + a.len() + b.len();
                let word: Vec<Lit> = (0..width)
                    .map(|at| if bit(at) { self.graph.node(Node::Memory(place)) } else { FALSE })
                    .collect();
                sum = Some(match sum {
                    None => word,
                    Some(sum) => {
                        let low = sum[..shift.min(width)].to_vec();
                        let high = self.graph.alu(
                            &sum[low.len()..],
                            &word[low.len()..],
                            false,
                            false,
                            FALSE,
                            width - low.len(),
                        );
                        low.into_iter().chain(high.0).collect()
                    }
                });
            }
        }
        sum.map(|sum| (0..cell.width).map(|at| sum.get(at).copied().unwrap_or(FALSE)).collect())
    }

    fn sum(&mut self, cell: &Cell, operands: &[Vec<Lit>]) -> Vec<Lit> {
        if let Some(product) = self.multiplied(cell, operands) {
            return product;
        }
        let bits = cell.first as usize..cell.first as usize + cell.width;
        let used =
            self.words.users[bits.clone()].iter().rposition(|users| *users > 0).map_or(1, |top| top + 1);
        let (mut terms, width, signed) = self.terms(cell, operands, used);
        self.merge(&mut terms, cell, width);
        let lits = self.graph.sum(&terms, width, &mut self.differences);
        self.sums.insert(cell.first, (terms, width));
        let fill = if signed { lits[width - 1] } else { FALSE };
        (0..cell.width).map(|at| lits.get(at).copied().unwrap_or(fill)).collect()
    }

    /// What a cell adds, of how many bits the sum is, and whether bits above are its sign.
    fn terms(&self, cell: &Cell, operands: &[Vec<Lit>], used: usize) -> (Vec<Term>, usize, bool) {
        let term = |a: Vec<Lit>, signed, subtract| Term { a, b: None, signed, subtract };
        match cell.op {
            Op::Neg => {
                let mut a = operands[0][..used].to_vec();
                let size = a.iter().rposition(|lit| *lit != FALSE).map_or(1, |top| top + 1);
                a.truncate(size);
                (vec![term(a, false, true)], used, false)
            }
            Op::Mul | Op::MulSigned => {
                let signed = cell.op == Op::MulSigned;
                let cut = |word: &[Lit]| {
                    let mut word = word[..word.len().min(used)].to_vec();
                    while word.len() > 1
                        && word[word.len() - 1] == if signed { word[word.len() - 2] } else { FALSE }
                    {
                        word.pop();
                    }
                    word
                };
                let (a, b) = (cut(&operands[0]), cut(&operands[1]));
                let width = used.min(a.len() + b.len());
                (vec![Term { a, b: Some(b), signed, subtract: false }], width, signed)
            }
            _ => {
                let subtract = cell.op == Op::Sub;
                let (a, b, width) = reduced(&operands[0], &operands[1], used);
                (vec![term(a, false, false), term(b, false, subtract)], width, subtract)
            }
        }
    }

    /// Replaces a term by its own terms, if the term is a sum with no other reader.
    fn merge(&mut self, terms: &mut Vec<Term>, cell: &Cell, width: usize) {
        let mut at = 0;
        'terms: while at < terms.len() {
            let term = &terms[at];
            if term.b.is_none() {
                for place in &cell.operands {
                    let first = self.words.at(place)[0];
                    let Some((inner, size)) = self.sums.get(&first) else { continue };
                    let own: Vec<Lit> = (0..*size).map(|bit| self.lits[first as usize + bit]).collect();
                    let alone = (0..*size).all(|bit| self.words.users[first as usize + bit] <= 1);
                    if own != term.a || !alone || (*size != width && may_overflow(inner, *size, term.signed))
                    {
                        continue;
                    }
                    let subtract = term.subtract;
                    let mut inner = inner.clone();
                    inner.iter_mut().for_each(|term| term.subtract ^= subtract);
                    terms.splice(at..=at, inner);
                    continue 'terms;
                }
            }
            at += 1;
        }
    }
}
