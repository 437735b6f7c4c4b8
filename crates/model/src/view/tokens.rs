//! Tokens, each kept once: registers and queues hold their numbers.

use super::structure::{Field, Shape};
use std::collections::HashMap;

/// A kind of token, and every one of it that was met.
#[derive(Clone, Debug)]
pub struct Kind {
    /// Name of the kind.
    pub name: String,
    /// What a table of them is called.
    pub title: String,
    /// Fields of the tokens.
    pub fields: Vec<Field>,
    /// Number k + 1: its triangle, then its fields.
    pub met: Vec<Vec<u64>>,
    numbers: HashMap<Vec<u64>, u64>,
    /// The least and greatest value of each field, where tokens themselves are not kept.
    ranges: Vec<Option<[i64; 2]>>,
}

/// All tokens by kind.
#[derive(Clone, Debug, Default)]
pub struct Tokens {
    kinds: Vec<Kind>,
    only_ranges: bool,
}

impl Kind {
    /// The least and greatest value of each field, where the tokens themselves are not kept.
    pub(crate) fn ranges(&self) -> impl Iterator<Item = (&Field, [i64; 2])> {
        self.fields.iter().zip(&self.ranges).filter_map(|(field, range)| Some((field, (*range)?)))
    }
}

impl Tokens {
    /// Keeps no token, but the least and greatest value of each field.
    pub(super) fn of_ranges() -> Tokens {
        Tokens { only_ranges: true, ..Tokens::default() }
    }

    /// The kinds.
    #[must_use]
    pub fn kinds(&self) -> &[Kind] {
        &self.kinds
    }

    pub(super) fn declare(&mut self, name: &str, title: &str, fields: impl FnOnce() -> Vec<Field>) {
        if self.kinds.iter().all(|kind| kind.name != name) {
            let (name, title) = (name.to_owned(), title.to_owned());
            let fields = fields();
            let ranges = vec![None; fields.len()];
            self.kinds.push(Kind { name, title, fields, met: Vec::new(), numbers: HashMap::new(), ranges });
        }
    }

    /// The place of a kind.
    pub(super) fn place(&self, name: &str) -> usize {
        self.kinds.iter().position(|kind| kind.name == name).expect("units declare the kinds they show")
    }

    /// The number of a token; 0: none. `of_map`: its pixel is one of the map.
    pub(super) fn number(&mut self, kind: &str, token: Option<(u32, &[u64])>, of_map: bool) -> u64 {
        let Some((triangle, values)) = token else { return 0 };
        let place = self.place(kind);
        let kind = &mut self.kinds[place];
        if self.only_ranges {
            for ((range, field), value) in kind.ranges.iter_mut().zip(&kind.fields).zip(values) {
                let value = field.shape.value(*value);
                let [least, greatest] = range.unwrap_or([value; 2]);
                *range = Some([least.min(value), greatest.max(value)]);
            }
            return 0;
        }
        let in_map =
            |shape| if let Shape::Pixel { bits, .. } = shape { u64::from(of_map) << bits } else { 0 };
        let values_of_page =
            values.iter().zip(&kind.fields).map(|(value, field)| value | in_map(field.shape));
        let token: Vec<u64> = std::iter::once(u64::from(triangle)).chain(values_of_page).collect();
        debug_assert_eq!(values.len(), kind.fields.len(), "{}", kind.name);
        let next = kind.met.len() as u64 + 1;
        let number = *kind.numbers.entry(token.clone()).or_insert(next);
        if number == next {
            kind.met.push(token);
        }
        number
    }
}
