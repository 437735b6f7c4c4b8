//! A node as Verilog text, in a place where exactly its own width is wanted.

use std::collections::BTreeMap;

use edgewalk_netlist::netlist::{Netlist, NodeId, Source};
use edgewalk_netlist::ops::{Bits, Op};

use crate::literal;
use crate::paragraph::{Body, LINE};
use crate::symbols::stem;
use crate::text::{Shape, Text};
use crate::usage::{Mentioned, Names};

/// An operand longer than this gets a name.
const LONGEST_OPERAND: usize = 64;

/// Writes expressions, and what they need declared before them.
pub(crate) struct Writer<'n> {
    pub netlist: &'n Netlist,
    pub names: Names,
    pub mentioned: Mentioned,
    fanout: Vec<usize>,
    /// Operators that have a name here and none in the netlist.
    made_up: BTreeMap<NodeId, MadeUp>,
}

/// A name of an operator.
struct MadeUp {
    name: String,
    /// The node whose declaration bears the name: the operator itself, or the wire it drives.
    carrier: NodeId,
}

impl<'n> Writer<'n> {
    pub fn new(netlist: &'n Netlist, fanout: Vec<usize>) -> Self {
        Writer {
            netlist,
            names: Names::of(netlist),
            mentioned: Mentioned::default(),
            fanout,
            made_up: BTreeMap::new(),
        }
    }

    /// The operators that were declared here, with their names.
    pub fn declared(&self) -> impl Iterator<Item = (NodeId, &str)> {
        let own = self.made_up.iter().filter(|(id, of)| **id == of.carrier);
        own.map(|(id, of)| (*id, of.name.as_str()))
    }

    /// The node where it stands alone, after `before` on the line; broken into lines if it is long.
    pub fn alone(&mut self, body: &mut Body, before: &str, id: NodeId) -> String {
        if self.is_inline(id) {
            return self.in_lines(body, before, id);
        }
        format!("{before}{}", self.text(body, id).text)
    }

    /// An operator after `before`, broken into lines if it is long.
    fn in_lines(&mut self, body: &mut Body, before: &str, id: NodeId) -> String {
        let flat = self.operator(body, id).text;
        let column = before.chars().count();
        if column + flat.chars().count() < LINE {
            return format!("{before}{flat}");
        }
        let fill = " ".repeat(column.min(LINE / 2));
        format!("{before}{}", self.broken(body, id, &fill).unwrap_or(flat))
    }

    /// The driver of the wire `name` with the node `wire`, which from here on is the name of an operator without one.
    pub fn driver(&mut self, body: &mut Body, before: &str, wire: NodeId, id: NodeId) -> String {
        if !self.is_nameless(id) {
            return self.alone(body, before, id);
        }
        let text = self.in_lines(body, before, id);
        if let Some(name) = self.netlist.name_of(wire) {
            self.made_up.insert(id, MadeUp { name, carrier: wire });
        }
        text
    }

    /// An operator that has no name yet.
    fn is_nameless(&self, id: NodeId) -> bool {
        matches!(self.netlist.node(id).source, Source::Op(..)) && !self.made_up.contains_key(&id)
    }

    /// A signal by name, made up if need be: what may be indexed. Bits `hi` to `lo` of it are mentioned.
    pub fn name(&mut self, body: &mut Body, id: NodeId, hi: u32, lo: u32) -> String {
        let (name, carrier) = match self.netlist.name_of(id) {
            Some(name) => (name, id),
            None => {
                if !self.made_up.contains_key(&id) {
                    self.make_up(body, id);
                }
                self.made_up.get(&id).map(|of| (of.name.clone(), of.carrier)).unwrap_or((String::new(), id))
            }
        };
        self.mentioned.bits(carrier, hi, lo);
        name
    }

    /// Declares a wire for an operator.
    fn make_up(&mut self, body: &mut Body, id: NodeId) {
        let width = self.netlist.width(id);
        let stem = match &self.netlist.node(id).source {
            Source::Op(op, _) => stem(*op),
            _ => "value",
        };
        let name = self.names.fresh(stem);
        let before = format!("wire {}{name} = ", literal::range(width));
        let text = self.in_lines(body, &before, id);
        body.line(format!("{text};"), "");
        self.made_up.insert(id, MadeUp { name, carrier: id });
    }

    /// The node in place: its name, or its operator if nothing speaks against it.
    pub fn text(&mut self, body: &mut Body, id: NodeId) -> Text {
        if let Source::Constant { value, name: None } = self.netlist.node(id).source {
            let bits = Bits { value, width: self.netlist.width(id) };
            return Text::new(literal::unsigned(bits), Shape::Atom);
        }
        if self.is_inline(id) {
            return self.operator(body, id);
        }
        Text::new(self.whole(body, id), Shape::Atom)
    }

    /// An operator that is written where it is used.
    fn is_inline(&self, id: NodeId) -> bool {
        self.is_nameless(id) && (self.fanout[id.index()] <= 1 || self.is_light(id))
    }

    /// All bits of a signal, by name.
    pub fn whole(&mut self, body: &mut Body, id: NodeId) -> String {
        self.name(body, id, self.netlist.width(id) - 1, 0)
    }

    /// As [`Self::text`], but named if it is long.
    pub fn operand(&mut self, body: &mut Body, id: NodeId) -> Text {
        let text = self.text(body, id);
        if text.text.len() <= LONGEST_OPERAND
            || matches!(self.netlist.node(id).source, Source::Constant { .. })
        {
            return text;
        }
        Text::new(self.whole(body, id), Shape::Atom)
    }

    /// As [`Self::operand`], but however long if it goes on with the same operator.
    pub fn chained(&mut self, body: &mut Body, op: Op, id: NodeId) -> Text {
        if self.goes_on(op, id) { self.text(body, id) } else { self.operand(body, id) }
    }

    /// The node is the same operator, written in place.
    pub fn goes_on(&self, op: Op, id: NodeId) -> bool {
        self.is_inline(id) && matches!(self.netlist.node(id).source, Source::Op(same, _) if same == op)
    }

    /// So short that repeating it reads better than a name.
    fn is_light(&self, id: NodeId) -> bool {
        match &self.netlist.node(id).source {
            Source::Op(Op::Slice { .. } | Op::Not | Op::ZeroExtend(_), operands) => {
                let operand = &self.netlist.node(operands[0]);
                !matches!(operand.source, Source::Op(..))
            }
            _ => false,
        }
    }
}
