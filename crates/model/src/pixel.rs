//! PIXEL: steps along a span, Z, R, G and B through A shared adders.
//!
//! ```text
//!  span ─> x, count, values ─── floor(value / 2^r) ─> out 0 ─> .. ─> out D-1 ─> frag
//!             ^── values += g, every T = 4/A clocks
//! ```
//! Formats: values and g of b + r bits, modular; x signed, COLW bits; outputs of b bits.
//!
//! Timing: a span taken in cycle n gives its first fragment in n + T + D, then one every T clocks, without a gap to the
//! next span. If the last stage cannot leave, all stands still.
//!
//! Rules: `docs/machine.md`, section 5. Not modelled: the segments of the adders and the channels' turns at them; only
//! their clocks are seen outside.

use crate::Coverage;
use crate::tokens::{Fragment, Rgb, Source, Span, Words, add, word_masks};
use edgewalk_numerics::Machine;

/// State of PIXEL.
#[derive(Clone, Debug)]
pub struct Pixel {
    width: u32,
    x_bits: u32,
    fraction: [u32; 4],
    masks: Words,
    last_phase: u32,
    stage_mask: usize,

    active: bool,
    phase: u32,
    x: i32,
    count: u32,
    /// 1 or -1 column.
    step_x: i32,
    values: Words,
    gradient: Words,
    /// y·2^xb.
    row: u32,
    fence: bool,
    source: Source,
    /// Out stages as a ring: `oldest` is stage D-1.
    stages: [Option<Fragment>; 4],
    oldest: usize,
}

impl Pixel {
    /// A unit at rest.
    #[must_use]
    pub fn new(machine: &Machine) -> Self {
        Pixel {
            width: machine.width,
            x_bits: machine.widths().x,
            fraction: machine.channels().map(|c| c.fraction),
            masks: word_masks(machine),
            last_phase: machine.clocks_per_pixel() - 1,
            stage_mask: machine.segments as usize - 1, // 1, 2 or 4
            active: false,
            phase: 0,
            x: 0,
            count: 0,
            step_x: 1,
            values: [0; 4],
            gradient: [0; 4],
            row: 0,
            fence: false,
            source: Source::default(),
            stages: [None; 4],
            oldest: 0,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.active = false;
        self.stages = [None; 4];
    }

    /// A span is being stepped along.
    #[inline]
    #[must_use]
    pub fn active(&self) -> bool {
        self.active
    }

    /// The column lies on the screen.
    #[inline]
    #[must_use]
    pub fn on_screen(&self) -> bool {
        (self.x as u32) < self.width // a negative column is a large unsigned one
    }

    /// An out stage is occupied.
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.stages[..=self.stage_mask].iter().any(Option::is_some)
    }

    /// The fragment offered to DEPTH.
    #[inline]
    #[must_use]
    pub fn frag(&self) -> Option<&Fragment> {
        self.stages[self.oldest & 3].as_ref()
    }

    /// The pipeline moves.
    #[inline]
    #[must_use]
    pub fn advance(&self, frag_ready: bool) -> bool {
        self.frag().is_none() || frag_ready
    }

    /// A span can be taken: the last one is done or has its last clock.
    #[inline]
    #[must_use]
    pub fn span_ready(&self, frag_ready: bool) -> bool {
        self.advance(frag_ready) && (!self.active || self.finish())
    }

    fn finish(&self) -> bool {
        self.phase == self.last_phase && self.count == 1
    }

    /// Clock edge. `gradient` is EDGE's g.
    #[inline]
    pub fn step(&mut self, span: Option<&Span>, gradient: &Words, frag_ready: bool, coverage: &mut Coverage) {
        if !self.advance(frag_ready) {
            return;
        }
        let mut sums = None;
        if self.active {
            if self.phase < self.last_phase {
                self.phase += 1;
                self.shift(None);
                return;
            }
            sums = self.sums(coverage);
        }
        self.shift(sums);
        if self.active && self.count > 1 {
            self.next_pixel();
            return;
        }
        self.active = span.is_some();
        if let Some(span) = span {
            self.load(span, gradient);
        }
    }

    /// Moves the out stages, `entering` into the first.
    #[inline]
    fn shift(&mut self, entering: Option<Fragment>) {
        self.stages[self.oldest & 3] = entering;
        self.oldest = self.oldest.wrapping_add(1) & self.stage_mask;
    }

    /// The pixel whose sums are ready, if it lies on the screen.
    #[inline]
    fn sums(&mut self, coverage: &mut Coverage) -> Option<Fragment> {
        if !self.on_screen() {
            coverage.off_screen += 1;
            return None;
        }
        let fragment = self.fragment();
        if self.fence {
            self.fence = false;
            coverage.fence += 1;
        }
        Some(fragment)
    }

    /// The pixel at `x`, its values cut to b bits.
    #[inline]
    fn fragment(&self) -> Fragment {
        let output = |i: usize| self.values[i].wrapping_shr(self.fraction[i]); // r < 64
        Fragment {
            addr: self.row | self.x as u32,
            z: output(0) as u32,
            rgb: Rgb::new([output(1) as u16, output(2) as u16, output(3) as u16]),
            fence: self.fence,
            source: self.source,
        }
    }

    #[inline]
    fn next_pixel(&mut self) {
        self.phase = 0;
        self.count -= 1;
        self.x = self.x.wrapping_add(self.step_x);
        self.values = add(&self.values, &self.gradient, &self.masks);
    }

    fn load(&mut self, span: &Span, gradient: &Words) {
        self.phase = 0;
        self.x = span.x;
        self.count = span.count;
        self.step_x = if span.left { -1 } else { 1 };
        self.values = span.values;
        self.row = span.y << self.x_bits;
        self.fence = span.fence;
        self.source = span.source;
        if span.fresh {
            self.gradient = *gradient;
        }
    }
}
