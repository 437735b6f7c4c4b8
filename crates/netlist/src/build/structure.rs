//! What ties a module together: named wires and instances of other modules.

use std::sync::Arc;

use super::module::Module;
use super::operand::Operand;
use super::signal::Signal;
use crate::error::Fault;
use crate::netlist::{self, Item, Netlist, NodeId, Source};

/// A wire that is used before its driver is known: the feedback of a handshake between instances.
#[derive(Clone, Copy, Debug)]
pub struct Wire<'m> {
    q: Signal<'m>,
    index: usize,
}

impl<'m> Wire<'m> {
    #[track_caller]
    pub(super) fn new(module: &'m Module, name: &str, width: u32) -> Self {
        let width = module.checked_width(name, width);
        let index = module.draft().netlist.wires.len();
        let q = module.node(width, Source::Wire(index));
        module.declare(name, Some(q.id));
        let wire = netlist::Wire {
            name: name.to_string(),
            doc: String::new(),
            node: q.id,
            driver: NodeId::UNDRIVEN,
        };
        module.draft().netlist.wires.push(wire);
        module.item(Item::Wire(index));
        Wire { q, index }
    }

    /// A wire with its driver already there.
    #[track_caller]
    pub(super) fn driven(driver: Signal<'m>, name: &str, doc: &str) -> Signal<'m> {
        let wire = Wire::new(driver.module, name, driver.width).doc(doc);
        driver.module.draft().netlist.wires[wire.index].driver = driver.id;
        wire.q
    }

    /// The wire's value.
    pub fn q(self) -> Signal<'m> {
        self.q
    }

    /// Documents format and unit.
    pub fn doc(self, doc: &str) -> Self {
        self.q.module.draft().netlist.wires[self.index].doc = doc.to_string();
        self
    }

    /// Gives it its driver, once.
    #[track_caller]
    pub fn drive(self, signal: impl Operand<'m>) {
        let name = self.q.describe();
        let driver = self.q.module.fitted(&name, self.q.width, signal).id;
        let before = std::mem::replace(&mut self.q.module.draft().netlist.wires[self.index].driver, driver);
        if before != NodeId::UNDRIVEN {
            self.q.module.fail(Fault::DrivenTwice { name });
        }
        self.q.module.item(Item::Drive(self.index));
    }
}

/// A module used inside another. Its clock and reset are connected unseen.
#[derive(Clone, Copy, Debug)]
pub struct Instance<'m> {
    module: &'m Module,
    index: usize,
}

impl<'m> Instance<'m> {
    #[track_caller]
    pub(super) fn new(module: &'m Module, name: &str, of: &Arc<Netlist>) -> Self {
        module.declare(name, None);
        let index = module.draft().netlist.instances.len();
        let instance = netlist::Instance {
            name: name.to_string(),
            module: Arc::clone(of),
            connections: vec![NodeId::UNDRIVEN; of.inputs.len()],
            outputs: vec![None; of.outputs.len()],
        };
        module.draft().netlist.instances.push(instance);
        module.item(Item::Instance(index));
        Instance { module, index }
    }

    /// Drives the input `port`, once.
    #[track_caller]
    pub fn connect(self, port: &str, signal: impl Operand<'m>) -> Self {
        let (name, of) = self.names();
        let target = format!("{name}.{port}");
        let Some(input) = of.inputs.iter().position(|input| input.name == port) else {
            self.no_port(&of, "input", port, of.inputs.iter().map(|input| input.name.as_str()));
            return self;
        };
        let driver = self.module.fitted(&target, of.width(of.inputs[input].node), signal).id;
        let before = std::mem::replace(
            &mut self.module.draft().netlist.instances[self.index].connections[input],
            driver,
        );
        if before != NodeId::UNDRIVEN {
            self.module.fail(Fault::DrivenTwice { name: target });
        }
        self.to_the_end();
        self
    }

    /// The value of the output `port`, a wire called `<instance>_<port>`.
    #[track_caller]
    pub fn output(self, port: &str) -> Signal<'m> {
        let (name, of) = self.names();
        let Some(output) = of.outputs.iter().position(|output| output.name == port) else {
            self.no_port(&of, "output", port, of.outputs.iter().map(|output| output.name.as_str()));
            return self.module.lit(1, 0);
        };
        let width = of.width(of.outputs[output].driver);
        if let Some(id) = self.module.draft().netlist.instances[self.index].outputs[output] {
            return Signal { module: self.module, id, width };
        }
        let signal = self.module.node(width, Source::InstanceOutput { instance: self.index, output });
        self.module.declare(&format!("{name}_{port}"), Some(signal.id));
        self.module.draft().netlist.instances[self.index].outputs[output] = Some(signal.id);
        self.module.item(Item::InstanceOutput(signal.id));
        self.to_the_end();
        signal
    }

    /// The instance is told after everything it is connected to.
    fn to_the_end(self) {
        let items = &mut self.module.draft().netlist.items;
        items.retain(|item| *item != Item::Instance(self.index));
        items.push(Item::Instance(self.index));
    }

    fn names(self) -> (String, Arc<Netlist>) {
        let instance = &self.module.draft().netlist.instances[self.index];
        (instance.name.clone(), Arc::clone(&instance.module))
    }

    #[track_caller]
    fn no_port<'a>(
        self,
        of: &Netlist,
        direction: &'static str,
        port: &str,
        known: impl Iterator<Item = &'a str>,
    ) {
        self.module.fail(Fault::NoPort {
            of: of.name.clone(),
            direction,
            port: port.to_string(),
            known: known.collect::<Vec<_>>().join(", "),
        });
    }
}
