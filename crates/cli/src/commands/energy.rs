//! `edgewalk energy`: area, clock and energy of the machine in standard cells, while it draws the user's own frame.

use crate::Talk;
use crate::cost::cache_folder;
use crate::document::document;
use crate::input::{Source, to_port};
use crate::machine_args::MachineArgs;
use crate::progress;
use crate::scratch::Scratch;
use crate::verdict::Verdict;
use anyhow::{Context, Result, anyhow};
use edgewalk_machine::Plan;
use edgewalk_model::{Counters, Pass};
use edgewalk_netlist::Transitions;
use edgewalk_synth::{Activity, Cache, Design, LIBRARY, Library, Part, Placeless, Power, gates, power};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Duration;

/// Draw the input with the machine's netlist, count the transitions of its registers, and compute area, clock and energy in
/// standard cells.
///
/// Yosys maps the Verilog onto the cells of OSU's library for 0.18 um; OpenSTA computes the clock, and the power from the
/// transitions of every register and port. There is no layout: wires and the tree of the clock cost nothing. The memories
/// outside the machine are not counted. The figures compare machines; they are no promise of a chip.
///
/// Tools: apt-get install yosys opensta qflow-tech-osu018.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk energy sphere
  edgewalk energy sphere --triangles 100 --set formats.z_fraction=6
  edgewalk energy mesh.obj --mhz 50 --json")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Draw this many triangles of the input; all of them if left out
    #[arg(long, value_name = "N")]
    triangles: Option<usize>,
    /// Stop after this many cycles
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(1..))]
    cycles: u64,
    /// Clock at which the power is told; the fastest that the gates permit if left out
    #[arg(long, value_name = "MHZ", value_parser = megahertz)]
    mhz: Option<f64>,
    /// Time limit of each run of a tool, seconds
    #[arg(long, default_value_t = 3600, value_name = "SECONDS", value_parser = clap::value_parser!(u64).range(1..))]
    limit: u64,
    /// Folder of the cache; $XDG_CACHE_HOME/edgewalk/synth or ~/.cache/edgewalk/synth if left out
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
}

fn megahertz(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|mhz| (0.001..=100_000.0).contains(mhz));
    number.ok_or_else(|| "permitted: 0.001 to 100000".to_owned())
}

/// The report, as text and as JSON.
#[derive(Serialize)]
struct Report {
    /// Hash of the machine.
    machine: String,
    library: &'static str,
    #[serde(flatten)]
    placeless: Placeless,
    /// Clock of the watts, MHz.
    mhz: f64,
    power: Power,
    frame: Frame,
    energy: Energy,
}

/// What was drawn.
#[derive(Serialize)]
struct Frame {
    cycles: u64,
    triangles: u64,
    fragments: u64,
    writes: u64,
}

/// Energy, pJ. It does not depend on the clock, but for the leakage.
#[derive(Serialize)]
struct Energy {
    cycle_pj: f64,
    frame_pj: f64,
    /// Of a triangle taken in; null if none was.
    triangle_pj: Option<f64>,
    /// Of a pixel written; null if none was.
    pixel_pj: Option<f64>,
    /// Of the frame, by unit.
    units: BTreeMap<String, f64>,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let machine = args.source.machine(machine)?;
    let library = Library::read(LIBRARY.as_ref())?;
    let folder = cache_folder(args.cache.as_deref())?;
    let scratch = Scratch::within(&folder).with_context(|| format!("--cache {}", folder.display()))?;
    let cache = Cache::new(folder, scratch.path().to_owned());
    let limit = Duration::from_secs(args.limit);

    let (counted, counters) = drawn(args, &machine, talk)?;
    let bar = progress::spinner("yosys and sta", talk.quiet);
    let design =
        Design::new(&machine, Part::MACHINE).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    let gates = gates(&design, &library, &cache, limit)?;
    let cycles = counted.cycles();
    let a_cycle = |count: u64| count as f64 / cycles as f64;
    let activity = counted.bits().into_iter().map(|(name, bit)| {
        (name, Activity { transitions: a_cycle(bit.transitions), high: a_cycle(bit.high) })
    });
    let mhz = args.mhz.unwrap_or(1000.0 / gates.placeless.ns);
    let power = power(&gates, &library, &activity.collect(), 1000.0 / mhz, &cache, limit)?;
    bar.finish_and_clear();

    let placeless = gates.placeless;
    let report = Report {
        energy: energy(&power, mhz, cycles, &counters),
        machine: machine.hash(),
        library: "osu018",
        placeless,
        mhz,
        power,
        frame: frame(cycles, &counters),
    };
    talk.say(|| document("energy", &report), || report.text())?;
    Ok(Verdict::Pass)
}

/// Draws the input, and counts transitions.
fn drawn(args: &Args, machine: &Plan, talk: Talk) -> Result<(Transitions, Counters)> {
    let port = to_port(&args.source.frame(machine)?, machine)?;
    let triangles = args.triangles.map_or(port.triangles.len(), |most| most.min(port.triangles.len()));
    let size = (machine.width, machine.height);
    Verdict::drew(triangles as u64).or_nothing(&args.source.input, 0, size)?;
    let bar = progress::bar(triangles as u64, "triangles", talk.quiet);
    let mut counted: Option<Transitions> = None;
    let taken = port.triangles.iter().take(triangles).copied().inspect(|_| bar.inc(1));
    let passes = [Pass { triangles, ..Pass::all(port.state()?) }];
    let counters = edgewalk_lockstep::render_rtl_with(machine, taken, &passes, port.words(), |sim| {
        let counted = counted.get_or_insert_with(|| Transitions::new(sim, "edgewalk"));
        counted.sample(sim);
        counted.cycles() < args.cycles
    })?;
    bar.finish_and_clear();
    Ok((counted.context("the machine did not run")?, counters))
}

fn frame(cycles: u64, counters: &Counters) -> Frame {
    let Counters { triangles, fragments, writes, .. } = *counters;
    Frame { cycles, triangles, fragments, writes }
}

fn energy(power: &Power, mhz: f64, cycles: u64, counters: &Counters) -> Energy {
    // W/MHz is uJ a cycle.
    let frame = |watts: f64| watts / mhz * 1e6 * cycles as f64;
    let frame_pj = frame(power.watts);
    let each = |count: u64| (count > 0).then(|| frame_pj / count as f64);
    Energy {
        cycle_pj: frame_pj / cycles as f64,
        frame_pj,
        triangle_pj: each(counters.triangles),
        pixel_pj: each(counters.writes),
        units: power.units.iter().map(|unit| (unit.unit.clone(), frame(unit.watts))).collect(),
    }
}

impl Report {
    /// Writing to a string cannot fail.
    fn text(&self) -> String {
        let Report { machine, placeless, mhz, power, frame, energy, library } = self;
        let Placeless { tools, area_um2, kge, flip_flops, ns, path, units, .. } = placeless;
        let mut t = format!("machine {machine} in cells of {library}; {}; {}\n", tools[0], tools[1]);
        _ = writeln!(
            t,
            "    {:<10}{:>12}{:>9}{:>8}{:>12}{:>9}",
            "unit", "area um2", "FF", "share", "nJ a frame", "share"
        );
        for (area, watts) in units.iter().zip(&power.units) {
            _ = writeln!(
                t,
                "    {:<10}{:>12.0}{:>9}{:>6.1} %{:>12.2}{:>7.1} %",
                area.unit,
                area.area_um2,
                area.flip_flops,
                100.0 * area.area_um2 / area_um2,
                energy.units[&area.unit] / 1000.0,
                100.0 * watts.watts / power.watts
            );
        }
        _ = writeln!(
            t,
            "area {:.3} mm2, {kge:.1} thousand gates (NAND2X1), {flip_flops} flip-flops",
            area_um2 / 1e6
        );
        _ = writeln!(t, "clock {ns:.3} ns, {:.1} MHz without wires: {} to {}", 1000.0 / ns, path[0], path[1]);
        _ = writeln!(
            t,
            "power {:.2} mW at {mhz:.1} MHz, {:.4} of it leakage; transitions counted of {} of {flip_flops} flip-flops",
            1e3 * power.watts,
            1e3 * power.leakage_watts,
            power.counted
        );
        _ = writeln!(
            t,
            "energy {:.1} pJ a cycle, {:.1} nJ in {} cycles",
            energy.cycle_pj,
            energy.frame_pj / 1000.0,
            frame.cycles
        );
        for (what, count, pj) in [
            ("triangle", frame.triangles, energy.triangle_pj),
            ("pixel written", frame.writes, energy.pixel_pj),
        ] {
            if let Some(pj) = pj {
                _ = writeln!(t, "       {pj:.1} pJ a {what}, of {count}");
            }
        }
        t.trim_end().to_owned()
    }
}
