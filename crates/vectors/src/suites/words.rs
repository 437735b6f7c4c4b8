//! What the memories hold that nobody writes: a light's map, and the records, tables, roots and texels behind TERM, SHADE, NORMAL or LAMP and
//! TEXEL. Records start around the ends of the tables; tables, roots and texels are random, so that no error of the arithmetic is
//! small by chance.

use super::light;
use edgewalk_lockstep::case::words_at_start;
use edgewalk_lockstep::{Interface, Unit};
use edgewalk_machine::{Plan, Record, Term};
use rand::seq::IndexedRandom;
use rand::{Rng, RngCore, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::BTreeMap;
use std::sync::Arc;

/// By memory the words from address 0 on; what lies beyond them is all ones.
pub type Words = BTreeMap<&'static str, Arc<[u128]>>;

/// The memory of the terms: a record for each triangle.
pub(super) const RECORDS: &str = "terms";

/// Materials with words of their own; the last of all is made of ones.
const MATERIALS: usize = 2;

/// EDGE of a cone that ends at a right angle to its axis: what lies there, with 0 for `da`, is the last that is lit.
const RIGHT_ANGLE: u32 = 1 << 16;

/// The words for a drawing of so many triangles.
#[must_use]
pub fn words(machine: &Plan, seed: u64, triangles: usize) -> Words {
    let shaded = if machine.shade.is_there() { triangles } else { 0 };
    let records: Vec<Record> = (0..shaded).map(|k| record(machine, seed, k)).collect();
    with_records(machine, seed, &records)
}

/// The words for triangles with these records.
pub(super) fn with_records(machine: &Plan, seed: u64, records: &[Record]) -> Words {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut words = Words::new();
    if machine.shadow.is_there() {
        words.insert("map", light::map(machine).into_iter().map(u128::from).collect());
    }
    let of_materials = |each: usize| each * MATERIALS.min(1 << machine.shade.material_bits);
    for memory in Interface::new(machine, Unit::MACHINE).memories {
        let most = match memory.name {
            "tables" => of_materials(1 << machine.shade.entry_bits()),
            "textures" => of_materials(1 << (2 * machine.shade.texture_bits)),
            "roots" => machine.root_words() as usize,
            _ => continue,
        };
        let mut all = words_at_start(machine, &memory, &mut random)[..most].to_vec();
        if memory.name == "textures" && machine.shade.bumps() {
            steepest(machine, &mut all);
        }
        if memory.name == "roots" {
            below_halves(machine, &mut all);
        }
        words.insert(memory.name, all.into());
    }
    if machine.shade.is_there() {
        let records = records.iter().flat_map(|record| machine.record_words(record));
        words.insert(RECORDS, records.map(u128::from).collect());
    }
    words
}

/// Entries that leave a product 1 below a half, where what is cut off decides: of NORMAL's R one with the least root and slope; of LAMP's
/// A the one for the farthest light, 1 there, and of its C the last, at a right angle to the axis. LAMP's root for that light is 1.
fn below_halves(machine: &Plan, roots: &mut [u128]) {
    if machine.shade.is_positional() {
        let entries = [(0, RIGHT_ANGLE, 0), (255, 1 << 16, 0), (511, 0x7fff, 0), (575, 512, 511)];
        entries.iter().for_each(|(place, v, slope)| roots[*place] = machine.root_word(*v, *slope));
    } else {
        roots[128] = machine.root_word(1, 1);
    }
}

/// Every other texel has slopes at the ends of their bits, or none: each of both with each in turn.
fn steepest(machine: &Plan, texels: &mut [u128]) {
    let bits = machine.shade.slope_bits;
    let lowest = 1u128 << (bits - 1);
    let ends = [lowest, lowest - 1, 0];
    for (k, texel) in texels.iter_mut().step_by(2).enumerate() {
        let slopes = ends[k % 3] << bits | ends[k / 3 % 3];
        *texel = *texel >> (2 * bits) << (2 * bits) | slopes;
    }
}

/// The record of triangle number k: reference pixel on the screen or beside it, most of them of the first material.
fn record(machine: &Plan, seed: u64, k: usize) -> Record {
    let mut random = Pcg64Mcg::seed_from_u64(seed << 32 ^ k as u64);
    let last = (1u32 << machine.shade.material_bits) - 1;
    // Tables take long to come.
    let material = [(5, 1.min(last)), (6, last)].into_iter().find(|(place, _)| k % 16 == *place);
    let material = material.map_or(0, |(_, material)| material);
    Record {
        // Where the suites draw; a walk over all of a large screen would take long.
        x: random.random_range(-4..machine.width.min(20) as i32 + 4),
        y: random.random_range(0..machine.height.min(20)),
        material,
        gloss: random.random_range(0..=machine.shade.gloss_bits),
        terms: machine.terms().iter().map(|term| around(machine, term, k % 8 == 4, &mut random)).collect(),
    }
}

/// Words of a term that begins at one of its ends or between them and crosses them in some pixels; or any words.
fn around(machine: &Plan, term: &Term, any: bool, random: &mut Pcg64Mcg) -> [u64; 6] {
    if any {
        return std::array::from_fn(|_| random.next_u64());
    }
    let ends = ends(machine, term);
    let (low, high) = (ends[0], ends[ends.len() - 1]);
    let at = match random.random() {
        true => *ends.choose(random).unwrap_or(&low),
        false => random.random_range(low..=high),
    };
    let range = (high - low) << term.fraction;
    let mut upto = |most: i128| random.random_range(-most..=most) as u64;
    let (slope, bend) = (range / 16, range / 256);
    let below = upto((1 << term.fraction) / 2);
    let v = ((at << term.fraction) as u64).wrapping_add(below);
    [v, upto(slope), upto(slope), upto(bend), upto(bend), upto(bend)]
}

/// Outputs of a term at which something changes behind it, the lowest first.
pub(super) fn ends(machine: &Plan, term: &Term) -> Vec<i128> {
    let one = 1i128 << (machine.shade.table_bits + machine.shade.cosine_fraction());
    let largest = (1i128 << (term.bits - 1)) - 1;
    match &term.name[..1] {
        // What a cosine grows by with the slopes.
        "n" | "p" if term.name.len() > 3 => vec![-largest - 1, 0, largest],
        "t" => vec![0, 0x1_0000, largest],
        "n" if term.name == "nn" => vec![0x4000, 0x1_0000],
        "n" => vec![0, one],
        "p" if term.bits == 25 => vec![-(1 << 23), 0, 1 << 23],
        "p" => vec![0, 0x1_0000],
        // LAMP: each exponent of the way, products around 0, the axis.
        "d" if term.name == "dd" => vec![0, 1 << 16, 1 << 20, 1 << 24, 1 << 28, 1 << 30],
        "d" => vec![-(1 << 23), 0, 1 << 23],
        // A texture begins anew.
        _ => vec![0, (1 << term.bits) - 1],
    }
}
