//! EDGE: walks the two edges of a triangle, a line a step.

use std::sync::Arc;

use edgewalk_machine::units::{edge::SPEC, tokens};
use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

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
    let upper = n1.q().any().named("upper");
    let knee =
        (n1.q().eq(1) & n2.q().any()).named_doc("knee", "last line of the upper part, the lower follows");
    let last = upper.mux(n1.q().eq(1) & !knee, n2.q().eq(1)).named_doc("last", "last line of all");
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
    let carry = take_step(&major, "major", line_done);
    major.load(load, |f| prim[format!("major_{f}").as_str()]);

    m.comment("The minor edge, and the one that takes its place at the knee.");
    let second = Registers::new(&m, "second", edge.clone());
    second.load(load, |f| prim[format!("minor2_{f}").as_str()]);
    let minor = Registers::new(&m, "minor", edge);
    take_step(&minor, "minor", along);
    minor.load(at_knee, |f| second[f].q());
    let has_upper = prim["n1"].any().named("has_upper");
    minor.load(load, |f| {
        has_upper.mux(prim[format!("minor1_{f}").as_str()], prim[format!("minor2_{f}").as_str()])
    });

    m.comment("The channels at the start of the span, their steps, and the increments for PIXEL.");
    let increments = Registers::new(&m, "inc", parts(&tokens::words(plan)));
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
                value.when(step, value.q() + carry.mux(d1, d0)).when(load, of_prim("start"));
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

/// One step of an edge; the returned carry says that the column goes one further.
fn take_step<'m>(edge: &Registers<'m>, name: &str, when: Signal<'m>) -> Signal<'m> {
    let (r, bits) = (edge["r"].q(), edge["r"].q().width());
    let less = (r.zext(bits + 1) - edge["f"].q().zext(bits + 1)).named(&format!("{name}_less"));
    let carry = less.msb().named(&format!("{name}_carry"));
    let less = less.trunc(bits);
    // Without a register for it the modulus is 2^F, and R wraps by itself.
    let wrapped = edge.get("m").map_or(less, |modulus| carry.mux(less + modulus, less));
    edge["r"].when(when, wrapped);
    let (c, q) = (edge["c"].q(), edge["q"].q());
    edge["c"].when(when, c + q + carry.zext(c.width()));
    carry
}
