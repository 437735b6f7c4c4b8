//! What each unit declares, a file a unit, in the order the data flows.

pub mod tokens;
pub mod setup;
pub mod edge;
pub mod span;
pub mod term;
pub mod pixel;
pub mod texel;
pub mod bump;
pub mod normal;
pub mod lamp;
pub mod shade;
pub mod project;
pub mod shadow;
pub mod depth;
pub mod blend;
pub mod memory;

use crate::activity::Activity;
use crate::field::Field;
use crate::link::Status;
use crate::unit::{Event, UnitSpec, always};

/// Every unit, in the order the data flows.
pub const UNITS: &[&UnitSpec] = &[
    &setup::SPEC,
    &edge::SPEC,
    &span::SPEC,
    &term::SPEC,
    &pixel::SPEC,
    &texel::SPEC,
    &bump::SPEC,
    &normal::SPEC,
    &lamp::SPEC,
    &shade::SPEC,
    &project::SPEC,
    &shadow::SPEC,
    &depth::SPEC,
    &blend::SPEC,
];

/// What can happen between units.
pub const EVENTS: &[Event] =
    &[Event { name: "setup_overlap", doc: "triangles taken in while PIXEL draws", can_happen: always }];

/// What the machine tells beside its tokens, in every cycle.
pub(crate) fn machine_status() -> Vec<Status> {
    let cause = Field::count("activity", Activity::BITS, "the cause of the cycle");
    vec![Status { field: cause, during: None }, Status::new("idle", "nothing to do")]
}
