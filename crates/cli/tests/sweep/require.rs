//! Requirements of a sweep: what the estimate rules out is not drawn, what breaks a limit is in no best and no front, and each
//! requirement tells how many machines it ruled out.

use super::rows;
use crate::support::{SCREEN, TRIANGLE, edgewalk, run};
use serde_json::Value;

/// What `sweep` prints as JSON, and its rows.
fn swept(folder: &std::path::Path, words: &[&str]) -> (Value, Vec<Value>) {
    std::fs::write(folder.join("a.tri"), TRIANGLE).unwrap();
    let output =
        edgewalk(folder, &[&["sweep", "a.tri", "--json", "--out", "out"], words].concat()).output().unwrap();
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    (serde_json::from_slice(&output.stdout).unwrap(), rows(&folder.join("out")))
}

const VARY: [&str; 8] = [
    "--set",
    "formats.z_vertex=0",
    "--vary",
    "setup.lanes=1,2,4",
    "--vary",
    "formats.z_fraction=2,4,14",
    "--vary",
    "setup.kind=parallel,sequenced",
];
const TABLES: &str = "/estimate/est_lut4/value";
const ERROR: &str = "/report/comparison/z_error";

fn figure(row: &Value, at: &str) -> f64 {
    row.pointer(at).unwrap_or(&Value::Null).as_f64().unwrap_or_else(|| panic!("{at} is no number in {row}"))
}

#[test]
fn requirements_rule_machines_out_and_say_how_many() {
    let folder = tempfile::tempdir().unwrap();
    let (_, all) = swept(folder.path(), &[&VARY[..], &["--estimate"]].concat());
    assert_eq!(all.len(), 18);
    // Limits that some machines keep and others do not.
    let middle = |at: &str| {
        let mut values: Vec<f64> = all.iter().map(|row| figure(row, at)).collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2 - 1]
    };
    let (tables, error) = (middle(TABLES), middle(ERROR));
    let folder = tempfile::tempdir().unwrap();
    let limits = [format!("lut4<={tables}"), format!("z_error<={error}")];
    let words = ["--require", &limits[0], "--require", &limits[1], "--fits", "ice40-hx8k"];
    let (report, some) = swept(folder.path(), &[&VARY[..], &words].concat());
    assert_eq!(some.len(), 18);

    // By the rows of the sweep without requirements: which machines keep each.
    let machine = |row: &Value| row["machine"].as_str().unwrap().to_owned();
    let mut counts = [0; 3];
    let mut kept = Vec::new();
    for row in &all {
        let fits = some.iter().find(|other| machine(other) == machine(row)).unwrap()["estimate"]["fits"][0]["fits"]
            != false;
        match (figure(row, TABLES) <= tables, figure(row, ERROR) <= error, fits) {
            (false, ..) => counts[0] += 1,
            (true, false, _) => counts[1] += 1,
            (true, true, false) => counts[2] += 1,
            (true, true, true) => kept.push(machine(row)),
        }
    }
    assert!(counts[0] > 0 && counts[1] > 0 && !kept.is_empty(), "{counts:?} ruled out, {} kept", kept.len());
    let told = report["ruled_out"].as_array().unwrap().iter().map(|of| of["machines"].as_u64().unwrap());
    assert_eq!(told.collect::<Vec<_>>(), counts);
    assert_eq!(report["ruled_out"][0]["required"], format!("est_lut4 <= {tables}"));
    assert_eq!(report["ruled_out"][2]["required"], "fits ice40-hx8k");

    // What the estimate rules out is not drawn, and its row says by what.
    for row in &some {
        let before = all.iter().find(|other| machine(other) == machine(row)).unwrap();
        assert_eq!(row["estimate"]["est_lut4"], before["estimate"]["est_lut4"]);
        assert_ne!(row["key"], before["key"], "a row depends on what was required");
        if figure(row, TABLES) > tables {
            assert_eq!(row["status"], "pruned");
            let [value, error] =
                ["value", "error"].map(|name| row["estimate"]["est_lut4"][name].as_f64().unwrap());
            let found = format!("{value:.1} ± {error:.1}");
            assert_eq!(row["reason"], format!("required: est_lut4 <= {tables}; by the estimate: {found}"));
            assert!(row["report"].is_null());
        } else if row["status"] != "pruned" {
            assert_eq!(row["report"]["cycles"], before["report"]["cycles"]);
        }
    }
    // Bests and front are of machines that keep everything.
    for best in report["best"].as_object().unwrap().values().chain(report["front"].as_array().unwrap()) {
        assert!(kept.contains(&machine(best)), "{best} keeps not all");
    }
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    let line = format!("required: z_error &lt;= {error}: rules out {} of 18 machines", counts[1]);
    assert!(page.contains(&line), "the page has no line {line}");
}

#[test]
fn devices_of_two_families_are_told_by_the_estimates_of_each() {
    let folder = tempfile::tempdir().unwrap();
    let vary = ["--vary", "setup.lanes=1,4", "--vary", "setup.kind=parallel,sequenced"];
    let (report, rows) =
        swept(folder.path(), &[&vary[..], &["--fits", "ecp5-25", "--fits", "ice40-hx8k"]].concat());
    assert_eq!(rows.len(), 4);
    for row in &rows {
        let keys = &row["keys"];
        let [lanes, kind] = ["setup.lanes", "setup.kind"].map(|key| keys[key].to_string().replace('"', ""));
        let machine =
            format!("default,screen.width=64,screen.height=48,setup.lanes={lanes},setup.kind={kind}");
        for (family, device) in [("ecp5", "ecp5-25"), ("ice40", "ice40-hx8k")] {
            let words = ["estimate", &machine, "--family", family, "--fits", device, "--json"];
            let output = edgewalk(folder.path(), &words).output().unwrap();
            let alone: Value = serde_json::from_slice(&output.stdout).unwrap();
            let fits = row["estimate"]["fits"].as_array().unwrap();
            let told = fits.iter().find(|fits| fits["device"] == device).unwrap();
            assert_eq!(*told, alone["machines"][0]["fits"][0], "{machine} on {device}");
            if family == "ice40" {
                assert_eq!(row["estimate"]["est_lut4"], alone["machines"][0]["est_lut4"], "{machine}");
            }
        }
    }
    // Every one of the four fits an ECP5-25, and not every one an HX8K.
    let told: Vec<u64> =
        report["ruled_out"].as_array().unwrap().iter().map(|of| of["machines"].as_u64().unwrap()).collect();
    assert!(told[0] == 0 && (1..4).contains(&told[1]), "{told:?}");
}

#[test]
fn only_what_the_estimate_leaves_open_is_built() {
    let folder = tempfile::tempdir().unwrap();
    let cells = ["--synth", "ice40-hx8k", "--synth-unit", "span", "--synth-seeds", "1", "--cache", "cache"];
    let vary = ["--vary", "fifo.span=1,8", "--require", "lut4<=420", "--require", "z_error<=100"];
    let (report, rows) = swept(folder.path(), &[&vary[..], &cells].concat());
    let of = |depth: u64| rows.iter().find(|row| row["keys"]["fifo.span"] == depth).unwrap();
    let error = |row: &Value| figure(row, "/estimate/est_lut4/error");
    let estimate = |row: &Value| figure(row, "/estimate/est_lut4/value");
    // The deep queue is beyond the limit by more than the error, so no tool saw it.
    assert!(
        estimate(of(8)) - error(of(8)) > 420.0 && of(8)["status"] == "pruned" && of(8)["synth"].is_null()
    );
    assert!(estimate(of(1)) - error(of(1)) <= 420.0 && figure(of(1), "/synth/cells/lut4") <= 420.0);
    assert_eq!(report["ruled_out"][0], serde_json::json!({ "required": "lut4 <= 420", "machines": 1 }));
}

/// How many machines a requirement rules out of those of a sweep of `input`.
fn ruled_out(folder: &std::path::Path, words: &[&str]) -> (u64, usize) {
    std::fs::write(folder.join("whole.tri"), TRIANGLE).unwrap();
    let words = [&["sweep", "--json", "--vary", "fifo.span=1,2", "--out", "r"], words].concat();
    let output = edgewalk(folder, &words).output().unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let count =
        report["ruled_out"].as_array().unwrap().iter().map(|of| of["machines"].as_u64().unwrap()).sum();
    (count, report["front"].as_array().unwrap().len())
}

#[test]
fn distance_from_the_shading_equation_is_worked_out_where_it_is_required() {
    let folder = tempfile::tempdir().unwrap();
    let of =
        |limit: &str| ruled_out(folder.path(), &[&["sphere", "--require", limit], &SCREEN[..]].concat()).0;
    assert_eq!((of("shading_error<=0.0001"), of("shading_mean<=0.0001")), (2, 2));
    assert_eq!((of("shading_error<=255"), of("shading_error>=0.0001")), (0, 0));
}

#[test]
fn figures_that_are_not_known_keep_no_requirement() {
    let folder = tempfile::tempdir().unwrap();
    // Nothing is proved of textbook fill; a triangle file has no surface.
    for words in [
        &["whole.tri", "--machine", "textbook", "--require", "z_bound<=0.6"][..],
        &["whole.tri", "--machine", "textbook", "--require", "z_bound>=0.6"],
        &["whole.tri", "--require", "shading_error<=255"],
    ] {
        assert_eq!(ruled_out(folder.path(), words), (2, 0), "{words:?}");
    }
    // One that a figure breaks counts before one that is not known.
    let words = ["whole.tri", "--machine", "textbook", "--require", "z_bound<=1", "--require", "cycles<=1"];
    assert_eq!(ruled_out(folder.path(), &words), (2, 0));
    let report = std::fs::read_to_string(folder.path().join("r/report.html")).unwrap();
    assert!(report.contains("required: cycles &lt;= 1: rules out 2 of 2 machines"), "{report}");
}

/// What stands behind --require, and what the error must say.
const MALFORMED: [(&str, &str); 27] = [
    ("", "is empty: write NAME<=NUMBER or NAME>=NUMBER"),
    ("   ", "is empty"),
    ("lut4", "no <= or >= behind `lut4`"),
    ("<=4500", "position 1: found `<` before any name"),
    ("  >= 3", "position 3: found `>` before any name"),
    ("z_error<1", "position 8: found `<`: permitted: <=, >="),
    ("z_error>1", "position 8: found `>`: permitted: <=, >="),
    ("z_error=1", "position 8: found `=`: permitted: <=, >="),
    ("z_error==1", "position 8: found `==`: permitted: <=, >="),
    ("z_error!=1", "position 8: found `!=`: permitted: <=, >="),
    ("z_error=<1", "position 8: found `=<`: permitted: <=, >="),
    ("z_eror<=1", "position 1: unknown figure z_eror; permitted: cycles, bytes, z_error"),
    ("  lut5<=1", "position 3: unknown figure lut5"),
    ("LUT4<=1", "position 1: unknown figure LUT4"),
    ("est_mhz5>=1", "; nearest: est_mhz"),
    ("z error<=1", "position 1: unknown figure z error"),
    ("z_error<=", "position 10: no number behind <="),
    ("z_error>=  ", "no number behind >="),
    ("z_error<=one", "position 10: `one` is no number"),
    ("z_error<= 1 LSB", "position 11: `1 LSB` is no number"),
    ("cycles<=1,000", "position 9: `1,000` is no number"),
    ("cycles<=1_000", "position 9: `1_000` is no number"),
    ("cycles<=-1", "position 9: `-1`: permitted: a finite number of 0 or more"),
    ("cycles<=inf", "position 9: `inf`: permitted: a finite number"),
    ("cycles<=NaN", "position 9: `NaN`: permitted: a finite number"),
    ("cycles<=1<=2", "position 9: `1<=2` is no number"),
    ("mpixels_per_s>=1", "only synthesis gives mpixels_per_s; add --synth TARGET"),
];

#[test]
fn malformed_requirements_say_what_and_where() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    for (text, why) in MALFORMED {
        let words = ["sweep", "a.tri", "--vary", "setup.lanes=1,2", "--out", "out", "--require", text];
        let (code, said) = run(folder.path(), &words);
        assert_eq!(code, Some(2), "{text}: {said}");
        assert!(
            said.starts_with(&format!("error: --require '{text}': ")) && said.contains(why),
            "{text}: {said}"
        );
    }
    assert!(!folder.path().join("out").exists());
}

#[test]
fn requirements_that_clash_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    for (words, why) in [
        (&["--require", "z_error<=1", "--require", "z_error<=2"][..], "z_error <= 1 is required already"),
        (&["--require", "z_error<=1", "--require", "z_error>=2"], "no figure keeps this and z_error <= 1"),
        (&["--fits", "ice40-up5"], "nearest: ice40-up5k"),
        (&["--fits", "ecp5"], "nearest: ecp5-25"),
        (&["--fits", "ice40-up5k", "--fits", "ice40-up5k"], "is given twice"),
    ] {
        let words = [&["sweep", "a.tri", "--vary", "setup.lanes=1,2", "--out", "out"], words].concat();
        let (code, said) = run(folder.path(), &words);
        assert!(code == Some(2) && said.contains(why), "{words:?}: {said}");
        assert!(!folder.path().join("out").exists());
    }
    // One figure keeps both.
    let both = ["--require", "cycles<=5", "--require", "cycles>=5", "--out", "both", "--chunks", "1"];
    let words = [&["sweep", "plan", "a.tri", "--vary", "setup.lanes=1,2"], &both[..]].concat();
    let (code, said) = run(folder.path(), &words);
    assert_eq!(code, Some(0), "{said}");
}

/// A sample has as many points as it was asked for, however often a random one comes again.
#[test]
fn a_sample_is_as_large_as_it_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let grid = [
        "--vary",
        "fifo.span=1..64",
        "--vary",
        "formats.z_fraction=0..20",
        "--vary",
        "formats.color_fraction=0..9",
    ];
    let sample = ["--sample", "3000", "--chunks", "1", "--out", "o", "--json"];
    let words = [&["sweep", "plan", "a.tri"], &grid[..], &sample].concat();
    let output = edgewalk(folder.path(), &words).output().unwrap();
    let plan: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(plan["points"], 3000, "{plan}");
}
