//! NORMAL: divides the products of a fragment's normal by the normal's length.

mod cosine;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{normal::SPEC, tokens};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::ports::Interface;
use crate::roots::Roots;
use crate::wires::{Part, Registers, moved, parts};
use cosine::cosine;

const DOC: &str = "NORMAL divides the products of a fragment's normal by the normal's length.

  frag ─> [N1: N.N cut] ─> [N2: entry of R] ─> [N3: slope * low] ─> [N4: y, the root] ─> [N5: product * y] ─> normed
                 roots memory ─ rdata ─┘

Formats: pl*, ph*, nn signed, 2^16 for 1.0; of nn what lies from 1/4 to below 1 counts. R holds {v, slope}, 2^-16: 1/sqrt(k/256), and
how much less it is one entry on. nl*, nh* signed, in entries of SHADE's tables; what is beyond their bits is the last that they say.
Timing: a fragment a clock, offered five clocks after it was taken. All stages move together.
Rules: R is fetched once after a reset, when the first fragment comes, a word a clock; until then none is taken.";

/// What the stages are called.
const STAGES: [&str; 5] = ["n1", "n2", "n3", "n4", "n5"];

/// The netlist of NORMAL.
///
/// # Errors
/// None for a machine with NORMAL that [`edgewalk_machine::Machine::plan`] accepts.
pub fn normal(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_normal", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (frag_valid, frag) = ports.takes();
    let memory = ports.memory("roots");
    let normed_ready = ports.gives_ready();

    m.comment(
        "The stages, and what goes through them as it is: products and gloss as far as they are multiplied.",
    );
    let cosines = parts(&tokens::cosines(plan));
    let through = |part: &Part| part.name != "nn";
    let with_products: Vec<Part> = frag.parts().into_iter().filter(through).collect();
    let without: Vec<Part> = cosines.iter().filter(|part| frag.get(&part.name).is_some()).cloned().collect();
    let stages = STAGES.map(|name| {
        let kept = if name == "n5" { &without } else { &with_products };
        let valid = m.reg(&format!("{name}_valid"), 1).doc("a fragment is in this stage").reset(0);
        Stage { valid, kept: Registers::new(&m, name, kept.clone()) }
    });
    let last = stages[4].valid.q();
    let advance = (!last | normed_ready).named_doc("advance", "all stages move on");
    let occupied = stages.iter().map(|stage| stage.valid.q()).reduce(|any, one| any | one);
    let occupied = occupied.expect("there are five stages");

    let roots = Roots::new(&m, plan, "table R", frag_valid, &memory);
    let frag_ready = (advance & roots.have).named("frag_ready");
    let take = (frag_valid & frag_ready).named("take");
    let (mut valid, mut before) = (take, frag.clone());
    for Stage { valid: filled, kept } in &stages {
        filled.when(advance, valid);
        kept.load(advance, |f| before[f]);
        (valid, before) = (filled.q(), kept.token());
    }
    m.comment("N1: N.N from 1/4 to below 1.");
    let nn = frag["nn"];
    let (sign, whole) = (nn.msb(), nn.slice(nn.width() - 2, 16).any());
    let short = (sign | (!whole & !nn.slice(15, 14).any())).named_doc("short", "shorter than a half");
    let at_most = whole.mux(m.lit(16, 0xffff), nn.trunc(16));
    let n1_s = moved(&m, advance, "n1_s", "N.N, 2^-16", short.mux(m.lit(16, 1 << 14), at_most));

    m.comment("N2: the entry, and how far N.N lies beyond it.");
    let entry = roots.read(advance, n1_s.slice(15, 8));
    let low = moved(&m, advance, "n2_low", "2^-16", n1_s.trunc(8));

    m.comment("N3: how much less the root is there.");
    let (v, slope) = (entry.slice(26, 10), entry.slice(9, 0));
    let n3_v = moved(&m, advance, "n3_v", "of the entry, 2^-16", v);
    let less = moved(&m, advance, "n3_less", "2^-24", slope * low);

    m.comment("N4: the root.");
    let rounded = (less + m.lit(18, 1 << 7)).slice(17, 8).named_doc("rounded", "2^-16");
    let y = moved(&m, advance, "n4_y", "1/sqrt(N.N), 2^-16", n3_v - rounded.zext(17));

    m.comment("N5: the cosines, and where they stand in SHADE's tables.");
    let n4 = stages[3].kept.token();
    let cosines: Vec<(String, Signal<'_>)> = cosines
        .iter()
        .filter(|part| frag.get(&part.name).is_none())
        .map(|part| {
            let gloss = part.name.starts_with("nh").then(|| n4["gloss"]);
            let product = n4[part.name.replacen('n', "p", 1).as_str()];
            let index = cosine(&m, plan, part, product, y, gloss);
            (part.name.clone(), moved(&m, advance, &format!("n5_{}", part.name), &part.doc, index))
        })
        .collect();

    ports.take_ready(frag_ready);
    ports.read("roots", roots.read_valid, roots.read_place, roots.loading);
    ports.give(last, |f| match cosines.iter().find(|(name, _)| name == f) {
        Some((_, index)) => *index,
        None => before[f],
    });
    ports.status("table_wait", frag_valid & !roots.have);
    ports.status("occupied", occupied);
    m.finish()
}

/// A fragment on its way.
struct Stage<'m> {
    valid: Reg<'m>,
    kept: Registers<'m>,
}
