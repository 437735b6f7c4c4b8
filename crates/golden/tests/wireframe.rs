//! Wireframe: each pixel holds a point of its line, surfaces hide what is behind them and nothing that lies in them.

use edgewalk_golden::{Fill, HiddenLines, NO_TRIANGLE, Picture, draw, wireframe};
use edgewalk_scene::{Frame, Polygon, Scene, ShadeMode, Triangle, Vertex};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

const SIDE: u32 = 32;
const EXACT: Fill = Fill::Exact { subpixel_bits: 8 };

fn vertex(x: f64, y: f64, z: f64) -> Vertex {
    Vertex { x, y, z, ..Vertex::default() }
}

/// A line is a polygon of two vertices.
fn line(a: Vertex, b: Vertex) -> Polygon {
    Polygon { contours: vec![vec![a, b]], after: 0 }
}

fn picture_of(a: Vertex, b: Vertex) -> Picture {
    wireframe(&Frame { polygons: vec![line(a, b)], ..Frame::new(SIDE, SIDE) }, EXACT, HiddenLines::Drawn)
}

fn drawn(picture: &Picture) -> Vec<[i64; 2]> {
    let all = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| [x, y]));
    all.zip(&picture.writes).filter(|(_, writes)| **writes > 0).map(|(p, _)| p.map(i64::from)).collect()
}

/// Whether a line has a point in a closed pixel; units of 1/256 px.
fn touches([a, b]: [[i64; 2]; 2], pixel: [i64; 2]) -> bool {
    let low = pixel.map(|c| c * 256);
    let boxes = (0..2).all(|k| a[k].min(b[k]) <= low[k] + 256 && low[k] <= a[k].max(b[k]));
    let side = |dx: i64, dy: i64| {
        let corner = [low[0] + dx, low[1] + dy];
        ((b[0] - a[0]) * (corner[1] - a[1]) - (b[1] - a[1]) * (corner[0] - a[0])).signum()
    };
    let sides = [side(0, 0), side(256, 0), side(0, 256), side(256, 256)];
    boxes && sides.iter().any(|s| *s <= 0) && sides.iter().any(|s| *s >= 0)
}

#[test]
fn a_line_is_a_chain_of_pixels_that_it_goes_through() {
    let mut rng = Pcg64::seed_from_u64(50);
    let (mut lines, mut pixels) = (0, 0);
    for k in 0..3_000 {
        let reach = [20, 40, 100_000][k % 3] * 256;
        let ends: [[i64; 2]; 2] =
            std::array::from_fn(|_| std::array::from_fn(|_| 16 * 256 + rng.random_range(-reach..reach)));
        let [a, b] = ends.map(|[x, y]| vertex(x as f64 / 256.0, y as f64 / 256.0, 0.5));
        let seen = drawn(&picture_of(a, b));
        assert_eq!(seen, drawn(&picture_of(b, a)), "{ends:?}");
        let steep = usize::from((ends[0][1] - ends[1][1]).abs() > (ends[0][0] - ends[1][0]).abs());
        let mut chain = seen.clone();
        chain.sort_by_key(|p| p[steep]);
        for pair in chain.windows(2) {
            let step = [pair[1][steep] - pair[0][steep], pair[1][1 - steep] - pair[0][1 - steep]];
            assert!(step[0] == 1 && step[1].abs() <= 1, "{ends:?}: {pair:?}");
        }
        for pixel in &seen {
            assert!(touches(ends, *pixel), "{ends:?} does not touch {pixel:?}");
        }
        assert_eq!(seen, by_the_rule(ends), "{ends:?}");
        lines += usize::from(!seen.is_empty());
        pixels += seen.len();
    }
    println!("{lines} lines on the screen, {pixels} pixels");
    assert!(lines > 1_500 && pixels > 20_000);
}

/// The pixels of a line by the rule alone: every pixel of the screen is asked. Units of 1/512 px, so that centres are whole.
fn by_the_rule([a, b]: [[i64; 2]; 2]) -> Vec<[i64; 2]> {
    let double = |[x, y]: [i64; 2]| [i128::from(2 * x), i128::from(2 * y)];
    let [a, b] = [double(a), double(b)];
    let main = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
    let [from, to] = if a[main] <= b[main] { [a, b] } else { [b, a] };
    let length = to[main] - from[main];
    let all = (0..i64::from(SIDE)).flat_map(|y| (0..i64::from(SIDE)).map(move |x| [x, y]));
    all.filter(|pixel| {
        let [along, across] = [pixel[main], pixel[1 - main]].map(|c| i128::from(512 * c + 256));
        if along < from[main] || along >= to[main] {
            return false;
        }
        // Twice the distance across from the line to the centre, times the length, from more than minus a pixel to a pixel.
        let line = from[1 - main] * length + (along - from[main]) * (to[1 - main] - from[1 - main]);
        let above = 2 * (line - across * length);
        -512 * length < above && above <= 512 * length
    })
    .collect()
}

/// Lines around a polygon draw each pixel of their joints once, and blending by kt would show one that is drawn twice.
#[test]
fn lines_that_follow_each_other_share_no_pixel() {
    let mut rng = Pcg64::seed_from_u64(52);
    let mut pixels = 0;
    for _ in 0..300 {
        // To the right all the way, and flat: no two lines have a column in common.
        let mut at = [rng.random_range(0.0..3.0), rng.random_range(8.0..24.0)];
        let mut lines = Vec::new();
        while at[0] < 28.0 {
            let dx: f64 = rng.random_range(0.1..5.0);
            let next = [at[0] + dx, at[1] + rng.random_range(-0.9 * dx..0.9 * dx)];
            lines.push(line(vertex(at[0], at[1], 0.5), vertex(next[0], next[1], 0.5)));
            at = next;
        }
        let frame = Frame { polygons: lines, ..Frame::new(SIDE, SIDE) };
        let picture = wireframe(&frame, EXACT, HiddenLines::Drawn);
        // A line is drawn there and back.
        assert!(picture.coverage.iter().all(|count| *count == 0 || *count == 2));
        pixels += picture.coverage.iter().filter(|count| **count > 0).count();
    }
    println!("{pixels} pixels");
    assert!(pixels > 5_000);
}

#[test]
fn depth_and_colour_run_along_the_line() {
    let a = Vertex { r: 1.0, ..vertex(2.5, 4.5, 0.0) };
    let b = Vertex { g: 1.0, ..vertex(10.5, 8.5, 1.0) };
    let picture = picture_of(a, b);
    assert_eq!(drawn(&picture).len(), 8, "the column of the far end is not in it");
    for k in 0..8u32 {
        let x = 2 + k;
        let y = (0..SIDE).find(|y| picture.writes[(y * SIDE + x) as usize] > 0);
        let at = (y.unwrap_or(SIDE) * SIDE + x) as usize;
        let t = f64::from(k) / 8.0;
        assert_eq!((picture.z[at], picture.rgb[at]), (t, [1.0 - t, t, 0.0]), "column {x}");
    }
    let flat =
        Frame { mode: ShadeMode::Flat, triangles: vec![Triangle([b, a, a])], ..Frame::new(SIDE, SIDE) };
    let picture = wireframe(&flat, EXACT, HiddenLines::Drawn);
    assert!(drawn(&picture).iter().all(|[x, y]| picture.rgb[(y * 32 + x) as usize] == [0.0, 1.0, 0.0]));
}

fn square(low: f64, high: f64, z: f64) -> Vec<Vertex> {
    vec![vertex(low, low, z), vertex(high, low, z), vertex(high, high, z), vertex(low, high, z)]
}

#[test]
fn surfaces_hide_lines_behind_them() {
    let window = vec![square(4.0, 28.0, 0.25), square(12.0, 20.0, 0.25)];
    let frame = Frame {
        polygons: vec![
            Polygon { contours: window, after: 0 },
            Polygon { contours: vec![square(8.0, 24.0, 0.75)], after: 0 },
            Polygon { contours: vec![square(14.0, 18.0, 0.75)], after: 0 },
        ],
        ..Frame::new(SIDE, SIDE)
    };
    let pixels = |hidden, id| wireframe(&frame, EXACT, hidden).id.iter().filter(|i| **i == id).count();
    // The frame of the window and its hole; the square behind the frame; the one seen through the hole.
    let shown = [0, 1, 2].map(|id| pixels(HiddenLines::Drawn, id));
    // Of each square the lower right corner is in two lines.
    assert_eq!(shown, [4 * 24 - 1 + 4 * 8 - 1, 4 * 16 - 1, 4 * 4 - 1]);
    assert_eq!([0, 1, 2].map(|id| pixels(HiddenLines::Removed, id)), [shown[0], 0, shown[2]]);
}

/// A land without overhangs: corners of cells of `cell` px at random depths.
fn land(rng: &mut Pcg64, cell: u32) -> Vec<Triangle> {
    let n = SIDE / cell;
    let mut shaken = |range: f64| rng.random_range(-range..range);
    let corners: Vec<Vertex> = (0..=n)
        .flat_map(|j| (0..=n).map(move |i| [i, j]))
        .map(|place| {
            let [x, y] = place.map(|k| f64::from(k * cell) + shaken(0.2 * f64::from(cell)));
            vertex(x, y, 0.5 + shaken(0.4))
        })
        .collect();
    let corner = |i: u32, j: u32| corners[(j * (n + 1) + i) as usize];
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| [i, j]));
    cells
        .flat_map(|[i, j]| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)];
            [Triangle([a, b, c]), Triangle([b, d, c])]
        })
        .collect()
}

#[test]
fn no_surface_hides_its_own_edges() {
    let mut rng = Pcg64::seed_from_u64(51);
    let (mut checked, mut elsewhere, mut lost) = (0, 0, 0);
    for round in 0..60 {
        let triangles = land(&mut rng, [4, 8, 16][round % 3]);
        let frame = Frame { triangles, ..Frame::new(SIDE, SIDE) };
        let owner = draw(&frame, EXACT).id;
        let seen = wireframe(&frame, EXACT, HiddenLines::Removed);
        for (triangle, id) in frame.triangles.iter().zip(0..) {
            let [a, b, c] = triangle.0;
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let all = picture_of(from, to);
                for at in (0..all.id.len()).filter(|at| all.id[*at] != NO_TRIANGLE) {
                    // Seen itself, or another line of the land before it.
                    let visible = seen.writes[at] > 0 && seen.z[at] <= all.z[at];
                    if owner[at] == id {
                        checked += 1;
                        assert!(visible, "an edge of triangle {id} is hidden by it at {at}");
                    } else {
                        elsewhere += 1;
                        lost += u32::from(!visible);
                    }
                }
            }
        }
    }
    println!(
        "{checked} pixels of lines in their own surfaces visible; of {elsewhere} in others' {lost} hidden"
    );
    assert!(checked > 10_000);
    assert!(f64::from(lost) < 0.02 * f64::from(elsewhere));
}

#[test]
fn half_of_a_sphere_is_hidden() {
    let frame = match Scene::builtin("sphere") {
        Ok(scene) => scene.frame(400, 400, 1000.0, ShadeMode::Gouraud),
        Err(error) => panic!("{error}"),
    };
    let pixels =
        |hidden| wireframe(&frame, EXACT, hidden).writes.iter().filter(|writes| **writes > 0).count();
    let (all, seen) = (pixels(HiddenLines::Drawn), pixels(HiddenLines::Removed));
    println!("{seen} of {all} pixels with lines are seen");
    assert!(seen > 5_000 && 10 * seen > 4 * all && 10 * seen < 7 * all);
}
