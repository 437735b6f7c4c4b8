//! Which line of which triangle EDGE walks.

use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

use crate::wires::Token;

/// The handshakes of EDGE, as far as the walk reads them.
pub(super) struct Links<'m> {
    /// A triangle is offered.
    pub prim_valid: Signal<'m>,
    /// The line is accepted.
    pub line_ready: Signal<'m>,
    /// PIXEL has not loaded the increments of the triangle before.
    pub fresh_queued: Signal<'m>,
}

/// What the walk does in a clock.
pub(super) struct Walk<'m> {
    /// A line is offered.
    pub running: Signal<'m>,
    pub prim_ready: Signal<'m>,
    /// A triangle is accepted.
    pub load: Signal<'m>,
    /// A line is accepted.
    pub step: Signal<'m>,
    /// No triangle is being walked, and none that has been walked stays at the port.
    pub idle: Signal<'m>,
    /// The triangle at the port has been walked, and stays till PIXEL has its increments; none where it does not stay.
    pub walked: Option<Signal<'m>>,
    /// No triangle is being walked, and the next one is offered.
    pub offered: Signal<'m>,
    /// The registers of the line take a new value: the next line, or the first of a triangle that is offered.
    pub moves: Signal<'m>,
    /// The line lies in the upper part of the triangle.
    pub upper: Signal<'m>,
    /// The minor edge is replaced, and does not step.
    pub exchanges: Signal<'m>,
    /// `moves`, but not from the knee line of textbook fill to its second drawing.
    pub line_done: Signal<'m>,
}

impl<'m> Walk<'m> {
    /// The registers of the walk.
    pub fn new(m: &'m Module, plan: &Plan, links: &Links<'m>, prim: &Token<'m>) -> Walk<'m> {
        let Links { prim_valid, line_ready, .. } = *links;
        let start = if plan.is_sequenced() { Start::staying(m, links) } else { Start::moving(m, links) };
        let Start { running, last, prim_ready, load, step, idle, walked } = start;
        let offered = match walked {
            Some(_) => load,
            None => (idle & prim_valid).named_doc("offered", "the next triangle is there"),
        };
        let goes_on = if walked.is_some() { step } else { line_ready };
        let moves = idle.mux(prim_valid, goes_on).named("moves");

        m.comment("Where in the triangle: the upper part, then the lower.");
        let n1 = m.reg("n1", prim["n1"].width()).doc("lines left of the upper part");
        let n2 = m.reg("n2", prim["n2"].width()).doc("lines left of the lower part");
        let exchanges =
            m.reg("exchanges", 1).doc("idle, or at the knee: the minor edge is loaded, not stepped").reset(1);
        let parts = Parts { of_line: [n1, n2].map(Reg::q), of_prim: [prim["n1"], prim["n2"]] };
        let Place { upper, first_knee, next_knee } = Place::new(m, last, &parts, idle, moves);
        exchanges.when(moves, idle.mux(!load | first_knee, last.q() | next_knee));
        let exchanges = exchanges.q();
        n1.when(offered, prim["n1"]).when(step & upper, n1.q() - 1);
        n2.when(offered, prim["n2"]).when(step & !upper, n2.q() - 1);

        // The knee line of textbook fill is drawn twice: as the last of the upper and as the first of the
        // lower part.
        let line_done = match plan.fill {
            Fill::Exact => moves,
            Fill::Textbook => idle.mux(prim_valid, goes_on & !exchanges).named("line_done"),
        };
        Walk { running, prim_ready, load, step, idle, walked, offered, moves, upper, exchanges, line_done }
    }
}

/// When a triangle begins, and when the next one may come.
struct Start<'m> {
    running: Signal<'m>,
    last: Reg<'m>,
    prim_ready: Signal<'m>,
    load: Signal<'m>,
    step: Signal<'m>,
    idle: Signal<'m>,
    walked: Option<Signal<'m>>,
}

impl<'m> Start<'m> {
    /// A triangle moves in, and its registers are EDGE's.
    fn moving(m: &'m Module, links: &Links<'m>) -> Start<'m> {
        let Links { prim_valid, line_ready, fresh_queued } = *links;
        m.comment("A triangle is taken when the one before is walked and PIXEL has its increments.");
        let running = m.reg("running", 1).reset(0);
        let last = m.reg("last", 1).doc("last line of all");
        let prim_ready = (!running.q() & !fresh_queued).named("prim_ready");
        let load = (prim_valid & prim_ready).named("load");
        let step = (running.q() & line_ready).named("step");
        m.comment("While EDGE is idle the registers load the offered triangle in every clock. So their enable does not wait for fresh_queued.");
        let idle = m.reg("idle", 1).doc("not running; selects what the registers load").reset(1);
        let at_end = (step & last.q()).named("at_end");
        running.when(at_end, 0).when(load, 1);
        idle.when(at_end, 1).when(load, 0);
        Start { running: running.q(), last, prim_ready, load, step, idle: idle.q(), walked: None }
    }

    /// A triangle stays at the port while it is walked: SETUP keeps what does not step.
    fn staying(m: &'m Module, links: &Links<'m>) -> Start<'m> {
        let Links { prim_valid, line_ready, fresh_queued } = *links;
        m.comment("A triangle begins while it is offered, and is taken when it is walked and PIXEL has its increments.");
        let running = m.reg("running", 1).reset(0);
        let last = m.reg("last", 1).doc("last line of all");
        let step = (running.q() & line_ready).named("step");
        let at_end = (step & last.q()).named("at_end");
        let walked = m.reg("walked", 1).doc("the triangle is walked, and not taken yet").reset(0);
        let idle = m.reg("idle", 1).doc("neither running nor walked").reset(1);
        let prim_ready = (walked.q() & !fresh_queued).named("prim_ready");
        let load = (idle.q() & prim_valid).named("load");
        running.when(at_end, 0).when(load, 1);
        walked.when(at_end, 1).when(prim_ready, 0);
        idle.when(load, 0).when(prim_ready, 1);
        let walked = Some(walked.q());
        Start { running: running.q(), last, prim_ready, load, step, idle: idle.q(), walked }
    }
}

/// Lines of the upper and of the lower part of a triangle.
struct Parts<'m> {
    /// Of the triangle that is walked, from the line on.
    of_line: [Signal<'m>; 2],
    /// Of the triangle that is offered.
    of_prim: [Signal<'m>; 2],
}

/// Where in the triangle the line is, in registers: what follows looks at them in every step.
struct Place<'m> {
    upper: Signal<'m>,
    /// The line is the last of the upper part and the lower follows: of a triangle's first, and of the next
    /// one.
    first_knee: Signal<'m>,
    next_knee: Signal<'m>,
}

impl<'m> Place<'m> {
    fn new(
        m: &'m Module,
        last: Reg<'m>,
        parts: &Parts<'m>,
        idle: Signal<'m>,
        moves: Signal<'m>,
    ) -> Place<'m> {
        let upper = m.reg("upper", 1).doc("in the upper part");
        let [n1, n2] = parts.of_line;
        let some_lower = n2.any().named("some_lower");
        let (two, one) = (n1.eq(2).named("two_upper"), n1.eq(1).named("one_upper"));
        let next_last = upper.q().mux((two & !some_lower) | (one & n2.eq(1)), n2.eq(2)).named("next_last");
        let [n1, n2] = parts.of_prim;
        let (first_some_lower, first_one) =
            (n2.any().named("lower_follows"), n1.eq(1).named("one_upper_only"));
        let first_last = n1.any().mux(first_one & !first_some_lower, n2.eq(1)).named("first_last");
        upper.when(moves, idle.mux(n1.any(), upper.q() & !one));
        let first_knee = (first_one & first_some_lower).named("first_knee");
        let next_knee = (two & some_lower).named("next_knee");
        last.when(moves, idle.mux(first_last, next_last));
        Place { upper: upper.q(), first_knee, next_knee }
    }
}
