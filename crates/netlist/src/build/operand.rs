//! What may stand beside a signal: another signal, a register or wire for its value, or a number.

use super::module::Module;
use super::signal::Signal;
use super::storage::Reg;
use super::structure::Wire;
use crate::error::Fault;
use crate::ops::{MAX_WIDTH, mask};

/// A signal, a register or wire (its value), or a number, which takes the width of what it stands beside.
pub trait Operand<'m> {
    /// Width of the operand; a number has none.
    fn width_in(&self, module: &'m Module) -> Option<u32>;
    /// As a signal of `module`; a number becomes a constant of `width` bits.
    fn signal(self, module: &'m Module, width: u32) -> Signal<'m>;
}

impl<'m> Operand<'m> for Signal<'m> {
    fn width_in(&self, _: &'m Module) -> Option<u32> {
        Some(self.width)
    }
    #[track_caller]
    fn signal(self, module: &'m Module, _: u32) -> Signal<'m> {
        module.own(self)
    }
}

impl<'m> Operand<'m> for Reg<'m> {
    fn width_in(&self, _: &'m Module) -> Option<u32> {
        Some(self.q().width)
    }
    #[track_caller]
    fn signal(self, module: &'m Module, _: u32) -> Signal<'m> {
        module.own(self.q())
    }
}

impl<'m> Operand<'m> for Wire<'m> {
    fn width_in(&self, _: &'m Module) -> Option<u32> {
        Some(self.q().width)
    }
    #[track_caller]
    fn signal(self, module: &'m Module, _: u32) -> Signal<'m> {
        module.own(self.q())
    }
}

impl<'m> Operand<'m> for u128 {
    fn width_in(&self, _: &'m Module) -> Option<u32> {
        None
    }
    #[track_caller]
    fn signal(self, module: &'m Module, width: u32) -> Signal<'m> {
        module.lit(width, self)
    }
}

/// The type of a plain number; a negative one in two's complement.
impl<'m> Operand<'m> for i32 {
    fn width_in(&self, _: &'m Module) -> Option<u32> {
        None
    }
    #[track_caller]
    fn signal(self, module: &'m Module, width: u32) -> Signal<'m> {
        let value = i128::from(self);
        if value >= 0 {
            return module.lit(width, value as u128);
        }
        let lowest = i128::MIN >> (MAX_WIDTH - width.clamp(1, MAX_WIDTH));
        if value < lowest {
            module.fail(Fault::Literal { value: value.to_string(), width });
        }
        module.lit(width, value as u128 & mask(width.clamp(1, MAX_WIDTH)))
    }
}
