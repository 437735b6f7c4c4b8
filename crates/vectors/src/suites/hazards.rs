//! Pixels that are met again while they are in flight. Random triangles hardly ever do this.
//!
//! SETUP takes longer than a pixel is in flight, so on the whole machine these bite only with stalls that keep depths,
//! writes or reads waiting for longer than SETUP takes (`late`); at the ports of DEPTH alone they always do.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::Plan;

/// Depths that pass and fail in turn under `less` and under `greater`.
const MIXED: [f64; 12] = [0.9, 0.5, 0.7, 0.3, 0.6, 0.1, 0.8, 0.1, 0.05, 0.4, 0.02, 0.0];

/// Three pixels so that every one follows every other at every distance up to five.
const ANY_ORDER: &str = "1112221233321131231323221123311213212";

pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    let pen = Pen::new(machine);
    let falling = |n: u32| (0..n).map(move |i| 1.0 - f64::from(i + 1) / f64::from(n + 1));
    let mut cases = vec![
        case("one_pixel_again_and_again_nearer", falling(12).map(|z| pen.dot(1.0, 1.0, z))),
        case("one_pixel_again_nearer_and_farther", MIXED.map(|z| pen.dot(2.0, 1.0, z))),
        case("one_pixel_again_at_equal_depth", [0.5; 6].map(|z| pen.dot(0.0, 2.0, z))),
        case("one_pixel_again_at_the_cleared_depth", [1.0; 4].map(|z| pen.dot(4.0, 2.0, z))),
        case("two_pixels_in_turn", {
            let column = |i: usize| 1.0 + (i % 2) as f64;
            MIXED.iter().enumerate().map(|(i, z)| pen.dot(column(i), 3.0, *z)).collect::<Vec<_>>()
        }),
        case("three_pixels_in_turn", {
            let column = |i: usize| 1.0 + (i % 3) as f64;
            MIXED.iter().enumerate().map(|(i, z)| pen.dot(column(i), 0.0, *z)).collect::<Vec<_>>()
        }),
        case("four_pixels_in_turn", {
            let column = |i: usize| 1.0 + (i % 4) as f64;
            MIXED.iter().enumerate().map(|(i, z)| pen.dot(column(i), 2.0, *z)).collect::<Vec<_>>()
        }),
        case("three_pixels_in_any_order", {
            // 37 depths in no order, falling on the whole.
            let z = |i: usize| (1.0 - i as f64 / 72.0) * (i * 23 % 37) as f64 / 36.0;
            let column = |digit: char| 2.0 + f64::from(digit.to_digit(10).unwrap_or(0));
            ANY_ORDER.chars().enumerate().map(|(i, at)| pen.dot(column(at), 3.0, z(i))).collect::<Vec<_>>()
        }),
        case("last_place_of_the_queue", last_place(&pen, machine.inflight)),
        case("two_writes_meet_a_third", two_writes(&pen, machine.inflight)),
        case("between_what_two_wrote", (0..5).flat_map(|n| between(&pen, 14 - 3 * n)).collect::<Vec<_>>()),
        case("one_pixel_again_around_half_depth", {
            [0.5, 0.4, 0.5, 0.6, 0.4, 1.0, 0.5, 0.0, 1.0].map(|z| pen.dot(5.0, 1.0, z))
        }),
        case("short_span_over_itself", {
            falling(8).map(|z| pen.level([(0.0, 4.0), (3.0, 4.0), (0.0, 5.0)], z))
        }),
        case("span_meets_its_end_from_the_other_side", {
            let right = [(0.0, 5.0), (4.0, 5.0), (0.0, 6.0)];
            let left = [(0.0, 5.0), (4.0, 5.0), (4.0, 6.0)];
            falling(8)
                .enumerate()
                .map(|(i, z)| pen.level(if i % 2 == 0 { right } else { left }, z))
                .collect::<Vec<_>>()
        }),
        case("fan_around_one_pixel", {
            let rim = [
                (3.0, 0.0),
                (6.0, 0.0),
                (6.0, 3.0),
                (6.0, 6.0),
                (3.0, 6.0),
                (0.0, 6.0),
                (0.0, 3.0),
                (0.0, 0.0),
            ];
            (0..8)
                .map(|i| pen.shaded([(3.5, 3.5), rim[i], rim[(i + 1) % 8]], [0.3, 0.4, 0.2]))
                .collect::<Vec<_>>()
        }),
        case("knee_line_of_one_pixel", {
            falling(4).map(|z| pen.shaded([(3.0, 1.0), (4.0, 3.0), (3.0, 5.0)], [z, z * 0.5, z * 0.9]))
        }),
        case("knee_line_of_two_pixels_to_the_left", {
            falling(4).map(|z| pen.shaded([(4.0, 1.0), (2.0, 3.0), (4.0, 5.0)], [z, z * 0.5, z * 0.9]))
        }),
    ];
    if machine.blend.is_there() {
        cases.extend([1, 2, 3].map(|pixels| {
            case(&format!("glass_on_{pixels}_pixels_in_turn"), glass(&pen, pixels, machine.z.bits))
        }));
        cases.push(case("glass_in_any_order", {
            let column = |digit: char| 2.0 + f64::from(digit.to_digit(10).unwrap_or(0));
            let z = |i: usize| 1.0 - (i + 1) as f64 / ANY_ORDER.len() as f64;
            let dot = |(i, at)| pen.glass_dot(column(at), 4.0, z(i), GLASS[i % GLASS.len()]);
            ANY_ORDER.chars().enumerate().map(dot).collect::<Vec<_>>()
        }));
    }
    cases
}

/// k_t: each of clear, opaque and between follows each.
const GLASS: [f64; 11] = [0.5, 0.5, 0.0, 0.75, 1.0, 0.0, 0.0, 0.25, 1.0, 1.0, 0.6];

/// Glass before glass, as many layers as there are depths for, on so many pixels in turn.
fn glass(pen: &Pen, pixels: u32, z_bits: u32) -> Vec<Triangle> {
    let layers = (1u32 << z_bits.min(5)) - 1;
    let layer = |i: u32| {
        let z = 1.0 - f64::from(i + 1) / f64::from(layers);
        (0..pixels).map(move |pixel| {
            let kt = GLASS[((i * pixels + pixel) as usize) % GLASS.len()];
            pen.glass_dot(f64::from(pixel + 3), 3.0, z, kt)
        })
    };
    (0..layers).flat_map(layer).collect()
}

/// Depth in fifteenths of full scale: 4 bits hold it.
fn fifteenths(n: u32) -> f64 {
    f64::from(n) / 15.0
}

/// As many pixels in turn as make a fragment take the last place of the queue while one of its pixel is at the head.
/// Every second one of a pixel passes, the one behind it must fail by what that one wrote.
fn last_place(pen: &Pen, places: u32) -> Vec<Triangle> {
    let pixels = places - 1;
    let visits = [12, 13, 10, 11, 8, 9, 6, 7, 4, 5, 2, 3, 0, 1];
    // Fewer where there are many pixels: what repeats teaches little.
    let visits = &visits[..if pixels <= 4 { visits.len() } else { 4 }];
    let dot = |pixel: u32, z: u32| pen.dot(f64::from(pixel % 6), f64::from(pixel / 6), fifteenths(z));
    visits.iter().flat_map(|z| (0..pixels).map(move |pixel| dot(pixel, *z))).collect()
}

/// Two that pass, and one that fails by what the second wrote, though it would pass by what the first did.
fn between(pen: &Pen, first: u32) -> [Triangle; 3] {
    [first, first - 2, first - 1].map(|z| pen.dot(1.0, 4.0, fifteenths(z)))
}

/// Two that pass, as many that fail as fill the queue, and one that enters when the first is written and the second passes: it
/// lies between the two. Again on other pixels, each time one fragment later: once the queue holds just these.
fn two_writes(pen: &Pen, places: u32) -> Vec<Triangle> {
    let round = |first: u32| {
        let failing = std::iter::repeat_n(first + 1, places.saturating_sub(2) as usize);
        [first, first - 2].into_iter().chain(failing).chain([first - 1])
    };
    let pixels = if places <= 5 { places + 1 } else { 1 };
    let dots = |pixel: u32| {
        let later = std::iter::repeat_n(15, pixel as usize);
        let depths = later.chain([14, 10, 6].into_iter().flat_map(round));
        depths.map(move |z| pen.dot(f64::from(pixel), 4.0, fifteenths(z)))
    };
    (0..pixels).flat_map(dots).collect()
}
