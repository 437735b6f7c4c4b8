//! SHADOW: the unit against the rule in plain numbers, the machine with it against itself without, and its rate.

use crate::common;
use crate::common::{machine, random_machine, random_triangle};
use edgewalk_machine::{Gate, Plan, Transmits};
use edgewalk_model::shadow::Shadow;
use edgewalk_model::tokens::{Fragment, MAX_CHANNELS};
use edgewalk_model::{DrawState, Events, Rig, ShadowInputs, Stalls, WordMemory};
use rand::{Rng, SeedableRng, rngs::StdRng};

const C: usize = MAX_CHANNELS;

const STALLS: [Stalls; 3] = [
    Stalls::NONE,
    Stalls { seed: 1, rd: 60, data: 60, wr: 60 },
    Stalls { seed: 2, rd: 10, data: 200, wr: 200 },
];

/// A machine with a map and no channels of the user's own.
fn with(settings: &[(&str, String)]) -> Plan {
    let all = [("shadow.light", "parallel")].into_iter();
    let all: Vec<(&str, &str)> =
        all.chain(settings.iter().map(|(key, value)| (*key, value.as_str()))).collect();
    machine(&all)
}

/// Two's complement in so many bits.
fn bits(value: i64, bits: u32) -> u32 {
    (value & ((1 << bits) - 1)) as u32
}

/// A fragment of this colour there: texel x, y and depth from the light.
fn fragment(plan: &Plan, [r, g, b]: [u32; 3], place: [i64; 3]) -> Fragment<C> {
    let mut values = [0, r, g, b, 0, 0, 0, 0];
    for (value, (channel, place)) in values[4..].iter_mut().zip(plan.channels()[4..7].iter().zip(place)) {
        *value = bits(place, channel.bits);
    }
    Fragment { values, ..Fragment::default() }
}

/// What is left of a colour where the light comes, by the rule; none in shadow.
fn left(plan: &Plan, map: &[u32], on: bool, [x, y, d]: [i64; 3]) -> Option<u32> {
    let (size, all) = (i64::from(plan.shadow.size), plan.color.max() as u32);
    if !on || x < 0 || y < 0 || x >= size || y >= size || d < 0 {
        return Some(all);
    }
    if d >= 1 << plan.shadow.depth_bits {
        return None;
    }
    let word = map[(y << plan.shadow.side_bits() | x) as usize];
    let transmits = plan.shadow.transmits == Transmits::Yes;
    let (depth, left) = if transmits { (word / (all + 1), word % (all + 1)) } else { (word, all) };
    (d <= i64::from(depth)).then_some(left)
}

/// The nearest to c·share/(2^b - 1), half up.
fn scaled(plan: &Plan, color: u32, share: u32) -> u32 {
    let max = plan.color.max();
    ((2 * u64::from(color) * u64::from(share) + max) / (2 * max)) as u32
}

/// What is left in shadow.
fn dark(plan: &Plan, ambient: u32) -> u32 {
    if plan.shadow.gate == Gate::And { 0 } else { ambient }
}

/// The memory of the light's map, as nothing has written it.
fn map_memory(plan: &Plan, stalls: Stalls) -> WordMemory {
    let memories = plan.word_memories();
    let (_, port) = memories.iter().find(|(unit, _)| *unit == "shadow").expect("it has SHADOW");
    WordMemory::new(port, stalls)
}

/// Texels of a map.
fn texels(plan: &Plan) -> usize {
    1 << (2 * plan.shadow.side_bits())
}

/// A map that counts or not, and what is left in shadow.
fn lit_by(on: bool, ambient: u32) -> ShadowInputs {
    ShadowInputs { on, ambient, ..ShadowInputs::default() }
}

/// Feeds SHADOW and the map with a fragment a clock, DEPTH taking as `willing` says, under the inputs asked for; gives what it was given, events, cycles.
fn feed(
    plan: &Plan,
    fragments: &[Fragment<C>],
    asked: ShadowInputs,
    memory: &mut WordMemory,
    mut willing: impl FnMut() -> bool,
) -> (Vec<Fragment<C>>, Events, u64) {
    let mut unit = Shadow::new(plan);
    let (mut events, mut given, mut next, mut cycles) = (Events::default(), Vec::new(), 0, 0);
    while next < fragments.len() || unit.occupied() {
        let frag = fragments.get(next);
        let map = memory.port();
        let read = unit.read(frag, &asked).filter(|_| map.ready);
        let fires = frag.is_some() && unit.frag_ready(frag, &asked, &map);
        let ready = willing();
        let mut made = Fragment::default();
        let shaded = (unit.shaded(&asked, &map, &mut made) && ready).then_some(made);
        let taken = map.word.is_some() && unit.mdata_ready(ready);
        unit.step(frag, &asked, &map, shaded.is_some(), &mut events);
        memory.step(read, taken);
        next += usize::from(fires);
        given.extend(shaded);
        cycles += 1;
        assert!(cycles < 1000 * (fragments.len() as u64 + 10), "SHADOW does not come to rest");
    }
    (given, events, cycles)
}

/// Every kind of place on purpose: the map's corners, one texel outside on each side, as far from it as the word goes, before
/// and behind it, ties and one beside.
#[test]
fn every_decision_is_the_rules() {
    let mut rng = StdRng::seed_from_u64(1);
    let (mut all, mut checked, mut shadow, mut dim) = (Events::default(), 0, 0, 0);
    for run in 0..3000 {
        let pick = |rng: &mut StdRng, list: &[u32]| list[rng.random_range(0..list.len())].to_string();
        let transmits = run % 4 < 2;
        // The light's own pass: nothing is looked up, whatever the place and shadow_on.
        let light_pass = run % 8 == 6;
        let plan = with(&[
            ("shadow.size", pick(&mut rng, &[1, 2, 3, 5, 8, 13])),
            ("shadow.guard_bits", pick(&mut rng, &[0, 1, 3])),
            ("shadow.depth_bits", pick(&mut rng, if transmits { &[4, 8, 16] } else { &[4, 8, 24] })),
            ("shadow.gate", ["and", "scale"][run % 2].to_owned()),
            ("shadow.transmits", if transmits { "yes" } else { "no" }.to_owned()),
            ("shadow.own_pass", if light_pass { "yes" } else { "no" }.to_owned()),
            ("formats.color_bits", pick(&mut rng, &[2, 5, 8, 12, 16])),
            ("fifo.shadow", pick(&mut rng, &[1, 2, 3, 4, 16])),
            ("memory.map_latency", pick(&mut rng, &[1, 2, 3, 8])),
        ]);
        let (on, ambient) = (rng.random_bool(0.9), rng.random_range(0..=plan.color.max() as u32));
        let mut memory = map_memory(&plan, STALLS[run % 3]);
        let depths = 1u32 << plan.shadow.depth_bits;
        let mut some = |range: u32| match rng.random_range(0..4) {
            0 => 0,
            1 => range - 1,
            _ => rng.random_range(0..range),
        };
        let shares = if transmits { plan.color.max() as u32 + 1 } else { 1 };
        let map: Vec<u32> = (0..texels(&plan)).map(|_| some(depths) * shares + some(shares)).collect();
        memory.write(0, map.iter().map(|word| u128::from(*word)));
        let (size, texel, depth) =
            (i64::from(plan.shadow.size), plan.channels()[4].bits, plan.channels()[6].bits);
        let places: Vec<[i64; 3]> = (0..60)
            .map(|_| {
                let mut at = || match rng.random_range(0..16) {
                    0 => -1,
                    1 => size,
                    2 => -(1 << (texel - 1)),
                    3 => (1 << (texel - 1)) - 1,
                    4 => size - 1,
                    _ => rng.random_range(0..size),
                };
                let [x, y] = [at(), at()];
                let inside = (0..size).contains(&x) && (0..size).contains(&y);
                let word = if inside { map[(y << plan.shadow.side_bits() | x) as usize] } else { 0 };
                let stored = word / shares;
                let d = match rng.random_range(0..9) {
                    0 => -1,
                    1 => i64::from(depths),
                    2 => -(1 << (depth - 1)),
                    3 => (1 << (depth - 1)) - 1,
                    4 => i64::from(depths) - 1,
                    5 | 6 => i64::from(stored),
                    7 => i64::from(stored) + 1,
                    _ => rng.random_range(0..i64::from(depths)),
                };
                [x, y, d]
            })
            .collect();
        let fragments: Vec<_> = places
            .iter()
            .map(|place| {
                fragment(&plan, [0; 3].map(|_| rng.random_range(0..=plan.color.max() as u32)), *place)
            })
            .collect();
        let asked_for = ShadowInputs { light_pass, ..lit_by(on, ambient) };
        let patience = rng.random_range(0.1..=1.0);
        let mut draw = StdRng::seed_from_u64(run as u64);
        let (given, events, _) =
            feed(&plan, &fragments, asked_for, &mut memory, || draw.random_bool(patience));
        assert_eq!(given.len(), fragments.len());
        for ((given, asked), place) in given.iter().zip(&fragments).zip(places) {
            let left = left(&plan, &map, on && !light_pass, place);
            let share = left.unwrap_or_else(|| dark(&plan, ambient));
            let wanted = [1, 2, 3].map(|i| scaled(&plan, asked.values[i], share));
            let found = (given.lit, &given.values[1..4]);
            assert_eq!(found, (left.is_some(), &wanted[..]), "{place:?}, on {on}: {plan:?}");
            checked += 1;
            dim += i32::from(left.is_some_and(|left| left < plan.color.max() as u32));
            shadow += i32::from(left.is_none());
        }
        all.merge(&events);
    }
    println!("{checked} decisions, {shadow} in shadow, {dim} lit through glass, {:?}", all.counts());
    assert!(checked == 180_000 && shadow > 30_000 && dim > 8_000);
    let met = all.counts();
    for event in edgewalk_machine::units::shadow::SPEC.events {
        let count = met.iter().find(|(name, _)| *name == event.name).map(|(_, count)| *count);
        assert!(count > Some(0), "never met: {}", event.name);
    }
}

/// The gate `scale`, every colour and every share of 8 bits.
#[test]
fn every_share_of_8_bits_is_the_nearest() {
    let plan = with(&[("shadow.gate", "scale".to_owned())]);
    let mut memory = map_memory(&plan, Stalls::NONE);
    let mut checked = 0;
    for ambient in 0..256 {
        let fragments: Vec<_> =
            (0..256).map(|c| fragment(&plan, [c, 255 - c, c / 2], [0, 0, 1 << 16])).collect();
        let (given, ..) = feed(&plan, &fragments, lit_by(true, ambient), &mut memory, || true);
        for (given, asked) in given.iter().zip(&fragments) {
            for i in 1..4 {
                assert_eq!(given.values[i], scaled(&plan, asked.values[i], ambient));
                checked += 1;
            }
        }
    }
    assert_eq!(checked, 3 * 65_536);
}

#[test]
fn a_fragment_a_clock_where_the_queue_is_longer_than_the_latency() {
    for (latency, places, wanted) in
        [(1, 2, 1.0), (2, 3, 1.0), (2, 2, 1.5), (4, 5, 1.0), (4, 1, 5.0), (8, 16, 1.0)]
    {
        let plan = with(&[("memory.map_latency", latency.to_string()), ("fifo.shadow", places.to_string())]);
        let mut memory = map_memory(&plan, Stalls::NONE);
        let fragments: Vec<_> = (0..6000).map(|i| fragment(&plan, [9; 3], [i % 512, i / 512, 7])).collect();
        let (.., cycles) = feed(&plan, &fragments, lit_by(true, 0), &mut memory, || true);
        let clocks = cycles as f64 / 6000.0;
        assert!((clocks - wanted).abs() < 0.01, "latency {latency}, {places} places: {clocks} for {wanted}");
    }
}

/// The machine with the map off and on: the same fragments in the same order, but for the colours of those in shadow.
#[test]
fn the_map_changes_colours_and_nothing_else() {
    let mut rng = StdRng::seed_from_u64(2);
    let (mut machines, mut checked, mut shadow) = (0, 0, 0);
    while machines < 120 {
        let fixed = [
            ("screen.width", "24"),
            ("screen.height", "18"),
            ("shadow.light", "parallel"),
            ("shadow.size", "7"),
        ];
        let plan = random_machine(&fixed, &mut rng);
        machines += 1;
        let triangles: Vec<_> = (0..20).map(|_| random_triangle(&plan, 20.0, &mut rng)).collect();
        let stalls = STALLS[machines % 3];
        let mut map: Vec<u32> = Vec::new();
        let ambient = rng.random_range(0..=plan.color.max());
        let mut runs = [false, true].map(|on| {
            let state = DrawState { shadow_on: on, ambient, ..common::ALWAYS };
            let mut rig = Rig::<C>::new(&plan, state, stalls);
            if map.is_empty() {
                let most = u32::MAX >> (32 - plan.map_word_bits());
                map = (0..texels(&plan)).map(|_| rng.random_range(0..=most)).collect();
            }
            rig.memories.write("map", 0, map.iter().map(|word| u128::from(*word)));
            let seen = common::fragments_read(&mut rig, &triangles);
            assert!(rig.model.counters().add_up());
            seen
        });
        let [off, on] = &mut runs;
        assert_eq!(off.len(), on.len());
        let at = ["lx", "ly", "lz"]
            .map(|name| plan.channels().iter().position(|c| c.name == name).expect("there"));
        for (off, on) in off.iter().zip(on.iter()) {
            let place = at.map(|i| edgewalk_model::tokens::output(&plan.channels()[i], off.values[i]));
            let left = left(&plan, &map, true, place);
            let share = left.unwrap_or_else(|| dark(&plan, ambient as u32));
            let mut wanted = Fragment { lit: left.is_some(), ..*off };
            (1..4).for_each(|i| wanted.values[i] = scaled(&plan, off.values[i], share));
            assert!(off.lit);
            assert_eq!(*on, wanted, "{place:?}: {plan:?}");
            checked += 1;
            shadow += i32::from(left.is_none());
        }
    }
    println!("{machines} machines, {checked} fragments, {shadow} in shadow");
    assert!(checked > 50_000 && shadow > 500);
}

/// A fragment a read fired for, in order, and the map that lay there.
fn fragments(plan: &Plan, triangles: &[common::Triangle], map: Option<&[u32]>) -> Vec<Fragment<C>> {
    let state = DrawState { shadow_on: map.is_some(), ..common::ALWAYS };
    let mut rig = Rig::<C>::new(plan, state, Stalls::NONE);
    if let Some(map) = map {
        rig.memories.write("map", 0, map.iter().map(|word| u128::from(*word)));
    }
    common::fragments_read(&mut rig, triangles)
}

/// Every decision of a million fragments beside the exact planes through the vertices at the port: the texel is the floor of
/// the exact coordinate, or within the proved error of one; lit is what the exact depth says against the same texel, or within
/// the proved error of the boundary; and what is not farther than its texel is never in shadow. Texels hold depths within an
/// LSB of a fragment's own, so that comparisons are hard.
#[test]
fn every_decision_of_a_million_fragments_is_explained() {
    let mut rng = StdRng::seed_from_u64(3);
    let settings = [
        ("screen.width", "160".to_owned()),
        ("screen.height", "120".to_owned()),
        ("shadow.light_vertex", "4".to_owned()),
    ];
    let (mut checked, mut looked_up, mut near) = (0u64, 0u64, 0u64);
    let (mut texels, mut decisions, mut reached) = (0u64, 0u64, 0.0f64);
    for (batch, fraction) in [14, 14, 11, 18].into_iter().cycle().enumerate() {
        if checked >= 1_000_000 {
            break;
        }
        let plan = with(&[&settings[..], &[("shadow.light_fraction", fraction.to_string())]].concat());
        let far = f64::from(1u32 << plan.shadow.depth_bits);
        let triangles: Vec<common::Triangle> = (0..120)
            .map(|_| {
                let size = 2f64.powf(rng.random_range(2.0..7.0));
                let at = [rng.random_range(0.0..160.0), rng.random_range(0.0..120.0)];
                let texel = [0, 1].map(|_| rng.random_range(-50.0..560.0));
                let depth = rng.random_range(-0.1..1.1) * far;
                std::array::from_fn(|_| {
                    let mut near = |from: f64, by: f64| from + rng.random_range(-0.5..0.5) * by;
                    let (x, y) = (near(at[0], size), near(at[1], size));
                    let light =
                        [near(texel[0], 3.0 * size), near(texel[1], 3.0 * size), near(depth, 0.05 * far)];
                    plan.port_vertex(x, y, &[0.5, 0.5, 0.5, 0.5, light[0], light[1], light[2]])
                        .expect("in range")
                })
            })
            .collect();
        let at = |f: &Fragment<C>, i: usize| edgewalk_model::tokens::output(&plan.channels()[i], f.values[i]);
        let exact = |f: &Fragment<C>, i: usize| {
            let (x, y) = common::place(&plan, f.addr);
            common::rule::exact_value(&plan, &triangles[f.source.id as usize], i, x, y)
        };
        let size = i64::from(plan.shadow.size);
        let texel = |f: &Fragment<C>| {
            let (x, y) = (at(f, 4), at(f, 5));
            let inside = (0..size).contains(&x) && (0..size).contains(&y);
            inside.then(|| (y << plan.shadow.side_bits() | x) as usize)
        };
        let mut map = vec![0; 1 << (2 * plan.shadow.side_bits())];
        for f in fragments(&plan, &triangles, None) {
            if let Some(texel) = texel(&f) {
                let (n, d) = exact(&f, 6);
                let depth = (n as f64 / d as f64).round() + f64::from(rng.random_range(-1..=1));
                map[texel] = depth.clamp(0.0, far - 1.0) as u32;
            }
        }
        for f in fragments(&plan, &triangles, Some(&map)) {
            checked += 1;
            let (x, y) = common::place(&plan, f.addr);
            let steps = common::rule::steps(&plan, &triangles[f.source.id as usize], x, y);
            // (1 + N)·2^-(r+1), as a fraction.
            let (error, unit) = (1 + i128::from(steps.total()), 2i128 << fraction);
            for i in [4, 5] {
                let ((n, d), found) = (exact(&f, i), i128::from(at(&f, i)));
                let wanted = n.div_euclid(d);
                if found != wanted {
                    // The integer between the two, and how far the exact coordinate is from it.
                    let side = found.max(wanted);
                    let away = (side * d - n).abs();
                    assert!(
                        (found - wanted).abs() == 1 && away * unit <= error * d,
                        "texel {found} for {n}/{d}"
                    );
                    reached = reached.max((away * unit) as f64 / (error * d) as f64);
                    texels += 1;
                }
            }
            let Some(place) = texel(&f) else {
                assert!(f.lit, "outside the map");
                continue;
            };
            looked_up += 1;
            let ((n, d), m) = (exact(&f, 6), i128::from(map[place]));
            // Behind the map all is in shadow; else against the texel's depth and a half.
            let boundary =
                if at(&f, 6) >= 1 << plan.shadow.depth_bits { i128::from(far as i64) - 1 } else { m };
            let boundary = if at(&f, 6) < 0 { -1 } else { boundary };
            // In units of 1/(2·d): lit if 2n < (2·boundary + 1)·d; before the map the other way round.
            let less = 2 * n < (2 * boundary + 1) * d;
            let wanted = at(&f, 6) < 0 || less;
            let off = (2 * n - (2 * boundary + 1) * d).abs();
            let open = off * unit <= 2 * error * d;
            near += u64::from(open);
            if at(&f, 6) < 0 {
                assert!(f.lit && (less || open), "before the map");
            } else if f.lit != wanted {
                assert!(open, "lit {} for {n}/{d} against {m}", f.lit);
                decisions += 1;
            }
            assert!(
                f.lit || n > m * d || at(&f, 6) >= 1 << plan.shadow.depth_bits,
                "false shadow: {n}/{d} against {m}"
            );
        }
        assert!(batch < 10_000);
    }
    println!(
        "{checked} fragments, {looked_up} looked up, {near} within the error of the boundary: {texels} texels and {decisions} \
         decisions differ, all explained, {reached:.3} of the texel's error reached; no false shadow"
    );
    assert!(looked_up > 600_000 && texels > 1_000 && decisions > 50 && reached > 0.8);
}
