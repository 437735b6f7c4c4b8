//! The patches of `docs/adding_a_unit.md` still fit this tree, and the document's figures are theirs.

use std::path::Path;

/// A file of the patch: its path, whether it is new, and the lines that each hunk expects to find.
struct Change<'a> {
    path: &'a str,
    new: bool,
    hunks: Vec<String>,
    added: usize,
    removed: usize,
}

fn changes(patch: &str) -> Vec<Change<'_>> {
    let mut changes: Vec<Change> = Vec::new();
    for line in patch.lines() {
        if line.starts_with("diff --git ") {
            changes.push(Change { path: "", new: false, hunks: Vec::new(), added: 0, removed: 0 });
            continue;
        }
        let change = changes.last_mut().expect("a patch begins with `diff`");
        if line == "--- /dev/null" {
            change.new = true;
        } else if let Some(path) = line.strip_prefix("+++ b/") {
            change.path = path;
        } else if line.starts_with("@@ ") {
            change.hunks.push(String::new());
        } else if let Some(hunk) = change.hunks.last_mut() {
            match line.split_at(1) {
                ("+", _) => change.added += 1,
                (kind, text) => {
                    change.removed += usize::from(kind == "-");
                    *hunk += text;
                    *hunk += "\n";
                }
            }
        }
    }
    changes
}

/// The patch of that name touches so many files, and each of its hunks finds its place.
fn applies_and_is_counted_right(name: &str, files: usize, least: usize, most_lines: usize) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let read = |path: &str| std::fs::read_to_string(root.join(path));
    let patch = read(&format!("docs/{name}.patch")).expect("the patch");
    let page = read("docs/adding_a_unit.md").expect("the document");
    let lines = patch.lines().count();
    assert!(lines < most_lines, "the patch has grown: {lines} lines");
    let changes = changes(&patch);
    let mut hunks = 0;
    for Change { path, new, hunks: expected, added, removed } in &changes {
        let row = format!("| `{path}` | {added} | {removed} |");
        assert!(page.contains(&row), "docs/adding_a_unit.md has no row {row}");
        if *new {
            assert!(!root.join(path).exists(), "{path} is there already");
            continue;
        }
        let text = read(path).unwrap_or_else(|_| panic!("{path} is gone"));
        let mut rest = text.as_str();
        for hunk in expected {
            let place = rest.find(hunk.as_str());
            let place = place.unwrap_or_else(|| panic!("{path} no longer has, in this order:\n{hunk}"));
            rest = &rest[place + hunk.len()..];
            hunks += 1;
        }
    }
    println!("{name}: {} files, {hunks} hunks", changes.len());
    assert!(hunks >= least, "only {hunks} hunks");
    assert_eq!(changes.len(), files);
    assert!(page.contains(&format!("**{files} files**")), "{files} files");
}

#[test]
fn a_unit_takes_nine_files() {
    applies_and_is_counted_right("adding_a_unit", 9, 18, 300);
}

#[test]
fn a_parameter_takes_five_files() {
    applies_and_is_counted_right("adding_a_parameter", 5, 6, 120);
}
