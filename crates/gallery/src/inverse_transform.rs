//! L and V of a pixel (the slides): by the inverse transform of its place, beside the place that is interpolated.

use crate::exhibit::{Exhibit, GUARD, HEIGHT, LSB, SUBPIXEL_BITS, View, WIDTH, figure};
use anyhow::Result;
use edgewalk_golden::{Weights, fragments};
use edgewalk_scene::{Scene, ShadeMode, SurfaceTriangle};
use glam::{DMat4, DVec3};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/missed-highlight.toml");

/// Error shown as white, LSB.
const WHITE: f64 = 32.0;

/// Bits of the depths whose inverse transform is taken; the last is of no rounding.
const BITS: [Option<u32>; 3] = [Some(16), Some(24), None];

/// A way to the place of a pixel: its picture, and how far it is off.
#[derive(Default)]
struct Way {
    rgb: Vec<[f64; 3]>,
    /// Error of each pixel's worst colour, LSB.
    map: Vec<f64>,
    /// From the true place, in lengths of the world.
    off: f64,
}

pub(crate) fn inverse_transform() -> Result<Exhibit> {
    let scene = Scene::parse(Path::new("missed-highlight.toml"), SCENE)?;
    let back = scene.camera.to_clip(WIDTH, HEIGHT).inverse();
    let interpolated = drawn(&scene, |_, linear| linear);
    let inverse = BITS.map(|bits| drawn(&scene, |pixel, _| to_world(&back, pixel, bits)));
    let mut figures = Vec::new();
    let mut tell = |name: &str, way: &Way| {
        figures.push(figure(format!("{name}: largest distance from the true place"), way.off, 6));
        let most = way.map.iter().copied().fold(0.0, f64::max);
        figures.push(figure(format!("{name}: largest error of a colour, LSB"), most, 3));
    };
    tell("place interpolated over the screen", &interpolated);
    for (bits, way) in BITS.iter().zip(&inverse) {
        let depth =
            bits.map_or("a depth that is not rounded".to_owned(), |bits| format!("a depth of {bits} bits"));
        tell(&format!("inverse transform, {depth}"), way);
    }
    let [_, rounded, _] = inverse;
    Ok(Exhibit {
        name: "inverse-transform",
        title: "L and V by the inverse transform",
        cause: "L, V and with them the highlight of a near light need the place of a pixel in the world. The slides transform the \
                pixel's (X, Y, Z) back. That costs a matrix and a division for each pixel, and is exact but for the rounding of Z and of the \
                vertices, which are snapped to 1/256 pixel: depth is linear over the screen. Golden's Phong shading and the machine interpolate the place itself over the screen, an \
                addition for each coordinate, and err under perspective. The normal is interpolated alike in all pictures.",
        figures,
        views: vec![
            View::colors("inverse", "By the inverse transform, depth of 24 bits", rounded.rgb),
            View::colors("interpolated", "The place interpolated over the screen", interpolated.rgb),
            View::error(
                "error",
                format!("Error of the second, white at {WHITE} LSB"),
                &interpolated.map,
                WHITE,
            ),
        ],
    })
}

/// The scene with the equation at each pixel; `place` has the pixel's centre and depth, and the place interpolated over the screen.
fn drawn(scene: &Scene, place: impl Fn(DVec3, DVec3) -> DVec3) -> Way {
    let count = (WIDTH * HEIGHT) as usize;
    let mut way =
        Way { rgb: vec![scene.background.to_array(); count], map: vec![0.0; count], ..Way::default() };
    for triangle in &scene.surface(WIDTH, HEIGHT, GUARD).triangles {
        let (mode, bits) = (ShadeMode::Gouraud, SUBPIXEL_BITS);
        fragments(&triangle.on_screen(), mode, bits, (WIDTH, HEIGHT), |fragment| {
            let of = |weights: Weights| weights.of(triangle.vertices.map(|vertex| vertex.position));
            let pixel = DVec3::new(f64::from(fragment.x) + 0.5, f64::from(fragment.y) + 0.5, fragment.z());
            let (linear, truth) =
                (of(Weights::linear(fragment)), of(Weights::perspective(fragment, triangle)));
            let found = place(pixel, linear);
            let [own, right] = [found, truth].map(|place| lit(scene, triangle, place));
            let at = (fragment.y * WIDTH + fragment.x) as usize;
            way.rgb[at] = own.to_array();
            way.map[at] = LSB * (own - right).abs().max_element();
            way.off = way.off.max(found.distance(truth));
        });
    }
    way
}

/// The colour of a flat triangle at a place.
fn lit(scene: &Scene, triangle: &SurfaceTriangle, place: DVec3) -> DVec3 {
    let material = scene.mesh.materials()[scene.mesh.faces()[triangle.face as usize].material as usize];
    let point = scene.point(place, triangle.own_normal);
    scene.lighting().shade(&material, &point).clamp(DVec3::ZERO, DVec3::ONE)
}

/// The place in the world of a pixel's centre and depth, which may be rounded to so many bits.
fn to_world(back: &DMat4, pixel: DVec3, bits: Option<u32>) -> DVec3 {
    let depth = bits.map_or(pixel.z, |bits| {
        let most = f64::from(u32::MAX >> (32 - bits));
        (pixel.z * most).round() / most
    });
    let [x, y] = [pixel.x / f64::from(WIDTH), pixel.y / f64::from(HEIGHT)];
    back.project_point3(DVec3::new(2.0 * x - 1.0, 1.0 - 2.0 * y, depth))
}
