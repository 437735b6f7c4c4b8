//! The ends of links, and single ports, of a unit of the model.

use super::NoPlace;
use crate::device::tokens::Table;
use crate::interface::{Interface, Link};
use crate::values::{PortId, PortValues};
use edgewalk_machine::Plan;
use edgewalk_model::named::Sourced;
use edgewalk_model::tokens::Words;
use std::ops::Range;

/// Where a unit's ports are to be found: it alone, or inside the machine.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    pub plan: &'a Plan,
    pub interface: &'a Interface,
    pub owner: &'static str,
}

/// Whether the map is drawn, not the picture.
pub struct LightPass(Option<PortId>);

impl LightPass {
    pub fn is_high(&self, ports: &PortValues) -> bool {
        self.0.is_some_and(|port| ports.is_high(port))
    }
}

impl<'a> Scope<'a> {
    /// The unit of the interface itself.
    pub fn alone(plan: &'a Plan, interface: &'a Interface) -> Scope<'a> {
        Scope { plan, interface, owner: interface.unit.name() }
    }

    /// A single port.
    pub fn port(&self, name: &str) -> Result<PortId, NoPlace> {
        let found = self.interface.port(&format!("{}.{name}", self.owner));
        found.map(|port| port.id).ok_or_else(|| self.missing(name))
    }

    /// The input `light_pass`, where the machine draws its map.
    pub fn light_pass(&self) -> Result<LightPass, NoPlace> {
        let there = self.plan.shadow.draws_map();
        Ok(LightPass(there.then(|| self.port("light_pass")).transpose()?))
    }

    fn link(&self, name: &str) -> Result<(usize, &'a Link), NoPlace> {
        let links = self.interface.links.iter().chain(&self.interface.inner).enumerate();
        let mut own = links.filter(|(_, link)| link.name == name && link.owner == self.owner);
        own.next().ok_or_else(|| self.missing(name))
    }

    fn missing(&self, name: &str) -> NoPlace {
        NoPlace::Port { unit: self.owner.to_owned(), port: name.to_owned() }
    }

    /// The end of a link where tokens come in.
    pub fn taker<T: Sourced>(&self, name: &str) -> Result<Taker<T>, NoPlace> {
        let (place, link) = self.link(name)?;
        Ok(Taker { table: Table::of(self.plan, link)?, place, valid: link.valid, fields: link.range() })
    }

    /// The end of a link where tokens go out.
    pub fn giver<T: Sourced>(&self, name: &str) -> Result<Giver<T>, NoPlace> {
        let (place, link) = self.link(name)?;
        Ok(Giver {
            table: Table::of(self.plan, link)?,
            place,
            valid: link.valid,
            ready: link.ready,
            fields: link.range(),
        })
    }

    /// The words held beside a link.
    pub fn held(&self, beside: &str) -> Result<HeldWords, NoPlace> {
        let (_, link) = self.link(beside)?;
        let found = self.plan.channels().iter().map(|channel| {
            let held = link.fields[link.own..].iter().find(|port| port.field.name == channel.name);
            held.map(|port| port.id).ok_or_else(|| self.missing(channel.name))
        });
        let kt = link.fields[link.own..]
            .iter()
            .find(|port| port.field.name == "kt" && self.plan.has_triangle_kt());
        Ok(HeldWords { words: found.collect::<Result<_, _>>()?, kt: kt.map(|port| port.id) })
    }
}

/// Where tokens come in.
#[derive(Clone, Debug)]
pub struct Taker<T> {
    table: Table<T>,
    place: usize,
    valid: PortId,
    fields: Range<usize>,
}

impl<T: Sourced> Taker<T> {
    /// The token that is offered.
    pub fn token(&self, ports: &PortValues) -> Option<T> {
        let triangle = ports.triangle(self.place).unwrap_or(0);
        ports.is_high(self.valid).then(|| self.table.unpack(ports.range(&self.fields), triangle))
    }
}

/// Where tokens go out.
#[derive(Clone, Debug)]
pub struct Giver<T> {
    table: Table<T>,
    place: usize,
    valid: PortId,
    pub ready: PortId,
    fields: Range<usize>,
}

impl<T: Sourced> Giver<T> {
    /// Valid, and the fields of the token if there is one.
    pub fn offer(&self, token: Option<&T>, ports: &mut PortValues) {
        ports.set(self.valid, token.is_some());
        ports.set_triangle(self.place, token.map(|token| { *token }.source().id));
        if let Some(token) = token {
            self.table.pack(token, ports.range_mut(&self.fields));
        }
    }
}

/// Words that a unit holds for another, and k_t of the triangle if it has one.
#[derive(Clone, Debug)]
pub struct HeldWords {
    words: Vec<PortId>,
    kt: Option<PortId>,
}

impl HeldWords {
    /// Shows them.
    pub fn show<const C: usize>(&self, words: &Words<C>, kt: u32, ports: &mut PortValues) {
        for (port, word) in self.words.iter().zip(words) {
            ports[*port] = u128::from(*word);
        }
        if let Some(port) = self.kt {
            ports[port] = kt.into();
        }
    }

    /// Reads them; behind the last channel 0, and 0 for a k_t that is not there.
    pub fn read<const C: usize>(&self, ports: &PortValues) -> (Words<C>, u32) {
        let word = |i: usize| self.words.get(i).map_or(0, |port| ports[*port] as u64); // at most 56 bits
        (std::array::from_fn(word), self.kt.map_or(0, |port| ports[port] as u32)) // at most 13 bits
    }
}
