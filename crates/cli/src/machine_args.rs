//! `--machine FILE|PRESET` and `--set key=value`, the same for every command.

use anyhow::{Context, Result, anyhow};
use edgewalk_machine::nearest::nearest;
use edgewalk_machine::presets::PRESETS;
use edgewalk_machine::{Machine, Plan};
use std::path::Path;

/// Which machine.
#[derive(clap::Args, Clone, Debug)]
pub struct MachineArgs {
    /// A machine file (TOML) or the name of a preset: default, textbook
    #[arg(long, value_name = "FILE|PRESET", default_value = "default", global = true)]
    machine: String,
    /// Overrides one key, e.g. --set interpolator.adders=2 (repeatable; `edgewalk config` lists the keys)
    #[arg(long, value_name = "KEY=VALUE", global = true)]
    set: Vec<String>,
}

impl MachineArgs {
    /// The machine asked for, with its screen replaced where the input brings its own size.
    pub fn machine(&self, size: Option<(u32, u32)>) -> Result<Plan> {
        let mut machine = self.load()?;
        if let Some((width, height)) = size {
            machine.set("screen.width", &width.to_string()).map_err(|e| anyhow!("size: {e}"))?;
            machine.set("screen.height", &height.to_string()).map_err(|e| anyhow!("size: {e}"))?;
        }
        for setting in &self.set {
            let (key, value) = setting.split_once('=').ok_or_else(|| {
                anyhow!("--set {setting}: write key=value, e.g. --set interpolator.adders=2")
            })?;
            machine.set(key.trim(), value.trim()).map_err(|e| anyhow!("--set {setting}: {e}"))?;
        }
        machine.plan().map_err(|e| anyhow!("--machine {}: {e}", self.machine))
    }

    fn load(&self) -> Result<Machine> {
        if let Some(machine) = Machine::preset(&self.machine) {
            return Ok(machine);
        }
        let path = Path::new(&self.machine);
        if !path.exists() && path.extension().is_none() {
            let close = nearest(&self.machine, PRESETS.iter().map(|p| p.0));
            return Err(anyhow!(
                "--machine {}: neither a file nor a preset; nearest preset: {close}",
                self.machine
            ));
        }
        let text = std::fs::read_to_string(path).with_context(|| format!("--machine {}", self.machine))?;
        Machine::from_toml(&text).map_err(|e| anyhow!("{}: {e}", self.machine))
    }
}
