//! Rows that are there already: tried again, of another bound, of another program, changed by somebody.

use super::{keys, rows};
use crate::support::{TRIANGLE, csv, edgewalk, run};
use serde_json::{Value, json};
use std::path::Path;

const SWEEP: [&str; 5] = ["sweep", "a.tri", "--vary", "interpolator.adders=1,2,4", "--quiet"];

/// A folder with a sweep of three machines in `s`.
fn swept() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    assert_eq!(again(folder.path(), &[]), (Some(0), String::new()));
    folder
}

fn again(at: &Path, more: &[&str]) -> (Option<i32>, String) {
    run(at, &[&SWEEP[..], &["--out", "s"], more].concat())
}

/// Changes the row in this place of a file of rows.
fn edited(path: &Path, place: usize, change: impl FnOnce(&mut Value)) {
    let text = std::fs::read_to_string(path).unwrap();
    let mut rows: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    change(&mut rows[place]);
    std::fs::write(path, rows.iter().map(|row| format!("{row}\n")).collect::<String>()).unwrap();
}

/// As if the point had not been drawn.
fn failed(row: &mut Value) {
    for part in ["report", "slack", "derived", "verdict"] {
        row.as_object_mut().unwrap().remove(part);
    }
    row["status"] = "failed".into();
    row["reason"] = "the disk was full".into();
}

fn statuses(at: &Path, out: &str) -> Vec<String> {
    csv(&at.join(out).join("runs.csv")).into_iter().skip(1).map(|record| record[1].clone()).collect()
}

#[test]
fn a_failed_row_is_retried_when_asked() {
    let folder = swept();
    let at = folder.path();
    let path = at.join("s/runs.jsonl");
    edited(&path, 1, failed);
    let first = rows(&at.join("s"))[1]["key"].clone();
    // The failed row stays until `--retry failed`; `--retry timeout` leaves it.
    for more in [&[][..], &["--retry", "timeout"]] {
        assert_eq!(again(at, more), (Some(0), String::new()));
        assert_eq!(rows(&at.join("s")).len(), 3);
        assert_eq!(statuses(at, "s").iter().filter(|status| *status == "failed").count(), 1);
    }
    assert_eq!(again(at, &["--retry", "failed"]), (Some(0), String::new()));
    let all = rows(&at.join("s"));
    assert!(all.len() == 4 && all[3]["key"] == first && all[3]["status"] == "ok", "{}", all[3]);
    assert_eq!(statuses(at, "s"), ["ok"; 3], "of two rows of a key the later counts");
    assert_eq!(again(at, &["--retry", "failed"]).0, Some(0));
    assert_eq!(rows(&at.join("s")).len(), 4, "nothing is left to retry");
    edited(&path, 3, |row| {
        failed(row);
        row["status"] = "timeout".into();
    });
    assert_eq!(again(at, &["--retry", "timeout"]).0, Some(0));
    assert_eq!((rows(&at.join("s")).len(), statuses(at, "s")), (5, vec!["ok".to_owned(); 3]));
}

#[test]
fn a_part_run_again_replaces_its_rows() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let plan = ["sweep", "plan", "--chunks", "2", "--out", "s"];
    assert_eq!(run(at, &[&plan[..], &SWEEP[1..]].concat()), (Some(0), String::new()));
    let part = |chunk: &str, more: &[&str]| {
        run(at, &[&["sweep", "run", "--out", "s", "--chunk", chunk, "--quiet"], more].concat())
    };
    let merge = || run(at, &["sweep", "merge", "--out", "s", "--quiet"]);
    assert!(part("0", &[]).0 == Some(0) && part("1", &[]).0 == Some(0));
    edited(&at.join("s/chunks/1.jsonl"), 0, failed);
    assert_eq!(merge(), (Some(0), String::new()));
    assert_eq!(statuses(at, "s").iter().filter(|status| *status == "failed").count(), 1);
    assert_eq!(part("1", &["--retry", "failed"]), (Some(0), String::new()));
    assert_eq!(merge(), (Some(0), String::new()));
    assert_eq!(statuses(at, "s"), ["ok"; 3], "the part's new row wins over the old one");
    // Its seconds tell whose row it is.
    let seconds = |path: &str| -> Vec<Value> {
        rows_of(&at.join(path)).iter().map(|row| row["seconds"].clone()).collect()
    };
    let merged = seconds("s/runs.jsonl");
    assert!(merged.contains(seconds("s/chunks/1.jsonl").last().unwrap()), "{merged:?}");
}

fn rows_of(path: &Path) -> Vec<Value> {
    std::fs::read_to_string(path).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn bounds_keep_their_own_rows() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let sweep = |bound: &[&str]| -> Value {
        let vary = ["sweep", "sphere", "--vary", "formats.z_fraction=4..9", "--out", "s", "--json"];
        let screen = ["--set", "screen.width=160", "--set", "screen.height=120"];
        let output = edgewalk(at, &[&vary[..], &screen, bound].concat()).output().unwrap();
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let mut pruned = Vec::new();
    for (bound, limit) in [(&["--bound", "1"][..], 1.0), (&["--bound", "0.6"], 0.6), (&[], f64::MAX)] {
        let told = sweep(bound);
        assert_eq!((&told["made"], &told["rows"]), (&json!(6), &json!(6)), "{bound:?}");
        assert_eq!(sweep(bound)["made"], 0, "{bound:?}");
        pruned.push(told["status"]["pruned"].as_u64().unwrap());
        // No row of another bound is among those that the table has.
        let table = csv(&at.join("s/runs.csv"));
        let place = table[0].iter().position(|name| name == "z_bound_for_input").unwrap();
        for record in table[1..].iter().filter(|record| record[1] == "ok") {
            assert!(
                record[place].parse::<f64>().is_ok_and(|bound| bound <= limit) || limit == f64::MAX,
                "{record:?}"
            );
        }
    }
    assert!(pruned[0] > 0 && pruned[1] > pruned[0] && pruned[2] == 0, "{pruned:?}");
    assert_eq!(rows(&at.join("s")).len(), 18);
}

#[test]
fn why_names_another_version() {
    let folder = swept();
    let at = folder.path();
    edited(&at.join("s/runs.jsonl"), 0, |row| {
        row["version"] = "0.0.9".into();
        row["key"] = "00000000000000aa".into();
    });
    let output =
        edgewalk(at, &["sweep", "why", "00000000000000aa", "--out", "s", "--json"]).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    let changed: Vec<&str> =
        told["changed"].as_array().unwrap().iter().map(|what| what.as_str().unwrap()).collect();
    let version = format!("version: the row is of 0.0.9, this program is {}", env!("CARGO_PKG_VERSION"));
    assert_eq!(changed, [&version, "the sweep that was asked for last has no such point"]);
    // Another row of the machine differs in its version alone.
    assert_eq!(again(at, &[]).0, Some(0));
    let own = rows(&at.join("s"))[0]["machine"].clone();
    let other = rows(&at.join("s"))
        .into_iter()
        .find(|row| row["machine"] == own && row["key"] != "00000000000000aa")
        .unwrap();
    let output =
        edgewalk(at, &["sweep", "why", "00000000000000aa", "--out", "s", "--json"]).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(told["same_machine"], json!([{ "key": other["key"], "differs_in": ["version"] }]));
}

#[test]
fn a_sweep_that_built_nothing_ends_with_two() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = ["sweep", "sphere", "--vary", "formats.z_fraction=1..3", "--out", "s", "--json"];
    let output = edgewalk(folder.path(), &sweep).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(
        (output.status.code(), &told["status"]["invalid"], &told["machines"]),
        (Some(2), &json!(3), &json!(3))
    );
    assert!(told["best"].as_object().unwrap().is_empty() && told["front"].as_array().unwrap().is_empty());
    // A machine that can be built among them is enough.
    let more = ["sweep", "sphere", "--vary", "formats.z_fraction=3..4", "--out", "t", "--quiet"];
    assert_eq!(run(folder.path(), &more).0, Some(0));
}

/// A row whose error lies beyond its bound, with figures that agree.
fn beyond(row: &mut Value, channel: &str) {
    let bound = row["report"]["comparison"][format!("{channel}_bound_for_input")].as_f64().unwrap();
    row["report"]["comparison"][format!("{channel}_error")] = json!(1.25 * bound);
    row["slack"][channel] = json!(1.25);
}

#[test]
fn an_error_beyond_its_bound_ends_with_one() {
    for channel in ["z", "color"] {
        let folder = swept();
        let at = folder.path();
        edited(&at.join("s/runs.jsonl"), 1, |row| beyond(row, channel));
        let output = edgewalk(at, &[&SWEEP[..4], &["--out", "s", "--json"]].concat()).output().unwrap();
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(
            (output.status.code(), &told["faults"], &told["made"]),
            (Some(1), &json!(1), &json!(0)),
            "{channel}"
        );
        let output = edgewalk(at, &[&SWEEP[..4], &["--out", "s"]].concat()).output().unwrap();
        let said = "1 rows show an error beyond what is proved: a fault of edgewalk";
        assert!(String::from_utf8_lossy(&output.stdout).contains(said));
        let page = std::fs::read_to_string(at.join("s/report.html")).unwrap();
        assert!(page.contains(&format!("<strong>{said}.</strong>")));
    }
    // In a part, and when parts are put together.
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let plan = ["sweep", "plan", "--chunks", "2", "--out", "s"];
    assert_eq!(run(at, &[&plan[..], &SWEEP[1..]].concat()).0, Some(0));
    let part = |chunk: &str| run(at, &["sweep", "run", "--out", "s", "--chunk", chunk, "--quiet"]).0;
    assert_eq!((part("0"), part("1")), (Some(0), Some(0)));
    edited(&at.join("s/chunks/1.jsonl"), 0, |row| beyond(row, "z"));
    assert_eq!((part("0"), part("1")), (Some(0), Some(1)));
    assert_eq!(run(at, &["sweep", "merge", "--out", "s", "--quiet"]).0, Some(1));
}

/// A change to a row, and what the error says of it.
type Change = (fn(&mut Value), &'static str);

const CHANGES: [Change; 19] = [
    (|row| row["report"]["cycles"]["total"] = json!(-5), "/cycles/total is -5: permitted: a whole number"),
    (|row| row["report"]["cycles"]["total"] = json!(7), "/cycles/total is 7, but its causes add up to"),
    (
        |row| row["report"]["cycles"]["total"] = json!(1e308),
        "/cycles/total is 1e+308: permitted: a whole number",
    ),
    (|row| row["report"]["cycles"]["by_cause"]["draw"] = json!(-1), "a cause has -1 cycles"),
    (|row| row["report"]["comparison"]["z_error"] = json!(-0.5), "z_error is -0.5: permitted: 0 or more"),
    (|row| row["report"]["comparison"]["color_bound"] = json!("none"), "color_bound is \"none\""),
    (|row| row["report"]["comparison"]["z_error"] = json!(0.125), "slack.z is"),
    (|row| row["report"]["comparison"]["covered"] = json!(1_000_000), "more pixels than the 3072"),
    (|row| row["report"]["machine"] = json!("000000000000"), "report.machine is \"000000000000\""),
    (|row| row["slack"] = json!(null), "slack"),
    (|row| row["derived"]["word_bits"] = json!(1), "derived.word_bits is 1"),
    (|row| row["derived"]["frames_per_s"] = json!(1e9), "derived is"),
    (|row| row["verdict"] = json!("great"), "verdict \"great\": permitted: pass, mismatch, vacuous"),
    (|row| row["machine"] = json!("<script>"), "machine is \"<script>\", where a row with this key has"),
    (|row| row["input"] = json!("b.tri"), "input is \"b.tri\""),
    (|row| row["keys"]["interpolator.adders"] = json!(8), "keys is"),
    (|row| row["stalls"] = json!("dram"), "stalls is \"dram\""),
    (|row| row["status"] = json!("failed"), "without a reason"),
    (|row| _ = row.as_object_mut().unwrap().remove("report"), "status ok without a report"),
];

#[test]
fn rows_that_cannot_be_are_refused() {
    let folder = swept();
    let at = folder.path();
    let plan = ["sweep", "plan", "--chunks", "1", "--out", "p"];
    assert_eq!(run(at, &[&plan[..], &SWEEP[1..]].concat()).0, Some(0));
    assert_eq!(run(at, &["sweep", "run", "--out", "p", "--chunk", "0", "--quiet"]).0, Some(0));
    let whole = [("s/runs.jsonl", &SWEEP[..]), ("p/chunks/0.jsonl", &["sweep", "merge"])];
    let mut refused = 0;
    for (file, command) in whole {
        let path = at.join(file);
        let good = std::fs::read_to_string(&path).unwrap();
        let out = &file[..1];
        let report = || std::fs::read(at.join("s/report.html")).unwrap();
        let before = report();
        for (change, said) in CHANGES {
            std::fs::write(&path, &good).unwrap();
            edited(&path, 1, change);
            let (code, error) = run(at, &[command, &["--out", out]].concat());
            assert!(
                code == Some(2) && error.contains(said) && error.contains(file),
                "{said}: {code:?} {error}"
            );
            assert!(error.contains("remove its line and run the point again"), "{error}");
            refused += 1;
        }
        // What has become of a point must be a word that is counted somewhere.
        std::fs::write(&path, &good).unwrap();
        edited(&path, 1, |row| row["status"] = json!("great"));
        let (code, error) = run(at, &[command, &["--out", out]].concat());
        let said =
            "line 2: status \"great\": permitted: ok, pruned, invalid, failed, timeout; remove the line";
        assert!(code == Some(2) && error.contains(said), "{error}");
        assert_eq!(report(), before, "the report is left as it was");
        std::fs::write(&path, good).unwrap();
        assert_eq!(run(at, &[command, &["--out", out]].concat()).0, Some(0));
    }
    println!("refused {refused}");
    assert_eq!(refused, 38);
}

#[test]
fn a_plan_of_too_many_parts_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let plan = ["sweep", "plan", "--chunks", "2", "--out", "s"];
    assert_eq!(run(at, &[&plan[..], &SWEEP[1..]].concat()).0, Some(0));
    let path = at.join("s/sweep.json");
    let good = std::fs::read_to_string(&path).unwrap();
    let kept: Value = serde_json::from_str(&good).unwrap();
    assert_eq!(kept.as_object().unwrap().keys().next().unwrap(), "format");
    assert_eq!((&kept["format"], &kept["version"]), (&json!("edgewalk-sweep-definition"), &json!([1, 3])));
    for chunks in ["4294967295", "0", "4"] {
        std::fs::write(&path, good.replace("\"chunks\": 2", &format!("\"chunks\": {chunks}"))).unwrap();
        for command in [&["merge"][..], &["run", "--chunk", "0"]] {
            let since = std::time::Instant::now();
            let (code, error) = run(at, &[&["sweep"], command, &["--out", "s"]].concat());
            let said = format!("s/sweep.json: --chunks {chunks}: permitted: 1 to 3");
            assert!(code == Some(2) && error.contains(&said), "{error}");
            assert!(since.elapsed().as_secs() < 10);
        }
    }
    let synth = "\"synth\": {\"target\": \"ice40-hx8k\", \"unit\": \"span\", \"seeds\": 4294967295}";
    std::fs::write(&path, good.replace("\"synth\": null", synth)).unwrap();
    let (code, error) = run(at, &["sweep", "run", "--chunk", "0", "--out", "s"]);
    assert!(code == Some(2) && error.contains("--synth-seeds 4294967295: permitted: 1 to 1000"), "{error}");
    for (from, to, said) in
        [("-definition", "-other", "edgewalk-sweep-other"), ("    1,\n", "    9,\n", "version 9.3")]
    {
        std::fs::write(&path, good.replace(from, to)).unwrap();
        let (code, error) = run(at, &["sweep", "merge", "--out", "s"]);
        assert!(code == Some(2) && error.contains(said), "{error}");
    }
    assert!(keys_of_nothing(at));
}

/// That no part has run.
fn keys_of_nothing(at: &Path) -> bool {
    !at.join("s/runs.jsonl").exists() || keys(&at.join("s")).is_empty()
}
