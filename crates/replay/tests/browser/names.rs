//! The page knows no machine: no name of a unit, a link, a register or a field stands in it.

use crate::case::seven;
use edgewalk_replay::{Window, page};
use std::collections::BTreeSet;

/// Names that are words of the language, of the browser or of the format as well: the page means those.
const OTHER_MEANINGS: [(&str, &str); 12] = [
    ("span", "an element"),
    ("data", "of an image; the format's key"),
    ("count", "of tokens, the format's key"),
    ("value", "of an input; of a formula"),
    ("left", "of a box"),
    ("from", "of a link, the format's key; Array.from"),
    ("job", "of a schedule, the format's key"),
    ("phase", "of a unit, the format's key"),
    ("start", "of a cell of the lanes"),
    ("done", "a part of a bar, as a class"),
    ("head", "a method of tables"),
    ("taken", "a part of a bar"),
];

/// Whether the page asks for something by this name: as a property, a key or a text of its own.
fn asks_for(source: &str, name: &str) -> bool {
    source.match_indices(name).any(|(at, _)| {
        let before = source[..at].chars().next_back().unwrap_or(' ');
        let after = source[at + name.len()..].chars().next().unwrap_or(' ');
        let whole = !after.is_alphanumeric() && after != '_';
        let quoted = ['"', '\'', '`'].contains(&before) && after == before;
        let property = before == '.' && whole && !source[..at - 1].ends_with(['.', ' ', '\n']);
        quoted || property
    })
}

#[test]
fn no_name_of_the_machine_stands_in_the_page() {
    let source = page::source();
    let source = source.split_once("<script>").expect("a script").1;
    let mut names = BTreeSet::new();
    for case in seven() {
        let recording = case.recording(Window { from: 0, to: Some(400) });
        let structure = recording.view.structure();
        names.extend(structure.units.iter().map(|unit| unit.name.clone()));
        names.extend(structure.units.iter().map(|unit| unit.title.clone()));
        names.extend(structure.links.iter().map(|link| link.name.clone()));
        for kind in recording.view.tokens().kinds() {
            names.insert(kind.name.clone());
            names.extend(kind.fields.iter().map(|field| field.name.to_owned()));
        }
        for register in &structure.registers {
            // Of a cell row and column; single letters are everybody's.
            names.extend(register.name.split('.').map(str::to_owned));
        }
    }
    // What every replay has, whatever its machine.
    let generic = ["valid", "ready", "works", "says", "happens", "triangle", "cause"];
    let other = |name: &str| OTHER_MEANINGS.iter().any(|(own, _)| *own == name) || generic.contains(&name);
    let asked: Vec<&String> = names.iter().filter(|name| name.len() > 1 && !other(name)).collect();
    let known: Vec<_> = asked.iter().filter(|name| asks_for(source, name)).collect();
    println!("checked {} names in {} characters of script", asked.len(), source.len());
    assert!(known.is_empty(), "the page knows {known:?}");
    assert!(asked.len() > 60);
    assert!(
        asks_for("app.setup", "setup") && asks_for("x === 'edge'", "edge") && !asks_for("the edge", "edge")
    );
}
