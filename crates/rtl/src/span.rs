//! SPAN: cuts a line to the screen and queues what is left of it.

use std::sync::Arc;

use edgewalk_machine::units::{span::SPEC, tokens};
use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::fifo::fifo;
use crate::ports::Interface;
use crate::wires::{Token, parts};

const DOC: &str = "SPAN cuts a line to the screen and queues what is left of it.

  line ─> [end cut to the screen] ─> empty? ─no─> [FIFO] ─> span
                                        └─yes─> dropped; its flags wait for the next span

Timing: a line is taken when the queue has room; one that is not empty is a span in the next cycle at the earliest.
Rules: the span is cut on the side where it ends. What lies off the screen on the side where it starts is stepped over
by PIXEL, as the channels must be stepped there too.";

/// The netlist of SPAN.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn span(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_span", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (line_valid, line) = ports.takes();
    let span_ready = ports.gives_ready();

    let cut = match plan.fill {
        Fill::Exact => cut_exact(&m, plan, &line),
        Fill::Textbook => cut_textbook(&m, plan, &line),
    };

    m.comment("Flags of dropped lines wait for the next span.");
    let pend_fresh = m.reg("pend_fresh", 1).doc("fresh of dropped lines").reset(0);
    let pend_fence = m.reg("pend_fence", 1).doc("fence of dropped lines").reset(0);
    let fresh = (line["fresh"] | pend_fresh).named("fresh");
    let fence = (line["fence"] | pend_fence).named("fence");

    m.comment("The queue.");
    let fields = parts(&tokens::span(plan));
    let queue = fifo("edgewalk_span_fifo", plan.span_fifo, &fields)?;
    let queue = m.instance("queue", &queue);
    // A full queue holds back empty lines too: whether a line is empty is known too late in its clock.
    let line_ready = queue.output("in_ready").named("line_ready");
    let taken = (line_valid & line_ready).named("taken");
    let push = (taken & !cut.empty).named("push");
    pend_fresh.when(taken, cut.empty & fresh);
    pend_fence.when(taken, cut.empty & fence);
    let token = Token::new(fields.clone(), |f| match f {
        "x" => cut.x,
        "count" => cut.count,
        "leftward" => cut.leftward,
        "fresh" => fresh,
        "fence" => fence,
        same => line[same],
    });
    token.connect(queue.connect("in_valid", push).connect("out_ready", span_ready), "in", &fields);
    let span = Token::of_instance(queue, "out", fields);
    let span_valid = queue.output("out_valid");

    m.comment("While a triangle's first span is queued, EDGE must keep the increments of the triangle.");
    let fresh_queued = m.reg("fresh_queued", 1).doc("the first span of a triangle is queued").reset(0);
    fresh_queued.when(span_valid & span_ready & span["fresh"], 0).when(push & fresh, 1);

    ports.take_ready(line_ready);
    ports.give(span_valid, |f| span[f]);
    ports.status("fresh_queued", fresh_queued);
    m.finish()
}

/// A line cut to the screen.
struct Cut<'m> {
    empty: Signal<'m>,
    x: Signal<'m>,
    count: Signal<'m>,
    leftward: Signal<'m>,
}

/// Half-open spans from the major edge inwards, to the right or to the left.
fn cut_exact<'m>(m: &'m Module, plan: &Plan, line: &Token<'m>) -> Cut<'m> {
    let (cmaj, cmin, width) = (line["cmaj"], line["cmin"], plan.width as i32);
    m.comment("To the right: from cmaj to before cmin, at most to the end of the screen.");
    let end_right =
        cmin.slt(width).mux(cmin, width).named_doc("end_right", "signed, first column after the span");
    let none_right = (end_right.sle(cmaj) | cmin.sle(0)).named("none_right");
    m.comment("To the left: from before cmaj to cmin, at least to column 0.");
    let last_left = (cmaj - 1).named_doc("last_left", "signed, last column left of the major edge");
    let end_left = cmin.sgt(0).mux(cmin, 0).named_doc("end_left", "signed, last column of the span");
    let none_left = (last_left.slt(end_left) | cmin.sge(width)).named("none_left");
    let leftward = line["major_right"];
    Cut {
        empty: leftward.mux(none_left, none_right).named("empty"),
        x: leftward.mux(last_left, cmaj).named("x"),
        // end − x, or x − end + 1 = cmaj − end.
        count: (leftward.mux(cmaj, end_right) - leftward.mux(end_left, cmaj)).named_doc("count", "columns"),
        leftward,
    }
}

/// Spans with both ends, always to the right: a column stands one right of `Trunc(X)`.
fn cut_textbook<'m>(m: &'m Module, plan: &Plan, line: &Token<'m>) -> Cut<'m> {
    let (cmaj, cmin, major_right) = (line["cmaj"], line["cmin"], line["major_right"]);
    let width = plan.width as i32;
    m.comment("From Trunc(X) of the left edge to Trunc(X) of the right edge, both drawn; a column register is Trunc(X) + 1.");
    let x = (major_right.mux(cmin, cmaj) - 1).named("x");
    let xe = major_right.mux(cmaj, cmin).named_doc("xe", "signed, first column after the line");
    let end = xe.slt(width).mux(xe, width).named_doc("end_cut", "signed, first column after the span");
    Cut {
        empty: (end.sle(x) | xe.sle(0)).named("empty"),
        x,
        count: (end - x).named_doc("count", "columns"),
        leftward: m.lit(1, 0),
    }
}
