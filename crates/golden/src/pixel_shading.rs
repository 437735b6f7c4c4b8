//! The colour of a pixel by the equation there: Phong and fast Phong of a frame that has normals.
//!
//! All is a mean over the triangle, by what its vertices weigh at the pixel; nothing is stepped.

use crate::fast_phong::{PowerTable, nodes, six_point_at};
use crate::fragment::{Fragment, Weight};
use edgewalk_scene::{PixelMethod, PixelShading, PixelTriangle};
use glam::DVec3;

/// A triangle about to be shaded.
pub struct PixelBrush<'a> {
    shading: &'a PixelShading,
    triangle: &'a PixelTriangle,
    /// Of the lights in their order; none for Phong.
    cosines: Vec<Cosines>,
}

/// A light's cosines, each by its values at the vertices and at the middles of the edges opposite them.
struct Cosines {
    /// In the middle of the triangle.
    intensity: DVec3,
    diffuse: [[f64; 3]; 2],
    halfway: [[f64; 3]; 2],
}

impl<'a> PixelBrush<'a> {
    /// Of the triangle with this place; `None` if the frame has no normals for it.
    pub fn new(shading: &'a PixelShading, place: usize) -> Option<Self> {
        let triangle = shading.triangles.get(place)?;
        let cosines = match shading.method {
            PixelMethod::Phong => Vec::new(),
            PixelMethod::FastPhong => Self::of_lights(shading, triangle),
        };
        Some(Self { shading, triangle, cosines })
    }

    fn of_lights(shading: &PixelShading, triangle: &PixelTriangle) -> Vec<Cosines> {
        let PixelTriangle { normals, positions, .. } = *triangle;
        let middle = (positions[0] + positions[1] + positions[2]) / 3.0;
        let of = |light: &edgewalk_scene::Light| {
            let toward = |position| light.incident(position).toward;
            let halfway = |position| (toward(position) + shading.viewer_at(position)).normalize_or_zero();
            Cosines {
                intensity: light.incident(middle).intensity,
                diffuse: nodes(normals, positions, |n, p| n.dot(toward(p))),
                halfway: nodes(normals, positions, |n, p| n.dot(halfway(p))),
            }
        };
        shading.lights.iter().map(of).collect()
    }

    /// The colour at a pixel of the triangle, each in [0, 1].
    pub fn color<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> [f64; 3] {
        let (shares, surface) = (fragment.shares(), DVec3::from(fragment.rgb()));
        let mean = |values: [DVec3; 3]| values.iter().zip(shares).map(|(v, share)| *v * share).sum::<DVec3>();
        let color = match self.shading.method {
            PixelMethod::Phong => {
                let PixelTriangle { normals, positions, .. } = *self.triangle;
                self.shading.color(self.triangle, mean(positions), mean(normals), surface)
            }
            PixelMethod::FastPhong => self.fast(&shares, surface, 0),
        };
        color.to_array()
    }

    /// In fast Phong N·L and N·H of each light at a pixel, not cut; in Phong none.
    pub fn cosines<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> Vec<[f64; 2]> {
        let shares = fragment.shares();
        let at = |light: &Cosines| [&light.diffuse, &light.halfway].map(|nodes| six_point_at(&shares, nodes));
        self.cosines.iter().map(at).collect()
    }

    /// In fast Phong the colours that the pixel may have for one who knows the cosines N·L to within `doubt`: for each light
    /// whose N·L is no farther from 0, as if it stood above the horizon and as if below. The first is that of
    /// [`Self::color`]; in Phong it is the only one.
    pub fn branches<const N: usize, W: Weight>(
        &self,
        fragment: &Fragment<N, W>,
        doubt: f64,
    ) -> Vec<[f64; 3]> {
        let (shares, surface) = (fragment.shares(), DVec3::from(fragment.rgb()));
        let mut turned = vec![0];
        for (light, cosines) in self.cosines.iter().enumerate() {
            if six_point_at(&shares, &cosines.diffuse).abs() <= doubt {
                let others: Vec<u64> = turned.iter().map(|set| set | 1 << light).collect();
                turned.extend(others);
            }
        }
        match turned[..] {
            [_] => vec![self.color(fragment)],
            _ => turned.into_iter().map(|set| self.fast(&shares, surface, set).to_array()).collect(),
        }
    }

    /// I_e + c k_a I_a + sum of I_l (c k_d D + k_s f(H)^n) over the lights with D > 0; those in the set `turned` as if on the
    /// other side of the horizon.
    fn fast(&self, shares: &[f64], surface: DVec3, turned: u64) -> DVec3 {
        let material = self.shading.material(self.triangle, surface);
        let part = |(place, light): (usize, &Cosines)| {
            let cosine = six_point_at(shares, &light.diffuse);
            if (cosine <= 0.0) != (turned >> place & 1 == 1) {
                return DVec3::ZERO;
            }
            // The quadratics go beyond 0 and 1.
            let halfway = six_point_at(shares, &light.halfway).clamp(0.0, 1.0);
            let power = PowerTable::exact(self.shading.specular, material.exponent, halfway);
            light.intensity * (material.diffuse * cosine.clamp(0.0, 1.0) + material.specular * power)
        };
        let sum: DVec3 = self.cosines.iter().enumerate().map(part).sum();
        (material.emission + material.ambient * self.shading.ambient + sum).clamp(DVec3::ZERO, DVec3::ONE)
    }
}
