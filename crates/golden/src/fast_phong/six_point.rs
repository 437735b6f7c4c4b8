//! The quadratic through the values at the vertices and the edges' midpoints.
//!
//! ```text
//!        0          along an edge the quadratic is the one through that edge's three values alone,
//!       / \         so two triangles that share the edge agree on it: no step is seen there, which
//!      5   4        the Taylor series about two different centroids leaves
//!     /     \
//!    1---3---2      midpoint k + 3 lies opposite vertex k
//! ```

use crate::fast_phong::quadratic::Quadratic;
use glam::{DVec2, DVec3};

/// Through `vertices` at three points on the screen, in pixels, and `midpoints`, each opposite the vertex of its place;
/// `None` if the points lie on a line.
///
/// With barycentric coordinates l_k it is the sum of vertices_k l_k (2 l_k - 1) and 4 midpoints_k l_i l_j.
pub fn six_point(points: [DVec2; 3], vertices: [f64; 3], midpoints: [f64; 3]) -> Option<Quadratic> {
    let [p0, p1, p2] = points;
    let area = (p1 - p0).perp_dot(p2 - p0);
    if area == 0.0 {
        return None;
    }
    let origin = (p0 + p1 + p2) / 3.0;
    // l_k falls from 1 at vertex k to 0 on the opposite edge, and is 1/3 at the centroid.
    let barycentric = |from: DVec2, to: DVec2| Linear {
        one: 1.0 / 3.0,
        x: (from.y - to.y) / area,
        y: (to.x - from.x) / area,
    };
    let l = [barycentric(p1, p2), barycentric(p2, p0), barycentric(p0, p1)];
    let mut t = [0.0; 6];
    for k in 0..3 {
        let own = Linear { one: 2.0 * l[k].one - 1.0, x: 2.0 * l[k].x, y: 2.0 * l[k].y };
        l[k].times(own, vertices[k], &mut t);
        l[(k + 1) % 3].times(l[(k + 2) % 3], 4.0 * midpoints[k], &mut t);
    }
    Some(Quadratic { origin, t })
}

/// The same sum where the vertices weigh `shares`, which add up to 1: `values` at the vertices and at the midpoints.
pub(crate) fn six_point_at(shares: &[f64], [vertices, midpoints]: &[[f64; 3]; 2]) -> f64 {
    let l = |k: usize| shares[k % 3];
    let part = |k: usize| vertices[k] * l(k) * (2.0 * l(k) - 1.0) + 4.0 * midpoints[k] * l(k + 1) * l(k + 2);
    part(0) + part(1) + part(2)
}

/// A cosine at the vertices and at the midpoints, each opposite the vertex of its place: `cosine` takes a unit normal and
/// the point it stands at.
pub(crate) fn nodes(
    normals: [DVec3; 3],
    positions: [DVec3; 3],
    cosine: impl Fn(DVec3, DVec3) -> f64,
) -> [[f64; 3]; 2] {
    let at = |normal: DVec3, position| cosine(normal.normalize_or_zero(), position);
    let middle = |values: [DVec3; 3], k: usize| (values[(k + 1) % 3] + values[(k + 2) % 3]) / 2.0;
    let midpoint = |k| at(middle(normals, k), middle(positions, k));
    [std::array::from_fn(|k| at(normals[k], positions[k])), std::array::from_fn(midpoint)]
}

/// `x` times x plus `y` times y plus `one`.
#[derive(Clone, Copy)]
struct Linear {
    one: f64,
    x: f64,
    y: f64,
}

impl Linear {
    /// Adds `factor` times the product to the coefficients T0 to T5.
    fn times(self, other: Self, factor: f64, t: &mut [f64; 6]) {
        let product = [
            self.one * other.one,
            self.one * other.y + self.y * other.one,
            self.one * other.x + self.x * other.one,
            self.y * other.y,
            self.x * other.y + self.y * other.x,
            self.x * other.x,
        ];
        for (sum, part) in t.iter_mut().zip(product) {
            *sum += factor * part;
        }
    }
}
