//! PIXEL: steps along a span, a pixel every 4/A clocks, with A adders shared by the four channels.

mod adder;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg};

use crate::token::{self, CHANNELS, Registers, Token};
use adder::{Step, Words};

const DOC: &str = "PIXEL steps along a span, a pixel every 4/A clocks, with A adders shared by the four channels.

  span ─> [x count]─────────────────────────────────────┐
      └─> [values z r g b] <─ + <─ [g z r g b] <─ EDGE  ├─> [out] ─> frag
                 └──────────────────────────────────────┘

Formats: values and increments are modular words; a fragment takes the bits above the fraction.
Timing: a pixel leaves in the last of its phases. The additions for the next pixel begin in that same phase and go on
in the first phases of the next pixel, one channel of each adder a clock.
Rules: everything stands still while a fragment waits at the output. Columns off the screen cost their phases, and give
no fragment.";

/// The netlist of PIXEL.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn pixel(machine: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_pixel", DOC);
    if machine.segments > 1 {
        m.doc(adder::SKEW_DOC);
    }
    let span_valid = m.input("span_valid", 1);
    let span = Token::inputs(&m, "span", token::span(machine));
    let increments = Token::inputs(&m, "inc", token::values(machine).collect());
    let frag_ready = m.input("frag_ready", 1);
    let frag_valid = m.reg("frag_valid", 1).reset(0);

    m.comment("The span being drawn.");
    let advance = (!frag_valid.q() | frag_ready).named("advance");
    let active = m.reg("active", 1).doc("a span is being drawn").reset(0);
    let x = m.reg("x", span["x"].width()).doc("column, signed");
    let y = m.reg("y", span["y"].width()).doc("line");
    let left = m.reg("left", 1).doc("towards smaller columns");
    let count = m.reg("count", span["count"].width()).doc("pixels left of the span, this one too");
    let fence = m.reg("fence", 1).doc("for the next fragment");
    let phases = machine.clocks_per_pixel();
    let phase = (phases > 1).then(|| m.reg("phase", phases.ilog2()).doc("clock of the pixel"));
    let last_phase = phase.map_or(m.lit(1, 1), |phase| phase.q().all().named("last_phase"));
    let finish = (active.q() & last_phase & count.q().eq(1)).named_doc("finish", "last clock of the span");
    let span_ready = (advance & (!active.q() | finish)).named("span_ready");
    let load = (span_valid & span_ready).named("load");
    let visible =
        x.q().lt(machine.width as i32).named_doc("visible", "on the screen; negative columns are large");
    let leaves = (advance & active.q() & last_phase).named_doc("leaves", "this pixel is done");
    let next = (leaves & !finish).named_doc("next_pixel", "another one follows");
    let emit = (active.q() & last_phase & visible).named_doc("emit", "a fragment");

    active.when(leaves & finish, 0).when(load, 1);
    if let Some(phase) = phase {
        phase.when(advance & active, phase.q() + 1).when(load, 0);
    }
    x.when(next, left.q().mux(x.q() - 1, x.q() + 1)).when(load, span["x"]);
    count.when(next, count.q() - 1).when(load, span["count"]);
    y.when(load, span["y"]);
    left.when(load, span["left"]);
    fence.when(advance & emit, 0).when(load, span["fence"]);
    let tag = Registers::new(&m, "drawn", token::tag(machine).into_iter().collect());
    tag.load(load, |f| span[f]);

    m.comment("The additions.");
    let add = match phase {
        None => next,
        Some(_) => {
            // Set by a pixel that has a next one: its channels after the first are added in the next one's phases.
            let adding = m.reg("adding", 1).doc("this pixel is not the first of its span");
            adding.when(next, 1).when(load, 0);
            (next | (advance & active.q() & !last_phase & adding.q())).named("add")
        }
    };
    let slot = phase.map(|phase| (phase.q() + 1).named_doc("slot", "channel of each adder in this clock"));
    let first = Step { load, fresh: span["fresh"], add, slot };
    let words = Words::new(&m, machine, advance, first, &span, &increments);

    m.comment("The output: in each stage the bits of one more segment.");
    let address = m.cat(&[y.q(), x.q().trunc(machine.widths().x)]);
    let mut valid = emit;
    let mut before: Option<Token> = None;
    let mut occupied = frag_valid.q();
    for stage in 0..machine.segments as usize {
        let is_last = stage + 1 == machine.segments as usize;
        let name = if is_last { "frag".to_owned() } else { format!("out{stage}") };
        let source = |f: token::Field| {
            let low = before.as_ref().and_then(|token| token.get(&f.name));
            let high = CHANNELS.iter().position(|channel| *channel == f.name);
            let high = high.and_then(|channel| words.output(machine, channel, stage));
            let signal = match (high, low, f.name.as_str()) {
                (Some(high), Some(low), _) => Some(m.cat(&[high, low])),
                (Some(bits), None, _) | (None, Some(bits), _) => Some(bits),
                (None, None, "addr") => Some(address),
                (None, None, "fence") => Some(fence.q()),
                (None, None, own) => tag.get(own).map(Reg::q),
            };
            signal.map(|signal| (f, signal))
        };
        let source: Token = token::fragment(machine).into_iter().filter_map(source).collect();
        let registers = Registers::new(&m, &name, source.fields());
        registers.load(advance, |f| source[f]);
        let filled = if is_last { frag_valid } else { m.reg(&format!("{name}_valid"), 1).reset(0) };
        filled.when(advance, valid);
        occupied = if is_last { occupied } else { occupied | filled };
        valid = filled.q();
        before = Some(registers.token());
    }

    m.output("span_ready", span_ready);
    m.output("frag_valid", frag_valid);
    if let Some(fragment) = before {
        fragment.output(&m, "frag");
    }
    m.output_doc("active", active, "a span is being drawn");
    m.output_doc("visible", visible, "its pixel is on the screen");
    m.output_doc("advance", advance, "nothing waits at the output");
    m.output_doc("occupied", occupied, "a fragment is in an output stage");
    m.finish()
}
