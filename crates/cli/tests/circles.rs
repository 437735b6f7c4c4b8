//! Files of a crate that use one another in a circle, by their `use` lines and the paths in their text
//! (`docs/architecture.md`, "Circles of files").

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Circles beyond a folder that there may be, as a whole or in part; `docs/architecture.md` gives the reason of each.
const KNOWN: &[(&str, &[&str])] = &[
    ("machine", &["blend", "dither", "extra", "key", "machine", "polygon", "shade", "shadow"]),
    ("machine", &["role", "vertex"]),
];

/// Crates in which a file and those of its folder may use one another: they are one subject. The other crates have no circle.
const ONE_SUBJECT: &[&str] =
    &["vectors", "golden", "scene", "netlist", "numerics", "explore", "rtl", "host", "lockstep", "judge"];

/// The path of a module below its crate; a crate's own file has none.
type Module = Vec<String>;

/// A crate's files.
#[derive(Default)]
struct Crate {
    /// What each file says outside its unit tests and comments.
    text: BTreeMap<Module, String>,
}

fn crates() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The code of a file, without comments and unit tests.
fn code(text: &str) -> String {
    let tests = ["#[cfg(test)]\nmod tests {", "#[cfg(test)]\nmod test {"];
    let end = tests.iter().filter_map(|tests| text.find(tests)).min().unwrap_or(text.len());
    let lines = text[..end].lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

impl Crate {
    /// The files of a source folder.
    fn read(source: &Path) -> Crate {
        let mut files = Crate::default();
        let mut folders = vec![(source.to_owned(), Module::new())];
        while let Some((folder, module)) = folders.pop() {
            for entry in std::fs::read_dir(folder).expect("a source folder") {
                let path = entry.expect("an entry").path();
                let stem = path.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_owned();
                if path.is_dir() {
                    folders.push((path, [&module[..], &[stem]].concat()));
                } else if path.extension().is_some_and(|end| end == "rs") {
                    let own = ["lib", "main", "mod"].contains(&&*stem);
                    let module = if own { module.clone() } else { [&module[..], &[stem]].concat() };
                    let text = std::fs::read_to_string(&path).expect("a source file");
                    files.text.insert(module, code(&text));
                }
            }
        }
        files
    }

    /// The module of this crate that a path leads to from another, and the name behind it.
    fn resolve(&self, from: &Module, path: &[String]) -> Option<(Module, Option<String>)> {
        let first = path.first()?;
        let (mut module, mut rest) = match &**first {
            "crate" | "$crate" => (Module::new(), &path[1..]),
            "self" => (from.clone(), &path[1..]),
            "super" => (from[..from.len().checked_sub(1)?].to_vec(), &path[1..]),
            name => ([&from[..], &[name.to_owned()]].concat(), &path[1..]),
        };
        while rest.first().is_some_and(|name| name == "super") {
            module.pop();
            rest = &rest[1..];
        }
        if !self.text.contains_key(&module) {
            return None;
        }
        while let Some(name) = rest.first() {
            let inner = [&module[..], std::slice::from_ref(name)].concat();
            if !self.text.contains_key(&inner) {
                break;
            }
            (module, rest) = (inner, &rest[1..]);
        }
        Some((module, rest.first().cloned()))
    }

    /// The module in which an item is written that the crate's own file shows on.
    fn written(&self, module: Module, item: Option<String>) -> Module {
        let Some(item) = item.filter(|_| module.is_empty()) else { return module };
        let shown = uses(&self.text[&module]).into_iter().find(|path| path.last() == Some(&item));
        match shown.and_then(|path| self.resolve(&module, &path)) {
            Some((written, _)) => written,
            None => module,
        }
    }

    /// The files that each file uses.
    fn arrows(&self) -> BTreeMap<Module, BTreeSet<Module>> {
        let mut arrows = BTreeMap::new();
        for (module, text) in &self.text {
            let used = uses(text).into_iter().chain(paths(text));
            let used = used.filter_map(|path| self.resolve(module, &path));
            let used = used.map(|(used, item)| self.written(used, item));
            let of_crate = |used: &Module| !used.is_empty() && !module.is_empty() && used != module;
            arrows.insert(module.clone(), used.filter(of_crate).collect::<BTreeSet<_>>());
        }
        arrows
    }

    /// The circles: sets of files each of which uses every other, directly or by way of others.
    fn circles(&self) -> Vec<Vec<String>> {
        let arrows = self.arrows();
        let all: BTreeMap<_, _> = arrows.keys().map(|module| (module, reached(&arrows, module))).collect();
        let circles = all.iter().filter(|(module, reached)| reached.contains(**module));
        let circles = circles.map(|(module, reached)| {
            let back = reached.iter().filter(|other| all[**other].contains(*module));
            back.map(|module| module.join("::")).collect::<Vec<_>>()
        });
        circles.collect::<BTreeSet<_>>().into_iter().collect()
    }
}

/// All that a file uses, by way of others too.
fn reached<'a>(arrows: &'a BTreeMap<Module, BTreeSet<Module>>, from: &'a Module) -> BTreeSet<&'a Module> {
    let (mut waiting, mut reached) = (vec![from], BTreeSet::new());
    while let Some(next) = waiting.pop() {
        waiting.extend(arrows[next].iter().filter(|to| reached.insert(*to)));
    }
    reached
}

/// The paths of `use` items, their braces opened.
fn uses(text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find("use ") {
        let before = rest[..start].chars().next_back();
        rest = &rest[start + 4..];
        if before.is_some_and(|c| !c.is_whitespace()) {
            continue;
        }
        let Some(end) = rest.find(';') else { break };
        open(&rest[..end], &[], &mut found);
    }
    found
}

/// Opens the braces of a `use` item.
fn open(tree: &str, before: &[String], found: &mut Vec<Vec<String>>) {
    let tree = tree.trim();
    let (way, list) = match tree.split_once('{') {
        None => (tree, None),
        Some((way, list)) => (way, list.trim_end().strip_suffix('}')),
    };
    let way = way.split(" as ").next().unwrap_or("").split("::").map(str::trim);
    let path: Vec<String> =
        before.iter().cloned().chain(way.filter(|s| !s.is_empty()).map(str::to_owned)).collect();
    let Some(list) = list else {
        found.push(path);
        return;
    };
    let (mut depth, mut start) = (0, 0);
    for (at, c) in list.char_indices().chain([(list.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                if !list[start..at].trim().is_empty() {
                    open(&list[start..at], &path, found);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
}

/// The paths in a text that begin with `crate::` or `super::`.
fn paths(text: &str) -> Vec<Vec<String>> {
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':' || c == '$'));
    let words = words.map(|word| word.trim_end_matches(':'));
    let paths = words.filter(|word| ["crate::", "$crate::", "super::"].iter().any(|s| word.starts_with(s)));
    paths.map(|word| word.split("::").map(str::to_owned).collect()).collect()
}

/// The circle may be.
fn permitted(name: &str, circle: &[String]) -> bool {
    let subject = |file: &String| file.split("::").next().unwrap_or("").to_owned();
    let one_subject = circle.iter().map(subject).collect::<BTreeSet<_>>().len() == 1;
    let known = |known: &[&str]| circle.iter().all(|file| known.contains(&&**file));
    one_subject && ONE_SUBJECT.contains(&name) || KNOWN.iter().any(|(of, files)| *of == name && known(files))
}

#[test]
fn files_use_one_another_in_no_circle() {
    let (mut files, mut arrows, mut inside) = (0, 0, BTreeSet::new());
    let mut wrong = Vec::new();
    for entry in std::fs::read_dir(crates()).expect("the crates folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().and_then(|name| name.to_str()).expect("a name").to_owned();
        let found = Crate::read(&path.join("src"));
        files += found.text.len();
        arrows += found.arrows().values().map(BTreeSet::len).sum::<usize>();
        for circle in found.circles() {
            if !permitted(&name, &circle) {
                wrong.push(format!("{name}: {}", circle.join(", ")));
            }
            inside.insert(name.clone());
        }
    }
    println!("checked {files} files, {arrows} uses of one by another");
    assert!(files > 600 && arrows > 1500, "{files} files, {arrows} uses: the sources were not read");
    assert!(wrong.is_empty(), "files that use one another:\n{}", wrong.join("\n"));
    for name in ONE_SUBJECT {
        assert!(inside.contains(*name), "{name} has no circle left: take it out of the list");
    }
}

/// A crate of files with these texts.
fn of_texts(texts: &[(&str, &str)]) -> Crate {
    let module = |name: &str| name.split("::").filter(|s| !s.is_empty()).map(str::to_owned).collect();
    Crate { text: texts.iter().map(|(name, text)| (module(name), code(text))).collect() }
}

#[test]
fn circles_are_found_however_they_are_written() {
    let root = ("", "mod a;\nmod b;\npub use a::{self, c::Shown};\n");
    let circles = |a: &str, b: &str, c: &str| of_texts(&[root, ("a", a), ("b", b), ("a::c", c)]).circles();
    let found = [
        ("use crate::b::X;", "use crate::a::Y;", ""),
        ("use crate::{b::{X, Z}, other};", "pub(crate) use super::{\n    a::Y,\n};", ""),
        ("fn f() { crate::b::g() }", "fn g() { super::a::f() }", ""),
    ];
    for (a, b, c) in found {
        assert_eq!(circles(a, b, c), [["a", "b"]], "{a} {b}");
    }
    assert_eq!(circles("use c::X;", "", "use super::Y;"), [["a", "a::c"]]);
    assert_eq!(circles("", "use crate::Shown;", "use super::super::b::X;"), [["a::c", "b"]]);
    let none = [
        ("use crate::b::X;", "", "use crate::b::X;"),
        ("use crate::b::X;", "// use crate::a::Y;", ""),
        ("use crate::b::X;", "#[cfg(test)]\nmod tests {\n    use crate::a::Y;\n}", ""),
        ("use b::X;", "use a::Y;", ""), // of other crates
    ];
    for (a, b, c) in none {
        assert_eq!(circles(a, b, c), Vec::<Vec<String>>::new(), "{a} {b}");
    }
}
