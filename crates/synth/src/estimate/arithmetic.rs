//! Sums, differences and products, as Yosys' `wreduce`, `alumacc`, `maccmap` and `ice40_opt` map them:
//! operands are cut to the bits that tell something, sums of sums become one sum, and two operands a carry chain.

use super::family::Family;
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
pub(super) struct Chain {
    pub signed: bool,
    pub sum: Vec<Lit>,
    pub carry: Vec<Lit>,
}

/// Differences by their operands, to be shared by comparisons of the same.
#[derive(Default)]
pub(super) struct Differences(pub QuickMap<(Vec<Lit>, Vec<Lit>), Chain>);

pub(super) fn extended(word: &[Lit], width: usize, signed: bool) -> Vec<Lit> {
    let fill = if signed { word.last().copied().unwrap_or(FALSE) } else { FALSE };
    (0..width).map(|bit| word.get(bit).copied().unwrap_or(fill)).collect()
}

/// How many of the lowest bits need no chain, as one of the two words hands the carry on there: a 0, or of what is
/// subtracted from a 1 (`opt_expr -fine`). A chain of an iCE40 leaves such bits out by itself.
fn low_zeros(a: &[Lit], b: &[Lit], subtract: bool, carry: Lit) -> usize {
    if carry != Lit::from(subtract) {
        return 0;
    }
    a.iter().zip(b).take_while(|(a, b)| **b == FALSE || **a == carry).count()
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
    /// a + b + carry on a chain of an iCE40. A step with two constants needs no cell.
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
                    self.carries.push(CarryBit { inputs, cell: place });
                    sums.push(self.node(Node::Sum(place)));
                    carry = self.node(Node::Carry(place));
                }
            }
            carries.push(carry);
        }
        (sums, carries)
    }

    /// a + b + carry on a chain of an ECP5, a cell for two bits. The carry between the two is no output of the cell. Who
    /// reads it gets it from look-up tables.
    fn chain_of_pairs(&mut self, a: &[Lit], b: &[Lit], carry: Lit) -> (Vec<Lit>, Vec<Lit>) {
        let (mut sums, mut carries) = (Vec::new(), Vec::new());
        let (mut carry, mut cell) = (carry, 0);
        for (at, (a, b)) in a.iter().zip(b).enumerate() {
            let place = self.carries.len() as u32;
            let upper = at % 2 == 1;
            cell = if upper { cell } else { place };
            self.carries.push(CarryBit { inputs: [*a, *b, carry], cell });
            sums.push(self.node(Node::Sum(place)));
            let out = self.node(Node::Carry(place));
            carries.push(if upper {
                out
            } else {
                let (both, either) = (self.and(*a, *b), self.or(*a, *b));
                let through = self.and(carry, either);
                self.or(both, through)
            });
            carry = out;
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
    pub(super) fn alu(
        &mut self,
        a: &[Lit],
        b: &[Lit],
        signed: bool,
        invert: bool,
        carry: Lit,
        width: usize,
    ) -> (Vec<Lit>, Vec<Lit>) {
        let low = if self.family == Family::Ecp5 { low_zeros(a, b, invert, carry).min(width) } else { 0 };
        let a = extended(a, width, signed);
        let b: Vec<Lit> = extended(b, width, signed).iter().map(|lit| lit ^ Lit::from(invert)).collect();
        // They give a bit of the other word, and the carry goes on as it is.
        let handed = (0..low).map(|at| if b[at] == carry { a[at] } else { b[at] });
        let (mut sums, mut carries): (Vec<Lit>, Vec<Lit>) = (handed.collect(), vec![carry; low]);
        let (a, b) = (&a[low..], &b[low..]);
        let (sum, out) = match self.family {
            family if a.len() <= family.short_sum() => self.ripple(a, b, carry),
            Family::Ice40 => self.chain(a, b, carry),
            Family::Ecp5 | Family::Gates => self.chain_of_pairs(a, b, carry),
        };
        sums.extend(sum);
        carries.extend(out);
        (sums, carries)
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

    pub fn equal(&mut self, a: &[Lit], b: &[Lit]) -> Lit {
        let same: Vec<Lit> = a.iter().zip(b).map(|(a, b)| self.xor(*a, *b) ^ 1).collect();
        self.all(&same)
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
