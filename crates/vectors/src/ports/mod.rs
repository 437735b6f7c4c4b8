//! The ports of the machine and of its units, as data: what a bench drives and what it compares.
//!
//! A channel `rd` with a field `addr` is the ports `rd_valid`, `rd_ready` and `rd_addr`. Names and formats are those of
//! `docs/machine.md`, sections 1 to 9, not read from a design: so a design with another port is found out.

mod fields;
mod tokens;
mod units;

pub use tokens::*;
pub use units::interface;

/// One field of a token, or a single port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name of the port.
    pub port: String,
    /// Bits, at most 128.
    pub width: u32,
    /// Two's complement.
    pub signed: bool,
    /// Format and unit.
    pub format: String,
}

/// Which way a channel's tokens go, seen from the design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Into the design.
    In,
    /// Out of the design.
    Out,
}

/// A valid/ready channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Prefix of its ports.
    pub name: &'static str,
    /// Which way its tokens go.
    pub direction: Direction,
    /// The fields of a token, the most significant first where they are packed.
    pub fields: Vec<Field>,
    /// The design's ready is defined, and compared, even while there is no valid. (Outputs' valids always are.)
    pub ready_always: bool,
}

/// An output that is compared in every cycle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Status {
    /// The port.
    pub field: Field,
    /// For a flag that does not always mean something: the port that is 1 while it does. It counts as 0 while not.
    pub during: Option<&'static str>,
}

/// A unit of the machine, or the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// All units together.
    Machine,
    /// Triangles to increments.
    Setup,
    /// Increments to lines.
    Edge,
    /// Lines to spans.
    Span,
    /// Spans to fragments.
    Pixel,
    /// Fragments to writes.
    Depth,
}

impl Unit {
    /// All, in the order the data flows; the whole first.
    pub const ALL: [Unit; 6] = [Unit::Machine, Unit::Setup, Unit::Edge, Unit::Span, Unit::Pixel, Unit::Depth];

    /// The word for it, in files and directories.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["machine", "setup", "edge", "span", "pixel", "depth"][self as usize]
    }

    /// Name of its Verilog module.
    #[must_use]
    pub fn module(self) -> String {
        match self {
            Unit::Machine => "edgewalk".to_owned(),
            _ => format!("edgewalk_{}", self.name()),
        }
    }
}

/// All ports of a unit but `clk` and `rst`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interface {
    /// Whose they are.
    pub unit: Unit,
    /// Channels: those in, then those out.
    pub channels: Vec<Channel>,
    /// Inputs that hold one value over the whole run.
    pub constants: Vec<Field>,
    /// One-bit inputs that may change in any cycle.
    pub levels: Vec<Field>,
    /// Outputs that are compared in every cycle.
    pub status: Vec<Status>,
    /// `rd` and `data` are the two ends of a depth memory that the bench has to be.
    pub memory: bool,
}

impl Channel {
    /// Bits of a packed token.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.fields.iter().map(|field| field.width).sum()
    }

    /// The place of the field whose port is `<name>_<field>`.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<usize> {
        let port = format!("{}_{name}", self.name);
        self.fields.iter().position(|field| field.port == port)
    }
}

impl Interface {
    /// The channels of one direction, in order.
    pub fn channels_of(&self, direction: Direction) -> impl Iterator<Item = &Channel> {
        self.channels.iter().filter(move |channel| channel.direction == direction)
    }

    /// The input ports with their widths, in the order in which [`crate::Device`] takes them: for every channel in
    /// turn valid and fields (in) or ready (out), then constants, then levels.
    #[must_use]
    pub fn inputs(&self) -> Vec<(String, u32)> {
        self.flat(Direction::In, self.constants.iter().chain(&self.levels))
    }

    /// The output ports with their widths, in the order in which [`crate::Device`] gives them: for every channel in
    /// turn valid and fields (out) or ready (in), then the status ports.
    #[must_use]
    pub fn outputs(&self) -> Vec<(String, u32)> {
        self.flat(Direction::Out, self.status.iter().map(|status| &status.field))
    }

    fn flat<'a>(&'a self, with_data: Direction, rest: impl Iterator<Item = &'a Field>) -> Vec<(String, u32)> {
        let mut ports = Vec::new();
        let plain = |field: &Field| (field.port.clone(), field.width);
        for channel in &self.channels {
            if channel.direction == with_data {
                ports.push((format!("{}_valid", channel.name), 1));
                ports.extend(channel.fields.iter().map(plain));
            } else {
                ports.push((format!("{}_ready", channel.name), 1));
            }
        }
        ports.extend(rest.map(plain));
        ports
    }
}
