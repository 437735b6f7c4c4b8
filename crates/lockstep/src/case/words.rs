//! What stands in the memories that nobody writes while the machine is busy, drawn at random.

use crate::interface::Memory;
use crate::rig::bits;
use edgewalk_machine::{Plan, Record};
use rand::{Rng, RngCore};
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

/// The words of a memory from address 0 on; none of one that the machine writes.
#[must_use]
pub fn words_at_start(plan: &Plan, memory: &Memory, random: &mut Pcg64Mcg) -> Arc<[u128]> {
    match memory.name {
        "terms" => (0..1 << plan.shade.record_bits).flat_map(|_| record(plan, random)).collect(),
        "map" | "roots" | "textures" => {
            (0..1 << memory.address_bits).map(|_| bits(random, memory.word_bits)).collect()
        }
        "tables" => (0..1 << memory.address_bits).map(|_| entry(plan, memory, random)).collect(),
        _ => Arc::default(),
    }
}

/// Random words around a reference pixel near the screen, so that no walk takes for ever; most of the triangles of one material.
fn record(plan: &Plan, random: &mut Pcg64Mcg) -> Vec<u128> {
    let record = Record {
        x: random.random_range(-4..plan.width as i32 + 4),
        y: random.random_range(0..plan.height),
        material: if random.random_bool(0.95) {
            0
        } else {
            random.random_range(0..1 << plan.shade.material_bits)
        },
        gloss: random.random_range(0..=plan.shade.gloss_bits),
        terms: plan.terms().iter().map(|_| std::array::from_fn(|_| random.next_u64())).collect(),
    };
    plan.record_words(&record).into_iter().map(u128::from).collect()
}

/// Half of the entries have small numbers only: their sums are not cut.
fn entry(plan: &Plan, memory: &Memory, random: &mut Pcg64Mcg) -> u128 {
    let b = plan.color.bits;
    let low = u128::MAX >> (128 - b.div_ceil(2));
    let small = (0..memory.word_bits.div_ceil(b)).fold(0, |mask, _| mask << b | low);
    bits(random, memory.word_bits) & if random.random_bool(0.5) { small } else { u128::MAX }
}
