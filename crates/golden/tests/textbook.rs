//! The listing of ch. 7.5 (half triangles) and the worked example of the notes.

use edgewalk_golden::{Fill, Half, draw, fragments, half_triangles};
use edgewalk_scene::{DepthFunc, Frame, ShadeMode, Triangle, Vertex};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

const SCREEN: (u32, u32) = (40, 40);

fn shaded(points: [(f64, f64, f64); 3]) -> Triangle {
    Triangle(points.map(|(x, y, i)| Vertex { x, y, z: i, r: i, g: i, b: i, ..Vertex::default() }))
}

type Written = (Half, u32, u32, f64);

fn written(triangle: &Triangle) -> Vec<Written> {
    let mut list = Vec::new();
    half_triangles(triangle, ShadeMode::Gouraud, SCREEN, |half, f| list.push((half, f.x, f.y, f.rgb()[0])));
    list
}

fn line(list: &[Written], half: Half, y: u32) -> Vec<(u32, f64)> {
    list.iter().filter(|w| w.0 == half && w.2 == y).map(|w| (w.1, w.3)).collect()
}

/// The printed listing, statement by statement, for a triangle with vertex 2 on the left; f64 is exact enough for the
/// small numbers of these tests, and none of their edges crosses a half by less than its error.
fn listing(
    start: [f64; 3],
    left_to: [f64; 3],
    right_to: [f64; 3],
    lines: std::ops::RangeInclusive<i64>,
    right_from: f64,
    di_x: f64,
) -> Vec<(i64, i64, f64)> {
    let [x, y, i] = start;
    let slope = |to: [f64; 3], from: f64| (to[0] - from) / (to[1] - y);
    let (dxs, dis) = (slope(left_to, x), (left_to[2] - i) / (left_to[1] - y));
    let dxe = slope(right_to, right_from);
    let (mut x_start, mut x_end, mut i_start) = (x + 0.5, right_from + 0.5, i + 0.5);
    let mut list = Vec::new();
    for y in lines {
        let mut value = i_start;
        for x in x_start.floor() as i64..=x_end.floor() as i64 {
            list.push((x, y, value - 0.5));
            value += di_x;
        }
        x_start += dxs;
        x_end += dxe;
        i_start += dis;
    }
    list
}

#[test]
fn both_halves_as_the_listing_writes_them() {
    // Vertex 2 on the left, as the book assumes. Plane: i = 0.2 + 0.02 (x - 12) + 0.01 (y - 3).
    let i = |x: f64, y: f64| 0.2 + 0.02 * (x - 12.0) + 0.01 * (y - 3.0);
    let [one, two, three] = [(12.0, 3.0), (5.0, 10.0), (20.0, 26.0)].map(|(x, y)| [x, y, i(x, y)]);
    let knee_right = one[0] + (two[1] - one[1]) * (three[0] - one[0]) / (three[1] - one[1]);
    let mut expected = listing(one, two, three, 3..=10, one[0], 0.02);
    let first_half = expected.len();
    expected.extend(listing(two, three, three, 10..=26, knee_right, 0.02));
    for order in [[one, two, three], [three, one, two], [two, one, three]] {
        let list = written(&shaded(order.map(|[x, y, i]| (x, y, i))));
        assert_eq!(list.len(), expected.len());
        for (k, (got, want)) in list.iter().zip(&expected).enumerate() {
            let half = if k < first_half { Half::First } else { Half::Second };
            assert_eq!((got.0, i64::from(got.1), i64::from(got.2)), (half, want.0, want.1));
            assert!((got.3 - want.2).abs() < 1e-12, "{got:?} {want:?}");
        }
    }
}

#[test]
fn mirrored_triangle_starts_at_the_long_edge() {
    // Vertex 2 on the right: the left edge is 1-3. At line 4 it is at x = 0 + 4/2 = 2.
    let list = written(&shaded([(0.0, 0.0, 0.0), (12.0, 4.0, 0.6), (4.0, 8.0, 0.2)]));
    let knee = line(&list, Half::First, 4);
    assert_eq!((knee[0].0, knee.len()), (2, 11), "from 2 to 12, both ends");
    assert!((knee[0].1 - 0.1).abs() < 1e-15, "the value of edge 1-3 at line 4");
    assert!((knee[10].1 - 0.6).abs() < 1e-15, "vertex 2 itself");
    assert_eq!(line(&list, Half::Second, 4), knee, "the knee line is drawn by both halves");
}

#[test]
fn start_value_belongs_to_the_edge_though_the_pixel_is_rounded() {
    // Edge 1-2 at line 1 is at x = 10 - 5/3 = 8.33, drawn from pixel 8: the value there is that of x = 8.33.
    let triangle = shaded([(10.0, 0.0, 0.0), (5.0, 3.0, 0.5), (10.0, 6.0, 0.0)]);
    let got = line(&written(&triangle), Half::First, 1);
    assert_eq!(got.iter().map(|(x, _)| *x).collect::<Vec<_>>(), [8, 9, 10]);
    for (k, (_, value)) in got.iter().enumerate() {
        assert!((value - (0.5 / 3.0 - 0.1 * k as f64)).abs() < 1e-15, "{k} {value}");
    }
    assert!(got[2].1 < 0.0, "the last pixel overshoots the edge 1-3, where the intensity is 0");
}

#[test]
fn halves_without_height_and_triangles_without_area_draw_nothing() {
    let flat_top = written(&shaded([(2.0, 2.0, 0.1), (8.0, 2.0, 0.2), (4.0, 9.0, 0.3)]));
    assert!(!flat_top.is_empty() && flat_top.iter().all(|w| w.0 == Half::Second));
    assert_eq!(line(&flat_top, Half::Second, 2).len(), 7, "2 to 8, both ends");
    let flat_bottom = written(&shaded([(4.0, 2.0, 0.1), (8.0, 9.0, 0.2), (2.0, 9.0, 0.3)]));
    assert!(!flat_bottom.is_empty() && flat_bottom.iter().all(|w| w.0 == Half::First));
    for points in
        [[(1.0, 1.0); 3], [(1.0, 1.0), (5.0, 5.0), (9.0, 9.0)], [(1.0, 3.0), (7.0, 3.0), (4.0, 3.0)]]
    {
        assert!(written(&shaded(points.map(|(x, y)| (x, y, 0.5)))).is_empty(), "{points:?}");
    }
}

#[test]
fn shared_edges_are_drawn_twice() {
    let mut frame = Frame::new(16, 16);
    frame.depth = Some(DepthFunc::Lequal);
    frame.triangles = vec![
        shaded([(2.0, 2.0, 0.5), (2.0, 10.0, 0.5), (10.0, 10.0, 0.5)]),
        shaded([(2.0, 2.0, 0.5), (10.0, 2.0, 0.5), (10.0, 10.0, 0.5)]),
    ];
    let picture = draw(&frame, Fill::Textbook);
    let diagonal: Vec<u32> = (2..=10).map(|k| picture.coverage[k * 16 + k]).collect();
    assert_eq!(diagonal, [2; 9]);
    assert_eq!(picture.coverage.iter().sum::<u32>(), 9 * 9 + 9);
    assert_eq!(picture.writes, picture.coverage, "as near passes lequal");
    frame.depth = Some(DepthFunc::Less);
    let strict = draw(&frame, Fill::Textbook);
    assert_eq!(strict.writes.iter().max(), Some(&1));
}

#[test]
fn slivers_tie_with_themselves() {
    // Slivers a thousand lines long, drawn again from other vertices. Their last pixels lie far outside in depth, where
    // f64 has lost some bits; it is the same exact depth all the same, on the knee line in both halves.
    let mut rng = Pcg64::seed_from_u64(7);
    let (mut shared, mut knees) = (0, 0);
    for _ in 0..60 {
        let bottom = f64::from(rng.random_range(0..60));
        let knee = f64::from(rng.random_range(1..1000));
        let beside = (knee * bottom / 1000.0).round() + f64::from(rng.random_range(0..=1));
        let mut depth = || rng.random::<f64>();
        let [a, b, c] = shaded([(0.0, 0.0, depth()), (beside, knee, depth()), (bottom, 1000.0, depth())]).0;
        let [strict, lenient] = [DepthFunc::Less, DepthFunc::Lequal].map(|func| {
            let mut frame = Frame::new(64, 1001);
            (frame.depth, frame.triangles) = (Some(func), vec![Triangle([a, b, c]), Triangle([b, c, a])]);
            draw(&frame, Fill::Textbook)
        });
        for at in 0..strict.z.len() {
            // Beyond the edge a depth may lie beyond the cleared one; then nothing passes.
            let drawn = strict.writes[at] > 0;
            assert_eq!(strict.writes[at], u32::from(drawn));
            assert_eq!(lenient.writes[at], if drawn { lenient.coverage[at] } else { 0 });
            shared += u32::from(drawn);
            knees += u32::from(drawn && strict.coverage[at] == 4);
        }
    }
    println!("{shared} pixels, {knees} of them on knee lines");
    assert!(shared > 50_000 && knees > 60);
}

#[test]
fn the_thinnest_slivers_tie_with_themselves() {
    // Twice the area is 1 and an edge a million lines high. On one line the edges lie on either side of a half, so a second pixel is
    // drawn a whole one beyond them: there two vertices weigh a million times the whole, the three terms of a depth cancel
    // but for their last digits, and in f64 their sum depends on their order.
    let mut rng = Pcg64::seed_from_u64(9);
    let (mut pixels, mut apart) = (0, 0);
    for k in 0..600 {
        let shift = f64::from(k % 20);
        let slopes = [0.3, 1e-7].map(|most| rng.random_range(-most..most));
        let z = |x: f64, y: f64| 0.5 + slopes[0] * x + slopes[1] * y;
        let places = [(0.0, -499_990.0), (1.0, 500_010.0), (1.0, 500_011.0)];
        let [a, b, c] = shaded(places.map(|(x, y)| (x, y + shift, z(x, y)))).0;
        let orders = [Triangle([a, b, c]), Triangle([b, c, a])];
        let beyond = orders.map(|triangle| {
            let here = line(&written(&triangle), Half::First, 10 + k % 20);
            assert_eq!(here.iter().map(|(x, _)| *x).collect::<Vec<_>>(), [0, 1]);
            here[1].1
        });
        apart += u32::from((beyond[0] - beyond[1]).abs() > 1e-12);
        for (func, writes) in [(DepthFunc::Less, 1), (DepthFunc::Lequal, 2)] {
            let mut frame = Frame::new(SCREEN.0, SCREEN.1);
            (frame.depth, frame.triangles) = (Some(func), orders.to_vec());
            let picture = draw(&frame, Fill::Textbook);
            for (drawn, written) in picture.coverage.iter().zip(&picture.writes).filter(|(d, _)| **d > 0) {
                assert_eq!((*drawn, *written), (2, writes), "{func:?}");
                pixels += 1;
            }
        }
    }
    println!("{pixels} pixels, {apart} with two depths in f64 that are one");
    assert!(pixels > 40_000 && apart > 200);
}

#[test]
fn depths_that_f64_leaves_open_are_decided_on_every_line() {
    for shape in [
        [(2.0, 2.0), (30.0, 2.0), (9.0, 30.0)],
        [(2.0, 2.0), (30.0, 30.0), (9.0, 30.0)],
        [(2.0, 2.0), (30.0, 9.0), (9.0, 30.0)],
    ] {
        let [far, near] = [0.5, 0.5 - 1e-10].map(|z| shaded(shape.map(|(x, y)| (x, y, z))));
        for (triangles, passes) in [([far, near], 2), ([near, far], 1)] {
            let mut frame = Frame::new(SCREEN.0, SCREEN.1);
            frame.triangles = triangles.to_vec();
            let picture = draw(&frame, Fill::Textbook);
            assert!(picture.writes.iter().all(|writes| *writes == 0 || *writes == passes));
            assert!(picture.writes.iter().sum::<u32>() > 200);
        }
    }
}

/// The worked example of the notes: intensities 0.9, 0.2, 0.3 at y = 10, 20, 30. The text gives no x but those of line 15: 10.5 on edge P1P2 and
/// 20 on P1P3; vertices at these places make it so.
const WORKED: [(f64, f64, f64); 3] = [(15.0, 10.0, 0.9), (6.0, 20.0, 0.2), (35.0, 30.0, 0.3)];

#[test]
fn worked_example_steps_along_the_edges() {
    let list = written(&shaded(WORKED));
    let start = |half, y| line(&list, half, y)[0].1;
    assert!((start(Half::First, 11) - start(Half::First, 10) - -0.07).abs() < 1e-12, "P1P2");
    assert!((start(Half::Second, 21) - start(Half::Second, 20) - 0.01).abs() < 1e-12, "P2P3");
    // P1P3 is the left edge of the mirror image.
    let mirrored = written(&shaded(WORKED.map(|(x, y, i)| (40.0 - x, y, i))));
    let start = |y| line(&mirrored, Half::First, y)[0].1;
    assert!((start(11) - start(10) - -0.03).abs() < 1e-12, "P1P3");
}

#[test]
fn worked_example_scan_line_15() {
    let list = line(&written(&shaded(WORKED)), Half::First, 15);
    assert!((list[0].1 - 0.55).abs() < 1e-12, "the left edge, at x = 10.5");
    // The exact step is 0.2 / 9.5. The notes count 20 - 10.5 as 10 steps, hence 0.02, and ends at 0.75; "0.15" is a misprint.
    let step = list[1].1 - list[0].1;
    assert!((step - 0.2 / 9.5).abs() < 1e-12);
    let as_printed: f64 = (0.75 - 0.55) / 10.0;
    assert!((as_printed - 0.02).abs() < 1e-12);
    assert!((list[0].1 + 10.0 * as_printed - 0.75).abs() < 1e-12);
    // The pixel whose place is exactly x = 20 in the half-open picture has the right edge's value.
    let at_edges: Vec<f64> = [10.5, 20.0].map(|x| list[0].1 + (x - 10.5) * step).to_vec();
    assert!((at_edges[1] - 0.75).abs() < 1e-12);
    // The same plane without the listing's rounding: 0.55 half a pixel left of the centre of pixel 10 of line 15.
    let shifted = shaded(WORKED.map(|(x, y, i)| (x + 0.5, y + 0.5, i)));
    let mut exact = Vec::new();
    fragments(&shifted, ShadeMode::Gouraud, 8, SCREEN, |f| {
        if f.y == 15 {
            exact.push((f.x, f.rgb()[0]));
        }
    });
    assert_eq!((exact[0].0, exact[exact.len() - 1].0), (11, 19), "11 to 20, right end open");
    assert!((exact[0].1 - (0.55 + 0.5 * 0.2 / 9.5)).abs() < 1e-12);
}

#[test]
fn the_largest_coordinates_fit() {
    let far = 1e6;
    let triangle = shaded([(-far, -far, 0.0), (far, -far + 1.0, 1.0), (0.0, far, 0.5)]);
    let list = written(&triangle);
    assert_eq!(list.len() as u32, SCREEN.0 * SCREEN.1, "the screen lies inside");
    assert!(list.iter().all(|w| (w.3 - 0.5).abs() < 1e-4), "half way down");
}
