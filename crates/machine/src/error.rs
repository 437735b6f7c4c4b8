//! Why a machine is refused.

use crate::key::Key;
use crate::keys::KEYS;
use crate::machine::Machine;
use edgewalk_nearest::nearest;

/// Words longer than this are cut in messages, characters.
const SHOWN: usize = 60;

/// Why a machine is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{what}", line.map(|l| format!("line {l}: ")).unwrap_or_default())]
pub struct MachineError {
    /// Line in the file, from 1, where there is one.
    pub line: Option<usize>,
    /// Key and value, what is wrong with them, and what to write instead.
    pub what: String,
}

impl MachineError {
    pub(crate) fn new(what: String) -> Self {
        MachineError { line: None, what }
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
        Self::new(key.refusal(&Self::shown(value)))
    }

    /// `key`'s value clashes with another.
    pub(crate) fn rule(machine: &Machine, key: &str, reason: String, remedy: String) -> Self {
        let value = KEYS.iter().find(|k| k.name == key).map_or_else(String::new, |k| k.show(machine));
        Self::new(format!("{key} = {value} cannot be built: {reason}; try {key} = {remedy}"))
    }

    /// The error at a place of a file, the offset in bytes.
    pub(crate) fn at(mut self, text: &str, offset: usize) -> Self {
        self.line = Some(text[..offset.min(text.len())].matches('\n').count() + 1);
        self
    }
}

impl Key {
    /// The key of that name.
    ///
    /// # Errors
    /// There is none.
    pub fn named(name: &str) -> Result<&'static Key, MachineError> {
        KEYS.iter().find(|key| key.name == name).ok_or_else(|| {
            let name = MachineError::shown(name);
            let near = nearest(&name, KEYS.iter().map(|key| key.name)).map(|near| format!("nearest: {near}"));
            let hint = near.unwrap_or_else(|| "`edgewalk config print` shows all keys".to_owned());
            MachineError::new(format!("unknown key {name}; {hint}"))
        })
    }
}
