//! `--machine FILE|PRESET` and `--set key=value`, the same for every command.

use anyhow::{Context, Result, anyhow, ensure};
use edgewalk_host::needs::Need;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::presets::PRESETS;
use edgewalk_machine::{Machine, MachineError, Plan, Unknown};
use edgewalk_scene::inputs;
use std::fmt;
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

    /// Refuses --machine and --set, which would count for nothing; `why` says of what.
    pub fn refuse(&self, why: &str) -> Result<()> {
        let asked = self.words();
        ensure!(asked.is_empty(), "{}: {why}; leave out --machine and --set", asked.join(" "));
        Ok(())
    }

    /// The machine `FILE|PRESET[,key=value...]`, with what --set says on top; screen and needs as in
    /// [`MachineArgs::adapted`].
    ///
    /// # Errors
    /// Those of [`MachineArgs::adapted`]; --machine beside it; a key that --set gives another value.
    pub fn named(&self, text: &str, size: Option<(u32, u32)>, needs: impl Needs) -> Result<Plan> {
        ensure!(
            self.machine == DEFAULT,
            "--machine {}: the command names its machines itself, as {text}; leave out --machine",
            self.machine
        );
        let mut words = text.split(',').map(str::trim);
        let machine = words.next().unwrap_or_default();
        let own: Vec<Setting> = words.map(|setting| Setting { option: "", setting }).collect();
        for (key, value) in own.iter().filter_map(Setting::parts) {
            let other = |of: &Setting| of.parts().is_some_and(|of| of.0 == key && differ(key, value, of.1));
            if let Some(setting) = self.settings().find(other) {
                return Err(anyhow!("{text}: {setting} gives {key} another value; leave one of the two out"));
            }
        }
        let settings: Vec<Setting> = own.into_iter().chain(self.settings()).collect();
        load(machine, Machine::from_toml)
            .and_then(|machine| adapted(&machine, size, needs, &settings))
            .with_context(|| text.to_owned())
    }

    /// The machine `FILE|PRESET[,key=value...]`, whatever --machine and --set say.
    pub fn alone(text: &str) -> Result<Plan> {
        MachineArgs { machine: DEFAULT.to_owned(), set: Vec::new() }.named(text, None, no_needs)
    }

    /// The machine asked for, with its screen replaced where the input brings its own size.
    pub fn machine(&self, size: Option<(u32, u32)>) -> Result<Plan> {
        self.adapted(size, no_needs)
    }

    /// As [`MachineArgs::machine`], and with the keys that the input asks for; --set has the last word.
    ///
    /// # Errors
    /// --set says of one of these keys what the input cannot be drawn with.
    pub fn adapted(&self, size: Option<(u32, u32)>, needs: impl Needs) -> Result<Plan> {
        let machine =
            load(&self.machine, Machine::from_toml).with_context(|| format!("--machine {}", self.machine))?;
        adapted(&machine, size, needs, &self.settings().collect::<Vec<_>>())
    }

    /// The keys asked for, which need not make a machine that can be built: a sweep sets others on top.
    ///
    /// # Errors
    /// No such file or preset, an unknown key, a value outside its domain.
    pub fn keys(&self) -> Result<Machine> {
        let machine =
            load(&self.machine, Machine::read).with_context(|| format!("--machine {}", self.machine))?;
        set(machine, None, &[], &self.settings().collect::<Vec<_>>())
    }

    fn settings(&self) -> impl Iterator<Item = Setting<'_>> {
        self.set.iter().map(|setting| Setting { option: "--set ", setting })
    }
}

/// `key=value`, and the option that it stands behind; it may also stand behind a machine's name.
struct Setting<'a> {
    option: &'static str,
    setting: &'a str,
}

impl Setting<'_> {
    /// Key and value; none without a `=`.
    fn parts(&self) -> Option<(&str, &str)> {
        self.setting.split_once('=').map(|(key, value)| (key.trim(), value.trim()))
    }
}

/// Whether two values of a key are not the same: `4` and `04` are. Which of them is none is said where it is set.
fn differ(key: &str, one: &str, other: &str) -> bool {
    let shown = |value: &str| {
        let mut machine = Machine::default();
        machine.set(key, value).ok()?;
        KEYS.iter().find(|known| known.name == key).map(|known| known.show(&machine))
    };
    matches!((shown(one), shown(other)), (Some(one), Some(other)) if one != other)
}

/// What the input asks of a machine.
pub trait Needs: FnMut(&Plan) -> Result<Vec<Need>> {}

impl<F: FnMut(&Plan) -> Result<Vec<Need>>> Needs for F {}

/// Asks for nothing: the machine stays as it is.
pub fn no_needs(_: &Plan) -> Result<Vec<Need>> {
    Ok(Vec::new())
}

impl fmt::Display for Setting<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.option, self.setting)
    }
}

/// The machine with its settings, and where the input asks for more, with that too.
fn adapted(
    machine: &Machine,
    size: Option<(u32, u32)>,
    mut needs: impl Needs,
    settings: &[Setting],
) -> Result<Plan> {
    let asked = built(machine.clone(), size, &[], settings)?;
    let wanted = needs(&asked)?;
    if wanted.is_empty() {
        return Ok(asked);
    }
    let plan = built(machine.clone(), size, &wanted, settings)?;
    for need in needs(&plan)? {
        let against = |setting: &&Setting| setting.parts().is_some_and(|(key, _)| key == need.key);
        if let Some(setting) = settings.iter().rfind(against) {
            return Err(anyhow!("{}; {setting} stands against --adapt: leave it out", need.why));
        }
    }
    Ok(plan)
}

/// The machine of a preset or file, with the screen of the input, what the input asks for, and then the settings.
fn built(machine: Machine, size: Option<(u32, u32)>, needs: &[Need], settings: &[Setting]) -> Result<Plan> {
    let machine = set(machine, size, needs, settings)?;
    machine.plan().map_err(|e| anyhow!("{}: {e}", asked_for(size, needs, settings)))
}

/// The same machine's keys, whether it can be built or not.
fn set(
    mut machine: Machine,
    size: Option<(u32, u32)>,
    needs: &[Need],
    settings: &[Setting],
) -> Result<Machine> {
    if let Some((width, height)) = size {
        machine.set("screen.width", &width.to_string()).map_err(|e| anyhow!("size: {e}"))?;
        machine.set("screen.height", &height.to_string()).map_err(|e| anyhow!("size: {e}"))?;
    }
    for Need { key, value, .. } in needs {
        machine.set(key, value).map_err(|e| anyhow!("--adapt: {key} = {value}: {e}"))?;
    }
    for setting in settings {
        let (key, value) = setting.parts().ok_or_else(|| {
            let found = if setting.option.is_empty() && setting.setting.is_empty() {
                "nothing stands behind a comma; ".to_owned()
            } else {
                format!("{setting}: ")
            };
            anyhow!("{found}write key=value, e.g. interpolator.adders=2")
        })?;
        // What stands behind a machine's name is named with it.
        let named = if setting.option.is_empty() { String::new() } else { format!("{setting}: ") };
        machine.set(key, value).map_err(|e| anyhow!("{named}{e}"))?;
    }
    Ok(machine)
}

/// All that makes the machine another than the one of the file or preset, which has been checked.
fn asked_for(size: Option<(u32, u32)>, needs: &[Need], settings: &[Setting]) -> String {
    let size = size.map(|(width, height)| format!("size {width} {height}"));
    let needs = needs.iter().map(|need| format!("--adapt: {} = {}", need.key, need.value));
    let settings = settings.iter().map(ToString::to_string);
    size.into_iter().chain(needs).chain(settings).collect::<Vec<_>>().join(", ")
}

/// The machine of a preset or file of that name; `read` takes the text of the file.
fn load(name: &str, read: fn(&str) -> Result<Machine, MachineError>) -> Result<Machine> {
    if let Some(machine) = Machine::preset(name) {
        return Ok(machine);
    }
    let path = Path::new(name);
    if !path.exists() && path.extension().is_none() {
        let unknown = Unknown::new("preset", name, PRESETS.iter().map(|p| p.0));
        return Err(anyhow!("no file; {unknown}"));
    }
    let mut text = String::new();
    File::open(path)?.take(MAX_LENGTH + 1).read_to_string(&mut text)?;
    inputs::note(path);
    ensure!(text.len() as u64 <= MAX_LENGTH, "permitted: at most {MAX_LENGTH} bytes");
    Ok(read(&text)?)
}
