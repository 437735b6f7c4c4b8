//! Machines drawn at random from the table of keys, so that a new key is drawn without a word here.

use edgewalk_machine::key::{Domain, Key};
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{Machine, Plan};
use rand::Rng;
use rand::seq::{IndexedRandom, SliceRandom};
use rand_pcg::Pcg64Mcg;

/// A machine that can be built. Every key is set several times, in any order; what clashes with the rest is taken back.
pub fn random_plan(rng: &mut Pcg64Mcg) -> Plan {
    let mut plan = Plan::default();
    for _ in 0..3 {
        let mut keys: Vec<&Key> = KEYS.iter().collect();
        keys.shuffle(rng);
        for key in keys {
            let mut machine: Machine = (*plan).clone();
            (key.set)(&mut machine, draw(rng, key.domain));
            plan = machine.plan().unwrap_or(plan);
        }
    }
    plan
}

fn draw(rng: &mut Pcg64Mcg, domain: Domain) -> u32 {
    match domain {
        Domain::Range(low, high) => rng.random_range(low..=high),
        Domain::OneOf(list) => *list.choose(rng).expect("a list of values has some"),
        Domain::Word(words) => rng.random_range(0..words.len() as u32),
    }
}
