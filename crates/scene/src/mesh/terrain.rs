//! A landscape: heights from lattice noise, the same on every machine as no library function is in it.

use super::{Face, Material, Mesh};
use crate::error::InputError;
use glam::DVec3;

/// Octaves of noise: each twice as fine and half as high as the one before.
const OCTAVES: u32 = 5;

/// Which landscape.
const SEED: u32 = 40;

/// A square of side 2 about the origin, `side` by `side` cells, heights about 0.
pub(crate) fn terrain(side: u32) -> Result<Mesh, InputError> {
    let coordinate = |k: u32| 2.0 * f64::from(k) / f64::from(side) - 1.0;
    let mut positions = Vec::new();
    for row in 0..=side {
        for column in 0..=side {
            let (x, z) = (coordinate(column), coordinate(row));
            positions.push(DVec3::new(x, height(x, z), z));
        }
    }
    let place = |column: u32, row: u32| row * (side + 1) + column;
    let mut faces = Vec::new();
    for row in 0..side {
        for column in 0..side {
            let [a, b, c, d] =
                [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(right, down)| place(column + right, row + down));
            for corners in [[a, b, c], [a, c, d]] {
                let middle: f64 = corners.iter().map(|corner| positions[*corner as usize].y / 3.0).sum();
                let material = LEVELS.iter().filter(|(from, _)| middle >= *from).count() as u32 - 1;
                faces.push(Face { corners, material });
            }
        }
    }
    let materials = LEVELS.map(|(_, color)| Material::matte(DVec3::from(color)));
    Mesh::new("terrain", positions, faces, materials.to_vec())
}

/// Colours from a height on: sand, meadow, rock, snow.
const LEVELS: [(f64, [f64; 3]); 4] = [
    (f64::NEG_INFINITY, [0.76, 0.68, 0.45]),
    (-0.08, [0.35, 0.55, 0.25]),
    (0.04, [0.5, 0.46, 0.42]),
    (0.13, [0.95, 0.95, 0.97]),
];

fn height(x: f64, z: f64) -> f64 {
    let octave = |k: u32| {
        let fine = f64::from(1u32 << k);
        noise(1.5 * fine * (x + 1.0), 1.5 * fine * (z + 1.0), SEED + k) / fine
    };
    0.25 * (0..OCTAVES).map(octave).sum::<f64>()
}

/// Smooth between random values at integer points, in [-1, 1]; x and z are not negative.
fn noise(x: f64, z: f64, seed: u32) -> f64 {
    let (column, row) = (x.floor(), z.floor());
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (right, down) = (smooth(x - column), smooth(z - row));
    let at = |right: u32, down: u32| random(column as u32 + right, row as u32 + down, seed);
    let mix = |from: f64, to: f64, t: f64| from + t * (to - from);
    mix(mix(at(0, 0), at(1, 0), right), mix(at(0, 1), at(1, 1), right), down)
}

/// A value in [-1, 1) that looks random, by multiplication and shifts.
fn random(x: u32, z: u32, seed: u32) -> f64 {
    let mut hash = x.wrapping_mul(0x9e37_79b1) ^ z.wrapping_mul(0x85eb_ca77) ^ seed.wrapping_mul(0xc2b2_ae3d);
    hash = (hash ^ (hash >> 15)).wrapping_mul(0x2c1b_3c6d);
    hash = (hash ^ (hash >> 12)).wrapping_mul(0x297a_2d39);
    f64::from(hash ^ (hash >> 15)) / f64::from(1u32 << 31) - 1.0
}
