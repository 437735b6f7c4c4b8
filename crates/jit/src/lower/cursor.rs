//! Where instructions go, and what they reach of the state. Nothing here knows values of the graph.

use std::ops::{Deref, DerefMut};

use cranelift_codegen::cursor::FuncCursor;
use cranelift_codegen::ir::{Inst, InstBuilder, MemFlagsData, Type, Value, types};
use edgewalk_netlist::ops::mask;

use super::lowered::{Lowered, lane};
use crate::layout::Place;

/// A program takes the state's address and so many bytes more, so that the lowest bit of what it is given is
/// 1: see [`StateCursor::test_bit`]. Where the host has no instruction that tests memory, none.
pub(crate) const ODD: i64 = if cfg!(target_arch = "x86_64") { 1 } else { 0 };

/// Cranelift's cursor, in a program of the state.
pub(super) struct StateCursor<'a> {
    inner: FuncCursor<'a>,
    /// The address of the state.
    pub state: Value,
    /// The low 32 bits of that and [`ODD`].
    odd: Value,
    /// Whether the host has words of 128 bits.
    pub has_vectors: bool,
}

impl<'a> Deref for StateCursor<'a> {
    type Target = FuncCursor<'a>;

    fn deref(&self) -> &FuncCursor<'a> {
        &self.inner
    }
}

impl<'a> DerefMut for StateCursor<'a> {
    fn deref_mut(&mut self) -> &mut FuncCursor<'a> {
        &mut self.inner
    }
}

impl<'a> StateCursor<'a> {
    /// Stands in the function's first block; `address` is what the program is given.
    pub fn new(mut inner: FuncCursor<'a>, address: Value, has_vectors: bool) -> StateCursor<'a> {
        // Cranelift takes it into each access.
        let state = inner.ins().iadd_imm_s(address, -ODD);
        let odd = inner.ins().ireduce(types::I32, address);
        StateCursor { inner, state, odd, has_vectors }
    }

    /// The type of a value.
    pub fn type_of(&self, value: Value) -> Type {
        self.func.dfg.value_type(value)
    }

    /// Reads a place of so many bits.
    pub fn read(&mut self, ty: Type, Place { offset, width }: Place) -> Value {
        let state = self.state;
        self.ins().load(ty, flags(width), state, offset)
    }

    /// Writes a place of so many bits.
    pub fn write(&mut self, value: Value, Place { offset, width }: Place) -> Inst {
        let state = self.state;
        self.ins().store(flags(width), value, state, offset)
    }

    /// Reads a byte of the state as a word: at an offset, and so many bytes further.
    pub fn read_byte(&mut self, offset: i32, further: Value) -> Value {
        let state = self.state;
        let address = self.ins().iadd(state, further);
        self.ins().uload8(types::I64, MemFlagsData::trusted(), address, offset)
    }

    /// Tests a bit where it lies: not 0 if it is 1. The place has nothing but zeros above the bit. With the
    /// odd address `test [place], address` is one instruction of the host and takes no register; with a
    /// constant instead Cranelift would load the bit first.
    pub fn test_bit(&mut self, place: Place) -> Value {
        // Cranelift tests 32 bits of memory or more.
        let bits = self.read(types::I32, place);
        let odd = self.odd;
        self.ins().band(odd, bits)
    }

    /// What is in a place; a bit as a word.
    pub fn load(&mut self, Place { offset, width }: Place) -> Value {
        let state = self.state;
        match width {
            1 => self.ins().uload8(types::I64, flags(1), state, offset),
            _ => self.ins().load(lane(width), flags(width), state, offset),
        }
    }

    /// A bit that is there as a word below 2^bits.
    pub fn bit(&mut self, word: Value, bits: u32) -> Lowered {
        Lowered::bit(self.ins().ireduce(types::I8, word), word, bits)
    }

    /// A constant of this type.
    pub fn constant(&mut self, ty: Type, value: u128) -> Value {
        if ty == types::I128 {
            let low = self.ins().iconst(types::I64, value as u64 as i64);
            let high = self.ins().iconst(types::I64, (value >> 64) as u64 as i64);
            return self.ins().iconcat(low, high);
        }
        self.ins().iconst(ty, value as u64 as i64)
    }

    /// 0, of the type of a value.
    pub fn zero_like(&mut self, value: Value) -> Value {
        let ty = self.type_of(value);
        self.constant(ty, 0)
    }

    /// The low `width` bits, zeros above.
    pub fn masked(&mut self, value: Value, width: u32) -> Value {
        let ty = self.func.dfg.value_type(value);
        if width >= ty.bits() {
            return value;
        }
        if ty == types::I128 {
            let (low, high) = self.ins().isplit(value);
            let high = self.masked(high, width - 64);
            return self.ins().iconcat(low, high);
        }
        let ones = self.constant(ty, mask(width));
        self.ins().band(value, ones)
    }

    /// With copies of bit `width` - 1 above it.
    pub fn sign_extended(&mut self, value: Value, width: u32) -> Value {
        let ty = self.type_of(value);
        let narrow = match width {
            8 => types::I8,
            16 => types::I16,
            32 => types::I32,
            _ if width == ty.bits() => return value,
            _ if ty == types::I128 => {
                let (low, high) = self.ins().isplit(value);
                let high = self.sign_extended(high, width - 64);
                return self.ins().iconcat(low, high);
            }
            _ => {
                let unused = self.constant(types::I64, (ty.bits() - width).into());
                let top = self.ins().ishl(value, unused);
                return self.ins().sshr(top, unused);
            }
        };
        let low = self.ins().ireduce(narrow, value);
        self.ins().sextend(ty, low)
    }

    /// Shifted by less than the lane has bits.
    pub fn shifted_left(&mut self, value: Value, n: u32) -> Value {
        if n == 0 {
            return value;
        }
        if self.type_of(value) != types::I128 {
            let n = self.constant(types::I64, n.into());
            return self.ins().ishl(value, n);
        }
        let (low, high) = self.ins().isplit(value);
        let (new_low, new_high) = if n >= 64 {
            (self.constant(types::I64, 0), self.shifted_left(low, n - 64))
        } else {
            let (up, over) = (self.shifted_left(high, n), self.shifted_right(low, 64 - n));
            (self.shifted_left(low, n), self.ins().bor(up, over))
        };
        self.ins().iconcat(new_low, new_high)
    }

    /// Shifted by less than the lane has bits.
    pub fn shifted_right(&mut self, value: Value, n: u32) -> Value {
        if n == 0 {
            return value;
        }
        if self.type_of(value) != types::I128 {
            let n = self.constant(types::I64, n.into());
            return self.ins().ushr(value, n);
        }
        let (low, high) = self.ins().isplit(value);
        let (new_low, new_high) = if n >= 64 {
            (self.shifted_right(high, n - 64), self.constant(types::I64, 0))
        } else {
            let (down, over) = (self.shifted_right(low, n), self.shifted_left(high, 64 - n));
            (self.ins().bor(down, over), self.shifted_right(high, n))
        };
        self.ins().iconcat(new_low, new_high)
    }

    /// In a lane at least as wide, with zeros above.
    pub fn widened(&mut self, value: Value, ty: Type) -> Value {
        if self.type_of(value) == ty { value } else { self.ins().uextend(ty, value) }
    }

    /// In a lane at least as wide, with copies of the sign above.
    pub fn sign_widened(&mut self, value: Value, ty: Type) -> Value {
        if self.type_of(value) == ty { value } else { self.ins().sextend(ty, value) }
    }

    /// In any lane: the bits that fit, or all with zeros above.
    pub fn resized(&mut self, value: Value, ty: Type) -> Value {
        if self.type_of(value).bits() > ty.bits() {
            self.ins().ireduce(ty, value)
        } else {
            self.widened(value, ty)
        }
    }
}

/// No access traps: all places lie within the state. They are aligned to 8 bytes.
pub(super) fn flags(width: u32) -> MemFlagsData {
    if width <= 64 { MemFlagsData::trusted() } else { MemFlagsData::new().with_notrap() }
}
