//! `edgewalk emit`: the machine as Verilog.

use crate::document::document;
use crate::machine_args::MachineArgs;
use crate::staging::Staging;
use crate::verdict::Verdict;
use crate::{Talk, staging};
use anyhow::{Result, anyhow};
use serde_json::json;
use std::path::PathBuf;

/// Writes the machine as readable, synthesizable Verilog-2001, a module a file, with a list of them in compile order.
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

/// The files that `write_design` may write under `folder`: of the lanes of SETUP a machine has 1, 2 or 4.
pub fn own(folder: &str) -> Vec<String> {
    (0..4).map(|lane| format!("{folder}edgewalk_setup_lane{lane}.v")).collect()
}

/// Prints every module of the machine under `folder` of `out`, with the machine file and the list of modules in compile
/// order, which is returned too.
pub fn write_design(
    machine: &edgewalk_machine::Plan,
    out: &staging::Staging,
    folder: &str,
) -> Result<Vec<String>> {
    let design = edgewalk_rtl::machine(machine).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    let (stamp, mut names) = (machine.stamp("//"), Vec::new());
    for (name, text) in edgewalk_verilog::print(&design) {
        out.write(&format!("{folder}{name}"), format!("{stamp}\n{text}"))?;
        names.push(name);
    }
    out.write(&format!("{folder}filelist.f"), format!("{stamp}{}\n", names.join("\n")))?;
    out.write(&format!("{folder}machine.toml"), machine.stamp("#") + "\n" + &machine.to_toml())?;
    Ok(names)
}
