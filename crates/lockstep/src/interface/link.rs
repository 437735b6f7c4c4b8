//! A single port, a link, a memory.

use crate::values::{PortId, PortValues};
use edgewalk_machine::{Field, Held, Ready, Scale, Until};

/// Which way a link's tokens go, seen from the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Into the device.
    In,
    /// Out of the device.
    Out,
}

/// One port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Port {
    /// Place among the values.
    pub id: PortId,
    /// The unit that has it.
    pub owner: &'static str,
    /// Name of the port.
    pub name: String,
    /// What it carries; a field of a token goes by its name in the token.
    pub field: Field,
}

impl Port {
    /// Bits, at most 128.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.field.width()
    }

    /// Two's complement.
    #[must_use]
    pub fn is_signed(&self) -> bool {
        self.field.format.is_signed()
    }

    /// A value of the port as its format reads it: `-3.25 px`.
    #[must_use]
    pub fn shown(&self, value: u128) -> String {
        let number = self.number(value);
        let unit = match self.field.scale {
            Scale::Count => "",
            Scale::Of(unit) | Scale::Modular(unit) => unit,
            Scale::Unorm => return format!("{:.6}", number as f64 / self.field.format.max_raw() as f64),
        };
        let scaled = number as f64 / f64::from(self.field.format.fraction_bits()).exp2();
        format!("{scaled} {unit}").trim_end().to_owned()
    }

    /// The value with its sign.
    #[must_use]
    pub fn number(&self, value: u128) -> i128 {
        let unused = 128 - self.width();
        if self.is_signed() { ((value << unused) as i128) >> unused } else { value as i128 }
    }
}

/// A valid/ready link with its ports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Link {
    /// The unit that has it.
    pub owner: &'static str,
    /// Prefix of its ports.
    pub name: &'static str,
    /// Which way its tokens go.
    pub direction: Direction,
    /// The fields of a token and what is held beside it, the most significant first where they are packed.
    pub fields: Vec<Port>,
    /// Of these the token's own; the others are held beside it.
    pub own: usize,
    /// How long the unit holds what it holds beside the token, if it does.
    pub held_until: Option<Until>,
    /// The taker's ready means something even while there is no valid.
    pub ready_always: bool,
    /// Not empty: a token comes as so many words, one after the other in the first field; the other fields count with the last.
    pub words: Vec<Field>,
    /// The port `name_valid`.
    pub valid: PortId,
    /// The port `name_ready`.
    pub ready: PortId,
}

impl Link {
    pub(super) fn declared(
        owner: &'static str,
        direction: Direction,
        link: &edgewalk_machine::Link,
        held: &[Held],
    ) -> Link {
        let own =
            |prefix: &'static str, field: &Field| port_of(owner, format!("{prefix}_{}", field.name), field);
        let mut fields: Vec<Port> = link.fields.iter().map(|field| own(link.name, field)).collect();
        let beside = held.iter().filter(|held| held.beside == link.name);
        let held_until = beside.clone().next().map(|held| held.until);
        fields.extend(beside.flat_map(|held| held.fields.iter().map(|field| own(held.name, field))));
        let unplaced = PortId(usize::MAX);
        Link {
            owner,
            name: link.name,
            direction,
            fields,
            own: link.fields.len(),
            held_until,
            ready_always: link.ready == Ready::Always,
            words: link.words.clone(),
            valid: unplaced,
            ready: unplaced,
        }
    }

    /// What stands on the ports while a word of a whole token is sent: the word, extended by its format, and what is beside it.
    pub fn word<'a>(&self, whole: &'a [u128], place: usize) -> impl Iterator<Item = u128> + use<'a> {
        let (word, bits) = (&self.words[place], self.fields[0].width());
        let negative = word.format.is_signed() && whole[place] >> (word.width() - 1) & 1 == 1;
        let above = if negative { u128::MAX << (word.width() - 1) } else { 0 };
        let data = (whole[place] | above) & (u128::MAX >> (128 - bits));
        std::iter::once(data).chain(whole[self.words.len()..].iter().copied())
    }

    /// Bits of a packed token; of one that comes word by word those of a word and what stands beside it.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.fields.iter().map(Port::width).sum()
    }

    /// The fields of a whole token: its words, if it comes word by word, then the ports, but for that of the words.
    pub fn whole(&self) -> impl Iterator<Item = &Field> {
        let ports = &self.fields[usize::from(!self.words.is_empty())..];
        self.words.iter().chain(ports.iter().map(|port| &port.field))
    }

    /// The place of one of the token's own fields.
    #[must_use]
    pub fn place(&self, field: &str) -> Option<usize> {
        self.fields[..self.own].iter().position(|port| port.field.name == field)
    }

    /// Whether the unit holds values beside the tokens that it gives.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.direction == Direction::Out && self.own < self.fields.len()
    }

    /// The values held beside the token.
    #[must_use]
    pub fn held(&self) -> &[Port] {
        &self.fields[self.own..]
    }

    /// The fields' places among the values: behind the valid.
    pub(crate) fn range(&self) -> std::ops::Range<usize> {
        self.valid.0 + 1..self.valid.0 + 1 + self.fields.len()
    }

    /// The fields of the token that stands there.
    #[must_use]
    pub fn token<'a>(&self, ports: &'a PortValues) -> &'a [u128] {
        ports.range(&self.range())
    }

    /// Whether a token moves.
    #[must_use]
    pub fn fires(&self, ports: &PortValues) -> bool {
        ports.is_high(self.valid) && ports.is_high(self.ready)
    }
}

/// An output that means something without a handshake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StatusPort {
    /// The port.
    pub port: Port,
    /// For a flag that does not always mean something: the port that is 1 while it does. It counts as 0 while not.
    pub during: Option<&'static str>,
    /// The same port.
    pub(crate) guard: Option<PortId>,
}

impl StatusPort {
    /// What counts of the port's value in a cycle.
    #[must_use]
    pub fn value(&self, ports: &PortValues) -> u128 {
        if self.guard.is_none_or(|guard| ports.is_high(guard)) { ports[self.port.id] } else { 0 }
    }

    /// [`StatusPort::value`] in Verilog.
    #[must_use]
    pub fn expression(&self) -> String {
        match self.during {
            None => self.port.name.clone(),
            Some(other) => format!("{other} && {}", self.port.name),
        }
    }
}

/// A memory behind the unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Memory {
    /// What is stored there.
    pub name: &'static str,
    /// Number of the link with the addresses.
    pub read: usize,
    /// Number of the link with the words.
    pub data: usize,
    /// The write that changes it; none if another unit's link writes it.
    pub write: Option<MemoryWrite>,
    /// Bits of an address.
    pub address_bits: u32,
    /// Bits of a word.
    pub word_bits: u32,
    /// Clocks from a read to its data, at the least.
    pub latency: u64,
}

/// The link that writes a memory, and the places of its fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryWrite {
    /// Number of the link.
    pub link: usize,
    /// Where to.
    pub address: usize,
    /// What.
    pub word: usize,
    /// Whether, if not always.
    pub enable: Option<usize>,
}

/// A handshake port of a link.
pub(super) fn flag(owner: &'static str, link: &str, name: &str) -> Port {
    port_of(owner, format!("{link}_{name}"), &Field::count(name, 1, "handshake"))
}

/// A port that has no place yet.
pub(super) fn port_of(owner: &'static str, name: String, field: &Field) -> Port {
    Port { id: PortId(usize::MAX), owner, name, field: field.clone() }
}
