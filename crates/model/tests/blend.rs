//! BLEND: its arithmetic against exact numbers and golden's weighted sum, its hazards against a plain loop.

use crate::common::blend::{C, feed, fragment, word};
use crate::common::{machine, random_machine, random_triangle};
use edgewalk_machine::{BlendKind, Plan};
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{DrawState, Drawn, Events, Stalls, render_with};
use edgewalk_numerics::blend_error;
use rand::{Rng, SeedableRng, rngs::StdRng};
use std::collections::HashMap;

/// A machine of 1024 pixels with BLEND.
fn with(settings: &[(&str, String)]) -> Plan {
    let small = [("screen.width", "32"), ("screen.height", "32"), ("blend.kind", "constant")];
    let all: Vec<(&str, &str)> =
        small.into_iter().chain(settings.iter().map(|(key, value)| (*key, value.as_str()))).collect();
    machine(&all)
}

/// Blends I over B for every k of a machine of 8 bits: all 16,842,752 results.
#[test]
fn every_blend_of_8_bits_is_the_nearest_and_never_outside() {
    let plan = with(&[]);
    let (mut checked, mut worst) = (0u64, 0);
    for kt in 0..=256u32 {
        for front in (0..256u32).step_by(3) {
            // Opaque fragments bring the colours of the pixels, then three colours of fragments come over each.
            let fronts = [front, front + 1, front + 2].map(|i| i.min(255));
            let backs = (0..256).map(|back| fragment(back, [back; 3], 0));
            let fronts_over = (0..256).map(|back| fragment(back, fronts, kt));
            let all: Vec<Fragment<C>> = backs.chain(fronts_over).collect();
            let (memory, ..) = feed(&plan, &all, false, Stalls::NONE);
            for back in 0..256u32 {
                let stored = memory.pixel(back, 0);
                for (front, found) in fronts.into_iter().zip([stored[1], stored[2], stored[3]]) {
                    let exact = i64::from(front * (256 - kt) + back * kt);
                    let off = (i64::from(found) * 256 - exact).abs();
                    worst = worst.max(off);
                    assert!(off <= 128, "{front} over {back}, k = {kt}: {found}");
                    assert!(
                        (front.min(back)..=front.max(back)).contains(&found),
                        "{front} over {back}: {found}"
                    );
                    assert!(kt > 0 || found == front, "k = 0 gives {found} for {front}");
                    assert!(kt < 256 || found == back, "k = 1 gives {found} for {back}");
                    checked += 1;
                }
            }
        }
    }
    println!("{checked} blends, at most {} / 256 LSB off", worst);
    // 257 weights, 86 groups of three colours of which the last repeats 255 twice, 256 colours behind.
    assert_eq!(checked, 257 * 86 * 3 * 256);
    assert_eq!(worst, 128, "a half is reached");
}

/// A real number rounded to a grid of 2^bits - 1 or 2^bits steps.
fn rounded(value: f64, steps: u32) -> u32 {
    (value * f64::from(steps)).round_ties_even() as u32
}

/// Stacks of layers against the same in f64, each within the running bound; gives the share of it that was reached, and
/// the largest error.
fn stacks(
    plan: &Plan,
    count: u32,
    layers: u32,
    rng: &mut StdRng,
    kt: impl Fn(&mut StdRng) -> f64,
) -> [f64; 2] {
    let (max, one) = (plan.color.max() as u32, 1u32 << plan.blend.kt_bits);
    let (mut share, mut largest, mut checked) = (0.0f64, 0.0f64, 0);
    let places = plan.width * plan.height;
    for _ in 0..count.div_ceil(places) {
        let mut fragments = Vec::new();
        // What golden has at each pixel, LSB, and the bound.
        let mut wanted: Vec<([f64; 3], f64)> = vec![([1.0, 2.0, 3.0], 0.0); places as usize];
        for _ in 0..layers {
            for addr in 0..places {
                let (front, kt): ([f64; 3], f64) = (rng.random(), kt(rng));
                let k = rounded(kt, one);
                fragments.push(fragment(addr, front.map(|c| rounded(c, max)), k));
                let (colors, bound) = &mut wanted[addr as usize];
                let front = front.map(|c| c * f64::from(max));
                let far = (0..3).map(|i| (front[i] - colors[i]).abs()).fold(0.0, f64::max);
                *bound = blend_error(*bound, 0.5, far, f64::from(k) / f64::from(one), 0.5 / f64::from(one));
                *colors = std::array::from_fn(|i| (1.0 - kt) * front[i] + kt * colors[i]);
            }
        }
        let (memory, ..) = feed(plan, &fragments, false, Stalls::NONE);
        for (addr, (colors, bound)) in wanted.iter().enumerate() {
            let x_bits = plan.widths().x;
            let at = (addr as u32 / plan.width) << x_bits | addr as u32 % plan.width;
            let stored = memory.pixel(at, 0);
            for (found, exact) in [stored[1], stored[2], stored[3]].into_iter().zip(colors) {
                let error = (f64::from(found) - exact).abs();
                assert!(error <= *bound + 1e-9, "{error} LSB, bound {bound}");
                share = share.max(error / bound);
                largest = largest.max(error);
                checked += 1;
            }
        }
    }
    assert!(checked >= 3 * count, "{checked} of {count} stacks");
    [share, largest]
}

#[test]
fn a_million_blends_lie_within_the_bound_of_one_layer() {
    let mut rng = StdRng::seed_from_u64(3);
    let plan = with(&[]);
    let [share, largest] = stacks(&plan, 1 << 20, 1, &mut rng, |rng| rng.random());
    println!("1,048,576 blends: {share:.3} of the bound, {largest:.3} LSB at most");
    assert!(share > 0.9 && largest < 1.5);
}

#[test]
fn stacks_of_30_layers_lie_within_the_running_bound() {
    let mut rng = StdRng::seed_from_u64(4);
    let mut reached: f64 = 0.0;
    let near_one: fn(&mut StdRng) -> f64 = |rng| rng.random_range(0.9..1.0);
    let almost_one: fn(&mut StdRng) -> f64 = |rng| 1.0 - rng.random_range(0.5..3.0) / 256.0;
    let cases: [(&str, &str, &str, fn(&mut StdRng) -> f64); 5] = [
        ("any k_t", "8", "8", |rng| rng.random()),
        ("k_t from 0.9", "8", "8", near_one),
        ("k_t next to 1", "8", "8", almost_one),
        ("4 guard bits", "12", "8", near_one),
        ("4 guard bits, 12 of k_t", "12", "12", near_one),
    ];
    for (name, bits, kt_bits, kt) in cases {
        let settings = [("formats.color_bits", bits.to_owned()), ("blend.kt_bits", kt_bits.to_owned())];
        let [share, largest] = stacks(&with(&settings), 100_000, 30, &mut rng, kt);
        println!(
            "100,352 stacks of 30 layers, {name}: {share:.3} of the bound, {largest:.2} LSB of {bits} bits"
        );
        reached = reached.max(share);
    }
    assert!(reached >= 0.9, "the bound is far from sharp: {reached}");
}

/// Sums that saturate.
#[test]
fn colours_are_added_and_saturate() {
    let plan = with(&[("memory.color_hazard", "forward".to_owned())]);
    let mut rng = StdRng::seed_from_u64(5);
    let fragments: Vec<_> = (0..10_000)
        .map(|_| {
            fragment(
                rng.random_range(0..50),
                [0; 3].map(|_| rng.random_range(0..90)),
                rng.random_range(0..=256),
            )
        })
        .collect();
    let (memory, writes, ..) = feed(&plan, &fragments, true, Stalls::NONE);
    let mut wanted = HashMap::new();
    let mut saturated = 0;
    for (f, write) in fragments.iter().zip(&writes) {
        let back = wanted.entry(f.addr).or_insert([1, 2, 3]);
        *back = [0, 1, 2].map(|i| back[i] + f.values[i + 1]);
        saturated += back.iter().filter(|c| **c > 255).count();
        *back = back.map(|c| c.min(255));
        assert_eq!((write.addr, write.rgb), (f.addr, word(&plan, *back)));
    }
    assert_eq!(writes.len(), fragments.len());
    assert!(saturated > 100 && wanted.iter().all(|(a, rgb)| memory.pixel(*a, 0)[1..4] == *rgb));
}

const STALLS: [Stalls; 3] = [
    Stalls::NONE,
    Stalls { seed: 1, rd: 60, data: 60, wr: 60 },
    Stalls { seed: 2, rd: 10, data: 200, wr: 200 },
];

/// What blending one fragment after the other comes to, in plain numbers: every write in order.
fn sequential(plan: &Plan, fragments: &[Fragment<C>], add: bool) -> Vec<(u32, u64)> {
    let mut stored = HashMap::new();
    let one = i64::from(1u32 << plan.blend.kt_bits);
    let max = plan.color.max() as i64;
    fragments
        .iter()
        .map(|f| {
            let back = stored.entry(f.addr).or_insert([1i64, 2, 3]);
            let k = i64::from(f.kt).min(one);
            *back = [0, 1, 2].map(|i| {
                let front = i64::from(f.values[i + 1]);
                if add {
                    (front + back[i]).min(max)
                } else {
                    (2 * (front * (one - k) + back[i] * k) + one).div_euclid(2 * one)
                }
            });
            (f.addr, word(plan, back.map(|c| c as u32)))
        })
        .collect()
}

/// 6,000 runs on few addresses, of every policy, latency, number of multipliers and stages, with stalls on every port.
#[test]
fn every_policy_blends_as_a_plain_loop_does() {
    let mut rng = StdRng::seed_from_u64(6);
    let (mut all, mut checked) = (Events::default(), 0);
    for run in 0..6000 {
        let pick = |rng: &mut StdRng, list: &[u32]| list[rng.random_range(0..list.len())].to_string();
        let plan = with(&[
            ("memory.color_hazard", ["drain", "interlock", "forward"][run % 3].to_owned()),
            ("memory.color_latency", pick(&mut rng, &[1, 2, 3, 4, 5, 6, 7, 8])),
            ("blend.multipliers", pick(&mut rng, &[3, 1, 0])),
            ("blend.stages", pick(&mut rng, &[1, 2])),
            ("fifo.blend", pick(&mut rng, &[1, 2, 3, 4, 8, 16])),
            ("blend.kt_bits", pick(&mut rng, &[4, 7, 8, 12])),
        ]);
        let addresses = [1, 2, 3, 5, 64][rng.random_range(0..5)];
        let most = 2u32 << plan.blend.kt_bits; // what is beyond 1 counts as 1
        let fragments: Vec<_> = (0..60)
            .map(|_| {
                let kt = if rng.random_bool(0.3) { 0 } else { rng.random_range(0..most) };
                let rgb = [0; 3].map(|_| rng.random_range(0..256));
                // Each is a triangle of its own.
                Fragment { fence: true, ..fragment(rng.random_range(0..addresses), rgb, kt) }
            })
            .collect();
        let add = rng.random_bool(0.2);
        let (_, writes, events, _) = feed(&plan, &fragments, add, STALLS[rng.random_range(0..3)]);
        let found: Vec<(u32, u64)> = writes.iter().map(|write| (write.addr, write.rgb)).collect();
        let expected = sequential(&plan, &fragments, add);
        if let Some(place) = (0..expected.len()).find(|i| found.get(*i) != Some(&expected[*i])) {
            panic!("run {run}, fragment {place}: {:?} for {:?}; {plan:?}", found.get(place), expected[place]);
        }
        assert_eq!(found.len(), expected.len());
        checked += found.len();
        all.merge(&events);
    }
    println!("6000 runs, {checked} writes, {:?}", all.counts());
    assert_eq!(checked, 6000 * 60);
    let met = all.counts();
    for event in edgewalk_machine::units::blend::SPEC.events {
        let count = met.iter().find(|(name, _)| *name == event.name).map(|(_, count)| *count);
        assert!(count > Some(0), "never met: {}", event.name);
    }
}

/// Clocks a fragment with Q = 8, L = 2, M = 1, by policy and the number of addresses that come in turn.
#[test]
fn clocks_a_fragment() {
    let expected: [(&str, [f64; 6]); 3] = [
        ("drain", [5.0, 3.0, 7.0 / 3.0, 2.0, 5.0 / 3.0, 1.07]),
        ("interlock", [5.0, 2.5, 5.0 / 3.0, 1.25, 1.0, 1.0]),
        ("forward", [2.0, 1.0, 1.0, 1.0, 1.0, 1.0]),
    ];
    let mut checked = 0;
    for (policy, wanted) in expected {
        let plan = with(&[("memory.color_hazard", policy.to_owned()), ("fifo.blend", "8".to_owned())]);
        for (addresses, wanted) in [1, 2, 3, 4, 6, 64].into_iter().zip(wanted) {
            let fragments: Vec<_> = (0..9600u32)
                .map(|i| Fragment { fence: i % addresses == 0, ..fragment(i % addresses, [200; 3], 100) })
                .collect();
            let (.., cycles) = feed(&plan, &fragments, false, Stalls::NONE);
            let clocks = cycles as f64 / fragments.len() as f64;
            println!("{policy}, {addresses} addresses in turn: {clocks:.2} clocks a fragment");
            assert!((clocks - wanted).abs() < 0.01, "{policy} {addresses}: {clocks} for {wanted}");
            checked += 1;
        }
    }
    assert_eq!(checked, 18);
    // Multipliers: clocks a fragment on many addresses; opaque ones take one.
    for (multipliers, kt_bits, kt, wanted) in [
        ("3", "8", 100, 1.0),
        ("1", "8", 100, 3.0),
        ("0", "8", 100, 4.0),
        ("0", "7", 50, 4.0),
        ("0", "8", 0, 1.0),
    ] {
        let plan =
            with(&[("blend.multipliers", multipliers.to_owned()), ("blend.kt_bits", kt_bits.to_owned())]);
        let fragments: Vec<_> = (0..9600).map(|i| fragment(i % 1000, [200; 3], kt)).collect();
        let (.., cycles) = feed(&plan, &fragments, false, Stalls::NONE);
        let clocks = cycles as f64 / fragments.len() as f64;
        assert!((clocks - wanted).abs() < 0.01, "{multipliers} multipliers, k = {kt}: {clocks}");
    }
}

/// The whole machine, k_t of triangles and of pixels: what its own fragments come to, one after the other.
#[test]
fn random_machines_draw_what_their_fragments_come_to() {
    let mut rng = StdRng::seed_from_u64(7);
    let (mut all, mut fragments, mut kinds) = (Events::default(), 0, [0; 3]);
    for number in 0..600 {
        let width = ["2", "12", "40"][number % 3];
        // A sequenced SETUP keeps triangles too far apart to meet in flight.
        let fixed = [("screen.width", width), ("screen.height", width), ("setup.kind", "parallel")];
        let plan = random_machine(&fixed, &mut rng);
        if !plan.blend.is_there() {
            continue;
        }
        kinds[plan.blend.kind as usize] += 1;
        let triangles: Vec<_> =
            (0..60).map(|_| random_triangle(&plan, rng.random_range(1.0..30.0), &mut rng)).collect();
        let state = DrawState {
            depth_func: [1, 3, 6, 7][number % 4],
            depth_write: rng.random_bool(0.7),
            color_write: rng.random_bool(0.9),
            blend_add: rng.random_bool(0.2),
            clear: [1, 2, 3],
            ..DrawState::default()
        };
        let max = plan.color.max() as i64;
        let one = 1i64 << plan.blend.kt_bits;
        let place = plan.channels().iter().position(|channel| channel.name == "kt");
        assert_eq!(place.is_some(), plan.blend.kind == BlendKind::Interpolated);
        let mut wanted: HashMap<u32, (i64, [i64; 3])> = HashMap::new();
        let hook = |drawn: Drawn| {
            let Drawn::Fragment(f) = drawn else { return };
            fragments += 1;
            let (z, rgb) = wanted.entry(f.addr).or_insert((plan.z.max() as i64, [1, 2, 3]));
            let new = i64::from(f.values[0]);
            let bit = if new < *z {
                0
            } else if new == *z {
                1
            } else {
                2
            };
            if state.depth_func >> bit & 1 == 0 {
                return;
            }
            if state.depth_write {
                *z = new;
            }
            let kt = match place {
                Some(place) => f.values[place],
                None => triangles[f.source.id as usize][0].kt(),
            };
            let k = i64::from(kt).min(one);
            if state.color_write {
                *rgb = [0, 1, 2].map(|i| {
                    let front = i64::from(f.values[i + 1]);
                    if state.blend_add {
                        (front + rgb[i]).min(max)
                    } else {
                        (2 * (front * (one - k) + rgb[i] * k) + one).div_euclid(2 * one)
                    }
                });
            }
        };
        let stalls = STALLS[number / 3 % 3];
        let frame =
            render_with(&plan, triangles.iter().copied(), state, stalls, hook).expect("its own vertices");
        let x_bits = plan.widths().x;
        for (pixel, (z, rgb)) in (0u32..).zip(frame.z.iter().zip(&frame.rgb)) {
            let addr = pixel / plan.width << x_bits | pixel % plan.width;
            let found = (*z as i64, rgb.map(|c| c as i64));
            let expected = wanted.get(&addr).copied().unwrap_or((plan.z.max() as i64, [1, 2, 3]));
            assert_eq!(found, expected, "machine {number}, pixel {pixel}: {plan:?} {state:?}");
        }
        assert!(frame.counters.add_up());
        all.merge(&frame.events);
    }
    println!("{kinds:?} machines by kind, {fragments} fragments, {:?}", all.counts());
    assert!(kinds[1] > 90 && kinds[2] > 70 && fragments > 100_000, "{kinds:?}, {fragments}");
    let met = all.counts();
    let events = [edgewalk_machine::units::blend::SPEC.events, edgewalk_machine::units::depth::SPEC.events];
    // SETUP keeps triangles so far apart that these rarely meet; BLEND alone meets them above.
    let apart = ["opaque_behind", "behind_opaque", "color_forward_entry"];
    for event in events.into_iter().flatten().filter(|event| !apart.contains(&event.name)) {
        let count = met.iter().find(|(name, _)| *name == event.name).map(|(_, count)| *count);
        assert!(count > Some(0), "never met: {}", event.name);
    }
}
