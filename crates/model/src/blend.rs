//! BLEND: weighs the colour of a fragment that passed against that of its pixel, or adds it.
//!
//! ```text
//!  pass ─┬─> crd (addr)           cdata ──┐
//!        └─> queue ─> head ─ B ───────────┴─> stage 0 ─> .. ─> stage M-1 ─> w ─> cwr
//!               ^── forward ──────────────────────────────────────┴─────────┘
//! ```
//! Formats: colours of b bits; k_t of kt_bits + 1 bits, k/2^kt_bits, of which the first alone stands for 1. A word of the
//! memory is red, green and blue, red the most significant.
//!
//! Timing: a fragment taken into stage 0 at the end of cycle n stays there `work` cycles, 1 if nothing is multiplied, and is
//! written in n + work + M. A fragment a clock where `work` is 1.
//!
//! Rules: `docs/machine.md`, section 9; the three hazard policies draw the same picture. Queue, policy and forwarding are
//! those of any read-modify-write, `crate::rmw`; here are the stages, the wait for a result in them, and the arithmetic.
//! Not modelled: the products bit by bit; a result is computed when its fragment is taken.

mod view;

use crate::Events;
use crate::ports::{Pins, Ported, Shown};
pub use crate::rmw::Block;
use crate::rmw::{Outcome, Rmw};
use crate::tokens::{ColorWrite, Fragment};
use crate::word_memory::Ask;
use edgewalk_machine::{BlendKind, Hazard, Plan};

/// The unit's inputs of a cycle, but for the fragment; `color_write` is DEPTH's.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlendInputs {
    /// Colours of fragments that pass the depth test go on to BLEND.
    pub color_write: bool,
    /// BLEND adds; else it mixes.
    pub add: bool,
    /// The memory takes a read.
    pub crd_ready: bool,
    /// The oldest read's colour.
    pub cdata: Option<u64>,
    /// The memory takes a write.
    pub cwr_ready: bool,
}

/// The unit's ports to its memory in a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BlendOutputs<const C: usize> {
    /// Address of a colour read.
    pub crd: Option<u32>,
    /// The colour is taken, if it is there.
    pub cdata_ready: bool,
    /// A colour.
    pub cwr: Option<ColorWrite<C>>,
}

/// What travels beside the colour of the pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Side<const C: usize> {
    frag: Fragment<C>,
    /// k, 0 to 2^kt_bits.
    k: u32,
    /// The pixel's colour counts.
    need: bool,
}

/// A colour of the pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Colour {
    rgb: u64,
    /// Not hardware: the fragment that left it took none itself.
    opaque: bool,
}

/// State of BLEND.
#[derive(Clone, Debug)]
pub struct Blend<const C: usize> {
    /// b.
    bits: u32,
    kt_bits: u32,
    /// Place of k_t among the channels, if it is one.
    kt: Option<usize>,
    /// Clocks of a product.
    product: u32,
    /// M - 1.
    last: usize,
    rmw: Rmw<Colour, Side<C>>,
    /// Results, each as w will have it.
    stages: [Option<Outcome<Colour, Side<C>>>; 2],
    /// Cycles that stage 0 still needs, this one among them.
    work: u32,
}

impl<const C: usize> Blend<C> {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let blend = &plan.blend;
        let interpolated = blend.kind == BlendKind::Interpolated;
        let kt = plan.channel_place("kt");
        Blend {
            bits: plan.color.bits,
            kt_bits: blend.kt_bits,
            kt: kt.filter(|_| interpolated),
            product: match blend.multipliers {
                0 => blend.kt_bits.div_ceil(2),
                1 => 3,
                _ => 1,
            },
            last: blend.stages as usize - 1, // M is 1 or 2
            rmw: Rmw::new(blend.hazard, blend.queue),
            stages: [None; 2],
            work: 0,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.rmw.reset();
        self.stages = [None; 2];
    }

    /// Fragments or a write are in flight.
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.rmw.occupied() || self.stages.iter().any(Option::is_some)
    }

    /// The queue is full.
    #[must_use]
    pub fn full(&self) -> bool {
        self.rmw.block(None, false).is_some()
    }

    /// What keeps a fragment from entering. Without one there is no hazard.
    #[must_use]
    pub fn block(&self, pass: Option<&Fragment<C>>, add: bool) -> Option<Block> {
        let Some(pass) = pass else { return self.rmw.block(None, false) };
        let need = self.needs(pass, add);
        let by_stage = match self.rmw.policy() {
            Hazard::Drain => pass.fence && self.occupied(),
            Hazard::Interlock => need && self.in_stage(pass.addr),
            Hazard::Forward => false,
        };
        if by_stage { Some(Block::Hazard) } else { self.rmw.block(Some((pass.addr, pass.fence)), need) }
    }

    /// The fragment that is offered can be taken.
    #[must_use]
    pub fn pass_ready(&self, pass: Option<&Fragment<C>>, inputs: &BlendInputs) -> bool {
        let reads = pass.is_some_and(|pass| self.needs(pass, inputs.add));
        self.block(pass, inputs.add).is_none() && (inputs.crd_ready || !reads)
    }

    /// Address of a colour read.
    #[must_use]
    pub fn read(&self, pass: Option<&Fragment<C>>, add: bool) -> Option<u32> {
        let reads = |pass: &&Fragment<C>| self.needs(pass, add) && self.block(Some(pass), add).is_none();
        pass.filter(reads).map(|pass| pass.addr)
    }

    /// The colour of a pixel can be taken.
    #[must_use]
    pub fn cdata_ready(&self, cwr_ready: bool) -> bool {
        let head = self.rmw.head();
        head.is_some_and(|(_, side)| side.need) && self.room(cwr_ready) && !self.head_waits()
    }

    /// The write offered to the colour memory.
    #[must_use]
    pub fn write(&self) -> Option<ColorWrite<C>> {
        self.rmw.write().map(|w| ColorWrite {
            addr: w.addr,
            rgb: w.word.rgb,
            values: w.side.frag.values,
            lit: w.side.frag.lit,
            source: w.side.frag.source,
        })
    }

    /// Clock edge.
    pub fn step(&mut self, pass: Option<&Fragment<C>>, inputs: &BlendInputs, events: &mut Events) {
        let leaves = self.leaves(inputs.cwr_ready);
        let moves = self.moves(leaves);
        let taken = self.take(inputs, events);
        let pushed = pass.filter(|pass| self.pass_ready(Some(pass), inputs));
        if let Some(pass) = pass {
            self.count_entry(pass, inputs, events);
        }
        if let Some(pass) = pushed {
            let side = self.side(pass, inputs.add);
            events.blend.color_forward_write += u64::from(self.rmw.enter(pass.addr, side));
        }
        if taken {
            let result = self.result(inputs, events);
            self.work = if result.side.need && !inputs.add { self.product } else { 1 };
            self.shift(leaves, moves, Some(result), inputs, pushed, events);
        } else {
            self.work = self.work.saturating_sub(1).max(1);
            self.shift(leaves, moves, None, inputs, pushed, events);
        }
    }

    fn needs(&self, pass: &Fragment<C>, add: bool) -> bool {
        add || self.k(pass) != 0
    }

    /// k of a fragment, 0 to 2^kt_bits.
    fn k(&self, pass: &Fragment<C>) -> u32 {
        self.kt.map_or(pass.kt.into(), |place| pass.values[place]).min(1 << self.kt_bits)
    }

    fn side(&self, pass: &Fragment<C>, add: bool) -> Side<C> {
        Side { frag: *pass, k: self.k(pass), need: self.needs(pass, add) }
    }

    /// A stage has a fragment of this address.
    fn in_stage(&self, addr: u32) -> bool {
        self.stages.iter().flatten().any(|stage| stage.addr == addr)
    }

    /// Stage 0 has had all its clocks, or will have at the end of this cycle.
    fn done(&self) -> bool {
        self.work <= 1
    }

    /// The last stage goes into w.
    fn leaves(&self, cwr_ready: bool) -> bool {
        let done = self.last > 0 || self.done();
        self.stages[self.last].is_some() && done && (self.rmw.write().is_none() || cwr_ready)
    }

    /// Stage 0 goes on.
    fn moves(&self, leaves: bool) -> bool {
        if self.last == 0 {
            leaves
        } else {
            self.stages[0].is_some() && self.done() && (self.stages[1].is_none() || leaves)
        }
    }

    /// Stage 0 can take a fragment.
    fn room(&self, cwr_ready: bool) -> bool {
        self.stages[0].is_none() || self.moves(self.leaves(cwr_ready))
    }

    /// The oldest fragment waits for a result that will be forwarded to it.
    fn head_waits(&self) -> bool {
        let waits = |(addr, side): (u32, &Side<C>)| side.need && self.in_stage(addr);
        self.rmw.policy() == Hazard::Forward && self.rmw.head().is_some_and(waits)
    }

    /// The oldest fragment goes into stage 0.
    fn take(&self, inputs: &BlendInputs, events: &mut Events) -> bool {
        let Some((_, side)) = self.rmw.head() else { return false };
        let waits = self.head_waits();
        events.blend.color_head_wait += u64::from(waits);
        self.room(inputs.cwr_ready) && !waits && (!side.need || inputs.cdata.is_some())
    }

    /// The colour of the oldest fragment, which leaves the queue.
    fn result(&mut self, inputs: &BlendInputs, events: &mut Events) -> Outcome<Colour, Side<C>> {
        let old = Colour { rgb: inputs.cdata.unwrap_or(0), opaque: false };
        let head = self.rmw.retire(old);
        let mut side = *self.rmw.side(&head);
        if side.need && head.forwarded {
            events.blend.color_forward_used += 1;
            events.blend.behind_opaque += u64::from(head.old.opaque);
        }
        let mut rgb = 0;
        for channel in 1..=3 {
            let back = head.old.rgb >> (self.bits * (3 - channel as u32)) & ((1 << self.bits) - 1);
            let color = self.color(side.frag.values[channel], back as u32, &side, inputs.add);
            side.frag.values[channel] = color;
            rgb = rgb << self.bits | u64::from(color);
        }
        Outcome { addr: head.addr, side, word: Colour { rgb, opaque: !side.need }, stored: true }
    }

    /// One colour of a fragment before one of its pixel, b bits each.
    fn color(&self, front: u32, back: u32, side: &Side<C>, add: bool) -> u32 {
        let (front, back) = (i64::from(front), i64::from(back));
        let color = if add {
            (front + back).min((1 << self.bits) - 1)
        } else if side.need {
            let (one, half) = (1 << self.kt_bits, 1 << (self.kt_bits - 1));
            back + (((front - back) * (one - i64::from(side.k)) + half) >> self.kt_bits)
        } else {
            front
        };
        color as u32
    }

    /// Moves the stages, `entering` into the first, and the last into w and the queue.
    fn shift(
        &mut self,
        leaves: bool,
        moves: bool,
        entering: Option<Outcome<Colour, Side<C>>>,
        inputs: &BlendInputs,
        pushed: Option<&Fragment<C>>,
        events: &mut Events,
    ) {
        let last = self.stages[self.last].filter(|_| leaves);
        if let Some(result) = last {
            let to_entry = u64::from(pushed.is_some_and(|pass| pass.addr == result.addr));
            let taken = self.rmw.finish_with(result);
            if taken > 0 {
                events.blend.color_forward_entry += to_entry;
                events.blend.color_forward_queue += taken - to_entry;
            }
            self.stages[self.last] = None;
        } else {
            events.blend.color_write_stall += u64::from(self.rmw.write().is_some() && !inputs.cwr_ready);
            self.rmw.no_result(inputs.cwr_ready);
        }
        if moves && self.last > 0 {
            self.stages[1] = self.stages[0].take();
        }
        if entering.is_some() {
            self.stages[0] = entering;
        }
    }

    /// What becomes of the fragment that is offered.
    fn count_entry(&self, pass: &Fragment<C>, inputs: &BlendInputs, events: &mut Events) {
        match (self.block(Some(pass), inputs.add), self.rmw.policy()) {
            (Some(Block::Hazard), Hazard::Drain) => events.blend.color_drain_stall += 1,
            (Some(Block::Hazard), _) => events.blend.color_interlock_stall += 1,
            (Some(Block::Full), _) => events.blend.color_queue_full += 1,
            (None, _) if self.needs(pass, inputs.add) => {
                events.blend.color_read_stall += u64::from(!inputs.crd_ready);
            }
            (None, _) => {
                events.blend.opaque += 1;
                let stages = self.stages.iter().flatten().map(|stage| (stage.addr, &stage.side));
                let mut older = self.rmw.queued().chain(stages);
                let behind = older.any(|(addr, side)| addr == pass.addr && side.need);
                events.blend.opaque_behind += u64::from(behind);
            }
        }
    }
}

impl BlendInputs {
    fn of<T, const C: usize>(pins: &Pins<T, C>) -> BlendInputs {
        BlendInputs {
            color_write: pins.state.color_write,
            add: pins.state.blend_add,
            crd_ready: pins.word.ready,
            cdata: pins.word.word.map(|word| word as u64), // at most 48 bits
            cwr_ready: pins.next,
        }
    }
}

impl<const C: usize> Ported<C> for Blend<C> {
    type Takes = Fragment<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        let inputs = BlendInputs::of(pins);
        out.takes(self.pass_ready(pins.token, &inputs));
        out.gives(self.write().as_ref());
        out.asks(Ask { addr: self.read(pins.token, inputs.add), take: self.cdata_ready(inputs.cwr_ready) });
        out.status("color_hazard", self.block(pins.token, inputs.add) == Some(Block::Hazard));
        out.status("color_full", self.full());
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        self.step(pins.token, &BlendInputs::of(pins), events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
