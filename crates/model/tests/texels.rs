//! How often a texel is another than the exact one: as often as the mean error of its coordinates says, the sum over both axes, as places lie anyhow
//! between the sides of texels. A machine that errs otherwise than its words do, within the bound, is found so.
//!
//! The words behind the texels are read off a twin without SHADOW, whose channels of the user's own have the same words, cut lower.

use crate::common;
use crate::common::{machine, rule};
use crate::project::{C, quotients};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{Rig, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

/// Mean errors and mismatches, both summed over the axes.
#[derive(Default)]
struct Found {
    fragments: u64,
    error: f64,
    texels: u64,
}

impl Found {
    fn axis(&mut self, exact: f64, found: f64, texel: i64) {
        self.error += (found - exact).abs();
        self.texels += u64::from(texel != exact.floor() as i64);
    }

    /// Share of the mismatches over the mean error.
    fn ratio(&self, name: &str) -> f64 {
        let [share, mean] = [self.texels as f64, self.error].map(|sum| sum / self.fragments as f64);
        println!(
            "{name}: {} fragments, {} texels differ, a share of {share:.5} beside a mean error of {mean:.5} over two axes",
            self.fragments, self.texels
        );
        share / mean
    }
}

/// So many channels of the user's own in place of the light's, `below` bits of whose fraction are bits of the output.
fn twin(plan: &Plan, kind: &str, count: usize, below: u32) -> Plan {
    let mut settings = vec![
        ("screen.width".to_owned(), "160".to_owned()),
        ("screen.height".to_owned(), "120".to_owned()),
        ("channels.extra".to_owned(), count.to_string()),
    ];
    for (i, channel) in plan.channels()[4..4 + count].iter().enumerate() {
        let numbers = [
            ("bits", channel.bits + below),
            ("fraction", channel.fraction - below),
            ("vertex", channel.vertex_fraction - below),
        ];
        settings.push((format!("channels.e{i}_kind"), kind.to_owned()));
        settings.extend(numbers.map(|(key, value)| (format!("channels.e{i}_{key}"), value.to_string())));
    }
    let settings: Vec<_> = settings.iter().map(|(key, value)| (&key[..], &value[..])).collect();
    machine(&settings)
}

/// What PIXEL gives of the twin, and SHADOW's texel of the machine, fragment by fragment.
fn both(
    plan: &Plan,
    twin: &Plan,
    triangles: &[common::Triangle],
    count: usize,
) -> Vec<(Fragment<C>, Vec<i64>)> {
    let moved = |vertex: &PortVertex| twin.raw_vertex(vertex.x(), vertex.y(), &vertex.values()[..4 + count]);
    let twins: Vec<common::Triangle> =
        triangles.iter().map(|triangle| triangle.each_ref().map(moved)).collect();
    let mut rig = Rig::<C>::new(plan, common::ALWAYS, Stalls::NONE);
    let seen = common::fragments_read(&mut rig, triangles);
    let mut beside = Vec::new();
    common::fragments(twin, &twins, |id, at, outputs| {
        let f: Fragment<C> = seen[beside.len()];
        assert_eq!((f.source.id as usize, common::place(plan, f.addr)), (id, at));
        beside.push((f, outputs));
    });
    assert_eq!(seen.len(), beside.len());
    beside
}

/// Triangles of every size, with texels and depths that change over them.
fn any(
    rng: &mut StdRng,
    mut port: impl FnMut([f64; 2], [f64; 2], f64) -> PortVertex,
) -> Vec<common::Triangle> {
    let mut triangles = Vec::new();
    for _ in 0..80 {
        let reach = 2f64.powf(rng.random_range(4.0..7.0));
        let at = [rng.random_range(0.0..160.0), rng.random_range(0.0..120.0)];
        let texel = [0, 1].map(|_| rng.random_range(100.0..400.0));
        triangles.push([(); 3].map(|()| {
            let mut near = |from: [f64; 2], by: f64| from.map(|c: f64| c + rng.random_range(-0.5..0.5) * by);
            let (at, texel) = (near(at, reach), near(texel, 1.5 * reach));
            port(at, texel, rng.random_range(1.0..2.0))
        }));
    }
    triangles
}

/// Vertices have as many fraction bits as the interpolator: what a division would round down shows at once.
#[test]
fn texels_of_a_parallel_light_differ_as_often_as_they_err() {
    let mut rng = StdRng::seed_from_u64(21);
    let settings = [
        ("screen.width", "160"),
        ("screen.height", "120"),
        ("shadow.light", "parallel"),
        ("shadow.light_vertex", "14"),
    ];
    let plan = machine(&settings);
    let twin = twin(&plan, "floor", 2, 14);
    let mut found = Found::default();
    while found.fragments < 1_200_000 {
        let triangles = any(&mut rng, |at, texel, _| {
            let values = [0.5, 0.5, 0.5, 0.5, texel[0], texel[1], 9.0];
            plan.port_vertex(at[0], at[1], &values).expect("in range")
        });
        for (f, outputs) in both(&plan, &twin, &triangles, 2) {
            let (x, y) = common::place(&plan, f.addr);
            found.fragments += 1;
            for i in [4, 5] {
                let (n, d) = rule::exact_value(&plan, &triangles[f.source.id as usize], i, x, y);
                let texel = edgewalk_model::tokens::output(&plan.channels()[i], f.values[i]);
                found.axis(n as f64 / d as f64, outputs[i] as f64 / 16384.0, texel);
            }
        }
    }
    let ratio = found.ratio("parallel");
    assert!(found.texels > 500 && (0.85..1.15).contains(&ratio), "{ratio}");
}

#[test]
fn texels_of_a_perspective_light_differ_as_often_as_they_err() {
    let mut rng = StdRng::seed_from_u64(22);
    let settings = [
        ("screen.width", "160"),
        ("screen.height", "120"),
        ("shadow.light", "perspective"),
        ("shadow.light_bits", "16"),
    ];
    let plan = machine(&settings);
    let twin = twin(&plan, "signed", 4, 0);
    let side = f64::from(1u32 << plan.shadow.side_bits());
    let scale = f64::from((1u32 << plan.shadow.light_bits) - 1) / 2.0;
    let mut found = Found::default();
    while found.fragments < 400_000 {
        let triangles = any(&mut rng, |at, texel, weight| {
            let [x, y] = texel.map(|texel| texel / side * weight * scale);
            plan.port_vertex(at[0], at[1], &[0.5, 0.5, 0.5, 0.5, x, y, 9.0, weight * scale])
                .expect("in range")
        });
        for (f, outputs) in both(&plan, &twin, &triangles, 4) {
            let (x, y) = common::place(&plan, f.addr);
            let exact =
                |i: usize| rule::exact_value(&plan, &triangles[f.source.id as usize], i, x, y).0 as f64;
            found.fragments += 1;
            let texels = quotients(&plan, &f);
            for i in [0, 1] {
                let [wanted, got] =
                    [side * exact(4 + i) / exact(7), side * outputs[4 + i] as f64 / outputs[7] as f64];
                // −1 stands for all that lies beside the map.
                let on_map = (0.0..side).contains(&wanted) && (0.0..side).contains(&got);
                if on_map {
                    found.axis(wanted, got, texels[i]);
                }
            }
        }
    }
    let ratio = found.ratio("perspective");
    assert!(found.texels > 500 && (0.85..1.15).contains(&ratio), "{ratio}");
}
