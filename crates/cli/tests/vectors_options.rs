//! `edgewalk vectors`: `--seed`, `--stalls` and `--triangles` do what their help says.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, run};
use serde_json::Value;
use std::path::Path;

const SMALL: [&str; 6] =
    ["--set", "screen.width=24", "--set", "screen.height=20", "--set", "screen.guard_bits=6"];

/// Writes the vectors of a unit of machine; the folder's only directory is `name`.
fn vectors(folder: &Path, out: &str, arguments: &[&str]) {
    let (code, told) =
        run(folder, &[&["vectors", "--no-csv", "--quiet", "--out", out][..], arguments].concat());
    assert_eq!(code, Some(0), "{told}");
}

fn text(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

fn manifest(folder: &Path, directory: &str) -> Value {
    serde_json::from_str(&text(folder, &format!("{directory}/manifest.json"))).unwrap()
}

/// The help names every suite and every unit that the program knows: those that it permits instead of an unknown one.
#[test]
fn help_names_every_suite_and_unit() {
    let folder = tempfile::tempdir().unwrap();
    let help = edgewalk(folder.path(), &["vectors", "--help"]).output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let said: Vec<&str> = help.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').collect();
    for (option, least) in [("--suite", 24), ("--unit", 16)] {
        let (code, error) = run(folder.path(), &["vectors", option, "nosuch", "--out", "out"]);
        let list = error.split_once("permitted: ").unwrap().1;
        let list = list.split([';', '\n']).next().unwrap();
        let names: Vec<&str> = list.split(", ").collect();
        let missing: Vec<&&str> = names.iter().filter(|name| !said.contains(name)).collect();
        assert!(
            code == Some(2) && names.len() >= least && missing.is_empty(),
            "{missing:?} of {error}: {help}"
        );
        println!("{option}: {} / {} names", names.len(), names.len());
    }
}

#[test]
fn a_seed_draws_triangles_and_stalls() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("own.tri"), triangles(&[0, 1, 2])).unwrap();
    for (out, seed, count) in [("one", "1", "5"), ("two", "2", "5"), ("again", "2", "5"), ("more", "2", "9")]
    {
        let random = ["--suite", "random", "--count", count, "--unit", "setup", "--seed", seed];
        vectors(folder, out, &[&random[..], &SMALL].concat());
        let own = [
            "own.tri",
            "--unit",
            "setup",
            "--stalls",
            "mixed",
            "--seed",
            seed,
            "--set",
            "screen.guard_bits=6",
        ];
        vectors(folder, &format!("{out}_own"), &own);
        for directory in [format!("{out}/random_setup"), format!("{out}_own/own_setup")] {
            assert_eq!(manifest(folder, &directory)["suite"]["seed"].to_string(), seed, "{directory}");
        }
    }
    let random = |out: &str| text(folder, &format!("{out}/random_setup/tri.in.mem"));
    assert_ne!(random("one"), random("two"));
    assert_eq!(random("two"), random("again"));
    // Triangle k depends on nothing but seed, suite and k.
    assert!(random("more").starts_with(&random("two")) && random("more").lines().count() == 9);
    // The triangles of a file stay, and wait in other cycles.
    let own = |out: &str, file: &str| text(folder, &format!("{out}_own/own_setup/{file}"));
    assert_eq!(own("one", "tri.in.mem"), own("two", "tri.in.mem"));
    assert_ne!(own("one", "prim.willing.mem"), own("two", "prim.willing.mem"));
    assert_eq!(own("two", "prim.willing.mem"), own("again", "prim.willing.mem"));
}

/// Two suites of one name would have one directory; a name given twice is given once.
#[test]
fn suites_of_one_name_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("hazards.tri"), triangles(&[0])).unwrap();
    for (input, suite) in [("hazards.tri", "hazards"), ("sphere", "sphere")] {
        let asked = ["vectors", input, "--suite", suite, "--unit", "edge", "--out", "refused"];
        let (code, error) = run(folder, &[&asked[..], &SMALL].concat());
        let said = format!("error: --suite {suite}: {input} is a suite named {suite} too");
        assert!(code == Some(2) && error.starts_with(&said) && !folder.join("refused").exists(), "{error}");
    }
    let twice = ["--suite", "hazards", "--suite", "hazards", "--unit", "edge", "--unit", "edge"];
    let arguments = [&["vectors", "--no-csv", "--json", "--out", "twice"], &twice[..], &SMALL].concat();
    let output = edgewalk(folder, &arguments).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(told["directories"], serde_json::json!(["hazards_edge"]));
}

#[test]
fn stalls_are_those_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut cycles = Vec::new();
    for kind in ["none", "mixed", "late"] {
        let suite = ["--suite", "hazards", "--unit", "depth", "--stalls", kind];
        vectors(folder, kind, &[&suite[..], &SMALL].concat());
        let depth = manifest(folder, &format!("{kind}/hazards_depth"));
        assert_eq!(depth["stalls"]["kind"], kind);
        cycles.push(depth["cycles"].as_u64().unwrap());
        let willing = text(folder, &format!("{kind}/hazards_depth/wr.willing.mem"));
        assert_eq!(willing.contains('0'), kind != "none", "{kind}");
    }
    println!("cycles without stalls, with mixed and with late ones: {cycles:?}");
    assert!(cycles[0] < cycles[1] && cycles[0] < cycles[2] && cycles[1] != cycles[2], "{cycles:?}");
    // Left out: those of the suite.
    for (suite, kind) in [("hazards", "late"), ("random", "mixed"), ("sphere", "none")] {
        vectors(folder, "own", &[&["--suite", suite, "--unit", "depth"][..], &SMALL].concat());
        assert_eq!(manifest(folder, &format!("own/{suite}_depth"))["stalls"]["kind"], kind);
    }
}

/// Triangles with these numbers, each unlike every other in place, colour and depth.
fn triangles(numbers: &[u32]) -> String {
    let triangle = |k: &u32| {
        let (x, z) = (1 + k, f64::from(1 + k) / 16.0);
        format!("T {x} 1 {z} 1 0 0 1  {} 3 0.5 0 {z} 0 1  4 15 0.8 0 0 1 1\n", x + 8)
    };
    "size 24 20\n".to_owned() + &numbers.iter().map(triangle).collect::<String>()
}

/// The same with normals and materials of their own.
fn shaded(numbers: &[u32]) -> String {
    let head = "size 24 20\nmode phong\nview 0 0 1\nsun 0.3 0.3 1 0.9\n";
    let mut text = head.to_owned();
    for k in numbers {
        let (x, share) = (1 + k, f64::from(1 + k) / 16.0);
        text += &format!("material 0.1 {share} 0.3 {}\n", 5 + k);
        text += &format!("T {x} 1 0.2 1 0.5 0 1  {} 3 0.5 1 0.5 0 1  4 15 0.8 1 0.5 0 1\n", x + 8);
        let (sine, cosine) = (f64::from(*k) / 10.0).sin_cos();
        text += &format!("N {sine:.4} 0 {cosine:.4}  0 {sine:.4} {cosine:.4}  0 0 1\n");
    }
    text
}

/// Ten triangles are every first, second, fourth, fifth or tenth of ten, as the number wanted asks for at least.
const SAMPLES: [(&str, &[u32]); 6] = [
    ("1", &[0]),
    ("2", &[0, 5]),
    ("3", &[0, 4, 8]),
    ("4", &[0, 3, 6, 9]),
    ("9", &[0, 2, 4, 6, 8]),
    ("10", &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]),
];

#[test]
fn a_sample_is_every_nth_triangle() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("all.tri"), triangles(&(0..10).collect::<Vec<_>>())).unwrap();
    let guard = ["--set", "screen.guard_bits=6", "--unit", "setup"];
    for (wanted, numbers) in SAMPLES {
        std::fs::write(folder.join("some.tri"), triangles(numbers)).unwrap();
        vectors(folder, "sample", &[&["all.tri", "--triangles", wanted][..], &guard].concat());
        vectors(folder, "some", &[&["some.tri"][..], &guard].concat());
        assert_eq!(manifest(folder, "sample/all_setup")["suite"]["triangles"], numbers.len(), "{wanted}");
        for file in ["tri.in.mem", "prim.exp.mem"] {
            let (sample, some) = (format!("sample/all_setup/{file}"), format!("some/some_setup/{file}"));
            assert_eq!(text(folder, &sample), text(folder, &some), "{wanted}: {file}");
        }
    }
}

#[test]
fn a_sample_brings_its_records() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("all.tri"), shaded(&(0..10).collect::<Vec<_>>())).unwrap();
    let machine = ["--set", "shade.kind=phong", "--set", "screen.guard_bits=6", "--unit", "machine"];
    let places = |words: &str| words.lines().map(str::to_owned).collect::<Vec<_>>();
    vectors(folder, "whole", &[&["all.tri"][..], &machine].concat());
    let whole = places(&text(folder, "whole/all_machine/terms.start.mem"));
    let record = whole.len() / 10;
    let distinct: std::collections::BTreeSet<_> = whole.chunks(record).collect();
    assert!(record > 1 && whole.len() == 10 * record && distinct.len() == 10, "{} words", whole.len());
    for (wanted, numbers) in &SAMPLES[1..4] {
        vectors(folder, "sample", &[&["all.tri", "--triangles", wanted][..], &machine].concat());
        let found = places(&text(folder, "sample/all_machine/terms.start.mem"));
        let expected: Vec<_> =
            numbers.iter().flat_map(|k| &whole[*k as usize * record..][..record]).cloned().collect();
        assert_eq!(found, expected, "--triangles {wanted}");
    }
}

/// A unit of another machine is refused; of a machine with it each directory is written, EDGE behind a sequenced SETUP among them.
#[test]
fn unit_of_another_machine_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for unit in ["lamp", "blend", "poly"] {
        let arguments = ["vectors", "--suite", "hazards", "--unit", unit, "--out", "v"];
        let (code, said) = run(folder.path(), &arguments);
        assert_eq!(code, Some(2), "{said}");
        let message =
            format!("--unit {unit}: the machine has no such unit; permitted: machine, setup, edge, span");
        assert!(said.contains(&message), "{said}");
    }
    vectors(folder.path(), "v", &["--suite", "hazards", "--unit", "edge", "--set", "setup.kind=sequenced"]);
    let manifest = manifest(folder.path(), "v/hazards_edge");
    let line =
        manifest["channels"].as_array().expect("a list").iter().find(|channel| channel["name"] == "line");
    assert_eq!(
        line.expect("a channel")["latency"],
        Value::Null,
        "the line leaves before its triangle is taken"
    );
}

/// Without --suite those suites are written that say something about the units; with it one that says nothing is refused.
#[test]
fn suites_left_out_are_those_of_the_units() {
    let folder = tempfile::tempdir().expect("a folder");
    let directories = |out: &str| {
        let entries = std::fs::read_dir(folder.path().join(out)).expect("a folder");
        let names = entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
        names.collect::<std::collections::BTreeSet<_>>()
    };
    vectors(folder.path(), "pixel", &[&["--unit", "pixel"][..], &SMALL].concat());
    let names = ["corners_pixel", "hazards_pixel", "random_pixel", "sphere_pixel"];
    assert_eq!(directories("pixel"), names.map(str::to_owned).into());
    let one = ["--unit", "pixel", "--unit", "depth", "--only", "flat_top"];
    vectors(folder.path(), "one", &[&one[..], &SMALL].concat());
    assert_eq!(directories("one"), ["corners_depth", "corners_pixel"].map(str::to_owned).into());
    let refused = |arguments: &[&str], message: &str| {
        let (code, said) = run(folder.path(), &[&["vectors", "--out", "none"], arguments].concat());
        assert!(code == Some(2) && said.contains(message), "{said}");
    };
    let message = "--suite depth_never: it is for the units machine, depth only; leave it out, or take one of these units";
    refused(&["--unit", "pixel", "--suite", "depth_never"], message);
    refused(
        &["--unit", "edge", "--suite", "random", "--count", "0"],
        "'--count <COUNT>': 0 is not in 1..=10000",
    );
    // Memory for as many cannot be had.
    let many = ["--unit", "pixel", "--suite", "random", "--count", "99999999999"];
    refused(&many, "'--count <COUNT>': 99999999999 is not in 1..=10000");
}

/// Suites of a machine with POLY meet all that can happen there: nothing is warned of.
#[test]
fn machines_with_poly_warn_of_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    for lines in ["no", "yes"] {
        let lines = format!("polygon.lines={lines}");
        // The same cases as on the preset's own screen, with shorter spans.
        let screen = ["--set", "screen.width=48", "--set", "screen.height=40"];
        let machine = ["--machine", "polygon", "--set", &lines, "--no-csv", "--out", "v"];
        let units = ["--unit", "span", "--unit", "pixel", "--unit", "poly"];
        let (code, said) = run(folder.path(), &[&["vectors"], &units[..], &machine, &screen].concat());
        assert!(code == Some(0) && !said.contains("warning"), "{lines}: {said}");
    }
}

/// Cases that examples of help and pages name are there.
#[test]
fn cases_of_examples_are_known() {
    let folder = tempfile::tempdir().unwrap();
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/own_rtl.md")).unwrap();
    let help = ["vectors", "verify"].map(|command| {
        let output = edgewalk(folder.path(), &[command, "--help"]).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    });
    let mut checked = 0;
    for line in help.iter().flat_map(|help| help.lines()).chain(page.lines()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.first() != Some(&"edgewalk") {
            continue;
        }
        for pair in words.windows(2).filter(|pair| pair[0] == "--only") {
            let (code, error) =
                run(folder.path(), &["vectors", "--only", pair[1], "--unit", "pixel", "--out", "v"]);
            assert_eq!(code, Some(0), "{line}: {error}");
            checked += 1;
        }
    }
    assert!(checked >= 3, "{checked} examples");
}
