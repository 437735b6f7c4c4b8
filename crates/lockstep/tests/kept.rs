//! Every failure that was ever found, as a file in `cases`, run again.

use edgewalk_lockstep::{Case, Checked};
use std::path::PathBuf;

#[test]
fn kept_failures_are_run_again() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("cases");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).expect("the cases").map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    let mut all = Checked::default();
    for file in &files {
        let name = file.file_name().expect("a file").to_string_lossy().into_owned();
        let text = std::fs::read_to_string(file).expect("a case");
        let case = Case::from_toml(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(!case.about.is_empty(), "{name} does not say what it is for");
        let checked = case.run().unwrap_or_else(|error| panic!("{name}: {error}\n{}", case.about));
        println!("{name}: {} tokens, {} values of ports compared", checked.tokens, checked.compared);
        assert!(checked.compared > 0 && checked.tokens > 0, "{name} compares nothing");
        all.merge(&checked);
    }
    println!("{} cases, {} values of ports compared", files.len(), all.compared);
    assert!(files.len() >= 8);
}

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
        ("tokens = [\"zz\"]", "tokens: \"zz\" is no token of tri: 234 bits in hex"),
        ("[unwilling]\nwrite = 1", "unwilling.write: one of tri, data, rd, wr"),
        ("[machine.fifo]\nspam = 1", "machine: line 2: unknown key fifo.spam; nearest: fifo.span"),
    ];
    for (text, message) in refused {
        assert_eq!(Case::from_toml(text).expect_err(text).to_string(), message);
    }
}
