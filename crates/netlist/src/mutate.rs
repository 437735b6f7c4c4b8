//! Mutants: netlists with a single fault, to try a test suite before trusting it.
//!
//! A mutant changes one place of one module, wherever that module is used. None of them makes a combinational loop or
//! changes a width. Some are equivalent to the original (a `<` whose sides are never equal): that is for the suite's
//! author to prove.

use std::collections::HashMap;
use std::sync::Arc;

use crate::describe::describe;
use crate::netlist::{Item, Netlist, Node, NodeId, Output, Source, Update};
use crate::ops::{Op, mask};

/// A single fault.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// The module it is in.
    pub module: String,
    /// What was changed, in words.
    pub description: String,
    change: Change,
}

/// A change of one place of a module.
#[derive(Clone, Debug)]
enum Change {
    /// The source of a node.
    Source(NodeId, Source),
    /// The condition of update `update` of a register is always 1.
    AlwaysUpdate { register: usize, update: usize },
    /// One update never happens; the register has others.
    NeverUpdate { register: usize, update: usize },
    /// The reset value of a register, or none.
    Reset(usize, Option<u128>),
    /// Every word of a memory that has no contents of its own, at the start.
    Others(usize, u128),
    /// The word at an address of a memory, at the start.
    Row { memory: usize, address: usize, word: u128 },
    /// Two inputs of an instance are exchanged.
    Exchange { instance: usize, inputs: [usize; 2] },
}

/// All mutants of a netlist and of every module in it, those of the innermost first.
pub fn mutants(netlist: &Arc<Netlist>) -> Vec<Mutant> {
    let of = |module: &Arc<Netlist>| {
        let changes = operators(module).into_iter().chain(registers(module));
        let changes = changes.chain(contents(module)).chain(exchanges(module));
        let name = module.name.clone();
        let mutant = move |(description, change)| Mutant { module: name.clone(), description, change };
        changes.map(mutant).collect::<Vec<_>>()
    };
    netlist.modules().iter().flat_map(of).collect()
}

impl Mutant {
    /// The netlist with this fault; it must be the one the mutant was made for.
    pub fn apply(&self, netlist: &Arc<Netlist>) -> Arc<Netlist> {
        rebuilt(netlist, |module| {
            if module.name == self.module {
                self.change.apply(module);
            }
        })
    }

    /// The netlist without the fault and with one more output, [`DIFFERS`]: 1 in the cycles in which the fault would change
    /// what it is in, the value of a node or what a register takes. Where that is never 1 the fault changes nothing at all.
    /// `None` for faults that are nothing of the kind.
    pub fn watched(&self, netlist: &Arc<Netlist>) -> Option<Arc<Netlist>> {
        let mut seen = false;
        let watched = rebuilt(netlist, |module| {
            let mut places = Vec::new();
            if module.name == self.module {
                places.extend(self.change.differs(module));
                seen = !places.is_empty();
            }
            for instance in 0..module.instances.len() {
                places.extend(watched_output(module, instance));
            }
            let one = |m: &mut Netlist, a, b| pushed(m, 1, Source::Op(Op::Or, vec![a, b]));
            if let Some(driver) = places.into_iter().reduce(|a, b| one(module, a, b)) {
                module.outputs.push(Output { name: DIFFERS.to_owned(), doc: String::new(), driver });
                module.paths.push(Vec::new());
            }
        });
        seen.then_some(watched)
    }
}

/// The output of a watched netlist.
pub const DIFFERS: &str = "fault_differs";

/// The netlist with every module changed, what each is made of first.
fn rebuilt(netlist: &Arc<Netlist>, mut change: impl FnMut(&mut Netlist)) -> Arc<Netlist> {
    let mut done: HashMap<String, Arc<Netlist>> = HashMap::new();
    for module in netlist.modules() {
        let mut changed = Netlist::clone(&module);
        for instance in &mut changed.instances {
            if let Some(part) = done.get(&instance.module.name) {
                instance.module = Arc::clone(part);
            }
        }
        change(&mut changed);
        done.insert(module.name.clone(), Arc::new(changed));
    }
    done.get(&netlist.name).map_or_else(|| Arc::clone(netlist), Arc::clone)
}

fn pushed(netlist: &mut Netlist, width: u32, source: Source) -> NodeId {
    netlist.nodes.push(Node { width, source });
    NodeId((netlist.nodes.len() - 1) as u32)
}

/// The node of an instance's output [`DIFFERS`], if its module has one.
fn watched_output(netlist: &mut Netlist, instance: usize) -> Option<NodeId> {
    let outputs = &netlist.instances[instance].module.outputs;
    let output = outputs.iter().position(|output| output.name == DIFFERS)?;
    let node = pushed(netlist, 1, Source::InstanceOutput { instance, output });
    netlist.instances[instance].outputs.push(Some(node));
    let place = netlist.items.iter().position(|item| *item == Item::Instance(instance))?;
    netlist.items.insert(place, Item::InstanceOutput(node));
    Some(node)
}

impl Change {
    fn apply(&self, netlist: &mut Netlist) {
        match self {
            Change::Source(id, source) => netlist.nodes[id.index()].source = source.clone(),
            Change::AlwaysUpdate { register, update } => {
                netlist.registers[*register].updates[*update].when = None;
            }
            Change::NeverUpdate { register, update } => {
                netlist.registers[*register].updates.remove(*update);
            }
            Change::Reset(register, value) => netlist.registers[*register].reset = *value,
            Change::Others(memory, value) => netlist.memories[*memory].contents.others = Some(*value),
            Change::Row { memory, address, word } => {
                let row = netlist.memories[*memory].contents.rows.get_mut(address);
                row.into_iter().for_each(|row| row.word = *word);
            }
            Change::Exchange { instance, inputs: [one, two] } => {
                netlist.instances[*instance].connections.swap(*one, *two);
            }
        }
    }

    /// A node that is 1 where the change would make a difference.
    fn differs(&self, netlist: &mut Netlist) -> Option<NodeId> {
        match self {
            Change::Source(id, source) => {
                let other = pushed(netlist, netlist.width(*id), source.clone());
                Some(pushed(netlist, 1, Source::Op(Op::Ne, vec![*id, other])))
            }
            // An update before it would be overruled too.
            Change::AlwaysUpdate { register, update: 0 } => {
                let register = &netlist.registers[*register];
                let (q, Update { when, value }) = (register.node, register.updates[0].clone());
                let stays = pushed(netlist, 1, Source::Op(Op::Not, vec![when?]));
                let other = pushed(netlist, 1, Source::Op(Op::Ne, vec![value, q]));
                Some(pushed(netlist, 1, Source::Op(Op::And, vec![stays, other])))
            }
            _ => None,
        }
    }
}

/// Another operator, other operands, another constant: of every node that something depends on.
fn operators(netlist: &Netlist) -> Vec<(String, Change)> {
    let mut found = Vec::new();
    for id in live(netlist) {
        let node = netlist.node(id);
        let text = describe(netlist, &node.source);
        match &node.source {
            Source::Constant { value, .. } => {
                let value = value.wrapping_add(1) & mask(node.width);
                let source = Source::Constant { value, name: None };
                let place = user(netlist, id).map_or(String::new(), |user| format!(" in `{user}`"));
                found.push((format!("`{text}` becomes `{value}`{place}"), Change::Source(id, source)));
            }
            Source::Op(op, operands) => {
                // Nothing is added on top: the two extensions are one.
                let same = matches!(op, Op::ZeroExtend(_) | Op::SignExtend(_))
                    && netlist.width(operands[0]) == node.width;
                for other in others(*op).into_iter().filter(|_| !same) {
                    found.push(becomes(netlist, id, &text, Source::Op(other, operands.clone())));
                }
                if let Some(exchanged) = exchanged(*op, operands) {
                    found.push(becomes(netlist, id, &text, Source::Op(*op, exchanged)));
                }
            }
            _ => {}
        }
    }
    found
}

fn becomes(netlist: &Netlist, id: NodeId, text: &str, source: Source) -> (String, Change) {
    (format!("`{text}` becomes `{}`", describe(netlist, &source)), Change::Source(id, source))
}

/// The first operator that a node goes into.
fn user(netlist: &Netlist, id: NodeId) -> Option<String> {
    let uses = |node: &&Node| matches!(&node.source, Source::Op(_, operands) if operands.contains(&id));
    netlist.nodes.iter().find(uses).map(|node| describe(netlist, &node.source))
}

/// What an operator is confused with: the same operands, the same width.
fn others(op: Op) -> Vec<Op> {
    use Op::*;
    match op {
        Add => vec![Sub],
        Sub => vec![Add],
        Mul => vec![MulSigned],
        MulSigned => vec![Mul],
        And => vec![Or],
        Or => vec![And, Xor],
        Xor => vec![Or],
        Eq => vec![Ne],
        Ne => vec![Eq],
        Lt => vec![Le, LtSigned],
        Le => vec![Lt, LeSigned],
        Gt => vec![Ge, GtSigned],
        Ge => vec![Gt, GeSigned],
        LtSigned => vec![LeSigned, Lt],
        LeSigned => vec![LtSigned, Le],
        GtSigned => vec![GeSigned, Gt],
        GeSigned => vec![GtSigned, Ge],
        Shl(n) => vec![Shl(n + 1)],
        Shr(n) => vec![Shr(n + 1)],
        Sar(n) => vec![Sar(n + 1), Shr(n)],
        SarBy => vec![ShrBy],
        ShrBy => vec![SarBy],
        ShlBy => vec![ShrBy],
        Slice { hi, lo } if lo > 0 => vec![Slice { hi: hi - 1, lo: lo - 1 }],
        SignExtend(w) => vec![ZeroExtend(w)],
        ZeroExtend(w) => vec![SignExtend(w)],
        Any => vec![All],
        All => vec![Any],
        Neg => vec![Not],
        Not => vec![Neg],
        Slice { .. } | Mux | Concat | Parity => vec![],
    }
}

/// The two operands the other way round, where that makes a difference.
fn exchanged(op: Op, operands: &[NodeId]) -> Option<Vec<NodeId>> {
    match (op, operands) {
        (Op::Mux, &[condition, then, otherwise]) => Some(vec![condition, otherwise, then]),
        (Op::Sub | Op::Lt | Op::Le | Op::LtSigned | Op::LeSigned, &[a, b]) => Some(vec![b, a]),
        _ => None,
    }
}

fn registers(netlist: &Netlist) -> Vec<(String, Change)> {
    let mut found = Vec::new();
    for (index, register) in netlist.registers.iter().enumerate() {
        let name = &register.name;
        for (update, one) in register.updates.iter().enumerate() {
            let Some(condition) = one.when else { continue };
            let condition = describe(netlist, &netlist.node(condition).source);
            let change = Change::AlwaysUpdate { register: index, update };
            found.push((format!("`{name}` is updated always instead of when `{condition}`"), change));
            if register.updates.len() > 1 {
                let change = Change::NeverUpdate { register: index, update };
                found.push((format!("`{name}` is never updated when `{condition}`"), change));
            }
        }
        if let Some(value) = register.reset {
            let other = value ^ 1;
            found.push((
                format!("`{name}` is reset to {other} instead of {value}"),
                Change::Reset(index, Some(other)),
            ));
            found.push((format!("`{name}` is not reset"), Change::Reset(index, None)));
        }
    }
    found
}

/// Another word in all of a memory, and another bit in each word that has contents of its own.
fn contents(netlist: &Netlist) -> Vec<(String, Change)> {
    let mut found = Vec::new();
    for (memory, of) in netlist.memories.iter().enumerate() {
        if let Some(word) = of.contents.others {
            let text = format!("`{}` starts with {} instead of {word}", of.name, word ^ 1);
            found.push((text, Change::Others(memory, word ^ 1)));
        }
        for (address, row) in &of.contents.rows {
            for bit in 0..of.width {
                let word = row.word ^ 1 << bit;
                let text = format!("bit {bit} of word {address} of `{}` is {}", of.name, word >> bit & 1);
                found.push((text, Change::Row { memory, address: *address, word }));
            }
        }
    }
    found
}

fn exchanges(netlist: &Netlist) -> Vec<(String, Change)> {
    let mut found = Vec::new();
    for (index, instance) in netlist.instances.iter().enumerate() {
        let module = &instance.module;
        // Only inputs with a register behind them: there is no loop to make.
        let held = |input: &usize| !module.paths.iter().flatten().any(|of| of == input);
        let held: Vec<usize> = (0..module.inputs.len()).filter(held).collect();
        let width = |input: usize| module.width(module.inputs[input].node);
        for (place, one) in held.iter().enumerate() {
            // The next input of the same width, not every pair.
            let Some(two) = held[place + 1..].iter().find(|two| width(**two) == width(*one)) else {
                continue;
            };
            let names = [one, two].map(|input| &module.inputs[*input].name);
            let text = format!("`{}` and `{}` of `{}` are exchanged", names[0], names[1], instance.name);
            found.push((text, Change::Exchange { instance: index, inputs: [*one, *two] }));
        }
    }
    found
}

/// The nodes that an output, a register, a memory or an instance depends on, in ascending order.
fn live(netlist: &Netlist) -> Vec<NodeId> {
    let mut todo: Vec<NodeId> = netlist.outputs.iter().map(|output| output.driver).collect();
    for update in netlist.registers.iter().flat_map(|register| &register.updates) {
        todo.extend(update.when);
        todo.push(update.value);
    }
    for memory in &netlist.memories {
        todo.extend(memory.writes.iter().flat_map(|port| [port.en, port.addr, port.data]));
        todo.extend(memory.reads.iter().flat_map(|port| [port.en, port.addr]));
    }
    todo.extend(netlist.instances.iter().flat_map(|instance| &instance.connections));
    let mut seen = vec![false; netlist.nodes.len()];
    while let Some(id) = todo.pop() {
        if std::mem::replace(&mut seen[id.index()], true) {
            continue;
        }
        match &netlist.node(id).source {
            Source::Op(_, operands) => todo.extend(operands),
            Source::Wire(wire) => todo.push(netlist.wires[*wire].driver),
            _ => {}
        }
    }
    netlist.ids().filter(|id| seen[id.index()]).collect()
}
