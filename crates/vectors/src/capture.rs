//! Runs the model under a bench and keeps every token that moves at a port, with the cycle in which it does.
//!
//! ```text
//!  triangles ─> machine ─> trace
//!  triangles ─> setup ─> edge ─> span ─> pixel ─> depth     each alone under its own bench,
//!                                                           fed with what the one before gave
//! ```

use crate::bench::{Bench, Setting, Slot};
use crate::device::{Device, model};
use crate::ports::{Direction, Interface, Token, Unit, interface, pack_triangle};
use crate::stalls::{StallKind, patterns};
use crate::status::status_ports;
use crate::suites::Suite;
use edgewalk_machine::Plan;
use edgewalk_model::setup::setup_clocks;
use edgewalk_model::{Coverage, DrawState};
use std::collections::BTreeMap;

/// What moved at one channel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ChannelTrace {
    /// The tokens, in order.
    pub tokens: Vec<Token>,
    /// The cycle in which each moved.
    pub cycles: Vec<u64>,
    /// Number of the triangle that each belongs to; empty where a channel does not know (rd, data).
    pub triangles: Vec<u32>,
}

/// All that is to be seen at the ports of a unit in a run.
#[derive(Clone, Debug)]
pub struct Trace {
    /// The machine.
    pub machine: Plan,
    /// The ports.
    pub interface: Interface,
    /// What the bench did.
    pub setting: Setting,
    /// The stalls in words.
    pub stalls: StallKind,
    /// For each channel of the interface.
    pub channels: Vec<ChannelTrace>,
    /// Every change of the outputs that are compared in every cycle, with its cycle; the first is cycle 0. See
    /// [`crate::status_ports`].
    pub status: Vec<(u64, Token)>,
    /// Cycles until nothing more happened.
    pub cycles: u64,
    /// For each channel the cycles in which its token was valid.
    pub valid_cycles: Vec<u64>,
    /// The longest wait between two things that happened, cycles.
    pub longest_gap: u64,
    /// Hazards and corners met.
    pub coverage: Coverage,
}

/// Runs the machine, or one of its units, over a suite. The machine must have passed [`edgewalk_machine::Machine::plan`].
#[must_use]
pub fn capture(machine: &Plan, unit: Unit, suite: &Suite, state: DrawState, stalls: StallKind) -> Trace {
    // With tags of 32 bits each token knows its triangle; a tag changes nothing else.
    let tagged = machine.tagged();
    let run = Run { machine: &tagged, suite, state };
    run.observe(unit, run.tokens(unit), stalls).with_tags_of(machine)
}

/// Runs a unit over these tokens, whoever made them; `seed` is that of the stalls.
#[must_use]
pub fn capture_tokens(
    machine: &Plan,
    unit: Unit,
    tokens: Vec<Token>,
    state: DrawState,
    stalls: StallKind,
    seed: u64,
) -> Trace {
    let suite = Suite { seed, ..Suite::of_triangles("tokens", "", Vec::new()) };
    Run { machine, suite: &suite, state }.observe(unit, tokens, stalls)
}

struct Run<'a> {
    machine: &'a Plan,
    suite: &'a Suite,
    state: DrawState,
}

impl Run<'_> {
    /// What enters the unit: what leaves the one before, running alone and without stalls.
    fn tokens(&self, unit: Unit) -> Vec<Token> {
        let pack = |(triangle, k)| pack_triangle(self.machine, triangle, k);
        match unit {
            Unit::Machine | Unit::Setup => self.suite.triangles().zip(0..).map(pack).collect(),
            Unit::Edge => self.output(Unit::Setup),
            Unit::Span => {
                let without_gradients = |mut line: Token| {
                    line.truncate(line.len() - GRADIENTS);
                    line
                };
                self.output(Unit::Edge).into_iter().map(without_gradients).collect()
            }
            Unit::Pixel => self.spans_with_gradients(),
            Unit::Depth => self.output(Unit::Pixel),
        }
    }

    /// The tokens that leave the unit.
    fn output(&self, unit: Unit) -> Vec<Token> {
        let trace = self.observe(unit, self.tokens(unit), StallKind::None);
        trace.channels.into_iter().next_back().map(|channel| channel.tokens).unwrap_or_default()
    }

    /// SPAN does not carry the gradients; they come from EDGE, and belong to the triangle that the tag names.
    fn spans_with_gradients(&self) -> Vec<Token> {
        let tag = |token: &Token, behind: usize| token[token.len() - 1 - behind];
        let gradients: BTreeMap<u128, Token> = self
            .output(Unit::Edge)
            .into_iter()
            .map(|line| (tag(&line, GRADIENTS), line[line.len() - GRADIENTS..].to_vec()))
            .collect();
        let mut spans = self.output(Unit::Span);
        for span in &mut spans {
            let gradient = gradients.get(&tag(span, 0)).cloned().unwrap_or_else(|| vec![0; GRADIENTS]);
            span.extend(gradient);
        }
        spans
    }

    fn setting(&self, interface: &Interface, tokens: Vec<Token>, stalls: StallKind) -> Setting {
        let constants = vec![u128::from(self.state.depth_func), u128::from(self.state.depth_write)];
        Setting {
            tokens,
            constants: if interface.constants.is_empty() { Vec::new() } else { constants },
            patterns: patterns(interface, stalls, self.suite.seed),
            latency: u64::from(self.machine.latency),
            clear_z: u128::from(self.suite.clear_z.unwrap_or(self.machine.z.max())),
            words: 1 << self.machine.widths().address,
        }
    }

    fn observe(&self, unit: Unit, tokens: Vec<Token>, stalls: StallKind) -> Trace {
        let interface = interface(self.machine, unit);
        let setting = self.setting(&interface, tokens, stalls);
        let slots = Slot::of(&interface);
        let status_ports = status_ports(&interface);
        let mut trace = Trace {
            machine: self.machine.clone(),
            setting: setting.clone(),
            stalls,
            channels: vec![ChannelTrace::default(); slots.len()],
            status: Vec::new(),
            cycles: 0,
            valid_cycles: vec![0; slots.len()],
            longest_gap: 0,
            coverage: Coverage::default(),
            interface,
        };
        let mut device = model(self.machine, unit);
        let mut bench = Bench::new(&trace.interface, setting);
        let mut outputs = Vec::new();
        let patience = patience(self.machine);
        while !bench.exhausted() || bench.cycle() < trace.cycles + patience {
            let cycle = bench.cycle();
            let inputs = bench.inputs().to_vec();
            device.cycle(&inputs, &mut outputs);
            let channels = trace.channels.iter_mut().zip(&mut trace.valid_cycles);
            for ((channel, valid_cycles), slot) in channels.zip(&slots) {
                *valid_cycles += u64::from(slot.valid(&inputs, &outputs));
                if slot.fires(&inputs, &outputs) {
                    channel.tokens.push(slot.token(&inputs, &outputs).to_vec());
                    channel.cycles.push(cycle);
                }
            }
            let status: Token = status_ports.iter().map(|port| port.value(&inputs, &outputs)).collect();
            let changed = trace.status.last().is_none_or(|(_, last)| *last != status);
            if changed {
                trace.status.push((cycle, status));
            }
            if bench.clock(&outputs) || changed {
                trace.longest_gap = trace.longest_gap.max(cycle + 1 - trace.cycles);
                trace.cycles = cycle + 1;
            }
        }
        trace.coverage = device.coverage().clone();
        trace
    }
}

/// Gradients that stand behind the fields of a line or a span: Z, R, G, B.
const GRADIENTS: usize = 4;

/// Longest time in which nothing may move at the ports though something will: SETUP, then lines without pixels, then a
/// span that comes from far off the screen.
fn patience(machine: &Plan) -> u64 {
    let clocks = setup_clocks(machine);
    let span = u64::from(machine.clocks_per_pixel()) << machine.widths().column;
    u64::from(clocks.phase1) + u64::from(clocks.phase2) + u64::from(machine.height) + span + 1000
}

impl Trace {
    /// The same run of the machine with the tags that it really has.
    fn with_tags_of(mut self, machine: &Plan) -> Trace {
        let mask = (1u128 << machine.tag_bits) - 1;
        let narrow = |token: &mut Token, place: usize| match machine.tag_bits {
            0 => _ = token.remove(place),
            _ => token[place] &= mask,
        };
        let mut first = true;
        for (channel, trace) in self.interface.channels.iter().zip(&mut self.channels) {
            let feeds = std::mem::replace(&mut first, false);
            let Some(place) = channel.field("tag") else { continue };
            trace.triangles = trace.tokens.iter().map(|token| token[place] as u32).collect(); // a tag of 32 bits
            trace.tokens.iter_mut().for_each(|token| narrow(token, place));
            if feeds {
                self.setting.tokens.iter_mut().for_each(|token| narrow(token, place));
            }
        }
        self.interface = interface(machine, self.interface.unit);
        self.machine = machine.clone();
        self
    }

    /// Tokens that the design has to give.
    #[must_use]
    pub fn tokens_out(&self) -> u64 {
        let channels = self.interface.channels.iter().zip(&self.channels);
        let out = channels.filter(|(channel, _)| channel.direction == Direction::Out);
        out.map(|(_, trace)| trace.tokens.len() as u64).sum()
    }

    /// Tokens and status changes that a bench has to compare.
    #[must_use]
    pub fn expected(&self) -> u64 {
        self.tokens_out() + self.status.len() as u64
    }
}
