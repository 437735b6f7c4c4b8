//! `edgewalk vectors` as a user runs it: own triangles, without tables, with what is missing said.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

const TRIANGLES: &str = "size 24 20\nmode gouraud\ndepth greater\n\
    T 1 1 0.2 1 0 0 1  12 3 0.5 0 1 0 1  4 15 0.8 0 0 1 1\n\
    T 2 2 0.3 1 0 0 1  12 4 0.5 0 1 0 1  4 15 0.8 0 0 1 1\n";

fn vectors(folder: &Path, arguments: &[&str]) -> Output {
    std::fs::write(folder.join("own triangles.tri"), TRIANGLES).expect("written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(["vectors", "--out", "v", "--set", "screen.guard_bits=6"]).args(arguments);
    command.current_dir(folder).output().expect("the program runs")
}

fn manifest(folder: &Path, name: &str) -> Value {
    let text = std::fs::read(folder.join("v").join(name).join("manifest.json")).expect("written");
    serde_json::from_slice(&text).expect("JSON")
}

#[test]
fn own_triangles_become_vectors_of_any_unit() {
    let folder = tempfile::tempdir().expect("a folder");
    let output =
        vectors(folder.path(), &["own triangles.tri", "--unit", "pixel", "--unit", "depth", "--no-csv"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{told}");
    // Two triangles meet little, and that is said.
    assert!(told.contains("warning: pixel: not covered: off_screen\n"), "{told}");
    let mut names: Vec<String> = std::fs::read_dir(folder.path().join("v"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names, ["own_triangles_depth", "own_triangles_pixel"]);
    let depth = manifest(folder.path(), "own_triangles_depth");
    assert_eq!(depth["suite"]["triangles"], 2);
    // The file's size and depth function count.
    assert_eq!(depth["machine"]["settings"]["screen.width"], "24");
    assert_eq!(depth["constants"]["depth_func"], 4);
    assert!(depth["channels"][0]["table"].is_null());
    let files = depth["files"].as_array().expect("a list");
    assert!(files.iter().all(|file| !file["name"].as_str().expect("text").ends_with(".csv")));
    let output =
        Command::new("make").args(["-C", "v/own_triangles_pixel", "icarus"]).current_dir(&folder).output();
    let output = output.expect("make is installed");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.lines().any(|line| line == "PASS"), "{said}");
}

#[test]
fn tables_are_written_unless_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let output =
        vectors(folder.path(), &["own triangles.tri", "--unit", "pixel", "--triangles", "1", "--quiet"]);
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
    let pixel = manifest(folder.path(), "own_triangles_pixel");
    assert_eq!(pixel["suite"]["triangles"], 1);
    assert_eq!(pixel["channels"][0]["table"], "span.csv");
    assert!(folder.path().join("v/own_triangles_pixel/span.csv").exists());
}

#[test]
fn a_huge_directory_is_announced_before_it_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let wide = "size 1024 1024\nT 0 0 0 0 0 0 1  1024 0 0 0 0 0 1  0 1024 0 0 0 0 1\n";
    std::fs::write(folder.path().join("wide.tri"), wide).expect("written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(["vectors", "wide.tri", "--unit", "depth", "--stalls", "none", "--out", "v"]);
    let output = command.current_dir(&folder).output().expect("the program runs");
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{told}");
    assert!(told.contains("warning: wide_depth: writing ") && told.contains("--no-csv"), "{told}");
}

#[test]
fn a_suite_for_other_units_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let small = ["--set", "screen.width=24", "--set", "screen.height=20"];
    let output =
        vectors(folder.path(), &[&["--suite", "depth_less", "--unit", "pixel"][..], &small].concat());
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("--suite depth_less: it is for the units machine, depth only"), "{told}");
    assert!(!folder.path().join("v").exists());
}

/// A frame that is shaded at each pixel: its records and tables are there, and what the bench expects is its picture.
#[test]
fn shaded_triangles_bring_their_words() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = "size 24 20\nmode phong\nview 0 0 1\nsun 0.3 0.3 1 0.9\nspecular halfway\nmaterial 0.1 0.6 0.3 20\n\
        T 1 1 0.2 1 0.5 0 1  20 3 0.5 1 0.5 0 1  4 15 0.8 1 0.5 0 1\nN -0.3 -0.3 0.9055  0.5 -0.3 0.8124  -0.3 0.5 0.8124\n\
        material 0.2 0.4 0.4 5\n\
        T 2 2 0.1 0 0.5 1 1  12 4 0.1 0 0.5 1 1  4 18 0.1 0 0.5 1 1\nN 0.3 -0.3 0.9055  0 0 1  -0.3 0.5 0.8124\n";
    std::fs::write(folder.path().join("shaded.tri"), file).expect("written");
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
        command.args(arguments).args(["--set", "shade.kind=phong", "--set", "screen.guard_bits=6"]);
        let output = command.current_dir(&folder).output().expect("the program runs");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let wanted = ["--unit", "machine", "--unit", "term", "--unit", "normal", "--unit", "shade"];
    let (code, told) = run(&[&["vectors", "shaded.tri", "--no-csv", "--out", "v"][..], &wanted].concat());
    assert_eq!(code, Some(0), "{told}");
    for unit in ["machine", "term", "normal", "shade"] {
        let make = ["-C", &format!("v/shaded_{unit}"), "icarus"].map(str::to_owned);
        let output =
            Command::new("make").args(make).current_dir(&folder).output().expect("make is installed");
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && said.lines().any(|line| line == "PASS"), "{unit}: {said}");
    }
    let (code, told) = run(&["raster", "shaded.tri", "--engine", "model", "--out", "picture"]);
    assert_eq!(code, Some(0), "{told}");
    let (_, _, rgb) = crate::support::npy(&folder.path().join("picture/rgb.npy"));
    let machine = manifest(folder.path(), "shaded_machine");
    let channels = machine["channels"].as_array().expect("a list");
    let writes = channels.iter().find(|channel| channel["name"] == "wr").expect("it writes");
    let text = std::fs::read_to_string(folder.path().join("v/shaded_machine/wr.exp.mem")).expect("written");
    let mut drawn = std::collections::BTreeMap::new();
    for line in text.lines() {
        let token = u128::from_str_radix(line, 16).expect("hex");
        let field = |port: &str| {
            let fields = writes["fields"].as_array().expect("a list");
            let field = fields.iter().find(|field| field["port"] == port).expect("a write has it");
            let number = |key: &str| field[key].as_u64().expect("a number");
            (token >> number("lsb") & ((1 << number("width")) - 1)) as usize
        };
        drawn.insert(field("wr_addr"), ["wr_r", "wr_g", "wr_b"].map(|port| field(port) as u8));
    }
    assert!(drawn.len() > 100, "{}", drawn.len());
    for (address, colour) in &drawn {
        let pixel = (address / 32 * 24 + address % 32) * 3;
        let drawn =
            rgb[8 * pixel..].chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight")));
        let drawn: Vec<u8> = drawn.take(3).map(|value| (value * 255.0).round() as u8).collect();
        assert_eq!(drawn, colour, "address {address}");
    }
    let few = ["vectors", "shaded.tri", "--out", "w", "--set", "term.record_bits=1"];
    assert_eq!(run(&few).0, Some(0));
    std::fs::write(
        folder.path().join("shaded.tri"),
        format!("{file}{}", &file[file.rfind('T').unwrap_or(0)..]),
    )
    .expect("written");
    let (code, told) = run(&few);
    assert_eq!(code, Some(2), "{told}");
    assert!(told.contains("add --triangles 2, or --set term.record_bits=2"), "{told}");
}
