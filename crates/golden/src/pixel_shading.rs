//! The colour of a pixel by the equation there: Phong and fast Phong of a frame that has normals.
//!
//! All is a mean over the triangle, by what its vertices weigh at the pixel; nothing is stepped.

use crate::fast_phong::six_point::{nodes, six_point_at};
use crate::fast_phong::table::PowerTable;
use crate::fragment::{Fragment, Weight};
use edgewalk_scene::{Image, Light, PixelMethod, PixelShading, PixelTriangle};
use glam::{DVec2, DVec3};
use std::ops::{Add, Mul};

/// What its pictures say of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texel {
    /// Of the texture; white without one.
    pub color: DVec3,
    /// B_u and B_v of the relief, per unit of u and of v; 0 without one.
    pub slopes: DVec2,
}

impl Texel {
    /// Where there is no picture.
    pub const BLANK: Self = Self { color: DVec3::ONE, slopes: DVec2::ZERO };
}

/// A triangle about to be shaded.
pub struct PixelBrush<'a> {
    shading: &'a PixelShading,
    triangle: &'a PixelTriangle,
    texture: Option<&'a Image>,
    relief: Option<&'a Image>,
    /// Of the lights in their order; none for Phong.
    cosines: Vec<Cosines>,
}

/// A light's cosines, each by its values at the vertices and at the middles of the edges opposite them.
struct Cosines {
    /// In the middle of the triangle.
    intensity: DVec3,
    diffuse: [[f64; 3]; 2],
    halfway: [[f64; 3]; 2],
    /// What they grow by at the vertices, for slopes of 1 along u and along v: of N·L, and of N·H.
    turns: [[[f64; 3]; 2]; 2],
}

/// A light at a pixel: its intensity, N·L and N·H.
#[derive(Clone, Copy)]
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
        let [texture, relief] = [shading.texture(triangle), shading.relief(triangle)]
            .map(|picture| picture.map(|image| &**image));
        Some(Self { shading, triangle, texture, relief, cosines })
    }

    fn of_lights(shading: &PixelShading, triangle: &PixelTriangle) -> Vec<Cosines> {
        let PixelTriangle { normals, positions, turns, .. } = *triangle;
        let middle = (positions[0] + positions[1] + positions[2]) / 3.0;
        let of = |light: &Light| {
            let toward = |position| light.incident(position).toward;
            let halfway = |position| (toward(position) + shading.viewer_at(position)).normalize_or_zero();
            let turned = |turn: DVec3, direction: DVec3, normal: DVec3| {
                normal.normalize_or_zero().cross(turn).dot(direction)
            };
            let of_light = |turn: DVec3| [0, 1, 2].map(|k| turned(turn, toward(positions[k]), normals[k]));
            let of_halfway = |turn: DVec3| [0, 1, 2].map(|k| turned(turn, halfway(positions[k]), normals[k]));
            Cosines {
                intensity: light.incident(middle).intensity,
                turns: [turns.map(of_light), turns.map(of_halfway)],
                diffuse: nodes(normals, positions, |n, p| n.dot(toward(p))),
                halfway: nodes(normals, positions, |n, p| n.dot(halfway(p))),
            }
        };
        shading.lights.iter().map(of).collect()
    }

    /// The colour at a pixel of the triangle, each in [0, 1].
    pub fn color<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> [f64; 3] {
        self.color_by(fragment, &self.texel(fragment))
    }

    /// Like `color`, with this texel for its own.
    pub fn color_by<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>, texel: &Texel) -> [f64; 3] {
        let (shares, surface) = (fragment.shares(), DVec3::from(fragment.rgb()) * texel.color);
        let color = match self.shading.method {
            PixelMethod::Phong => {
                let position = mean(self.triangle.positions, &shares);
                self.shading.color(self.triangle, position, self.normal(&shares, texel), surface)
            }
            PixelMethod::FastPhong => self.sum(&self.lit(&shares, texel), surface, 0),
        };
        color.to_array()
    }

    /// Where a pixel lies in texture and relief, u to the right and v up; `None` without both.
    pub fn place<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> Option<DVec2> {
        self.texture.or(self.relief).map(|_| mean(self.triangle.texture, &fragment.shares()))
    }

    /// The texel at a pixel.
    pub fn texel<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> Texel {
        let Some(place) = self.place(fragment) else { return Texel::BLANK };
        Texel {
            color: self.texture.map_or(DVec3::ONE, |image| image.nearest(place)),
            slopes: self.relief.map_or(DVec2::ZERO, |image| image.slope(place)),
        }
    }

    /// N, of no certain length, turned by the relief: N + N x (B_u T_u + B_v T_v).
    fn normal(&self, shares: &[f64], texel: &Texel) -> DVec3 {
        let (normal, [along_u, along_v]) = (mean(self.triangle.normals, shares), self.triangle.turns);
        normal + normal.cross(texel.slopes.x * along_u + texel.slopes.y * along_v)
    }

    /// N·L and N·H of each light at a pixel with this texel; those of fast Phong are not cut.
    pub fn cosines<const N: usize, W: Weight>(
        &self,
        fragment: &Fragment<N, W>,
        texel: &Texel,
    ) -> Vec<[f64; 2]> {
        self.lit(&fragment.shares(), texel)
            .into_iter()
            .map(|Lit { diffuse, halfway, .. }| [diffuse, halfway])
            .collect()
    }

    /// I_l of each light at a pixel, in Phong; in fast Phong in the middle of the triangle.
    pub fn intensities<const N: usize, W: Weight>(&self, fragment: &Fragment<N, W>) -> Vec<DVec3> {
        self.lit(&fragment.shares(), &Texel::BLANK).into_iter().map(|lit| lit.intensity).collect()
    }

    /// The colours that the pixel may have for one who knows the cosines N·L to within `doubt`: for each light whose N·L is
    /// no farther from 0, as if it stood above the horizon and as if below; and the cosine to a light's axis to within `axis_doubt`: for
    /// each light next to the edge of whose cone the pixel lies inside and outside. The first is that of [`Self::color_by`].
    pub fn branches<const N: usize, W: Weight>(
        &self,
        fragment: &Fragment<N, W>,
        texel: &Texel,
        doubt: f64,
        axis_doubt: f64,
    ) -> Vec<[f64; 3]> {
        let shares = fragment.shares();
        let lights = self.lit(&shares, texel);
        let surface = DVec3::from(fragment.rgb()) * texel.color;
        let mut sides: Vec<Vec<Lit>> = vec![lights];
        // Beside the edge of a cone, each light by itself.
        let opened =
            [axis_doubt, -axis_doubt].map(|by| self.lit_by(&shares, texel, |light| light.opened(by)));
        for light in 0..sides[0].len().min(MOST_TURNED) {
            for other in opened.iter().map(|lights| lights[light]) {
                if other.intensity != sides[0][light].intensity {
                    let mut others = sides.clone();
                    others.iter_mut().for_each(|lights| lights[light] = other);
                    sides.extend(others);
                }
            }
        }
        let lights = &sides[0];
        let mut turned = vec![0];
        for (light, lit) in lights.iter().enumerate().take(MOST_TURNED) {
            if lit.diffuse.abs() <= doubt {
                let others: Vec<u64> = turned.iter().map(|set| set | 1 << light).collect();
                turned.extend(others);
            }
        }
        let all = sides.iter().flat_map(|lights| turned.iter().map(move |set| (lights, *set)));
        let others = all.skip(1).map(|(lights, set)| self.sum(lights, surface, set).to_array());
        [self.color_by(fragment, texel)].into_iter().chain(others).collect()
    }

    /// The cosines of each light where the vertices weigh `shares`. In fast Phong a relief counts to first order, linear between
    /// the vertices.
    fn lit(&self, shares: &[f64], texel: &Texel) -> Vec<Lit> {
        self.lit_by(shares, texel, |light| light)
    }

    /// Like `lit`, by lights that are changed, in Phong.
    fn lit_by(&self, shares: &[f64], texel: &Texel, changed: impl Fn(Light) -> Light) -> Vec<Lit> {
        let turned = |[along_u, along_v]: [[f64; 3]; 2]| {
            texel.slopes.x * mean(along_u, shares) + texel.slopes.y * mean(along_v, shares)
        };
        let of_nodes = |light: &Cosines| Lit {
            intensity: light.intensity,
            diffuse: six_point_at(shares, &light.diffuse) + turned(light.turns[0]),
            halfway: six_point_at(shares, &light.halfway) + turned(light.turns[1]),
        };
        if self.shading.method == PixelMethod::FastPhong {
            return self.cosines.iter().map(of_nodes).collect();
        }
        let normal = self.normal(shares, texel).normalize_or_zero();
        let position = mean(self.triangle.positions, shares);
        let viewer = self.shading.viewer_at(position);
        let of_normal = |light: &Light| {
            let incident = changed(*light).incident(position);
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
