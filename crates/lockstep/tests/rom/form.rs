//! What a register holds, as a sum of numbers that are not known.

use std::collections::BTreeMap;

/// A number that is not known, but is the same in both runs.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Atom {
    /// A or W in front of the flipped word.
    A,
    W,
    /// A before the step of the word before that.
    Before,
    /// A or W of a row, in the clock of this number; 2 is all from the third on.
    RowA(u8, u8),
    RowW(u8, u8),
    /// A vertex's word: place, part, and how often the order has changed.
    Vertex(u8, u8, u32),
    /// The row of the digits in this clock, of four rows.
    Digits(u32, Vec<Form>),
    /// The number without its low t bits.
    Masked(Form),
    /// The low bits of the number, signed.
    Low(Form),
    /// A row's A, so far up as the round of this number has it, and the row's W.
    Raised(u32, Form, Form),
    /// Something else, of one run alone.
    Unknown(u32),
}

/// A sum of atoms, each so many times, and a constant.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Form {
    pub atoms: BTreeMap<Atom, i128>,
    pub constant: i128,
}

impl Form {
    pub fn of(atom: Atom) -> Form {
        Form { atoms: [(atom, 1)].into(), constant: 0 }
    }

    pub fn constant(constant: i128) -> Form {
        Form { constant, ..Form::default() }
    }

    /// The number, if it is known.
    pub fn number(&self) -> Option<i128> {
        self.atoms.is_empty().then_some(self.constant)
    }

    /// The atom, its count, and the constant, if it has one atom alone.
    pub fn single(&self) -> Option<(&Atom, i128, i128)> {
        let mut atoms = self.atoms.iter();
        let (atom, count) = atoms.next()?;
        atoms.next().is_none().then_some((atom, *count, self.constant))
    }

    pub fn is_zero(&self) -> bool {
        self.number() == Some(0)
    }

    pub fn plus(&self, other: &Form, times: i128) -> Form {
        let mut sum = self.clone();
        sum.constant = sum.constant.wrapping_add(other.constant.wrapping_mul(times));
        for (atom, count) in &other.atoms {
            let all = sum.atoms.entry(atom.clone()).or_default();
            *all = all.wrapping_add(count.wrapping_mul(times));
            if *all == 0 {
                sum.atoms.remove(atom);
            }
        }
        sum
    }

    pub fn twice(&self) -> Form {
        self.plus(self, 1)
    }

    /// Every bit the other way: the sign is the other one.
    pub fn complement(&self) -> Form {
        Form::constant(-1).plus(self, -1)
    }
}
