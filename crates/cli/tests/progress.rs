//! Bars on a terminal beside long work, and none where they were not asked for.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{TRIANGLE, edgewalk};
use std::path::Path;
use std::process::Command;

/// What a terminal of 120 columns gets to see, its lines as they overwrite each other.
fn seen(folder: &Path, arguments: &[&str]) -> String {
    let quoted = |word: &&str| format!("'{word}'");
    let arguments: Vec<String> = arguments.iter().map(quoted).collect();
    let command = format!("stty cols 120; '{}' {}", env!("CARGO_BIN_EXE_edgewalk"), arguments.join(" "));
    let mut terminal = Command::new("script");
    // A runner without a terminal may have no TERM, which would be a terminal without bars.
    terminal
        .env("TERM", "xterm")
        .args(["-qec", &command, "/dev/null"])
        .current_dir(folder)
        .stdin(std::process::Stdio::null());
    let output = terminal.output().expect("script, of util-linux");
    let text = String::from_utf8_lossy(&output.stdout).replace('\r', "\n");
    assert!(output.status.success(), "{command}: {text}");
    text
}

#[test]
fn a_terminal_sees_how_far_long_work_is_and_with_quiet_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("d.tri"), TRIANGLE).unwrap();
    let tick = ["raster", "d.tri", "--engine", "model", "--out", "m"];
    let commands: [(&[&str], &str); 6] = [
        (&["raster", "d.tri", "--out", "o"], "/59 bytes"),
        (&tick, "1/1 triangles"),
        (&["bench", "d.tri", "--repeat", "1", "--engine", "fast,tick"], "2/2 engines"),
        (&["sweep", "d.tri", "--vary", "interpolator.adders=1,2", "--out", "s"], "2/2 points"),
        (&["vectors", "d.tri", "--unit", "depth", "--out", "v"], "1/1 vector directories"),
        (
            &["vectors", "--suite", "random", "--count", "80", "--unit", "machine", "--no-csv", "--out", "w"],
            "of 80 tokens have entered",
        ),
    ];
    for (command, bar) in commands {
        let text = seen(folder.path(), command);
        let of = text.lines().filter(|line| line.contains(['█', '░'])).collect::<Vec<_>>();
        assert!(of.iter().any(|line| line.contains(bar)), "{command:?}: {of:?}");
        let text = seen(folder.path(), &[command, &["-q"]].concat());
        assert!(!text.contains('█') && !text.contains('░'), "{command:?}: {text}");
        // Standard error that is no terminal has none either.
        let output = edgewalk(folder.path(), command).output().unwrap();
        assert!(output.status.success() && !String::from_utf8_lossy(&output.stderr).contains('█'));
    }
}
