//! What a run reads stays as it is.

use anyhow::{Result, ensure};
use std::fs::canonicalize;
use std::path::Path;

/// Accepts a file to write that is none of these to read; `option` names it.
///
/// # Errors
/// It is one of them.
pub fn none_of<P: AsRef<Path>>(option: &str, file: &Path, inputs: impl IntoIterator<Item = P>) -> Result<()> {
    // What is not there yet is no input.
    let Some(place) = canonicalize(file).ok().filter(|place| place.is_file()) else { return Ok(()) };
    for input in inputs {
        ensure!(
            canonicalize(input.as_ref()).ok().as_ref() != Some(&place),
            "{option} {}: this file is the input {}; permitted: a file that the command does not read; give another name",
            file.display(),
            input.as_ref().display()
        );
    }
    Ok(())
}
