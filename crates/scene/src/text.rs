//! Text files of one item a line: words and numbers, and the place they stand for messages.

use crate::error::{Fault, InputError};
use edgewalk_nearest::nearest;
use std::fmt::Display;
use std::io::{BufRead, Read as _};
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Bytes of the longest line: a contour of 65,536 vertices with 70 characters a number.
pub(crate) const MAX_LINE: usize = 32 << 20;

/// Bytes of a word that a message is made from.
const MAX_SHOWN: usize = 1 << 10;

/// What some editors put before the first line.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// Where a line stands.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub file: &'a str,
    /// Counted from 1.
    pub line: usize,
}

impl Place<'_> {
    pub fn fault(self, key: impl Display, value: &[u8], permitted: impl Into<String>) -> Box<Fault> {
        // A fault shows no more than a few dozen characters; a word may be as long as a line.
        let start = &value[..value.len().min(MAX_SHOWN)];
        Fault::new(self.file, Some(self.line), key, String::from_utf8_lossy(start), permitted)
    }

    /// The index of `word` among `valid`.
    pub fn choice(self, key: &str, word: &[u8], valid: &[&'static str]) -> Result<usize, InputError> {
        if let Some(index) = valid.iter().position(|name| name.as_bytes() == word) {
            return Ok(index);
        }
        let mut fault = self.fault(key, word, format!("permitted: {}", valid.join(" ")));
        fault.nearest = std::str::from_utf8(word).ok().and_then(|word| nearest(word, valid.iter().copied()));
        Err(fault.into())
    }

    /// Exactly N words, which messages call `names`.
    pub fn values<'a, const N: usize>(
        self,
        key: &str,
        names: &str,
        mut words: impl Iterator<Item = &'a [u8]>,
    ) -> Result<[&'a [u8]; N], InputError> {
        let mut taken: [&[u8]; N] = [&[]; N];
        let mut count = 0;
        for slot in &mut taken {
            if let Some(word) = words.next() {
                *slot = word;
                count += 1;
            }
        }
        count += words.count();
        if count == N {
            return Ok(taken);
        }
        let permitted = match N {
            0 => "permitted: no value".to_owned(),
            1 => format!("permitted: 1 value, {names}"),
            _ => format!("permitted: {N} values, {names}"),
        };
        Err(self.fault(key, format!("{count} given").as_bytes(), permitted).into())
    }

    /// A number that is neither infinite nor NaN.
    pub fn finite(self, key: impl Display, word: &[u8]) -> Result<f64, InputError> {
        let number = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
        let finite = number.filter(|number: &f64| number.is_finite());
        finite.ok_or_else(|| self.fault(key, word, "permitted: a finite number").into())
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

    /// A part of a colour, 0 to 1; a message about a larger one says how to scale it.
    pub fn color(self, key: impl Display, word: &[u8]) -> Result<f64, InputError> {
        let mut color = self.number(key, word, "a number", 0.0..=1.0);
        if let Err(InputError::Fault(fault)) = &mut color
            && fault.value.parse::<f64>().is_ok_and(|value| value > 1.0)
        {
            fault.permitted += "; colours are 0 to 1, so divide those of 0 to 255 by 255";
        }
        color
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

/// The lines of a file that messages call `file`.
pub(crate) struct Lines<R> {
    file: String,
    input: R,
    /// Whether a line that ends in a backslash goes on in the next one.
    joined: bool,
    text: Vec<u8>,
    /// Number of the first line of `text`, counted from 1.
    line: usize,
    /// Lines read so far.
    read: usize,
}

impl<R: BufRead> Lines<R> {
    pub fn new(file: &str, input: R) -> Self {
        Self { file: file.into(), input, joined: false, text: Vec::new(), line: 0, read: 0 }
    }

    /// The next line and its place; `None` at the end.
    pub fn next(&mut self) -> Result<Option<(Place<'_>, &[u8])>, InputError> {
        self.text.clear();
        self.line = self.read + 1;
        loop {
            let room = (MAX_LINE + 1).saturating_sub(self.text.len());
            match (&mut self.input).take(room as u64).read_until(b'\n', &mut self.text) {
                Ok(0) => break,
                Ok(_) => self.read += 1,
                Err(source) => return Err(InputError::Read { file: self.file.clone(), source }),
            }
            if self.text.len() > MAX_LINE {
                let why = format!("permitted: lines of at most {MAX_LINE} bytes");
                return Err(self.place().fault("line", &self.text, why).into());
            }
            if !(self.joined && goes_on(&mut self.text)) {
                break;
            }
        }
        if self.read < self.line {
            return Ok(None);
        }
        let mark = if self.line == 1 { BYTE_ORDER_MARK } else { b"" };
        Ok(Some((self.place(), self.text.strip_prefix(mark).unwrap_or(&self.text))))
    }

    /// Of the last line that was given.
    pub fn place(&self) -> Place<'_> {
        Place { file: &self.file, line: self.line }
    }

    /// Behind the last line of the file.
    pub fn end(&self) -> Place<'_> {
        Place { line: self.read + 1, ..self.place() }
    }
}

/// Makes a backslash at the end of a line a blank, and says whether there was one. A comment ends with its line.
fn goes_on(text: &mut Vec<u8>) -> bool {
    let Some(before) = text.trim_ascii_end().strip_suffix(b"\\") else { return false };
    if before.trim_ascii_start().starts_with(b"#") {
        return false;
    }
    let length = before.len();
    text.truncate(length);
    text.push(b' ');
    true
}

/// Calls `take` with each line of a file that messages call `file`; one that ends in a backslash goes on in the next.
pub(crate) fn each_line(
    file: &str,
    input: impl BufRead,
    mut take: impl FnMut(Place, &[u8]) -> Result<(), InputError>,
) -> Result<(), InputError> {
    let mut lines = Lines { joined: true, ..Lines::new(file, input) };
    while let Some((place, text)) = lines.next()? {
        take(place, text)?;
    }
    Ok(())
}
