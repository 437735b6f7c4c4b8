//! A table of a TOML file: values by key, checked, with their places for messages.

use crate::error::{Fault, InputError};
use edgewalk_nearest::nearest;
use glam::{DVec2, DVec3};
use std::ops::RangeInclusive;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The file that a table stands in.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub file: &'a str,
    pub text: &'a str,
}

impl Source<'_> {
    /// A fault at a byte of the file.
    pub fn fault(
        self,
        start: usize,
        key: impl std::fmt::Display,
        value: impl std::fmt::Display,
        permitted: impl Into<String>,
    ) -> Box<Fault> {
        let before = &self.text.as_bytes()[..start.min(self.text.len())];
        let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
        Fault::new(self.file, Some(line), key, value, permitted)
    }
}

/// A table whose keys are all known.
pub(super) struct Table<'a> {
    source: Source<'a>,
    /// What messages put before its keys: `light 2: `; nothing for the whole file.
    name: String,
    /// First byte.
    start: usize,
    entries: &'a DeTable<'a>,
}

impl<'a> Table<'a> {
    /// # Errors
    /// A key that is not among `keys`.
    pub fn new(
        source: Source<'a>,
        name: String,
        start: usize,
        entries: &'a DeTable<'a>,
        keys: &[&'static str],
    ) -> Result<Self, InputError> {
        for key in entries.keys() {
            if !keys.contains(&key.get_ref().as_ref()) {
                let permitted = format!("permitted: {}", keys.join(" "));
                let mut fault =
                    source.fault(key.span().start, format!("{name}key"), key.get_ref(), permitted);
                fault.nearest = nearest(key.get_ref(), keys.iter().copied());
                return Err(fault.into());
            }
        }
        Ok(Self { source, name, start, entries })
    }

    fn value(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.entries.get(key)
    }

    /// A fault of a key, at its value if it has one.
    pub fn fault(
        &self,
        key: &str,
        value: impl std::fmt::Display,
        permitted: impl Into<String>,
    ) -> InputError {
        let start = self.value(key).map_or(self.start, |value| value.span().start);
        self.source.fault(start, format!("{}{key}", self.name), value, permitted).into()
    }

    /// A fault of a value, as it stands in the file.
    fn wrong(&self, key: &str, permitted: impl Into<String>) -> InputError {
        let span = self.value(key).map(Spanned::span);
        let text = span.and_then(|span| self.source.text.get(span)).unwrap_or_default();
        self.fault(key, text, permitted)
    }

    /// A value that must be there.
    pub fn required<T>(&self, key: &str, value: Option<T>, permitted: &str) -> Result<T, InputError> {
        value.ok_or_else(|| self.fault(key, "not there", permitted))
    }

    /// Whether a key is there.
    pub fn has(&self, key: &str) -> bool {
        self.value(key).is_some()
    }

    /// A text.
    pub fn text(&self, key: &str) -> Result<Option<&'a str>, InputError> {
        match self.value(key).map(Spanned::get_ref) {
            None => Ok(None),
            Some(DeValue::String(text)) => Ok(Some(text)),
            Some(_) => Err(self.wrong(key, "permitted: a text in quotes")),
        }
    }

    /// The name of a file.
    pub fn file(&self, key: &str) -> Result<Option<&'a str>, InputError> {
        match self.text(key)? {
            Some("") => Err(self.fault(key, "", "permitted: the name of a file")),
            name => Ok(name),
        }
    }

    /// What is wrong with the file that a key names; one that cannot be read is a fault of the key.
    pub fn of_file(&self, key: &str, error: InputError) -> InputError {
        match (error, self.text(key)) {
            (InputError::Read { source, .. }, Ok(Some(name))) => {
                self.fault(key, name, format!("cannot be read: {source}"))
            }
            (error, _) => error,
        }
    }

    /// Refuses the first of `keys` that is there and not among `own`, the keys of such a table.
    pub fn only(&self, keys: &[&str], own: &[&str], such: &str) -> Result<(), InputError> {
        match keys.iter().find(|key| self.has(key) && !own.contains(key)) {
            Some(other) => {
                let start =
                    self.entries.get_key_value(*other).map_or(self.start, |(key, _)| key.span().start);
                let permitted = format!("permitted in {such}: {}", own.join(" "));
                Err(self.source.fault(start, format!("{}key", self.name), other, permitted).into())
            }
            None => Ok(()),
        }
    }

    /// Refuses a key that means something only beside one of others.
    pub fn beside(&self, key: &str, others: &[&str], because: &str) -> Result<(), InputError> {
        if !self.has(key) || others.iter().any(|other| self.has(other)) {
            return Ok(());
        }
        let others: Vec<String> = others.iter().map(|other| format!("`{other}`")).collect();
        let others = match others.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, first)) => format!("{} or {last}", first.join(", ")),
            None => String::new(),
        };
        Err(self.fault(key, "given", format!("permitted only beside {others}{because}")))
    }

    /// One of some names: its place among them.
    pub fn choice(&self, key: &str, valid: &[&'static str]) -> Result<Option<usize>, InputError> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        if let Some(place) = valid.iter().position(|name| *name == text) {
            return Ok(Some(place));
        }
        let mut error = self.fault(key, text, format!("permitted: {}", valid.join(" ")));
        if let InputError::Fault(fault) = &mut error {
            fault.nearest = nearest(text, valid.iter().copied());
        }
        Err(error)
    }

    /// `true` or `false`.
    pub fn flag(&self, key: &str) -> Result<Option<bool>, InputError> {
        match self.value(key).map(Spanned::get_ref) {
            None => Ok(None),
            Some(DeValue::Boolean(flag)) => Ok(Some(*flag)),
            Some(_) => Err(self.wrong(key, "permitted: true false")),
        }
    }

    /// A number within `range`.
    pub fn number(&self, key: &str, range: RangeInclusive<f64>) -> Result<Option<f64>, InputError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        match number(value.get_ref()).filter(|number| range.contains(number)) {
            Some(number) => Ok(Some(number)),
            None => {
                Err(self.wrong(key, format!("permitted: a number from {} to {}", range.start(), range.end())))
            }
        }
    }

    /// A number within `range`; `None` within for a word in its place.
    pub fn number_or(
        &self,
        key: &str,
        range: RangeInclusive<f64>,
        word: &str,
    ) -> Result<Option<Option<f64>>, InputError> {
        match self.value(key).map(Spanned::get_ref) {
            Some(DeValue::String(text)) if text == word => Ok(Some(None)),
            Some(value) => match number(value).filter(|number| range.contains(number)) {
                Some(number) => Ok(Some(Some(number))),
                None => {
                    let (least, most) = range.into_inner();
                    Err(self.wrong(key, format!("permitted: \"{word}\", or a number from {least} to {most}")))
                }
            },
            None => Ok(None),
        }
    }

    /// A whole number within `range`.
    pub fn count(&self, key: &str, range: RangeInclusive<u32>) -> Result<Option<u32>, InputError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let (least, most) = range.into_inner();
        let permitted = f64::from(least)..=f64::from(most);
        match number(value.get_ref()).filter(|number| number.fract() == 0.0 && permitted.contains(number)) {
            Some(number) => Ok(Some(number as u32)),
            None => Err(self.wrong(key, format!("permitted: a whole number from {least} to {most}"))),
        }
    }

    /// A list of three numbers within ±`limit`.
    pub fn vector(&self, key: &str, limit: f64) -> Result<Option<DVec3>, InputError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        match triple(value.get_ref()).filter(|v| v.abs().max_element() <= limit) {
            Some(vector) => Ok(Some(vector)),
            None => {
                let permitted = format!("permitted: [x, y, z], each from -{limit} to {limit}");
                Err(self.wrong(key, permitted))
            }
        }
    }

    /// The direction of a list of three numbers, as a unit vector.
    pub fn direction(&self, key: &str) -> Result<Option<DVec3>, InputError> {
        match self.vector(key, MAX_DIRECTION)?.map(DVec3::try_normalize) {
            Some(None) => Err(self.wrong(key, "permitted: [x, y, z], not all of them 0")),
            direction => Ok(direction.flatten()),
        }
    }

    /// Red, green, blue from 0 to `most`: a list of three numbers, or one for all.
    pub fn color(&self, key: &str, most: f64) -> Result<Option<DVec3>, InputError> {
        self.three_or_one(key, 0.0..=most, "[r, g, b]")
    }

    /// Factors of x, y, z within `range`: a list of three numbers, or one for all.
    pub fn factors(&self, key: &str, range: RangeInclusive<f64>) -> Result<Option<DVec3>, InputError> {
        self.three_or_one(key, range, "[x, y, z]")
    }

    fn three_or_one(
        &self,
        key: &str,
        range: RangeInclusive<f64>,
        list: &str,
    ) -> Result<Option<DVec3>, InputError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let three = triple(value.get_ref()).or_else(|| number(value.get_ref()).map(DVec3::splat));
        match three.filter(|three| three.to_array().iter().all(|number| range.contains(number))) {
            Some(three) => Ok(Some(three)),
            None => {
                let (least, most) = range.into_inner();
                Err(self.wrong(key, format!("permitted: a number or {list}, each from {least} to {most}")))
            }
        }
    }

    /// A list of lists of three numbers within ±`limit`.
    pub fn vectors(&self, key: &str, limit: f64) -> Result<Option<Vec<DVec3>>, InputError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let list = match value.get_ref() {
            DeValue::Array(list) => list.iter().map(|v| triple(v.get_ref())).collect::<Option<Vec<_>>>(),
            _ => None,
        };
        match list.filter(|list| list.iter().all(|v| v.abs().max_element() <= limit)) {
            Some(list) => Ok(Some(list)),
            None => {
                let permitted = format!("permitted: a list of [x, y, z], each from -{limit} to {limit}");
                Err(self.wrong(key, permitted))
            }
        }
    }

    /// A list of `count` lists of two numbers within ±`limit`.
    pub fn pairs(&self, key: &str, count: usize, limit: f64) -> Result<Option<Vec<DVec2>>, InputError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let list = match value.get_ref() {
            DeValue::Array(list) => list.iter().map(|v| numbers(v.get_ref()).map(DVec2::from)).collect(),
            _ => None,
        };
        match list.filter(|list: &Vec<_>| {
            list.len() == count && list.iter().all(|v| v.abs().max_element() <= limit)
        }) {
            Some(list) => Ok(Some(list)),
            None => {
                let permitted = format!("permitted: {count} of [u, v], each from -{limit} to {limit}");
                Err(self.wrong(key, permitted))
            }
        }
    }

    /// A list of lists of whole numbers below `limit`.
    pub fn indices(&self, key: &str, limit: usize) -> Result<Option<Vec<Vec<u32>>>, InputError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let index = |value: &Spanned<DeValue>| {
            let index = number(value.get_ref())?;
            (index.fract() == 0.0 && index >= 0.0 && index < limit as f64).then_some(index as u32)
        };
        let list = |value: &Spanned<DeValue>| match value.get_ref() {
            DeValue::Array(list) => list.iter().map(index).collect::<Option<Vec<_>>>(),
            _ => None,
        };
        let lists = match value.get_ref() {
            DeValue::Array(lists) => lists.iter().map(list).collect::<Option<Vec<_>>>(),
            _ => None,
        };
        match lists {
            Some(lists) => Ok(Some(lists)),
            None => {
                let permitted =
                    format!("permitted: a list of lists of places from 0 to {}", limit.max(1) - 1);
                Err(self.wrong(key, permitted))
            }
        }
    }

    /// The table `[key]`.
    pub fn table(&self, key: &str, keys: &[&'static str]) -> Result<Option<Table<'a>>, InputError> {
        match self.value(key) {
            None => Ok(None),
            Some(value) => match value.get_ref() {
                DeValue::Table(entries) => {
                    Table::new(self.source, format!("{key}: "), value.span().start, entries, keys).map(Some)
                }
                _ => Err(self.wrong(key, format!("permitted: a table, [{key}]"))),
            },
        }
    }

    /// The tables `[[key]]`, which messages count from 1.
    pub fn tables(&self, key: &str, keys: &[&'static str]) -> Result<Vec<Table<'a>>, InputError> {
        let Some(value) = self.value(key) else { return Ok(Vec::new()) };
        let DeValue::Array(list) = value.get_ref() else {
            return Err(self.wrong(key, format!("permitted: tables, [[{key}]]")));
        };
        let table = |(place, value): (usize, &'a Spanned<DeValue<'a>>)| match value.get_ref() {
            DeValue::Table(entries) => {
                Table::new(self.source, format!("{key} {}: ", place + 1), value.span().start, entries, keys)
            }
            _ => Err(self.wrong(key, format!("permitted: tables, [[{key}]]"))),
        };
        list.iter().enumerate().map(table).collect()
    }
}

/// Largest component of a direction: its square is far from overflow.
const MAX_DIRECTION: f64 = 1e12;

/// A finite number; whole numbers and others are alike.
fn number(value: &DeValue) -> Option<f64> {
    let number = match value {
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix()).ok()? as f64,
        DeValue::Float(float) => float.as_str().parse().ok()?,
        _ => return None,
    };
    number.is_finite().then_some(number)
}

fn triple(value: &DeValue) -> Option<DVec3> {
    numbers(value).map(DVec3::from)
}

/// A list of so many numbers.
fn numbers<const N: usize>(value: &DeValue) -> Option<[f64; N]> {
    let DeValue::Array(list) = value else { return None };
    let numbers = list.iter().map(|value| number(value.get_ref())).collect::<Option<Vec<_>>>()?;
    numbers.try_into().ok()
}
