//! `edgewalk energy`: area, clock and energy of the machine in standard cells, while it draws the user's own frame.

use crate::Talk;
use crate::cell_energy::{CellEnergy, Drawing};
use crate::document::document;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::number::{real, whole};
use crate::progress;
use crate::verdict::Verdict;
use anyhow::Result;
use std::path::PathBuf;

/// Draw the input with the machine's gates, count every transition of every net, and compute area, clock and energy in standard
/// cells.
///
/// Yosys maps the Verilog onto the cells of OSU's library for 0.18 um, or of your own. OpenSTA computes the clock. The gates are
/// compared with the netlist in every cycle (docs/energy.md). There is no layout: wires and the tree of the clock cost nothing.
/// The memories outside the machine are not counted. The figures compare machines; they are no promise of a chip.
///
/// Tools: apt-get install yosys opensta qflow-tech-osu018.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk energy sphere
  edgewalk energy sphere --triangles 100 --set formats.z_fraction=6
  edgewalk energy mesh.obj --mhz 50 --json
  edgewalk energy sphere --triangles 100 --library cells.lib")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Draw this many triangles, polygons and lines, the first ones of the input; all of them if left out
    #[arg(long, value_name = "N", value_parser = whole::<u64>(1..))]
    triangles: Option<u64>,
    /// Stop after this many cycles
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = whole::<u64>(1..))]
    cycles: u64,
    /// Clock at which the power is told; the fastest that the gates permit if left out
    #[arg(long, value_name = "MHZ", value_parser = real(0.001..=100_000.0, "MHz"))]
    mhz: Option<f64>,
    /// Library of cells in the Liberty format, instead of OSU's for 0.18 um (docs/energy.md)
    #[arg(long, value_name = "FILE.lib")]
    library: Option<PathBuf>,
    /// Time limit of each run of a tool, seconds
    #[arg(long, default_value_t = 3600, value_name = "SECONDS", value_parser = whole::<u64>(1..))]
    limit: u64,
    /// Folder of the cache; $XDG_CACHE_HOME/edgewalk/synth or ~/.cache/edgewalk/synth if left out
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = args.source.machine(machine)?;
    let cells = CellEnergy::new(args.library.as_deref(), args.cache.as_deref(), args.limit)?;
    let first = args.triangles.map_or(usize::MAX, |most| usize::try_from(most).unwrap_or(usize::MAX));
    let port = args.source.to_port(&args.source.first(&machine, first)?, &machine)?;
    let tokens = port.triangles.len() as u64;
    Verdict::drew(tokens).or_nothing(&args.source.input, 0, (machine.width, machine.height))?;
    let bar = progress::bar(tokens, "tokens", talk.quiet);
    let drawing = Drawing { machine: &machine, port: &port, cycles: args.cycles };
    let report = cells.measure(&drawing, args.mhz, &|| bar.inc(1))?;
    bar.finish_and_clear();
    talk.say(|| document("energy", &report), || report.text())?;
    Ok(Verdict::Pass)
}
