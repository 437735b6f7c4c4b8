//! A polygon cut into triangles covers the same pixels, each once.
#![allow(clippy::unwrap_used)] // simple polygons have triangles

use crate::shapes;
use crate::shapes::{Pixels, Point, SCREEN, concave, convex, covered, random_points, star_with_hole};
use edgewalk_golden::{Fill, draw, fragments};
use edgewalk_scene::{Frame, Polygon, ShadeMode, Vertex};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Draws the triangles with half-planes; how many there are.
fn check(contours: &[Vec<Point>], bits: u32) -> (usize, usize) {
    let triangles = shapes::polygon(contours, bits).triangles(bits).unwrap();
    let mut pixels = Pixels::new();
    for triangle in &triangles {
        fragments(triangle, ShadeMode::Gouraud, bits, SCREEN, |f| {
            assert!(pixels.insert((f.x, f.y)), "{} {} drawn twice, {contours:?}", f.x, f.y);
        });
    }
    assert_eq!(pixels, covered(contours, bits), "{contours:?}");
    (triangles.len(), pixels.len())
}

#[test]
fn ten_thousand_random_polygons_as_triangles() {
    let mut rng = Pcg64::seed_from_u64(40);
    let names = ["convex", "concave", "hole"];
    let (mut checked, mut pixels) = ([0; 3], [0; 3]);
    for k in 0..10_002usize {
        let (kind, bits) = (k % 3, (k / 3 % 9) as u32);
        let contours = match kind {
            0 => vec![convex(&mut rng, bits)],
            1 => vec![concave(&mut rng, bits)],
            _ => star_with_hole(&mut rng, bits),
        };
        let (triangles, covered) = check(&contours, bits);
        if kind < 2 {
            assert_eq!(triangles, contours[0].len() - 2, "{contours:?}");
        }
        checked[kind] += 1;
        pixels[kind] += covered;
    }
    for (kind, name) in names.into_iter().enumerate() {
        println!("{name:<8} {:>5} polygons, {:>7} pixels once", checked[kind], pixels[kind]);
        assert!(pixels[kind] > 100_000);
    }
    println!("checked {} / 10002", checked.iter().sum::<i32>());
}

#[test]
fn contours_that_touch_or_lie_in_one_another() {
    let square = |x: i64, y: i64, side: i64| vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]];
    let cases: [(&str, Vec<Vec<Point>>, usize); 7] = [
        ("an edge in common is none", vec![square(0, 0, 4), square(4, 0, 4)], 32),
        ("a part of an edge in common", vec![square(0, 0, 8), square(8, 2, 4)], 80),
        ("corners that touch", vec![square(0, 0, 4), square(4, 4, 4)], 32),
        ("the same twice", vec![square(0, 0, 4), square(0, 0, 4)], 0),
        ("an island in a hole", vec![square(0, 0, 12), square(2, 2, 8), square(4, 4, 4)], 144 - 64 + 16),
        ("there and back", vec![vec![[0, 0], [8, 0], [8, 8], [8, 0]]], 0),
        ("a spike", vec![vec![[0, 0], [4, 0], [9, 0], [4, 0], [4, 4], [0, 4]]], 16),
    ];
    for (name, contours, pixels) in cases {
        assert_eq!(check(&contours, 0).1, pixels, "{name}");
    }
    for points in [[[3, 3]; 3], [[0, 0], [4, 4], [8, 8]]] {
        assert_eq!(check(&[points.to_vec()], 0), (0, 0), "no area");
    }
}

#[test]
fn crossing_edges_are_refused_and_nothing_else() {
    let mut rng = Pcg64::seed_from_u64(41);
    let (mut refused, mut drawn) = (0, 0);
    for k in 0..3_000 {
        let bits = k % 9;
        let contours = vec![random_points(&mut rng, bits, 6)];
        match shapes::polygon(&contours, bits).triangles(bits) {
            Err(_) => refused += 1,
            Ok(_) => drawn += usize::from(check(&contours, bits).1 > 0),
        }
    }
    println!("{refused} refused, {drawn} drawn");
    assert!(refused > 500 && drawn > 500);
    let bow_tie = vec![vec![[0, 0], [8, 8], [8, 0], [0, 8]]];
    let message = shapes::polygon(&bow_tie, 0).triangles(0).unwrap_err().to_string();
    assert!(message.starts_with("polygon at vertex 8 0: "), "{message}");
}

#[test]
fn a_long_contour_is_cut_in_reasonable_time() {
    // A comb of 16,000 teeth.
    let teeth: Vec<Point> = (0..32_000)
        .map(|k| [k, if k % 2 == 0 { 0 } else { 4000 }])
        .chain([[32_000, 8000], [0, 8000]])
        .collect();
    assert_eq!(check(&[teeth], 8).0, 32_000);
}

#[test]
fn a_frame_keeps_order_ids_and_flat_colour() {
    let mut rng = Pcg64::seed_from_u64(42);
    let mut frame = Frame { mode: ShadeMode::Flat, ..Frame::new(SCREEN.0, SCREEN.1) };
    for k in 0..30 {
        let mut polygon = Polygon { after: k / 2, ..shapes::polygon(&[concave(&mut rng, 8)], 8) };
        let z = rng.random_range(0.0..=1.0);
        for v in polygon.contours.iter_mut().flatten() {
            *v = Vertex { z, r: rng.random_range(0.0..=1.0), ..*v };
        }
        if k % 2 == 0 {
            frame.polygons.push(polygon);
        } else {
            frame.triangles.push(edgewalk_scene::Triangle(std::array::from_fn(|i| polygon.contours[0][i])));
        }
    }
    let fill = Fill::Exact { subpixel_bits: 8 };
    let whole = draw(&frame, fill);
    let cut = frame.triangulated(8).unwrap();
    assert_eq!(cut.triangles.len(), cut.ids.len());
    let triangles = cut.triangles.into_owned();
    let mut pieces = draw(&Frame { triangles, polygons: Vec::new(), ..frame.clone() }, fill);
    for id in pieces.id.iter_mut().filter(|id| **id >= 0) {
        *id = cut.ids[*id as usize];
    }
    assert_eq!(pieces, whole);
}
