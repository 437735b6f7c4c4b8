//! A table of TOML that knows which keys it was asked for, so that any other is an error with the nearest name.

use super::error::DutError;
use toml::Value;

/// A table and where it stands.
pub(super) struct Section<'a> {
    file: &'a str,
    path: String,
    entries: toml::Table,
    asked: Vec<&'static str>,
}

impl<'a> Section<'a> {
    /// The whole file.
    pub(super) fn whole(file: &'a str, text: &str) -> Result<Self, DutError> {
        let entries = text.parse::<toml::Table>().map_err(|error| {
            let place = error.span().map_or(1, |span| text[..span.start].lines().count().max(1));
            let found = error.message().lines().collect::<Vec<_>>().join(" ");
            DutError::new(file, format!("line {place}"), found, "TOML")
        })?;
        Ok(Section { file, path: String::new(), entries, asked: Vec::new() })
    }

    /// The key with its tables.
    pub(super) fn key(&self, name: &str) -> String {
        if self.path.is_empty() { name.to_owned() } else { format!("{}.{name}", self.path) }
    }

    pub(super) fn error(&self, name: &str, found: impl Into<String>, permitted: &str) -> DutError {
        DutError::new(self.file, self.key(name), found, permitted)
    }

    fn take(&mut self, name: &'static str) -> Option<Value> {
        self.asked.push(name);
        self.entries.remove(name)
    }

    pub(super) fn text(&mut self, name: &'static str) -> Result<Option<String>, DutError> {
        match self.take(name) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(self.error(name, shown(&other), "a text in quotes")),
        }
    }

    /// One of these words.
    pub(super) fn choice<T: Copy>(
        &mut self,
        name: &'static str,
        words: &[(&'static str, T)],
    ) -> Result<Option<T>, DutError> {
        let Some(text) = self.text(name)? else { return Ok(None) };
        match words.iter().find(|(word, _)| *word == text) {
            Some((_, value)) => Ok(Some(*value)),
            None => {
                let names = words.iter().map(|(word, _)| *word);
                let found = shown(&Value::String(text.clone()));
                Err(DutError::unknown(self.file, self.key(name), found, &text, names))
            }
        }
    }

    pub(super) fn number(&mut self, name: &'static str, most: u32) -> Result<Option<u32>, DutError> {
        match self.take(name) {
            None => Ok(None),
            Some(Value::Integer(number)) if (1..=i64::from(most)).contains(&number) => {
                Ok(Some(number as u32)) // it fits, as `most` does
            }
            Some(other) => Err(self.error(name, shown(&other), &format!("a whole number, 1 to {most}"))),
        }
    }

    /// A list of texts.
    pub(super) fn texts(&mut self, name: &'static str) -> Result<Option<Vec<String>>, DutError> {
        let Some(value) = self.take(name) else { return Ok(None) };
        let list = value.as_array().and_then(|list| {
            list.iter().map(|entry| entry.as_str().map(str::to_owned)).collect::<Option<Vec<_>>>()
        });
        match list {
            Some(list) => Ok(Some(list)),
            None => Err(self.error(name, shown(&value), "a list of texts, [\"a\", \"b\"]")),
        }
    }

    pub(super) fn table(&mut self, name: &'static str) -> Result<Option<Section<'a>>, DutError> {
        match self.take(name) {
            None => Ok(None),
            Some(Value::Table(entries)) => {
                Ok(Some(Section { file: self.file, path: self.key(name), entries, asked: Vec::new() }))
            }
            Some(other) => {
                let permitted = format!("a table, [{}]", self.key(name));
                Err(self.error(name, shown(&other), &permitted))
            }
        }
    }

    /// Tables of any names.
    pub(super) fn tables(self) -> Result<Vec<(String, Section<'a>)>, DutError> {
        let Section { file, path, entries, .. } = self;
        let of = |(name, value): (String, Value)| {
            let path = format!("{path}.{name}");
            match value {
                Value::Table(entries) => Ok((name, Section { file, path, entries, asked: Vec::new() })),
                other => Err(DutError::new(file, path.clone(), shown(&other), format!("a table, [{path}]"))),
            }
        };
        entries.into_iter().map(of).collect()
    }

    /// What stands under names of the user's own.
    pub(super) fn values(&self) -> impl Iterator<Item = (&String, &Value)> {
        self.entries.iter()
    }

    /// Nothing is left that was not asked for.
    pub(super) fn finish(self) -> Result<(), DutError> {
        match self.entries.iter().next() {
            None => Ok(()),
            Some((name, value)) => {
                let found = format!("unknown key, {name} = {}", shown(value));
                Err(DutError::unknown(self.file, self.key(name), found, name, self.asked.iter().copied()))
            }
        }
    }
}

/// A value in an error message: cut where it is long.
pub(super) fn shown(value: &Value) -> String {
    let text: String = value.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    match text.char_indices().nth(60) {
        Some((end, _)) => format!("{} ...", &text[..end]),
        None => text,
    }
}
