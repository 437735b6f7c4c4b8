//! `edgewalk size` as a user runs it: the answers hold when they are drawn, and one bit fewer does not.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{SCREEN, TRIANGLE, edgewalk, names, run};
use serde_json::Value;
use std::path::Path;
use std::time::Instant;

fn json(folder: &Path, arguments: &[&str]) -> (Option<i32>, Value) {
    let output = edgewalk(folder, &[arguments, &["--json"]].concat()).output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    let value = serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {error}"));
    (output.status.code(), value)
}

/// A slope edge also draws pixels outside the triangle, of which nothing is proved.
#[test]
fn bounds_say_for_which_pixels_they_hold() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    for (kind, holds) in [("slope", "pixels inside the triangle"), ("exact", "every pixel")] {
        let set = format!("edge.kind={kind}");
        let words = ["size", "a.tri", "--set", &set];
        assert_eq!(json(folder.path(), &words).1["holds"], holds);
        let text = String::from_utf8(edgewalk(folder.path(), &words).output().unwrap().stdout).unwrap();
        assert_eq!(text.contains(&format!("bounds hold at {holds}")), kind == "slope", "{text}");
    }
}

/// The machine that `size` answers with, as settings.
fn settings(report: &Value, answer: &str) -> Vec<String> {
    let channels = report["channels"].as_array().unwrap();
    let of = |channel: &Value| {
        format!("{}={}", channel["key"].as_str().unwrap(), channel[answer]["fraction_bits"])
    };
    channels.iter().map(of).collect()
}

#[test]
fn three_meshes_stay_within_the_bound_at_the_answer_and_exceed_1_lsb_below() {
    let folder = tempfile::tempdir().unwrap();
    let (mut drawn, mut broken) = (0, 0);
    for scene in ["sphere", "torus", "room"] {
        let start = Instant::now();
        let (code, report) = json(folder.path(), &["size", scene]);
        let seconds = start.elapsed().as_secs_f64();
        println!("{scene}: {seconds:.2} s");
        assert_eq!(code, Some(0));
        // At the answer: every error within what was said, which is at most what was asked for.
        for answer in ["these", "every"] {
            let settings = settings(&report, answer);
            let mut arguments = vec!["render", scene];
            settings.iter().for_each(|setting| arguments.extend(["--set", setting]));
            let (code, picture) = json(folder.path(), &arguments);
            assert_eq!(code, Some(0), "{scene} {answer}");
            for (channel, name) in report["channels"].as_array().unwrap().iter().zip(["z", "color"]) {
                assert_eq!(channel["name"], name);
                let bound = channel[answer]["bound"].as_f64().unwrap();
                let error = picture["comparison"][format!("{name}_error")].as_f64().unwrap();
                assert!(error <= bound && bound <= 1.0, "{scene} {answer}: {name} {error} {bound}");
                if answer == "these" {
                    let told = picture["comparison"][format!("{name}_bound_for_input")].as_f64().unwrap();
                    assert_eq!(told, bound, "render and size prove the same");
                    assert_eq!(picture["comparison"]["additions"], channel["these"]["additions"]);
                }
                drawn += 1;
            }
        }
        // One bit fewer: the witness, on its own.
        for channel in report["channels"].as_array().unwrap() {
            for answer in ["every", "these"] {
                let fewer = &channel[answer]["one_bit_fewer"];
                let (name, key) = (channel["name"].as_str().unwrap(), channel["key"].as_str().unwrap());
                let file = format!("out/size/witness_{name}_{answer}.tri");
                let setting = format!("{key}={}", fewer["fraction_bits"]);
                let (code, picture) = json(folder.path(), &["render", &file, "--set", &setting]);
                let error = picture["comparison"][format!("{name}_error")].as_f64().unwrap();
                assert!(code == Some(1) && error > 1.0, "{scene}: {file} {setting} {error}");
                assert_eq!(fewer["error"].as_f64(), Some(error));
                let enough = format!("{key}={}", channel[answer]["fraction_bits"]);
                let (code, picture) = json(folder.path(), &["render", &file, "--set", &enough]);
                let error = picture["comparison"][format!("{name}_error")].as_f64().unwrap();
                assert!(code == Some(0) && error <= 1.0, "{scene}: {file} {enough} {error}");
                broken += 1;
            }
        }
    }
    println!("checked {drawn} bounds and {broken} witnesses");
    assert_eq!((drawn, broken), (12, 12));
}

/// The numbers of a line, a sign as part of its number.
fn numbers(line: &str) -> Vec<f64> {
    line.split(|c: char| !c.is_ascii_digit() && c != '.').filter_map(|word| word.parse().ok()).collect()
}

/// Every line of the text says what the JSON does, lines before columns; a wrap is called one, and an error an error.
#[test]
fn the_text_says_what_the_json_does() {
    let folder = tempfile::tempdir().unwrap();
    let (mut lines, mut wraps, mut errors) = (0, 0, 0);
    for (input, error) in [("sphere", "1"), ("torus", "0.6")] {
        let arguments = ["size", input, "--error", error];
        let (_, report) = json(folder.path(), &arguments);
        let output = edgewalk(folder.path(), &arguments).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        let mut said = text.lines().skip(2);
        let guard = &report["guard_bits"];
        let second = text.lines().nth(1).unwrap();
        assert_eq!(
            second,
            format!(
                "guard bits: {}; these triangles and the screen lie in {}",
                guard["machine"], guard["needed"]
            )
        );
        for channel in report["channels"].as_array().unwrap() {
            let [name, key] = ["name", "key"].map(|of| channel[of].as_str().unwrap());
            assert_eq!(said.next().unwrap(), format!("{name} ({key} = {})", channel["fraction_bits"]));
            for answer in ["every", "every_in_fewest_guard_bits", "these"] {
                let (of, line) = (&channel[answer], said.next().unwrap());
                let [steps, needed] = ["steps", "needed_by"].map(|key| &of[key]);
                let mut told =
                    vec![&of["fraction_bits"], &of["bound"], &of["additions"], &steps[0], &steps[1]];
                if !needed.is_null() {
                    told.extend([&needed[1][0], &needed[1][1], &needed[0]]);
                }
                let told: Vec<f64> = told.into_iter().map(|value| value.as_f64().unwrap()).collect();
                let line = line.split_at(38).1;
                let found = numbers(line);
                assert_eq!(found.len(), told.len(), "{line}: {told:?}");
                assert!(found.iter().zip(&told).all(|(a, b)| (a - b).abs() <= 0.00005), "{line}: {told:?}");
                assert!(line.contains(&format!("{} lines + {} columns", steps[0], steps[1])), "{line}");
                lines += 1;
            }
            for answer in ["every", "these"] {
                let (fewer, n) = (&channel[answer]["one_bit_fewer"], &channel[answer]["additions"]);
                let line = said.next().unwrap();
                let (bits, error) =
                    (fewer["fraction_bits"].as_u64().unwrap(), fewer["error"].as_f64().unwrap());
                let at = format!("{},{}", fewer["pixel"][0], fewer["pixel"][1]);
                // A wrap is an error of almost the whole range.
                let full = if name == "z" { 16_777_215.0 } else { 255.0 };
                assert_eq!(fewer["wraps"], error > full / 2.0, "{fewer}");
                let how = if fewer["wraps"] == true {
                    wraps += 1;
                    assert!(n.as_u64().unwrap() + 1 >= 1 << bits, "{n} {bits}");
                    format!("wraps at {at}, as N + 1 < 2^r does not hold for N = {n} and r = {bits}")
                } else {
                    errors += 1;
                    format!("errs by {error:.4} LSB at {at}")
                };
                let file = format!("out/size/witness_{name}_{answer}.tri");
                assert_eq!(line, format!("    with {bits} bits {file} {how}: --set {key}={bits}"));
            }
        }
        assert_eq!(said.next(), None);
    }
    println!("checked {lines} answers, {wraps} wraps, {errors} errors");
    assert!(lines == 12 && wraps >= 2 && errors >= 2);
}

#[test]
fn a_triangle_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let (code, report) = json(folder.path(), &["size", "a.tri", "--error", "0.75"]);
    assert_eq!(code, Some(0));
    assert_eq!((&report["width"], &report["height"]), (&64.into(), &48.into()), "the file brings its screen");
    // Corners 0,0 and 60,0 and 0,40: the major edge is the vertical one, on line 0 the last centre left of the slope is 58.5.
    let these = &report["channels"][0]["these"];
    assert_eq!((&these["additions"], &these["steps"]), (&58.into(), &serde_json::json!([0, 58])));
    assert_eq!(these["needed_by"], serde_json::json!([0, [58, 0]]));
    // 59/2 units of 2^-r and half a vertex LSB are to stay within 0.25: r = 8.
    assert_eq!(these["fraction_bits"], 8);
    assert_eq!(these["bound"].as_f64(), Some(0.5 + 1.0 / 32.0 + 59.0 / 512.0));
    assert_eq!(report["guard_bits"], serde_json::json!({ "machine": 13, "needed": 6 }));
    // For every triangle: 47 lines, 63 columns, 8191 of the guard band; 63 with 6 guard bits.
    assert_eq!(report["channels"][0]["every"]["additions"], 47 + 63 + 8191);
    assert_eq!(report["channels"][0]["every_in_fewest_guard_bits"]["additions"], 47 + 63 + 63);
    assert_eq!(report["channels"][1]["name"], "color");
}

/// A witness with a bit fewer has too few bits for the segments of the machine's adders.
#[test]
fn witnesses_of_a_segmented_adder_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let settings = ["interpolator.segments=4", "formats.color_bits=2"];
    let segmented: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
    let whole = &segmented[2..];
    let [segmented, whole] = [&segmented[..], whole].map(|settings| {
        let (code, report) = json(folder.path(), &[&["size", "a.tri"], settings].concat());
        assert_eq!(code, Some(0));
        report["channels"].clone()
    });
    assert_eq!(segmented, whole, "segments change no value");
    let witness = &segmented[1]["these"]["one_bit_fewer"];
    assert!(witness["fraction_bits"].as_u64().unwrap() + 2 < 8, "a word of less than 4 segments: {witness}");
}

/// What stands behind the interpolator counts: the answer's bound is that of `render` with the answer's bits.
#[test]
fn bounds_are_those_of_what_is_stored() {
    let folder = tempfile::tempdir().unwrap();
    let polygon = "size 32 32\nP 4 2.3 3.1 .31 .1 .2 .3 0  28.7 5.9 .52 .63 .3 .41 0  25.2 29.3 .61 .9 .7 .52 0  5.5 22.6 .44 .37 .6 .4 0\n";
    let value = |x: f64, y: f64| 0.03 + x / 61.0 + y / 97.0;
    let corners = [(2.3, 3.1), (28.7, 5.9), (25.2, 29.3), (5.5, 22.6)];
    let vertex = |(x, y)| {
        let v = value(x, y);
        format!("  {x} {y} {v} {v} {v} {v} 0")
    };
    let planar = format!("size 32 32\nP 4 {}\n", corners.map(vertex).concat());
    let map = "shadow 16 0.01 0.25 .5 0 0 0  0 .5 0 0  0 0 1 0  0 0 0 1\nL 0 0 0.1  9 0 0.1  0 9 0.1\n";
    let triangle = "T 1 1 .5 1 0 .3 0  31 1 .2 0 1 .3 0  1 31 .5 .5 .7 0 0\n";
    let blended = "blend 1\nT 1 1 .5 1 0 .3 .5  31 1 .2 0 1 .3 .5  1 31 .5 .5 .7 0 .5\n";
    let lit = format!("size 32 32\n{map}{triangle}");
    let plain = format!("size 32 32\n{triangle}");
    let mixed = format!("size 32 32\n{blended}");
    let gate = ["--set", "shadow.light=perspective", "--set", "shadow.size=16", "--set", "shadow.gate=scale"];
    // The machine, the error, and whether these triangles and every one have an answer for the colour.
    let cases: [(&str, &[&str], &str, [bool; 2]); 8] = [
        (&plain, &["--set", "dither.bits=4"], "1", [false, false]),
        (&plain, &["--set", "dither.bits=4"], "17.9", [true, true]),
        (&lit, &gate, "1.2", [true, false]),
        (&lit, &gate, "2", [true, true]),
        (&plain, &["--set", "blend.kind=constant"], "1", [true, false]),
        (&mixed, &["--set", "blend.kind=constant"], "1", [false, false]),
        (&planar, &["--machine", "polygon"], "1", [true, true]),
        (polygon, &["--machine", "bilinear"], "1", [false, false]),
    ];
    for (text, machine, error, answers) in cases {
        std::fs::write(folder.path().join("a.tri"), text).unwrap();
        let (code, report) = json(folder.path(), &[&["size", "a.tri", "--error", error], machine].concat());
        assert_eq!(code, Some(0), "{machine:?} {report}");
        let color = &report["channels"][1];
        for (answer, is_there) in ["these", "every"].into_iter().zip(answers) {
            let told = &color[answer];
            assert_eq!(
                [&told["bound"], &told["fraction_bits"]].map(|of| !of.is_null()),
                [is_there; 2],
                "{machine:?} {told}"
            );
            assert_eq!(told["out_of_reach"].is_null(), is_there, "{told}");
            if !is_there {
                continue;
            }
            let bound = told["bound"].as_f64().unwrap();
            assert!(bound <= error.parse().unwrap(), "{machine:?} {told}");
            let setting = format!("formats.color_fraction={}", told["fraction_bits"]);
            let (_, picture) =
                json(folder.path(), &[&["render", "a.tri", "--set", &setting], machine].concat());
            let found = &picture["comparison"];
            assert!(found["color_error"].as_f64().unwrap() <= bound, "{machine:?} {answer}: {found}");
            // With lights render has a bound of the machine alone.
            if let (Some(of_render), "these") = (found["color_bound_for_input"].as_f64(), answer) {
                assert!((of_render - bound).abs() < 1e-9, "{machine:?}: {of_render} {bound}");
            }
        }
    }
    println!("checked {} frames", cases.len());
}

#[test]
fn what_cannot_be_sized_is_said() {
    let folder = tempfile::tempdir().unwrap();
    for (error, said) in [("0.5", "above 0.5"), ("nan", "permitted: numbers, LSB"), ("1e9", "1024 LSB")] {
        let (code, told) = run(folder.path(), &["size", "sphere", "--error", error]);
        assert!(code == Some(2) && told.contains(said), "{error}: {told}");
    }
    // Roundings alone take it, or nothing does.
    for (arguments, said) in [
        (&["--error", "0.52"][..], "may err by 0.53125 LSB already"),
        (&["--machine", "textbook"][..], "outputs wrap outside the triangle"),
    ] {
        let (code, report) = json(folder.path(), &[&["size", "sphere"], arguments].concat());
        let why = report["channels"][0]["these"]["out_of_reach"].as_str().unwrap();
        assert!(code == Some(0) && why.contains(said), "{why}");
        assert!(report["channels"][0]["these"]["fraction_bits"].is_null());
    }
    // 31 additions and the start are 2^5 roundings: whether 5 bits would do is open, and the page does not claim it.
    let (_, report) = json(folder.path(), &["size", "terrain"]);
    let these = &report["channels"][0]["these"];
    assert_eq!((&these["additions"], &these["fraction_bits"]), (&31.into(), &6.into()));
    assert!(these["one_bit_fewer"].is_null() && these["no_breaker"] == "none was found", "{these}");
    std::fs::write(
        folder.path().join("off.tri"),
        "size 64 48\nT 0 -9 0 0 0 0 0  9 -9 0 0 0 0 0  0 -2 0 0 0 0 0\n",
    )
    .unwrap();
    let (code, told) = run(folder.path(), &[&["size", "off.tri"], &SCREEN[..]].concat());
    assert!(code == Some(2) && told.contains("no triangle covers a pixel of the screen"), "{told}");
    assert_eq!(names(folder.path()), ["off.tri", "out"]);
}
