//! `edgewalk compare` of any number of machines on any number of inputs: what their features cost, as one table.
//!
//! ```text
//!  machines ─> netlists ─> estimate of each unit ─┐
//!  machines x inputs ─> pictures, cycles ─────────┼─> text, JSON, page
//!  inputs ─> shading equation ─> distance ────────┤
//!  machines x inputs ─> transitions ─> energy ────┘
//! ```

mod page;
mod page_file;
mod text;

use super::{Args, Asked, apart, drawn, verdict};
use crate::Talk;
use crate::cell_energy::{CellEnergy, Drawing};
use crate::cost::Synthesiser;
use crate::document::document;
use crate::estimator::Estimator;
use crate::machine_args::{MachineArgs, no_needs};
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_explore::sweep::equation::{Distance, Equation, Measure};
use edgewalk_files::Staging;
use edgewalk_golden::Shading;
use edgewalk_host::input::{Input, Shaded};
use edgewalk_host::needs::reason;
use edgewalk_host::port::to_port;
use edgewalk_judge::passes::beside_golden;
use edgewalk_judge::report::Report;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_synth::{Part, Target, memories};
use edgewalk_tool::Stop;
use page_file::PageFile;
use serde_json::{Value, json};

/// What a run may write.
const FILES: [&str; 2] = ["features.json", "features.txt"];

/// The word behind a machine's colon that asks for Gouraud shading with a map for each light.
const SHADOWS: &str = "shadows";

/// Devices of which the table says whether a machine fits.
const DEVICES: [&str; 2] = ["ice40-hx8k", "ice40-up5k"];

/// A machine of the table.
struct Column {
    /// As it was asked for.
    name: String,
    /// Without the word for shadows.
    asked: String,
    shadows: bool,
    /// With the screen that it has by itself.
    plan: Plan,
}

impl Column {
    fn new(name: &str, machine: &MachineArgs) -> Result<Column> {
        let (asked, shadows) = match name.strip_suffix(SHADOWS).and_then(|rest| rest.strip_suffix(':')) {
            Some(asked) => (asked, true),
            None => (name, false),
        };
        let plan = machine.named(apart(asked)?.0, None, no_needs)?;
        Ok(Column { name: name.to_owned(), asked: asked.to_owned(), shadows, plan })
    }

    /// Cells by unit, and the memories.
    fn cost(&self, synthesiser: Option<&Synthesiser>) -> Result<Value> {
        let devices = DEVICES.map(Target::named).into_iter().collect::<Result<Vec<_>, _>>();
        let whole = Estimator::new("machine", devices.map_err(|error| anyhow!("{error}"))?);
        let units = self.plan.units().map(|unit| {
            json!({ "unit": unit.name, "estimate": Estimator::new(unit.name, Vec::new()).value(&self.plan) })
        });
        let memories: Vec<Value> = memories(&self.plan, Part::MACHINE)
            .into_iter()
            .map(|memory| {
                let bits = memory.words * memory.bits;
                json!({ "memory": memory.name, "words": memory.words, "word_bits": memory.bits, "bits": bits })
            })
            .collect();
        let bits: u64 = memories.iter().filter_map(|memory| memory["bits"].as_u64()).sum();
        let mut cost = json!({
            "machine": self.name,
            "hash": self.plan.hash(),
            "units": units.collect::<Vec<_>>(),
            "estimate": whole.value(&self.plan),
            "memories": memories,
            "memory_bits": bits,
        });
        if let Some(synthesiser) = synthesiser {
            let measured = synthesiser.cost(&self.plan);
            cost["synth"] = measured.unwrap_or_else(|(_, why)| json!({ "reasons": [why] }));
        }
        Ok(cost)
    }
}

/// A picture of the table.
struct Picture {
    report: Report,
    /// Cycles of the lights' maps.
    maps: u64,
    distance: Option<Distance>,
    /// From the equation in the form that the machine draws.
    from_form: Option<Distance>,
    verdict: Verdict,
}

impl Picture {
    fn value(&self) -> Result<Value> {
        let report = serde_json::to_value(&self.report)?;
        let at = |place: &str| report.pointer(place).cloned().unwrap_or(Value::Null);
        // Of an open picture nothing was compared.
        let error = |place: &str| if self.verdict == Verdict::Open { Value::Null } else { at(place) };
        Ok(json!({
            "cycles": at("/cycles/total"),
            "map_cycles": self.maps,
            "all_cycles": at("/cycles/total").as_u64().map(|cycles| cycles + self.maps),
            "fragments": at("/fragments"),
            "bytes": at("/traffic/bytes"),
            "z_error": error("/comparison/z_error"),
            "color_error": error("/comparison/color_error"),
            "shading_error": self.distance.map(|distance| distance.largest),
            "shading_mean": self.distance.map(|distance| distance.mean),
            "form_error": self.from_form.map(|distance| distance.largest),
            "form_mean": self.from_form.map(|distance| distance.mean),
            "verdict": self.verdict.word(),
        }))
    }
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    if args.adapt {
        return Err(anyhow!(
            "--adapt: not permitted for a table of machines, as each input would change them; set the keys behind the machines' names"
        ));
    }
    if let (Some(triangles), false) = (args.energy, args.stalls == Waits::Never) {
        return Err(anyhow!(
            "--energy {triangles} --stalls {}: the energy is that of a memory that never makes the machine wait; leave out one of them",
            args.stalls
        ));
    }
    let names = [&args.a, &args.b].into_iter().chain(&args.with);
    let columns = names.map(|name| Column::new(name, machine)).collect::<Result<Vec<_>>>()?;
    let shaded = Shaded::Corners(Shading::Gouraud);
    let inputs = args.inputs.iter().map(|name| Input::open(name, shaded)).collect::<Result<Vec<_>>>()?;
    let synthesiser = match args.synth.definition(&columns[0].plan)? {
        Some(of) => {
            let synthesiser = Synthesiser::new(&of, args.synth.tools())?;
            synthesiser.check()?;
            Some(synthesiser)
        }
        None => None,
    };
    let tools = args.synth.tools();
    let library = args.library.as_deref();
    let cells = args.energy.map(|_| CellEnergy::new(library, tools.cache(), tools.limit())).transpose()?;
    let out = Staging::new(&args.out)?;
    let page = args.page.as_deref().map(|file| PageFile::new(file, (&args.out, &FILES))).transpose()?;
    let (mut machines, mut verdict, mut drawn) = (Vec::new(), Verdict::Pass, 0);
    for column in &columns {
        let mut cost = column.cost(synthesiser.as_ref())?;
        let mut rows = Vec::new();
        for input in &inputs {
            let mut row = json!({ "input": input.name() });
            match picture(column, input, args, machine) {
                Ok(picture) => {
                    verdict = verdict.and(picture.verdict);
                    drawn += 1;
                    let told = picture.value()?;
                    told.as_object().into_iter().flatten().for_each(|(key, value)| row[key] = value.clone());
                    if let (Some(cells), Some(triangles)) = (&cells, args.energy) {
                        let asked = Asked::new(&column.asked, input, args, machine)?;
                        row["energy"] = match energy(cells, triangles, column, &asked) {
                            Ok(energy) => energy,
                            // A tool that is missing or fails ends the command.
                            Err(why) if why.is::<Stop>() => return Err(why),
                            Err(why) => json!({ "reason": format!("{why:#}") }),
                        };
                    }
                }
                Err(why) => row["reason"] = reason(&why).into(),
            }
            rows.push(row);
        }
        cost["inputs"] = rows.into();
        machines.push(cost);
    }
    if drawn == 0 {
        let why = machines[0].pointer("/inputs/0/reason").and_then(Value::as_str).unwrap_or_default();
        return Err(anyhow!("no machine draws any of the inputs; the first: {why}"));
    }
    let told = json!({
        "stalls": args.stalls.to_string(),
        "inputs": inputs.iter().map(Input::name).collect::<Vec<_>>(),
        "machines": machines,
    });
    let (json, text) = (document("features", &told)?, text::text(&told));
    out.write("features.json", &json)?;
    out.write("features.txt", &text)?;
    out.publish(&FILES)?;
    page.map(|page| page.publish(&page::page(&told))).transpose()?;
    talk.say(|| Ok(json.clone()), || text.clone())?;
    synthesiser.iter().try_for_each(Synthesiser::check_any)?;
    Ok(verdict)
}

/// Cycles of a frame whose energy is computed, at most.
const CYCLES: u64 = 1_000_000;

/// Energy of the first triangles in standard cells. Of pictures in passes none: the netlist draws one pass.
fn energy(cells: &CellEnergy, triangles: u32, column: &Column, asked: &Asked) -> Result<Value> {
    if column.shadows {
        return Ok(json!({ "reason": format!(":{SHADOWS} draws in passes; energy is that of one") }));
    }
    let port = to_port(&asked.input.first(&asked.plan, triangles as usize)?, &asked.plan)?;
    let drawing = Drawing { machine: &asked.plan, port: &port, cycles: CYCLES };
    Ok(serde_json::to_value(cells.measure(&drawing, None, &|| ())?)?)
}

/// Draws an input on a machine, and compares it with the shading equation.
fn picture(column: &Column, input: &Input, args: &Args, machine: &MachineArgs) -> Result<Picture> {
    let asked = Asked::new(&column.asked, input, args, machine)?;
    if column.shadows {
        return shadowed(&asked, args.stalls);
    }
    let equation = Equation::of(&asked.input, &asked.plan);
    let form = match asked.shaded {
        Shaded::Corners(_) => None,
        Shaded::Pixels(method) => Equation::of_shade(&asked.input, &asked.plan, method),
    };
    let [mut measure, mut of_form] = [&equation, &form].map(|of| of.as_ref().map(Equation::measure));
    let mut maps = 0;
    let report = drawn(&asked, args.stalls, |raster| {
        maps = raster.lights.iter().map(|light| light.cycles.total).sum();
        measure.iter_mut().chain(&mut of_form).for_each(|measure| measure.add(raster));
        Ok(())
    })?;
    let size = (asked.plan.width, asked.plan.height);
    let verdict = verdict(&report).or_nothing(input.name(), report.drawn.primitives(), size)?;
    let distance = measure.map(Measure::distance);
    // What shades at the corners draws the scene's own equation.
    let from_form = of_form.map(Measure::distance).or(distance);
    Ok(Picture { report, maps, distance, from_form, verdict })
}

/// Draws a scene with a map for each of its lights, beside the equation with shadows by rays.
fn shadowed(asked: &Asked, waits: Waits) -> Result<Picture> {
    if waits != Waits::Never {
        return Err(anyhow!(":{SHADOWS}: permitted with --stalls none"));
    }
    let (scene, surface) = asked.input.surface(&asked.plan).ok_or_else(|| {
        anyhow!(":{SHADOWS}: a triangle file brings its own maps, the line `shadow`; leave :{SHADOWS} out")
    })?;
    let (drawn, _, passes) = beside_golden(scene, &surface, &asked.plan)?;
    let equation = Equation::with_shadows(&asked.input, &asked.plan);
    let distance = equation.as_ref().map(|equation| {
        let mut measure = equation.measure();
        measure.add(&drawn);
        measure.distance()
    });
    let maps = drawn.lights.iter().map(|light| light.cycles.total).sum();
    let report = Report::new(asked.input.name(), surface.triangles.len() as u64, &asked.plan, &drawn, waits);
    let (triangles, size) = (surface.triangles.len() as u64, (asked.plan.width, asked.plan.height));
    let verdict = passes.verdict().or_nothing(asked.input.name(), triangles, size)?;
    Ok(Picture { report, maps, distance, from_form: distance, verdict })
}
