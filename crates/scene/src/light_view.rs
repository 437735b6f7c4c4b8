//! What a light sees: the depth pass "setting the eye position to the light source" (ch. 7.2), as screen-space triangles.
//!
//! ```text
//!   directional            positional                     flood
//!   ─┐ |  |  | ┌─          six pyramids of 90 degrees     one pyramid around the cone; six where half of it is
//!    └─┴──┴──┴─┘           around the light               wider than 60 degrees
//!   box around the mesh
//! ```
//! A map is `size` by `size` texels, texel (i, j) with its centre at (i + 1/2, j + 1/2). Distance is along the axis of the
//! view, in the world's unit; depth in the map runs from 0 at the near plane to 1 at the far one, linear over the map:
//! (d - n) / (f - n) in a parallel view, (d - n) f / ((f - n) d) in a pyramid.
//!
//! Not modelled: what is nearer to a positional or flood light than 1/10,000 of the mesh's farthest point casts no shadow.

use crate::clip::{ClipVertex, Viewport, clip};
use crate::frame::Triangle;
use crate::light::Light;
use crate::mesh::Mesh;
use glam::{DVec2, DVec3, DVec4};

/// Near plane of a pyramid as a part of the far one.
const NEAR: f64 = 1e-4;

/// Kept free around what a view is fitted to, as a part of it: a point on its very border must have a texel.
const MARGIN: f64 = 0.01;

/// Half the widest cone that one pyramid holds, radians.
const WIDEST: f64 = std::f64::consts::FRAC_PI_3;

/// One depth map of a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightView {
    /// Texels a side.
    size: u32,
    eye: DVec3,
    /// Unit vectors: to the right and up in the map, and away from the light.
    right: DVec3,
    up: DVec3,
    axis: DVec3,
    lens: Lens,
    near: f64,
    far: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Lens {
    /// Half the sides of the box.
    Parallel(DVec2),
    /// Tangent of half the angle.
    Pyramid(f64),
}

/// Where a point is in a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InMap {
    /// Texels to the right and down, in [0, size).
    pub texel: DVec2,
    /// Along the axis.
    pub distance: f64,
}

impl Light {
    /// The depth maps, of `size` by `size` texels, that hold every point of a mesh within `bounds` that the light shines on.
    pub fn views(&self, bounds: [DVec3; 2], size: u32) -> Vec<LightView> {
        match *self {
            Self::Directional { toward, .. } => vec![LightView::parallel(-toward, bounds, size)],
            Self::Flood { position, axis, cone, .. } if cone <= WIDEST => {
                vec![LightView::pyramid(position, axis, cone.tan() * (1.0 + MARGIN), bounds, size)]
            }
            Self::Positional { position, .. } | Self::Flood { position, .. } => {
                let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
                axes.map(|axis| LightView::pyramid(position, axis, 1.0 + MARGIN, bounds, size)).to_vec()
            }
        }
    }
}

impl LightView {
    fn parallel(axis: DVec3, bounds: [DVec3; 2], size: u32) -> Self {
        let (right, up) = axis.any_orthonormal_pair();
        let along = corners(bounds).map(|p| DVec3::new(p.dot(right), p.dot(up), p.dot(axis)));
        let low = along.into_iter().reduce(DVec3::min).unwrap_or_default();
        let high = along.into_iter().reduce(DVec3::max).unwrap_or_default();
        let (middle, margin) = ((low + high) / 2.0, MARGIN * (high - low).length());
        let half = (high - low) / 2.0 + margin;
        let eye = right * middle.x + up * middle.y + axis * (middle.z - 2.0 * half.z);
        let lens = Lens::Parallel(half.truncate());
        Self { size, eye, right, up, axis, lens, near: half.z, far: 3.0 * half.z }
    }

    fn pyramid(eye: DVec3, axis: DVec3, tangent: f64, bounds: [DVec3; 2], size: u32) -> Self {
        let (right, up) = axis.any_orthonormal_pair();
        let far = corners(bounds).into_iter().map(|p| p.distance(eye)).fold(0.0, f64::max) * (1.0 + MARGIN);
        Self { size, eye, right, up, axis, lens: Lens::Pyramid(tangent), near: NEAR * far, far }
    }

    /// Texels a side.
    pub fn size(&self) -> u32 {
        self.size
    }

    /// To the right, up, and along the axis.
    fn turned(&self, vector: DVec3) -> DVec3 {
        DVec3::new(vector.dot(self.right), vector.dot(self.up), vector.dot(self.axis))
    }

    /// x and y from -w to w in the map; z from 0 at the near plane to w at the far one.
    fn to_clip(self, point: DVec3) -> DVec4 {
        let p = self.turned(point - self.eye);
        let depth = (p.z - self.near) / (self.far - self.near);
        match self.lens {
            Lens::Parallel(half) => DVec4::new(p.x / half.x, p.y / half.y, depth, 1.0),
            Lens::Pyramid(tangent) => DVec4::new(p.x / tangent, p.y / tangent, depth * self.far, p.z),
        }
    }

    /// The opaque faces of a mesh, in texels.
    pub fn triangles(&self, mesh: &Mesh) -> Vec<Triangle> {
        let viewport = Viewport { width: self.size, height: self.size, guard: 2.0 * f64::from(self.size) };
        let mut triangles = Vec::new();
        for face in mesh.faces() {
            if mesh.materials()[face.material as usize].transmission > 0.0 {
                continue;
            }
            let corners = mesh.corners(face).map(|position| ClipVertex::bare(self.to_clip(position)));
            clip(corners, &viewport, |vertices| {
                triangles.push(Triangle(vertices.map(|vertex| vertex.screen)))
            });
        }
        triangles
    }

    /// Where a point is in this map (ch. 7.3); `None` if it is outside, or not in front of the light.
    pub fn place(&self, point: DVec3) -> Option<InMap> {
        let DVec4 { x, y, w, .. } = self.to_clip(point);
        let side = f64::from(self.size);
        let texel = DVec2::new(0.5 + 0.5 * x / w, 0.5 - 0.5 * y / w) * side;
        let inside = w > 0.0 && (0.0..side).contains(&texel.x) && (0.0..side).contains(&texel.y);
        inside.then(|| InMap { texel, distance: (point - self.eye).dot(self.axis) })
    }

    /// The distance that belongs to a depth in [0, 1].
    pub fn distance(&self, depth: f64) -> f64 {
        match self.lens {
            Lens::Parallel(_) => self.near + depth * (self.far - self.near),
            Lens::Pyramid(_) => self.near / (1.0 - depth * (1.0 - self.near / self.far)),
        }
    }

    /// By how much the distance of a plane through a point changes over one texel to the side and one up or down: both
    /// together, to first order. Infinite where the light sees the plane edge-on.
    pub fn slope(&self, point: DVec3, normal: DVec3) -> f64 {
        let (p, n) = (self.turned(point - self.eye), self.turned(normal).abs());
        let per_texel = 2.0 / f64::from(self.size);
        match self.lens {
            Lens::Parallel(half) => per_texel * n.truncate().dot(half) / n.z,
            Lens::Pyramid(tangent) => {
                let facing = (self.turned(normal).dot(p) / p.z).abs();
                per_texel * tangent * p.z * (n.x + n.y) / facing
            }
        }
    }
}

/// The corners of a box.
fn corners([low, high]: [DVec3; 2]) -> [DVec3; 8] {
    std::array::from_fn(|k| {
        let side = |bit: usize, low: f64, high: f64| if k >> bit & 1 == 0 { low } else { high };
        DVec3::new(side(0, low.x, high.x), side(1, low.y, high.y), side(2, low.z, high.z))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Attenuation;

    const BOUNDS: [DVec3; 2] = [DVec3::new(-1.0, 0.0, -2.0), DVec3::new(3.0, 1.0, 2.0)];

    fn lights() -> [Light; 4] {
        let (intensity, attenuation, exponent) = (DVec3::ONE, Attenuation::NONE, 0.0);
        let flood = |cone| Light::Flood {
            position: DVec3::new(1.0, 4.0, 0.0),
            axis: DVec3::new(0.1, -1.0, 0.2).normalize(),
            cone,
            exponent,
            intensity,
            attenuation,
        };
        [
            Light::Directional { toward: DVec3::new(0.3, 0.9, -0.2).normalize(), intensity },
            Light::Positional { position: DVec3::new(0.2, 0.4, 0.1), intensity, attenuation },
            flood(0.9),
            flood(1.5),
        ]
    }

    /// Every point the light shines on is in some map, and depth and distance are two names for one thing.
    #[test]
    fn every_lit_point_has_a_texel_and_its_distance() {
        let mut places = 0;
        for light in lights() {
            for k in 0..500u32 {
                let part = |prime: u32| f64::from(k * prime % 101) / 100.0;
                let point = BOUNDS[0] + (BOUNDS[1] - BOUNDS[0]) * DVec3::new(part(37), part(53), part(71));
                if light.incident(point).intensity == DVec3::ZERO {
                    continue;
                }
                let views = light.views(BOUNDS, 64);
                let here: Vec<_> = views.iter().filter_map(|view| Some((view, view.place(point)?))).collect();
                assert!(!here.is_empty(), "{light:?} {point}");
                for (view, place) in here {
                    let DVec4 { z, w, .. } = view.to_clip(point);
                    assert!((0.0..=1.0).contains(&(z / w)), "{light:?} {point}");
                    assert!((view.distance(z / w) / place.distance - 1.0).abs() < 1e-9);
                    places += 1;
                }
            }
        }
        assert!(places > 1500, "{places}");
    }

    #[test]
    fn slope_is_the_change_over_a_texel() {
        let normal = DVec3::new(0.3, 0.8, -0.5).normalize();
        let point = DVec3::new(0.7, 0.1, 0.4);
        for light in lights() {
            for view in light.views(BOUNDS, 1 << 16) {
                let Some(place) = view.place(point) else { continue };
                // One step along the plane to each side in the map: to the points of the plane a texel away.
                let step = 2.0 / f64::from(view.size);
                let ray = |dx: f64, dy: f64| {
                    let aside = |half: DVec2| (view.right * dx * half.x + view.up * dy * half.y) * step;
                    let (from, way) = match view.lens {
                        Lens::Parallel(half) => (point + aside(half), view.axis),
                        Lens::Pyramid(tangent) => {
                            (view.eye, (point - view.eye) / place.distance + aside(DVec2::splat(tangent)))
                        }
                    };
                    let along = (point - from).dot(normal) / way.dot(normal);
                    view.place(from + way * along).map(|there| (there.distance - place.distance).abs())
                };
                let (Some(x), Some(y)) = (ray(1.0, 0.0), ray(0.0, 1.0)) else { continue };
                let slope = view.slope(point, normal);
                assert!(((x + y) / slope - 1.0).abs() < 1e-2, "{light:?}: {x} {y} {slope}");
            }
        }
    }
}
