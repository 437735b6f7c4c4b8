//! Lines in every direction, on centres and between them, over each side of the screen and beside it.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::Plan;

/// From left to right or from above, x or y first; the other way round each time too.
pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    let pen = Pen::new(machine);
    let (w, h) = pen.size();
    let both = |a: (f64, f64), b: (f64, f64)| [pen.line([a, b], [0.2, 0.8]), pen.line([b, a], [0.3, 0.7])];
    let all = |ends: &[((f64, f64), (f64, f64))]| -> Vec<Triangle> {
        ends.iter().flat_map(|(a, b)| both(*a, *b)).collect()
    };
    let fan = (0..16).map(|k| {
        let angle = f64::from(k) * std::f64::consts::TAU / 16.0;
        let end = (5.5 + 4.5 * angle.cos(), 5.5 + 4.5 * angle.sin());
        pen.line([(5.5, 5.5), end], [0.1 + f64::from(k) / 20.0, 0.5])
    });
    vec![
        case("sixteen_directions", fan),
        case(
            "on_centres",
            all(&[((1.5, 2.5), (8.5, 2.5)), ((2.5, 1.5), (2.5, 8.5)), ((1.5, 1.5), (7.5, 7.5))]),
        ),
        case(
            "between_two_pixels",
            all(&[((1.0, 3.0), (8.0, 3.0)), ((3.0, 1.0), (3.0, 8.0)), ((1.5, 2.5), (9.5, 6.5))]),
        ),
        case("within_a_pixel", all(&[((3.25, 4.5), (3.75, 4.5)), ((3.5, 4.25), (3.5, 4.75))])),
        case("without_a_pixel", all(&[((3.75, 4.5), (4.25, 4.5)), ((4.5, 4.5), (4.5, 4.5))])),
        case("over_the_sides", all(&[((-3.0, 4.25), (w + 3.0, 5.75)), ((4.25, -3.0), (5.75, h + 3.0))])),
        case(
            "over_the_corners",
            all(&[((-4.0, 3.0), (3.0, -4.0)), ((w - 3.0, h + 4.0), (w + 4.0, h - 3.0))]),
        ),
        case(
            "beside_the_screen",
            all(&[
                ((1.0, -2.0), (9.0, -1.5)),
                ((1.0, h + 2.0), (9.0, h + 1.5)),
                ((-2.0, 1.0), (-1.5, 9.0)),
                ((w + 2.0, 1.0), (w + 1.5, 9.0)),
            ]),
        ),
        case(
            "first_column_behind_all_vertices",
            all(&[((-3.0, 0.5), (0.4, 9.5)), ((0.5, -3.0), (9.5, 0.4))]),
        ),
        case(
            "a_path_without_a_gap",
            [(1.0, 1.0), (7.0, 3.0), (9.0, 8.0), (2.0, 7.0)]
                .windows(2)
                .map(|ends| pen.line([ends[0], ends[1]], [0.4, 0.6]))
                .collect::<Vec<_>>(),
        ),
        case(
            "line_and_triangle_in_turn",
            [
                pen.line([(0.0, 0.0), (9.0, 9.0)], [0.5, 0.5]),
                pen.dot(3.0, 3.0, 0.2),
                pen.line([(0.0, 4.0), (9.0, 3.0)], [0.1, 0.3]),
                pen.dot(3.0, 3.0, 0.1),
            ],
        ),
    ]
}
