//! `edgewalk demo` says and draws what README shows of it.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use serde_json::Value;
use std::path::Path;
use std::process::Command;
use zune_png::PngDecoder;

fn edgewalk(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk")).args(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn png(path: &Path) -> (usize, Vec<[u8; 3]>) {
    let bytes = std::fs::read(path).unwrap();
    let mut decoder = PngDecoder::new(&bytes);
    let raw = decoder.decode_raw().unwrap();
    let (width, height) = decoder.get_dimensions().unwrap();
    assert_eq!(raw.len(), 3 * width * height);
    (width, raw.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect())
}

#[test]
fn the_demo_is_as_readme_says() {
    let out = tempfile::tempdir().unwrap();
    let printed = edgewalk(&["demo", "--out", out.path().to_str().unwrap()]);
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let block = readme.split("```\n").find(|block| block.starts_with("torus-knot: ")).unwrap();
    let mut lines = printed.lines();
    let mut checked = 0;
    for line in block.lines().filter(|line| *line != "...") {
        assert!(lines.any(|printed| printed == line), "README says `{line}`; printed is\n{printed}");
        checked += 1;
    }
    assert!(checked >= 5, "{checked} lines");
    for name in ["image.png", "z_accumulator.png"] {
        let [drawn, kept] = [
            out.path().join(name),
            root.join("docs").join(format!("demo{}", name.replace("image", "").replace("z_", "_z_"))),
        ];
        assert!(png(&drawn) == png(&kept), "{} is not what is drawn today", kept.display());
    }

    // Its last line is the command that shows the machine at work.
    let command = printed.lines().find_map(|line| line.strip_prefix("at work   edgewalk ")).unwrap();
    let arguments: Vec<&str> = command.split(": ").next().unwrap().split(' ').collect();
    assert!(edgewalk(&arguments).contains("20 of 12288 triangles"));
    assert!(out.path().join("replay.html").is_file());

    // The map of the accumulators says what `explain` says of single pixels.
    let (width, map) = png(&out.path().join("z_accumulator.png"));
    assert_eq!((width, map.len()), (640, 640 * (480 + 22)));
    let (mut below, mut above) = (0, 0);
    for (x, y) in
        [(320, 240), (330, 250), (150, 300), (400, 180), (260, 370), (480, 250), (120, 220), (200, 280)]
    {
        let told: Value = serde_json::from_str(&edgewalk(&[
            "explain",
            "torus-knot",
            &x.to_string(),
            &y.to_string(),
            "--json",
        ]))
        .unwrap();
        let last = told["machine"]["additions"].as_array().unwrap().last().unwrap();
        let share = last["error"][0].as_f64().unwrap() / last["bound"][0].as_f64().unwrap();
        let strength = share.abs().sqrt();
        let full = if share < 0.0 { [70.0, 150.0, 255.0] } else { [255.0, 150.0, 30.0] };
        let shown = map[y * width + x];
        for (byte, full) in shown.into_iter().zip(full) {
            assert!((f64::from(byte) - full * strength).abs() <= 1.01, "({x}, {y}): {shown:?} for {share}");
        }
        if share < 0.0 { below += 1 } else { above += 1 }
    }
    assert!(below > 0 && above > 0, "{below} below, {above} above");
    assert_eq!(map[0], [0, 0, 0], "no triangle");
    let bar = &map[485 * width..486 * width];
    assert_eq!((bar[8], bar[631]), ([70, 150, 255], [255, 150, 30]), "ends of the scale");
}

/// The picture of the accumulators of a file, whose demo has to succeed: its width and pixels, if it is drawn.
fn accumulators(folder: &Path, text: &str, options: &[&str]) -> Option<(usize, Vec<[u8; 3]>)> {
    let [file, out] = ["a.tri", "d"].map(|name| folder.join(name));
    std::fs::write(&file, text).unwrap();
    let paths = [file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    let printed = edgewalk(&[&["demo"], &paths[..], options].concat());
    let picture = out.join("z_accumulator.png");
    assert_eq!(printed.contains(" z_accumulator.png\n"), picture.is_file(), "{printed}");
    picture.is_file().then(|| png(&picture))
}

/// Lines are walked with their axes exchanged: their screen may have fewer columns than they have lines.
#[test]
fn lines_are_black_in_the_picture_of_the_accumulators() {
    let folder = tempfile::tempdir().unwrap();
    let text = "size 16 12\nT 1 1 0.3 1 0 0 0  15 2 0.7 1 0 0 0  2 11 0.4 1 0 0 0\n\
                S 0 2 0.2 1 0 0 0  16 9 0.1 1 1 0 0\nS 3 0 0.2 1 0 0 0  5 12 0.1 1 1 0 0\n";
    let (width, map) = accumulators(folder.path(), text, &["--adapt"]).unwrap();
    let at = |x: usize, y: usize| map[y * width + x];
    let of_lines = [(0, 2), (8, 5), (15, 8), (3, 0), (4, 11)].map(|(x, y)| at(x, y));
    assert_eq!(of_lines, [[0; 3]; 5]);
    for (x, y) in [(8, 3), (2, 8), (10, 3)] {
        assert_ne!(at(x, y), [0; 3], "the triangle at {x},{y}");
    }
}

/// POLY walks other edges than EDGE.
#[test]
fn a_machine_with_poly_has_no_picture_of_the_accumulators() {
    let folder = tempfile::tempdir().unwrap();
    let text = "size 16 12\nP 4 1 1 0.5 1 0 0 0  15 1 0.5 1 0 0 0  15 11 0.9 1 0 0 0  1 11 0.9 1 0 0 0\n";
    assert!(accumulators(folder.path(), text, &["--machine", "polygon"]).is_none());
    assert!(accumulators(folder.path(), text, &["--machine", "small", "--adapt"]).is_some());
}

/// The command that the demo prints shows the demo's input on the demo's machine, whatever a shell makes of its words.
#[test]
fn the_printed_replay_is_of_the_same_machine() {
    let folder = tempfile::tempdir().unwrap();
    let text = "size 16 12\nextra 1\nT 0 0 0 1 0 0 0  14 0 0 0 1 0 0  0 9 1 0 0 1 0\nX 0 0 1\n";
    std::fs::write(folder.path().join("a b.tri"), text).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_edgewalk"));
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let shell = |command: &str| {
        let mut shell = Command::new("sh");
        shell.args(["-c", command]).current_dir(folder.path()).env("PATH", &path);
        let output = shell.output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{command}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let demo = "edgewalk demo --machine up5k --set memory.latency=5 --adapt --out 'd d'";
    let printed = shell(&format!("{demo} 'a b.tri'"));
    let command = printed.lines().find_map(|line| line.strip_prefix("at work   ")).unwrap();
    let replayed: Value = serde_json::from_str(&shell(&format!("{command} --json"))).unwrap();
    let report: Value =
        serde_json::from_str(&std::fs::read_to_string(folder.path().join("d d/report.json")).unwrap())
            .unwrap();
    assert!(report["machine"].is_string() && replayed["hash"] == report["machine"], "{command}");
    assert_eq!(replayed["file"], "d d/replay.html");
    // The standard input has been read.
    let printed = shell(&format!("{demo} - <'a b.tri'"));
    assert!(printed.contains("\nvectors   ") && !printed.contains("at work"), "{printed}");
}
