//! The listing of ch. 7.5 to the letter: what the book's program draws.
//!
//! ```text
//! Y_1        1          first half:   lines Y_1 ..= Y_2, between the edges 1-2 and 1-3
//!           / \
//! Y_2      2   \        second half:  lines Y_2 ..= Y_3, between the edges 2-3 and 1-3
//!            `. \
//! Y_3           `3      a half without height draws nothing
//! ```
//! On a line, pixels Trunc(X_start + 1/2) ..= Trunc(X_end + 1/2), where X_start is on the left edge. The first one has
//! the value of the left edge at that line, each further one delta i_X more: the plane at X_start, X_start + 1, ...
//! Both ends are drawn, and both halves draw the line Y_2: shared pixels come twice. The listing adds 1/2 to values
//! before it truncates them; here they are what they are before that. The mirror image of the listing, with vertex 2 on
//! the right, starts at the edge 1-3.
//!
//! Units: whole pixels, pixel X at the coordinate X as in the book (elsewhere its centre is at X + 1/2). Coordinates are
//! at most 10^6 either way, so twice the area is at most 4*10^12 and, times the height of an edge, a weight at most
//! 8*10^18 (and 10^13 more outside the triangle): below 2^63.

use crate::cover::{shaded, snap};
use crate::fragment::Fragment;
use edgewalk_scene::{ShadeMode, Triangle, Vertex};
use std::ops::Range;

/// A part of a triangle between two edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Half {
    /// From vertex 1 to the knee, Y_1 ..= Y_2: the listing as printed.
    First,
    /// From the knee to vertex 3, Y_2 ..= Y_3.
    Second,
}

/// Calls `draw` for every pixel the listing writes on a screen of `width` by `height` pixels, in its order.
///
/// Vertices are first rounded to whole pixels, half to even. A triangle without area has no pixels.
pub fn half_triangles(
    triangle: &Triangle,
    mode: ShadeMode,
    (width, height): (u32, u32),
    draw: impl FnMut(Half, &Fragment),
) {
    half_triangles_of_lines(triangle, mode, width, 0..height, draw);
}

/// Like `half_triangles`, for some lines of the screen.
pub(crate) fn half_triangles_of_lines(
    triangle: &Triangle,
    mode: ShadeMode,
    width: u32,
    lines: Range<u32>,
    mut draw: impl FnMut(Half, &Fragment),
) {
    let Some(walk) = Walk::new(triangle, mode) else { return };
    for half in [Half::First, Half::Second] {
        let Some(sides) = walk.sides(half) else { continue };
        for y in sides.top.max(i64::from(lines.start))..=sides.bottom.min(i64::from(lines.end) - 1) {
            let (start, end) = (sides.left.pixel(y), sides.right.pixel(y));
            for x in start.max(0)..=end.min(i64::from(width) - 1) {
                draw(half, &walk.value(&sides.left, x as u32, y as u32));
            }
        }
    }
}

/// A triangle that has an area.
pub(crate) struct Walk {
    vertices: [Vertex; 3],
    /// Of `vertices`, whole pixels.
    points: [[i64; 2]; 3],
    /// The points with Y_1 <= Y_2 <= Y_3.
    sorted: [[i64; 2]; 3],
    /// Sign of the area.
    winding: i64,
}

impl Walk {
    /// `None` if the rounded triangle has no area.
    pub(crate) fn new(triangle: &Triangle, mode: ShadeMode) -> Option<Self> {
        let points = triangle.0.map(|v| [snap(v.x, 0), snap(v.y, 0)]);
        let winding = cross(points[0], points[1], points[2]).signum();
        let mut sorted = points;
        sorted.sort_by_key(|point| point[1]);
        (winding != 0).then_some(Self { vertices: shaded(triangle, mode), points, sorted, winding })
    }

    /// What bounds a half; `None` if it has no height.
    fn sides(&self, half: Half) -> Option<Sides> {
        let [one, two, three] = self.sorted;
        let minor = match half {
            Half::First => Edge { top: one, bottom: two },
            Half::Second => Edge { top: two, bottom: three },
        };
        let major = Edge { top: one, bottom: three };
        let (top, bottom) = (minor.top[1], minor.bottom[1]);
        let knee_is_left = cross(one, three, two) > 0;
        let (left, right) = if knee_is_left { (minor, major) } else { (major, minor) };
        (top < bottom).then_some(Sides { left, right, top, bottom })
    }

    /// The values at a pixel the listing writes. On the line Y_2 both halves agree.
    pub(crate) fn fragment(&self, x: u32, y: u32) -> Option<Fragment<'_>> {
        let halves = [Half::First, Half::Second].into_iter().filter_map(|half| self.sides(half));
        let mut here = halves.filter(|sides| (sides.top..=sides.bottom).contains(&i64::from(y)));
        here.next().map(|sides| self.value(&sides.left, x, y))
    }

    /// The value of the left edge at line y, and delta i_X for each pixel from the first one to x.
    fn value(&self, left: &Edge, x: u32, y: u32) -> Fragment<'_> {
        let line = i64::from(y);
        let (start, height) = (left.crossing(line), left.height());
        let steps = i64::from(x) - left.pixel(line);
        // In units of 1/height of a pixel.
        let place = [start + steps * height, line * height];
        let weight = |from: usize, to: usize| {
            let [from, to] = [self.points[from], self.points[to]];
            let (dx, dy) = (place[0] - from[0] * height, place[1] - from[1] * height);
            self.winding * ((to[0] - from[0]) * dy - (to[1] - from[1]) * dx)
        };
        let weights = [weight(1, 2), weight(2, 0), weight(0, 1)];
        Fragment { x, y, vertices: &self.vertices, weights, total: weights.iter().sum() }
    }
}

/// What bounds a half that has a height.
struct Sides {
    left: Edge,
    right: Edge,
    /// First and last line.
    top: i64,
    bottom: i64,
}

/// An edge of such a half.
struct Edge {
    top: [i64; 2],
    bottom: [i64; 2],
}

impl Edge {
    fn height(&self) -> i64 {
        self.bottom[1] - self.top[1]
    }

    /// X at line y, times the height.
    fn crossing(&self, y: i64) -> i64 {
        self.top[0] * self.height() + (y - self.top[1]) * (self.bottom[0] - self.top[0])
    }

    /// Trunc(X + 1/2).
    fn pixel(&self, y: i64) -> i64 {
        (2 * self.crossing(y) + self.height()).div_euclid(2 * self.height())
    }
}

/// Twice the area, positive if `a`, `b`, `c` run clockwise on the screen (y down).
fn cross(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
