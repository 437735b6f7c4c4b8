//! SETUP: turns three vertices into first values and increments.
//!
//! ```text
//!  tri ─> sort ─┬─> 3 edges: C, R, q, f, M ───────┬─> prim
//!               └─> area, planes ─> N channels ───┘
//! ```
//! Formats: vertices XW bits, 2^-s px; inside, integers of any length (the lanes are as long as they need be); outside,
//! columns of COLW bits and words of b + r bits, both modular.
//!
//! Timing: a parallel unit computes a triangle taken in cycle n in S1 cycles (edges, area, cull), and S2 more (channels) unless it
//! is culled, both as its numbers ask for; `prim` is offered from cycle n + S1 + S2 + 1 until it is taken, `tri_ready` is high in the cycle after. A sequenced unit works for S
//! cycles, waits while a prim is offered, and takes L more for the next; it takes words while EDGE walks.
//!
//! Rules: `docs/machine.md`, section 2. Not modelled: the lanes bit by bit; all is computed when the triangle arrives
//! and appears when the hardware would have it.

mod round;
pub(crate) mod sort;
pub(crate) mod edges;
mod channels;
mod polygon;
pub(crate) mod clocks;
mod sequenced;
mod spent;
mod schedule;
pub mod sequencer;
mod view;

pub use clocks::longest_setup;
pub use spent::SetupClocks;

use crate::Events;
use crate::ports::{Pins, Ported, Shown};
use crate::tokens::{FEW, Prim, Source};
use clocks::Timing;
use edges::{Parts, Screen};
use edgewalk_machine::{Plan, PortVertex, Role};
use sort::Sorted;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Idle,
    Phase1,
    Phase2,
    Done,
}

/// State of SETUP.
#[derive(Clone, Debug)]
pub struct Setup<const C: usize> {
    plan: Plan,
    timing: Timing,
    /// Of the pass of this triangle.
    screen: Screen,
    /// Of k_t at the port.
    kt_mask: u32,
    record_mask: u32,
    state: State,
    /// Cycles remaining in PHASE1 or PHASE2, less one; 0 in the others.
    remaining: u32,
    culled: bool,
    /// Of this triangle.
    clocks: SetupClocks,
    prim: Prim<C>,
    sequenced: bool,
    /// A prim is offered, and which. A sequenced unit works on while it is.
    there: bool,
    given: Prim<C>,
    /// Apart from the rest, as only a recording looks at it: inside, it made every cycle slower.
    sorted: Box<Sorted<C>>,
    /// Not hardware: triangles taken in.
    taken: u32,
    /// With TERM: the number of the last triangle since reset, -1 before the first.
    record: u32,
    /// Words of a triangle at the port: 1 where it comes at once.
    words: u32,
    /// Words taken of the triangle that comes.
    come: u32,
}

impl<const C: usize> Setup<C> {
    /// An idle unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        Setup {
            plan: plan.clone(),
            timing: Timing::new(plan),
            screen: Screen::picture(plan),
            record_mask: (1 << plan.shade.record_bits) - 1, // at most 20
            kt_mask: u32::MAX >> (31 - plan.blend.kt_bits), // at most 12
            state: State::Idle,
            remaining: 0,
            culled: false,
            clocks: SetupClocks::default(),
            prim: Prim::default(),
            sequenced: plan.is_sequenced(),
            there: false,
            given: Prim::default(),
            sorted: Box::new(Sorted::default()),
            taken: 0,
            record: u32::MAX,
            words: if plan.is_sequenced() { plan.triangle_words() } else { 1 },
            come: 0,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.state = State::Idle;
        self.remaining = 0;
        self.record = u32::MAX;
        self.come = 0;
        self.there = false;
    }

    /// A triangle, or a word of one, can be taken: the unit is IDLE.
    #[inline]
    #[must_use]
    pub fn tri_ready(&self) -> bool {
        self.state == State::Idle
    }

    /// A triangle is taken in this cycle, if one is offered: with its last word.
    #[inline]
    #[must_use]
    pub fn takes(&self, offered: bool) -> bool {
        self.tri_ready() && offered && self.come + 1 == self.words
    }

    /// The triangle offered to EDGE.
    #[inline]
    #[must_use]
    pub fn prim(&self) -> Option<&Prim<C>> {
        self.there.then_some(&self.given)
    }

    /// Not hardware: the clocks of the triangle taken last.
    #[inline]
    #[must_use]
    pub fn clocks(&self) -> SetupClocks {
        self.clocks
    }

    /// Clock edge, with a triangle offered or none; where it comes word by word with one of its words.
    #[inline(always)]
    pub fn step(
        &mut self,
        tri: Option<(&[PortVertex; 3], u32)>,
        prim_ready: bool,
        light_pass: bool,
        events: &mut Events,
    ) {
        let waits = self.there;
        if waits && prim_ready {
            self.there = false;
        }
        if self.remaining > 0 {
            self.remaining -= 1;
            return;
        }
        match self.state {
            State::Done if self.there && !self.sequenced => {}
            State::Idle => {
                if let Some((vertices, tag)) = tri {
                    self.come += 1;
                    if self.come < self.words {
                        return;
                    }
                    self.come = 0;
                    self.screen = Screen::of_pass(&self.plan, light_pass);
                    self.take(vertices, tag, events);
                }
            }
            State::Phase1 if self.culled => self.state = State::Idle,
            State::Phase1 if waits => {} // sequenced: its last word is repeated
            // Of edges without a plane there are no channels.
            State::Phase1 if self.clocks.phase2 == 0 => self.give(),
            State::Phase1 => self.enter(State::Phase2, self.clocks.phase2),
            State::Phase2 => self.give(),
            State::Done => self.state = State::Idle,
        }
    }

    /// Not hardware: an idle unit takes a triangle and works until it offers it, or has culled it.
    pub fn run(&mut self, triangle: &[PortVertex; 3], events: &mut Events) -> Option<Prim<C>> {
        let mut offered = Some((triangle, 0));
        while offered.is_some() || (self.prim().is_none() && !self.tri_ready()) {
            let takes = self.takes(offered.is_some());
            self.step(offered, false, false, events);
            offered = offered.filter(|_| !takes);
        }
        self.prim().copied()
    }

    /// All of the triangle is known.
    fn give(&mut self) {
        self.state = State::Done;
        (self.there, self.given) = (true, self.prim);
    }

    fn enter(&mut self, state: State, cycles: u32) {
        self.state = state;
        self.remaining = cycles - 1;
    }

    fn take(&mut self, vertices: &[PortVertex; 3], tag: u32, events: &mut Events) {
        let id = self.taken;
        let sorted = Sorted::new(&self.plan, vertices);
        if sorted.role.ends() {
            self.taken = self.taken.wrapping_add(1);
            self.record = self.record.wrapping_add(1);
        }
        let (clocks, culled) = prepare(&self.plan, &self.timing, self.screen, &sorted, &mut self.prim);
        self.enter(State::Phase1, clocks.phase1);
        self.clocks = clocks;
        self.culled = culled.is_some();
        match culled {
            None => {
                self.prim.kt = vertices[0].kt() & self.kt_mask;
                self.prim.record = self.record & self.record_mask;
                self.prim.source = Source { tag, id };
                self.count(&sorted, events);
                if self.plan.polygon.is_there() {
                    polygon::count(&self.plan, self.screen, &sorted, events);
                }
            }
            Some(Culled::Lines) => events.setup.culled_lines += 1,
            Some(Culled::Columns) => events.setup.culled_columns += 1,
            Some(Culled::Area) => events.setup.culled_area += 1,
        }
        *self.sorted = sorted;
    }

    fn count(&self, sorted: &Sorted<C>, events: &mut Events) {
        let [n1, n2] = self.prim.lines;
        let knee = sorted.corners[1].v;
        let p = 1 << self.plan.widths().center_fraction;
        events.setup.major_right += u64::from(self.prim.major_right);
        events.setup.major_left += u64::from(!self.prim.major_right);
        events.setup.no_upper_part += u64::from(n1 == 0);
        events.setup.no_lower_part += u64::from(n2 == 0);
        if let Role::Line { flat } = sorted.role {
            events.setup.line_flat += u64::from(flat);
            events.setup.line_steep += u64::from(!flat);
        }
        events.setup.knee_on_line += u64::from(n1 > 0 && n2 > 0 && knee % p == 0);
    }
}

/// Why a triangle draws nothing: the first that holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Culled {
    /// No line of pixel centres lies in it on the screen.
    Lines,
    /// No column (exact fill).
    Columns,
    /// The triangle's area is 0.
    Area,
}

/// The clocks of a triangle of the picture at the port; S2 is 0 if it is culled.
#[must_use]
pub fn setup_clocks(plan: &Plan, vertices: &[PortVertex; 3]) -> SetupClocks {
    let sorted = Sorted::<{ edgewalk_machine::MAX_CHANNELS }>::new(plan, vertices);
    prepare(plan, &Timing::new(plan), Screen::picture(plan), &sorted, &mut Prim::default()).0
}

/// Why a triangle of the picture at the port draws nothing, if SETUP culls it.
#[must_use]
pub fn cull(plan: &Plan, vertices: &[PortVertex; 3]) -> Option<Culled> {
    if plan.polygon.is_there() {
        let sorted = Sorted::<{ edgewalk_machine::MAX_CHANNELS }>::new(plan, vertices);
        let (timing, screen) = (Timing::new(plan), Screen::picture(plan));
        return polygon::prepare(plan, &timing, screen, &sorted, &mut Prim::default()).1;
    }
    let (screen, sorted) = (Screen::picture(plan), Sorted::<FEW>::new(plan, vertices));
    if edges::parts(plan, screen, &sorted).lines == [0, 0] {
        Some(Culled::Lines)
    } else if edges::no_columns(plan, screen, &sorted) {
        Some(Culled::Columns)
    } else {
        (sorted.area() == 0).then_some(Culled::Area)
    }
}

/// The clocks of a triangle on any screen, and why it draws nothing; if it does draw, `prim` gets its increments, without tag
/// and number.
pub(crate) fn prepare<const C: usize>(
    plan: &Plan,
    timing: &Timing,
    screen: Screen,
    sorted: &Sorted<C>,
    prim: &mut Prim<C>,
) -> (SetupClocks, Option<Culled>) {
    if plan.polygon.is_there() {
        return polygon::prepare(plan, timing, screen, sorted, prim);
    }
    let parts = edges::parts(plan, screen, sorted);
    let (clocks, culled) = found(plan, timing, screen, sorted, &parts, prim);
    let Some(clocks) = timing.of_program(screen, sorted, &parts, prim) else { return (clocks, culled) };
    for (edge, lines) in prim.minor.iter_mut().zip(parts.lines) {
        // The program leaves out what is not walked.
        edge.m = if lines == 0 { 0 } else { edge.m };
    }
    (clocks, culled)
}

/// Like `prepare`, with the clocks of a parallel SETUP.
fn found<const C: usize>(
    plan: &Plan,
    timing: &Timing,
    screen: Screen,
    sorted: &Sorted<C>,
    parts: &Parts,
    prim: &mut Prim<C>,
) -> (SetupClocks, Option<Culled>) {
    if parts.lines == [0, 0] {
        return (timing.culled(), Some(Culled::Lines));
    }
    if edges::no_columns(plan, screen, sorted) {
        return (timing.culled(), Some(Culled::Columns));
    }
    let area = sorted.area();
    let scale = timing.scale(sorted, area);
    let phase1 = timing.phase1(sorted, parts, scale);
    if area == 0 {
        return (SetupClocks { phase1, phase2: 0 }, Some(Culled::Area));
    }
    let [a, b, c] = &sorted.corners;
    let ([j0, j1], [n1, n2]) = (parts.first, parts.lines);
    *prim = Prim {
        line: parts.drawn() as u32, // first drawn line, 0 <= jm < H
        lines: parts.lines,
        thin: sorted.role.is_line(),
        flat: sorted.role.is_flat(),
        major_right: area < 0,
        major: edges::walk(plan, a, c, parts.drawn(), n1 + n2),
        minor: [edges::walk(plan, a, b, j0, n1), edges::walk(plan, b, c, j1, n2)],
        ..Prim::default()
    };
    channels::prepare(plan, sorted, parts, prim);
    let phase2 = timing.phase2(sorted, parts, prim, (area, scale));
    (SetupClocks { phase1, phase2 }, None)
}

impl<const C: usize> Ported<C> for Setup<C> {
    type Takes = ([PortVertex; 3], u32);

    fn show(&self, _: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.tri_ready());
        out.gives(self.prim());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        let triangle = pins.token.map(|(vertices, tag)| (vertices, *tag));
        self.step(triangle, pins.next, pins.state.light_pass, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
