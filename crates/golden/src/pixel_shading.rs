//! The colour of a pixel by the equation there: Phong and fast Phong of a frame that has normals.
//!
//! All is a mean over the triangle, by what its vertices weigh at the pixel; nothing is stepped.

use crate::fast_phong::{PowerTable, nodes, six_point_at};
use crate::fragment::{Fragment, Weight};
use edgewalk_scene::{Image, Light, PixelMethod, PixelShading, PixelTriangle};
use glam::{DVec2, DVec3};
use std::ops::{Add, Mul};

/// A triangle about to be shaded.
pub struct PixelBrush<'a> {
    shading: &'a PixelShading,
    triangle: &'a PixelTriangle,
    texture: Option<&'a Image>,
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

/// A light at a pixel: its intensity, N·L and N·H.
struct Lit {
    intensity: DVec3,
    diffuse: f64,
    halfway: f64,
}

impl<'a> PixelBrush<'a> {
    /// Of the triangle with this place; `None` if the frame has no normals for it.
    pub fn new(shading: &'a PixelShading, place: usize) -> Option<Self> {
        let triangle = shading.triangles.get(place)?;
        let cosines = match shading.method {
            PixelMethod::Phong => Vec::new(),
            PixelMethod::FastPhong => Self::of_lights(shading, triangle),
        };
        Some(Self { shading, triangle, texture: shading.texture(triangle).map(|image| &**image), cosines })
    }

    fn of_lights(shading: &PixelShading, triangle: &PixelTriangle) -> Vec<Cosines> {
        let PixelTriangle { normals, positions, .. } = *triangle;
        let middle = (positions[0] + positions[1] + positions[2]) / 3.0;
        let of = |light: &Light| {
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
        self.color_by(fragment, self.texel(fragment))
    }

    /// The same with this texel for its own; it is white where there is no texture.
    pub fn color_by<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>, texel: DVec3) -> [f64; 3] {
        let (shares, surface) = (fragment.shares(), DVec3::from(fragment.rgb()) * texel);
        let color = match self.shading.method {
            PixelMethod::Phong => {
                let PixelTriangle { normals, positions, .. } = *self.triangle;
                let (position, normal) = (mean(positions, &shares), mean(normals, &shares));
                self.shading.color(self.triangle, position, normal, surface)
            }
            PixelMethod::FastPhong => self.sum(&self.lit(&shares), surface, 0),
        };
        color.to_array()
    }

    /// Where a pixel lies in the texture, u to the right and v up; `None` without one.
    pub fn place<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> Option<DVec2> {
        self.texture.map(|_| mean(self.triangle.texture, &fragment.shares()))
    }

    /// The texel at a pixel.
    pub fn texel<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> DVec3 {
        let place = self.place(fragment);
        self.texture.zip(place).map_or(DVec3::ONE, |(image, place)| image.nearest(place))
    }

    /// N·L and N·H of each light at a pixel; those of fast Phong are not cut.
    pub fn cosines<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> Vec<[f64; 2]> {
        self.lit(&fragment.shares())
            .into_iter()
            .map(|Lit { diffuse, halfway, .. }| [diffuse, halfway])
            .collect()
    }

    /// The colours that the pixel may have for one who knows the cosines N·L to within `doubt`: for each light whose N·L is
    /// no farther from 0, as if it stood above the horizon and as if below. The first is that of [`Self::color_by`].
    pub fn branches<const N: usize, W: Weight>(
        &self,
        fragment: &Fragment<N, W>,
        texel: DVec3,
        doubt: f64,
    ) -> Vec<[f64; 3]> {
        let lights = self.lit(&fragment.shares());
        let surface = DVec3::from(fragment.rgb()) * texel;
        let mut turned = vec![0];
        for (light, lit) in lights.iter().enumerate().take(MOST_TURNED) {
            if lit.diffuse.abs() <= doubt {
                let others: Vec<u64> = turned.iter().map(|set| set | 1 << light).collect();
                turned.extend(others);
            }
        }
        let others = turned[1..].iter().map(|set| self.sum(&lights, surface, *set).to_array());
        [self.color_by(fragment, texel)].into_iter().chain(others).collect()
    }

    /// The cosines of each light where the vertices weigh `shares`.
    fn lit(&self, shares: &[f64]) -> Vec<Lit> {
        let of_nodes = |light: &Cosines| Lit {
            intensity: light.intensity,
            diffuse: six_point_at(shares, &light.diffuse),
            halfway: six_point_at(shares, &light.halfway),
        };
        if self.shading.method == PixelMethod::FastPhong {
            return self.cosines.iter().map(of_nodes).collect();
        }
        let PixelTriangle { normals, positions, .. } = *self.triangle;
        let (normal, position) = (mean(normals, shares).normalize_or_zero(), mean(positions, shares));
        let viewer = self.shading.viewer_at(position);
        let of_normal = |light: &Light| {
            let incident = light.incident(position);
            let halfway = (incident.toward + viewer).normalize_or_zero();
            let [diffuse, halfway] = [incident.toward, halfway].map(|direction| normal.dot(direction));
            Lit { intensity: incident.intensity, diffuse, halfway }
        };
        self.shading.lights.iter().map(of_normal).collect()
    }

    /// I_e + c k_a I_a + sum of I_l (c k_d D + k_s f(H)^n) over the lights with D > 0; those in the set `turned` as if on the
    /// other side of the horizon.
    fn sum(&self, lights: &[Lit], surface: DVec3, turned: u64) -> DVec3 {
        let material = self.shading.material(self.triangle, surface);
        let part = |(place, Lit { intensity, diffuse, halfway }): (usize, &Lit)| {
            if (*diffuse <= 0.0) != (turned >> place & 1 == 1) {
                return DVec3::ZERO;
            }
            // The quadratics go beyond 0 and 1.
            let power = PowerTable::exact(self.shading.specular, material.exponent, halfway.clamp(0.0, 1.0));
            *intensity * (material.diffuse * diffuse.clamp(0.0, 1.0) + material.specular * power)
        };
        let sum: DVec3 = lights.iter().enumerate().map(part).sum();
        (material.emission + material.ambient * self.shading.ambient + sum).clamp(DVec3::ZERO, DVec3::ONE)
    }
}

/// Lights of which both sides of the horizon are given: no machine has more at once, and all their sides are combined.
const MOST_TURNED: usize = 8;

/// A mean over the triangle.
fn mean<V>(values: [V; 3], shares: &[f64]) -> V
where
    V: Copy + Default + Add<Output = V> + Mul<f64, Output = V>,
{
    values.iter().zip(shares).fold(V::default(), |sum, (value, share)| sum + *value * *share)
}
