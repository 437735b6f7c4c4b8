//! NORMAL: divides the products of a fragment's normal by the normal's length.

mod cosine;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{normal::SPEC, tokens};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::ports::Interface;
use crate::roots::Roots;
use crate::wires::{Part, Registers, moved, parts};
use cosine::{cosine, product};

const DOC: &str = "NORMAL divides the products of a fragment's normal by the normal's length.

  frag ─> [N1: limit N.N] ─> [N2, N3: entry of R] ─> [N4: slope * low] ─> [N5: y, the root]
       ─> [N6: product * y] ─> [N7: cosine, entry] ─> normed
                 roots memory ─ rdata ─┘

Formats: pl*, ph* and nn are signed, 2^16 for 1.0; nn is limited to [1/4, 1). R holds {v, slope}, 2^-16: v is 1/sqrt(k/256),
slope the decrease to the next entry. nl* and nh* are signed, in entries of SHADE's tables, saturated at the ends.
Timing: a fragment a clock, offered seven clocks after it was taken. All stages advance together.
Rules: R is fetched once after a reset, when the first fragment is offered, a word a clock. No fragment is taken before.";

/// What the stages are called.
const STAGES: [&str; 7] = ["n1", "n2", "n3", "n4", "n5", "n6", "n7"];

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

    m.comment("Stages, and the fields that pass through them until they are multiplied.");
    let cosines = parts(&tokens::cosines(plan));
    let through = |part: &Part| part.name != "nn";
    let with_products: Vec<Part> = frag.parts().into_iter().filter(through).collect();
    let is_kept = |part: &Part| cosines.iter().any(|kept| kept.name == part.name);
    let without: Vec<Part> = cosines.iter().filter(|part| frag.get(&part.name).is_some()).cloned().collect();
    let with_gloss: Vec<Part> =
        frag.parts().into_iter().filter(|part| is_kept(part) || part.name == "gloss").collect();
    let stages = STAGES.map(|name| {
        let kept = match name {
            "n6" => &with_gloss,
            "n7" => &without,
            _ => &with_products,
        };
        let valid = m.reg(&format!("{name}_valid"), 1).doc("the stage holds a fragment").reset(0);
        Stage { valid, kept: Registers::new(&m, name, kept.clone()) }
    });
    let last = stages[STAGES.len() - 1].valid.q();
    let advance = (!last | normed_ready).named_doc("advance", "all stages advance");
    let occupied = stages.iter().map(|stage| stage.valid.q()).reduce(|any, one| any | one);
    let occupied = occupied.expect("there are seven stages");

    let roots = Roots::new(&m, plan, "table R", frag_valid, &memory);
    let frag_ready = (advance & roots.have).named("frag_ready");
    let take = (frag_valid & frag_ready).named("take");
    let (mut valid, mut before) = (take, frag.clone());
    for Stage { valid: filled, kept } in &stages {
        filled.when(advance, valid);
        kept.load(advance, |f| before[f]);
        (valid, before) = (filled.q(), kept.token());
    }
    m.comment("N1: N.N, limited to [1/4, 1).");
    let nn = frag["nn"];
    let (sign, whole) = (nn.msb(), nn.slice(nn.width() - 2, 16).any());
    let short =
        (sign | (!whole & !nn.slice(15, 14).any())).named_doc("short", "length below 1/2: N.N counts as 1/4");
    let at_most = whole.mux(m.lit(16, 0xffff), nn.trunc(16));
    let n1_s = moved(&m, advance, "n1_s", "N.N, 2^-16", short.mux(m.lit(16, 1 << 14), at_most));

    m.comment("N2: entry of the table, and distance of N.N beyond it.");
    let entry = roots.read(advance, n1_s.slice(15, 8));
    let low = moved(&m, advance, "n2_low", "2^-16", n1_s.trunc(8));

    m.comment("N3: the entry, in registers behind the memory.");
    let n3_v = moved(&m, advance, "n3_v", "root at the entry, 2^-16", entry.slice(26, 10));
    let slope = moved(&m, advance, "n3_slope", "2^-16", entry.slice(9, 0));
    let low = moved(&m, advance, "n3_low", "2^-16", low);

    m.comment("N4: correction of the root.");
    let n4_v = moved(&m, advance, "n4_v", "root at the entry, 2^-16", n3_v);
    let less = moved(&m, advance, "n4_less", "2^-24", slope * low);

    m.comment("N5: the root, 1/sqrt(N.N).");
    let rounded = (less + m.lit(18, 1 << 7)).slice(17, 8).named_doc("rounded", "2^-16");
    let y = moved(&m, advance, "n5_y", "1/sqrt(N.N), 2^-16", n4_v - rounded.zext(17));

    m.comment("N6: the products with the root, exact.");
    let (n5, n6) = (stages[4].kept.token(), stages[5].kept.token());
    let found: Vec<&Part> = cosines.iter().filter(|part| frag.get(&part.name).is_none()).collect();
    let products: Vec<Signal<'_>> = found
        .iter()
        .map(|part| {
            let name = part.name.replacen('n', "p", 1);
            moved(&m, advance, &format!("n6_{name}"), "times the root, 2^-32", product(n5[name.as_str()], y))
        })
        .collect();

    m.comment("N7: the cosines, and their entries in SHADE's tables.");
    let cosines: Vec<(String, Signal<'_>)> = found
        .iter()
        .zip(products)
        .map(|(part, product)| {
            let gloss = part.name.starts_with("nh").then(|| n6["gloss"]);
            let index = cosine(&m, plan, part, product, gloss);
            (part.name.clone(), moved(&m, advance, &format!("n7_{}", part.name), &part.doc, index))
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
