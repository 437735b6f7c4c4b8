//! The interpreter: the meaning of a netlist, cycle by cycle; and what else runs one looks like.

mod flatten;
mod simulator;

pub use simulator::{InputId, SignalId, SimError, Simulator};

/// What runs a netlist clock by clock: the [`Simulator`] here, or code that was made of it.
pub trait Simulate {
    /// Names an input of the top module.
    type Input: Copy;
    /// Names a signal by its path.
    type Signal: Copy;

    /// The input of that name; `rst` is one of them if there is a register with reset.
    ///
    /// # Errors
    /// If there is none.
    fn input(&self, name: &str) -> Result<Self::Input, SimError>;

    /// A port, register or named wire by its path, as [`Simulator::signal`].
    ///
    /// # Errors
    /// If there is none.
    fn signal(&self, path: &str) -> Result<Self::Signal, SimError>;

    /// Bits of a signal.
    fn width(&self, signal: Self::Signal) -> u32;

    /// Sets an input; bits beyond its width are dropped, as by a wire.
    fn set(&mut self, input: Self::Input, value: u128);

    /// The value of a signal in this cycle.
    fn value(&mut self, signal: Self::Signal) -> u128;

    /// Sets inputs and reads signals, each from or to its place among the values. Each simulator has its own code for it: a
    /// program that is not optimised then runs the optimised code of the simulator's crate.
    fn exchange(
        &mut self,
        inputs: &[(usize, Self::Input)],
        signals: &[(usize, Self::Signal)],
        values: &mut [u128],
    );

    /// One rising edge of `clk`.
    fn tick(&mut self);
}

impl Simulate for Simulator {
    type Input = InputId;
    type Signal = SignalId;

    fn input(&self, name: &str) -> Result<InputId, SimError> {
        Simulator::input(self, name)
    }

    fn signal(&self, path: &str) -> Result<SignalId, SimError> {
        Simulator::signal(self, path)
    }

    fn width(&self, signal: SignalId) -> u32 {
        Simulator::width(self, signal)
    }

    fn set(&mut self, input: InputId, value: u128) {
        Simulator::set(self, input, value);
    }

    fn value(&mut self, signal: SignalId) -> u128 {
        Simulator::value(self, signal)
    }

    fn exchange(&mut self, inputs: &[(usize, InputId)], signals: &[(usize, SignalId)], values: &mut [u128]) {
        inputs.iter().for_each(|(place, input)| self.set(*input, values[*place]));
        signals.iter().for_each(|(place, signal)| values[*place] = self.value(*signal));
    }

    fn tick(&mut self) {
        Simulator::tick(self);
    }
}
