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
}

/// All tokens by kind.
#[derive(Clone, Debug, Default)]
pub struct Tokens(Vec<Kind>);

impl Tokens {
    /// The kinds.
    #[must_use]
    pub fn kinds(&self) -> &[Kind] {
        &self.0
    }

    pub(super) fn declare(&mut self, name: &str, title: &str, fields: impl FnOnce() -> Vec<Field>) {
        if self.0.iter().all(|kind| kind.name != name) {
            let (name, title) = (name.to_owned(), title.to_owned());
            self.0.push(Kind { name, title, fields: fields(), met: Vec::new(), numbers: HashMap::new() });
        }
    }

    /// The place of a kind.
    pub(super) fn place(&self, name: &str) -> usize {
        self.0.iter().position(|kind| kind.name == name).expect("units declare the kinds they show")
    }

    /// The number of a token; 0: none. `of_map`: its pixel is one of the map.
    pub(super) fn number(&mut self, kind: &str, token: Option<(u32, &[u64])>, of_map: bool) -> u64 {
        let Some((triangle, values)) = token else { return 0 };
        let place = self.place(kind);
        let kind = &mut self.0[place];
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
