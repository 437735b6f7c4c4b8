//! `edgewalk config`: print, check and explain a machine.

mod precision;
mod values;

use crate::Talk;
use crate::document::document;
use crate::machine_args::MachineArgs;
use crate::verdict::Verdict;
use anyhow::Result;
use edgewalk_host::extra::{self, OwnChannel};
use edgewalk_machine::key::{Domain, Key};
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::presets::PRESETS;
use edgewalk_machine::{Channel, Plan};
use precision::Precision;
use serde_json::{Map, Value, json};
use std::fmt::Write as _;

/// Print, check or explain a machine: its keys, the proved error of its outputs, the fraction bits that its screen
/// needs.
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
    /// Print the whole machine as a file, every key with its meaning
    Print,
    /// Check whether the machine can be built, and if not, tell why
    Check,
    /// Explain a key: meaning, permitted values, and what each value comes to in clocks, bounds and estimated cells
    Explain {
        /// A key, e.g. memory.hazard; without one all keys, what follows from them, and the presets
        key: Option<String>,
    },
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = machine.machine(None)?;
    let hash = machine.hash();
    // What is asked for is the output itself, so a quiet program prints it too.
    let talk = Talk { quiet: false, ..talk };
    match &args.what {
        What::Print => talk.say(
            || document("machine", json!({ "hash": hash, "keys": keys(&machine) })),
            || format!("# machine {hash}\n{}", machine.to_toml()),
        ),
        What::Check => talk.say(
            || document("check", json!({ "ok": true, "hash": hash })),
            || format!("machine {hash} can be built"),
        ),
        What::Explain { key } => explain(&machine, key.as_deref(), talk),
    }?;
    Ok(Verdict::Pass)
}

/// The keys that the machine uses, with their values: words or numbers.
fn keys(machine: &Plan) -> Map<String, Value> {
    let used = KEYS.iter().filter(|key| (key.used)(machine));
    let value = |key: &Key| match key.domain {
        Domain::Word(_) => json!(key.show(machine)),
        _ => json!((key.get)(machine)),
    };
    used.map(|key| (key.name.to_owned(), value(key))).collect()
}

fn explain(machine: &Plan, key: Option<&str>, talk: Talk) -> Result<()> {
    let chosen: Vec<&Key> = match key {
        Some(name) => vec![Key::named(name)?],
        None => KEYS.iter().collect(),
    };
    let json = || {
        let list: Vec<_> = chosen
            .iter()
            .map(|k| json!({ "key": k.name, "value": k.show(machine), "permitted": k.permitted(), "doc": k.doc }))
            .collect();
        let all = key.is_none().then(|| Precision::of(machine));
        let own: Vec<_> = extra::channels(machine).iter().map(|c| OwnChannel::of(c, machine)).collect();
        let own = (key.is_none() && !own.is_empty()).then_some(own);
        let values = key.and(chosen.first()).map(|key| values::consequences(machine, key));
        document("keys", json!({ "keys": list, "values": values, "precision": all, "channels": own }))
    };
    let text = || {
        let lines = chosen.iter().map(|k| {
            let [value, permitted] = [k.show(machine), k.permitted()];
            format!("{} = {value}\n    {}\n    permitted: {permitted}\n", k.name, k.doc)
        });
        let text: String = lines.collect();
        match (key, &chosen[..]) {
            (Some(_), [key]) => text + &values::text(&values::consequences(machine, key)),
            _ => text + &consequences(machine),
        }
    };
    talk.say(json, text)
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
