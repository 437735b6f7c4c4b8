//! Writes `docs/mutants.md` from the verdicts that are kept.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;

use anyhow::Result;

use crate::verdicts::{Kept, Verdict, unplaced};

const HEAD: &str = "# Faults made up by a program

Written by `tests/mutants/run` ([verification](verification.md)): cargo-mutants makes up changes of one place of a crate's source (a result, an
operator, a branch); all are compiled in, each behind a switch, and with one of them on run the crate's own tests that reach it, then, if they
pass, those of the program. A fault that does not build is not viable; one that never ends is found by its time. Verdicts are kept in
`tests/mutants/verdicts` and count as long as the file with the fault is what it was.

| crate | sample by seed | last tried | tried | viable | found by its tests | by the program's | by time | survivors | of which no test reaches |
|---|---|---|---|---|---|---|---|---|---|
";

/// Writes the page; the exit code: 0 every survivor is explained, 1 others are left, 2 nothing was tried.
pub fn report(root: &Path, crates: &[String]) -> Result<u8> {
    let kept = Kept::of(root)?;
    let mut page = HEAD.to_owned();
    let (mut tried, mut survivors) = (0, BTreeMap::new());
    for owner in crates {
        let verdicts = kept.holding(owner)?;
        tried += verdicts.len();
        for seed in verdicts.iter().map(|verdict| verdict.seed).collect::<BTreeSet<_>>() {
            let of: Vec<&Verdict> = verdicts.iter().filter(|verdict| verdict.seed == seed).collect();
            let count = |word: &str| of.iter().filter(|verdict| verdict.verdict == word).count();
            let last = of.iter().map(|verdict| verdict.date.as_str()).max().unwrap_or_default();
            let (all, unreached) = (of.len(), count("unreached"));
            let viable = all - count("unviable");
            let found = format!("{} | {} | {}", count("caught"), count("program"), count("timeout"));
            let left = count("missed") + unreached;
            writeln!(
                page,
                "| {owner} | {seed} | {last} | {all} | {viable} | {found} | {left} | {unreached} |"
            )?;
        }
        for verdict in verdicts.into_iter().filter(Verdict::survives) {
            survivors.insert(unplaced(&verdict.fault), verdict.verdict);
        }
    }
    page.push_str("\n| survivor | why it may |\n|---|---|\n");
    let mut unexplained = 0;
    for (fault, verdict) in &survivors {
        let why = match kept.reason(fault) {
            Some(why) => why.to_owned(),
            None => {
                unexplained += 1;
                let unreached = if verdict == "unreached" { "; no test reaches it" } else { "" };
                format!("**not yet explained**{unreached}")
            }
        };
        writeln!(page, "| `{}` | {why} |", fault.replace('|', "\\|"))?;
    }
    std::fs::write(root.join("docs/mutants.md"), page)?;
    println!(
        "tried {tried}, survivors {}, of which {unexplained} not explained; see docs/mutants.md",
        survivors.len()
    );
    Ok(if tried == 0 { 2 } else { u8::from(unexplained > 0) })
}
