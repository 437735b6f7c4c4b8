//! POLY against golden's edge table, against exact planes, and against EDGE.

use crate::common::polygon::{Contours, KINDS, golden, loaded, shape, vertices};
use crate::common::rule::exact_value;
use crate::common::{ALWAYS, Triangle, any_triangle, fragments, machine, render};
use edgewalk_machine::{Machine, Plan, PortVertex, Role, Sides, Window};
use edgewalk_model::{DrawState, Events, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};
use std::collections::BTreeSet;

type Pixels = BTreeSet<(i64, i64)>;

/// A small screen with POLY, and these keys.
fn small(keys: &[(&str, &str)]) -> Plan {
    let own = [("screen.width", "24"), ("screen.height", "20"), ("screen.guard_bits", "9")];
    machine(&[&own[..], &[("polygon.edges", "64")], keys].concat())
}

/// Vertices whose values are all alike.
fn flat(plan: &Plan, contours: &Contours) -> Vec<Vec<PortVertex>> {
    vertices(plan, contours, |_, _| 5)
}

fn window_of(plan: &Plan, vertices: &[Vec<PortVertex>]) -> Window {
    plan.window_from(&vertices.concat())
}

/// The pixels of these tokens, none of which may come twice.
fn pixels(plan: &Plan, tokens: &[Triangle]) -> Pixels {
    let mut pixels = Pixels::new();
    fragments(plan, tokens, |_, at, _| assert!(pixels.insert(at), "{at:?} drawn twice"));
    pixels
}

fn drawn(plan: &Plan, contours: &Contours) -> Pixels {
    let vertices = flat(plan, contours);
    pixels(plan, &plan.polygon(&vertices, window_of(plan, &vertices)))
}

/// So many polygons of every kind, in machines of all numbers of sub-pixel bits.
fn same_pixels(count: u64) {
    let (mut checked, mut covered) = (0, 0);
    for bits in 0..=8u32 {
        let plan = small(&[("screen.subpixel_bits", &bits.to_string())]);
        let mut rng = StdRng::seed_from_u64(u64::from(bits));
        for number in 0..count / 9 {
            let contours = shape(&plan, KINDS[number as usize % KINDS.len()], &mut rng);
            let expected = golden(&plan, &contours);
            assert_eq!(drawn(&plan, &contours), expected, "{bits} bits: {contours:?}");
            covered += expected.len();
            checked += 1;
        }
    }
    println!("{checked} of {} polygons, {covered} pixels: 0 differ", count / 9 * 9);
    assert!(checked > 0 && covered > 20 * checked, "{checked} polygons, {covered} pixels");
}

#[test]
fn polygons_cover_goldens_pixels() {
    same_pixels(900);
}

/// `cargo test --release -p edgewalk-model polygon::many -- --ignored --nocapture`
#[test]
#[ignore = "a minute"]
fn many_polygons_cover_goldens_pixels() {
    same_pixels(10_008);
}

#[test]
fn the_order_of_ties_changes_no_pixel() {
    let plan = small(&[]);
    let mut rng = StdRng::seed_from_u64(5);
    let mut checked = 0;
    for number in 0..210 {
        let contours = shape(&plan, KINDS[number % KINDS.len()], &mut rng);
        let expected = golden(&plan, &contours);
        // Backwards, and from another vertex on.
        let mut turned: Contours = contours.iter().rev().cloned().collect();
        for contour in &mut turned {
            contour.reverse();
            let first = rng.random_range(0..contour.len());
            contour.rotate_left(first);
        }
        assert_eq!(drawn(&plan, &turned), expected, "{contours:?}");
        // The tokens of edges may come in any order, and the plane from anywhere: its sides count for nothing here.
        let vertices = flat(&plan, &contours);
        let mut tokens = plan.polygon(&vertices, Window::default());
        let Some(last) = tokens.pop() else { continue };
        let sides = Role::of(&last).sides();
        tokens.reverse();
        let rng = &mut rng;
        tokens.insert(rng.random_range(0..=tokens.len()), plan.with_role(last, Role::Edges(sides)));
        tokens.push(plan.with_role(last, Role::Plane(Sides::default())));
        assert_eq!(pixels(&plan, &tokens), expected, "{contours:?}");
        checked += 1;
    }
    assert!(checked > 180, "{checked}");
}

#[test]
fn bands_cover_the_pixels_of_the_whole() {
    let plan = small(&[]);
    let mut rng = StdRng::seed_from_u64(6);
    let mut drawn = 0;
    for number in 0..140 {
        let contours = shape(&plan, KINDS[number % KINDS.len()], &mut rng);
        let vertices = flat(&plan, &contours);
        let (mut all, mut from) = (Pixels::new(), 0);
        while from < plan.height {
            let to = (from + rng.random_range(1..9)).min(plan.height);
            let window = Window { x0: rng.random_range(0..24), y0: from, y1: to };
            let band = pixels(&plan, &plan.polygon(&vertices, window));
            assert!(band.iter().all(|(_, y)| (i64::from(from)..i64::from(to)).contains(y)));
            assert!(band.is_disjoint(&all));
            all.extend(band);
            from = to;
        }
        drawn += all.len();
        assert_eq!(all, golden(&plan, &contours), "{contours:?}");
    }
    assert!(drawn > 2000, "{drawn}");
}

/// The values of a polygon against the plane of its last token, exact: no word is farther from it than the bound of the
/// steps between. Gives how much of the bound was reached, in thousandths.
fn within_bound(plan: &Plan, contours: &Contours, rng: &mut StdRng) -> (usize, i128) {
    let [a, b]: [Vec<i64>; 2] =
        std::array::from_fn(|_| plan.channels().iter().map(|_| rng.random_range(-6..=6)).collect());
    let value = |channel: usize, p: [i32; 2]| {
        let format = &plan.channels()[channel];
        let middle = (format.limit() << format.vertex_fraction) as i64 / 2;
        let slope = [a[channel], b[channel]];
        let moved: i64 = slope.iter().zip(p).map(|(slope, at)| slope * i64::from(at)).sum();
        middle + (moved >> plan.subpixel_bits)
    };
    let vertices = vertices(plan, contours, value);
    let window = Window { x0: rng.random_range(0..24), y0: rng.random_range(0..5), y1: plan.height };
    let tokens = plan.polygon(&vertices, window);
    let Some(plane) = tokens.last().copied() else { return (0, 0) };
    let (mut values, mut reached) = (0, 0);
    fragments(plan, &tokens, |_, (x, y), outputs| {
        for (i, (channel, output)) in plan.channels().iter().zip(outputs).enumerate() {
            let (numerator, denominator) = exact_value(plan, &plane, i, x, y);
            let away = (x - i64::from(window.x0)).abs() + (y - i64::from(window.y0));
            // In 2^-(r + 1) LSB: the output is rounded, so half an LSB more.
            let one = 2i128 << channel.fraction;
            let error = (i128::from(output) * denominator - numerator).abs() * one;
            let bound = one / 2 + 1 + i128::from(away);
            assert!(error <= bound * denominator, "channel {i} at {x}, {y}: {output}, {contours:?}");
            values += 1;
            reached =
                reached.max((error - one / 2 * denominator) * 1000 / denominator / (1 + i128::from(away)));
        }
    });
    (values, reached)
}

#[test]
fn values_stay_within_the_planes_bound() {
    let mut rng = StdRng::seed_from_u64(7);
    let (mut values, mut reached) = (0, 0);
    for fraction in ["4", "5", "7"] {
        let plan = small(&[
            ("formats.z_fraction", fraction),
            ("formats.z_bits", "16"),
            ("formats.color_fraction", fraction),
            ("interpolator.adders", "2"),
        ]);
        for number in 0..300 {
            // Of far ones the plane's rounded vertices may lie outside what a word holds.
            let contours = shape(&plan, KINDS[number % 5], &mut rng);
            let (more, most) = within_bound(&plan, &contours, &mut rng);
            (values, reached) = (values + more, reached.max(most));
        }
    }
    println!("{values} values: 0 beyond, {reached} thousandths of the steps' bound reached");
    assert!(values > 340_000 && reached > 500, "{values} values, {reached}");
}

/// The machine without POLY.
fn with_edge(plan: &Plan) -> Plan {
    Machine::clone(plan).with(|m| m.polygon.edges = 0).plan().expect("can be built")
}

/// The same vertices at the port of another machine.
fn at_port(plan: &Plan, triangle: &Triangle) -> Triangle {
    let values = plan.channels().len();
    triangle.map(|v| plan.raw_vertex(v.x(), v.y(), &v.values()[..values]))
}

#[test]
fn triangles_cover_the_pixels_that_edge_gives() {
    for keys in [&[][..], &[("edge.kind", "slope"), ("edge.fraction_bits", "20")]] {
        let poly = small(keys);
        let edge = with_edge(&poly);
        let mut rng = StdRng::seed_from_u64(8);
        let triangles: Vec<Triangle> = (0..600).map(|_| any_triangle(&edge, &mut rng)).collect();
        let windowed: Vec<Triangle> = triangles
            .iter()
            .map(|triangle| {
                let triangle = at_port(&poly, triangle);
                poly.with_window(triangle, poly.window_from(&triangle))
            })
            .collect();
        let of = |plan: &Plan, triangles: &[Triangle]| {
            let mut all = BTreeSet::new();
            fragments(plan, triangles, |id, at, _| assert!(all.insert((id, at))));
            all
        };
        let expected = of(&edge, &triangles);
        assert!(expected.len() > 5000, "{}", expected.len());
        assert_eq!(of(&poly, &windowed), expected);
        let frame = render(&poly, &windowed, ALWAYS, Stalls::NONE);
        assert_eq!(frame.counters.triangles, 600);
    }
}

/// Clocks a line of polygons of `kind` that lie on 640 x 480, spans far shorter than the walk.
fn clocks_a_line(plan: &Plan, contours: &[Contours]) -> f64 {
    let (mut cycles, mut lines) = (0, 0u64);
    for contours in contours {
        let vertices = flat(plan, contours);
        let tokens = plan.polygon(&vertices, window_of(plan, &vertices));
        let mut rows = BTreeSet::new();
        fragments(plan, &tokens, |_, (_, y), _| _ = rows.insert(y));
        lines += rows.len() as u64;
        cycles += walk_cycles(plan, &tokens);
    }
    cycles as f64 / lines as f64
}

/// Cycles from the fire of the last token until POLY rests, with a SPAN that takes every line at once.
fn walk_cycles(plan: &Plan, tokens: &[Triangle]) -> u64 {
    let (mut poly, mut events, mut cycles) = (loaded(plan, tokens), Events::default(), 0);
    while poly.walking() {
        poly.step(None, false, poly.line().is_some(), false, &mut events);
        cycles += 1;
    }
    cycles
}

#[test]
fn a_line_takes_as_many_clocks_as_the_design_says() {
    let plan = machine(&[("polygon.edges", "64")]);
    let ring = |count: usize, radius: f64, turn: f64| -> Contours {
        let point = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64 + turn;
            [(320.0 + radius * angle.cos()) * 256.0, (240.0 + radius * angle.sin()) * 256.0]
                .map(|at| at as i32)
        };
        vec![(0..count).map(point).collect()]
    };
    let regular: Vec<Contours> = (3..40).map(|count| ring(count, 230.0, 0.1)).collect();
    let mut rng = StdRng::seed_from_u64(3);
    let convex: Vec<Contours> = (0..40)
        .map(|_| {
            let mut turns: Vec<f64> = (0..8).map(|_| rng.random_range(0.0..std::f64::consts::TAU)).collect();
            turns.sort_by(f64::total_cmp);
            turns.dedup();
            vec![
                turns
                    .iter()
                    .map(|angle| {
                        [(320.0 + 300.0 * angle.cos()) * 256.0, (240.0 + 230.0 * angle.sin()) * 256.0]
                            .map(|at| at as i32)
                    })
                    .collect(),
            ]
        })
        .collect();
    let concave: Vec<Contours> = (0..40)
        .map(|_| {
            let point = |k: usize| {
                let angle = std::f64::consts::TAU * k as f64 / 12.0;
                let radius = rng.random_range(20.0..235.0);
                [(320.0 + radius * angle.cos()) * 256.0, (240.0 + radius * angle.sin()) * 256.0]
                    .map(|at| at as i32)
            };
            vec![(0..12).map(point).collect()]
        })
        .collect();
    let figures = [("regular", regular, 4.3), ("convex", convex, 4.4), ("concave", concave, 13.0)];
    for (name, contours, most) in figures {
        let clocks = clocks_a_line(&plan, &contours);
        println!("{name}: {clocks:.2} clocks a line");
        assert!(clocks <= most && clocks > 2.0, "{name}: {clocks:.2}");
    }
}

/// A sheet of 100 by 60 quads on 640 x 480 that leans to the right, its depth and colours in one plane.
fn sheet(plan: &Plan) -> Vec<Vec<PortVertex>> {
    let corner = |column: i32, row: i32| {
        let at = [1500 * column + 60 * row + 700, 1900 * row + 30 * column + 500];
        let value = |k: i64| 200 + k * (i64::from(at[0]) / 256 + i64::from(at[1]) / 128);
        plan.raw_vertex(at[0], at[1], &[16 * value(40), value(1), value(2), value(1)])
    };
    let quads = (0..60).flat_map(|row| (0..100).map(move |column| [column, row]));
    let corners = |[x, y]: [i32; 2]| [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
    quads.map(|quad| corners(quad).map(|[x, y]| corner(x, y)).into()).collect()
}

/// A number from 1,000 to 999,999 as pages write it.
fn grouped(number: u64) -> String {
    if number < 1000 {
        return number.to_string();
    }
    format!("{},{:03}", grouped(number / 1000), number % 1000)
}

/// Figures of `docs/polygons.md`: `cargo test --release -p edgewalk-model polygon::quads -- --nocapture`.
#[test]
fn quads_take_fewer_clocks_than_triangles() {
    let poly = machine(&[("polygon.edges", "64")]);
    let edge = with_edge(&poly);
    let quads = sheet(&poly);
    let as_polygons: Vec<Triangle> = quads
        .iter()
        .flat_map(|quad| poly.polygon(std::slice::from_ref(quad), poly.window_from(quad)))
        .collect();
    let halves = |plan: &Plan, quad: &[PortVertex]| {
        [[0, 1, 2], [0, 2, 3]].map(|half| plan.windowed(at_port(plan, &half.map(|k: usize| quad[k]))))
    };
    let of = |plan: &Plan| -> Vec<Triangle> { quads.iter().flat_map(|quad| halves(plan, quad)).collect() };
    let frame = |plan: &Plan, tokens: &[Triangle]| render(plan, tokens, DrawState::default(), Stalls::NONE);
    let drawn = [frame(&poly, &as_polygons), frame(&poly, &of(&poly)), frame(&edge, &of(&edge))];
    let page = include_str!("../../../docs/polygons.md");
    let names = ["quads by POLY", "triangles by POLY", "triangles by EDGE"];
    let rows = names.iter().zip(&drawn).map(|(name, frame)| {
        let [edges, channels] = frame.counters.setup_clocks;
        assert_eq!(frame.coverage, drawn[0].coverage, "{name}");
        format!("| {name} | {} | {} |", grouped(frame.counters.cycles), grouped(edges + channels))
    });
    let rows = rows.collect::<Vec<_>>().join("\n");
    println!("{rows}");
    assert!(page.contains(&rows), "docs/polygons.md has not: {rows}");
    assert_eq!(quads.len(), 6000);
    let setup = |k: usize| drawn[k].counters.setup_clocks.iter().sum::<u64>();
    assert!(setup(0) * 10 < setup(2) * 8, "{} {}", setup(0), setup(2));
    assert!(drawn[0].counters.cycles < drawn[2].counters.cycles);
}
