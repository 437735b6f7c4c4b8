//! Each operator in instructions. What it means is the table in `edgewalk_netlist::ops`.

use cranelift_codegen::ir::condcodes::{CondCode, IntCC};
use cranelift_codegen::ir::{InstBuilder, Value, types};
use edgewalk_netlist::Op;
use edgewalk_netlist::ops::mask;

use super::lowered::{Lowered, lane};
use super::range::Range;
use super::values::Values;
use crate::graph::{Kind, ValueId};

/// The result of `width` bits.
pub(super) fn lower(v: &mut Values, op: Op, width: u32, operands: &[ValueId]) -> Lowered {
    let ty = lane(width);
    if let Some((condition, signed)) = relation(op)
        && let &[a, b] = operands
    {
        return Lowered::below(compare(v, condition, signed, a, b), 1);
    }
    if width == 1
        && let &[a, b] = operands
        && let Some(bit) = of_words(v, op, a, b)
    {
        return bit;
    }
    match (op, operands) {
        (Op::Add, &[a, b]) => {
            let (a, b) = (v.any(a), v.any(b));
            let range = a.ranges(b).and_then(|(a, b)| a.plus(b));
            let bits = a.bits.max(b.bits).saturating_add(1);
            Lowered::within(v.cursor.ins().iadd(a.any, b.any), bits, range)
        }
        (Op::Sub, &[a, b]) => {
            let (a, b) = (v.any(a), v.any(b));
            let range = a.ranges(b).and_then(|(a, b)| a.minus(b));
            Lowered::within(v.cursor.ins().isub(a.any, b.any), u32::MAX, range)
        }
        (Op::Neg, &[a]) => {
            let a = v.any(a);
            let range = a.range.and_then(|range| Range::of(0).minus(range));
            Lowered::within(v.cursor.ins().ineg(a.any), u32::MAX, range)
        }
        (Op::Mul, &[a, b]) => product(v, width, a, b),
        (Op::MulSigned, &[a, b]) => signed_product(v, width, a, b),
        (Op::And, &[a, b]) => {
            let (a, b) = (v.any(a), v.any(b));
            // A range that is unsigned only by one of them is in its bits.
            let range = of_bits(a, b).filter(|_| a.bits.min(b.bits) == u32::MAX);
            Lowered::within(v.cursor.ins().band(a.any, b.any), a.bits.min(b.bits), range)
        }
        (Op::Or, &[a, b]) => {
            let (a, b) = (v.any(a), v.any(b));
            Lowered::within(v.cursor.ins().bor(a.any, b.any), a.bits.max(b.bits), of_bits(a, b))
        }
        (Op::Xor, &[a, b]) => {
            let (a, b) = (v.any(a), v.any(b));
            Lowered::within(v.cursor.ins().bxor(a.any, b.any), a.bits.max(b.bits), of_bits(a, b))
        }
        (Op::Not, &[a]) => not(v, width, a),
        (Op::Mux, &[c, a, b]) => {
            let (a, b) = (v.any(a), v.any(b));
            let c = v.condition(c);
            Lowered::either(v.cursor.ins().select(c, a.any, b.any), a, b)
        }
        (Op::Shl(n), &[a]) if n < width => {
            let a = v.any(a);
            let range = a.range.and_then(|range| range.times_power(n));
            Lowered::within(v.cursor.shifted_left(a.any, n), a.bits.saturating_add(n), range)
        }
        (Op::Shr(n), &[a]) if n < width => {
            let a = v.zero(a);
            Lowered::below(v.cursor.shifted_right(a, n), width - n)
        }
        (Op::Sar(n), &[a]) => {
            let a = v.sign(a);
            let n = v.cursor.constant(types::I64, n.min(width - 1).into());
            Lowered::signed(v.cursor.ins().sshr(a, n), width)
        }
        (Op::ShlBy | Op::ShrBy | Op::SarBy, &[a, n]) => shifted_by(v, op, width, a, n),
        (Op::Slice { hi, lo }, &[a]) => {
            if let Some((word, zero)) = sign_asked(v, hi, lo, a) {
                return Lowered::below(v.cursor.ins().icmp(IntCC::SignedLessThan, word, zero), 1);
            }
            let bits = v.any(a).bits.min(lane(v.graph().width(a)).bits());
            let bits = bits.saturating_sub(lo);
            if width == 1 && lane(v.graph().width(a)) == types::I64 {
                let word = v.any(a).any;
                let word = v.cursor.shifted_right(word, lo);
                return v.cursor.bit(word, bits);
            }
            Lowered::below(slice(v, hi, lo, a), bits)
        }
        (Op::ZeroExtend(_), &[a]) => {
            let zero = v.word(a);
            Lowered::below(v.cursor.widened(zero, ty), v.graph().width(a))
        }
        (Op::SignExtend(_), &[a]) => {
            let bits = v.graph().width(a);
            if let Some(word) = sign_of_bit(v, a).filter(|_| ty == types::I64) {
                return Lowered::signed(word, 1);
            }
            if bits == 1 && ty == types::I64 {
                let zero = v.word(a);
                return Lowered::signed(v.cursor.ins().ineg(zero), 1);
            }
            let sign = v.sign(a);
            Lowered::signed(v.cursor.sign_widened(sign, ty), bits)
        }
        (Op::Concat, _) => concat(v, width, operands),
        (Op::Any, &[a]) => {
            let a = v.zero(a);
            let zero = v.cursor.zero_like(a);
            Lowered::below(v.cursor.ins().icmp(IntCC::NotEqual, a, zero), 1)
        }
        (Op::All, &[a]) => {
            let bits = v.graph().width(a);
            let a = v.zero(a);
            let ones = v.cursor.constant(lane(bits), mask(bits));
            Lowered::below(v.cursor.ins().icmp(IntCC::Equal, a, ones), 1)
        }
        (Op::Parity, &[a]) => parity(v, a),
        // Shifts beyond the width; nothing else is left.
        _ => Lowered::below(v.cursor.constant(ty, 0), 0),
    }
}

/// The relation of integers that an operator asks for, and whether they are signed. All others are said by
/// these three (`simplify`).
fn relation(op: Op) -> Option<(IntCC, bool)> {
    Some(match op {
        Op::Eq => (IntCC::Equal, false),
        Op::Lt => (IntCC::UnsignedLessThan, false),
        Op::LtSigned => (IntCC::SignedLessThan, true),
        _ => return None,
    })
}

fn compare(v: &mut Values, condition: IntCC, signed: bool, a: ValueId, b: ValueId) -> Value {
    let (a, b) = if signed { (v.sign(a), v.sign(b)) } else { (v.zero(a), v.zero(b)) };
    v.cursor.ins().icmp(condition, a, b)
}

/// The opposite of a relation is a relation.
fn not(v: &mut Values, width: u32, a: ValueId) -> Lowered {
    if let Kind::Op(op, operands) = v.graph().kind(a)
        && let Some((condition, signed)) = relation(*op)
        && let &[a, b] = &**operands
    {
        return Lowered::below(compare(v, condition.complement(), signed, a, b), 1);
    }
    if let Some(&[word]) = v.graph().as_op(a, Op::Any) {
        let word = v.zero(word);
        let zero = v.cursor.zero_like(word);
        return Lowered::below(v.cursor.ins().icmp(IntCC::Equal, word, zero), 1);
    }
    if let &Kind::Op(Op::Slice { hi, lo }, ref operands) = v.graph().kind(a)
        && let Some((word, zero)) = sign_asked(v, hi, lo, operands[0])
    {
        return Lowered::below(v.cursor.ins().icmp(IntCC::SignedGreaterThanOrEqual, word, zero), 1);
    }
    let a = v.any(a);
    if let Some(word) = a.word {
        let one = v.cursor.constant(types::I64, 1);
        let word = v.cursor.ins().bxor(word, one);
        return v.cursor.bit(word, a.bits.max(1));
    }
    if width == 1 {
        let one = v.cursor.constant(types::I8, 1);
        return Lowered::below(v.cursor.ins().bxor(a.any, one), a.bits.max(1));
    }
    let range = a.range.and_then(|range| Range::of(-1).minus(range));
    Lowered::within(v.cursor.ins().bnot(a.any), u32::MAX, range)
}

/// A word that has copies of its sign above its bits, and 0, if these bits of it are the sign.
fn sign_asked(v: &mut Values, hi: u32, lo: u32, word: ValueId) -> Option<(Value, Value)> {
    let width = v.graph().width(word);
    if hi != lo || hi + 1 != width || lane(width) != types::I64 {
        return None;
    }
    let word = v.any(word);
    word.range.filter(|range| range.is_signed(width))?;
    Some((word.any, v.cursor.zero_like(word.any)))
}

/// A word of copies of a bit of a word, moved to where its sign is.
fn sign_of_bit(v: &mut Values, bit: ValueId) -> Option<Value> {
    let &Kind::Op(Op::Slice { hi, lo }, ref operands) = v.graph().kind(bit) else { return None };
    let word = operands[0];
    if hi != lo || lane(v.graph().width(word)) != types::I64 || !v.is_worked_out_here(bit) {
        return None;
    }
    let word = v.any(word).any;
    let (up, down) = (v.cursor.constant(types::I64, (63 - lo).into()), v.cursor.constant(types::I64, 63));
    let top = v.cursor.ins().ishl(word, up);
    Some(v.cursor.ins().sshr(top, down))
}

/// Of bits of two words.
fn of_bits(a: Lowered, b: Lowered) -> Option<Range> {
    a.ranges(b).map(|(a, b)| a.of_bits(b))
}

/// `And`, `Or` and `Xor` of two bits that are there as words, as a word: an `And` of a bit and the opposite
/// of another is one instruction then.
fn of_words(v: &mut Values, op: Op, a: ValueId, b: ValueId) -> Option<Lowered> {
    let (first, second) = (v.any(a), v.any(b));
    if op == Op::And {
        for (other, bit) in [(b, first), (a, second)] {
            if let Some(&[not]) = v.graph().as_op(other, Op::Not)
                && let Some((word, not)) = bit.word.zip(v.known_word(not))
            {
                let word = v.cursor.ins().band_not(word, not);
                return Some(v.cursor.bit(word, bit.bits));
            }
        }
    }
    let words = first.word.zip(second.word);
    let (word, bits) = match (op, words) {
        (Op::And, Some((a, b))) => (v.cursor.ins().band(a, b), first.bits.min(second.bits)),
        (Op::Or, Some((a, b))) => (v.cursor.ins().bor(a, b), first.bits.max(second.bits)),
        (Op::Xor, Some((a, b))) => (v.cursor.ins().bxor(a, b), first.bits.max(second.bits)),
        _ => return None,
    };
    Some(v.cursor.bit(word, bits))
}

fn product(v: &mut Values, width: u32, a: ValueId, b: ValueId) -> Lowered {
    let narrow = [a, b].iter().all(|operand| v.graph().width(*operand) <= 64);
    let factor = if narrow { types::I64 } else { types::I128 };
    let (a, b) = (v.zero(a), v.zero(b));
    let (a, b) = (v.cursor.widened(a, factor), v.cursor.widened(b, factor));
    let low = v.cursor.ins().imul(a, b);
    if !narrow || width <= 64 {
        return Lowered::below(low, width);
    }
    let high = v.cursor.ins().umulhi(a, b);
    Lowered::below(v.cursor.ins().iconcat(low, high), width)
}

fn signed_product(v: &mut Values, width: u32, a: ValueId, b: ValueId) -> Lowered {
    let narrow = [a, b].iter().all(|operand| v.graph().width(*operand) <= 64);
    let factor = if narrow { types::I64 } else { types::I128 };
    let (a, b) = (v.sign(a), v.sign(b));
    let (a, b) = (v.cursor.sign_widened(a, factor), v.cursor.sign_widened(b, factor));
    let low = v.cursor.ins().imul(a, b);
    if !narrow || width <= 64 {
        return Lowered::signed(low, width);
    }
    let high = v.cursor.ins().smulhi(a, b);
    Lowered::signed(v.cursor.ins().iconcat(low, high), width)
}

/// A shift by a signal: what is shifted out of the lane must be gone, however large the count.
fn shifted_by(v: &mut Values, op: Op, width: u32, a: ValueId, n: ValueId) -> Lowered {
    let count_bits = v.graph().width(n);
    let lane_bits: u32 = if width == 1 { 1 } else { lane(width).bits() };
    let count = v.zero(n);
    let in_lane = (count_bits > lane_bits.ilog2()).then(|| {
        let limit = v.cursor.constant(lane(count_bits), lane_bits.into());
        v.cursor.ins().icmp(IntCC::UnsignedLessThan, count, limit)
    });
    let count = v.cursor.resized(count, types::I64);
    match op {
        Op::SarBy => {
            let a = v.sign(a);
            let most = v.cursor.constant(types::I64, (lane_bits - 1).into());
            let count = in_lane.map_or(count, |in_lane| v.cursor.ins().select(in_lane, count, most));
            Lowered::signed(v.cursor.ins().sshr(a, count), width)
        }
        _ => {
            let (shifted, bits) = if op == Op::ShlBy {
                let a = v.any(a).any;
                (v.cursor.ins().ishl(a, count), u32::MAX)
            } else {
                let a = v.zero(a);
                (v.cursor.ins().ushr(a, count), width)
            };
            let zero = v.cursor.constant(lane(width), 0);
            Lowered::below(in_lane.map_or(shifted, |fits| v.cursor.ins().select(fits, shifted, zero)), bits)
        }
    }
}

/// Bits from `lo` on; above `hi` anything.
fn slice(v: &mut Values, hi: u32, lo: u32, a: ValueId) -> Value {
    let ty = lane(hi - lo + 1);
    let a = v.any(a).any;
    if v.cursor.type_of(a) == types::I128 && ty != types::I128 && hi / 64 == lo / 64 {
        let (low, high) = v.cursor.ins().isplit(a);
        let half = v.cursor.shifted_right(if lo < 64 { low } else { high }, lo % 64);
        return v.cursor.resized(half, ty);
    }
    let shifted = v.cursor.shifted_right(a, lo);
    v.cursor.resized(shifted, ty)
}

fn concat(v: &mut Values, width: u32, parts: &[ValueId]) -> Lowered {
    let ty = lane(width);
    let mut all: Option<Lowered> = None;
    for part in parts {
        let bits = v.graph().width(*part);
        all = Some(match all {
            None => {
                let part = match v.any(*part) {
                    Lowered { word: Some(word), bits, .. } if ty != types::I8 => Lowered::below(word, bits),
                    part => part,
                };
                let any = v.cursor.widened(part.any, ty);
                // In a longer word the sign does not reach to the top.
                let is_same = any == part.any;
                let range = part.range.filter(|range| is_same || range.bits().is_some());
                Lowered::within(any, part.bits, range)
            }
            Some(high) => {
                let part = v.word(*part);
                let (part, above) = (v.cursor.widened(part, ty), v.cursor.shifted_left(high.any, bits));
                let range = high.range.and_then(|high| high.times_power(bits));
                let range = range.zip(Range::unsigned(bits)).and_then(|(high, low)| high.plus(low));
                Lowered::within(side_by_side(v, above, part, bits), high.bits.saturating_add(bits), range)
            }
        });
    }
    match all {
        Some(all) => all,
        None => Lowered::below(v.cursor.constant(ty, 0), 0),
    }
}

/// Bits above others; by a sum where that is one instruction with the shift.
fn side_by_side(v: &mut Values, above: Value, below: Value, bits: u32) -> Value {
    if bits <= 3 && v.cursor.type_of(above) == types::I64 {
        v.cursor.ins().iadd(below, above)
    } else {
        v.cursor.ins().bor(above, below)
    }
}

fn parity(v: &mut Values, a: ValueId) -> Lowered {
    let mut a = v.zero(a);
    if v.cursor.type_of(a) == types::I128 {
        let (low, high) = v.cursor.ins().isplit(a);
        a = v.cursor.ins().bxor(low, high);
    }
    let ones = v.cursor.ins().popcnt(a);
    Lowered::below(v.cursor.resized(ones, types::I8), 8)
}
