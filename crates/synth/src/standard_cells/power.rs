//! Power of the gates while a frame is drawn.

use super::gates::{Gates, Module, Register, opened, sta_run};
use super::library::Library;
use crate::cache::Cache;
use edgewalk_tool::Stop;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::time::Duration;

/// What a bit did, a cycle: transitions, and the share of cycles in which it was 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Activity {
    /// Transitions a cycle.
    pub transitions: f64,
    /// Share of cycles at 1.
    pub high: f64,
}

/// Power of a design at a clock.
#[derive(Clone, Debug, Serialize)]
pub struct Power {
    /// Watts in all.
    pub watts: f64,
    /// Of these, watts that flow without any transition.
    pub leakage_watts: f64,
    /// Flip-flops whose transitions were counted in the frame; the tool derives those of the others from their inputs.
    pub counted: u64,
    /// Watts of each unit; `joints` is what joins them.
    pub units: Vec<UnitPower>,
}

/// Power of a unit.
#[derive(Clone, Debug, Serialize)]
pub struct UnitPower {
    /// Name of the unit.
    pub unit: String,
    /// Watts of the unit.
    pub watts: f64,
}

/// Power at a clock of that period, ns. `activity` names bits as the Verilog does: `u_setup.lane0.acc[3]`.
///
/// # Errors
/// OpenSTA is missing, fails or takes too long.
pub fn power(
    gates: &Gates,
    library: &Library,
    activity: &BTreeMap<String, Activity>,
    period: f64,
    cache: &Cache,
    limit: Duration,
) -> Result<Power, Stop> {
    // The documented command `set_power_activity -pins` of version 2.0.17 fails, so those beneath it are called.
    let mut script = opened(&gates.verilog, &gates.top, period);
    for input in &gates.modules[&gates.top].inputs {
        if let Some(Activity { transitions, high }) = activity.get(input) {
            let port = input.replace('[', "\\[").replace(']', "\\]");
            // Writing to a string cannot fail.
            _ = writeln!(
                script,
                "sta::set_power_input_port_activity [get_ports {{{port}}}] {transitions:.9} {high:.9}"
            );
        }
    }
    let mut counted = 0;
    registers(&gates.modules, &gates.top, "", &mut |pin, names| {
        let found = names.iter().find_map(|name| activity.get(name));
        if let Some(Activity { transitions, high }) = found {
            counted += 1;
            _ = writeln!(script, "sta::set_power_pin_activity [get_pins {pin}] {transitions:.9} {high:.9}");
        }
    });
    script.push_str("report_power -digits 9 -instances [get_cells -hierarchical *]\n");
    let printed = sta_run(cache.scratch(), library, &script, limit)?;
    let (mut all, mut leakage) = (0.0, 0.0);
    let mut units: BTreeMap<String, f64> = BTreeMap::new();
    let mut cells = 0;
    for line in printed.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [internal, switching, leaks, total, cell] = words[..] else { continue };
        let numbers = [internal, switching, leaks, total].map(str::parse::<f64>);
        let [Ok(_), Ok(_), Ok(leaks), Ok(total)] = numbers else { continue };
        let unit = cell.split_once('/').map_or("joints", |(unit, _)| unit.trim_start_matches("u_"));
        (all, leakage, cells) = (all + total, leakage + leaks, cells + 1);
        // Instances of modules are told of too, without power of their own.
        if cell.contains('/') || total > 0.0 {
            *units.entry(unit.to_owned()).or_default() += total;
        }
    }
    if cells < gates.placeless.cells {
        let told = format!("it tells the power of {cells} cells of {}", gates.placeless.cells);
        return Err(Stop::Broken { tool: "sta".to_owned(), lines: vec![told] });
    }
    let order = gates.placeless.units.iter();
    let units = order.map(|area| UnitPower {
        unit: area.unit.clone(),
        watts: units.get(&area.unit).copied().unwrap_or(0.0),
    });
    Ok(Power { watts: all, leakage_watts: leakage, counted, units: units.collect() })
}

/// Visits each flip-flop: the path of its output pin for OpenSTA, and the paths of that bit by each name.
fn registers(
    modules: &BTreeMap<String, Module>,
    module: &str,
    prefix: &str,
    visit: &mut dyn FnMut(String, Vec<String>),
) {
    let of = &modules[module];
    let dotted = prefix.replace('/', ".");
    for Register { cell, output, names } in &of.registers {
        let names = names.iter().map(|name| format!("{dotted}{name}")).collect();
        visit(format!("{prefix}{cell}/{output}"), names);
    }
    for (instance, module) in &of.instances {
        registers(modules, module, &format!("{prefix}{instance}/"), visit);
    }
}
