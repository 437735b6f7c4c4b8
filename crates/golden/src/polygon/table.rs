//! The edge table: edges by the first line they cross.

use super::grid::Grid;
use edgewalk_scene::{Polygon, ShadeMode, Vertex};
use std::fmt;
use std::ops::Range;

/// The edges of a polygon that cross a line of pixels, in the order of their buckets: first line, then x, then 1/m.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeTable {
    edges: Vec<Edge>,
}

/// An edge from its end at Ymin to its end at Ymax.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    pub(super) grid: Grid,
    /// x and y at Ymin, units of the grid.
    pub(super) start: [i64; 2],
    /// x and y at Ymax.
    end: [i64; 2],
    /// The values at Ymin and at Ymax.
    pub(super) values: [Vertex; 2],
    /// The numbers of these vertices, counted through all contours.
    numbers: [usize; 2],
    /// Place in the table: the order of edges that meet in a point.
    pub(super) place: usize,
}

impl EdgeTable {
    /// The table of a polygon whose vertices are snapped to `grid`. Horizontal edges are left out, and with them all
    /// that pass between two lines of centres: they cross no line.
    pub fn new(polygon: &Polygon, mode: ShadeMode, grid: Grid) -> Self {
        let Some(first) = polygon.contours.iter().flatten().next().copied() else {
            return Self { edges: Vec::new() };
        };
        let shaded = |v: &Vertex| match mode {
            ShadeMode::Gouraud => *v,
            ShadeMode::Flat => v.colored_as(&first),
        };
        let mut edges = Vec::new();
        let mut number = 0;
        for contour in &polygon.contours {
            for (i, vertex) in contour.iter().enumerate() {
                let next = (i + 1) % contour.len();
                let mut ends = [(vertex, number + i), (&contour[next], number + next)]
                    .map(|(v, n)| (grid.place(v), v, n));
                ends.sort_by_key(|(place, ..)| place[1]);
                let [(start, ..), (end, ..)] = ends;
                let (values, numbers) = (ends.map(|(_, v, _)| shaded(v)), ends.map(|(.., n)| n));
                edges.push(Edge { grid, start, end, values, numbers, place: 0 });
            }
            number += contour.len();
        }
        edges.retain(|edge| !edge.lines().is_empty());
        edges.sort_by(|a, b| {
            let steeper = || (a.dx() * b.dy()).cmp(&(b.dx() * a.dy()));
            (a.lines().start, a.start[0]).cmp(&(b.lines().start, b.start[0])).then_with(steeper)
        });
        for (place, edge) in edges.iter_mut().enumerate() {
            edge.place = place;
        }
        Self { edges }
    }

    /// All edges.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The buckets that are not empty: the edges that enter on one line.
    pub fn buckets(&self) -> impl Iterator<Item = &[Edge]> {
        self.edges.chunk_by(|a, b| a.lines().start == b.lines().start)
    }
}

impl Edge {
    /// The lines it crosses: Ymin counted, Ymax not.
    pub fn lines(&self) -> Range<i64> {
        self.grid.first_pixel(self.start[1])..self.grid.first_pixel(self.end[1])
    }

    /// y of its upper end on the screen, pixels.
    pub fn y_min(&self) -> f64 {
        self.grid.pixels(self.start[1])
    }

    /// y of its lower end on the screen, pixels.
    pub fn y_max(&self) -> f64 {
        self.grid.pixels(self.end[1])
    }

    /// x at Ymin, pixels.
    pub fn x_at_y_min(&self) -> f64 {
        self.grid.pixels(self.start[0])
    }

    /// 1/m, pixels a line, as numerator and positive denominator, both in pixels and exact.
    pub fn inverse_slope(&self) -> [f64; 2] {
        [self.dx(), self.dy()].map(|distance| self.grid.pixels(distance))
    }

    /// Names of its ends at Ymin and Ymax: `A` to `Z` in the order of the vertices, then their numbers from 26.
    pub fn ends(&self) -> [String; 2] {
        self.numbers.map(|n| if n < 26 { char::from(b'A' + n as u8).to_string() } else { n.to_string() })
    }

    /// Below 2^30.
    pub(super) fn dx(&self) -> i64 {
        self.end[0] - self.start[0]
    }

    /// Below 2^30, positive in a table.
    pub(super) fn dy(&self) -> i64 {
        self.end[1] - self.start[1]
    }

    /// How much its ends weigh on a line it crosses: l_a = (values[0] w_0 + values[1] w_1) / (w_0 + w_1).
    pub(super) fn weights(&self, line: i64) -> [i64; 2] {
        let y = self.grid.centre(line);
        [self.end[1] - y, y - self.start[1]]
    }
}

/// As the lecture prints it: a bucket a paragraph.
impl fmt::Display for EdgeTable {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "bucket  edge       Ymin       Ymax  x at Ymin        1/m")?;
        for bucket in self.buckets() {
            for (k, edge) in bucket.iter().enumerate() {
                let line = if k == 0 { edge.lines().start.to_string() } else { String::new() };
                let [dx, dy] = edge.inverse_slope();
                let slope = if dx == 0.0 { "0".into() } else { format!("{dx}/{dy}") };
                let (ends, y) = (edge.ends().join("-"), [edge.y_min(), edge.y_max()]);
                writeln!(
                    f,
                    "{line:>6}  {ends:<6}{:>9}  {:>9}  {:>9}  {slope:>9}",
                    y[0],
                    y[1],
                    edge.x_at_y_min()
                )?;
            }
        }
        Ok(())
    }
}
