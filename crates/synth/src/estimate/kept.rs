//! Modules that were worked out, for machines that have them too.

use super::delay::Delays;
use super::family::Family;
use super::graph::{Quick, QuickMap};
use super::module::{Logic, Module, Ports};
use super::ports::View;
use super::reads::keys_read;
use super::structure::{Structure, UnitTables};
use crate::fpga::Fpga;
use edgewalk_machine::Plan;
use edgewalk_netlist::netlist::Source;
use edgewalk_netlist::{BuildErrors, Netlist};
use std::hash::{Hash, Hasher};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// A module of a machine.
#[derive(Clone)]
pub(super) struct Unit {
    pub name: String,
    pub netlist: Arc<Netlist>,
    /// [`number`] of the netlist.
    number: u64,
}

impl Unit {
    pub fn new(name: &str, netlist: Arc<Netlist>) -> Unit {
        Unit { name: name.to_owned(), number: number(&netlist), netlist }
    }
}

/// A module as it is looked at.
pub(super) struct Viewed {
    pub ports: Ports,
    /// Until the module is worked out, or looked at otherwise.
    logic: Mutex<Option<Logic>>,
    /// Set when somebody asks for it.
    module: OnceLock<Module>,
}

impl Viewed {
    /// Takes the logic out, which needs much memory.
    pub fn take_logic(&self) -> Option<Logic> {
        open(&self.logic).take()
    }
}

/// Modules of the machines that were estimated so far. A module that several machines have is worked out once.
pub struct Kept {
    pub(super) family: Family,
    delays: Delays,
    /// By the number of the netlist and the view.
    modules: Mutex<QuickMap<u64, QuickMap<View, Arc<Viewed>>>>,
    /// By name and keys.
    units: Mutex<QuickMap<(&'static str, Vec<u32>), Unit>>,
}

impl Kept {
    /// Nothing is kept so far.
    #[must_use]
    pub fn new(delays: Delays, family: Fpga) -> Kept {
        Kept { family: Family::of(family), delays, modules: Mutex::default(), units: Mutex::default() }
    }

    /// Of a module with all that is in it.
    pub(crate) fn alone(&self, netlist: &Netlist, name: &str) -> Structure {
        let view = View { family: self.family, ..View::default() };
        let module = Logic::of(netlist, &view).module(&self.delays);
        let mut tables: Vec<UnitTables> = module
            .tables
            .iter()
            .map(|(unit, tables)| UnitTables { unit: unit.clone(), tables: *tables })
            .collect();
        if let Some(top) = tables.first_mut() {
            name.clone_into(&mut top.unit);
        }
        let ways = &module.ways;
        let ports = ways.ends.iter().map(|(_, way)| *way).chain(ways.begins.values().copied());
        let through = ways.through.values().flatten().map(|(_, way)| *way);
        let longest = ports.chain(through).fold(ways.within, |a, b| if b.ns > a.ns { b } else { a });
        Structure {
            whole: false,
            tables,
            carry: module.carry,
            ff: module.ff,
            ram: module.ram,
            distributed: module.distributed,
            products: module.products,
            lone_ff: module.lone_ff,
            lone_carry: module.lone_carry,
            path: longest.path,
        }
    }

    /// A module looked at so.
    pub(super) fn viewed(&self, unit: &Unit, view: &View) -> Arc<Viewed> {
        let known = open(&self.modules).get(&unit.number).and_then(|views| views.get(view)).cloned();
        known.unwrap_or_else(|| {
            let logic = Logic::of(&unit.netlist, view);
            let ports = logic.ports(view);
            let viewed = Arc::new(Viewed { ports, logic: Mutex::new(Some(logic)), module: OnceLock::new() });
            open(&self.modules).entry(unit.number).or_default().insert(view.clone(), viewed.clone());
            viewed
        })
    }

    /// What a module comes to.
    pub(super) fn module<'v>(&self, unit: &Unit, view: &View, viewed: &'v Viewed) -> &'v Module {
        viewed.module.get_or_init(|| {
            let logic = viewed.take_logic();
            logic.unwrap_or_else(|| Logic::of(&unit.netlist, view)).module(&self.delays)
        })
    }

    /// A unit of a machine, built if no machine before had the same.
    pub(super) fn unit(
        &self,
        name: &'static str,
        plan: &Plan,
        build: impl FnOnce() -> Built,
    ) -> Result<Unit, BuildErrors> {
        let key = (name, keys_read(name, plan));
        let known = open(&self.units).get(&key).cloned();
        known.map_or_else(
            || {
                let unit = Unit::new(name, build()?);
                open(&self.units).insert(key, unit.clone());
                Ok(unit)
            },
            Ok,
        )
    }
}

type Built = Result<Arc<Netlist>, BuildErrors>;

fn open<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A number for what a netlist computes; names and comments are no part of it.
fn number(netlist: &Netlist) -> u64 {
    let mut hash = Quick::default();
    put(netlist, &mut hash);
    hash.finish()
}

fn put(netlist: &Netlist, hash: &mut Quick) {
    for node in &netlist.nodes {
        node.width.hash(hash);
        match &node.source {
            Source::Input(port) => (0u8, port).hash(hash),
            Source::Constant { value, .. } => (1u8, value).hash(hash),
            Source::Op(op, operands) => (2u8, op, operands).hash(hash),
            Source::Wire(wire) => (3u8, netlist.wires[*wire].driver).hash(hash),
            Source::Register(register) => (4u8, register).hash(hash),
            Source::MemoryRead { memory, port } => (5u8, memory, port).hash(hash),
            Source::InstanceOutput { instance, output } => (6u8, instance, output).hash(hash),
        }
    }
    for register in &netlist.registers {
        (register.node, register.reset, register.updates.len()).hash(hash);
        register.updates.iter().for_each(|update| (update.when, update.value).hash(hash));
    }
    for memory in &netlist.memories {
        (memory.words, memory.width, memory.writes.len(), memory.reads.len()).hash(hash);
        for port in &memory.writes {
            (port.en, port.addr, port.data).hash(hash);
        }
        for port in &memory.reads {
            (port.en, port.addr, port.node).hash(hash);
        }
        if memory.writes.is_empty() {
            (0..memory.words).for_each(|at| memory.contents.word(memory.width, at).hash(hash));
        }
    }
    netlist.inputs.iter().for_each(|input| input.node.hash(hash));
    netlist.outputs.iter().for_each(|output| output.driver.hash(hash));
    for instance in &netlist.instances {
        instance.connections.hash(hash);
        put(&instance.module, hash);
    }
}
