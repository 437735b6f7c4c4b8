//! Sorted blending against an exact composition from back to front, pixel by pixel.

use edgewalk_golden::{Fill, MAX_PAIRS, back_to_front, draw, fragments};
use edgewalk_scene::{Blending, Frame, ShadeMode, Triangle, Vertex};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SUBPIXEL_BITS: u32 = 8;
const SIDE: u32 = 32;

/// What every pixel should be: all its fragments by depth, farthest first, each over what is behind it. `None` where two
/// depths are too near to tell.
fn composed(frame: &Frame) -> Vec<Option<[f64; 3]>> {
    let mut fragments_at = vec![Vec::new(); (SIDE * SIDE) as usize];
    for triangle in &frame.triangles {
        fragments(triangle, frame.mode, SUBPIXEL_BITS, (SIDE, SIDE), |f| {
            fragments_at[(f.y * SIDE + f.x) as usize].push((f.z(), f.rgb(), f.kt()));
        });
    }
    let compose = |mut list: Vec<(f64, [f64; 3], f64)>| {
        list.sort_by(|a, b| b.0.total_cmp(&a.0));
        let ties = list.windows(2).any(|pair| pair[0].0 - pair[1].0 < 1e-12);
        let over = |back: [f64; 3], (_, front, kt): &(f64, [f64; 3], f64)| {
            std::array::from_fn(|c| front[c] + kt * (back[c] - front[c]))
        };
        (!ties).then(|| list.iter().fold(frame.clear, over))
    };
    fragments_at.into_iter().map(compose).collect()
}

/// The frame with its triangles in drawing order, and the warning.
fn sorted(mut frame: Frame) -> (Frame, Option<String>) {
    let order = back_to_front(&frame.triangles, SUBPIXEL_BITS);
    let (warning, count) = (order.warning(), frame.triangles.len());
    assert_eq!(order.order.len(), count);
    frame.triangles = order.order.iter().map(|place| frame.triangles[*place]).collect();
    frame.blend = Blending::Mix;
    (frame, warning)
}

/// Pixels checked, and those that differ by more than 1e-12.
fn compare(frame: &Frame) -> (u32, u32) {
    let picture = draw(frame, Fill::Exact { subpixel_bits: SUBPIXEL_BITS });
    let (mut checked, mut differ) = (0, 0);
    for (drawn, expected) in picture.rgb.iter().zip(composed(frame)) {
        let Some(expected) = expected else { continue };
        checked += 1;
        differ += u32::from((0..3).any(|c| (drawn[c] - expected[c]).abs() > 1e-12));
    }
    (checked, differ)
}

fn triangle(corners: [[f64; 3]; 3], rgb: [f64; 3], kt: f64) -> Triangle {
    let [r, g, b] = rgb;
    Triangle(corners.map(|[x, y, z]| Vertex { x, y, z, r, g, b, kt, ..Vertex::default() }))
}

/// Triangles in planes that are nearly parallel to the screen and apart in depth: an order exists. In `crossing` ones
/// they lie anyhow.
fn random(random: &mut Pcg64Mcg, crossing: bool) -> Frame {
    let mut frame = Frame { clear: random.random(), ..Frame::new(SIDE, SIDE) };
    let count = random.random_range(2..14);
    for k in 0..count {
        let middle = (f64::from(k) + 0.5) / f64::from(count);
        let spread = if crossing { 0.5 } else { 0.4 / f64::from(count) };
        let corners = [0; 3].map(|_| {
            let [x, y] = [0; 2].map(|_| random.random_range(-8.0..40.0));
            [x, y, (middle + random.random_range(-spread..spread)).clamp(0.0, 0.99)]
        });
        let kt = if random.random_bool(0.25) { 0.0 } else { random.random_range(0.01..1.0) };
        let mut new = triangle(corners, random.random(), kt);
        // Colours differ at the vertices.
        new.0.iter_mut().for_each(|vertex| vertex.r = random.random());
        frame.triangles.push(new);
    }
    for k in (1..frame.triangles.len()).rev() {
        frame.triangles.swap(k, random.random_range(0..=k));
    }
    frame
}

#[test]
fn where_an_order_exists_the_picture_is_the_exact_composition() {
    let mut source = Pcg64Mcg::seed_from_u64(75);
    let (mut pixels, mut unsorted) = (0, 0);
    for _ in 0..300 {
        let frame = random(&mut source, false);
        let mut as_it_is = frame.clone();
        as_it_is.blend = Blending::Mix;
        unsorted += compare(&as_it_is).1;
        let (frame, warning) = sorted(frame);
        assert_eq!(warning, None);
        let (checked, differ) = compare(&frame);
        assert_eq!(differ, 0, "{frame:?}");
        pixels += checked;
    }
    println!(
        "checked {pixels} pixels of 300 frames: 0 differ by more than 1e-12; {unsorted} differ without sorting"
    );
    assert!(pixels > 250_000 && unsorted > 10_000);
}

#[test]
fn without_a_warning_nothing_is_wrong() {
    let mut source = Pcg64Mcg::seed_from_u64(74);
    let (mut quiet, mut warned, mut wrong) = (0, 0, 0);
    for _ in 0..600 {
        let (frame, warning) = sorted(random(&mut source, true));
        let (_, differ) = compare(&frame);
        match warning {
            None => {
                assert_eq!(differ, 0, "no warning, and yet {differ} pixels differ: {frame:?}");
                quiet += 1;
            }
            Some(_) => {
                warned += 1;
                wrong += u32::from(differ > 0);
            }
        }
    }
    println!(
        "checked 600 frames: {quiet} without a warning, all right; {warned} with one, of which {wrong} show it"
    );
    assert!(quiet > 50 && wrong > 50);
}

#[test]
fn three_in_a_circle_and_two_that_cut() {
    // Bars along the sides of a triangle, each over the next at one end and under the one before at the other.
    let corners = [[4.0, 4.0], [28.0, 4.0], [16.0, 26.0]];
    let bar = |k: usize| {
        let ([x, y], [ex, ey]) = (corners[k], corners[(k + 1) % 3]);
        let (dx, dy) = ((ex - x) * 0.2, (ey - y) * 0.2);
        // A wedge that starts beyond one corner, near, and ends in a point beyond the other, far.
        let start = [[x - dx - dy, y - dy + dx, 0.2], [x - dx + dy, y - dy - dx, 0.2]];
        triangle([start[0], start[1], [ex + dx, ey + dy, 0.8]], [0.1 * k as f64, 0.5, 0.9], 0.5)
    };
    let frame = Frame { triangles: (0..3).map(bar).collect(), ..Frame::new(SIDE, SIDE) };
    let order = back_to_front(&frame.triangles, SUBPIXEL_BITS);
    assert_eq!((order.cycles.len(), order.intersections.len()), (1, 0), "{order:?}");
    assert!(order.warning().is_some_and(|text| text.contains("circles")));
    let two = Frame { triangles: (0..2).map(bar).collect(), ..Frame::new(SIDE, SIDE) };
    assert_eq!(back_to_front(&two.triangles, SUBPIXEL_BITS).warning(), None, "two of them are no circle");

    let cut = |z: [f64; 3]| triangle([[0.0, 0.0, z[0]], [30.0, 0.0, z[1]], [0.0, 30.0, z[2]]], [1.0; 3], 0.5);
    let crossing = [cut([0.2, 0.8, 0.5]), cut([0.8, 0.2, 0.5])];
    let order = back_to_front(&crossing, SUBPIXEL_BITS);
    assert_eq!(order.intersections, [[0, 1]]);
    assert!(order.warning().is_some_and(|text| text.contains("cut each other")));
}

#[test]
fn opaque_ones_come_first_and_are_not_compared() {
    let at = |z: f64, kt: f64| triangle([[0.0, 0.0, z], [30.0, 0.0, z], [0.0, 30.0, 1.0 - z]], [z; 3], kt);
    let triangles = [at(0.3, 0.5), at(0.7, 0.0), at(0.1, 0.0), at(0.9, 0.2)];
    let order = back_to_front(&triangles, SUBPIXEL_BITS);
    assert_eq!((order.order[..2].to_vec(), order.transparent), (vec![1, 2], 2));
    assert!(
        order.intersections.len() == 1 && order.intersections[0].iter().all(|place| [0, 3].contains(place))
    );
    let frame = Frame {
        mode: ShadeMode::Flat,
        triangles: vec![at(0.5, 0.0), at(0.5, 0.0)],
        ..Frame::new(SIDE, SIDE)
    };
    assert_eq!(sorted(frame).1, None);
}

#[test]
fn where_nothing_overlaps_the_farthest_vertex_decides() {
    // Side by side; the second is nearest with one vertex and farthest with another.
    let at = |place: f64, z: [f64; 3]| {
        triangle([[place, 0.0, z[0]], [place + 8.0, 0.0, z[1]], [place, 9.0, z[2]]], [0.5; 3], 0.5)
    };
    let triangles = [at(0.0, [0.4; 3]), at(10.0, [0.1, 0.9, 0.2]), at(20.0, [0.6; 3]), at(30.0, [0.4; 3])];
    assert_eq!(back_to_front(&triangles, SUBPIXEL_BITS).order, [1, 2, 0, 3], "equal ones stay as they are");
}

#[test]
fn too_many_to_compare_are_sorted_by_their_farthest_vertices_and_say_so() {
    // One upon the other, and more pairs than are looked at.
    let count = 6326u64;
    assert!(count * (count - 1) / 2 > MAX_PAIRS);
    let depth = |k: u64| (k * 5 % count) as f64 / count as f64;
    let triangles: Vec<_> = (0..count)
        .map(|k| triangle([[0.0, 0.0, 0.0], [8.0, 0.0, depth(k)], [0.0, 8.0, 0.0]], [0.5; 3], 0.5))
        .collect();
    let order = back_to_front(&triangles, SUBPIXEL_BITS);
    assert!(order.unchecked && order.warning().is_some_and(|text| text.contains("farthest vertices only")));
    let depths: Vec<_> = order.order.iter().map(|place| triangles[*place].0[1].z).collect();
    assert!(depths.len() == triangles.len() && depths.is_sorted_by(|a, b| a > b));
}
