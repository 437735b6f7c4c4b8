//! Copies of the tree, in which faults are put.

use std::collections::BTreeMap;
use std::fs::Permissions;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// What a file holds, and who may do what with it: some are run.
#[derive(Clone, PartialEq, Hash)]
pub struct Content {
    pub bytes: Vec<u8>,
    mode: u32,
}

/// Files by path from the top of a tree.
pub type Files = BTreeMap<PathBuf, Content>;

/// The files of a tree by path from its top, without what is built, written or kept of versions, and without what this
/// campaign writes itself.
pub fn files(top: &Path) -> Result<Files> {
    const LEFT: [&str; 5] = ["target", "out", ".git", "docs/mutants.md", "tests/mutants/verdicts"];
    let mut found = BTreeMap::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(folder) = folders.pop() {
        let path = top.join(&folder);
        for entry in path.read_dir().with_context(|| path.display().to_string())? {
            let entry = entry?;
            let place = folder.join(entry.file_name());
            if LEFT.iter().any(|left| place == Path::new(left)) {
                continue;
            }
            if entry.file_type()?.is_dir() {
                folders.push(place);
            } else {
                let bytes = std::fs::read(entry.path()).with_context(|| place.display().to_string())?;
                let mode = entry.metadata()?.permissions().mode();
                found.insert(place, Content { bytes, mode });
            }
        }
    }
    Ok(found)
}

/// Makes a folder hold these files and no others. A file that is as it should be is left alone, so that it is not built again.
pub fn hold(top: &Path, wanted: &Files) -> Result<()> {
    std::fs::create_dir_all(top)?;
    let there = files(top)?;
    for place in there.keys().filter(|place| !wanted.contains_key(*place)) {
        std::fs::remove_file(top.join(place))?;
    }
    for (place, content) in wanted {
        if there.get(place) == Some(content) {
            continue;
        }
        let path = top.join(place);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        std::fs::write(&path, &content.bytes).with_context(|| path.display().to_string())?;
        std::fs::set_permissions(&path, Permissions::from_mode(content.mode))?;
    }
    Ok(())
}

/// A number for what the files hold and for words beside them: what was found of the same is found again.
pub fn key(files: &Files, words: &[&str]) -> String {
    let mut hasher = DefaultHasher::new();
    // This campaign's own files change no fault and no test, but for what is compiled in.
    let own = Path::new("tests/mutants");
    let counted = |place: &Path| !place.starts_with(own) || place.ends_with("switches.rs");
    for (place, content) in files.iter().filter(|(place, _)| counted(place)) {
        place.hash(&mut hasher);
        content.hash(&mut hasher);
    }
    words.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}
