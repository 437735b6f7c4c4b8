//! What DITHER does at each place of its pattern: colours at the ends of their range and between, k_t at and one beyond each sixteenth,
//! and triangles whose first fragments are dropped.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::Plan;

/// Numbers of the pattern, line by line.
const PATTERN: [[u32; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// Columns and lines of the pattern.
fn places() -> impl Iterator<Item = (usize, usize)> {
    (0..16).map(|place| (place % 4, place / 4))
}

pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    let dots = Dots { machine, pen: Pen::new(machine) };
    let most = machine.color.max();
    let color = |lsb: u64| lsb.min(most) as f64 / most as f64;
    let each = |colors: fn(u64, u64) -> [u64; 3]| {
        let dots = &dots;
        places()
            .zip(0u64..)
            .map(move |(place, number)| dots.dot(place, 0.5, colors(number, most).map(color), 0.0))
    };
    let mut cases = vec![
        case("black_and_white_in_each_place", {
            [0.0, 1.0].into_iter().flat_map(|share| {
                let z = 0.9 - 0.2 * share;
                let dots = &dots;
                places().map(move |place| dots.dot(place, z, [share, 1.0 - share, share], 0.0))
            })
        }),
        case(
            "colours_of_every_kind_in_each_place",
            each(|n, most| [n * 37 + 5, n * 53 + 2, n * 71].map(|c| c % (most + 1))),
        ),
        case(
            "one_below_and_one_above_black_and_white",
            each(|n, most| [1 + n % 2, most - 1 - n % 2, most / 2 + n % 2]),
        ),
    ];
    if machine.dither.drops() {
        let one = f64::from(1u32 << machine.blend.kt_bits);
        cases.extend([
            case("each_place_at_its_sixteenth", {
                places().map(|(x, y)| dots.dot((x, y), 0.6, [0.2, 0.5, 0.8], f64::from(PATTERN[y][x]) / 16.0))
            }),
            case("each_place_one_beyond_its_sixteenth", {
                places().map(|(x, y)| {
                    dots.dot((x, y), 0.4, [0.8, 0.5, 0.2], f64::from(PATTERN[y][x]) / 16.0 + 1.0 / one)
                })
            }),
            case(
                "each_place_of_glass_as_clear_as_can_be",
                places().map(|place| dots.dot(place, 0.3, [1.0; 3], 1.0)),
            ),
            case("first_fragments_are_dropped_and_the_same_pixels_met_again", {
                (0..16u32).map(|step| {
                    let z = 0.9 - f64::from(step) / 20.0;
                    let corners = [(0.0, 0.0), (5.0, 0.0), (0.0, 5.0)];
                    corners.map(|at| dots.pen.glass(at, [z, 0.4, 0.6, z], f64::from(step) / 16.0))
                })
            }),
        ]);
    }
    cases
}

struct Dots<'a> {
    machine: &'a Plan,
    pen: Pen<'a>,
}

impl Dots<'_> {
    /// One pixel of one colour and this k_t, on its own place of the pattern, or as far right and down as the screen has places.
    fn dot(&self, (x, y): (usize, usize), z: f64, [r, g, b]: [f64; 3], kt: f64) -> Triangle {
        let within = |place: usize, side: u32| f64::from((place as u32).min(side - 1));
        let (x, y) = (within(x, self.machine.width), within(y, self.machine.height));
        [(x, y), (x + 1.5, y), (x, y + 1.5)].map(|at| self.pen.glass(at, [z, r, g, b], kt))
    }
}
