//! The verdicts of a run, a line each, read again where a run was cut short.

use super::bench::Ended;
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Name of the file.
const FILE: &str = "verdicts.jsonl";

/// The file in this folder.
pub fn file(folder: &Path) -> PathBuf {
    folder.join(FILE)
}

/// The verdict on a fault.
#[derive(Serialize, Deserialize)]
pub struct Row {
    /// Place of the fault among those of the unit.
    pub fault: usize,
    /// `found`, `found by time` or `survived`.
    pub verdict: String,
    /// Seconds that the command was given.
    pub limit: u64,
}

/// A line of the file.
#[derive(Serialize, Deserialize)]
struct Line {
    /// What the verdict depends on.
    key: String,
    #[serde(flatten)]
    row: Row,
}

/// The file, and what is known of this run.
pub struct Store {
    key: String,
    known: Mutex<(File, BTreeMap<usize, String>)>,
}

impl Store {
    /// The verdicts under this key; of a line that was cut short nothing is used. A fault that was found by time counts
    /// only where its command had this limit or a longer one.
    pub fn open(path: &Path, key: &str, limit: u64) -> Result<Store> {
        let named = || format!("--out {}", path.display());
        let text = match fs::read_to_string(path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            read => read.with_context(named)?,
        };
        let lines = text.lines().filter_map(|line| serde_json::from_str::<Line>(line).ok());
        let holds = |row: &Row| row.verdict != Ended::Late.word() || row.limit >= limit;
        let rows = lines.filter(|line| line.key == key).map(|line| line.row).filter(holds);
        let known = rows.map(|row| (row.fault, row.verdict)).collect();
        let mut file = OpenOptions::new().append(true).create(true).open(path).with_context(named)?;
        if !text.is_empty() && !text.ends_with('\n') {
            file.write_all(b"\n").with_context(named)?;
        }
        Ok(Store { key: key.to_owned(), known: Mutex::new((file, known)) })
    }

    /// The verdict on a fault.
    pub fn of(&self, fault: usize) -> Option<String> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner).1.get(&fault).cloned()
    }

    /// Keeps a verdict at once.
    pub fn add(&self, row: Row) -> Result<()> {
        let (fault, verdict) = (row.fault, row.verdict.clone());
        let line = serde_json::to_string(&Line { key: self.key.clone(), row })? + "\n";
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.0.write_all(line.as_bytes()).context(FILE)?;
        known.1.insert(fault, verdict);
        Ok(())
    }
}
