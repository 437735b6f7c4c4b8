//! Which inputs an output depends on without a register between; finds combinational loops on the way.

use std::collections::BTreeSet;

use crate::netlist::{Netlist, NodeId, Source};

/// For each output the inputs it depends on, or the names around a loop.
pub(super) fn of_outputs(netlist: &Netlist) -> Result<Vec<Vec<usize>>, Vec<String>> {
    let order = order(netlist)?;
    let mut inputs: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); netlist.nodes.len()];
    for id in order {
        let mut of: BTreeSet<usize> =
            dependencies(netlist, id).iter().flat_map(|from| inputs[from.index()].iter().copied()).collect();
        if let Source::Input(port) = netlist.node(id).source {
            of.insert(port);
        }
        inputs[id.index()] = of;
    }
    Ok(netlist.outputs.iter().map(|output| inputs[output.driver.index()].iter().copied().collect()).collect())
}

/// What a node depends on in the same cycle.
fn dependencies(netlist: &Netlist, id: NodeId) -> Vec<NodeId> {
    match &netlist.node(id).source {
        Source::Op(_, operands) => operands.clone(),
        Source::Wire(i) => vec![netlist.wires[*i].driver],
        Source::InstanceOutput { instance, output } => {
            let instance = &netlist.instances[*instance];
            instance.module.paths[*output].iter().map(|input| instance.connections[*input]).collect()
        }
        Source::Input(_) | Source::Constant { .. } | Source::Register(_) | Source::MemoryRead { .. } => {
            Vec::new()
        }
    }
}

/// All nodes, each after those it depends on.
fn order(netlist: &Netlist) -> Result<Vec<NodeId>, Vec<String>> {
    #[derive(Clone, Copy, PartialEq)]
    enum Mark {
        New,
        Open,
        Done,
    }
    let mut marks = vec![Mark::New; netlist.nodes.len()];
    let mut order = Vec::with_capacity(netlist.nodes.len());
    for start in (0..netlist.nodes.len() as u32).map(NodeId) {
        // Depth first with its own stack: a node and the dependencies still to visit.
        let mut stack = Vec::new();
        if marks[start.index()] == Mark::New {
            marks[start.index()] = Mark::Open;
            stack.push((start, dependencies(netlist, start)));
        }
        while let Some((id, left)) = stack.last_mut() {
            match left.pop() {
                Some(next) if marks[next.index()] == Mark::New => {
                    marks[next.index()] = Mark::Open;
                    stack.push((next, dependencies(netlist, next)));
                }
                Some(next) if marks[next.index()] == Mark::Open => {
                    let open: Vec<NodeId> = stack.iter().map(|(id, _)| *id).collect();
                    return Err(around(netlist, &open, next));
                }
                Some(_) => {}
                None => {
                    marks[id.index()] = Mark::Done;
                    order.push(*id);
                    stack.pop();
                }
            }
        }
    }
    Ok(order)
}

/// The names around the loop that ends at `closing`, in the direction the signals flow, from the one declared first.
fn around(netlist: &Netlist, open: &[NodeId], closing: NodeId) -> Vec<String> {
    let from = open.iter().position(|id| *id == closing).unwrap_or(0);
    let mut nodes: Vec<NodeId> = open[from..].iter().rev().copied().collect();
    let first = nodes.iter().enumerate().min_by_key(|(_, id)| **id).map_or(0, |(place, _)| place);
    nodes.rotate_left(first);
    let mut path: Vec<String> = nodes.iter().filter_map(|id| loop_name(netlist, *id)).collect();
    path.extend(path.first().cloned());
    path
}

/// The loop passes an unnamed operator without a word.
fn loop_name(netlist: &Netlist, id: NodeId) -> Option<String> {
    match &netlist.node(id).source {
        Source::InstanceOutput { instance, output } => {
            let instance = &netlist.instances[*instance];
            Some(format!("{}.{}", instance.name, instance.module.outputs[*output].name))
        }
        _ => netlist.name_of(id),
    }
}
