//! A light at a point as LAMP takes it: the unit of the ways to it, its three tables, and what these and the products may err by
//! (`docs/machine.md`, section 17; bound 17 of `docs/numerics.md`).
//!
//! ```text
//!  ways of all triangles ──longest, nearest──> unit, full light ──> tables A, C, and EDGE
//!                                                                     └─ every place in them tried ─> errors
//! ```

use super::roots;
use crate::advice::OR_GOLDEN;
use anyhow::{Result, anyhow};
use edgewalk_machine::Plan;
use edgewalk_scene::{Attenuation, Light, PixelShading, PixelTriangle};
use glam::DVec3;

/// 1.0 in LAMP.
const ONE: f64 = 65536.0;

/// What is left below 1 for l·l.
const BELOW_ONE: f64 = 1.0 / (1 << 14) as f64;

/// EDGE of a light without an axis: nothing lies beyond it.
const NO_EDGE: u32 = (1 << 17) - 1;

/// Entries of a table of attenuation for each exponent, and the first that is used.
const FIRST: u32 = 16;
const ENTRIES: u32 = 64;

/// A light at a point.
#[derive(Clone, Debug)]
pub struct Point {
    position: DVec3,
    attenuation: Attenuation,
    beam: Option<Beam>,
    /// The longest way and a little more, in the world.
    unit: f64,
    /// The nearest place of a triangle, in units.
    nearest: f64,
    /// The attenuation there.
    pub full: f64,
    /// What the tables A and C err by, 2^-16.
    attenuation_error: f64,
    beam_error: f64,
    root_error: f64,
}

/// What a flood has besides.
#[derive(Clone, Copy, Debug)]
struct Beam {
    axis: DVec3,
    /// Cosine of half the opening angle.
    edge: f64,
    exponent: f64,
}

impl Beam {
    fn at(&self, cosine: f64) -> f64 {
        cosine.max(0.0).powf(self.exponent)
    }
}

/// How far what LAMP gives may be from the exact, 2^-16; `None` where nothing is proved but the whole range.
#[derive(Clone, Copy, Debug, Default)]
pub struct LampErrors {
    /// Of N·L.
    pub diffuse: Option<f64>,
    /// Of N·H.
    pub halfway: Option<f64>,
    /// Of what is left of the light.
    pub beam: f64,
    /// Of the cosine to the axis.
    pub axis: f64,
}

/// What the words of the terms of a triangle may err by, in their last bits.
#[derive(Clone, Copy, Debug)]
pub struct WordErrors {
    /// Of degree 1 and of degree 2.
    pub linear: f64,
    pub quadratic: f64,
    /// Of the values that they go through.
    pub node: f64,
}

impl Point {
    /// The light of a frame, if it stands at a point.
    ///
    /// # Errors
    /// One far away, one that the tables cannot hold.
    pub fn of(light: &Light, shading: &PixelShading) -> Result<Point> {
        let (position, attenuation, beam) = match *light {
            Light::Directional { .. } => {
                return Err(anyhow!(
                    "a directional light: with shade.light = positional lights stand at a point; add --set shade.light=directional{OR_GOLDEN}"
                ));
            }
            Light::Positional { position, attenuation, .. } => (position, attenuation, None),
            Light::Flood { position, axis, cone, exponent, attenuation, .. } => {
                if exponent > 0.0 && exponent < 1.0 {
                    return Err(anyhow!(
                        "exponent {exponent} of a flood: the machine's table of the beam wants 0, or 1 and more; take 1"
                    ));
                }
                (position, attenuation, Some(Beam { axis, edge: cone.cos(), exponent }))
            }
        };
        let ways = |own: &PixelTriangle| own.positions.map(|place| position - place);
        let lengths = || shading.triangles.iter().flat_map(ways).map(DVec3::length);
        let farthest = lengths().fold(0.0, f64::max);
        let nearest = shading.triangles.iter().map(|own| shortest(ways(own))).fold(farthest, f64::min);
        let unit = if farthest > 0.0 { farthest / (1.0 - BELOW_ONE).sqrt() } else { 1.0 };
        let full = attenuation.factor(nearest);
        let nearest = nearest / unit;
        let mut point = Point {
            position,
            attenuation,
            beam,
            unit,
            nearest,
            full,
            attenuation_error: 0.0,
            beam_error: 0.0,
            root_error: roots::relative_error(),
        };
        point.attenuation_error = point.worst_attenuation();
        point.beam_error = point.worst_beam();
        Ok(point)
    }

    /// l at the vertices of a triangle, and in the middles of the edges opposite them.
    pub fn ways(&self, own: &PixelTriangle) -> [[DVec3; 3]; 2] {
        let ways = own.positions.map(|place| (self.position - place) / self.unit);
        [ways, [0, 1, 2].map(|k: usize| (ways[(k + 1) % 3] + ways[(k + 2) % 3]) / 2.0)]
    }

    /// -axis·l at the vertices of a triangle.
    pub fn along(&self, own: &PixelTriangle) -> [f64; 3] {
        self.ways(own)[0].map(|way| self.beam.map_or(0.0, |beam| -beam.axis.dot(way)))
    }

    /// The attenuation where l·l, in units, is x, of the full light.
    fn attenuation(&self, x: f64) -> f64 {
        (self.attenuation.factor(self.unit * x.sqrt()) / self.full).min(1.0)
    }

    /// What the cone lets through `beside` below a cosine of 1.
    fn beam(&self, beside: f64) -> f64 {
        self.beam.map_or(1.0, |beam| beam.at(1.0 - beside))
    }

    fn edge(&self) -> u32 {
        self.beam.map_or(NO_EDGE, |beam| ((1.0 - beam.edge) * ONE).floor() as u32) // at most 2^16
    }

    /// Where entry `k` of table A with this exponent stands.
    fn place(k: u32, exponent: u32) -> f64 {
        f64::from(k) / f64::from(ENTRIES) / f64::from(1u32 << (2 * exponent))
    }

    fn of_attenuation(&self, exponent: u32, k: u32) -> [u32; 2] {
        chord(Self::place(k, exponent), Self::place(k + 1, exponent), |x| self.attenuation(x))
    }

    fn of_beam(&self, k: u32) -> [u32; 2] {
        chord(f64::from(k) / 256.0, f64::from(k + 1) / 256.0, |beside| self.beam(beside))
    }

    /// The words of the memory of the roots.
    pub fn words(&self, machine: &Plan) -> Vec<u128> {
        let mut words = roots::words(machine);
        words[0] = machine.root_word(self.edge(), 0);
        words.extend((0..256).map(|k| self.of_beam(k)).map(|[v, slope]| machine.root_word(v, slope)));
        for exponent in 0..8 {
            words.extend((0..ENTRIES).map(|k| {
                let [v, slope] = if k < FIRST { [0, 0] } else { self.of_attenuation(exponent, k) };
                machine.root_word(v, slope)
            }));
        }
        words
    }

    /// Every place in table A, but for those nearer than any triangle.
    fn worst_attenuation(&self) -> f64 {
        let mut worst = 0f64;
        for exponent in 0..8 {
            for k in FIRST..ENTRIES {
                let entry = self.of_attenuation(exponent, k);
                for low in 0..1024 {
                    let m = f64::from(1024 * k + low);
                    let x = |m: f64| m / ONE / f64::from(1u32 << (2 * exponent));
                    if x(m + 1.0) >= self.nearest * self.nearest {
                        let said = look(entry, low);
                        // The exact number is this one, or up to one more.
                        for exact in [m, m + 1.0] {
                            worst = worst.max((said - self.attenuation(x(exact)) * ONE).abs());
                        }
                    }
                }
            }
        }
        worst
    }

    /// Every place in table C within the cone.
    fn worst_beam(&self) -> f64 {
        let within = |beside: &u32| *beside <= self.edge().min(0xffff);
        let off = |beside: u32| {
            let said = look(self.of_beam(beside / 256), beside % 256 * 4);
            (said - self.beam(f64::from(beside) / ONE) * ONE).abs()
        };
        (0..1 << 16).filter(within).map(off).fold(0.0, f64::max)
    }

    /// Bound 17 for a triangle, seen from `toward`, a unit vector.
    pub fn errors(&self, own: &PixelTriangle, toward: DVec3, words: WordErrors) -> LampErrors {
        let WordErrors { linear, quadratic, node } = words;
        let [ways, _] = self.ways(own);
        let near = shortest(ways);
        // Of l·l, of 1.
        let square = (quadratic + 1.0) / (1u64 << 30) as f64 + node;
        let least = near * near - square;
        if least < 2.0 / ONE {
            return LampErrors { beam: ONE, axis: ONE, ..LampErrors::default() };
        }
        let relative = self.root_error + 1.01 * square / (2.0 * least);
        // A product over the way: its word, what is rounded before the root, the root, what is rounded behind it.
        let over_way = |word: f64| {
            let word = (word + 0.5) / 128.0 + node * ONE;
            (1.0 + relative) * (word / least.sqrt() + 1.0) + ONE * relative + 0.5
        };
        let (toward_light, way) = (over_way(quadratic), over_way(linear));
        let attenuation = self.attenuation_error + 1.01 * ONE * square / least;
        let slope = self.beam.map_or(0.0, |beam| beam.exponent);
        let beam = 1.01 * (attenuation + self.beam_error + slope * way) + 0.5;
        let of_light = LampErrors { beam, axis: way + 1.0, ..LampErrors::default() };

        let shortest = shortest(own.normals);
        let square = quadratic + node * ONE;
        let least = shortest * shortest * ONE - square - 1.0;
        if least < ONE / 4.0 {
            return of_light;
        }
        let relative = self.root_error + 1.01 * square / (2.0 * least);
        let root = (ONE / least).sqrt() * (1.0 + relative);
        let diffuse = toward_light * root + ONE * relative + 0.5;
        let viewed = ((linear + 0.5) / 128.0 + node * ONE + 0.5) * root + ONE * relative + 0.5;
        let of_normal = LampErrors { diffuse: Some(diffuse), ..of_light };

        // The light may stand behind what is seen from: 1 + L·V, at least.
        let along = ways.map(|way| way.dot(toward)).into_iter().fold(f64::INFINITY, f64::min);
        let farthest = ways.map(DVec3::length).into_iter().fold(0.0, f64::max);
        let least = along / if along < 0.0 { near } else { farthest };
        let both = (1.0 + least.max(-1.0)) * ONE - way;
        if both < 4.0 * way {
            return of_normal;
        }
        let relative = self.root_error + 1.01 * way / (2.0 * both);
        let root = (2.0 * ONE / both).sqrt() * (1.0 + relative);
        let halfway = (diffuse + viewed) / 2.0 * root + 1.0 + relative + ONE * relative + 0.5;
        LampErrors { halfway: Some(halfway), ..of_normal }
    }
}

/// v and slope, 2^-16: the chord of a function of 0 to 1 that does not rise, lowered by half of what it lies above the function.
fn chord(from: f64, to: f64, function: impl Fn(f64) -> f64) -> [u32; 2] {
    let (low, high) = (function(from), function(to));
    let gap = (low + high) / 2.0 - function((from + to) / 2.0);
    let v = ((low - gap / 2.0) * ONE).round().clamp(0.0, ONE) as u32;
    [v, (((low - high) * ONE).round() as u32).min(v).min(0xffff)]
}

/// What the machine finds between two entries, 2^-16.
fn look([v, slope]: [u32; 2], low: u32) -> f64 {
    f64::from(v) - f64::from((slope * low + 512) / 1024)
}

/// The length of the shortest vector over a triangle: how far 0 is from the triangle that its three span.
pub fn shortest(vectors: [DVec3; 3]) -> f64 {
    let sides = [0, 1, 2].map(|k| [vectors[k], vectors[(k + 1) % 3]]);
    let to_side = |[a, b]: [DVec3; 2]| {
        let along = b - a;
        let part = (-a.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (a + part * along).length()
    };
    let least = sides.into_iter().map(to_side).fold(f64::INFINITY, f64::min);
    let across = (vectors[1] - vectors[0]).cross(vectors[2] - vectors[0]);
    let Some(direction) = across.try_normalize() else { return least };
    let height = direction.dot(vectors[0]);
    let inside = sides.into_iter().all(|[a, b]| (b - a).cross(height * direction - a).dot(direction) >= 0.0);
    if inside { height.abs() } else { least }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_vector_lies_in_the_middle_on_an_edge_or_at_a_corner() {
        let tilted = |x: f64, y: f64| DVec3::new(x, y, 1.0).normalize();
        let around = [tilted(1.0, 0.0), tilted(-0.5, 0.75f64.sqrt()), tilted(-0.5, -(0.75f64.sqrt()))];
        assert!((shortest(around) - 0.5f64.sqrt()).abs() < 1e-12);
        assert!((shortest([DVec3::X, DVec3::Y, DVec3::X]) - 0.5f64.sqrt()).abs() < 1e-12);
        assert!((shortest([DVec3::X; 3]) - 1.0).abs() < 1e-12);
        assert!(shortest([DVec3::X, -DVec3::X, DVec3::Y]) < 1e-12);
        let mut least = f64::INFINITY;
        let list = [tilted(0.9, 0.3), tilted(-0.2, 0.8), tilted(0.1, -0.7)];
        for (i, j) in (0..=400).flat_map(|i| (0..=400 - i).map(move |j| (i, j))) {
            let [a, b] = [i, j].map(|k: i32| f64::from(k) / 400.0);
            least = least.min((list[0] * a + list[1] * b + list[2] * (1.0 - a - b)).length());
        }
        assert!(shortest(list) <= least && least - shortest(list) < 1e-4, "{least}");
    }
}
