//! The fast path against ticking on machines with POLY: polygons, triangles and lines, with and without DITHER.

use crate::common::polygon::{KINDS, shape, vertices};
use crate::common::{Triangle, machine, random_values, render};
use crate::fast::{compare, random_machine_with, random_triangles};
use edgewalk_machine::{Hazard, Lines, Machine, Plan, PortVertex, Role, Sides, Window};
use edgewalk_model::fast::{self, Passage, Path, Reason, Renderer};
use edgewalk_model::{DrawState, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

/// What was compared.
#[derive(Clone, Copy, Debug, Default)]
struct Met {
    frames: u32,
    polygons: u32,
    triangles: u32,
    lines: u32,
    /// Frames with rounded colours.
    dithered: u32,
    /// Depths and colours of pixels, and counters.
    values: u64,
    fast: u32,
    ticked: u32,
}

/// A machine with POLY that need not be ticked for a unit behind PIXEL, in three of four; fences that are waited for often.
fn random_machine(rng: &mut impl Rng) -> Plan {
    loop {
        let edges = [8, 16, 32, 64, 128][rng.random_range(0..5)];
        let plan = random_machine_with(edges, rng);
        if plan.channels().len() == 4 && !plan.blend.is_there() || rng.random_bool(0.05) {
            return plan;
        }
    }
}

/// A polygon as the host sends it, in one window or in bands; now and then without its last tokens, with sides taken out, or
/// with a plane that has no area.
fn polygon(plan: &Plan, rng: &mut StdRng) -> Vec<Triangle> {
    let contours = shape(plan, KINDS[rng.random_range(0..KINDS.len())], rng);
    let with_values =
        |v: PortVertex, rng: &mut StdRng| plan.raw_vertex(v.x(), v.y(), &random_values(plan, rng));
    let corners: Vec<Vec<PortVertex>> = vertices(plan, &contours, |_, _| 0)
        .into_iter()
        .map(|contour| contour.into_iter().map(|vertex| with_values(vertex, rng)).collect())
        .collect();
    let whole = plan.window_from(&corners.concat());
    let windows = match rng.random_range(0..3) {
        0 => {
            let height = rng.random_range(1..plan.height + 2);
            (0..plan.height)
                .step_by(height as usize)
                .map(|y0| Window { x0: rng.random_range(0..plan.width), y0, y1: y0 + height })
                .collect()
        }
        _ => vec![whole],
    };
    let mut tokens: Vec<Triangle> =
        windows.into_iter().flat_map(|window| plan.polygon(&corners, window)).collect();
    if rng.random_bool(0.1) {
        let place = rng.random_range(0..=tokens.len());
        tokens.drain(..place);
    }
    if rng.random_bool(0.1)
        && let Some(last) = tokens.last_mut()
    {
        *last = match rng.random_range(0..3) {
            0 => plan.with_role(*last, Role::Plane(Sides::default())),
            1 => plan.with_role(*last, Role::Plane(Sides::of_bits(rng.random_range(0..8)))),
            _ => plan.with_window(
                plan.with_role([last[0], last[0], last[1]], Role::Plane(Sides::default())),
                Window::of(last),
            ),
        };
    }
    tokens
}

/// Polygons, triangles and lines in turn.
fn primitives(plan: &Plan, met: &mut Met, rng: &mut StdRng) -> Vec<Triangle> {
    let mut tokens = Vec::new();
    for _ in 0..rng.random_range(0..24) {
        if rng.random_bool(0.6) {
            tokens.extend(polygon(plan, rng));
            continue;
        }
        for primitive in random_triangles(plan, rng).into_iter().take(3) {
            tokens.push(plan.windowed(primitive));
        }
    }
    for token in &tokens {
        match Role::of(token) {
            Role::Triangle => met.triangles += 1,
            Role::Plane(_) => met.polygons += 1,
            Role::Line { .. } => met.lines += 1,
            Role::Edges(_) => {}
        }
    }
    tokens
}

/// Compares frames of so many machines.
fn same_frames(machines: u32, seed: u64) {
    let mut rng = StdRng::seed_from_u64(seed);
    let mut met = Met::default();
    for _ in 0..machines {
        let plan = random_machine(&mut rng);
        for _ in 0..3 {
            let tokens = primitives(&plan, &mut met, &mut rng);
            let state = DrawState {
                depth_func: if rng.random_bool(0.5) { 1 } else { rng.random_range(0..8) },
                depth_write: rng.random_bool(0.8),
                clear: [0; 3].map(|_: u64| rng.random_range(0..=plan.stored_color().max())),
                ..DrawState::default()
            };
            let path = compare(&plan, &tokens, state);
            met.frames += 1;
            // z, three colours, coverage, writes and id of each pixel; 14 counters.
            met.values += 7 * u64::from(plan.width) * u64::from(plan.height) + 14;
            met.fast += u32::from(path == Path::Fast);
            met.ticked += u32::from(path != Path::Fast);
            met.dithered += u32::from(path == Path::Fast && plan.dither.rounds());
        }
    }
    println!("{machines} machines, {met:?}: 0 differ");
    assert!(met.fast > met.frames / 2, "{met:?}");
    assert!(met.polygons > 3 * machines && met.triangles > machines && met.lines > machines / 2, "{met:?}");
    assert!(met.dithered > 0, "{met:?}");
}

#[test]
fn frames_with_polygons_equal_ticking() {
    same_frames(60, 1);
}

/// `cargo test --release -p edgewalk-model fast_poly::six -- --ignored --nocapture`
#[test]
#[ignore = "a minute"]
fn six_hundred_machines_equal_ticking() {
    same_frames(600, 2);
}

/// A frame that was drawn once, clocked for other timing keys.
#[test]
fn polygons_are_clocked_for_other_timing_keys() {
    let mut rng = StdRng::seed_from_u64(3);
    let (mut clocked, mut ticked) = (0, 0);
    for round in 0..60 {
        let edges = [8, 64, 128][round % 3];
        let machine = Machine::default().with(|m| {
            (m.width, m.height) = (rng.random_range(1..80), rng.random_range(1..60));
            (m.polygon.edges, m.span_fifo) = (edges, 4);
            m.polygon.lines = Lines::Yes;
        });
        let plan = machine.with(|m| (m.hazard, m.latency, m.inflight) = (Hazard::Forward, 1, 16));
        let plan = plan.plan().expect("can be built");
        let tokens = primitives(&plan, &mut Met::default(), &mut rng);
        let state = DrawState { depth_write: round % 5 > 0, ..DrawState::default() };
        let mut renderer = Renderer::new(&plan, true);
        let passage = match renderer.draw_passage(tokens.iter().copied(), state) {
            Ok(passage) => passage,
            Err(fast::Refusal::Tick(Reason::Polygons)) => continue,
            Err(other) => panic!("{other:?}"),
        };
        let drawn: u64 = passage.fates().iter().map(|fate| fate.pixels).sum();
        assert_eq!(drawn, renderer.counters().fragments);
        for _ in 0..4 {
            let other = machine.with(|m| {
                m.hazard = [Hazard::Drain, Hazard::Interlock, Hazard::Forward][rng.random_range(0..3)];
                (m.lanes, m.segments) = (1 << rng.random_range(0..3), 1 << rng.random_range(0..3));
                (m.adders, m.span_fifo) = (rng.random_range(1..=4), rng.random_range(1..10));
                (m.inflight, m.latency) = (rng.random_range(1..=16), rng.random_range(1..=8));
            });
            let other = other.plan().expect("timing keys do not clash with these words");
            let setup = Passage::setup(&other, &tokens).expect("its own vertices");
            match passage.clocked(&other, &setup) {
                Ok(counters) => {
                    assert_eq!(counters, render(&other, &tokens, state, Stalls::NONE).counters, "{other:?}");
                    clocked += 1;
                }
                Err(Reason::Queue | Reason::Interlock) => ticked += 1,
                Err(other) => panic!("{other:?}"),
            }
        }
    }
    println!("{clocked} clocked, {ticked} to be ticked");
    assert!(clocked > 100 && ticked > 5, "{clocked} clocked, {ticked} ticked");
}

/// Edges of one window and the plane of another, or a line, draw something that only ticking finds.
#[test]
fn tokens_of_no_polygon_are_ticked() {
    let keys =
        [("screen.width", "24"), ("screen.height", "20"), ("polygon.edges", "16"), ("polygon.lines", "yes")];
    let plan = machine(&keys);
    let corner = |x: i32, y: i32| plan.raw_vertex(x << 8, y << 8, &[5; 4]);
    let square = vec![vec![corner(2, 2), corner(12, 2), corner(12, 12), corner(2, 12)]];
    let whole = plan.polygon(&square, Window::default());
    let below = Window { y0: 8, ..Window::default() };
    let [edges, end] = [whole[0], whole[1]];
    let line = plan.windowed(plan.line([corner(1, 1), corner(1, 9)]));
    let draw = |tokens: &[Triangle]| compare(&plan, tokens, DrawState::default());
    assert_eq!(draw(&whole), Path::Fast);
    assert_eq!(draw(&[line, line]), Path::Fast);
    assert_eq!(draw(&[edges, plan.with_window(end, below)]), Path::Ticked(Reason::Polygons));
    assert_eq!(draw(&[edges, line]), Path::Ticked(Reason::Polygons));
}
