//! Machines drawn at random from the keys, small enough for an interpreter.

use edgewalk_machine::key::Domain;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{
    BlendKind, Dither, EdgeKind, Fill, Lines, MAX_CHANNELS, Machine, OwnPass, Plan, Precision, ShadeColour,
    ShadeKind, ShadeLight, ShadowLight, Texture, Transmits, Values,
};
use rand::Rng;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;

/// Keys that take less than their domain: screens that an interpreter fills, queues that get full.
const NARROW: &[(&str, u32, u32)] = &[
    ("screen.width", 1, 20),
    ("screen.height", 1, 20),
    ("fifo.span", 1, 4),
    ("fifo.inflight", 1, 6),
    ("fifo.blend", 1, 6),
    ("fifo.shadow", 1, 6),
    ("shadow.size", 1, 40),
    ("term.record_bits", 1, 4),
    ("shade.material_bits", 0, 2),
    ("texture.bits", 1, 4),
];

/// A machine that can be built. Every key takes all kinds of values, so a new key is drawn without a word here.
pub fn random_machine(rng: &mut Pcg64Mcg) -> Plan {
    loop {
        if let Ok(plan) = draw(rng).plan() {
            return plan;
        }
    }
}

/// The same with POLY in EDGE's place.
pub fn random_poly(rng: &mut Pcg64Mcg) -> Plan {
    loop {
        let mut machine = draw(rng);
        machine.polygon.edges = *[8, 8, 16, 32].choose(rng).expect("four");
        if machine.polygon.is_bilinear() {
            if rng.random() {
                (machine.edge_kind, machine.shade.kind) = (EdgeKind::Slope, ShadeKind::None);
            } else {
                machine.polygon.values = Values::Plane;
            }
        }
        if let Ok(plan) = machine.plan() {
            return plan;
        }
    }
}

fn draw(rng: &mut Pcg64Mcg) -> Machine {
    let mut machine = Machine::default();
    // Machines with POLY are drawn apart, by `random_poly`.
    for key in KEYS.iter().filter(|key| key.name != "polygon.edges") {
        let narrow = NARROW.iter().find(|(name, ..)| *name == key.name);
        let domain = narrow.map_or(key.domain, |(_, low, high)| Domain::Range(*low, *high));
        let value = match domain {
            Domain::Range(low, high) => rng.random_range(low..=high),
            Domain::OneOf(list) => *list.choose(rng).expect("a domain is not empty"),
            Domain::Word(words) => rng.random_range(0..words.len() as u32),
        };
        (key.set)(&mut machine, value);
    }
    if machine.shade.texture != Texture::None {
        machine.shade.colour = ShadeColour::Multiply; // tables have no colour to multiply
    }
    if machine.shade.bumps() {
        machine.shade.light = ShadeLight::Directional; // LAMP takes no relief
    }
    if machine.shade.is_positional() {
        machine.shade.lights = 1;
        machine.shade.fraction = machine.shade.fraction.min(32);
        machine.shade.linear_fraction = machine.shade.linear_fraction.min(39);
    }
    // What would make nearly all of them clash.
    machine.guard_bits =
        if rng.random_bool(0.1) { rng.random_range(8..=14) } else { rng.random_range(2..=6) };
    machine.tag_bits = *[0, 1, 5, 32].choose(rng).expect("four");
    if machine.fill == Fill::Textbook {
        machine.subpixel_bits = 0;
    }
    if machine.fill == Fill::Textbook || machine.subpixel_bits == 0 || machine.shade.is_there() {
        machine.polygon.lines = Lines::No; // a line has no half pixel there, or nobody who walks up
    }
    let within = |p: &mut Precision| p.vertex_fraction = p.vertex_fraction.min(p.fraction);
    within(&mut machine.z);
    within(&mut machine.color);
    machine.extras.iter_mut().for_each(|extra| within(&mut extra.precision));
    let kt = &mut machine.blend;
    kt.kt_vertex = kt.kt_vertex.min(kt.kt_fraction);
    if kt.kind != BlendKind::None || rng.random_bool(0.25) {
        machine.dither = Dither::default(); // with BLEND there is none, and some of the others have none
    }
    if machine.dither.bits >= machine.color.bits {
        machine.dither.bits = 0;
    }
    let light = &mut machine.shadow;
    if machine.dither.drops() {
        light.own_pass = OwnPass::No; // the pattern is that of the picture
    }
    light.vertex_fraction = light.vertex_fraction.min(light.fraction);
    if machine.extra > 2 && rng.random() {
        light.light = ShadowLight::None; // it leaves no room for so many channels of the user's own
    }
    if light.draws_map() {
        light.size = light.size.min(1 << machine.guard_bits);
        light.depth_bits = light.depth_bits.min(machine.z.bits);
        if light.transmits() && kt.kind == BlendKind::None {
            light.transmits = Transmits::No; // BLEND would draw that plane
        }
    }
    if light.projects() && kt.kind == BlendKind::Interpolated {
        kt.kind = BlendKind::Constant; // there are eight channels at most
    }
    let own = u32::from(kt.kind == BlendKind::Interpolated) + light.channels().len() as u32;
    machine.extra = machine.extra.min(MAX_CHANNELS as u32 - 4 - own);
    machine.adders = machine.adders.min(4 + machine.extra + own);
    machine
}
