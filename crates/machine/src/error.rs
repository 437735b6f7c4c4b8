//! Why a machine is refused.

use crate::key::Key;
use crate::keys::KEYS;
use crate::machine::Machine;

/// Words longer than this are cut in messages, characters.
const SHOWN: usize = 60;

/// Why a machine is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{what}; {hint}", line.map(|l| format!("line {l}: ")).unwrap_or_default())]
pub struct MachineError {
    /// Line in the file, from 1, where there is one.
    pub line: Option<usize>,
    /// Key, value and what is wrong with them.
    pub what: String,
    /// What to write instead.
    pub hint: String,
}

impl MachineError {
    pub(crate) fn new(what: String, hint: String) -> Self {
        MachineError { line: None, what, hint }
    }

    /// A word of the user's, cut to a readable length.
    pub(crate) fn shown(word: &str) -> String {
        match word.char_indices().nth(SHOWN) {
            Some((end, _)) => word[..end].to_owned() + "...",
            None => word.to_owned(),
        }
    }

    /// `key = value` lies outside the key's domain.
    pub(crate) fn value(key: &Key, value: &str) -> Self {
        let value = &Self::shown(value);
        Self::new(
            format!("{} = {value} is not permitted ({})", key.name, key.permitted()),
            format!("nearest: {}", key.nearest(value)),
        )
    }

    /// `key`'s value clashes with another.
    pub(crate) fn rule(machine: &Machine, key: &str, reason: String, remedy: String) -> Self {
        let value = KEYS.iter().find(|k| k.name == key).map_or_else(String::new, |k| k.show(machine));
        Self::new(format!("{key} = {value} cannot be built: {reason}"), format!("try {key} = {remedy}"))
    }

    /// The error at a place of a file, the offset in bytes.
    pub(crate) fn at(mut self, text: &str, offset: usize) -> Self {
        self.line = Some(text[..offset.min(text.len())].matches('\n').count() + 1);
        self
    }
}
