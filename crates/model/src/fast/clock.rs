//! The machine's clock without ticking: when each line, span and fragment passes, and what every cycle was spent on.
//!
//! ```text
//!  SETUP            EDGE               SPAN FIFO            PIXEL                 DEPTH
//!  a ─S1,S2─> prim p ─> line, held ─move m─> room for F ─pop o─> count·T clocks ─D─> read r ─L─> compare
//! ```
//! Every time is the greatest of what it waits for (max-plus), section by section of `docs/machine.md`:
//! - 2: `a' = p + w`, or `a + S1 + w` if culled, with w words of a triangle, 1 if it comes at once; `p = max(a + S1 + S2 + 1, EDGE free, first span popped + 1)`;
//!   sequenced `p = max(a + S, EDGE free + 1, first span popped + 2) + L + 1`;
//! - 3, 4: a line leaves EDGE a clock after the one before, `l`, and in the cycle in which that one moves on from SPAN's register;
//!   it moves in `m >= l + 1`, span k and what lies between it and span k − 1 not before `o(k−F) + 1`, the cycle in which the
//!   registered FIFO shows the room;
//! - 4, 5: `o(k) = max(m(k) + 1, o(k−1) + count·T)`: the registered FIFO shows the token; PIXEL takes it in its last clock;
//! - 5, 6: a fragment is read D cycles after its last clock, `r`; it is in the queue until `r + L`, and w holds it in
//!   `r + L + 1` if it passed.
//!
//! Drain: the fragment with the fence stands still until the queue and w are empty, and PIXEL with it: whatever PIXEL
//! would do from that cycle on is so much later. At most D + 1 fences are on their way at a time.
//!
//! Cycles are counted by cause (section 8) in order: `counted` is the first that is not yet.
//!
//! With POLY in EDGE's place the times of lines are those of `poly_clock.rs`.
//!
//! Not here: a queue that fills and addresses in flight under interlock; such frames are ticked.

use super::inflight::InFlight;
use super::walk::Span;
use super::walking::Walking;
use crate::counters::Counters;
use crate::fifo::Fifo;
use crate::setup::SetupClocks;
use edgewalk_machine::{Activity, Hazard, Plan};

/// The last fragment of a span, as DEPTH sees it.
#[derive(Clone, Copy, Debug, Default)]
struct LastRead {
    /// Cycle of its read.
    cycle: u64,
    /// The fragment passes the depth test, and so is in w a cycle longer.
    passed: bool,
}

impl LastRead {
    /// The first cycle in which nothing is in flight any more.
    fn drained(self, latency: u64) -> u64 {
        self.cycle + latency + 1 + u64::from(self.passed)
    }
}

/// A fragment with a fence on its way from PIXEL to DEPTH.
#[derive(Clone, Copy, Debug, Default)]
struct Fence {
    /// The cycle in which it reaches DEPTH.
    arrival: u64,
    /// The fragment before it; none: nothing to wait for.
    before: Option<LastRead>,
}

/// The times of the machine, from triangle to triangle.
#[derive(Clone, Debug)]
pub(super) struct Clock {
    span_fifo: usize,
    /// T: clocks a pixel.
    pixel: u32,
    /// D: clocks from PIXEL to DEPTH.
    segments: u64,
    /// L: clocks from read to compare.
    latency: u64,
    drain: bool,
    inflight: Option<InFlight>,
    /// Words of a triangle behind the first, one a cycle.
    words: u64,
    /// SETUP is sequenced: it keeps a prim till EDGE has walked it.
    keeps: bool,

    /// a: the cycle in which SETUP takes the next triangle; before its words have come, the first of them.
    pub(super) take: u64,
    /// EDGE takes a prim not before.
    pub(super) edge_free: u64,
    /// EDGE offers the next line from this cycle on.
    pub(super) offer: u64,
    /// The cycle after the last line has moved on from SPAN's register.
    pub(super) moved: u64,
    /// No span of the triangle has come yet.
    pub(super) fresh: bool,
    /// The cycle after the pop of each of the last 64 spans.
    room: [u64; 64],
    spans: u64,
    /// Pixels on and off the screen.
    drawn: u64,
    skipped: u64,
    /// Cycles of all spans in the FIFO.
    queued: u64,
    /// S1 and S2 of all triangles.
    pub(super) setup: [u64; 2],
    /// Cycles counted as EDGE while lines are walked.
    edge: u64,
    /// PIXEL pops not before.
    pixel_free: u64,
    last: Option<LastRead>,
    fences: Fifo<Fence, 8>,
    pub(super) walking: Walking,
    counted: u64,
    activity: [u64; Activity::ALL.len()],
}

impl Clock {
    pub(super) fn new(plan: &Plan, depth_write: bool) -> Self {
        Clock {
            span_fifo: plan.span_fifo as usize,
            pixel: plan.clocks_per_pixel(),
            segments: u64::from(plan.segments),
            latency: u64::from(plan.latency),
            drain: plan.hazard == Hazard::Drain,
            inflight: InFlight::new(plan, depth_write),
            words: if plan.is_sequenced() { u64::from(plan.triangle_words() - 1) } else { 0 },
            keeps: plan.is_sequenced(),
            take: 0,
            edge_free: 0,
            offer: 0,
            moved: 0,
            fresh: false,
            room: [0; 64],
            spans: 0,
            drawn: 0,
            skipped: 0,
            queued: 0,
            setup: [0; 2],
            edge: 0,
            pixel_free: 0,
            last: None,
            fences: Fifo::default(),
            walking: Walking::default(),
            counted: 0,
            activity: [0; Activity::ALL.len()],
        }
    }

    /// A triangle that SETUP culls.
    pub(super) fn culled(&mut self, setup: SetupClocks) {
        self.enter_setup();
        self.setup[0] += u64::from(setup.phase1);
        self.take += u64::from(setup.phase1) + 1;
    }

    /// A triangle that EDGE takes; its lines follow.
    #[inline(always)]
    pub(super) fn triangle(&mut self, setup: SetupClocks) {
        self.enter_setup();
        self.setup[0] += u64::from(setup.phase1);
        self.setup[1] += u64::from(setup.phase2);
        let prim = if self.keeps {
            // The prim before is taken in `edge_free`; a cycle later the next one is brought in.
            (self.take + u64::from(setup.phase1)).max(self.edge_free + 1) + u64::from(setup.phase2) + 1
        } else {
            (self.take + u64::from(setup.all()) + 1).max(self.edge_free)
        };
        self.take = prim + 1;
        self.offer = prim + 1;
        self.fresh = true;
        self.spend(prim + 1, Activity::Setup);
    }

    /// SETUP works until it takes the next triangle, and is IDLE in that cycle, or in those of its words.
    #[inline(always)]
    pub(super) fn enter_setup(&mut self) {
        self.spend(self.take, Activity::Setup);
        if self.words > 0 {
            self.take += self.words;
            self.idle_until(self.take + 1);
        } else if self.counted == self.take {
            let flush = self.last.is_some_and(|last| self.take < last.drained(self.latency));
            self.spend(self.take + 1, if flush { Activity::Flush } else { Activity::Idle });
        }
    }

    /// Counts the cycles before `until` in which SETUP has nothing to do.
    #[cold]
    fn idle_until(&mut self, until: u64) {
        while !self.fences.is_empty() && self.fences.head().arrival < until {
            self.pass_fence(Activity::Flush);
        }
        let drained = self.last.map_or(0, |last| last.drained(self.latency));
        self.spend(drained.min(until), Activity::Flush);
        self.spend(until, Activity::Idle);
    }

    /// Spans of a triangle, from one fence to the next; `fresh`: its first ones.
    #[inline(always)]
    pub(super) fn spans<W>(&mut self, spans: &[Span<W>], fresh: bool, to_left: bool) {
        if self.drain || self.inflight.is_some() {
            self.watched(spans, fresh, to_left);
        } else {
            self.flowing(spans, fresh);
        }
    }

    /// Spans of a machine in which no fragment waits for another.
    ///
    /// Behind a line, EDGE offers the next not before that has moved on: of a triangle's lines only the first asks for
    /// [`Clock::offer`]. And each span ends where the next may begin, so the cycles without a pixel to step over are what all of
    /// them take together, less the pixels.
    #[inline(always)]
    fn flowing<W>(&mut self, spans: &[Span<W>], fresh: bool) {
        let (Some(first), Some(last)) = (spans.first(), spans.last()) else { return };
        let (mut moved, mut pixel_free, mut place) = (self.next_line(), self.pixel_free, self.spans);
        let (mut before, mut queued, mut drawn, mut all) = (moved, 0u64, 0u64, 0u64);
        if fresh {
            let first = moved.max(self.room_before(place)) + u64::from(first.empty) + 1;
            self.edge_free = pixel_free.max(first) + 1;
        }
        // No frame lasts 2^64 clocks: nothing wraps, and unchecked all this stays in registers.
        let clocks_per_pixel = u64::from(self.pixel);
        for span in spans {
            before = moved;
            moved = moved.max(self.room_before(place)).wrapping_add(u64::from(span.empty)).wrapping_add(1);
            let pop = pixel_free.max(moved);
            self.room[place as usize & 63] = pop.wrapping_add(1);
            queued = pop.wrapping_add(1).wrapping_sub(moved).wrapping_add(queued);
            drawn = u64::from(span.count).wrapping_add(drawn);
            let pixels = u64::from(span.skip).wrapping_add(u64::from(span.count));
            all = pixels.wrapping_add(all);
            pixel_free = pixels.wrapping_mul(clocks_per_pixel).wrapping_add(pop);
            place = place.wrapping_add(1);
        }
        self.fresh = false;
        self.moved = moved;
        self.offer = if last.empty > 0 { moved - 1 } else { before };
        self.spans = place;
        self.queued += queued;
        self.drawn += drawn;
        self.skipped += all - drawn;
        self.edge += pixel_free + 1 - all * u64::from(self.pixel) - self.counted;
        self.pixel_free = pixel_free;
        self.counted = pixel_free + 1;
        self.last = Some(LastRead { cycle: pixel_free + self.segments, passed: false });
    }

    /// Spans of a machine in which fragments wait for fences, or must not meet their addresses.
    fn watched<W>(&mut self, spans: &[Span<W>], fresh: bool, to_left: bool) {
        let mut first = true;
        for span in spans {
            self.lines(u64::from(span.empty) + 1);
            self.span(span, first && fresh, first, to_left);
            first = false;
        }
    }

    /// The line that moved on last is a span: of a triangle or polygon the first one if it is fresh, and the first behind a fence.
    #[inline(always)]
    pub(super) fn span<W>(&mut self, span: &Span<W>, fresh: bool, fence: bool, to_left: bool) {
        let (place, pixel) = (self.spans as usize, u64::from(self.pixel));
        let push = self.moved - 1;
        let mut pop = self.pixel_free.max(push + 1);
        while !self.fences.is_empty() && self.fences.head().arrival <= pop {
            self.pass_fence(Activity::Edge);
            pop = self.pixel_free.max(push + 1);
        }
        self.room[place & 63] = pop + 1;
        self.queued += pop - push;
        self.spans += 1;
        let drawn = pop + u64::from(span.skip) * pixel;
        if fresh {
            self.edge_free = pop + 1;
            self.fresh = false;
        }
        if fence && self.drain {
            let arrival = drawn + pixel + self.segments;
            self.fences.push(Fence { arrival, before: self.last });
        }
        if let Some(inflight) = &mut self.inflight {
            inflight.meet(span, drawn, to_left, fence);
        }
        self.edge += pop + 1 - self.counted;
        self.skipped += u64::from(span.skip);
        self.drawn += u64::from(span.count);
        self.pixel_free = drawn + u64::from(span.count) * pixel;
        self.counted = self.pixel_free + 1;
        self.last = Some(LastRead { cycle: self.pixel_free + self.segments, passed: false });
    }

    /// The cycle in which the next line moves on from SPAN's register, if there is room.
    #[inline(always)]
    fn next_line(&self) -> u64 {
        self.offer.max(self.moved.saturating_sub(1)) + 1
    }

    /// There is room for a span not before.
    #[inline(always)]
    fn room_before(&self, span: u64) -> u64 {
        self.room[(span as usize).wrapping_sub(self.span_fifo) & 63]
    }

    /// So many lines leave EDGE and move on from SPAN's register, all but the last without a pixel: one waits for room, and those
    /// behind it find the same room.
    #[inline(always)]
    pub(super) fn lines(&mut self, lines: u64) {
        let next = self.next_line();
        self.moved = next.max(self.room_before(self.spans)) + lines;
        // A line leaves EDGE in the cycle in which the one before it moves on.
        self.offer = if lines > 1 { self.moved - 1 } else { next };
    }

    /// Whether the last fragment of the last span passed the depth test.
    #[inline(always)]
    pub(super) fn last_passed(&mut self, passed: bool) {
        if let Some(last) = &mut self.last {
            last.passed = passed;
        }
    }

    /// A fragment may have met its address in flight under interlock: the times are wrong from there on.
    #[inline(always)]
    pub(super) fn interlocked(&self) -> bool {
        self.inflight.as_ref().is_some_and(InFlight::met)
    }

    /// The last line of the triangle has left EDGE, `empty` of them since the last span.
    #[inline(always)]
    pub(super) fn end_triangle(&mut self, empty: u32) {
        if empty > 0 {
            self.lines(u64::from(empty));
        }
        // Without a span its mark goes with the last line.
        self.edge_free = self.edge_free.max(if self.fresh { self.moved } else { self.offer });
        self.spend(self.moved, Activity::Edge);
    }

    /// Counts the cycles before `until` in which PIXEL has nothing to do.
    #[inline(always)]
    pub(super) fn spend(&mut self, until: u64, cause: Activity) {
        if until <= self.counted {
            return;
        }
        while !self.fences.is_empty() && self.fences.head().arrival < until {
            self.pass_fence(cause);
        }
        self.activity[cause as usize] += until.saturating_sub(self.counted);
        self.counted = self.counted.max(until);
    }

    /// Lets the oldest fence through; PIXEL stands still while it waits. `cause`: of the cycles before, if PIXEL has
    /// nothing to do.
    #[cold]
    fn pass_fence(&mut self, cause: Activity) {
        let Fence { arrival, before } = *self.fences.head();
        self.fences.pop();
        let read = before.map_or(arrival, |last| last.drained(self.latency).max(arrival));
        let wait = read - arrival;
        self.activity[Activity::Hazard as usize] += wait;
        if arrival < self.counted {
            self.counted += wait;
            self.pixel_free += wait;
        } else {
            self.activity[cause as usize] += arrival - self.counted;
            self.counted = read;
            self.pixel_free = read;
        }
        // The fragments behind it are later too: itself, the one before the next fence, and so on.
        if let Some(last) = &mut self.last {
            last.cycle += wait;
        }
        for i in 0..self.fences.len() {
            let fence = self.fences.at_mut(i);
            fence.arrival += wait;
            if let Some(last) = &mut fence.before {
                last.cycle += wait;
            }
        }
    }

    /// No triangle is left: counts the cycles until the first idle one, itself included.
    pub(super) fn finish(mut self, counters: &mut Counters) {
        self.spend(self.take, Activity::Setup);
        while !self.fences.is_empty() {
            self.pass_fence(Activity::Flush);
        }
        if let Some(last) = self.last {
            self.spend(last.drained(self.latency), Activity::Flush);
        }
        self.spend(self.counted + 1, Activity::Idle);
        self.activity[Activity::Edge as usize] += self.edge;
        self.activity[Activity::Draw as usize] = self.drawn * u64::from(self.pixel);
        self.activity[Activity::Offscreen as usize] = self.skipped * u64::from(self.pixel);
        counters.cycles = self.counted;
        counters.activity = self.activity;
        counters.spans = self.spans;
        counters.fragments = self.drawn;
        counters.setup_clocks = self.setup;
        counters.queued_spans = self.queued;
        counters.inflight = self.drawn * self.latency;
    }
}
