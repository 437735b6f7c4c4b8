//! Copies of the tree, in which faults are put.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs::Permissions;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// What a file holds, and who may do what with it: some are run.
#[derive(Clone, PartialEq, Hash)]
pub struct Content {
    /// Of a symbolic link: where it points.
    pub bytes: Vec<u8>,
    /// Bits of the permissions; none of a symbolic link.
    mode: Option<u32>,
}

/// Files by path from the top of a tree.
pub type Files = BTreeMap<PathBuf, Content>;

/// The files of a tree by path from its top, without what is built, written or kept of versions, and without the verdicts
/// of this campaign.
pub fn files(top: &Path) -> Result<Files> {
    const LEFT: [&str; 4] = ["target", "out", ".git", "tests/mutants/verdicts"];
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
            let kind = entry.file_type()?;
            if kind.is_dir() {
                folders.push(place);
            } else if kind.is_symlink() {
                let bytes = std::fs::read_link(entry.path())?.into_os_string().into_vec();
                found.insert(place, Content { bytes, mode: None });
            } else {
                let bytes = std::fs::read(entry.path()).with_context(|| place.display().to_string())?;
                let mode = Some(entry.metadata()?.permissions().mode());
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
        if there.contains_key(place) {
            std::fs::remove_file(&path)?;
        }
        let Some(mode) = content.mode else {
            symlink(OsStr::from_bytes(&content.bytes), &path).with_context(|| path.display().to_string())?;
            continue;
        };
        std::fs::write(&path, &content.bytes).with_context(|| path.display().to_string())?;
        std::fs::set_permissions(&path, Permissions::from_mode(mode))?;
    }
    Ok(())
}

/// A number for what the files hold and for words beside them: what was found of the same is found again.
pub fn key(files: &Files, words: &[&str]) -> String {
    let mut hasher = DefaultHasher::new();
    // This campaign's own files change no fault and no test, but for what is compiled in.
    let own = |place: &Path| place.starts_with("tests/mutants") || place == Path::new("docs/mutants.md");
    let counted = |place: &Path| !own(place) || place.ends_with("switches.rs");
    for (place, content) in files.iter().filter(|(place, _)| counted(place)) {
        place.hash(&mut hasher);
        content.hash(&mut hasher);
    }
    words.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_has_the_files_and_links_of_the_tree() -> Result<()> {
        let folder = std::env::temp_dir().join(format!("edgewalk-tree-{}", std::process::id()));
        let [tree, copy] = ["tree", "copy"].map(|name| folder.join(name));
        std::fs::create_dir_all(tree.join("docs"))?;
        std::fs::write(tree.join("docs/scene"), "red")?;
        symlink("docs", tree.join("scenes"))?;
        let wanted = files(&tree)?;
        assert_eq!(wanted.len(), 2);
        // The second time into a copy where a file is a link and the link leads elsewhere.
        for _ in 0..2 {
            hold(&copy, &wanted)?;
            assert!(files(&copy)? == wanted);
            assert_eq!(std::fs::read(copy.join("scenes/scene"))?, b"red");
            std::fs::remove_file(copy.join("docs/scene"))?;
            symlink(tree.join("docs/scene"), copy.join("docs/scene"))?;
            std::fs::remove_file(copy.join("scenes"))?;
            symlink("elsewhere", copy.join("scenes"))?;
        }
        assert_eq!(std::fs::read(tree.join("docs/scene"))?, b"red");
        std::fs::remove_dir_all(&folder)?;
        Ok(())
    }
}
