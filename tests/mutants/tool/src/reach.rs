//! Which tests meet which faults, and how long each takes.

use std::collections::{BTreeSet, HashSet};
use std::fs::{OpenOptions, Permissions};
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use serde_json::{Value, json};

use crate::cargo::Program;
use crate::child::{self, Ended};
use crate::work;

/// A test never takes this long without a fault.
pub const LONGEST: Duration = Duration::from_secs(3600);

/// A test, in a process of its own.
pub struct Test {
    pub owner: String,
    pub program: PathBuf,
    pub name: String,
    /// Without a fault.
    pub seconds: f64,
    /// The faults that it meets.
    pub reached: HashSet<u32>,
}

impl Test {
    /// Runs it with these variables.
    pub fn run(
        &self,
        tree: &Path,
        variables: &[(&str, &str)],
        limit: Duration,
        log: &Path,
    ) -> Result<(Ended, Duration)> {
        let folder = tree.join("crates").join(&self.owner);
        let mut with = vec![("CARGO_MANIFEST_DIR", folder.to_str().context("the tree's name is text")?)];
        with.extend(variables);
        let program = self.program.to_str().context("the target's name is text")?;
        child::run(&[program, "--exact", &self.name], &folder, &with, limit, log)
    }

    fn shown(&self) -> String {
        format!("{}: {}", self.owner, self.name)
    }
}

/// Runs every test of the programs once, all faults off; what `kept` holds of the same key is not run again.
pub fn reached(programs: &[Program], tree: &Path, results: &Path, key: &str) -> Result<Vec<Test>> {
    let mut tests = Vec::new();
    for program in programs {
        tests.extend(listed(program, tree, results)?);
    }
    let path = results.join("reach");
    let kept = kept(&path, key);
    let mut left = Vec::new();
    for (place, test) in tests.iter_mut().enumerate() {
        match kept.iter().find(|line| line["test"] == test.shown() && line["program"] == program_name(test)) {
            Some(line) => {
                test.seconds = line["seconds"].as_f64().unwrap_or(0.0);
                let numbers = line["reached"].as_array().into_iter().flatten();
                test.reached = numbers.filter_map(|number| Some(number.as_u64()? as u32)).collect();
            }
            None => left.push(place),
        }
    }
    if kept.is_empty() {
        std::fs::write(&path, format!("{key}\n"))?;
    }
    println!("{} tests, {} to be run once without a fault", tests.len(), left.len());
    let file = Mutex::new(OpenOptions::new().append(true).open(&path)?);
    let failed = Mutex::new(Vec::new());
    let found = Mutex::new(Vec::new());
    let began = Instant::now();
    work::both(&left, |worker, done, &place| {
        let test = &tests[place];
        let log = results.join(format!("reach-{worker}"));
        let numbers = results.join(format!("reach-{worker}.numbers"));
        std::fs::write(&numbers, "")?;
        // A test may start the program as another user.
        std::fs::set_permissions(&numbers, Permissions::from_mode(0o666))?;
        let variable = numbers.to_str().context("the target's name is text")?;
        let (ended, took) = test.run(tree, &[("EDGEWALK_FAULTS_REACHED", variable)], LONGEST, &log)?;
        let output = std::fs::read_to_string(&log).unwrap_or_default();
        match ended {
            Ended::Passed if output.contains("test result: ok. 1 passed") => {}
            Ended::Cut => bail!("{} was ended from outside; run it again", test.shown()),
            _ => {
                work::locked(&failed).push(format!("{}\n{output}", test.shown()));
                return Ok(());
            }
        }
        let text = std::fs::read_to_string(&numbers).unwrap_or_default();
        let reached: BTreeSet<u32> = text.lines().filter_map(|line| line.parse().ok()).collect();
        let line = json!({"test": test.shown(), "program": program_name(test), "seconds": took.as_secs_f64(), "reached": reached});
        writeln!(work::locked(&file), "{line}")?;
        work::locked(&found).push((place, took.as_secs_f64(), reached));
        if done % 50 == 0 {
            println!("  {done} of {} tests, {}", left.len(), work::left(began, done, left.len()));
        }
        Ok(())
    })?;
    for (place, seconds, reached) in work::into(found) {
        tests[place].seconds = seconds;
        tests[place].reached = reached.into_iter().collect();
    }
    let failed = work::into(failed);
    if !failed.is_empty() {
        std::fs::write(results.join("failed"), failed.join("\n"))?;
        let names: Vec<&str> = failed.iter().filter_map(|text| text.lines().next()).collect();
        bail!("without a fault fails (see {}):\n  {}", results.join("failed").display(), names.join("\n  "));
    }
    Ok(tests)
}

/// Those of a program, without the ignored ones.
fn listed(program: &Program, tree: &Path, results: &Path) -> Result<Vec<Test>> {
    let list = |more: &[&str]| -> Result<Vec<String>> {
        let path = program.path.to_str().context("the target's name is text")?;
        let log = results.join("list");
        let command = [&[path, "--list", "--format", "terse"], more].concat();
        let (ended, _) = child::run(&command, &tree.join("crates").join(&program.owner), &[], LONGEST, &log)?;
        if ended != Ended::Passed {
            bail!("{path} lists no tests");
        }
        let text = std::fs::read_to_string(&log)?;
        Ok(text.lines().filter_map(|line| line.strip_suffix(": test")).map(str::to_owned).collect())
    };
    let ignored: HashSet<String> = list(&["--ignored"])?.into_iter().collect();
    let test = |name| Test {
        owner: program.owner.clone(),
        program: program.path.clone(),
        name,
        seconds: 0.0,
        reached: HashSet::new(),
    };
    Ok(list(&[])?.into_iter().filter(|name| !ignored.contains(name)).map(test).collect())
}

/// The program's name without its folder: two of a crate may have tests of the same name.
fn program_name(test: &Test) -> String {
    test.program.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The lines that a cut run of the same key left.
fn kept(path: &Path, key: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    match text.split_once('\n') {
        Some((first, lines)) if first == key => {
            lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
        }
        _ => Vec::new(),
    }
}
