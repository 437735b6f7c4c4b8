//! `edgewalk emit`: the machine as Verilog.

use crate::Talk;
use crate::design::{own, write_design};
use crate::document::document;
use crate::machine_args::MachineArgs;
use crate::verdict::Verdict;
use anyhow::Result;
use edgewalk_files::Staging;
use serde_json::json;
use std::path::PathBuf;

/// Write the machine as readable, synthesizable Verilog-2001: a file for each module, and filelist.f in compile
/// order.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk emit --out hdl/mine --set interpolator.adders=1
  edgewalk emit --machine textbook --out hdl/textbook
  cd hdl/mine && iverilog -g2001 -s edgewalk -c filelist.f -o edgewalk.vvp")]
pub struct Args {
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/hdl")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = machine.machine(None)?;
    let out = Staging::new(&args.out)?;
    let files = write_design(&machine, &out, "")?;
    out.publish(&own(""))?;
    talk.say(
        || document("emit", json!({ "hash": machine.hash(), "files": files })),
        || format!("machine {} -> {}\n    {}", machine.hash(), args.out.display(), files.join("\n    ")),
    )?;
    Ok(Verdict::Pass)
}
