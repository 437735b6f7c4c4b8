//! A node as Verilog text, in a place where exactly its own width is wanted.

use std::collections::BTreeMap;

use edgewalk_netlist::netlist::{Netlist, NodeId, Source};
use edgewalk_netlist::ops::{Bits, Op, mask};

use crate::literal;
use crate::paragraph::{Body, LINE};
use crate::usage::{Mentioned, Names};

/// An operand longer than this gets a name.
const LONGEST_OPERAND: usize = 64;

/// How a text may stand inside another.
#[derive(Clone, Copy, PartialEq)]
enum Shape {
    /// A name, a constant, braces, a call: anywhere.
    Atom,
    /// `~a`: inside a binary operator.
    Unary,
    /// `a + b`: alone, or under the same operator on its left.
    Binary(&'static str),
    /// `c ? a : b`: alone, or after the colon of another.
    Choice,
    /// `$signed(a) >>> 3`: alone; elsewhere its neighbours would turn it unsigned.
    Signed,
}

#[derive(Clone)]
struct Text {
    text: String,
    shape: Shape,
}

impl Text {
    fn new(text: String, shape: Shape) -> Self {
        Text { text, shape }
    }

    /// As an operand of the binary operator `of`.
    fn beside(self, of: &'static str, left: bool) -> String {
        let chain = matches!((self.shape, of), (Shape::Binary("+" | "-"), "+" | "-")) && left
            || self.shape == Shape::Binary(of) && ["&", "|", "^", "&&", "||"].contains(&of);
        match self.shape {
            Shape::Atom | Shape::Unary => self.text,
            Shape::Binary(_) if chain => self.text,
            Shape::Signed => format!("$unsigned({})", self.text),
            Shape::Binary(_) | Shape::Choice => format!("({})", self.text),
        }
    }

    /// As an operand of a unary operator.
    fn under(self) -> String {
        match self.shape {
            Shape::Atom => self.text,
            Shape::Signed => format!("$unsigned({})", self.text),
            _ => format!("({})", self.text),
        }
    }

    /// As one of the two values of a choice.
    fn chosen(self, last: bool) -> String {
        match self.shape {
            Shape::Signed => format!("$unsigned({})", self.text),
            Shape::Choice if !last => format!("({})", self.text),
            _ => self.text,
        }
    }
}

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
    fn name(&mut self, body: &mut Body, id: NodeId, hi: u32, lo: u32) -> String {
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
    fn text(&mut self, body: &mut Body, id: NodeId) -> Text {
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
    fn whole(&mut self, body: &mut Body, id: NodeId) -> String {
        self.name(body, id, self.netlist.width(id) - 1, 0)
    }

    /// As [`Self::text`], but named if it is long.
    fn operand(&mut self, body: &mut Body, id: NodeId) -> Text {
        let text = self.text(body, id);
        if text.text.len() <= LONGEST_OPERAND
            || matches!(self.netlist.node(id).source, Source::Constant { .. })
        {
            return text;
        }
        Text::new(self.whole(body, id), Shape::Atom)
    }

    /// As [`Self::operand`], but however long if it goes on with the same operator.
    fn chained(&mut self, body: &mut Body, op: Op, id: NodeId) -> Text {
        if self.goes_on(op, id) { self.text(body, id) } else { self.operand(body, id) }
    }

    /// The node is the same operator, written in place.
    fn goes_on(&self, op: Op, id: NodeId) -> bool {
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

    /// The value of a constant.
    fn constant(&self, id: NodeId) -> Option<Bits> {
        match self.netlist.node(id).source {
            Source::Constant { value, .. } => Some(Bits { value, width: self.netlist.width(id) }),
            _ => None,
        }
    }

    fn operator(&mut self, body: &mut Body, id: NodeId) -> Text {
        let Source::Op(op, operands) = &self.netlist.node(id).source else {
            return self.text(body, id);
        };
        let width = self.netlist.width(id);
        if let Some(value) = self.known(*op, operands, width) {
            return Text::new(literal::unsigned(Bits { value, width }), Shape::Atom);
        }
        let a = operands[0];
        match op {
            Op::Slice { hi, lo } => self.bits(body, a, *hi, *lo),
            Op::ZeroExtend(_) => self.extended(body, a, width, false),
            Op::SignExtend(_) => self.extended(body, a, width, true),
            Op::Sar(n) if *n >= width => self.signs(body, a, width),
            Op::Concat => {
                let parts: Vec<String> = operands.iter().map(|id| self.operand(body, *id).text).collect();
                Text::new(format!("{{{}}}", parts.join(", ")), Shape::Atom)
            }
            Op::Mux => {
                let condition = self.operand(body, a).beside("?", true);
                let then = self.operand(body, operands[1]).chosen(false);
                let otherwise = self.chained(body, *op, operands[2]).chosen(true);
                Text::new(format!("{condition} ? {then} : {otherwise}"), Shape::Choice)
            }
            Op::Mul | Op::MulSigned => {
                let signed = *op == Op::MulSigned;
                let [left, right] = [a, operands[1]].map(|id| self.extended(body, id, width, signed));
                if signed {
                    let text = format!("$signed({}) * $signed({})", left.text, right.text);
                    return Text::new(text, Shape::Signed);
                }
                Text::new(
                    format!("{} * {}", left.beside("*", true), right.beside("*", false)),
                    Shape::Binary("*"),
                )
            }
            Op::Shl(n) | Op::Shr(n) => {
                let sign = if matches!(op, Op::Shl(_)) { "<<" } else { ">>" };
                let left = self.operand(body, a).beside(sign, true);
                Text::new(format!("{left} {sign} {n}"), Shape::Binary(sign))
            }
            Op::Sar(n) => {
                let left = self.operand(body, a).text;
                Text::new(format!("$signed({left}) >>> {n}"), Shape::Signed)
            }
            Op::SarBy => {
                let left = self.operand(body, a).text;
                let right = self.operand(body, operands[1]).beside(">>>", false);
                Text::new(format!("$signed({left}) >>> {right}"), Shape::Signed)
            }
            Op::LtSigned | Op::LeSigned | Op::GtSigned | Op::GeSigned => {
                let [left, right] = [a, operands[1]].map(|id| self.signed(body, id));
                let sign = symbol(*op, width);
                Text::new(format!("{left} {sign} {right}"), Shape::Binary(sign))
            }
            Op::Any | Op::All | Op::Parity if self.netlist.width(a) == 1 => self.text(body, a),
            Op::Neg | Op::Not | Op::Any | Op::All | Op::Parity => {
                let sign = symbol(*op, width);
                let text = format!("{sign}{}", self.operand(body, a).under());
                // A reduction inside looks like a binary operator: it gets parentheses like one.
                let is_reduction = matches!(op, Op::Any | Op::All | Op::Parity);
                Text::new(text, if is_reduction { Shape::Binary("reduction") } else { Shape::Unary })
            }
            _ => {
                let sign = symbol(*op, width);
                let left = self.chained(body, *op, a).beside(sign, true);
                let right = self.operand(body, operands[1]).beside(sign, false);
                Text::new(format!("{left} {sign} {right}"), Shape::Binary(sign))
            }
        }
    }

    /// The value of an operator that tools would complain about: it does not depend on any signal.
    fn known(&self, op: Op, operands: &[NodeId], width: u32) -> Option<u128> {
        let constants: Option<Vec<Bits>> = operands.iter().map(|id| self.constant(*id)).collect();
        if let Some(constants) = constants {
            return Some(op.value(width, &constants));
        }
        match (op, operands) {
            (Op::Shl(n) | Op::Shr(n), _) if n >= width => Some(0),
            (Op::Lt | Op::Le | Op::Gt | Op::Ge, &[a, b]) => {
                self.always(op, a, b, [0, mask(self.netlist.width(a))])
            }
            (Op::LtSigned | Op::LeSigned | Op::GtSigned | Op::GeSigned, &[a, b]) => {
                let half = 1u128 << (self.netlist.width(a) - 1);
                self.always(op, a, b, [half, half - 1])
            }
            _ => None,
        }
    }

    /// The result of a comparison with a constant, if it is the same for both ends of the other side's range.
    fn always(&self, op: Op, a: NodeId, b: NodeId, ends: [u128; 2]) -> Option<u128> {
        let width = self.netlist.width(a);
        let results = ends.map(|value| {
            let end = Bits { value, width };
            match (self.constant(a), self.constant(b)) {
                (Some(a), None) => Some(op.value(1, &[a, end])),
                (None, Some(b)) => Some(op.value(1, &[end, b])),
                _ => None,
            }
        });
        results[0].filter(|_| results[0] == results[1])
    }

    fn bits(&mut self, body: &mut Body, of: NodeId, hi: u32, lo: u32) -> Text {
        if lo == 0 && hi + 1 == self.netlist.width(of) {
            return self.text(body, of);
        }
        let name = self.name(body, of, hi, lo);
        let range = if hi == lo { format!("[{hi}]") } else { format!("[{hi}:{lo}]") };
        Text::new(name + &range, Shape::Atom)
    }

    fn extended(&mut self, body: &mut Body, id: NodeId, width: u32, signed: bool) -> Text {
        let own = self.netlist.width(id);
        let more = width - own;
        if more == 0 {
            return self.text(body, id);
        }
        if let Some(bits) = self.constant(id) {
            let op = if signed { Op::SignExtend(width) } else { Op::ZeroExtend(width) };
            let value = op.value(width, &[bits]);
            return Text::new(literal::unsigned(Bits { value, width }), Shape::Atom);
        }
        if !signed {
            let zeros = literal::unsigned(Bits { value: 0, width: more });
            let low = self.operand(body, id).text;
            return Text::new(format!("{{{zeros}, {low}}}"), Shape::Atom);
        }
        if own == 1 {
            return self.signs(body, id, width);
        }
        let sign = self.signs(body, id, more).text;
        let name = self.whole(body, id);
        Text::new(format!("{{{sign}, {name}}}"), Shape::Atom)
    }

    /// The sign of `of`, `count` times.
    fn signs(&mut self, body: &mut Body, of: NodeId, count: u32) -> Text {
        let top = self.netlist.width(of) - 1;
        let sign = self.bits(body, of, top, top).text;
        Text::new(if count == 1 { sign } else { format!("{{{count}{{{sign}}}}}") }, Shape::Atom)
    }

    /// As an operand of a signed comparison.
    fn signed(&mut self, body: &mut Body, id: NodeId) -> String {
        match self.constant(id) {
            Some(bits) => literal::signed(bits),
            None => format!("$signed({})", self.operand(body, id).text),
        }
    }

    /// A choice, a chain of one operator or a concatenation, a part on each line; `fill` leads to its column.
    fn broken(&mut self, body: &mut Body, id: NodeId, fill: &str) -> Option<String> {
        let Source::Op(op, operands) = &self.netlist.node(id).source else { return None };
        match op {
            Op::Mux => {
                let condition = self.operand(body, operands[0]).beside("?", true);
                let then = self.operand(body, operands[1]).chosen(false);
                let last = operands[2];
                let otherwise = match self.goes_on(*op, last) {
                    true => self.broken(body, last, fill)?,
                    false => self.operand(body, last).chosen(true),
                };
                Some(format!("{condition} ? {then}\n{}: {otherwise}", &fill[..fill.len().saturating_sub(2)]))
            }
            Op::Concat => {
                let parts: Vec<String> = operands.iter().map(|id| self.operand(body, *id).text).collect();
                Some(format!("{{{}}}", parts.join(&format!(",\n{fill} "))))
            }
            Op::And | Op::Or | Op::Xor | Op::Add | Op::Sub => {
                let sign = symbol(*op, self.netlist.width(id));
                let left = match self.goes_on(*op, operands[0]) {
                    true => self.broken(body, operands[0], fill)?,
                    false => self.operand(body, operands[0]).beside(sign, true),
                };
                let right = self.operand(body, operands[1]).beside(sign, false);
                Some(format!("{left}\n{}{sign} {right}", &fill[..fill.len().saturating_sub(sign.len() + 1)]))
            }
            _ => None,
        }
    }
}

/// The operator's sign; on single bits the logical one.
fn symbol(op: Op, width: u32) -> &'static str {
    match op {
        Op::Add => "+",
        Op::Sub | Op::Neg => "-",
        Op::Mul | Op::MulSigned => "*",
        Op::And if width == 1 => "&&",
        Op::And | Op::All => "&",
        Op::Or if width == 1 => "||",
        Op::Or | Op::Any => "|",
        Op::Xor | Op::Parity => "^",
        Op::Not if width == 1 => "!",
        Op::Not => "~",
        Op::Eq => "==",
        Op::Ne => "!=",
        Op::Lt | Op::LtSigned => "<",
        Op::Le | Op::LeSigned => "<=",
        Op::Gt | Op::GtSigned => ">",
        Op::Ge | Op::GeSigned => ">=",
        Op::Shl(_) | Op::ShlBy => "<<",
        Op::Shr(_) | Op::ShrBy => ">>",
        Op::Sar(_) | Op::SarBy => ">>>",
        Op::Mux => "?",
        Op::Slice { .. } | Op::ZeroExtend(_) | Op::SignExtend(_) | Op::Concat => "",
    }
}

/// What an operator's result is called if it has to be called something.
fn stem(op: Op) -> &'static str {
    match op {
        Op::Add => "sum",
        Op::Sub => "difference",
        Op::Neg => "negative",
        Op::Mul | Op::MulSigned => "product",
        Op::And => "both",
        Op::Or => "either",
        Op::Xor => "differing",
        Op::Not => "inverse",
        Op::Eq => "equal",
        Op::Ne => "unequal",
        Op::Lt | Op::LtSigned => "less",
        Op::Le | Op::LeSigned => "at_most",
        Op::Gt | Op::GtSigned => "greater",
        Op::Ge | Op::GeSigned => "at_least",
        Op::Mux => "choice",
        Op::Shl(_) | Op::Shr(_) | Op::Sar(_) | Op::ShlBy | Op::ShrBy | Op::SarBy => "shifted",
        Op::Slice { .. } => "part",
        Op::ZeroExtend(_) | Op::SignExtend(_) => "extended",
        Op::Concat => "joined",
        Op::Any => "any",
        Op::All => "every",
        Op::Parity => "parity",
    }
}
