//! What the whole machine shows beside the ports of its units.

use crate::activity::Activity;
use crate::field::Field;
use crate::link::Status;
use crate::unit::{always, events};

/// Outputs that mean something in every cycle.
pub(crate) fn status() -> Vec<Status> {
    let cause = Field::count("activity", Activity::BITS, "cause of the cycle");
    vec![
        Status { field: cause, during: None },
        Status::new("idle", "no triangle, fragment or write is inside"),
    ]
}

events! {
    setup_overlap = "triangles taken while PIXEL draws" if always;
}
