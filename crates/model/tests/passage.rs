//! A frame that was drawn once, clocked for other timing keys, against ticking; and memories that stall.

use crate::common::{Triangle, random_values, render};
use edgewalk_machine::{Fill, Hazard, Machine, Plan};
use edgewalk_model::fast::{Passage, Reason, Renderer};
use edgewalk_model::{Activity, Culled, DrawState, Stalls, WAITS, Waits, cull, setup_clocks};
use rand::{Rng, SeedableRng, rngs::StdRng};

/// Small triangles that pile up, on the screen and beside it.
fn triangles(plan: &Plan, rng: &mut impl Rng) -> Vec<Triangle> {
    let one = f64::from(1u32 << plan.subpixel_bits);
    let mut middle = [0.0; 2];
    let triangle = |_| {
        if rng.random_bool(0.3) {
            middle = [plan.width, plan.height].map(|side| rng.random_range(-0.2..1.2) * f64::from(side));
        }
        let size = 2f64.powf(rng.random_range(0.0..6.0));
        std::array::from_fn(|_| {
            let [x, y] = middle.map(|m| ((m + rng.random_range(-0.5..=0.5) * size) * one).round() as i32);
            plan.raw_vertex(x, y, &random_values(plan, rng))
        })
    };
    (0..40).map(triangle).collect()
}

/// Another machine that draws the same pixels.
fn retimed(machine: &Machine, rng: &mut impl Rng) -> Plan {
    let hazard = [Hazard::Drain, Hazard::Interlock, Hazard::Forward][rng.random_range(0..3)];
    let power = |rng: &mut dyn FnMut() -> u32| 1 << rng();
    Machine {
        lanes: power(&mut || rng.random_range(0..3)),
        segments: power(&mut || rng.random_range(0..3)),
        adders: rng.random_range(1..=4),
        span_fifo: rng.random_range(1..10),
        inflight: rng.random_range(1..=16),
        latency: rng.random_range(1..=8),
        hazard,
        ..machine.clone()
    }
    .plan()
    .expect("timing keys do not clash with these words")
}

#[test]
fn other_timing_keys_are_clocked_as_ticking_has_it() {
    let mut rng = StdRng::seed_from_u64(3);
    let (mut clocked, mut ticked, mut culled) = (0, 0, 0);
    for round in 0..150 {
        let fill = if round % 3 == 0 { Fill::Textbook } else { Fill::Exact };
        let subpixel_bits = if fill == Fill::Textbook { 0 } else { [0, 4, 8][round % 3] };
        let machine = Machine {
            width: rng.random_range(1..80),
            height: rng.random_range(1..60),
            fill,
            subpixel_bits,
            ..Machine::default()
        };
        let drawn_on = Machine { hazard: Hazard::Forward, latency: 1, inflight: 16, ..machine.clone() };
        let plan = drawn_on.plan().expect("can be built");
        let list = triangles(&plan, &mut rng);
        let state = DrawState { depth_write: round % 5 > 0, ..DrawState::default() };
        let mut renderer = Renderer::new(&plan, true);
        let passage = renderer.draw_passage(list.iter().copied(), state).expect("never ticked");
        for (triangle, fate) in list.iter().zip(passage.fates()) {
            let why = cull(&plan, triangle);
            assert_eq!(why.is_none(), fate.walked, "{plan:?}");
            let clocks = setup_clocks(&plan, triangle);
            assert_eq!(why.is_some(), clocks.phase2 == 0);
            culled += u32::from(matches!(why, Some(Culled::Lines | Culled::Columns)));
        }
        for _ in 0..4 {
            let other = retimed(&machine, &mut rng);
            let setup = Passage::setup(&other, &list).expect("its own vertices");
            let tick = render(&other, &list, state, Stalls::NONE);
            match passage.clocked(&other, &setup) {
                Ok(counters) => {
                    assert_eq!(counters, tick.counters, "{other:?}");
                    clocked += 1;
                }
                Err(Reason::Queue | Reason::Interlock) => ticked += 1,
                Err(other) => panic!("{other:?}"),
            }
            let frame = renderer.frame();
            assert!(
                (frame.z, frame.rgb, frame.id) == (tick.z, tick.rgb, tick.id),
                "{other:?} draws other pixels"
            );
        }
    }
    println!("600 machines: {clocked} clocked, {ticked} to be ticked; {culled} triangles culled");
    assert!(clocked > 300 && ticked > 30 && culled > 30);
}

#[test]
fn the_farthest_pixel_is_behind_the_most_additions() {
    // Columns 1 to 8 of line 2, from the vertical edge at x = 1; and a walk over 3 columns left of the screen.
    let plan = Machine { width: 16, height: 12, ..Machine::default() }.plan().expect("can be built");
    let triangle = |corners: [[i32; 2]; 3]| corners.map(|[x, y]| plan.raw_vertex(x << 8, y << 8, &[0; 4]));
    let farthest = |corners| {
        let passage = Renderer::new(&plan, false).draw_passage([triangle(corners)], DrawState::default());
        passage.expect("never ticked").fates()[0]
    };
    let fate = farthest([[1, 2], [9, 2], [1, 4]]);
    assert_eq!((fate.pixels, fate.farthest), (8, Some((2 * 16 + 6, [0, 5]))));
    let fate = farthest([[-3, 2], [5, 2], [-3, 4]]);
    assert_eq!((fate.pixels, fate.farthest), (3, Some((2 * 16 + 2, [0, 5]))));
    assert_eq!(farthest([[1, -9], [9, -9], [1, -2]]).farthest, None);
}

#[test]
fn memories_that_stall_draw_the_same_and_cost_cycles() {
    let mut rng = StdRng::seed_from_u64(5);
    let mut slower = [0; WAITS.len()];
    for _ in 0..20 {
        let machine = retimed(&Machine { width: 64, height: 48, ..Machine::default() }, &mut rng);
        let list = triangles(&machine, &mut rng);
        let state = DrawState::default();
        let free = render(&machine, &list, state, Stalls::NONE);
        for (kind, slower) in WAITS.iter().zip(&mut slower) {
            let waits: Waits = kind.parse().expect("listed");
            let frame =
                edgewalk_model::render(&machine, list.iter().copied(), state, waits).expect("its own");
            assert!(
                (&frame.z, &frame.rgb, &frame.id) == (&free.z, &free.rgb, &free.id),
                "{kind} {machine:?}"
            );
            assert!(
                frame.counters.add_up() && frame.counters.cycles >= free.counters.cycles,
                "{kind} {machine:?}"
            );
            *slower += u32::from(frame.counters.spent(Activity::Memory) > 0);
        }
    }
    // A fixed pace of a clock an access holds only machines that draw a pixel a clock.
    assert!(slower[0] == 0 && slower[1] > 0 && slower[2..] == [20, 20], "{slower:?}");
}
