//! Each operator as Verilog, in a place where exactly its own width is wanted.

use edgewalk_netlist::netlist::{NodeId, Source};
use edgewalk_netlist::ops::{Bits, Op};

use crate::expression::Writer;
use crate::literal;
use crate::paragraph::Body;
use crate::simplify;
use crate::symbols::symbol;
use crate::text::{Shape, Text};

impl Writer<'_> {
    /// An operator written out.
    pub fn operator(&mut self, body: &mut Body, id: NodeId) -> Text {
        let Source::Op(op, operands) = &self.netlist.node(id).source else {
            return self.text(body, id);
        };
        let width = self.netlist.width(id);
        if let Some(value) = simplify::known(self.netlist, *op, operands, width) {
            return Text::new(literal::unsigned(Bits { value, width }), Shape::Atom);
        }
        if let Some(same) = simplify::passed_on(self.netlist, *op, operands, width) {
            return self.text(body, same);
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
        if let Some(bits) = simplify::constant(self.netlist, id) {
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
        match simplify::constant(self.netlist, id) {
            Some(bits) => literal::signed(bits),
            None => format!("$signed({})", self.operand(body, id).text),
        }
    }

    /// A choice, a chain of one operator or a concatenation, a part on each line; `fill` leads to its column.
    pub fn broken(&mut self, body: &mut Body, id: NodeId, fill: &str) -> Option<String> {
        let Source::Op(op, operands) = &self.netlist.node(id).source else { return None };
        let width = self.netlist.width(id);
        if simplify::passed_on(self.netlist, *op, operands, width).is_some() {
            return None;
        }
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
                let sign = symbol(*op, width);
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
