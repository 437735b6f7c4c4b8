//! What the mutants of TERM, TEXEL, BUMP, NORMAL, LAMP, SHADE and PROJECT are tried with beside the suites: tokens as no other unit gives them.

use crate::common;
use edgewalk_machine::{
    Bump, Machine, Plan, Project, Shade, ShadeColour, ShadeKind, ShadeLight, ShadowLight, Texture, Walk,
};
use edgewalk_model::DrawState;
use edgewalk_vectors::{StallKind, Trace, Unit, capture_tokens};
use rand::seq::IndexedRandom;
use rand::{Rng, RngCore, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Each unit in each of its kinds, with short words.
pub fn machines() -> Vec<(Plan, Unit)> {
    let small = Machine::clone(&common::small());
    let shade = |kind, walk, colour, lights| {
        let shade = Shade { kind, walk, colour, lights, gloss_bits: 2, material_bits: 1, ..small.shade };
        let shade = Shade { table_bits: 8, fraction: 3, linear_fraction: 2, record_bits: 3, ..shade };
        let shade = Shade { texture: Texture::None, texture_bits: 2, texel_queue: 2, ..shade };
        let mut machine = Machine { shade, ..small.clone() };
        machine.color.bits = 2;
        machine
    };
    let textured = |mut machine: Machine| {
        machine.shade.texture = Texture::Nearest;
        machine
    };
    let relief = |mut machine: Machine| {
        (machine.shade.bump, machine.shade.slope_bits) = (Bump::Yes, 4);
        machine.shade.texture = Texture::Nearest;
        machine
    };
    let lamp = |mut machine: Machine| {
        machine.shade.light = ShadeLight::Positional;
        machine
    };
    use ShadeColour::{Multiply, Tables};
    use ShadeKind::{FastPhong, Phong};
    let fast = shade(FastPhong, Walk::Register, Tables, 1);
    let list = [
        (fast.clone(), common::TERM),
        (shade(FastPhong, Walk::Memory, Tables, 1), common::TERM),
        (textured(shade(Phong, Walk::Memory, Multiply, 1)), common::TERM),
        (fast.clone(), common::PIXEL),
        (textured(shade(FastPhong, Walk::Register, Multiply, 1)), common::TEXEL),
        (relief(shade(FastPhong, Walk::Register, Multiply, 1)), common::BUMP),
        (relief(shade(Phong, Walk::Register, Multiply, 1)), common::BUMP),
        (shade(Phong, Walk::Register, Tables, 1), common::NORMAL),
        (lamp(shade(Phong, Walk::Register, Tables, 1)), common::LAMP),
        (fast, common::SHADE),
        (shade(FastPhong, Walk::Register, Multiply, 2), common::SHADE),
        (lamp(shade(Phong, Walk::Register, Tables, 1)), common::SHADE),
    ];
    list.into_iter().map(|(machine, unit)| (machine.plan().expect("can be built"), unit)).collect()
}

/// PROJECT of both kinds; where the texel has more rows, and where the depth has.
pub fn machines_with_project() -> Vec<(Plan, Unit)> {
    let kinds = [(Project::Pipelined, 5, 4, 6), (Project::Serial, 64, 4, 7), (Project::Serial, 3, 4, 5)];
    let each = |(project, size, depth_bits, light_bits)| {
        let mut machine = Machine::clone(&common::small());
        let light = ShadowLight::Perspective;
        machine.shadow =
            edgewalk_machine::Shadow { light, project, size, depth_bits, light_bits, ..machine.shadow };
        (machine.shadow.fraction, machine.shadow.vertex_fraction) = (4, 1);
        (machine.z.bits, machine.color.bits) = (4, 2);
        (machine.plan().expect("can be built"), common::PROJECT)
    };
    kinds.map(each).to_vec()
}

/// Tokens of one material.
const FEW: usize = 400;

/// As many tokens with fields at and beside the ends of what they mean to the unit, so many of another material than the first; or a few
/// of the first alone.
pub fn any_tokens(machine: &Plan, of: &Trace, others: f64, stalls: StallKind, seed: u64) -> Trace {
    let taken = &of.interface.links[0];
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tokens = of.setting.tokens.clone();
    if others == 0.0 {
        tokens.truncate(FEW);
    }
    let (mut y, mut first) = (0, true);
    for token in &mut tokens {
        y = (y + random.random_range(0..3)) % i128::from(machine.height);
        for (field, port) in taken.fields.iter().enumerate() {
            let bits = port.width();
            let any = random.next_u64() as i128;
            let number = match port.field.name.as_str() {
                "fresh" => i128::from(first || random.random_bool(0.3)),
                // From far off the screen too.
                "x" if random.random_bool(0.03) => any,
                "x" => random.random_range(-3..i128::from(machine.width) + 3),
                "y" => y,
                "count" => random.random_range(1..6),
                "material" => i128::from(random.random_bool(others)),
                "gloss" => random.random_range(0..=i128::from(machine.shade.gloss_bits)),
                // For LAMP of every exponent.
                "nn" if taken.place("dd").is_some() && random.random() => {
                    i128::from(random.random_range(0..4u32)) << random.random_range(0..16)
                }
                // Where the root's slope leaves 1 less than a half.
                "nn" => beside(&[0x4000, 0x807f, 0x1_0000], &mut random),
                "beam" if random.random() => beside(&[0, 0x8000, 0x1_0000], &mut random),
                // At a right angle to its axis.
                "da" if random.random_bool(0.2) => 0,
                // 1 less than a half of what is cut off, below 0.
                "pl" | "dv" | "da" | "pv" if random.random_bool(0.1) => -65,
                "pl0" | "ph0" if random.random_bool(0.1) => -0x8001,
                // Seen from where the light stands, and against it.
                "dd" if random.random_bool(0.3) => (1 << 30) - 1,
                // Where the slope of table A leaves 1 less than a half.
                "dd" if random.random_bool(0.1) => 0xfc01 << 14,
                "dv" if random.random_bool(0.3) => {
                    random.random_range(-1..1) << 23 | random.random_range(0..4096)
                }
                "dd" => any >> random.random_range(34..64),
                "pl" | "dv" | "da" | "pv" if random.random_bool(0.9) => any >> random.random_range(40..60),
                "nl0" | "nh0" if machine.shade.bumps() => any,
                "nl0" | "nh0" | "nl1" | "nh1" => match random.random() {
                    true => beside(&[0, 256, 1 << (bits - 1)], &mut random),
                    false => random.random_range(0..256),
                },
                "pl0" | "ph0" if random.random_bool(0.7) => random.random_range(-200..=0x1_0200),
                "lw" => match random.random_range(0..8) {
                    0 => random.random_range(-1..4),
                    1 => any,
                    _ => random.random_range(1..1 << (bits - 1)),
                },
                "lx" | "ly" | "lz" if bits > 1 => match random.random_range(0..4) {
                    0 => any,
                    1 => beside(&[0, 1 << (bits - 2)], &mut random),
                    _ => random.random_range(0..1 << (bits - 1)),
                },
                _ => any,
            };
            token[field] = number as u128 & (u128::MAX >> (128 - bits));
        }
        if let Some(weight) = taken.place("lw") {
            edges(taken, token, weight, &mut random);
        }
        first = false;
    }
    capture_tokens(machine, of.interface.unit, tokens, DrawState::default(), stalls, seed)
}

/// One of these numbers, or one less or more.
fn beside(numbers: &[i128], random: &mut Pcg64Mcg) -> i128 {
    numbers.choose(random).copied().unwrap_or(0) + random.random_range(-1..=1)
}

/// Now and then a number is its weight, or one beside it.
fn edges(taken: &edgewalk_lockstep::Link, token: &mut [u128], weight: usize, random: &mut Pcg64Mcg) {
    for name in ["lx", "ly", "lz"] {
        if let Some(place) = taken.place(name).filter(|_| random.random_bool(0.2)) {
            let number = token[weight] as i128 + random.random_range(-1..=1);
            token[place] = number as u128 & (u128::MAX >> (128 - taken.fields[place].width()));
        }
    }
}
