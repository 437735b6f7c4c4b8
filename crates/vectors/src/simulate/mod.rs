//! Runs a directory of vectors in a simulator, and its design through lint and synthesis.
//!
//! The only place of this crate that does I/O. Tools read the directory and write to a work directory beside it; every
//! tool has a time limit. A verdict says how much was compared, and nothing compared is a verdict of its own.

mod synthesis;

pub use edgewalk_tool::Stop;
pub use synthesis::{Cells, synth_ice40};

use crate::manifest::Manifest;
use crate::read::{ReadError, read};
use crate::write::mark;
use edgewalk_tool::{first_lines, run};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// A simulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simulator {
    /// Icarus Verilog.
    Icarus,
    /// Verilator with `--binary --timing`.
    Verilator,
}

impl Simulator {
    /// Both.
    pub const ALL: [Simulator; 2] = [Simulator::Icarus, Simulator::Verilator];

    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["icarus", "verilator"][self as usize]
    }
}

/// How a run of the test bench ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Everything expected came, as expected, and nothing else.
    Pass {
        /// Tokens and status changes compared.
        checked: u64,
        /// How often the run met the events that the bench of a user's design counts.
        met: BTreeMap<String, u64>,
    },
    /// Something differs, is missing, or is too much.
    Mismatch {
        /// Tokens and status changes that came.
        checked: u64,
        /// Tokens that should have come.
        expected: u64,
        /// What the test bench says first.
        lines: Vec<String>,
    },
    /// Nothing was compared.
    Vacuous,
}

/// Why there is no outcome.
#[derive(Debug, thiserror::Error)]
pub enum SimulateError {
    /// The directory is not what its manifest says.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The simulator refuses a user's design, or the design ends the run.
    #[error("{simulator} does not run the design; correct its files or its description:\n{}", lines.join("\n"))]
    Design {
        /// The simulator.
        simulator: &'static str,
        /// What it said first.
        lines: Vec<String>,
    },
    /// A tool is missing or broken, or took too long.
    #[error(transparent)]
    Tool(#[from] Stop),
}

/// Runs the test bench of a directory, after checking that its files are those that were written. `work` is a folder that
/// is there, for what the tools write.
///
/// # Errors
/// A changed directory; a tool that is missing, refuses the design, or exceeds the limit (for each of its two steps).
pub fn simulate(
    simulator: Simulator,
    directory: &Path,
    work: &Path,
    limit: Duration,
) -> Result<Outcome, SimulateError> {
    let manifest = read(|name| std::fs::read(directory.join(name)))?.manifest;
    // The tools run inside the directory, so their output needs a full path.
    let work = std::path::absolute(work).map_err(|error| Stop::file(work, &error))?;
    printed(simulator, &manifest, directory, &work, limit)
        .and_then(|text| {
            let lines = of_bench(&manifest, &text);
            let others = text.lines().filter(|line| !line.contains(&mark(&manifest.machine.hash)));
            let said = lines.iter().copied().chain(others);
            let none = || Stop::Broken { tool: simulator.name().to_owned(), lines: first_lines(said) };
            verdict(&manifest, &lines).ok_or_else(none)
        })
        .map_err(|stop| match stop {
            Stop::Broken { lines, .. } if manifest.dut.is_some() && !compiler_failed(&lines) => {
                SimulateError::Design { simulator: simulator.name(), lines }
            }
            stop => stop.into(),
        })
}

/// Whether what Verilator said is of the build of its C++, with which the design has nothing to do.
fn compiler_failed(lines: &[String]) -> bool {
    lines.iter().any(|line| line.starts_with("make") || line.starts_with("%Error: make"))
}

/// What the test bench and the tools print.
fn printed(
    simulator: Simulator,
    manifest: &Manifest,
    directory: &Path,
    work: &Path,
    limit: Duration,
) -> Result<String, Stop> {
    match simulator {
        Simulator::Icarus => {
            let program = work.join("tb.vvp");
            let mut compile = Command::new("iverilog");
            compile.arg(format!("-g{}", standard(manifest)));
            compile.args(["-s", "tb", "-c", "filelist.f", "-o"]).arg(&program);
            run(compile.current_dir(directory), limit)?;
            run(Command::new("vvp").arg("-n").arg(&program).current_dir(directory), limit)
        }
        Simulator::Verilator => {
            let objects = work.join("obj_dir");
            let mut compile = Command::new("verilator");
            compile.args(["--binary", "--timing", "-O3", "--top-module", "tb", "-f", "filelist.f"]);
            if manifest.dut.is_some() {
                // A foreign file may lack `timescale, or draw warnings: lint is where they count.
                compile.args(["-Wno-fatal", "--timescale", "1ns/1ps"]);
            }
            // The C++ runs for a moment only: to optimise it takes longer, and each file of it reads Verilator's headers.
            compile.arg("--Mdir").arg(&objects).args([
                "-MAKEFLAGS",
                "OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0",
                "--output-split",
                "1000000",
            ]);
            run(compile.current_dir(directory), limit)?;
            let built = objects.join("Vtb");
            std::fs::metadata(&built).map_err(|error| Stop::unwritten("verilator", &built, &error))?;
            // Verilator has no unknown bits: what has no start value begins with random ones.
            let mut program = Command::new(built);
            program.args(["+verilator+rand+reset+2", "+verilator+seed+1"]);
            run(program.current_dir(directory), limit)
        }
    }
}

/// The year of the language's standard that the design needs.
fn standard(manifest: &Manifest) -> &'static str {
    let newer = manifest.dut.iter().flat_map(|dut| &dut.files).any(|file| file.ends_with(".sv"));
    if newer { "2012" } else { "2001" }
}

/// The design's files pass `verilator --lint-only -Wall`.
///
/// # Errors
/// A tool that is missing or exceeds the limit; its complaints are [`Stop::Broken`].
pub fn lint(directory: &Path, limit: Duration) -> Result<(), SimulateError> {
    let manifest = read(|name| std::fs::read(directory.join(name)))?.manifest;
    let mut command = Command::new("verilator");
    command.args(["--lint-only", "-Wall"]);
    match &manifest.dut {
        None => command.args(["--top-module", &manifest.module]).args(hdl(&manifest)),
        Some(dut) => {
            command.args(dut.include.iter().map(|folder| format!("-I{folder}")));
            command.args(dut.parameters.iter().map(|(name, value)| format!("-G{name}={value}")));
            command.args(["--top-module", &dut.top]).args(&dut.files)
        }
    };
    let text = run(command.current_dir(directory), limit)?;
    match text.trim().is_empty() {
        true => Ok(()),
        false => {
            Err(Stop::Broken { tool: "verilator -Wall".to_owned(), lines: first_lines(text.lines()) }.into())
        }
    }
}

/// The Verilog files of the design.
fn hdl(manifest: &Manifest) -> Vec<&str> {
    let names = manifest.files.iter().map(|file| file.name.as_str());
    names.filter(|name| name.starts_with("hdl/") && name.ends_with(".v")).collect()
}

/// The lines of the test bench among all that was printed, without their mark.
fn of_bench<'a>(manifest: &Manifest, text: &'a str) -> Vec<&'a str> {
    let mark = mark(&manifest.machine.hash) + " ";
    text.lines().filter_map(|line| Some(line.rsplit_once(&mark)?.1)).collect()
}

/// What the test bench found; `None` if it did not come to its end, or refused the ports of the design.
fn verdict(manifest: &Manifest, lines: &[&str]) -> Option<Outcome> {
    if lines.iter().any(|line| line.starts_with("FAIL: ports")) {
        return None;
    }
    let counts = lines.iter().find_map(|line| line.strip_prefix("checked "))?;
    let (checked, expected) = counts.split_once(" / ")?;
    let (checked, expected): (u64, u64) = (checked.trim().parse().ok()?, expected.trim().parse().ok()?);
    let passed = lines.contains(&"PASS") && checked == expected && expected == manifest.expected;
    let vacuous = checked == 0 || lines.contains(&"FAIL: nothing was compared");
    Some(match (vacuous, passed) {
        (true, _) => Outcome::Vacuous,
        (false, true) => Outcome::Pass { checked, met: met(lines) },
        (false, false) => {
            let beside = ["cycles ", "met "];
            let told = lines.iter().filter(|line| !beside.iter().any(|word| line.starts_with(word)));
            Outcome::Mismatch { checked, expected: manifest.expected, lines: first_lines(told.copied()) }
        }
    })
}

/// Lines `met EVENT COUNT`.
fn met(lines: &[&str]) -> BTreeMap<String, u64> {
    let counts = lines.iter().filter_map(|line| line.strip_prefix("met ")?.split_once(' '));
    counts.filter_map(|(event, count)| Some((event.to_owned(), count.trim().parse().ok()?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{StallKind, Suite, Tables, Unit, capture, directory};
    use edgewalk_machine::Plan;
    use edgewalk_model::DrawState;

    /// What a bench may print, and what is made of it: only all of what the manifest expects is a pass.
    #[test]
    fn only_all_that_was_expected_passes() {
        let suite = Suite::of_triangles("none", "", Vec::new());
        let trace = capture(&Plan::default(), Unit::MACHINE, &suite, DrawState::default(), StallKind::None);
        let files = directory(&suite, &trace, &[], Tables::LeftOut);
        let manifest: Manifest = serde_json::from_slice(&files[0].1).expect("a manifest");
        let manifest = Manifest { expected: 7, ..manifest };
        let judged = |text: &str| verdict(&manifest, &text.lines().collect::<Vec<_>>());
        let met = BTreeMap::from([("memory_stall".to_owned(), 12)]);
        let passed = "met memory_stall 12\nwrong 0\nchecked 7 / 7\nPASS\n";
        assert_eq!(judged(passed), Some(Outcome::Pass { checked: 7, met }));
        let mismatch = |checked| Some((checked, 7));
        for (text, wanted) in [
            ("checked 7 / 7\nFAIL\n", mismatch(7)),
            ("checked 7 / 7\n", mismatch(7)),
            ("checked 6 / 7\nPASS\n", mismatch(6)),
            ("checked 6 / 6\nPASS\n", mismatch(6)),
            ("checked 8 / 8\nPASS\n", mismatch(8)),
        ] {
            let found = match judged(text) {
                Some(Outcome::Mismatch { checked, expected, .. }) => Some((checked, expected)),
                _ => None,
            };
            assert_eq!(found, wanted, "{text}");
        }
        for text in
            ["checked 0 / 0\nPASS\n", "checked 0 / 7\nPASS\n", "checked 7 / 7\nFAIL: nothing was compared\n"]
        {
            assert_eq!(judged(text), Some(Outcome::Vacuous), "{text}");
        }
        for text in ["", "PASS\n", "checked all\nPASS\n", "checked 0 / 7\nFAIL: ports of another width\n"] {
            assert_eq!(judged(text), None, "{text}");
        }
    }
}
