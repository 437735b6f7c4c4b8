//! `--triangles` on a machine with POLY: whole polygons are taken or left, and counts are of polygons, not of tokens.

use crate::support::{edgewalk, root, run};
use std::path::Path;

/// Three polygons, which are five tokens at the port.
const POLYGONS: [&str; 3] = [
    "P 4  4 4 .5 1 0 0 0   60 8 .5 1 0 0 0   50 44 .5 1 0 0 0  5 40 .5 1 0 0 0\n",
    "P 4  14 14 .4 0 1 0 0   40 18 .4 0 1 0 0   40 34 .4 0 1 0 0  15 30 .4 0 1 0 0\n",
    "P 3  14 14 .3 0 1 0 0   40 18 .3 0 1 0 0   40 34 .3 0 1 0 0\n",
];

/// The polygons at these places as a file.
fn write(folder: &Path, name: &str, places: &[usize]) {
    let polygons: String = places.iter().map(|place| POLYGONS[*place]).collect();
    std::fs::write(folder.join(name), format!("size 64 48\n{polygons}")).expect("written");
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "q.tri", &[0, 1, 2]);
    folder
}

/// What a command prints that must succeed, on the preset with POLY.
fn printed(folder: &Path, arguments: &[&str]) -> String {
    let output = edgewalk(folder, &[arguments, &["--machine", "polygon"]].concat()).output().expect("runs");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

fn json(folder: &Path, arguments: &[&str]) -> serde_json::Value {
    serde_json::from_str(&printed(folder, &[arguments, &["--json"]].concat())).expect("JSON")
}

#[test]
fn a_sample_has_whole_polygons() {
    let (folder, mut checked) = (folder(), 0);
    let folder = folder.path();
    let token_file = |out: &str, file: &str| {
        std::fs::read_to_string(folder.join(format!("{out}/{file}_setup/tri.in.mem"))).expect("written")
    };
    for (wanted, places) in [("1", &[0][..]), ("2", &[0, 2]), ("3", &[0, 1, 2]), ("9", &[0, 1, 2])] {
        write(folder, "some.tri", places);
        let unit = ["--unit", "setup", "--no-csv", "-q", "--out"];
        printed(folder, &[&["vectors", "q.tri", "--triangles", wanted][..], &unit, &["sample"]].concat());
        printed(folder, &[&["vectors", "some.tri"][..], &unit, &["some"]].concat());
        assert_eq!(token_file("sample", "q"), token_file("some", "some"), "--triangles {wanted}");
        checked += places.len();
    }
    let verify = ["verify", "q.tri", "--triangles", "1", "--no-simulators", "--only", "q"];
    assert!(printed(folder, &verify).contains("pass  input"));
    println!("{checked} polygons");
}

/// The first polygons by each command that takes them are those of a file with these alone.
#[test]
fn the_first_polygons_are_drawn_whole() {
    let folder = folder();
    let folder = folder.path();
    let mut checked = 0;
    for count in 1..=3 {
        write(folder, "some.tri", &(0..count).collect::<Vec<_>>());
        let cycles = &json(folder, &["render", "some.tri", "--out", "r"])["cycles"]["total"];
        assert!(cycles.as_u64() > Some(100));
        let first = ["--triangles", &count.to_string()];
        for (command, out) in [("trace", "t.vcd"), ("replay", "q.json")] {
            let report = json(folder, &[&[command, "q.tri", "--out", out][..], &first].concat());
            assert_eq!(&report["cycles"], cycles, "{command} {count}");
            checked += 1;
        }
        let explained = json(folder, &[&["explain", "q.tri", "34", "24"][..], &first].concat());
        let listed = |key: &str| explained[key].as_array().map(Vec::len);
        assert_eq!(
            [listed("fragments"), listed("polygons"), listed("poly")],
            [Some(count); 3],
            "{explained}"
        );
    }
    println!("{checked} runs");
    let (code, error) =
        run(folder, &["trace", "q.tri", "--triangle", "3", "--out", "t.vcd", "--machine", "polygon"]);
    assert_eq!((code, error.contains("--triangle 3: permitted: 0 to 2")), (Some(2), true), "{error}");
    // The last polygon enters behind four tokens.
    let last = json(folder, &["trace", "q.tri", "--triangle", "2", "--out", "t.vcd"]);
    let whole = json(folder, &["trace", "q.tri", "--out", "t.vcd"]);
    assert!(last["cycles"].as_u64() > Some(100) && last["cycles"].as_u64() < whole["cycles"].as_u64());
}

#[test]
fn polygons_are_counted_as_polygons() {
    let folder = folder();
    let folder = folder.path();
    for (arguments, words) in [
        (&["replay", "q.tri", "--out", "q.html"][..], ", 3 of 3 polygons, "),
        (&["replay", "q.tri", "--triangles", "1", "--out", "q.json"], ", 1 of 3 polygons, "),
        (&["replay", "--lesson", "--out", "l.json"], ", 1 of 1 polygon, "),
        (&["size", "q.tri", "--out", "s"], "q.tri: 3 polygons on 64x48"),
        (&["render", "q.tri", "--out", "r"], "q.tri: 3 polygons on 64x48"),
        (&["bench", "q.tri", "--engine", "fast", "--repeat", "1"], "3 polygons, 2450 fragments"),
    ] {
        let text = printed(folder, arguments);
        assert!(text.contains(words), "{arguments:?}: {text}");
        let html = arguments.contains(&"q.html");
        assert_eq!(text.contains("open it in a browser"), html, "{arguments:?}: {text}");
    }
    for (file, scene) in [("q.json", (1, 3, "the first 1 of 3 polygons")), ("l.json", (1, 1, "1 polygon"))] {
        let text = std::fs::read_to_string(folder.join(file)).expect("written");
        let found = &serde_json::from_str::<serde_json::Value>(&text).expect("JSON")["scene"];
        assert_eq!(
            (&found["triangles"], &found["of"], &found["drawn"]),
            (&scene.0.into(), &scene.1.into(), &scene.2.into())
        );
    }
    let mixed = root().join("docs/scenes/polygons.tri").display().to_string();
    // A replay shows those of the file, the others tell what the machine takes: no plane holds one of them.
    let words = "6 triangles and 5 polygons";
    for (arguments, words) in [
        (&["render", &mixed, "--out", "r"][..], words),
        (&["bench", &mixed, "--engine", "fast", "--repeat", "1"], words),
        (&["replay", &mixed, "--cycles", "9", "--out", "q.html"], ", 6 of 6 polygons, "),
    ] {
        let text = printed(folder, arguments);
        assert!(text.contains(words), "{arguments:?}: {text}");
    }
}
