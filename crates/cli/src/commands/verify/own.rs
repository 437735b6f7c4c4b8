//! A user's own design under the suites of its unit.

use super::events::Events;
use super::{Args, Check, Due, in_simulator, write};
use crate::suites::warn_of_gaps;
use crate::verdict::Verdict;
use crate::{Talk, jobs, progress};
use anyhow::Result;
use edgewalk_machine::Plan;
use edgewalk_vectors::dut::Wiring;
use edgewalk_vectors::{Runs, Simulator, Suite, Tables, directory_for, reached};
use std::time::Duration;

/// Every suite in Icarus. A build with Verilator takes seconds: it runs the directed suites as one.
pub fn checks(
    args: &Args,
    machine: &Plan,
    wiring: &Wiring,
    suites: Vec<Suite>,
    talk: Talk,
) -> Result<(Vec<Check>, Events)> {
    let unit = wiring.dut.unit;
    let asked = |simulator| args.simulator.is_empty() || args.simulator.contains(&simulator);
    let suites: Vec<Suite> = suites.into_iter().filter(|suite| suite.is_for(unit)).collect();
    let mut work: Vec<(Simulator, Suite)> = Vec::new();
    if asked(Simulator::Verilator) {
        let directed = suites.iter().filter(|suite| ["hazards", "corners"].contains(&suite.name.as_str()));
        let directed: Vec<Suite> = directed.cloned().collect();
        if !directed.is_empty() {
            work.push((Simulator::Verilator, Suite::joined("directed", "", directed)));
        }
    }
    if asked(Simulator::Icarus) {
        work.extend(suites.into_iter().map(|suite| (Simulator::Icarus, suite)));
    }
    let limit = Duration::from_secs(args.limit);
    let bar = progress::bar(work.len() as u64, "suites", talk.quiet);
    let done = jobs::all(&work, &bar, |(simulator, suite)| {
        let trace = Runs::new(machine, suite, suite.state).capture(unit, args.stalls.unwrap_or(suite.stalls));
        let due = Due { tokens: wiring.tokens(&trace), all: wiring.expected(&trace) };
        if due.tokens == 0 && trace.tokens_out() > 0 {
            return Ok(None);
        }
        let folder = write(directory_for(suite, &trace, wiring, Tables::LeftOut))?;
        let check = in_simulator(*simulator, folder.path(), limit, suite, unit, due)?;
        Ok(Some((check, (unit, reached(&trace)))))
    })?;
    bar.finish_and_clear();
    for ((_, suite), _) in work.iter().zip(&done).filter(|(_, done)| done.is_none() && !talk.quiet) {
        let all = "all of its tokens are of memories inside the design";
        talk.warn(&format!("{}: left out, as nothing is to be compared: {all}", suite.name));
    }
    let (checks, runs): (Vec<Check>, Vec<_>) = done.into_iter().flatten().unzip();
    warn_of_gaps(&runs, talk);
    let passed = checks.iter().zip(&runs).filter(|(check, _)| check.verdict() == Verdict::Pass);
    let passed = passed.map(|(check, (_, reached))| (&check.met, reached));
    let events = Events::of(machine, wiring, passed);
    Ok((checks, events))
}
