//! The name of the file that a run writes.

use anyhow::{Context as _, Result};
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
