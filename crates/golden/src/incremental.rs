//! Attributes by addition alone, the way the listings of ch. 7.5 and ch. 7.6 step them.
//!
//! ```text
//!   start --> + dX --> + dX -->        a pixel:  value += dX          (ch. 7.9; once a triangle)
//!     |                                a line:   start += dY          (ch. 7.10; along the left edge)
//!     v + dY                           a half or a triangle begins:   start = the plane there (ch. 7.8)
//!   start --> + dX --> ...
//! ```
//! In f64, so what the additions cost is rounding of 2^-53 each. dY leads from the first pixel of a line to the first
//! pixel of the next: over the width the edge moves by, which in the exact fill is one of two whole numbers of pixels.

use crate::fragment::Fragment;

/// N attributes of one triangle on their way over its pixels.
#[derive(Debug, Clone)]
pub struct Incremental<const N: usize> {
    /// Of the vertices.
    values: [[f64; N]; 3],
    /// dX, from the second pixel of the first line on that has one.
    per_pixel: Option<[f64; N]>,
    /// First pixel of the line.
    start: Option<Place<N>>,
    /// The pixel last asked for.
    now: Place<N>,
}

/// A pixel and its values.
#[derive(Debug, Clone, Copy)]
struct Place<const N: usize> {
    x: u32,
    y: u32,
    weights: [i64; 3],
    total: i64,
    values: [f64; N],
}

impl<const N: usize> Incremental<N> {
    /// The attributes at the three vertices of a triangle.
    pub fn new(values: [[f64; N]; 3]) -> Self {
        let now = Place { x: 0, y: 0, weights: [0; 3], total: 1, values: [0.0; N] };
        Self { values, per_pixel: None, start: None, now }
    }

    /// The values at a fragment. It is called for all fragments of one triangle as
    /// [`fragments`](crate::fragments) or [`half_triangles`](crate::half_triangles) draw them.
    pub fn step(&mut self, fragment: &Fragment) -> &[f64; N] {
        let Fragment { x, y, weights, total, .. } = *fragment;
        let now = self.now;
        // In the textbook fill the second half draws the knee line once more, and may have another total.
        let further = self.start.is_some() && (now.y, now.total) == (y, total) && now.x < x;
        let values = match self.start {
            Some(_) if further => {
                let per_pixel = *self.per_pixel.get_or_insert_with(|| now.way_to(fragment, &self.values));
                add(now.values, per_pixel)
            }
            Some(start) if start.total == total => add(start.values, start.way_to(fragment, &self.values)),
            _ => plane(weights, total, &self.values),
        };
        let place = Place { x, y, weights, total, values };
        if !further {
            self.start = Some(place);
        }
        self.now = place;
        &self.now.values
    }
}

impl<const N: usize> Place<N> {
    /// The increments from here to a fragment.
    fn way_to(&self, fragment: &Fragment, vertices: &[[f64; N]; 3]) -> [f64; N] {
        let moved = [0, 1, 2].map(|k| fragment.weights[k] - self.weights[k]);
        plane(moved, fragment.total, vertices)
    }
}

/// (w0 a0 + w1 a1 + w2 a2) / total.
fn plane<const N: usize>(weights: [i64; 3], total: i64, [a, b, c]: &[[f64; N]; 3]) -> [f64; N] {
    let [u, v, w] = weights.map(|weight| weight as f64 / total as f64);
    std::array::from_fn(|k| u * a[k] + v * b[k] + w * c[k])
}

fn add<const N: usize>(left: [f64; N], right: [f64; N]) -> [f64; N] {
    std::array::from_fn(|k| left[k] + right[k])
}
