//! An error names the user's word, the place of that word, and the permitted values.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{TRIANGLE, edgewalk, names, run};

/// Files of the cases, by name.
const FILES: [(&str, &str); 13] = [
    ("t.tri", TRIANGLE),
    (
        "far.tri",
        "size 8 8\nmode phong\nview 0 0 1\nsun 0 0 1 0.5\nmaterial 0.1 0.5 0 1\n\
         T 1 1 0.5 1 1 1 0  9000 1 0.5 1 1 1 0  1 5 0.5 1 1 1 0\nN 0 0 1 0 0 1 0 0 1\n",
    ),
    ("lines.toml", "[polygon]\nlines = true\n"),
    ("list.toml", "[screen]\nwidth = [32]\n"),
    ("far.toml", "[screen]\nwidth = 0x8000\n"),
    ("named.toml", "[[object]]\nbuiltin = \"sphere\"\nmaterial = \"m\"\n"),
    ("no_mesh.toml", "[[object]]\nmesh = \"none.obj\"\n"),
    ("empty_mesh.toml", "[[object]]\nmesh = \"\"\n"),
    ("no_picture.toml", "[[material]]\nname = \"m\"\ntexture = \"none.png\"\n"),
    ("empty_picture.toml", "[[material]]\nname = \"m\"\ntexture = \"\"\n"),
    ("folder.toml", "[[object]]\nmesh = \"folder.obj\"\n"),
    ("point.toml", "[[object]]\npositions = [[1, 1, 1], [1, 1, 1], [1, 1, 1]]\nfaces = [[0, 1, 2]]\n"),
    ("crease.toml", "[normals]\ncrease = \"group\"\n[[object]]\nbuiltin = \"sphere\"\n"),
];

/// A command line, and how its error begins.
const REFUSED: &[(&[&str], &str)] = &[
    // Machine keys.
    (
        &["emit", "--set", "screen.width=nan"],
        "--set screen.width=nan: screen.width = nan is not permitted (1 to 8192)\n",
    ),
    (
        &["emit", "--set", "screen.width=wide"],
        "--set screen.width=wide: screen.width = wide is not permitted (1 to 8192)\n",
    ),
    (
        &["emit", "--set", "setup.lanes=inf"],
        "--set setup.lanes=inf: setup.lanes = inf is not permitted (1, 2, 4)\n",
    ),
    (
        &["emit", "--set", "polygon.lines=false"],
        "--set polygon.lines=false: polygon.lines = false is not permitted (no, yes); nearest: no\n",
    ),
    (
        &["emit", "--machine", "lines.toml"],
        "--machine lines.toml: line 2: polygon.lines = true is not permitted (no, yes); nearest: yes\n",
    ),
    (
        &["emit", "--machine", "list.toml"],
        "--machine list.toml: line 2: screen.width = [32] is not permitted (1 to 8192)\n",
    ),
    (
        &["emit", "--machine", "far.toml"],
        "--machine far.toml: line 2: screen.width = 32768 is not permitted (1 to 8192); nearest: 8192\n",
    ),
    // Scenes.
    (
        &["render", "named.toml"],
        "named.toml:3: object 1: material: `m`: no [[material]] is declared; declare one of this name, or leave the key out\n",
    ),
    (&["render", "no_mesh.toml"], "no_mesh.toml:2: object 1: mesh: `none.obj`: cannot be read: No such file"),
    (
        &["render", "empty_mesh.toml"],
        "empty_mesh.toml:2: object 1: mesh: ``: permitted: the name of a file\n",
    ),
    (
        &["render", "no_picture.toml"],
        "no_picture.toml:3: material 1: texture: `none.png`: cannot be read: No such file",
    ),
    (
        &["render", "empty_picture.toml"],
        "empty_picture.toml:3: material 1: texture: ``: permitted: the name of a file\n",
    ),
    (&["render", "folder.toml"], "folder.obj: kind of file: `a folder`: permitted: a regular file\n"),
    (&["render", "point.toml"], "point.toml:1: object 1: size: `0`: permitted: at least "),
    (
        &["render", "crease.toml"],
        "crease.toml:2: normals: crease: `\"group\"`: permitted: \"groups\", or a number from 0 to 180\n",
    ),
    // A vertex by the number that it has in the file.
    (
        &["render", "far.tri", "--adapt"],
        "far.tri: triangle 0 (counted from 0), vertex 2 (from 1): x = 9000 lies outside the guard band",
    ),
    (
        &["bench", "far.tri", "--adapt", "--engine", "fast"],
        "far.tri: triangle 0 (counted from 0), vertex 2 (from 1): x = 9000 lies outside the guard band",
    ),
    // Machines by name.
    (
        &["compare", "default", "nosuch", "t.tri"],
        "nosuch: no file; unknown preset nosuch; permitted: default, ",
    ),
    (
        &["compare", "default", "default,", "t.tri"],
        "default,: nothing stands behind a comma; write key=value, e.g. interpolator.adders=2\n",
    ),
    (
        &["compare", "default", "default,adders", "t.tri"],
        "default,adders: adders: write key=value, e.g. interpolator.adders=2\n",
    ),
    (
        &["compare", "default", "default,setup.lanes=3", "t.tri"],
        "default,setup.lanes=3: setup.lanes = 3 is not permitted (1, 2, 4); nearest: 2\n",
    ),
    (
        &["emit", "--machine", "nosuch"],
        "--machine nosuch: no file; unknown preset nosuch; permitted: default, ",
    ),
    (&["emit", "--set", "adders"], "--set adders: write key=value, e.g. interpolator.adders=2\n"),
    // Numbers below zero.
    (&["explain", "sphere", "-1", "5"], "invalid value '-1' for '<X>': -1 is not in 0..="),
    (&["explain", "sphere", "5", "-2"], "invalid value '-2' for '<Y>': -2 is not in 0..="),
    (&["size", "t.tri", "--error", "-1"], "t.tri: --error -1: permitted: above 0.5, "),
    (
        &["judge", "t.tri", "x", "--depth-lsb", "-1"],
        "invalid value '-1' for '--depth-lsb <LSB>': permitted: 0 or more, LSB",
    ),
    (&["bench", "t.tri", "--repeat", "-1"], "invalid value '-1' for '--repeat <N>': -1 is not in 1..=1000"),
    (&["sweep", "run", "--out", "f", "--chunk", "-1"], "invalid value '-1' for '--chunk <I>': -1 is not in "),
    (&["render", "-1"], "built-in scenes: name: `-1`: permitted: sphere"),
    // --adapt and --set of one key.
    (
        &["render", "t.tri", "--adapt", "--set", "channels.extra=2"],
        "extra 0: the machine has channels.extra = 2; --set channels.extra=2 stands against --adapt: leave it out\n",
    ),
    (
        &["raster", "t.tri", "--out", "out", "--adapt", "--set", "channels.extra=2"],
        "extra 0: the machine has channels.extra = 2; --set channels.extra=2 stands against --adapt: leave it out\n",
    ),
    (
        &["compare", "default", "default,channels.extra=2", "t.tri", "--adapt"],
        "default,channels.extra=2: extra 0: the machine has channels.extra = 2; channels.extra=2 stands against --adapt: \
         leave it out\n",
    ),
    (
        &["render", "t.tri", "--set", "channels.extra=2"],
        "t.tri: extra 0: the machine has channels.extra = 2; give --set channels.extra=0, or --adapt, which sets the keys that \
         are not given\n",
    ),
];

#[test]
fn each_refusal_names_what_the_user_wrote() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in FILES {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    std::fs::create_dir(folder.path().join("folder.obj")).unwrap();
    let before = names(folder.path());
    let mut wrong = Vec::new();
    for (arguments, says) in REFUSED {
        let (code, error) = run(folder.path(), arguments);
        if code != Some(2) || !error.starts_with(&format!("error: {says}")) {
            wrong.push(format!("{arguments:?}: {code:?}\n  {error}  expected {says}\n"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), REFUSED.len(), wrong.concat());
    println!("refused {0} / {0} command lines", REFUSED.len());
    assert_eq!(names(folder.path()), before, "nothing was left behind");
}

#[test]
fn standard_output_takes_one_document() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.tri"), TRIANGLE).unwrap();
    let output = edgewalk(folder.path(), &["triangles", "t.tri", "--out", "-", "--json"]).output().unwrap();
    let told: serde_json::Value = serde_json::from_slice(&output.stderr).unwrap();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    let says = "--out - --json: the standard output takes one of the triangle file and the JSON document; give --out a \
                file, or leave --json out";
    assert_eq!(told["error"], says);
}

/// Whole numbers of a machine file are those of TOML.
#[test]
fn a_hexadecimal_width_is_that_number() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.toml"), "[screen]\nwidth = 0x1_00\nheight = 0b100000\n").unwrap();
    let checked = run(folder.path(), &["config", "check", "--machine", "m.toml", "-q"]);
    assert_eq!(checked, (Some(0), String::new()));
    let printed = edgewalk(folder.path(), &["config", "print", "--machine", "m.toml"]).output().unwrap();
    let printed = String::from_utf8(printed.stdout).unwrap();
    assert!(printed.contains("width = 256") && printed.contains("height = 32"), "{printed}");
}

/// What a file says is shown, and steers no terminal.
#[test]
fn no_control_character_reaches_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let scene =
        "[[material]]\nname = \"a\"\n[[object]]\nbuiltin = \"sphere\"\nmaterial = \"\\u001b[32my\\u009b\"\n";
    let files = [
        ("a.tri", "size 8 8\n\x1b[31mfoo\n", "\\u{1b}[31mfoo"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \x1b[32m\x7f\n", "\\u{1b}[32m\\u{7f}"),
        ("a.toml", scene, "\\u{1b}[32my\\u{9b}"),
        ("m.toml", "[screen]\n\"\\u001b[33mwidth\" = 1\n", "\\u{1b}[33mwidth"),
    ];
    for (name, text, shown) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
        let arguments =
            if name == "m.toml" { ["emit", "--machine", name] } else { ["render", name, "--adapt"] };
        let (code, error) = run(folder.path(), &[&arguments[..], &["--out", "out"]].concat());
        assert!(code == Some(2) && error.contains(shown), "{name}: {error:?}");
        assert!(!error.contains(|letter: char| letter.is_control() && letter != '\n'), "{name}: {error:?}");
    }
    // A name in a report.
    let named = "\x1b[31m.tri";
    std::fs::write(folder.path().join(named), TRIANGLE).unwrap();
    let output = edgewalk(folder.path(), &["raster", named, "--out", "out"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        output.status.success() && text.contains("\\u{1b}[31m.tri") && !text.contains('\x1b'),
        "{text:?}"
    );
}

/// Only `render` and `raster` have --engine: no other command advises it.
#[test]
fn commands_without_engine_advise_none() {
    let folder = tempfile::tempdir().unwrap();
    let phong = FILES.iter().find(|(name, _)| *name == "far.tri").unwrap().1.replace("9000", "7");
    std::fs::write(folder.path().join("p.tri"), phong).unwrap();
    let glass = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scenes/glass-and-shadows.toml");
    let (advice, mut advised) = ("--engine", 0);
    for words in [
        &["raster", "p.tri", "--out", "o"][..],
        &["render", "p.tri", "--out", "o"],
        &["vectors", "p.tri", "--out", "o"],
        &["verify", "p.tri"],
        &["trace", "p.tri", "--out", "o"],
        &["explain", "p.tri", "2", "2"],
        &["replay", "p.tri", "--out", "o.html"],
        &["energy", "p.tri"],
        &["judge", "p.tri", "o", "--against", "machine"],
        &["vectors", glass, "--out", "o"],
        &["trace", "sphere", "--shading", "phong", "--out", "o"],
    ] {
        let (code, error) = run(folder.path(), words);
        assert_eq!(code, Some(2), "{words:?}: {error}");
        let has_engine = words[0].starts_with('r') && words[0] != "replay";
        assert_eq!(error.contains(advice), has_engine, "{words:?}: {error}");
        advised += usize::from(has_engine);
    }
    assert_eq!(advised, 2);
}
