//! Text files of one item a line: words and numbers, and the place they stand for messages.

use crate::error::{Fault, InputError, nearest};
use std::fmt::Display;
use std::io::BufRead;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Where a line stands.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub file: &'a str,
    /// Counted from 1.
    pub line: usize,
}

impl Place<'_> {
    pub fn fault(self, key: impl Display, value: &[u8], permitted: impl Into<String>) -> Box<Fault> {
        Fault::new(self.file, Some(self.line), key, String::from_utf8_lossy(value), permitted)
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
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let text = line.split(|byte| *byte == b'#').next().unwrap_or_default();
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// The rest of a line after its first word: names may contain blanks.
pub(crate) fn rest(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(line);
    text.trim().split_once(char::is_whitespace).map_or(String::new(), |(_, name)| name.trim().to_owned())
}

/// Calls `take` with each line of a file that messages call `file`; returns the number of lines.
pub(crate) fn each_line(
    file: &str,
    mut input: impl BufRead,
    mut take: impl FnMut(Place, &[u8]) -> Result<(), InputError>,
) -> Result<usize, InputError> {
    let mut place = Place { file, line: 0 };
    let mut text = Vec::new();
    loop {
        text.clear();
        match input.read_until(b'\n', &mut text) {
            Ok(0) => return Ok(place.line),
            Ok(_) => {}
            Err(source) => return Err(InputError::Read { file: file.into(), source }),
        }
        place.line += 1;
        take(place, &text)?;
    }
}
