//! The fast path against ticking: every pixel, every count, over machines and triangles drawn at random.

use edgewalk_machine::keys::{Domain, KEYS};
use edgewalk_machine::{Machine, Plan, PortVertex};
use edgewalk_model::fast::{self, Path, Reason};
use edgewalk_model::{Activity, Coverage, DrawState, Frame, Stalls, render};
use rand::{Rng, SeedableRng, rngs::StdRng};

type Triangle = [PortVertex; 3];

/// A machine with every key drawn at random, on a small screen.
fn random_machine(rng: &mut impl Rng) -> Plan {
    loop {
        let mut machine = Machine::default();
        for key in KEYS {
            let value = match key.domain {
                Domain::Range(low, high) => rng.random_range(low..=high),
                Domain::OneOf(list) => list[rng.random_range(0..list.len())],
                Domain::Word(words) => rng.random_range(0..words.len() as u32),
            };
            (key.set)(&mut machine, value);
        }
        machine.width = rng.random_range(1..80);
        machine.height = rng.random_range(1..60);
        if rng.random_bool(0.5) {
            machine.span_fifo = rng.random_range(1..5);
        }
        if let Ok(plan) = machine.plan() {
            return plan;
        }
    }
}

/// Triangles of every kind: tiny ones that pile up, large ones, degenerate ones, off the screen, to the guard band.
fn random_triangles(machine: &Plan, rng: &mut impl Rng) -> Vec<Triangle> {
    let one = f64::from(1u32 << machine.subpixel_bits);
    let limit = f64::from((1u32 << machine.guard_bits) - 1);
    let mut middle = [0.0; 2];
    let count = rng.random_range(0..60);
    (0..count)
        .map(|_| {
            if rng.random_bool(0.6) {
                middle =
                    [machine.width, machine.height].map(|side| rng.random_range(-0.2..1.2) * f64::from(side));
            }
            let size = 2f64.powf(rng.random_range(-2.0..7.5)).min(limit);
            let wide = rng.random_bool(0.1);
            let mut triangle: Triangle = std::array::from_fn(|_| {
                let [x, y] = middle.map(|m| {
                    let reach = if wide && rng.random_bool(0.5) { limit } else { size };
                    ((m + rng.random_range(-0.5..=0.5) * reach).clamp(-limit, limit) * one).round() as i32
                });
                let value = std::array::from_fn(|i| {
                    let channel = machine.channels()[i];
                    rng.random_range(0..=channel.max() << channel.vertex_fraction)
                });
                PortVertex { x, y, value }
            });
            match rng.random_range(0..20) {
                0 => triangle[1] = triangle[0],
                1 => triangle[2].y = triangle[1].y,
                2 => triangle[1].y = triangle[0].y,
                3 => triangle[2].x = (triangle[0].x + triangle[1].x) / 2,
                _ => {}
            }
            triangle
        })
        .collect()
}

/// Draws both ways and compares all that can be seen.
fn compare(machine: &Plan, triangles: &[Triangle], state: DrawState) -> Path {
    let (fast, path) = fast::draw(machine, triangles.iter().copied(), state);
    let mut tick = render(machine, triangles.iter().copied(), state, Stalls::NONE);
    if path == Path::Fast {
        tick.corners = Coverage::default();
    }
    let context = || format!("{path:?} {state:?} {machine:?} {} triangles", triangles.len());
    let spent = |frame: &Frame| Activity::ALL.map(|a| (a.name(), frame.counters.spent(a)));
    assert_eq!(spent(&fast), spent(&tick), "{}", context());
    assert_eq!(fast.counters, tick.counters, "{}", context());
    assert!(fast.counters.add_up());
    assert!(fast == tick, "pixels differ: {}", context());
    let mut bare = fast::Renderer::new(machine, false);
    match bare.draw(triangles.iter().copied(), state) {
        Ok(()) => {
            tick = Frame { coverage: vec![], writes: vec![], id: vec![], ..tick };
            assert!(bare.frame() == tick, "without details: {}", context());
            let [top, rest] =
                [0..machine.height / 3, machine.height / 3..machine.height].map(|l| bare.lines(l));
            assert!([top.z, rest.z].concat() == tick.z, "depths by parts: {}", context());
            assert!([top.rgb, rest.rgb].concat() == tick.rgb, "colours by parts: {}", context());
        }
        Err(reason) => assert_eq!(path, Path::Ticked(reason), "{}", context()),
    }
    path
}

#[test]
fn random_machines_equal_ticking() {
    let mut rng = StdRng::seed_from_u64(1);
    let (mut fast, mut queue, mut interlock) = (0, 0, 0);
    let mut fragments = 0;
    for _ in 0..600 {
        let machine = random_machine(&mut rng);
        for _ in 0..3 {
            let triangles = random_triangles(&machine, &mut rng);
            let state = DrawState {
                depth_func: if rng.random_bool(0.5) { 1 } else { rng.random_range(0..8) },
                depth_write: rng.random_bool(0.8),
                clear: [0; 3].map(|_: u64| rng.random_range(0..=machine.color.max())),
            };
            match compare(&machine, &triangles, state) {
                Path::Fast => fast += 1,
                Path::Ticked(Reason::Queue) => queue += 1,
                Path::Ticked(Reason::Interlock) => interlock += 1,
            }
            fragments += triangles.len();
        }
    }
    println!(
        "1800 frames, {fragments} triangles: {fast} fast, {queue} ticked for the queue, {interlock} for an interlock"
    );
    assert!(fast > queue + interlock, "more than half must take the fast path");
}
