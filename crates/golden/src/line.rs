//! A line's pixels, by the rule of `docs/polygons.md`: one in each column whose centre lies from the first end to before the
//! other, or in each row of a steep one; the pixel whose centre is nearest to the line there, of two the left or upper one.
//!
//! ```text
//!    from ──•──.                 at the centre of each column an exact quotient, rounded once; the same whichever end
//!              ` ──•── to        comes first
//! ```
//! Units: those of [`Grid`], coordinates below 2^29, differences below 2^30, products below 2^61.

use crate::fragment::Fragment;
use crate::polygon::Grid;
use edgewalk_scene::{self as scene, ShadeMode, Vertex};
use std::ops::Range;

/// Calls `draw` for every pixel of a line on a screen of `width` by `height` pixels, its ends snapped to so many sub-pixel bits.
pub fn line_fragments(
    line: &scene::Line,
    mode: ShadeMode,
    subpixel_bits: u32,
    (width, height): (u32, u32),
    draw: impl FnMut(&Fragment<2>),
) {
    let line = Line::new(&line.ends, mode, Grid::subpixels(subpixel_bits));
    line.fragments_of_lines(width, 0..height, draw);
}

/// A line on the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    /// The one that comes first along the main axis, then the other; in flat mode both have the first one's colour.
    ends: [Vertex; 2],
    /// Along the main axis, then across it.
    from: [i64; 2],
    to: [i64; 2],
    /// The main axis is y.
    steep: bool,
    grid: Grid,
}

impl Line {
    /// The line between two ends.
    pub(crate) fn new(ends: &[Vertex; 2], mode: ShadeMode, grid: Grid) -> Self {
        let colored = match mode {
            ShadeMode::Gouraud => *ends,
            ShadeMode::Flat => ends.map(|end| end.colored_as(&ends[0])),
        };
        let [a, b] = ends.each_ref().map(|end| grid.place(end));
        let steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
        let turned = |[x, y]: [i64; 2]| if steep { [y, x] } else { [x, y] };
        let [a, b] = [a, b].map(turned);
        let backward = a[0] > b[0];
        let [from, to] = if backward { [b, a] } else { [a, b] };
        let ends = if backward { [colored[1], colored[0]] } else { colored };
        Self { ends, from, to, steep, grid }
    }

    /// Calls `draw` for each of its pixels on some lines of a screen of `width` columns.
    pub(crate) fn fragments_of_lines(
        &self,
        width: u32,
        lines: Range<u32>,
        mut draw: impl FnMut(&Fragment<2>),
    ) {
        let (columns, rows) = (0..i64::from(width), i64::from(lines.start)..i64::from(lines.end));
        let (along, across) = if self.steep { (rows, columns) } else { (columns, rows) };
        let first = self.grid.first_pixel(self.from[0]).max(along.start);
        let end = self.grid.first_pixel(self.to[0]).min(along.end);
        for pixel in first..end {
            let (other, fragment) = self.at(pixel);
            if across.contains(&other) {
                draw(&fragment);
            }
        }
    }

    /// The fragment at this place of the screen, if the line has one there.
    pub(crate) fn fragment(&self, x: u32, y: u32) -> Option<Fragment<'_, 2>> {
        let mut found = None;
        self.fragments_of_lines(x + 1, y..y + 1, |fragment| {
            if fragment.x == x {
                found = Some([fragment.x, fragment.y]);
            }
        });
        let [x, y] = found?;
        Some(self.at(if self.steep { y } else { x }.into()).1)
    }

    /// The pixel in this column, or row of a steep line: its place across, and what the ends weigh there.
    fn at(&self, pixel: i64) -> (i64, Fragment<'_, 2>) {
        let [length, wide] = [0, 1].map(|axis| self.to[axis] - self.from[axis]);
        let way = self.grid.centre(pixel) - self.from[0];
        // Rounded to the nearest centre, a tie down: the last pixel whose left side is before the line.
        let other = self.grid.pixel_before_quotient(self.from[1] * length + way * wide, length);
        let (x, y) = if self.steep { (other, pixel) } else { (pixel, other) };
        let weights = [length - way, way];
        (other, Fragment { x: x as u32, y: y as u32, vertices: &self.ends, weights, total: length })
    }
}
