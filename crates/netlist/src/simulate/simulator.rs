//! Runs a netlist: inputs in, values out, one clock at a time.

use std::collections::BTreeMap;

use super::flatten::{Flat, RST, Readers, Slot};
use crate::netlist::Netlist;
use crate::ops::mask;

/// A running netlist. Inputs are 0 until set; registers without reset, and memory outputs before the first read, are 0
/// at the start (in Verilog they are unknown).
#[derive(Clone, Debug)]
pub struct Simulator {
    flat: Flat,
    /// The top module's inputs, with `rst`.
    inputs: BTreeMap<String, Slot>,
    /// Registers and memory outputs that take a value, between computing and taking it.
    next: Vec<(Slot, u128)>,
    pending: Pending,
}

/// Instructions and registers that read a value which changed since they were computed; all of them at the start.
#[derive(Clone, Debug)]
struct Pending {
    /// A bit a place of [`Readers`].
    bits: Vec<u64>,
    /// There may be instructions among them.
    any: bool,
}

impl Pending {
    fn all(instructions: usize, readers: &Readers) -> Pending {
        let mut pending = Pending { bits: vec![0; readers.end.div_ceil(64)], any: true };
        (0..instructions).chain(readers.registers..readers.end).for_each(|place| pending.insert(place));
        pending
    }

    #[inline(always)]
    fn insert(&mut self, place: usize) {
        self.bits[place / 64] |= 1 << (place % 64);
    }

    /// Takes out the first of 64 places.
    #[inline(always)]
    fn take(&mut self, word: usize) -> Option<usize> {
        let bits = self.bits[word];
        self.bits[word] = bits & bits.wrapping_sub(1);
        (bits != 0).then(|| word * 64 + bits.trailing_zeros() as usize)
    }
}

/// Gives a slot a value; who reads it is computed anew if that is another.
#[inline(always)]
fn put(values: &mut [u128], readers: &Readers, pending: &mut Pending, slot: Slot, value: u128) {
    let before = std::mem::replace(&mut values[slot as usize], value);
    if before != value {
        readers.of(slot).iter().for_each(|place| pending.insert(*place as usize));
        pending.any = true;
    }
}

/// An input of the top module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InputId(Slot);

/// Any named signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SignalId(Slot);

/// A name or a value that does not fit the netlist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SimError {
    /// No such input of the top module.
    #[error("no input `{0}`")]
    NoInput(String),
    /// No such signal.
    #[error("no signal `{0}`")]
    NoSignal(String),
    /// No such memory.
    #[error("no memory `{0}`")]
    NoMemory(String),
    /// The value has more bits than the input.
    #[error("{value} does not fit input `{name}` of {width} bits")]
    TooWide {
        /// The input.
        name: String,
        /// Width of the input.
        width: u32,
        /// The value given.
        value: u128,
    },
}

impl Simulator {
    /// The netlist before its first clock.
    pub fn new(netlist: &Netlist) -> Simulator {
        let flat = Flat::new(netlist);
        let names = netlist.inputs.iter().map(|input| input.name.as_str());
        let inputs = names
            .chain(netlist.has_reset.then_some("rst"))
            .filter_map(|name| Some((name.to_string(), *flat.names.get(name)?)))
            .collect();
        Simulator {
            pending: Pending::all(flat.instructions.len(), &flat.readers),
            flat,
            inputs,
            next: Vec::new(),
        }
    }

    /// The input `name` of the top module; `rst` is one of them if there is a register with reset.
    ///
    /// # Errors
    /// If there is none of that name.
    pub fn input(&self, name: &str) -> Result<InputId, SimError> {
        self.inputs.get(name).map(|slot| InputId(*slot)).ok_or_else(|| SimError::NoInput(name.to_string()))
    }

    /// A port, register, named wire, named constant, memory output (`ram_q`) or instance output (`u_a_q`) by its path:
    /// `q` in the top module, `u_edge.u_minor.slope` deeper down.
    ///
    /// # Errors
    /// If there is none of that path.
    pub fn signal(&self, path: &str) -> Result<SignalId, SimError> {
        let slot = self.flat.names.get(path);
        slot.map(|slot| SignalId(*slot)).ok_or_else(|| SimError::NoSignal(path.to_string()))
    }

    /// All signals with their paths, in alphabetical order. A signal may have several paths.
    pub fn signals(&self) -> impl Iterator<Item = (&str, SignalId)> {
        self.flat.names.iter().map(|(path, slot)| (path.as_str(), SignalId(*slot)))
    }

    /// Bits of a signal.
    pub fn width(&self, signal: SignalId) -> u32 {
        self.flat.widths[signal.0 as usize]
    }

    /// The instance of the top module in which a signal is computed; empty if none.
    pub fn unit(&self, signal: SignalId) -> &str {
        let unit = self.flat.units.iter().find(|(_, slots)| slots.contains(&signal.0));
        unit.map_or("", |(name, _)| name)
    }

    /// Whether a signal is a constant, or computed from nothing else.
    pub fn is_constant(&self, signal: SignalId) -> bool {
        self.flat.constant[signal.0 as usize]
    }

    /// Sets an input; bits beyond its width are dropped, as by a wire.
    pub fn set(&mut self, input: InputId, value: u128) {
        let Flat { values, widths, readers, .. } = &mut self.flat;
        let value = value & mask(widths[input.0 as usize]);
        put(values, readers, &mut self.pending, input.0, value);
    }

    /// Sets an input by name.
    ///
    /// # Errors
    /// If there is none of that name, or the value does not fit.
    pub fn set_input(&mut self, name: &str, value: u128) -> Result<(), SimError> {
        let input = self.input(name)?;
        let width = self.flat.widths[input.0 as usize];
        if value > mask(width) {
            return Err(SimError::TooWide { name: name.to_string(), width, value });
        }
        self.set(input, value);
        Ok(())
    }

    /// The value of a signal in this cycle.
    pub fn value(&mut self, signal: SignalId) -> u128 {
        self.eval();
        self.flat.values[signal.0 as usize]
    }

    /// The value of a signal in this cycle, by path.
    ///
    /// # Errors
    /// If there is none of that path.
    pub fn get(&mut self, path: &str) -> Result<u128, SimError> {
        let signal = self.signal(path)?;
        Ok(self.value(signal))
    }

    /// The words of a memory by its path.
    ///
    /// # Errors
    /// If there is none of that path.
    pub fn memory(&self, path: &str) -> Result<&[u128], SimError> {
        let index = self.flat.memory_names.get(path).ok_or_else(|| SimError::NoMemory(path.to_string()))?;
        Ok(&self.flat.memories[*index].words)
    }

    /// The memories that are written: path and bits of a word.
    pub fn written_memories(&self) -> impl Iterator<Item = (&str, u32)> {
        let all = self.flat.memory_names.iter().map(|(path, index)| (path, &self.flat.memories[*index]));
        let written = all.filter(|(_, memory)| !memory.writes.is_empty());
        written.map(|(path, memory)| (path.as_str(), self.flat.widths[memory.writes[0].2 as usize]))
    }

    /// Computes everything that follows from inputs and registers, if anything changed. Reading a signal does it too.
    pub fn eval(&mut self) {
        if !std::mem::replace(&mut self.pending.any, false) {
            return;
        }
        let Flat { values, instructions, readers, .. } = &mut self.flat;
        // In order: an instruction only makes later ones pending.
        for word in 0..readers.registers / 64 {
            while let Some(place) = self.pending.take(word) {
                let value = instructions[place].compute(values);
                put(values, readers, &mut self.pending, instructions[place].dst, value);
            }
        }
        self.pending.any = false;
    }

    /// One rising edge of `clk`.
    pub fn tick(&mut self) {
        self.eval();
        let Flat { values, registers, memories, readers, .. } = &mut self.flat;
        let is_set = |slot: Slot| values[slot as usize] == 1;
        let reset = is_set(RST);
        self.next.clear();
        // A register that reads what it read before keeps its value.
        for word in readers.registers / 64..self.pending.bits.len() {
            while let Some(place) = self.pending.take(word) {
                let register = &registers[place - readers.registers];
                let update = register.updates.iter().rev().find(|(when, _)| when.is_none_or(is_set));
                let next = match (reset, register.reset, update) {
                    (true, Some(value), _) => value,
                    (_, _, Some((_, value))) => values[*value as usize],
                    (_, _, None) => continue,
                };
                self.next.push((register.q, next));
            }
        }
        for memory in memories.iter_mut() {
            let index = |addr: Slot| usize::try_from(values[addr as usize]).unwrap_or(usize::MAX);
            for (en, addr, q) in &memory.reads {
                if is_set(*en) {
                    self.next.push((*q, memory.words.get(index(*addr)).copied().unwrap_or(0)));
                }
            }
            for (en, addr, data) in &memory.writes {
                if is_set(*en)
                    && let Some(word) = memory.words.get_mut(index(*addr))
                {
                    *word = values[*data as usize];
                }
            }
        }
        for (slot, next) in &self.next {
            put(values, readers, &mut self.pending, *slot, *next);
        }
    }
}
