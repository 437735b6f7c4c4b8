//! Inputs and machines that do not fit each other.

use crate::support::run;

const T: &str = "T 0 0 0 0 0 0 0  9 0 0 0 0 0 0  0 9 0 0 0 0 0\n";
const SCREEN: [&str; 4] = ["--set", "screen.width=64", "--set", "screen.height=48"];

#[test]
fn another_number_of_channels_names_the_key_both_numbers_and_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("two.tri"), format!("size 64 48\nextra 2\n{T}X 1 2 3 4 5 6\n"))
        .unwrap();
    std::fs::write(folder.path().join("none.tri"), format!("size 64 48\n{T}")).unwrap();
    let three = ["--set", "channels.extra=3"];
    let says_2 = |machine: u32| {
        format!(
            "two.tri: extra 2: the machine has channels.extra = {machine}; give --set channels.extra=2, \
             or --adapt, which sets the keys that are not given\n"
        )
    };
    let says_0 = |input: &str| {
        let other = match input {
            "sphere" => "or draw a triangle file with a line `extra 3`",
            _ => "or --adapt, which sets the keys that are not given",
        };
        format!(
            "{input}: extra 0: the machine has channels.extra = 3; give --set channels.extra=0, {other}\n"
        )
    };
    let mut refused = 0;
    let mut refuse = |arguments: &[&str], machine: &[&str], message: String| {
        let (code, error) = run(folder.path(), &[arguments, &SCREEN, machine].concat());
        assert_eq!((code, error), (Some(2), format!("error: {message}")), "{arguments:?}");
        refused += 1;
    };
    for engine in ["golden", "fast", "model", "rtl"] {
        let arguments = |file| ["raster", file, "--engine", engine, "--out", "OUT"];
        refuse(&arguments("two.tri"), &[], says_2(0));
        refuse(&arguments("two.tri"), &three, says_2(3));
        refuse(&arguments("none.tri"), &three, says_0("none.tri"));
    }
    for input in ["two.tri", "none.tri", "sphere"] {
        let message = |machine| if input == "two.tri" { says_2(machine) } else { says_0(input) };
        refuse(&["render", input, "--out", "OUT"], &three, message(3));
        refuse(&["render", input, "--engine", "golden", "--out", "OUT"], &three, message(3));
        refuse(&["explain", input, "2", "2"], &three, message(3));
        refuse(&["bench", input], &three, message(3));
        refuse(&["trace", input, "--out", "OUT.vcd"], &three, message(3));
        refuse(&["verify", input, "--no-simulators"], &three, message(3));
        refuse(&["demo", input, "--out", "OUT"], &three, message(3));
    }
    println!("checked {refused} / 33 command lines");
    assert_eq!(refused, 33);
    assert_eq!(crate::support::names(folder.path()), ["none.tri", "two.tri"], "nothing was left behind");
}

#[test]
fn a_value_that_the_channel_does_not_hold_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("unorm", "1.5", "0 to 1"),
        ("unorm", "-0.5", "0 to 1"),
        ("signed", "2047.5", "-2047 to 2047"),
        ("floor", "-2048", "-2047 to 2047"),
    ];
    let mut refused = 0;
    for (kind, value, range) in cases {
        let text = format!("size 64 48\nextra 1\n{T}X 0 1 0\n{T}X 0 1 {value}\n");
        std::fs::write(folder.path().join("in.tri"), text).unwrap();
        for engine in ["fast", "model", "rtl"] {
            let set = format!("channels.e0_kind={kind}");
            let arguments = ["raster", "in.tri", "--engine", engine, "--out", "OUT", "--set"];
            let (code, error) =
                run(folder.path(), &[&arguments[..], &["channels.extra=1", "--set", &set]].concat());
            let message = format!(
                "error: in.tri: triangle 1 (counted from 0), vertex 3 (from 1): e0 = {value} lies outside {range}\n"
            );
            assert_eq!((code, error), (Some(2), message));
            refused += 1;
        }
    }
    println!("checked {refused} / 12 values");
    assert_eq!(refused, 12);
}

#[test]
fn malformed_values_name_line_reason_and_the_valid_form() {
    let (folder, size) = (tempfile::tempdir().unwrap(), "size 64 48\n");
    let cases: [(String, &[&str]); 10] = [
        (format!("{size}extra 5\n"), &[":2: extra N: `5`", "an integer from 0 to 4"]),
        (format!("{size}{T}X 1 2 3 4 5 6\n"), &[":3: X: `6 given`", "here `extra 2`"]),
        (format!("{size}extra 2\n{T}X 1 2 3 4 5 nan\n"), &[":4: X vertex 3 e1: `nan`", "a number from"]),
        (format!("{size}extra 2\n{T}X 1 2 3 4 5 inf\n"), &[":4: X vertex 3 e1: `inf`"]),
        (format!("{size}extra 2\n{T}X 1 2 3 4 5 1e10\n"), &[":4: X vertex 3 e1: `1e10`", "2147483647"]),
        (
            format!("{size}extra 2\n{T}X 1 2 3\n"),
            &[":4: X: `3 given`", "6 values, e0 e1 of vertex 1, then of 2"],
        ),
        (format!("{size}extra 2\n{T}X 1 2 3 4 5 6 7\n"), &[":4: X: `7 given`", "6 values"]),
        (format!("{size}extra 2\n{T}{T}"), &[":4: X: `T`", "triangle in line 3 is missing", "6 values"]),
        (format!("{size}extra 2\n{T}"), &[":4: X: `end of file`", "triangle in line 3 is missing"]),
        (format!("{size}extra 2\n{}", T.replacen('T', "P 3", 1)), &[":3:", "`P`", "polygons have no `X`"]),
    ];
    let mut refused = 0;
    for (text, words) in &cases {
        std::fs::write(folder.path().join("in.tri"), text).unwrap();
        for engine in ["golden", "fast", "model", "rtl"] {
            let extra = if text.contains("extra 2") { "channels.extra=2" } else { "channels.extra=0" };
            let arguments = ["raster", "in.tri", "--engine", engine, "--out", "OUT", "--set", extra];
            let (code, error) = run(folder.path(), &arguments);
            assert_eq!(code, Some(2), "{error}");
            assert!(error.starts_with("error: in.tri:"), "{error}");
            assert!(words.iter().all(|word| error.contains(word)), "{words:?}: {error}");
            refused += 1;
        }
    }
    println!("checked {refused} / 40 files");
    assert_eq!(refused, 40);
}

/// Golden has the channels of the machine, and draws whatever else the machine lacks.
#[test]
fn golden_asks_for_its_channels_alone() {
    let folder = tempfile::tempdir().unwrap();
    let x = "1 2 3 4 1 2 3 4 1 2 3 4";
    std::fs::write(folder.path().join("in.tri"), format!("size 64 48\nextra 4\nblend 1\n{T}X {x}\n"))
        .unwrap();
    for engine in ["golden", "scanline"] {
        let arguments = ["raster", "in.tri", "--engine", engine, "--out", "OUT"];
        let message = "error: in.tri: extra 4: the machine has channels.extra = 0; give --set channels.extra=4, or --adapt, \
                       which sets the keys that are not given\n";
        assert_eq!(run(folder.path(), &arguments), (Some(2), message.to_owned()), "{engine}");
        let (code, error) = run(folder.path(), &[&arguments[..], &["--adapt"]].concat());
        match engine {
            "golden" => assert_eq!((code, error.as_str()), (Some(0), "")),
            _ => assert!(code == Some(2) && error.contains("the frame blends"), "{error}"),
        }
    }
}
