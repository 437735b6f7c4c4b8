//! Perspective distortion (slides, notes): what is linear in the world is not linear on the screen.

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use crate::plot::{Series, plot};
use edgewalk_golden::{Shading, Weights, fragments, shade};
use edgewalk_scene::{Camera, Face, FaceData, InputError, Material, Mesh, Scene, ShadeMode, Texture};
use glam::{DVec2, DVec3};

/// Squares of the chequer over the floor.
const SQUARES: u32 = 8;

pub(crate) fn perspective() -> anyhow::Result<Exhibit> {
    let cuts = [1, 2, 4, 8, 16, 32];
    let mut points = Vec::new();
    for parts in cuts {
        points.push((f64::from(parts).log2(), displacement(&floor(parts)?).log2()));
    }
    let shift = |k: usize| points[k].1.exp2();
    let scene = floor(1)?;
    let shaded = shade(&scene, &scene.surface(WIDTH, HEIGHT, GUARD), Shading::Phong, FILL);
    Ok(Exhibit {
        name: "perspective",
        title: "Perspective distortion (S16)",
        cause: "The middle of an edge on the screen is not the middle of the edge in the world: what is farther away is \
                shorter. Interpolating over the screen puts it there all the same, differently in each triangle, so the \
                lines of the chequer break at the diagonal. Cutting the floor into n by n parts divides the fault by about \
                n squared as soon as each part is flat enough.",
        figures: vec![
            figure("largest displacement in two triangles, squares of the chequer", shift(0), 3),
            figure("cut 8 by 8", shift(3), 3),
            figure("cut 32 by 32", shift(5), 4),
            figure("cut 16 by 16 over cut 32 by 32", shift(4) / shift(5), 2),
        ],
        views: vec![
            View::colors("screen", "Interpolated over the screen", shaded.picture.rgb),
            View::colors("truth", "Truth", shaded.truth),
            View::drawing(
                "cuts",
                "Displacement against the number of cuts",
                plot("log2 parts", "log2 squares", &[Series { label: "displacement", points }]),
            ),
        ],
    })
}

/// A floor of `parts` by `parts` quads under one chequer.
fn floor(parts: u32) -> Result<Scene, InputError> {
    let at = |k: u32| f64::from(k) / f64::from(parts);
    let place = |i: u32, j: u32| i * (parts + 1) + j;
    let (mut positions, mut faces, mut face_data) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..=parts {
        positions.extend((0..=parts).map(|j| DVec3::new(2.0 * at(i) - 1.0, 0.0, 2.0 - 4.0 * at(j))));
    }
    for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (i, j))) {
        for corners in [[(i, j), (i + 1, j), (i + 1, j + 1)], [(i, j), (i + 1, j + 1), (i, j + 1)]] {
            faces.push(Face { corners: corners.map(|(i, j)| place(i, j)), material: 0 });
            let texture = corners.map(|(i, j)| DVec2::new(at(i), at(j)));
            face_data.push(FaceData { texture: Some(texture), ..FaceData::default() });
        }
    }
    let chequer = Texture::Checker { squares: SQUARES, colors: [DVec3::ONE, DVec3::splat(0.2)] };
    let board = Material { texture: Some(0), ..Material::matte(DVec3::ONE) };
    let mesh = Mesh::new("floor", positions, faces, vec![board])?
        .with_face_data(face_data)
        .with_textures(vec![chequer]);
    let eye = DVec3::new(0.3, 0.6, 3.0);
    let camera =
        Camera { eye, target: DVec3::new(0.0, -0.1, 0.6), up: DVec3::Y, angle: 0.8, near: 0.1, far: 20.0 };
    Ok(Scene { camera, ambient: DVec3::ONE, lights: Vec::new(), ..Scene::of_mesh(mesh) })
}

/// The largest distance between where the screen and where the surface has a pixel's texture, in squares.
fn displacement(scene: &Scene) -> f64 {
    let mut largest = 0.0f64;
    for triangle in &scene.surface(WIDTH, HEIGHT, GUARD).triangles {
        fragments(&triangle.on_screen(), ShadeMode::Gouraud, 8, (WIDTH, HEIGHT), |fragment| {
            let texture = triangle.vertices.map(|vertex| vertex.texture);
            let off =
                Weights::linear(fragment).of(texture) - Weights::perspective(fragment, triangle).of(texture);
            largest = largest.max(off.length());
        });
    }
    largest * f64::from(SQUARES)
}
