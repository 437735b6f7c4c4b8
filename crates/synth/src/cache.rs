//! Results of tools, kept by all that they depend on: a folder a step. Removing any of it is always safe.

use edgewalk_tool::Stop;
use sha2::{Digest, Sha256};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// What is made of the tools' output before it is kept; another number makes all that is kept worthless.
const FORMAT: &str = "1";

/// A folder of results.
pub struct Cache {
    root: PathBuf,
    scratch: PathBuf,
    /// Steps that were found there.
    found: AtomicU64,
    /// Steps that were done.
    done: AtomicU64,
}

impl Cache {
    /// One in `root`; steps work in `scratch`, a folder in the same file system, from where their results move.
    #[must_use]
    pub fn new(root: PathBuf, scratch: PathBuf) -> Cache {
        Cache { root, scratch, found: AtomicU64::new(0), done: AtomicU64::new(0) }
    }

    /// How many steps were found, and how many done.
    #[must_use]
    pub fn counts(&self) -> (u64, u64) {
        (self.found.load(Ordering::Relaxed), self.done.load(Ordering::Relaxed))
    }

    /// The folder with the results `keep` of the step that `key` names; `work` makes them where it has not been done.
    pub(crate) fn step(
        &self,
        key: &[&str],
        keep: &[&str],
        work: impl FnOnce(&Path) -> Result<(), Stop>,
    ) -> Result<PathBuf, Stop> {
        let name = name(key);
        let kept = self.root.join(&name);
        if keep.iter().all(|file| kept.join(file).is_file()) {
            self.found.fetch_add(1, Ordering::Relaxed);
            return Ok(kept);
        }
        let folder = self.scratch.join(&name);
        let said = |error: &std::io::Error| Stop::file(&kept, error);
        std::fs::create_dir_all(&folder).map_err(|error| said(&error))?;
        work(&folder)?;
        self.done.fetch_add(1, Ordering::Relaxed);
        std::fs::create_dir_all(&kept).map_err(|error| said(&error))?;
        for file in keep {
            // Each file appears whole; another run that makes the same step makes the same file.
            std::fs::rename(folder.join(file), kept.join(file)).map_err(|error| match error.kind() {
                ErrorKind::NotFound => Stop::broken(file, &error), // the tool did not write it
                _ => said(&error),
            })?;
        }
        let _ = std::fs::remove_dir_all(folder); // what is left of it goes with the scratch folder
        Ok(kept)
    }
}

fn name(key: &[&str]) -> String {
    let mut hash = Sha256::new();
    for part in key.iter().chain([&FORMAT]) {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
}
