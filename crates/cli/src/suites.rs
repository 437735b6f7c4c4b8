//! Suites of vectors: those of a machine, that of an input, and their directories.

use crate::input::PortFrame;
use crate::{Talk, jobs, progress};
use anyhow::{Result, anyhow, ensure};
use edgewalk_files::Staging;
use edgewalk_machine::{Plan, nearest};
use edgewalk_scene::InputKind;
use edgewalk_vectors::suites::input::Sent;
use edgewalk_vectors::{
    Files, Reached, SUITES, StallKind, Suite, Tables, Unit, capture_watched, design, directory,
    directory_for, dut::Wiring, not_covered, reached,
};
use std::path::{Component, Path};

/// Reads `--stalls`.
pub fn stalls(name: &str) -> Result<StallKind, String> {
    let names = StallKind::ALL.map(StallKind::name);
    StallKind::ALL
        .into_iter()
        .find(|kind| kind.name() == name)
        .ok_or_else(|| format!("one of {}", names.join(", ")))
}

/// Refuses a unit that the machine has not.
pub fn check_unit(machine: &Plan, unit: Unit) -> Result<()> {
    let names: Vec<&str> = Unit::all(machine).iter().map(|unit| unit.name()).collect();
    ensure!(
        names.contains(&unit.name()),
        "--unit {}: the machine has no such unit; permitted: {}; or set the keys that give it this unit",
        unit.name(),
        names.join(", ")
    );
    Ok(())
}

/// The triangles of an input as a suite with its depth function; `triangles` of them, spread over it evenly.
pub fn of_input(input: &str, machine: &Plan, port: &PortFrame, triangles: Option<u64>) -> Result<Suite> {
    let name = if input == InputKind::STANDARD_INPUT { "stdin" } else { input };
    let map = port.passes.first().and_then(|pass| port.lights.get(pass.map?));
    let sent = Sent {
        triangles: &port.triangles,
        ids: &port.ids,
        state: port.one_state()?,
        map: map.map(|map| map.words.as_slice()),
        shading: port.words(),
    };
    Ok(Suite { about: input.to_owned(), ..Suite::of_input(machine, name, &sent, triangles)? })
}

/// The suites that meet every corner on purpose.
pub fn directed(machine: &Plan) -> Result<Vec<Suite>> {
    named(machine, |name| ["hazards", "corners"].contains(&name))
}

/// The suites of the depth functions, and those of BLEND, SHADOW and SHADE where they are.
pub fn functions(machine: &Plan) -> Result<Vec<Suite>> {
    named(machine, |name| {
        ["depth_", "blend_", "color_", "light", "shade"].iter().any(|kind| name.starts_with(kind))
    })
}

fn named(machine: &Plan, wanted: impl Fn(&str) -> bool) -> Result<Vec<Suite>> {
    let listed = SUITES.iter().filter(|suite| suite.is_for(machine));
    let names = listed.map(|suite| suite.name).filter(|name| wanted(name));
    names.map(|name| Ok(Suite::named(machine, name, 1, 0)?)).collect()
}

/// Of these suites the cases of these names; all, if none is named. A suite without such a case is left out.
pub fn only(suites: Vec<Suite>, names: &[String]) -> Result<Vec<Suite>> {
    if names.is_empty() {
        return Ok(suites);
    }
    // Suites of the depth functions have the same cases.
    let mut known: Vec<&str> = Vec::new();
    for case in suites.iter().flat_map(|suite| &suite.cases) {
        if !known.contains(&case.name.as_str()) {
            known.push(&case.name);
        }
    }
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        let near = nearest(name, known.iter().copied()).map(|near| format!("; nearest: {near}"));
        let near = near.unwrap_or_default();
        return Err(anyhow!("--only: unknown case {name}{near}; permitted: {}", known.join(", ")));
    }
    let suites = suites.into_iter().map(|suite| suite.only(names));
    Ok(suites.filter(|suite| !suite.cases.is_empty()).collect())
}

/// Prints what could be met in each unit and was not.
pub fn warn_of_gaps(runs: &[(Unit, Reached)], talk: Talk) {
    for unit in Unit::known().filter(|_| !talk.quiet) {
        let missing = not_covered(runs.iter().filter(|(of, _)| *of == unit).map(|(_, reached)| reached));
        if !missing.is_empty() {
            talk.warn(&format!("{}: not covered: {}", unit.name(), missing.join(", ")));
        }
    }
}

/// The files in these directories of an earlier run, as their own manifests list them.
pub fn own(out: &Path, folder: &str, directories: &[String]) -> Vec<String> {
    let mut own = Vec::new();
    for directory in directories {
        let manifest = std::fs::read(out.join(folder).join(directory).join("manifest.json"));
        // A manifest that is not there, or is not ours, lists nothing.
        let manifest: Option<serde_json::Value> =
            manifest.ok().and_then(|text| serde_json::from_slice(&text).ok());
        let files = manifest.as_ref().and_then(|manifest| manifest["files"].as_array());
        let names = files.into_iter().flatten().filter_map(|file| file["name"].as_str());
        let within =
            |name: &&str| Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        own.extend(names.filter(within).map(|name| format!("{folder}{directory}/{name}")));
    }
    own
}

/// Directories to be written: one for each suite and unit it is for.
pub struct Set<'a> {
    /// The stimuli.
    pub suites: &'a [Suite],
    /// Of which units.
    pub units: &'a [Unit],
    /// Other stalls than each suite's own.
    pub stalls: Option<StallKind>,
    /// With tables or without.
    pub tables: Tables,
    /// The design that the benches are for; ours if there is none.
    pub own: Option<&'a Wiring>,
}

/// What the progress bar counts.
const WHAT: &str = "vector directories";

/// From so many bytes on a directory is announced before it is written.
const HUGE: usize = 64 << 20;

impl Set<'_> {
    /// Writes them under `folder` of `out`; returns their names.
    pub fn write(&self, machine: &Plan, out: &Staging, folder: &str, talk: Talk) -> Result<Vec<String>> {
        let mut work: Vec<(&Suite, Unit)> = Vec::new();
        for suite in self.suites {
            let of_it: Vec<Unit> = self.units.iter().copied().filter(|unit| suite.is_for(*unit)).collect();
            if of_it.is_empty() {
                let names: Vec<&str> = suite.units.iter().map(|unit| unit.name()).collect();
                return Err(anyhow!(
                    "--suite {}: it is for the units {} only; leave it out, or take one of these units",
                    suite.name,
                    names.join(", ")
                ));
            }
            work.extend(of_it.into_iter().map(|unit| (suite, unit)));
        }
        let bar = progress::bar(work.len() as u64, WHAT, talk.quiet);
        let written = jobs::all(&work, &bar, |(suite, unit)| {
            let name = format!("{}_{}", suite.name, unit.name());
            let stalls = self.stalls.unwrap_or(suite.stalls);
            let trace = capture_watched(machine, *unit, suite, suite.state, stalls, &|entered, of| {
                bar.set_message(format!("{WHAT}; {name}: {entered} of {of} tokens have entered"));
            });
            let files = match self.own {
                Some(wiring) => directory_for(suite, &trace, wiring, self.tables),
                None => {
                    let verilog = design::verilog(machine, *unit)
                        .map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
                    directory(suite, &trace, &verilog, self.tables)
                }
            };
            if !talk.quiet {
                bar.suspend(|| announce(&name, &files, talk));
            }
            for (file, contents) in files {
                if contents.len() >= HUGE / 16 {
                    bar.set_message(format!("{WHAT}; {name}/{file}: writing {} MB", contents.len() >> 20));
                }
                out.write(&format!("{folder}{name}/{file}"), contents)?;
            }
            bar.set_message(WHAT);
            Ok((name, (*unit, reached(&trace))))
        })?;
        bar.finish_and_clear();
        let (names, runs): (Vec<String>, Vec<_>) = written.into_iter().unzip();
        warn_of_gaps(&runs, talk);
        Ok(names)
    }
}

/// Says how much is about to be written where it is very much.
fn announce(name: &str, files: &Files, talk: Talk) {
    let size = |of: fn(&str) -> bool| {
        files.iter().filter(|(n, _)| of(n)).map(|(_, bytes)| bytes.len()).sum::<usize>()
    };
    let (all, tables) = (size(|_| true), size(|n| n.ends_with(".csv")));
    if all >= HUGE {
        let hint = if tables > 0 {
            format!(", {} MB of them tables (--no-csv leaves them out)", tables >> 20)
        } else {
            String::new()
        };
        talk.warn(&format!("{name}: writing {} MB{hint}", all >> 20));
    }
}
