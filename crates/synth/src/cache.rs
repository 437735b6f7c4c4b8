//! Results of tools, kept by all that they depend on: a folder a step. Removing any of it is always safe.

use edgewalk_tool::Stop;
use sha2::{Digest, Sha256};
use std::fmt::Display;
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

    /// The folder with the results `keep` of the step that `key` names, and what `read` makes of them. Where the step has not
    /// been done, or its results cannot be read, `work` makes them; they are kept once they have been read.
    pub(crate) fn step<T>(
        &self,
        key: &[&str],
        keep: &[&str],
        work: impl FnOnce(&Path) -> Result<(), Stop>,
        read: impl Fn(&Path) -> Result<T, Stop>,
    ) -> Result<(PathBuf, T), Stop> {
        let name = name(key);
        let kept = self.root.join(&name);
        if keep.iter().all(|file| kept.join(file).is_file())
            && let Ok(read) = read(&kept)
        {
            self.found.fetch_add(1, Ordering::Relaxed);
            return Ok((kept, read));
        }
        let folder = self.scratch.join(&name);
        let said = |error: std::io::Error| Stop::file(&kept, &error);
        std::fs::create_dir_all(&folder).map_err(said)?;
        work(&folder)?;
        let read = read(&folder)?;
        self.done.fetch_add(1, Ordering::Relaxed);
        std::fs::create_dir_all(&kept).map_err(said)?;
        for file in keep {
            // Each file appears whole; another run that makes the same step makes the same file.
            std::fs::rename(folder.join(file), kept.join(file)).map_err(said)?;
        }
        let _ = std::fs::remove_dir_all(folder); // what is left of it goes with the scratch folder
        Ok((kept, read))
    }
}

/// The text of a file that a tool wrote.
pub(crate) fn text(tool: &str, path: &Path) -> Result<String, Stop> {
    std::fs::read_to_string(path).map_err(|error| Stop::unwritten(tool, path, &error))
}

/// A file of a tool that is not what it should be. Where the disk is full, tools write a part of a file and end as if all were
/// well.
pub(crate) fn unreadable(tool: &str, file: &str, why: impl Display) -> Stop {
    let line = format!(
        "its {file} cannot be read: {why}; permitted: whole files; make space if the disk of the cache is full"
    );
    Stop::Broken { tool: tool.to_owned(), lines: vec![line] }
}

fn name(key: &[&str]) -> String {
    let mut hash = Sha256::new();
    for part in key.iter().chain([&FORMAT]) {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
}
