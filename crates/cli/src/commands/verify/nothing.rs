//! Why a suite compared nothing: the error that names the suite, its units, the reason, and a way out.

use super::{Args, Check};
use crate::verdict::Verdict;
use anyhow::{Result, anyhow, bail};
use edgewalk_machine::Plan;

/// The verdict of the checks; `taken` counts the triangles of the input that were sent.
///
/// # Errors
/// No suite ran, or a suite compared nothing and no other differs.
pub fn verdict(args: &Args, machine: &Plan, taken: usize, checks: &[Check]) -> Result<Verdict> {
    if checks.is_empty() {
        bail!(
            "no suite was run, as none of those asked for has a token for the ports of the design; \
             permitted: at least 1 suite; leave --only and --simulator out"
        );
    }
    match checks.iter().fold(Verdict::Pass, |all, check| all.and(check.verdict())) {
        Verdict::Vacuous | Verdict::Open => Err(anyhow!(reasons(args, machine, taken, checks).join("\n"))),
        verdict => Ok(verdict),
    }
}

/// One sentence for each suite that compared nothing at a unit.
fn reasons(args: &Args, machine: &Plan, taken: usize, checks: &[Check]) -> Vec<String> {
    // The units of each such suite, both in the order of the checks.
    let mut suites: Vec<(&str, Vec<&str>)> = Vec::new();
    for check in checks.iter().filter(|check| check.verdict() == Verdict::Vacuous) {
        match suites.iter_mut().find(|(suite, _)| *suite == check.suite) {
            Some((_, units)) if units.contains(&check.unit) => {}
            Some((_, units)) => units.push(check.unit),
            None => suites.push((&check.suite, vec![check.unit])),
        }
    }
    let (input, width, height) = (&args.source.input, machine.width, machine.height);
    let reason = |(suite, units): (&str, Vec<&str>)| {
        let (why, way) = match suite {
            "input" => (
                format!(
                    "none of the triangles taken from {input} ({taken}) covers a pixel of the {width}x{height} screen"
                ),
                "verify an input with a triangle in view, or take more of its triangles (--triangles)",
            ),
            _ if !args.only.is_empty() => {
                ("the cases of --only give none".to_owned(), "name other cases, or leave --only out")
            }
            _ => (
                format!("its triangles cover no pixel of the {width}x{height} screen"),
                "set a larger screen, or name cases that cover a pixel (--only)",
            ),
        };
        format!(
            "suite {suite}: 0 tokens of {} were compared: {why}; permitted: at least 1; {way}",
            units.join(", ")
        )
    };
    suites.into_iter().map(reason).collect()
}
