//! Machines with POLY: the model against the netlist, every port of the machine and of every unit in it, every cycle.

use crate::common::fail::{checked, checked_compiled};
use crate::common::machines::random_poly;
use crate::common::polygons::{Triangle, primitives};
use edgewalk_lockstep::{Case, Checked, Interface, Triangles, Unit};
use edgewalk_machine::{EdgeKind, Lines, Machine, Plan, PortVertex, Role, Sides, Values, Window};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// 24 x 20 pixels, quarters of them, eight edges.
fn small(keys: &[(&str, &str)]) -> Plan {
    let with = |m: &mut Machine| {
        (m.width, m.height, m.guard_bits, m.subpixel_bits) = (24, 20, 7, 2);
        (m.polygon.edges, m.polygon.lines) = (8, Lines::Yes);
    };
    let mut machine = Machine::default().with(with);
    for (key, value) in keys {
        machine.set(key, value).expect("a key of the machine");
    }
    machine.plan().expect("can be built")
}

/// Corners in quarters of a pixel.
fn contour(plan: &Plan, corners: &[[i32; 2]]) -> Vec<PortVertex> {
    let value = |k: usize| (100 * k as i64) % 255;
    let values = |k: usize| vec![value(k); plan.channels().len()];
    corners.iter().enumerate().map(|(k, [x, y])| plan.raw_vertex(*x, *y, &values(k))).collect()
}

/// All tokens, in a window that may leave some of them no line.
fn polygon(plan: &Plan, contours: &[&[[i32; 2]]], window: Window) -> Vec<Triangle> {
    let contours: Vec<Vec<PortVertex>> = contours.iter().map(|corners| contour(plan, corners)).collect();
    let tokens = plan.polygon(&contours, Window::default());
    tokens.into_iter().map(|token| plan.with_window(token, window)).collect()
}

/// The named corners of POLY, each as tokens.
fn corners(plan: &Plan) -> Vec<(&'static str, Vec<Triangle>)> {
    let whole = Window::default();
    let of = |contours: &[&[[i32; 2]]]| polygon(plan, contours, whole);
    let square = [[8, 8], [40, 8], [40, 40], [8, 40]];
    // Two, two and one edges enter and leave where a vertex lies on a line of centres.
    let diamond = [[40, 10], [70, 42], [40, 74], [10, 42]];
    let comb = |teeth: i32| -> Vec<[i32; 2]> {
        (0..2 * teeth).map(|k| [4 + 8 * k, if k % 2 == 0 { 4 } else { 60 }]).collect()
    };
    let (full, over) = (comb(4), comb(5));
    let crossing = [[4, 4], [90, 40], [4, 40], [90, 4]];
    let mut all = vec![
        ("vertices on a line of centres", of(&[&diamond])),
        ("horizontal edges on a line", of(&[&[[8, 10], [40, 10], [40, 42], [8, 42]]])),
        ("a contour begins where another one ends", of(&[&square, &[[8, 40], [40, 40], [24, 70]]])),
        ("lines without an edge", of(&[&square, &[[8, 60], [40, 60], [24, 78]]])),
        ("edges of one line", of(&[&[[8, 8], [40, 9], [38, 11], [12, 12]]])),
        ("edges on each other", of(&[&square, &[[40, 8], [72, 8], [72, 40], [40, 40]]])),
        ("the whole order reversed in one line", of(&[&[[0, 4], [90, 5], [88, 9], [2, 9]], &crossing])),
        (
            "four edges meet",
            of(&[&[[8, 8], [72, 72], [8, 72], [72, 8]], &[[40, 4], [44, 76], [40, 76], [36, 76]]]),
        ),
        (
            "edges left of the screen",
            of(&[&[[-60, 8], [30, 8], [30, 60], [-60, 60]], &[[-50, 4], [-40, 70], [-20, 10]]]),
        ),
        ("all right of the screen", of(&[&[[100, 8], [140, 8], [120, 60]]])),
        ("as many edges as there are places", of(&[&full])),
        ("one more", of(&[&over])),
        ("a small one behind it", of(&[&[[8, 8], [20, 12], [9, 30]]])),
        ("a window above", polygon(plan, &[&square], Window { y0: 0, y1: 2, x0: 0 })),
        ("a window inside", polygon(plan, &[&diamond], Window { y0: 6, y1: 12, x0: 20 })),
        ("a window below", polygon(plan, &[&diamond], Window { y0: 15, y1: 20, x0: 3 })),
    ];
    let square = contour(plan, &square);
    let role = |vertices: Triangle, role: Role| vec![plan.with_role(vertices, role)];
    let [a, b, c] = [square[0], square[1], square[2]];
    all.push(("no edge at all", role([a, b, c], Role::Plane(Sides::default()))));
    all.push(("a plane without area", {
        let mut tokens = role([a, b, c], Role::Edges(Sides::ALL));
        tokens.extend(role([a, c, c], Role::Plane(Sides::default())));
        tokens
    }));
    all.push(("an order that is put in place", {
        let low = contour(plan, &[[8, 40], [40, 44], [20, 70]]);
        let high = contour(plan, &[[8, 4], [40, 8], [20, 30]]);
        let mut tokens = role([low[0], low[1], low[2]], Role::Edges(Sides::ALL));
        tokens.extend(role([high[0], high[1], high[2]], Role::Plane(Sides::ALL)));
        tokens
    }));
    all.push(("a triangle", vec![plan.with_window([a, b, c], plan.window_from(&[a, b, c]))]));
    for ends in [[a, c], [a, square[3]]] {
        let line = plan.line(ends);
        all.push(("a line", vec![plan.with_window(line, Window { y0: 1, ..Window::default() })]));
    }
    all
}

/// Each corner by itself and all behind each other, with a memory that keeps the machine waiting and without.
#[test]
fn the_corners_of_poly_are_met_alike() {
    let mut all = Checked::default();
    let mut cases = 0;
    let kinds = [
        &[][..],
        &[("edge.kind", "slope"), ("edge.fraction_bits", "12"), ("setup.lanes", "1")],
        &[("edge.kind", "slope"), ("polygon.values", "bilinear")],
    ];
    for keys in kinds {
        let plan = small(keys);
        let port = Triangles::new(&plan);
        let corners = corners(&plan);
        let together: Vec<Triangle> = corners.iter().flat_map(|(_, tokens)| tokens).copied().collect();
        for (name, tokens) in corners.iter().cloned().chain([("all", [together.clone(), together].concat())])
        {
            for unwilling in [0, 120, 250] {
                let mut case = Case { seed: 7, about: name.to_owned(), ..Case::new(&plan, Unit::MACHINE) };
                case.unwilling = [("rd".to_owned(), unwilling), ("wr".to_owned(), unwilling)].into();
                case.state.depth_func = 7;
                case.tokens = (0..).zip(&tokens).map(|(tag, token)| port.pack(token, tag)).collect();
                all.merge(&checked_compiled(&case));
                cases += 1;
            }
        }
    }
    println!("{cases} cases, {} tokens, {} values of ports compared", all.tokens, all.compared);
    let poly = Unit::named("poly").expect("declared");
    let plan = small(kinds[2]);
    let declared: Vec<&str> = poly.events(&plan).iter().map(|event| event.name).collect();
    let declared = declared.into_iter().chain(["window_top", "window_bottom", "line_flat", "line_steep"]);
    let counts = all.events.counts();
    let unmet: Vec<&str> =
        declared.filter(|name| counts.iter().any(|(event, count)| event == name && *count == 0)).collect();
    assert_eq!(unmet, [""; 0], "not met");
    assert_eq!(cases, kinds.len() * 3 * (corners(&plan).len() + 1));
}

/// A reset in each cycle of a polygon's way through the machine, in turn.
#[test]
fn a_reset_is_alike_in_each_state_of_poly() {
    let mut compared = 0;
    for first in 0..40 {
        let bilinear = &[("edge.kind", "slope"), ("polygon.values", "bilinear")];
        let plan = small(if first % 2 == 0 { &[] } else { bilinear });
        let port = Triangles::new(&plan);
        let tokens = corners(&plan).into_iter().take(8).flat_map(|(_, tokens)| tokens);
        let tokens: Vec<_> = tokens.map(|token| port.pack(&token, 0)).collect();
        let mut case = Case { seed: first, disturbed: 5, ..Case::new(&plan, Unit::MACHINE) };
        case.resets = (0..60).map(|k| 20 + first + 41 * k).collect();
        case.tokens.clone_from(&tokens);
        compared += checked_compiled(&case).compared;
    }
    assert!(compared > 100_000, "{compared}");
}

/// Machines with POLY alone, drawn at random, their units compared inside.
fn machines(count: usize) {
    let mut rng = Pcg64Mcg::seed_from_u64(41);
    let mut all = Checked::default();
    for number in 0..count {
        let mut drawn = std::iter::repeat_with(|| random_poly(&mut rng));
        let plan =
            drawn.find(|plan| number % 8 == 0 || !plan.shade.is_there()).expect("half of them have none");
        let port = Triangles::new(&plan);
        let interface = Interface::new(&plan, Unit::MACHINE);
        let mut case = Case { seed: number as u64, ..Case::new(&plan, Unit::MACHINE) };
        let mut share = || if rng.random() { rng.random_range(1..200) } else { 0 };
        case.unwilling = interface
            .waits()
            .map(|link| {
                let most = if ["srd", "sdata", "rrd", "rdata"].contains(&link) { 60 } else { 200 };
                (link.to_owned(), share() % most)
            })
            .collect();
        case.state.light_pass = plan.shadow.draws_map() && rng.random();
        case.resets = if rng.random_bool(0.5) { vec![rng.random_range(1..3000)] } else { Vec::new() };
        case.disturbed = rng.random_range(0..40);
        let drawn = primitives(&plan, 60, &mut rng);
        case.tokens = (0..).zip(&drawn).map(|(tag, token)| port.pack(token, tag)).collect();
        all.merge(&checked_compiled(&case));
    }
    println!("{count} machines, {} tokens, {} values of ports compared", all.tokens, all.compared);
    println!("{:?}", all.events.poly);
    assert!(all.tokens > 50 * count as u64);
}

#[test]
fn machines_with_poly_are_alike() {
    machines(16);
}

/// `cargo test --release -p edgewalk-lockstep polygon::two_hundred -- --ignored --nocapture`
#[test]
#[ignore = "minutes"]
fn two_hundred_machines_with_poly_are_alike() {
    machines(200);
}

/// SETUP and POLY alone with 1, 2 and 4 lanes and default formats: numbers of full length.
#[test]
fn setup_and_poly_alone_are_alike() {
    let mut rng = Pcg64Mcg::seed_from_u64(43);
    let mut all = Checked::default();
    for lanes in [1, 2, 4] {
        let kinds = [(EdgeKind::Exact, Values::Plane), (EdgeKind::Slope, Values::Bilinear)];
        for (kind, (name, count)) in
            kinds.into_iter().flat_map(|kind| [("setup", 150), ("poly", 60)].map(|unit| (kind, unit)))
        {
            let with = |m: &mut Machine| {
                (m.polygon.edges, m.lanes, m.tag_bits) = (16, lanes, 4);
                (m.edge_kind, m.polygon.values) = kind;
            };
            let plan = Machine::default().with(with).plan().expect("can be built");
            let unit = Unit::named(name).expect("declared");
            let mut case = Case { seed: 3, cycles: 20_000, disturbed: 10, ..Case::new(&plan, unit) };
            case.tokens = crate::common::tokens::random_tokens(&plan, unit, count, &mut rng);
            case.unwilling = [("line".to_owned(), 60), ("prim".to_owned(), 60)].into();
            case.unwilling.retain(|link, _| Interface::new(&plan, unit).waits().any(|wait| wait == link));
            all.merge(&checked(&case));
        }
    }
    println!("{} tokens, {} values of ports compared", all.tokens, all.compared);
    assert!(all.tokens > 300, "{}", all.tokens);
}
