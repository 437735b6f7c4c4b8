//! A fault with a switch through the tests that reach it.

use std::path::Path;
use std::time::Duration;

use anyhow::{Result, bail};

use crate::child::Ended;
use crate::fault::Fault;
use crate::reach::{LONGEST, Test};

/// The crate of the program, whose tests are those of all.
pub const PROGRAM: &str = "cli";

/// The tests that can tell of it: its crate's, then the program's, each by time.
pub fn meeting<'a>(fault: &Fault, tests: &'a [Test]) -> Vec<&'a Test> {
    let of = |owner: &str| {
        let mut found: Vec<&Test> =
            tests.iter().filter(|test| test.owner == owner && test.reached.contains(&fault.number)).collect();
        found.sort_by(|one, two| one.seconds.total_cmp(&two.seconds));
        found
    };
    let mut found = of(&fault.owner);
    if fault.owner != PROGRAM {
        found.extend(of(PROGRAM));
    }
    found
}

/// The verdict: `caught` by a test of the crate, `program` by one of the program, `timeout`, `missed` by all that reach it,
/// `unreached` where none does.
pub fn judged(fault: &Fault, tests: &[Test], tree: &Path, log: &Path) -> Result<&'static str> {
    let meeting = meeting(fault, tests);
    if meeting.is_empty() {
        return Ok("unreached");
    }
    for test in meeting {
        match ended(fault, test, tree, log)? {
            Ended::Passed => {}
            Ended::Failed if test.owner == fault.owner => return Ok("caught"),
            Ended::Failed => return Ok("program"),
            Ended::TimedOut => return Ok("timeout"),
            Ended::Cut => {
                let log = log.display();
                bail!(
                    "no verdict, what was started ended from outside or not at all ({log}); run it again: {}",
                    fault.name
                )
            }
        }
    }
    Ok("missed")
}

/// How a test ends with the fault on. Where it takes too long it is timed again without: the machine may have more to do by now.
fn ended(fault: &Fault, test: &Test, tree: &Path, log: &Path) -> Result<Ended> {
    let mut seconds = test.seconds;
    loop {
        let limit = Duration::from_secs_f64(3.0 * seconds + 20.0);
        let (ended, _) = test.run(tree, &[("EDGEWALK_FAULT", &fault.number.to_string())], limit, log)?;
        if ended != Ended::TimedOut {
            return Ok(ended);
        }
        let (without, took) = test.run(tree, &[], LONGEST, log)?;
        if without != Ended::Passed {
            bail!("without a fault, {} fails now; see {}", test.name, log.display());
        }
        if took.as_secs_f64() <= 1.5 * seconds {
            return Ok(Ended::TimedOut);
        }
        seconds = took.as_secs_f64();
    }
}
