//! The file that a run writes: what it is called, and that the run does not read it.

use anyhow::{Context as _, Result, ensure};
use std::fs::canonicalize;
use std::path::Path;

/// The name of the file that --out asks for.
///
/// # Errors
/// None, as of a folder, or one that is not UTF-8.
pub fn name_of(out: &Path) -> Result<&str> {
    let named = out.file_name().with_context(|| format!("--out {}: no name of a file", out.display()))?;
    named.to_str().with_context(|| {
        format!("--out {}: the name is not UTF-8; permitted: names of UTF-8; give another", out.display())
    })
}

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
