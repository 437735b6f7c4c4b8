//! The file of the page: it appears as a whole, or not at all.

use anyhow::{Context as _, Result, ensure};
use edgewalk_files::Staging;
use std::fs::canonicalize;
use std::path::Path;

/// Where the page goes, checked before anything is drawn.
pub struct PageFile<'f> {
    staging: Staging,
    name: &'f str,
}

impl<'f> PageFile<'f> {
    /// The file that `--page` names; `out` is the folder of these other files.
    ///
    /// # Errors
    /// No file can be written there, or it is one of the other files or an input that was read.
    pub fn new(file: &'f Path, (out, others): (&Path, &[&str])) -> Result<PageFile<'f>> {
        let given = || format!("--page {}", file.display());
        let name = file.file_name().and_then(|name| name.to_str()).with_context(|| {
            format!("{}: the path names no file; permitted: a path that ends in a name, as p.html", given())
        })?;
        let folder = file.parent().filter(|path| !path.as_os_str().is_empty()).unwrap_or(Path::new("."));
        ensure!(
            folder.is_dir(),
            "{}: the folder {} is not there; permitted: a file in a folder that is there; make the folder first",
            given(),
            folder.display()
        );
        ensure!(
            !file.is_dir(),
            "{}: a folder stands there; permitted: a regular file or a new name; give another name",
            given()
        );
        let same = canonicalize(folder).ok().is_some_and(|folder| canonicalize(out).ok() == Some(folder));
        ensure!(
            !(same && others.contains(&name)),
            "{}: the command writes {name} into --out itself; permitted: a name other than {}; give another name",
            given(),
            others.join(" and ")
        );
        let staging = Staging::within(folder, given)?;
        // What is no regular file is refused here.
        staging.create(name).with_context(given)?;
        staging.accept([name]).with_context(given)?;
        Ok(PageFile { staging, name })
    }

    /// Writes the page.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn publish(self, page: &str) -> Result<()> {
        self.staging.write(self.name, page)?;
        self.staging.publish(&[self.name])
    }
}
