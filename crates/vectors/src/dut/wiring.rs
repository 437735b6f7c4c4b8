//! Which port of the design stands for which of the unit: `dut.toml` beside the unit's interface and the ports found.

use super::error::DutError;
use super::file::{Channel, Compare, Dut, Widths};
use super::ports::Found;
use crate::capture::{LinkTrace, Trace};
use edgewalk_lockstep::{Direction, Interface, Link, Memory, Port};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// What stands for a port of the unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wire {
    /// A port, with so many bits above the value.
    Port {
        /// Name of the port.
        name: String,
        /// Bits above the value: its sign, or 0.
        above: u32,
    },
    /// A part of the channel's packed port.
    Packed,
    /// Nothing.
    Absent,
}

/// One port for several fields of a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packed {
    /// Name of the port.
    pub name: String,
    /// Bits above the fields, 0.
    pub above: u32,
    /// Places of the fields, the most significant first.
    pub order: Vec<usize>,
}

/// The ports of a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ends {
    /// The port of valid; `None`: the memory behind the channel is inside the design, which has no port for it.
    pub valid: Option<String>,
    /// The port of ready; `None`: there is none, and the taker takes every token at once.
    pub ready: Option<String>,
    /// For each field its port.
    pub fields: Vec<Wire>,
    /// The port of those that are packed.
    pub packed: Option<Packed>,
}

/// What a bench connects to which port of a design.
#[derive(Clone, Debug, PartialEq)]
pub struct Wiring {
    /// The design.
    pub dut: Dut,
    /// For each channel of the unit.
    pub links: Vec<Ends>,
    /// For each constant of the unit.
    pub constants: Vec<Wire>,
    /// For each level of the unit.
    pub levels: Vec<Wire>,
    /// For each status port of the unit; none is there where only the order counts.
    pub status: Vec<Wire>,
    /// The ports that the design has, if they are known.
    pub found: Option<BTreeMap<String, Found>>,
    not_compared: Vec<String>,
}

impl Wiring {
    /// Tokens of a trace that the design has to give at its ports.
    #[must_use]
    pub fn tokens(&self, trace: &Trace) -> u64 {
        self.outside(trace).tokens_out()
    }

    /// What a bench has to compare of a trace.
    #[must_use]
    pub fn expected(&self, trace: &Trace) -> u64 {
        let trace = self.outside(trace);
        match self.dut.compare {
            Compare::Order => trace.tokens_out(),
            Compare::Cycle => trace.expected(),
        }
    }

    /// The trace without what moves at channels that the design has inside.
    #[must_use]
    pub(crate) fn outside<'a>(&self, trace: &'a Trace) -> Cow<'a, Trace> {
        if self.links.iter().all(|ends| ends.valid.is_some()) {
            return Cow::Borrowed(trace);
        }
        let mut outside = trace.clone();
        let inside = outside.links.iter_mut().zip(&self.links).filter(|(_, ends)| ends.valid.is_none());
        inside.for_each(|(moved, _)| *moved = LinkTrace::default());
        Cow::Owned(outside)
    }

    /// What the design gives to nobody: fields without a port, and all status ports where only the order counts.
    #[must_use]
    pub fn not_compared(&self) -> &[String] {
        &self.not_compared
    }
}

impl Dut {
    /// Connects the design to the unit; `found` are the design's ports, if they are known.
    ///
    /// # Errors
    /// A name that the unit or the design has not, a port that stands for two, of the wrong direction or width, an input
    /// for which nothing stands.
    pub fn wire(
        self,
        interface: &Interface,
        found: Option<&BTreeMap<String, Found>>,
    ) -> Result<Wiring, DutError> {
        let mut check = Check { dut: &self, found, used: BTreeMap::new() };
        check.port("clock", &self.clock, 1, true, "the clock")?;
        check.port("reset.port", &self.reset.port, 1, true, "the reset")?;
        check.channels(interface, Direction::In)?;
        check.channels(interface, Direction::Out)?;
        check.memories(interface)?;
        check.other_ports(interface)?;
        let mut links = Vec::new();
        for link in &interface.links {
            links.push(check.link(interface, link)?);
        }
        let constants = check.singles(interface, &interface.constants, true)?;
        let levels = check.singles(interface, &interface.levels, true)?;
        let status: Vec<Port> = interface.status.iter().map(|status| status.port.clone()).collect();
        let status = match self.compare {
            Compare::Order => {
                // They stay open; a name that the file gives must be right.
                let named = status
                    .iter()
                    .filter(|port| self.ports.contains_key(&port.name) && !self.absent.contains(&port.name));
                check.singles(interface, &named.cloned().collect::<Vec<_>>(), false)?;
                vec![Wire::Absent; status.len()]
            }
            Compare::Cycle => check.singles(interface, &status, false)?,
        };
        check.ties()?;
        let out = interface.links.iter().zip(&links).filter(|(link, _)| link.direction == Direction::Out);
        let fields = out.flat_map(|(link, ends)| link.fields.iter().zip(&ends.fields));
        let ports = fields.chain(interface.status.iter().map(|status| &status.port).zip(&status));
        let absent = ports.filter(|(_, wire)| **wire == Wire::Absent).map(|(port, _)| port.name.clone());
        let not_compared = absent.collect();
        let found = found.cloned();
        Ok(Wiring { dut: self, links, constants, levels, status, found, not_compared })
    }
}

/// The table of the file for a channel.
fn table(link: &Link) -> String {
    format!("{}.{}", if link.direction == Direction::In { "in" } else { "out" }, link.name)
}

/// What the file calls a field: without the prefix of its channel.
fn field_name<'a>(link: &Link, port: &'a Port) -> &'a str {
    port.name.strip_prefix(&format!("{}_", link.name)).unwrap_or(&port.name)
}

struct Check<'a> {
    dut: &'a Dut,
    found: Option<&'a BTreeMap<String, Found>>,
    /// Ports that stand for something, with the key that says so.
    used: BTreeMap<String, String>,
}

impl Check<'_> {
    fn error(
        &self,
        key: impl Into<String>,
        found: impl Into<String>,
        permitted: impl Into<String>,
    ) -> DutError {
        DutError::new(&self.dut.file, key, found, permitted)
    }

    /// A port of the design; gives the bits that it has above the value of `what`.
    fn port(&mut self, key: &str, name: &str, width: u32, input: bool, what: &str) -> Result<u32, DutError> {
        if let Some(other) = self.used.insert(name.to_owned(), key.to_owned()) {
            return Err(self.error(
                key,
                format!("port {name}, which stands for {other}"),
                "a port of its own",
            ));
        }
        let Some(ports) = self.found else { return Ok(0) };
        let way = |input: bool| if input { "input" } else { "output" };
        let Some(found) = ports.get(name) else {
            let names: Vec<&str> =
                ports.iter().filter(|(_, p)| p.input == input).map(|(n, _)| n.as_str()).collect();
            let said = format!("{} has no port {name} for {what}", self.dut.top);
            return Err(DutError::unknown(&self.dut.file, key, said, name, names));
        };
        if found.input != input {
            let said = format!("port {name} is an {}", way(found.input));
            return Err(self.error(key, said, format!("an {} for {what}", way(input))));
        }
        let bits = |n: u32| format!("{n} bit{}", if n == 1 { "" } else { "s" });
        match found.width.checked_sub(width) {
            Some(0) => Ok(0),
            Some(above) if self.dut.widths == Widths::Extend => Ok(above),
            wider => {
                let said = format!("port {name} has {}", bits(found.width));
                let error = self.error(key, said, format!("{} for {what}", bits(width)));
                Err(if wider.is_some() { error.advised("or set widths = \"extend\"") } else { error })
            }
        }
    }

    /// Tables stand for channels of the unit.
    fn channels(&self, interface: &Interface, direction: Direction) -> Result<(), DutError> {
        let (given, other, way, opposite) = match direction {
            Direction::In => (&self.dut.inputs, Direction::Out, "in", "out"),
            Direction::Out => (&self.dut.outputs, Direction::In, "out", "in"),
        };
        let names: Vec<&str> = interface.links_of(direction).map(|link| link.name).collect();
        let Some(name) = given.keys().find(|name| !names.contains(&name.as_str())) else { return Ok(()) };
        let key = format!("{way}.{name}");
        let found = format!("{} has no channel {way} {name}", interface.unit.name());
        if interface.links_of(other).any(|link| link.name == name) {
            let error = self.error(key, found, names.join(", "));
            return Err(error.advised(format!("{name} is a channel {opposite}: [{opposite}.{name}]")));
        }
        Err(DutError::unknown(&self.dut.file, key, found, name, names))
    }

    /// `[memories]` names memories of the unit.
    fn memories(&self, interface: &Interface) -> Result<(), DutError> {
        let names: Vec<&str> = interface.memories.iter().map(|memory| memory.name).collect();
        match self.dut.memories.keys().find(|name| !names.contains(&name.as_str())) {
            None => Ok(()),
            Some(name) => {
                let found = format!("{} has no memory {name}", interface.unit.name());
                Err(DutError::unknown(&self.dut.file, format!("memories.{name}"), found, name, names))
            }
        }
    }

    /// Whether the design has this memory inside.
    fn has(&self, memory: &Memory) -> bool {
        self.dut.memories.contains_key(memory.name)
    }

    fn link(&mut self, interface: &Interface, link: &Link) -> Result<Ends, DutError> {
        let table = table(link);
        let input = link.direction == Direction::In;
        let given = if input { &self.dut.inputs } else { &self.dut.outputs };
        let of_it = |memory: &&Memory| {
            [memory.read, memory.data].iter().any(|place| interface.links[*place].name == link.name)
        };
        if let Some(memory) = interface.memories.iter().find(of_it).filter(|memory| self.has(memory)) {
            return match given.get(link.name) {
                None => Ok(Ends {
                    valid: None,
                    ready: None,
                    fields: vec![Wire::Absent; link.fields.len()],
                    packed: None,
                }),
                Some(_) => {
                    let found = format!("a channel of the memory {}, which is inside", memory.name);
                    Err(self.error(table, found, "channels of other memories"))
                }
            };
        }
        let given = given.get(link.name).cloned().unwrap_or_default();
        let prefix = given.prefix.clone().unwrap_or_else(|| format!("{}_", link.name));
        let names: Vec<&str> = link.fields.iter().map(|port| field_name(link, port)).collect();
        self.named_fields(&table, &given, &names)?;
        let end = |name: &Option<String>, end: &str| name.clone().unwrap_or_else(|| format!("{prefix}{end}"));
        let valid = end(&given.valid, "valid");
        self.port(&format!("{table}.valid"), &valid, 1, input, &format!("{}_valid", link.name))?;
        let ready = match given.absent.iter().any(|absent| absent == "ready") {
            true => None,
            false => {
                let ready = end(&given.ready, "ready");
                self.port(&format!("{table}.ready"), &ready, 1, !input, &format!("{}_ready", link.name))?;
                Some(ready)
            }
        };
        let mut fields = Vec::new();
        for (port, name) in link.fields.iter().zip(&names) {
            fields.push(if given.absent.iter().any(|absent| absent == name) {
                self.may_be_absent(interface, link, port, &table)?;
                Wire::Absent
            } else if let (Some(_), None) = (&given.packed, given.fields.get(*name)) {
                Wire::Packed
            } else {
                let own = given.fields.get(*name).cloned();
                let own = own.unwrap_or_else(|| match &given.prefix {
                    Some(prefix) => format!("{prefix}{name}"),
                    None => port.name.clone(),
                });
                let key = format!("{table}.fields.{name}");
                let above = self.port(&key, &own, port.width(), input, &port.name)?;
                Wire::Port { name: own, above }
            });
        }
        if !input && fields.iter().all(|wire| *wire == Wire::Absent) {
            let found = "every field is absent";
            return Err(self.error(format!("{table}.absent"), found, "one field or more that is compared"));
        }
        let packed = self.packed(&given, link, &names, &fields, &table)?;
        Ok(Ends { valid: Some(valid), ready, fields, packed })
    }

    /// What the table names are fields of the channel.
    fn named_fields(&self, table: &str, given: &Channel, names: &[&str]) -> Result<(), DutError> {
        let known = |key: String, name: &str, extra: Option<&'static str>| {
            let all: Vec<&str> = names.iter().copied().chain(extra).collect();
            match all.contains(&name) {
                true => Ok(()),
                false => {
                    let found = format!("the channel has no field {name}");
                    Err(DutError::unknown(&self.dut.file, key, found, name, all))
                }
            }
        };
        for name in given.fields.keys() {
            known(format!("{table}.fields.{name}"), name, None)?;
            if given.absent.contains(name) {
                let found = format!("{name}, which `fields` gives a port");
                return Err(self.error(format!("{table}.absent"), found, "fields without a port"));
            }
        }
        for name in &given.absent {
            known(format!("{table}.absent"), name, Some("ready"))?;
        }
        given.order.iter().flatten().try_for_each(|name| known(format!("{table}.order"), name, None))
    }

    /// A field that a memory of the bench needs must be there.
    fn may_be_absent(
        &self,
        interface: &Interface,
        link: &Link,
        port: &Port,
        table: &str,
    ) -> Result<(), DutError> {
        let of = |place: usize, field: usize| &interface.links[place].fields[field].name;
        let kept = interface.memories.iter().filter(|memory| !self.has(memory));
        let needs = kept.flat_map(|memory| {
            let write = memory.write.iter().flat_map(move |write| {
                [Some(write.address), Some(write.word), write.enable]
                    .into_iter()
                    .flatten()
                    .map(move |f| (write.link, f))
            });
            write.chain([(memory.read, 0)]).map(move |(link, field)| (of(link, field), memory.name))
        });
        match needs.into_iter().find(|(name, _)| link.direction == Direction::Out && **name == port.name) {
            None => Ok(()),
            Some((_, memory)) => {
                let found = format!("{}, by which the bench keeps the memory {memory}", port.name);
                Err(self.error(format!("{table}.absent"), found, "fields that are compared only"))
            }
        }
    }

    fn packed(
        &mut self,
        given: &Channel,
        link: &Link,
        names: &[&str],
        fields: &[Wire],
        table: &str,
    ) -> Result<Option<Packed>, DutError> {
        let Some(name) = given.packed.clone() else { return Ok(None) };
        let in_it: Vec<usize> = (0..fields.len()).filter(|place| fields[*place] == Wire::Packed).collect();
        let order = match &given.order {
            None => in_it.clone(),
            Some(order) => names_in(order, names),
        };
        let mut sorted = order.clone();
        sorted.sort_unstable();
        if sorted != in_it || in_it.is_empty() {
            let fields: Vec<&str> = in_it.iter().map(|place| names[*place]).collect();
            let found = format!("{:?}", given.order.as_deref().unwrap_or_default());
            let permitted = format!("each of {} once", fields.join(", "));
            return Err(self.error(format!("{table}.order"), found, permitted));
        }
        let width = in_it.iter().map(|place| link.fields[*place].width()).sum();
        let what = format!("the fields of {}", link.name);
        let input = link.direction == Direction::In;
        let above = self.port(&format!("{table}.packed"), &name, width, input, &what)?;
        Ok(Some(Packed { name, above, order }))
    }

    fn singles(&mut self, interface: &Interface, ports: &[Port], input: bool) -> Result<Vec<Wire>, DutError> {
        let mut wires = Vec::new();
        for port in ports {
            if self.dut.absent.contains(&port.name) {
                if !input {
                    let found = format!("{}, which {} gives", port.name, interface.unit.name());
                    let error = self.error("ports.absent", found, "inputs, as compare = \"cycle\"");
                    return Err(error.advised("compare = \"order\" needs no status ports"));
                }
                wires.push(Wire::Absent);
                continue;
            }
            let name = self.dut.ports.get(&port.name).unwrap_or(&port.name).clone();
            let key = format!("ports.{}", port.name);
            let above = self.port(&key, &name, port.width(), input, &port.name)?;
            if above > 0 && !input {
                let found = format!("port {name} has {} bits", port.width() + above);
                return Err(self.error(key, found, format!("{} for a status port", port.width())));
            }
            wires.push(Wire::Port { name, above });
        }
        Ok(wires)
    }

    /// `[ports]` names ports of the unit.
    fn other_ports(&self, interface: &Interface) -> Result<(), DutError> {
        let single = interface.constants.iter().chain(&interface.levels);
        let single = single.chain(interface.status.iter().map(|status| &status.port));
        let names: Vec<&str> = single.map(|port| port.name.as_str()).collect();
        let unit = interface.unit.name();
        let keys = self.dut.ports.keys().map(|name| (format!("ports.{name}"), name));
        for (key, name) in keys.chain(self.dut.absent.iter().map(|name| ("ports.absent".to_owned(), name))) {
            if !names.contains(&name.as_str()) {
                let found = format!("{unit} has no port {name} outside its channels");
                return Err(DutError::unknown(&self.dut.file, key, found, name, names));
            }
        }
        Ok(())
    }

    /// Every input of the design has a value.
    fn ties(&mut self) -> Result<(), DutError> {
        for (name, value) in &self.dut.tie {
            let key = format!("tie.{name}");
            if let Some(other) = self.used.insert(name.clone(), key.clone()) {
                let found = format!("port {name}, which stands for {other}");
                return Err(self.error(key, found, "an input of its own"));
            }
            let Some(ports) = self.found else { continue };
            let Some(found) = ports.get(name).filter(|found| found.input) else {
                let inputs: Vec<&str> =
                    ports.iter().filter(|(_, p)| p.input).map(|(n, _)| n.as_str()).collect();
                let said = format!("{} has no input {name}", self.dut.top);
                return Err(DutError::unknown(&self.dut.file, key, said, name, inputs));
            };
            if found.width < 64 && value >> found.width != 0 {
                let permitted =
                    format!("0 to {}, as the port has {} bits", (1u64 << found.width) - 1, found.width);
                return Err(self.error(key, value.to_string(), permitted));
            }
        }
        let mut open = self
            .found
            .into_iter()
            .flatten()
            .filter(|(name, port)| port.input && !self.used.contains_key(*name));
        match open.next() {
            None => Ok(()),
            Some((name, _)) => {
                let found = format!("input {name} of {} stands for nothing", self.dut.top);
                let error = self.error("tie", found, "every input has a value");
                Err(error.advised(format!("name what it stands for, or hold it: [tie] {name} = 0")))
            }
        }
    }
}

/// Places of these names.
fn names_in(order: &[String], names: &[&str]) -> Vec<usize> {
    order.iter().filter_map(|wanted| names.iter().position(|name| name == wanted)).collect()
}
