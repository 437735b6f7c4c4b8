//! `edgewalk trace`: waveforms of the machine's netlist.

use crate::Talk;
use crate::document::document;
use crate::input::{Source, to_port};
use crate::machine_args::MachineArgs;
use crate::staging::Staging;
use crate::verdict::Verdict;
use anyhow::{Context, Result, anyhow};
use edgewalk_lockstep::StallKind;
use edgewalk_machine::Activity;
use edgewalk_netlist::{FstTrace, Labels, Simulator, VcdTrace};
use serde_json::json;
use std::fs::File;
use std::io::BufWriter;
use std::path::PathBuf;

/// Run the machine's netlist and write the waveform of every signal that can change, as VCD or FST.
///
/// The ending of the file chooses the format. `activity_name` holds the cause of each cycle in words: as text in a
/// VCD, as ASCII in an FST.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk trace sphere --out out/sphere.fst --triangles 20
  edgewalk trace triangles.tri --out out/t.vcd --cycles 5000 --set interpolator.adders=1")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Output file, .vcd or .fst
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Draw this many triangles of the input
    #[arg(long, default_value_t = 10)]
    triangles: usize,
    /// Stop after this many cycles
    #[arg(long, default_value_t = 20_000)]
    cycles: u64,
}

/// The outermost scope.
const TOP: &str = "edgewalk";

/// Either kind of waveform.
enum Wave {
    Vcd(VcdTrace<BufWriter<File>>),
    Fst(Box<FstTrace<BufWriter<File>>>),
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = args.source.machine(machine)?;
    let port = to_port(&args.source.frame(&machine)?, &machine)?;
    let traced = port.triangles.len().min(args.triangles);
    let size = (machine.width, machine.height);
    Verdict::drew(traced as u64).or_nothing(&args.source.input, 0, size)?;
    let kind = args.out.extension().and_then(|e| e.to_str()).unwrap_or_default();
    if !["vcd", "fst"].contains(&kind) {
        return Err(anyhow!("--out {}: the file must end in .vcd or .fst", args.out.display()));
    }
    let name = args.out.file_name().and_then(|n| n.to_str()).context("--out: no file name")?;
    let folder = args.out.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(".".as_ref());
    let out = Staging::new(folder)?;
    let mut file = Some(out.create(name)?);
    let mut wave: Option<Wave> = None;
    let mut failure: Result<()> = Ok(());
    let mut cycles = 0;
    let triangles = port.triangles.iter().take(args.triangles).copied();
    edgewalk_lockstep::render_rtl_with(&machine, triangles, port.state()?, StallKind::None, |sim| {
        failure = sample(&mut wave, &mut file, kind, sim);
        cycles += 1;
        failure.is_ok() && cycles < args.cycles
    })?;
    failure.with_context(|| out.name(name))?;
    match wave {
        Some(Wave::Vcd(w)) => w.finish().with_context(|| out.name(name))?,
        Some(Wave::Fst(w)) => w.finish().map_err(|e| anyhow!("{}: {e}", out.name(name)))?,
        None => {}
    }
    out.publish(&[name])?;
    talk.say(
        || document("trace", json!({ "file": args.out, "cycles": cycles, "hash": machine.hash() })),
        || format!("{cycles} cycles -> {}", args.out.display()),
    )?;
    Ok(Verdict::Pass)
}

/// Takes a sample; the first opens the file, as it needs the simulator's list of signals.
fn sample(
    wave: &mut Option<Wave>,
    file: &mut Option<BufWriter<File>>,
    kind: &str,
    sim: &mut Simulator,
) -> Result<()> {
    if let Some(file) = file.take() {
        let names = Activity::ALL.map(Activity::name);
        let labels = [Labels { signal: "activity", names: &names }];
        *wave = Some(match kind {
            "vcd" => Wave::Vcd(VcdTrace::new(file, sim, TOP, &labels)?),
            _ => Wave::Fst(Box::new(FstTrace::new(file, sim, TOP, &labels)?)),
        });
    }
    match wave {
        Some(Wave::Vcd(w)) => w.sample(sim)?,
        Some(Wave::Fst(w)) => w.sample(sim)?,
        None => {}
    }
    Ok(())
}
