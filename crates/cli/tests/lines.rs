//! Lines of triangle files and wireframes, drawn by the machine.

use crate::support::{edgewalk, ended, rendered_by_every_engine};

/// Lines before, between and behind surfaces, over the sides of the screen, along both axes, and from both ends.
const FILE: &str = "size 48 36
clear 0.1 0.1 0.2
S  -5 3 0.4 1 0 0 0   60 30 0.4 0 1 0 0
T  4 4 0.5 1 1 0 0   44 8 0.5 0 1 1 0   10 33 0.5 1 0 1 0
S  40 34 0.3 1 1 1 0   2 2 0.7 0 0 1 0
P 4  20 10 0.2 1 0 0 0   30 10 0.2 1 0 0 0   30 20 0.2 1 0 0 0   20 20 0.2 1 0 0 0
depth lequal
S  25 -9 0.1 0 1 0 0   25.5 50 0.9 0 1 1 0
S  3.5 20.5 0.5 1 1 0 0   30.5 20.5 0.5 1 1 0 0
S  7 7 0.5 1 1 1 0   7 7 0.5 1 1 1 0
";

const TRIANGLE: &str = "size 32 24\nT 2 1 0.5 1 0 0 0   30 3 0.5 0 1 0 0   5 22 0.5 0 0 1 0\n";
const TRIANGLE_WITH_OWN_CHANNEL: &str =
    "size 32 24\nextra 1\nT 2 1 0.5 1 0 0 0   30 3 0.5 0 1 0 0   5 22 0.5 0 0 1 0\nX 1 2 3\n";

const LINES: [&str; 2] = ["--set", "polygon.lines=yes"];

fn folder(file: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.tri"), file).expect("a file");
    folder
}

#[test]
fn lines_of_a_file_are_drawn_by_every_engine() {
    let folder = folder(FILE);
    for more in [&["--set", "setup.lanes=1"][..], &["--set", "blend.kind=constant"]] {
        for report in rendered_by_every_engine(folder.path(), &[&["a.tri"], &LINES[..], more].concat()) {
            assert_eq!((&report["triangles"], &report["lines"]), (&3.into(), &5.into()));
            let comparison = &report["comparison"];
            assert_eq!(comparison["coverage_mismatches"], 0, "{comparison}");
            assert_eq!(comparison["order_wrong"], 0, "{comparison}");
            assert!(report["fragments"].as_u64() > Some(500), "{report}");
        }
    }
}

#[test]
fn a_wireframe_is_drawn_by_every_engine() {
    let folder = folder(FILE);
    for hidden in [&[][..], &["--hidden-lines"]] {
        let arguments = [&["a.tri", "--shading", "wireframe"], hidden, &LINES].concat();
        for report in rendered_by_every_engine(folder.path(), &arguments) {
            agrees(&report);
            assert_eq!(report["lines"], 12, "three edges of the triangle, four of the square, five lines");
            assert_eq!(report["triangles"].as_u64() == Some(0), !hidden.is_empty());
        }
    }
}

/// Coverage and order are golden's.
fn agrees(report: &serde_json::Value) {
    let comparison = &report["comparison"];
    assert_eq!((&comparison["coverage_mismatches"], &comparison["order_wrong"]), (&0.into(), &0.into()));
}

#[test]
fn a_wireframe_of_a_torus_agrees_with_golden() {
    let folder = tempfile::tempdir().expect("a folder");
    for hidden in [&[][..], &["--hidden-lines"]] {
        let arguments = [&["render", "torus", "--shading", "wireframe", "--json"], hidden, &LINES].concat();
        let output = edgewalk(folder.path(), &arguments).output().expect("runs");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a report");
        agrees(&report);
        assert_eq!(report["lines"], 6144);
        assert!(report["fragments"].as_u64() > Some(50_000), "{report}");
    }
}

#[test]
fn lines_want_a_machine_that_takes_them() {
    let folder = folder(FILE);
    let said = |arguments: &[&str]| ended(&edgewalk(folder.path(), arguments).output().expect("runs"));
    for arguments in [
        &["render", "a.tri"][..],
        &["raster", "a.tri", "--out", "o"],
        &["verify", "a.tri", "--no-simulators"],
        &["render", "torus", "--shading", "wireframe"],
    ] {
        let (code, error) = said(arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        for part in ["lines: the machine's port takes triangles only", "--set polygon.lines=yes", "--adapt"] {
            assert!(error.contains(part), "{arguments:?}: {error}");
        }
    }
    assert_eq!(said(&["raster", "a.tri", "--adapt", "--out", "o"]).0, Some(0));
    for (key, reason) in [
        ("edge.fill=textbook", "a line wants edge.fill = exact"),
        ("screen.subpixel_bits=0", "lines need screen.subpixel_bits of 1 or more"),
        ("shade.kind=fast-phong", "lines need shade.kind = none"),
    ] {
        let integers = key.contains("fill").then_some(["--set", "screen.subpixel_bits=0"]);
        let settings = integers.iter().flatten().copied().chain(["--set", key]).chain(LINES);
        let (code, error) = said(&["config", "print"].into_iter().chain(settings).collect::<Vec<_>>());
        assert_eq!(code, Some(2), "{key}: {error}");
        assert!(error.contains(reason) && error.contains("try polygon.lines = no"), "{key}: {error}");
    }
}

#[test]
fn malformed_lines_name_place_and_remedy() {
    let end = "1 1 0.5 1 1 1 0";
    for (file, parts) in [
        (format!("size 9 9\nS {end}"), &["a.tri:2: S: `7 given`", "14 values"][..]),
        (format!("size 9 9\nS {end} 9 9 1.5 1 1 1 0"), &["a.tri:2: S vertex 2 z: `1.5`"]),
        (format!("S {end} {end}"), &["a.tri:1: size: `S`", "missing"]),
        (format!("size 9 9\nextra 1\nS {end} {end}"), &["`S`", "lines have no `X`"]),
        (
            format!("size 9 9\nmode phong\nview 0 0 1\nsun 0 0 1 1\nS {end} {end}"),
            &["`S`", "lines have no `N`"],
        ),
        (
            format!("size 9 9\nP 3 {end} 5 1 0 1 1 1 0 1 5 0 1 1 1 0\nS {end} {end}\nH 3 {end} {end} {end}"),
            &["`H`", "only on the lines after a polygon"],
        ),
        (
            format!("size 9 9\nS {end} 99999 1 0.5 1 1 1 0"),
            &["a.tri: line 0 (counted from 0), end 2 (from 1)", "outside the guard band", "clip it"],
        ),
    ] {
        let folder = folder(&file);
        let (code, error) =
            ended(&edgewalk(folder.path(), &["render", "a.tri", "--adapt"]).output().expect("runs"));
        assert_eq!(code, Some(2), "{file}: {error}");
        assert!(parts.iter().all(|part| error.contains(part)), "{file}: {error}");
    }
}

/// A wireframe of a file has needs of its own: lines, and no channels of the user's own.
#[test]
fn adapt_draws_the_wireframe_of_a_file() {
    let (plain, own) = (folder(TRIANGLE), folder(TRIANGLE_WITH_OWN_CHANNEL));
    let mut checked = 0;
    for (folder, command) in [
        (&plain, &["render", "a.tri", "--out", "o"][..]),
        (&plain, &["replay", "a.tri", "--out", "r.json"]),
        (&own, &["render", "a.tri", "--out", "o"]),
        (&own, &["render", "a.tri", "--out", "o", "--engine", "golden"]),
        (&own, &["replay", "a.tri", "--out", "r.json"]),
    ] {
        let arguments = [command, &["--shading", "wireframe", "--adapt"]].concat();
        let (code, error) = ended(&edgewalk(folder.path(), &arguments).output().expect("runs"));
        assert_eq!(code, Some(0), "{arguments:?}: {error}");
        checked += 1;
    }
    assert_eq!(checked, 5);
}

/// The command that a recording of a wireframe names explains the wireframe: inside the triangle its black surface, pushed back.
#[test]
fn explain_shows_the_wireframe_of_a_file() {
    let folder = folder(TRIANGLE);
    let replay = [&["replay", "a.tri", "--shading", "wireframe", "--out", "r.json"][..], &LINES].concat();
    let (code, error) = ended(&edgewalk(folder.path(), &replay).output().expect("runs"));
    assert_eq!(code, Some(0), "{error}");
    let recording = std::fs::read_to_string(folder.path().join("r.json")).expect("a recording");
    let recording: serde_json::Value = serde_json::from_str(&recording).expect("one JSON value");
    let command = recording["command"].as_str().expect("a command").replace("{x} {y}", "12 10");
    let words: Vec<&str> = command.split(' ').skip(1).chain(["--json"]).collect();
    let output = edgewalk(folder.path(), &words).output().expect("runs");
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("one JSON value");
    assert_eq!(told["stored"], serde_json::json!({"id": 0, "z": 8_388_609, "rgb": [0, 0, 0]}), "{command}");
    assert_eq!(told["rgb"], serde_json::json!([0.0, 0.0, 0.0]), "{told}");
}

/// Every word of the machine's tools takes them: vectors, the netlist beside the model, replay, explain.
#[test]
fn lines_go_through_the_other_commands() {
    let folder = folder(&FILE.replace("depth lequal\n", ""));
    for arguments in [
        &["verify", "a.tri", "--no-simulators"][..],
        &["vectors", "a.tri", "--out", "v"],
        &["explain", "a.tri", "24", "18"],
        &["explain", "a.tri", "4", "20"],
        &["replay", "a.tri", "--out", "r.html"],
        &["trace", "a.tri", "--out", "t.vcd"],
        &["triangles", "a.tri", "--out", "b.tri"],
    ] {
        let arguments = [arguments, &["--adapt"]].concat();
        let (code, error) = ended(&edgewalk(folder.path(), &arguments).output().expect("runs"));
        assert_eq!(code, Some(0), "{arguments:?}: {error}");
    }
    let written = std::fs::read_to_string(folder.path().join("b.tri")).expect("a triangle file");
    assert_eq!(written.lines().filter(|line| line.starts_with("S ")).count(), 5, "{written}");
}

/// On a machine with POLY too a line is drawn between the polygon before it and the triangle behind it.
#[test]
fn a_line_keeps_its_place_behind_a_polygon() {
    let polygon = "P 4 1 1 0.5 1 0 0 0   20 1 0.5 1 0 0 0   20 14 0.5 1 0 0 0   1 14 0.5 1 0 0 0";
    let line = "S 2 6.4 0.5 0 1 0 0   20 6.4 0.5 0 1 0 0";
    let triangle = "T 1 1 0.5 0 0 1 0   20 1 0.5 0 0 1 0   1 14 0.5 0 0 1 0";
    let folder = folder(&format!("size 24 16\ndepth always\n{polygon}\n{line}\n{triangle}\n"));
    let machine = [&LINES[..], &["--machine", "polygon", "--json"]].concat();
    let machine = [&machine[..], &["--set", "screen.width=24", "--set", "screen.height=16"]].concat();
    for (x, id) in [("5", 2), ("18", 1)] {
        let arguments = [&["explain", "a.tri", x, "6"], &machine[..]].concat();
        let output = edgewalk(folder.path(), &arguments).output().expect("runs");
        let explained: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!((&explained["id"], &explained["stored"]["id"]), (&id.into(), &id.into()), "{explained}");
    }
}
