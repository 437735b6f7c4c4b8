//! EDGE: walks the two edges of a triangle, a line a step.

use std::sync::Arc;

use edgewalk_machine::units::{edge::SPEC, tokens};
use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::ports::Interface;
use crate::wires::{Part, Registers, parts};

const DOC: &str = "EDGE walks the major and the minor edge of a triangle, a line a step.

  prim ─> [major C R q f M] ── cmaj ───────┐
          [minor C R q f M] ── cmin ───────┼─> line
          [a value a channel] ─ by carry ──┘
          [g of each channel] ───────────────> inc, held for PIXEL

Timing: the first line is valid in the cycle after the triangle was taken, then one line a clock while line_ready.
Rules: a step takes f from R; where R is too small M is added back and the column goes one further (carry).
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
    let prim_ready = (!running.q() & !fresh_queued).named("prim_ready");
    let load = (prim_valid & prim_ready).named("load");
    let step = (running.q() & line_ready).named("step");

    m.comment("Where in the triangle: the upper part, then the lower.");
    let n1 = m.reg("n1", prim["n1"].width()).doc("lines left of the upper part");
    let n2 = m.reg("n2", prim["n2"].width()).doc("lines left of the lower part");
    let place = Place::new(&m, [n1, n2], [prim["n1"], prim["n2"]], load, step);
    let Place { upper, knee, last } = place;
    n1.when(load, prim["n1"]).when(step & upper, n1.q() - 1);
    n2.when(load, prim["n2"]).when(step & !upper, n2.q() - 1);
    running.when(step & last, 0).when(load, 1);

    let (at_knee, along) = ((step & knee).named("at_knee"), (step & !knee).named("along"));
    let line_done = match plan.fill {
        Fill::Exact => step,
        // The knee line is drawn twice: as the last of the upper and as the first of the lower part.
        Fill::Textbook => along,
    };
    let elsewhere = match plan.fill {
        Fill::Exact => ["cmaj", "cmin", "fence"].as_slice(),
        Fill::Textbook => &["cmaj", "cmin"],
    };
    let mut own = parts(&tokens::line(plan));
    own.retain(|f| !elsewhere.contains(&f.name.as_str()));
    let line = Registers::new(&m, "line", own);
    line["y"].when(load, prim["jm"]).when(line_done, line["y"].q() + 1);
    line["major_right"].when(load, prim["major_right"]);
    line["fresh"].when(load, 1).when(step, 0);
    if let Some(fence) = line.get("fence") {
        fence.when(load, 1).when(step, knee);
    }
    if let (Some(register), Some(tag)) = (line.get("tag"), prim.get("tag")) {
        register.when(load, tag);
    }

    m.comment("The major edge.");
    let edge = parts_of_edge(&prim.parts());
    let major = Registers::new(&m, "major", edge.clone());
    let of_prim = |f: &str| prim[format!("major_{f}").as_str()];
    // The values step by whether the edge carries. So its R is one line ahead, and the carry stands in a register.
    let (first_carry, first_r) = less(of_prim("r"), of_prim("f"), prim.get("major_m"), "first");
    let (next_carry, next_r) = less(major["r"].q(), major["f"].q(), major.get("m").map(Reg::q), "major");
    let carry =
        m.reg("carry", 1).doc("the major edge carries in its next step; 0 between triangles").reset(0);
    carry.when(line_done, next_carry).when(step & last, 0).when(load, first_carry);
    major["r"].when(line_done, next_r);
    take_columns(&major, line_done, carry.q());
    major.load(load, |f| if f == "r" { first_r } else { of_prim(f) });
    let carry = carry.q();

    m.comment("The minor edge, and the one that takes its place at the knee.");
    let second = Registers::new(&m, "second", edge.clone());
    second.load(load, |f| prim[format!("minor2_{f}").as_str()]);
    let minor = Registers::new(&m, "minor", edge);
    let (minor_carry, minor_r) = less(minor["r"].q(), minor["f"].q(), minor.get("m").map(Reg::q), "minor");
    minor["r"].when(along, minor_r);
    take_columns(&minor, along, minor_carry);
    minor.load(at_knee, |f| second[f].q());
    let has_upper = prim["n1"].any().named("has_upper");
    minor.load(load, |f| {
        has_upper.mux(prim[format!("minor1_{f}").as_str()], prim[format!("minor2_{f}").as_str()])
    });

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
            register.doc("as in the triangle").when(load, of_prim(result)).q()
        };
        let value = line[channel];
        increments[channel].when(load, of_prim("g"));
        match plan.fill {
            Fill::Exact => {
                let (d0, d1) = (held("d0"), held("d1"));
                let added =
                    carry.mux(d1, running.q().mux(d0, of_prim("start"))).named(&format!("{channel}_added"));
                value.when(step | load, running.q().mux(value.q() + added, added));
            }
            Fill::Textbook => {
                let (d_a, start_b, d_b) = (held("d_a"), held("start_b"), held("d_b"));
                value
                    .when(along, value.q() + upper.mux(d_a, d_b))
                    // Where the left edge is the major one, the knee line begins where it did.
                    .when(at_knee & line["major_right"].q(), start_b)
                    .when(load, has_upper.mux(of_prim("start_a"), of_prim("start_b")));
            }
        }
    }

    ports.take_ready(prim_ready);
    ports.give(running, |f| match f {
        "cmaj" => major["c"].q(),
        "cmin" => minor["c"].q(),
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

/// R of an edge a line further, and whether the step carries.
fn less<'m>(
    r: Signal<'m>,
    f: Signal<'m>,
    modulus: Option<Signal<'m>>,
    name: &str,
) -> (Signal<'m>, Signal<'m>) {
    let bits = r.width();
    let less = (r.zext(bits + 1) - f.zext(bits + 1)).named(&format!("{name}_less"));
    let carry = less.msb().named(&format!("{name}_carry"));
    let less = less.trunc(bits);
    // Without a register for it the modulus is 2^F, and R wraps by itself.
    (carry, modulus.map_or(less, |modulus| carry.mux(less + modulus, less)))
}

/// The column of an edge a line further.
fn take_columns<'m>(edge: &Registers<'m>, when: Signal<'m>, carry: Signal<'m>) {
    let (c, q) = (edge["c"].q(), edge["q"].q());
    edge["c"].when(when, c + q + carry.zext(c.width()));
}

/// Where in the triangle the line is, in registers: what follows looks at them in every step.
struct Place<'m> {
    upper: Signal<'m>,
    knee: Signal<'m>,
    last: Signal<'m>,
}

impl<'m> Place<'m> {
    fn new(
        m: &'m Module,
        left: [Reg<'m>; 2],
        of_prim: [Signal<'m>; 2],
        load: Signal<'m>,
        step: Signal<'m>,
    ) -> Place<'m> {
        let [n1, n2] = left.map(Reg::q);
        let upper = m.reg("upper", 1).doc("in the upper part");
        let knee = m.reg("knee", 1).doc("last line of the upper part, the lower follows");
        let last = m.reg("last", 1).doc("last line of all");
        let some_lower = n2.any().named("some_lower");
        let (two, one) = (n1.eq(2).named("two_upper"), n1.eq(1).named("one_upper"));
        upper.when(step, upper.q() & !one);
        knee.when(step, two & some_lower);
        last.when(step, upper.q().mux((two & !some_lower) | (one & n2.eq(1)), n2.eq(2)));
        let [n1, n2] = of_prim;
        let (some_lower, one) = (n2.any().named("lower_follows"), n1.eq(1).named("one_upper_only"));
        upper.when(load, n1.any());
        knee.when(load, one & some_lower);
        last.when(load, n1.any().mux(one & !some_lower, n2.eq(1)));
        Place { upper: upper.q(), knee: knee.q(), last: last.q() }
    }
}
