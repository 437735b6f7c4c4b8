//! Runs a netlist as native code, with the interface of `edgewalk_netlist::Simulator`.

use std::fmt;
use std::sync::{Arc, OnceLock};

use edgewalk_netlist::ops::mask;
use edgewalk_netlist::{Netlist, SimError};

use crate::code::{Code, Cost};
use crate::elaborate::elaborate;
use crate::error::JitError;
use crate::free_running::free_running;
use crate::groups::groups;
use crate::layout::{Layout, Place};
use crate::lower::{Plan, Program};
use crate::merge_registers::merge_registers;
use crate::order::Readers;
use crate::places::ArrayPlaces;
use crate::schedule::schedule;
use crate::shared::shared;
use crate::sign_extended::Signs;
use crate::skip_idle_units::wakes;
use crate::state::State;
use crate::step::Step;
use crate::tables::Tables;

/// A running netlist. Inputs are 0 until set; registers without reset, and memory outputs before the first
/// read, are 0 at the start. A clone shares the code and has its own state.
#[derive(Clone)]
pub struct Simulator {
    compiled: Arc<Compiled>,
    state: State,
    /// An input or a register changed since the outputs were computed.
    outputs_stale: bool,
    /// Like `outputs_stale`, for all signals.
    signals_stale: bool,
}

/// All that does not change. Only a clock is compiled before someone asks for more.
struct Compiled {
    plan: Plan,
    clock: Code,
    outputs: OnceLock<Code>,
    signals: OnceLock<Code>,
}

impl Compiled {
    /// The program for the state.
    ///
    /// # Panics
    /// If one that is compiled now does not compile where the clock did, which was larger: a defect of this
    /// crate.
    fn code(&self, program: Program) -> &Code {
        let compile = || Code::new(program, &self.plan).expect("the host compiled the clock");
        match program {
            Program::Clock => &self.clock,
            Program::Outputs => self.outputs.get_or_init(compile),
            Program::Signals => self.signals.get_or_init(compile),
        }
    }
}

/// An input of the top module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InputId {
    place: Place,
    /// The units that have to know of a change.
    wakes: u64,
}

/// An output of the top module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutputId(Place);

/// Any named signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SignalId {
    place: Place,
    needs: Needs,
}

/// What must be computed before a signal can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Needs {
    Nothing,
    Outputs,
    Signals,
}

impl Simulator {
    /// The netlist before its first clock, compiled.
    ///
    /// # Errors
    /// If there is no code generator for this machine, or the netlist is larger than it can be.
    pub fn new(netlist: &Netlist) -> Result<Simulator, JitError> {
        let mut design = free_running(merge_registers(elaborate(netlist)));
        let groups = groups(&mut design);
        let steps = schedule(&mut design, &groups);
        let readers = Readers::of(&design, &steps);
        let mut steps = readers.ordered(steps);
        let (wakes, signs) = (wakes(&design, &readers, &groups, &mut steps), Signs::of(&design));
        // Before any of what they follow from changes.
        steps.insert(0, Step::Early(wakes.all_gates()));
        let mut tables = Tables::of(&design.graph, &signs);
        let shared = shared(&design, &tables, &steps);
        let layout = Layout::new(&design, &tables, &wakes, &shared)?;
        let arrays = ArrayPlaces::new(&mut tables, &layout);
        let state = State::new(&design, &tables, &wakes, &layout);
        let plan = Plan { design, steps, tables, arrays, signs, wakes, shared, layout };
        let clock = Code::new(Program::Clock, &plan)?;
        let compiled = Compiled { plan, clock, outputs: OnceLock::new(), signals: OnceLock::new() };
        Ok(Simulator { compiled: Arc::new(compiled), state, outputs_stale: true, signals_stale: true })
    }

    /// The input `name` of the top module; `rst` is one of them if there is a register with reset.
    ///
    /// # Errors
    /// If there is none of that name.
    pub fn input(&self, name: &str) -> Result<InputId, SimError> {
        let Plan { design, wakes, layout, .. } = &self.compiled.plan;
        let value = design.inputs.get(name);
        let found =
            value.and_then(|value| Some(InputId { place: layout.of(*value)?, wakes: wakes.of(*value) }));
        found.ok_or_else(|| SimError::NoInput(name.to_owned()))
    }

    /// The output `name` of the top module.
    ///
    /// # Errors
    /// If there is none of that name.
    pub fn output(&self, name: &str) -> Result<OutputId, SimError> {
        let Plan { design, layout, .. } = &self.compiled.plan;
        let mut outputs = design.outputs.iter().zip(&layout.sampled);
        let found = outputs.find(|((output, _), _)| output == name);
        found.map(|(_, place)| OutputId(*place)).ok_or_else(|| SimError::NoSignal(name.to_owned()))
    }

    /// A port, register, named wire, named constant, memory output (`ram_q`) or instance output (`u_a_q`) by
    /// its path: `q` in the top module, `u_edge.u_minor.slope` deeper down.
    ///
    /// # Errors
    /// If there is none of that path.
    pub fn signal(&self, path: &str) -> Result<SignalId, SimError> {
        let Plan { design, layout, .. } = &self.compiled.plan;
        let none = || SimError::NoSignal(path.to_owned());
        let value = *design.signals.get(path).ok_or_else(none)?;
        let place = layout.of(value).ok_or_else(none)?;
        let needs = if !design.graph.is_computed(value) {
            Needs::Nothing
        } else if design.outputs.iter().any(|(_, output)| *output == value) {
            Needs::Outputs
        } else {
            Needs::Signals
        };
        Ok(SignalId { place, needs })
    }

    /// The paths of all signals, in alphabetical order.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.compiled.plan.design.signals.keys().map(String::as_str)
    }

    /// Bits of a signal.
    pub fn width(&self, signal: SignalId) -> u32 {
        signal.place.width
    }

    /// Sets an input; bits beyond its width are dropped, as by a wire.
    #[inline]
    pub fn set(&mut self, input: InputId, value: u128) {
        let InputId { place, wakes } = input;
        if self.state.set(place, value) {
            let Plan { layout, wakes: all, .. } = &self.compiled.plan;
            self.state.wake(layout, all, wakes);
            self.change();
        }
    }

    /// Sets an input by name.
    ///
    /// # Errors
    /// If there is none of that name, or the value does not fit.
    pub fn set_input(&mut self, name: &str, value: u128) -> Result<(), SimError> {
        let input = self.input(name)?;
        let width = input.place.width;
        if value > mask(width) {
            return Err(SimError::TooWide { name: name.to_owned(), width, value });
        }
        self.set(input, value);
        Ok(())
    }

    /// The value of a signal in this cycle.
    pub fn value(&mut self, signal: SignalId) -> u128 {
        match signal.needs {
            Needs::Nothing => {}
            Needs::Outputs => self.eval(),
            Needs::Signals => {
                if std::mem::replace(&mut self.signals_stale, false) {
                    self.execute(Program::Signals);
                }
            }
        }
        // A register may have copies of its sign above its bits.
        self.state.get(signal.place) & mask(signal.place.width)
    }

    /// The value of a signal in this cycle, by path.
    ///
    /// # Errors
    /// If there is none of that path.
    pub fn get(&mut self, path: &str) -> Result<u128, SimError> {
        let signal = self.signal(path)?;
        Ok(self.value(signal))
    }

    /// A copy of the words of a memory by its path.
    ///
    /// # Errors
    /// If there is none of that path.
    pub fn memory(&self, path: &str) -> Result<Vec<u128>, SimError> {
        let Plan { design, layout, .. } = &self.compiled.plan;
        let mut memories = design.memories.iter().zip(&layout.memories);
        let found = memories.find(|(memory, _)| memory.path == path);
        let (_, area) = found.ok_or_else(|| SimError::NoMemory(path.to_owned()))?;
        Ok((0..area.words).map(|index| self.state.word(*area, index)).collect())
    }

    /// Puts a word into a memory, a ROM too: a fault in it.
    ///
    /// # Errors
    /// If there is no such word.
    pub fn set_word(&mut self, path: &str, address: usize, value: u128) -> Result<(), SimError> {
        let Plan { design, layout, .. } = &self.compiled.plan;
        let mut memories = design.memories.iter().zip(&layout.memories);
        let found = memories.find(|(memory, area)| memory.path == path && address < area.words);
        let (_, area) = found.ok_or_else(|| SimError::NoMemory(format!("{path}[{address}]")))?;
        self.state.set_word(*area, address, value & mask(area.width));
        self.change();
        Ok(())
    }

    /// Computes the outputs that follow from inputs and registers, if anything changed. Reading a signal does
    /// it too.
    pub fn eval(&mut self) {
        if std::mem::replace(&mut self.outputs_stale, false) {
            self.execute(Program::Outputs);
        }
    }

    /// Of the units that can stand still, how many work in the next clock, if no input changes: the others
    /// are left out of it. A bit from another unit may still wake them.
    pub fn working(&self) -> usize {
        let Plan { wakes, layout, .. } = &self.compiled.plan;
        wakes.units(u64::MAX).filter(|(unit, _)| self.state.clocks(layout, *unit) > 0).count()
    }

    /// What a clock costs before the code generator sees the host.
    pub fn cost(&self) -> Cost {
        self.compiled.clock.cost
    }

    /// One rising edge of `clk`.
    #[inline]
    pub fn tick(&mut self) {
        self.compiled.clock.run(self.state.words_mut());
        self.change();
    }

    /// The value that an output had just before the last rising edge of `clk`; 0 if there was none yet.
    #[inline]
    pub fn sampled(&self, output: OutputId) -> u128 {
        self.state.get(output.0)
    }

    #[inline]
    fn change(&mut self) {
        self.outputs_stale = true;
        self.signals_stale = true;
    }

    fn execute(&mut self, program: Program) {
        self.compiled.code(program).run(self.state.words_mut());
    }
}

impl fmt::Debug for Simulator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulator").field("words", &self.compiled.plan.layout.size).finish_non_exhaustive()
    }
}

impl edgewalk_netlist::Simulate for Simulator {
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
