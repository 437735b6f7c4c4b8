//! `edgewalk trace`: waveforms of the machine's netlist, and counts of its transitions.

mod views;

use crate::Talk;
use crate::document::document;
use crate::input::{PortFrame, Source};
use crate::kept;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::suites::of_input;
use crate::verdict::Verdict;
use anyhow::{Context, Result, anyhow, ensure};
use edgewalk_files::Staging;
use edgewalk_lockstep::StallKind;
use edgewalk_machine::counted::number;
use edgewalk_machine::{Activity, Counted, Pass, Plan, wholes};
use edgewalk_netlist::{FstTrace, Labels, Simulator, Transitions, UnitTransitions, VcdTrace};
use edgewalk_vectors::{Runs, Unit};
use serde_json::json;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufWriter;
use std::ops::Range;
use std::path::PathBuf;
use views::Views;

/// Run the machine's netlist and write the waveform or the transitions of every signal that can change.
///
/// The ending of the file chooses the format: VCD and FST are waveforms, SAIF counts transitions. `activity_name` holds the
/// cause of each cycle in words: as text in a VCD, as ASCII in an FST. With SAIF the sums by unit are printed. A named signal
/// counts once, for the unit that drives it. The machine's inputs count for `top`.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk trace sphere --out out/sphere.fst --triangles 20
  edgewalk trace triangles.tri --out out/t.vcd --cycles 5000 --set interpolator.adders=1
  edgewalk trace sphere --out out/sphere.saif --triangles 100 --cycles 100000
  edgewalk trace sphere --out out/t.vcd --from 1000 --to 1500
  edgewalk trace sphere --out out/t.vcd --triangles 100 --pixel 320 200
  edgewalk trace sphere --out out/t.vcd --triangles 100 --triangle 57
  edgewalk trace sphere --out out/t.fst --views
  gtkwave out/t.fst out/t.gtkw
  surfer --command-file out/t.sucl out/t.fst")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Output file, .vcd, .fst or .saif
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Draw this many triangles, polygons and lines, the first ones of the input
    #[arg(long, default_value_t = 10, value_parser = whole::<u64>(1..))]
    triangles: u64,
    /// Stop after this many cycles of waveform
    #[arg(long, default_value_t = 20_000, value_parser = whole::<u64>(1..))]
    cycles: u64,
    /// First cycle of the waveform; times are those of the whole run
    #[arg(long, value_name = "CYCLE", conflicts_with_all = ["pixel", "triangle"], value_parser = whole::<u64>(..))]
    from: Option<u64>,
    /// Last cycle of the waveform
    #[arg(long, value_name = "CYCLE", conflicts_with_all = ["pixel", "triangle"], value_parser = whole::<u64>(..))]
    to: Option<u64>,
    /// The writes of this pixel, with 40 cycles before the first of them
    #[arg(long, num_args = 2, value_names = ["X", "Y"], conflicts_with = "triangle", value_parser = whole::<u32>(..))]
    pixel: Option<Vec<u32>>,
    /// Write save files beside the waveform, with the ports in groups and a format for each: .gtkw for GTKWave, .sucl
    /// for Surfer
    #[arg(long)]
    views: bool,
    /// The cycles from the entry of this triangle, polygon or line to its last write; 0 is the first one
    #[arg(long, value_name = "N", value_parser = whole::<u32>(..))]
    triangle: Option<u32>,
}

/// The outermost scope.
const TOP: &str = "edgewalk";

/// The endings of the output file.
const KINDS: [&str; 3] = ["vcd", "fst", "saif"];

/// A file being written.
enum Wave {
    Vcd(VcdTrace<'static>),
    Fst(Box<FstTrace<BufWriter<File>>>),
    Saif(Box<Transitions>, BufWriter<File>),
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = args.source.machine(machine)?;
    let frame = args.source.first(&machine, usize::try_from(args.triangles).unwrap_or(usize::MAX))?;
    let port = args.source.to_port(&frame, &machine)?;
    let size = (machine.width, machine.height);
    Verdict::drew(port.triangles.len() as u64).or_nothing(&args.source.input, 0, size)?;
    let kind = args.out.extension().and_then(|e| e.to_str()).unwrap_or_default();
    if !KINDS.contains(&kind) {
        return Err(anyhow!("--out {}: the file must end in .vcd, .fst or .saif", args.out.display()));
    }
    ensure!(
        !args.views || kind != "saif",
        "--views --out {}: a SAIF has no waveform; permitted with .vcd and .fst",
        args.out.display()
    );
    let name = kept::name_of(&args.out)?;
    let folder = args.out.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(".".as_ref());
    let window = window(args, &machine, &port)?;
    let out = Staging::new(folder)?;
    let mut file = Some(out.create(name)?);
    let mut wave: Option<Wave> = None;
    let mut failure: Result<()> = Ok(());
    let mut there = BTreeSet::new();
    let mut cycle = 0;
    let triangles = port.triangles.iter().copied();
    let passes = [Pass { triangles: port.triangles.len(), ..Pass::all(port.state()?) }];
    edgewalk_lockstep::render_rtl_with(&machine, triangles, &passes, port.words(), |sim| {
        if cycle == 0 && args.views {
            let changing = sim.signals().filter(|(_, signal)| !sim.is_constant(*signal));
            there = changing.map(|(path, _)| path.to_owned()).collect();
        }
        failure = sample(&mut wave, &mut file, kind, sim, window.contains(&cycle));
        cycle += 1;
        failure.is_ok() && cycle < window.end
    })?;
    let cycles = cycle.saturating_sub(window.start);
    ensure!(
        cycles > 0,
        "--from {}: the run ends after {cycle} cycles; permitted: 0 to {}",
        window.start,
        cycle - 1
    );
    failure.with_context(|| out.name(name))?;
    let mut units = None;
    match wave {
        Some(Wave::Vcd(w)) => w.finish().with_context(|| out.name(name))?,
        Some(Wave::Fst(w)) => w.finish().map_err(|e| anyhow!("{}: {e}", out.name(name)))?,
        Some(Wave::Saif(counted, mut file)) => {
            counted.write_saif(&mut file).with_context(|| out.name(name))?;
            units = Some(counted.units());
        }
        None => {}
    }
    let mut written = vec![name.to_owned()];
    if args.views {
        let views = Views::new(&machine, TOP, &there, kind == "fst");
        let stem = name.strip_suffix(kind).unwrap_or(name);
        for (ending, text) in [("gtkw", views.gtkwave(&machine)), ("sucl", views.surfer(&machine))] {
            let name = format!("{stem}{ending}");
            out.write(&name, text)?;
            written.push(name);
        }
    }
    out.publish(&written)?;
    talk.say(
        || document("trace", report(args, cycles, machine.hash(), units.as_deref())),
        || {
            let table = units.as_deref().map(|units| table(units, cycles)).unwrap_or_default();
            let views = if args.views { "; views: .gtkw, .sucl" } else { "" };
            format!("{table}{} -> {}{views}", number(cycles, "cycle"), args.out.display())
        },
    )?;
    Ok(Verdict::Pass)
}

/// The run as JSON; `units` if transitions were counted.
fn report(
    args: &Args,
    cycles: u64,
    hash: impl serde::Serialize,
    units: Option<&[UnitTransitions]>,
) -> serde_json::Value {
    let mut report = json!({ "file": args.out, "cycles": cycles, "hash": hash });
    if let Some(units) = units {
        let unit = |u: &UnitTransitions| json!({ "unit": unit_name(u), "bits": u.bits, "transitions": u.transitions });
        report["units"] = units.iter().map(unit).collect();
    }
    report
}

/// The instance's name in the Verilog without `u_`; the top module has none.
fn unit_name(unit: &UnitTransitions) -> &str {
    match unit.unit.as_str() {
        "" => "top",
        name => name.strip_prefix("u_").unwrap_or(name),
    }
}

/// Transitions by unit: the sum, its share of all, and the mean of a cycle.
fn table(units: &[UnitTransitions], cycles: u64) -> String {
    let all: u64 = units.iter().map(|unit| unit.transitions).sum();
    let line = |unit: &UnitTransitions| {
        let (bits, count) = (unit.bits, unit.transitions);
        let share = 100.0 * count as f64 / all.max(1) as f64;
        let mean = count as f64 / cycles.max(1) as f64;
        format!("{:<10}{bits:>8}{count:>14}{share:>7.1} %{mean:>12.2}\n", unit_name(unit))
    };
    let head = format!("{:<10}{:>8}{:>14}{:>9}{:>12}\n", "unit", "bits", "transitions", "share", "a cycle");
    units.iter().fold(head, |text, unit| text + &line(unit))
}

/// Cycles shown before the first write of a pixel.
const BEFORE: u64 = 40;

/// The cycles to be written.
fn window(args: &Args, machine: &Plan, port: &PortFrame) -> Result<Range<u64>> {
    let cycles = |from: u64, behind: u64| from..behind.min(from.saturating_add(args.cycles));
    if args.pixel.is_none() && args.triangle.is_none() {
        let (from, to) = (args.from.unwrap_or(0), args.to.unwrap_or(u64::MAX));
        ensure!(
            from <= to,
            "--from {from} --to {to}: the last cycle is before the first; permitted: --to {from} or more"
        );
        return Ok(cycles(from, to.saturating_add(1)));
    }
    ensure!(
        !machine.shade.is_there(),
        "--pixel and --triangle: the machine shades at each pixel; permitted with shade.kind = none; --from and --to take any machine"
    );
    let suite = of_input(&args.source.input, machine, port, None)?;
    let run = Runs::new(machine, &suite, suite.state).capture(Unit::MACHINE, StallKind::None);
    let memories = run.interface.memories.iter().filter(|memory| ["depth", "color"].contains(&memory.name));
    let writes = memories.filter_map(|memory| memory.write).map(|write| (write, &run.links[write.link]));
    if let Some(pixel) = &args.pixel {
        let (x, y) = (pixel[0], pixel[1]);
        ensure!(
            x < machine.width && y < machine.height,
            "--pixel {x} {y}: is off the screen; permitted: 0 0 to {} {}",
            machine.width - 1,
            machine.height - 1
        );
        let address = u128::from(y << machine.widths().x | x);
        let of = writes.flat_map(|(write, link)| {
            let tokens = link.tokens.iter().zip(&link.cycles);
            tokens.filter(move |(token, _)| token[write.address] == address).map(|(_, cycle)| *cycle)
        });
        let at: Vec<u64> = of.collect();
        let (Some(first), Some(last)) = (at.iter().min(), at.iter().max()) else {
            return Err(anyhow!(
                "--pixel {x} {y}: nothing of {} writes it; take another, or more --triangles",
                Counted::of(&port.triangles)
            ));
        };
        return Ok(cycles(first.saturating_sub(BEFORE), last + 2));
    }
    let triangle = args.triangle.unwrap_or(0);
    // Tokens enter; a write has the number of the triangle, polygon or line.
    let first = wholes(&port.triangles).take(triangle as usize).map(<[_]>::len).sum::<usize>();
    let enters = run.links[0].triangles.iter().position(|entered| *entered as usize == first);
    let Some(enters) = enters.map(|place| run.links[0].cycles[place]) else {
        return Err(anyhow!(
            "--triangle {triangle}: permitted: 0 to {}",
            wholes(&port.triangles).count() - 1
        ));
    };
    let of = writes.flat_map(|(_, link)| {
        let all = link.triangles.iter().zip(&link.cycles);
        all.filter(|(of, _)| **of == triangle).map(|(_, cycle)| *cycle)
    });
    let last = of.max().unwrap_or(enters);
    Ok(cycles(enters, last + 2))
}

/// Takes a sample where one is wanted; the first cycle opens the file, as it needs the simulator's list of signals.
fn sample(
    wave: &mut Option<Wave>,
    file: &mut Option<BufWriter<File>>,
    kind: &str,
    sim: &mut Simulator,
    wanted: bool,
) -> Result<()> {
    if let Some(file) = file.take() {
        let names = Activity::ALL.map(Activity::name);
        let labels = [Labels { signal: "activity", names: &names }];
        *wave = Some(match kind {
            "vcd" => Wave::Vcd(VcdTrace::new(Box::new(file), sim, TOP, &labels)?),
            "saif" => Wave::Saif(Box::new(Transitions::new(sim, TOP)), file),
            _ => Wave::Fst(Box::new(FstTrace::new(file, sim, TOP, &labels)?)),
        });
    }
    match wave {
        Some(Wave::Vcd(w)) if wanted => w.sample(sim)?,
        Some(Wave::Fst(w)) if wanted => w.sample(sim)?,
        Some(Wave::Saif(counted, _)) if wanted => counted.sample(sim),
        Some(Wave::Vcd(w)) => w.pass(),
        Some(Wave::Fst(w)) => w.pass(),
        Some(Wave::Saif(..)) | None => {}
    }
    Ok(())
}
