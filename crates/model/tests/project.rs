//! PROJECT: hand-worked values, the unit against long division in integers wider than its own, and its clocks.

use crate::common;
use crate::common::machine;
use edgewalk_machine::Plan;
use edgewalk_model::project::Project;
use edgewalk_model::tokens::{Fragment, MAX_CHANNELS, output};
use edgewalk_model::{Activity, DrawState, Events, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

pub const C: usize = MAX_CHANNELS;

pub fn with(settings: &[(&str, &str)]) -> Plan {
    machine(&[&[("shadow.light", "perspective")], settings].concat())
}

/// Two's complement in so many bits.
fn cut(value: i64, bits: u32) -> u32 {
    (value & ((1 << bits) - 1)) as u32
}

/// A fragment with these x, y, z, w.
fn fragment(plan: &Plan, place: [i64; 4], addr: u32) -> Fragment<C> {
    let mut values = [0, 1, 2, 3, 0, 0, 0, 0];
    for (value, place) in values[4..].iter_mut().zip(place) {
        *value = cut(place, plan.shadow.light_bits + 1);
    }
    Fragment { addr, values, ..Fragment::default() }
}

/// Texel and depth that a fragment was given.
pub fn quotients(plan: &Plan, fragment: &Fragment<C>) -> [i64; 3] {
    let bits = [plan.shadow.texel_bits(), plan.shadow.texel_bits(), plan.shadow.distance_bits()];
    std::array::from_fn(|i| {
        let (word, sign) = (i64::from(fragment.values[4 + i]), 1i64 << (bits[i] - 1));
        assert!(word < 2 * sign, "no bits beyond the field's");
        (word ^ sign) - sign
    })
}

/// Feeds the unit a fragment a clock, `willing` says when what it gives is taken; what it gave, with the clock of each taking
/// and giving.
fn feed(
    plan: &Plan,
    fragments: &[Fragment<C>],
    mut willing: impl FnMut() -> bool,
) -> (Vec<(Fragment<C>, [u64; 2])>, Events) {
    let mut unit = Project::new(plan);
    let (mut events, mut given, mut taken, mut now) = (Events::default(), Vec::new(), Vec::new(), 0);
    while given.len() < fragments.len() {
        let frag = fragments.get(taken.len());
        let ready = willing();
        if let Some(projected) = unit.projected().filter(|_| ready) {
            given.push((*projected, [taken[given.len()], now]));
        }
        let fires = frag.is_some() && unit.frag_ready(ready);
        unit.step(frag, ready, &mut events);
        if fires {
            taken.push(now);
        }
        now += 1;
        assert!(now < 10_000 * (fragments.len() as u64 + 10), "PROJECT does not come to rest");
    }
    assert!(!unit.occupied());
    (given, events)
}

/// By hand, with a map of 8 texels and 16 depths.
#[test]
fn hand_worked_quotients() {
    let cases = [
        // Half of the way in x, a quarter in y, z 3/8 of 16.
        ([8, 4, 6, 16], [4, 2, 6]),
        // 8·5/7 = 5.71, 8·6/7 = 6.86, 16·3/7 + 1/2 = 7.36.
        ([5, 6, 3, 7], [5, 6, 7]),
        // Exactly on the edge of texel 3; 16·5/32 + 1/2 = 3 exactly: half goes up.
        ([12, 0, 5, 32], [3, 0, 3]),
        // The last texel; 16·15/16 = 15; 16·31/32 + 1/2 = 16: rounded to the end of the map.
        ([15, 15, 15, 16], [7, 7, 15]),
        ([31, 1, 31, 32], [7, 0, 16]),
        // x = w is outside, and so is below 0; y is found all the same.
        ([16, 8, 1, 16], [-1, 4, 1]),
        ([-1, 8, 0, 16], [-1, 4, 0]),
        ([8, -1, 0, 16], [4, -1, 0]),
        // Before and behind.
        ([1, 1, -1, 16], [0, 0, -1]),
        ([1, 1, 16, 16], [0, 0, 16]),
        ([1, 1, 40, 16], [0, 0, 16]),
        // Behind the light, or beside it: nothing is divided, whatever the signs are.
        ([4, 4, 4, 0], [-1, -1, -1]),
        ([-4, -4, -4, -8], [-1, -1, -1]),
        ([4, 4, 40, -8], [-1, -1, -1]),
        // The smallest weight, and the widest numbers.
        ([0, 0, 0, 1], [0, 0, 0]),
        ([63, 62, 62, 63], [-1, 7, 16]),
        ([-64, 63, -64, 63], [-1, -1, -1]),
    ];
    for project in ["pipelined", "serial"] {
        let plan = with(&[
            ("shadow.size", "8"),
            ("shadow.depth_bits", "4"),
            ("shadow.light_bits", "6"),
            ("shadow.project", project),
        ]);
        let fragments: Vec<_> = cases.iter().map(|(place, _)| fragment(&plan, *place, 7)).collect();
        let (given, events) = feed(&plan, &fragments, || true);
        for ((given, _), (place, wanted)) in given.iter().zip(&cases) {
            assert_eq!(quotients(&plan, given), *wanted, "{place:?}");
            assert_eq!((given.addr, &given.values[..4], given.values[7]), (7, &[0, 1, 2, 3][..], 0));
        }
        assert_eq!(given.len(), cases.len());
        let met = [events.project.behind_light, events.project.map_edge, events.project.depth_to_end];
        assert_eq!(met, [3, 3, 2], "w <= 0; x or y = w; 31/32 and 62/63");
    }
}

/// floor(2^n·a/b), a bit a step, by what is left of it: 0 <= a < b.
fn long_division(a: i128, b: i128, n: u32) -> i128 {
    let (mut rest, mut quotient) = (a, 0);
    for _ in 0..n {
        rest *= 2;
        quotient = 2 * quotient + i128::from(rest >= b);
        rest -= if rest >= b { b } else { 0 };
    }
    quotient
}

/// Random formats and words, with a liking for edges; pipelined and serial, taken at any pace.
#[test]
fn every_quotient_is_that_of_long_division() {
    let mut rng = StdRng::seed_from_u64(1);
    let (mut all, mut checked, mut inside) = (Events::default(), 0, 0);
    for run in 0..600 {
        let bz = rng.random_range(4..=24u32);
        let size = 2f64.powf(rng.random_range(0.0..=12.0)) as u32;
        let side = size.next_power_of_two().ilog2().max(1);
        let p = rng.random_range(bz.max(side)..=28);
        let plan = with(&[
            ("shadow.size", &size.to_string()),
            ("shadow.depth_bits", &bz.to_string()),
            ("shadow.light_bits", &p.to_string()),
            ("shadow.project", ["pipelined", "serial"][run % 2]),
        ]);
        let most = (1i64 << p) - 1;
        let places: Vec<[i64; 4]> = (0..200)
            .map(|_| {
                let w = match rng.random_range(0..8) {
                    0 => rng.random_range(-most - 1..=0),
                    1 => rng.random_range(1..=3),
                    2 => most,
                    _ => rng.random_range(1..=most),
                };
                let mut value = |quotient: i64| match rng.random_range(0..8) {
                    0 => w,
                    1 => w - 1,
                    2 => -1,
                    // On the edge of a texel, or as near as there is a number.
                    3 => {
                        ((i128::from(rng.random_range(0..quotient)) * i128::from(w)) / i128::from(quotient))
                            as i64
                    }
                    4 => rng.random_range(-most - 1..=most),
                    _ => rng.random_range(0..=w.max(0)),
                };
                [value(1 << side), value(1 << side), value(2 << bz), w]
            })
            .collect();
        let fragments: Vec<_> = places.iter().zip(0..).map(|(place, i)| fragment(&plan, *place, i)).collect();
        let pace = rng.random_range(0.2..=1.0);
        let mut draw = StdRng::seed_from_u64(run as u64);
        let (given, events) = feed(&plan, &fragments, || draw.random_bool(pace));
        for (((given, _), [x, y, z, w]), i) in given.iter().zip(&places).zip(0..) {
            let [x, y, z, w] = [x, y, z, w].map(|value| i128::from(*value));
            let texel = |x: i128| if w > 0 && (0..w).contains(&x) { long_division(x, w, side) } else { -1 };
            let depth = if w <= 0 || z < 0 {
                -1
            } else if z >= w {
                1 << bz
            } else {
                (long_division(z, w, bz + 1) + 1) / 2
            };
            let wanted = [texel(x), texel(y), depth];
            assert_eq!(quotients(&plan, given).map(i128::from), wanted, "{x} {y} {z} / {w}, {plan:?}");
            assert_eq!(given.addr, i, "in their order");
            checked += 1;
            inside += u32::from(wanted[0] >= 0 && wanted[1] >= 0);
        }
        all.merge(&events);
    }
    println!("{checked} fragments, {inside} of them on the map");
    assert!(checked == 120_000 && inside > 30_000);
    let met = all.counts();
    for event in edgewalk_machine::units::project::SPEC.events {
        let count = met.iter().find(|(name, _)| *name == event.name).map(|(_, count)| *count);
        assert!(count > Some(0), "never met: {}", event.name);
    }
}

/// R + 1 clocks on the way, one a clock or one in R + 1; what waits at the end keeps all others waiting.
#[test]
fn clocks_are_those_of_the_specification() {
    for (size, bz, rows) in [("512", "16", 17), ("2", "4", 5), ("4096", "8", 12), ("4096", "24", 25)] {
        for (project, apart) in [("pipelined", 1), ("serial", rows + 1)] {
            let plan = with(&[
                ("shadow.size", size),
                ("shadow.depth_bits", bz),
                ("shadow.light_bits", "24"),
                ("shadow.project", project),
            ]);
            assert_eq!(plan.shadow.rows(), rows as u32);
            let fragments: Vec<_> = (0..50).map(|i| fragment(&plan, [1, 2, 3, 7], i)).collect();
            let (given, _) = feed(&plan, &fragments, || true);
            for (i, (_, [taken, offered])) in given.iter().enumerate() {
                assert_eq!((*taken, *offered), (i as u64 * apart, i as u64 * apart + rows + 1), "{project}");
            }
            // Taken only from clock 1000 on: by then the stages are full, and all stand still.
            let mut now = 0;
            let (given, _) = feed(&plan, &fragments, || {
                now += 1;
                now > 1000
            });
            let before = given.iter().filter(|(_, [taken, _])| *taken < 999).count() as u64;
            assert_eq!(before, if project == "serial" { 1 } else { rows + 1 }.min(50), "{project}");
        }
    }
}

/// What a reset leaves: nothing.
#[test]
fn a_reset_empties_it() {
    for project in ["pipelined", "serial"] {
        let plan = with(&[("shadow.project", project)]);
        let (mut unit, mut events) = (Project::<C>::new(&plan), Events::default());
        for _ in 0..30 {
            unit.step(Some(&fragment(&plan, [1, 1, 1, 2], 0)), false, &mut events);
        }
        assert!(unit.occupied() && unit.projected().is_some() && !unit.frag_ready(false));
        unit.reset();
        assert!(!unit.occupied() && unit.projected().is_none() && unit.frag_ready(false) && !unit.dividing());
    }
}

/// A serial PROJECT keeps PIXEL waiting, which is a cause of its own; a pipelined one never does.
#[test]
fn cycles_of_division_have_their_cause() {
    let mut rng = StdRng::seed_from_u64(4);
    let mut cycles = Vec::new();
    for project in ["pipelined", "serial"] {
        let plan = with(&[("screen.width", "32"), ("screen.height", "24"), ("shadow.project", project)]);
        let triangles: Vec<_> = (0..10).map(|_| common::random_triangle(&plan, 20.0, &mut rng)).collect();
        let drawn = common::render(&plan, &triangles, DrawState::default(), Stalls::NONE);
        assert!(drawn.counters.add_up());
        cycles.push(drawn.counters.activity[Activity::Project as usize]);
    }
    assert!(cycles[0] == 0 && cycles[1] > 1000, "{cycles:?}");
}

/// A channel is read as its kind says.
#[test]
fn light_space_values_are_signed_and_rounded() {
    let plan = with(&[]);
    let names: Vec<&str> = plan.channels()[4..].iter().map(|channel| channel.name).collect();
    assert_eq!(names, ["lx", "ly", "lz", "lw"]);
    assert!(plan.channels()[4..].iter().all(|c| c.kind.is_signed() && c.kind.is_rounded() && c.bits == 21));
    assert_eq!(output(&plan.channels()[7], cut(-3, 21)), -3);
}
