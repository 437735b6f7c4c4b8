//! The camera: from world space to clip space.
//!
//! Clip space is homogeneous (x, y, z, w): x to the right, y up, both from -w to w on the screen; z from 0 at the near
//! plane to w at the far plane.

use glam::dcamera::rh::proj::directx::perspective;
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3};

/// A perspective camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: DVec3,
    /// What it looks at, the middle of the picture.
    pub target: DVec3,
    /// What is up in the picture; not along the line of sight.
    pub up: DVec3,
    /// Angle of view across the shorter side of the screen, radians in (0, pi).
    pub angle: f64,
    /// Distance to the near plane, positive.
    pub near: f64,
    /// Distance to the far plane, beyond the near one.
    pub far: f64,
}

impl Camera {
    /// A camera that sees all of `points` on a screen of any shape, from a little above and to the right, so near that
    /// they fill a square one. The points are not all in one place.
    pub fn around(points: &[DVec3]) -> Self {
        const ANGLE: f64 = 0.7;
        /// Of the picture left free around what is seen; rounding then clips nothing.
        const MARGIN: f64 = 0.05;
        let bounds = |low: DVec3, high: DVec3, p: &DVec3| (low.min(*p), high.max(*p));
        let (low, high) = points.iter().fold((points[0], points[0]), |(low, high), p| bounds(low, high, p));
        let (target, radius) = ((low + high) / 2.0, (high - low).length() / 2.0);
        let backward = DVec3::new(0.45, 0.5, 1.0).normalize();
        let to_view = look_at_mat4(DVec3::ZERO, -backward, DVec3::Y);
        // In view space a point p is in the picture if |x| and |y| <= (distance - z) tan(ANGLE / 2).
        let slope = (ANGLE / 2.0).tan() * (1.0 - MARGIN);
        let seen = points.iter().map(|point| to_view.transform_vector3(*point - target));
        let (mut distance, mut depth) = (0.0f64, 0.0f64);
        for p in seen {
            depth = depth.max(p.z.abs());
            distance = distance.max(p.z + p.x.abs().max(p.y.abs()) / slope);
        }
        let room = depth + MARGIN * radius;
        let distance = distance.max(room + MARGIN * radius);
        let eye = target + backward * distance;
        Self { eye, target, up: DVec3::Y, angle: ANGLE, near: distance - room, far: distance + room }
    }

    /// World space to clip space for a screen of `width` by `height` pixels.
    pub fn to_clip(&self, width: u32, height: u32) -> DMat4 {
        let aspect = f64::from(width) / f64::from(height);
        // The tangent of half the vertical angle; the horizontal one is `aspect` times that.
        let half = (self.angle / 2.0).tan() / aspect.min(1.0);
        perspective(2.0 * half.atan(), aspect, self.near, self.far)
            * look_at_mat4(self.eye, self.target, self.up)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn framed_points_lie_on_the_screen_whatever_its_shape() {
        let cloud = |k: u32| {
            let axis = |prime: u32| f64::from(k * prime % 101) / 101.0;
            DVec3::new(-3.0 + 4.0 * axis(37), 10.0 + axis(53), 2.0 + 900.0 * axis(71))
        };
        let points: Vec<DVec3> = (0..101).map(cloud).collect();
        for points in [&points[..], &points[..2]] {
            let camera = Camera::around(points);
            for (width, height) in [(500, 500), (640, 480), (480, 640), (1, 1000), (1000, 1)] {
                let to_clip = camera.to_clip(width, height);
                let mut widest = 0.0f64;
                for p in points.iter().map(|point| to_clip * point.extend(1.0)) {
                    assert!(
                        p.w > 0.0 && p.x.abs() <= p.w && p.y.abs() <= p.w && (0.0..=p.w).contains(&p.z),
                        "{p}"
                    );
                    widest = widest.max((p.x / p.w).abs()).max((p.y / p.w).abs());
                }
                assert!(widest > 0.9 || width != height, "{widest}");
            }
        }
    }

    #[test]
    fn near_and_far_planes_bound_the_depth() {
        let camera =
            Camera { eye: DVec3::Z, target: DVec3::ZERO, up: DVec3::Y, angle: 1.0, near: 0.5, far: 8.0 };
        let to_clip = camera.to_clip(4, 3);
        let depth = |distance: f64| {
            let p = to_clip * DVec3::new(0.0, 0.0, 1.0 - distance).extend(1.0);
            p.z / p.w
        };
        assert!(depth(0.5).abs() < 1e-12);
        assert!((depth(8.0) - 1.0).abs() < 1e-12);
        let right = to_clip * DVec3::X.extend(1.0);
        let up = to_clip * DVec3::Y.extend(1.0);
        assert!(right.x > 0.0 && up.y > 0.0);
    }
}
