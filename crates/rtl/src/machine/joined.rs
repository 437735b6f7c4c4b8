//! The units as instances, and the wires between them and to the machine's ports.

use edgewalk_machine::{Link, Status};
use edgewalk_netlist::{Instance, Signal};

use crate::ports::Interface;
use crate::wires::{Token, parts};

/// One unit in its place.
pub(super) struct Unit<'m> {
    /// Ports of the unit on the machine's module that are also ports of the machine.
    pub outside: Interface<'m>,
    pub instance: Instance<'m>,
}

/// All units, in the order the data flows.
pub(super) struct Joined<'m>(pub Vec<Unit<'m>>);

impl<'m> Joined<'m> {
    /// The machine's inputs: tokens, constants, what comes from memories, ready for the writes.
    pub fn connect_inputs(&self) {
        if let Some(first) = self.0.first() {
            let link = first.outside.takes_link();
            let (valid, token) = first.outside.takes();
            first.instance.connect(&port(link, "valid"), valid);
            token.connect(first.instance, link.name, &parts(&link.fields));
        }
        let mut constants: Vec<(&str, Signal<'_>)> = Vec::new();
        for Unit { outside, instance } in &self.0 {
            for field in &outside.ports.constants {
                // What several units ask for is one input of the machine.
                let made = constants.iter().find(|(name, _)| *name == field.name);
                let constant = made.map_or_else(|| outside.constant(&field.name), |(_, constant)| *constant);
                instance.connect(&field.name, constant);
                constants.push((&field.name, constant));
            }
        }
        for Unit { outside, instance } in &self.0 {
            for memory in &outside.ports.memory {
                let from = outside.memory(memory.name);
                instance.connect(&port(&memory.read, "ready"), from.read_ready);
                instance.connect(&port(&memory.data, "valid"), from.data_valid);
                from.data.connect(*instance, memory.data.name, &parts(&memory.data.fields));
            }
            for link in &outside.ports.writes {
                instance.connect(&port(link, "ready"), outside.writes_ready(link.name));
            }
        }
        if let Some(last) = self.0.last() {
            let link = last.outside.gives_link();
            last.instance.connect(&port(link, "ready"), last.outside.gives_ready());
        }
    }

    /// The links from unit to unit, values held beside them, and levels.
    pub fn join(&self) {
        for (place, taker) in self.0.iter().enumerate() {
            if place > 0 {
                link(&self.0[place - 1], taker);
            }
            for held in &taker.outside.ports.held_in {
                let holds =
                    |unit: &&Unit| unit.outside.ports.held_out.iter().any(|out| out.name == held.name);
                if let Some(giver) = self.0.iter().find(holds) {
                    let held_parts = parts(&held.fields);
                    Token::of_instance(giver.instance, held.name, held_parts.clone()).connect(
                        taker.instance,
                        held.name,
                        &held_parts,
                    );
                }
            }
            for Status { field, .. } in &taker.outside.ports.status {
                let asks =
                    |unit: &&Unit| unit.outside.ports.levels.iter().any(|level| level.name == field.name);
                for unit in self.0.iter().filter(asks) {
                    unit.instance.connect(&field.name, taker.instance.output(&field.name));
                }
            }
        }
    }

    /// The machine's outputs: ready for tokens, what goes to memories, the writes.
    pub fn connect_outputs(&self) {
        if let Some(first) = self.0.first() {
            first.outside.take_ready(first.instance.output(&port(first.outside.takes_link(), "ready")));
        }
        for Unit { outside, instance } in &self.0 {
            for memory in &outside.ports.memory {
                let valid = instance.output(&port(&memory.read, "valid"));
                let address = instance.output(&port(&memory.read, "addr"));
                let data_ready = instance.output(&port(&memory.data, "ready"));
                outside.read(memory.name, valid, address, data_ready);
            }
            for link in &outside.ports.writes {
                let valid = instance.output(&port(link, "valid"));
                outside.write(link.name, valid, |f| instance.output(&port(link, f)));
            }
        }
        if let Some(last) = self.0.last() {
            let link = last.outside.gives_link();
            last.outside
                .give(last.instance.output(&port(link, "valid")), |f| last.instance.output(&port(link, f)));
        }
    }

    /// Name of the link by which triangles come: that of the first unit.
    pub fn source(&self) -> &'static str {
        self.0.first().map_or("", |first| first.outside.takes_link().name)
    }

    /// Valid of the link that a unit gives under that name.
    pub fn valid(&self, link: &str) -> Signal<'m> {
        self.unit(|unit| unit.outside.gives_link().name == link).output(&format!("{link}_valid"))
    }

    /// A unit takes nothing of what another offers it by the link of that name; `None`: no unit takes such a link.
    pub fn keeps_waiting(&self, link: &str) -> Option<Signal<'m>> {
        let takes = |unit: &&Unit<'m>| unit.outside.takes_link().name == link;
        self.0.iter().find(takes).map(|_| self.valid(link) & !self.ready_for(link))
    }

    /// Ready of the link that a unit takes under that name.
    pub fn ready_for(&self, link: &str) -> Signal<'m> {
        self.unit(|unit| unit.outside.takes_link().name == link).output(&format!("{link}_ready"))
    }

    fn unit(&self, is_it: impl Fn(&Unit<'m>) -> bool) -> Instance<'m> {
        let unit = self
            .0
            .iter()
            .find(|unit| is_it(unit))
            .expect("the unit is in the machine that is asked for its link");
        unit.instance
    }
}

impl<'m> Unit<'m> {
    /// The status of that name.
    pub fn status(&self, name: &str) -> Option<&Status> {
        self.outside.ports.status.iter().find(|status| status.field.name == name)
    }
}

/// `<link>_<part>`.
pub(super) fn port(link: &Link, part: &str) -> String {
    format!("{}_{part}", link.name)
}

/// From a unit to the next. The taker's fields are among the giver's; each side has its own name for the link.
fn link(from: &Unit<'_>, to: &Unit<'_>) {
    let (given, taken) = (from.outside.gives_link(), to.outside.takes_link());
    to.instance.connect(&port(taken, "valid"), from.instance.output(&port(given, "valid")));
    from.instance.connect(&port(given, "ready"), to.instance.output(&port(taken, "ready")));
    let taken_parts = parts(&taken.fields);
    Token::of_instance(from.instance, given.name, taken_parts.clone()).connect(
        to.instance,
        taken.name,
        &taken_parts,
    );
}
