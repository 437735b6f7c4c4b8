//! A ray and a triangle: a ray through a shared edge meets exactly one of its triangles.
//!
//! The corners are sheared so that the ray is the axis through 0; edge functions of the corners' x and y then say on
//! which side of each edge it passes. A shared edge gives both triangles the same number with opposite sign, to the last
//! bit; where it is 0 the ray counts as moved to the right by an infinitely small amount and up by a yet smaller one.

use glam::{DVec2, DVec3};

/// A ray from a point.
pub(super) struct Ray {
    pub(super) from: DVec3,
    /// Unit vector, or zero: such a ray meets nothing.
    pub(super) way: DVec3,
    /// The axis nearest to the way comes last.
    axes: [usize; 3],
    shear: DVec2,
}

impl Ray {
    pub(super) fn new(from: DVec3, way: DVec3) -> Self {
        let last = way.abs().max_position();
        let axes = [(last + 1) % 3, (last + 2) % 3, last];
        Self { from, way, axes, shear: DVec2::new(way[axes[0]], way[axes[1]]) / way[last] }
    }

    /// The distance to the triangle along the ray, negative behind its start; `None` where it passes beside it.
    pub(super) fn hit(&self, corners: [DVec3; 3]) -> Option<f64> {
        let [x, y, z] = self.axes;
        let corners = corners.map(|corner| {
            let c = corner - self.from;
            (DVec2::new(c[x], c[y]) - self.shear * c[z], c[z])
        });
        let [(a, az), (b, bz), (c, cz)] = corners;
        let sides = [side(b, c), side(c, a), side(a, b)];
        if sides != [sides[0]; 3] || sides[0] == 0 {
            return None;
        }
        let weights = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
        let total: f64 = weights.iter().sum();
        let along = (weights[0] * az + weights[1] * bz + weights[2] * cz) / total;
        // Without area all weights are 0, and the quotient is NaN: nearer than nothing and farther than nothing.
        Some(along / self.way[z])
    }
}

/// 1 if 0 lies to the left of the way from `a` to `b`, -1 to the right; 0 only if the two are one point.
fn side(a: DVec2, b: DVec2) -> i8 {
    let sign = |value: f64| {
        if value > 0.0 {
            1
        } else if value < 0.0 {
            -1
        } else {
            0
        }
    };
    let sides = [sign(a.perp_dot(b)), sign(a.y - b.y), sign(b.x - a.x)];
    sides.into_iter().find(|side| *side != 0).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of six triangles around 0 in the plane z = 1: rays through its middle, its spokes and its faces.
    #[test]
    fn shared_edges_and_corners_are_met_once() {
        let rim = [[2.0, 0.0], [1.0, 2.0], [-1.0, 2.0], [-2.0, 0.0], [-1.0, -2.0], [1.0, -2.0]];
        let corner = |k: usize| DVec3::new(rim[k % 6][0], rim[k % 6][1], 1.0);
        let mut rays = 0;
        for (x, y) in (-3..=3).flat_map(|x| (-3..=3).map(move |y| (x, y))) {
            let through = DVec3::new(f64::from(x) / 4.0, f64::from(y) / 4.0, 1.0);
            for from in [DVec3::ZERO, DVec3::new(0.5, -0.25, -3.0)] {
                let ray = Ray::new(from, (through - from).normalize());
                let met: Vec<f64> =
                    (0..6).filter_map(|k| ray.hit([DVec3::Z, corner(k), corner(k + 1)])).collect();
                assert!(met.len() == 1, "{through}: {met:?}");
                assert!((met[0] - through.distance(from)).abs() < 1e-12);
                rays += 1;
            }
        }
        println!("checked {rays} rays");
    }

    #[test]
    fn beside_behind_and_without_area() {
        let triangle = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 1.0)];
        let hit = |x, y, way| Ray::new(DVec3::new(x, y, 0.0), way).hit(triangle);
        assert_eq!(hit(0.25, 0.25, DVec3::Z), Some(1.0));
        assert_eq!(hit(0.25, 0.25, DVec3::NEG_Z), Some(-1.0));
        assert_eq!(hit(0.75, 0.75, DVec3::Z), None);
        assert_eq!(hit(0.25, 0.25, DVec3::X), None, "parallel");
        let flat = [triangle[0], triangle[1], DVec3::new(2.0, 0.0, 1.0)];
        assert_eq!(Ray::new(DVec3::new(0.5, 0.0, 0.0), DVec3::Z).hit(flat), None);
    }
}
