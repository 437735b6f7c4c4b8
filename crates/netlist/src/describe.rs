//! A source as text for an error message: its name, or the operator with its operands, three deep.

use crate::netlist::{Netlist, NodeId, Source};

const DEPTH: u32 = 3;

pub(crate) fn describe(netlist: &Netlist, source: &Source) -> String {
    text(netlist, source, DEPTH)
}

fn text(netlist: &Netlist, source: &Source, depth: u32) -> String {
    match source {
        Source::Input(i) => netlist.inputs.get(*i).map_or_else(|| "input".into(), |input| input.name.clone()),
        Source::Constant { name: Some(name), .. } => name.clone(),
        Source::Constant { value, .. } => value.to_string(),
        Source::Wire(i) => netlist.wires[*i].name.clone(),
        Source::Register(i) => netlist.registers[*i].name.clone(),
        Source::MemoryRead { memory, port } => netlist.memories[*memory].reads[*port].name.clone(),
        Source::InstanceOutput { instance, output } => {
            let instance = &netlist.instances[*instance];
            format!("{}.{}", instance.name, instance.module.outputs[*output].name)
        }
        Source::Op(op, _) if depth == 0 => format!("{op:?}(..)"),
        Source::Op(op, operands) => {
            let of = |id: &NodeId| text(netlist, &netlist.node(*id).source, depth - 1);
            let operands: Vec<String> = operands.iter().map(of).collect();
            format!("{op:?}({})", operands.join(", "))
        }
    }
}
