//! What is wrong with a user's design, or with the file that describes it.

use edgewalk_nearest::nearest;
use std::fmt;

/// A refusal: the file, the key, what was found there and what is permitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DutError {
    /// The file that describes the design, as it was named.
    pub file: String,
    /// The key with its tables, `in.span.fields.x`; empty where the whole file is meant.
    pub key: String,
    /// What was found.
    pub found: String,
    /// What is permitted, or needed.
    pub permitted: String,
    /// The name that was probably meant, or what to do.
    pub advice: Option<String>,
}

impl DutError {
    /// Without advice.
    pub(crate) fn new(
        file: &str,
        key: impl Into<String>,
        found: impl Into<String>,
        permitted: impl Into<String>,
    ) -> Self {
        let (key, found, permitted) = (key.into(), found.into(), permitted.into());
        DutError { file: file.to_owned(), key, found, permitted, advice: None }
    }

    /// `name` is none of `names`.
    pub(crate) fn unknown<'a>(
        file: &str,
        key: impl Into<String>,
        found: impl Into<String>,
        name: &str,
        names: impl IntoIterator<Item = &'a str> + Clone,
    ) -> Self {
        let all: Vec<&str> = names.clone().into_iter().collect();
        let permitted = if all.is_empty() { "nothing here".to_owned() } else { all.join(", ") };
        let error = DutError::new(file, key, found, permitted);
        match nearest(name, names) {
            Some(near) => error.advised(format!("nearest: {near}")),
            None => error,
        }
    }

    /// With what to do.
    pub(crate) fn advised(self, advice: impl Into<String>) -> Self {
        DutError { advice: Some(advice.into()), ..self }
    }
}

impl fmt::Display for DutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file)?;
        if !self.key.is_empty() {
            write!(f, "{}: ", self.key)?;
        }
        write!(f, "{}; permitted: {}", self.found, self.permitted)?;
        match &self.advice {
            Some(advice) => write!(f, "; {advice}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for DutError {}
