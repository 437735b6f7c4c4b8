//! Sums, differences, comparisons and products, as Yosys' `wreduce`, `alumacc`, `maccmap` and `ice40_opt` map them:
//! operands are cut to the bits that tell something, sums of sums become one sum, and two operands a carry chain.

use super::graph::{CarryBit, FALSE, Graph, Lit, Node, QuickMap, TRUE};

/// A summand: a word, or the product of two.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub a: Vec<Lit>,
    /// The other factor of a product.
    pub b: Option<Vec<Lit>>,
    pub signed: bool,
    pub subtract: bool,
}

/// A carry chain: the sum, and the carry out of each bit.
#[derive(Clone, Debug)]
struct Chain {
    signed: bool,
    sum: Vec<Lit>,
    carry: Vec<Lit>,
}

/// Differences by their operands, to be shared by comparisons of the same.
#[derive(Default)]
pub(super) struct Differences(QuickMap<(Vec<Lit>, Vec<Lit>), Chain>);

/// A relation that a carry chain decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

fn extended(word: &[Lit], width: usize, signed: bool) -> Vec<Lit> {
    let fill = if signed { word.last().copied().unwrap_or(FALSE) } else { FALSE };
    (0..width).map(|bit| word.get(bit).copied().unwrap_or(fill)).collect()
}

/// The operands of a sum or difference of `width` bits without the zeros on top, and how many bits are computed.
pub(super) fn reduced(a: &[Lit], b: &[Lit], width: usize) -> (Vec<Lit>, Vec<Lit>, usize) {
    let cut = |word: &[Lit]| {
        let size = word[..width].iter().rposition(|lit| *lit != FALSE).map_or(1, |top| top + 1);
        word[..size].to_vec()
    };
    let (a, b) = (cut(a), cut(b));
    let computed = width.min(a.len().max(b.len()) + 1);
    (a, b, computed)
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

/// Whether a sum of these may not fit `width` bits, or be of another sign.
pub(super) fn may_overflow(terms: &[Term], width: usize, signed: bool) -> bool {
    let mut largest = 0f64;
    for term in terms {
        if term.signed != signed || (!term.signed && term.subtract) {
            return true;
        }
        let bits = term.a.len() + term.b.as_ref().map_or(0, Vec::len);
        largest += (bits as f64).exp2() - 1.0;
    }
    largest > (width as f64).exp2() - 1.0
}

impl Graph {
    /// a + b + carry on a chain; up to two bits are look-up tables.
    fn chain(&mut self, a: &[Lit], b: &[Lit], carry: Lit) -> (Vec<Lit>, Vec<Lit>) {
        let (mut sums, mut carries) = (Vec::new(), Vec::new());
        let mut carry = carry;
        for (a, b) in a.iter().zip(b) {
            let inputs = [*a, *b, carry];
            let of = |value| inputs.iter().filter(|lit| **lit == value).count();
            let (zeros, ones) = (of(FALSE), of(TRUE));
            let other = inputs.iter().copied().find(|lit| *lit > TRUE);
            let short = match other {
                _ if zeros >= 2 => Some(FALSE),
                _ if ones >= 2 => Some(TRUE),
                Some(other) if zeros + ones == 2 => Some(other),
                _ => None,
            };
            match short {
                Some(out) => {
                    let half = self.xor(*a, *b);
                    sums.push(self.xor(half, carry));
                    carry = out;
                }
                None => {
                    let place = self.carries.len() as u32;
                    self.carries.push(CarryBit { inputs });
                    sums.push(self.node(Node::Sum(place)));
                    carry = self.node(Node::Carry(place));
                }
            }
            carries.push(carry);
        }
        (sums, carries)
    }

    fn ripple(&mut self, a: &[Lit], b: &[Lit], carry: Lit) -> (Vec<Lit>, Vec<Lit>) {
        let (mut sums, mut carries) = (Vec::new(), Vec::new());
        let mut carry = carry;
        for (a, b) in a.iter().zip(b) {
            let (sum, out) = self.full_adder(*a, *b, carry);
            sums.push(sum);
            carry = out;
            carries.push(out);
        }
        (sums, carries)
    }

    /// Sum and carries of `width` bits: an `$alu` of Yosys.
    fn alu(
        &mut self,
        a: &[Lit],
        b: &[Lit],
        signed: bool,
        invert: bool,
        carry: Lit,
        width: usize,
    ) -> (Vec<Lit>, Vec<Lit>) {
        let a = extended(a, width, signed);
        let b: Vec<Lit> = extended(b, width, signed).iter().map(|lit| lit ^ Lit::from(invert)).collect();
        if width <= 2 { self.ripple(&a, &b, carry) } else { self.chain(&a, &b, carry) }
    }

    /// A sum of terms, `width` bits.
    pub fn sum(&mut self, terms: &[Term], width: usize, differences: &mut Differences) -> Vec<Lit> {
        match two_operands(terms, width) {
            Some((a, b, signed, subtract, carry)) => {
                let key = (a.clone(), b.clone());
                let same = |chain: &&Chain| chain.sum.len() == width && chain.signed == signed;
                if subtract
                    && carry == TRUE
                    && let Some(chain) = differences.0.get(&key).filter(same)
                {
                    return chain.sum.clone();
                }
                let (sum, carries) = self.alu(&a, &b, signed, subtract, carry, width);
                if subtract && carry == TRUE {
                    let chain = Chain { signed, sum: sum.clone(), carry: carries };
                    differences.0.insert(key, chain);
                }
                sum
            }
            None => self.tree(terms, width),
        }
    }

    /// A sum of many terms: full adders down to two words, and a chain.
    fn tree(&mut self, terms: &[Term], width: usize) -> Vec<Lit> {
        let mut columns = vec![Vec::new(); width];
        let single = |term: &&Term| term.a.len() == 1 && term.b.is_none() && !term.signed && !term.subtract;
        for term in terms.iter().filter(|term| !single(term)) {
            match &term.b {
                None => add(&mut columns, &extended(&term.a, width, term.signed), term.subtract),
                Some(b) => self.products(&mut columns, &term.a, b, term),
            }
        }
        for term in terms.iter().filter(single) {
            add_bit(&mut columns, term.a[0], 0);
        }
        let (mut rows, mut spare) = rows_of(columns);
        while rows.len() > 2 {
            let mut next = Vec::new();
            for group in rows.chunks(3) {
                if let [one, two, three] = group {
                    let (mut sums, mut carries) = (Vec::new(), vec![spare.pop().unwrap_or(FALSE)]);
                    for bit in 0..width {
                        let (sum, carry) = self.full_adder(one[bit], two[bit], three[bit]);
                        sums.push(sum);
                        carries.push(carry);
                    }
                    carries.truncate(width);
                    next.extend([sums, carries]);
                } else {
                    next.extend(group.iter().cloned());
                }
            }
            rows = next;
        }
        match &rows[..] {
            [] => vec![FALSE; width],
            [one] => one.clone(),
            [one, two, ..] => self.alu(one, two, false, false, spare.pop().unwrap_or(FALSE), width).0,
        }
    }

    /// A row for each bit of the shorter factor. `maccmap` does not see which bits of a row are 0.
    fn products(&mut self, columns: &mut [Column], a: &[Lit], b: &[Lit], term: &Term) {
        let width = columns.len();
        let (a, b) = if a.len() < b.len() { (b, a) } else { (a, b) };
        let a = extended(a, width, term.signed);
        let b = if b.len() > width { &b[..width] } else { b };
        for (shift, bit) in b.iter().enumerate() {
            let last = term.signed && shift + 1 == b.len();
            if term.subtract {
                add_bit(columns, TRUE, 0);
            }
            for (at, column) in columns.iter_mut().enumerate() {
                let product = match at.checked_sub(shift) {
                    None => FALSE,
                    Some(from) => self.and(a[from] ^ Lit::from(last), *bit),
                };
                column.push(Entry { order: MADE, lit: product ^ Lit::from(term.subtract) });
            }
            if last {
                let one: Vec<Lit> = (0..width).map(|at| if at == shift { *bit } else { FALSE }).collect();
                add(columns, &one, term.subtract);
            }
        }
    }

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

    pub fn equal(&mut self, a: &[Lit], b: &[Lit]) -> Lit {
        let same: Vec<Lit> = a.iter().zip(b).map(|(a, b)| self.xor(*a, *b) ^ 1).collect();
        self.all(&same)
    }
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

/// The operands of a sum that a chain can do: both, whether signed, whether the second is subtracted, and the carry in.
fn two_operands(terms: &[Term], width: usize) -> Option<(Vec<Lit>, Vec<Lit>, bool, bool, Lit)> {
    let (mut a, mut b, mut carries) = (Vec::new(), Vec::new(), Vec::new());
    let (mut a_signed, mut b_signed, mut subtract) = (false, false, false);
    for term in terms {
        if term.b.is_some() {
            return None;
        } else if term.a.len() == 1 && !term.signed && !term.subtract {
            carries.push(term.a[0]);
        } else if !a.is_empty() || term.subtract {
            if !b.is_empty() {
                return None;
            }
            (b, b_signed, subtract) = (term.a.clone(), term.signed, term.subtract);
        } else {
            (a, a_signed) = (term.a.clone(), term.signed);
        }
    }
    if !a_signed || !b_signed {
        a_signed &= a.len() != width;
        b_signed &= b.len() != width;
        if a_signed != b_signed {
            return None;
        }
    }
    for word in [&mut a, &mut b] {
        if word.is_empty() && !carries.is_empty() {
            word.push(carries.remove(0));
        }
    }
    if subtract {
        carries.push(TRUE);
    }
    if carries.len() > 1 {
        return None;
    }
    if !subtract && b < a && !b.is_empty() {
        std::mem::swap(&mut a, &mut b);
    }
    Some((a, b, a_signed, subtract, carries.first().copied().unwrap_or(FALSE)))
}

/// A bit of a column, and when its turn comes: constants, then signals of the design, then what `maccmap` made.
#[derive(Clone, Copy)]
struct Entry {
    order: u8,
    lit: Lit,
}

type Column = Vec<Entry>;

const CONSTANT: u8 = 0;
const SIGNAL: u8 = 1;
const MADE: u8 = 2;

fn add(columns: &mut [Column], word: &[Lit], subtract: bool) {
    if !subtract {
        word.iter().enumerate().for_each(|(at, bit)| add_bit(columns, *bit, at));
        return;
    }
    add_bit(columns, TRUE, 0);
    for (at, bit) in word.iter().enumerate() {
        // The inverter's output is a signal of its own, even of a constant.
        columns[at].push(Entry { order: MADE, lit: bit ^ 1 });
    }
}

/// A bit twice in a column is once in the next.
fn add_bit(columns: &mut [Column], bit: Lit, at: usize) {
    if at >= columns.len() || bit == FALSE {
        return;
    }
    let order = if bit == TRUE { CONSTANT } else { SIGNAL };
    match columns[at].iter().position(|known| (known.order, known.lit) == (order, bit)) {
        Some(place) => {
            columns[at].remove(place);
            add_bit(columns, bit, at + 1);
        }
        None => columns[at].push(Entry { order, lit: bit }),
    }
}

/// The bit whose turn it is; no bit is 0.
fn next(column: &mut Column) -> Lit {
    let first = (0..column.len()).min_by_key(|place| column[*place].order);
    first.map_or(FALSE, |place| column.remove(place).lit)
}

/// Words of a bit a column, and the bits that the carries' free places at the bottom of the tree take.
fn rows_of(mut columns: Vec<Column>) -> (Vec<Vec<Lit>>, Vec<Lit>) {
    /// Columns from which bits go to such places: a bit of column n takes 2^n of them.
    const LOWEST: usize = 4;
    let (mut rows, mut spare): (Vec<Vec<Lit>>, Vec<Lit>) = (Vec::new(), Vec::new());
    while columns.iter().any(|column| !column.is_empty()) {
        rows.push(columns.iter_mut().map(next).collect());
        loop {
            let deepest = columns.iter().map(Vec::len).max().unwrap_or(0);
            let last = columns.iter().rposition(|column| column.len() == deepest).unwrap_or(0);
            if deepest == 0 || last > LOWEST {
                break;
            }
            let full: Vec<usize> = (0..=last).filter(|at| columns[*at].len() == deepest).collect();
            let wanted: usize = full.iter().map(|at| 1 << at).sum();
            if wanted + spare.len() > rows.len() - 1 {
                break;
            }
            for at in full {
                let bit = next(&mut columns[at]);
                spare.extend(std::iter::repeat_n(bit, 1 << at));
            }
        }
    }
    (rows, spare)
}
