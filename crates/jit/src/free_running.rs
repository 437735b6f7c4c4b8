//! Registers that get a unit of their own, so that a unit can stand still without them, or they without it.
//!
//! A **free-running** register, or runner, is a counter that nothing holds: the value that it takes when
//! nothing else is asked for follows from itself alone. It would keep its unit awake in every clock, though
//! most of the time the unit does not see it. For there is a bit, its **mask**, such that nothing else in the
//! unit follows from the runner while the mask is 0. All runners are one unit, which always works. They wake
//! their own unit only while the mask is 1.
//!
//! **Calm** registers are stored in every clock too. But they follow only from each other and from registers
//! of the unit that are loaded now and then, such as differences of corners that stay while a triangle is set
//! up.

use std::collections::BTreeSet;

use edgewalk_netlist::Op;

use crate::design::{Design, Register, Runner};
use crate::effect::{Set, unite};
use crate::graph::{Graph, Kind, ValueId};
use crate::order::Readers;

/// So many operators must rest with calm registers: a unit has to be woken, counted and asked for.
const LEAST: usize = 16;

/// The design with them in units of their own.
pub(crate) fn free_running(mut design: Design) -> Design {
    let readers = Readers::of(&design, &[]);
    let nodes: Vec<Node> =
        design.registers.iter().map(|register| Node::of(&design, &readers, register)).collect();
    let runners: Vec<(usize, ValueId)> =
        (0..nodes.len()).filter_map(|at| Some((at, mask_of(&design, &nodes, at)?))).collect();
    let calm = calm(&design, &readers, &nodes);
    let of_memories = design.memories.iter().map(|memory| memory.unit);
    let units = of_memories.chain(design.registers.iter().map(|register| register.unit)).max();
    let mut unit = units.map_or(0, |last| last + 1);
    for (at, mask) in runners {
        let register = &mut design.registers[at];
        design.runners.push(Runner { q: register.q, sees: register.unit, mask });
        register.unit = unit;
    }
    for registers in calm {
        unit += 1;
        registers.into_iter().for_each(|at| design.registers[at].unit = unit);
    }
    design
}

/// What a register follows from.
struct Node {
    unit: usize,
    q: ValueId,
    width: u32,
    number: usize,
    reads: Set,
    /// The register is stored in every clock.
    always: bool,
    /// What it takes if no condition holds follows from itself alone.
    runs: bool,
}

impl Node {
    fn of(design: &Design, readers: &Readers, register: &Register) -> Node {
        let graph = &design.graph;
        let mut reads = readers.none();
        for (when, value) in &register.updates {
            when.iter().chain([value]).for_each(|value| unite(&mut reads, readers.cone(*value)));
        }
        let is_always = |when: &Option<ValueId>| when.is_none_or(|when| graph.as_constant(when) == Some(1));
        let always = register.updates.iter().rev().find(|(when, _)| is_always(when)).map(|(_, value)| *value);
        Node {
            unit: register.unit,
            q: register.q,
            width: graph.width(register.q),
            number: readers.number(register.q).unwrap_or(0),
            reads,
            always: always.is_some(),
            runs: always
                .is_some_and(|value| value != register.q && readers.cone(value) == readers.cone(register.q)),
        }
    }

    fn reads(&self, other: &Node) -> bool {
        self.reads[other.number / 64] >> (other.number % 64) & 1 == 1
    }
}

/// The mask of a runner.
fn mask_of(design: &Design, nodes: &[Node], at: usize) -> Option<ValueId> {
    let runner = &nodes[at];
    if !runner.runs {
        return None;
    }
    let own = || nodes.iter().enumerate().filter(|(other, node)| node.unit == runner.unit && *other != at);
    let seeing: Vec<&Node> = own().map(|(_, node)| node).filter(|node| node.reads(runner)).collect();
    let bits = own().map(|(_, node)| node).filter(|node| node.width == 1);
    let asked = |bit: &&Node| seeing.iter().all(|node| node.q == bit.q || node.reads(bit));
    bits.filter(asked).map(|bit| bit.q).find(|mask| is_masked(design, runner, *mask))
}

/// Whether nothing else of its unit follows from a runner while the mask is 0.
fn is_masked(design: &Design, runner: &Node, mask: ValueId) -> bool {
    let graph = &design.graph;
    let seen = seen(graph, runner.q, mask);
    let is_off = |bit: ValueId| seen[bit.index()] == Seen::Bit(false);
    let sees = |value: ValueId| seen[value.index()] == Seen::Runner;
    let registers =
        design.registers.iter().filter(|register| register.unit == runner.unit && register.q != runner.q);
    let register_is_masked = |register: &Register| {
        // That the mask becomes 0 changes nothing as long as nothing weaker would make it 1.
        let mut stays = register.q == mask;
        register.updates.iter().all(|(when, value)| {
            if when.is_some_and(is_off) {
                return true;
            }
            stays &= graph.as_constant(*value) == Some(0);
            stays || !(when.is_some_and(sees) || sees(*value))
        })
    };
    let memories = || design.memories.iter().filter(|memory| memory.unit == runner.unit);
    let writes = memories().flat_map(|memory| &memory.writes);
    let writes = writes.map(|port| (port.en, vec![port.addr, port.data]));
    let reads = memories().flat_map(|memory| &memory.reads).map(|port| (port.en, vec![port.addr]));
    registers.into_iter().all(register_is_masked)
        && writes.chain(reads).all(|(en, others)| is_off(en) || !(sees(en) || others.into_iter().any(sees)))
}

/// What a value is while the mask is 0.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Seen {
    /// The value follows from something else than the runner.
    Other,
    /// Always this.
    Bit(bool),
    /// The value may follow from the runner.
    Runner,
}

fn seen(graph: &Graph, runner: ValueId, mask: ValueId) -> Vec<Seen> {
    let mut seen: Vec<Seen> = Vec::with_capacity(graph.len());
    for id in graph.ids() {
        let of = |operand: ValueId| seen[operand.index()];
        let operands = graph.operands(id);
        let any = || {
            if operands.iter().any(|operand| of(*operand) == Seen::Runner) {
                Seen::Runner
            } else {
                Seen::Other
            }
        };
        seen.push(match graph.kind(id) {
            _ if id == runner => Seen::Runner,
            _ if id == mask => Seen::Bit(false),
            Kind::Constant(bit) if graph.width(id) == 1 => Seen::Bit(*bit == 1),
            Kind::Op(Op::And, operands)
                if operands.iter().any(|operand| of(*operand) == Seen::Bit(false)) =>
            {
                Seen::Bit(false)
            }
            Kind::Op(Op::Or, operands) if operands.iter().any(|operand| of(*operand) == Seen::Bit(true)) => {
                Seen::Bit(true)
            }
            Kind::Op(Op::Not, operands) => match of(operands[0]) {
                Seen::Bit(bit) => Seen::Bit(!bit),
                other => other,
            },
            Kind::Op(Op::Mux, operands) => match of(operands[0]) {
                Seen::Bit(true) => of(operands[1]),
                Seen::Bit(false) => of(operands[2]),
                _ => any(),
            },
            _ => any(),
        });
    }
    seen
}

/// Of each unit the calm registers, if they are worth it.
fn calm(design: &Design, readers: &Readers, nodes: &[Node]) -> Vec<Vec<usize>> {
    let units: BTreeSet<usize> = nodes.iter().map(|node| node.unit).collect();
    let of_unit = |unit: usize| {
        let own =
            || (0..nodes.len()).filter(move |at| nodes[*at].unit == unit && !nodes[*at].reads(&nodes[*at]));
        let mut calm: Vec<usize> = own().filter(|at| nodes[*at].always).collect();
        let mut sources = readers.none();
        own().for_each(|at| sources[nodes[at].number / 64] |= 1 << (nodes[at].number % 64));
        loop {
            let (stay, leave): (Vec<usize>, Vec<usize>) = calm.iter().partition(|at| {
                nodes[**at].reads.iter().zip(&sources).all(|(reads, sources)| reads & !sources == 0)
            });
            if leave.is_empty() {
                return calm;
            }
            leave.iter().for_each(|at| sources[nodes[*at].number / 64] &= !(1 << (nodes[*at].number % 64)));
            calm = stay;
        }
    };
    units.into_iter().map(of_unit).filter(|calm| operators(design, calm) >= LEAST).collect()
}

/// All that these registers follow from within a clock.
fn operators(design: &Design, registers: &[usize]) -> usize {
    let graph = &design.graph;
    let updates = registers.iter().flat_map(|at| &design.registers[*at].updates);
    let mut open: Vec<ValueId> =
        updates.flat_map(|(when, value)| when.iter().chain([value])).copied().collect();
    let mut seen = BTreeSet::new();
    while let Some(value) = open.pop() {
        if matches!(graph.kind(value), Kind::Op(..)) && seen.insert(value) {
            open.extend(graph.operands(value));
        }
    }
    seen.len()
}
