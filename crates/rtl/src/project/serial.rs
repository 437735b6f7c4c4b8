//! One fragment after the other, a row of each number a clock.

use edgewalk_machine::{LIGHT_SPACE, Plan};
use edgewalk_netlist::Module;

use super::row::Row;
use super::{DIVIDED, give, kept, rows};
use crate::ports::Interface;
use crate::wires::Registers;

const DOC: &str = "Serial: one fragment after the other, a row of x, y and z a clock.

Timing: a fragment takes one clock a row, and one more. The next fragment is taken when this one leaves.";

/// The netlist's inside.
pub(super) fn build<'m>(m: &'m Module, plan: &Plan, ports: &Interface<'m>) {
    m.doc(DOC);
    let (frag_valid, frag) = ports.takes();
    let projected_ready = ports.gives_ready();
    let (last, bits) = (plan.shadow.rows(), plan.shadow.light_bits);

    m.comment("Row counter.");
    let busy = m.reg("busy", 1).doc("the unit holds a fragment").reset(0);
    let row = m.reg("row", last.ilog2() + 1).doc("rows already done");
    let done = row.q().eq(last as i32).named("done");
    let projected_valid = (busy.q() & done).named("projected_valid");
    let dividing = (busy.q() & !done).named("dividing");
    let goes = (projected_valid & projected_ready).named("goes");
    let frag_ready = (!busy.q() | goes).named("frag_ready");
    let take = (frag_valid & frag_ready).named("take");
    busy.when(goes, 0).when(take, 1);
    row.when(dividing, row.q() + 1).when(take, 0);

    let kept = kept(plan, &frag);
    let fragment = Registers::new(m, "kept", kept.parts());
    fragment.load(take, |f| kept[f]);

    m.comment("Restoring division, a row a clock.");
    let [x, y, z, w] = LIGHT_SPACE.map(|name| frag[name].trunc(bits));
    let divisor = m.reg("w", bits).doc("divisor").when(take, w).q();
    let mut numbers = DIVIDED.into_iter().zip([x, y, z]).zip(rows(plan)).map(|((name, number), rows)| {
        let rest = m.reg(name, bits).doc("rest");
        let quotient = m.reg(&format!("{name}_quotient"), rows).doc("quotient bits so far, from the low end");
        let step = Row::new(&format!("{name}_less"), rest.q(), divisor);
        // A number of fewer rows than the longest stands still when it is done.
        let works = if rows == last { dividing } else { dividing & row.q().lt(rows as i32) };
        let works = works.named(&format!("{name}_works"));
        rest.when(works, step.rest()).when(take, number);
        let places = step.behind(Some(quotient.q()));
        quotient.when(works, places.trunc(rows));
        quotient.q()
    });
    let quotients = std::array::from_fn(|_| numbers.next().expect("three are divided"));

    ports.take_ready(frag_ready);
    give(plan, ports, projected_valid, &fragment.token(), quotients);
    ports.status("dividing", dividing);
    ports.status("occupied", busy.q());
}
