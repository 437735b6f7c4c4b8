//! The depth buffer over many polygons (the slides), ties decided exactly, and the order among triangles.

use crate::shapes;
use crate::shapes::{Point, SCREEN, expected};
use edgewalk_golden::{Fill, NO_TRIANGLE, draw};
use edgewalk_scene::{Blending, DepthFunc, Frame, Polygon, Triangle, Vertex};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

const BITS: u32 = 4;
const EXACT: Fill = Fill::Exact { subpixel_bits: BITS };

/// z = (c + a x + b y) / 2^16 with small integers: exact everywhere.
type Plane = [i64; 3];

fn height([c, a, b]: Plane, [x, y]: Point) -> i64 {
    (c << (BITS + 1)) + a * x + b * y
}

fn in_plane(contours: &[Vec<Point>], plane: Plane, after: usize) -> Polygon {
    let mut polygon = Polygon { after, ..shapes::polygon(contours, BITS) };
    for (v, p) in polygon.contours.iter_mut().flatten().zip(contours.iter().flatten()) {
        v.z = height(plane, p.map(|c| 2 * c)) as f64 / f64::from(1u32 << (16 + BITS + 1));
    }
    polygon
}

#[test]
fn nearest_of_many_polygons_wins_at_every_pixel() {
    let mut rng = Pcg64::seed_from_u64(30);
    let (mut checked, mut mismatches, mut ties) = (0, 0, 0);
    for round in 0..60 {
        let func = [DepthFunc::Less, DepthFunc::Lequal][round % 2];
        let mut frame = Frame { depth: Some(func), ..Frame::new(SCREEN.0, SCREEN.1) };
        let mut shapes = Vec::new();
        for k in 0..40 {
            let contours = match k % 3 {
                0 => vec![shapes::convex(&mut rng, BITS)],
                1 => vec![shapes::concave(&mut rng, BITS)],
                _ => shapes::star_with_hole(&mut rng, BITS),
            };
            // Few planes that all meet in one line, so that ties abound.
            let slope = rng.random_range(-3..=3);
            let plane = [30_000 - 11 * slope, slope, slope];
            frame.polygons.push(in_plane(&contours, plane, 0));
            shapes.push((expected(&contours, BITS), plane));
        }
        let picture = draw(&frame, EXACT);
        for at in 0..picture.id.len() {
            let (x, y) = (at as u32 % SCREEN.0, at as u32 / SCREEN.0);
            let centre = [x, y].map(|c| (2 * i64::from(c) + 1) << BITS);
            let mut wanted: Option<(i64, i32)> = None;
            let mut covered = 0;
            for (id, (pixels, plane)) in (0..).zip(&shapes) {
                if !pixels.contains(&(x, y)) {
                    continue;
                }
                covered += 1;
                let z = height(*plane, centre);
                let passes = wanted.is_none_or(|(stored, _)| match func {
                    DepthFunc::Less => z < stored,
                    _ => z <= stored,
                });
                ties += u32::from(wanted.is_some_and(|(stored, _)| stored == z));
                if passes {
                    wanted = Some((z, id));
                }
            }
            checked += 1;
            let right =
                picture.id[at] == wanted.map_or(NO_TRIANGLE, |(_, id)| id) && picture.coverage[at] == covered;
            mismatches += u32::from(!right);
        }
    }
    let all = 60 * SCREEN.0 * SCREEN.1;
    println!("checked {checked} / {all} pixels, {ties} ties: {mismatches} mismatches");
    assert_eq!((checked, mismatches), (all, 0));
    assert!(ties > 10_000);
}

/// The square from corner to corner with one depth.
fn square(low: f64, high: f64, z: f64) -> [Vertex; 4] {
    [[low, low], [high, low], [high, high], [low, high]].map(|[x, y]| Vertex { x, y, z, ..Vertex::default() })
}

#[test]
fn triangles_and_polygons_are_one_list() {
    let [a, b, c, d] = square(0.0, 8.0, 0.5);
    let polygon = |after| Polygon { contours: vec![square(0.0, 8.0, 0.5).to_vec()], after };
    let frame = Frame {
        depth: Some(DepthFunc::Lequal),
        triangles: vec![Triangle([a, b, c]), Triangle([a, c, d])],
        polygons: vec![polygon(0), polygon(1)],
        ..Frame::new(8, 8)
    };
    // Polygon, triangle, polygon, triangle: at equal depths the last one drawn stays.
    let picture = draw(&frame, EXACT);
    assert_eq!((picture.id[7], picture.id[7 * 8]), (2, 3));
    assert!(picture.coverage.iter().all(|count| *count == 3));
    // With `less` the first one stays, against a triangle's depth as against a polygon's.
    let picture = draw(&Frame { depth: Some(DepthFunc::Less), ..frame.clone() }, EXACT);
    assert!(picture.id.iter().all(|id| *id == 0));
    let late = Frame { depth: Some(DepthFunc::Less), polygons: vec![polygon(2)], ..frame };
    assert!(draw(&late, EXACT).id.iter().all(|id| [0, 1].contains(id)));
}

#[test]
fn a_difference_below_the_errors_of_f64_decides() {
    let far = f64::from_bits(0.5f64.to_bits() + 1);
    let mut checked = 0;
    for (first, second, wins) in [(far, 0.5, 1), (0.5, far, 0), (0.5, 0.5, 0)] {
        // Of the four pairings of polygon and triangle.
        for kinds in 0..4 {
            let mut frame = Frame { depth: Some(DepthFunc::Less), ..Frame::new(8, 8) };
            for (k, z) in [first, second].into_iter().enumerate() {
                let [a, b, c, d] = square(0.0, 8.0, z);
                if kinds >> k & 1 == 0 {
                    let after = frame.triangles.len();
                    frame.polygons.push(Polygon { contours: vec![vec![a, b, c, d]], after });
                } else {
                    frame.triangles.push(Triangle([a, b, d]));
                }
            }
            let picture = draw(&frame, EXACT);
            assert_eq!((picture.coverage[0], picture.id[0]), (2, wins), "{first:e} {second:e} {kinds}");
            checked += 1;
        }
    }
    assert_eq!(checked, 12);
}

#[test]
fn books_draw_at_whole_coordinates() {
    let frame = Frame {
        polygons: vec![Polygon { contours: vec![square(1.0, 3.0, 0.5).to_vec()], after: 0 }],
        ..Frame::new(4, 4)
    };
    let lines = [0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0];
    assert_eq!(draw(&frame, Fill::Textbook).coverage, lines);
}

#[test]
fn a_transparent_polygon_lets_what_is_behind_through() {
    let with = |value: f64, kt: f64| square(0.0, 4.0, 0.5).map(|v| Vertex { r: value, kt, ..v }).to_vec();
    let frame = Frame {
        depth: Some(DepthFunc::Lequal),
        blend: Blending::Mix,
        polygons: [with(0.5, 0.0), with(1.0, 0.25)].map(|c| Polygon { contours: vec![c], after: 0 }).to_vec(),
        ..Frame::new(4, 4)
    };
    assert!(draw(&frame, EXACT).rgb.iter().all(|[r, ..]| *r == 0.75 * 1.0 + 0.25 * 0.5));
}
