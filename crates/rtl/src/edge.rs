//! EDGE: walks the two edges of a triangle, a line a step.

use std::sync::Arc;

use edgewalk_machine::units::{edge::SPEC, tokens};
use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::ports::Interface;
use crate::wires::{Part, Registers, parts};

const DOC: &str = "EDGE walks the major and the minor edge of a triangle, a line a step.

  prim ─> [major C R-f q f M] ── cmaj ─────┐
          [minor C R-f q f M] ── cmin ─────┼─> line
          [a value a channel] ─ by carry ──┘
          [g of each channel] ───────────────> inc, held for PIXEL

Timing: the first line is valid in the cycle after the triangle was taken, then one line a clock while line_ready.
Rules: a step takes f from R; where R is too small M is added back and the column goes one further (carry).
R - f is what is kept, so that its sign says whether the step carries, and no step waits for a subtraction to know it.
The columns are not cut to the screen here: SPAN does that.";

/// The netlist of EDGE.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn edge(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_edge", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (prim_valid, prim) = ports.takes();
    let line_ready = ports.gives_ready();
    let fresh_queued = ports.level("fresh_queued");

    m.comment("A triangle is taken when the one before is walked and PIXEL has its increments.");
    let running = m.reg("running", 1).reset(0);
    let last = m.reg("last", 1).doc("last line of all");
    let prim_ready = (!running.q() & !fresh_queued).named("prim_ready");
    let load = (prim_valid & prim_ready).named("load");
    let step = (running.q() & line_ready).named("step");
    m.comment("Between triangles everything takes the next one as soon as it is there, and again till PIXEL has the increments: no enable waits for that.");
    let idle = m.reg("idle", 1).doc("not running: for what is loaded, as running is for the values").reset(1);
    let at_end = (step & last.q()).named("at_end");
    running.when(at_end, 0).when(load, 1);
    idle.when(at_end, 1).when(load, 0);
    let idle = idle.q();
    let offered = (idle & prim_valid).named_doc("offered", "the next triangle is there");
    let moves = idle.mux(prim_valid, line_ready).named("moves");

    m.comment("Where in the triangle: the upper part, then the lower.");
    let n1 = m.reg("n1", prim["n1"].width()).doc("lines left of the upper part");
    let n2 = m.reg("n2", prim["n2"].width()).doc("lines left of the lower part");
    let exchanges =
        m.reg("exchanges", 1).doc("idle, or at the knee: another minor edge comes, and no step").reset(1);
    let Place { upper, first_knee, next_knee } =
        Place::new(&m, last, [n1, n2], [prim["n1"], prim["n2"]], idle, moves);
    exchanges.when(moves, idle.mux(!load | first_knee, last.q() | next_knee));
    let exchanges = exchanges.q();
    n1.when(offered, prim["n1"]).when(step & upper, n1.q() - 1);
    n2.when(offered, prim["n2"]).when(step & !upper, n2.q() - 1);

    // The knee line of textbook fill is drawn twice: as the last of the upper and as the first of the lower part.
    let line_done = match plan.fill {
        Fill::Exact => moves,
        Fill::Textbook => idle.mux(prim_valid, line_ready & !exchanges).named("line_done"),
    };
    let elsewhere = match plan.fill {
        Fill::Exact => ["cmaj", "cmin", "fence"].as_slice(),
        Fill::Textbook => &["cmaj", "cmin"],
    };
    let mut own = parts(&tokens::line(plan));
    own.retain(|f| !elsewhere.contains(&f.name.as_str()));
    let line = Registers::new(&m, "line", own);
    line["y"].when(line_done, idle.mux(prim["jm"], line["y"].q() + 1));
    line["major_right"].when(offered, prim["major_right"]);
    line["fresh"].when(moves, idle);
    if let Some(fence) = line.get("fence") {
        fence.when(moves, exchanges);
    }
    if let (Some(register), Some(tag)) = (line.get("tag"), prim.get("tag")) {
        register.when(offered, tag);
    }

    m.comment("The major edge.");
    let edges = parts_of_edge(&prim.parts());
    let first = |edge: &str, f: &str| prim[format!("{edge}_{f}").as_str()];
    let major = Edge::new(&m, "major", &edges);
    let (rest, column) = major.next(&m);
    let rest = idle.mux(major.first_rest(|f| first("major", f)), rest).named("major_next");
    major.rest.when(line_done, rest);
    // Beside the sign of R - f, as it chooses in all values; the reset is what tells the two apart.
    let carry = m.reg("carry", 1).doc("the major edge carries in its next step").reset(0);
    carry.when(line_done, rest.msb());
    major.own["c"].when(line_done, idle.mux(first("major", "c"), column));
    major.keep(offered, |f| first("major", f));

    m.comment("The minor edge, and the one that takes its place at the knee.");
    let second = Edge::new(&m, "second", &edges);
    let second_rest = second.first_rest(|f| first("minor2", f)).named("minor2_rest");
    second.rest.when(offered, second_rest);
    second.own["c"].when(offered, first("minor2", "c"));
    second.keep(offered, |f| first("minor2", f));
    let minor = Edge::new(&m, "minor", &edges);
    let (rest, column) = minor.next(&m);
    let has_upper = prim["n1"].any().named("has_upper");
    let minor1_rest = minor.first_rest(|f| first("minor1", f)).named("minor1_rest");
    let enters = |f: &str| has_upper.mux(first("minor1", f), first("minor2", f));
    let first_rest = has_upper.mux(minor1_rest, second_rest);
    minor.rest.when(moves, exchanges.mux(idle.mux(first_rest, second.rest.q()), rest));
    minor.own["c"].when(moves, exchanges.mux(idle.mux(enters("c"), second.own["c"].q()), column));
    let exchanged = (exchanges & moves).named("exchanged");
    minor.keep(exchanged, |f| idle.mux(enters(f), second.own[f].q()));

    m.comment("The channels at the start of the span, their steps, and the increments for PIXEL.");
    let increments = Registers::new(&m, "inc", parts(&tokens::held_by_edge(plan)));
    for name in ["kt", "record"] {
        if let (Some(register), Some(value)) = (increments.get(name), prim.get(name)) {
            register.when(load, value);
        }
    }
    if plan.fill == Fill::Exact {
        m.comment("Between triangles what is added is the start: it needs no choice behind the adder.");
    }
    for channel in plan.channels().iter().map(|channel| channel.name) {
        let of_prim = |result: &str| prim[format!("{channel}_{result}").as_str()];
        let held = |result: &str| {
            let register = m.reg(&format!("{channel}_{result}"), of_prim(result).width());
            register.doc("as in the triangle").when(offered, of_prim(result)).q()
        };
        let value = line[channel];
        increments[channel].when(load, of_prim("g"));
        match plan.fill {
            Fill::Exact => {
                let (d0, d1) = (held("d0"), held("d1"));
                let added = idle.mux(of_prim("start"), carry.q().mux(d1, d0));
                let added = added.named(&format!("{channel}_added"));
                value.when(moves, running.q().mux(value.q() + added, added));
            }
            Fill::Textbook => {
                let (d_a, start_b, d_b) = (held("d_a"), held("start_b"), held("d_b"));
                let at_knee = step & exchanges;
                value
                    .when(line_done, value.q() + upper.mux(d_a, d_b))
                    // Where the left edge is the major one, the knee line begins where it did.
                    .when(at_knee & line["major_right"].q(), start_b)
                    .when(offered, has_upper.mux(of_prim("start_a"), of_prim("start_b")));
            }
        }
    }

    ports.take_ready(prim_ready);
    ports.give(running, |f| match f {
        "cmaj" => major.own["c"].q(),
        "cmin" => minor.own["c"].q(),
        // In exact fill only another triangle can hold the same pixel.
        "fence" => line.get("fence").unwrap_or(line["fresh"]).q(),
        own => line[own].q(),
    });
    ports.hold("inc", |f| increments[f].q());
    m.finish()
}

/// What a prim has of each edge: the parts of its first minor one, without that one's name.
fn parts_of_edge(prim: &[Part]) -> Vec<Part> {
    let of_edge = |part: &Part| {
        part.name.strip_prefix("minor1_").map(|name| Part { name: name.to_owned(), ..part.clone() })
    };
    prim.iter().filter_map(of_edge).collect()
}

/// An edge as it is walked.
struct Edge<'m> {
    name: &'m str,
    /// R - f; below 0 the step carries.
    rest: Reg<'m>,
    carry: Signal<'m>,
    /// All but R.
    own: Registers<'m>,
}

impl<'m> Edge<'m> {
    fn new(m: &'m Module, name: &'m str, edge: &[Part]) -> Edge<'m> {
        let own = edge.iter().filter(|part| part.name != "r").cloned().collect();
        let own = Registers::new(m, name, own);
        let bits = own["f"].q().width() + 1;
        let rest = m.reg(&format!("{name}_rest"), bits).doc("R - f, signed: below 0 the step carries");
        Edge { name, rest, carry: rest.q().msb(), own }
    }

    /// R - f and the column of an edge a line further.
    fn next(&self, m: &'m Module) -> (Signal<'m>, Signal<'m>) {
        let Edge { name, rest, carry, own } = self;
        let bits = rest.q().width();
        let f = own["f"].q().zext(bits);
        let rest = match own.get("m") {
            // f first: that sum waits for nothing, and M only for the carry.
            Some(modulus) => {
                let less = (rest.q() - f).named(&format!("{name}_less"));
                let back = carry.mux(modulus.q().zext(bits), m.lit(bits, 0)).named(&format!("{name}_back"));
                less + back
            }
            // The modulus is 2^F, and R wraps by itself.
            None => rest.q().trunc(bits - 1).zext(bits) - f,
        };
        let (c, q) = (own["c"].q(), own["q"].q());
        (rest, c + q + carry.zext(c.width()))
    }

    /// R - f of an edge with these parts at its first line.
    fn first_rest(&self, of_prim: impl Fn(&str) -> Signal<'m>) -> Signal<'m> {
        let bits = self.rest.q().width();
        of_prim("r").zext(bits) - of_prim("f").zext(bits)
    }

    /// What does not step.
    fn keep(&self, when: Signal<'m>, value: impl Fn(&str) -> Signal<'m>) {
        for part in self.own.token().parts().iter().filter(|part| part.name != "c") {
            self.own[part.name.as_str()].when(when, value(&part.name));
        }
    }
}

/// Where in the triangle the line is, in registers: what follows looks at them in every step.
struct Place<'m> {
    upper: Signal<'m>,
    /// The line is the last of the upper part and the lower follows: of a triangle's first, and of the next one.
    first_knee: Signal<'m>,
    next_knee: Signal<'m>,
}

impl<'m> Place<'m> {
    fn new(
        m: &'m Module,
        last: Reg<'m>,
        left: [Reg<'m>; 2],
        of_prim: [Signal<'m>; 2],
        idle: Signal<'m>,
        moves: Signal<'m>,
    ) -> Place<'m> {
        let upper = m.reg("upper", 1).doc("in the upper part");
        let [n1, n2] = left.map(Reg::q);
        let some_lower = n2.any().named("some_lower");
        let (two, one) = (n1.eq(2).named("two_upper"), n1.eq(1).named("one_upper"));
        let next_last = upper.q().mux((two & !some_lower) | (one & n2.eq(1)), n2.eq(2)).named("next_last");
        let [n1, n2] = of_prim;
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
