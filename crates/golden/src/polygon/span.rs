//! A span: the pixels of a line between two edges, and their values.

use super::PolygonFragment;
use super::active::ActiveEdge;
use super::table::EdgeTable;
use crate::fragment::Fragment;
use edgewalk_scene::Vertex;
use std::ops::Range;

/// The pixels of a line from one active edge to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span<'a> {
    left: ActiveEdge<'a>,
    right: ActiveEdge<'a>,
    line: i64,
    /// At Ymin and Ymax of the left edge, then of the right one.
    vertices: [Vertex; 4],
}

impl<'a> Span<'a> {
    pub(crate) fn new(left: ActiveEdge<'a>, right: ActiveEdge<'a>, line: i64) -> Self {
        let [[a, b], [c, d]] = [left, right].map(|crossing| crossing.edge().values);
        Self { left, right, line, vertices: [a, b, c, d] }
    }

    /// The span that holds a pixel.
    pub(crate) fn over(table: &'a EdgeTable, x: u32, y: u32) -> Option<Self> {
        let crossings = table.crossing(i64::from(y));
        let mut pairs = crossings.chunks_exact(2).map(|pair| Self::new(pair[0], pair[1], i64::from(y)));
        pairs.find(|span| (span.left.column()..span.right.column()).contains(&i64::from(x)))
    }

    /// The span's pixels on a screen of this width; both ends are rounded up, and the last is not in it.
    pub(crate) fn columns(&self, width: u32) -> Range<u32> {
        let on_screen = |column: i64| column.clamp(0, i64::from(width)) as u32;
        on_screen(self.left.column())..on_screen(self.right.column())
    }

    /// The values at a pixel of the span.
    pub(crate) fn fragment(&self, x: u32) -> PolygonFragment<'_> {
        // x_b - x and x - x_a, times the heights of their edges; both below 2^61, and the weights of the ends below 2^30.
        let to_right = i128::from(-self.right.distance(i64::from(x)));
        let to_left = i128::from(self.left.distance(i64::from(x)));
        let [a, b] = self.left.edge().weights(self.line).map(|weight| i128::from(weight) * to_right);
        let [c, d] = self.right.edge().weights(self.line).map(|weight| i128::from(weight) * to_left);
        // The line is on the screen: `scan` and `over` see to that.
        let y = self.line as u32;
        Fragment { x, y, vertices: &self.vertices, weights: [a, b, c, d], total: a + b + c + d }
    }
}
