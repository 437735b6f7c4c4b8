//! From Verilog to gates, and the longest path through them.

use super::library::Library;
use super::written::{Module, Placed, modules};
use crate::cache::{Cache, text, unreadable};
use crate::design::Design;
use edgewalk_tool::{Stop, run};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// Name of what joins the units.
pub(super) const JOINTS: &str = "joints";
/// Files of the step.
const CELLS: &str = "cells.lib";
const VERILOG: &str = "gates.v";
const WRITTEN: &str = "gates.json";
const ENCODED: &str = "encoded.txt";
const MODULES: &str = "modules.json";
const TIMING: &str = "timing.txt";
/// Separates the longest path from the transition times in what OpenSTA prints.
const SLEWS: &str = "Transition times:";
/// The last line of what OpenSTA prints.
const END: &str = "End of transition times.";
/// The clock that the tool is asked for, ns; the path found does not depend on it.
const PERIOD: f64 = 10.0;

/// A design in gates.
#[derive(Debug)]
pub struct Gates {
    /// The design's top module.
    pub(super) top: String,
    pub(super) modules: BTreeMap<String, Module>,
    /// The longest transition times of output pins by path, of rise and fall, ns.
    pub(super) slews: BTreeMap<String, [f64; 2]>,
    /// What is known of it without a frame.
    pub placeless: Placeless,
}

/// Area and clock, before any layout.
#[derive(Clone, Debug, Serialize)]
pub struct Placeless {
    /// Versions of Yosys and OpenSTA.
    pub tools: [String; 2],
    /// Area of all cells, um2.
    pub area_um2: f64,
    /// Thousands of gate equivalents: the area in NANDs of two inputs.
    pub kge: f64,
    /// Flip-flops.
    pub flip_flops: u64,
    /// Cells in all.
    pub cells: u64,
    /// The shortest period of the clock, ns.
    pub ns: f64,
    /// The registers at the ends of the critical path.
    pub path: [String; 2],
    /// The units; `joints` is what joins them.
    pub units: Vec<UnitArea>,
}

/// Area of a unit.
#[derive(Clone, Debug, Serialize)]
pub struct UnitArea {
    /// Name of the unit.
    pub unit: String,
    /// Area of its cells, um2.
    pub area_um2: f64,
    /// Flip-flops of the unit.
    pub flip_flops: u64,
}

/// Synthesises the design. The steps are kept in the cache.
///
/// # Errors
/// A tool is missing, fails or takes too long.
pub fn gates(design: &Design, library: &Library, cache: &Cache, limit: Duration) -> Result<Gates, Stop> {
    let yosys = first_line(&run(Command::new("yosys").arg("-V"), limit)?);
    let sta = "OpenSTA ".to_owned() + &first_line(&run(Command::new("sta").arg("-version"), limit)?);
    let top = &design.module;
    let constraints = constraints(library);
    // Wires of one bit each: OpenSTA reads no concatenations. Cells get names without marks. The JSON comes before wires lose their
    // second names, by which the netlist may know them.
    let script = format!(
        "synth -top {top} -encfile {ENCODED}; dfflibmap -liberty {CELLS}; abc -liberty {CELLS} -constr constraints; splitnets -ports; \
         rename -enumerate -pattern cell_% c:*; write_json {WRITTEN}; opt_clean -purge; write_verilog -noattr {VERILOG}"
    );
    let key = [&*design.hash, &yosys, &library.hash, &script, &constraints, "with ports and wires"];
    let work = |folder: &Path| {
        let write = |name: &str, text: &str| {
            std::fs::write(folder.join(name), text).map_err(|error| Stop::file(&folder.join(name), &error))
        };
        for (name, verilog) in &design.files {
            write(name, verilog)?;
        }
        write(CELLS, &library.text)?;
        write("constraints", &constraints)?;
        let script = format!("read_verilog {}; {script}", design.sources().collect::<Vec<_>>().join(" "));
        run(Command::new("yosys").args(["-q", "-p", &script]).current_dir(folder), limit)?;
        // Yosys writes none where there is no state machine.
        let encoded = std::fs::read_to_string(folder.join(ENCODED)).unwrap_or_default();
        let modules =
            serde_json::to_string(&modules(&text("yosys", &folder.join(WRITTEN))?, &encoded, library)?);
        write(MODULES, &modules.map_err(|error| Stop::file(&folder.join(MODULES), &error.into()))?)
    };
    let (folder, modules) = cache.step(&key, &[VERILOG, MODULES], work, |folder| {
        let modules: BTreeMap<String, Module> = serde_json::from_str(&text("yosys", &folder.join(MODULES))?)
            .map_err(|error| unreadable("yosys", MODULES, error))?;
        let ends = text("yosys", &folder.join(VERILOG))?.lines().filter(|line| *line == "endmodule").count();
        match ends == modules.len() {
            true => Ok(modules),
            false => {
                Err(unreadable("yosys", VERILOG, format!("{ends} of {} modules are there", modules.len())))
            }
        }
    })?;
    // Absolute: OpenSTA works in another folder.
    let verilog = std::path::absolute(folder.join(VERILOG)).map_err(|error| Stop::file(&folder, &error))?;
    let work = |folder: &Path| {
        let used = modules.values().flat_map(|module| &module.cells).map(|cell| cell.of.as_str());
        let outputs: BTreeSet<&str> = used.flat_map(|cell| library.outputs(cell)).collect();
        let mut script = format!(
            "{}report_checks -path_delay max -digits 4\nputs {{{SLEWS}}}\nset sta_report_default_digits 9\n",
            opened(&verilog, top, PERIOD)
        );
        // Writing to a string cannot fail.
        for output in outputs {
            _ = writeln!(script, "foreach pin [get_pins -hierarchical */{output}] {{ report_slews $pin }}");
        }
        _ = writeln!(script, "puts {{{END}}}");
        std::fs::write(folder.join(TIMING), sta_run(folder, library, &script, limit)?)
            .map_err(|error| Stop::file(&folder.join(TIMING), &error))
    };
    let (_, ((ns, ends), slews)) = cache.step(&[&key[..], &[&*sta]].concat(), &[TIMING], work, |folder| {
        let printed = text("sta", &folder.join(TIMING))?;
        let whole = printed.trim_end().strip_suffix(END).and_then(|printed| printed.split_once(SLEWS));
        let (checks, times) = whole.ok_or_else(|| unreadable("sta", TIMING, "it ends early"))?;
        Ok((longest(checks)?, times.lines().filter_map(slew).collect()))
    })?;
    let path = ends.map(|cell| named(&modules, top, library, &cell));
    let placeless = counted(design, library, &modules, [yosys, sta], (ns, path))?;
    Ok(Gates { top: top.clone(), modules, slews, placeless })
}

/// The world outside the design, for ABC: an inverter drives each input, and each output has a load, fF.
fn constraints(library: &Library) -> String {
    format!("set_driving_cell {}\nset_load 0.05\n", library.inverter)
}

/// Commands of OpenSTA that open the netlist with a clock of that period, ns.
fn opened(verilog: &Path, top: &str, period: f64) -> String {
    // The library's own units may be others.
    format!(
        "read_liberty {CELLS}\nset_cmd_units -time ns -power W\nread_verilog {{{}}}\nlink_design {top}\n\
         create_clock -name clk -period {period} [get_ports clk]\n",
        verilog.display()
    )
}

/// Runs commands of OpenSTA. It ends with success whatever a command says, so its errors are looked for.
fn sta_run(folder: &Path, library: &Library, script: &str, limit: Duration) -> Result<String, Stop> {
    const SCRIPT: &str = "run.tcl";
    for (name, text) in [(SCRIPT, script), (CELLS, &library.text)] {
        std::fs::write(folder.join(name), text).map_err(|error| Stop::file(&folder.join(name), &error))?;
    }
    let printed = run(
        Command::new("sta").args(["-no_splash", "-no_init", "-exit", SCRIPT]).current_dir(folder),
        limit,
    )?;
    let errors = edgewalk_tool::first_lines(printed.lines().filter(|line| line.starts_with("Error")));
    match errors.is_empty() {
        true => Ok(printed),
        false => Err(Stop::Broken { tool: "sta".to_owned(), lines: errors }),
    }
}

fn counted(
    design: &Design,
    library: &Library,
    modules: &BTreeMap<String, Module>,
    tools: [String; 2],
    (ns, path): (f64, [String; 2]),
) -> Result<Placeless, Stop> {
    let top = &modules[&design.module];
    let own = |module: &Module| {
        let area: f64 = module.cells.iter().filter_map(|cell| library.area(&cell.of)).sum();
        let flip_flops = module.cells.iter().filter(|cell| library.register(&cell.of).is_some());
        (area, flip_flops.count() as u64, module.cells.len() as u64)
    };
    let unit = |name: &str, (area_um2, flip_flops, _): (f64, u64, u64)| UnitArea {
        unit: name.to_owned(),
        area_um2,
        flip_flops,
    };
    let mut all = own(top);
    let mut units = vec![unit(JOINTS, all)];
    for Placed { name: instance, of: module, .. } in &top.instances {
        let mut sum = (0.0, 0, 0);
        let mut open = vec![module];
        while let Some(module) = open.pop() {
            let module = &modules[module];
            let (area, flip_flops, cells) = own(module);
            sum = (sum.0 + area, sum.1 + flip_flops, sum.2 + cells);
            open.extend(module.instances.iter().map(|instance| &instance.of));
        }
        all = (all.0 + sum.0, all.1 + sum.1, all.2 + sum.2);
        units.push(unit(instance.trim_start_matches("u_"), sum));
    }
    // In the order of the data, the joints last.
    let order = |area: &UnitArea| {
        let place = design.units.iter().position(|(name, _)| *name == area.unit);
        place.unwrap_or(design.units.len())
    };
    units.sort_by_key(order);
    let (area_um2, flip_flops, cells) = all;
    let kge = area_um2 / library.gate_area() / 1000.0;
    Ok(Placeless { tools, area_um2, kge, flip_flops, cells, ns, path, units })
}

/// The longest path of a report: the period it permits, ns, and the cells at its ends.
fn longest(report: &str) -> Result<(f64, [String; 2]), Stop> {
    let of = |key: &str| {
        let rest = report.lines().find_map(|line| line.trim().strip_prefix(key))?;
        rest.split_whitespace().next().map(str::to_owned)
    };
    let slack = report.lines().find_map(|line| {
        let line = line.trim();
        let number = line.strip_suffix("slack (MET)").or_else(|| line.strip_suffix("slack (VIOLATED)"))?;
        number.trim().parse::<f64>().ok()
    });
    match (slack, of("Startpoint:"), of("Endpoint:")) {
        (Some(slack), Some(from), Some(to)) => Ok((PERIOD - slack, [from, to])),
        _ => Err(Stop::Broken { tool: "sta".to_owned(), lines: vec!["it tells of no path".to_owned()] }),
    }
}

/// A line of `report_slews`: `u_span/cell_7/Y ^ 0.040:0.070 v 0.030:0.060`, the shortest and the longest rise and fall.
fn slew(line: &str) -> Option<(String, [f64; 2])> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [pin, "^", rise, "v", fall] = words[..] else { return None };
    let [rise, fall] = [rise, fall].map(|times| times.split_once(':')?.1.parse::<f64>().ok());
    Some((pin.to_owned(), [rise?, fall?]))
}

/// `u_setup/lane0/cell_7` by the name of its register: `setup.lane0.acc[3]`.
fn named(modules: &BTreeMap<String, Module>, top: &str, library: &Library, path: &str) -> String {
    let mut parts: Vec<&str> = path.split('/').collect();
    let cell = parts.pop().unwrap_or_default();
    let mut module = modules.get(top);
    for part in &parts {
        let instance = module.and_then(|module| module.instances.iter().find(|of| of.name == *part));
        module = instance.and_then(|instance| modules.get(&instance.of));
    }
    let placed = module.and_then(|module| module.cells.iter().find(|of| of.name == cell));
    let output = placed.and_then(|of| of.pins.get(library.register(&of.of)?));
    parts.push(output.and_then(|bit| module?.name(bit)).unwrap_or(cell));
    parts.join(".").trim_start_matches("u_").to_owned()
}

fn first_line(printed: &str) -> String {
    printed.lines().next().unwrap_or_default().trim().to_owned()
}
