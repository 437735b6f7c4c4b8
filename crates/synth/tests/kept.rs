//! Estimates of machines one after the other are those of each machine by itself.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_machine::key::{Domain, Key};
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{Machine, Plan};
use edgewalk_synth::estimate::{Fit, Kept};
use edgewalk_synth::{Fpga, Part};
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn draw(rng: &mut Pcg64Mcg, domain: Domain) -> u32 {
    match domain {
        Domain::Range(low, high) => rng.random_range(low..=high),
        Domain::OneOf(list) => *list.choose(rng).unwrap(),
        Domain::Word(words) => rng.random_range(0..words.len() as u32),
    }
}

/// The machine with another value of this key, if one of some draws can be built.
fn other(plan: &Plan, key: &Key, rng: &mut Pcg64Mcg) -> Option<Plan> {
    let mut drawn = (0..8).filter_map(|_| {
        let mut machine: Machine = (**plan).clone();
        (key.set)(&mut machine, draw(rng, key.domain));
        machine.plan().ok()
    });
    drawn.find(|other| **other != **plan)
}

/// Small machines, that have most units together.
const BASES: [&[(&str, &str)]; 5] = [
    &[],
    &[("blend.kind", "constant"), ("shadow.light", "perspective"), ("shadow.project", "serial")],
    &[
        ("shade.kind", "fast-phong"),
        ("setup.kind", "parallel"),
        ("edge.kind", "slope"),
        ("shade.colour", "multiply"),
        ("texture.kind", "nearest"),
    ],
    &[
        ("setup.kind", "parallel"),
        ("polygon.edges", "8"),
        ("polygon.lines", "yes"),
        ("shadow.light", "parallel"),
        ("shadow.gate", "scale"),
        ("dither.bits", "4"),
    ],
    &[
        ("setup.kind", "parallel"),
        ("polygon.edges", "8"),
        ("polygon.values", "bilinear"),
        ("edge.kind", "slope"),
    ],
];

/// Each key in turn has another value, so that a unit that reads the key and is thought not to is the one of the
/// machine before.
#[test]
fn kept_units_change_no_estimate() {
    let rng = &mut Pcg64Mcg::seed_from_u64(34);
    let delays = Fit::known(Fpga::Ice40).delays;
    let kept = Kept::new(delays, Fpga::Ice40);
    let (mut machines, mut changed) = (0, 0);
    for settings in BASES {
        let mut base = Machine::preset("up5k").unwrap();
        settings.iter().for_each(|(key, value)| base.set(key, value).unwrap());
        let base = base.plan().unwrap();
        let mut before = Part::MACHINE.structure(&base, &kept).unwrap();
        for key in KEYS {
            let Some(plan) = other(&base, key, rng) else { continue };
            let [with, without] = [&kept, &Kept::new(delays, Fpga::Ice40)]
                .map(|kept| Part::MACHINE.structure(&plan, kept).unwrap());
            assert_eq!(
                with,
                without,
                "{} = {} with units kept\n{}",
                key.name,
                key.show(&plan),
                base.to_toml()
            );
            machines += 1;
            changed += usize::from(with != before);
            before = with;
        }
    }
    println!("{machines} machines, {changed} of them unlike the one before");
    assert!(machines > 100 && changed > 60);
}
