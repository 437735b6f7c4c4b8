//! Faults that a bench passed: the line that changed, and a triangle that shows the fault or a proof that none does.

use crate::suites::{directed, functions};
use anyhow::Result;
use edgewalk_lockstep::LockstepError;
use edgewalk_machine::Plan;
use edgewalk_netlist::Netlist;
use edgewalk_netlist::mutate::Mutant;
use edgewalk_vectors::prove::{Proof, prove};
use edgewalk_vectors::{Interface, Runs, Suite, Trace, Unit};
use serde::Serialize;
use std::fmt::Write as _;
use std::sync::Arc;

/// A fault that the bench passed.
#[derive(Serialize)]
pub struct Survivor {
    module: String,
    fault: String,
    /// The lines of Verilog without it.
    without: Vec<String>,
    /// The lines with it.
    with: Vec<String>,
    /// Where the suites of the unit show it first.
    #[serde(skip_serializing_if = "Option::is_none")]
    shown_by: Option<Shown>,
    /// No input whatever shows it: so the prover found, if it was asked.
    pub proved_equivalent: bool,
}

/// A difference that a fault makes.
#[derive(Serialize)]
struct Shown {
    suite: String,
    case: String,
    /// Number in the suite, from 0; none where the difference belongs to no triangle.
    triangle: Option<u32>,
    /// Port, cycle, what was expected and what was found.
    difference: String,
}

/// The unit under its suites, as far as needed to look at survivors.
pub struct Look<'a> {
    machine: &'a Plan,
    unit: Unit,
    netlist: &'a Arc<Netlist>,
    runs: Vec<(Suite, Trace)>,
    /// Asks the prover where no suite shows a fault.
    prove: bool,
}

impl<'a> Look<'a> {
    /// Runs the model over every suite of the unit.
    pub fn new(machine: &'a Plan, unit: Unit, netlist: &'a Arc<Netlist>, prove: bool) -> Result<Look<'a>> {
        let random = Suite::named(machine, "random", 1, 24)?;
        let suites = [directed(machine)?, functions(machine)?, vec![random]].concat();
        let suites = suites.into_iter().filter(|suite| suite.is_for(unit));
        let run = |suite: Suite| {
            let trace = Runs::new(machine, &suite, suite.state).capture(unit, suite.stalls);
            (suite, trace)
        };
        Ok(Look { machine, unit, netlist, runs: suites.map(run).collect(), prove })
    }

    /// What can be said of a fault that the bench passed.
    pub fn at(&self, mutant: &Mutant) -> Result<Survivor> {
        let faulty = mutant.apply(self.netlist);
        let (without, with) =
            changed(&edgewalk_verilog::print(self.netlist), &edgewalk_verilog::print(&faulty));
        let shown_by = self.runs.iter().find_map(|(suite, trace)| shown(suite, trace, &faulty));
        // Of SETUP and of the whole machine the prover does not see all: they are too large.
        let whole = self.unit != Unit::MACHINE && self.unit.name() != "setup";
        let proved_equivalent = self.prove && shown_by.is_none() && {
            let interface = Interface::new(self.machine, self.unit);
            prove(&interface, self.netlist, mutant, whole)? == Proof::Equivalent
        };
        let (module, fault) = (mutant.module.clone(), mutant.description.clone());
        Ok(Survivor { module, fault, without, with, shown_by, proved_equivalent })
    }
}

/// The first difference that a faulty unit makes in a run.
fn shown(suite: &Suite, trace: &Trace, faulty: &Arc<Netlist>) -> Option<Shown> {
    let (triangle, difference) = match trace.lockstep(faulty) {
        Ok(_) | Err(LockstepError::Vacuous) => return None,
        Err(LockstepError::Differs { difference, .. }) => (difference.triangle, difference.to_string()),
        Err(error) => (None, error.to_string()),
    };
    let mut first = 0;
    let of = |case: &&edgewalk_vectors::Case| {
        first += case.triangles.len() as u32; // a suite is small
        triangle.is_some_and(|triangle| triangle < first)
    };
    let case = suite.cases.iter().find(of).map(|case| case.name.clone()).unwrap_or_default();
    Some(Shown { suite: suite.name.clone(), case, triangle, difference })
}

/// Lines shown of a change.
const SHOWN: usize = 4;

/// The first lines in which two designs differ.
fn changed(one: &[(String, String)], other: &[(String, String)]) -> (Vec<String>, Vec<String>) {
    for ((_, one), (_, other)) in one.iter().zip(other) {
        let (one, other): (Vec<&str>, Vec<&str>) = (one.lines().collect(), other.lines().collect());
        let same = one.iter().zip(&other).take_while(|(a, b)| a == b).count();
        if same == one.len() && same == other.len() {
            continue;
        }
        let (one, other) = (&one[same..], &other[same..]);
        let behind = one.iter().rev().zip(other.iter().rev()).take_while(|(a, b)| a == b).count();
        let lines = |lines: &[&str]| {
            lines[..lines.len() - behind].iter().take(SHOWN).map(|line| line.trim().to_owned()).collect()
        };
        return (lines(one), lines(other));
    }
    (Vec::new(), Vec::new())
}

impl Survivor {
    /// As lines; `proved`: the prover was asked.
    pub fn lines(&self, proved: bool) -> String {
        let Survivor { module, fault, without, with, shown_by, proved_equivalent } = self;
        let mut text = format!("survived: {module}: {fault}\n");
        // Writing to a string cannot fail.
        without.iter().for_each(|line| _ = writeln!(text, "    - {line}"));
        with.iter().for_each(|line| _ = writeln!(text, "    + {line}"));
        _ = match (shown_by, proved_equivalent) {
            (Some(Shown { suite, case, triangle: Some(triangle), difference }), _) => {
                writeln!(text, "    shown by triangle {triangle} of suite {suite}, case {case}: {difference}")
            }
            (Some(Shown { suite, difference, .. }), _) => {
                writeln!(text, "    shown by suite {suite}: {difference}")
            }
            (None, true) => writeln!(text, "    proved: it changes nothing at any port"),
            (None, false) if proved => writeln!(text, "    no suite shows it; neither proved nor refuted"),
            (None, false) => writeln!(text, "    no suite shows it; --prove asks the prover"),
        };
        text
    }
}
