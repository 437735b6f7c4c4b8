//! Normals over a triangle as a linear function of the pixel (ch. 7.11).

use glam::{DVec2, DVec3};

/// N(x, y) = A x + B y + C, x and y in pixels from the centroid.
///
/// Not normalised in between: N is shorter inside the triangle than at its corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalPlane {
    /// The centroid, pixels.
    pub centre: DVec2,
    /// A, per pixel to the right.
    pub a: DVec3,
    /// B, per line down.
    pub b: DVec3,
    /// C, the mean of the vertices' normals.
    pub c: DVec3,
}

impl NormalPlane {
    /// Through the normals at three points on the screen, in pixels; `None` if these lie on a line.
    pub fn new(points: [DVec2; 3], normals: [DVec3; 3]) -> Option<Self> {
        let [p0, p1, p2] = points;
        let (u, v) = (p1 - p0, p2 - p0);
        let area = u.perp_dot(v);
        if area == 0.0 {
            return None;
        }
        let (along_u, along_v) = (normals[1] - normals[0], normals[2] - normals[0]);
        Some(Self {
            centre: (p0 + p1 + p2) / 3.0,
            a: (along_u * v.y - along_v * u.y) / area,
            b: (along_v * u.x - along_u * v.x) / area,
            c: (normals[0] + normals[1] + normals[2]) / 3.0,
        })
    }
}
