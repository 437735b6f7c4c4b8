//! Choices in arms of choices: what an arm needs, what both share, and what others read besides.

use edgewalk_netlist::Module;
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use crate::simulator;

/// How many choices lie in each other's arms.
const DEEP: u64 = 500;

/// Each choice's arm goes on from the choice before; its other arm, and what is read beside it, take from the inputs.
#[test]
fn arms_of_every_choice_are_those_it_takes() {
    for width in [1, 8, 64, 100] {
        let mask = u128::MAX >> (128 - width);
        let m = Module::new("choices", "");
        let (a, b, taken) = (m.input("a", width), m.input("b", width), m.input("taken", 64));
        let shared = a + b;
        let mut value = a;
        for i in 0..DEEP {
            let add = m.lit(width, u128::from(i) & mask);
            // Long enough to be worth a branch, and, but for the sum that all share, of this choice alone.
            let longer = (((((value + add) ^ b) + shared) ^ a) + add) ^ shared;
            let other = ((((b ^ add) + a) ^ shared) + add) - b;
            value = taken.slice((i % 64) as u32, (i % 64) as u32).mux(longer, other);
            if i % 100 == 50 {
                m.output(&format!("value{i}"), value);
            }
        }
        m.output("value", value);
        let netlist = m.finish().unwrap();
        let mut sim = simulator(&netlist);
        let mut random = Pcg64Mcg::new(1);
        let mut compared = 0;
        for round in 0..40u32 {
            let (a, b) = (random.random::<u128>() & mask, random.random::<u128>() & mask);
            let taken = match round {
                0 => u64::MAX,
                1 => 0,
                _ => random.random(),
            };
            for (name, value) in [("a", a), ("b", b), ("taken", taken.into())] {
                sim.set_input(name, value).unwrap();
            }
            let add = |x: u128, y: u128| x.wrapping_add(y) & mask;
            let shared = add(a, b);
            let mut value = a;
            for i in 0..DEEP {
                let n = u128::from(i) & mask;
                value = if taken >> (i % 64) & 1 == 1 {
                    add(add(add(value, n) ^ b, shared) ^ a, n) ^ shared
                } else {
                    add(add(b ^ n, a) ^ shared, n).wrapping_sub(b) & mask
                };
                if i % 100 == 50 {
                    assert_eq!(sim.get(&format!("value{i}")).unwrap(), value, "width {width}, choice {i}");
                    compared += 1;
                }
            }
            assert_eq!(sim.get("value").unwrap(), value, "width {width}");
            compared += 1;
        }
        assert_eq!(compared, 40 * 6);
    }
}
