//! The clocks of a pixel.

use edgewalk_netlist::{Module, Reg, Signal};

/// Counts the clocks of a pixel, 0 to T - 1.
pub(super) struct Phase<'m> {
    pub counter: Reg<'m>,
    /// The phase is T - 1.
    pub last: Signal<'m>,
    /// After T - 1 the counter is 0 of itself.
    wraps: bool,
}

impl<'m> Phase<'m> {
    /// None where a pixel takes one clock.
    pub fn new(m: &'m Module, clocks: u32) -> Option<Phase<'m>> {
        (clocks > 1).then(|| {
            let counter = m.reg("phase", clocks.next_power_of_two().ilog2()).doc("clock within the pixel");
            let wraps = clocks.is_power_of_two();
            let last = if wraps { counter.q().all() } else { counter.q().eq(clocks as i32 - 1) };
            Phase { counter, last: last.named("last_phase"), wraps }
        })
    }

    /// The phase after this one.
    pub fn next(&self) -> Signal<'m> {
        let next = self.counter.q() + 1;
        if self.wraps { next } else { self.last.mux(0, next) }
    }
}
