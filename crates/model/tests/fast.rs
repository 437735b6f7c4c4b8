//! The fast path against ticking: every pixel, every count, over machines and triangles drawn at random.

use crate::common::{Triangle, moved, random_values, render};
use edgewalk_machine::key::Domain;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{
    BlendKind, Dither, ForeignVertex, Hazard, Machine, Plan, Role, ScreenDoor, SetupKind, ShadeKind,
    ShadowLight, Walk,
};
use edgewalk_model::fast::{self, Path, Reason, Refusal};
use edgewalk_model::{Activity, DrawState, Events, Frame, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

/// A machine with every key drawn at random, on a small screen. Machines with POLY have a suite of their own, `fast_poly.rs`.
pub(crate) fn random_machine(rng: &mut impl Rng) -> Plan {
    random_machine_with(0, rng)
}

/// A machine with so many places for edges, and every other key at random.
pub(crate) fn random_machine_with(edges: u32, rng: &mut impl Rng) -> Plan {
    loop {
        let mut machine = Machine::default();
        machine.polygon.edges = edges;
        for key in KEYS.iter().filter(|key| key.name != "polygon.edges") {
            let value = match key.domain {
                Domain::Range(low, high) => rng.random_range(low..=high),
                Domain::OneOf(list) => list[rng.random_range(0..list.len())],
                Domain::Word(words) => rng.random_range(0..words.len() as u32),
            };
            (key.set)(&mut machine, value);
        }
        if rng.random_bool(0.7) {
            machine.extra = 0; // others are ticked
        }
        if rng.random_bool(0.8) {
            machine.blend.kind = BlendKind::None; // others too
        }
        if rng.random_bool(0.9) {
            machine.shadow.light = ShadowLight::None; // and these
        }
        if rng.random_bool(0.97) {
            machine.shade.kind = ShadeKind::None; // and others
        }
        if machine.blend.kind != BlendKind::None || rng.random_bool(0.6) {
            machine.dither = Dither::default();
        }
        if rng.random_bool(0.6) {
            machine.dither.screen_door = ScreenDoor::No; // others are ticked
        }
        machine.shade.walk = Walk::Register; // triangles out to the guard band, and records of zeros: the walks are long
        machine.shade.record_bits = 8;
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
pub(crate) fn random_triangles(machine: &Plan, rng: &mut impl Rng) -> Vec<Triangle> {
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
                machine.raw_vertex(x, y, &random_values(machine, rng))
            });
            match rng.random_range(0..20) {
                0 => triangle[1] = triangle[0],
                1 => triangle[2] = moved(machine, &triangle[2], triangle[2].x(), triangle[1].y()),
                2 => triangle[1] = moved(machine, &triangle[1], triangle[1].x(), triangle[0].y()),
                3 => {
                    let x = (triangle[0].x() + triangle[1].x()) / 2;
                    triangle[2] = moved(machine, &triangle[2], x, triangle[2].y());
                }
                _ => {}
            }
            // A line as the host sends it, or any three vertices as one.
            match rng.random_range(0..8) {
                0..3 => machine.line([triangle[0], triangle[1]]),
                3 => machine.with_role(triangle, Role::Line { flat: rng.random() }),
                _ => triangle,
            }
        })
        .collect()
}

/// Draws both ways and compares all that can be seen.
pub(crate) fn compare(machine: &Plan, triangles: &[Triangle], state: DrawState) -> Path {
    let drawn = fast::draw(machine, triangles.iter().copied(), state);
    let (fast, path) = drawn.expect("this machine's vertices");
    let mut tick = render(machine, triangles, state, Stalls::NONE);
    if path == Path::Fast {
        tick.events = Events::default();
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
        Err(Refusal::Tick(reason)) => assert_eq!(path, Path::Ticked(reason), "{}", context()),
        Err(Refusal::Foreign(foreign)) => panic!("{foreign}"),
    }
    path
}

#[test]
fn random_machines_equal_ticking() {
    let mut rng = StdRng::seed_from_u64(1);
    let (mut fast, mut channels, mut shadow, mut blend, mut shade, mut queue, mut interlock) =
        (0, 0, 0, 0, 0, 0, 0);
    let (mut dithered, mut door) = (0, 0);
    let (mut fragments, mut values) = (0, 0);
    // Machines, and frames on the fast path, by kind of SETUP: parallel, sequenced.
    let (mut machines, mut fast_by_kind) = ([0; 2], [0; 2]);
    for _ in 0..600 {
        let machine = random_machine(&mut rng);
        let kind = usize::from(machine.setup_kind == SetupKind::Sequenced);
        machines[kind] += 1;
        for _ in 0..3 {
            let triangles = random_triangles(&machine, &mut rng);
            let state = DrawState {
                depth_func: if rng.random_bool(0.5) { 1 } else { rng.random_range(0..8) },
                depth_write: rng.random_bool(0.8),
                clear: [0; 3].map(|_: u64| rng.random_range(0..=machine.stored_color().max())),
                ..DrawState::default()
            };
            match compare(&machine, &triangles, state) {
                Path::Fast => {
                    fast += 1;
                    fast_by_kind[kind] += 1;
                    dithered += usize::from(machine.dither.rounds());
                }
                Path::Ticked(Reason::ScreenDoor) => door += 1,
                Path::Ticked(Reason::Channels) => channels += 1,
                Path::Ticked(Reason::Shadow) => shadow += 1,
                Path::Ticked(Reason::Blend) => blend += 1,
                Path::Ticked(Reason::Shade) => shade += 1,
                Path::Ticked(Reason::Passes) => unreachable!("one pass"),
                Path::Ticked(Reason::Polygons | Reason::Bilinear) => unreachable!("no POLY"),
                Path::Ticked(Reason::Queue) => queue += 1,
                Path::Ticked(Reason::Interlock) => interlock += 1,
                Path::Ticked(Reason::Memory) => panic!("this memory never stalls"),
            }
            fragments += triangles.len();
            // z, three colours, coverage, writes and id of each pixel; 14 counters.
            values += 7 * u64::from(machine.width) * u64::from(machine.height) + 14;
        }
    }
    let [parallel, sequenced] = machines;
    println!(
        "{parallel} machines with a parallel SETUP and {sequenced} with a sequenced one, {fast_by_kind:?} of their frames fast: {values} values, 0 differ"
    );
    println!(
        "1800 frames, {fragments} triangles: {fast} fast, {dithered} of them dithered; ticked: {door} for their screen door, {channels} for their channels, {shadow} for SHADOW, {blend} for BLEND, {shade} for SHADE, {queue} for the queue, \
         {interlock} for an interlock"
    );
    assert!(machines.iter().all(|count| *count > 200) && fast_by_kind.iter().all(|count| *count > 300));
    assert!(fast > queue + interlock, "more than half of those with four channels must take the fast path");
    assert!(dithered > 50 && door > 50, "{dithered} dithered, {door} with a screen door");
    assert!(channels > 0 && shadow > 0 && blend > 0 && shade > 0 && queue > 0 && interlock > 0);
}

#[test]
fn triangles_of_another_machine_are_refused() {
    let (plan, other) = (Plan::default(), Plan::preset("textbook").expect("a preset"));
    let [own, foreign] = [&plan, &other].map(|plan| [plan.raw_vertex(0, 0, &[]); 3]);
    let state = DrawState::default();
    let error = ForeignVertex { triangle: 1 };
    assert_eq!(edgewalk_model::render(&plan, [own, foreign], state, Stalls::NONE), Err(error));
    assert_eq!(fast::draw(&plan, [own, foreign], state), Err(error));
    let mut renderer = fast::Renderer::new(&plan, false);
    assert_eq!(renderer.draw([own, foreign], state), Err(Refusal::Foreign(error)));
    assert_eq!(renderer.draw([own, own], state), Ok(()));
}

/// Also where the frame before was given up half way.
#[test]
fn nothing_is_left_of_the_frame_before() {
    let mut rng = StdRng::seed_from_u64(7);
    let foreign = [Plan::preset("textbook").expect("a preset").raw_vertex(0, 0, &[]); 3];
    let (mut frames, mut fragments) = (0, 0);
    for _ in 0..40 {
        let machine = Machine { hazard: Hazard::Forward, ..Machine::default() };
        let machine =
            Machine { width: rng.random_range(16..80), height: rng.random_range(16..60), ..machine };
        let machine = machine.plan().expect("can be built");
        let mut renderer = fast::Renderer::new(&machine, rng.random());
        let state = DrawState::default();
        for number in 0..4 {
            let mut triangles = random_triangles(&machine, &mut rng);
            triangles.truncate(rng.random_range(0..12));
            if number == 1 {
                triangles.extend([foreign; 9]);
                let refused = renderer.draw(triangles, state);
                assert!(matches!(refused, Err(Refusal::Foreign(_))), "{refused:?}");
                continue;
            }
            let mut fresh = fast::Renderer::new(&machine, false);
            assert_eq!(fresh.draw(triangles.iter().copied(), state), Ok(()));
            assert_eq!(renderer.draw(triangles, state), Ok(()));
            let [found, wanted] = [&renderer, &fresh].map(fast::Renderer::frame);
            assert!(found.z == wanted.z && found.rgb == wanted.rgb, "frame {number} on {machine:?}");
            assert_eq!(found.counters, wanted.counters);
            (frames, fragments) = (frames + 1, fragments + found.counters.fragments);
        }
    }
    println!("{frames} frames after others, {fragments} fragments");
    assert!(frames == 120 && fragments > 20_000, "{fragments} fragments");
}

/// Frames are told apart by a number that is soon used up. In the first there is one triangle and in the others another, so that
/// what the first left would be seen when its number comes again.
#[test]
fn nothing_is_left_of_a_frame_long_before() {
    let machine = Machine { width: 16, height: 16, ..Machine::default() }.plan().expect("can be built");
    let corner = |x: i32, y: i32| machine.raw_vertex(x << 8, y << 8, &[1 << 20, 4080, 0, 4080]);
    let [left, right] = [0, 8].map(|x| [corner(x, 0), corner(x + 7, 0), corner(x, 15)]);
    let mut renderer = fast::Renderer::new(&machine, false);
    let mut draw = |triangle, clear| {
        assert_eq!(renderer.draw([triangle], DrawState { clear, ..DrawState::default() }), Ok(()));
        renderer.frame()
    };
    draw(left, [0; 3]);
    let mut frames = 0;
    for number in 0..600u64 {
        let clear = [number % 256, 7, number % 3];
        let found = draw(right, clear);
        let mut fresh = fast::Renderer::new(&machine, false);
        assert_eq!(fresh.draw([right], DrawState { clear, ..DrawState::default() }), Ok(()));
        let wanted = fresh.frame();
        assert!(found.z == wanted.z && found.rgb == wanted.rgb, "frame {number}");
        assert_eq!(found.rgb[0], clear, "frame {number}");
        frames += usize::from(found.counters.fragments > 0);
    }
    assert_eq!(frames, 600, "frames in which something is drawn");
}
