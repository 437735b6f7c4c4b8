//! PROJECT and SHADOW under perspective lights: every decision of fragments beside exact quotients.

use crate::common;
use crate::project::{C, quotients, with};
use edgewalk_machine::Plan;
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{DrawState, Rig, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

/// x, y, z, w of a vertex of a triangle under a light that looks in perspective, anywhere in its view or beside it.
struct Seen {
    at: [f64; 2],
    texel: [f64; 2],
    depth: f64,
    weight: f64,
}

/// The vertices at the port, their light-space values times the largest power of two that they have room for.
fn port(plan: &Plan, seen: [Seen; 3]) -> common::Triangle {
    let (side, far) = (f64::from(1u32 << plan.shadow.side_bits()), f64::from(1u32 << plan.shadow.depth_bits));
    let light = seen.each_ref().map(|v| {
        [v.texel[0] / side, v.texel[1] / side, v.depth / far, 1.0].map(|quotient| quotient * v.weight)
    });
    let largest = light.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
    let scale = 2f64.powi((((1u64 << plan.shadow.light_bits) - 1) as f64 / largest).log2().floor() as i32);
    std::array::from_fn(|i| {
        let [x, y, z, w] = light[i].map(|value| value * scale);
        plan.port_vertex(seen[i].at[0], seen[i].at[1], &[0.5, 0.5, 0.5, 0.5, x, y, z, w]).expect("in range")
    })
}

/// Fragments read, in order, with this map.
fn fragments(plan: &Plan, triangles: &[common::Triangle], map: Option<&[u32]>) -> Vec<Fragment<C>> {
    let state = DrawState { shadow_on: map.is_some(), ..common::ALWAYS };
    let mut rig = Rig::<C>::new(plan, state, Stalls::NONE);
    rig.memories.write("map", 0, map.unwrap_or_default().iter().map(|word| u128::from(*word)));
    common::fragments_read(&mut rig, triangles)
}

/// Of a fragment: the exact values as numerators over one denominator, and how far a value may be off before and behind its
/// rounding, as a fraction of an LSB.
struct Exact {
    values: [i128; 4],
    one: i128,
    off: f64,
}

impl Exact {
    fn of(plan: &Plan, triangle: &common::Triangle, f: &Fragment<C>) -> Exact {
        let (x, y) = common::place(plan, f.addr);
        let exact: [(i128, i128); 4] =
            std::array::from_fn(|i| common::rule::exact_value(plan, triangle, 4 + i, x, y));
        assert!(exact.iter().all(|(_, d)| *d == exact[0].1), "formats are the same");
        let steps = common::rule::steps(plan, triangle, x, y);
        let off = f64::from(1 + steps.total() as u32) / f64::from(2u32 << plan.shadow.fraction) + 0.5;
        Exact { values: exact.map(|(n, _)| n), one: exact[0].1, off }
    }

    /// The least that the weight at the output may be, LSB; nothing is said of a fragment for which that is not above 0.
    fn weight(&self) -> f64 {
        self.values[3] as f64 / self.one as f64 - self.off
    }

    /// How far 2^bits·value/weight lies from this whole or half number, which is `twice`/2, and how far it may be off.
    fn from(&self, i: usize, bits: u32, twice: i128) -> [f64; 2] {
        let (value, w) = (self.values[i], self.values[3]);
        let away = (twice * w - (value << (bits + 1))).abs() as f64 / (2.0 * w as f64);
        let quotient = (value.abs() << bits) as f64 / w as f64;
        [away, (2f64.powi(bits as i32) + quotient) * self.off / self.weight()]
    }
}

/// Every decision of a million fragments beside the exact quotients of the planes through the vertices at the port.
#[test]
fn every_decision_of_a_perspective_light_is_explained() {
    let mut rng = StdRng::seed_from_u64(5);
    let (mut checked, mut looked_up, mut open, mut behind) = (0u64, 0u64, 0u64, 0u64);
    let (mut texels, mut decisions, mut reached) = (0u64, 0u64, [0.0f64; 2]);
    let formats = [("20", "14", "512"), ("16", "14", "300"), ("20", "11", "512"), ("24", "18", "1024")];
    for (p, fraction, size) in formats.into_iter().cycle() {
        if checked >= 1_000_000 {
            break;
        }
        let plan = with(&[
            ("screen.width", "160"),
            ("screen.height", "120"),
            ("shadow.light_bits", p),
            ("shadow.light_fraction", fraction),
            ("shadow.size", size),
        ]);
        let (side, bz) = (plan.shadow.side_bits(), plan.shadow.depth_bits);
        let (size, far) = (i64::from(plan.shadow.size), f64::from(1u32 << bz));
        let triangles: Vec<common::Triangle> = (0..60)
            .map(|_| {
                let reach = 2f64.powf(rng.random_range(2.0..7.0));
                let at = [rng.random_range(0.0..160.0), rng.random_range(0.0..120.0)];
                let texel = [0, 1].map(|_| rng.random_range(-0.1..1.1) * size as f64);
                let depth = rng.random_range(-0.1..1.1) * far;
                // How much nearer to the light one vertex is than another; now and then one lies behind it.
                let depth_of_field = 2f64.powf(rng.random_range(0.0..4.0));
                let sign = if rng.random_bool(0.1) { -1.0 } else { 1.0 };
                port(
                    &plan,
                    std::array::from_fn(|i| {
                        let mut near = |from: f64, by: f64| from + rng.random_range(-0.5..0.5) * by;
                        Seen {
                            at: [near(at[0], reach), near(at[1], reach)],
                            texel: [near(texel[0], 3.0 * reach), near(texel[1], 3.0 * reach)],
                            depth: near(depth, 0.05 * far),
                            weight: near(1.0, 1.0) * depth_of_field * if i == 0 { sign } else { 1.0 },
                        }
                    }),
                )
            })
            .collect();
        let place = |f: &Fragment<C>| {
            let [x, y, _] = quotients(&plan, f);
            let inside = (0..size).contains(&x) && (0..size).contains(&y);
            inside.then(|| (y << side | x) as usize)
        };
        let exact = |f: &Fragment<C>| Exact::of(&plan, &triangles[f.source.id as usize], f);
        // Texels hold depths within an LSB of a fragment's own, so that comparisons are hard.
        let mut map = vec![0; 1 << (2 * side)];
        for f in fragments(&plan, &triangles, None) {
            if let Some(place) = place(&f) {
                let e = exact(&f);
                let depth = (e.values[2] as f64 / e.values[3] as f64 * far).round();
                map[place] = (depth + f64::from(rng.random_range(-1..=1))).clamp(0.0, far - 1.0) as u32;
            }
        }
        for f in fragments(&plan, &triangles, Some(&map)) {
            checked += 1;
            let e = exact(&f);
            if e.weight() <= 0.0 {
                // Behind the light, or so near to its plane that nothing is proved.
                assert!(f.lit || e.values[3] > 0 || e.weight() + 2.0 * e.off > 0.0, "behind the light");
                behind += 1;
                continue;
            }
            let found = quotients(&plan, &f);
            for i in [0, 1] {
                let (n, w) = (e.values[i] << side, e.values[3]);
                let on_map = |texel: i128| (0..1i128 << side).contains(&texel).then_some(texel);
                let (wanted, got) = (on_map(n.div_euclid(w)), on_map(found[i].into()));
                if wanted == got {
                    continue;
                }
                // The edge between the two.
                let edge = match (wanted, got) {
                    (Some(wanted), Some(got)) => wanted.max(got),
                    (Some(one), None) | (None, Some(one)) => {
                        if one == 0 {
                            0
                        } else {
                            one + 1
                        }
                    }
                    (None, None) => continue,
                };
                let [away, may] = e.from(i, side, 2 * edge);
                if let (Some(wanted), Some(got)) = (wanted, got) {
                    assert!((wanted - got).abs() == 1 || may >= 1.0, "texel {got} for {n}/{w}");
                }
                assert!(away <= may, "texel {got:?} for {n}/{w}, {away} of {may}");
                reached[0] = reached[0].max(away / may);
                texels += 1;
            }
            let Some(place) = place(&f) else {
                assert!(f.lit, "outside the map");
                continue;
            };
            looked_up += 1;
            let m = i128::from(map[place]);
            let [away, may] = e.from(2, bz, 2 * m + 1);
            let (z, w) = (e.values[2] << (bz + 1), e.values[3]);
            if f.lit != (z < (2 * m + 1) * w) {
                assert!(away <= may, "lit {} for {z}/{w} against {m}", f.lit);
                reached[1] = reached[1].max(away / may);
                decisions += 1;
            }
            open += u64::from(may >= 0.5);
            assert!(f.lit || z > 2 * m * w || may >= 0.5, "false shadow: {z}/{w} against {m}");
        }
    }
    println!(
        "{checked} fragments, {looked_up} looked up, {behind} behind the light or in its plane, {open} with an error of half an LSB or more: \
         {texels} texels and {decisions} decisions differ, all explained, {:.3} and {:.3} of the bounds reached; no false shadow",
        reached[0], reached[1]
    );
    assert!(looked_up > 500_000 && texels > 100 && decisions > 1000 && behind > 500 && open < looked_up / 2);
    assert!(reached[0] > 0.2 && reached[1] > 0.4 && reached.iter().all(|share| *share <= 1.0));
}
