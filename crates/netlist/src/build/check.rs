//! What can only be seen when the whole module is there.

use std::sync::Arc;

use crate::error::Fault;
use crate::netlist::{Netlist, NodeId};

/// Registers, wires and instance inputs without a driver, with the name they were declared by.
pub(super) fn undriven(netlist: &Netlist) -> Vec<(String, Fault)> {
    let registers = netlist.registers.iter().filter(|register| register.updates.is_empty());
    let registers = registers.map(|register| (register.name.clone(), register.name.clone()));
    let wires = netlist.wires.iter().filter(|wire| wire.driver == NodeId::UNDRIVEN);
    let wires = wires.map(|wire| (wire.name.clone(), wire.name.clone()));
    let inputs = netlist.instances.iter().flat_map(|instance| {
        let inputs = instance.module.inputs.iter().zip(&instance.connections);
        let open = inputs.filter(|(_, driver)| **driver == NodeId::UNDRIVEN);
        open.map(|(input, _)| (instance.name.clone(), format!("{}.{}", instance.name, input.name)))
    });
    registers
        .chain(wires)
        .chain(inputs)
        .map(|(declared, name)| (declared, Fault::Undriven { name }))
        .collect()
}

/// Memories that nothing writes and that have words without contents, by name.
pub(super) fn unknown_words(netlist: &Netlist) -> Vec<(String, Fault)> {
    let roms =
        netlist.memories.iter().filter(|memory| memory.writes.is_empty() && memory.contents.others.is_none());
    let unknown = roms.filter_map(|memory| {
        let word = (0..memory.words).find(|word| !memory.contents.rows.contains_key(word))?;
        Some((memory.name.clone(), Fault::UnknownWord { name: memory.name.clone(), word }))
    });
    unknown.collect()
}

/// Two modules of one name would be two files of one name.
pub(super) fn duplicate_modules(netlist: &Netlist) -> Vec<(String, Fault)> {
    let mut found: Vec<(Arc<Netlist>, &str)> = Vec::new();
    let mut faults = Vec::new();
    for instance in &netlist.instances {
        for module in instance.module.modules() {
            let clash =
                found.iter().any(|(known, _)| known.name == module.name && !Arc::ptr_eq(known, &module));
            if clash || module.name == netlist.name {
                let fault = Fault::DuplicateModule { name: module.name.clone() };
                faults.push((instance.name.clone(), fault));
            }
            found.push((module, &instance.name));
        }
    }
    faults.dedup();
    faults
}
