//! Energy of a machine in standard cells while it draws a frame: for `energy`, and for tables of machines.

use crate::cost::cache_folder;
use anyhow::{Context, Result, anyhow, ensure};
use edgewalk_files::Scratch;
use edgewalk_host::port::PortFrame;
use edgewalk_machine::{Counted, Plan};
use edgewalk_model::{Counters, Pass};
use edgewalk_netlist::{BitBlocks, Simulator};
use edgewalk_scene::inputs;
use edgewalk_synth::{
    Cache, Design, GateRun, Gates, Library, Part, Placeless, Power, UNSETTLED, gates, power,
};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

/// Where machines are measured.
pub struct CellEnergy {
    library: Library,
    cache: Cache,
    /// Removed together with this value: the folder in which the cache makes its entries.
    _scratch: Scratch,
    limit: Duration,
}

/// A frame of a machine whose energy is measured.
pub struct Drawing<'d> {
    /// The machine.
    pub machine: &'d Plan,
    /// The frame at its port.
    pub port: &'d PortFrame,
    /// Stop after so many cycles.
    pub cycles: u64,
}

impl CellEnergy {
    /// With the library of that file, or that of the system.
    ///
    /// # Errors
    /// No usable library, or a folder that cannot be written.
    pub fn new(library: Option<&Path>, cache: Option<&Path>, limit: u64) -> Result<CellEnergy> {
        let library = match library {
            Some(file) => {
                inputs::note(file);
                Library::read(file).context("--library")?
            }
            None => Library::installed()?,
        };
        let folder = cache_folder(cache)?;
        let scratch = Scratch::within(&folder).with_context(|| format!("--cache {}", folder.display()))?;
        let cache = Cache::new(folder, scratch.path().to_owned());
        Ok(CellEnergy { library, cache, _scratch: scratch, limit: Duration::from_secs(limit) })
    }

    /// Maps the machine onto gates, draws with netlist and gates side by side, and computes area, clock and energy at so many MHz,
    /// or at the fastest clock. Each token that enters the machine calls `taken`.
    ///
    /// # Errors
    /// A tool is missing, fails or takes too long. The machine cannot be built. The clock is too fast for the gates. The gates
    /// differ from the netlist, or there are too few cycles to compare the two.
    pub fn measure(&self, of: &Drawing, mhz: Option<f64>, taken: &dyn Fn()) -> Result<Report> {
        // What no netlist draws alone is refused before the tools run.
        of.port.state()?;
        let design = Design::new(of.machine, Part::MACHINE)
            .map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
        let gates = gates(&design, &self.library, &self.cache, self.limit)?;
        let fastest = 1000.0 / gates.placeless.ns;
        let mhz = mhz.unwrap_or(fastest);
        ensure!(
            mhz <= fastest,
            "--mhz {mhz}: the gates permit {fastest:.1} MHz at most; leave --mhz out for that clock"
        );
        let (run, cycles, counters) = drawn(of, &gates, &self.library, taken)?;
        let frame = frame(of.port, cycles, &counters);
        let power = power(&gates, &self.library, &run, 1000.0 / mhz)?;
        ensure!(
            power.compared > 0,
            "{cycles} cycles were run; more than {UNSETTLED} are needed: gates and netlist are compared from then on"
        );
        Ok(Report {
            energy: energy(&power, mhz, &frame),
            machine: of.machine.hash(),
            library: self.library.name().to_owned(),
            gate: self.library.gate().to_owned(),
            placeless: gates.placeless,
            mhz,
            power,
            frame,
        })
    }
}

/// The report, as text and as JSON.
#[derive(Serialize)]
pub struct Report {
    /// Hash of the machine.
    machine: String,
    /// Name of the library of cells.
    library: String,
    /// The cell in whose area the others are told.
    gate: String,
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
    /// Taken in, with polygons and lines.
    triangles: u64,
    /// What they are.
    #[serde(skip)]
    noun: &'static str,
    fragments: u64,
    writes: u64,
}

/// Energy, pJ. It does not depend on the clock, but for the leakage.
#[derive(Serialize)]
struct Energy {
    cycle_pj: f64,
    frame_pj: f64,
    /// Of a triangle, polygon or line taken in; null if none was.
    triangle_pj: Option<f64>,
    /// Of a pixel written; null if none was.
    pixel_pj: Option<f64>,
    /// Of the frame, by unit.
    units: BTreeMap<String, f64>,
}

/// Draws with netlist and gates; gives the run of the gates, the cycles, and the counters.
fn drawn<'l>(
    of: &Drawing,
    gates: &Gates,
    library: &'l Library,
    told: &dyn Fn(),
) -> Result<(GateRun<'l>, u64, Counters)> {
    let (mut run, mut failed, mut blocks) = (None, None, None);
    let (cycles, counters) = clocked(of, told, |sim| {
        let blocks = blocks.get_or_insert_with(|| BitBlocks::new(sim));
        if run.is_none() {
            match GateRun::new(gates, library, blocks.names()) {
                Ok(new) => run = Some(new),
                Err(stop) => {
                    failed = Some(stop);
                    return false;
                }
            }
        }
        blocks.sample(sim);
        let (words, cycles) = blocks.block();
        if cycles == BitBlocks::CYCLES {
            run.iter_mut().for_each(|run| run.block(words, cycles));
        }
        true
    })?;
    if let Some(stop) = failed {
        return Err(stop.into());
    }
    let mut run = run.context("the machine did not run")?;
    if let Some((words, cycles)) = blocks.as_ref().map(BitBlocks::block)
        && cycles < BitBlocks::CYCLES
    {
        run.block(words, cycles);
    }
    Ok((run, cycles, counters))
}

/// Draws with the machine's netlist; `cycle` sees every cycle before its edge, and returns false to end. Gives the cycles seen.
fn clocked(
    of: &Drawing,
    told: &dyn Fn(),
    mut cycle: impl FnMut(&mut Simulator) -> bool,
) -> Result<(u64, Counters)> {
    let Drawing { machine, port, cycles: most } = *of;
    let taken = port.triangles.iter().copied().inspect(|_| told());
    let passes = [Pass { triangles: port.triangles.len(), ..Pass::all(port.state()?) }];
    let mut cycles = 0;
    let counters = edgewalk_lockstep::render_rtl_with(machine, taken, &passes, port.words(), |sim| {
        cycles += 1;
        cycle(sim) && cycles < most
    })?;
    Ok((cycles, counters))
}

fn frame(port: &PortFrame, cycles: u64, counters: &Counters) -> Frame {
    let Counters { triangles: tokens, fragments, writes, .. } = *counters;
    let taken = Counted::of(&port.triangles[..tokens as usize]);
    let triangles = taken.total() as u64;
    let noun = if taken.total() == taken.triangles { "triangle" } else { "triangle, polygon or line" };
    Frame { cycles, triangles, noun, fragments, writes }
}

fn energy(power: &Power, mhz: f64, drawn: &Frame) -> Energy {
    let cycles = drawn.cycles;
    // W/MHz is uJ a cycle.
    let frame = |watts: f64| watts / mhz * 1e6 * cycles as f64;
    let frame_pj = frame(power.watts);
    let each = |count: u64| (count > 0).then(|| frame_pj / count as f64);
    Energy {
        cycle_pj: frame_pj / cycles as f64,
        frame_pj,
        triangle_pj: each(drawn.triangles),
        pixel_pj: each(drawn.writes),
        units: power.units.iter().map(|unit| (unit.unit.clone(), frame(unit.watts))).collect(),
    }
}

impl Report {
    /// As text. Writing to a string cannot fail.
    pub fn text(&self) -> String {
        let Report { machine, placeless, mhz, power, frame, energy, library, gate } = self;
        let Placeless { tools, area_um2, kge, flip_flops, ns, path, units, .. } = placeless;
        let mut t = format!("machine {machine} in cells of {library}; {}; {}\n", tools[0], tools[1]);
        _ = writeln!(
            t,
            "    {:<10}{:>12}{:>9}{:>8}{:>12}{:>9}{:>9}",
            "unit", "area um2", "FF", "share", "nJ a frame", "share", "still"
        );
        for (area, watts) in units.iter().zip(&power.units) {
            _ = writeln!(
                t,
                "    {:<10}{:>12.0}{:>9}{:>6.1} %{:>12.2}{:>7.1} %{:>9}",
                area.unit,
                area.area_um2,
                area.flip_flops,
                100.0 * area.area_um2 / area_um2,
                energy.units[&area.unit] / 1000.0,
                100.0 * watts.watts / power.watts,
                watts.still.map_or_else(|| "-".to_owned(), |still| format!("{:.1} %", 100.0 * still))
            );
        }
        _ = writeln!(
            t,
            "area {:.3} mm2, {kge:.1} thousand gates ({gate}), {flip_flops} flip-flops",
            area_um2 / 1e6
        );
        _ = writeln!(t, "clock {ns:.3} ns, {:.1} MHz without wires: {} to {}", 1000.0 / ns, path[0], path[1]);
        _ = writeln!(
            t,
            "power {:.2} mW at {mhz:.1} MHz: clock {:.2}, flip-flops {:.2}, gates {:.2}, leakage {:.4}",
            1e3 * power.watts,
            1e3 * power.clock_watts,
            1e3 * power.flip_flop_watts,
            1e3 * power.gate_watts,
            1e3 * power.leakage_watts
        );
        _ = writeln!(
            t,
            "a clock that stops for units that hold still would take {:.2} mW less",
            1e3 * power.still_watts
        );
        _ = writeln!(
            t,
            "transitions {:.1} a cycle, counted at every net; {} next states and outputs compared with the netlist, 0 differ",
            power.transitions, power.compared
        );
        _ = writeln!(
            t,
            "energy {:.1} pJ a cycle, {:.1} nJ in {} cycles",
            energy.cycle_pj,
            energy.frame_pj / 1000.0,
            frame.cycles
        );
        for (what, count, pj) in [
            (frame.noun, frame.triangles, energy.triangle_pj),
            ("pixel written", frame.writes, energy.pixel_pj),
        ] {
            if let Some(pj) = pj {
                _ = writeln!(t, "       {pj:.1} pJ a {what}, of {count}");
            }
        }
        t.trim_end().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edgewalk_host::draw::{Drawn, draw_frame};
    use edgewalk_host::input::{Input, Shaded};
    use edgewalk_host::port::to_port;
    use edgewalk_machine::Machine;
    use edgewalk_model::Waits;
    use edgewalk_scene::PixelMethod;

    const SQUARE: &str = "[[material]]\nname = \"m\"\ndiffuse = 0.5\nspecular = 0.3\nexponent = 20\n[[object]]\n\
        positions = [[-1, -1, 0], [1, -1, 0.1], [1, 1, 0], [-1, 1, 0.2]]\nfaces = [[0, 1, 2], [0, 2, 3]]\n\
        material = \"m\"\n";

    /// The netlist reads the records and tables of the frame: with empty ones it takes other cycles.
    #[test]
    fn shaded_frame_takes_the_models_cycles() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join("square.toml");
        std::fs::write(&scene, SQUARE).expect("a file");
        let mut machine = Machine::default();
        for (key, value) in [("screen.width", "64"), ("screen.height", "48"), ("shade.kind", "fast-phong")] {
            machine.set(key, value).expect("a key");
        }
        let machine = machine.plan().expect("can be built");
        let name = scene.display().to_string();
        let input = Input::open(&name, Shaded::Pixels(PixelMethod::FastPhong)).expect("a scene");
        let port = to_port(&input.frame(&machine).expect("a frame"), &machine).expect("fits");
        let Drawn::Ticked(model, ..) = draw_frame(&machine, &port, Waits::Never).expect("is drawn") else {
            panic!("machines with SHADE are ticked");
        };
        let drawing = Drawing { machine: &machine, port: &port, cycles: 1 << 20 };
        let (cycles, counters) = clocked(&drawing, &|| (), |_| true).expect("is drawn");
        let model = model.counters;
        assert_eq!((cycles, counters.writes), (model.cycles, model.writes));
        assert!(counters.writes > 500, "{}", counters.writes);
    }
}
