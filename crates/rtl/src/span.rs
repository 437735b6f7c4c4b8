//! SPAN: cuts the end of a line to the screen and queues the span.

use std::sync::Arc;

use edgewalk_machine::units::{span::SPEC, tokens};
use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::fifo::fifo;
use crate::light_pass::LightPass;
use crate::ports::Interface;
use crate::wires::{Registers, Token, moved, parts};

const DOC: &str = "SPAN cuts the end of a line to the screen and queues the span.

  line ─> [end cut to the screen] ─> held ─> empty? ─no─> [FIFO] ─> span
                                               └─yes─> dropped; its flags wait for the next span

Timing: SPAN takes a line if it holds none, or if the queue has room. A span appears two cycles after its line was taken, at the
earliest. An empty line takes its turn like any other.
Rules: the span is cut on the side where it ends. Columns off the screen on the side where it starts are
stepped over by PIXEL, as the channels must be stepped there too.";

/// The netlist of SPAN.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn span(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_span", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (line_valid, line) = ports.takes();
    let span_ready = ports.gives_ready();

    let (bits, lines, size) = (line["cmaj"].width(), plan.widths().y, plan.shadow.size);
    let light_pass = LightPass::of(plan, &ports);
    let width = light_pass.number(&m, bits, plan.width.into(), size.into());
    let thin = Thin::of(&line, || light_pass.number(&m, bits, plan.height.into(), size.into()));
    let ends = match plan.fill {
        Fill::Exact => ends_exact(&m, width, &line, thin),
        Fill::Textbook => ends_textbook(&m, width, &line),
    };

    m.comment("Line register. The right end is clipped here. Don't care while line_held is 0.");
    let fields = parts(&tokens::span(plan));
    let queue = fifo("edgewalk_span_fifo", plan.span_fifo, &fields, &["fresh"])?;
    let queue = m.instance("queue", &queue);
    let room = queue.output("in_ready");
    let line_held = m.reg("line_held", 1).doc("1: the line register holds a line").reset(0);
    let line_ready = (!line_held.q() | room).named("line_ready");
    let take = (line_valid & line_ready).named("take");
    let moves = (line_held.q() & room).named_doc("moves", "the line held is queued or dropped");
    line_held.when(moves, 0).when(take, 1);
    let made = |f: &str| matches!(f, "x" | "count" | "leftward") || f == "y" && thin.is_some();
    let as_it_is: Vec<_> = fields.iter().filter(|f| !made(&f.name)).cloned().collect();
    let held = Registers::new(&m, "held", as_it_is);
    held.load(line_ready, |f| line[f]);
    let [first, end] = ["first", "end"].map(|name| m.reg(&format!("held_{name}"), ends.first.width()));
    let first = first.doc("signed, first column").when(line_ready, ends.first).q();
    let end = end
        .doc("signed, the column behind the last, or one beyond the screen")
        .when(line_ready, ends.end)
        .q();
    let beyond =
        m.reg("held_beyond", 1).doc("1: the span ends with the screen").when(line_ready, ends.beyond).q();
    let end = beyond.mux(width, end).named("end_cut");
    let [crossed, outside] = [
        ("crossed", "1: no column lies between the line's edges", ends.crossed),
        ("outside", "1: both ends lie beside the screen", ends.outside),
    ]
    .map(|(name, doc, end)| m.reg(&format!("held_{name}"), 1).doc(doc).when(line_ready, end).q());
    let empty = (crossed | outside).named_doc("empty", "1: the line has no column on the screen");
    let leftward = match plan.fill {
        Fill::Exact => m
            .reg("held_leftward", 1)
            .doc("1: the span is drawn from its last column to its first")
            .when(line_ready, ends.leftward)
            .q(),
        Fill::Textbook => m.lit(1, 0),
    };
    let pixel = thin.map(|thin| HeldPixel {
        thin: moved(&m, line_ready, "held_thin", "a pixel of a line", thin.thin),
        flat: moved(&m, line_ready, "held_flat", "of a line with x and y exchanged", thin.flat),
        y: moved(&m, line_ready, "held_y", "line of the span", line["y"]),
    });

    m.comment("Flags of dropped lines wait for the next span.");
    let pend_fresh = m.reg("pend_fresh", 1).doc("fresh of dropped lines").reset(0);
    let pend_fence = m.reg("pend_fence", 1).doc("fence of dropped lines").reset(0);
    let fresh = (held["fresh"].q() | pend_fresh).named("fresh");
    let fence = (held["fence"].q() | pend_fence).named("fence");
    pend_fresh.when(moves, empty & fresh);
    pend_fence.when(moves, empty & fence);

    m.comment("The queue.");
    let push = (moves & !empty).named("push");
    let token = Token::new(fields.clone(), |f| match (f, pixel) {
        ("x", Some(pixel)) => pixel.flat.mux(pixel.y.zext(bits), leftward.mux(end - 1, first)),
        ("x", None) => leftward.mux(end - 1, first),
        ("y", Some(pixel)) => pixel.flat.mux(first.trunc(lines), pixel.y.trunc(lines)),
        ("count", Some(pixel)) => pixel.thin.mux(1, end - first),
        ("count", None) => end - first,
        ("leftward", _) => leftward,
        ("fresh", _) => fresh,
        ("fence", _) => fence,
        (same, _) => held[same].q(),
    });
    token.connect(queue.connect("in_valid", push).connect("out_ready", span_ready), "in", &fields);
    let span = Token::of_instance(queue, "out", fields);
    let span_valid = queue.output("out_valid");

    m.comment("While a triangle's first span is queued, or the held line may become it, EDGE must keep its increments.");
    let fresh_in_queue = queue.output("any_fresh").named("fresh_in_queue");
    let fresh_queued = fresh_in_queue | (line_held.q() & fresh);

    ports.take_ready(line_ready);
    ports.give(span_valid, |f| span[f]);
    ports.status("fresh_queued", fresh_queued);
    ports.status("line_held", line_held);
    m.finish()
}

/// The ends of a line from left to right, the one where its span ends cut to the screen.
struct Ends<'m> {
    /// First column.
    first: Signal<'m>,
    /// The column behind the last, but for the cut at the screen's right side.
    end: Signal<'m>,
    /// The right end is cut.
    beyond: Signal<'m>,
    /// No column lies between them.
    crossed: Signal<'m>,
    /// None of those there are is on the screen.
    outside: Signal<'m>,
    /// The span runs from its last column to its first.
    leftward: Signal<'m>,
}

/// Half-open spans from the major edge inwards, to the right or to the left.
fn ends_exact<'m>(m: &'m Module, width: Signal<'m>, line: &Token<'m>, thin: Option<Thin<'m>>) -> Ends<'m> {
    let (cmaj, cmin) = (line["cmaj"], line["cmin"]);
    m.comment("To the right from cmaj to before cmin, at most to the end of the screen; to the left to cmin, at least to column 0.");
    let right_of_screen =
        beyond(cmin, width).named_doc("right_of_screen", "no column of the screen lies right of cmin");
    let left_of_screen =
        before(cmin).named_doc("left_of_screen", "no column of the screen lies left of cmin");
    m.comment(
        "The edges' own columns say whether the span is empty, so no comparison waits for the clipped end.",
    );
    // The sign of a difference with room for it: nothing stands behind the carry.
    let wide = cmaj.width() + 1;
    let ordered = (cmaj.sext(wide) - cmin.sext(wide)).msb().named("ordered");
    let outside_right = (beyond(cmaj, width) | left_of_screen).named("outside_right");
    let outside_left = (before(cmaj) | right_of_screen).named("outside_left");
    let leftward = thin.map_or(line["major_right"], |thin| line["major_right"] & !thin.thin);
    let (first, end) =
        (leftward.mux(left_of_screen.mux(0, cmin), cmaj).named("first"), leftward.mux(cmaj, cmin));
    let beyond = (!leftward & right_of_screen).named("beyond");
    let crossed = leftward.mux(ordered | cmaj.eq(cmin), !ordered).named("crossed");
    let outside = leftward.mux(outside_left, outside_right).named("outside");
    Ends {
        first,
        end,
        beyond,
        crossed: thin.map_or(crossed, |thin| crossed & !thin.thin),
        outside: thin.map_or(outside, |thin| thin.thin.mux(thin.outside(cmaj, width), outside)),
        leftward,
    }
}

/// What a line that is offered is, in a machine whose port takes lines.
#[derive(Clone, Copy)]
struct Thin<'m> {
    /// A pixel of a line.
    thin: Signal<'m>,
    /// Of one with x and y exchanged.
    flat: Signal<'m>,
    /// H.
    height: Signal<'m>,
}

impl<'m> Thin<'m> {
    fn of(line: &Token<'m>, height: impl FnOnce() -> Signal<'m>) -> Option<Thin<'m>> {
        let (thin, flat) = (line.get("thin")?, line.get("flat")?);
        Some(Thin { thin, flat: (thin & flat).named("exchanged"), height: height() })
    }

    /// The pixel lies beside the screen.
    fn outside(self, column: Signal<'m>, width: Signal<'m>) -> Signal<'m> {
        column.msb() | column.ge(self.flat.mux(self.height, width))
    }
}

/// A pixel of a thin line as the line register holds it, with its y.
#[derive(Clone, Copy)]
struct HeldPixel<'m> {
    thin: Signal<'m>,
    flat: Signal<'m>,
    y: Signal<'m>,
}

/// The column is the screen's width or more. Without its sign the comparison is one carry.
fn beyond<'m>(column: Signal<'m>, width: Signal<'m>) -> Signal<'m> {
    !column.msb() & column.ge(width)
}

/// The column is 0 or less.
fn before(column: Signal<'_>) -> Signal<'_> {
    column.msb() | column.eq(0)
}

/// Spans with both ends, always to the right: a column stands one right of `Trunc(X)`.
fn ends_textbook<'m>(m: &'m Module, width: Signal<'m>, line: &Token<'m>) -> Ends<'m> {
    let (cmaj, cmin, major_right) = (line["cmaj"], line["cmin"], line["major_right"]);
    m.comment("From Trunc(X) of the left edge to Trunc(X) of the right edge, both drawn; a column register is Trunc(X) + 1.");
    let xe = major_right.mux(cmaj, cmin).named_doc("xe", "signed, first column after the line");
    let first = (major_right.mux(cmin, cmaj) - 1).named("first");
    let on_screen = xe.slt(width).named_doc("on_screen", "the span ends on the screen");
    let crossed = on_screen.mux(xe, width).sle(first).named("crossed");
    Ends {
        first,
        end: xe,
        beyond: !on_screen,
        crossed,
        outside: xe.sle(0).named("outside"),
        leftward: major_right,
    }
}
