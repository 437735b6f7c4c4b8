//! Inputs that are no plain files, begin with a byte order mark, or cannot be read.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{SCREEN, TRIANGLE, edgewalk, ended, run};
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Triangles, then a polygon: the engine that draws while it reads has to begin again.
const POLYGON: &str = "size 64 48\nT 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 40 1 0 0 1 0\n\
                       P 3  64 48 .25 0 0 1 0  20 48 .25 0 0 1 0  64 10 .25 0 0 1 0\n";
const SHADOW: &str =
    "shadow 64 0.001 0.25   1 0 0 0   0 1 0 0   0 0 1 0   0 0 0 1\nL 0 0 0  64 0 0  0 48 0\n";
const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n";
const SCENE: &str = "ambient = 0.5\n[[object]]\nmesh = \"plain.obj\"\n";
const MACHINE: &str = "[screen]\nwidth = 64\nheight = 48\n";
const ARRAYS: [&str; 5] = ["coverage.npy", "writes.npy", "id.npy", "z.npy", "rgb.npy"];

/// Two machines: one whose frames need no ticking, and one whose frames do.
const TICKED: [&str; 4] = ["--set", "fifo.inflight=8", "--set", "memory.latency=8"];

/// Writes `text` into a new pipe of that name and runs the program; ends it if it waits for more.
fn from_pipe(folder: &Path, pipe: &str, text: &str, arguments: &[&str]) -> (Option<i32>, String) {
    let path = folder.join(pipe);
    _ = std::fs::remove_file(&path);
    assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
    let mut child = edgewalk(folder, arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let text = text.to_owned();
    // Ends when the program has read it; if it never does, with the test.
    std::thread::spawn(move || std::fs::write(path, text));
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("{arguments:?} waits for a second reading of {pipe}");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    ended(&child.wait_with_output().unwrap())
}

fn same_files(folder: &Path, [one, other]: [&str; 2], names: &[&str], context: &str) {
    for name in names {
        let [a, b] = [one, other].map(|out| std::fs::read(folder.join(out).join(name)).unwrap());
        assert!(a == b, "{context}: {name}");
    }
}

#[test]
fn every_engine_draws_from_a_pipe() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut checked = 0;
    for text in [TRIANGLE, POLYGON] {
        std::fs::write(folder.join("plain.tri"), text).unwrap();
        let ticked = ("fast", &TICKED[..]);
        for (engine, settings) in [("fast", &[][..]), ticked, ("golden", &[]), ("model", &[]), ("rtl", &[])] {
            let passes = (Some(0), String::new());
            let arguments =
                |file, out| [&["raster", file, "--engine", engine, "-q", "--out", out], settings].concat();
            assert_eq!(run(folder, &arguments("plain.tri", "plain")), passes);
            assert_eq!(from_pipe(folder, "pipe.tri", text, &arguments("pipe.tri", "pipe")), passes);
            same_files(folder, ["plain", "pipe"], &ARRAYS, engine);

            let mut child = edgewalk(folder, &arguments("/dev/stdin", "stdin"))
                .stdin(Stdio::piped())
                .stderr(Stdio::piped())
                .spawn()
                .unwrap();
            child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
            assert_eq!(ended(&child.wait_with_output().unwrap()), passes, "{engine}");
            same_files(folder, ["plain", "stdin"], &ARRAYS, engine);
            checked += 2;
        }
    }
    println!("checked {checked} / 20 pictures");
    assert_eq!(checked, 20);
}

#[test]
fn every_command_reads_its_file_once() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("plain.obj"), MESH).unwrap();
    std::fs::write(folder.join("plain.tri"), TRIANGLE).unwrap();
    let runs: [(&str, &str, &[&str]); 12] = [
        ("p.tri", TRIANGLE, &["render", "p.tri"]),
        ("p.tri", TRIANGLE, &["render", "p.tri", "--engine", "golden"]),
        ("p.tri", TRIANGLE, &["explain", "p.tri", "10", "10"]),
        ("p.tri", TRIANGLE, &["trace", "p.tri", "--out", "t.vcd", "--cycles", "9"]),
        ("p.tri", TRIANGLE, &["verify", "p.tri", "--no-simulators", "--triangles", "1", "--stalls", "none"]),
        ("p.tri", TRIANGLE, &["bench", "p.tri", "--engine", "fast", "--repeat", "1"]),
        ("p.obj", MESH, &["render", "p.obj"]),
        ("p.obj", MESH, &["render", "p.obj", "--engine", "golden", "--shading", "phong"]),
        ("p.obj", MESH, &["explain", "p.obj", "32", "24"]),
        ("p.toml", SCENE, &["explain", "p.toml", "32", "24"]),
        ("m.toml", MACHINE, &["raster", "plain.tri", "--out", "o", "--machine", "m.toml"]),
        (
            "m.toml",
            MACHINE,
            &["bench", "plain.tri", "--engine", "fast", "--repeat", "1", "--machine", "m.toml"],
        ),
    ];
    for (pipe, text, command) in runs {
        let arguments = [command, &["-q"], &SCREEN].concat();
        assert_eq!(from_pipe(folder, pipe, text, &arguments), (Some(0), String::new()), "{arguments:?}");
    }
    println!("checked {0} / {0} commands", runs.len());
}

#[test]
fn a_byte_order_mark_is_no_word() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let library = "newmtl red\nKd 1 0 0\n";
    let mesh = |library: &str| format!("mtllib {library}\nusemtl red\n{MESH}");
    let files = [
        ("plain.tri", "marked.tri", TRIANGLE.to_owned()),
        ("plain.obj", "marked.obj", MESH.to_owned()),
        ("plain.toml", "marked.toml", SCENE.to_owned()),
        ("machine.toml", "marked_machine.toml", MACHINE.to_owned()),
        ("plain.mtl", "marked.mtl", library.to_owned()),
    ];
    for (plain, marked, text) in &files {
        std::fs::write(folder.join(plain), text).unwrap();
        std::fs::write(folder.join(marked), format!("\u{feff}{text}")).unwrap();
    }
    std::fs::write(folder.join("with.obj"), mesh("plain.mtl")).unwrap();
    std::fs::write(folder.join("with_marked.obj"), mesh("marked.mtl")).unwrap();
    let render = |input| vec!["render", input, "--machine", "machine.toml"];
    let runs = [
        [render("plain.tri"), render("marked.tri")],
        [render("plain.obj"), render("marked.obj")],
        [render("plain.toml"), render("marked.toml")],
        [render("with.obj"), render("with_marked.obj")],
        ["machine.toml", "marked_machine.toml"]
            .map(|machine| vec!["render", "plain.tri", "--machine", machine]),
        ["plain.tri", "marked.tri"].map(|file| vec!["raster", file]),
    ];
    for [plain, marked] in &runs {
        for (command, out) in [(plain, "plain"), (marked, "marked")] {
            let arguments = [command, &["-q", "--out", out][..]].concat();
            assert_eq!(run(folder, &arguments), (Some(0), String::new()), "{arguments:?}");
        }
        same_files(folder, ["plain", "marked"], &["image.png"], marked[1]);
    }
    println!("checked {0} / {0} pairs", runs.len());
}

#[test]
fn shadow_may_come_late() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (size, triangles) = TRIANGLE.split_once('\n').unwrap();
    std::fs::write(folder.join("first.tri"), format!("{size}\n{SHADOW}{triangles}")).unwrap();
    std::fs::write(folder.join("late.tri"), format!("{TRIANGLE}{SHADOW}")).unwrap();
    for out in ["first", "late"] {
        let file = format!("{out}.tri");
        let golden = run(folder, &["raster", &file, "--engine", "golden", "-q", "--out", out]);
        assert_eq!(golden, (Some(0), String::new()));
        for engine in ["fast", "model", "rtl"] {
            let (code, error) = run(folder, &["raster", &file, "--engine", engine, "--out", "o"]);
            assert_eq!(code, Some(2), "{error}");
            assert!(error.contains(&format!("{file}: shadow: the machine has no SHADOW")), "{error}");
        }
    }
    let lit = std::fs::read(folder.join("late/lit.npy")).unwrap();
    assert!(lit[128..].contains(&1), "the shadow is seen");
    same_files(folder, ["first", "late"], &["lit.npy", "rgb.npy"], "late");
}

#[test]
fn a_reason_is_given_once_and_by_whose_fault() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&[&str], &str); 9] = [
        (&["raster", "none.tri", "--out", "o"], "none.tri: cannot be read: "),
        (&["raster", "none.tri", "--engine", "golden", "--out", "o"], "none.tri: cannot be read: "),
        (&["render", "none.tri"], "none.tri: cannot be read: "),
        (&["render", "none.obj"], "none.obj: cannot be read: "),
        (&["render", "none.gltf"], "none.gltf: cannot be read: "),
        (&["render", "none.toml"], "none.toml: cannot be read: "),
        (&["emit", "--machine", "none.toml"], "--machine none.toml: "),
        (
            &["emit", "--set", "edge.fill=textbook"],
            "--set edge.fill=textbook: screen.subpixel_bits = 8 cannot be built",
        ),
        (
            &["raster", "wide.tri", "--out", "o", "--set", "screen.guard_bits=12"],
            "size 8192 4, --set screen.guard_bits=12: screen.guard_bits = 12 cannot be built",
        ),
    ];
    std::fs::write(folder.path().join("wide.tri"), "size 8192 4\n").unwrap();
    for (arguments, says) in cases {
        let (code, error) = run(folder.path(), arguments);
        assert_eq!(code, Some(2), "{error}");
        assert!(error.starts_with(&format!("error: {says}")), "{arguments:?}: {error}");
        assert!(error.matches("os error 2").count() <= 1, "{error}");
        assert_eq!(error.contains("os error 2"), says.contains("none."), "{error}");
    }
    println!("checked {0} / {0} messages", cases.len());
}
