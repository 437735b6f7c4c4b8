//! The inputs that this process has read: an output must not take the place of one.
//!
//! A file names others, as a mesh its materials and those their pictures. So each is noted where it is opened.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Where the files are, without links on the way.
static READ: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Notes a file that is read. A pipe has no place that could be written to.
pub fn note(path: &Path) {
    if let Ok(place) = path.canonicalize() {
        READ.lock().unwrap_or_else(PoisonError::into_inner).insert(place);
    }
}

/// Whether this file was read, whatever name it was given then.
#[must_use]
pub fn was_read(path: &Path) -> bool {
    path.canonicalize()
        .is_ok_and(|place| READ.lock().unwrap_or_else(PoisonError::into_inner).contains(&place))
}
