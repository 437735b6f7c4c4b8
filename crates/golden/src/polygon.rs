//! Scan conversion of polygons: edge table, active edge table, odd-even rule (the slides).
//!
//! ```text
//!            F                       edge table       every edge that is not horizontal, in the bucket of its Ymin
//!           / `-.                    active edges     those that cross this line, in the order of x
//!   -------a-----b---E--c---D-----   spans            a to b, c to d: pixels with an odd number of edges on their left
//!          |      `-/  `-.  |        next line        x again, from the ends of each edge
//!          A              `-C
//! ```
//! Ymin is counted, Ymax is not; the start of a span is rounded up and so is its end, which is no longer in it. That is
//! the half-open rule of [`crate::fragments`] in both axes, so that polygons and triangles meet without a gap or a pixel
//! drawn twice. Vertices are snapped to the [`Grid`] first.
//!
//! A value runs linearly along an edge, then linearly along the span (the slides):
//! ```text
//!   l_a = (l_1 (y_2 - y) + l_2 (y - y_1)) / (y_2 - y_1)      l_b likewise on the right edge
//!   l_p = (l_a (x_b - x) + l_b (x - x_a)) / (x_b - x_a)
//! ```
//! Cleared of fractions these are four integer weights. In a triangle that is the plane; elsewhere it depends on how the
//! polygon is turned (the orientation dependence of the slides). It is what the method gives, not an error of this program.

mod grid;
mod table;
mod active;
mod span;

pub use active::ActiveEdge;
pub use grid::Grid;
pub use span::Span;
pub use table::{Edge, EdgeTable};

use crate::fragment::Fragment;
use std::ops::Range;

/// A pixel of a polygon: what the ends of the left and of the right edge weigh there.
pub type PolygonFragment<'a> = Fragment<'a, 4, i128>;

/// Calls `draw` for every pixel of the polygon in `table` on a screen of `width` by `height` pixels, line by line.
pub fn fragments(table: &EdgeTable, (width, height): (u32, u32), draw: impl FnMut(&PolygonFragment)) {
    fragments_of_lines(table, width, 0..height, draw);
}

/// Like `fragments`, for some lines of the screen.
pub(crate) fn fragments_of_lines(
    table: &EdgeTable,
    width: u32,
    lines: Range<u32>,
    mut draw: impl FnMut(&PolygonFragment),
) {
    table.scan(i64::from(lines.start)..i64::from(lines.end), |line, active| {
        for pair in active.chunks_exact(2) {
            let span = Span::new(pair[0], pair[1], line);
            for x in span.columns(width) {
                draw(&span.fragment(x));
            }
        }
    });
}
