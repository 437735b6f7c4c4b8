//! How `edgewalk verify` ends: each exit code for its own reason.

use std::process::{Command, Output};

/// A small machine, so that all of it takes seconds.
const SMALL: [&str; 6] =
    ["--set", "screen.width=24", "--set", "screen.height=20", "--set", "screen.guard_bits=6"];

fn verify(triangles: &str, arguments: &[&str], path: Option<&str>) -> Output {
    verify_file(&format!("size 24 20\nmode gouraud\n{triangles}"), arguments, path)
}

fn verify_file(text: &str, arguments: &[&str], path: Option<&str>) -> Output {
    let place = tempfile::tempdir().expect("a directory");
    let file = place.path().join("input.tri");
    std::fs::write(&file, text).expect("a file");
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.arg("verify").arg(&file).args(SMALL).args(arguments);
    if let Some(path) = path {
        command.env("PATH", path);
    }
    command.output().expect("the program runs")
}

const TRIANGLE: &str = "T 1 1 0.2 1 0 0 1  12 3 0.5 0 1 0 1  4 15 0.8 0 0 1 1\n";

fn told(output: &Output) -> (Option<i32>, String) {
    let text = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    (output.status.code(), text)
}

#[test]
fn pass_counts_what_the_stimulus_asks_for() {
    let (code, text) = told(&verify(TRIANGLE, &["--no-simulators"], None));
    assert_eq!(code, Some(0), "{text}");
    let counts: Vec<(u64, u64)> = text
        .lines()
        .filter_map(|line| line.split_once("checked ")?.1.split_once(" / "))
        .map(|(checked, expected)| (checked.parse().expect("a number"), expected.parse().expect("a number")))
        .collect();
    // The input through the machine, two directed suites through it and its five units, the eight depth functions and the
    // write mask through the machine and DEPTH.
    assert_eq!(counts.len(), 1 + 2 * 6 + 9 * 2, "{text}");
    assert!(counts.iter().all(|(checked, expected)| *checked > 500 && checked == expected), "{text}");
    for function in
        ["never", "less", "equal", "lequal", "greater", "notequal", "gequal", "always", "unwritten"]
    {
        let of =
            |unit: &str| text.lines().any(|line| line.contains(&format!("pass  depth_{function:<9} {unit}")));
        assert!(of("machine") && of("depth"), "{function}: {text}");
    }
    // Together they leave nothing out that this machine can meet.
    assert!(!text.contains("not covered"), "{text}");
}

/// A machine with SHADOW, under the light of the file: its own map is looked up, and SHADOW's suites leave nothing out.
#[test]
fn a_light_is_verified() {
    let light = "shadow 4 0.01 0  0.2 0 0 0  0 0.2 0 0  0 0 1 0  0 0 0 1\nL 0 0 0.4  4 0 0.4  0 4 0.4\n";
    let settings = ["shadow.light=parallel", "shadow.size=4", "fifo.shadow=3"];
    let settings = settings.iter().flat_map(|setting| ["--set", setting]);
    let arguments: Vec<&str> = settings.chain(["--no-simulators"]).collect();
    let (code, text) = told(&verify(&format!("{light}{TRIANGLE}"), &arguments, None));
    assert_eq!(code, Some(0), "{text}");
    for of in [
        "pass  input           machine",
        "pass  light           machine",
        "pass  light           shadow",
        "pass  light_off       shadow",
    ] {
        assert!(text.contains(of), "{of}: {text}");
    }
    assert!(!text.contains("not covered"), "{text}");
}

/// A machine that shades, with a file that is: its units are there, and what their suites can meet they do.
#[test]
fn a_shaded_frame_is_verified() {
    let text = format!(
        "size 24 20\nmode phong\nview 0 0 1\nsun 0.3 0.3 1 0.9\nmaterial 0.1 0.6 0.3 20\n{}N 0 0 1  0 0 1  0.6 0 0.8\n",
        "T 1 1 0.2 1 0.5 0 1  12 3 0.5 1 0.5 0 1  4 15 0.8 1 0.5 0 1\n"
    );
    let settings = ["shade.kind=phong", "shade.table_bits=8", "shade.material_bits=1"];
    let settings = settings.iter().flat_map(|setting| ["--set", setting]);
    let arguments: Vec<&str> = settings.chain(["--no-simulators"]).collect();
    let (code, text) = told(&verify_file(&text, &arguments, None));
    assert_eq!(code, Some(0), "{text}");
    for of in
        ["input           machine", "shade           term", "shade           normal", "shade           shade"]
    {
        assert!(text.contains(&format!("pass  {of}")), "{of}: {text}");
    }
    assert!(!text.contains("not covered"), "{text}");
}

#[test]
fn what_is_not_covered_is_said() {
    let (code, text) = told(&verify(TRIANGLE, &["--no-simulators", "--stalls", "none"], None));
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("warning: depth: not covered: memory_stall, queue_full, write_stall\n"), "{text}");
}

#[test]
fn nothing_to_draw_is_nothing_checked() {
    let off = "T 0.1 0.1 0 1 0 0 0  0.2 0.1 0 0 1 0 0  0.1 0.2 1 0 0 1 0\n";
    // The tools that are not ours answer as a bench does to which no token came.
    let tools = fake_simulators(&format!(
        "case $suite.$unit in\ninput.machine) say checked 0 / $n; say FAIL: nothing was compared;;\n\
         *) {HONEST};;\nesac"
    ));
    let path = format!("{}:{}", tools.path().display(), std::env::var("PATH").unwrap_or_default());
    for (triangles, taken) in [("", 0), (off, 1)] {
        for arguments in [&["--no-simulators"][..], &[]] {
            let (code, text) = told(&verify(triangles, arguments, Some(&path)));
            let why = format!(
                "({taken}) covers a pixel of the 24x20 screen; permitted: at least 1; verify an input"
            );
            assert_eq!(code, Some(2), "{text}");
            assert!(
                text.contains("checked 0 / ") && text.contains("suite input: 0 tokens of machine"),
                "{text}"
            );
            assert!(text.contains(&why), "{text}");
        }
    }
    let (code, text) = told(&verify(TRIANGLE, &["--no-simulators", "--only", "zero_area_horizontal"], None));
    let why = "suite corners: 0 tokens of machine, setup, edge, span, pixel, depth were compared: the cases of --only";
    assert!(code == Some(2) && text.contains(why), "{text}");
    // On a screen of one line some suites cover no pixel, and --only was not given.
    let line = "size 24 1\nT 0 0 0 1 0 0 0  20 0 0 0 1 0 0  0 3 1 0 0 1 0\n";
    let (code, text) = told(&verify_file(line, &["--no-simulators", "--set", "screen.height=1"], None));
    let why = "its triangles cover no pixel of the 24x1 screen; permitted: at least 1; set a larger screen";
    assert!(code == Some(2) && text.contains(why) && !text.contains("the cases of --only"), "{text}");
}

/// Verilator takes the bench of a suite without a token, so that `verify` comes to say so.
#[test]
fn bench_of_no_tokens_has_no_warning() {
    for (count, file) in [("0", "bench_source"), ("0", "bench_sink"), ("3", "bench_source")] {
        let path = format!("{}/../vectors/bench/{file}.v", env!("CARGO_MANIFEST_DIR"));
        let mut command = Command::new("verilator");
        command.args(["--lint-only", "-Wall", &format!("-GCOUNT={count}"), "--top-module", file, &path]);
        let (code, text) = told(&command.output().expect("verilator runs"));
        assert_eq!((code, text.as_str()), (Some(0), ""), "{file}");
    }
}

#[test]
fn a_missing_simulator_is_named() {
    let (code, text) = told(&verify(TRIANGLE, &[], Some("/nowhere")));
    assert_eq!(code, Some(3), "{text}");
    assert!(text.contains("iverilog is not installed; try: apt-get install"), "{text}");
}

/// Tools of our own in place of the simulators: what the bench would print is `script`, run in the directory of vectors with
/// $suite, $unit, $n, the number that its manifest expects, and `say`, which prints a line as the bench does.
fn fake_simulators(script: &str) -> tempfile::TempDir {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().expect("a folder");
    let value = |key: &str| {
        format!("$(sed -n 's/^ *\"{key}\": \"\\{{0,1\\}}\\([a-z_0-9]*\\).*/\\1/p' manifest.json | head -1)")
    };
    let bench = format!(
        "#!/bin/sh\nsuite={} unit={} n={} hash={}\nsay() {{ echo \"edgewalk $hash: $*\"; }}\n{script}\n",
        value("name"),
        value("unit"),
        value("expected"),
        value("hash")
    );
    let binary = folder.path().join("bench");
    let build = format!(
        "#!/bin/sh\nwhile [ \"$1\" != --Mdir ]; do shift; done\nmkdir -p \"$2\" && cp '{}' \"$2/Vtb\"\n",
        binary.display()
    );
    for (name, text) in
        [("bench", &bench), ("vvp", &bench), ("iverilog", &"#!/bin/sh\n".to_owned()), ("verilator", &build)]
    {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).expect("set");
    }
    folder
}

/// What a bench prints that has compared all.
const HONEST: &str = "say wrong 0; say checked $n / $n; say PASS";

#[test]
fn a_simulator_that_takes_too_long_is_ended() {
    let script = format!("case $suite.$unit in\nhazards.setup) exec sleep 60;;\n*) {HONEST};;\nesac");
    let tools = fake_simulators(&script);
    let path = format!("{}:{}", tools.path().display(), std::env::var("PATH").unwrap_or_default());
    let started = std::time::Instant::now();
    let (code, text) = told(&verify(TRIANGLE, &["--limit", "1"], Some(&path)));
    assert_eq!(code, Some(4), "{text}");
    assert!(text.contains("was ended after 1 s"), "{text}");
    assert!(started.elapsed().as_secs() < 60, "it was not waited for");
}

/// A simulator that compared nothing, less, more, or another thing than the manifest expects has not passed, and is told
/// beside what was expected.
#[test]
fn a_simulator_that_is_wrong_does_not_pass() {
    let script = format!(
        "case $suite.$unit in\n\
         hazards.setup) say checked 0 / 0; say PASS;;\n\
         hazards.edge) say checked $((n - 1)) / $((n - 1)); say PASS;;\n\
         hazards.span) say frag: token 0: expected 1, found 2; say checked $n / $n; say FAIL;;\n\
         hazards.pixel) say checked $((n + 1)) / $((n + 1)); say PASS;;\n\
         *) {HONEST};;\nesac"
    );
    let tools = fake_simulators(&script);
    let path = format!("{}:{}", tools.path().display(), std::env::var("PATH").unwrap_or_default());
    let (code, text) = told(&verify(TRIANGLE, &[], Some(&path)));
    assert_eq!(code, Some(1), "{text}");
    let line = |unit: &str| {
        let of =
            |line: &&str| line.contains(&format!("hazards         {unit} ")) && line.contains("= icarus");
        text.lines().find(of).unwrap_or_else(|| panic!("{unit}: {text}"))
    };
    let counts = |unit: &str| {
        let (checked, expected) =
            line(unit).split_once("checked ").and_then(|(_, n)| n.split_once(" / ")).expect(unit);
        (checked.parse::<u64>().expect("a number"), expected.parse::<u64>().expect("a number"))
    };
    for (unit, off) in [("setup", None), ("edge", Some(-1)), ("span", Some(0)), ("pixel", Some(1))] {
        assert!(line(unit).starts_with("FAIL"), "{}", line(unit));
        let (checked, expected) = counts(unit);
        assert!(expected > 20, "{unit}: {expected}");
        assert_eq!(checked as i64, off.map_or(0, |off| expected as i64 + off), "{unit}");
    }
    assert!(text.contains("      frag: token 0: expected 1, found 2"), "{text}");
    assert_eq!(text.lines().filter(|line| line.starts_with("FAIL")).count(), 4, "the others pass: {text}");
    // One that says nothing, or only that it passed, is broken.
    let tools = fake_simulators("say PASS");
    let path = format!("{}:{}", tools.path().display(), std::env::var("PATH").unwrap_or_default());
    let (code, text) = told(&verify(TRIANGLE, &[], Some(&path)));
    assert!(code == Some(3) && text.contains("icarus failed:\nPASS"), "{text}");
}
