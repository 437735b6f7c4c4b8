//! MACHINE: all units, joined as they declare it.

mod joined;

mod activity;
mod picture;

use std::sync::Arc;

use edgewalk_machine::{Activity, Plan, UnitSpec};
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::ports::Interface;
use crate::units::{Build, builder};
use joined::{Joined, Unit};

/// The netlist of the whole machine.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn machine(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    assemble(plan, &units(plan))
}

/// The netlist of the units that draw, all but SETUP, joined as in the machine: it takes primitives. It does not tell the
/// cause of a cycle, which is SETUP's too.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn engine(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let units: Vec<_> = units(plan).into_iter().filter(|(unit, _)| unit.name != "setup").collect();
    let m = Module::new("edgewalk_engine", "The units that draw, without SETUP.");
    let units = place(&m, plan, built(plan, &units)?);
    units.connect_inputs();
    units.join();
    units.connect_outputs();
    m.finish()
}

fn units(plan: &Plan) -> Vec<(&'static UnitSpec, Build)> {
    let build = |unit: &UnitSpec| builder(unit.name).expect("a test finds a builder for every declared unit");
    plan.units().map(|unit| (unit, build(unit))).collect()
}

/// Builds these units and joins them, as [`join`].
///
/// # Errors
/// Those of the units, and inputs of theirs that nothing drives.
pub fn assemble(plan: &Plan, units: &[(&UnitSpec, Build)]) -> Result<Arc<Netlist>, BuildErrors> {
    join(plan, built(plan, units)?)
}

/// Joins these units, in the order the data flows, as their declarations say: a link to the link of the next unit, held values,
/// levels and status by their names. What is not joined is a port of the machine.
///
/// # Errors
/// Inputs of the units that nothing drives.
pub fn join(plan: &Plan, units: Vec<(&UnitSpec, Arc<Netlist>)>) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk", &doc(plan, &units));
    let units = place(&m, plan, units);
    units.connect_inputs();
    units.join();

    m.comment("Cause of the cycle.");
    let activity = activity::activity(&m, &units).named("activity");

    units.connect_outputs();
    let status = Interface::new(&m, plan.ports());
    status.status("activity", activity);
    status.status("idle", activity.eq(Activity::Idle as i32));
    m.finish()
}

fn built<'u>(
    plan: &Plan,
    units: &[(&'u UnitSpec, Build)],
) -> Result<Vec<(&'u UnitSpec, Arc<Netlist>)>, BuildErrors> {
    units.iter().map(|(unit, build)| Ok((*unit, build(plan)?))).collect()
}

fn place<'m>(m: &'m Module, plan: &Plan, units: Vec<(&UnitSpec, Arc<Netlist>)>) -> Joined<'m> {
    let placed = units.into_iter().map(|(unit, netlist)| {
        let instance = m.instance(&format!("u_{}", unit.name), &netlist);
        Unit { outside: Interface::new(m, (unit.ports)(plan)), instance }
    });
    Joined(placed.collect())
}

fn doc(plan: &Plan, units: &[(&UnitSpec, Arc<Netlist>)]) -> String {
    let ports: Vec<_> = units.iter().map(|(unit, _)| (unit.name, (unit.ports)(plan))).collect();
    let drawn = if plan.polygon.is_there() { "triangles and polygons" } else { "triangles" };
    format!(
        "EDGEWALK draws {drawn}, scan line by scan line.

{}

A link ─> has valid and ready: a token moves in a cycle where both are high. valid never waits for ready.
A value drawn without valid is held until its reader has loaded it. One clock; rst is synchronous, active high.
activity is the single cause of the cycle: {}.
{}",
        picture::picture(&ports),
        Activity::codes(plan),
        Activity::of_pixel(plan)
    )
}
