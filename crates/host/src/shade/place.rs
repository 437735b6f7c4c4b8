//! Where a triangle lies in pixels: the frame of its spans, its visible box, and the first pixel of its first line
//! (`docs/machine.md`, section 2, exact fill).

use edgewalk_machine::{Plan, PortVertex};
use edgewalk_numerics::term::Shares;

/// A triangle that has lines and columns on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Vertices in centre coordinates, 2^-t px.
    corners: [[i64; 2]; 3],
    /// P.
    pixel: i64,
    /// The triangle's spans run to the left.
    pub leftward: bool,
    /// Column and line of the pixel that the walk of its spans begins at.
    pub start: [i64; 2],
    /// In the middle of its visible box.
    pub middle: [i64; 2],
    /// Sides of that box, pixels.
    pub sides: [u32; 2],
}

impl Place {
    /// `None` if the machine culls it.
    pub fn of(machine: &Plan, triangle: &[PortVertex; 3]) -> Option<Place> {
        let bits = machine.subpixel_bits;
        let pixel = 1i64 << bits.max(1);
        let centre = |v: i32| if bits >= 1 { i64::from(v) - (1 << (bits - 1)) } else { 2 * i64::from(v) - 1 };
        let corners = triangle.map(|vertex| [centre(vertex.x()), centre(vertex.y())]);
        let mut sorted = corners;
        sorted.sort_by_key(|[_, v]| *v); // stable
        let [top, knee, bottom] = sorted;
        let to = |a: [i64; 2], b: [i64; 2]| [b[0] - a[0], b[1] - a[1]];
        let (first, second) = (to(top, knee), to(top, bottom));
        let area = first[0] * second[1] - second[0] * first[1];
        let up = |value: i64, unit: i64| -(-value).div_euclid(unit);
        let (width, height) = (i64::from(machine.width), i64::from(machine.height));
        let columns = corners.map(|[u, _]| u);
        let (left, right) = (columns.into_iter().min()?, columns.into_iter().max()?);
        let (k0, k1) = (up(left, pixel).max(0), up(right, pixel).min(width));
        let (j0, j2) = (up(top[1], pixel).max(0), up(bottom[1], pixel).min(height));
        if area == 0 || k1 <= k0 || j2 <= j0 {
            return None;
        }
        let leftward = area < 0;
        // Where the major edge, from the top to the bottom, crosses the first line.
        let across = top[0] * second[1] + (j0 * pixel - top[1]) * second[0];
        let column = up(across, second[1] * pixel);
        Some(Place {
            corners,
            pixel,
            leftward,
            start: [column - i64::from(leftward), j0],
            middle: [k0 + (k1 - k0) / 2, j0 + (j2 - j0) / 2],
            sides: [(k1 - k0) as u32, (j2 - j0) as u32], // of the screen
        })
    }

    /// Columns along the span and lines down from the middle of the box.
    pub fn steps_to(&self, [x, y]: [i64; 2]) -> (i64, i64) {
        let right = x - self.middle[0];
        (if self.leftward { -right } else { right }, y - self.middle[1])
    }

    /// What the vertices weigh in the middle of the box.
    pub fn shares(&self) -> Shares {
        let [x, y] = self.middle.map(|place| place * self.pixel);
        let step = if self.leftward { -self.pixel } else { self.pixel };
        // Coordinates have less than 24 bits, so products have less than 50.
        let at = |x: i64, y: i64| {
            [0, 1, 2].map(|k: usize| {
                let ([ax, ay], [bx, by]) = (self.corners[(k + 1) % 3], self.corners[(k + 2) % 3]);
                (ax - x) * (by - y) - (ay - y) * (bx - x)
            })
        };
        let (here, column, line) = (at(x, y), at(x + step, y), at(x, y + self.pixel));
        let growth = |to: [i64; 3]| [0, 1, 2].map(|k| to[k] - here[k]);
        Shares { here, column: growth(column), line: growth(line) }
    }
}
