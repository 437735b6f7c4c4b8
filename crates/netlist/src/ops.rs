//! The operators: one written width rule and one written meaning each.
//!
//! Everything else (interpreter, Verilog, any later back end) is tested against this table. Values are unsigned
//! integers below 2^width, in a `u128`; `s(a)` is `a` read as two's complement; every result is taken modulo 2^w.
//!
//! | operator | operands | result width w | result |
//! |---|---|---|---|
//! | `Add` `Sub` | a, b of w | w | a + b, a - b |
//! | `Neg` | a of w | w | -a |
//! | `Mul` | a, b | wa + wb | a * b |
//! | `MulSigned` | a, b | wa + wb | s(a) * s(b) |
//! | `And` `Or` `Xor` `Not` | of w | w | bit by bit |
//! | `Eq` `Ne` `Lt` `Le` `Gt` `Ge` | a, b of one width | 1 | 1 if the relation of a and b holds, else 0 |
//! | `LtSigned` ... `GeSigned` | a, b of one width | 1 | the same of s(a) and s(b) |
//! | `Mux` | c of 1; a, b of w | w | a if c = 1, else b |
//! | `Shl(n)` `Shr(n)` | a of w | w | a * 2^n, floor(a / 2^n) |
//! | `Sar(n)` | a of w | w | floor(s(a) / 2^n) |
//! | `ShlBy` `ShrBy` `SarBy` | a of w; n of at most 16 bits | w | the same with n a signal |
//! | `Slice { hi, lo }` | a, hi < wa, lo <= hi | hi - lo + 1 | floor(a / 2^lo) |
//! | `ZeroExtend(w)` | a, wa <= w | w | a |
//! | `SignExtend(w)` | a, wa <= w | w | s(a) |
//! | `Concat` | one or more, most significant first | sum | the first * 2^(sum of the others) + ... |
//! | `Any` `All` `Parity` | a | 1 | a is not 0; a is 2^wa - 1; the number of ones in a is odd |

/// The widest signal.
pub const MAX_WIDTH: u32 = 128;

/// The widest shift distance: simulators refuse distances beyond a machine word.
const MAX_DISTANCE: u32 = 16;

/// A combinational operator; the module's table says what each means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // the table above is their documentation
pub enum Op {
    Add,
    Sub,
    Neg,
    Mul,
    MulSigned,
    And,
    Or,
    Xor,
    Not,
    Eq,
    Ne,
    Lt,
    Le,
    Gt,
    Ge,
    LtSigned,
    LeSigned,
    GtSigned,
    GeSigned,
    Mux,
    Shl(u32),
    Shr(u32),
    Sar(u32),
    ShlBy,
    ShrBy,
    SarBy,
    Slice { hi: u32, lo: u32 },
    ZeroExtend(u32),
    SignExtend(u32),
    Concat,
    Any,
    All,
    Parity,
}

impl Op {
    /// Width of the result for operands of these widths, or what is wrong with them.
    pub fn width(self, operands: &[u32]) -> Result<u32, String> {
        use Op::*;
        let width = match (self, operands) {
            (Add | Sub | And | Or | Xor, &[a, b]) => same(a, b)?,
            (Eq | Ne | Lt | Le | Gt | Ge | LtSigned | LeSigned | GtSigned | GeSigned, &[a, b]) => {
                same(a, b)?;
                1
            }
            (Mul | MulSigned, &[a, b]) => a + b,
            (Neg | Not | Shl(_) | Shr(_) | Sar(_), &[a]) => a,
            (ShlBy | ShrBy | SarBy, &[a, n]) => {
                if n > MAX_DISTANCE {
                    return Err(format!("a shift distance of {n} bits, more than {MAX_DISTANCE}"));
                }
                a
            }
            (Mux, &[c, a, b]) => {
                if c != 1 {
                    return Err(format!("the condition has {c} bits instead of 1"));
                }
                same(a, b)?
            }
            (Slice { hi, lo }, &[a]) => {
                if lo > hi || hi >= a {
                    return Err(format!("bits {hi}..{lo} of {a}"));
                }
                hi - lo + 1
            }
            (ZeroExtend(w) | SignExtend(w), &[a]) => {
                if w < a {
                    return Err(format!("extension from {a} bits to {w}"));
                }
                w
            }
            (Concat, [_, ..]) => operands.iter().fold(0, |sum: u32, &w| sum.saturating_add(w)),
            (Any | All | Parity, &[_]) => 1,
            _ => return Err(format!("{} operands", operands.len())),
        };
        if (1..=MAX_WIDTH).contains(&width) {
            Ok(width)
        } else {
            Err(format!("a result of {width} bits, outside 1..={MAX_WIDTH}"))
        }
    }

    /// The result, of `width` bits, from operands of widths that [`Op::width`] accepts.
    pub fn value(self, width: u32, operands: &[Bits]) -> u128 {
        match *operands {
            [a] => self.apply(width, a, ZERO, ZERO),
            [a, b] => self.apply(width, a, b, ZERO),
            [a, b, c] if self == Op::Mux => self.apply(width, a, b, c),
            _ => operands.iter().fold(0, |high, low| concat(high, *low)),
        }
    }

    /// [`Op::value`] with operands in place; those an operator does not have are ignored, `Concat` has two.
    #[inline(always)]
    pub(crate) fn apply(self, width: u32, a: Bits, b: Bits, c: Bits) -> u128 {
        use Op::*;
        let (x, y) = (a.value, b.value);
        let result = match self {
            Add => x.wrapping_add(y),
            Sub => x.wrapping_sub(y),
            Neg => x.wrapping_neg(),
            Mul => x.wrapping_mul(y),
            MulSigned => a.signed().wrapping_mul(b.signed()) as u128,
            And => x & y,
            Or => x | y,
            Xor => x ^ y,
            Not => !x,
            Eq => (x == y).into(),
            Ne => (x != y).into(),
            Lt => (x < y).into(),
            Le => (x <= y).into(),
            Gt => (x > y).into(),
            Ge => (x >= y).into(),
            LtSigned => (a.signed() < b.signed()).into(),
            LeSigned => (a.signed() <= b.signed()).into(),
            GtSigned => (a.signed() > b.signed()).into(),
            GeSigned => (a.signed() >= b.signed()).into(),
            Mux if x == 1 => y,
            Mux => c.value,
            Shl(n) => shift_left(a, n.into()),
            Shr(n) => shift_right(a, n.into()),
            Sar(n) => shift_right_signed(a, n.into()),
            ShlBy => shift_left(a, y),
            ShrBy => shift_right(a, y),
            SarBy => shift_right_signed(a, y),
            Slice { lo, .. } => x >> lo,
            ZeroExtend(_) => x,
            SignExtend(_) => a.signed() as u128,
            Concat => concat(x, b),
            Any => (x != 0).into(),
            All => (x == mask(a.width)).into(),
            Parity => (x.count_ones() % 2).into(),
        };
        result & mask(width)
    }
}

/// A value with its width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bits {
    /// Below 2^width.
    pub value: u128,
    /// 1 to [`MAX_WIDTH`].
    pub width: u32,
}

const ZERO: Bits = Bits { value: 0, width: 1 };

impl Bits {
    /// The value read as two's complement.
    #[inline(always)]
    pub fn signed(self) -> i128 {
        let unused = MAX_WIDTH - self.width;
        ((self.value << unused) as i128) >> unused
    }
}

/// The largest value of `width` bits.
#[inline(always)]
pub fn mask(width: u32) -> u128 {
    u128::MAX >> (MAX_WIDTH - width)
}

fn same(a: u32, b: u32) -> Result<u32, String> {
    if a == b { Ok(a) } else { Err(format!("{a} bits against {b}")) }
}

#[inline(always)]
fn shift_left(a: Bits, n: u128) -> u128 {
    if n < a.width.into() { a.value << n } else { 0 }
}

#[inline(always)]
fn shift_right(a: Bits, n: u128) -> u128 {
    if n < a.width.into() { a.value >> n } else { 0 }
}

#[inline(always)]
fn shift_right_signed(a: Bits, n: u128) -> u128 {
    (a.signed() >> n.min((MAX_WIDTH - 1).into())) as u128
}

#[inline(always)]
fn concat(high: u128, low: Bits) -> u128 {
    if low.width < MAX_WIDTH { (high << low.width) | low.value } else { low.value }
}
