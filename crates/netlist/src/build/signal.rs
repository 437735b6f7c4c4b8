//! A value in a module, and the operators on it.

use std::ops::{Add, BitAnd, BitOr, BitXor, Mul, Neg, Not, Sub};

use super::module::Module;
use super::operand::Operand;
use super::structure::Wire;
use crate::describe::describe;
use crate::error::Fault;
use crate::netlist::NodeId;
use crate::ops::Op;

/// A value of known width in a module; a handle that is copied freely. What each operator means is the table of
/// [`crate::ops`]; a number as the other operand takes this signal's width.
#[derive(Clone, Copy, Debug)]
pub struct Signal<'m> {
    pub(super) module: &'m Module,
    pub(super) id: NodeId,
    pub(super) width: u32,
}

macro_rules! binary {
    ($($(#[$doc:meta])* $method:ident $op:ident;)*) => { $(
        $(#[$doc])*
        #[track_caller]
        pub fn $method(self, other: impl Operand<'m>) -> Signal<'m> {
            self.binary(Op::$op, other)
        }
    )* };
}

macro_rules! unary {
    ($($(#[$doc:meta])* $method:ident($($argument:ident),*) $op:expr;)*) => { $(
        $(#[$doc])*
        #[track_caller]
        pub fn $method(self $(, $argument: u32)*) -> Signal<'m> {
            self.module.op($op, &[self], self.width)
        }
    )* };
}

#[allow(clippy::should_implement_trait)] // `shl(3)` and `shr(3)` keep the width, as in a datapath
impl<'m> Signal<'m> {
    /// Bits.
    pub fn width(self) -> u32 {
        self.width
    }

    /// The module it belongs to.
    pub fn module(self) -> &'m Module {
        self.module
    }

    binary! {
        /// 1 if equal.
        eq Eq;
        /// 1 if not equal.
        ne Ne;
        /// 1 if less, unsigned.
        lt Lt;
        /// 1 if less or equal, unsigned.
        le Le;
        /// 1 if greater, unsigned.
        gt Gt;
        /// 1 if greater or equal, unsigned.
        ge Ge;
        /// 1 if less, signed.
        slt LtSigned;
        /// 1 if less or equal, signed.
        sle LeSigned;
        /// 1 if greater, signed.
        sgt GtSigned;
        /// 1 if greater or equal, signed.
        sge GeSigned;
        /// Signed product, as wide as both together.
        smul MulSigned;
    }

    unary! {
        /// Shifted left by `n`, zeros come in, the width stays.
        shl(n) Op::Shl(n);
        /// Shifted right by `n`, zeros come in, the width stays.
        shr(n) Op::Shr(n);
        /// Shifted right by `n`, copies of the sign come in, the width stays.
        sar(n) Op::Sar(n);
        /// Bits `hi` down to `lo`, both included.
        slice(hi, lo) Op::Slice { hi, lo };
        /// Bit `i`.
        bit(i) Op::Slice { hi: i, lo: i };
        /// With zeros in front, `width` bits.
        zext(width) Op::ZeroExtend(width);
        /// With copies of the sign in front, `width` bits.
        sext(width) Op::SignExtend(width);
        /// 1 if any bit is 1.
        any() Op::Any;
        /// 1 if every bit is 1.
        all() Op::All;
        /// 1 if the number of ones is odd.
        parity() Op::Parity;
    }

    /// The lowest `width` bits.
    #[track_caller]
    pub fn trunc(self, width: u32) -> Signal<'m> {
        let width = self.module.checked_width("trunc", width);
        self.slice(width - 1, 0)
    }

    /// The highest bit: the sign.
    #[track_caller]
    pub fn msb(self) -> Signal<'m> {
        self.bit(self.width - 1)
    }

    /// Shifted left by another signal.
    #[track_caller]
    pub fn shl_by(self, n: Signal<'m>) -> Signal<'m> {
        self.module.op(Op::ShlBy, &[self, n], self.width)
    }

    /// Shifted right by another signal, zeros come in.
    #[track_caller]
    pub fn shr_by(self, n: Signal<'m>) -> Signal<'m> {
        self.module.op(Op::ShrBy, &[self, n], self.width)
    }

    /// Shifted right by another signal, copies of the sign come in.
    #[track_caller]
    pub fn sar_by(self, n: Signal<'m>) -> Signal<'m> {
        self.module.op(Op::SarBy, &[self, n], self.width)
    }

    /// `then` where this single bit is 1, else `otherwise`; one of the two may be a number.
    #[track_caller]
    pub fn mux(self, then: impl Operand<'m>, otherwise: impl Operand<'m>) -> Signal<'m> {
        let Some(width) = then.width_in(self.module).or(otherwise.width_in(self.module)) else {
            self.module.fail(Fault::UnknownWidth);
            return self.module.lit(1, 0);
        };
        let (then, otherwise) = (then.signal(self.module, width), otherwise.signal(self.module, width));
        self.module.op(Op::Mux, &[self, then, otherwise], width)
    }

    /// The same value as a wire with a name for the reader.
    #[track_caller]
    pub fn named(self, name: &str) -> Signal<'m> {
        self.named_doc(name, "")
    }

    /// The same value as a wire with a name, and its format and unit.
    #[track_caller]
    pub fn named_doc(self, name: &str, doc: &str) -> Signal<'m> {
        Wire::driven(self, name, doc)
    }

    #[track_caller]
    fn binary(self, op: Op, other: impl Operand<'m>) -> Signal<'m> {
        let other = other.signal(self.module, self.width);
        self.module.op(op, &[self, other], self.width)
    }

    pub(super) fn describe(self) -> String {
        let draft = self.module.draft();
        describe(&draft.netlist, &draft.netlist.node(self.id).source)
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $op:ident;)*) => { $(
        impl<'m, T: Operand<'m>> $trait<T> for Signal<'m> {
            type Output = Signal<'m>;
            #[track_caller]
            fn $method(self, other: T) -> Signal<'m> {
                self.binary(Op::$op, other)
            }
        }
    )* };
}

operators! {
    Add add Add;
    Sub sub Sub;
    BitAnd bitand And;
    BitOr bitor Or;
    BitXor bitxor Xor;
}

/// Unsigned product, as wide as both together.
impl<'m> Mul for Signal<'m> {
    type Output = Signal<'m>;
    #[track_caller]
    fn mul(self, other: Signal<'m>) -> Signal<'m> {
        self.binary(Op::Mul, other)
    }
}

impl<'m> Not for Signal<'m> {
    type Output = Signal<'m>;
    #[track_caller]
    fn not(self) -> Signal<'m> {
        self.module.op(Op::Not, &[self], self.width)
    }
}

impl<'m> Neg for Signal<'m> {
    type Output = Signal<'m>;
    #[track_caller]
    fn neg(self) -> Signal<'m> {
        self.module.op(Op::Neg, &[self], self.width)
    }
}
