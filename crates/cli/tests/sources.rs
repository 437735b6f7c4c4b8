//! `docs/sources.md` resolves every label by which docs, code and gallery cite a source.

use crate::support::root;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const LAST_SYSTEM: u32 = 17;

fn texts(folder: &Path, found: &mut Vec<(PathBuf, String)>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let ends = path.extension().and_then(|end| end.to_str()).unwrap_or_default();
        if path.is_dir() && !path.ends_with("target") {
            texts(&path, found);
        } else if ["rs", "md", "toml", "tri", "js"].contains(&ends) {
            found.push((path.clone(), std::fs::read_to_string(&path).expect("text")));
        }
    }
}

/// The words of a text: letters, digits and underscores, with what follows each.
fn words(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let starts = text.char_indices().filter(move |(at, c)| is_part(*c) && !text[..*at].ends_with(is_part));
    starts.map(move |(at, _)| {
        let end = text[at..].find(|c| !is_part(c)).map_or(text.len(), |length| at + length);
        (&text[at..end], &text[end..])
    })
}

/// The number behind a word, if it is a whole one of at most two digits.
fn number_behind(rest: &str) -> Option<u32> {
    let rest = rest.strip_prefix([' ', '\n'])?;
    let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let fraction =
        rest[digits..].starts_with('.') && rest[digits + 1..].starts_with(|c: char| c.is_ascii_digit());
    if fraction || !(1..=2).contains(&digits) { None } else { rest[..digits].parse().ok() }
}

#[test]
fn every_label_is_told_in_sources() {
    let mut found = Vec::new();
    for folder in ["crates", "docs"] {
        texts(&root().join(folder), &mut found);
    }
    for file in ["README.md", "CHANGELOG.md"] {
        found.push((file.into(), std::fs::read_to_string(root().join(file)).expect("text")));
    }
    let sources = std::fs::read_to_string(root().join("docs/sources.md")).expect("text");
    let numerics = std::fs::read_to_string(root().join("docs/numerics.md")).expect("text");
    let (mut systems, mut bounds, mut named) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    for (file, text) in found.iter().filter(|(file, _)| !file.ends_with("tests/sources.rs")) {
        for (word, rest) in words(text) {
            let at = || format!("{}: {word}{}", file.display(), rest.chars().take(20).collect::<String>());
            if let Some(number) = word.strip_prefix('S').and_then(|n| n.parse::<u32>().ok()) {
                assert!((1..=LAST_SYSTEM).contains(&number), "{}", at());
                systems.insert(number);
            }
            if ["bound", "Bound", "bounds", "Bounds"].contains(&word)
                && let Some(number) = number_behind(rest).filter(|number| *number > 0)
            {
                assert!(numerics.contains(&format!("## Bound {number}: ")), "{}", at());
                bounds.insert(number);
            }
            // Names of texts that nothing in the project tells.
            let letter = rest.trim_start().chars().next().unwrap_or_default();
            let behind = rest.trim_start().chars().nth(1).is_none_or(|c| !c.is_alphanumeric());
            let alone = "ABC".contains(letter) && behind && rest.starts_with([' ', '\n']);
            assert!(!(["seed", "Seed"].contains(&word) && alone), "{}", at());
            for name in ["BW86"] {
                if word == name {
                    named.insert(name);
                }
            }
        }
        for name in ["the slides", "the notes", "ch. 7"] {
            if text.contains(name) {
                named.insert(name);
            }
        }
    }
    for number in &systems {
        assert!(sources.contains(&format!("\n| S{number} | ")), "S{number}");
    }
    for name in &named {
        assert!(sources.contains(name), "{name}");
    }
    let last = bounds.last().expect("bounds are cited");
    assert!(sources.contains(&format!("| bound 1 to bound {last} |")), "bound {last}");
    println!("{} systems, {} bounds, {} texts", systems.len(), bounds.len(), named.len());
    assert_eq!((systems.len(), named.len()), (LAST_SYSTEM as usize, 4));
    assert!(bounds.len() >= 17);
}
