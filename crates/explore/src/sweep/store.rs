//! The rows of a sweep in a file: appended one a line, each in one write, and read again where a run was cut short.

use super::row::Status;
use anyhow::{Context, Result, anyhow};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// An open file of rows, that nobody else writes to.
pub struct Store {
    path: PathBuf,
    file: Mutex<Tail>,
}

struct Tail {
    file: File,
    /// Bytes of whole rows.
    length: u64,
}

impl Store {
    /// Opens the file, which is made where there is none, and gives the rows in it. What a cut write left behind the last line is
    /// removed.
    ///
    /// # Errors
    /// A file that cannot be written or that another run has open, a line that is no row.
    pub fn open(path: &Path) -> Result<(Store, Vec<Value>)> {
        let named = || path.display().to_string();
        let file = OpenOptions::new().read(true).append(true).create(true).open(path).with_context(named)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(anyhow!(
                    "{}: another sweep is writing to it; wait for its end, or choose another --out",
                    named()
                ));
            }
            Err(TryLockError::Error(error)) => return Err(error).with_context(named),
        }
        let mut bytes = Vec::new();
        (&file).read_to_end(&mut bytes).with_context(named)?;
        let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        let rows = rows(&bytes[..whole]).with_context(named)?;
        if whole < bytes.len() {
            file.set_len(whole as u64).with_context(named)?;
        }
        let tail = Tail { file, length: whole as u64 };
        Ok((Store { path: path.to_owned(), file: Mutex::new(tail) }, rows))
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Appends a row.
    ///
    /// # Errors
    /// It cannot be written; the rows before it stay.
    pub fn append(&self, row: &Value) -> Result<()> {
        let line = format!("{row}\n");
        let mut tail = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let Tail { file, length } = &mut *tail;
        match file.write_all(line.as_bytes()) {
            Ok(()) => {
                *length += line.len() as u64;
                Ok(())
            }
            Err(error) => {
                // Half a line would be removed by the next run as well.
                let _ = file.set_len(*length).and_then(|()| file.seek(SeekFrom::End(0)));
                Err(error).with_context(|| self.path.display().to_string())
            }
        }
    }
}

/// The rows of a file that may not be there.
///
/// # Errors
/// It cannot be read, or a line is no row; a cut last line is passed over.
pub fn read(path: &Path) -> Result<Vec<Value>> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let named = || path.display().to_string();
    let bytes = std::fs::read(path).with_context(named)?;
    let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    rows(&bytes[..whole]).with_context(named)
}

fn rows(bytes: &[u8]) -> Result<Vec<Value>> {
    let lines = bytes.split(|byte| *byte == b'\n').enumerate().filter(|(_, line)| !line.is_empty());
    lines
        .map(|(place, line)| {
            let row: Value = serde_json::from_slice(line)
                .map_err(|e| anyhow!("line {}: no row of a sweep: {e}; remove the line", place + 1))?;
            if row["key"].as_str().is_none() {
                return Err(anyhow!("line {}: a row without a key; remove the line", place + 1));
            }
            if Status::of(&row).is_none() {
                return Err(anyhow!(
                    "line {}: status {}: permitted: {}; remove the line",
                    place + 1,
                    row["status"],
                    Status::ALL.map(Status::name).join(", ")
                ));
            }
            Ok(row)
        })
        .collect()
}

/// The lines of such a file as they stand there, by their rows' keys: a number that is read and written again may change in its last digit.
///
/// # Errors
/// As [`read`].
pub fn lines(path: &Path) -> Result<BTreeMap<String, String>> {
    let rows = read(path)?;
    if rows.is_empty() {
        return Ok(BTreeMap::new());
    }
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let lines = text.lines().filter(|line| !line.is_empty()).map(str::to_owned);
    Ok(rows.iter().map(|row| row["key"].as_str().unwrap_or_default().to_owned()).zip(lines).collect())
}

/// Rows by their keys; of two with one key the later counts.
#[must_use]
pub fn by_key(rows: Vec<Value>) -> BTreeMap<String, Value> {
    rows.into_iter().map(|row| (row["key"].as_str().unwrap_or_default().to_owned(), row)).collect()
}
