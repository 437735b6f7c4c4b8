//! Comparisons, as Yosys' `alumacc` maps them: by the carry of a difference, which others of the same operands share.

use super::arithmetic::{Chain, Differences, extended};
use super::graph::{FALSE, Graph, Lit, TRUE};

/// A relation that a carry chain decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Relation {
    /// The same with the operands in the other order.
    fn turned(self) -> Relation {
        match self {
            Relation::Less => Relation::Greater,
            Relation::LessOrEqual => Relation::GreaterOrEqual,
            Relation::Greater => Relation::Less,
            Relation::GreaterOrEqual => Relation::LessOrEqual,
        }
    }
}

/// An operand of a comparison, cut to the bits that tell something.
#[derive(Clone, Debug)]
pub(super) struct Operand {
    pub word: Vec<Lit>,
    /// Parts of words that it is put together from.
    pub pieces: usize,
}

impl Operand {
    /// Yosys' order of two words: the shorter comes first, then that of fewer pieces. Of words alike in both, the order
    /// follows from numbers that Yosys gives to names, and takes back when a name is gone; it is not known here.
    fn comes_before(&self, other: &Operand) -> bool {
        (self.word.len(), self.pieces) < (other.word.len(), other.pieces)
    }
}

impl Graph {
    /// A comparison.
    pub fn compare(
        &mut self,
        relation: Relation,
        [a, b]: [Operand; 2],
        signed: bool,
        differences: &mut Differences,
    ) -> Lit {
        if let Some(lit) = self.simple_comparison(relation, &a.word, &b.word, signed) {
            return lit;
        }
        let (mut less, equal) = match relation {
            Relation::Less => (true, false),
            Relation::LessOrEqual => (true, true),
            Relation::Greater => (false, false),
            Relation::GreaterOrEqual => (false, true),
        };
        let known = a.comes_before(&b) || b.comes_before(&a);
        let (mut a, mut b) = match b.comes_before(&a) {
            true => {
                less = !less;
                (b.word, a.word)
            }
            false => (a.word, b.word),
        };
        let width = a.len().max(b.len());
        let shared = |chain: &&Chain| chain.signed == signed;
        let mut found = differences.0.get(&(a.clone(), b.clone())).filter(shared).cloned();
        if found.is_none() && !known {
            found = differences.0.get(&(b.clone(), a.clone())).filter(shared).cloned();
            if found.is_some() {
                less = !less;
                std::mem::swap(&mut a, &mut b);
            }
        }
        let chain = found.unwrap_or_else(|| {
            let (sum, carry) = self.alu(&a, &b, signed, true, TRUE, width);
            let chain = Chain { signed, sum, carry };
            differences.0.insert((a.clone(), b.clone()), chain.clone());
            chain
        });
        let top = chain.sum.len() - 1;
        let lower = if signed {
            let before = if top == 0 { TRUE } else { chain.carry[top - 1] };
            let overflow = self.xor(chain.carry[top], before);
            self.xor(overflow, chain.sum[top])
        } else {
            chain.carry[top] ^ 1
        };
        if less && !equal {
            return lower;
        }
        let same = self.equal(&extended(&a, width, signed), &extended(&b, width, signed));
        let first = if less { lower } else { self.or(lower, same) ^ 1 };
        if equal { self.or(first, same) } else { first }
    }

    /// Comparisons with constants that Yosys does without a chain.
    fn simple_comparison(&mut self, relation: Relation, a: &[Lit], b: &[Lit], signed: bool) -> Option<Lit> {
        let fixed = |word: &[Lit]| word.iter().all(|lit| *lit <= TRUE);
        let (word, constant, relation) = match (fixed(a), fixed(b)) {
            (_, true) => (a, b, relation),
            (true, false) => (b, a, relation.turned()),
            _ => return None,
        };
        if word.len().max(constant.len()) > 4 && !fixed(word) {
            return None;
        }
        // A look-up table, or known: by the bits from the top.
        let width = word.len().max(constant.len());
        let (mut word, mut constant) = (extended(word, width, signed), extended(constant, width, signed));
        if signed {
            word[width - 1] ^= 1;
            constant[width - 1] ^= 1;
        }
        let (mut below, mut same) = (FALSE, TRUE);
        for (bit, limit) in word.iter().zip(&constant).rev() {
            if *limit == TRUE {
                let here = self.and(same, bit ^ 1);
                below = self.or(below, here);
                same = self.and(same, *bit);
            } else {
                same = self.and(same, bit ^ 1);
            }
        }
        let not_above = self.or(below, same);
        Some(match relation {
            Relation::Less => below,
            Relation::LessOrEqual => not_above,
            Relation::Greater => not_above ^ 1,
            Relation::GreaterOrEqual => below ^ 1,
        })
    }
}
