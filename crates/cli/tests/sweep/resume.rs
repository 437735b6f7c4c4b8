//! A sweep that is ended at any time goes on where it was.

use super::{keys, rows};
use crate::support::{TRIANGLE, edgewalk, run};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::Value;
use std::fs::{OpenOptions, Permissions};
use std::io::Write as _;
use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _};
use std::os::unix::process::CommandExt as _;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

const SWEEP: &[&str] = &[
    "sweep",
    "torus-knot",
    "--vary",
    "interpolator.adders=1..4",
    "--vary",
    "fifo.span=1,2,4",
    "--vary",
    "memory.latency=1..4",
    "--vary",
    "formats.z_fraction=8,10,12",
    "--vary",
    "formats.color_fraction=8,12",
    "--quiet",
];

fn without_times(folder: &Path) -> Vec<Value> {
    let mut rows = rows(folder);
    rows.iter_mut().for_each(|row| _ = row.as_object_mut().unwrap().remove("seconds"));
    rows.sort_by_key(|row| row["key"].as_str().unwrap().to_owned());
    rows
}

#[test]
fn killed_at_random_it_ends_with_the_same_rows_and_does_nothing_twice() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = |out: &str| edgewalk(folder.path(), &[SWEEP, &["--out", out]].concat());
    assert!(sweep("whole").status().unwrap().success());
    let mut random = Pcg64Mcg::seed_from_u64(4);
    let (mut kills, mut cut_short) = (0, 0);
    let path = folder.path().join("cut/runs.jsonl");
    let there = || std::fs::read_to_string(&path).unwrap_or_default();
    for _ in 0..10 {
        let mut child = sweep("cut").spawn().unwrap();
        // At a random number of rows, as starting takes long on a busy machine and the rows then come at once.
        let wanted = there().lines().count() + random.random_range(0..30);
        while there().lines().count() < wanted && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_micros(500));
        }
        cut_short += u32::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap(); // SIGKILL
        child.wait().unwrap();
        kills += 1;
        // As a write that was cut would leave it, without a kill that happens to meet one.
        if random.random_bool(0.5) && !there().is_empty() {
            let torn = "{\"key\":\"0123456789abcdef\",\"status\":\"o";
            OpenOptions::new().append(true).open(&path).unwrap().write_all(torn.as_bytes()).unwrap();
        }
    }
    let before = there().lines().count();
    assert!(sweep("cut").status().unwrap().success());
    let [whole, cut] = ["whole", "cut"].map(|out| without_times(&folder.path().join(out)));
    assert_eq!(whole.len(), 4 * 3 * 4 * 3 * 2);
    assert!(whole == cut, "other rows than undisturbed");
    let mut once = keys(&folder.path().join("cut"));
    once.dedup();
    assert_eq!(once.len(), cut.len(), "a row was made twice");
    println!("{kills} kills, {cut_short} of them in the middle; {before} rows were there at the last start");
    assert!(kills == 10 && cut_short == 10 && (40..288).contains(&before), "{cut_short} {before}");
    // Once more: nothing is made, the table is the same.
    let table = std::fs::read_to_string(folder.path().join("cut/runs.csv")).unwrap();
    let text = there();
    let again = edgewalk(folder.path(), &[SWEEP, &["--out", "cut", "--json"]].concat()).output().unwrap();
    let told: Value = serde_json::from_slice(&again.stdout).unwrap();
    assert_eq!((&told["made"], &told["rows"]), (&0.into(), &whole.len().into()));
    assert_eq!(
        (there(), std::fs::read_to_string(folder.path().join("cut/runs.csv")).unwrap()),
        (text, table)
    );
}

#[test]
fn a_full_disk_is_said_and_the_rows_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    // No file may grow above so many blocks of 512 bytes: what `ulimit -f` forbids is an error as a full disk is.
    let line = |blocks: u32, out: &str| {
        format!(
            "trap '' XFSZ; ulimit -f {blocks}; exec {} {} --out {out}",
            env!("CARGO_BIN_EXE_edgewalk"),
            SWEEP.join(" ")
        )
    };
    let shell = |blocks, out| {
        Command::new("sh").args(["-c", &line(blocks, out)]).current_dir(folder.path()).output().unwrap()
    };
    let output = shell(200, "s");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && error.contains("s/runs.jsonl"), "{:?} {error}", output.status);
    let kept = rows(&folder.path().join("s")).len();
    assert!(kept > 20 && kept < 288, "{kept} rows kept");
    // With room it goes on from there.
    let (code, error) = run(folder.path(), &[SWEEP, &["--out", "s"]].concat());
    assert_eq!((code, error.as_str()), (Some(0), ""));
    let mut once = keys(&folder.path().join("s"));
    once.dedup();
    assert_eq!((once.len(), rows(&folder.path().join("s")).len()), (288, 288));
}

#[test]
fn a_read_only_folder_is_said_and_the_rows_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("edgewalk");
    std::fs::copy(env!("CARGO_BIN_EXE_edgewalk"), &program).unwrap();
    let (code, error) = run(folder.path(), &[SWEEP, &["--sample", "40", "--out", "s"]].concat());
    assert_eq!((code, error.as_str()), (Some(0), ""));
    let permit = |path: &Path, mode| std::fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
    let kept = || std::fs::read_to_string(folder.path().join("s/runs.jsonl")).unwrap();
    let before = kept();
    permit(&folder.path().join("s/runs.jsonl"), 0o444);
    permit(&folder.path().join("s"), 0o555);
    permit(folder.path(), 0o555);
    let somebody = |out: &str| {
        let mut command = Command::new(&program);
        command.args(SWEEP).args(["--out", out]).current_dir(folder.path());
        // Permissions do not bind root.
        if std::fs::metadata(&program).unwrap().uid() == 0 {
            command.gid(65534).uid(65534);
        }
        let output = command.output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    for (out, named) in [("s", "s"), ("new", "new")] {
        let (code, error) = somebody(out);
        assert!(
            code == Some(2) && error.contains(named) && error.contains("ermission denied"),
            "{code:?} {error}"
        );
        assert_eq!(error.lines().filter(|line| line.starts_with("error:")).count(), 1, "{error}");
    }
    assert_eq!(kept(), before);
    assert!(!folder.path().join("new").exists());
    permit(folder.path(), 0o755);
    permit(&folder.path().join("s"), 0o755);
    permit(&folder.path().join("s/runs.jsonl"), 0o644);
    let (code, error) = run(folder.path(), &[SWEEP, &["--out", "s"]].concat());
    assert_eq!((code, error.as_str()), (Some(0), ""));
    assert_eq!((before.lines().count(), rows(&folder.path().join("s")).len()), (40, 288));
}

#[test]
fn sweep_that_runs_keeps_its_definition() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let kept = || std::fs::read_to_string(at.join("s/sweep.json")).unwrap();
    let sweep = ["sweep", "a.tri", "--quiet", "--out", "s", "--vary"];
    assert_eq!(run(at, &[&sweep[..], &["fifo.span=1,2"]].concat()), (Some(0), String::new()));
    let before = kept();
    // As a sweep that runs holds it.
    let rows = OpenOptions::new().append(true).open(at.join("s/runs.jsonl")).unwrap();
    rows.lock().unwrap();
    let plan = ["sweep", "plan", "a.tri", "--out", "s", "--chunks", "1", "--vary", "fifo.span=3"];
    for words in [
        &[&sweep[..], &["fifo.span=3"]].concat()[..],
        &[&sweep[..], &["fifo.span=1..64", "--search", "32"]].concat(),
        &plan,
        &["sweep", "merge", "--out", "s"],
    ] {
        let (code, error) = run(at, words);
        assert!(code == Some(2) && error.contains("another sweep is writing"), "{words:?}: {error}");
        assert_eq!(kept(), before, "{words:?}");
    }
}

#[test]
fn two_at_once_do_not_write_into_one_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = edgewalk(folder.path(), &[SWEEP, &["--out", "s"]].concat()).spawn().unwrap();
    let rows = folder.path().join("s/runs.jsonl");
    while std::fs::metadata(&rows).map_or(0, |data| data.len()) == 0 {
        assert!(first.try_wait().unwrap().is_none(), "it ended before it could be met");
        std::thread::sleep(Duration::from_millis(2));
    }
    let (code, error) = run(folder.path(), &[SWEEP, &["--out", "s"]].concat());
    assert!(code == Some(2) && error.contains("another sweep is writing"), "{error}");
    assert!(first.wait().unwrap().success());
}
