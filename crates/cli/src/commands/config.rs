//! `edgewalk config`: print, check and explain a machine.

mod precision;

use crate::machine_args::MachineArgs;
use crate::talk;
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_host::extra::{self, OwnChannel};
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::nearest::nearest;
use edgewalk_machine::presets::PRESETS;
use edgewalk_machine::{Channel, Plan};
use precision::Precision;
use serde_json::json;
use std::fmt::Write as _;

/// Prints, checks or explains a machine: what its keys mean, which error of its outputs is proved, how many fraction bits its
/// screen needs.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk config print --machine textbook > my.toml
  edgewalk config check --machine my.toml --set interpolator.adders=1
  edgewalk config explain memory.hazard")]
pub struct Args {
    #[command(subcommand)]
    what: What,
}

#[derive(clap::Subcommand)]
enum What {
    /// The whole machine as a file, every key with its meaning
    Print,
    /// Says whether the machine can be built, or why not
    Check,
    /// What a key means, what it may be, and what follows from the machine
    Explain {
        /// A key, e.g. memory.hazard; all of them if left out
        key: Option<String>,
    },
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, json: bool) -> Result<Verdict> {
    let machine = machine.machine(None)?;
    let hash = machine.hash();
    talk::print(&match &args.what {
        What::Print => format!("# machine {hash}\n{}", machine.to_toml()),
        What::Check if json => json!({ "ok": true, "hash": hash }).to_string(),
        What::Check => format!("machine {hash} can be built"),
        What::Explain { key } => explain(&machine, key.as_deref(), json)?,
    })?;
    Ok(Verdict::Pass)
}

fn explain(machine: &Plan, key: Option<&str>, json: bool) -> Result<String> {
    let chosen: Vec<_> = KEYS.iter().filter(|k| key.is_none_or(|name| k.name == name)).collect();
    if chosen.is_empty() {
        let name = key.unwrap_or_default();
        return Err(anyhow!("unknown key {name}; nearest: {}", nearest(name, KEYS.iter().map(|k| k.name))));
    }
    if json {
        let list: Vec<_> = chosen
            .iter()
            .map(|k| json!({ "key": k.name, "value": k.show(machine), "permitted": k.permitted(), "doc": k.doc }))
            .collect();
        let all = key.is_none().then(|| Precision::of(machine));
        let own: Vec<_> = extra::channels(machine).iter().map(|c| OwnChannel::of(c, machine)).collect();
        let own = (key.is_none() && !own.is_empty()).then_some(own);
        let told = json!({ "keys": list, "precision": all, "channels": own });
        return Ok(serde_json::to_string_pretty(&told)?);
    }
    let mut text = String::new();
    for k in chosen {
        // Writing to a string cannot fail.
        _ = writeln!(
            text,
            "{} = {}\n    {}\n    permitted: {}",
            k.name,
            k.show(machine),
            k.doc,
            k.permitted()
        );
    }
    if key.is_none() {
        text += &consequences(machine);
    }
    Ok(text)
}

/// What follows from the keys, and the presets.
fn consequences(machine: &Plan) -> String {
    let w = machine.widths();
    let setup = edgewalk_model::longest_setup(machine);
    let word = |channel: Channel| format!("{}, {} bits, modular", channel.word_format(), channel.word());
    let mut text = format!(
        "\nwhat follows\n    \
         vertex x, y            Q{}.{} px\n    \
         z word                 {}\n    \
         colour words           {}\n    \
         address                {} bits: line {} bits, column {} bits\n    \
         pixel rate in a span   1/{} pixel a clock\n    \
         setup                  at most {} clocks a triangle\n",
        machine.guard_bits + 1,
        machine.subpixel_bits,
        word(machine.channels()[0]),
        word(machine.channels()[1]),
        w.address,
        w.y,
        w.x,
        machine.clocks_per_pixel(),
        setup.all()
    );
    text += &Precision::of(machine).text();
    for channel in extra::channels(machine) {
        let [name, proved] = [channel.name.to_owned(), OwnChannel::of(channel, machine).line()];
        _ = write!(text, "    {name:<6} words           {}\n    {proved}", word(*channel));
    }
    text += "\npresets\n";
    for (name, doc) in PRESETS {
        // Writing to a string cannot fail.
        _ = writeln!(text, "    {name:<22} {doc}");
    }
    text
}
