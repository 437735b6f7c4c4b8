//! Tokens for a unit alone: such as the rest of the machine would rarely give it.

use super::polygons::primitives;
use super::triangles::{random_primitive, sides};
use edgewalk_lockstep::{Direction, Interface, Port, Rig, Setting, Token, Triangles, Unit, model};
use edgewalk_machine::{Fill, Plan};
use edgewalk_model::DrawState;
use rand::seq::IndexedRandom;
use rand::{Rng, RngCore};
use rand_pcg::Pcg64Mcg;

/// So many random tokens for the unit.
pub fn random_tokens(plan: &Plan, unit: Unit, count: usize, rng: &mut Pcg64Mcg) -> Vec<Token> {
    match unit.name() {
        "machine" | "setup" => triangles(plan, count, rng),
        // What EDGE or POLY takes has to fit together: SETUP makes it.
        "edge" | "poly" => prims(plan, count, rng),
        _ => {
            let interface = Interface::new(plan, unit);
            let fields = &interface.links[0].fields;
            let mut tokens: Vec<Token> = (0..count).map(|_| token(plan, fields, rng)).collect();
            // The first of all brings increments: before it PIXEL has none.
            let fresh = interface.links[0].place("fresh");
            if let (Some(first), Some(fresh)) = (tokens.first_mut(), fresh) {
                first[fresh] = 1;
            }
            if unit.name() == "term" {
                side_by_side(plan, &interface, &mut tokens, rng);
            }
            tokens
        }
    }
}

fn triangles(plan: &Plan, count: usize, rng: &mut Pcg64Mcg) -> Vec<Token> {
    let port = Triangles::new(plan);
    if plan.polygon.is_there() {
        return primitives(plan, count, rng)
            .iter()
            .map(|triangle| port.pack(triangle, rng.random()))
            .collect();
    }
    (0..count).map(|_| port.pack(&random_primitive(plan, rng), rng.random())).collect()
}

/// The prims of random triangles, those that are not culled.
fn prims(plan: &Plan, count: usize, rng: &mut Pcg64Mcg) -> Vec<Token> {
    let setup = Interface::new(plan, Unit::named("setup").expect("declared"));
    // A triangle in so many is not culled, in nearly any machine.
    let tokens = triangles(plan, 20 * count, rng);
    let picture = DrawState::default().constants();
    let setting = Setting { tokens, ..Setting::willing(&setup, &picture).expect("those of a picture") };
    let (mut rig, mut ports) = (Rig::new(&setup, setting), setup.values());
    let mut device = model(plan, &setup).expect("the model has SETUP");
    let out = setup.links_of(Direction::Out).next().expect("SETUP gives prims");
    let mut prims = Vec::new();
    while prims.len() < count && !rig.exhausted() {
        rig.drive(&mut ports);
        device.cycle(&mut ports);
        if out.fires(&ports) {
            prims.push(out.token(&ports).to_vec());
        }
        rig.clock(&ports);
    }
    prims
}

/// Most spans a line or a few below the one before, so that TERM is not on its way for most of the time.
fn side_by_side(plan: &Plan, interface: &Interface, tokens: &mut [Token], rng: &mut Pcg64Mcg) {
    let y = interface.links[0].place("y").expect("a span has a line");
    for i in 1..tokens.len() {
        if rng.random_bool(0.9) {
            tokens[i][y] = (tokens[i - 1][y] + rng.random_range(0..3)) % u128::from(plan.height);
        }
    }
}

/// A number around the ends of a table of SHADE, or any other of so many bits.
fn cosine(plan: &Plan, bits: u32, rng: &mut Pcg64Mcg) -> i128 {
    let (last, most) = ((1i128 << plan.shade.table_bits) - 1, (1i128 << (bits - 1)) - 1);
    let ends = [-1, 0, last, last + 1, -most - 1, most];
    match rng.random_range(0..4) {
        0 => *ends.choose(rng).expect("some"),
        1 => rng.random_range(-most - 1..=most),
        _ => rng.random_range(0..=last),
    }
}

/// Random bits, but columns and lines around the screen, short spans, few addresses and few depths, so that they meet.
fn token(plan: &Plan, fields: &[Port], rng: &mut Pcg64Mcg) -> Token {
    let [width, height] = sides(plan, rng).map(i128::from);
    let fresh = rng.random_bool(0.3);
    // kt: 0, 1, more than 1, or anything.
    let one = 1i128 << plan.blend.kt_bits;
    let kts = [0, one, one + rng.random_range(0..one), rng.random_range(0..one), rng.random_range(0..one)];
    // PROJECT divides by a weight, the others by it; SHADOW behind it has none.
    let most = 1i128 << plan.shadow.light_bits;
    let weights = [rng.random_range(-most..most), rng.random_range(1..4), rng.random_range(1..most)];
    let weight =
        fields.iter().any(|port| port.name == "frag_lw").then(|| *weights.choose(rng).expect("some"));
    let value = |port: &Port| {
        let random = u128::from(rng.next_u64()) << 64 | u128::from(rng.next_u64());
        let number = match port.name.as_str() {
            "line_cmaj" | "line_cmin" => rng.random_range(-3..=width + 3),
            "span_x" => rng.random_range(-4..width + 4),
            "span_count" => rng.random_range(1..=9),
            "line_y" if plan.polygon.has_lines() => rng.random_range(0..width.min(height)),
            "line_y" | "span_y" => rng.random_range(0..height),
            "line_fresh" => fresh.into(),
            "line_fence" => (fresh || plan.fill == Fill::Textbook && rng.random_bool(0.2)).into(),
            "frag_addr" | "pass_addr" => rng.random_range(0..3.min(1 << plan.widths().address)),
            "frag_z" => rng.random_range(0..=few(plan)).into(),
            "pass_kt" => *kts.choose(rng).expect("some"),
            "frag_fence" | "pass_fence" => rng.random_bool(0.3).into(),
            "frag_material" if rng.random_bool(0.99) => 0,
            "frag_nl0" | "frag_nh0" | "frag_nl1" | "frag_nh1" => cosine(plan, port.width(), rng),
            "frag_gloss" => rng.random_range(0..=plan.shade.gloss_bits).into(),
            // Roots of small numbers, and numbers that are not all beyond the ends.
            "frag_dd" => (random >> rng.random_range(96..128)) as i128,
            "frag_pl" | "frag_dv" | "frag_da" | "frag_pv" => random as i128 >> rng.random_range(103..124),
            // N.N is cut below 2^14 and from 2^16 on.
            "frag_nn" if rng.random_bool(0.7) => rng.random_range((1 << 14) - 2..(1 << 16) + 2),
            "frag_lw" => weight.unwrap_or(0),
            "frag_lx" | "frag_ly" | "frag_lz" if weight.is_some() => {
                let w = weight.unwrap_or(0);
                match rng.random_range(0..8) {
                    0 => w,
                    1 => rng.random_range(-most..most),
                    2 => w - 1,
                    3 => -1,
                    _ => rng.random_range(0..=w.max(0)),
                }
            }
            "frag_lx" | "frag_ly" if rng.random_bool(0.9) => {
                rng.random_range(-1..=i128::from(plan.shadow.size))
            }
            "frag_lz" if rng.random_bool(0.9) => rng.random_range(-1..=1i128 << plan.shadow.depth_bits),
            _ => random as i128,
        };
        number as u128 & (u128::MAX >> (128 - port.width()))
    };
    fields.iter().map(value).collect()
}

/// The largest of the few depths that DEPTH alone gets.
pub fn few(plan: &Plan) -> u64 {
    plan.z.max().min(3)
}
