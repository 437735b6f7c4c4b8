//! `edgewalk replay` as a user runs it: what it writes, what it refuses and in which words.

use crate::support::{SCREEN, TRIANGLE, names, run};
use std::path::Path;

fn replay(folder: &Path, arguments: &[&str]) -> serde_json::Value {
    let (code, error) = run(folder, arguments);
    assert_eq!(code, Some(0), "{arguments:?}: {error}");
    let out = arguments.iter().position(|a| *a == "--out").expect("--out") + 1;
    let text = std::fs::read_to_string(folder.join(arguments[out])).expect("written");
    let json = match text.split_once("<script type=\"application/json\" id=\"replay\">") {
        Some((_, rest)) => rest.split_once("</script>").expect("an end").0.to_owned(),
        None => text,
    };
    serde_json::from_str(&json).expect("JSON")
}

#[test]
fn one_file_without_any_address() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("t.tri"), TRIANGLE).expect("written");
    let page = replay(folder.path(), &["replay", "t.tri", "--out", "out/t.html", "-q"]);
    assert_eq!(names(&folder.path().join("out")), ["t.html"]);
    let json = replay(folder.path(), &["replay", "t.tri", "--out", "t.json", "-q"]);
    assert_eq!(page, json, "page and recording say the same");
    assert_eq!((&page["format"], &page["scene"]["of"]), (&"edgewalk-replay".into(), &1.into()));
    let text = std::fs::read_to_string(folder.path().join("out/t.html")).expect("written");
    for address in ["http:", "https:", "//cdn", "src=", "@import", "url("] {
        assert!(!text.contains(address), "{address} stands in the page");
    }
    assert!(text.len() < 300_000 && text.contains("default-src 'none'"));
}

/// A part of a run is that part of the whole run: the same cycle, and the picture as it was.
#[test]
fn a_part_is_that_part_of_the_run() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("t.tri"), TRIANGLE).expect("written");
    let whole = replay(folder.path(), &["replay", "t.tri", "--out", "a.json", "-q"]);
    let cycles = whole["cycles"].as_u64().expect("cycles");
    let last = (cycles - 1).to_string();
    let part = replay(
        folder.path(),
        &["replay", "t.tri", "--from", "400", "--cycles", "50", "--out", "b.json", "-q"],
    );
    assert_eq!((&part["from"], &part["cycles"]), (&400.into(), &50.into()));
    let part =
        replay(folder.path(), &["replay", "t.tri", "--from", "400", "--to", &last, "--out", "b.json", "-q"]);
    assert_eq!(part["cycles"], cycles - 400);
    let stalled = replay(folder.path(), &["replay", "t.tri", "--stalls", "mixed", "--out", "b.json", "-q"]);
    assert!(stalled["cycles"].as_u64() > Some(cycles), "stalls take time");
}

#[test]
fn the_lesson_needs_no_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let lesson = replay(folder.path(), &["replay", "--lesson", "--out", "l.html", "-q"]);
    let steps = lesson["lesson"].as_array().expect("steps");
    let checks = steps.iter().flat_map(|step| step["parts"].as_array().into_iter().flatten());
    let checks: Vec<_> = checks.filter(|part| part["check"].is_object()).collect();
    assert!(
        checks.len() > 100 && checks.iter().all(|part| part["check"]["same"] == true),
        "{}",
        checks.len()
    );
}

#[test]
fn what_cannot_be_shown_is_refused_in_words() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("t.tri"), TRIANGLE).expect("written");
    std::fs::write(folder.path().join("empty.tri"), "size 8 8\n").expect("written");
    let screen = [&["replay", "sphere", "--out", "o.html"][..], &SCREEN].concat();
    let many = [&screen[..], &["--triangles", "2208", "--stalls", "mixed", "--set", "interpolator.adders=1"]]
        .concat();
    for (arguments, words) in [
        (many, &["sphere", "permitted: at most 200000", "--triangles", "--from"][..]),
        ([&screen[..], &["--from", "99999999"]].concat(), &["--from 99999999", "permitted: 0 to "]),
        ([&screen[..], &["--from", "9", "--to", "5"]].concat(), &["--from 9", "permitted: 0 to 5"]),
        ([&screen[..], &["--triangles", "0"]].concat(), &["sphere: nothing was drawn"]),
        (vec!["replay", "empty.tri", "--out", "o.html"], &["empty.tri: nothing was drawn"]),
        (vec!["replay", "t.tri", "--out", "o.txt"], &["--out o.txt: the file must end in .html or .json"]),
        (vec!["replay", "spere", "--out", "o.html"], &["spere", "sphere"]),
        (vec!["replay", "t.tri", "--lesson", "--out", "o.html"], &["--lesson", "cannot be used with"]),
        (
            vec!["replay", "--lesson", "--out", "o.html", "--set", "blend.kind=constant"],
            &["--lesson", "blend.kind", "none"],
        ),
        (vec!["replay", "t.tri", "--stalls", "often", "--out", "o.html"], &["often", "mixed"]),
        (vec!["replay", "t.tri", "--cycles", "0", "--out", "o.html"], &["--cycles", "0"]),
    ] {
        let (code, error) = run(folder.path(), &arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        assert!(words.iter().all(|word| error.contains(word)), "{arguments:?}: {error}");
        assert!(!folder.path().join("o.html").exists());
    }
}
