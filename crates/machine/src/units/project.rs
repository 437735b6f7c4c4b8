//! PROJECT: from light-space values to their quotients.

use super::tokens;
use crate::link::{Link, Status};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::shadow::Project;
use crate::unit::{Ports, UnitSpec, events};

/// What PROJECT declares.
pub const SPEC: UnitSpec = UnitSpec {
    name: "project",
    purpose: "divides a fragment's place in the light's view by its weight",
    section: 15,
    present: there,
    // SHADOW names the light-space values of either light.
    wants: |_: &Machine| Vec::new(),
    ports,
    events: EVENTS,
};

fn there(plan: &Plan) -> bool {
    plan.shadow.projects()
}

fn pipelined(plan: &Plan) -> bool {
    there(plan) && plan.shadow.project == Project::Pipelined
}

fn serial(plan: &Plan) -> bool {
    there(plan) && plan.shadow.project == Project::Serial
}

/// A weight has room for a depth within half an LSB of the end, 1 - 1/w.
fn rounds_to_end(plan: &Plan) -> bool {
    there(plan) && plan.shadow.light_bits >= plan.shadow.depth_bits + 2
}

fn ports(plan: &Plan) -> Ports {
    let occupied = "the unit holds a fragment";
    let dividing =
        serial(plan).then(|| Status::new("dividing", "the division is not done; no fragment is taken"));
    Ports {
        takes: Some(Link::new("frag", tokens::tinted(plan))),
        gives: Some(Link::new("projected", tokens::projected(plan))),
        status: dividing.into_iter().chain([Status::new("occupied", occupied)]).collect(),
        ..Ports::default()
    }
}

events! {
    behind_light = "fragments behind the light, or beside it: w <= 0" if there;
    map_edge = "columns and lines on the far edge of the map: x or y is w" if there;
    texel_edge = "columns and lines on the edge of a texel" if there;
    depth_to_end = "depths before the map's end that are rounded to it" if rounds_to_end;
    project_stall = "cycles in which all stages stand still (pipelined)" if pipelined;
    project_wait = "cycles in which a fragment waits until another is divided (serial)" if serial;
}
