//! What others see of a module: its header and its ports.

use edgewalk_netlist::netlist::{Netlist, NodeId, Source};

use crate::literal;

/// The purpose of the module and the rest of its header text, as comments.
pub(crate) fn header(netlist: &Netlist) -> String {
    let mut lines = netlist.doc.lines();
    let first = lines.next().map_or(String::new(), |line| format!(": {line}"));
    let rest: String = lines.map(|line| format!("{}\n", format!("// {line}").trim_end())).collect();
    format!("// {}{first}\n{rest}\n", netlist.name)
}

/// The port list: clock and reset, inputs, outputs, each with its doc.
pub(crate) fn ports(netlist: &Netlist) -> String {
    let implicit = [("clk", netlist.has_clock), ("rst", netlist.has_reset)];
    let implicit = implicit.iter().filter(|(_, there)| *there);
    let implicit = implicit.map(|(name, _)| ("input  wire ".to_string(), 1, *name, ""));
    let inputs = netlist.inputs.iter().map(|input| {
        ("input  wire ".to_string(), netlist.width(input.node), input.name.as_str(), input.doc.as_str())
    });
    let outputs = netlist.outputs.iter().map(|output| {
        let is_reg = is_shown(netlist, output.driver)
            && matches!(netlist.node(output.driver).source, Source::Register(_) | Source::MemoryRead { .. })
            && netlist.name_of(output.driver).as_ref() == Some(&output.name);
        let kind = if is_reg { "output reg  " } else { "output wire " };
        let doc = if output.doc.is_empty() { doc_of(netlist, output.driver) } else { &output.doc };
        (kind.to_string(), netlist.width(output.driver), output.name.as_str(), doc)
    });
    let all: Vec<Vec<_>> = vec![implicit.collect(), inputs.collect(), outputs.collect()];
    let ranges = all.iter().flatten().map(|(_, width, ..)| literal::range(*width).len()).max().unwrap_or(0);
    let names = all.iter().flatten().map(|(_, _, name, _)| name.len() + 1).max().unwrap_or(0);
    let mut left = all.iter().map(Vec::len).sum::<usize>();
    let mut groups = Vec::new();
    for group in all.iter().filter(|group| !group.is_empty()) {
        let mut text = String::new();
        for (kind, width, name, doc) in group {
            left -= 1;
            let name = format!("{name}{}", if left > 0 { "," } else { "" });
            let comment =
                if doc.is_empty() { String::new() } else { format!("  // {}", doc.replace('\n', " ")) };
            let line = format!("  {kind}{:>ranges$}{name:names$}{comment}", literal::range(*width));
            text.push_str(line.trim_end());
            text.push('\n');
        }
        groups.push(text);
    }
    groups.join("\n")
}

/// A register, wire, memory or instance output that is declared as the output port of its name.
pub(crate) fn is_shown(netlist: &Netlist, node: NodeId) -> bool {
    let name = netlist.name_of(node);
    netlist.outputs.iter().any(|output| output.driver == node && Some(&output.name) == name.as_ref())
}

fn doc_of(netlist: &Netlist, node: NodeId) -> &str {
    match netlist.node(node).source {
        Source::Register(index) if is_shown(netlist, node) => &netlist.registers[index].doc,
        Source::Wire(index) if is_shown(netlist, node) => &netlist.wires[index].doc,
        _ => "",
    }
}
