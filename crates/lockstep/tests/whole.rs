//! Whole machines: the model against the netlist, every port of the machine and of every unit in it, every cycle, on
//! machines and triangles drawn at random.

use crate::common::fail::checked_compiled;
use crate::common::machines::random_machine;
use crate::common::polygons::primitives;
use crate::common::triangles::{after_it, one_pixel, random_primitive};
use edgewalk_lockstep::{Case, Checked, Interface, Triangles, Unit};
use edgewalk_machine::{Blend, BlendKind, Fill, Hazard, Kind, Machine, Plan, units};
use edgewalk_model::longest_setup;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// How many machines are drawn, how many more with BUMP and with LAMP, and about how many triangles on each.
const MACHINES: [usize; 2] = [120, 400];
const RELIEFS: [usize; 2] = [24, 300];
const LAMPS: [usize; 2] = [24, 300];
const TRIANGLES: u64 = 100;

/// What random triangles may not meet, and [`colours_on_one_pixel`] does.
const DIRECTED: [&str; 5] =
    ["opaque_behind", "behind_opaque", "color_head_wait", "color_forward_queue", "color_forward_used"];

/// What only BLEND, BUMP, SHADE, PROJECT and SHADOW alone meet for certain (`tests/units.rs`), and LAMP on machines of its own
/// (`whole_lamps`): triangles of one pixel, and of two materials, come too far apart, and few of their depths are a texel's, or
/// quotients on an edge; few machines blend under interlock, and few have LAMP.
const ALONE: [&str; 11] = [
    "color_interlock_stall",
    "color_forward_entry",
    "color_forward_write",
    "material_change",
    "tables_drain",
    "texel_tie",
    "map_edge",
    "depth_to_end",
    "slope_lowest",
    "square_cut",
    "lamp_read_stall",
];

/// What SETUP meets with POLY alone.
const WINDOWS: [&str; 2] = ["window_top", "window_bottom"];

/// Machines with SHADE read tables of hundreds of words, so three of sixteen may have it.
fn drawn_machine(number: usize, rng: &mut Pcg64Mcg) -> Plan {
    let mut machines = std::iter::repeat_with(|| random_machine(rng));
    machines.find(|plan| number % 16 < 3 || !plan.shade.is_there()).expect("half of them have none")
}

/// A case without triangles: stalls, resets, depth function, all at random.
fn random_case(plan: &Plan, rng: &mut Pcg64Mcg) -> Case {
    let mut case = Case::new(plan, Unit::MACHINE);
    let interface = Interface::new(plan, Unit::MACHINE);
    case.unwilling = interface.waits().map(|link| (link.to_owned(), share(rng))).collect();
    // Tables come in hundreds of words: they are not kept waiting for long.
    for (_, share) in case
        .unwilling
        .iter_mut()
        .filter(|(link, _)| ["srd", "sdata", "rrd", "rdata"].contains(&link.as_str()))
    {
        *share %= 60;
    }
    case.state.depth_func = if rng.random_bool(0.6) { 1 } else { rng.random_range(0..8) };
    case.state.depth_write = rng.random_bool(0.9);
    case.state.color_write = rng.random_bool(0.9);
    case.state.blend_add = rng.random_bool(0.3);
    case.state.shadow_on = rng.random_bool(0.9);
    case.state.light_pass = plan.shadow.draws_map() && rng.random();
    case.state.ambient = rng.random_range(0..=plan.color.max());
    case.clear_z = rng.random_bool(0.3).then(|| plan.z.max().div_ceil(2));
    case.late = if rng.random_bool(0.3) { rng.random_range(1..8) } else { 0 };
    case.resets = if rng.random_bool(0.3) { vec![rng.random_range(1..3000)] } else { Vec::new() };
    case.disturbed = rng.random_range(0..40);
    case.seed = rng.random_range(0..1 << 32);
    case
}

/// In so many of 256 cycles the rig waits: in half of the cases never.
fn share(rng: &mut Pcg64Mcg) -> u8 {
    if rng.random_bool(0.5) { rng.random_range(1..200) } else { 0 }
}

fn report(all: &Checked) {
    let Checked { cycles, tokens, compared, .. } = all;
    println!("{tokens} triangles, {cycles} cycles, {compared} values of ports compared, {:?}", all.moved);
    for (event, count) in all.events.counts() {
        println!("  {count:>9} {event}");
    }
}

/// Slow machines get fewer triangles, none less than a dozen: most of the time goes where most triangles come of it.
fn shares(machines: &[Plan]) -> Vec<u64> {
    let triangles = TRIANGLES * machines.len() as u64;
    let weight = |plan: &Plan| {
        // Of a machine with SHADE now and then a triangle is of another material.
        let tables = if plan.shade.is_there() { plan.shade.entries() / 8 } else { 0 };
        let cycles = f64::from(longest_setup(plan).all() + 6 * plan.clocks_per_pixel() + tables);
        (cycles * f64::from(3 + plan.lanes) * plan.channels().len() as f64).powi(-3)
    };
    let all: f64 = machines.iter().map(weight).sum();
    machines.iter().map(|plan| 12 + (triangles as f64 * weight(plan) / all).ceil() as u64).collect()
}

/// So many machines.
fn whole_machines(count: usize) {
    let mut rng = Pcg64Mcg::seed_from_u64(4);
    let machines: Vec<Plan> = (0..count).map(|number| drawn_machine(number, &mut rng)).collect();
    let all = compared(&machines);
    let mut extra = [0; 5];
    machines.iter().for_each(|plan| extra[plan.extra as usize] += 1);
    let channels = machines.iter().flat_map(|plan| plan.channels());
    let signed = channels.filter(|channel| channel.kind != Kind::Unorm).count();
    let maps = machines.iter().filter(|plan| plan.shadow.draws_map()).count();
    println!(
        "{count} machines, {extra:?} with 0 to 4 extra channels, {signed} of them signed; {maps} draw their map"
    );
    report(&all);
    assert!(extra.iter().all(|machines| machines * 30 >= count) && signed > count && maps * 20 > count);
    // `tests/polygon.rs` meets these.
    let of_poly: Vec<&str> = units::poly::SPEC.events.iter().map(|event| event.name).chain(WINDOWS).collect();
    let missing: Vec<_> = all
        .events
        .missing()
        .into_iter()
        .filter(|event| !DIRECTED.contains(event) && !ALONE.contains(event) && !of_poly.contains(event))
        .collect();
    assert_eq!(missing, [""; 0], "not met");
}

/// So many machines with BUMP.
fn whole_reliefs(count: usize) {
    let mut rng = Pcg64Mcg::seed_from_u64(17);
    let drawn = std::iter::repeat_with(|| random_machine(&mut rng));
    let machines: Vec<Plan> = drawn.filter(|plan| plan.shade.bumps()).take(count).collect();
    let all = compared(&machines);
    let phong = machines.iter().filter(|plan| plan.shade.normalises()).count();
    println!("{count} machines with BUMP, {phong} of them with NORMAL");
    report(&all);
    assert!(phong * 4 > count && phong * 4 < 3 * count, "{phong}");
    let possible = machines.iter().flat_map(|plan| Unit::of(&units::bump::SPEC).events(plan));
    let missing = all.events.missing();
    let unmet: Vec<_> = possible.map(|event| event.name).filter(|event| missing.contains(event)).collect();
    assert_eq!(unmet, [""; 0], "not met");
}

/// So many machines with LAMP.
fn whole_lamps(count: usize) {
    let mut rng = Pcg64Mcg::seed_from_u64(18);
    let drawn = std::iter::repeat_with(|| random_machine(&mut rng));
    let machines: Vec<Plan> = drawn.filter(|plan| plan.shade.is_positional()).take(count).collect();
    let all = compared(&machines);
    let textured = machines.iter().filter(|plan| plan.shade.textures()).count();
    println!("{count} machines with LAMP, {textured} of them with TEXEL");
    report(&all);
    assert!(textured * 4 > count && textured * 4 < 3 * count, "{textured}");
    let possible = machines.iter().flat_map(|plan| Unit::of(&units::lamp::SPEC).events(plan));
    let missing = all.events.missing();
    let unmet: Vec<_> = possible.map(|event| event.name).filter(|event| missing.contains(event)).collect();
    assert_eq!(unmet, [""; 0], "not met");
}

/// The machines, on two threads.
fn compared(machines: &[Plan]) -> Checked {
    let shares = shares(machines);
    let half = |half: usize| {
        let mut all = Checked::default();
        for (i, (plan, share)) in machines.iter().zip(&shares).enumerate().skip(half).step_by(2) {
            let mut rng = Pcg64Mcg::seed_from_u64(100 + i as u64);
            let port = Triangles::new(plan);
            let mut case = random_case(plan, &mut rng);
            let drawn = primitives(plan, *share as usize, &mut rng);
            case.tokens = (0..).zip(&drawn).map(|(k, triangle)| port.pack(triangle, k)).collect();
            all.merge(&checked_compiled(&case));
        }
        all
    };
    let all = std::thread::scope(|scope| {
        let other = scope.spawn(|| half(1));
        let mut all = half(0);
        all.merge(&other.join().expect("the other half agrees"));
        all
    });
    // A triangle that a reset took from the machine is not offered again, one in the cycle of the reset is.
    let given: u64 = shares.iter().sum();
    assert!(all.tokens >= given * 9 / 10 && all.compared > 10 * all.cycles);
    all
}

#[test]
fn machines_drawn_at_random() {
    whole_machines(MACHINES[0]);
}

#[test]
fn machines_with_a_relief() {
    whole_reliefs(RELIEFS[0]);
}

#[test]
fn machines_with_a_light_at_a_point() {
    whole_lamps(LAMPS[0]);
}

/// A campaign: `cargo test --release -p edgewalk-lockstep whole:: -- --ignored --nocapture`.
#[test]
#[ignore = "minutes"]
fn many_machines_drawn_at_random() {
    whole_machines(MACHINES[1]);
}

/// Another: `cargo test --release -p edgewalk-lockstep whole::many_machines_with_a_relief -- --ignored --nocapture`.
#[test]
#[ignore = "minutes"]
fn many_machines_with_a_relief() {
    whole_reliefs(RELIEFS[1]);
}

/// Another: `cargo test --release -p edgewalk-lockstep whole::many_machines_with_a_light -- --ignored --nocapture`.
#[test]
#[ignore = "minutes"]
fn many_machines_with_a_light_at_a_point() {
    whole_lamps(LAMPS[1]);
}

/// Triangles of one pixel on one address, right behind others that end there: what the in-flight queue must get right.
#[test]
fn hazards_on_one_pixel() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let mut all = Checked::default();
    let cases = [Hazard::Drain, Hazard::Interlock, Hazard::Forward].into_iter().flat_map(|hazard| {
        [Fill::Exact, Fill::Textbook]
            .into_iter()
            .flat_map(move |fill| (1..=5).map(move |depth| (hazard, fill, depth)))
    });
    for (hazard, fill, inflight) in cases {
        let mut machine =
            Machine { width: 6, height: 6, guard_bits: 3, hazard, inflight, ..Machine::default() };
        (machine.fill, machine.lanes) = (fill, 4);
        machine.subpixel_bits = if fill == Fill::Textbook { 0 } else { 2 };
        let plan = machine.plan().expect("can be built");
        let port = Triangles::new(&plan);
        let triangles = (0..100).flat_map(|_| {
            let first = random_primitive(&plan, &mut rng);
            [first, after_it(&plan, &mut rng, &first), one_pixel(&plan, &mut rng, 2, 3)]
        });
        let tokens = triangles.map(|triangle| port.pack(&triangle, 0)).collect();
        let mut case = Case { resets: Vec::new(), ..random_case(&plan, &mut rng) };
        (case.tokens, case.state.depth_write) = (tokens, true);
        case.unwilling.remove("tri");
        all.merge(&checked_compiled(&case));
    }
    report(&all);
    let met = &all.events;
    assert!(met.depth.drain_stall > 0 && met.depth.interlock_stall > 0, "hazards that wait were not met");
    assert!(met.depth.forward_compare > 0, "forwarding was not met");
    assert!(met.depth.forward_write > 0 && met.depth.forward_used > 0, "forwarding was not met");
}

/// The same with BLEND, for colours: every kind, policy, number of multipliers and stages.
#[test]
fn colours_on_one_pixel() {
    let mut rng = Pcg64Mcg::seed_from_u64(4);
    let (mut all, mut machines) = (Checked::default(), 0);
    let hazards = [Hazard::Drain, Hazard::Interlock, Hazard::Forward];
    for kind in [BlendKind::Constant, BlendKind::Interpolated] {
        for (i, hazard) in hazards.into_iter().enumerate() {
            for (multipliers, stages) in [(3, 1), (3, 2), (1, 1), (1, 2), (0, 1), (0, 2)] {
                let mut machine =
                    Machine { width: 6, height: 6, guard_bits: 3, lanes: 4, ..Machine::default() };
                (machine.hazard, machine.subpixel_bits) = (hazards[(i + machines) % 3], 2);
                machine.blend = Blend { kind, hazard, multipliers, stages, ..machine.blend };
                machine.blend.queue = rng.random_range(1..=4);
                machine.blend.latency = rng.random_range(1..=3);
                machine.blend.kt_bits = rng.random_range(4..=12);
                let plan = machine.plan().expect("can be built");
                let port = Triangles::new(&plan);
                let triangles = (0..120).flat_map(|_| {
                    let first = random_primitive(&plan, &mut rng);
                    [first, after_it(&plan, &mut rng, &first), one_pixel(&plan, &mut rng, 2, 3)]
                });
                let tokens = triangles.map(|triangle| port.pack(&triangle, 0)).collect();
                let mut case = Case { tokens, resets: Vec::new(), ..random_case(&plan, &mut rng) };
                (case.state.depth_func, case.state.color_write) = (7, true);
                case.unwilling.remove("tri");
                // Writes that wait longer than SETUP takes keep colours in flight.
                case.unwilling.insert("cwr".to_owned(), [0, 150, 240, 253][machines % 4]);
                all.merge(&checked_compiled(&case));
                machines += 1;
            }
        }
    }
    println!("{machines} machines");
    report(&all);
    let met = |name: &&str| all.events.counts().into_iter().any(|(event, count)| event == *name && count > 0);
    let colors = ["color_drain_stall", "color_interlock_stall", "color_forward_write"];
    let missing: Vec<_> = DIRECTED.iter().chain(&colors).filter(|name| !met(name)).collect();
    assert!(missing.is_empty(), "{missing:?} not met");
}
