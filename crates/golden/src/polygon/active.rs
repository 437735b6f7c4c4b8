//! The active edge table: the edges that cross a line, from left to right.
//!
//! ```text
//!   x = column - remainder / (dy * pitch)      column = x rounded up to a pixel's centre, 0 <= remainder < dy * pitch
//! ```
//! The lecture adds 1/m to each x on the way to the next line. Here x is divided out on every line from the ends of the edge, which
//! is the same number: a walk by quotient and remainder is the machine's way, and no second opinion on it.
//!
//! dy < 2^30 and pitch <= 2^9, so remainders are below 2^39.

use super::table::{Edge, EdgeTable};
use std::cmp::Ordering;
use std::ops::Range;

/// An edge where it crosses a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ActiveEdge<'a> {
    edge: &'a Edge,
    column: i64,
    remainder: i64,
}

impl<'a> ActiveEdge<'a> {
    /// Where an edge crosses one of its lines.
    pub(crate) fn on(edge: &'a Edge, line: i64) -> Self {
        let [up, down] = edge.weights(line);
        // Both products are below 2^60: the crossing in units of the grid, times dy, from the centre of pixel 0.
        let x = (edge.start[0] - edge.grid.centre(0)) * (up + down) + down * edge.dx();
        let unit = edge.dy() * edge.grid.pitch();
        let column = -(-x).div_euclid(unit);
        Self { edge, column, remainder: column * unit - x }
    }

    /// The edge.
    pub fn edge(&self) -> &'a Edge {
        self.edge
    }

    /// The first pixel whose centre is not left of the edge.
    pub fn column(&self) -> i64 {
        self.column
    }

    /// The distance from here to the centre of a pixel, times dy, units of the grid: below 2^61 on the screen.
    pub(super) fn distance(&self, pixel: i64) -> i64 {
        (pixel - self.column) * self.edge.dy() * self.edge.grid.pitch() + self.remainder
    }

    /// x of the crossing, pixels.
    pub fn x(&self) -> f64 {
        let grid = self.edge.grid;
        grid.pixels(grid.centre(self.column)) - grid.pixels(self.remainder) / self.edge.dy() as f64
    }

    /// From left to right, exact; edges that cross the line in one point in the order of the table.
    pub(crate) fn order(&self, other: &Self) -> Ordering {
        // A larger remainder is farther left. Remainders are divided by dy, so each is multiplied with the other's.
        let left = |a: &Self, b: &Self| i128::from(a.remainder) * i128::from(b.edge.dy());
        self.column
            .cmp(&other.column)
            .then_with(|| left(other, self).cmp(&left(self, other)))
            .then(self.edge.place.cmp(&other.edge.place))
    }
}

impl EdgeTable {
    /// The lecture's algorithm: calls `visit` with each of `lines` that edges cross, and these edges from left to right.
    ///
    /// Edges whose first lines lie before `lines` enter on the first of those.
    pub fn scan(&self, lines: Range<i64>, mut visit: impl FnMut(i64, &[ActiveEdge])) {
        let mut waiting = self.edges().iter().peekable();
        let mut active: Vec<&Edge> = Vec::new();
        let mut line = lines.start;
        loop {
            if active.is_empty() {
                let Some(next) = waiting.peek() else { return };
                line = line.max(next.lines().start);
            }
            if line >= lines.end {
                return;
            }
            while let Some(edge) = waiting.next_if(|edge| edge.lines().start <= line) {
                active.push(edge);
            }
            // Ymax is not counted: an edge leaves before its last line is filled.
            active.retain(|edge| edge.lines().contains(&line));
            let crossings = from_left(active.iter().copied(), line);
            if !crossings.is_empty() {
                visit(line, &crossings);
            }
            line += 1;
        }
    }

    /// The edges that cross one line, from left to right.
    pub(super) fn crossing(&self, line: i64) -> Vec<ActiveEdge<'_>> {
        from_left(self.edges().iter().filter(|edge| edge.lines().contains(&line)), line)
    }
}

/// Edges that cross a line, in the order of their crossings.
fn from_left<'a>(edges: impl Iterator<Item = &'a Edge>, line: i64) -> Vec<ActiveEdge<'a>> {
    let mut crossings: Vec<_> = edges.map(|edge| ActiveEdge::on(edge, line)).collect();
    crossings.sort_by(ActiveEdge::order);
    crossings
}
