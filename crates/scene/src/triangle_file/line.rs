//! The words of one line, with the place they stand for messages.

use crate::error::{Fault, InputError, nearest};
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Values longer than this are cut in messages, characters.
const SHOWN: usize = 40;

/// Where a line stands.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub file: &'a str,
    /// Counted from 1.
    pub line: usize,
}

impl Place<'_> {
    pub fn fault(self, key: impl Display, value: &[u8], permitted: impl Into<String>) -> Box<Fault> {
        let text = String::from_utf8_lossy(value);
        let mut shown: String = text.chars().take(SHOWN).collect();
        if text.chars().nth(SHOWN).is_some() {
            shown.push_str("...");
        }
        Box::new(Fault {
            file: self.file.into(),
            line: Some(self.line),
            key: key.to_string(),
            value: shown,
            permitted: permitted.into(),
            nearest: None,
        })
    }

    /// The index of `word` among `valid`.
    pub fn choice(self, key: &str, word: &[u8], valid: &[&'static str]) -> Result<usize, InputError> {
        if let Some(index) = valid.iter().position(|name| name.as_bytes() == word) {
            return Ok(index);
        }
        let mut fault = self.fault(key, word, format!("permitted: {}", valid.join(" ")));
        fault.nearest = nearest(&String::from_utf8_lossy(word), valid);
        Err(fault.into())
    }

    /// A number within `range`; NaN lies in no range. `kind` is what a message calls such a number.
    pub fn number<T>(
        self,
        key: impl Display,
        word: &[u8],
        kind: &str,
        range: RangeInclusive<T>,
    ) -> Result<T, InputError>
    where
        T: FromStr + PartialOrd + Display,
    {
        let number = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
        match number {
            Some(number) if range.contains(&number) => Ok(number),
            _ => {
                let permitted = format!("permitted: {kind} from {} to {}", range.start(), range.end());
                Err(self.fault(key, word, permitted).into())
            }
        }
    }
}

/// The words of a line without its comment.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let text = line.split(|byte| *byte == b'#').next().unwrap_or_default();
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}
