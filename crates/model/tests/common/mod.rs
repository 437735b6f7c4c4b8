//! Machines, vertices and triangles for the tests.
#![allow(dead_code, unused_imports, reason = "every test file uses a part")]

pub mod blend;
pub mod check;
pub mod depth;
pub mod polygon;
pub mod rule;
pub mod shade;

pub use check::Check;
pub use rule::inside;

use edgewalk_machine::{Channel, Dither, Kind, Machine, Plan, PortVertex, ShadeKind};
use edgewalk_model::tokens::{Fragment, MAX_CHANNELS, output};
use edgewalk_model::{Cycle, DrawState, Frame, Model, Rig, Sample, Stalls};
use rand::Rng;
use std::convert::Infallible;

pub type Triangle = [PortVertex; 3];

/// Every fragment is read, whatever is stored.
pub const ALWAYS: DrawState = DrawState {
    depth_func: 7,
    depth_write: true,
    color_write: true,
    blend_add: false,
    shadow_on: false,
    light_pass: false,
    ambient: 0,
    clear: [0; 3],
};

pub fn machine(settings: &[(&str, &str)]) -> Plan {
    let mut machine = Machine::default();
    for (key, value) in settings {
        machine.set(key, value).expect("a key of the machine");
    }
    machine.plan().expect("a machine that can be built")
}

/// The same vertex elsewhere.
pub fn moved(plan: &Plan, vertex: &PortVertex, x: i32, y: i32) -> PortVertex {
    plan.raw_vertex(x, y, vertex.values())
}

/// PROJECT divides the channel: what leaves the machine is a quotient, which suites of its own judge.
pub fn is_divided(plan: &Plan, channel: &Channel) -> bool {
    plan.shadow.projects() && ["lx", "ly", "lz", "lw"].contains(&channel.name)
}

/// As [`edgewalk_model::render`], of triangles that are this machine's.
/// Draws the triangles. `see` gets every cycle: its number, the machine behind it, and what happened. The machine is long to compile:
/// so it is compiled here once, and not in every test.
#[inline(never)]
pub fn watch(
    rig: &mut Rig<MAX_CHANNELS>,
    triangles: &[Triangle],
    see: &mut dyn FnMut(u64, &Model<MAX_CHANNELS>, &Cycle<MAX_CHANNELS>),
) {
    let offered = triangles.iter().map(|triangle| Ok::<_, Infallible>(*triangle));
    let Ok(()) = rig.draw(offered, see);
}

/// The fragments that are read, in order.
pub fn fragments_read(rig: &mut Rig<MAX_CHANNELS>, triangles: &[Triangle]) -> Vec<Fragment<MAX_CHANNELS>> {
    let mut seen = Vec::new();
    watch(rig, triangles, &mut |_, model, cycle| seen.extend(cycle.read.map(|_| model.last_read())));
    seen
}

pub fn render(plan: &Plan, triangles: &[Triangle], state: DrawState, stalls: Stalls) -> Frame {
    edgewalk_model::render(plan, triangles.iter().copied(), state, stalls).expect("this machine's vertices")
}

/// Every fragment, in order; gives `hook` its triangle's number, column and line, and outputs, LSB.
pub fn fragments(plan: &Plan, triangles: &[Triangle], mut hook: impl FnMut(usize, (i64, i64), Vec<i64>)) {
    let each = |drawn: edgewalk_model::Drawn| {
        if let edgewalk_model::Drawn::Fragment(sample) = drawn {
            hook(sample.source.id as usize, place(plan, sample.addr), outputs(plan, sample.values));
        }
    };
    let triangles = triangles.iter().copied();
    edgewalk_model::render_with(plan, triangles, ALWAYS, Stalls::NONE, each)
        .expect("this machine's vertices");
}

/// Column and line of an address.
pub fn place(plan: &Plan, addr: u32) -> (i64, i64) {
    let bits = plan.widths().x;
    (i64::from(addr & ((1 << bits) - 1)), i64::from(addr >> bits))
}

/// The outputs of the channels, LSB.
pub fn outputs(plan: &Plan, values: &[u32]) -> Vec<i64> {
    plan.channels().iter().zip(values).map(|(channel, word)| output(channel, *word)).collect()
}

/// A random value for every channel, and a k_t if triangles have one; one in eight is the largest in magnitude, so that words
/// wrap.
pub fn random_values(plan: &Plan, rng: &mut impl Rng) -> Vec<i64> {
    let value = |channel: &edgewalk_machine::Channel| {
        let most = (channel.limit() << channel.vertex_fraction) as i64;
        let least = if channel.kind.is_signed() { -most } else { 0 };
        match rng.random_range(0..16) {
            0 => least,
            1 => most,
            _ => rng.random_range(least..=most),
        }
    };
    let mut values: Vec<i64> = plan.channels().iter().map(value).collect();
    if plan.has_triangle_kt() {
        values.push(if rng.random_bool(0.3) { 0 } else { rng.random_range(0..=1 << plan.blend.kt_bits) });
    }
    values
}

/// A random triangle around the screen whose corners lie within `size` px of each other.
pub fn random_triangle(plan: &Plan, size: f64, rng: &mut impl Rng) -> Triangle {
    let one = f64::from(1u32 << plan.subpixel_bits);
    let limit = f64::from((1u32 << plan.guard_bits) - 1);
    let middle = [plan.width, plan.height].map(|side| rng.random_range(0.0..f64::from(side)));
    std::array::from_fn(|_| {
        let c = middle.map(|m| (m + rng.random_range(-0.5..=0.5) * size).clamp(-limit, limit) * one);
        plan.raw_vertex(c[0].round() as i32, c[1].round() as i32, &random_values(plan, rng))
    })
}

/// Triangles of every size and place, degenerate ones among them.
pub fn any_triangle(plan: &Plan, rng: &mut impl Rng) -> Triangle {
    let size = 2f64.powf(rng.random_range(-3.0..f64::from(plan.guard_bits) + 1.0));
    let mut triangle = random_triangle(plan, size, rng);
    let limit = ((1i32 << plan.guard_bits) - 1) << plan.subpixel_bits;
    for corner in &mut triangle {
        if rng.random_bool(0.05) {
            let x = rng.random_range(-limit..=limit);
            let y = rng.random_range(-limit..=limit);
            *corner = moved(plan, corner, x, y);
        }
    }
    match rng.random_range(0..16) {
        0 => triangle[1] = triangle[0],
        1 => triangle[2] = moved(plan, &triangle[2], triangle[2].x(), triangle[1].y()),
        2 => triangle[1] = moved(plan, &triangle[1], triangle[1].x(), triangle[0].y()),
        3 => triangle[2] = moved(plan, &triangle[2], triangle[0].x(), triangle[2].y()),
        4 => {
            let middle = |a: i32, b: i32| a + (b - a) / 2;
            let [a, b, _] = triangle;
            triangle[2] = moved(plan, &a, middle(a.x(), b.x()), middle(a.y(), b.y()));
        }
        _ => {}
    }
    triangle
}

/// A machine with every key drawn at random, that can be built; `fixed` settings stay. Without TERM and SHADE and
/// without DITHER, if they do not ask for them: those make colours of their own, from records, tables and a pattern.
pub fn random_machine(fixed: &[(&str, &str)], rng: &mut impl Rng) -> Plan {
    use edgewalk_machine::key::Domain;
    use edgewalk_machine::keys::KEYS;
    loop {
        let mut machine = Machine::default();
        // Machines with POLY have a suite of their own, tests/polygon.rs.
        for key in KEYS.iter().filter(|key| key.name != "polygon.edges") {
            let value = match key.domain {
                Domain::Range(low, high) => rng.random_range(low..=high),
                Domain::OneOf(list) => list[rng.random_range(0..list.len())],
                Domain::Word(words) => rng.random_range(0..words.len() as u32),
            };
            (key.set)(&mut machine, value);
        }
        machine.shade.kind = ShadeKind::None;
        machine.dither = Dither::default();
        for (key, value) in fixed {
            machine.set(key, value).expect("a key of the machine");
        }
        if let Ok(plan) = machine.plan() {
            return plan;
        }
    }
}
