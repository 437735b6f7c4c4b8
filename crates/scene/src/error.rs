//! What is wrong with an input, where, and what would be right.

use std::fmt;

/// A fault in a file or a name given by the user.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// The file could not be opened or read.
    #[error("{file}: cannot be read")]
    Read {
        /// The file as the user named it.
        file: String,
        /// The operating system's reason.
        source: std::io::Error,
    },
    /// The file was read, and something in it is not permitted.
    #[error(transparent)]
    Fault(#[from] Box<Fault>),
    /// The file holds what it cannot be drawn with while it is read: a polygon, or a light's depth map behind
    /// a triangle.
    #[error(transparent)]
    NeedsWhole(Box<Fault>),
}

/// Something not permitted: `file:line: key: value: what is permitted (nearest valid name)`.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct Fault {
    /// The file as the user named it.
    pub file: String,
    /// Line, counted from 1; `None` where the format has no lines or the whole file is meant.
    pub line: Option<usize>,
    /// Which item, e.g. `depth` or `T vertex 2 z`.
    pub key: String,
    /// What stands there, cut to a readable length.
    pub value: String,
    /// What may stand there.
    pub permitted: String,
    /// The valid name that looks most like `value`.
    pub nearest: Option<&'static str>,
}

/// Values longer than this are cut in messages, characters.
const SHOWN: usize = 60;

impl Fault {
    /// A fault without a nearest name.
    pub(crate) fn new(
        file: &str,
        line: Option<usize>,
        key: impl fmt::Display,
        value: impl fmt::Display,
        permitted: impl Into<String>,
    ) -> Box<Self> {
        let (file, key, permitted) = (file.to_owned(), key.to_string(), permitted.into());
        Box::new(Self { file, line, key, value: shown(&value.to_string()), permitted, nearest: None })
    }
}

/// A value cut to a readable length.
fn shown(value: &str) -> String {
    match value.char_indices().nth(SHOWN) {
        Some((end, _)) => value[..end].to_owned() + "...",
        None => value.to_owned(),
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:", self.file)?;
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        write!(f, " {}: `{}`: {}", self.key, self.value, self.permitted)?;
        if let Some(nearest) = self.nearest {
            write!(f, "; did you mean `{nearest}`?")?;
        }
        Ok(())
    }
}
