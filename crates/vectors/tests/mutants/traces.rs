//! What the faults of a unit are tried with: suites under every kind of stall, and tokens that no unit before it gives.

use super::{setup, shaded};
use crate::common;
use edgewalk_machine::Plan;
use edgewalk_model::DrawState;
use edgewalk_vectors::{StallKind, Suite, Trace, Unit, capture, capture_tokens};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
/// What a unit's mutants are tried with.
pub fn traces(machine: &Plan, unit: Unit) -> Vec<Trace> {
    let names: &[&str] =
        if unit == common::SETUP { &["corners", "random"] } else { &["hazards", "corners", "random"] };
    let suites = names.iter().map(|name| Suite::named(machine, name, 1, 24).expect("listed"));
    let suite = Suite::joined("mutants", "all that is directed, and some at random", suites);
    let half = suite.clone().on_half_depth(machine);
    // Only DEPTH looks at the function and the write mask.
    let functions = match unit.name() {
        "depth" => 0..8,
        // Under always most comes to it.
        "blend" => 7..8,
        _ => 1..2,
    };
    let mut traces = Vec::new();
    for depth_func in functions {
        for stalls in StallKind::ALL {
            let state = DrawState { depth_func, ..suite.state };
            let suite = if depth_func & 4 != 0 { &half } else { &suite };
            traces.push(capture(machine, unit, suite, state, stalls));
        }
    }
    let masked = DrawState { depth_write: false, ..suite.state };
    traces.push(capture(machine, unit, &suite, masked, StallKind::Mixed));
    if machine.blend.is_there() && unit == common::DEPTH {
        let unwritten = DrawState { color_write: false, ..DrawState::default() };
        traces.push(capture(machine, unit, &suite, unwritten, StallKind::Mixed));
    }
    match unit.name() {
        "shadow" => {
            for name in ["light", "light_off"] {
                let suite = Suite::named(machine, name, 1, 24).expect("listed");
                traces.push(capture(machine, unit, &suite, suite.state, suite.stalls));
            }
            let any = [StallKind::Mixed, StallKind::None, StallKind::Late].into_iter().zip(1..);
            let any: Vec<_> =
                any.map(|(stalls, seed)| any_fragments(machine, &traces[1], stalls, seed)).collect();
            traces.extend(any);
        }
        "dither" => {
            let suite = Suite::named(machine, "dither", 1, 24).expect("listed");
            traces.truncate(2);
            for stalls in StallKind::ALL {
                traces.push(capture(machine, unit, &suite, suite.state, stalls));
            }
            let any = StallKind::ALL.into_iter().zip(1..);
            let any: Vec<_> =
                any.map(|(stalls, seed)| any_fragments(machine, &traces[2], stalls, seed)).collect();
            traces.extend(any);
        }
        "term" | "texel" | "bump" | "normal" | "lamp" | "shade" | "project" => {
            let own = if unit == common::PROJECT { "light" } else { "shade" };
            let suite = Suite::named(machine, own, 1, 24).expect("listed");
            // The directed words once, the rest at random: whole suites under every stall take long.
            traces.truncate(1);
            for stalls in [StallKind::Mixed, StallKind::Late] {
                traces.push(capture(machine, unit, &suite, suite.state, stalls));
            }
            let any = StallKind::ALL.into_iter().zip(1..);
            let any: Vec<_> = any
                .map(|(stalls, seed)| shaded::any_tokens(machine, &traces[0], 0.05, stalls, seed))
                .collect();
            traces.extend(any);
            // First, as they are few, tokens of one material, so that a reset finds fragments inside.
            traces.insert(0, shaded::any_tokens(machine, &traces[0], 0.0, StallKind::None, 7));
        }
        "setup" => {
            let far = setup::far(machine);
            let steep = setup::steep(machine);
            let cut = [(&far, 8), (&far, 60), (&steep, 5)].map(|(of, each)| setup::cut_often(of, each));
            traces
                .extend([setup::specks(machine), far, setup::halves(machine), steep].into_iter().chain(cut));
        }
        "poly" => {
            // A line before and behind polygons: what is held of one must not be the other's.
            let lines = machine.polygon.has_lines().then_some("lines");
            let names = ["polygon", "polygon_corners"].into_iter().chain(lines).chain(["polygon"]);
            let suites = names.map(|name| Suite::named(machine, name, 1, 24).expect("listed"));
            let suite = Suite::joined("polygons", "every shape and corner", suites);
            traces.truncate(1);
            for stalls in StallKind::ALL {
                traces.push(capture(machine, unit, &suite, suite.state, stalls));
            }
            let cut = [11, 17, 23, 41, 97, 230].map(|each| setup::cut_often(&traces[1], each));
            traces.extend(cut);
            // A line behind edges is walked as a thin polygon of several edges: each way in which MOVER may keep it waiting.
            for seed in 1..=4 {
                let corners = Suite::named(machine, "polygon_corners", seed, 24).expect("listed");
                traces.push(capture(machine, unit, &corners, corners.state, StallKind::Mixed));
            }
        }
        "pixel" => {
            traces
                .extend((1..=2).map(|seed| others_increments(machine, &traces[1], seed)).collect::<Vec<_>>());
        }
        "span" => traces.extend((1..=4).map(|seed| any_lines(machine, &traces[1], seed)).collect::<Vec<_>>()),
        "blend" => {
            let kinds = [(false, StallKind::Mixed), (true, StallKind::Mixed), (false, StallKind::None)];
            let any = kinds
                .into_iter()
                .zip(1..)
                .map(|((add, stalls), seed)| any_passes(machine, &traces[1], add, stalls, seed));
            let any: Vec<_> = any.collect();
            traces.extend(any);
        }
        _ => {}
    }
    traces
}
/// As many spans, half of them fresh, and with each the increments of another: EDGE may have the next triangle while spans of the
/// one before are queued.
fn others_increments(machine: &Plan, of: &Trace, seed: u64) -> Trace {
    let span = &of.interface.links[0];
    let fresh = span.place("fresh").expect("a span has it");
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tokens = of.setting.tokens.clone();
    for token in &mut tokens {
        token[fresh] = u128::from(random.random::<bool>());
        for place in span.own..span.fields.len() {
            token[place] = random.random::<u128>() & (u128::MAX >> (128 - span.fields[place].width()));
        }
    }
    capture_tokens(machine, of.interface.unit, tokens, DrawState::default(), StallKind::Mixed, seed)
}

/// As many lines, with flags that no EDGE gives, half of them somewhere around the screen: many are empty.
fn any_lines(machine: &Plan, of: &Trace, seed: u64) -> Trace {
    let line = &of.interface.links[0];
    let place = |field| line.place(field).expect("a line has it");
    let flags = ["fresh", "fence"].map(place);
    let ends = ["cmaj", "cmin"].map(place);
    let column_mask = (1u128 << machine.widths().column) - 1;
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tokens = of.setting.tokens.clone();
    for token in &mut tokens {
        flags.iter().for_each(|flag| token[*flag] = u128::from(random.random::<bool>()));
        if random.random() {
            let column = random.random_range(-4..machine.width as i128 + 4);
            let length = random.random_range(-2..4);
            token[ends[0]] = column as u128 & column_mask;
            token[ends[1]] = (column + length) as u128 & column_mask;
        }
    }
    // A line without flags comes first: what a reset left would be seen.
    flags.iter().for_each(|flag| tokens[0][*flag] = 0);
    capture_tokens(machine, of.interface.unit, tokens, DrawState::default(), StallKind::Mixed, seed)
}

/// As many fragments around the map, as no PIXEL gives them.
fn any_fragments(machine: &Plan, of: &Trace, stalls: StallKind, seed: u64) -> Trace {
    let frag = &of.interface.links[0];
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tokens = of.setting.tokens.clone();
    for token in &mut tokens {
        for (field, port) in frag.fields.iter().enumerate() {
            let number = match port.field.name.as_str() {
                "lx" | "ly" => random.random_range(-2..=i64::from(machine.shadow.size) + 1),
                "lz" => random.random_range(-2..=(1 << machine.shadow.depth_bits) + 1),
                _ => random.random_range(0..1 << port.width().min(32)),
            };
            token[field] = number as u128 & (u128::MAX >> (128 - port.width()));
        }
    }
    let ambient = random.random_range(1..=machine.color.max());
    let state = DrawState { shadow_on: true, ambient, ..DrawState::default() };
    capture_tokens(machine, of.interface.unit, tokens, state, stalls, seed)
}

/// As many fragments on three pixels, each in four with a k_t of 0, or of 1 and more, and fences as no DEPTH gives them.
fn any_passes(machine: &Plan, of: &Trace, blend_add: bool, stalls: StallKind, seed: u64) -> Trace {
    let pass = &of.interface.links[0];
    let place = |field| pass.place(field).expect("a fragment has it");
    let [addr, kt, fence] = ["addr", "kt", "fence"].map(place);
    let one = 1u128 << machine.blend.kt_bits;
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut tokens = of.setting.tokens.clone();
    for token in &mut tokens {
        token[addr] = random.random_range(0..3);
        token[fence] = random.random_range(0..2);
        token[kt] = match random.random_range(0..4) {
            0 => 0,
            1 => one + random.random_range(0..one),
            _ => random.random_range(0..one),
        };
        for color in ["r", "g", "b"] {
            token[place(color)] = random.random_range(0..1 << machine.color.bits);
        }
    }
    let state = DrawState { blend_add, ..DrawState::default() };
    capture_tokens(machine, of.interface.unit, tokens, state, stalls, seed)
}
