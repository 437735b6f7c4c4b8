//! The gates as Yosys writes them: modules with cells of the library, instances of modules, and wires.

use super::library::Library;
use crate::cache::unreadable;
use edgewalk_tool::Stop;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A module of the gate netlist.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Module {
    /// Cells of the library.
    pub cells: Vec<Placed>,
    /// Instances of modules.
    pub instances: Vec<Placed>,
    /// The bit at each port.
    pub ports: BTreeMap<String, Bit>,
    /// Names of input ports, without the clock.
    pub inputs: Vec<String>,
    /// Names of output ports.
    pub outputs: Vec<String>,
    /// Names of each wire, as the Verilog has them.
    pub names: BTreeMap<u64, Vec<String>>,
    /// By register, the codes of a state machine: those of the design and those of the gates, the highest bit first.
    pub codes: BTreeMap<String, Vec<[String; 2]>>,
}

/// A cell, or an instance of a module.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Placed {
    /// The name of the cell or instance.
    pub name: String,
    /// The library's cell, or the module.
    pub of: String,
    /// The bit at each pin.
    pub pins: BTreeMap<String, Bit>,
}

/// A wire's number within its module, or a constant: `0`, `1`, `x`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Bit {
    Wire(u64),
    Constant(String),
}

impl Module {
    /// The first name of a wire.
    pub fn name(&self, bit: &Bit) -> Option<&str> {
        let Bit::Wire(wire) = bit else { return None };
        self.names.get(wire)?.first().map(String::as_str)
    }

    /// The states of a state machine in which that bit of the gates is 1, each by the bits of the design; none if the bit has no
    /// other code there. Names get the prefix.
    pub fn states(&self, bit: &str, prefix: &str) -> Option<Vec<Vec<(String, bool)>>> {
        let (register, place) = match bit.strip_suffix(']').and_then(|rest| rest.rsplit_once('[')) {
            Some((register, place)) => (register, place.parse().ok()?),
            None => (bit, 0),
        };
        let high = |code: &str, place: usize| code.as_bytes().iter().rev().nth(place) == Some(&b'1');
        let codes = self.codes.get(register)?.iter().filter(|[_, new]| high(new, place));
        let state = |[old, _]: &[String; 2]| {
            let name = |bit: usize| match old.len() {
                1 => format!("{prefix}{register}"),
                _ => format!("{prefix}{register}[{bit}]"),
            };
            (0..old.len()).map(|bit| (name(bit), high(old, bit))).collect()
        };
        Some(codes.map(state).collect())
    }
}

/// Reads what Yosys says of the codes of state machines, by module and register:
///
/// ```text
/// .fsm edgewalk_setup from_place
/// .map 00 --1
/// ```
fn codes(text: &str) -> BTreeMap<(&str, &str), Vec<[String; 2]>> {
    let mut codes: BTreeMap<_, Vec<[String; 2]>> = BTreeMap::new();
    let mut open = ("", "");
    for line in text.lines() {
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            [".fsm", module, register] => open = (module, register),
            [".map", old, new] => codes.entry(open).or_default().push([old.to_owned(), new.to_owned()]),
            _ => {}
        }
    }
    codes
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
    cells: BTreeMap<String, WrittenCell>,
    netnames: BTreeMap<String, Net>,
}

#[derive(Deserialize)]
struct Port {
    direction: String,
    bits: Vec<Bit>,
}

#[derive(Deserialize)]
struct WrittenCell {
    r#type: String,
    connections: BTreeMap<String, Vec<Bit>>,
}

#[derive(Deserialize)]
struct Net {
    hide_name: u8,
    bits: Vec<Bit>,
}

/// The modules of a netlist of `write_json`, whose ports and wires have one bit each, with what `-encfile` wrote.
pub(super) fn modules(
    json: &str,
    encoded: &str,
    library: &Library,
) -> Result<BTreeMap<String, Module>, Stop> {
    let broken = |why: String| Stop::Broken { tool: "yosys".to_owned(), lines: vec![why] };
    let written: Written =
        serde_json::from_str(json).map_err(|error| unreadable("yosys", "netlist", error))?;
    let known: Vec<String> = written.modules.keys().cloned().collect();
    let mut modules = BTreeMap::new();
    for (name, of) in written.modules {
        if of.attributes.contains_key("blackbox") {
            continue;
        }
        let mut module = Module::default();
        for (net, Net { bits, .. }) in of.netnames.into_iter().filter(|(_, net)| net.hide_name == 0) {
            if let [Bit::Wire(wire)] = bits[..] {
                module.names.entry(wire).or_default().push(net);
            }
        }
        for (cell, WrittenCell { r#type, connections }) in of.cells {
            let pins =
                connections.into_iter().filter_map(|(pin, bits)| Some((pin, bits.into_iter().next()?)));
            let is_cell = library.area(&r#type).is_some();
            if !is_cell && !known.contains(&r#type) {
                return Err(broken(
                    format!("{name} has cells {type}, which the library has not", type = r#type),
                ));
            }
            let placed = Placed { name: cell, pins: pins.collect(), of: r#type };
            if is_cell { &mut module.cells } else { &mut module.instances }.push(placed);
        }
        for (name, Port { direction, bits }) in of.ports {
            match direction.as_str() {
                "input" if name != "clk" => module.inputs.push(name.clone()),
                "output" => module.outputs.push(name.clone()),
                _ => {}
            }
            if let Some(bit) = bits.into_iter().next() {
                module.ports.insert(name, bit);
            }
        }
        modules.insert(name, module);
    }
    for ((name, register), codes) in codes(encoded) {
        if let Some(module) = modules.get_mut(name) {
            module.codes.insert(register.to_owned(), codes);
        }
    }
    Ok(modules)
}
