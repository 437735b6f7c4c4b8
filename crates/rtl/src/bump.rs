//! BUMP: turns the normal of a fragment by the slopes of a relief.

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{bump::SPEC, tokens};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::cut::cut;
use crate::ports::Interface;
use crate::wires::{Part, Registers, Token, moved, parts};

const DOC: &str = "BUMP turns the normal of a fragment by the slopes of a relief.

  frag ─> [K1: bu * u, bv * v of each cosine] ─> [K2: cosine + both] ─> bumped

Formats: bu, bv signed, 2^(bits-1) for the relief's largest slope; cosines and their u and v signed, of one unit. Sums are exact; a
cosine is cut where its bits end.
Timing: a fragment a clock, offered two clocks after it was taken. All stages move together.
Rules: none; it keeps nothing from fragment to fragment.";

const SQUARE_DOC: &str = "With NORMAL behind: K1 has bu * bu, bu * bv, bv * bv too, K2 their products with tuu, tuv and tvv, and K3 the sum of
these with nn, N.N of the turned normal, 2^16 for 1.0; a fragment is offered three clocks after it was taken.";

/// N.N, and what it is when the normal has turned.
const SQUARE: &str = "nn";
const SQUARES: [&str; 3] = ["tuu", "tuv", "tvv"];

/// The netlist of BUMP.
///
/// # Errors
/// None for a machine with BUMP that [`edgewalk_machine::Machine::plan`] accepts.
pub fn bump(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_bump", DOC);
    let normalises = plan.shade.normalises();
    if normalises {
        m.doc(SQUARE_DOC);
    }
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (frag_valid, frag) = ports.takes();
    let bumped_ready = ports.gives_ready();
    let slope_bits = plan.shade.slope_bits;

    m.comment("The stages, and what goes through them as it is.");
    let given = parts(&tokens::bumped(plan));
    let of_lights = &plan.terms()[..2 * plan.shade.lights as usize];
    let is_cosine = |part: &Part| of_lights.iter().any(|term| term.name == part.name);
    let (cosines, through): (Vec<Part>, Vec<Part>) = given.iter().cloned().partition(is_cosine);
    let squares = |part: &Part| SQUARES.contains(&part.name.as_str());
    let goes_in = |part: &Part| given.iter().any(|other| other.name == part.name) || squares(part);
    let mut lists = vec![frag.parts().into_iter().filter(goes_in).collect(), through.clone()];
    if normalises {
        lists.push(through.into_iter().filter(|part| part.name != SQUARE).collect());
    }
    let stages: Vec<(Reg<'_>, Registers<'_>)> = lists
        .into_iter()
        .zip(["k1", "k2", "k3"])
        .map(|(kept, name)| {
            let valid = m.reg(&format!("{name}_valid"), 1).doc("a fragment is in this stage").reset(0);
            (valid, Registers::new(&m, name, kept))
        })
        .collect();
    let last = stages[stages.len() - 1].0.q();
    let advance = (!last | bumped_ready).named_doc("advance", "all stages move on");
    let (mut valid, mut before) = (frag_valid, frag.clone());
    for (filled, kept) in &stages {
        filled.when(advance, valid);
        kept.load(advance, |f| before[f]);
        (valid, before) = (filled.q(), kept.token());
    }

    let occupied = stages.iter().map(|(valid, _)| valid.q()).reduce(|any, one| any | one).unwrap_or(last);

    m.comment("K1: products with the slopes.");
    let slopes = [("u", frag["bu"]), ("v", frag["bv"])];
    let products: Vec<[Signal<'_>; 2]> = cosines
        .iter()
        .map(|part| {
            slopes.map(|(way, slope)| {
                let name = format!("{}{way}", part.name);
                moved(&m, advance, &format!("k1_{name}"), "slope * growth", frag[name.as_str()].smul(slope))
            })
        })
        .collect();
    let pairs =
        [("uu", 0, 0), ("uv", 0, 1), ("vv", 1, 1)].map(|(name, i, j)| (name, slopes[i].1, slopes[j].1));
    let of_slopes = normalises.then(|| {
        pairs
            .map(|(name, a, b)| moved(&m, advance, &format!("k1_{name}"), "product of two slopes", a.smul(b)))
    });

    m.comment("K2: the cosines of the turned normal.");
    let k1 = stages[0].1.token();
    let one = slope_bits - 1;
    let mut sums: Vec<Signal<'_>> = Vec::new();
    for (part, [along_u, along_v]) in cosines.iter().zip(products) {
        let cosine = k1[part.name.as_str()];
        // Three numbers below 2^(b + bits - 2) in magnitude.
        let width = cosine.width() + slope_bits + 1;
        let half = if normalises { 1 << (slope_bits - 2) } else { 0 };
        let scaled = m.cat(&[cosine.sext(width - one), m.lit(one, half)]);
        let sum = scaled + along_u.sext(width) + along_v.sext(width);
        let doc = if normalises { "exact, with the half that rounds it" } else { "exact" };
        let sum = sum.named_doc(&format!("sum_{}", part.name), doc);
        let turned = sum.slice(width - 1, one + plan.shade.cosine_fraction());
        let turned = turned.named(&format!("turned_{}", part.name));
        let turned = cut(&m, &part.name, turned, part.width);
        sums.push(moved(&m, advance, &format!("k2_{}", part.name), &part.doc, turned));
    }

    let mut square = None;
    if let Some(of_slopes) = of_slopes {
        let growths: Vec<Signal<'_>> = SQUARES
            .into_iter()
            .zip(of_slopes)
            .map(|(name, slopes)| {
                moved(&m, advance, &format!("k2_{name}"), "growth of nn", k1[name].smul(slopes))
            })
            .collect();

        m.comment("K3: N.N of the turned normal.");
        for (part, sum) in cosines.iter().zip(&mut sums) {
            *sum = moved(&m, advance, &format!("k3_{}", part.name), &part.doc, *sum);
        }
        let nn = stages[1].1.token()[SQUARE];
        // Four numbers of at most 2^(2 * bits + 15) in magnitude.
        let width = nn.width() + 2 * slope_bits + 1;
        let scaled = m.cat(&[nn.sext(width - 2 * one), m.lit(2 * one, 0)]);
        let sum = growths.into_iter().fold(scaled, |sum, growth| sum + growth.sext(width));
        let turned = sum.named_doc("sum_nn", "exact").slice(width - 1, 2 * one).named("turned_nn");
        square = Some(moved(&m, advance, "k3_nn", "2^16 for 1.0", cut(&m, SQUARE, turned, nn.width())));
    }

    ports.take_ready(advance);
    let kept: Token<'_> = before;
    ports.give(last, |f| match cosines.iter().position(|part| part.name == f) {
        Some(place) => sums[place],
        None => square.filter(|_| f == SQUARE).unwrap_or_else(|| kept[f]),
    });
    ports.status("occupied", occupied);
    m.finish()
}
