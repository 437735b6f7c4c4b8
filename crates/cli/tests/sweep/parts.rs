//! Parts run apart and put together; `why`; stalls.

use super::{keys, rows};
use crate::support::{TRIANGLE, edgewalk, names, run};
use serde_json::Value;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

const VARY: [&str; 5] =
    ["sphere", "--vary", "formats.z_fraction=8..13", "--vary", "interpolator.adders=1,2,4"];

fn figures(folder: &std::path::Path) -> Vec<Value> {
    let mut rows = rows(folder);
    rows.iter_mut().for_each(|row| _ = row.as_object_mut().unwrap().remove("seconds"));
    rows.sort_by_key(|row| row["key"].as_str().unwrap().to_owned());
    rows
}

#[test]
fn parts_in_any_order_and_twice_merge_to_the_same_rows() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    assert_eq!(
        run(at, &[&["sweep", "--quiet", "--out", "whole"], &VARY[..]].concat()),
        (Some(0), String::new())
    );
    assert_eq!(
        run(at, &[&["sweep", "plan", "--quiet", "--chunks", "4", "--out", "s"], &VARY[..]].concat()),
        (Some(0), String::new())
    );
    assert_eq!(names(&at.join("s")), ["hq.sh", "slurm.sh", "sweep.json"]);
    // Before all parts are there the merge says how many points are missing.
    let part =
        |arguments: &[&str]| run(at, &[&["sweep", "run", "--quiet", "--out", "s"], arguments].concat());
    assert_eq!(part(&["--chunk", "2"]), (Some(0), String::new()));
    let (code, error) = run(at, &["sweep", "merge", "--quiet", "--out", "s"]);
    assert!(code == Some(2) && error.contains("14 of 18 points have no row yet"), "{error}");
    for (variable, chunk) in
        [("SLURM_ARRAY_TASK_ID", "3"), ("HQ_TASK_ID", "0"), ("HQ_TASK_ID", "0"), ("SLURM_ARRAY_TASK_ID", "1")]
    {
        let mut command = edgewalk(at, &["sweep", "run", "--quiet", "--out", "s"]);
        assert!(command.env(variable, chunk).status().unwrap().success());
    }
    for _ in 0..2 {
        assert_eq!(run(at, &["sweep", "merge", "--quiet", "--out", "s"]), (Some(0), String::new()));
        assert_eq!(figures(&at.join("s")), figures(&at.join("whole")));
        assert_eq!(keys(&at.join("s")).len(), 18);
    }
    // Digit by digit, which reading and writing numbers would not keep.
    let texts = ["s", "whole"].map(|out| {
        let text = std::fs::read_to_string(at.join(out).join("runs.jsonl")).unwrap();
        let mut lines: Vec<String> =
            text.lines().map(|line| line.split(",\"seconds\"").next().unwrap().to_owned()).collect();
        lines.sort();
        lines
    });
    assert!(texts[0] == texts[1] && texts[0].len() == 18);
    let (code, error) = part(&["--chunk", "4"]);
    assert!(code == Some(2) && error.contains("0 to 3"), "{error}");
    let mut lost = edgewalk(at, &["sweep", "run", "--out", "s"]);
    let output = lost.env_remove("SLURM_ARRAY_TASK_ID").env_remove("HQ_TASK_ID").output().unwrap();
    assert!(String::from_utf8_lossy(&output.stderr).contains("--chunk: no part is given; add --chunk N"));
    let (code, error) = run(at, &["sweep", "run", "--out", "whole", "--chunk", "0"]);
    assert!(code == Some(2) && error.contains("no parts"), "{error}");
}

#[test]
fn merge_keeps_rows_of_other_sweeps_and_writes_nothing_where_rows_are_missing() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let file = at.join("d/runs.jsonl");
    let ran = |words: &[&str]| run(at, &[&["sweep"], words, &["--quiet", "--out", "d"]].concat());
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    assert_eq!(ran(&["a.tri", "--vary", "fifo.span=1..5"]), (Some(0), String::new()));
    let before = std::fs::read_to_string(&file).unwrap();
    assert_eq!(
        ran(&["plan", "a.tri", "--vary", "fifo.span=1,2,30", "--chunks", "1"]),
        (Some(0), String::new())
    );
    assert_eq!(ran(&["run", "--chunk", "0"]), (Some(0), String::new()));
    assert_eq!(ran(&["merge"]), (Some(0), String::new()));
    let after = std::fs::read_to_string(&file).unwrap();
    let planned = |row: &&str| ["1", "2"].iter().any(|span| row.contains(&format!("\"fifo.span\":{span},")));
    let kept: Vec<&str> = before.lines().filter(|row| !planned(row)).collect();
    assert_eq!((after.lines().count(), kept.len()), (6, 3), "{after}");
    assert!(kept.iter().all(|row| after.contains(row)), "{after}");
    // With another input no row belongs to the plan.
    std::fs::write(at.join("a.tri"), TRIANGLE.replace("40", "30")).unwrap();
    let (code, error) = ran(&["merge"]);
    assert!(code == Some(2) && error.contains("3 of 3 points have no row yet"), "{error}");
    assert!(std::fs::read_to_string(&file).unwrap() == after, "a merge that failed has changed rows");
}

#[test]
fn parts_cannot_read_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let plan = ["sweep", "plan", "-", "--vary", "fifo.span=1,2", "--chunks", "1", "--out", "s"];
    let (code, error) = run(folder.path(), &plan);
    assert!(
        code == Some(2) && error.contains("-: the parts of a sweep cannot read standard input"),
        "{error}"
    );
    assert!(names(folder.path()).is_empty());
}

/// What HyperQueue's program does with a job array, all of it here and at once.
const HQ: &str = r#"#!/bin/sh
while [ "$1" != -- ]; do
    [ "$1" = --array ] && last=${2#0-}
    shift
done
shift
for task in $(seq 0 "$last"); do
    HQ_TASK_ID=$task "$@" || exit
done
"#;

#[test]
fn the_job_scripts_run_every_part() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("hq"), HQ).unwrap();
    std::fs::set_permissions(at.join("hq"), std::fs::Permissions::from_mode(0o755)).unwrap();
    std::fs::write(at.join("a.tri"), "size 64 48\nT 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 40 1 0 0 1 0\n")
        .unwrap();
    std::os::unix::fs::symlink("/bin/sh", at.join("sbatch")).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_edgewalk")).parent().unwrap();
    let path = format!("{}:{}:{}", at.display(), program.display(), std::env::var("PATH").unwrap());
    // A shell has to see folders with spaces, quotes and hyphens as they are.
    let jobs = [
        ("it's Slurm", "sbatch", &["0", "1", "2"][..]),
        ("it's HQ", "sh", &["none"]),
        ("-x", "sbatch", &["0", "1", "2"]),
        ("-y", "sh", &["none"]),
    ];
    for (out, script, tasks) in jobs {
        let plan = ["sweep", "plan", "a.tri", "--vary", "interpolator.adders=1..4", "--chunks", "3"];
        let planned = edgewalk(at, &[&plan[..], &[&*format!("--out={out}")]].concat()).output().unwrap();
        let told = String::from_utf8(planned.stdout).unwrap();
        // The commands are those that `plan` prints.
        let pasted = |command: &str, task: &str| {
            let line = told.lines().find(|line| line.trim().starts_with(command)).unwrap();
            let mut job = Command::new("sh");
            job.args(["-c", line]).current_dir(at).env("PATH", &path);
            job.env_remove("SLURM_ARRAY_TASK_ID").env_remove("HQ_TASK_ID");
            if command == "sbatch" {
                job.env("SLURM_ARRAY_TASK_ID", task);
            }
            let done = job.output().unwrap();
            assert!(done.status.success(), "{line}: {}", String::from_utf8_lossy(&done.stderr));
        };
        tasks.iter().for_each(|task| pasted(script, task));
        pasted("edgewalk sweep merge", "none");
        assert_eq!(keys(&at.join(out)).len(), 4, "{script}");
    }
}

#[test]
fn why_names_the_input_that_changed() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let triangle = |y: u32| format!("size 64 48\nT 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 {y} 1 0 0 1 0\n");
    std::fs::write(at.join("a.tri"), triangle(40)).unwrap();
    let sweep = ["sweep", "a.tri", "--vary", "setup.lanes=1,4", "--out", "s", "--quiet"];
    assert_eq!(run(at, &sweep), (Some(0), String::new()));
    let key = keys(&at.join("s"))[0].clone();
    let why = |key: &str| {
        let output = edgewalk(at, &["sweep", "why", key, "--out", "s"]).output().unwrap();
        (
            output.status.code(),
            String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr),
        )
    };
    let (code, text) = why(&key[..6]);
    assert!(
        code == Some(0) && text.contains("all of it is the same today") && text.contains("setup.lanes"),
        "{text}"
    );
    std::fs::write(at.join("a.tri"), triangle(30)).unwrap();
    let (_, text) = why(&key);
    assert!(text.contains("changed: input_hash: a.tri was"), "{text}");
    assert_eq!(run(at, &sweep), (Some(0), String::new()));
    assert_eq!(rows(&at.join("s")).len(), 4, "another file is another row");
    let (_, text) = why(&key);
    assert!(text.contains("the same machine") && text.contains("differs in [\"input_hash\"]"), "{text}");
    // It alone: not the row itself, and no other machine's.
    let (of, others): (Vec<Value>, Vec<Value>) =
        rows(&at.join("s")).into_iter().partition(|row| row["key"] == key.as_str());
    let same: Vec<Value> = others.into_iter().filter(|row| row["machine"] == of[0]["machine"]).collect();
    let json = edgewalk(at, &["sweep", "why", &key, "--json", "--out", "s"]).output().unwrap();
    let told: Value = serde_json::from_slice(&json.stdout).unwrap();
    let others: Vec<&Value> =
        told["same_machine"].as_array().unwrap().iter().map(|other| &other["key"]).collect();
    assert!(same.len() == 1 && others == [&same[0]["key"]], "{told}");
    let (code, text) = why("nothing");
    assert!(code == Some(2) && text.contains("no row has this key"), "{text}");
}
