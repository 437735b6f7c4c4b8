//! What joins the units: links with a handshake, values held beside them, ports of memories, status.

use crate::field::Field;

/// When the ready of a link means something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ready {
    /// In every cycle.
    Always,
    /// While valid is high: it depends on the token that is offered.
    WhileValid,
}

/// A valid/ready link: `name_valid`, `name_ready` and a port `name_field` for every field. A token moves in a cycle where
/// valid and ready are high.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Link {
    /// Prefix of its ports.
    pub name: &'static str,
    /// The fields of a token, in the order of the ports; packed, the first is the most significant.
    pub fields: Vec<Field>,
    /// When the taker's ready means something.
    pub ready: Ready,
    /// Not empty: a token comes as so many words, one after the other in the first field. The low bits of a word are the value, what
    /// stands above them is not seen. The other fields count with the last word. A token moves with its last word.
    pub words: Vec<Field>,
}

impl Link {
    pub(crate) fn new(name: &'static str, fields: Vec<Field>) -> Link {
        Link { name, fields, ready: Ready::Always, words: Vec::new() }
    }

    /// Bits of a packed token.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.fields.iter().map(Field::width).sum()
    }

    /// The place of a field.
    #[must_use]
    pub fn place(&self, field: &str) -> Option<usize> {
        self.fields.iter().position(|f| f.name == field)
    }
}

/// How long values are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Until {
    /// Until the giver takes its next token.
    Taken,
    /// Until the giver takes its next token with this flag.
    TakenWith(&'static str),
    /// Until the giver offers its next token. A taker looks at them with the token alone.
    Offered,
}

/// Values without a handshake, ports `name_field`: they hold from one token of the link beside them to the next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Held {
    /// Prefix of its ports.
    pub name: &'static str,
    /// The values.
    pub fields: Vec<Field>,
    /// The link of the giver and of the taker whose tokens they belong to.
    pub beside: &'static str,
    /// How long the giver holds them.
    pub until: Until,
}

/// A word memory outside the datapath: a read link for addresses, a data link back in order, and a write link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MemoryPort {
    /// What is stored there.
    pub name: &'static str,
    /// Address out.
    pub read: Link,
    /// Word in, at the earliest `latency` clocks after the read fired.
    pub data: Link,
    /// The link that writes.
    pub write: &'static str,
    /// The field of `write` that is stored.
    pub word: &'static str,
    /// The field of `write` that permits it, if not every write of it is meant.
    pub enable: Option<&'static str>,
    /// Clocks from a read to its data, at the least.
    pub latency: u32,
}

/// An output that means something without a handshake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Status {
    /// The port.
    pub field: Field,
    /// For a flag that does not always mean something: the port that is 1 while it does. It counts as 0 while not.
    pub during: Option<&'static str>,
}

impl Status {
    pub(crate) fn new(name: &str, doc: &str) -> Status {
        Status { field: Field::count(name, 1, doc), during: None }
    }

    /// Meaning of the port, and when it counts.
    #[must_use]
    pub fn meaning(&self) -> String {
        let during = self.during.map(|port| format!(", while {port} is 1")).unwrap_or_default();
        format!("{}{during}", self.field)
    }

    pub(crate) fn during(self, port: &'static str) -> Status {
        Status { during: Some(port), ..self }
    }
}
