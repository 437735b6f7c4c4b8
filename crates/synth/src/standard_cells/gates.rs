//! From Verilog to gates, and the longest path through them.

use super::library::Library;
use crate::cache::Cache;
use crate::design::Design;
use edgewalk_tool::{Stop, run};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// Files of the step.
const CELLS: &str = "cells.lib";
const VERILOG: &str = "gates.v";
const WRITTEN: &str = "gates.json";
const MODULES: &str = "modules.json";
const TIMING: &str = "timing.txt";
/// The clock that the tool is asked for, ns; the path found does not depend on it.
const PERIOD: f64 = 10.0;

/// A design in gates.
#[derive(Debug)]
pub struct Gates {
    /// The design's top module.
    pub(super) top: String,
    pub(super) verilog: PathBuf,
    pub(super) modules: BTreeMap<String, Module>,
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

/// A module of the gate netlist.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Module {
    /// Cells of the library by type.
    pub cells: BTreeMap<String, u64>,
    /// Instances: name and module.
    pub instances: Vec<(String, String)>,
    /// Flip-flops.
    pub registers: Vec<Register>,
    /// Input bits by name.
    pub inputs: Vec<String>,
}

/// A flip-flop of a module.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Register {
    /// Name of the cell.
    pub cell: String,
    /// The pin at which its value is seen.
    pub output: String,
    /// Names of the bit at that pin, as the Verilog has them.
    pub names: Vec<String>,
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
    // Wires of one bit each: OpenSTA reads no concatenations. Cells get names without marks.
    let script = format!(
        "synth -top {top}; dfflibmap -liberty {CELLS}; abc -liberty {CELLS} -constr constraints; splitnets -ports; \
         opt_clean -purge; rename -enumerate -pattern cell_%; write_verilog -noattr {VERILOG}; write_json {WRITTEN}"
    );
    let key = [&*design.hash, &yosys, &library.hash, &script, &constraints, "without constants"];
    let folder = cache.step(&key, &[VERILOG, MODULES], |folder| {
        let write = |name: &str, text: &str| {
            std::fs::write(folder.join(name), text).map_err(|error| Stop::broken(name, &error))
        };
        for (name, verilog) in &design.files {
            write(name, verilog)?;
        }
        write(CELLS, &library.text)?;
        write("constraints", &constraints)?;
        let script = format!("read_verilog {}; {script}", design.sources().collect::<Vec<_>>().join(" "));
        run(Command::new("yosys").args(["-q", "-p", &script]).current_dir(folder), limit)?;
        write(VERILOG, &without_constants(&text(&folder.join(VERILOG))?))?;
        let modules = serde_json::to_string(&modules(&text(&folder.join(WRITTEN))?, library)?);
        write(MODULES, &modules.map_err(|error| Stop::broken(MODULES, &error.into()))?)
    })?;
    let modules: BTreeMap<String, Module> = serde_json::from_str(&text(&folder.join(MODULES))?)
        .map_err(|error| Stop::broken(MODULES, &error.into()))?;
    // Absolute: OpenSTA works in another folder.
    let verilog = std::path::absolute(folder.join(VERILOG)).map_err(|error| Stop::broken(VERILOG, &error))?;
    let timing = cache.step(&[&key[..], &[&*sta]].concat(), &[TIMING], |folder| {
        let script = format!("{}report_checks -path_delay max -digits 4\n", opened(&verilog, top, PERIOD));
        std::fs::write(folder.join(TIMING), sta_run(folder, library, &script, limit)?)
            .map_err(|error| Stop::broken(TIMING, &error))
    })?;
    let (ns, ends) = longest(&text(&timing.join(TIMING))?)?;
    let path = ends.map(|cell| named(&modules, top, &cell));
    let placeless = counted(design, library, &modules, [yosys, sta], (ns, path))?;
    Ok(Gates { top: top.clone(), verilog, modules, placeless })
}

/// The gates without `assign NAME = 1'h0;` and its like. OpenSTA 2.0.17 crashes in `report_power` where gates of another
/// module read such a constant. A wire without a driver has no transition either.
fn without_constants(verilog: &str) -> String {
    let constant = |line: &&str| line.starts_with("  assign ") && line.contains("= 1'h");
    verilog.lines().filter(|line| !constant(line)).fold(String::new(), |text, line| text + line + "\n")
}

/// The world outside the design, for ABC: an inverter drives each input, and each output has a load, fF.
fn constraints(library: &Library) -> String {
    format!("set_driving_cell {}\nset_load 0.05\n", library.inverter)
}

/// Commands of OpenSTA that open the netlist with a clock of that period, ns.
pub(super) fn opened(verilog: &Path, top: &str, period: f64) -> String {
    // The library's own units may be others.
    format!(
        "read_liberty {CELLS}\nset_cmd_units -time ns -power W\nread_verilog {{{}}}\nlink_design {top}\n\
         create_clock -name clk -period {period} [get_ports clk]\n",
        verilog.display()
    )
}

/// Runs commands of OpenSTA. It ends with success whatever a command says, so its errors are looked for.
pub(super) fn sta_run(
    folder: &Path,
    library: &Library,
    script: &str,
    limit: Duration,
) -> Result<String, Stop> {
    const SCRIPT: &str = "run.tcl";
    for (name, text) in [(SCRIPT, script), (CELLS, &library.text)] {
        std::fs::write(folder.join(name), text).map_err(|error| Stop::broken(name, &error))?;
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

/// A netlist of `write_json`, as far as it is needed.
#[derive(Deserialize)]
struct Written {
    modules: BTreeMap<String, WrittenModule>,
}

#[derive(Deserialize)]
struct WrittenModule {
    #[serde(default)]
    attributes: BTreeMap<String, serde_json::Value>,
    ports: BTreeMap<String, Port>,
    cells: BTreeMap<String, Cell>,
    netnames: BTreeMap<String, Net>,
}

#[derive(Deserialize)]
struct Port {
    direction: String,
}

#[derive(Deserialize)]
struct Cell {
    r#type: String,
    connections: BTreeMap<String, Vec<Bit>>,
}

#[derive(Deserialize)]
struct Net {
    hide_name: u8,
    bits: Vec<Bit>,
}

/// A wire's number, or a constant.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(untagged)]
enum Bit {
    Wire(u64),
    Constant(String),
}

fn modules(json: &str, library: &Library) -> Result<BTreeMap<String, Module>, Stop> {
    let broken = |why: String| Stop::Broken { tool: "yosys".to_owned(), lines: vec![why] };
    let written: Written =
        serde_json::from_str(json).map_err(|error| broken(format!("{WRITTEN} cannot be read: {error}")))?;
    let real = written.modules.iter().filter(|(_, module)| !module.attributes.contains_key("blackbox"));
    let mut modules = BTreeMap::new();
    for (name, of) in real {
        let mut module = Module::default();
        let mut names: BTreeMap<&Bit, Vec<String>> = BTreeMap::new();
        for (name, net) in of.netnames.iter().filter(|(_, net)| net.hide_name == 0) {
            if let [bit] = &net.bits[..] {
                names.entry(bit).or_default().push(name.clone());
            }
        }
        for (cell, Cell { r#type, connections }) in &of.cells {
            if written.modules.contains_key(r#type) && library.area(r#type).is_none() {
                module.instances.push((cell.clone(), r#type.clone()));
                continue;
            }
            if library.area(r#type).is_none() {
                return Err(broken(format!("{name} has cells {type}, which the library has not")));
            }
            *module.cells.entry(r#type.clone()).or_default() += 1;
            if let Some(output) = library.register(r#type) {
                let bit = connections.get(output).and_then(|bits| bits.first());
                let names = bit.and_then(|bit| names.get(bit)).cloned().unwrap_or_default();
                module.registers.push(Register { cell: cell.clone(), output: output.to_owned(), names });
            }
        }
        let inputs = of.ports.iter().filter(|(name, port)| port.direction == "input" && *name != "clk");
        module.inputs = inputs.map(|(name, _)| name.clone()).collect();
        modules.insert(name.clone(), module);
    }
    Ok(modules)
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
        let area: f64 =
            module.cells.iter().map(|(cell, n)| library.area(cell).unwrap_or(0.0) * *n as f64).sum();
        (area, module.registers.len() as u64, module.cells.values().sum::<u64>())
    };
    let unit = |name: &str, (area_um2, flip_flops, _): (f64, u64, u64)| UnitArea {
        unit: name.to_owned(),
        area_um2,
        flip_flops,
    };
    let mut all = own(top);
    let mut units = vec![unit("joints", all)];
    for (instance, module) in &top.instances {
        let mut sum = (0.0, 0, 0);
        let mut open = vec![module];
        while let Some(module) = open.pop() {
            let module = &modules[module];
            let (area, flip_flops, cells) = own(module);
            sum = (sum.0 + area, sum.1 + flip_flops, sum.2 + cells);
            open.extend(module.instances.iter().map(|(_, module)| module));
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

/// `u_setup/lane0/_7_` by the name of its register: `setup.lane0.acc[3]`.
fn named(modules: &BTreeMap<String, Module>, top: &str, path: &str) -> String {
    let mut parts: Vec<&str> = path.split('/').collect();
    let cell = parts.pop().unwrap_or_default();
    let mut module = modules.get(top);
    for part in &parts {
        let instance = module.and_then(|module| module.instances.iter().find(|(name, _)| name == part));
        module = instance.and_then(|(_, module)| modules.get(module));
    }
    let register = module.and_then(|module| module.registers.iter().find(|of| of.cell == cell));
    let name = register.and_then(|of| of.names.first()).map_or(cell, String::as_str);
    parts.push(name);
    parts.join(".").trim_start_matches("u_").to_owned()
}

fn text(path: &Path) -> Result<String, Stop> {
    std::fs::read_to_string(path).map_err(|error| Stop::broken(&path.display().to_string(), &error))
}

fn first_line(printed: &str) -> String {
    printed.lines().next().unwrap_or_default().trim().to_owned()
}
