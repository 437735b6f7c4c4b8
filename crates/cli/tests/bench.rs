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
    for i in 0..100 {
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
    assert!(cycles > 15_000, "{cycles} cycles");
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
    assert!(line("interpreter").contains("  first 1 triangle, "), "{told}");
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
        // Its texels have 72 bits.
        let shades = [
            "setup.lanes=1",
            "shade.kind=phong",
            "shade.colour=multiply",
            "texture.kind=nearest",
            "texture.bits=3",
            "texture.bump=yes",
            "texture.slope_bits=12",
            "formats.color_bits=16",
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

#[cfg(not(feature = "jit"))]
#[test]
fn without_the_feature_jit_says_how_to_build_it() {
    let folder = tempfile::tempdir().unwrap();
    let (code, told) = crate::support::run(folder.path(), &["bench", "sphere", "--engine", "fast,jit"]);
    assert_eq!(code, Some(2), "{told}");
    assert!(
        told.contains("--engine jit") && told.contains("`cargo build --release --features jit`"),
        "{told}"
    );
}

/// Runs a bench of Verilator, in whose place stands a program that prints these lines: exit code, standard output, standard error.
fn of_lines(lines: &str, more: &[&str]) -> (Option<i32>, String, String) {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
    };
    write("machine", &format!("#!/bin/sh\ncat <<'END'\n{lines}END\n"));
    let machine = folder.path().join("machine");
    write("verilator", &format!("#!/bin/sh\nmkdir obj_dir && cp '{}' obj_dir/Vmachine\n", machine.display()));
    let text = "size 40 30\nT 1 1 0 1 0 0 0  39 2 0 0 1 0 0  4 28 0 0 0 1 0\nT 9 1 0 1 0 0 0  30 2 0 0 1 0 0  4 20 0 0 0 1 0\n";
    write("two.tri", text);
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
    let mut command = crate::support::edgewalk(folder.path(), &["bench", "two.tri", "--engine", "verilator"]);
    let output = command.args(more).env("PATH", path).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// An engine that takes a cycle more, makes a write less, or does so in one frame only, ends with 1 and is named; one that
/// says something else is broken.
#[test]
fn an_engine_that_differs_ends_with_1() {
    let frames =
        |cycles: u64, writes: u64, count: usize| format!("{cycles} {writes} 1.0 9.0\n").repeat(count);
    let (code, json, _) = of_lines(&frames(1, 1, 3), &["--repeat", "2", "--json"]);
    assert_eq!(code, Some(1), "{json}");
    let expected: Value = serde_json::from_str(&json).unwrap();
    let expected = &expected["engines"][0]["differs"]["expected"];
    let number = |key: &str| expected[key].as_u64().unwrap();
    let (cycles, writes) = (number("cycles"), number("writes"));
    let right = frames(cycles, writes, 3);
    assert_eq!(of_lines(&right, &["--repeat", "2"]).0, Some(0));
    for (wrong, found) in [
        (frames(cycles + 1, writes, 3), (cycles + 1, writes)),
        (frames(cycles, writes - 1, 3), (cycles, writes - 1)),
        (frames(cycles, writes, 2) + &frames(cycles - 1, writes, 1), (cycles - 1, writes)),
        (frames(cycles, writes + 1, 1) + &frames(cycles, writes, 2), (cycles, writes + 1)),
    ] {
        let (code, text, _) = of_lines(&wrong, &["--repeat", "2"]);
        let told = format!(
            "verilator     differs from the machine: {} cycles instead of {cycles}, {} writes instead of {writes}\n",
            found.0, found.1
        );
        assert!(code == Some(1) && text.contains(&told), "{told}: {text}");
        let (code, text, error) = of_lines(&wrong, &["--repeat", "2", "--quiet"]);
        assert!(code == Some(1) && text.is_empty() && error.starts_with("error: mismatch: "), "{error}");
    }
    for broken in
        [String::new(), "nonsense\n".to_owned(), frames(cycles, writes, 2), frames(cycles, writes, 4)]
    {
        let (code, text, error) = of_lines(&broken, &["--repeat", "2"]);
        assert!(code == Some(3) && text.is_empty(), "{text}");
        assert!(error.contains("the verilated machine failed"), "{error}");
    }
    // Times by hand: sorted 1 2 3 4 5 7 8 9 100, the quartiles are 3, 5 and 8.
    let times =
        [50, 5, 1, 9, 3, 7, 2, 8, 4, 100].map(|cpu| format!("{cycles} {writes} {cpu} {}\n", 1000 + cpu));
    let (code, json, _) = of_lines(&times.concat(), &["--repeat", "9", "--json"]);
    assert_eq!(code, Some(0));
    let row: Value = serde_json::from_str(&json).unwrap();
    let row = &row["engines"][0];
    let figure = |key: &str| row[key].as_f64().unwrap();
    assert_eq!(["cpu_ms_median", "ms_min", "noise", "ratio_to_verilator"].map(figure), [5.0, 1.0, 1.0, 1.0]);
    assert!(
        figure("first_ms") >= 1050.0 && figure("first_ms") < 60_000.0,
        "built and drawn, on the wall: {row}"
    );
    assert_eq!(figure("cycles_per_second"), cycles as f64 * 1e3 / 5.0);
}

/// Where nothing is timed nothing is compared; and an engine that was named must be there.
#[test]
fn nothing_timed_is_no_success() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("a.tri"),
        "size 16 16\nT 1 1 0 1 0 0 0  15 2 0 0 1 0 0  4 14 0 0 0 1 0\n",
    )
    .unwrap();
    let bench = |more: &[&str]| {
        let arguments = [&["bench", "a.tri", "--repeat", "1"], more].concat();
        let output =
            crate::support::edgewalk(folder.path(), &arguments).env("PATH", "/nonexistent").output().unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    let why = "error: no engine was timed: fast: its memory never makes the machine wait; permitted: ";
    let (code, text, error) = bench(&["--engine", "fast", "--stalls", "random"]);
    assert!(code == Some(2) && text.contains("\nfast ") && error.starts_with(why), "{text}{error}");
    let (code, text, error) = bench(&["--engine", "fast", "--stalls", "random", "--quiet"]);
    assert!(code == Some(2) && text.is_empty() && error.starts_with(why), "{text}{error}");
    let (code, _, error) = bench(&["--engine", "fast,verilator"]);
    assert!(code == Some(3) && error.contains("verilator is not installed; try: "), "{error}");
    let (code, text, error) = bench(&[]);
    assert!(code == Some(0) && text.contains("verilator     verilator is not installed\n"), "{text}{error}");
}
