//! A stage a row: a fragment a clock.

use edgewalk_machine::{LIGHT_SPACE, Plan};
use edgewalk_netlist::{Module, Signal};

use super::beside::beside;
use super::row::Row;
use super::{DIVIDED, give, kept, rows};
use crate::ports::Interface;

const DOC: &str = "Pipelined: a stage a row, x, y and z side by side.

  frag ─┬─> [stage 0] ─ row ─> [stage 1] ─ row ─> ... ─> [last stage] ─┬─> projected
        └─> [ring of the rest] ────────────────────────────────────────┘

Timing: a fragment a clock. All stages advance together.";

/// The netlist's inside.
pub(super) fn build<'m>(m: &'m Module, plan: &Plan, ports: &Interface<'m>) {
    m.doc(DOC);
    let (frag_valid, frag) = ports.takes();
    let projected_ready = ports.gives_ready();
    let (last, bits) = (plan.shadow.rows(), plan.shadow.light_bits);

    m.comment("Stages.");
    let valid = m.reg("valid", last + 1).doc("bit i: stage i holds a fragment").reset(0);
    let projected_valid = valid.q().msb().named("projected_valid");
    let advance = (!projected_valid | projected_ready).named_doc("advance", "all stages advance");
    valid.when(advance, m.cat(&[valid.q().trunc(last), frag_valid]));

    let kept = kept(plan, &frag);
    let kept = beside(m, last + 1, advance, &kept);

    let moved = |name: &str, doc: &str, value: Signal<'m>| {
        m.reg(name, value.width()).doc(doc).when(advance, value).q()
    };
    m.comment("Stage 0: dividends and divisor.");
    let [x, y, z, w] = LIGHT_SPACE.map(|name| frag[name].trunc(bits));
    let mut divisor = moved("w0", "divisor", w);
    let mut numbers = [x, y, z].map(|number| (number, None));
    for (name, (rest, _)) in DIVIDED.into_iter().zip(&mut numbers) {
        *rest = moved(&format!("{name}0"), "dividend", *rest);
    }
    for stage in 1..=last {
        m.comment(&format!("Stage {stage}."));
        for ((name, rows), (rest, quotient)) in DIVIDED.into_iter().zip(rows(plan)).zip(&mut numbers) {
            let (name_of_quotient, doc) = (format!("{name}{stage}_quotient"), "quotient bits so far");
            if stage > rows {
                *quotient = quotient.map(|done| moved(&name_of_quotient, "the quotient", done));
                continue;
            }
            let row = Row::new(&format!("{name}{stage}_less"), *rest, divisor);
            *quotient = Some(moved(&name_of_quotient, doc, row.behind(*quotient)));
            if stage < rows {
                *rest = moved(&format!("{name}{stage}"), "rest", row.rest());
            }
        }
        if stage < last {
            divisor = moved(&format!("w{stage}"), "divisor", divisor);
        }
    }

    let quotients = numbers.map(|(_, quotient)| quotient.expect("each has a row at least"));
    ports.take_ready(advance);
    give(plan, ports, projected_valid, &kept, quotients);
    ports.status("occupied", valid.q().any());
}
