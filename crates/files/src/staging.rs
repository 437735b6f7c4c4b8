//! Output folders in which a run's files appear all together or not at all.
//!
//! Files are made in a scratch folder inside the target, so that a rename never leaves its file system, and renamed at
//! the end. What a rename replaces or removes is kept in the scratch folder until the last one has succeeded; if one
//! fails, all are undone.

use crate::scratch::{self, Scratch};
use anyhow::{Context, Result, anyhow};
use edgewalk_scene::inputs;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write as _};
use std::os::unix::fs::FileTypeExt as _;
use std::path::{Path, PathBuf};

/// Files on their way into a folder.
pub struct Staging {
    target: PathBuf,
    scratch: Scratch,
}

/// In the scratch folder: what is new, and what was there before.
const NEW: &str = "new";
const OLD: &str = "old";

impl Staging {
    /// Prepares the way into `target`; whatever goes wrong before [`Staging::publish`] leaves everything as it was.
    pub fn new(target: &Path) -> Result<Self> {
        Self::within(target, || format!("--out {}", target.display()))
    }

    /// Like `new`, for a folder that the user gave in another way; `given` says how in an error.
    pub fn within(target: &Path, given: impl FnOnce() -> String) -> Result<Self> {
        let scratch = Scratch::within(target).with_context(given)?;
        Ok(Staging { target: target.to_owned(), scratch })
    }

    /// A new file of that name (which may contain folders).
    ///
    /// # Errors
    /// A pipe, socket or device stands in its place, or a link to one: such are never replaced. A link to a file is.
    pub fn create(&self, name: &str) -> Result<BufWriter<File>> {
        if let Some(kind) = special(&self.target.join(name)) {
            return Err(anyhow!(
                "{}: a {kind} stands there; permitted: a regular file or a new name",
                self.name(name)
            ));
        }
        let file = self.scratch.create(&Path::new(NEW).join(name));
        Ok(BufWriter::with_capacity(1 << 16, file.with_context(|| self.name(name))?))
    }

    /// A file without a name, to be written and then read again; on the disk of the target, as memory may be too small for it.
    pub fn nameless(&self) -> Result<File> {
        tempfile::tempfile_in(self.scratch.path()).with_context(|| self.target.display().to_string())
    }

    /// What messages call the file: its place in the target.
    pub fn name(&self, name: &str) -> String {
        self.target.join(name).display().to_string()
    }

    /// Writes a whole file.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> Result<()> {
        let mut file = self.create(name)?;
        file.write_all(contents.as_ref()).and_then(|()| file.flush()).with_context(|| self.name(name))
    }

    /// Accepts names of files to replace or to remove. A link may go: what it names stays.
    ///
    /// # Errors
    /// One of them is an input of this run.
    pub fn accept(&self, names: impl IntoIterator<Item = impl AsRef<Path>>) -> Result<()> {
        let places = names.into_iter().map(|name| self.target.join(name));
        let mut files =
            places.filter(|place| fs::symlink_metadata(place).is_ok_and(|there| !there.is_symlink()));
        files.find(|place| inputs::was_read(place)).map_or(Ok(()), |place| {
            Err(anyhow!(
                "{}: this run reads this file, and would replace or remove it; permitted: a place without such a file; \
                 give the output another folder or name",
                place.display()
            ))
        })
    }

    /// Moves everything into the target. `own` are the files that this command may write: those that it did not write
    /// this time are of an earlier run, and removed; nothing else is touched. Links to folders in the target are not
    /// followed: a new file behind one is an error, an old one stays.
    ///
    /// # Errors
    /// Nothing is moved if a file cannot be placed, or if an input of this run would be lost. An input that would be
    /// replaced by the same bytes is not lost; [`Staging::accept`], before they are known, refuses it.
    pub fn publish(self, own: &[impl AsRef<str>]) -> Result<()> {
        let undisturbed = scratch::undisturbed();
        let mut names = BTreeSet::new();
        let new = self.scratch.path().join(NEW);
        list(&new, Path::new(""), &mut names).with_context(|| self.target.display().to_string())?;
        let behind_a_link = |name: &PathBuf| Some((name.clone(), link_on_the_way(&self.target, name)?));
        if let Some((name, link)) = names.iter().find_map(behind_a_link) {
            return Err(anyhow!(
                "{}: is a link, and below --out files are written into folders only; remove the link, or give --out the \
                 folder that it names ({} was to be written)",
                link.display(),
                name.display()
            ));
        }
        let stale = own.iter().map(|name| PathBuf::from(name.as_ref())).filter(|name| {
            let there = fs::symlink_metadata(self.target.join(name));
            !names.contains(name)
                && there.is_ok_and(|there| there.is_file() || there.is_symlink())
                && link_on_the_way(&self.target, name).is_none()
        });
        let stale: Vec<PathBuf> = stale.collect();
        let lost = |name: &&PathBuf| !same(&new.join(name), &self.target.join(name));
        self.accept(names.iter().chain(&stale).filter(lost))?;
        let mut moves = Moves { old: self.scratch.path().join(OLD), done: Vec::new(), made: Vec::new() };
        let replace = |name: &PathBuf| moves.replace(&new.join(name), &self.target.join(name));
        let moved = names.iter().try_for_each(replace);
        let moved =
            moved.and_then(|()| stale.iter().try_for_each(|name| moves.put_away(&self.target.join(name))));
        match moved {
            Ok(()) => {
                drop(undisturbed);
                self.scratch.keep_parents();
                Ok(())
            }
            Err(error) => {
                moves.undo();
                Err(error)
            }
        }
    }
}

/// The kind of what stands there, behind links too, if it is neither file nor folder.
fn special(path: &Path) -> Option<&'static str> {
    let kind = fs::metadata(path).ok()?.file_type();
    if kind.is_file() || kind.is_dir() {
        None
    } else if kind.is_fifo() {
        Some("pipe")
    } else if kind.is_socket() {
        Some("socket")
    } else {
        Some("device")
    }
}

/// The first link among the folders between the target and a file in it.
fn link_on_the_way(target: &Path, name: &Path) -> Option<PathBuf> {
    let mut folders: Vec<PathBuf> = name.ancestors().skip(1).map(|folder| target.join(folder)).collect();
    folders.pop(); // the target itself, which may be a link
    let is_link = |path: &PathBuf| fs::symlink_metadata(path).is_ok_and(|there| there.is_symlink());
    folders.into_iter().rev().find(is_link)
}

/// Whether both files hold the same bytes.
fn same(one: &Path, other: &Path) -> bool {
    matches!((fs::read(one), fs::read(other)), (Ok(one), Ok(other)) if one == other)
}

/// The files under a folder, without its name.
fn list(folder: &Path, within: &Path, names: &mut BTreeSet<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = within.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            list(&entry.path(), &name, names)?;
        } else {
            names.insert(name);
        }
    }
    Ok(())
}

/// Renames that can be undone.
struct Moves {
    /// Where files go that are replaced or removed.
    old: PathBuf,
    /// From where to where.
    done: Vec<(PathBuf, PathBuf)>,
    /// Folders that were not there.
    made: Vec<PathBuf>,
}

impl Moves {
    fn replace(&mut self, new: &Path, target: &Path) -> Result<()> {
        let at = || target.display().to_string();
        if let Some(folder) = target.parent() {
            self.made.extend(scratch::make(folder).with_context(at)?);
        }
        match fs::symlink_metadata(target) {
            Ok(there) if there.is_dir() => {
                return Err(anyhow!(
                    "{}: is a folder where a file must be written; remove it, or choose another --out",
                    at()
                ));
            }
            Ok(_) => self.put_away(target)?,
            Err(_) => {}
        }
        self.rename(new, target).with_context(at)
    }

    fn put_away(&mut self, target: &Path) -> Result<()> {
        let away = self.old.join(self.done.len().to_string());
        let moved = fs::create_dir_all(&self.old).and_then(|()| self.rename(target, &away));
        moved.with_context(|| target.display().to_string())
    }

    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)?;
        self.done.push((from.to_owned(), to.to_owned()));
        Ok(())
    }

    /// Back from the last to the first. What fails even here cannot be helped.
    fn undo(self) {
        for (from, to) in self.done.iter().rev() {
            let _ = fs::rename(to, from);
        }
        scratch::remove_empty(&self.made);
    }
}
