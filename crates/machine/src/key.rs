//! What a key of a machine file is, and how a value of it is read and written.

use Domain::{OneOf, Range, Word};

use crate::machine::Machine;

/// What a key may be set to.
#[derive(Clone, Copy, Debug)]
pub enum Domain {
    /// Whole numbers from the first to the second, both included.
    Range(u32, u32),
    /// One of these whole numbers.
    OneOf(&'static [u32]),
    /// One of these words; the number in [`Key::get`] is its place.
    Word(&'static [&'static str]),
}

/// One key of the machine file.
#[derive(Clone, Copy)]
pub struct Key {
    /// Dotted name, `section.key`.
    pub name: &'static str,
    /// What it means, with its unit.
    pub doc: &'static str,
    /// Permitted values.
    pub domain: Domain,
    /// Reads the value (for words: the place in the domain).
    pub get: fn(&Machine) -> u32,
    /// Writes a value that lies in the domain.
    pub set: fn(&mut Machine, u32),
    /// The key means something in this machine: those of channels and units that it has not stay out of its
    /// file and its hash.
    pub used: fn(&Machine) -> bool,
    /// The value that says that a unit is not there. It stays out of the hash: so machines keep theirs when a
    /// unit is added to the program.
    pub absent: Option<u32>,
}

/// A key that is a number: name, domain, meaning, its field, and where the key has a meaning if not
/// everywhere.
macro_rules! number {
    ($name:expr, $domain:expr, $doc:expr, $($field:ident).+) => {
        number!($name, $domain, $doc, $($field).+, if |_| true)
    };
    ($name:expr, $domain:expr, $doc:expr, $($field:ident).+, if $used:expr) => {
        Key {
            name: $name,
            doc: $doc,
            domain: $domain,
            get: |m| m.$($field).+,
            set: |m, v| m.$($field).+ = v,
            used: $used,
            absent: None,
        }
    };
}
pub(crate) use number;

/// A key that is a word of an enumeration, whose values are named in their order.
macro_rules! word {
    ($name:expr, $kind:ident { $($word:literal => $value:ident),+ }, $doc:expr, $($field:ident).+) => {
        word!($name, $kind { $($word => $value),+ }, $doc, $($field).+, if |_| true)
    };
    ($name:expr, $kind:ident { $($word:literal => $value:ident),+ }, $doc:expr, $($field:ident).+, if $used:expr) => {
        Key {
            name: $name,
            doc: $doc,
            domain: Domain::Word(&[$($word),+]),
            get: |m| m.$($field).+ as u32,
            set: |m, v| m.$($field).+ = [$($kind::$value),+][v as usize],
            used: $used,
            absent: None,
        }
    };
}
pub(crate) use word;

impl Key {
    /// The value tells this machine from others.
    #[must_use]
    pub fn tells(&self, machine: &Machine) -> bool {
        (self.used)(machine) && self.absent != Some((self.get)(machine))
    }

    /// The value as written in a file, words without quotes.
    #[must_use]
    pub fn show(&self, machine: &Machine) -> String {
        let value = (self.get)(machine);
        match self.domain {
            Word(words) => words[value as usize].to_owned(),
            _ => value.to_string(),
        }
    }

    /// The permitted values in words: `4 to 32`, `1, 2 or 4`.
    #[must_use]
    pub fn permitted(&self) -> String {
        match self.domain {
            Range(low, high) => format!("{low} to {high}"),
            OneOf(list) => list.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
            Word(words) => words.join(", "),
        }
    }

    /// Reads a value; `None` if it is not in the domain.
    #[must_use]
    pub fn parse(&self, text: &str) -> Option<u32> {
        match self.domain {
            Word(words) => words.iter().position(|w| *w == text).map(|place| place as u32),
            Range(low, high) => text.parse().ok().filter(|v| (low..=high).contains(v)),
            OneOf(list) => text.parse().ok().filter(|v| list.contains(v)),
        }
    }

    /// Why a value is refused: what is permitted, and the nearest to it, if one is near.
    #[must_use]
    pub fn refusal(&self, text: &str) -> String {
        let refused = format!("{} = {text} is not permitted ({})", self.name, self.permitted());
        match self.nearest(text) {
            Some(near) => format!("{refused}; nearest: {near}"),
            None => refused,
        }
    }

    /// The permitted value that is nearest to a refused one; none where every word is far, and of what is no number.
    fn nearest(&self, text: &str) -> Option<String> {
        let number = || text.parse::<f64>().ok().filter(|number| number.is_finite());
        match self.domain {
            Word(words) => {
                let text = match text {
                    "true" => "yes",
                    "false" => "no",
                    other => other,
                };
                edgewalk_nearest::nearest(text, words.iter().copied()).map(str::to_owned)
            }
            Range(low, high) => {
                let near = number()?.round().clamp(f64::from(low), f64::from(high));
                Some((near as u32).to_string())
            }
            OneOf(list) => {
                let wanted = number()?;
                let distance = |v: &&u32| (f64::from(**v) - wanted).abs();
                list.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).map(ToString::to_string)
            }
        }
    }
}
