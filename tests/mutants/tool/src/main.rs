//! Faults made up by cargo-mutants, all of a sample compiled in at once, each behind a switch that a variable of the
//! environment turns on (mutant schemata: Untch, Offutt and Harrold 1993), and each through the tests that reach it.
//!
//! ```text
//! options ──> fault (list, sample) ──> place ──> instrument ──> switched (set aside what does not build) ──> cargo (tests)
//!         ──> reach (every test once) ──> judge | plain (set aside) ──> verdicts ──> report
//! ```

mod cargo;
mod child;
mod cksum;
mod fault;
mod instrument;
mod judge;
mod options;
mod place;
mod plain;
mod reach;
mod report;
mod switched;
mod tree;
mod verdicts;
mod work;

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;
use std::process::{Command, ExitCode};
use std::sync::Mutex;
use std::time::Instant;

use anyhow::{Context, Result, bail};

use cargo::Build;
use fault::Fault;
use options::Options;
use plain::Plain;
use reach::Test;
use verdicts::{Kept, Verdict};

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let crates = match crates(&root) {
        Ok(crates) => crates,
        Err(error) => return failed(&error, 3),
    };
    let options = match options::options(std::env::args().skip(1), &crates) {
        Ok(options) => options,
        Err(message) => return failed(&anyhow::anyhow!(message), 2),
    };
    match campaign(&root, &options) {
        Ok(()) if options.estimate => ExitCode::SUCCESS,
        Ok(()) => report::report(&root, &crates).map_or_else(|error| failed(&error, 3), ExitCode::from),
        Err(error) => failed(&error, 3),
    }
}

fn failed(error: &anyhow::Error, code: u8) -> ExitCode {
    eprintln!("tests/mutants/run: {error:#}");
    ExitCode::from(code)
}

/// The crates of `tests/mutants/crates`.
fn crates(root: &Path) -> Result<Vec<String>> {
    let text = std::fs::read_to_string(root.join("tests/mutants/crates")).context("tests/mutants/crates")?;
    Ok(text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect())
}

/// Tries what is left of the sample.
fn campaign(root: &Path, options: &Options) -> Result<()> {
    let root = root.canonicalize()?;
    let results = root.join("target/mutants/results");
    std::fs::create_dir_all(&results)?;
    std::fs::create_dir_all(root.join("tests/mutants/verdicts"))?;
    let lock = File::create(root.join("target/mutants/lock"))?;
    if lock.try_lock().is_err() {
        bail!("another run, or what is left of one, works in target/mutants");
    }
    let files = tree::files(&root)?;
    let plain = root.join("target/mutants/plain");
    tree::hold(&plain, &files)?;
    let mut faults: Vec<Fault> = Vec::new();
    for owner in &options.crates {
        let first = faults.len() as u32 + 1;
        faults.extend(fault::sampled(&plain, owner, &options.seeds, options.sample, first)?);
    }
    let kept = Kept::of(&root)?;
    let mut settled = BTreeSet::new();
    for owner in &options.crates {
        let verdicts = kept.holding(owner)?.into_iter();
        settled.extend(verdicts.filter(|verdict| kept.settled(verdict)).map(|verdict| verdict.fault));
    }
    // Judged faults are compiled in too: when a cut run goes on, all is as it was, and a survivor is not tried twice.
    let names: Vec<&str> = faults.iter().map(|fault| fault.name.as_str()).collect();
    let key = tree::key(&files, &names);
    let tried = results.join("tried");
    match std::fs::read_to_string(&tried).unwrap_or_default().strip_prefix(&format!("{key}\n")) {
        Some(lines) => settled.extend(lines.lines().map(str::to_owned)),
        None => std::fs::write(&tried, format!("{key}\n"))?,
    }
    let left: Vec<&Fault> = faults.iter().filter(|fault| !settled.contains(&fault.name)).collect();
    println!("{} faults, {} to be tried", faults.len(), left.len());
    if left.is_empty() {
        return Ok(());
    }

    let build = Build {
        tree: root.join("target/mutants/tree"),
        target: root.join("target/mutants/build"),
        crates: with_program(&options.crates),
    };
    let began = Instant::now();
    let phase = |what: &str| println!("[{:.0} s] {what}", began.elapsed().as_secs_f64());
    phase("switches written and checked");
    let aside = aside(&results, &files, &faults, &build, &key)?;
    phase("tests built");
    let programs = build.programs()?;
    phase("tests run once");
    let compiled = tree::key(&tree::files(&build.tree)?, &names);
    let tests = reach::reached(&programs, &build.tree, &results, &compiled)?;
    let (alone, switched): (Vec<&Fault>, Vec<&Fault>) =
        left.into_iter().partition(|fault| aside.contains_key(&fault.number));
    let most: f64 =
        switched.iter().flat_map(|fault| judge::meeting(fault, &tests)).map(|test| test.seconds).sum();
    phase(&format!(
        "{} faults with a switch: {:.0} minutes if no test finds any; {} set aside",
        switched.len(),
        most / 120.0,
        alone.len()
    ));
    if options.estimate {
        return Ok(());
    }

    let tried = OpenOptions::new().append(true).open(tried)?;
    let state = Mutex::new((tried, BTreeMap::new()));
    let keep = Keeping { kept, tree: &plain, state };
    let judging = Instant::now();
    work::both(&switched, |worker, done, fault| {
        let verdict = judge::judged(fault, &tests, &build.tree, &results.join(format!("judge-{worker}")))?;
        keep.keep(
            fault,
            verdict,
            &format!("{done} of {}, {}", switched.len(), work::left(judging, done, switched.len())),
        )
    })?;
    phase("faults that were set aside, one by one");
    let seconds =
        |owner: &str| tests.iter().filter(|test: &&Test| test.owner == owner).map(|test| test.seconds).sum();
    let slow = Plain {
        tree: plain.clone(),
        target: root.join("target/mutants/plain-build"),
        log: results.join("plain"),
    };
    let mut viable = Vec::new();
    for fault in alone {
        if slow.viable(fault)? {
            viable.push(fault);
        } else {
            keep.keep(fault, "unviable", "does not build")?;
        }
    }
    let judging = Instant::now();
    for (place, fault) in viable.iter().enumerate() {
        let verdict = slow.judged(fault, seconds)?;
        let done =
            format!("{} of {}, {}", place + 1, viable.len(), work::left(judging, place + 1, viable.len()));
        keep.keep(fault, verdict, &done)?;
    }
    phase("done");
    Ok(())
}

/// The crates whose tests are built: those with faults, and the program.
fn with_program(crates: &[String]) -> Vec<String> {
    let mut all = crates.to_vec();
    if !all.iter().any(|owner| owner == judge::PROGRAM) {
        all.push(judge::PROGRAM.to_owned());
    }
    all
}

/// Puts the switches in; which faults have none is kept for a cut run of the same key.
fn aside(
    results: &Path,
    files: &tree::Files,
    faults: &[Fault],
    build: &Build,
    key: &str,
) -> Result<BTreeMap<u32, String>> {
    let path = results.join("aside");
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    let mut known = BTreeMap::new();
    if let Some((first, lines)) = text.split_once('\n')
        && first == key
    {
        for (number, why) in lines.lines().filter_map(|line| line.split_once('\t')) {
            known.insert(number.parse()?, why.to_owned());
        }
    }
    let aside = switched::switched(files, faults, build, known)?;
    let lines = aside.iter().map(|(number, why)| format!("{number}\t{why}\n"));
    std::fs::write(&path, format!("{key}\n{}", lines.collect::<String>()))?;
    Ok(aside)
}

/// Keeps verdicts as they come.
struct Keeping<'a> {
    kept: Kept,
    tree: &'a Path,
    /// Those tried, for a cut run, and how many there are of each verdict. Also the lock of the files of verdicts.
    state: Mutex<(File, BTreeMap<&'static str, usize>)>,
}

impl Keeping<'_> {
    fn keep(&self, fault: &Fault, verdict: &'static str, progress: &str) -> Result<()> {
        let date = Command::new("date").arg("+%F").output().context("date")?;
        let date = String::from_utf8_lossy(&date.stdout).trim().to_owned();
        let line = Verdict { verdict: verdict.to_owned(), seed: fault.seed, date, fault: fault.name.clone() };
        let mut state = work::locked(&self.state);
        let (tried, counts) = &mut *state;
        self.kept.keep(&fault.owner, self.tree, &line)?;
        writeln!(tried, "{}", fault.name)?;
        *counts.entry(verdict).or_default() += 1;
        let counted: Vec<String> =
            counts.iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
        println!("  {verdict:<9} {} [{progress}: {}]", fault.name, counted.join(", "));
        Ok(())
    }
}
