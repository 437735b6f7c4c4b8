//! A fault without a switch, by itself in a copy of the tree, through all tests.

use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Context, Result, bail};

use crate::child::{self, Ended};
use crate::fault::Fault;
use crate::judge::PROGRAM;

/// The copy, and where its builds go.
pub struct Plain {
    pub tree: PathBuf,
    pub target: PathBuf,
    pub log: PathBuf,
}

const BUILD: Duration = Duration::from_secs(1800);

impl Plain {
    /// Whether its crate builds with it; few of them do, and this takes seconds.
    pub fn viable(&self, fault: &Fault) -> Result<bool> {
        self.with(fault, || self.cargo(fault, &fault.owner, &["check"], BUILD))
    }

    /// The verdict on one that builds. `seconds`: of all tests of a crate, one after the other.
    pub fn judged(&self, fault: &Fault, seconds: impl Fn(&str) -> f64) -> Result<&'static str> {
        self.with(fault, || self.tested(fault, seconds))
    }

    /// Does something while the fault is in the copy.
    fn with<T>(&self, fault: &Fault, what: impl FnOnce() -> Result<T>) -> Result<T> {
        let path = self.tree.join(&fault.file);
        let text = std::fs::read_to_string(&path).with_context(|| fault.file.clone())?;
        std::fs::write(&path, fault.changed(&text, 0..text.len()))?;
        let found = what();
        std::fs::write(&path, text)?;
        found
    }

    fn tested(&self, fault: &Fault, seconds: impl Fn(&str) -> f64) -> Result<&'static str> {
        for owner in [fault.owner.as_str(), PROGRAM] {
            if !self.cargo(fault, owner, &["test", "--tests", "--no-run"], BUILD)? {
                return Ok("unviable");
            }
            let limit = Duration::from_secs_f64(3.0 * seconds(owner) + 60.0);
            match self.cargo_ended(fault, owner, &["test", "--tests"], limit)? {
                Ended::Passed => {}
                Ended::TimedOut => return Ok("timeout"),
                _ if owner == fault.owner => return Ok("caught"),
                _ => return Ok("program"),
            }
        }
        Ok("missed")
    }

    fn cargo(&self, fault: &Fault, owner: &str, arguments: &[&str], limit: Duration) -> Result<bool> {
        Ok(self.cargo_ended(fault, owner, arguments, limit)? == Ended::Passed)
    }

    fn cargo_ended(&self, fault: &Fault, owner: &str, arguments: &[&str], limit: Duration) -> Result<Ended> {
        let package = format!("edgewalk-{owner}");
        // Built again for every fault: that counts for more than the speed of what is built.
        let level = format!("--config=profile.release.package.edgewalk-{}.opt-level=1", fault.owner);
        let mut command = vec!["cargo"];
        command.extend(arguments);
        command.extend(["--release", &level, "--package", &package]);
        if owner == PROGRAM {
            command.extend(["--features", "jit"]);
        }
        let target = self.target.to_str().context("the target's name is text")?;
        // A fault may be what a lint forbids.
        let variables =
            [("CARGO_TARGET_DIR", target), ("CARGO_INCREMENTAL", "1"), ("RUSTFLAGS", "--cap-lints=allow")];
        match child::run(&command, &self.tree, &variables, limit, &self.log)?.0 {
            Ended::Cut => bail!("no verdict, cargo was ended from outside; run it again: {}", fault.name),
            ended => Ok(ended),
        }
    }
}
