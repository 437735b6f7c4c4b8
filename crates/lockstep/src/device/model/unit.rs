//! A unit of the model by its declared ports, alone or inside the machine.

use super::link::{HeldPorts, Rules, Scope, Takes, WordPorts};
use super::{ModelDevice, NoPlace};
use crate::device::Device;
use crate::interface::Link;
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::Events;
use edgewalk_model::named::Place;
use edgewalk_model::ports::{Held, Pins, Ported, Shown};
use edgewalk_model::tokens::Sourced;
use edgewalk_model::word_memory::Ask;

/// The outputs of a unit. What it shows first says where each field of its tokens stands.
pub struct Outputs {
    plan: Plan,
    owner: &'static str,
    /// The ready of the link that it takes.
    ready: Option<PortId>,
    gives: Option<Given>,
    writes: Option<Given>,
    memory: Option<WordPorts>,
    held: HeldPorts,
    /// Each with whether the unit has shown it.
    status: Vec<(String, PortId, bool)>,
    /// A port that the unit has no place for.
    missing: Option<String>,
}

/// A link on which tokens go out.
struct Given {
    place: usize,
    link: Link,
    /// Where each field stands in the token, and its width.
    fields: Option<Vec<(Place, u32)>>,
}

impl Outputs {
    /// Finds the outputs that are ports of the unit itself; others inside the machine are ports of the machine.
    pub fn find(scope: Scope) -> Result<Outputs, NoPlace> {
        let declared = scope.declared()?;
        let given = |name: &str| {
            let (place, link) = scope.link(name).ok()?;
            Some(Given { place, link: link.clone(), fields: None })
        };
        let gives = declared.gives.as_ref().and_then(|link| given(link.name));
        let ready = declared.takes.as_ref().and_then(|link| scope.link(link.name).ok());
        let status = scope.status().map(|port| (port.name.clone(), port.id, false));
        Ok(Outputs {
            plan: scope.plan.clone(),
            owner: scope.owner,
            ready: ready.map(|(_, link)| link.ready),
            held: match &gives {
                Some(given) => HeldPorts::find(scope, &given.link)?,
                None => HeldPorts::default(),
            },
            gives,
            writes: declared.writes.first().and_then(|link| given(link.name)),
            memory: declared.memory.first().and_then(|memory| WordPorts::find(scope, memory).ok()),
            status: status.collect(),
            missing: None,
        })
    }

    /// Where the unit shows a cycle.
    pub fn on<'a>(&'a mut self, ports: &'a mut PortValues) -> Showing<'a> {
        Showing { outputs: self, ports }
    }

    /// Every port has been shown.
    ///
    /// # Errors
    /// The first that was not.
    pub fn complete(&self) -> Result<(), NoPlace> {
        let unseen = || self.status.iter().find(|(_, _, seen)| !seen).map(|(name, ..)| name.clone());
        let silent = || {
            let mut links = self.gives.iter().chain(&self.writes);
            links.find(|given| given.fields.is_none()).map(|given| format!("{}_valid", given.link.name))
        };
        match self.missing.clone().or_else(unseen).or_else(silent) {
            None => Ok(()),
            Some(port) => Err(NoPlace::Port { unit: self.owner.to_owned(), port }),
        }
    }
}

/// A unit that shows a cycle.
pub struct Showing<'a> {
    outputs: &'a mut Outputs,
    ports: &'a mut PortValues,
}

/// Valid, and the fields of the token if there is one.
fn offer<T: Sourced>(
    (given, plan, missing): (&mut Option<Given>, &Plan, &mut Option<String>),
    token: Option<&T>,
    ports: &mut PortValues,
) {
    let Some(Given { place, link, fields }) = given else { return };
    let fields = fields.get_or_insert_with(|| {
        let own = link.fields[..link.own].iter();
        let found = own
            .map(|port| T::find(plan, &port.field.name).map(|place| (place, port.width())).ok_or(&port.name));
        found.collect::<Result<_, _>>().unwrap_or_else(|port| {
            *missing = Some(port.clone());
            Vec::new()
        })
    });
    ports.set(link.valid, token.is_some());
    ports.set_triangle(*place, token.map(|token| { *token }.source().id));
    if let Some(mut token) = token.copied() {
        for ((place, width), value) in fields.iter().zip(ports.range_mut(&link.range())) {
            *value = token.at(*place).bits() & (u128::MAX >> (128 - width));
        }
    }
}

impl Shown for Showing<'_> {
    fn takes(&mut self, ready: bool) {
        if let Some(port) = self.outputs.ready {
            self.ports.set(port, ready);
        }
    }

    fn gives<T: Sourced>(&mut self, token: Option<&T>) {
        let Outputs { gives, plan, missing, .. } = self.outputs;
        offer((gives, plan, missing), token, self.ports);
    }

    fn writes<T: Sourced>(&mut self, token: Option<&T>) {
        let Outputs { writes, plan, missing, .. } = self.outputs;
        offer((writes, plan, missing), token, self.ports);
    }

    fn asks(&mut self, ask: Ask) {
        if let Some(memory) = &self.outputs.memory {
            memory.show(ask, self.ports);
        }
    }

    fn holds<const C: usize>(&mut self, held: &Held<C>) {
        self.outputs.held.show(held, self.ports);
    }

    fn status(&mut self, name: &str, value: bool) {
        self.number(name, value.into());
    }
}

impl Showing<'_> {
    /// A status port of several bits.
    pub fn number(&mut self, name: &str, value: u128) {
        if let Some((_, port, seen)) = self.outputs.status.iter_mut().find(|(own, ..)| own == name) {
            (self.ports[*port], *seen) = (value, true);
        }
    }
}

/// The inputs of a unit alone, but for its tokens.
struct Inputs {
    next: Option<PortId>,
    write: Option<PortId>,
    memory: Option<WordPorts>,
    held: HeldPorts,
    rules: Rules,
    fresh_queued: Option<PortId>,
}

impl Inputs {
    fn find(scope: Scope) -> Result<Inputs, NoPlace> {
        let declared = scope.declared()?;
        let ready = |link: Option<&edgewalk_machine::Link>| {
            link.map(|link| scope.link(link.name).map(|(_, link)| link.ready)).transpose()
        };
        let takes = declared.takes.as_ref().map(|link| scope.link(link.name)).transpose()?;
        let memory = declared.memory.first();
        Ok(Inputs {
            next: ready(declared.gives.as_ref())?,
            write: ready(declared.writes.first())?,
            memory: memory.map(|memory| WordPorts::find(scope, memory)).transpose()?,
            held: match takes {
                Some((_, link)) => HeldPorts::find(scope, link)?,
                None => HeldPorts::default(),
            },
            rules: Rules::find(scope)?,
            fresh_queued: scope.interface.levels.first().map(|_| scope.port("fresh_queued")).transpose()?,
        })
    }

    fn pins<'a, T, const C: usize>(&self, token: Option<&'a T>, ports: &PortValues) -> Pins<'a, T, C> {
        let is_high = |port: Option<PortId>| port.is_some_and(|port| ports.is_high(port));
        Pins {
            token,
            next: is_high(self.next),
            write: is_high(self.write),
            word: self.memory.as_ref().map_or_else(Default::default, |memory| memory.word(ports)),
            held: self.held.read(ports),
            state: self.rules.state(ports),
            fresh_queued: is_high(self.fresh_queued),
        }
    }
}

/// A unit alone; `K` is where its tokens come in.
pub struct UnitDevice<U, K, const C: usize> {
    unit: U,
    events: Events,
    taker: K,
    inputs: Inputs,
    outputs: Outputs,
}

impl<U: Ported<C>, K: Takes<U::Takes>, const C: usize> UnitDevice<U, K, C> {
    pub fn new(unit: U, taker: K, scope: Scope) -> Result<Self, NoPlace> {
        let (inputs, mut outputs) = (Inputs::find(scope)?, Outputs::find(scope)?);
        unit.show(&Pins::default(), &mut outputs.on(&mut scope.interface.values()));
        outputs.complete()?;
        Ok(UnitDevice { unit, events: Events::default(), taker, inputs, outputs })
    }
}

impl<U: Ported<C>, K: Takes<U::Takes>, const C: usize> Device for UnitDevice<U, K, C> {
    fn cycle(&mut self, ports: &mut PortValues) {
        let token = self.taker.token(ports);
        let pins = self.inputs.pins(token.as_ref(), ports);
        self.unit.show(&pins, &mut self.outputs.on(ports));
        self.unit.clock(&pins, &mut self.events);
        if ports.rst {
            self.unit.clear();
        }
        self.taker.clock(ports);
    }
}

impl<U: Ported<C>, K: Takes<U::Takes>, const C: usize> ModelDevice for UnitDevice<U, K, C> {
    fn events(&self) -> &Events {
        &self.events
    }
}
