//! The files of a user's design, found on disk.

use super::error::DutError;
use super::reader::Section;
use std::path::{Path, PathBuf};

/// The files of the list, in its order; of a pattern `*.v` those of its folder, sorted by name.
pub(super) fn found(section: &Section, list: Vec<String>, folder: &Path) -> Result<Vec<PathBuf>, DutError> {
    let mut files = Vec::new();
    for name in &list {
        let matching = matching(&folder.join(name))
            .map_err(|error| section.error("files", format!("{name:?}: {error}"), "files that are there"))?;
        if matching.is_empty() {
            return Err(section.error("files", format!("{name:?}: no such file"), "files that are there"));
        }
        files.extend(matching);
    }
    for file in &files {
        plain(section, "files", file)?;
        if !file.extension().is_some_and(|end| end == "v" || end == "sv") {
            return Err(section.error("files", format!("{:?}", file.display().to_string()), "*.v, *.sv"));
        }
    }
    match files.is_empty() {
        true => Err(section.error("files", "[]", "one file or more")),
        false => Ok(files),
    }
}

/// The folders of the list.
pub(super) fn folders(section: &Section, list: Vec<String>, folder: &Path) -> Result<Vec<PathBuf>, DutError> {
    let mut folders = Vec::new();
    for name in &list {
        let path = folder.join(name);
        if !path.is_dir() {
            return Err(section.error(
                "include",
                format!("{name:?}: no such folder"),
                "folders that are there",
            ));
        }
        plain(section, "include", &path)?;
        folders.push(path);
    }
    Ok(folders)
}

fn matching(path: &Path) -> std::io::Result<Vec<PathBuf>> {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let Some((before, after)) = name.split_once('*') else {
        return Ok(if path.is_file() { vec![path.to_owned()] } else { Vec::new() });
    };
    let entries = std::fs::read_dir(path.parent().unwrap_or(Path::new(".")))?;
    let paths = entries.map(|entry| entry.map(|entry| entry.path())).collect::<std::io::Result<Vec<_>>>()?;
    let fits = |path: &PathBuf| {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        name.len() >= before.len() + after.len() && name.starts_with(before) && name.ends_with(after)
    };
    let mut paths: Vec<PathBuf> = paths.into_iter().filter(|path| path.is_file() && fits(path)).collect();
    paths.sort();
    Ok(paths)
}

/// The path goes into a Makefile and command files of tools, where other signs have a meaning.
fn plain(section: &Section, key: &str, path: &Path) -> Result<(), DutError> {
    let text = path.to_str().unwrap_or("\u{fffd}");
    if text.chars().all(|c| c.is_alphanumeric() || "/._-+,=@".contains(c)) {
        return Ok(());
    }
    let permitted = "paths of letters, digits and / . _ - + , = @";
    Err(section
        .error(key, format!("{text:?}"), permitted)
        .advised("move the files, or make a link to their folder"))
}
