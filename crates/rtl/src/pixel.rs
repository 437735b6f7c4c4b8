//! PIXEL: steps along a span, a pixel every ceil(N/A) clocks, with A adders shared by the N channels.

mod adder;

mod terms;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{pixel::SPEC, tokens};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::light_pass::LightPass;
use crate::ports::Interface;
use crate::wires::{Part, Registers, Token, parts};
use adder::{Step, Words};
use terms::Terms;

const DOC: &str = "PIXEL steps along a span, a pixel every ceil(N/A) clocks, with A adders shared by the N channels.

  span ─> [x count]───────────────────────────────────────┐
      └─> [a value a channel] <─ + <─ [increments] <─ inc ├─> [out] ─> frag
                 └────────────────────────────────────────┘

Formats: values and increments are modular words; a fragment takes the bits above the fraction.
Timing: a pixel leaves in the last of its phases. The additions for the next pixel begin in that same phase and go on
in the first phases of the next pixel, one channel of each adder a clock; an adder without one more rests.
Rules: everything stands still while a fragment waits at the output. Columns off the screen cost their phases, and give
no fragment.";

/// The netlist of PIXEL.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn pixel(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_pixel", DOC);
    if plan.segments > 1 {
        m.doc(adder::SKEW_DOC);
    }
    if !plan.terms().is_empty() {
        m.doc(terms::DOC);
    }
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (span_valid, span) = ports.takes();
    let increments = ports.held_in("inc");
    let frag_ready = ports.gives_ready();
    let frag_valid = m.reg("frag_valid", 1).reset(0);

    m.comment("The span being drawn.");
    let advance = (!frag_valid.q() | frag_ready).named("advance");
    let active = m.reg("active", 1).doc("a span is being drawn").reset(0);
    let x = m.reg("x", span["x"].width()).doc("column, signed");
    let y = m.reg("y", span["y"].width()).doc("line");
    let leftward = m.reg("leftward", 1).doc("towards smaller columns");
    let count = m.reg("count", span["count"].width()).doc("pixels left of the span, this one too");
    let fence = m.reg("fence", 1).doc("for the next fragment");
    let phase = Phase::new(&m, plan.clocks_per_pixel());
    let last_phase = phase.as_ref().map_or(m.lit(1, 1), |phase| phase.last);
    let last = m.reg("last", 1).doc("count is 1");
    m.comment("Registers alone say whether the span goes on. Where it does not, one may enter; what is loaded while none comes means nothing.");
    let finish = (active.q() & last_phase & last.q()).named_doc("finish", "last clock of the span");
    let goes_on = (active.q() & !finish).named_doc("goes_on", "the next clock is this span's too");
    let span_ready = (advance & !goes_on).named("span_ready");
    let load = (span_valid & span_ready).named("load");
    let light_pass = LightPass::of(plan, &ports);
    let columns = light_pass.number(&m, x.q().width(), plan.width.into(), plan.shadow.size.into());
    let visible = x.q().lt(columns).named_doc("visible", "on the screen; negative columns are large");
    let emit = (active.q() & last_phase & visible).named_doc("emit", "a fragment");
    let moves = match &phase {
        None => advance,
        Some(_) => (advance & (last_phase | !active.q())).named_doc("moves", "another pixel, or none"),
    };

    active.when(advance, goes_on | span_valid);
    if let Some(phase) = &phase {
        phase.counter.when(advance, goes_on.mux(phase.next(), 0));
    }
    x.when(moves, goes_on.mux(leftward.q().mux(x.q() - 1, x.q() + 1), span["x"]));
    count.when(moves, goes_on.mux(count.q() - 1, span["count"]));
    last.when(moves, goes_on.mux(count.q().eq(2), span["count"].eq(1)));
    y.when(span_ready, span["y"]);
    leftward.when(span_ready, span["leftward"]);
    fence.when(advance, goes_on.mux(fence.q() & !emit, span["fence"]));
    let as_they_are = |part: &Part| ["material", "gloss", "tag"].contains(&part.name.as_str());
    let drawn = Registers::new(&m, "drawn", span.parts().into_iter().filter(as_they_are).collect());
    drawn.load(span_ready, |f| span[f]);
    let kt = plan.has_triangle_kt().then(|| {
        let kt = increments["kt"];
        m.reg("kt", kt.width()).doc("of the triangle").when(load & span["fresh"], kt)
    });

    m.comment("The additions.");
    let add = match &phase {
        None => goes_on,
        Some(_) => {
            // Set by a pixel that has a next one: its channels after the first are added in the next one's phases.
            let adding = m.reg("adding", 1).doc("this pixel is not the first of its span");
            adding.when(moves, goes_on);
            (goes_on & (last_phase | adding.q())).named("add")
        }
    };
    let slot = phase.map(|phase| phase.next().named_doc("slot", "channel of each adder in this clock"));
    let first =
        Step { stays: goes_on, fresh: (span_valid & span["fresh"]).named("new_increments"), add, slot };
    let words = Words::new(&m, plan, advance, first, &span, &increments);
    let terms = Terms::new(&m, plan, &span, [moves, span_ready], goes_on);

    m.comment("The output: in each stage the bits of one more segment.");
    let address = |x_bits: u32| {
        let (address, bits) = (m.cat(&[y.q(), x.q().trunc(x_bits)]), plan.widths().address);
        if address.width() < bits { address.zext(bits) } else { address }
    };
    let address = light_pass.choose(address(plan.widths().x), || address(plan.shadow.side_bits()));
    let mut valid = emit;
    let mut before: Option<Token> = None;
    let mut occupied = frag_valid.q();
    for stage in 0..plan.segments as usize {
        let is_last = stage + 1 == plan.segments as usize;
        let name = if is_last { "frag".to_owned() } else { format!("out{stage}") };
        let source = |f: Part| {
            let low = before.as_ref().and_then(|token| token.get(&f.name));
            let high = plan.channel_place(&f.name);
            let high = high.and_then(|channel| words.output(plan, channel, stage));
            let signal = match (high, low, f.name.as_str()) {
                (Some(high), Some(low), _) => Some(m.cat(&[high, low])),
                (Some(bits), None, _) | (None, Some(bits), _) => Some(bits),
                (None, None, "addr") => Some(address),
                (None, None, "fence") => Some(fence.q()),
                (None, None, "kt") => kt.map(Reg::q),
                (None, None, own) => terms.output(own).or(drawn.get(own).map(Reg::q)),
            };
            let kept =
                |signal| if is_last && f.name == "z" { depth(plan, light_pass, signal) } else { signal };
            signal.map(kept).map(|signal| (f, signal))
        };
        let source: Token = parts(&tokens::fragment(plan)).into_iter().filter_map(source).collect();
        let registers = Registers::new(&m, &name, source.parts());
        registers.load(advance, |f| source[f]);
        let filled = if is_last { frag_valid } else { m.reg(&format!("{name}_valid"), 1).reset(0) };
        filled.when(advance, valid);
        occupied = if is_last { occupied } else { occupied | filled };
        valid = filled.q();
        before = Some(registers.token());
    }

    ports.take_ready(span_ready);
    if let Some(fragment) = before {
        ports.give(frag_valid, |f| fragment[f]);
    }
    ports.status("active", active);
    ports.status("visible", visible);
    ports.status("advance", advance);
    ports.status("occupied", occupied);
    m.finish()
}

/// Of the map's depths the bits that its words have; the others are 0.
fn depth<'m>(plan: &Plan, light_pass: LightPass<'m>, z: Signal<'m>) -> Signal<'m> {
    let bits = plan.shadow.depth_bits;
    light_pass.choose(z, || if bits < z.width() { z.trunc(bits).zext(z.width()) } else { z })
}

/// Counts the clocks of a pixel, 0 to T - 1.
struct Phase<'m> {
    counter: Reg<'m>,
    last: Signal<'m>,
    /// After T - 1 the counter is 0 of itself.
    wraps: bool,
}

impl<'m> Phase<'m> {
    /// None where a pixel takes one clock.
    fn new(m: &'m Module, clocks: u32) -> Option<Phase<'m>> {
        (clocks > 1).then(|| {
            let counter = m.reg("phase", clocks.next_power_of_two().ilog2()).doc("clock of the pixel");
            let wraps = clocks.is_power_of_two();
            let last = if wraps { counter.q().all() } else { counter.q().eq(clocks as i32 - 1) };
            Phase { counter, last: last.named("last_phase"), wraps }
        })
    }

    /// The phase after this one.
    fn next(&self) -> Signal<'m> {
        let next = self.counter.q() + 1;
        if self.wraps { next } else { self.last.mux(0, next) }
    }
}
