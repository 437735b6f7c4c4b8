//! `--machine FILE|PRESET` and `--set key=value`, the same for every command.

use anyhow::{Context, Result, anyhow};
use edgewalk_host::needs::Need;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::presets::PRESETS;
use edgewalk_machine::{Machine, Plan, Unknown};
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// Bytes of the longest machine file; all keys with their comments take two thousand.
const MAX_LENGTH: u64 = 1 << 20;

/// The machine where none is asked for.
const DEFAULT: &str = "default";

/// Which machine.
#[derive(clap::Args, Clone, Debug)]
pub struct MachineArgs {
    #[arg(long, value_name = "FILE|PRESET", default_value = DEFAULT, global = true, help = machine_help())]
    machine: String,
    /// Override one key, e.g. --set interpolator.adders=2 (repeatable; `edgewalk config print` lists the keys)
    #[arg(long, value_name = "KEY=VALUE", global = true)]
    set: Vec<String>,
}

fn machine_help() -> String {
    let names: Vec<&str> = PRESETS.iter().map(|preset| preset.0).collect();
    format!("A machine file (TOML) or the name of a preset: {}", names.join(", "))
}

impl MachineArgs {
    /// The words of a command line that ask for the same machine.
    pub fn words(&self) -> Vec<&str> {
        let machine = Some(["--machine", &self.machine]).filter(|_| self.machine != DEFAULT);
        let set = self.set.iter().map(|setting| ["--set", setting]);
        machine.into_iter().chain(set).flatten().collect()
    }

    /// The words of a command line that ask for this machine: the preset that it differs least from, and the other keys.
    pub fn words_for(machine: &Machine) -> Vec<String> {
        let set = |preset: &str| -> Vec<String> {
            let of = Machine::preset(preset).unwrap_or_default();
            let others = KEYS.iter().filter(|key| key.show(&of) != key.show(machine));
            others.map(|key| format!("{}={}", key.name, key.show(machine))).collect()
        };
        let presets = PRESETS.iter().map(|preset| (preset.0, set(preset.0)));
        let (machine, set) = presets.min_by_key(|(_, set)| set.len()).unwrap_or((DEFAULT, Vec::new()));
        let asked = MachineArgs { machine: machine.to_owned(), set };
        asked.words().into_iter().map(str::to_owned).collect()
    }

    /// The machine `FILE|PRESET[,key=value...]`, with what --set says on top; screen and needs as in
    /// [`MachineArgs::adapted`].
    pub fn named(&self, text: &str, size: Option<(u32, u32)>, needs: &[Need]) -> Result<Plan> {
        let mut words = text.split(',').map(str::trim);
        let machine = words.next().unwrap_or_default().to_owned();
        let set = words.map(str::to_owned).chain(self.set.iter().cloned()).collect();
        MachineArgs { machine, set }.adapted(size, needs).with_context(|| text.to_owned())
    }

    /// The machine `FILE|PRESET[,key=value...]`, whatever --machine and --set say.
    pub fn alone(text: &str) -> Result<Plan> {
        MachineArgs { machine: DEFAULT.to_owned(), set: Vec::new() }.named(text, None, &[])
    }

    /// The machine asked for, with its screen replaced where the input brings its own size.
    pub fn machine(&self, size: Option<(u32, u32)>) -> Result<Plan> {
        self.adapted(size, &[])
    }

    /// As [`MachineArgs::machine`], and with the keys that the input asks for; --set has the last word.
    pub fn adapted(&self, size: Option<(u32, u32)>, needs: &[Need]) -> Result<Plan> {
        let mut machine = self.load()?;
        if let Some((width, height)) = size {
            machine.set("screen.width", &width.to_string()).map_err(|e| anyhow!("size: {e}"))?;
            machine.set("screen.height", &height.to_string()).map_err(|e| anyhow!("size: {e}"))?;
        }
        for Need { key, value, .. } in needs {
            machine.set(key, value).map_err(|e| anyhow!("--adapt: {key} = {value}: {e}"))?;
        }
        for setting in &self.set {
            let (key, value) = setting.split_once('=').ok_or_else(|| {
                anyhow!("--set {setting}: write key=value, e.g. --set interpolator.adders=2")
            })?;
            machine.set(key.trim(), value.trim()).map_err(|e| anyhow!("--set {setting}: {e}"))?;
        }
        machine.plan().map_err(|e| anyhow!("{}: {e}", self.asked_for(size, needs)))
    }

    /// All that makes the machine another than the one of the file or preset, which has been checked.
    fn asked_for(&self, size: Option<(u32, u32)>, needs: &[Need]) -> String {
        let size = size.map(|(width, height)| format!("size {width} {height}"));
        let needs = needs.iter().map(|need| format!("--adapt: {} = {}", need.key, need.value));
        let settings = self.set.iter().map(|setting| format!("--set {setting}"));
        size.into_iter().chain(needs).chain(settings).collect::<Vec<_>>().join(", ")
    }

    fn load(&self) -> Result<Machine> {
        if let Some(machine) = Machine::preset(&self.machine) {
            return Ok(machine);
        }
        let path = Path::new(&self.machine);
        if !path.exists() && path.extension().is_none() {
            let unknown = Unknown::new("preset", &self.machine, PRESETS.iter().map(|p| p.0));
            return Err(anyhow!("--machine {}: no file; {unknown}", self.machine));
        }
        let named = || format!("--machine {}", self.machine);
        let mut text = String::new();
        let file = File::open(path).with_context(named)?;
        file.take(MAX_LENGTH + 1).read_to_string(&mut text).with_context(named)?;
        if text.len() as u64 > MAX_LENGTH {
            return Err(anyhow!("{}: permitted: at most {MAX_LENGTH} bytes", named()));
        }
        Machine::from_toml(&text).map_err(|e| anyhow!("{}: {e}", self.machine))
    }
}
