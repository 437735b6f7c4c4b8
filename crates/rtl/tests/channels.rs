//! Extra channels against the first four: what has the same format and the same vertices comes out the same, and nothing else
//! changes. Every machine is drawn at random, so the channels meet in all kinds of rounds, adders and segments.

use crate::drive;
use crate::drive::{Memory, Seen};
use crate::random;
use edgewalk_machine::{BlendKind, Channel, Dither, Kind, Machine, Plan, Precision, SetupKind, ShadeKind};
use edgewalk_rtl as rtl;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

const MACHINES: usize = 60;
const TRIANGLES: usize = 4;

/// By vertex: x, y, then the values of z, r, g, b at the port.
type Triangle = [[i64; 6]; 3];

#[test]
fn extra_channels_are_as_the_first_four() {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let mut checked = 0;
    for _ in 0..MACHINES {
        let (with, without) = machines(&mut rng);
        let triangles: Vec<Triangle> = (0..TRIANGLES).map(|_| triangle(&mut rng, &with)).collect();
        let (seen, expected) = (run(&with, &triangles), run(&without, &triangles));
        assert_eq!(seen.writes.len(), expected.writes.len(), "{with:?}");
        for (write, other) in seen.writes.iter().zip(&expected.writes) {
            let [_, z, r, ..] = write[..5] else { panic!("address, z, r, g, b") };
            let sign = 1 << (with.color.bits - 1);
            assert_eq!(write[..5], other[..5], "what was there before: {with:?}");
            assert_eq!(write[5..8], [r, r ^ sign, r ^ sign], "{with:?}");
            assert!(!is_as_z(&with) || write[8] == z, "{with:?}");
            checked += 1;
        }
        let clocks = |plan: &Plan| u64::from(plan.clocks_per_pixel());
        assert_eq!(seen.busy * clocks(&without), expected.busy * clocks(&with), "{with:?}");
    }
    println!("{checked} fragments of {MACHINES} machines");
    assert!(checked > 20 * MACHINES, "only {checked} fragments");
}

/// A machine with e0 as r, e1 the same signed, e2 the same but floor, and e3 as z or with a format of its own; and without them.
fn machines(rng: &mut Pcg64Mcg) -> (Plan, Plan) {
    loop {
        let mut machine: Machine = (*random::random_plan(rng)).clone();
        // Without BLEND, DITHER and SHADE a fragment's values are written as they are, by one link.
        (machine.blend.kind, machine.shade.kind) = (BlendKind::None, ShadeKind::None);
        machine.dither = Dither::default();
        machine.setup_kind = SetupKind::Parallel; // the driver offers whole triangles
        machine.polygon.edges = 0; // and no window
        machine.width = rng.random_range(1..=16);
        machine.height = rng.random_range(1..=16);
        machine.guard_bits = rng.random_range(4..=6);
        let color = Precision { vertex_fraction: machine.color.vertex_fraction.max(1), ..machine.color };
        machine.color = color;
        // A longer word than all others makes them begin later in SETUP.
        let last = if rng.random() { machine.z } else { machine.extras[3].precision };
        let formats =
            [(Kind::Unorm, color), (Kind::Signed, color), (Kind::Floor, color), (Kind::Unorm, last)];
        for (extra, (kind, precision)) in machine.extras.iter_mut().zip(formats) {
            (extra.kind, extra.precision) = (kind, precision);
        }
        machine.extra = 4;
        let without = Machine { extra: 0, adders: rng.random_range(1..=4), ..machine.clone() };
        if let (Ok(with), Ok(without)) = (machine.plan(), without.plan()) {
            return (with, without);
        }
    }
}

fn is_as_z(plan: &Plan) -> bool {
    plan.extras[3].precision == plan.z
}

fn triangle(rng: &mut Pcg64Mcg, plan: &Plan) -> Triangle {
    let reach = ((1i64 << plan.guard_bits) - 1) << plan.subpixel_bits;
    // Most triangles near the screen.
    let near = reach.min(24 << plan.subpixel_bits);
    let reach = if rng.random_bool(0.8) { near } else { reach };
    std::array::from_fn(|_| {
        let mut vertex = [0; 6];
        vertex[..2].fill_with(|| rng.random_range(-reach / 4..=reach));
        for (value, channel) in vertex[2..].iter_mut().zip(plan.channels()) {
            // One LSB away from either end, so that half an LSB more and the sign's offset fit.
            *value = rng.random_range(unit(channel)..=(channel.max() as i64 - 1) * unit(channel));
        }
        vertex
    })
}

/// One LSB of the output, at the vertex port.
fn unit(channel: &Channel) -> i64 {
    1 << channel.vertex_fraction
}

/// What stands at a vertex port of a channel.
fn port_value(channel: &Channel, vertex: &[i64; 6]) -> i64 {
    let [_, _, z, r, g, b] = *vertex;
    let offset = unit(channel) << (channel.bits - 1);
    match channel.name {
        "z" | "e3" => z,
        "g" => g,
        "b" => b,
        // The same, with the middle of the range at 0.
        "e1" => r - offset,
        // Half an LSB more makes the floor a rounding.
        "e2" => r - offset + unit(channel) / 2,
        _ => r,
    }
}

/// What a triangle puts on the ports of this machine.
fn on_ports(plan: &Plan, triangle: &Triangle) -> drive::Triangle {
    let mut ports = Vec::new();
    for (place, vertex) in ["0", "1", "2"].into_iter().zip(triangle) {
        ports.extend([(format!("tri_x{place}"), vertex[0]), (format!("tri_y{place}"), vertex[1])]);
        let value = |c: &Channel| (format!("tri_{}", c.at_vertex(place)), port_value(c, vertex));
        ports.extend(plan.channels().iter().map(value));
    }
    ports.extend((plan.tag_bits > 0).then(|| ("tri_tag".to_owned(), 1)));
    ports
}

fn run(plan: &Plan, triangles: &[Triangle]) -> Seen {
    let netlist = rtl::machine(plan).unwrap_or_else(|errors| panic!("{plan:?}\n{errors}"));
    let triangles: Vec<_> = triangles.iter().map(|triangle| on_ports(plan, triangle)).collect();
    let depths = Memory { read: "rd", data: "data", latency: 1 };
    drive::run(&netlist, plan, &[depths], &triangles, |_| {})
}
