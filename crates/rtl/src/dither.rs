//! DITHER: rounds colours to fewer bits by a pattern, and drops fragments by the same pattern.

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::dither::SPEC;
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::ports::Interface;

const DOC: &str = "DITHER stands between what colours a fragment and DEPTH. It keeps no fragment.

  frag ─┬─> pattern of the pixel ─┐
        └─> red, green, blue ─────┴─> [scale, add, cut] ─> dithered

Formats: the pattern is a number from 0 to 15, the same in every square of 4 x 4 pixels.
Timing: a fragment is offered on in the cycle in which it comes.";

const CUT_DOC: &str = "Rules: a colour c of b bits becomes (c - c / 2^n + pattern * 2^(b-n) / 16) / 2^(b-n), each quotient its whole part: n bits.
Its mean over a square is that of c, to a sixteenth of a step. It needs no clamp: all ones become all ones.";

const DOOR_DOC: &str = "Rules: a fragment is dropped where pattern / 16 is below kt / 2^kt_bits. The fence of a dropped fragment goes to the next that is not.";

/// The netlist of DITHER.
///
/// # Errors
/// None for a machine with DITHER that [`edgewalk_machine::Machine::plan`] accepts.
pub fn dither(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_dither", DOC);
    if plan.dither.rounds() {
        m.doc(CUT_DOC);
    }
    if plan.dither.drops() {
        m.doc(DOOR_DOC);
    }
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (frag_valid, frag) = ports.takes();
    let dithered_ready = ports.gives_ready();

    m.comment("The pattern at the pixel: of the low two bits of its column and of its line.");
    let pattern = pattern(&m, plan, frag["addr"]);

    let (mut valid, mut ready, mut fence) = (frag_valid, dithered_ready, frag["fence"]);
    if plan.dither.drops() {
        m.comment("A fragment whose k_t is above the pattern is dropped; its fence is kept for the next.");
        let bits = plan.blend.kt_bits;
        let kt = frag["kt"];
        let threshold = if bits > 4 { m.cat(&[pattern, m.lit(bits - 4, 0)]) } else { pattern };
        let dropped = kt.msb() | threshold.lt(kt.trunc(bits));
        let dropped = dropped.named_doc("dropped", "it goes no farther");
        let pend_fence = m.reg("pend_fence", 1).doc("of fragments that were dropped").reset(0);
        fence = (fence | pend_fence.q()).named("fence");
        ready = (dropped | dithered_ready).named("ready");
        valid = frag_valid & !dropped;
        pend_fence.when(frag_valid & ready, dropped & fence);
    }

    if plan.dither.rounds() {
        m.comment("Colours: made a little smaller, so that all ones stay in range, then the pattern added and the lower bits cut.");
    }
    let color = |name: &str| {
        if plan.dither.rounds() { cut(&m, plan, frag[name], pattern, name) } else { frag[name] }
    };
    let colors = ["r", "g", "b"].map(|name| (name, color(name)));

    ports.take_ready(ready);
    ports.give(valid, |f| match colors.iter().find(|(name, _)| *name == f) {
        Some((_, color)) => *color,
        None if f == "fence" => fence,
        None => frag[f],
    });
    m.finish()
}

/// The pattern's number: x0 ^ y0, y0, x1 ^ y1, y1.
fn pattern<'m>(m: &'m Module, plan: &Plan, addr: Signal<'m>) -> Signal<'m> {
    let widths = plan.widths();
    let bit = |first: u32, bits: u32, place: u32| {
        if place < bits { addr.bit(first + place) } else { m.lit(1, 0) }
    };
    let [x0, x1] = [0, 1].map(|place| bit(0, widths.x, place));
    let [y0, y1] = [0, 1].map(|place| bit(widths.x, widths.y, place));
    m.cat(&[x0 ^ y0, y0, x1 ^ y1, y1]).named_doc("pattern", "number of the pattern at the pixel")
}

/// A colour with the bits that are stored.
fn cut<'m>(m: &'m Module, plan: &Plan, color: Signal<'m>, pattern: Signal<'m>, name: &str) -> Signal<'m> {
    let (all, left) = (plan.color.bits, plan.dither.bits);
    let dropped = all - left;
    let high = color.slice(all - 1, left).zext(all);
    let scaled = (color - high).named_doc(&format!("scaled_{name}"), "less its part of 2^n");
    let threshold = match dropped {
        0..=3 => pattern.slice(3, 4 - dropped),
        4 => pattern,
        more => m.cat(&[pattern, m.lit(more - 4, 0)]),
    };
    let sum = (scaled + threshold.zext(all)).named(&format!("sum_{name}"));
    sum.slice(all - 1, dropped)
}
