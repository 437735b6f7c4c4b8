//! The verdicts that are kept: `tests/mutants/verdicts/CRATE`, a line a fault: verdict, seed of the sample, date, checksum of
//! the file with the fault, fault. One holds as long as that file is what it was.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use crate::cksum::cksum;

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    pub verdict: String,
    pub seed: u64,
    pub date: String,
    pub fault: String,
}

impl Verdict {
    /// No test fails: none notices it, or none reaches it.
    pub fn survives(&self) -> bool {
        matches!(self.verdict.as_str(), "missed" | "unreached")
    }
}

/// The repository, and the reasons that it knows.
pub struct Kept {
    root: PathBuf,
    known: Vec<(String, String)>,
}

impl Kept {
    pub fn of(root: &Path) -> Result<Kept> {
        let text =
            std::fs::read_to_string(root.join("tests/mutants/known")).context("tests/mutants/known")?;
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        let known =
            lines.filter_map(|line| line.split_once('\t')).map(|(fault, why)| (fault.into(), why.into()));
        Ok(Kept { root: root.to_owned(), known: known.collect() })
    }

    /// The verdicts of a crate that hold.
    pub fn holding(&self, owner: &str) -> Result<Vec<Verdict>> {
        let mut holding = Vec::new();
        for line in self.lines(owner)? {
            let parts: Vec<&str> = line.splitn(5, '\t').collect();
            let [verdict, seed, date, sum, fault] = parts[..] else { continue };
            let file = fault.split(':').next().unwrap_or_default();
            if checksum(&self.root, file).is_some_and(|now| now == sum) {
                let seed = seed.parse().unwrap_or(0);
                holding.push(Verdict {
                    verdict: verdict.into(),
                    seed,
                    date: date.into(),
                    fault: fault.into(),
                });
            }
        }
        Ok(holding)
    }

    /// Whether a fault need not be tried: there is a verdict that holds, and if it survives, a reason.
    pub fn settled(&self, verdict: &Verdict) -> bool {
        !verdict.survives() || self.reason(&verdict.fault).is_some()
    }

    /// Why a survivor may.
    pub fn reason(&self, fault: &str) -> Option<&str> {
        let unplaced = unplaced(fault);
        self.known.iter().find(|(known, _)| *known == unplaced).map(|(_, why)| why.as_str())
    }

    /// Keeps a verdict in place of an older one of the same fault; `tree`: where the file is as it was tried.
    pub fn keep(&self, owner: &str, tree: &Path, verdict: &Verdict) -> Result<()> {
        let Verdict { verdict, seed, date, fault } = verdict;
        let file = fault.split(':').next().unwrap_or_default();
        let sum = checksum(tree, file).with_context(|| file.to_owned())?;
        let mut lines = self.lines(owner)?;
        lines.retain(|line| !line.ends_with(&format!("\t{fault}")));
        lines.push(format!("{verdict}\t{seed}\t{date}\t{sum}\t{fault}"));
        let path = self.path(owner);
        let new = path.with_extension("new");
        std::fs::write(&new, lines.join("\n") + "\n")?;
        std::fs::rename(new, path)?;
        Ok(())
    }

    fn path(&self, owner: &str) -> PathBuf {
        self.root.join("tests/mutants/verdicts").join(owner)
    }

    fn lines(&self, owner: &str) -> Result<Vec<String>> {
        let path = self.path(owner);
        if !path.exists() {
            return Ok(Vec::new());
        }
        let text = std::fs::read_to_string(&path).with_context(|| path.display().to_string())?;
        Ok(text.lines().map(str::to_owned).collect())
    }
}

fn checksum(top: &Path, file: &str) -> Option<String> {
    Some(cksum(&std::fs::read(top.join(file)).ok()?).to_string())
}

/// A fault without its line and column, which move: `crates/x/src/y.rs: replace ...`.
pub fn unplaced(fault: &str) -> String {
    let parts: Vec<&str> = fault.splitn(4, ':').collect();
    match parts[..] {
        // A name without its place has colons too, in paths.
        [file, line, column, what] if [line, column].iter().all(|place| place.parse::<u32>().is_ok()) => {
            format!("{file}:{what}")
        }
        _ => fault.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_fault_without_its_place() {
        let unplaced = "crates/x/src/y.rs: replace <a::b as c::d>::e with ()";
        assert_eq!(super::unplaced("crates/x/src/y.rs:1:2: replace <a::b as c::d>::e with ()"), unplaced);
        assert_eq!(super::unplaced(unplaced), unplaced);
    }
}
