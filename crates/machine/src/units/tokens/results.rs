//! What SETUP finds of a triangle, by name.

use crate::machine::Fill;
use crate::plan::Plan;

/// Names of the three edges of a prim: 0–2, 0–1 and 1–2 in the order of the sorted vertices.
pub const EDGES: [&str; 3] = ["major", "minor1", "minor2"];

/// The names of what SETUP finds for a channel, without the channel's own name, and what each is.
#[must_use]
pub fn results(plan: &Plan) -> &'static [(&'static str, &'static str)] {
    match plan.fill {
        _ if plan.polygon.is_there() => &[
            ("start", "value at pixel (start_x, start_y)"),
            ("d0", "step to the next line"),
            ("g", "step to the next pixel to the right"),
        ],
        Fill::Exact => &[
            ("start", "value at the first pixel of the first line"),
            ("d0", "step to the next line, edge without carry"),
            ("d1", "step to the next line, edge with carry"),
            ("g", "step to the next pixel of the span"),
        ],
        Fill::Textbook => &[
            ("start_a", "value on the left edge, first line of part 1"),
            ("d_a", "step to the next line, part 1"),
            ("start_b", "value on the left edge, first line of part 2"),
            ("d_b", "step to the next line, part 2"),
            ("g", "step to the next pixel of the span"),
        ],
    }
}
