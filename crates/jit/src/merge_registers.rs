//! Merges registers that are equal in every clock: those of a unit that begin alike and take the same values
//! under the same conditions, as lanes side by side have them. All registers of a unit that begin alike are
//! taken to be equal, and split where they do not take the same values. So registers that follow from each
//! other are found too.

use std::collections::HashMap;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};

use crate::design::{Design, Memory, Read, Register, Write};
use crate::graph::{Graph, Kind, ValueId};

/// The design with each of them only once.
pub(crate) fn merge_registers(design: Design) -> Design {
    let equals = equals(&design);
    without(&design, &equals).unwrap_or(design)
}

/// Of each register that seems equal to one with a lower number, that one.
fn equals(design: &Design) -> HashMap<ValueId, ValueId> {
    let Design { graph, registers, .. } = design;
    let own: Vec<u64> = graph.ids().map(|id| own_hash(graph, id)).collect();
    let first = |Register { unit, q, reset, .. }: &Register| hash((unit, graph.width(*q), reset));
    let mut kinds: Vec<u64> = registers.iter().map(first).collect();
    let mut count = 0;
    loop {
        let found = by_kind(registers, &kinds);
        if found.len() == count {
            return others(registers, &kinds);
        }
        count = found.len();
        let hashes = hashes(design, &own, &kinds);
        let next = |(register, kind): (&Register, &u64)| {
            let updates = register.updates.iter();
            let updates =
                updates.map(|(when, value)| (when.map(|when| hashes[when.index()]), hashes[value.index()]));
            hash((kind, updates.collect::<Vec<_>>()))
        };
        kinds = registers.iter().zip(&kinds).map(next).collect();
    }
}

/// The lowest register of each kind.
fn by_kind(registers: &[Register], kinds: &[u64]) -> HashMap<u64, ValueId> {
    let mut first = HashMap::new();
    for (register, kind) in registers.iter().zip(kinds) {
        first
            .entry(*kind)
            .and_modify(|lowest: &mut ValueId| *lowest = register.q.min(*lowest))
            .or_insert(register.q);
    }
    first
}

fn others(registers: &[Register], kinds: &[u64]) -> HashMap<ValueId, ValueId> {
    let first = by_kind(registers, kinds);
    let of_each = registers.iter().zip(kinds).map(|(register, kind)| (register.q, first[kind]));
    of_each.filter(|(q, other)| q != other).collect()
}

/// Like `others`, for values that come from the same if registers of a kind are equal.
fn hashes(design: &Design, own: &[u64], kinds: &[u64]) -> Vec<u64> {
    let mut hashes = own.to_vec();
    for (register, kind) in design.registers.iter().zip(kinds) {
        hashes[register.q.index()] = *kind;
    }
    for id in design.graph.ids() {
        for operand in design.graph.operands(id) {
            let mixed = (hashes[id.index()].rotate_left(23) ^ hashes[operand.index()])
                .wrapping_mul(0x9e37_79b9_7f4a_7c15);
            hashes[id.index()] = mixed ^ mixed >> 32;
        }
    }
    hashes
}

/// Of a value without its operands.
fn own_hash(graph: &Graph, id: ValueId) -> u64 {
    let width = graph.width(id);
    match graph.kind(id) {
        Kind::Stored => hash((0, id)),
        Kind::Constant(value) => hash((1, width, value)),
        Kind::Op(op, _) => hash((2, width, op)),
    }
}

fn hash(of: impl std::hash::Hash) -> u64 {
    BuildHasherDefault::<DefaultHasher>::default().hash_one(of)
}

/// The others take the place of these registers: none, if one of them then takes something else than the
/// other, which only hashes that are the same by chance can bring about.
fn without(design: &Design, equals: &HashMap<ValueId, ValueId>) -> Option<Design> {
    let before = &design.graph;
    let mut graph = Graph::default();
    let mut now: Vec<ValueId> = Vec::with_capacity(before.len());
    for id in before.ids() {
        let width = before.width(id);
        now.push(match (before.kind(id), equals.get(&id)) {
            (_, Some(other)) => now[other.index()],
            (Kind::Stored, None) => graph.stored(width),
            (Kind::Constant(value), None) => graph.constant(width, *value),
            (Kind::Op(op, operands), None) => {
                let operands: Vec<ValueId> = operands.iter().map(|operand| now[operand.index()]).collect();
                graph.op(*op, width, &operands)
            }
        });
    }
    let renewed = |value: ValueId| now[value.index()];
    let mut registers: Vec<Register> = Vec::new();
    let mut places = HashMap::new();
    for Register { unit, q, reset, updates } in &design.registers {
        let updates = updates.iter().map(|(when, value)| (when.map(renewed), renewed(*value))).collect();
        let register = Register { unit: *unit, q: renewed(*q), reset: *reset, updates };
        match places.get(&register.q) {
            Some(place) if registers[*place] != register => return None,
            Some(_) => {}
            None => {
                places.insert(register.q, registers.len());
                registers.push(register);
            }
        }
    }
    let write = |Write { en, addr, data }: &Write| Write {
        en: renewed(*en),
        addr: renewed(*addr),
        data: renewed(*data),
    };
    let read = |Read { en, addr, q }: &Read| Read { en: renewed(*en), addr: renewed(*addr), q: renewed(*q) };
    let memories = design.memories.iter().map(|memory| Memory {
        writes: memory.writes.iter().map(write).collect(),
        reads: memory.reads.iter().map(read).collect(),
        path: memory.path.clone(),
        contents: memory.contents.clone(),
        ..*memory
    });
    let named = |(name, value): (&String, &ValueId)| (name.clone(), renewed(*value));
    Some(Design {
        inputs: design.inputs.iter().map(named).collect(),
        reset: renewed(design.reset),
        outputs: design.outputs.iter().map(|(name, value)| (name.clone(), renewed(*value))).collect(),
        registers,
        memories: memories.collect(),
        runners: Vec::new(),
        signals: design.signals.iter().map(named).collect(),
        graph,
    })
}
