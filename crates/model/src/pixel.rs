//! PIXEL: steps along a span, N channels through A shared adders.
//!
//! ```text
//!  span ─> x, count, values ─── floor(value / 2^r) ─> out 0 ─> .. ─> out D-1 ─> frag
//!             ^── values += g, every T = ceil(N/A) clocks
//! ```
//! Formats: values and g of b + r bits, modular: they stand with the point before bit 32 of 64, so that the output of any
//! channel begins there; what is above it is not looked at. x signed, COLW bits; outputs of b bits.
//!
//! Timing: a span taken in cycle n gives its first fragment in n + T + D, then one every T clocks, without a gap to the
//! next span. If the last stage cannot leave, all stands still.
//!
//! Rules: `docs/machine.md`, section 5. Not modelled: the segments of the adders and the channels' turns at them; only
//! their clocks are seen outside.

mod view;

use crate::Events;
use crate::lit::{Cosines, Given, MAX_TERMS};
use crate::ports::{Pins, Ported, Shown};
use crate::term::{Walked, WalkedSpan};
use crate::tokens::{FEW, Fragment, OutputWords, Source, Span, Words, per_channel};
use edgewalk_machine::{Plan, Shadow};

/// What a pass draws.
#[derive(Clone, Copy, Debug)]
struct OfPass {
    /// Columns.
    width: u32,
    /// Bits of an address below the line.
    x_bits: u32,
    /// Bits of a depth that are kept.
    z_mask: u32,
}

/// State of PIXEL.
#[derive(Clone, Debug)]
pub struct Pixel<const C: usize> {
    /// Of a pass; those of the picture, and with `light_pass` those of the map.
    passes: [OfPass; 2],
    /// 32 - r: from a word to where it stands.
    align: OutputWords<C>,
    /// 2^b - 1; of the depth, what the pass keeps.
    masks: OutputWords<C>,
    last_phase: u32,
    /// How many there are.
    terms: usize,
    /// r and b of each; behind the last of 1 bit.
    term_formats: [(u32, u32); MAX_TERMS],

    active: bool,
    phase: u32,
    x: i32,
    /// Pixels remaining.
    count: u32,
    /// 1 or -1 column.
    step_x: i32,
    values: Words<C>,
    gradient: Words<C>,
    /// k_t of the triangle, where it has one: at most 13 bits.
    kt: u16,
    /// Of the span.
    pass: OfPass,
    /// y·2^xb, or y·2^SB.
    row: u32,
    fence: bool,
    source: Source,
    /// Out stage D-1, the last.
    out: Option<Fragment<C>>,
    /// Out stages before it as a ring of D-1 places.
    stages: [Option<Fragment<C>>; 3],
    before: usize,
    oldest: usize,
    /// With TERM: the terms at the pixel, and those of the fragments in the stages.
    walked: Walked,
    out_cosines: Cosines,
    cosines: [Cosines; 3],
}

impl<const C: usize> Pixel<C> {
    /// A unit at rest.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let z_mask = |bits: u32| u32::MAX >> (32 - bits);
        let picture = OfPass { width: plan.width, x_bits: plan.widths().x, z_mask: z_mask(plan.z.bits) };
        let Shadow { size, depth_bits, .. } = plan.shadow;
        let map = OfPass { width: size, x_bits: plan.shadow.side_bits(), z_mask: z_mask(depth_bits) };
        Pixel {
            passes: [picture, map],
            align: per_channel(plan, |c| 32 - c.fraction), // r <= 24
            masks: per_channel(plan, |c| u32::MAX >> (32 - c.bits)),
            last_phase: plan.clocks_per_pixel() - 1,
            terms: plan.terms().len().min(MAX_TERMS), // no machine has more; said so that no slice is checked for each pixel
            term_formats: std::array::from_fn(|i| {
                plan.terms().get(i).map_or((0, 1), |term| (term.fraction, term.bits))
            }),
            active: false,
            phase: 0,
            x: 0,
            count: 0,
            step_x: 1,
            values: [0; C],
            gradient: [0; C],
            kt: 0,
            pass: picture,
            row: 0,
            fence: false,
            source: Source::default(),
            out: None,
            stages: [None; 3],
            before: plan.segments as usize - 1, // D is 1, 2 or 4
            oldest: 0,
            walked: Walked::default(),
            out_cosines: Cosines::default(),
            cosines: [Cosines::default(); 3],
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.active = false;
        self.out = None;
        self.stages = [None; 3];
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
        (self.x as u32) < self.pass.width // a negative column is a large unsigned one
    }

    /// An out stage is occupied.
    #[must_use]
    pub fn occupied(&self) -> bool {
        self.out.is_some() || self.stages.iter().any(Option::is_some)
    }

    /// The fragment offered to DEPTH.
    #[inline]
    #[must_use]
    pub fn frag(&self) -> Option<&Fragment<C>> {
        self.out.as_ref()
    }

    /// The fragment offered on; with TERM the outputs of the terms, and the material, are beside it.
    #[inline]
    #[must_use]
    pub fn given(&self) -> Option<Given<'_, C>> {
        self.out.as_ref().map(|frag| Given { frag, cosines: &self.out_cosines })
    }

    /// Column and line of the pixel, while active.
    #[must_use]
    pub fn place(&self) -> (i32, u32) {
        (self.x, self.row >> self.pass.x_bits)
    }

    /// The triangle of the span, while active.
    #[must_use]
    pub fn source(&self) -> Source {
        self.source
    }

    /// With TERM: the words of the terms at the pixel; the low b + r bits count.
    #[must_use]
    pub fn walked(&self) -> &Walked {
        &self.walked
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

    /// Clock edge. `gradient` and `kt` are what EDGE holds; `walked`, with TERM, what comes with the span; `light_pass`: the span is one of the map.
    #[inline(always)]
    pub fn step(
        &mut self,
        span: Option<&Span<C>>,
        (gradient, kt): (&Words<C>, u32),
        walked: impl FnOnce() -> Walked,
        frag_ready: bool,
        light_pass: bool,
        events: &mut Events,
    ) {
        if !self.advance(frag_ready) {
            return;
        }
        if self.active {
            if self.phase < self.last_phase {
                self.phase += 1;
                self.shift(false);
                return;
            }
            self.shift(self.on_screen());
            self.entered(events);
            if self.count > 1 {
                self.next_pixel();
                return;
            }
        } else {
            self.shift(false);
        }
        self.active = span.is_some();
        if let Some(span) = span {
            self.pass = self.passes[usize::from(light_pass)];
            self.load(span, gradient, kt);
            if C > FEW && self.terms > 0 {
                self.walked = walked();
            }
        }
    }

    /// Moves the out stages, the pixel whose sums are ready into the first if it is `entering`.
    #[inline(always)]
    fn shift(&mut self, entering: bool) {
        if C > FEW && self.terms > 0 {
            // Beside a stage without a fragment stands what stood there before; nobody looks at it.
            let Pixel { walked, term_formats, terms, out_cosines, cosines, .. } = self;
            let formats = &term_formats[..*terms];
            let first = if self.before == 0 {
                out_cosines
            } else {
                *out_cosines = cosines[self.oldest];
                &mut cosines[self.oldest]
            };
            if entering {
                outputs(walked, formats, first);
            }
        }
        if self.before == 0 {
            self.out = entering.then(|| self.fragment());
            return;
        }
        let fragment = entering.then(|| self.fragment());
        self.out = std::mem::replace(&mut self.stages[self.oldest], fragment);
        self.oldest += 1;
        if self.oldest == self.before {
            self.oldest = 0;
        }
    }

    /// The pixel has entered the out stages, or lies beside the screen.
    #[inline]
    fn entered(&mut self, events: &mut Events) {
        if !self.on_screen() {
            events.pixel.off_screen += 1;
        } else if self.fence {
            self.fence = false;
            events.pixel.fence += 1;
        }
    }

    /// The pixel at `x`, its values cut to b bits.
    #[inline]
    fn fragment(&self) -> Fragment<C> {
        Fragment {
            addr: self.row | self.x as u32,
            values: std::array::from_fn(|i| (self.values[i] >> 32) as u32 & self.masks[i]),
            kt: self.kt,
            lit: false, // SHADOW says
            fence: self.fence,
            source: self.source,
        }
    }

    #[inline]
    fn next_pixel(&mut self) {
        self.phase = 0;
        self.count -= 1;
        self.x = self.x.wrapping_add(self.step_x);
        self.values = std::array::from_fn(|i| self.values[i].wrapping_add(self.gradient[i]));
        if C > FEW && self.terms > 0 {
            for term in &mut self.walked.terms[..self.terms] {
                term.v = term.v.wrapping_add(term.g);
                term.g = term.g.wrapping_add(term.gg);
            }
        }
    }

    fn load(&mut self, span: &Span<C>, gradient: &Words<C>, kt: u32) {
        self.phase = 0;
        self.masks[0] = self.pass.z_mask;
        self.x = span.x;
        self.count = span.count;
        self.step_x = if span.leftward { -1 } else { 1 };
        self.values = self.aligned(&span.values);
        self.row = span.y << self.pass.x_bits;
        self.fence = span.fence;
        self.source = span.source;
        if span.fresh {
            self.gradient = self.aligned(gradient);
            self.kt = kt as u16; // at most 13 bits
        }
    }

    fn aligned(&self, words: &Words<C>) -> Words<C> {
        std::array::from_fn(|i| words[i] << self.align[i])
    }
}

/// The outputs of the terms at a pixel: b bits above the r of the fraction.
#[inline]
fn outputs(walked: &Walked, formats: &[(u32, u32)], cosines: &mut Cosines) {
    (cosines.material, cosines.gloss) = (walked.material, walked.gloss);
    let terms = walked.terms.iter().zip(formats);
    for (output, (term, (fraction, bits))) in cosines.terms.iter_mut().zip(terms) {
        *output = (((term.v >> fraction) << (64 - bits)) as i64 >> (64 - bits)) as i32; // b <= 32
    }
}

impl<const C: usize> Ported<C> for Pixel<C> {
    type Takes = WalkedSpan<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.span_ready(pins.next));
        out.gives(self.given().map(|given| given.lit()).as_ref());
        out.status("active", self.active());
        out.status("visible", self.on_screen());
        out.status("advance", self.advance(pins.next));
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        let span = pins.token.map(|token| &token.span);
        let walked = || pins.token.map_or_else(Walked::default, |token| token.walked);
        let held = (&pins.held.gradient, pins.held.kt);
        self.step(span, held, walked, pins.next, pins.state.light_pass, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
