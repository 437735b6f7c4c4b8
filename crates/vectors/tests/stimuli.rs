//! What the suites feed, by count and checksum: a triangle that is not what its case is named after still passes everything, so that
//! without this nobody would see what the vectors have lost. After a change that is meant:
//! `UPDATE_EXPECT=1 cargo test --release -p edgewalk-vectors stimuli::`.

use std::fmt::Write as _;

use edgewalk_machine::units;
use edgewalk_vectors::{SUITES, StallKind, Suite, Unit, capture, capture_tokens};
use expect_test::expect_file;
use sha2::{Digest, Sha256};

use crate::common;

/// Machines with everything that a suite looks at.
const MACHINES: [&str; 16] = [
    "small",
    "textbook",
    "tiny",
    "wide_words",
    "interpolated_interlock_bit_by_bit",
    "and",
    "scale_five_texels_tags_one_extra",
    "perspective_pipelined_scale_tags",
    "own_map_larger_than_the_screen",
    "own_map_smaller_perspective_constant_kt_transmits",
    "fast_phong_registers_tables",
    "fast_phong_registers_relief",
    "phong_memory_multiply_two_lights_one_extra",
    "phong_lamp_multiply_texture",
    "five_of_eight_bits",
    "four_of_ten_bits_screen_door_interlock",
];

#[test]
fn every_suite_feeds_what_it_fed() {
    let machines =
        [common::twelve(), common::glass(), common::lights(), common::shades(), common::dithers()].concat();
    let mut fed = String::new();
    for name in MACHINES {
        let (_, plan) = machines.iter().find(|(other, _)| *other == name).expect("a machine of that name");
        for entry in SUITES.iter().filter(|entry| entry.is_for(plan)) {
            let suite = Suite::named(plan, entry.name, 3, 30).expect("listed");
            let digest = Sha256::digest(format!("{suite:?}"));
            let (cases, triangles) = (suite.cases.len(), suite.triangles().count());
            write!(fed, "{name}, {}: {cases} cases, {triangles} triangles, ", entry.name).expect("text");
            digest.iter().take(4).for_each(|byte| write!(fed, "{byte:02x}").expect("text"));
            fed.push('\n');
        }
    }
    expect_file!["snapshots/stimuli.txt"].assert_eq(&fed);
}

#[test]
fn tokens_of_ones_own_meet_the_stalls_and_the_words_of_their_seed() {
    let machines = common::shades();
    let (_, plan) = machines.iter().find(|(name, _)| *name == "fast_phong_registers_relief").expect("named");
    let suite = Suite::named(plan, "random", 1, 6).expect("listed");
    let unit = const { Unit::of(&units::texel::SPEC) };
    let tokens = capture(plan, unit, &suite, suite.state, StallKind::None).setting.tokens;
    assert!(tokens.len() > 50, "{} tokens", tokens.len());
    let run = |stalls, seed| capture_tokens(plan, unit, tokens.clone(), suite.state, stalls, seed).links;
    let cycles = |seed| run(StallKind::Mixed, seed).into_iter().map(|link| link.cycles).collect::<Vec<_>>();
    let values = |seed| run(StallKind::None, seed).into_iter().map(|link| link.tokens).collect::<Vec<_>>();
    assert_eq!((cycles(1), values(1)), (cycles(1), values(1)));
    assert_ne!(cycles(1), cycles(2), "stalls");
    assert_ne!(values(1), values(2), "words");
}
