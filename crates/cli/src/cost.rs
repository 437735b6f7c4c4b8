//! Synthesis of one machine after another, for sweeps and comparisons.

use crate::number::whole;
use anyhow::{Context, Result, anyhow};
use edgewalk_explore::sweep::definition::Synthesis;
use edgewalk_explore::sweep::row::{Cost, Status};
use edgewalk_files::Scratch;
use edgewalk_machine::Plan;
use edgewalk_synth::{Cache, Design, Flow, Outcome, Part, Target};
use edgewalk_tool::Stop;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// `--synth` and what goes with it.
#[derive(clap::Args, Clone, Debug)]
pub struct SynthArgs {
    /// Synthesise every machine for a device: ice40-hx8k, ice40-up5k, ecp5-25
    #[arg(long, value_name = "TARGET")]
    synth: Option<String>,
    /// With --synth: machine, engine (all units but setup), or the name of a unit
    #[arg(long, value_name = "UNIT", default_value = "machine", requires = "synth")]
    synth_unit: String,
    /// With --synth: place and route with the seeds 1 to N
    #[arg(long, default_value_t = 3, value_name = "N", requires = "synth", value_parser = whole::<u32>(1..=1000))]
    synth_seeds: u32,
    #[command(flatten)]
    tools: ToolArgs,
}

/// How the tools of synthesis run, which changes no result.
#[derive(clap::Args, Clone, Debug)]
pub struct ToolArgs {
    /// Time limit of each run of a tool, seconds
    #[arg(long, default_value_t = 3600, value_name = "SECONDS", value_parser = whole::<u64>(1..))]
    limit: u64,
    /// Folder of the cache; that of `edgewalk synth` if left out
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
}

impl ToolArgs {
    /// Folder of the cache, where it is not the usual one.
    pub fn cache(&self) -> Option<&Path> {
        self.cache.as_deref()
    }

    /// Seconds of each run of a tool.
    pub fn limit(&self) -> u64 {
        self.limit
    }
}

impl SynthArgs {
    /// What is asked for, once it is known that there is such a device.
    pub fn asked(&self) -> Result<Option<Synthesis>> {
        let Some(name) = &self.synth else { return Ok(None) };
        Target::named(name).map_err(|e| anyhow!("--synth: {e}"))?;
        Ok(Some(Synthesis { target: name.clone(), unit: self.synth_unit.clone(), seeds: self.synth_seeds }))
    }

    /// What is asked for, once it is known that there is such a device, and that this machine has the unit.
    pub fn definition(&self, machine: &Plan) -> Result<Option<Synthesis>> {
        let asked = self.asked()?;
        asked.iter().try_for_each(|of| has_unit(&of.unit, machine))?;
        Ok(asked)
    }

    /// How the tools run.
    pub fn tools(&self) -> &ToolArgs {
        &self.tools
    }
}

/// Whether the machine has the unit of --synth-unit.
///
/// # Errors
/// It has not, or there is no such unit.
pub fn has_unit(unit: &str, machine: &Plan) -> Result<()> {
    Part::named(unit, machine).map(|_| ()).map_err(|e| anyhow!("--synth-unit {unit}: {e}"))
}

/// Synthesises machines, each once.
pub struct Synthesiser {
    target: Target,
    unit: String,
    seeds: Vec<u32>,
    limit: Duration,
    cache: Cache,
    _scratch: Scratch,
    /// By the machine's hash.
    known: Mutex<BTreeMap<String, Cost>>,
    /// The last failure of a tool.
    stopped: Mutex<Option<Stop>>,
}

impl Synthesiser {
    /// With the cache of the command line.
    pub fn new(of: &Synthesis, tools: &ToolArgs) -> Result<Self> {
        let folder = cache_folder(tools.cache.as_deref())?;
        let scratch = Scratch::within(&folder).with_context(|| format!("--cache {}", folder.display()))?;
        let cache = Cache::new(folder, scratch.path().to_owned());
        Ok(Synthesiser {
            target: Target::named(&of.target).map_err(|e| anyhow!("--synth: {e}"))?,
            unit: of.unit.clone(),
            seeds: (1..=of.seeds).collect(),
            limit: Duration::from_secs(tools.limit),
            cache,
            _scratch: scratch,
            known: Mutex::default(),
            stopped: Mutex::default(),
        })
    }

    /// Checks that the tools of synthesis are there.
    pub fn check(&self) -> Result<()> {
        for tool in self.target.tools() {
            edgewalk_tool::run(std::process::Command::new(tool).arg("--version"), self.limit)?;
        }
        Ok(())
    }

    /// Checks that one machine at least has cells.
    ///
    /// # Errors
    /// What stopped the tools where none has.
    pub fn check_any(&self) -> Result<()> {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let stopped = self.stopped.lock().unwrap_or_else(PoisonError::into_inner);
        match &*stopped {
            Some(stop) if known.values().all(Cost::is_err) => Err(stop.clone().into()),
            _ => Ok(()),
        }
    }

    /// Cells, clock and critical path; what the device or the tools do not give is null, with the reason.
    pub fn cost(&self, machine: &Plan) -> Cost {
        let hash = machine.hash();
        if let Some(known) = self.known.lock().unwrap_or_else(PoisonError::into_inner).get(&hash) {
            return known.clone();
        }
        let cost = self.synthesised(machine);
        self.known.lock().unwrap_or_else(PoisonError::into_inner).insert(hash, cost.clone());
        cost
    }

    fn synthesised(&self, machine: &Plan) -> Cost {
        let failed = |why: String| (Status::Failed, why);
        let part = Part::named(&self.unit, machine).map_err(|e| failed(e.to_string()))?;
        let design =
            Design::new(machine, part).map_err(|e| failed(format!("the netlist cannot be built: {e}")))?;
        let flow =
            Flow { cache: &self.cache, limit: self.limit, seeds: &self.seeds, by_unit: true, done: &|| {} };
        let outcome = flow.run(&design, &self.target);
        if let Some(stop) = &outcome.stop {
            *self.stopped.lock().unwrap_or_else(PoisonError::into_inner) = Some(stop.clone());
        }
        match &outcome.stop {
            Some(stop @ Stop::TimeLimit { .. }) => Err((Status::Timeout, stop.to_string())),
            Some(stop) => Err(failed(stop.to_string())),
            None => self.value(&outcome, &design).map_err(|e| failed(e.to_string())),
        }
    }

    fn value(&self, outcome: &Outcome, design: &Design) -> Result<Value, serde_json::Error> {
        let mut value = serde_json::to_value(outcome)?;
        value["unit"] = self.unit.clone().into();
        value["design"] = design.hash.clone().into();
        Ok(value)
    }
}

/// Where results of the tools are kept: in the folder asked for, or where the system keeps such things.
pub fn cache_folder(asked: Option<&Path>) -> Result<PathBuf> {
    let variable = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let usual = || variable("XDG_CACHE_HOME").or_else(|| Some(variable("HOME")?.join(".cache")));
    let own = |folder: PathBuf| folder.join("edgewalk").join("synth");
    asked.map(Path::to_owned).or_else(|| usual().map(own)).ok_or_else(|| {
        anyhow!("neither XDG_CACHE_HOME nor HOME is set, so results have no folder; add --cache DIR")
    })
}
