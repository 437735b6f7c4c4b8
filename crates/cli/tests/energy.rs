//! `edgewalk energy`: every figure of the text is one of the JSON, and each follows from the others.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod page;

use crate::support::{edgewalk, run};
use serde_json::Value;
use std::path::Path;
use std::sync::LazyLock;

/// A machine that Yosys maps in a few seconds.
const SMALL: [&str; 24] = [
    "--set",
    "screen.width=24",
    "--set",
    "screen.height=16",
    "--set",
    "screen.guard_bits=5",
    "--set",
    "screen.subpixel_bits=0",
    "--set",
    "setup.lanes=1",
    "--set",
    "formats.z_bits=6",
    "--set",
    "formats.z_fraction=2",
    "--set",
    "formats.z_vertex=0",
    "--set",
    "formats.color_bits=3",
    "--set",
    "formats.color_fraction=2",
    "--set",
    "formats.color_vertex=0",
    "--set",
    "memory.latency=1",
];

/// Gates of [`SMALL`], mapped once for all tests here.
static GATES: LazyLock<&str> = LazyLock::new(|| {
    let cache = concat!(env!("CARGO_TARGET_TMPDIR"), "/energy");
    std::fs::create_dir_all(cache).unwrap();
    energy_of(Path::new(cache), cache, &[]);
    cache
});

/// What the command prints for 300 triangles of the sphere, with these words more.
fn energy(folder: &Path, more: &[&str]) -> String {
    energy_of(folder, *GATES, more)
}

fn energy_of(folder: &Path, cache: &str, more: &[&str]) -> String {
    let words = [&["energy", "sphere", "--triangles", "300", "--cache", cache][..], &SMALL, more].concat();
    let output = edgewalk(folder, &words).output().unwrap();
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn number(of: &Value) -> f64 {
    of.as_f64().unwrap_or_else(|| panic!("{of} is no number"))
}

/// Equal but for rounding.
fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * a.abs().max(b.abs())
}

#[test]
fn every_figure_of_energy_follows_from_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let printed = energy(folder.path(), &["--json", "--mhz", "50"]);
    let report: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(report["format"], "edgewalk-energy");

    // Areas: the units' are the whole, in gates too.
    let units = report["units"].as_array().unwrap();
    let sum = |key: &str| units.iter().map(|unit| number(&unit[key])).sum::<f64>();
    assert!(near(sum("area_um2"), number(&report["area_um2"])));
    assert!(near(sum("flip_flops"), number(&report["flip_flops"])));
    let gate = 24.0; // the library's area of NAND2X1, um2
    assert!(near(number(&report["kge"]), number(&report["area_um2"]) / gate / 1000.0));
    let names: Vec<&str> = units.iter().map(|unit| unit["unit"].as_str().unwrap()).collect();
    assert_eq!(names, ["setup", "edge", "span", "pixel", "depth", "joints"]);

    // Power and energy: the units' are the whole, and so are cycles, triangles and pixels.
    let (power, frame, energies) = (&report["power"], &report["frame"], &report["energy"]);
    let watts = power["units"].as_array().unwrap().iter().map(|unit| number(&unit["watts"])).sum::<f64>();
    assert!(near(watts, number(&power["watts"])));
    assert!(power["leakage_watts"].as_f64().unwrap() < watts / 100.0);
    let parts = ["clock_watts", "flip_flop_watts", "gate_watts", "leakage_watts"];
    assert!(near(parts.iter().map(|part| number(&power[part])).sum(), watts));
    parts.iter().for_each(|part| assert!(number(&power[part]) > 0.0, "{part}"));
    let counted = power["counted"].as_u64().unwrap();
    assert!(counted * 20 >= report["flip_flops"].as_u64().unwrap() * 19, "{counted} were counted");
    // Every flip-flop of the netlist and every output, in every cycle but the first 16.
    let (compared, cycles) = (power["compared"].as_u64().unwrap(), frame["cycles"].as_u64().unwrap() - 16);
    assert!(compared.is_multiple_of(cycles) && compared / cycles > counted, "{compared} in {cycles} cycles");
    clock_takes(&report);
    let of_units =
        |of: &dyn Fn(&Value) -> f64| power["units"].as_array().unwrap().iter().map(of).sum::<f64>();
    assert!(near(of_units(&|unit| number(&unit["clock_watts"])), number(&power["clock_watts"])));
    let still = |unit: &Value| unit["still"].as_f64().unwrap_or(0.0) * number(&unit["clock_watts"]);
    assert!(near(of_units(&still), number(&power["still_watts"])));
    let frame_pj = watts / 50e6 * 1e12 * number(&frame["cycles"]);
    assert!(near(frame_pj, number(&energies["frame_pj"])));
    assert_eq!(frame["triangles"], 300);
    for (each, count) in [("cycle_pj", "cycles"), ("triangle_pj", "triangles"), ("pixel_pj", "writes")] {
        assert!(near(number(&energies[each]), frame_pj / number(&frame[count])), "{each}");
    }
    let by_unit: f64 = energies["units"].as_object().unwrap().values().map(number).sum();
    assert!(near(by_unit, frame_pj));

    // The text says the same; a second run takes the gates from the cache and gives the same digits.
    let text = energy(folder.path(), &["--mhz", "50"]);
    for figure in [
        format!(
            "area {:.3} mm2, {:.1} thousand gates",
            number(&report["area_um2"]) / 1e6,
            number(&report["kge"])
        ),
        format!("clock {:.3} ns", number(&report["ns"])),
        format!(
            "power {:.2} mW at 50.0 MHz: clock {:.2}, flip-flops {:.2}, gates {:.2}, leakage {:.4}",
            watts * 1e3,
            number(&power["clock_watts"]) * 1e3,
            number(&power["flip_flop_watts"]) * 1e3,
            number(&power["gate_watts"]) * 1e3,
            number(&power["leakage_watts"]) * 1e3
        ),
        format!("hold still would take {:.2} mW less", number(&power["still_watts"]) * 1e3),
        format!("transitions {:.1} a cycle, counted at every net", number(&power["transitions"])),
        format!("{compared} next states and outputs compared with the netlist, 0 differ"),
        format!("energy {:.1} pJ a cycle", number(&energies["cycle_pj"])),
        format!("{:.1} pJ a triangle, of 300", number(&energies["triangle_pj"])),
        format!("{:.1} pJ a pixel written, of {}", number(&energies["pixel_pj"]), frame["writes"]),
    ] {
        assert!(text.contains(&figure), "{figure} is missing in\n{text}");
    }
    assert_eq!(energy(folder.path(), &["--json", "--mhz", "50"]), printed);

    // A cycle's energy does not depend on the clock, but for the leakage.
    let slow: Value = serde_json::from_str(&energy(folder.path(), &["--json", "--mhz", "5"])).unwrap();
    let leakage = |of: &Value, mhz: f64| number(&of["power"]["leakage_watts"]) / mhz * 1e6;
    let moved = |of: &Value, mhz: f64| number(&of["energy"]["cycle_pj"]) - leakage(of, mhz);
    let (fast, slow) = (moved(&report, 50.0), moved(&slow, 5.0));
    assert!((fast - slow).abs() < 1e-4 * fast, "{fast} and {slow} pJ");

    in_the_table_of_features(folder.path());
}

/// The clock's part by hand: two edges a cycle at each flip-flop, from the library's figures of DFFPOSX1.
fn clock_takes(report: &Value) {
    // Energies of rise and fall at a transition time of 0: the lines through the first two figures of each table.
    let at_zero = |first: f64, second: f64| first - (second - first) / (0.24 - 0.06) * 0.06;
    let within = at_zero(0.006865, 0.006943) + at_zero(0.11034, 0.129769); // pJ
    let charged = 0.0279235 * 1.8 * 1.8; // pF V2
    let pj = (within + charged) * number(&report["flip_flops"]);
    let told = number(&report["power"]["clock_watts"]) / 50e6 * 1e12;
    assert!(near(told, pj), "{told} pJ a cycle, {pj} by hand");
}

/// A gate of another kind in the kept gates: the command says which flip-flop has another value, and ends as for a broken tool.
#[test]
fn gates_that_differ_from_the_netlist_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for step in std::fs::read_dir(*GATES).unwrap() {
        let step = step.unwrap();
        if !step.path().join("modules.json").exists() {
            continue;
        }
        let copy = folder.path().join("kept").join(step.file_name());
        std::fs::create_dir_all(&copy).unwrap();
        for file in std::fs::read_dir(step.path()).unwrap() {
            let file = file.unwrap();
            let text = std::fs::read_to_string(file.path()).unwrap();
            let text = match file.file_name().to_str() {
                Some("modules.json") => text.replacen("\"NAND2X1\"", "\"NOR2X1\"", 1),
                _ => text,
            };
            std::fs::write(copy.join(file.file_name()), text).unwrap();
        }
    }
    let words = [&["energy", "sphere", "--triangles", "300", "--cache", "kept"][..], &SMALL].concat();
    let (code, error) = run(folder.path(), &words);
    assert_eq!(code, Some(3), "{error}");
    assert!(error.contains("yosys failed:\nits gates give "), "{error}");
    assert!(error.contains(" another value than the netlist in cycle "), "{error}");
}

/// `compare --energy` tells of each machine what `energy` does at the machine's own clock; the text has its energy a pixel.
fn in_the_table_of_features(folder: &Path) {
    let mut alone: Value = serde_json::from_str(&energy(folder, &["--json"])).unwrap();
    for key in ["format", "version"] {
        alone.as_object_mut().unwrap().shift_remove(key);
    }
    let settings: Vec<&str> = SMALL.iter().copied().filter(|word| *word != "--set").collect();
    let machine = format!("default,{}", settings.join(","));
    let flat = format!("{machine}:constant");
    let words = ["compare", &machine, &flat, "sphere", "--energy", "300", "--cache", *GATES];
    let told = edgewalk(folder, &[&words[..], &["--json"]].concat()).output().unwrap();
    assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
    let told: Value = serde_json::from_slice(&told.stdout).unwrap();
    let of = |place: usize| &told["machines"][place]["inputs"][0]["energy"];
    assert_eq!(of(0), &alone);
    // Other colours, other transitions, in the same gates.
    assert_eq!(of(1)["area_um2"], alone["area_um2"]);
    let [flat, gouraud] = [of(1), &alone].map(|of| number(&of["power"]["transitions"]));
    assert!(
        flat < gouraud,
        "{flat} transitions a cycle with constant colours, {gouraud} with interpolated ones"
    );
    assert_ne!(of(1)["energy"]["pixel_pj"], alone["energy"]["pixel_pj"]);
    let text = edgewalk(folder, &words).output().unwrap();
    let text = String::from_utf8(text.stdout).unwrap();
    for place in [0, 1] {
        let pixel = format!("{:.0}", number(&of(place)["energy"]["pixel_pj"]));
        assert!(text.contains(&pixel), "{pixel} pJ a pixel is missing in\n{text}");
    }
}

#[test]
fn energy_refuses_what_it_cannot_do() {
    let folder = tempfile::tempdir().unwrap();
    for (words, why) in [
        (&["energy", "sphere", "--mhz", "0"][..], "permitted: 0.001 to 100000"),
        (&["energy", "sphere", "--triangles", "0"], "'0' for '--triangles <N>': 0 is not in 1.."),
        (&["explain", "sphere", "0", "0", "--triangles", "0"], "0 is not in 1.."),
        (&["vectors", "--count", "0"], "0 is not in 1.."),
        (&["energy", "none.tri"], "none.tri: cannot be read"),
        (
            &[&["energy", "sphere", "--mhz", "1000", "--cache", *GATES][..], &SMALL].concat(),
            "--mhz 1000: the gates permit 243.6 MHz at most; leave --mhz out for that clock",
        ),
        (
            &[&["energy", "sphere", "--cycles", "16", "--cache", *GATES][..], &SMALL].concat(),
            "16 cycles were run; more than 16 are needed: gates and netlist are compared from then on",
        ),
        (&["compare", "a", "b", "sphere", "--library", "x.lib"], "--energy <N>"),
    ] {
        let (code, error) = run(folder.path(), words);
        assert_eq!(code, Some(2), "{words:?}: {error}");
        assert!(error.contains(why), "{words:?}: {error}");
    }
}

/// The smallest library that is accepted.
const CELLS: &str = "library (tiny) {
  time_unit : \"1ns\"; nom_voltage : 1.8;
  capacitive_load_unit (1, pf);
  cell (ND) {
    area : 4;
    pin (A) { direction : input; }
    pin (B) { direction : input; }
    pin (Y) { direction : output; function : \"(A B)'\"; }
  }
  cell (IV) {
    area : 2.5;
    pin (A) { direction : input; }
    pin (Y) { direction : output; function : \"!A\"; }
  }
  cell (FF) {
    area : 20;
    ff (IQ, IQN) { next_state : \"D\"; clocked_on : \"C\"; }
    pin (C) { direction : input; clock : true; }
    pin (D) { direction : input; }
    pin (Q) { direction : output; function : \"IQ\"; }
  }
}
";

/// What is replaced in [`CELLS`], by what, and how the error goes on behind the file's name.
const WRONG_LIBRARIES: [(&str, &str, &str); 30] = [
    (CELLS, "", ":1: the text is empty; a Liberty file begins with library (NAME) {"),
    (CELLS, "module a (b);\nendmodule\n", ":1: found `module`; a Liberty file begins with library (NAME) {"),
    (CELLS, "{ \"cells\": [] }", ":1: found `{`; a Liberty file begins with library (NAME) {"),
    ("library (tiny)", "library tiny", ":1: found `tiny`; needed: library (NAME) {"),
    (CELLS, "library (tiny) { }", ":1: the library has no cells"),
    ("  }\n}\n", "  }\n", ":22: the text ends within `library (tiny)` of line 1; a `}` is needed"),
    ("  }\n}\n", "  }\n}\n}\n", ":23: found `}` behind the end of the library"),
    (
        "(1, pf)",
        "(1, pf",
        ":3: found `;` within the parentheses of `capacitive_load_unit` of line 3; a `)` is needed",
    ),
    ("\"IQ\"", "\"IQ", ":20: the text in quotes does not end; `\"` is needed"),
    ("  cell (IV)", "  /* cell (IV)", ":10: the comment does not end; `*/` is needed"),
    ("area : 4;", "area 4;", ":5: found `4` behind `area`; permitted: `:` or `(`"),
    ("area : 4;", "= 4;", ":5: found `4` behind `=`; permitted: `:` or `(`"),
    ("    area : 4;\n", "", ":4: cell `ND` has no area; needed: area : UM2;"),
    (
        "area : 4;",
        "area : four;",
        ":5: area of cell `ND`: found `four`; permitted: a number of 0 or more, um2",
    ),
    ("area : 4;", "area : -4;", ":5: area of cell `ND`: found `-4`; permitted: a number of 0 or more, um2"),
    ("area : 4;", "area : inf;", ":5: area of cell `ND`: found `inf`; permitted: a number of 0 or more, um2"),
    ("cell (IV)", "cell (ND)", ":10: cell `ND` is there a second time; permitted: once"),
    ("cell (IV)", "cell ()", ":10: a cell without a name; needed: cell (NAME) {"),
    (
        "  capacitive_load_unit (1, pf);\n",
        "",
        ":1: the library has no capacitive_load_unit; needed: capacitive_load_unit (1, pf);",
    ),
    ("(1, pf)", "(1, nf)", ":3: found capacitive_load_unit (1, nf); permitted: a number, and pf or ff"),
    ("1.8", "low", ":2: found nom_voltage `low`; a number is needed"),
    ("1.8", "0", ":1: the library has no nom_voltage above 0; needed: nom_voltage : 1.8;"),
    ("1ns", "1 day", ":2: found time_unit `1 day`; permitted: a number and one of ns, ps, fs, us"),
    (
        "pin (B) {",
        "pin (B) { internal_power () { rise_power (scalar) { values (\"1\"); } }",
        ":7: `internal_power` has neither `power` nor both of `rise_power` and `fall_power`",
    ),
    (
        "pin (B) {",
        "pin (B) { internal_power () { power (scalar) { values (\"1, 2\"); } }",
        ":7: found 2 values; needed: 1",
    ),
    ("pin (B) {", "pin (B) { capacitance : much;", ":7: found capacitance `much`; a number is needed"),
    ("\"(A B)'\"", "\"(A B)\"", ": has no NAND of two inputs with an area"),
    ("\"!A\"", "\"A\"", ": has no inverter"),
    (
        "clocked_on : \"C\"",
        "clocked_on : \"!C\"",
        ": has no flip-flop of the rising clock edge without set and reset",
    ),
    (
        "next_state : \"D\";",
        "next_state : \"D\"; clear : \"!R\";",
        ": has no flip-flop of the rising clock edge",
    ),
];

/// What the netlist cannot draw alone is refused before the tools run: none is there. A table tells it in its place.
#[test]
fn frames_in_passes_are_refused_before_the_tools_run() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let triangle = "T 1 1 0.5 1 0 0 0  31 3 0.25 0 1 0 0  5 28 0.75 0 0 1 0";
    std::fs::write(at("q.tri"), format!("size 40 30\n{triangle}\ndepth off\n{triangle}\n")).unwrap();
    std::fs::write(at("cells.lib"), CELLS).unwrap();
    let of = |words: &[&str]| {
        let screen = ["--set", "screen.width=40", "--set", "screen.height=30", "--library", "cells.lib"];
        let mut command = edgewalk(folder.path(), &[words, &screen].concat());
        let output =
            command.env("PATH", folder.path()).env("XDG_CACHE_HOME", folder.path()).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, error) = of(&["energy", "q.tri"]);
    assert!(code == Some(2) && error.starts_with("error: 2 passes"), "{error}");
    let table = |input: &str| of(&["compare", "default", "default", input, "--energy", "4", "--out", "o"]);
    assert_eq!(table("q.tri"), (Some(0), String::new()));
    let told: Value = serde_json::from_slice(&std::fs::read(at("o/features.json")).unwrap()).unwrap();
    let row = &told["machines"][1]["inputs"][0];
    assert!(
        row["energy"]["reason"].as_str().unwrap().starts_with("2 passes") && row["verdict"] == "pass",
        "{row}"
    );
    // A tool that is missing ends the command.
    std::fs::write(at("a.tri"), format!("size 40 30\n{triangle}\n")).unwrap();
    let (code, error) = table("a.tri");
    assert!(code == Some(3) && error.contains("yosys is not installed"), "{error}");
}

#[test]
fn wrong_libraries_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("cells.lib");
    let refused = |name: &str, why: &str| {
        for words in [
            &["energy", "sphere", "--triangles", "1", "--library", name][..],
            &["compare", "default", "default", "sphere", "--energy", "1", "--library", name],
        ] {
            let (code, error) = run(folder.path(), words);
            assert_eq!(code, Some(2), "{words:?}: {error}");
            let expected = format!("error: --library: {name}{why}");
            assert!(error.starts_with(&expected), "{expected} is expected, not\n{error}");
        }
    };
    for (from, to, why) in WRONG_LIBRARIES {
        assert_eq!(CELLS.matches(from).count(), 1, "{from}");
        std::fs::write(&file, CELLS.replace(from, to)).unwrap();
        refused("cells.lib", why);
    }
    std::fs::write(&file, CELLS.as_bytes().iter().map(|byte| byte | 128).collect::<Vec<_>>()).unwrap();
    refused("cells.lib", ":1: is no text in UTF-8");
    std::fs::File::create(&file).unwrap().set_len(1 << 40).unwrap();
    refused("cells.lib", ": has 1099511627776 bytes; permitted: 268435456");
    std::fs::remove_file(&file).unwrap();
    refused("cells.lib", ": cannot be read: No such file or directory");
    refused(".", ": is no regular file");
    refused("/dev/zero", ": is no regular file");
}

/// Cells are known by their functions: with other names they give the same figures. Times are read in the library's unit.
#[test]
fn energy_takes_another_library() {
    let folder = tempfile::tempdir().unwrap();
    let installed = std::fs::read_to_string("/usr/share/qflow/tech/osu018/osu018_stdcells.lib").unwrap();
    let flip_flop = installed.find("cell (DFFPOSX1)").unwrap();
    let next = flip_flop + installed[flip_flop..].find("cell (DFFSR)").unwrap();
    let [before, flip_flop, behind] =
        [&installed[..flip_flop], &installed[flip_flop..next], &installed[next..]];
    assert_eq!(flip_flop.matches("pin(Q)").count(), 1);
    let renamed = [before, &flip_flop.replace("pin(Q)", "pin(OUT)"), behind].concat();
    let renamed = [("DFFPOSX1", "FD1"), ("NAND2X1", "ND2"), ("INVX2", "IV2"), ("osu018_stdcells", "mine")]
        .iter()
        .fold(renamed, |text, (from, to)| text.replace(from, to));
    let report = |text: &str| {
        std::fs::write(folder.path().join("my cells.lib"), text).unwrap();
        let printed = energy(folder.path(), &["--json", "--library", "my cells.lib"]);
        serde_json::from_str::<Value>(&printed).unwrap()
    };
    let osu: Value = serde_json::from_str(&energy(folder.path(), &["--json"])).unwrap();
    let mine = report(&renamed);
    assert_eq!([&osu["library"], &osu["gate"]], ["osu018_stdcells", "NAND2X1"]);
    assert_eq!([&mine["library"], &mine["gate"]], ["mine", "ND2"]);
    for key in ["area_um2", "kge", "flip_flops", "cells", "ns", "path", "units", "power", "energy"] {
        assert_eq!(mine[key], osu[key], "{key}");
    }
    assert!(installed.contains("time_unit : \"1ns\""));
    let quick = report(&installed.replace("time_unit : \"1ns\"", "time_unit : \"1ps\""));
    // But for the leakage, a clock's period does not matter.
    let [one, other] = [&quick, &osu].map(|report| number(&report["energy"]["frame_pj"]));
    assert!((one - other).abs() < 1e-3 * other, "{one} and {other} pJ");
    // OpenSTA prints four digits.
    let [quick, osu] = [&quick, &osu].map(|report| number(&report["ns"]));
    assert!((quick - osu / 1000.0).abs() <= 0.5e-4, "{quick} and {osu} ns");
}
