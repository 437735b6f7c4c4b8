//! The bench in Rust: offers tokens, takes tokens, and is the depth memory where the design needs one.
//!
//! It does what the test bench in Verilog (`hdl/bench.v`) does, cycle for cycle. Nothing it drives depends on an output
//! of the same cycle.

use crate::ports::{Direction, Interface, Token};
use crate::stalls::Pattern;
use std::collections::VecDeque;

/// What the bench feeds and how it behaves.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Tokens of the first channel in; those of `data` come from the memory.
    pub tokens: Vec<Token>,
    /// Values of the constants, in the interface's order.
    pub constants: Vec<u128>,
    /// A pattern for each channel, then for each level; see [`crate::stalls::patterns`].
    pub patterns: Vec<Pattern>,
    /// Clocks from a depth read to its data, at the least.
    pub latency: u64,
    /// Every depth at the start.
    pub clear_z: u128,
    /// Words of the depth memory.
    pub words: usize,
}

/// A channel's place in the lists of port values.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    pub direction: Direction,
    /// Fields of a token.
    pub fields: usize,
    /// Where valid (In) or ready (Out) stands among the inputs; fields follow a valid.
    pub input: usize,
    /// Where ready (In) or valid (Out) stands among the outputs; fields follow a valid.
    pub output: usize,
}

impl Slot {
    /// The place of every channel of an interface.
    pub fn of(interface: &Interface) -> Vec<Slot> {
        let (mut input, mut output) = (0, 0);
        let mut slots = Vec::new();
        for channel in &interface.channels {
            let fields = channel.fields.len();
            slots.push(Slot { direction: channel.direction, fields, input, output });
            match channel.direction {
                Direction::In => (input, output) = (input + 1 + fields, output + 1),
                Direction::Out => (input, output) = (input + 1, output + 1 + fields),
            }
        }
        slots
    }

    /// Whether a token is offered.
    pub fn valid(&self, inputs: &[u128], outputs: &[u128]) -> bool {
        match self.direction {
            Direction::In => inputs[self.input] == 1,
            Direction::Out => outputs[self.output] == 1,
        }
    }

    /// Whether a token moved.
    pub fn fires(&self, inputs: &[u128], outputs: &[u128]) -> bool {
        inputs[self.input] == 1 && outputs[self.output] == 1
    }

    /// The fields of the channel's token in this cycle.
    pub fn token<'a>(&self, inputs: &'a [u128], outputs: &'a [u128]) -> &'a [u128] {
        match self.direction {
            Direction::In => &inputs[self.input + 1..][..self.fields],
            Direction::Out => &outputs[self.output + 1..][..self.fields],
        }
    }
}

/// The bench in the middle of a run.
#[derive(Clone, Debug)]
pub struct Bench {
    setting: Setting,
    slots: Vec<Slot>,
    levels: usize,
    memory: Option<Memory>,
    cycle: u64,
    /// Tokens of the first channel that have fired.
    sent: usize,
    /// Whether each channel in already stood valid, unfired, in the cycle before.
    held: Vec<bool>,
    inputs: Vec<u128>,
}

/// Places of the channels of the depth memory, and its contents.
#[derive(Clone, Debug)]
struct Memory {
    data: usize,
    read: usize,
    write: usize,
    words: Vec<u128>,
    /// Depths read, with the first cycle in which each may be offered.
    queue: VecDeque<(u64, u128)>,
}

impl Bench {
    /// A bench before cycle 0.
    #[must_use]
    pub fn new(interface: &Interface, setting: Setting) -> Bench {
        let place = |name| interface.channels.iter().position(|channel| channel.name == name);
        let memory = match (interface.memory, place("data"), place("rd"), place("wr")) {
            (true, Some(data), Some(read), Some(write)) => Some(Memory {
                data,
                read,
                write,
                words: vec![setting.clear_z; setting.words],
                queue: VecDeque::new(),
            }),
            _ => None,
        };
        Bench {
            setting,
            slots: Slot::of(interface),
            levels: interface.levels.len(),
            memory,
            cycle: 0,
            sent: 0,
            held: vec![false; interface.channels.len()],
            inputs: Vec::new(),
        }
    }

    /// The cycle that [`Bench::inputs`] is for, from 0.
    #[must_use]
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// All tokens have been taken and all depths that were read.
    #[must_use]
    pub fn exhausted(&self) -> bool {
        self.sent == self.setting.tokens.len() && self.memory.as_ref().is_none_or(|m| m.queue.is_empty())
    }

    /// What the bench drives in this cycle.
    pub fn inputs(&mut self) -> &[u128] {
        self.inputs.clear();
        let willing = |place: usize| self.setting.patterns[place].at(self.cycle);
        for (place, slot) in self.slots.iter().enumerate() {
            if slot.direction == Direction::Out {
                self.inputs.push(u128::from(willing(place)));
                continue;
            }
            let depth: [u128; 1];
            let token = match &self.memory {
                Some(memory) if memory.data == place => match memory.queue.front() {
                    Some((due, z)) if *due <= self.cycle => {
                        depth = [*z];
                        Some(&depth[..])
                    }
                    _ => None,
                },
                _ => self.setting.tokens.get(self.sent).map(Vec::as_slice),
            };
            match token.filter(|_| self.held[place] || willing(place)) {
                Some(token) => {
                    self.inputs.push(1);
                    self.inputs.extend(token);
                }
                None => self.inputs.resize(self.inputs.len() + 1 + slot.fields, 0),
            }
        }
        self.inputs.extend(&self.setting.constants);
        let first = self.slots.len();
        // A level is high where its pattern is not willing, while there are tokens: without stalls it never is.
        let more = self.sent < self.setting.tokens.len();
        let levels = (first..first + self.levels).map(|place| u128::from(more && !willing(place)));
        self.inputs.extend(levels);
        &self.inputs
    }

    /// The clock edge after a cycle with these outputs. True if any token moved.
    pub fn clock(&mut self, outputs: &[u128]) -> bool {
        let mut moved = false;
        for (place, slot) in self.slots.iter().enumerate() {
            let fires = slot.fires(&self.inputs, outputs);
            moved |= fires;
            self.held[place] = !fires && self.inputs[slot.input] == 1;
            let is_data = self.memory.as_ref().is_some_and(|memory| memory.data == place);
            self.sent += usize::from(fires && slot.direction == Direction::In && !is_data);
        }
        if let Some(memory) = &mut self.memory {
            let [data, read, write] = [memory.data, memory.read, memory.write].map(|place| {
                let slot = &self.slots[place];
                slot.fires(&self.inputs, outputs).then(|| slot.token(&self.inputs, outputs))
            });
            if data.is_some() {
                memory.queue.pop_front();
            }
            if let Some([addr, ..]) = read {
                let z = memory.words.get(*addr as usize).copied().unwrap_or(0);
                memory.queue.push_back((self.cycle + self.setting.latency, z));
            }
            // addr z z_en …
            if let Some([addr, z, 1, ..]) = write
                && let Some(word) = memory.words.get_mut(*addr as usize)
            {
                *word = *z;
            }
        }
        self.cycle += 1;
        moved
    }
}
