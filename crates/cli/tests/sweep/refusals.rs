//! Malformed sweeps: a clear error before anything runs.

use crate::support::{edgewalk, names, run};

/// Arguments behind `sweep`, and what the error must say.
const REFUSED: [(&[&str], &[&str]); 32] = [
    (
        &["sphere", "--vary", "interpolator.ader=1,2"],
        &["unknown key interpolator.ader", "nearest: interpolator.adders"],
    ),
    (&["sphere", "--vary", "interpolator.adders"], &["interpolator.adders", "write key=a,b,c"]),
    (&["sphere", "--vary", "interpolator.adders="], &["no value", "1 to 8"]),
    (&["sphere", "--vary", "formats.z_fraction=14..6"], &["empty range", "14 is above 6"]),
    (&["sphere", "--vary", "formats.z_fraction=6..40"], &["permitted from 0 to 24"]),
    (&["sphere", "--vary", "formats.z_fraction=6..14..0"], &["the step is 0; permitted: 1 or more"]),
    (&["sphere", "--vary", "formats.z_fraction=six..14"], &["six is no whole number"]),
    (&["sphere", "--vary", "memory.hazard=drain..forward"], &["takes words", "interlock"]),
    (&["sphere", "--vary", "setup.lanes=1,3"], &["setup.lanes = 3 is not permitted", "nearest: 2"]),
    (&["sphere", "--vary", "setup.lanes=1,1"], &["1 comes twice"]),
    (&["sphere", "--vary", "setup.lanes=1", "--vary", "setup.lanes=2"], &["setup.lanes", "varied twice"]),
    (
        &[
            "sphere",
            "--vary",
            "screen.width=1..1000",
            "--vary",
            "screen.height=1..1000",
            "--vary",
            "screen.guard_bits=2..14",
            "--vary",
            "formats.z_fraction=0..24",
            "--vary",
            "fifo.span=1..64",
        ],
        &["20800000000 machines", "200000 points", "--sample"],
    ),
    (
        &["sphere", "--vary", "setup.lanes=1", "--objective", "cycles", "--objective", "cycles"],
        &["cycles", "is given twice; give it once"],
    ),
    (&["sphere", "--vary", "setup.lanes=1", "--objective", "cylces"], &["cylces", "nearest: cycles"]),
    (&["sphere", "--vary", "setup.lanes=1", "--objective", "lut4"], &["lut4", "--synth"]),
    (&["sphere", "--vary", "setup.lanes=1", "--sample", "0"], &["--sample 0", "at least 1"]),
    (
        &["sphere", "--vary", "setup.lanes=1", "--stalls", "none", "--judge", "dram"],
        &["--judge dram", "permitted: worst, sum, none"],
    ),
    (&["sphere", "--vary", "setup.lanes=1", "--judge", "wost"], &["--judge wost", "nearest: worst"]),
    (
        &["sphere", "--vary", "setup.lanes=1", "--judge-inputs", "wost"],
        &["--judge-inputs wost", "permitted: sum, worst", "nearest: worst"],
    ),
    (
        &["sphere", "--vary", "setup.lanes=1", "--judge-inputs", "worst", "--weight", "sphere=2"],
        &["--weight: weights are those of a sum"],
    ),
    (&["sphere", "--vary", "setup.lanes=1", "--weight", "sphere"], &["--weight sphere: write INPUT=NUMBER"]),
    (
        &["sphere", "--vary", "setup.lanes=1", "--weight", "spehre=2"],
        &["--weight spehre=2: unknown input spehre", "nearest: sphere"],
    ),
    (
        &["sphere", "--vary", "setup.lanes=1", "--weight", "sphere=0"],
        &["`0`: permitted: a finite number above 0"],
    ),
    (
        &["sphere", "--vary", "setup.lanes=1", "--weight", "sphere=inf"],
        &["`inf`: permitted: a finite number"],
    ),
    (
        &["sphere", "--vary", "setup.lanes=1", "--weight", "sphere=1e308"],
        &["`1e308`: permitted: a finite number above 0, at most 1e9"],
    ),
    (
        &["sphere", "--vary", "setup.lanes=1", "--weight", "sphere=2", "--weight", "sphere=3"],
        &["--weight sphere=3: sphere has a weight already; give it once"],
    ),
    (&["sphere", "--vary", "setup.lanes=1", "--stalls", "drm"], &["drm", "nearest: dram"]),
    (&["sphere", "--vary", "setup.lanes=1", "--stalls", "fixed:rd=x"], &["rd = x", "0 to 1048576"]),
    (&["sphere", "--vary", "setup.lanes=1", "--bound", "0.4"], &["--bound 0.4", "above 0.5"]),
    (&["sphere", "sphere", "--vary", "setup.lanes=1"], &["sphere", "is given twice; give it once"]),
    (&["spehre", "--vary", "setup.lanes=1"], &["spehre", "sphere"]),
    (&["sphere", "--vary", "setup.lanes=1", "--shading", "wireframe"], &["wireframe", "gouraud"]),
];

#[test]
fn malformed_sweeps_are_refused_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    let mut refused = 0;
    for (arguments, said) in REFUSED {
        let (code, error) = run(folder.path(), &[&["sweep", "--out", "out"], arguments].concat());
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        assert!(said.iter().all(|word| error.contains(word)), "{arguments:?}: {error}");
        assert!(names(folder.path()).is_empty(), "{arguments:?} left something");
        refused += 1;
    }
    assert!(refused >= 15);
    for missing in [
        &["sweep", "sphere", "--vary", "setup.lanes=1"][..],
        &["sweep", "--out", "o"],
        &["sweep", "sphere", "--out", "o"],
    ] {
        assert_eq!(run(folder.path(), missing).0, Some(2), "{missing:?}");
    }
}

#[test]
fn help_has_examples() {
    for command in [&["sweep"][..], &["size"], &["compare"]] {
        let output = edgewalk(std::path::Path::new("."), &[command, &["--help"]].concat()).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains(&format!("  edgewalk {}", command[0])), "{text}");
    }
}

#[test]
fn an_output_that_cannot_be_written_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = |out: &str| run(folder.path(), &["sweep", "sphere", "--vary", "setup.lanes=1", "--out", out]);
    std::fs::write(folder.path().join("file"), "").unwrap();
    let (code, error) = sweep("file/out");
    assert!(code == Some(2) && error.contains("file/out"), "{error}");
    // Where rows stand there is something else.
    std::fs::create_dir_all(folder.path().join("s/runs.jsonl")).unwrap();
    let (code, error) = sweep("s");
    assert!(code == Some(2) && error.contains("s/runs.jsonl"), "{error}");
    // A line that is none is named.
    std::fs::create_dir_all(folder.path().join("t")).unwrap();
    std::fs::write(
        folder.path().join("t/runs.jsonl"),
        "{\"key\":\"1\",\"status\":\"ok\"}\nnonsense\n{\"key\":\"2\",\"status\":\"ok\"}\n",
    )
    .unwrap();
    let (code, error) = sweep("t");
    assert!(code == Some(2) && error.contains("line 2") && error.contains("t/runs.jsonl"), "{error}");
}
