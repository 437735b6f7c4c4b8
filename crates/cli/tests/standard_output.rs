//! Every command with a reader that has gone away, and with an output that is full.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{SCREEN, TRIANGLE, edgewalk, ended, names, run};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufRead as _;
use std::path::Path;
use std::process::Stdio;

/// A quick run of each command, as text; those with a report also come with --json.
pub const COMMANDS: [&[&str]; 27] = [
    &["demo", "d.tri", "--out", "demo"],
    &["render", "d.tri", "--out", "render"],
    &["render", "sphere", "--engine", "golden", "--out", "shaded"],
    &["gallery", "worked-example", "--out", "gallery"],
    &["explain", "d.tri", "10", "10"],
    &["raster", "d.tri", "--out", "raster"],
    &["triangles", "d.tri", "--out", "t.tri"],
    &["judge", "d.tri", "d.png", "--color-lsb", "255"],
    &["emit", "--out", "emit"],
    &["vectors", "--suite", "hazards", "--unit", "depth", "--out", "vectors"],
    &["verify", "d.tri", "--triangles", "1", "--no-simulators", "--set", "screen.guard_bits=7"],
    &[
        "energy",
        "d.tri",
        "--cycles",
        "100",
        // The machine of the fewest gates: its mapping takes longest.
        "--machine",
        "small",
        "--set",
        "screen.guard_bits=7",
        "--set",
        "screen.subpixel_bits=0",
        "--set",
        "formats.z_bits=4",
        "--set",
        "formats.z_fraction=0",
        "--set",
        "formats.color_bits=2",
        "--set",
        "formats.color_fraction=0",
        "--cache",
        concat!(env!("CARGO_TARGET_TMPDIR"), "/synth"),
    ],
    &["mutants", "--unit", "span", "--bench", "true", "--sample", "1", "--out", "mutants"],
    &["trace", "d.tri", "--out", "t.vcd", "--cycles", "10"],
    &["bench", "d.tri", "--engine", "fast", "--repeat", "1"],
    &["synth", "--unit", "span", "--seeds", "1", "--cache", concat!(env!("CARGO_TARGET_TMPDIR"), "/synth")],
    &["estimate", "small"],
    &["calibrate", "--machines", "machines.txt", "--data", "rows.csv", "--fit", "fit.json"],
    &["size", "d.tri"],
    &["sweep", "d.tri", "--vary", "interpolator.adders=1,2", "--out", "sweep"],
    &["compare", "default", "default", "d.tri"],
    &["replay", "d.tri", "--out", "r.html"],
    &["config", "print"],
    &["config", "check"],
    &["config", "explain"],
    &["completions", "bash"],
    &["man", "--out", "man"],
];

/// On the screen of the file, for the commands that have a machine.
pub fn arguments<'a>(command: &[&'a str], json: bool) -> Vec<&'a str> {
    let mut arguments = command.to_vec();
    if !["gallery", "calibrate", "completions", "man"].contains(&command[0]) {
        arguments.extend(SCREEN);
    }
    if json {
        arguments.push("--json");
    }
    arguments
}

pub fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("d.tri"), TRIANGLE).unwrap();
    // The first of the machines that were measured.
    for (name, data) in [
        ("machines.txt", include_str!("../../synth/data/machines.txt")),
        ("rows.csv", include_str!("../../synth/data/ice40.csv")),
    ] {
        let lines: Vec<&str> = data.lines().take(8).collect();
        std::fs::write(folder.path().join(name), lines.join("\n") + "\n").unwrap();
    }
    // A picture of that size, of nothing.
    image::RgbImage::new(64, 48).save(folder.path().join("d.png")).unwrap();
    folder
}

/// Runs a command with a pipe whose reader takes `lines` lines and goes away; exit code and standard error.
fn with_head(folder: &Path, arguments: &[&str], lines: usize) -> (Option<i32>, String) {
    let mut child =
        edgewalk(folder, arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let out = std::io::BufReader::new(child.stdout.take().unwrap());
    let taken: Vec<_> = out.lines().take(lines).collect();
    assert_eq!(taken.len(), lines, "{arguments:?} prints less");
    ended(&child.wait_with_output().unwrap())
}

#[test]
fn every_command_is_here() {
    let help = edgewalk(Path::new("."), &["--help"]).output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = list.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let listed: BTreeSet<&str> = names.filter(|name| !name.is_empty() && *name != "help").collect();
    let tried: BTreeSet<&str> = COMMANDS.iter().map(|command| command[0]).collect();
    assert_eq!(listed, tried);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = folder();
    let mut checked = 0;
    for command in COMMANDS {
        for (json, lines) in [(false, 0), (false, 1), (true, 0)] {
            let arguments = arguments(command, json);
            let ended = with_head(folder.path(), &arguments, lines);
            assert_eq!(ended, (Some(0), String::new()), "{arguments:?} | head -{lines}");
            checked += 1;
        }
    }
    for page in ["--help", "--version"] {
        assert_eq!(with_head(folder.path(), &[page], 0), (Some(0), String::new()), "{page}");
        checked += 1;
    }
    println!("checked {checked} / {} runs", 3 * COMMANDS.len() + 2);
    assert_eq!(checked, 3 * COMMANDS.len() + 2);
    assert!(names(folder.path()).len() > 7, "files are written all the same");
}

#[test]
fn a_full_output_is_an_error_with_its_reason() {
    let folder = folder();
    let full = || Stdio::from(File::options().write(true).open("/dev/full").unwrap());
    let mut runs: Vec<Vec<&str>> =
        COMMANDS.iter().flat_map(|command| [false, true].map(|json| arguments(command, json))).collect();
    runs.extend([vec!["--help"], vec!["--version"], vec!["render", "--help"]]);
    for arguments in &runs {
        let output = edgewalk(folder.path(), arguments).stdout(full()).output().unwrap();
        let (code, error) = ended(&output);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        let why = "standard output: No space left on device (os error 28)";
        let said = if arguments.contains(&"--json") {
            format!(
                "{{\"format\":\"edgewalk-error\",\"version\":[1,0],\"error\":\"{why}\",\"exit_code\":2}}\n"
            )
        } else {
            format!("error: {why}\n")
        };
        assert_eq!(error, said, "{arguments:?}");
    }
    // Where the reason cannot be written either, the exit code is left.
    for arguments in [&["raster", "none.tri", "--out", "o"][..], &["no-such-command"]] {
        let output = edgewalk(folder.path(), arguments).stdout(full()).stderr(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    println!("checked {0} / {0} runs", runs.len() + 2);
}

#[test]
fn a_quiet_command_says_why_it_failed() {
    let folder = folder();
    let far = "[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 18]\n[[object]]\nmesh = \"quad.obj\"\n";
    std::fs::write(folder.path().join("far.toml"), far).unwrap();
    std::fs::write(folder.path().join("quad.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    std::fs::write(folder.path().join("empty.tri"), "size 64 48\n").unwrap();
    let mut commands: Vec<Vec<&str>> = vec![
        vec!["render", "far.toml"],
        vec!["render", "far.toml", "--engine", "golden", "--shading", "phong"],
        vec!["render", "empty.tri"],
        vec!["render", "empty.tri", "--engine", "golden"],
        vec!["demo", "far.toml"],
        vec!["verify", "far.toml", "--no-simulators"],
        vec!["render", "none.obj"],
        vec!["raster", "none.tri", "--out", "o"],
    ];
    for command in &mut commands {
        command.push("--quiet");
        command.extend(SCREEN);
        let (code, error) = run(folder.path(), command);
        assert_eq!(code, Some(2), "{command:?}: {error}");
        assert!(error.starts_with("error: ") && error.len() > 30, "{command:?}: `{error}`");
    }
    println!("checked {0} / {0} commands", commands.len());
}
