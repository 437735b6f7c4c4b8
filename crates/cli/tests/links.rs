//! Every relative link of a page leads to a file, every anchor to a heading or a named place, every section number to a section.

use crate::support::root;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The pages: README and its like, and all below `docs`.
fn pages() -> Vec<PathBuf> {
    let markdown = |path: &PathBuf| path.extension().is_some_and(|end| end == "md");
    let mut waiting = vec![root().join("docs"), root().join("hdl")];
    let top = std::fs::read_dir(root()).expect("the repository");
    let mut pages: Vec<PathBuf> = top.map(|entry| entry.expect("an entry").path()).filter(markdown).collect();
    while let Some(folder) = waiting.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                waiting.push(path);
            } else if markdown(&path) {
                pages.push(path);
            }
        }
    }
    pages
}

/// A page without what stands in fenced blocks and in inline code.
fn without_code(text: &str) -> String {
    let mut fenced = false;
    let lines = text.lines().filter(|line| {
        let fence = line.starts_with("```");
        fenced ^= fence;
        !fence && !fenced
    });
    lines.map(|line| line.split('`').step_by(2).collect::<Vec<_>>().join("") + "\n").collect()
}

/// The anchors of a page, as the usual viewers make them of headings, and those that it names itself.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut fenced = false;
    for line in text.lines() {
        fenced ^= line.starts_with("```");
        if let Some(title) = line.strip_prefix('#').filter(|_| !fenced) {
            let title = title.trim_start_matches('#').trim().to_lowercase();
            let kept = title.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
            let name: String = kept.map(|c| if c == ' ' { '-' } else { c }).collect();
            let again = (1..).map(|count| format!("{name}-{count}"));
            let mut names = std::iter::once(name.clone()).chain(again);
            found.insert(names.find(|name| !found.contains(name)).expect("one is free"));
        }
        for part in line.split("<a id=\"").skip(1) {
            found.insert(part.split('"').next().expect("a name").to_owned());
        }
    }
    found
}

/// What is wrong with a link of the page at `from`.
fn fault(from: &Path, target: &str) -> Option<String> {
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let path = if file.is_empty() { from.to_owned() } else { from.parent().expect("a folder").join(file) };
    if !path.exists() {
        return Some("no such file".to_owned());
    }
    if anchor.is_empty() || path.extension().is_none_or(|end| end != "md") {
        return None;
    }
    let there = anchors(&std::fs::read_to_string(&path).expect("text"));
    (!there.contains(anchor)).then(|| format!("no such anchor, only {there:?}"))
}

#[test]
fn every_relative_link_leads_somewhere() {
    let (mut links, mut faults) = (0, Vec::new());
    let pages = pages();
    for page in &pages {
        let text = without_code(&std::fs::read_to_string(page).expect("text"));
        for part in text.split("](").skip(1) {
            let target = part.split(')').next().expect("a link ends");
            if target.contains("://") {
                continue;
            }
            links += 1;
            if let Some(fault) = fault(page, target) {
                faults.push(format!("{}: {target}: {fault}", page.display()));
            }
        }
    }
    println!("{links} links of {} pages", pages.len());
    assert!(links > 200 && pages.len() > 20);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_link_that_leads_nowhere_is_found() {
    let readme = root().join("README.md");
    assert_eq!(fault(&readme, "docs/machine.md#20-ports"), None);
    assert!(fault(&readme, "docs/nowhere.md").is_some());
    assert!(fault(&readme, "docs/machine.md#21-nothing-of-the-kind").is_some());
}

#[test]
fn every_page_stands_in_the_index() {
    let index = std::fs::read_to_string(root().join("docs/README.md")).expect("the index");
    let mut checked = 0;
    for page in pages() {
        let Ok(name) = page.strip_prefix(root().join("docs")) else { continue };
        if name == Path::new("README.md") {
            continue;
        }
        assert!(
            index.contains(&format!("({})", name.display())),
            "docs/README.md does not name {}",
            name.display()
        );
        checked += 1;
    }
    assert!(checked > 20, "{checked}");
}

#[test]
fn every_section_that_is_cited_exists() {
    let machine = std::fs::read_to_string(root().join("docs/machine.md")).expect("the specification");
    let there: BTreeSet<u32> = machine
        .lines()
        .filter_map(|line| line.strip_prefix("## ")?.split('.').next()?.parse().ok())
        .collect();
    let mut cited = 0;
    for page in pages() {
        let text = without_code(&std::fs::read_to_string(&page).expect("text"));
        for part in text.split("section ").skip(1) {
            let digits = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
            if let Ok(number) = part[..digits].parse() {
                assert!(there.contains(&number), "{}: section {number}", page.display());
                cited += 1;
            }
        }
    }
    println!("{cited} citations of {} sections", there.len());
    assert!(cited > 30);
}

#[test]
fn lines_of_pages_are_short() {
    let mut checked = 0;
    for page in pages() {
        let name = page.strip_prefix(root()).expect("below the root").display().to_string();
        let mut fenced = false;
        for line in std::fs::read_to_string(&page).expect("text").lines() {
            let fence = line.starts_with("```");
            fenced ^= fence;
            let prose = !fence && !fenced && !line.starts_with(['|', '#']);
            assert!(!prose || line.chars().count() <= 120, "{name}: {line}");
            checked += 1;
        }
    }
    println!("{checked} lines");
    assert!(checked > 1000, "{checked}");
}
