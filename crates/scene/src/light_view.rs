//! What a light sees: the depth pass "setting the eye position to the light source" (ch. 7.2), as
//! screen-space triangles.
//!
//! ```text
//!   directional            positional                     flood
//!   ─┐ |  |  | ┌─          six pyramids of 90 degrees     one pyramid around the cone; six where half of it is
//!    └─┴──┴──┴─┘           around the light               wider than 60 degrees
//!   box around the mesh
//! ```
//! A map is `size` by `size` texels, texel (i, j) with its centre at (i + 1/2, j + 1/2). Distance is along
//! the axis of the view, in the world's unit; depth in the map runs from 0 at the near plane to 1 at the far
//! one, linear over the map: (d - n) / (f - n) in a parallel view, (d - n) f / ((f - n) d) in a pyramid.
//!
//! Not modelled: what is nearer to a positional or flood light than 1/10,000 of the mesh's farthest point
//! casts no shadow.

use crate::camera::Camera;
use crate::clip::{ClipVertex, Viewport, clip};
use crate::light::Light;
use crate::mesh::Mesh;
use crate::vertex::{Triangle, Vertex};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

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

/// Like `Lens`, where one pyramid has to do.
const WIDEST_ALONE: f64 = 7.0 * std::f64::consts::PI / 18.0;

/// Where a point is in a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InMap {
    /// Texels to the right and down, in [0, size).
    pub texel: DVec2,
    /// Along the axis.
    pub distance: f64,
}

impl Light {
    /// The depth maps, of `size` by `size` texels, that hold every point of a mesh within `bounds` that the
    /// light shines on.
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

impl Light {
    /// The one depth map, of `size` by `size` texels, that holds each of these points that the light shines
    /// on, as near to them as it may be; `None` where it takes several.
    pub fn view(&self, points: &[DVec3], size: u32) -> Option<LightView> {
        let bounds = bounds(points)?;
        let pyramid = |position, axis, tangent| LightView::pyramid(position, axis, tangent, bounds, size);
        let view = match *self {
            Self::Directional { toward, .. } => return Some(LightView::parallel(-toward, bounds, size)),
            Self::Flood { position, axis, cone, .. } if cone <= WIDEST => pyramid(position, axis, cone.tan()),
            // Of a few directions that from which the points spread least.
            Self::Positional { position, .. } | Self::Flood { position, .. } => {
                let middle = ((bounds[0] + bounds[1]) / 2.0 - position).try_normalize();
                let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).chain(middle);
                let spread = |axis| pyramid(position, axis, 1.0).spread(points);
                let (tangent, axis) =
                    axes.map(|axis| (spread(axis), axis)).min_by(|(a, _), (b, _)| a.total_cmp(b))?;
                (tangent <= WIDEST_ALONE.tan()).then(|| pyramid(position, axis, tangent))?
            }
        };
        let Lens::Pyramid(tangent) = view.lens else { return Some(view) };
        let along = points.iter().map(|point| view.turned(*point - view.eye).z);
        let near = (along.fold(view.far, f64::min) * (1.0 - MARGIN)).max(NEAR * view.far);
        Some(LightView { lens: Lens::Pyramid(tangent * (1.0 + MARGIN)), near, ..view })
    }
}

/// The box around points.
fn bounds(points: &[DVec3]) -> Option<[DVec3; 2]> {
    let low = points.iter().copied().reduce(DVec3::min)?;
    Some([low, points.iter().copied().reduce(DVec3::max)?])
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

    /// The tangent of half the angle over which points are seen to the side or up; infinite if one does not
    /// lie before the light.
    fn spread(&self, points: &[DVec3]) -> f64 {
        let tangent = |point: &DVec3| {
            let p = self.turned(*point - self.eye);
            if p.z > 0.0 { p.x.abs().max(p.y.abs()) / p.z } else { f64::INFINITY }
        };
        points.iter().map(tangent).fold(0.0, f64::max)
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

    /// Where a point is, homogeneous: texel x, texel y and depth, each times the last, which is above 0
    /// before the light.
    pub fn texels(&self, point: DVec3) -> DVec4 {
        let DVec4 { x, y, z, w } = self.to_clip(point);
        let side = f64::from(self.size);
        DVec4::new((0.5 * w + 0.5 * x) * side, (0.5 * w - 0.5 * y) * side, z, w)
    }

    /// The matrix that takes a pixel's (x, y, depth, 1) on the screen of a camera to [`Self::texels`] of what
    /// it shows, by rows; `None` for a camera that sees nothing.
    pub fn from_screen(&self, camera: &Camera, width: u32, height: u32) -> Option<[[f64; 4]; 4]> {
        let (half_width, half_height) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
        let viewport = DMat4::from_translation(DVec3::new(half_width, half_height, 0.0))
            * DMat4::from_scale(DVec3::new(half_width, -half_height, 1.0));
        // What a linear function of homogeneous points makes of the unit points is its matrix.
        let origin = self.texels(DVec3::ZERO);
        let [x, y, z] = DVec3::AXES.map(|axis| self.texels(axis) - origin);
        let to_world = (viewport * camera.to_clip(width, height)).inverse();
        let matrix = DMat4::from_cols(x, y, z, origin) * to_world;
        matrix.is_finite().then(|| matrix.transpose().to_cols_array_2d())
    }

    /// How much the depth of a plane changes over a texel to the side and one down, both together, given
    /// three of its points; 1, more than which no depth changes, where the light sees it edge-on.
    pub fn depth_slope(&self, points: [DVec3; 3]) -> f64 {
        let seen = points.map(|point| self.texels(point));
        let plane = DMat3::from_cols_array_2d(&seen.map(|p| [p.x, p.y, p.w])).transpose().inverse();
        let [x, y, _] = (plane * DVec3::from_array(seen.map(|p| p.z))).to_array();
        let slope = x.abs() + y.abs();
        if slope.is_nan() { 1.0 } else { slope.min(1.0) }
    }

    /// How much the depth in the map changes over a unit of length along the axis at a point, at most: nearer
    /// than the near plane as much as there.
    pub fn depth_rate(&self, point: DVec3) -> f64 {
        let range = self.far - self.near;
        match self.lens {
            Lens::Parallel(_) => 1.0 / range,
            Lens::Pyramid(_) => {
                let distance = (point - self.eye).dot(self.axis).max(self.near);
                self.far * self.near / (range * distance * distance)
            }
        }
    }

    /// The faces of a mesh in texels, with their k_t: those that hide the light, and those that transmit some
    /// of it.
    pub fn triangles(&self, mesh: &Mesh) -> [Vec<Triangle>; 2] {
        let viewport = Viewport { width: self.size, height: self.size, guard: 2.0 * f64::from(self.size) };
        let mut triangles = [Vec::new(), Vec::new()];
        for face in mesh.faces() {
            let kt = mesh.materials()[face.material as usize].transmission;
            let triangles = &mut triangles[usize::from(kt > 0.0)];
            let corners = mesh.corners(face).map(|position| ClipVertex::bare(self.to_clip(position)));
            clip(corners, &viewport, |vertices| {
                triangles.push(Triangle(vertices.map(|vertex| Vertex { kt, ..vertex.screen })));
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

    /// By how much the distance of a plane through a point changes over one texel to the side and one up or
    /// down: both together, to first order. Infinite where the light sees the plane edge-on.
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

    /// One view holds all that is lit, where there is one; none of a light amid the points.
    #[test]
    fn one_view_holds_every_lit_point() {
        let points: Vec<DVec3> = (0..300u32)
            .map(|k| {
                let part = |prime: u32| f64::from(k * prime % 101) / 100.0;
                BOUNDS[0] + (BOUNDS[1] - BOUNDS[0]) * DVec3::new(part(37), part(53), part(71))
            })
            .collect();
        let (intensity, attenuation) = (DVec3::ONE, Attenuation::NONE);
        let far = Light::Positional { position: DVec3::new(1.0, 6.0, 0.5), intensity, attenuation };
        let mut places = 0;
        for (light, is_there) in lights().into_iter().chain([far]).zip([true, false, true, true, true]) {
            let view = light.view(&points, 64);
            assert_eq!(view.is_some(), is_there, "{light:?}");
            for point in points.iter().filter(|point| light.incident(**point).intensity != DVec3::ZERO) {
                let Some(view) = view else { continue };
                let place = view.place(*point).expect("in the map");
                let texels = view.texels(*point);
                assert!((place.texel - texels.truncate().truncate() / texels.w).length() < 1e-9);
                assert!((0.0..=1.0).contains(&(texels.z / texels.w)), "{light:?} {point}");
                places += 1;
            }
        }
        assert!(places > 700, "{places}");
    }

    /// What a pixel shows has the texel of its point; the depth of a plane changes over a texel as its slope
    /// says.
    #[test]
    fn the_matrix_of_the_screen_goes_to_the_same_texel() {
        let camera = Camera {
            eye: DVec3::new(4.0, 5.0, 9.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            angle: 0.9,
            near: 1.0,
            far: 50.0,
        };
        let points = [DVec3::new(0.3, 0.2, 0.1), DVec3::new(1.0, 0.9, -1.0), DVec3::new(-0.5, 0.4, 1.5)];
        let mut checked = 0;
        for view in lights().iter().filter_map(|light| light.view(&points, 100)) {
            let matrix = view.from_screen(&camera, 64, 48).expect("a camera that sees");
            for point in points {
                let clip = camera.to_clip(64, 48) * point.extend(1.0);
                let (x, y) = (32.0 + 32.0 * clip.x / clip.w, 24.0 - 24.0 * clip.y / clip.w);
                let pixel = [x, y, clip.z / clip.w, 1.0];
                let seen = matrix.map(|row| (0..4).map(|k| row[k] * pixel[k]).sum::<f64>());
                let texels = view.texels(point);
                // Homogeneous, so the same but for a factor above 0.
                assert!(seen[3] > 0.0 && texels.w > 0.0);
                for k in 0..3 {
                    assert!((seen[k] / seen[3] - texels[k] / texels.w).abs() < 1e-9, "{k}");
                }
                checked += 1;
            }
            let place = |point: DVec3| view.texels(point).truncate() / view.texels(point).w;
            let [a, b, c] = points.map(place);
            let normal = (b - a).cross(c - a);
            let slope = (normal.x.abs() + normal.y.abs()) / normal.z.abs();
            assert!((view.depth_slope(points) / slope.min(1.0) - 1.0).abs() < 1e-6, "{slope}");
            assert_eq!(view.depth_slope([points[0]; 3]), 1.0, "no plane");
            // A little farther along the axis.
            let rate = (place(points[0] + 1e-6 * view.axis).z - place(points[0]).z) / 1e-6;
            assert!((view.depth_rate(points[0]) / rate - 1.0).abs() < 1e-4, "{rate}");
        }
        assert!(checked >= 6, "{checked}");
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
