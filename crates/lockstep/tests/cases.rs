//! Cases as files.

use edgewalk_lockstep::Case;

#[test]
fn a_case_is_read_back_as_it_was_written() {
    let text = "about = \"a case\"\nunit = \"depth\"\ndepth_func = 3\ndepth_write = false\nclear_z = 9\nlate = 2\n\
                resets = [7, 9]\ndisturbed = 5\ncycles = 40\nseed = 11\n\
                tokens = [\"00000000000000000\"]\n[unwilling]\nwr = 100\n[machine.memory]\nlatency = 3\n";
    let case = Case::from_toml(text).expect("a case");
    assert_eq!((case.depth_func, case.depth_write, case.clear_z, case.late), (3, false, Some(9), 2));
    assert_eq!((&case.resets[..], case.disturbed, case.cycles, case.seed), (&[7, 9][..], 5, 40, 11));
    assert_eq!((case.unwilling["wr"], case.plan.latency), (100, 3));
    let again = Case::from_toml(&case.to_toml()).expect("what was written");
    assert_eq!(format!("{again:?}"), format!("{case:?}"));
}

#[test]
fn what_is_no_case_is_refused_with_the_key() {
    let refused = [
        ("colour = 1", "colour: no case has such a key"),
        ("unit = \"pixl\"", "unit: unknown unit pixl; nearest: pixel"),
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
