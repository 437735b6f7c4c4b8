//! What is left of a light behind panes: the machine's own maps beside the exact products (bound 15).

use edgewalk_host::light::{ambient, left_error, map};
use edgewalk_machine::{Machine, Plan};
use edgewalk_scene::{Pane, Shadow};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn machine(kt_bits: u32, color_bits: u32) -> Plan {
    let mut machine = Machine::default();
    let settings = [("shadow.light", "parallel"), ("shadow.size", "2"), ("shadow.transmits", "yes")];
    settings.into_iter().for_each(|(key, value)| machine.set(key, value).expect("a key"));
    machine.set("shadow.gate", "scale").expect("a key");
    machine.set("formats.color_bits", &color_bits.to_string()).expect("a key");
    machine.blend.kt_bits = kt_bits;
    machine.plan().expect("can be built")
}

/// Panes of these k_t, one behind the other over all of a map, in the order that the numbers say.
fn stack(kts: &[f64], ambient: f64) -> Shadow {
    let rows = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let pane = |(place, kt): (usize, &f64)| {
        let z = 0.1 + 0.8 * ((place * 7) % 31) as f64 / 31.0;
        Pane { corners: [[0.0, 0.0, z], [8.0, 0.0, z], [0.0, 8.0, z]], kt: *kt }
    };
    let panes = kts.iter().enumerate().map(pane).collect();
    Shadow { size: 2, bias: 0.0, slopes: Vec::new(), ambient, matrix: rows, triangles: Vec::new(), panes }
}

/// Largest error over the bound, by the number of panes.
fn reached(kt_bits: u32, color_bits: u32, runs: u32, random: &mut Pcg64Mcg) -> ([f64; 31], u32) {
    let plan = machine(kt_bits, color_bits);
    let (max, one) = (plan.color.max() as f64, f64::from(kt_bits).exp2());
    let (mut reached, mut checked) = ([0.0f64; 31], 0);
    for run in 0..runs {
        let panes = [1, 1, 2, 4, 8, 16, 30][random.random_range(0..7)];
        let ambient_share: f64 = if run % 2 == 0 { 0.0 } else { random.random() };
        // Anything; what is rounded to 1; and a half LSB beside a step of k_t, so that its rounding errs the most.
        let kts: Vec<f64> = (0..panes)
            .map(|_| match run % 3 {
                0 => random.random_range(0.001..=1.0),
                1 => 1.0 - 0.499 / one,
                _ => ((f64::from(random.random_range(1u32..1 << kt_bits)) - 0.499) / one).max(1e-3),
            })
            .collect();
        let shadow = stack(&kts, ambient_share);
        let words = map(&shadow, &plan).expect("in the guard band").words;
        let left: f64 = kts.iter().product();
        let exact = (ambient_share + (1.0 - ambient_share) * left) * max;
        let grey = (ambient(&shadow, &plan) as f64 - ambient_share * max).abs();
        let bound = left_error(panes, color_bits, kt_bits, grey);
        for word in words {
            let error = (f64::from(word & plan.color.max() as u32) - exact).abs();
            assert!(error <= bound + 1e-9, "{kts:?}, AMBIENT {ambient_share}: {error} LSB, bound {bound}");
            assert_eq!(word >> color_bits, 0xffff, "what transmits leaves the depth alone");
            reached[panes as usize] = reached[panes as usize].max(error / bound);
            checked += 1;
        }
    }
    (reached, checked)
}

#[test]
fn what_panes_leave_of_a_light_lies_within_its_bound() {
    let mut random = Pcg64Mcg::seed_from_u64(9);
    let mut all = 0;
    for (kt_bits, color_bits) in [(8, 8), (12, 8), (4, 8), (8, 12), (12, 16)] {
        let (reached, checked) = reached(kt_bits, color_bits, 2000, &mut random);
        all += checked;
        println!(
            "k_t of {kt_bits} bits, k of {color_bits}: {checked} texels, 0 beyond; reached {:.3} by 1 pane, {:.3} by 2, {:.3} by 8, {:.3} by 30",
            reached[1], reached[2], reached[8], reached[30]
        );
        assert!(reached[1] > 0.9, "{}", reached[1]);
    }
    assert_eq!(all, 40_000);
}

/// What hides the light stands before some panes and behind others; what is behind it leaves k alone, in any order of the list.
#[test]
fn panes_behind_what_hides_the_light_do_not_count() {
    let plan = machine(8, 8);
    let mut shadow = stack(&[0.5, 0.25, 0.75], 0.0);
    shadow.triangles = vec![[[0.0, 0.0, 0.25], [8.0, 0.0, 0.25], [0.0, 8.0, 0.25]]];
    let first = map(&shadow, &plan).expect("in the guard band").words;
    shadow.panes.reverse();
    let second = map(&shadow, &plan).expect("in the guard band").words;
    // Depths 0.1, 0.28 and 0.46: only the first is before it.
    assert_eq!(first, [0x0040_0080; 4]);
    assert_eq!(second, first);
}
