//! A user's command, run on a design in a folder of its own.

use anyhow::{Context, Result, anyhow};
use edgewalk_files::{Scratch, undisturbed};
use edgewalk_tool::{Stop, run};
use sha2::{Digest, Sha256};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How a run ended.
pub enum Ended {
    /// With exit code 0.
    Passed,
    /// With another; what it printed first.
    Failed(Vec<String>),
    /// Not within the limit.
    Late,
}

impl Ended {
    /// The word for a design with a fault.
    pub fn word(&self) -> &'static str {
        match self {
            Ended::Passed => "survived",
            Ended::Failed(_) => "found",
            Ended::Late => "found by time",
        }
    }
}

/// The command, and folders in which it may run side by side.
pub struct Bench {
    command: String,
    folder: Option<PathBuf>,
    limit: Duration,
    free: Mutex<Vec<Scratch>>,
}

/// In the folder of a run: the design, and the copy of the user's folder.
const DESIGN: &str = "design";
const WORK: &str = "work";

impl Bench {
    /// The command and the folder that it needs.
    pub fn new(command: &str, folder: Option<&Path>, limit: Duration) -> Result<Bench> {
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            return Err(anyhow!("--in {}: no such folder", folder.display()));
        }
        let (command, folder) = (command.to_owned(), folder.map(Path::to_owned));
        Ok(Bench { command, folder, limit, free: Mutex::new(Vec::new()) })
    }

    /// What verdicts depend on, as a hash.
    pub fn key(&self, machine: &str, unit: &str, around: Option<&str>) -> Result<String> {
        let mut hash = Sha256::new();
        let mut add = |bytes: &[u8]| {
            hash.update((bytes.len() as u64).to_le_bytes());
            hash.update(bytes);
        };
        [machine, unit, around.unwrap_or(""), &self.command].iter().for_each(|text| add(text.as_bytes()));
        if let Some(folder) = &self.folder {
            for (name, path) in files(folder)? {
                add(name.to_string_lossy().as_bytes());
                add(&fs::read(&path).with_context(|| path.display().to_string())?);
            }
        }
        Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
    }

    /// Runs the command on a design: name and text of its files.
    pub fn run(&self, design: &[(String, String)]) -> Result<Ended> {
        let free = self.free.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let place = free.map_or_else(|| self.place(), Ok)?;
        let ended = self.run_in(place.path(), design);
        self.free.lock().unwrap_or_else(PoisonError::into_inner).push(place);
        ended
    }

    /// A new folder with a copy of what the command needs.
    fn place(&self) -> Result<Scratch> {
        let place = Scratch::temporary()?;
        let work = place.path().join(WORK);
        fs::create_dir(&work)?;
        for (name, path) in
            self.folder.iter().map(|folder| files(folder)).collect::<Result<Vec<_>>>()?.concat()
        {
            let copy = work.join(name);
            let _undisturbed = undisturbed();
            let copied =
                copy.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::copy(&path, &copy));
            copied.with_context(|| path.display().to_string())?;
        }
        Ok(place)
    }

    fn run_in(&self, place: &Path, design: &[(String, String)]) -> Result<Ended> {
        let folder = place.join(DESIGN);
        {
            // Behind a signal's removal the folder must not come again.
            let _undisturbed = undisturbed();
            fs::create_dir_all(&folder)?;
        }
        let mut names = Vec::new();
        for (name, text) in design {
            let path = folder.join(name);
            fs::write(&path, text).with_context(|| path.display().to_string())?;
            names.push(path.display().to_string());
        }
        let command = self.command.replace("{hdl}", &names.join(" "));
        let mut shell = Command::new("sh");
        shell.args(["-c", &command]).current_dir(place.join(WORK));
        match run(&mut shell, self.limit) {
            Ok(_) => Ok(Ended::Passed),
            Err(Stop::Broken { lines, .. }) => Ok(Ended::Failed(lines)),
            Err(Stop::TimeLimit { .. }) => Ok(Ended::Late),
            Err(missing) => Err(missing.into()),
        }
    }
}

/// The files of a folder and of those in it, by their names there, sorted.
fn files(folder: &Path) -> Result<Vec<(PathBuf, PathBuf)>> {
    fn walk(folder: &Path, within: &Path, found: &mut Vec<(PathBuf, PathBuf)>) -> std::io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            let name = within.join(entry.file_name());
            match entry.file_type()?.is_dir() {
                true => walk(&entry.path(), &name, found)?,
                false => found.push((name, entry.path())),
            }
        }
        Ok(())
    }
    let mut found = Vec::new();
    walk(folder, Path::new(""), &mut found).with_context(|| format!("--in {}", folder.display()))?;
    found.sort();
    Ok(found)
}
