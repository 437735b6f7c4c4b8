//! Cases as files.

use crate::common::triangles::half_square;
use edgewalk_lockstep::{Case, LockstepError, Triangles, Unit};
use edgewalk_machine::Machine;
use std::collections::BTreeMap;

#[test]
fn a_case_is_read_back_as_it_was_written() {
    let text = "about = \"a case\"\nunit = \"depth\"\ndepth_func = 3\ndepth_write = false\nclear_z = 9\nlate = 2\n\
                color_write = false\nblend_add = true\nshadow_on = true\nlight_pass = true\nambient = 77\n\
                resets = [7, 9]\ndisturbed = 5\ncycles = 40\nseed = 11\n\
                tokens = [\"00000000000000000\"]\n[unwilling]\nwr = 100\n[machine.memory]\nlatency = 3\n";
    let case = Case::from_toml(text).expect("a case");
    assert_eq!(
        (case.state.depth_func, case.state.depth_write, case.clear_z, case.late),
        (3, false, Some(9), 2)
    );
    assert_eq!(
        (case.state.color_write, case.state.blend_add, case.state.shadow_on, case.state.light_pass),
        (false, true, true, true)
    );
    assert_eq!((case.state.ambient, case.about.as_str()), (77, "a case"));
    assert_eq!((&case.resets[..], case.disturbed, case.cycles, case.seed), (&[7, 9][..], 5, 40, 11));
    assert_eq!((case.unwilling["wr"], case.plan.latency), (100, 3));
    let again = Case::from_toml(&case.to_toml()).expect("what was written");
    assert_eq!(format!("{again:?}"), format!("{case:?}"));
}

#[test]
fn what_is_no_case_is_refused_with_the_key() {
    let refused = [
        ("colour = 1", "colour: no case has such a key"),
        (
            "unit = \"pixl\"",
            "unit: unknown unit pixl; permitted: machine, setup, edge, poly, span, term, pixel, texel, bump, normal, lamp, shade, project, shadow, dither, depth, blend; nearest: pixel",
        ),
        ("depth_func = \"less\"", "depth_func: a number in range is wanted"),
        ("tokens = [\"zz\"]", "tokens: \"zz\" is no token of tri: 324 bits in hex"),
        ("[unwilling]\nwrite = 1", "unwilling.write: one of tri, data, rd, wr"),
        ("[machine.fifo]\nspam = 1", "machine: line 2: unknown key fifo.spam; nearest: fifo.span"),
    ];
    for (text, message) in refused {
        assert_eq!(Case::from_toml(text).expect_err(text).to_string(), message);
    }
}

/// A reset that comes when all is drawn is run too, and a cycle behind it.
#[test]
fn a_case_ends_behind_its_last_reset() {
    let of = |resets: &str| {
        let tokens = "0".repeat(81);
        let text = format!("unit = \"machine\"\nresets = [{resets}]\ntokens = [\"{tokens}\"]\n");
        Case::from_toml(&text).expect("a case").run().expect("no difference").cycles
    };
    let alone = of("");
    assert!(alone < 400, "{alone}");
    assert_eq!((of("500"), of("500, 3")), (502, 502));
}

/// A triangle of six pixels; in a cycle with reset nothing moves, so it is offered again.
#[test]
fn what_moved_is_counted_by_link() {
    let plan = Machine { width: 5, height: 4, guard_bits: 4, ..Machine::default() };
    let plan = plan.plan().expect("can be built");
    let mut case = Case::new(&plan, Unit::MACHINE);
    case.tokens = vec![Triangles::new(&plan).pack(&half_square(&plan, 7), 0)];
    for resets in [vec![], vec![0], vec![0, 1, 2]] {
        case.resets = resets;
        let checked = case.run().expect("no difference");
        assert_eq!(checked.moved, BTreeMap::from([("tri", 1), ("rd", 6), ("data", 6), ("wr", 6)]));
        assert_eq!(checked.tokens, 1);
    }
}

#[test]
fn a_case_in_which_nothing_moves_has_compared_nothing() {
    let case = Case::new(&Machine::default().plan().expect("can be built"), Unit::MACHINE);
    assert_eq!(case.run().expect_err("no triangle"), LockstepError::Vacuous);
}
