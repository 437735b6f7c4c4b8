//! Parts of a netlist cut out for the prover: what they give is an input then, and what they take an output.

use edgewalk_netlist::netlist::{
    Input, Item, Memory, MemoryRead, Node, NodeId, Output, Register, Source, Update,
};
use edgewalk_netlist::{Netlist, Op};
use std::sync::Arc;

/// The module of this name without what it is made of: outputs of its instances are inputs, and the other way round.
pub fn alone(netlist: &Arc<Netlist>, module: &str) -> Arc<Netlist> {
    let modules = netlist.modules();
    let found = modules.iter().find(|found| found.name == module).expect("the fault is in one of them");
    let mut alone = Netlist::clone(found);
    for instance in std::mem::take(&mut alone.instances) {
        for (output, node) in instance.module.outputs.iter().zip(&instance.outputs) {
            if let Some(node) = *node {
                let name = format!("{}_{}", instance.name, output.name);
                alone.nodes[node.index()].source = Source::Input(alone.inputs.len());
                alone.inputs.push(Input { name, doc: String::new(), node });
            }
        }
        for (input, driver) in instance.module.inputs.iter().zip(instance.connections) {
            let name = format!("{}_in_{}", instance.name, input.name);
            alone.outputs.push(Output { name, doc: String::new(), driver });
        }
    }
    alone.items.retain(|item| !matches!(item, Item::Instance(_) | Item::InstanceOutput(_)));
    alone.has_clock = !alone.registers.is_empty();
    alone.has_reset = alone.registers.iter().any(|register| register.reset.is_some());
    Arc::new(alone)
}

/// A module without its memories: what they give are inputs, and what they take outputs. A ROM is a case over its address.
pub fn without_memories(netlist: &Arc<Netlist>) -> Arc<Netlist> {
    let mut alone = Netlist::clone(netlist);
    for (index, memory) in std::mem::take(&mut alone.memories).into_iter().enumerate() {
        if memory.writes.is_empty() {
            memory.reads.iter().enumerate().for_each(|(port, read)| {
                read_case(&mut alone, &memory, read, Item::MemoryRead { memory: index, port })
            });
            continue;
        }
        let mut output =
            |name: String, driver| alone.outputs.push(Output { name, doc: String::new(), driver });
        for (port, write) in memory.writes.iter().enumerate() {
            for (what, node) in [("en", write.en), ("addr", write.addr), ("data", write.data)] {
                output(format!("{}_write{port}_{what}", memory.name), node);
            }
        }
        for (port, read) in memory.reads.iter().enumerate() {
            for (what, node) in [("en", read.en), ("addr", read.addr)] {
                output(format!("{}_read{port}_{what}", memory.name), node);
            }
        }
        for read in memory.reads {
            alone.nodes[read.node.index()].source = Source::Input(alone.inputs.len());
            let name = format!("{}_given", read.name);
            alone.inputs.push(Input { name, doc: String::new(), node: read.node });
        }
    }
    let of_memory =
        |item: &Item| matches!(item, Item::Memory(_) | Item::MemoryWrite { .. } | Item::MemoryRead { .. });
    alone.items.retain(|item| !of_memory(item));
    alone.has_clock = !alone.registers.is_empty();
    Arc::new(alone)
}

/// The output of a ROM as a register that takes a case over the address; its items stand in place of the port's.
fn read_case(netlist: &mut Netlist, rom: &Memory, read: &MemoryRead, item: Item) {
    let mut value = pushed(netlist, rom.width, Source::Constant { value: 0, name: None });
    for address in 0..rom.words {
        let word = Source::Constant { value: rom.contents.word(rom.width, address), name: None };
        let word = pushed(netlist, rom.width, word);
        let place = Source::Constant { value: address as u128, name: None };
        let place = pushed(netlist, rom.addr_bits, place);
        let here = pushed(netlist, 1, Source::Op(Op::Eq, vec![read.addr, place]));
        value = mux(netlist, here, word, value);
    }
    let register = netlist.registers.len();
    netlist.registers.push(Register {
        name: read.name.clone(),
        doc: String::new(),
        node: read.node,
        reset: None,
        starts_at_zero: false,
        updates: vec![Update { when: Some(read.en), value }],
    });
    netlist.nodes[read.node.index()].source = Source::Register(register);
    let items = netlist.items.iter().flat_map(|found| match *found == item {
        true => vec![Item::Register(register), Item::Update(register)],
        false => vec![found.clone()],
    });
    netlist.items = items.collect();
}

/// A module without instances and memories in one clock: what registers hold are inputs, and what they will hold are outputs.
pub fn one_clock(netlist: &Arc<Netlist>) -> Arc<Netlist> {
    let mut alone = Netlist::clone(netlist);
    let input = |alone: &mut Netlist, name: String, node: NodeId| {
        alone.nodes[node.index()].source = Source::Input(alone.inputs.len());
        alone.inputs.push(Input { name, doc: String::new(), node });
    };
    // There even without a register that has one: a fault may take the only one away.
    let reset = pushed(&mut alone, 1, Source::Input(0));
    input(&mut alone, "reset_now".to_owned(), reset);
    for register in std::mem::take(&mut alone.registers) {
        let (q, width) = (register.node, alone.width(register.node));
        // By another name: that of a register may be an output's too.
        input(&mut alone, format!("held_{}", register.name), q);
        let mut next = q;
        for update in register.updates {
            next = update.when.map_or(update.value, |when| mux(&mut alone, when, update.value, next));
        }
        if let Some(value) = register.reset {
            let value = pushed(&mut alone, width, Source::Constant { value, name: None });
            next = mux(&mut alone, reset, value, next);
        }
        alone.outputs.push(Output {
            name: format!("clocked_{}", register.name),
            doc: String::new(),
            driver: next,
        });
    }
    alone.items.retain(|item| matches!(item, Item::Wire(_) | Item::Drive(_) | Item::Constant(_)));
    (alone.has_clock, alone.has_reset) = (false, false);
    Arc::new(alone)
}

fn mux(netlist: &mut Netlist, condition: NodeId, then: NodeId, otherwise: NodeId) -> NodeId {
    pushed(netlist, netlist.width(then), Source::Op(Op::Mux, vec![condition, then, otherwise]))
}

fn pushed(netlist: &mut Netlist, width: u32, source: Source) -> NodeId {
    netlist.nodes.push(Node { width, source });
    netlist.ids().last().expect("it was just added")
}
