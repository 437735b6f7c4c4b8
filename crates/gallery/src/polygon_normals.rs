//! Phong shading of a polygon by its active edges (the slides): normals along the edges, then along the scan line.

use crate::exhibit::{Exhibit, HEIGHT, LSB, SUBPIXEL_BITS, View, WIDTH, figure};
use crate::orientation::{corners, middle};
use edgewalk_golden::polygon::{EdgeTable, Grid, fragments as polygon_fragments};
use edgewalk_golden::{Fragment, Weight, fragments};
use edgewalk_scene::{Light, Lighting, Material, Point, Polygon, ShadeMode, Specular, Triangle, Vertex};
use glam::DVec3;

/// Normals at the corners of a square that is bent like a saddle, and of one that bulges like a ball.
const SADDLE: [[f64; 2]; 4] = [[0.5, 0.0], [-0.5, 0.0], [0.5, 0.0], [-0.5, 0.0]];
const BALL: [[f64; 2]; 4] = [[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4]];

pub(crate) fn polygon_normals() -> Exhibit {
    let turned = |normals: [[f64; 2]; 4], degrees: f64| along_edges(&square(normals, degrees));
    let range = |normals: [[f64; 2]; 4]| {
        let all = (0..=90).map(|degrees| middle(&turned(normals, f64::from(degrees))));
        let (low, high) = all.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
        high - low
    };
    let [upright, slanted, standing] = [0.0, 30.0, 45.0].map(|degrees| turned(SADDLE, degrees));
    let halves = in_triangles(&square(SADDLE, 0.0));
    Exhibit {
        name: "polygon-normals",
        title: "Phong shading along a polygon's edges",
        cause: "The slides interpolate normals as they do colours: along the edges, then along the scan line, and bring them to length \
                1 at each pixel. Of a triangle that is the plane of ch. 7.11. Of a square whose normals lie in no plane it depends on \
                how the square is turned, as colours do: the highlight of the saddle is a cross through its middle at 0 degrees. At 45 \
                it is two bands, and the middle is dull. Light and normals do not turn. Normals of a ball's part lie in a plane, and nothing changes \
                in the middle. Machines shade triangles.",
        figures: vec![
            figure("saddle: middle of the square at 0 degrees, LSB", middle(&upright), 1),
            figure("saddle: at 45 degrees, LSB", middle(&standing), 1),
            figure("saddle: range while it turns, LSB", range(SADDLE), 1),
            figure("ball: range while it turns, LSB", range(BALL), 1),
            figure("saddle, at 0 degrees: middle of two triangles, LSB", middle(&halves), 1),
            figure(
                "saddle, at 0 degrees: largest difference from two triangles, LSB",
                apart(&upright, &halves),
                1,
            ),
        ],
        views: vec![
            View::colors("0", "The saddle at 0 degrees", upright),
            View::colors("30", "At 30 degrees", slanted),
            View::colors("45", "At 45 degrees", standing),
            View::colors("triangles", "At 0 degrees, as two triangles", halves),
        ],
    }
}

/// The corners with their normals in the first three of the user's own channels.
fn square(normals: [[f64; 2]; 4], degrees: f64) -> Vec<Vertex> {
    let of = |([x, y], [nx, ny]): ([f64; 2], [f64; 2])| {
        let normal = DVec3::new(nx, ny, 1.0).normalize_or(DVec3::Z);
        Vertex { x, y, z: 0.5, extra: [normal.x, normal.y, normal.z, 0.0], ..Vertex::default() }
    };
    corners(degrees).into_iter().zip(normals).map(of).collect()
}

/// By the polygon's active edges.
fn along_edges(square: &[Vertex]) -> Vec<[f64; 3]> {
    let polygon = Polygon { contours: vec![square.to_vec()], after: 0 };
    let table = EdgeTable::new(&polygon, ShadeMode::Gouraud, Grid::subpixels(SUBPIXEL_BITS));
    let mut picture = empty();
    polygon_fragments(&table, (WIDTH, HEIGHT), |fragment| light(fragment, &mut picture));
    picture
}

/// By the planes of two triangles.
fn in_triangles(square: &[Vertex]) -> Vec<[f64; 3]> {
    let mut picture = empty();
    for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
        let triangle = Triangle([square[a], square[b], square[c]]);
        let (mode, bits) = (ShadeMode::Gouraud, SUBPIXEL_BITS);
        fragments(&triangle, mode, bits, (WIDTH, HEIGHT), |fragment| light(fragment, &mut picture));
    }
    picture
}

fn empty() -> Vec<[f64; 3]> {
    vec![[0.2, 0.25, 0.4]; (WIDTH * HEIGHT) as usize]
}

/// The whole equation at a pixel, with light and viewer straight before the square and far away.
fn light<const N: usize, W: Weight>(fragment: &Fragment<'_, N, W>, picture: &mut [[f64; 3]]) {
    let lights = [Light::Directional { toward: DVec3::Z, intensity: DVec3::ONE }];
    let lighting = Lighting { ambient: DVec3::splat(0.1), lights: &lights, specular: Specular::Mirror };
    let matte = Material::matte(DVec3::new(0.5, 0.3, 0.2));
    let material = Material { specular: DVec3::splat(0.45), exponent: 12.0, ..matte };
    let normal = DVec3::from([0, 1, 2].map(|channel| fragment.extra(channel))).normalize_or_zero();
    let point = Point { position: DVec3::ZERO, normal, viewer: DVec3::Z };
    let color = lighting.shade(&material, &point).clamp(DVec3::ZERO, DVec3::ONE);
    picture[(fragment.y * WIDTH + fragment.x) as usize] = color.to_array();
}

/// Largest difference of two pictures, LSB.
fn apart(one: &[[f64; 3]], other: &[[f64; 3]]) -> f64 {
    let pixels = one.iter().zip(other);
    pixels.flat_map(|(a, b)| (0..3).map(|k| LSB * (a[k] - b[k]).abs())).fold(0.0, f64::max)
}
