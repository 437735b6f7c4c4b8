//! `edgewalk mutants`: single faults of our Verilog through a bench of the user's, by its command.

use crate::support::{edgewalk, ended};
use edgewalk_machine::Plan;
use edgewalk_netlist::mutate::mutants;
use edgewalk_vectors::{Runs, Suite, Unit, design};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;

fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = edgewalk(folder, arguments).output().expect("the program runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// The report of a run that ends with 0.
fn report(folder: &Path, arguments: &[&str]) -> Value {
    let (code, out, error) = run(folder, &[arguments, &["--json"]].concat());
    assert_eq!(code, Some(0), "{error}");
    serde_json::from_str(&out).expect("JSON")
}

/// A bench by the directory of a suite of PIXEL.
fn vectors(folder: &Path, out: &str, more: &[&str]) {
    let arguments = ["vectors", "--suite", "hazards", "--no-csv", "--quiet", "--out", out];
    let (code, _, error) = run(folder, &[&arguments, more].concat());
    assert_eq!(code, Some(0), "{error}");
}

const MAKE: &str = "make icarus HDL=\"{hdl}\"";

fn survivors(report: &Value) -> BTreeSet<String> {
    let list = report["survivors"].as_array().expect("a list");
    list.iter().map(|survivor| survivor["fault"].as_str().expect("a text").to_owned()).collect()
}

/// From outside the project's bench finds what lock-step finds with the same suite, on the same sample. A bench that looks
/// at colours alone finds less, and says which fault it missed, in which line.
#[test]
fn a_bench_is_scored_from_outside() {
    let folder = tempfile::tempdir().expect("a folder");
    vectors(folder.path(), "v", &["--unit", "pixel"]);
    let sample = ["mutants", "--unit", "pixel", "--sample", "16", "--seed", "3"];
    let ours = [&sample[..], &["--in", "v/hazards_pixel", "--bench", MAKE, "--out", "ours"]].concat();
    let outside = report(folder.path(), &ours);

    let machine = Plan::default();
    let pixel = Unit::named("pixel").expect("a unit");
    let netlist = design::netlist(&machine, pixel).expect("a checked machine");
    let suite = Suite::named(&machine, "hazards", 1, 0).expect("listed");
    let trace = Runs::new(&machine, &suite, suite.state).capture(pixel, suite.stalls);
    let faults = mutants(&netlist);
    let tried: Vec<usize> = rows(folder.path(), "ours").into_iter().map(|(fault, _)| fault).collect();
    assert_eq!(tried.len(), 16);
    let not_seen = tried.iter().filter(|fault| trace.lockstep(&faults[**fault].apply(&netlist)).is_ok());
    let not_seen: BTreeSet<String> = not_seen.map(|fault| faults[*fault].description.clone()).collect();
    assert_eq!(survivors(&outside), not_seen, "{outside}");
    assert_eq!(outside["faults"], faults.len());
    assert_eq!(outside["found"], 16 - not_seen.len());

    let colours = "unit = \"pixel\"\ntop = \"edgewalk_pixel\"\nfiles = [\"v/hazards_pixel/hdl/edgewalk_pixel.v\"]\n\
        [out.frag]\nabsent = [\"addr\", \"z\", \"fence\"]\n";
    fs::write(folder.path().join("colours.toml"), colours).expect("written");
    vectors(folder.path(), "c", &["--dut", "colours.toml"]);
    let theirs = [&sample[..], &["--in", "c/hazards_pixel", "--bench", MAKE, "--out", "theirs"]].concat();
    let less = report(folder.path(), &theirs);
    assert!(
        less["share"].as_f64().expect("a number") < outside["share"].as_f64().expect("a number") - 10.0,
        "{less}"
    );
    let only_theirs: Vec<String> = survivors(&less).difference(&survivors(&outside)).cloned().collect();
    assert!(only_theirs.len() >= 2, "{less}");
    let shown = less["survivors"].as_array().expect("a list").iter();
    let lines = |survivor: &Value, way: &str| survivor[way].as_array().map_or(0, Vec::len);
    assert!(shown.clone().all(|s| lines(s, "with") + lines(s, "without") > 0), "{less}");
    let design =
        fs::read_to_string(folder.path().join("v/hazards_pixel/hdl/edgewalk_pixel.v")).expect("a file");
    let of_design = |line: &Value| design.contains(line.as_str().expect("a text"));
    assert!(shown.clone().all(|s| s["without"].as_array().expect("a list").iter().all(of_design)), "{less}");
    assert!(shown.clone().any(|s| !s["with"].as_array().expect("a list").iter().all(of_design)), "{less}");
    // The project's own suite shows each of them by a triangle.
    let by_hazards = shown.filter(|s| only_theirs.iter().any(|fault| s["fault"] == *fault));
    let by_hazards =
        by_hazards.filter(|s| s["shown_by"]["suite"] == "hazards" && s["shown_by"]["triangle"].is_u64());
    assert_eq!(by_hazards.count(), only_theirs.len(), "{less}");
    // A threshold that is missed.
    let (code, text, _) = run(folder.path(), &[&theirs[..], &["--least", "100"]].concat());
    assert!(code == Some(1) && text.contains(&format!("found {} / 16", less["found"])), "{text}");
    let named = &only_theirs[0];
    assert!(
        text.lines().any(|line| line.starts_with("survived: ") && line.contains(named.as_str())),
        "{text}"
    );
}

/// Of what a bench that passes everything misses a suite shows a triangle, or the prover says that nothing can show it.
#[test]
fn survivors_are_shown_or_proved() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = ["mutants", "--unit", "span", "--bench", "true", "--sample", "14", "--seed", "1"];
    let report = report(folder.path(), &[&arguments[..], &["--prove"]].concat());
    let machine = Plan::default();
    let span = Unit::named("span").expect("a unit");
    let netlist = design::netlist(&machine, span).expect("a checked machine");
    let faults = mutants(&netlist);
    let (mut shown, mut proved) = (0, 0);
    for survivor in report["survivors"].as_array().expect("a list") {
        let place = faults.iter().position(|fault| {
            survivor["fault"] == fault.description.as_str() && survivor["module"] == fault.module.as_str()
        });
        let faulty = faults[place.expect("a fault of the unit")].apply(&netlist);
        let by = &survivor["shown_by"];
        if let Some(name) = by["suite"].as_str() {
            let suite = Suite::named(&machine, name, 1, 24).expect("listed");
            let trace = Runs::new(&machine, &suite, suite.state).capture(span, suite.stalls);
            assert!(trace.lockstep(&faulty).is_err(), "{survivor}");
            let mut first = 0;
            let case = suite.cases.iter().find(|case| {
                first += case.triangles.len() as u64;
                by["triangle"].as_u64().is_some_and(|triangle| triangle < first)
            });
            assert_eq!(by["case"].as_str(), Some(case.map_or("", |case| case.name.as_str())), "{survivor}");
            shown += 1;
        } else if survivor["proved_equivalent"] == true {
            proved += 1;
        }
    }
    println!("{shown} shown, {proved} proved to change nothing");
    assert_eq!((&report["found"], &report["proved_equivalent"]), (&Value::from(0), &Value::from(proved)));
    assert!(shown + proved == 14 && shown >= 8 && proved >= 1, "{report}");
}

/// Where the disk is full Yosys writes a part of the prover's file and ends as if all were well.
#[test]
fn a_part_of_a_problem_proves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let yosys = folder.path().join("yosys");
    let path = std::env::var("PATH").expect("a text");
    let cut = "truncate -s 40 miter.aig";
    fs::write(&yosys, format!("#!/bin/sh\nPATH='{path}' yosys \"$@\" || exit\n{cut}\n")).expect("written");
    fs::set_permissions(&yosys, fs::Permissions::from_mode(0o755)).expect("permitted");
    let arguments =
        ["mutants", "--unit", "span", "--bench", "true", "--sample", "14", "--seed", "1", "--prove"];
    let mut command = edgewalk(folder.path(), &arguments);
    command.env("PATH", format!("{}:{path}", folder.path().display()));
    let (code, error) = ended(&command.output().expect("a program"));
    assert!(code == Some(3) && error.contains("yosys failed:\nits miter.aig ends early"), "{error}");
}

/// Faults and verdicts that are kept in a folder, in the order in which they were tried.
fn rows(folder: &Path, out: &str) -> Vec<(usize, String)> {
    let text = fs::read_to_string(folder.join(out).join("verdicts.jsonl")).expect("written");
    let row = |line: &str| {
        let row: Value = serde_json::from_str(line).expect("JSON");
        let fault = row["fault"].as_u64().expect("a number") as usize; // few
        (fault, row["verdict"].as_str().expect("a text").to_owned())
    };
    text.lines().map(row).collect()
}

/// A run goes on where it was cut; another sample, command or folder has verdicts of its own.
#[test]
fn a_run_that_was_cut_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::create_dir(path.join("b")).expect("made");
    // The design without a fault has the reset of `frag_valid`; each run leaves a mark outside.
    let marks = path.join("marks");
    let bench = format!("cat {{hdl}} >sum; echo x >>{}; cksum <sum", marks.display());
    let arguments = |sample: &'static str| {
        vec!["mutants", "--unit", "span", "--in", "b", "--bench", "", "--out", "m", "--sample", sample]
    };
    let go = |sample: &'static str, bench: &str| {
        let mut arguments = arguments(sample);
        arguments[6] = bench;
        let report = report(path, &arguments);
        let runs = fs::read_to_string(&marks).expect("a file").lines().count();
        fs::remove_file(&marks).expect("removed");
        (report["tried"].as_u64(), runs)
    };
    assert_eq!(go("4", &bench), (Some(4), 5));
    let first = rows(path, "m");
    // The last verdict is cut short: that fault is tried again.
    let text = fs::read_to_string(path.join("m/verdicts.jsonl")).expect("a file");
    fs::write(path.join("m/verdicts.jsonl"), &text[..text.len() - 5]).expect("written");
    assert_eq!(go("4", &bench), (Some(4), 2));
    assert_eq!(go("4", &bench), (Some(4), 1), "all are known");
    // The folder of the bench is another.
    fs::write(path.join("b/more"), "x").expect("written");
    assert_eq!(go("4", &bench), (Some(4), 5));
    // A file of it has other contents, the command is another, the machine is another: a verdict holds for none of these.
    fs::write(path.join("b/more"), "y").expect("written");
    assert_eq!(go("4", &bench), (Some(4), 5));
    assert_eq!(go("4", &format!("{bench} # once more")), (Some(4), 5));
    let other = ["--set", "edge.kind=slope"];
    let mut arguments = arguments("4");
    arguments[6] = &bench;
    report(path, &[&arguments[..], &other].concat());
    assert_eq!(fs::read_to_string(&marks).expect("a file").lines().count(), 5);
    assert!(first.iter().all(|(_, verdict)| verdict == "survived"));
}

/// Commands that cannot score anything, and one that hangs on a fault.
#[test]
fn a_bench_that_cannot_score_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |bench: &str, more: &[&str]| {
        let arguments = ["mutants", "--unit", "pixel", "--sample", "2", "--bench", bench];
        run(folder.path(), &[&arguments, more].concat())
    };
    let (code, _, error) = run("echo no such bench; false", &[]);
    assert_eq!(code, Some(2), "{error}");
    assert!(
        error.contains("--bench: the design without a fault does not pass")
            && error.contains("no such bench"),
        "{error}"
    );
    let (code, _, error) = run("sleep 9", &["--limit", "1"]);
    assert!(code == Some(2) && error.contains("takes longer than --limit 1 s"), "{error}");
    let (code, _, error) = run("true", &["--in", "none"]);
    assert!(code == Some(2) && error.contains("--in none: no such folder"), "{error}");
    let (code, _, error) = run("true", &["--unit", "blend"]);
    assert_eq!(code, Some(2), "{error}");
    // The first run, without a fault, is quick; those behind it are not.
    let bench = format!("if test -e {0}/ran; then sleep 9; fi; touch {0}/ran", folder.path().display());
    let (code, out, error) = run(&bench, &["--limit", "1", "--json"]);
    assert_eq!(code, Some(0), "{error}");
    let report: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!((&report["found"], &report["found_by_time"]), (&Value::from(2), &Value::from(2)));
    assert_eq!(report["share"], 100.0);
}

/// Our PIXEL under the names of `docs/own_rtl/pixel.toml` passes the bench for that design, and its faults fail.
#[test]
fn faults_stand_in_for_a_users_design() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["pixel.toml", "my_pixel.v", "depth.toml", "my_depth.v"] {
        let own = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/own_rtl")).join(name);
        fs::copy(own, folder.path().join(name)).expect("copied");
    }
    for unit in ["pixel", "depth"] {
        let dut = format!("{unit}.toml");
        vectors(folder.path(), "v", &["--dut", &dut]);
        let folder_of_bench = format!("v/hazards_{unit}");
        let arguments =
            ["mutants", "--dut", &dut, "--sample", "6", "--in", &folder_of_bench, "--bench", MAKE];
        let report = report(folder.path(), &arguments);
        assert_eq!(report["unit"], unit);
        assert!(report["found"].as_u64().is_some_and(|found| found >= 3), "{report}");
    }
}

/// A fault that was found by time alone is tried again under a longer limit, and only then.
#[test]
fn a_longer_limit_asks_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let good = folder.path().join("good");
    // The first design has no fault: another one takes a second and a half.
    let bench =
        format!("test -e {0} || cat {{hdl}} >{0}; cat {{hdl}} | cmp -s - {0} || sleep 1.5", good.display());
    let found = |limit: &str| {
        let marks = folder.path().join("marks");
        let bench = format!("echo x >>{}; {bench}", marks.display());
        let arguments = ["mutants", "--unit", "span", "--sample", "2", "--limit", limit, "--bench", &bench];
        let report = report(folder.path(), &arguments);
        let runs = fs::read_to_string(&marks).expect("a file").lines().count();
        fs::remove_file(&marks).expect("removed");
        (report["found_by_time"].as_u64(), runs)
    };
    assert_eq!(found("1"), (Some(2), 3));
    assert_eq!(found("1"), (Some(2), 1), "the limit is the same");
    assert_eq!(found("30"), (Some(0), 3), "the limit is longer");
    assert_eq!(found("30"), (Some(0), 1));
    assert_eq!(found("1"), (Some(0), 1), "what passed in time once passes");
}

/// The folder of the bench may hold --out, empty folders and links to folders.
#[test]
fn the_folder_of_a_bench_is_copied_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, outside) = (folder.path().join("in"), folder.path().join("outside"));
    for made in [&path.join("build"), &path.join("lib"), &outside] {
        fs::create_dir_all(made).expect("made");
    }
    fs::write(path.join("lib/file"), "within").expect("written");
    fs::write(outside.join("file"), "outside").expect("written");
    let links = [("lib", "lib64"), ("../outside", "beside"), ("lib/file", "file"), ("nothing", "broken")];
    for (of, link) in links {
        std::os::unix::fs::symlink(of, path.join(link)).expect("a link");
    }
    let marks = folder.path().join("marks");
    // What lib64 names is the copy's own folder: the next line changes it there.
    let bench = format!(
        "echo x >>{}; test -d build -a -d out/mutants -a -L broken -a ! -e out/mutants/verdicts.jsonl && \
         test \"$(cat beside/file file)\" = outsidewithin && test $(cat lib64/file) = within && touch lib64/mark && test -e lib/mark",
        marks.display()
    );
    for runs in [3, 1] {
        let arguments = ["mutants", "--unit", "span", "--sample", "2", "--in", ".", "--bench", &bench];
        let (code, _, error) = run(&path, &arguments);
        assert_eq!(code, Some(0), "{error}");
        assert_eq!(fs::read_to_string(&marks).expect("a file").lines().count(), runs);
        fs::remove_file(&marks).expect("removed");
    }
    assert!(!path.join("lib/mark").exists());
    // A pipe would be read without end.
    let made = std::process::Command::new("mkfifo").arg(path.join("pipe")).status().expect("mkfifo");
    assert!(made.success());
    let (code, _, error) = run(&path, &["mutants", "--unit", "span", "--in", ".", "--bench", "true"]);
    assert!(
        code == Some(2) && error.contains("--in ./pipe: a pipe, a socket or a device; permitted: "),
        "{error}"
    );
}
