//! A user's command, run on a design in a folder of its own.

use anyhow::{Context, Result, anyhow, bail};
use edgewalk_files::{Scratch, undisturbed};
use edgewalk_tool::{Stop, run};
use sha2::{Digest, Sha256};
use std::fs;
use std::os::unix::fs::symlink;
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
    /// The file of verdicts, which is no part of the folder.
    out: PathBuf,
    limit: Duration,
    free: Mutex<Vec<Scratch>>,
}

/// In the folder of a run: the design, and the copy of the user's folder.
const DESIGN: &str = "design";
const WORK: &str = "work";

impl Bench {
    /// The command and the folder that it needs; `out` is the file of verdicts.
    pub fn new(command: &str, folder: Option<&Path>, out: &Path, limit: Duration) -> Result<Bench> {
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            return Err(anyhow!("--in {}: no such folder", folder.display()));
        }
        let (command, folder) = (command.to_owned(), folder.map(Path::to_owned));
        Ok(Bench { command, folder, out: out.to_owned(), limit, free: Mutex::new(Vec::new()) })
    }

    /// What verdicts depend on, as a hash: the program, the machine, the design without a fault, the command and its folder.
    pub fn key(&self, machine: &str, design: &[(String, String)]) -> Result<String> {
        let mut hash = Sha256::new();
        let mut add = |bytes: &[u8]| {
            hash.update((bytes.len() as u64).to_le_bytes());
            hash.update(bytes);
        };
        let design = design.iter().flat_map(|(name, text)| [name.as_str(), text]);
        [env!("CARGO_PKG_VERSION"), machine, &self.command]
            .into_iter()
            .chain(design)
            .for_each(|text| add(text.as_bytes()));
        for Entry { name, path, kind } in self.entries()? {
            add(name.as_os_str().as_encoded_bytes());
            match kind {
                Kind::Folder => add(b"folder"),
                Kind::File => add(&fs::read(&path).with_context(|| path.display().to_string())?),
                Kind::Link(of) => add(of.as_os_str().as_encoded_bytes()),
            }
        }
        Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
    }

    /// What the user's folder holds, but for the verdicts.
    fn entries(&self) -> Result<Vec<Entry>> {
        let Some(folder) = &self.folder else { return Ok(Vec::new()) };
        // The file may not be there yet.
        let place = self.out.parent().and_then(|parent| fs::canonicalize(parent).ok());
        let out = place.zip(self.out.file_name()).map(|(place, name)| place.join(name));
        entries(folder, out.as_deref())
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
        for Entry { name, path, kind } in self.entries()? {
            let copy = work.join(name);
            let _undisturbed = undisturbed();
            let copied = match kind {
                Kind::Folder => fs::create_dir(&copy),
                Kind::File => fs::copy(&path, &copy).map(|_| ()),
                Kind::Link(of) => symlink(self.copied(&of, &work), &copy),
            };
            copied.with_context(|| path.display().to_string())?;
        }
        Ok(place)
    }

    /// What a link in the copy names: within the user's folder the copy's own, elsewhere the same.
    fn copied(&self, of: &Path, work: &Path) -> PathBuf {
        let folder = self.folder.as_ref().and_then(|folder| fs::canonicalize(folder).ok());
        let within = folder.and_then(|folder| Some(of.strip_prefix(folder).ok()?.to_owned()));
        within.map_or_else(|| of.to_owned(), |within| work.join(within))
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

/// What stands in a folder.
enum Kind {
    Folder,
    /// A file, or a link to one.
    File,
    /// A link to a folder, or to nothing: what it names.
    Link(PathBuf),
}

/// A file, folder or link in the user's folder.
struct Entry {
    /// By which it is known there.
    name: PathBuf,
    path: PathBuf,
    kind: Kind,
}

impl Entry {
    /// The kind of what stands at `path`; None for the file `out`, which the run itself writes.
    fn new(name: PathBuf, path: PathBuf, out: Option<&Path>) -> Result<Option<Entry>> {
        let is_link = fs::symlink_metadata(&path)?.is_symlink();
        let kind = match fs::metadata(&path) {
            Ok(there) if there.is_file() => Kind::File,
            Ok(there) if there.is_dir() && is_link => Kind::Link(fs::canonicalize(&path)?),
            Ok(there) if there.is_dir() => Kind::Folder,
            Ok(_) => bail!("a pipe, a socket or a device; permitted: files, folders and links; remove it"),
            Err(_) if is_link => Kind::Link(fs::read_link(&path)?),
            Err(error) => return Err(error.into()),
        };
        let written_here =
            matches!(kind, Kind::File) && out.is_some() && fs::canonicalize(&path).ok().as_deref() == out;
        Ok(Some(Entry { name, path, kind }).filter(|_| !written_here))
    }
}

/// What stands in a folder and in those below it, sorted by name: a folder before what is in it.
fn entries(folder: &Path, out: Option<&Path>) -> Result<Vec<Entry>> {
    let mut found = Vec::new();
    let mut waiting = vec![PathBuf::new()];
    while let Some(within) = waiting.pop() {
        let named = || format!("--in {}", folder.join(&within).display());
        for entry in fs::read_dir(folder.join(&within)).with_context(named)? {
            let name = within.join(entry.with_context(named)?.file_name());
            let path = folder.join(&name);
            let shown = format!("--in {}", path.display());
            let Some(entry) = Entry::new(name, path, out).context(shown)? else { continue };
            if matches!(entry.kind, Kind::Folder) {
                waiting.push(entry.name.clone());
            }
            found.push(entry);
        }
    }
    found.sort_by(|one, other| one.name.cmp(&other.name));
    Ok(found)
}
