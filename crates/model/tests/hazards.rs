//! A pixel in flight: every policy draws what a plain loop over the fragments draws, whatever the memory does.

use crate::common::depth::{Sequential, feed, sequential};
use crate::common::{Triangle, machine, random_triangle, random_values};
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::tokens::{FEW, Fragment, Source, Write};
use edgewalk_model::{DrawState, Events, Memory, Rig, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

const POLICIES: [&str; 3] = ["drain", "interlock", "forward"];
const STALLS: [Stalls; 3] = [
    Stalls::NONE,
    Stalls { seed: 1, rd: 60, data: 60, wr: 60 },
    Stalls { seed: 2, rd: 10, data: 200, wr: 200 },
];

fn holds(name: &str, expected: &Sequential<FEW>, memory: &Memory<FEW>, writes: &[Write<FEW>]) {
    assert_eq!(writes.len(), expected.writes.len(), "{name}: writes");
    for (number, (write, expected)) in writes.iter().zip(&expected.writes).enumerate() {
        assert_eq!(write, expected, "{name}: write {number}");
    }
    for (addr, values) in &expected.stored {
        assert_eq!(memory.pixel(*addr), *values, "{name}: address {addr}");
    }
}

/// DEPTH and memory alone: one-pixel triangles on few addresses, back to back.
#[test]
fn one_pixel_triangles_on_one_address_back_to_back() {
    let mut rng = StdRng::seed_from_u64(1);
    let (mut all, mut runs, mut checked) = (Events::default(), 0, 0);
    for policy in POLICIES {
        for latency in 1..=8 {
            for inflight in [1, 2, 4, 16] {
                for stalls in STALLS {
                    let machine = machine(&[
                        ("screen.width", "4"),
                        ("screen.height", "4"),
                        ("formats.z_bits", "4"),
                        ("memory.hazard", policy),
                        ("memory.latency", &latency.to_string()),
                        ("fifo.inflight", &inflight.to_string()),
                    ]);
                    let state = DrawState {
                        depth_func: rng.random_range(0..8),
                        depth_write: rng.random_bool(0.8),
                        clear: [1, 2, 3],
                        ..DrawState::default()
                    };
                    let addresses = [1, 2, 5][rng.random_range(0..3)];
                    let fragments: Vec<_> = (0..200u32)
                        .map(|id| Fragment {
                            addr: rng.random_range(0..addresses),
                            values: [rng.random_range(0..16), id, 0, 0],
                            fence: true, // each is a triangle of its own
                            source: Source { tag: 0, id },
                            ..Fragment::default()
                        })
                        .collect();
                    let expected = sequential(&machine, &fragments, state);
                    let (memory, writes, events) = feed(&machine, &fragments, state, stalls);
                    holds(
                        &format!("{policy}, L = {latency}, {stalls:?}, {state:?}"),
                        &expected,
                        &memory,
                        &writes,
                    );
                    all.merge(&events);
                    runs += 1;
                    checked += expected.writes.len();
                }
            }
        }
    }
    println!("{runs} runs, {checked} writes, {all:?}");
    assert!(checked > 1000);
    for (name, count) in [
        ("forward from a compare", all.depth.forward_compare),
        ("forward from w", all.depth.forward_write),
        ("forward used", all.depth.forward_used),
        ("interlock", all.depth.interlock_stall),
        ("drain", all.depth.drain_stall),
        ("queue full", all.depth.queue_full),
        ("memory", all.depth.memory_stall),
        ("write", all.depth.write_stall),
        ("depth fail", all.depth.depth_fail),
    ] {
        assert!(count > 0, "never met: {name}");
    }
}

/// The whole machine against a plain loop over its own fragments.
fn against_the_loop(
    name: &str,
    machine: &Plan,
    triangles: &[Triangle],
    state: DrawState,
    stalls: Stalls,
    writes_open: impl Fn(u64) -> bool,
) -> (Vec<Fragment<FEW>>, Events) {
    let (mut fragments, mut writes) = (Vec::new(), Vec::new());
    let mut rig = Rig::<FEW>::new(machine, state, stalls);
    let mut triangles = triangles.iter().peekable();
    for now in 0.. {
        let cycle = rig.cycle(triangles.peek().map(|triangle| (*triangle, 0)), writes_open(now));
        fragments.extend(cycle.read.map(|_| rig.model.last_read()));
        writes.extend(cycle.write());
        if cycle.outputs.triangle {
            triangles.next();
        } else if cycle.outputs.idle && triangles.peek().is_none() {
            break;
        }
    }
    holds(name, &sequential(machine, &fragments, state), &rig.memories.depth, &writes);
    assert!(rig.model.counters().add_up());
    (fragments, rig.model.events().clone())
}

/// The memory takes no write for so long that SETUP brings one-pixel triangles of one address together.
#[test]
fn tiny_triangles_pile_up_in_front_of_a_slow_memory() {
    let mut rng = StdRng::seed_from_u64(2);
    let mut all = Events::default();
    for policy in POLICIES {
        for latency in [1, 3, 8] {
            let machine = machine(&[
                ("screen.width", "4"),
                ("screen.height", "4"),
                ("memory.hazard", policy),
                ("memory.latency", &latency.to_string()),
                ("fifo.inflight", "8"),
            ]);
            let triangles: Vec<Triangle> = (0..300)
                .map(|_| {
                    // Its only centre inside is that of pixel (1, 1), on its border.
                    [[0, 0], [256, 0], [0, 256]].map(|[x, y]| {
                        machine.raw_vertex(257 + x, 257 + y, &random_values(&machine, &mut rng))
                    })
                })
                .collect();
            let open = |now: u64| now % 2000 > 1900;
            let state = DrawState::default();
            let (fragments, events) =
                against_the_loop(policy, &machine, &triangles, state, Stalls::NONE, open);
            assert_eq!(fragments.len(), triangles.len());
            assert!(fragments.iter().all(|f| f.addr == fragments[0].addr));
            all.merge(&events);
        }
    }
    assert!(all.depth.forward_compare > 0 && all.depth.forward_used > 0, "{all:?}");
    assert!(all.depth.interlock_stall > 0 && all.depth.drain_stall > 0, "{all:?}");
}

/// A large triangle, then a small one on its last pixels: SETUP has the second ready while the first is drawn, and the
/// first pixel of the second is read 1 to 10 clocks after the same pixel of the first.
#[test]
fn a_pixel_is_drawn_again_a_few_clocks_later() {
    let mut all = Events::default();
    for policy in POLICIES {
        for latency in 1..=8 {
            let machine = machine(&[
                ("screen.width", "64"),
                ("screen.height", "64"),
                ("memory.hazard", policy),
                ("memory.latency", &latency.to_string()),
                ("fifo.inflight", "16"),
            ]);
            let (mut triangles, far) = (Vec::new(), 1 << 20);
            for round in 0..40i64 {
                // Lower right half of the screen, its last pixel at (63, 63); then the pixels before it, nearer.
                // In odd rounds farther than the large one, and still nearer than what that one has covered.
                let again = 1 + (round / 2 % 10) as i32;
                let near = if round % 2 == 1 { far + 500 } else { far - 500 };
                let value = |z: i64| [z - round * 1000, round, round, round];
                let v = |x: i32, y: i32, z| machine.raw_vertex(x * 256, y * 256, &value(z));
                triangles.push([v(64, 0, far), v(64, 64, far), v(0, 64, far)]);
                triangles.push([v(64, 63, near), v(64, 64, near), v(64 - 2 * again, 64, near)]);
            }
            let state = DrawState::default();
            let (_, events) = against_the_loop(policy, &machine, &triangles, state, Stalls::NONE, |_| true);
            all.merge(&events);
        }
    }
    assert!(all.depth.forward_compare > 0 && all.depth.forward_write > 0, "{all:?}");
    assert!(all.depth.interlock_stall > 0 && all.depth.drain_stall > 0, "{all:?}");
}

/// Policy, latency and stalls change when a pixel is drawn, never what is drawn.
#[test]
fn every_policy_draws_the_same_picture() {
    for fill in ["exact", "textbook"] {
        let mut rng = StdRng::seed_from_u64(3);
        let base = machine(&[
            ("screen.width", "40"),
            ("screen.height", "40"),
            ("screen.subpixel_bits", "0"),
            ("edge.fill", fill),
            ("formats.z_bits", "6"),
        ]);
        let triangles: Vec<_> = (0..200)
            .map(|_| {
                let size = rng.random_range(1.0..40.0);
                random_triangle(&base, size, &mut rng)
            })
            .collect();
        for depth_func in 0..8 {
            let state = DrawState {
                depth_func,
                depth_write: depth_func != 5,
                clear: [9, 8, 7],
                ..DrawState::default()
            };
            let mut first = None;
            for policy in POLICIES {
                for stalls in STALLS {
                    let mut machine = Machine::clone(&base);
                    machine.set("memory.hazard", policy).expect("a key");
                    machine.latency = rng.random_range(1..=8);
                    machine.inflight = rng.random_range(1..=16);
                    machine.adders = [1, 2, 4][rng.random_range(0..3)];
                    machine.segments = [1, 2, 4][rng.random_range(0..3)];
                    machine.span_fifo = rng.random_range(1..=4);
                    let machine = machine.plan().expect("can be built");
                    let name = format!("{fill}, {policy}, function {depth_func}, {stalls:?}");
                    let (fragments, _) =
                        against_the_loop(&name, &machine, &triangles, state, stalls, |_| true);
                    let first = first.get_or_insert_with(|| fragments.clone());
                    assert_eq!(*first, fragments, "{name}");
                }
            }
        }
    }
}
