//! Folders that do not outlive the program, even where SIGHUP, SIGINT or SIGTERM ends it.
//!
//! A signal waits for what must not be cut short (a guard of [`undisturbed`], the making of a file or folder), ends the
//! tools that run, removes every scratch folder and ends the program as it would have without a handler. From then on nothing is made any more.

use anyhow::{Context, Result};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};
use std::time::Duration;

/// Folders to remove: scratch folders with all that is in them, and those that were made for them if they are empty.
static LIVE: RwLock<Vec<Leftover>> = RwLock::new(Vec::new());

#[derive(Clone, PartialEq)]
struct Leftover {
    scratch: PathBuf,
    /// Made on the way there, the outermost first.
    made: Vec<PathBuf>,
}

/// A folder that is removed with all that is in it.
pub struct Scratch(Leftover);

impl Scratch {
    /// A new folder `.edgewalk-...` in `folder`, which is made, and its parents too, where there is none.
    pub fn within(folder: &Path) -> io::Result<Self> {
        let mut live = exclusive();
        let made = make(folder)?;
        let made_here = tempfile::Builder::new().prefix(".edgewalk-").tempdir_in(folder);
        match made_here {
            Ok(scratch) => {
                let leftover = Leftover { scratch: scratch.keep(), made };
                live.push(leftover.clone());
                Ok(Scratch(leftover))
            }
            Err(error) => {
                remove_empty(&made);
                // Without the name that was tried: it says nothing to anyone.
                Err(error.kind().into())
            }
        }
    }

    /// One where the system keeps such folders.
    pub fn temporary() -> Result<Self> {
        let folder = std::env::temp_dir();
        Self::within(&folder).with_context(|| format!("a folder in {}", folder.display()))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0.scratch
    }

    /// A new file in it, with its folders.
    pub fn create(&self, name: &Path) -> io::Result<File> {
        let _undisturbed = undisturbed();
        let path = self.path().join(name);
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        File::create(path)
    }

    /// Removes the scratch folder, and leaves those that were made for it.
    pub fn keep_parents(mut self) {
        exclusive().iter_mut().filter(|live| **live == self.0).for_each(|live| live.made.clear());
        self.0.made.clear();
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let mut live = exclusive();
        live.retain(|live| *live != self.0);
        self.0.remove();
    }
}

impl Leftover {
    fn remove(&self) {
        // A tool that is being ended, or a thread of the program, may write between the listing and the removal.
        for _ in 0..20 {
            if fs::remove_dir_all(&self.scratch).is_ok() || !self.scratch.exists() {
                break;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        remove_empty(&self.made);
    }
}

/// No signal ends the program while the guard lives. A thread must not hold two.
pub fn undisturbed() -> RwLockReadGuard<'static, impl Sized> {
    LIVE.read().unwrap_or_else(PoisonError::into_inner)
}

fn exclusive() -> RwLockWriteGuard<'static, Vec<Leftover>> {
    LIVE.write().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the tools that run and removes what is left when a signal ends the program, from now on.
pub fn watch_signals() -> Result<()> {
    let mut signals = Signals::new([SIGINT, SIGTERM]).context("signals")?;
    if !hangup_is_ignored() {
        signals.add_signal(SIGHUP).context("signals")?;
    }
    std::thread::spawn(move || {
        for signal in signals.forever() {
            // Held to the end.
            let live = exclusive();
            edgewalk_tool::end_all();
            live.iter().for_each(Leftover::remove);
            // It ends the program; there is nothing to do if even that fails.
            let _ = emulate_default_handler(signal);
        }
    });
    Ok(())
}

/// Whether the program was started to ignore SIGHUP, as `nohup` starts it. It counts as ignored where the system does not say.
fn hangup_is_ignored() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    // Signal n is bit n - 1.
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .is_none_or(|mask| mask >> (SIGHUP - 1) & 1 == 1)
}

/// Makes a folder with its parents, and gives those that were not there, the outermost first.
pub fn make(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let missing = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
    let mut folders: Vec<&Path> = folder.ancestors().take_while(missing).collect();
    folders.reverse();
    let mut made = Vec::new();
    for folder in folders {
        match fs::create_dir(folder) {
            Ok(()) => made.push(folder.to_owned()),
            Err(_) if folder.is_dir() => {}
            Err(error) => {
                remove_empty(&made);
                return Err(error);
            }
        }
    }
    Ok(made)
}

/// Removes folders, the last first, as far as nothing is in them.
pub fn remove_empty(folders: &[PathBuf]) {
    for folder in folders.iter().rev() {
        let _ = fs::remove_dir(folder);
    }
}
