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
    /// A camera that sees all between the corners `low` and `high` on a screen of any shape, from a little above and
    /// to the right.
    pub fn around([low, high]: [DVec3; 2]) -> Self {
        const ANGLE: f64 = 0.7;
        let radius = (high - low).length() / 2.0;
        let target = (low + high) / 2.0;
        let distance = radius / (ANGLE / 2.0).sin();
        let eye = target + DVec3::new(0.45, 0.35, 1.0).normalize() * distance;
        // A little room, so that rounding clips nothing.
        let room = 1.001 * radius;
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
    fn a_framed_box_lies_within_the_screen_whatever_its_shape() {
        let bounds = [DVec3::new(-3.0, 10.0, 2.0), DVec3::new(1.0, 11.0, 900.0)];
        let camera = Camera::around(bounds);
        for (width, height) in [(640, 480), (480, 640), (1, 1000), (1000, 1)] {
            let to_clip = camera.to_clip(width, height);
            for corner in 0..8 {
                let axis = |k: usize| bounds[corner >> k & 1][k];
                let p = to_clip * DVec3::new(axis(0), axis(1), axis(2)).extend(1.0);
                assert!(
                    p.w > 0.0 && p.x.abs() <= p.w && p.y.abs() <= p.w && (0.0..=p.w).contains(&p.z),
                    "{p}"
                );
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
