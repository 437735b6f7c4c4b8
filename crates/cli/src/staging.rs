//! Output directories in which nothing is ever half-written: files are made beside them and renamed at the end.

use anyhow::{Context, Result};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Files on their way into a directory.
pub struct Staging {
    target: PathBuf,
    made: TempDir,
}

impl Staging {
    /// Prepares a directory beside `target`; whatever goes wrong before [`Staging::publish`] leaves `target` untouched.
    pub fn new(target: &Path) -> Result<Self> {
        let parent = match target.parent() {
            Some(p) if !p.as_os_str().is_empty() => p,
            _ => Path::new("."),
        };
        std::fs::create_dir_all(parent).with_context(|| format!("--out {}", target.display()))?;
        let made = tempfile::Builder::new()
            .prefix(".edgewalk-")
            .tempdir_in(parent)
            .with_context(|| format!("--out {}", target.display()))?;
        Ok(Staging { target: target.to_owned(), made })
    }

    /// Where a file of that name (which may contain folders) is to be written now.
    pub fn path(&self, name: &str) -> Result<PathBuf> {
        let path = self.made.path().join(name);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).with_context(|| format!("{}", folder.display()))?;
        }
        Ok(path)
    }

    /// Writes a whole file.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> Result<()> {
        let path = self.path(name)?;
        std::fs::write(&path, contents).with_context(|| format!("{}", path.display()))
    }

    /// Moves everything into the target, replacing files of the same name and leaving others alone.
    pub fn publish(self) -> Result<()> {
        move_into(self.made.path(), &self.target)
    }
}

fn move_into(from: &Path, to: &Path) -> Result<()> {
    std::fs::create_dir_all(to).with_context(|| format!("{}", to.display()))?;
    for entry in std::fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            move_into(&entry.path(), &target)?;
        } else {
            std::fs::rename(entry.path(), &target).with_context(|| format!("{}", target.display()))?;
        }
    }
    Ok(())
}
