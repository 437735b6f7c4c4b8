//! Degenerate and extreme shapes: the places where rasterizers have their faults.

use super::pen::{Pen, case};
use super::{Case, Triangle, ladders, ties};
use edgewalk_machine::Plan;

const RAMP: [f64; 3] = [0.2, 0.5, 0.8];

/// The six orders of three vertices.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    let pen = Pen::new(machine);
    let mut cases = halves(&pen);
    cases.extend(without_pixels(&pen));
    cases.extend(neighbours(&pen));
    cases.extend(thin(&pen));
    cases.extend(smallest_carries(&pen));
    cases.extend(at_the_screen_sides(&pen));
    cases.extend(extreme_values(&pen));
    cases.extend(ties::cases(machine));
    // On a pixel that the other shapes leave alone, on any but the smallest screens.
    cases.push(ladders::down(&pen, 0.0, pen.size().1 - 1.0));
    cases
}

fn halves(pen: &Pen) -> Vec<Case> {
    let at = |points| pen.shaded(points, RAMP);
    let leaning = at([(2.0, 0.5), (9.0, 4.25), (4.0, 8.75)]);
    vec![
        case(
            "flat_top",
            [at([(1.0, 1.0), (8.0, 1.0), (3.0, 7.0)]), at([(8.0, 1.0), (1.0, 1.0), (11.0, 6.0)])],
        ),
        case(
            "flat_bottom",
            [at([(4.0, 1.0), (1.0, 7.0), (9.0, 7.0)]), at([(0.0, 2.0), (9.0, 6.0), (5.0, 6.0)])],
        ),
        case("flat_top_on_centres", [at([(1.5, 1.5), (6.5, 1.5), (1.5, 6.5)])]),
        case("flat_bottom_on_centres", [at([(1.5, 1.5), (6.5, 6.5), (1.5, 6.5)])]),
        case(
            "right_angles_at_each_corner",
            [
                at([(0.0, 0.0), (6.0, 0.0), (0.0, 6.0)]),
                at([(0.0, 0.0), (6.0, 0.0), (6.0, 6.0)]),
                at([(0.0, 0.0), (6.0, 6.0), (0.0, 6.0)]),
                at([(6.0, 0.0), (6.0, 6.0), (0.0, 6.0)]),
            ],
        ),
        case(
            "major_edge_left_and_right",
            [at([(3.0, 0.0), (9.0, 4.0), (3.0, 9.0)]), at([(9.0, 0.0), (2.0, 4.0), (9.0, 9.0)])],
        ),
        case(
            "knee_on_a_line_of_centres",
            [at([(3.0, 0.0), (9.0, 4.5), (2.0, 9.0)]), at([(8.0, 0.0), (1.0, 3.5), (7.0, 9.0)])],
        ),
        case(
            "knee_between_lines",
            [at([(3.0, 0.0), (9.0, 4.75), (2.0, 9.0)]), at([(8.0, 0.0), (1.0, 4.25), (7.0, 9.0)])],
        ),
        case("knee_one_line_below_the_top", [at([(4.0, 1.0), (9.0, 2.0), (1.0, 9.0)])]),
        case("knee_one_line_above_the_bottom", [at([(4.0, 1.0), (9.0, 8.0), (1.0, 9.0)])]),
        case("every_order_of_the_vertices", ORDERS.map(|order| order.map(|i| leaning[i]))),
        case("one_line_high", [at([(1.0, 2.25), (9.0, 2.5), (4.0, 2.75)])]),
        case(
            "steep_and_shallow_carries",
            [at([(0.0, 0.0), (11.0, 7.0), (1.0, 9.0)]), at([(11.0, 0.0), (0.0, 3.0), (10.0, 9.0)])],
        ),
    ]
}

fn without_pixels(pen: &Pen) -> Vec<Case> {
    let at = |points| pen.shaded(points, RAMP);
    vec![
        case("all_vertices_on_one_point", [at([(3.0, 3.0); 3])]),
        case("zero_area_on_a_slope", [at([(1.0, 1.0), (3.0, 3.0), (6.0, 6.0)])]),
        case("zero_area_horizontal", [at([(1.0, 2.5), (9.0, 2.5), (4.0, 2.5)])]),
        case("zero_area_vertical", [at([(2.5, 1.0), (2.5, 9.0), (2.5, 4.0)])]),
        case("between_two_lines_of_centres", [at([(1.0, 2.6), (9.0, 2.9), (4.0, 3.4)])]),
        case("between_the_centres_of_a_line", [at([(2.6, 2.0), (3.4, 2.2), (3.0, 4.0)])]),
        case(
            "apex_without_pixels",
            [at([(4.7, 0.0), (4.9, 8.0), (7.0, 9.0)]), at([(6.3, 0.0), (6.1, 8.0), (4.0, 9.0)])],
        ),
    ]
}

fn neighbours(pen: &Pen) -> Vec<Case> {
    let at = |points| pen.shaded(points, RAMP);
    vec![
        case(
            "edge_shared_by_two",
            [at([(1.0, 1.0), (9.0, 2.0), (8.0, 9.0)]), at([(1.0, 1.0), (8.0, 9.0), (0.0, 7.0)])],
        ),
        case(
            "edge_on_centres_shared_by_two",
            [at([(0.5, 0.5), (5.5, 0.5), (5.5, 5.5)]), at([(0.5, 0.5), (5.5, 5.5), (0.5, 5.5)])],
        ),
        case("corner_on_a_centre_shared_by_four", {
            let rim = [(1.0, 1.0), (8.0, 1.0), (8.0, 8.0), (1.0, 8.0)];
            (0..4).map(|i| at([(4.5, 4.5), rim[i], rim[(i + 1) % 4]])).collect::<Vec<_>>()
        }),
        case("fan_of_twelve", {
            let rim = |i: i32| {
                let angle = f64::from(i) * std::f64::consts::TAU / 12.0;
                (6.0 + 5.5 * angle.cos(), 6.0 + 5.5 * angle.sin())
            };
            (0..12).map(|i| at([(6.0, 6.0), rim(i), rim(i + 1)])).collect::<Vec<_>>()
        }),
    ]
}

fn thin(pen: &Pen) -> Vec<Case> {
    let mut cases = slivers(pen);
    // With more pixels a line than a pixel has sub-pixels an edge does not fit its modulus: SETUP waits for its digits.
    let long = 1.25 * pen.subpixels();
    if long + 6.0 < pen.limit() {
        cases.extend(too_flat(pen, long));
    }
    cases
}

/// A minor edge that passes a centre in its first line by less than the unit of its remainder: R - f = -1, which carries.
fn smallest_carries(pen: &Pen) -> Vec<Case> {
    let Some([x, y, dx, dy]) = smallest_carry(pen) else { return Vec::new() };
    let at = |points| pen.shaded(points, RAMP);
    let edge = [(x, y), (x + dx, y + dy)];
    vec![
        case("smallest_carry_of_the_upper_edge", [at([edge[0], edge[1], (x - 2.0, y + dy + 2.0)])]),
        case("smallest_carry_of_the_lower_edge", [at([(x + 1.0, y - 2.0), edge[0], edge[1]])]),
    ]
}

/// Where such an edge begins, and how far it goes, px. In sub-pixels: a pixel has p of them, and the edge begins e above a
/// line of centres and g before the second column from the left. It passes that column a line below if (p + e) dx = g dy + r
/// with 0 < r <= p.
fn smallest_carry(pen: &Pen) -> Option<[f64; 4]> {
    let p = pen.subpixels() as i64; // a power of two
    let step = pen.vertex_step();
    let e = p / 2 % step;
    let all = (2 * p..5 * p).step_by(step as usize);
    let all = all.flat_map(|dy| (step..dy).step_by(step as usize).map(move |dx| (dx, dy)));
    let (g, dx, dy) = all
        .map(|(dx, dy)| ((p + e) * dx / dy, (p + e) * dx % dy, dx, dy))
        .find(|(g, r, ..)| (1..=p).contains(r) && (p / 2 - g).rem_euclid(step) == 0)
        .map(|(g, _, dx, dy)| (g, dx, dy))?;
    let px = |sub: i64| sub as f64 / p as f64;
    Some([px(4 * p + p / 2 - g), px(2 * p + p / 2 - e), px(dx), px(dy)])
}

/// Of a triangle one edge alone runs so many pixels in a line.
fn too_flat(pen: &Pen, long: f64) -> Vec<Case> {
    let at = |points| pen.shaded(points, RAMP);
    let both = |points: [(f64, f64); 3]| [at(points), at(points.map(|(x, y)| (6.0 - x, y)))];
    vec![
        case("major_edge_alone_too_flat", both([(6.0 - long, 3.25), (-3.0, 3.45), (7.0, 4.25)])),
        case("first_minor_edge_alone_too_flat", both([(3.0, 1.0), (3.0 + long, 2.0), (3.0, 9.0)])),
        case("second_minor_edge_alone_too_flat", both([(3.0, 1.0), (3.0 + long, 9.0), (3.0, 10.0)])),
    ]
}

fn slivers(pen: &Pen) -> Vec<Case> {
    let at = |points| pen.shaded(points, RAMP);
    let (limit, (width, height)) = (pen.limit(), pen.size());
    vec![
        case("sliver_nearly_horizontal", [at([(0.0, 3.4), (11.0, 3.6), (11.0, 3.7)])]),
        case("sliver_nearly_vertical", [at([(3.4, 0.0), (3.6, 11.0), (3.7, 11.0)])]),
        case("sliver_on_the_diagonal", [at([(0.0, 0.0), (9.0, 9.0), (9.0, 9.4)])]),
        case("as_high_as_the_screen", [at([(2.0, 0.0), (4.0, height * 0.4), (3.0, height)])]),
        case("as_wide_as_the_screen", [at([(0.0, 2.0), (width, 4.0), (width * 0.3, 5.0)])]),
        case(
            "guard_band_to_guard_band_on_a_line",
            [at([(-limit, 3.25), (limit, 3.4), (0.0, 4.0)]), at([(limit, 5.25), (-limit, 5.4), (0.0, 6.0)])],
        ),
        case("guard_band_from_top_to_bottom", [at([(2.25, -limit), (3.0, 0.0), (3.75, limit)])]),
        case(
            "guard_band_wedges",
            [
                at([(-6.0, -limit), (9.0, limit), (2.0, limit - 3.0)]),
                at([(14.0, -limit), (3.0, limit), (8.0, 2.0 - limit)]),
                at([(5.0, -limit), (-5.0, 4.0), (11.0, limit)]),
            ],
        ),
        case("guard_band_diagonal_sliver", [at([(-limit, -limit), (limit, limit), (limit, limit - 1.0)])]),
    ]
}

fn at_the_screen_sides(pen: &Pen) -> Vec<Case> {
    let at = |points| pen.shaded(points, RAMP);
    let (w, h) = pen.size();
    // A guard band can be as narrow as the screen; then these reach as far as it allows.
    let far = 20.0f64.min(pen.limit() - 1.0);
    let both = |points: [(f64, f64); 3]| -> [Triangle; 2] {
        let mirrored = points.map(|(x, y)| (w - x, y));
        [at(points), at(mirrored)]
    };
    vec![
        case("wholly_left_and_right", both([(-9.0, 1.0), (-2.0, 3.0), (-6.0, 5.0)])),
        case("wholly_above", [at([(1.0, -9.0), (6.0, -3.0), (3.0, -1.0)])]),
        case("wholly_below", [at([(1.0, h + 1.0), (6.0, h + 3.0), (3.0, h + 5.0)])]),
        case("across_the_sides_major_inside", both([(4.0, 0.0), (-far, 3.0), (4.0, 6.0)])),
        case("across_the_sides_major_outside", both([(-far, 0.0), (4.0, 3.0), (-far, 6.0)])),
        case("across_the_top_knee_above", [at([(3.0, -6.0), (8.0, -2.0), (2.0, 4.0)])]),
        case("across_the_top_knee_below", [at([(3.0, -6.0), (8.0, 3.0), (2.0, 5.0)])]),
        case("across_the_bottom_knee_above", [at([(3.0, h - 6.0), (8.0, h - 2.0), (2.0, h + 4.0)])]),
        case("across_the_bottom_knee_below", [at([(3.0, h - 3.0), (8.0, h + 2.0), (2.0, h + 5.0)])]),
        case(
            "across_two_corners",
            [
                at([(-4.0, -3.0), (6.0, -1.0), (-2.0, 7.0)]),
                at([(w + 4.0, h + 3.0), (w - 6.0, h + 1.0), (w + 2.0, h - 7.0)]),
            ],
        ),
        case("last_column_and_last_line", [at([(w - 1.0, h - 1.0), (w, h - 1.0), (w - 1.0, h)])]),
        case(
            "ends_on_the_last_line_of_centres",
            [
                at([(1.0, h - 0.5), (8.0, h - 0.5), (4.0, h + 2.0)]),
                at([(4.0, h - 3.0), (1.0, h - 0.5), (8.0, h - 0.5)]),
            ],
        ),
        case("ends_on_the_last_column_of_centres", {
            let behind = w - 0.5 + 1.0 / pen.subpixels();
            let places =
                |x: f64| (0..3).map(move |i| std::array::from_fn(|j| if i == j { x } else { w + 2.0 }));
            let columns = places(w - 0.5).chain(places(behind));
            columns.map(|x: [f64; 3]| at([(x[0], 1.0), (x[1], 3.0), (x[2], 6.0)])).collect::<Vec<_>>()
        }),
        case("over_a_screen_strip", [at([(-far, 2.0), (w + far, 2.0), (w / 2.0, 8.0)])]),
    ]
}

fn extreme_values(pen: &Pen) -> Vec<Case> {
    let triangle = |points: [(f64, f64); 3], values: [[f64; 4]; 3]| -> Triangle {
        std::array::from_fn(|i| pen.vertex(points[i], values[i]))
    };
    let points = [(1.0, 1.0), (10.0, 3.0), (3.0, 9.0)];
    vec![
        case("all_zero", [triangle(points, [[0.0; 4]; 3])]),
        case("all_full_scale", [triangle(points, [[1.0; 4]; 3])]),
        case(
            "zero_to_full_scale",
            [
                triangle(points, [[0.0; 4], [1.0; 4], [0.0; 4]]),
                triangle(points, [[1.0; 4], [0.0; 4], [1.0; 4]]),
            ],
        ),
        case(
            "full_scale_in_a_sliver",
            [triangle(
                [(1.0, 1.0), (1.4, 9.0), (1.8, 9.0)],
                [[0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 1.0, 0.0], [0.0, 1.0, 0.0, 1.0]],
            )],
        ),
    ]
}
