//! A closed room with boxes in it, seen from within.

use super::surface::quad;
use super::{Face, Material, Mesh};
use crate::error::InputError;
use glam::DVec3;

/// Low corner, high corner, and turn about the vertical axis in radians of each box on the floor.
const BOXES: [([f64; 3], [f64; 3], f64); 3] = [
    ([-0.75, -1.0, -0.8], [-0.15, 0.3, -0.2], 0.3),
    ([0.1, -1.0, -0.3], [0.65, -0.45, 0.25], -0.35),
    ([0.2, -0.45, -0.2], [0.5, -0.15, 0.1], 0.2),
];

/// A cube of side 2 about the origin whose inside is its front: grey, left wall red, right wall green.
pub(crate) fn room() -> Result<Mesh, InputError> {
    let materials =
        [[0.8, 0.8, 0.78], [0.75, 0.15, 0.1], [0.2, 0.6, 0.2], [0.7, 0.65, 0.5], [0.35, 0.45, 0.75]];
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    let walls = cuboid(&mut positions, DVec3::NEG_ONE, DVec3::ONE, 0.0);
    // Left and right are the first two sides. Turned over, the inside is the front.
    for (side, quad) in walls.into_iter().enumerate() {
        let material = [1, 2, 0, 0, 0, 0][side];
        faces.extend(quad.map(|Face { corners: [a, b, c], .. }| Face { corners: [a, c, b], material }));
    }
    for (index, (low, high, turn)) in BOXES.into_iter().enumerate() {
        let material = if index == 1 { 4 } else { 3 };
        let sides = cuboid(&mut positions, low.into(), high.into(), turn);
        faces.extend(sides.into_iter().flatten().map(|face| Face { material, ..face }));
    }
    let materials = materials.map(|color| Material::matte(DVec3::from(color)));
    Mesh::new("room", positions, faces, materials.to_vec())
}

/// The sides of a box turned about its own vertical axis: left, right, bottom, top, back, front.
fn cuboid(positions: &mut Vec<DVec3>, low: DVec3, high: DVec3, turn: f64) -> [[Face; 2]; 6] {
    let first = positions.len() as u32;
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let (sin, cos) = turn.sin_cos();
    // Bit 0 of a corner's number: right, bit 1: up, bit 2: front.
    positions.extend((0..8u32).map(|corner| {
        let side = |bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let p = half * DVec3::new(side(0), side(1), side(2));
        middle + DVec3::new(cos * p.x + sin * p.z, p.y, cos * p.z - sin * p.x)
    }));
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    sides.map(|side| quad(side.map(|corner| first + corner)))
}
