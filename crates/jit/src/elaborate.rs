//! Dissolves the hierarchy: a module and its instances become one graph. Wires and ports become names of a value; a value that
//! nothing reads is left out.

use std::collections::BTreeMap;

use edgewalk_netlist::netlist::{Instance, Source};
use edgewalk_netlist::{Netlist, NodeId};

use crate::design::{Design, Memory, Read, Register, Write};
use crate::graph::{Graph, ValueId};

/// Takes the hierarchy apart.
pub(crate) fn elaborate(netlist: &Netlist) -> Design {
    let mut graph = Graph::default();
    let reset = graph.stored(1);
    let design = Design {
        graph,
        inputs: BTreeMap::new(),
        reset,
        outputs: Vec::new(),
        registers: Vec::new(),
        memories: Vec::new(),
        runners: Vec::new(),
        signals: BTreeMap::new(),
    };
    let mut elaboration = Elaboration { design, scopes: Vec::new() };
    elaboration.open(netlist, String::new(), None);
    for scope in 0..elaboration.scopes.len() {
        elaboration.state(scope);
        elaboration.names(scope, reset);
    }
    for input in &netlist.inputs {
        let value = elaboration.value(0, input.node);
        elaboration.design.inputs.insert(input.name.clone(), value);
    }
    if netlist.has_reset {
        elaboration.design.inputs.insert("rst".to_owned(), reset);
    }
    for output in &netlist.outputs {
        let value = elaboration.value(0, output.driver);
        elaboration.design.outputs.push((output.name.clone(), value));
    }
    elaboration.design
}

struct Elaboration<'n> {
    design: Design,
    scopes: Vec<Scope<'n>>,
}

/// A module in its place.
struct Scope<'n> {
    netlist: &'n Netlist,
    /// `instance.instance.`
    prefix: String,
    /// The scope that has it, and what is connected there.
    parent: Option<(usize, &'n Instance)>,
    /// The scope of each of its instances.
    children: Vec<usize>,
    /// By node, as far as they are known.
    values: Vec<Option<ValueId>>,
}

impl<'n> Elaboration<'n> {
    /// Makes the scopes of a module and its instances, with the values that are computed from nothing.
    fn open(&mut self, netlist: &'n Netlist, prefix: String, parent: Option<(usize, &'n Instance)>) -> usize {
        let index = self.scopes.len();
        let graph = &mut self.design.graph;
        let own = netlist.nodes.iter().map(|node| match &node.source {
            Source::Constant { value, .. } => Some(graph.constant(node.width, *value)),
            Source::Register(_) | Source::MemoryRead { .. } => Some(graph.stored(node.width)),
            Source::Input(_) if parent.is_none() => Some(graph.stored(node.width)),
            _ => None,
        });
        let values = own.collect();
        self.scopes.push(Scope { netlist, prefix: prefix.clone(), parent, children: Vec::new(), values });
        for instance in &netlist.instances {
            let child =
                self.open(&instance.module, format!("{prefix}{}.", instance.name), Some((index, instance)));
            self.scopes[index].children.push(child);
        }
        index
    }

    /// The node of which this one is another name.
    fn alias(&self, scope: usize, node: NodeId) -> Option<(usize, NodeId)> {
        let Scope { netlist, parent, children, .. } = &self.scopes[scope];
        match &netlist.node(node).source {
            Source::Input(port) => parent.map(|(scope, instance)| (scope, instance.connections[*port])),
            Source::Wire(wire) => Some((scope, netlist.wires[*wire].driver)),
            Source::InstanceOutput { instance, output } => {
                let driver = netlist.instances[*instance].module.outputs[*output].driver;
                Some((children[*instance], driver))
            }
            _ => None,
        }
    }

    /// The value of a node. Depth first with its own stack: a chain of operators can be long.
    fn value(&mut self, scope: usize, node: NodeId) -> ValueId {
        let mut stack = vec![(scope, node)];
        loop {
            // The stack has an entry until the node that was asked for is known.
            let &(at, id) = &stack[stack.len() - 1];
            let found = self.known(at, id).or_else(|| self.compute(at, id, &mut stack));
            if let Some(value) = found {
                self.scopes[at].values[id.index()] = Some(value);
                stack.pop();
                if stack.is_empty() {
                    return value;
                }
            }
        }
    }

    fn known(&self, scope: usize, node: NodeId) -> Option<ValueId> {
        self.scopes[scope].values[node.index()]
    }

    /// The value, if all it needs is known; else what it needs goes on the stack.
    fn compute(&mut self, scope: usize, node: NodeId, stack: &mut Vec<(usize, NodeId)>) -> Option<ValueId> {
        if let Some((of_scope, of)) = self.alias(scope, node) {
            let known = self.known(of_scope, of);
            if known.is_none() {
                stack.push((of_scope, of));
            }
            return known;
        }
        let netlist = self.scopes[scope].netlist;
        let Source::Op(op, operands) = &netlist.node(node).source else {
            return None; // the others are known from the start
        };
        let values: Option<Vec<ValueId>> =
            operands.iter().map(|operand| self.known(scope, *operand)).collect();
        if values.is_none() {
            let missing = operands.iter().filter(|operand| self.known(scope, **operand).is_none());
            stack.extend(missing.map(|operand| (scope, *operand)));
        }
        Some(self.design.graph.op(*op, netlist.width(node), &values?))
    }

    /// The instance of the top module in which a scope lies, from 1; 0 for the top module.
    fn unit(&self, mut scope: usize) -> usize {
        while let Some((parent, _)) = self.scopes[scope].parent {
            if parent == 0 {
                return self.scopes[0].children.iter().position(|child| *child == scope).map_or(0, |i| i + 1);
            }
            scope = parent;
        }
        0
    }

    fn state(&mut self, scope: usize) {
        let unit = self.unit(scope);
        let netlist = self.scopes[scope].netlist;
        for register in &netlist.registers {
            let updates = register.updates.iter().map(|update| {
                (update.when.map(|when| self.value(scope, when)), self.value(scope, update.value))
            });
            let updates = updates.collect();
            let q = self.value(scope, register.node);
            self.design.registers.push(Register { unit, q, reset: register.reset, updates });
        }
        for memory in &netlist.memories {
            let writes = memory.writes.iter().map(|port| Write {
                en: self.value(scope, port.en),
                addr: self.value(scope, port.addr),
                data: self.value(scope, port.data),
            });
            let writes = writes.collect();
            let reads = memory.reads.iter().map(|port| Read {
                en: self.value(scope, port.en),
                addr: self.value(scope, port.addr),
                q: self.value(scope, port.node),
            });
            let reads = reads.collect();
            self.design.memories.push(Memory {
                unit,
                path: format!("{}{}", self.scopes[scope].prefix, memory.name),
                words: memory.words,
                width: memory.width,
                contents: memory.contents.clone(),
                writes,
                reads,
            });
        }
    }

    fn names(&mut self, scope: usize, reset: ValueId) {
        let netlist = self.scopes[scope].netlist;
        let mut named: Vec<(String, NodeId)> = Vec::new();
        named.extend(netlist.inputs.iter().map(|input| (input.name.clone(), input.node)));
        named.extend(netlist.outputs.iter().map(|output| (output.name.clone(), output.driver)));
        named.extend(netlist.wires.iter().map(|wire| (wire.name.clone(), wire.node)));
        named.extend(netlist.registers.iter().map(|register| (register.name.clone(), register.node)));
        let reads = netlist.memories.iter().flat_map(|memory| &memory.reads);
        named.extend(reads.map(|read| (read.name.clone(), read.node)));
        let instance_outputs =
            netlist.instances.iter().flat_map(|instance| instance.outputs.iter().flatten());
        named.extend(instance_outputs.filter_map(|node| Some((netlist.name_of(*node)?, *node))));
        for (name, node) in named {
            let value = self.value(scope, node);
            self.name(scope, &name, value);
        }
        for node in &netlist.nodes {
            if let Source::Constant { value, name: Some(name) } = &node.source {
                let value = self.design.graph.constant(node.width, *value);
                self.name(scope, name, value);
            }
        }
        if netlist.has_reset {
            self.name(scope, "rst", reset);
        }
    }

    fn name(&mut self, scope: usize, name: &str, value: ValueId) {
        self.design.signals.insert(format!("{}{name}", self.scopes[scope].prefix), value);
    }
}
