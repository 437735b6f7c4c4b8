//! Surfaces of two parameters: sphere and torus, and the net of faces they share.

use super::{Face, FaceData, Material, Mesh};
use crate::error::InputError;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A sphere of radius 1 about the origin, poles up and down: `columns` >= 3 round the equator, `rows` >= 2 from pole to
/// pole.
pub(crate) fn sphere(columns: u32, rows: u32) -> Result<Mesh, InputError> {
    let mut positions = vec![DVec3::Y, DVec3::NEG_Y];
    for row in 1..rows {
        let (from_pole, height) = (PI * f64::from(row) / f64::from(rows)).sin_cos();
        positions.extend((0..columns).map(|column| {
            let (sin, cos) = (TAU * f64::from(column) / f64::from(columns)).sin_cos();
            DVec3::new(from_pole * sin, height, from_pole * cos)
        }));
    }
    let ring = |row: u32, column: u32| 2 + (row - 1) * columns + column % columns;
    let place = |row: u32, column: f64| {
        DVec2::new(column / f64::from(columns), 1.0 - f64::from(row) / f64::from(rows))
    };
    let mut faces = Vec::new();
    let mut texture = Vec::new();
    for column in 0..columns {
        let [left, middle, right] = [0.0, 0.5, 1.0].map(|along| f64::from(column) + along);
        faces.push(face([0, ring(1, column), ring(1, column + 1)]));
        texture.push([place(0, middle), place(1, left), place(1, right)]);
        faces.push(face([1, ring(rows - 1, column + 1), ring(rows - 1, column)]));
        texture.push([place(rows, middle), place(rows - 1, right), place(rows - 1, left)]);
        for row in 1..rows - 1 {
            let [a, b] = [ring(row, column), ring(row, column + 1)];
            faces.extend(quad([a, ring(row + 1, column), ring(row + 1, column + 1), b]));
            let below = row + 1;
            texture.extend(halves([
                place(row, left),
                place(below, left),
                place(below, right),
                place(row, right),
            ]));
        }
    }
    let clay = Material::matte(DVec3::new(0.85, 0.45, 0.3));
    let glazed = Material { specular: DVec3::splat(0.4), exponent: 24.0, ..clay };
    Ok(Mesh::new("sphere", positions, faces, vec![glazed])?.with_face_data(textured(texture)))
}

/// A torus about the vertical axis: radius 1 to the middle of the tube, whose own radius is 0.4.
pub(crate) fn torus(around: u32, across: u32) -> Result<Mesh, InputError> {
    let (positions, faces, texture) = closed_net(around, across, |u, v| {
        let ((around_sin, around_cos), (across_sin, across_cos)) = (u.sin_cos(), v.sin_cos());
        let reach = 1.0 + 0.4 * across_cos;
        DVec3::new(reach * around_sin, 0.4 * across_sin, reach * around_cos)
    });
    let brass = Material::matte(DVec3::new(0.8, 0.65, 0.25));
    let polished = Material { specular: DVec3::new(0.5, 0.45, 0.3), exponent: 32.0, ..brass };
    Ok(Mesh::new("torus", positions, faces, vec![polished])?.with_face_data(texture))
}

/// A surface closed both ways: `point` of two angles in [0, 2 pi). The front is outside if the first angle, the second
/// and the outward normal form a right-handed system. u and v of the texture run once along each angle.
pub(super) fn closed_net(
    columns: u32,
    rows: u32,
    point: impl Fn(f64, f64) -> DVec3,
) -> (Vec<DVec3>, Vec<Face>, Vec<FaceData>) {
    let angle = |k: u32, count: u32| TAU * f64::from(k) / f64::from(count);
    let mut positions = Vec::new();
    let mut faces = Vec::new();
    let mut texture = Vec::new();
    for column in 0..columns {
        for row in 0..rows {
            positions.push(point(angle(column, columns), angle(row, rows)));
            let place = |column: u32, row: u32| column % columns * rows + row % rows;
            faces.extend(quad([
                place(column, row),
                place(column + 1, row),
                place(column + 1, row + 1),
                place(column, row + 1),
            ]));
            let part = |column: u32, row: u32| {
                DVec2::new(f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows))
            };
            let sides = [(0, 0), (1, 0), (1, 1), (0, 1)];
            texture.extend(halves(sides.map(|(right, up)| part(column + right, row + up))));
        }
    }
    (positions, faces, textured(texture))
}

/// The texture coordinates of the two faces of [`quad`].
fn halves([a, b, c, d]: [DVec2; 4]) -> [[DVec2; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn textured(texture: Vec<[DVec2; 3]>) -> Vec<FaceData> {
    let data = |texture| FaceData { texture: Some(texture), ..FaceData::default() };
    texture.into_iter().map(data).collect()
}

/// Two faces, corners counter-clockwise from the front.
pub(super) fn quad([a, b, c, d]: [u32; 4]) -> [Face; 2] {
    [face([a, b, c]), face([a, c, d])]
}

fn face(corners: [u32; 3]) -> Face {
    Face { corners, material: 0 }
}
