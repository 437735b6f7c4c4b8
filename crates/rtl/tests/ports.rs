//! Every netlist has the ports that are declared for it, and those are the ones kept by hand in `tests/ports/*.txt`: a wrong
//! declaration, which would make all that follows from it wrong alike, is noticed here.

use std::collections::BTreeMap;
use std::sync::Arc;

use edgewalk_machine::{Link, Machine, Plan, Ports};
use edgewalk_netlist::{BuildErrors, Netlist};
use edgewalk_rtl as rtl;

/// Direction and bits of every port, by name.
type List = BTreeMap<String, (&'static str, u32)>;

/// The machine of a file, and the ports of each of its sections.
fn by_hand(text: &str) -> (Plan, BTreeMap<String, List>) {
    let mut machine = Machine::default();
    let mut sections: BTreeMap<String, List> = BTreeMap::new();
    let mut section = String::new();
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some((key, value)) = line.split_once(" = ") {
            match key {
                "preset" => machine = Machine::preset(value).expect("a preset"),
                _ => machine.set(key, value).expect("a key and its value"),
            }
        } else if let Some(name) = line.strip_prefix('[') {
            section = name.trim_end_matches(']').to_owned();
        } else {
            let words: Vec<&str> = line.split_whitespace().collect();
            let [direction, name, bits] = words[..] else { panic!("direction, name, bits: {line}") };
            let direction = if direction == "in" { "in" } else { "out" };
            let port = (direction, bits.parse().expect("a number of bits"));
            let before = sections.entry(section.clone()).or_default().insert(name.to_owned(), port);
            assert!(before.is_none(), "[{section}] has {name} twice");
        }
    }
    (machine.plan().expect("a machine that can be built"), sections)
}

fn built(netlist: Result<Arc<Netlist>, BuildErrors>) -> List {
    let netlist = netlist.unwrap_or_else(|errors| panic!("{errors}"));
    let inputs = netlist.inputs.iter().map(|port| (port.name.clone(), ("in", netlist.width(port.node))));
    let outputs = netlist.outputs.iter().map(|port| (port.name.clone(), ("out", netlist.width(port.driver))));
    inputs.chain(outputs).collect()
}

fn declared(ports: &Ports) -> List {
    let mut list = List::new();
    let mut link = |link: &Link, [there, back]: [&'static str; 2]| {
        list.insert(format!("{}_valid", link.name), (there, 1));
        list.insert(format!("{}_ready", link.name), (back, 1));
        list.extend(link.fields.iter().map(|f| (format!("{}_{}", link.name, f.name), (there, f.width()))));
    };
    let (enters, leaves) = (["in", "out"], ["out", "in"]);
    ports.takes.iter().for_each(|taken| link(taken, enters));
    ports.gives.iter().chain(&ports.writes).for_each(|given| link(given, leaves));
    for memory in &ports.memory {
        link(&memory.read, leaves);
        link(&memory.data, enters);
    }
    for (held, direction) in [(&ports.held_in, "in"), (&ports.held_out, "out")] {
        for held in held {
            let port = |name: &str| format!("{}_{name}", held.name);
            list.extend(held.fields.iter().map(|f| (port(&f.name), (direction, f.width()))));
        }
    }
    let inputs = ports.constants.iter().chain(&ports.levels).map(|f| (f, "in"));
    let outputs = ports.status.iter().map(|status| (&status.field, "out"));
    list.extend(inputs.chain(outputs).map(|(f, direction)| (f.name.clone(), (direction, f.width()))));
    list
}

fn check(file: &str, text: &str) {
    let (plan, mut by_hand) = by_hand(text);
    let mut checked = 0;
    let mut same = |name: &str, netlist: Result<Arc<Netlist>, BuildErrors>, declared: Option<List>| {
        let wanted = by_hand.remove(name).unwrap_or_else(|| panic!("{file} has no section [{name}]"));
        assert_eq!(built(netlist), wanted, "{name} of {file}: netlist and the list kept by hand");
        if let Some(declared) = declared {
            assert_eq!(declared, wanted, "{name} of {file}: declaration and the list kept by hand");
        }
        checked += wanted.len();
    };
    for unit in plan.units() {
        let build = rtl::units::builder(unit.name).expect("a builder");
        same(unit.name, build(&plan), Some(declared(&(unit.ports)(&plan))));
    }
    same("machine", rtl::machine(&plan), Some(declared(&plan.ports())));
    same("memory", rtl::memory(&plan, 0), None);
    assert!(by_hand.is_empty(), "{file} has sections without a netlist: {:?}", by_hand.keys());
    println!("{checked} ports of {file}");
    assert!(checked > 200, "only {checked} ports");
}

#[test]
fn ports_of_the_default_machine() {
    check("default.txt", include_str!("ports/default.txt"));
}

#[test]
fn ports_of_a_machine_that_takes_lines() {
    check("lines.txt", include_str!("ports/lines.txt"));
}

#[test]
fn ports_of_a_machine_that_takes_polygons() {
    check("polygon.txt", include_str!("ports/polygon.txt"));
}

#[test]
fn ports_of_the_textbook_machine() {
    check("textbook.txt", include_str!("ports/textbook.txt"));
}

#[test]
fn ports_of_a_machine_with_everything_on() {
    check("everything.txt", include_str!("ports/everything.txt"));
}

#[test]
fn ports_of_a_machine_with_blend() {
    check("blend.txt", include_str!("ports/blend.txt"));
}

#[test]
fn ports_of_a_machine_with_dither() {
    check("dither.txt", include_str!("ports/dither.txt"));
}

#[test]
fn ports_of_a_machine_with_shadow() {
    check("shadow.txt", include_str!("ports/shadow.txt"));
}

#[test]
fn ports_of_a_machine_with_shadow_whose_map_transmits() {
    check("transmits.txt", include_str!("ports/transmits.txt"));
}

#[test]
fn ports_of_a_machine_that_draws_its_map() {
    check("own_pass.txt", include_str!("ports/own_pass.txt"));
}

#[test]
fn ports_of_a_machine_that_shades() {
    check("shade.txt", include_str!("ports/shade.txt"));
}

#[test]
fn ports_of_a_machine_with_a_relief() {
    check("relief.txt", include_str!("ports/relief.txt"));
}

#[test]
fn every_declared_unit_has_a_builder() {
    let declared: Vec<&str> = edgewalk_machine::UNITS.iter().map(|unit| unit.name).collect();
    let built: Vec<&str> = edgewalk_rtl::BUILDERS.iter().map(|(name, _)| *name).collect();
    assert_eq!(built, declared);
}
