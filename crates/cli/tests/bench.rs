//! `edgewalk bench`: every engine takes part, does the same work, and one line of JSON says how fast.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use serde_json::Value;
use std::fmt::Write as _;
use std::process::Command;
use std::time::Instant;

/// Those that take part.
const ENGINES: &[&str] = if cfg!(feature = "jit") {
    &["fast", "tick", "jit", "interpreter", "verilator"]
} else {
    &["fast", "tick", "interpreter", "verilator"]
};

fn bench(arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("steps.tri");
    let mut text = String::from("size 40 30\n");
    for i in 0..300 {
        let (x, z) = (i % 30, f64::from(i % 7) / 7.0);
        writeln!(text, "T {x} 2 {z} 1 0 0 0  {x} 29 0.5 0 1 0 0  39.5 {} 0 0 0 1 0", i % 28).unwrap();
    }
    std::fs::write(&file, text).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .arg("bench")
        .arg(&file)
        .args(["--json", "--repeat", "2"])
        .args(arguments)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.stdout.iter().filter(|byte| **byte == b'\n').count(), 1, "one line");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn every_engine_says_how_fast_it_is() {
    // Verilator's C++ of one lane is sooner compiled.
    let began = Instant::now();
    let result = bench(&["--set", "setup.lanes=1"]);
    let whole = began.elapsed().as_secs_f64() * 1e3;
    assert_eq!((&result["renderer"], &result["engine"]), (&"edgewalk".into(), &"fast".into()));
    let engines = result["engines"].as_array().unwrap();
    let names: Vec<&str> = engines.iter().map(|row| row["engine"].as_str().unwrap()).collect();
    assert_eq!(names, ENGINES);
    assert_eq!(result["cpu_ms_median"], engines[0]["cpu_ms_median"]);
    assert_eq!(result["ms_min"], engines[0]["ms_min"]);
    let cycles = result["cycles"].as_u64().unwrap();
    assert!(cycles > 50_000, "{cycles} cycles");
    for row in engines {
        if let Some(absent) = row["absent"].as_str() {
            assert_eq!(absent, "verilator is not installed");
            continue;
        }
        let number = |key: &str| row[key].as_f64().unwrap();
        assert!(row["cycles"].as_u64().unwrap() <= cycles);
        for (rate, count) in [
            ("cycles_per_second", "cycles"),
            ("pixels_per_second", "fragments"),
            ("triangles_per_second", "triangles"),
        ] {
            let expected = number(count) * 1e3 / number("cpu_ms_median");
            assert!((number(rate) / expected - 1.0).abs() < 1e-9, "{rate} of {row}");
        }
        // By one clock: the least is no more than the median.
        assert!(number("ms_min") > 0.0 && number("ms_min") <= number("cpu_ms_median"), "{row}");
        // From the beginning, so with what has to be built: of Verilator's a program, in no less than half a second.
        let built = if row["engine"] == "verilator" { 500.0 } else { 0.0 };
        assert!(number("first_ms") > built && number("first_ms") < whole, "{row}, {whole} ms");
        assert!(row["noise"].is_null(), "two frames have no quartiles: {row}");
    }
}

/// What is said of an engine that draws a part only: how large it is; of the others nothing.
#[test]
fn an_engine_that_draws_a_part_says_which() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = String::from("size 640 480\n");
    (0..9)
        .for_each(|i| writeln!(text, "T 0 {i} 0.5 1 0 0 0  639 9 0.5 0 1 0 0  30 479 0.5 0 0 1 0").unwrap());
    std::fs::write(folder.path().join("large.tri"), text).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.current_dir(folder.path());
    command.args(["bench", "large.tri", "--repeat", "1", "--engine", "fast,tick,interpreter"]);
    let output = command.output().unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    let line = |engine: &str| told.lines().find(|line| line.starts_with(engine)).unwrap();
    assert!(line("interpreter").contains("  first 1 triangles, "), "{told}");
    assert!(["fast", "tick"].iter().all(|engine| !line(engine).contains("first")), "{told}");
}

/// Terms, tables, roots and texels from the host: every engine takes the same cycles and makes the same writes.
#[test]
fn machines_that_shade_take_part() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("shaded.tri");
    let mut text = String::from(
        "size 40 30\nmode phong\nview 0 0 1\nsun 0 1 1 0.8\nmaterial 0.1 0.8 0.3 20\ntexture 2 1 ff0000 00ff80\n",
    );
    for i in 0..9 {
        writeln!(text, "T {i} 2 0.5 1 1 0 0  {i} 29 0.4 0 1 1 0  39.5 {} 0.3 1 0 1 0", 3 * i).unwrap();
        text += "N 0 0 1  0 0.6 0.8  0.6 0 0.8\nUV 0 0  3 0  0 2\n";
    }
    std::fs::write(&file, text).unwrap();
    let run = |more: &[&str]| {
        let shades = [
            "setup.lanes=1",
            "shade.kind=phong",
            "shade.colour=multiply",
            "texture.kind=nearest",
            "texture.bits=3",
        ];
        let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
        command.arg("bench").arg(&file).args(["--json", "--repeat", "1"]).args(more);
        shades.iter().for_each(|setting| _ = command.args(["--set", setting]));
        command.output().unwrap()
    };
    let output = run(&["--set", "term.record_bits=4", "--set", "shade.material_bits=1"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    let engines = result["engines"].as_array().unwrap();
    assert_eq!(engines.len(), ENGINES.len());
    assert_eq!(engines[0]["absent"], "ticked: the machine has TERM and SHADE");
    for row in engines.iter().filter(|row| row["absent"].is_null()) {
        assert_eq!((&row["cycles"], &row["triangles"]), (&result["cycles"], &9.into()), "{row}");
    }
    let output = run(&["--set", "term.record_bits=3"]);
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(error.contains("9 triangles") && error.contains("term.record_bits=4"), "{error}");
}

#[test]
fn an_engine_that_is_not_exact_takes_no_part() {
    let result = bench(&["--engine", "tick,fast", "--set", "memory.latency=8"]);
    assert_eq!(result["engine"], "tick");
    assert_eq!(result["engines"][0]["absent"], "ticked: the in-flight queue may fill");
    assert_eq!(result["engines"].as_array().unwrap().len(), 2);
}
