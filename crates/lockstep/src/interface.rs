//! The ports of the machine or of a unit, as the declarations of crate `machine` have them, each with an id.
//!
//! ```text
//!  Plan, Unit ──declarations──> links, memories, constants, levels, status ──> port table: inputs, outputs, inner
//! ```
//! A link `rd` with a field `addr` is the ports `rd_valid`, `rd_ready` and `rd_addr`. Nothing is read from a design: so a
//! design with another port is found out. Values that a unit holds beside a link stand behind the fields of that link.

mod inner;
mod link;

pub use link::{Direction, Link, Memory, MemoryWrite, Port, StatusPort};

use crate::unit::Unit;
use crate::values::{PortId, PortValues};
use edgewalk_machine::{Field, Held, Plan, Ports};
use link::{flag, port_of};

/// All ports of a unit but `clk` and `rst`.
#[derive(Clone, Debug)]
pub struct Interface {
    /// The unit that has the ports.
    pub unit: Unit,
    /// Links: those in, then those out.
    pub links: Vec<Link>,
    /// Inputs that hold one value over the whole run.
    pub constants: Vec<Port>,
    /// One-bit inputs that may change in any cycle.
    pub levels: Vec<Port>,
    /// Outputs that mean something without a handshake.
    pub status: Vec<StatusPort>,
    /// Memories that whoever drives the unit has to be.
    pub memories: Vec<Memory>,
    /// The ends of links between the units inside, where these are compared too: of one that a unit takes only the
    /// ready is its own, of one that it gives all but the ready.
    pub(crate) inner: Vec<Link>,
    /// Status outputs of the units inside.
    pub(crate) inner_status: Vec<StatusPort>,
    ports: Vec<Port>,
    inputs: usize,
    outputs: usize,
}

impl Interface {
    /// The ports of a unit of this machine, or of the whole.
    #[must_use]
    pub fn new(plan: &Plan, unit: Unit) -> Interface {
        Interface::of_ports(unit, &unit.ports(plan))
    }

    /// The ports of the whole machine, and the outputs of every unit in it.
    #[must_use]
    pub fn with_units(plan: &Plan) -> Interface {
        let mut interface = Interface::new(plan, Unit::MACHINE);
        for unit in Unit::single(plan) {
            interface.add_inner(unit, &unit.ports(plan));
        }
        interface.find_guards();
        interface
    }

    /// Like `with_units`, for ports that somebody else declares.
    #[must_use]
    pub fn of_ports(unit: Unit, declared: &Ports) -> Interface {
        let mut interface = Interface {
            unit,
            links: Vec::new(),
            constants: Vec::new(),
            levels: Vec::new(),
            status: Vec::new(),
            memories: Vec::new(),
            inner: Vec::new(),
            inner_status: Vec::new(),
            ports: Vec::new(),
            inputs: 0,
            outputs: 0,
        };
        interface.add_links(declared);
        interface.add_inputs(declared);
        interface.add_outputs(declared);
        interface.memories = declared.memory.iter().map(|memory| interface.memory(memory)).collect();
        interface
    }

    fn add_links(&mut self, declared: &Ports) {
        let mut add = |direction, link: &edgewalk_machine::Link, held: &[Held]| {
            self.links.push(Link::declared(self.unit.name(), direction, link, held));
        };
        if let Some(link) = &declared.takes {
            add(Direction::In, link, &declared.held_in);
        }
        for memory in &declared.memory {
            add(Direction::In, &memory.data, &[]);
        }
        for memory in &declared.memory {
            add(Direction::Out, &memory.read, &[]);
        }
        for link in &declared.writes {
            add(Direction::Out, link, &[]);
        }
        if let Some(link) = &declared.gives {
            add(Direction::Out, link, &declared.held_out);
        }
    }

    /// For every link in turn valid and fields (in) or ready (out), then constants, then levels.
    fn add_inputs(&mut self, declared: &Ports) {
        let mut links = std::mem::take(&mut self.links);
        for link in &mut links {
            match link.direction {
                Direction::In => self.place_token(link),
                Direction::Out => link.ready = self.place(flag(self.unit.name(), link.name, "ready")),
            }
        }
        self.links = links;
        self.constants = self.add_single(&declared.constants);
        self.levels = self.add_single(&declared.levels);
        self.inputs = self.ports.len();
    }

    fn add_single(&mut self, fields: &[Field]) -> Vec<Port> {
        let owner = self.unit.name();
        let ids = fields.iter().map(|field| self.place(port_of(owner, field.name.clone(), field)));
        ids.collect::<Vec<_>>().into_iter().map(|id| self.at(id).clone()).collect()
    }

    /// For every link in turn valid and fields (out) or ready (in), then the status ports.
    fn add_outputs(&mut self, declared: &Ports) {
        let mut links = std::mem::take(&mut self.links);
        for link in &mut links {
            match link.direction {
                Direction::Out => self.place_token(link),
                Direction::In => link.ready = self.place(flag(self.unit.name(), link.name, "ready")),
            }
        }
        self.links = links;
        self.status = self.add_status(self.unit, declared);
        self.outputs = self.ports.len();
        self.find_guards();
    }

    fn add_status(&mut self, unit: Unit, declared: &Ports) -> Vec<StatusPort> {
        let status = declared.status.iter().map(|status| {
            let id = self.place(port_of(unit.name(), status.field.name.clone(), &status.field));
            StatusPort { port: self.at(id).clone(), during: status.during, guard: None }
        });
        status.collect()
    }

    fn place(&mut self, port: Port) -> PortId {
        let id = PortId(self.ports.len());
        self.ports.push(Port { id, ..port });
        id
    }

    /// Valid and fields, side by side.
    fn place_token(&mut self, link: &mut Link) {
        link.valid = self.place(flag(link.owner, link.name, "valid"));
        for field in &mut link.fields {
            field.id = PortId(self.ports.len());
            self.ports.push(field.clone());
        }
    }

    fn memory(&self, declared: &edgewalk_machine::MemoryPort) -> Memory {
        let link = |name: &str| self.links.iter().position(|link| link.name == name);
        let address = declared.read.fields.first().map_or("", |field| &field.name);
        let write = link(declared.write).map(|place| {
            let of = |field: &str| {
                self.links[place].place(field).expect("a declared write has the memory's fields")
            };
            MemoryWrite {
                link: place,
                address: of(address),
                word: of(declared.word),
                enable: declared.enable.map(of),
            }
        });
        Memory {
            name: declared.name,
            read: link(declared.read.name).expect("a memory's links are among those of its unit"),
            data: link(declared.data.name).expect("a memory's links are among those of its unit"),
            write,
            address_bits: declared.read.fields.first().map_or(0, Field::width),
            word_bits: declared.data.width(),
            latency: u64::from(declared.latency),
        }
    }

    /// The port of that name; of a unit inside it is `edge.line_valid`.
    #[must_use]
    pub fn port(&self, name: &str) -> Option<&Port> {
        let (owner, name) = name.split_once('.').unwrap_or((self.unit.name(), name));
        self.ports.iter().find(|port| port.owner == owner && port.name == name)
    }

    /// A port by its id.
    #[must_use]
    pub fn at(&self, id: PortId) -> &Port {
        &self.ports[id.0]
    }

    /// The input ports: for every link in turn valid and fields (in) or ready (out), then constants, then levels.
    #[must_use]
    pub fn inputs(&self) -> &[Port] {
        &self.ports[..self.inputs]
    }

    /// The output ports: for every link in turn valid and fields (out) or ready (in), then the status ports.
    #[must_use]
    pub fn outputs(&self) -> &[Port] {
        &self.ports[self.inputs..self.outputs]
    }

    /// The output ports of the units inside, if they are compared.
    #[must_use]
    pub fn inner_outputs(&self) -> &[Port] {
        &self.ports[self.outputs..]
    }

    /// The links of one direction, in order.
    pub fn links_of(&self, direction: Direction) -> impl Iterator<Item = &Link> {
        self.links.iter().filter(move |link| link.direction == direction)
    }

    /// The link of that name.
    #[must_use]
    pub fn link(&self, name: &str) -> Option<&Link> {
        self.links.iter().find(|link| link.name == name)
    }

    /// Names of all that the rig can make wait: links, then levels.
    pub fn waits(&self) -> impl Iterator<Item = &str> {
        self.links.iter().map(|link| link.name).chain(self.levels.iter().map(|level| level.name.as_str()))
    }

    /// A value for every port, all 0.
    #[must_use]
    pub fn values(&self) -> PortValues {
        PortValues::new(self.inputs, self.ports.len(), self.links.len() + self.inner.len())
    }
}
