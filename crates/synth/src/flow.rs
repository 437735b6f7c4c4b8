//! The tools one after another, for a design on a device.

use crate::cache::{Cache, text, unreadable};
use crate::cells::{Cells, Statistics};
use crate::design::Design;
use crate::harness;
use crate::memories::place;
use crate::packed::{Packed, packed};
use crate::report::{Mhz, Outcome, Seed, UnitCells};
use crate::target::Target;
use crate::timing::{Timing, timing};
use edgewalk_tool::{Stop, run};
use rayon::prelude::*;
use serde::de::IgnoredAny;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// Files of a step.
const STATISTICS: &str = "stat.json";
const NETLIST: &str = "netlist.json";
const PACKED: &str = "packed.json";
const REPORT: &str = "report.json";

/// How designs go through the tools.
pub struct Flow<'f> {
    /// Where results are kept.
    pub cache: &'f Cache,
    /// For each run of a tool.
    pub limit: Duration,
    /// Seeds of nextpnr.
    pub seeds: &'f [u32],
    /// Count cells by unit too: a second synthesis.
    pub by_unit: bool,
    /// Told of each finished step.
    pub done: &'f (dyn Fn() + Sync),
}

/// A design on a device, and the versions of the tools.
struct Job<'j> {
    flow: &'j Flow<'j>,
    design: &'j Design,
    target: &'j Target,
    yosys: String,
}

impl Flow<'_> {
    /// Steps for a target, if all goes well.
    #[must_use]
    pub fn steps(&self) -> u64 {
        3 + self.seeds.len() as u64
    }

    /// All that the tools say of the design on the device. Steps that do not wait for each other run at once.
    #[must_use]
    pub fn run(&self, design: &Design, target: &Target) -> Outcome {
        let mut outcome = self.measured(design, target);
        let own = outcome.cells.map_or(0, |cells| cells.blocks());
        outcome.memories = place(design.memories.clone(), target.blocks, own);
        outcome
    }

    fn measured(&self, design: &Design, target: &Target) -> Outcome {
        let mut outcome = Outcome::unknown(target);
        match self.version(target.yosys, "-V") {
            Ok(version) => outcome.yosys = Some(version),
            Err(stop) => return Outcome { reasons: vec![stop.to_string()], stop: Some(stop), ..outcome },
        }
        let job = Job { flow: self, design, target, yosys: outcome.yosys.clone().unwrap_or_default() };
        let (flat, units) = rayon::join(|| job.flat(), || job.units());
        outcome.units = units.map_err(|stop| outcome.reasons.push(stop.to_string())).ok();
        match flat {
            Ok((cells, netlist)) => {
                outcome.cells = Some(cells);
                if let Err(stop) = job.place(&netlist, &mut outcome) {
                    outcome.reasons.push(stop.to_string());
                }
            }
            Err(stop) => {
                outcome.reasons.push(stop.to_string());
                outcome.stop = Some(stop);
            }
        }
        outcome
    }

    fn version(&self, tool: &str, option: &str) -> Result<String, Stop> {
        let printed = run(Command::new(tool).arg(option), self.limit)?;
        Ok(printed.lines().next().unwrap_or_default().trim().to_owned())
    }
}

impl Job<'_> {
    /// Flattened, and counted by itself; then the netlist of it in the harness, which is synthesised apart, so that the
    /// one changes nothing of the other.
    fn flat(&self) -> Result<(Cells, PathBuf), Stop> {
        let (module, synth, around) = (&self.design.module, self.target.synth, harness::MODULE);
        let script = format!(
            "{synth} -top {module}; tee -q -o {STATISTICS} stat -json; design -stash part; \
             read_verilog {module}.v {around}.v; blackbox {module}; {synth} -top {around}; delete ={module}; \
             design -copy-from part ={module}; hierarchy -check -top {around}; flatten; write_json {NETLIST}"
        );
        let (folder, statistics) = self.synthesis(&script, &[STATISTICS, NETLIST])?;
        Ok((statistics.module(module)?, folder.join(NETLIST)))
    }

    /// The cells of each unit, with nothing optimised over the borders of modules.
    fn units(&self) -> Result<Vec<UnitCells>, Stop> {
        if self.design.units.is_empty() || !self.flow.by_unit {
            (self.flow.done)();
            return Ok(Vec::new());
        }
        let (module, synth) = (&self.design.module, self.target.synth);
        let script = format!("{synth} -noflatten -top {module}; tee -q -o {STATISTICS} stat -json");
        let (_, statistics) = self.synthesis(&script, &[STATISTICS])?;
        let of = |(unit, module): &(String, String)| {
            Ok(UnitCells { unit: unit.clone(), cells: statistics.module(module)? })
        };
        let mut units = self.design.units.iter().map(of).collect::<Result<Vec<_>, Stop>>()?;
        units.push(UnitCells { unit: "joints".to_owned(), cells: statistics.own(module) });
        Ok(units)
    }

    /// A run of Yosys that leaves statistics, and a netlist where that is to be kept too.
    fn synthesis(&self, script: &str, keep: &[&str]) -> Result<(PathBuf, Statistics), Stop> {
        let Job { flow, design, target, .. } = self;
        let work = |folder: &Path| {
            for (name, verilog) in &design.files {
                std::fs::write(folder.join(name), verilog)
                    .map_err(|error| Stop::file(&folder.join(name), &error))?;
            }
            let script = format!("read_verilog {}; {script}", design.sources().collect::<Vec<_>>().join(" "));
            run(Command::new(target.yosys).args(["-q", "-p", &script]).current_dir(folder), flow.limit)
                .map(drop)
        };
        let found = flow.cache.step(&[&design.hash, &self.yosys, script], keep, work, |folder| {
            let unread = |file: &str, error| unreadable(target.yosys, file, error);
            if keep.contains(&NETLIST) {
                serde_json::from_str::<IgnoredAny>(&text(target.yosys, &folder.join(NETLIST))?)
                    .map_err(|error| unread(NETLIST, error))?;
            }
            Statistics::read(&text(target.yosys, &folder.join(STATISTICS))?)
                .map_err(|error| unread(STATISTICS, error))
        });
        (flow.done)();
        found
    }

    /// Packs, then places and routes with every seed.
    fn place(&self, netlist: &Path, outcome: &mut Outcome) -> Result<(), Stop> {
        let Job { flow, target, .. } = self;
        let nextpnr = flow.version(target.nextpnr, "--version")?;
        let packed = self.pack(netlist, &nextpnr)?;
        outcome.nextpnr = Some(nextpnr.clone());
        let lacks = packed.lacks.clone();
        outcome.packed = Some(packed);
        if let Some(lacks) = lacks {
            outcome.reasons.push(lacks);
            return Ok(());
        }
        let found: Vec<(u32, Result<Timing, Stop>)> = flow
            .seeds
            .par_iter()
            .with_max_len(1)
            .map(|seed| (*seed, self.seed(netlist, &nextpnr, *seed)))
            .collect();
        let mut timings = Vec::new();
        for (seed, timing) in found {
            outcome.seeds.push(Seed { seed, mhz: timing.as_ref().ok().map(|timing| timing.mhz) });
            match timing {
                Ok(timing) => timings.push(timing),
                Err(stop) => outcome.reasons.push(format!("seed {seed}: {stop}")),
            }
        }
        timings.sort_by(|a, b| a.mhz.total_cmp(&b.mhz));
        outcome.mhz = Mhz::of(&timings.iter().map(|timing| timing.mhz).collect::<Vec<_>>());
        let middle = timings.len().saturating_sub(1) / 2;
        outcome.critical_path = timings.into_iter().nth(middle).map(|timing| timing.path);
        Ok(())
    }

    fn pack(&self, netlist: &Path, version: &str) -> Result<Packed, Stop> {
        let Job { flow, target, .. } = self;
        let options = ["--pack-only", "--write", NETLIST, "--report", REPORT];
        let then = |folder: &Path| {
            let tool = target.nextpnr;
            let (written, report) = (text(tool, &folder.join(NETLIST))?, text(tool, &folder.join(REPORT))?);
            let packed = packed(target.packed, &written, &report)
                .map_err(|error| unreadable(tool, &format!("{NETLIST} or {REPORT}"), error))?;
            let said = |error: std::io::Error| Stop::file(&folder.join(PACKED), &error);
            let packed = serde_json::to_string(&packed).map_err(|error| said(error.into()))?;
            std::fs::write(folder.join(PACKED), packed).map_err(said)
        };
        let packed =
            self.placement(netlist, version, &options, PACKED, then, |json| serde_json::from_str(json));
        (flow.done)();
        packed
    }

    fn seed(&self, netlist: &Path, version: &str, seed: u32) -> Result<Timing, Stop> {
        let number = seed.to_string();
        let options = ["--seed", &number, "--timing-allow-fail", "--report", REPORT];
        let found = self.placement(netlist, version, &options, REPORT, |_| Ok(()), |json| timing(seed, json));
        (self.flow.done)();
        found?.ok_or_else(|| Stop::Broken {
            tool: self.target.nextpnr.to_owned(),
            lines: vec!["it tells of no path from register to register".to_owned()],
        })
    }

    /// A run of nextpnr, and what follows; of it one file is kept and read.
    fn placement<T>(
        &self,
        netlist: &Path,
        version: &str,
        options: &[&str],
        keep: &str,
        then: impl FnOnce(&Path) -> Result<(), Stop>,
        read: impl Fn(&str) -> serde_json::Result<T>,
    ) -> Result<T, Stop> {
        let Job { flow, design, target, yosys } = self;
        let mut key = vec![&*design.hash, yosys, target.name, target.synth, version];
        key.extend(target.options.iter().chain(options));
        let work = |folder: &Path| {
            // Beside the output: not every nextpnr sees the whole file system.
            const INPUT: &str = "input.json";
            std::fs::copy(netlist, folder.join(INPUT))
                .map_err(|error| Stop::file(&folder.join(INPUT), &error))?;
            let mut command = Command::new(target.nextpnr);
            command.args(["-q", "--json", INPUT]).args(target.options).args(options);
            run(command.current_dir(folder), flow.limit)?;
            then(folder)
        };
        let read = |folder: &Path| {
            read(&text(target.nextpnr, &folder.join(keep))?)
                .map_err(|error| unreadable(target.nextpnr, keep, error))
        };
        flow.cache.step(&key, &[keep], work, read).map(|(_, found)| found)
    }
}
