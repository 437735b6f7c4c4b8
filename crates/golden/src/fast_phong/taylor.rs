//! The second-order Taylor series about the centroid (BW86).

use crate::fast_phong::normal_plane::NormalPlane;
use crate::fast_phong::quadratic::Quadratic;
use glam::DVec3;

/// Shorter than this the mean of unit normals has no direction worth the name.
const LEAST_LENGTH: f64 = 1e-6;

/// Of L·N/|N| for a unit vector L and unit normals at the vertices; 0 where these cancel at the centroid.
///
/// ```text
///   L·N / |N| = (a x + b y + c) / sqrt(d x² + e xy + f y² + g x + h y + i)
/// ```
/// T5 has 3 c g²; copies that print 3 i g² are misprinted (its dimension would be another than that of the rest).
pub fn taylor(normals: &NormalPlane, direction: DVec3) -> Quadratic {
    let NormalPlane { centre, a: x, b: y, c: n } = *normals;
    let (a, b, c) = (direction.dot(x), direction.dot(y), direction.dot(n));
    let (d, e, f) = (x.dot(x), 2.0 * x.dot(y), y.dot(y));
    let (g, h, i) = (2.0 * x.dot(n), 2.0 * y.dot(n), n.dot(n));
    let root = i.sqrt();
    if root < LEAST_LENGTH {
        return Quadratic { origin: centre, t: [0.0; 6] };
    }
    let t0 = c / root;
    let t1 = (2.0 * b * i - c * h) / (2.0 * i * root);
    let t2 = (2.0 * a * i - c * g) / (2.0 * i * root);
    let t3 = (3.0 * c * h * h - 4.0 * c * f * i - 4.0 * b * h * i) / (8.0 * i * i * root);
    let t4 = (3.0 * c * g * h - 2.0 * c * e * i - 2.0 * b * g * i - 2.0 * a * h * i) / (4.0 * i * i * root);
    let t5 = (3.0 * c * g * g - 4.0 * c * d * i - 4.0 * a * g * i) / (8.0 * i * i * root);
    Quadratic { origin: centre, t: [t0, t1, t2, t3, t4, t5] }
}
