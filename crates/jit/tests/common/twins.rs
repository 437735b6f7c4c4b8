//! Registers that are equal in every clock, those that only look so, and those that follow from either.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist};

/// Registers that are one: those of a pair `NAME0`, `NAME1` for each name.
pub const EQUAL: [&str; 4] = ["step", "again", "late", "changes"];
/// Pairs of registers that are not: they begin, change or follow otherwise.
pub const OTHER: [&str; 6] = ["reset", "free", "value", "when", "turned", "after"];

pub fn module() -> Arc<Netlist> {
    let m = Module::new("twins", "");
    let (data, other, go) = (m.input("data", 8), m.input("other", 8), m.input("go", 1));
    for i in 0..2 {
        let name = |name: &str| format!("{name}{i}");
        // Each of the two follows from itself: they are equal if they are taken to be.
        let step = m.reg(&name("step"), 8).reset(3).when(go, data).q();
        let again = m.reg(&name("again"), 8);
        again.set(go.mux(step, again.q() + 1));
        let late = m.reg(&name("late"), 8).set(again.q() ^ step).q();
        let changes = m.reg(&name("changes"), 8).when(go, late).when(late.bit(0), data);
        m.output(&name("sum"), changes.q() + late);

        m.reg(&name("reset"), 8).reset([0, 1][i]).when(go, data);
        let free = m.reg(&name("free"), 8);
        let free = if i == 0 { free.reset(0) } else { free };
        free.when(go, data);
        m.reg(&name("value"), 8).when(go, [data, other][i]);
        m.reg(&name("when"), 8).when([go, !go][i], data);
        let turned = m.reg(&name("turned"), 8).set([data - other, other - data][i]).q();
        m.reg(&name("after"), 8).when(go, turned);
    }
    m.finish().unwrap()
}
