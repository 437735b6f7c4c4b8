//! A frame in gates: the value of every net in every cycle, 64 cycles at once.
//!
//! ```text
//!  netlist, cycle by cycle ─> ports and flip-flops, 64 cycles a word ─> every gate ─> transitions of each net
//!                                          └──────── compared with ─────── next states
//! ```
//! The flip-flops' values are known from the netlist, so a gate computes 64 cycles with one operation on words. The gates' outputs
//! are compared with those of the netlist, and next states of flip-flops with their values a cycle later. Glitches within a cycle
//! are not seen.

use super::cell::Cell;
use super::flat::{Flat, Instance, ONE};
use super::gates::Gates;
use super::library::Library;
use edgewalk_tool::Stop;
use std::collections::BTreeMap;

/// Cycles at the start of a run whose flip-flops are not compared. A register without a reset may hold anything then. One that
/// always takes the same value is a constant in the gates at once, and in the netlist a cycle later.
pub const UNSETTLED: u64 = 16;

/// A run of the gates beside the netlist.
pub struct GateRun<'l> {
    flat: Flat<'l>,
    /// The place of each input's bit in a block.
    inputs: Vec<(usize, usize)>,
    /// Outputs that the netlist has: the place among the outputs, the net, and the place of its bit in a block.
    outputs: Vec<(usize, usize, usize)>,
    /// Where the value of each flip-flop comes from.
    states: Vec<Source>,
    values: Values,
    /// Of each flip-flop, in bit 63: the next state in the last cycle so far.
    last_next: Vec<u64>,
    /// Of each net, in bit 63: the value in the last cycle so far.
    last: Vec<u64>,
    /// The flip-flops of each unit, by their places among the cells.
    units: BTreeMap<String, Vec<usize>>,
    counts: Counts,
}

/// Values of the nets in a block.
struct Values {
    words: Vec<u64>,
    /// Of each net, the gates that read it.
    readers: Vec<Vec<usize>>,
    /// A bit for each gate: an input has changed since the gate was computed.
    due: Vec<u64>,
}

/// Where a flip-flop's value comes from.
enum Source {
    /// A bit of a block.
    Bit(usize),
    /// Bits of a block: the flip-flop is 1 where all bits of one of these states have these values.
    States(Vec<Vec<(usize, bool)>>),
    /// The gates, in the cycle before: the netlist has no such bit.
    Gates,
}

/// What was counted.
pub(super) struct Counts {
    /// Cycles run.
    pub cycles: u64,
    /// Transitions of each net.
    pub transitions: Vec<u64>,
    /// Of each cell, of each energy of each pin: transitions of the pin together with the cause.
    pub causes: Vec<Vec<u64>>,
    /// Of each unit, the cycles in which none of its flip-flops moved.
    pub still: BTreeMap<String, u64>,
    /// Flip-flops whose values are the netlist's.
    pub known: u64,
    /// Outputs and next states compared with the netlist.
    pub compared: u64,
    /// The first output, or flip-flop by its next state, that differs, and the cycle.
    pub differs: Option<(String, u64)>,
}

impl<'l> GateRun<'l> {
    /// A run of the gates; `places` tells where the netlist's bits are in a block: `u_setup.lane0.acc[3]`.
    ///
    /// # Errors
    /// A cell whose function is not known, a loop without a register, or an input that the netlist has not.
    pub fn new(
        gates: &Gates,
        library: &'l Library,
        places: &BTreeMap<String, usize>,
    ) -> Result<GateRun<'l>, Stop> {
        let flat = Flat::new(gates, library)?;
        let input = |(name, net): &(String, usize)| match places.get(name) {
            Some(place) => Ok((*net, *place)),
            None => {
                let line = format!("its gates have an input {name}, which the netlist has not");
                Err(Stop::Broken { tool: "yosys".to_owned(), lines: vec![line] })
            }
        };
        let inputs = flat.inputs.iter().map(input).collect::<Result<_, Stop>>()?;
        let outputs = flat.outputs.iter().enumerate();
        let outputs = outputs.filter_map(|(at, (name, net))| Some((at, *net, *places.get(name)?))).collect();
        let registers = &flat.cells[flat.gates..];
        let states: Vec<Source> = registers.iter().map(|of| Source::of(of, places)).collect();
        let known = states.iter().filter(|source| !matches!(source, Source::Gates));
        let mut units: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (place, of) in registers.iter().enumerate() {
            units.entry(of.unit.clone()).or_default().push(flat.gates + place);
        }
        let counts = Counts {
            cycles: 0,
            still: units.keys().map(|unit| (unit.clone(), 0)).collect(),
            transitions: vec![0; flat.nets],
            causes: flat.cells.iter().map(|of| vec![0; energies(of.cell)]).collect(),
            known: known.count() as u64,
            compared: 0,
            differs: None,
        };
        let values = Values::new(&flat);
        Ok(GateRun {
            last: values.words.clone(),
            last_next: vec![0; states.len()],
            values,
            inputs,
            outputs,
            units,
            states,
            counts,
            flat,
        })
    }

    /// Runs the cycles of a block, which follow those of the block before.
    pub fn block(&mut self, block: &[u64], cycles: u32) {
        let GateRun { flat, values, .. } = self;
        for (net, place) in &self.inputs {
            values.put(*net, block[*place]);
        }
        let (gates, registers) = flat.cells.split_at(flat.gates);
        let unknown: Vec<usize> = (0..registers.len())
            .filter(|place| match self.states[*place].word(block) {
                Some(state) => {
                    registers[*place].show(state, values);
                    false
                }
                None => true,
            })
            .collect();
        // A flip-flop that the netlist has not takes its next state from the gates, a cycle later: each turn makes one more cycle
        // of the block right, or nothing changes any more.
        let mut nexts = vec![0; registers.len()];
        for _ in 0..=cycles {
            for place in &unknown {
                registers[*place].show(nexts[*place] << 1 | self.last_next[*place] >> 63, values);
            }
            let before = nexts.clone();
            values.settle(gates);
            for place in &unknown {
                nexts[*place] = registers[*place].next(&values.words);
            }
            if nexts == before {
                break;
            }
        }
        let nexts: Vec<u64> = registers.iter().map(|of| of.next(&values.words)).collect();
        self.compare(&nexts, block, cycles);
        self.count(cycles);
    }

    /// Compares outputs with those of the netlist, and next states with its states a cycle later.
    fn compare(&mut self, nexts: &[u64], block: &[u64], cycles: u32) {
        let settled = if self.counts.cycles == 0 { u64::MAX << UNSETTLED } else { u64::MAX };
        let mask = counted(self.counts.cycles, cycles) & settled;
        let counts = &mut self.counts;
        let mut one = |name: &str, gates: u64, netlist: u64| {
            let differ = (gates ^ netlist) & mask;
            counts.compared += u64::from(mask.count_ones());
            if differ != 0 && counts.differs.is_none() {
                counts.differs = Some((name.to_owned(), counts.cycles + u64::from(differ.trailing_zeros())));
            }
        };
        for (at, net, place) in &self.outputs {
            one(&self.flat.outputs[*at].0, self.values.words[*net], block[*place]);
        }
        let registers = &self.flat.cells[self.flat.gates..];
        for (place, of) in registers.iter().enumerate() {
            if let (Source::Bit(_) | Source::States(_), Some(seen)) = (&self.states[place], &of.seen) {
                let shown = self.values.words[of.nets[seen.pin]];
                let state = if of.inverts(seen.pin) { !shown } else { shown };
                let name = seen.names.first().unwrap_or(&of.path);
                one(name, nexts[place] << 1 | self.last_next[place] >> 63, state);
            }
            // The last cycle of the block goes to bit 63.
            self.last_next[place] = nexts[place] << (u64::BITS - cycles);
        }
    }

    /// Counts transitions.
    fn count(&mut self, cycles: u32) {
        let mask = counted(self.counts.cycles, cycles);
        let changed: Vec<u64> = (self.values.words.iter().zip(&self.last))
            .map(|(word, last)| (word ^ (word << 1 | last >> 63)) & mask)
            .collect();
        for (count, changed) in self.counts.transitions.iter_mut().zip(&changed) {
            *count += u64::from(changed.count_ones());
        }
        for ((_, registers), still) in self.units.iter().zip(self.counts.still.values_mut()) {
            let outputs = registers.iter().map(|place| &self.flat.cells[*place]);
            let outputs = outputs.flat_map(|of| of.nets.iter().skip(of.cell.inputs));
            let moved = outputs.fold(0, |moved, net| moved | changed[*net]);
            *still += u64::from((mask & !moved).count_ones());
        }
        for (of, counts) in self.flat.cells.iter().zip(&mut self.counts.causes) {
            let mut counts = counts.iter_mut();
            for (pin, net) in of.cell.pins.iter().zip(&of.nets) {
                for energy in &pin.energies {
                    let clock = of.cell.register.as_ref().map(|register| register.clock);
                    let mut together = changed[*net];
                    // The clock moves in every cycle.
                    if let Some(cause) = energy.cause.filter(|cause| Some(*cause) != clock) {
                        together &= changed[of.nets[cause]];
                    }
                    if let Some(when) = energy.when {
                        together &= looked_up(when, of.cell.inputs, &of.nets, &self.values.words);
                    }
                    if let Some(count) = counts.next() {
                        *count += u64::from(together.count_ones());
                    }
                }
            }
        }
        for (last, word) in self.last.iter_mut().zip(&self.values.words) {
            *last = word << (u64::BITS - cycles);
        }
        self.counts.cycles += u64::from(cycles);
    }

    /// Nets, cells and what was counted of them.
    pub(super) fn counted(&self) -> (&Flat<'l>, &Counts) {
        (&self.flat, &self.counts)
    }
}

impl Values {
    /// No gate is computed yet.
    fn new(flat: &Flat) -> Values {
        let mut words = vec![0; flat.nets];
        words[ONE] = u64::MAX;
        let mut readers = vec![Vec::new(); flat.nets];
        let mut due = vec![0; flat.gates.div_ceil(64)];
        for (gate, of) in flat.cells[..flat.gates].iter().enumerate() {
            due[gate / 64] |= 1 << (gate % 64);
            of.nets[..of.cell.inputs].iter().for_each(|net| readers[*net].push(gate));
        }
        Values { words, readers, due }
    }

    fn put(&mut self, net: usize, word: u64) {
        if self.words[net] != word {
            self.words[net] = word;
            self.readers[net].iter().for_each(|gate| self.due[gate / 64] |= 1 << (gate % 64));
        }
    }

    /// Computes the gates that are due. Those that read a gate stand behind it.
    fn settle(&mut self, gates: &[Instance]) {
        for some in 0..self.due.len() {
            while self.due[some] != 0 {
                let Instance { cell, nets, .. } =
                    &gates[some * 64 + self.due[some].trailing_zeros() as usize];
                self.due[some] &= self.due[some] - 1;
                for (pin, net) in cell.pins.iter().zip(nets).skip(cell.inputs) {
                    let word = looked_up(pin.function, cell.inputs, nets, &self.words);
                    self.put(*net, word);
                }
            }
        }
    }
}

impl Source {
    fn of(register: &Instance, places: &BTreeMap<String, usize>) -> Source {
        let Some(seen) = &register.seen else { return Source::Gates };
        if seen.states.is_empty() {
            let place = seen.names.iter().find_map(|name| places.get(name));
            return place.map_or(Source::Gates, |place| Source::Bit(*place));
        }
        let state = |bits: &Vec<(String, bool)>| {
            bits.iter().map(|(name, value)| Some((*places.get(name)?, *value))).collect::<Option<Vec<_>>>()
        };
        seen.states.iter().map(state).collect::<Option<Vec<_>>>().map_or(Source::Gates, Source::States)
    }

    /// The value in a block, if the netlist has it.
    fn word(&self, block: &[u64]) -> Option<u64> {
        let all = |bits: &Vec<(usize, bool)>| {
            let bit = |(place, value): &(usize, bool)| if *value { block[*place] } else { !block[*place] };
            bits.iter().fold(u64::MAX, |word, of| word & bit(of))
        };
        match self {
            Source::Bit(place) => Some(block[*place]),
            Source::States(states) => Some(states.iter().fold(0, |word, bits| word | all(bits))),
            Source::Gates => None,
        }
    }
}

impl Instance<'_> {
    /// Whether an output of a flip-flop is the inverse of its state.
    fn inverts(&self, pin: usize) -> bool {
        self.cell.pins[pin].function & 1 == 1
    }

    /// Puts a flip-flop's state on its outputs.
    fn show(&self, state: u64, values: &mut Values) {
        for pin in self.cell.inputs..self.nets.len() {
            values.put(self.nets[pin], if self.inverts(pin) { !state } else { state });
        }
    }

    /// A flip-flop's next state.
    fn next(&self, words: &[u64]) -> u64 {
        let table = self.cell.register.as_ref().map_or(0, |register| register.next);
        looked_up(table, self.cell.inputs, &self.nets, words)
    }
}

/// How many energies the pins of a cell have.
fn energies(cell: &Cell) -> usize {
    cell.pins.iter().map(|pin| pin.energies.len()).sum()
}

/// The cycles of a block that have one before them; `before` is the number of cycles before the block.
fn counted(before: u64, cycles: u32) -> u64 {
    let all = u64::MAX >> (u64::BITS - cycles);
    if before == 0 { all & !1 } else { all }
}

/// A function of the nets at a cell's inputs, for 64 cycles.
fn looked_up(table: u64, inputs: usize, nets: &[usize], words: &[u64]) -> u64 {
    // By halves of the table, the highest input first: a choice between two functions of the others.
    fn chosen(table: u64, inputs: &[usize], words: &[u64]) -> u64 {
        let Some((last, others)) = inputs.split_last() else { return 0_u64.wrapping_sub(table & 1) };
        let half = 1 << others.len();
        let word = words[*last];
        let (low, high) = (chosen(table, others, words), chosen(table >> half, others, words));
        low & !word | high & word
    }
    chosen(table, &nets[..inputs], words)
}
