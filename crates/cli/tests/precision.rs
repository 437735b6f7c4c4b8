//! `edgewalk config explain`: additions, the proved bound or none, and the fraction bits that a screen needs.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use serde_json::Value;
use std::process::Command;

fn explain(settings: &[&str], json: bool) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(["config", "explain"]);
    for setting in settings {
        command.args(["--set", setting]);
    }
    if json {
        command.arg("--json");
    }
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn precision(settings: &[&str]) -> Value {
    serde_json::from_str::<Value>(&explain(settings, true)).unwrap()["precision"].clone()
}

#[test]
fn the_default_machine_has_what_it_needs_and_not_a_bit_more() {
    let told = precision(&[]);
    assert_eq!(told["additions"], "640x480: 479 lines + 8191 guard columns + 639 columns = 9309 steps");
    for channel in ["z", "color"] {
        let proof = &told[channel];
        // (9309 + 1) / 2^15 + 1/32 + 1/2.
        assert_eq!(proof["bound"], 9310.0 / 32768.0 + 1.0 / 32.0 + 0.5, "{proof}");
        assert_eq!((&proof["no_bound"], &proof["needed_fraction_bits"]), (&Value::Null, &14.into()));
        let witness = proof["one_bit_fewer"].as_str().unwrap();
        assert!(witness.starts_with("with 13 fraction bits, triangle ("), "{witness}");
        assert!(witness.contains("9309 additions"), "{witness}");
    }
    assert!(told["color"]["one_bit_fewer"].as_str().unwrap().ends_with("output 256 of 0..=255"));
    let page = explain(&[], false);
    assert_eq!(page.matches("at most 0.8154 LSB, proved").count(), 2, "{page}");
    assert_eq!(page.matches("14 are needed for 1 LSB").count(), 2, "{page}");
    assert!(page.contains("= 9309 steps") && page.contains("UQ24.14, 38 bits"), "{page}");
}

/// The bits that are said to be needed have a bound of at most 1 LSB, and one fewer have none.
#[test]
fn the_bits_it_asks_for_suffice_and_one_fewer_do_not() {
    let screens: [&[&str]; 5] = [
        &["formats.color_fraction=4"],
        &["screen.guard_bits=10", "formats.color_fraction=5"],
        &["screen.width=1920", "screen.height=1080", "formats.color_vertex=1"],
        &["screen.width=64", "screen.height=48", "screen.guard_bits=6", "formats.color_vertex=2"],
        &["edge.kind=slope", "formats.color_fraction=20"],
    ];
    let mut needed = Vec::new();
    for screen in screens {
        let bits = precision(screen)["color"]["needed_fraction_bits"].as_u64().unwrap();
        let with = |bits: u64| {
            let setting = format!("formats.color_fraction={bits}");
            precision(&[screen, &[&setting]].concat())["color"].clone()
        };
        let (enough, fewer) = (with(bits), with(bits - 1));
        assert!(enough["bound"].as_f64().unwrap() <= 1.0, "{screen:?}: {enough}");
        assert!(fewer["bound"].as_f64().is_none_or(|bound| bound > 1.0), "{screen:?}: {fewer}");
        needed.push(bits);
    }
    assert_eq!(needed[..4], [14, 12, 15, 8]);
    let told = &precision(screens[0])["color"];
    assert_eq!(told["bound"], Value::Null);
    assert!(told["no_bound"].as_str().unwrap().starts_with("9309 additions may err by 290.9375 LSB"));
    assert!(explain(screens[0], false).contains("no bound: 9309 additions"));
}

/// A bound is that of `render`, or there is none where `render` has none or one of the frame.
#[test]
fn bounds_hold_for_what_the_machine_stores() {
    let folder = tempfile::tempdir().unwrap();
    let triangle = |rules: &str, kt: &str| {
        format!("size 32 32\n{rules}T 1 1 .5 1 0 .3 {kt}  31 1 .2 0 1 .3 {kt}  1 31 .5 .5 .7 0 {kt}\n")
    };
    let map = "shadow 16 0.01 0.9 .5 0 0 0  0 .5 0 0  0 0 1 0  0 0 0 1\nL 0 0 0.1  9 0 0.1  0 9 0.1\n";
    let files = [
        ("a.tri", triangle("", "0")),
        ("b.tri", triangle("blend 1\n", "0.3")),
        ("s.tri", triangle(map, "0")),
        ("p.tri", triangle("", "0").replace("T ", "P 3 ")),
    ];
    for (name, text) in &files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let perspective = "shadow.light=perspective";
    let cases: [(&str, &str, &[&str], Result<f64, &str>); 8] = [
        ("a.tri", "default", &[], Ok(0.0)),
        ("a.tri", "default", &["dither.bits=4"], Ok(17.0)),
        ("s.tri", "default", &[perspective, "shadow.size=16", "shadow.gate=scale"], Ok(1.0)),
        ("sphere", "default", &["shade.kind=phong"], Err("terms and tables")),
        ("b.tri", "default", &["blend.kind=constant"], Err("layers")),
        ("a.tri", "default", &["shadow.transmits=yes", "shadow.gate=scale", perspective], Err("layers")),
        ("p.tri", "polygon", &[], Err("lie from a plane")),
        ("p.tri", "bilinear", &[], Err("edges of a frame")),
    ];
    for (input, preset, settings, expected) in cases {
        let screen = ["screen.width=32", "screen.height=32"];
        let settings = [&screen[..], settings].concat();
        let sets: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
        let run = |words: &[&str]| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
            command.current_dir(folder.path()).args(words).args(["--machine", preset, "--json"]).args(&sets);
            let output = command.output().unwrap();
            let value: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| {
                panic!("{words:?} {sets:?}: {}", String::from_utf8_lossy(&output.stderr))
            });
            value
        };
        let proof = run(&["config", "explain"])["precision"]["color"].clone();
        let of_key = run(&["config", "explain", "dither.bits"]);
        let values = of_key["values"].as_array().unwrap();
        let own = values.iter().find(|value| value["asked_for"] == true).unwrap();
        assert_eq!(own["bounds"][1], proof["bound"], "{own}");
        assert_eq!(own["no_bounds"][1], proof["no_bound"], "{own}");
        let mut words = vec!["render", input];
        if preset == "default" && input == "sphere" {
            words.extend(["--shading", "phong"]);
        }
        let comparison = run(&words)["comparison"].clone();
        let error = comparison["color_error"].as_f64().unwrap();
        match expected {
            Ok(behind) => {
                let (bound, of_frame) =
                    (proof["bound"].as_f64().unwrap(), comparison["color_bound"].as_f64().unwrap());
                assert!(error <= of_frame && of_frame <= bound, "{input}: {error} {of_frame} {bound}");
                let plain = precision(&screen)["color"]["bound"].as_f64().unwrap();
                assert_eq!(bound, plain + behind, "{input}");
                assert_eq!(proof["needed_fraction_bits"].is_null(), behind > 0.0, "{proof}");
            }
            Err(why) => {
                assert!(proof["bound"].is_null() && proof["needed_fraction_bits"].is_null(), "{proof}");
                for told in ["no_bound", "out_of_reach"] {
                    assert!(proof[told].as_str().unwrap().contains(why), "{proof}");
                }
            }
        }
    }
    println!("checked {} machines", cases.len());
}

#[test]
fn where_no_bits_will_do_it_says_why() {
    let told = precision(&["formats.z_vertex=0"]);
    assert_eq!(
        (&told["z"]["needed_fraction_bits"], &told["color"]["needed_fraction_bits"]),
        (&Value::Null, &14.into())
    );
    assert!(told["z"]["out_of_reach"].as_str().unwrap().contains("raise formats.z_vertex"), "{told}");
    let told = precision(&["edge.fill=textbook", "screen.subpixel_bits=0"]);
    for channel in ["z", "color"] {
        assert_eq!(
            (&told[channel]["bound"], &told[channel]["needed_fraction_bits"]),
            (&Value::Null, &Value::Null)
        );
        assert!(told[channel]["no_bound"].as_str().unwrap().contains("edge.fill = textbook"), "{told}");
    }
}

/// The triangle that is said to break one bit fewer does, drawn as it is printed.
#[test]
fn the_witness_wraps_when_it_is_drawn_and_not_with_the_bits_needed() {
    let told = precision(&[]);
    let witness = told["color"]["one_bit_fewer"].as_str().unwrap();
    let mut triangle = "size 640 480\nT".to_owned();
    let corners: Vec<&str> = witness.split('(').skip(1).map(|rest| rest.split_once(')').unwrap().0).collect();
    assert_eq!(corners.len(), 3, "{witness}");
    for corner in corners {
        let numbers: Vec<f64> = corner.split([',', ':']).map(|n| n.trim().parse().unwrap()).collect();
        triangle += &format!("  {} {} .5 {} 0 0 0", numbers[0], numbers[1], numbers[2] / 255.0);
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("witness.tri"), triangle + "\n").unwrap();
    let mut seen = Vec::new();
    for bits in [13, 14] {
        let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
            .current_dir(folder.path())
            .args(["render", "witness.tri", "--json", "--set", &format!("formats.color_fraction={bits}")])
            .output()
            .unwrap();
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        seen.push((output.status.code(), report["comparison"]["wrapped"].as_u64().unwrap() > 0));
    }
    assert_eq!(seen, [(Some(1), true), (Some(0), false)]);
}

/// Each value of a key with what `config check`, the explanation of that machine and `estimate` say of it.
#[test]
fn a_key_is_explained_by_the_machines_of_its_values() {
    let run = |words: &[&str]| {
        let output =
            Command::new(env!("CARGO_BIN_EXE_edgewalk")).args(words).output().expect("the program runs");
        // An error stands on the other stream.
        String::from_utf8([output.stdout, output.stderr].concat()).expect("text")
    };
    let json = |words: &[&str]| -> Value { serde_json::from_str(&run(words)).expect("one JSON value") };
    let mut checked = 0;
    for (key, values, own) in [
        ("memory.hazard", &["drain", "interlock", "forward"][..], "drain"),
        ("formats.z_fraction", &["0", "5", "6", "7", "24"], "6"),
        ("interpolator.adders", &["1", "2", "3", "4", "8"], "3"),
        ("setup.lanes", &["1", "2", "4"], "2"),
    ] {
        let set = format!("{key}={own}");
        let asked = ["config", "explain", key, "--set", &set];
        let told = json(&[&asked[..], &["--json"]].concat());
        let page = run(&asked);
        let told = told["values"].as_array().expect("values");
        assert_eq!(told.iter().map(|of| of["value"].as_str().expect("a value")).collect::<Vec<_>>(), values);
        for (of, value) in told.iter().zip(values) {
            let set = format!("{key}={value}");
            let line = page
                .lines()
                .find(|line| line.get(2..).is_some_and(|line| line.starts_with(value)))
                .expect(value);
            assert_eq!(of["asked_for"] == true, *value == own, "{of}");
            assert_eq!(line.starts_with('*'), *value == own, "{line}");
            let check = json(&["config", "check", "--json", "--set", &set]);
            if check["ok"] != true {
                let why = of["refused"].as_str().expect("a reason");
                assert!(check["error"].as_str().is_some_and(|error| error.ends_with(why)), "{check}: {why}");
                assert!(line.ends_with(why), "{line}");
                continue;
            }
            let whole = json(&["config", "explain", "--json", "--set", &set]);
            assert_eq!(of["bounds"][0], whole["precision"]["z"]["bound"], "{set}");
            assert_eq!(of["bounds"][1], whole["precision"]["color"]["bound"], "{set}");
            let text = run(&["config", "explain", "--set", &set]);
            assert!(text.contains(&format!("at most {} clocks a triangle", of["setup_clocks"])), "{of}");
            assert!(text.contains(&format!("1/{} pixel a clock", of["clocks_per_pixel"])), "{of}");
            let estimate = json(&["estimate", &format!("default,{set}"), "--json"]);
            let estimate = &estimate["machines"][0];
            assert_eq!(of["estimate"]["est_ff"], estimate["est_ff"], "{estimate}");
            assert_eq!(of["estimate"]["est_lut4"]["value"], estimate["est_lut4"]["value"], "{estimate}");
            let figures: Vec<&str> = line.split_whitespace().collect();
            assert!(figures.contains(&estimate["est_ff"].to_string().as_str()), "{line}");
            checked += 1;
        }
    }
    assert_eq!(checked, 14);
}

/// What `config explain edge.kind` says of a machine.
fn of_edges(setting: &str, json: bool) -> String {
    let words = ["config", "explain", "edge.kind", "--set", setting, "--json"];
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk")).args(&words[..5 + usize::from(json)]).output();
    String::from_utf8(output.expect("the program runs").stdout).expect("text")
}

/// A triangle that breaks a bit fewer is one that the machine takes: on its places, in its guard band. Beside a slope edge
/// pixels are drawn of which nothing is proved.
#[test]
fn what_a_machine_cannot_take_is_not_named() {
    for (setting, proved, holds) in [
        (
            "edge.kind=slope",
            "at most 0.8154 LSB, proved at pixels inside the triangle\n",
            "pixels inside the triangle",
        ),
        ("screen.subpixel_bits=4", "at most 0.8154 LSB, proved\n", "every pixel"),
    ] {
        assert_eq!(precision(&[setting])["holds"], holds);
        assert_eq!(of_edges(setting, true).matches(holds).count(), 1, "{setting}");
        assert!(
            of_edges(setting, false).contains("  bounds of slope edges hold at pixels inside the triangle\n")
        );
        let page = explain(&[setting], false);
        assert_eq!(
            (page.matches(proved).count(), page.matches("bits, triangle (").count()),
            (2, 0),
            "{setting}\n{page}"
        );
    }
}
