//! The ends of links, memories and constants of a unit of the model, as ports.

use super::NoPlace;
use crate::device::Triangles;
use crate::device::tokens::Table;
use crate::interface::{Interface, Link, Port};
use crate::unit::Unit;
use crate::values::{PortId, PortValues};
use edgewalk_machine::draw::Setter;
use edgewalk_machine::{DrawState, MemoryPort, Plan, PortVertex, Ports};
use edgewalk_model::WordIn;
use edgewalk_model::ports::Held;
use edgewalk_model::tokens::Sourced;
use edgewalk_model::word_memory::Ask;
use std::cell::RefCell;
use std::ops::Range;

/// Where a unit's ports are to be found: it alone, or inside the machine.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    pub plan: &'a Plan,
    pub interface: &'a Interface,
    pub owner: &'static str,
}

impl<'a> Scope<'a> {
    /// The unit of the interface itself.
    pub fn alone(plan: &'a Plan, interface: &'a Interface) -> Scope<'a> {
        Scope { plan, interface, owner: interface.unit.name() }
    }

    /// What the unit declares.
    pub fn declared(&self) -> Result<Ports, NoPlace> {
        let unit = Unit::named(self.owner).map_err(|error| NoPlace::Unit(error.name))?;
        Ok(unit.ports(self.plan))
    }

    /// A single port.
    pub fn port(&self, name: &str) -> Result<PortId, NoPlace> {
        let found = self.interface.port(&format!("{}.{name}", self.owner));
        found.map(|port| port.id).ok_or_else(|| self.missing(name))
    }

    /// A link of the unit, and its number.
    pub fn link(&self, name: &str) -> Result<(usize, &'a Link), NoPlace> {
        let links = self.interface.links.iter().chain(&self.interface.inner).enumerate();
        let mut own = links.filter(|(_, link)| link.name == name && link.owner == self.owner);
        own.next().ok_or_else(|| self.missing(name))
    }

    /// The status ports of the unit.
    pub fn status(&self) -> impl Iterator<Item = &'a Port> + use<'a> {
        let (interface, owner) = (self.interface, self.owner);
        let all = interface.status.iter().chain(&interface.inner_status);
        all.map(|status| &status.port).filter(move |port| port.owner == owner)
    }

    fn missing(&self, name: &str) -> NoPlace {
        NoPlace::Port { unit: self.owner.to_owned(), port: name.to_owned() }
    }
}

/// Where tokens come in.
pub trait Takes<T>: Send {
    /// The token that is offered.
    fn token(&self, ports: &PortValues) -> Option<T>;

    /// The clock edge of a cycle with these values.
    fn clock(&mut self, _: &PortValues) {}
}

/// Where tokens with named fields come in.
#[derive(Clone, Debug)]
pub struct Taker<T> {
    table: Table<T>,
    place: usize,
    valid: PortId,
    fields: Range<usize>,
}

impl<T: Sourced> Taker<T> {
    /// The link that the unit takes.
    pub fn find(scope: Scope) -> Result<Taker<T>, NoPlace> {
        let takes = scope.declared()?.takes;
        let (place, link) = scope.link(takes.as_ref().map_or("", |link| link.name))?;
        Ok(Taker { table: Table::of(scope.plan, link)?, place, valid: link.valid, fields: link.range() })
    }
}

impl<T: Sourced + Send> Takes<T> for Taker<T> {
    fn token(&self, ports: &PortValues) -> Option<T> {
        let triangle = ports.triangle(self.place).unwrap_or(0);
        ports.is_high(self.valid).then(|| self.table.unpack(ports.range(&self.fields), triangle))
    }
}

/// Where triangles come in.
pub struct TriangleTaker {
    link: Link,
    triangles: Triangles,
    /// The words taken of a triangle that comes word by word.
    taken: Vec<u128>,
    seen: RefCell<Seen>,
}

/// Most tokens stand at the port for many cycles: they are unpacked once.
struct Seen {
    /// The token of this cycle.
    offered: Vec<u128>,
    /// The token that was unpacked last.
    token: Vec<u128>,
    triangle: Tagged,
}

/// A triangle and its tag.
type Tagged = ([PortVertex; 3], u32);

impl TriangleTaker {
    pub fn find(scope: Scope) -> Result<TriangleTaker, NoPlace> {
        let takes = scope.declared()?.takes;
        let (_, link) = scope.link(takes.as_ref().map_or("", |link| link.name))?;
        let triangles =
            Triangles::of(scope.plan, link).ok_or_else(|| scope.missing("a field of a triangle"))?;
        let token = vec![0; link.whole().count()];
        let seen = Seen { offered: Vec::new(), triangle: triangles.unpack(&token), token };
        Ok(TriangleTaker { link: link.clone(), triangles, taken: Vec::new(), seen: RefCell::new(seen) })
    }

    /// The triangle whose last word is offered; before that one of which only the words so far are known.
    fn whole(&self, ports: &PortValues, whole: &mut Vec<u128>) {
        whole.clear();
        let token = self.link.token(ports);
        match (token, self.link.words.get(self.taken.len())) {
            ([word, beside @ ..], Some(field)) => {
                whole.extend(&self.taken);
                whole.push(word & (u128::MAX >> (128 - field.width())));
                whole.resize(self.link.words.len(), 0);
                whole.extend(beside);
            }
            _ => whole.extend(token),
        }
    }
}

/// A triangle and its tag; of one that comes word by word as soon as a word is offered. In a reset none is taken.
impl Takes<Tagged> for TriangleTaker {
    fn token(&self, ports: &PortValues) -> Option<Tagged> {
        if !ports.is_high(self.link.valid) || ports.rst {
            return None;
        }
        let Seen { offered, token, triangle } = &mut *self.seen.borrow_mut();
        self.whole(ports, offered);
        if offered != token {
            *triangle = self.triangles.unpack(offered);
            std::mem::swap(offered, token);
        }
        Some(*triangle)
    }

    fn clock(&mut self, ports: &PortValues) {
        if ports.rst {
            self.taken.clear();
        } else if let Some(field) = self.link.words.get(self.taken.len())
            && self.link.fires(ports)
        {
            self.taken.push(self.link.token(ports)[0] & (u128::MAX >> (128 - field.width())));
            if self.taken.len() == self.link.words.len() {
                self.taken.clear();
            }
        }
    }
}

/// The read side of a memory.
#[derive(Clone, Debug)]
pub struct WordPorts {
    read_valid: PortId,
    read_ready: PortId,
    read_addr: PortId,
    data_valid: PortId,
    data_ready: PortId,
    word: PortId,
}

impl WordPorts {
    /// The ports of a memory by its declaration.
    pub fn find(scope: Scope, memory: &MemoryPort) -> Result<Self, NoPlace> {
        let port = |link: &str, part: &str| scope.port(&format!("{link}_{part}"));
        let (read, data) = (memory.read.name, memory.data.name);
        Ok(WordPorts {
            read_valid: port(read, "valid")?,
            read_ready: port(read, "ready")?,
            read_addr: port(read, &memory.read.fields[0].name)?,
            data_valid: port(data, "valid")?,
            data_ready: port(data, "ready")?,
            word: port(data, &memory.data.fields[0].name)?,
        })
    }

    /// The memory takes a read; the word that it offers.
    pub fn word(&self, ports: &PortValues) -> WordIn {
        let word = ports.is_high(self.data_valid).then(|| ports[self.word]);
        WordIn { ready: ports.is_high(self.read_ready), word }
    }

    /// Shows what is asked of it.
    pub fn show(&self, ask: Ask, ports: &mut PortValues) {
        ports.set(self.read_valid, ask.addr.is_some());
        ports[self.read_addr] = ask.addr.unwrap_or(0).into();
        ports.set(self.data_ready, ask.take);
    }
}

/// The constants, each with its setter.
#[derive(Clone, Debug)]
pub struct Rules(Vec<(Setter, PortId)>);

impl Rules {
    /// Finds the rules among the ports of the interface.
    pub fn find(scope: Scope) -> Result<Rules, NoPlace> {
        let setter = |port: &Port| {
            let setter = DrawState::setter(&port.name).ok_or_else(|| scope.missing(&port.name))?;
            Ok((setter, port.id))
        };
        Ok(Rules(scope.interface.constants.iter().map(setter).collect::<Result<_, NoPlace>>()?))
    }

    /// The draw state of a cycle; a constant that the unit does not have is that of no pass.
    pub fn state(&self, ports: &PortValues) -> DrawState {
        let mut state =
            DrawState { depth_func: 0, depth_write: false, color_write: false, ..DrawState::default() };
        for (set, port) in &self.0 {
            set(&mut state, ports[*port]);
        }
        state
    }
}

/// Values that are held beside a link.
#[derive(Clone, Debug, Default)]
pub struct HeldPorts(Vec<(HeldValue, PortId)>);

#[derive(Clone, Copy, Debug)]
enum HeldValue {
    Gradient(usize),
    Kt,
    Record,
}

impl HeldPorts {
    /// Finds the ports that are held beside this link.
    pub fn find(scope: Scope, link: &Link) -> Result<HeldPorts, NoPlace> {
        let value = |name: &str| match name {
            "record" => Some(HeldValue::Record),
            "kt" if scope.plan.has_triangle_kt() => Some(HeldValue::Kt),
            _ => {
                let channels = scope.plan.channels();
                channels.iter().position(|channel| channel.name == name).map(HeldValue::Gradient)
            }
        };
        let found = link.fields[link.own..]
            .iter()
            .map(|port| Ok((value(&port.field.name).ok_or_else(|| scope.missing(&port.name))?, port.id)));
        Ok(HeldPorts(found.collect::<Result<_, NoPlace>>()?))
    }

    /// Shows them.
    pub fn show<const C: usize>(&self, held: &Held<C>, ports: &mut PortValues) {
        for (value, port) in &self.0 {
            ports[*port] = match value {
                HeldValue::Gradient(channel) => held.gradient[*channel].into(),
                HeldValue::Kt => held.kt.into(),
                HeldValue::Record => held.record.into(),
            };
        }
    }

    /// Reads them; 0 for a value that is not held.
    pub fn read<const C: usize>(&self, ports: &PortValues) -> Held<C> {
        let mut held = Held::default();
        for (value, port) in &self.0 {
            let bits = ports[*port];
            match value {
                HeldValue::Gradient(channel) => held.gradient[*channel] = bits as u64, // at most 56 bits
                HeldValue::Kt => held.kt = bits as u32,                                // at most 13 bits
                HeldValue::Record => held.record = bits as u32,                        // at most 20 bits
            }
        }
        held
    }
}
