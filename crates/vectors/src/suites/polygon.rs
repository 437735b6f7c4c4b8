//! Polygons of every shape, and the corners of POLY.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::{Plan, Role, Sides, Window};
use std::slice::from_ref;

type Point = (f64, f64);

/// Around a point, as many corners as there are radii.
fn ring(at: Point, radii: impl ExactSizeIterator<Item = f64>) -> Vec<Point> {
    let count = radii.len() as f64;
    let corner = |(k, radius): (usize, f64)| {
        let angle = std::f64::consts::TAU * (k as f64 + 0.3) / count;
        (at.0 + radius * angle.cos(), at.1 + radius * angle.sin())
    };
    radii.enumerate().map(corner).collect()
}

/// Teeth that reach from one line to another.
fn comb(teeth: usize, (width, top, bottom): (f64, f64, f64)) -> Vec<Point> {
    let step = width / (2 * teeth) as f64;
    (0..2 * teeth).map(|k| (step * k as f64, if k % 2 == 0 { top } else { bottom })).collect()
}

/// Convex, concave, crossing, with holes; of several contours; before and behind triangles.
pub(super) fn shapes(machine: &Plan) -> Vec<Case> {
    let pen = Pen::new(machine);
    let (w, h) = pen.size();
    let (middle, far) = ((w / 2.0, h / 2.0), w.min(h) / 2.0 - 0.5);
    let places = machine.polygon.edges as usize;
    let of = |contours: &[Vec<Point>]| pen.polygon(contours, None);
    let convex = |corners: usize| ring(middle, (0..corners).map(|_| far));
    let star = ring(middle, (0..8).map(|k| if k % 2 == 0 { far } else { far / 3.0 }));
    let hole = [ring(middle, (0..7).map(|_| far)), ring(middle, (0..4).map(|_| far / 2.0))];
    let crossing = vec![(0.5, 0.5), (w - 0.5, h - 1.0), (0.5, h - 1.0), (w - 0.5, 0.5)];
    let wide = ring(middle, (0..6).map(|_| pen.limit()));
    let halves = [vec![(1.0, 1.0), (4.5, 1.0), (4.0, 5.0)], vec![(5.5, 2.0), (9.0, 5.5), (6.0, 7.0)]];
    let mut cases: Vec<Case> =
        (3..9).map(|corners| case(&format!("convex_{corners}"), of(&[convex(corners)]))).collect();
    cases.extend([
        case("star", of(&[star])),
        case("hole", of(&hole)),
        case("crossing", of(&[crossing])),
        case("two_contours", of(&halves)),
        case("over_the_screen", of(&[wide])),
        case("comb", of(&[comb(places / 2, (w, 0.5, h))])),
        case("polygon_and_triangle_in_turn", {
            let mut tokens = of(&[convex(5)]);
            tokens.push(pen.machine().windowed(pen.dot(3.0, 3.0, 0.2)));
            tokens.extend(of(&[convex(4)]));
            tokens.push(pen.machine().windowed(pen.dot(3.0, 3.0, 0.1)));
            tokens
        }),
    ]);
    cases
}

/// Vertices on centres, edges that touch, gaps, windows, tables that are full or too small, planes without area.
pub(super) fn corners(machine: &Plan) -> Vec<Case> {
    let pen = Pen::new(machine);
    let (w, h) = pen.size();
    let places = machine.polygon.edges as usize;
    let of = |contours: &[Vec<Point>]| pen.polygon(contours, None);
    let square = |x: f64, y: f64, side: f64| vec![(x, y), (x + side, y), (x + side, y + side), (x, y + side)];
    let diamond = vec![(4.5, 0.5), (8.5, 4.5), (4.5, 8.5), (0.5, 4.5)];
    let window = |y0: u32, y1: u32| Some(Window { x0: 1, y0, y1 });
    let as_role = |vertices: Triangle, role: Role| {
        machine.with_window(machine.with_role(vertices, role), Window::default())
    };
    let triangle = pen.shaded([(1.0, 1.0), (7.0, 2.0), (3.0, 7.0)], [0.2, 0.4, 0.6]);
    let low = pen.shaded([(1.0, 6.0), (4.0, 6.5), (2.0, 9.0)], [0.3; 3]);
    let flat = [triangle[0], triangle[1], triangle[1]];
    vec![
        case("vertices_on_centres", of(from_ref(&diamond))),
        case("edges_along_lines", of(&[square(1.0, 1.5, 4.0)])),
        case("contour_behind_contour", of(&[square(1.0, 1.0, 3.0), square(2.0, 4.0, 3.0)])),
        case("lines_without_edges", of(&[square(1.0, 1.0, 2.0), square(2.0, 6.0, 2.0)])),
        case("edges_of_one_line", of(&[vec![(1.0, 2.0), (9.0, 2.25), (8.5, 2.75), (1.5, 3.0)]])),
        case("edges_on_each_other", of(&[square(1.0, 1.0, 4.0), square(5.0, 1.0, 3.0)])),
        case("order_reversed", of(&[vec![(0.5, 1.0), (9.5, 1.5), (0.5, 2.5), (9.5, 2.75)]])),
        case("left_of_the_screen", of(&[vec![(-6.0, 1.0), (5.0, 2.0), (4.0, 7.0), (-5.0, 6.0)]])),
        case("right_of_the_screen", of(&[square(w + 1.0, 1.0, 3.0)])),
        case("as_many_edges_as_places", of(&[comb(places / 2, (w, 0.5, h - 0.5))])),
        case("one_edge_too_many", {
            let mut contour = comb(places / 2, (w, 0.5, h - 0.5));
            contour.push((w / 2.0, h + 3.0));
            of(&[contour])
        }),
        case("a_small_one_behind_it", of(&[square(2.0, 2.0, 3.0)])),
        case("window_above", pen.polygon(from_ref(&diamond), window(0, 2))),
        case("window_inside", pen.polygon(from_ref(&diamond), window(2, 5))),
        case("window_below", pen.polygon(&[diamond], window(6, 9))),
        case("end_alone", [as_role(triangle, Role::Plane(Sides::default()))]),
        case(
            "void",
            [as_role(triangle, Role::Edges(Sides::ALL)), as_role(flat, Role::Plane(Sides::default()))],
        ),
        case(
            "put_in_order",
            [as_role(low, Role::Edges(Sides::ALL)), as_role(triangle, Role::Plane(Sides::ALL))],
        ),
        // The second token's upper edges begin before the first one's, the lower edge behind them.
        case("an_edge_before_those_loaded", {
            let early = pen.shaded([(1.0, 3.0), (4.0, 3.5), (2.0, 9.0)], [0.3; 3]);
            let tall = pen.shaded([(2.0, 1.0), (8.0, 6.0), (1.0, 9.0)], [0.5; 3]);
            [as_role(early, Role::Edges(Sides::ALL)), as_role(tall, Role::Plane(Sides::ALL))]
        }),
        // Four pixels right of two others on one line, left of the screen on the next.
        case("order_reversed_beside_the_screen", {
            let upright = vec![(1.0, 1.0), (3.0, 1.0), (3.0, 8.0), (1.0, 8.0)];
            of(&[upright, vec![(12.0, 3.2), (-14.0, 5.2), (12.0, 7.0)]])
        }),
        // Six upright edges, and two that go before all of them on one line.
        case("before_six_others", {
            let columns = [1.0, 3.5, 6.0].map(|x| vec![(x, 1.0), (x + 1.5, 1.0), (x + 1.5, 8.0), (x, 8.0)]);
            let back = vec![(12.0, 3.2), (-14.0, 5.2), (12.0, 7.0)];
            of(&columns.into_iter().chain([back]).collect::<Vec<_>>())
        }),
        case("a_long_way_down", of(&[square(1.0, 1.0, 2.0), square(6.0, h - 3.0, 2.0)])),
        // The edges that go first are loaded last.
        case("the_lower_half_first", of(&[square(6.0, h - 3.0, 2.0), square(1.0, 1.0, 2.0)])),
        // Without lines a triangle. With them a thin polygon, of two edges on most lines.
        case("a_line_behind_edges", {
            let line = machine.line([triangle[0], triangle[2]]);
            let tall = pen.shaded([(1.0, 1.0), (4.0, 1.5), (2.0, h)], [0.3; 3]);
            [as_role(tall, Role::Edges(Sides::ALL)), machine.with_window(line, Window::default())]
        }),
        case("sides_that_do_not_count", {
            let some = |sides| Role::Edges(Sides::new(sides));
            [
                as_role(low, some([true, false, true])),
                as_role(triangle, Role::Plane(Sides::new([false, true, true]))),
            ]
        }),
    ]
}
