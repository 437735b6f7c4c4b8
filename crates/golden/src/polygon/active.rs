//! The active edge table: the edges that cross a line, stepped from line to line without error.
//!
//! ```text
//!   x = column - remainder / (dy * pitch)      column = x rounded up to a pixel's centre, 0 <= remainder < dy * pitch
//!   next line: x + dx / dy                     its quotient to the column, its remainder from the remainder, one borrow
//! ```
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
    fn enter(edge: &'a Edge, line: i64) -> Self {
        let [up, down] = edge.weights(line);
        // Both products are below 2^60: the crossing in units of the grid, times dy, from the centre of pixel 0.
        let x = (edge.start[0] - edge.grid.centre(0)) * (up + down) + down * edge.dx();
        let unit = edge.dy() * edge.grid.pitch();
        let column = -(-x).div_euclid(unit);
        Self { edge, column, remainder: column * unit - x }
    }

    /// To the next line.
    fn step(&mut self) {
        let (dx, dy, pitch) = (self.edge.dx(), self.edge.dy(), self.edge.grid.pitch());
        self.column += dx.div_euclid(dy);
        self.remainder -= dx.rem_euclid(dy) * pitch;
        if self.remainder < 0 {
            self.remainder += dy * pitch;
            self.column += 1;
        }
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
    fn order(&self, other: &Self) -> Ordering {
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
    /// Edges whose first lines lie before `lines` enter where they cross the first of those.
    pub fn scan(&self, lines: Range<i64>, mut visit: impl FnMut(i64, &[ActiveEdge])) {
        let mut waiting = self.edges().iter().peekable();
        let mut active: Vec<ActiveEdge> = Vec::new();
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
                if edge.lines().contains(&line) {
                    active.push(ActiveEdge::enter(edge, line));
                }
            }
            active.sort_by(ActiveEdge::order);
            if !active.is_empty() {
                visit(line, &active);
            }
            line += 1;
            // Ymax is not counted: an edge leaves before its last line is filled.
            active.retain(|crossing| crossing.edge.lines().contains(&line));
            active.iter_mut().for_each(ActiveEdge::step);
        }
    }

    /// The edges that cross one line, from left to right.
    pub(super) fn crossing(&self, line: i64) -> Vec<ActiveEdge<'_>> {
        let mut active: Vec<_> = self
            .edges()
            .iter()
            .filter(|edge| edge.lines().contains(&line))
            .map(|edge| ActiveEdge::enter(edge, line))
            .collect();
        active.sort_by(ActiveEdge::order);
        active
    }
}
