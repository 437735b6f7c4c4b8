//! The span being drawn: where in it PIXEL is, and what it does in a clock.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Reg, Signal};

use super::adder::Step;
use super::phase::Phase;
use crate::light_pass::LightPass;
use crate::ports::Interface;
use crate::wires::{Part, Registers, Token};

/// The links of PIXEL.
pub(super) struct Links<'m> {
    pub span_valid: Signal<'m>,
    pub span: Token<'m>,
    /// The increments that EDGE holds.
    pub increments: Token<'m>,
    pub frag_valid: Signal<'m>,
    pub frag_ready: Signal<'m>,
}

/// What PIXEL does in a clock.
pub(super) struct Drawing<'m> {
    /// No fragment waits at the output.
    pub advance: Signal<'m>,
    /// A span is being drawn.
    pub active: Signal<'m>,
    /// Column and line of the pixel.
    pub x: Signal<'m>,
    pub y: Signal<'m>,
    /// Fence of the next fragment.
    pub fence: Signal<'m>,
    /// What goes with the fragments as the span has it.
    pub drawn: Registers<'m>,
    /// k_t of the triangle, where it has one.
    pub kt: Option<Signal<'m>>,
    /// The next clock is this span's too.
    pub goes_on: Signal<'m>,
    pub span_ready: Signal<'m>,
    /// The pixel lies on the screen.
    pub visible: Signal<'m>,
    /// A fragment leaves for the output.
    pub emit: Signal<'m>,
    /// The next clock has another pixel, or none.
    pub moves: Signal<'m>,
    pub light_pass: LightPass<'m>,
    /// `None` where a pixel takes one clock.
    phase: Option<Phase<'m>>,
    last_phase: Signal<'m>,
}

impl<'m> Drawing<'m> {
    /// The registers of the span, and their updates.
    pub fn new(m: &'m Module, plan: &Plan, links: &Links<'m>, ports: &Interface<'m>) -> Drawing<'m> {
        let Links { span_valid, ref span, ref increments, frag_valid, frag_ready } = *links;
        m.comment("The span in progress.");
        let advance = (!frag_valid | frag_ready).named("advance");
        let active = m.reg("active", 1).doc("a span is in progress").reset(0);
        let x = m.reg("x", span["x"].width()).doc("current column, signed");
        let y = m.reg("y", span["y"].width()).doc("line");
        let leftward = m.reg("leftward", 1).doc("towards smaller columns");
        let count =
            m.reg("count", span["count"].width()).doc("pixels left in the span, current one included");
        let fence = m.reg("fence", 1).doc("fence of the next fragment");
        let phase = Phase::new(m, plan.clocks_per_pixel());
        let last_phase = phase.as_ref().map_or(m.lit(1, 1), |phase| phase.last);
        let last = m.reg("last", 1).doc("count = 1: last pixel of the span");
        m.comment("Registers alone decide whether the span continues. Otherwise PIXEL loads the offered span. Values loaded without a valid span are don't care.");
        let finish = (active.q() & last_phase & last.q()).named_doc("finish", "last clock of the span");
        let goes_on = (active.q() & !finish).named_doc("goes_on", "the span continues in the next clock");
        let span_ready = (advance & !goes_on).named("span_ready");
        let load = (span_valid & span_ready).named("load");
        let light_pass = LightPass::of(plan, ports);
        let columns = light_pass.number(m, x.q().width(), plan.width.into(), plan.shadow.size.into());
        let visible = x
            .q()
            .lt(columns)
            .named_doc("visible", "the column is on the screen; unsigned, so a negative column is too large");
        let emit = (active.q() & last_phase & visible).named_doc("emit", "PIXEL makes a fragment");
        let moves = match &phase {
            None => advance,
            Some(_) => (advance & (last_phase | !active.q()))
                .named_doc("moves", "the pixel changes, or PIXEL is idle"),
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
        let drawn = Registers::new(m, "drawn", span.parts().into_iter().filter(as_they_are).collect());
        drawn.load(span_ready, |f| span[f]);
        let kt = plan.has_triangle_kt().then(|| {
            let kt = increments["kt"];
            m.reg("kt", kt.width()).doc("kt of the triangle").when(load & span["fresh"], kt).q()
        });
        let [active, x, y, fence] = [active, x, y, fence].map(Reg::q);
        Drawing {
            advance,
            active,
            x,
            y,
            fence,
            drawn,
            kt,
            goes_on,
            span_ready,
            visible,
            emit,
            moves,
            light_pass,
            phase,
            last_phase,
        }
    }

    /// What the lowest segments of the adders do.
    pub fn additions(&self, m: &'m Module, links: &Links<'m>) -> Step<'m> {
        let add = match &self.phase {
            None => self.goes_on,
            Some(_) => {
                // Set by a pixel that has a next one: its channels after the first are added in the next
                // one's phases.
                let adding = m.reg("adding", 1).doc("the current pixel is not the first of its span");
                adding.when(self.moves, self.goes_on);
                (self.goes_on & (self.last_phase | adding.q())).named("add")
            }
        };
        let slot = self.phase.as_ref();
        let slot =
            slot.map(|phase| phase.next().named_doc("slot", "channel that each adder serves in this clock"));
        let fresh = (links.span_valid & links.span["fresh"]).named("new_increments");
        Step { stays: self.goes_on, fresh, add, slot }
    }
}
