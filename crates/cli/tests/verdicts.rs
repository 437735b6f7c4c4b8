//! How the program ends, seen from outside: a picture that is wrong, one that wraps, and one with nothing on it.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use serde_json::Value;
use std::fs::write;
use std::path::Path;
use std::process::{Command, Output};

/// 590 x 450 pixels; red grows by a little more than half a unit of 4 fraction bits a pixel, up to full at the right.
const WIDE: &str = "size 640 480\nT 10 10 .2 .927 1 1 0  600 235 .9 1 1 1 0  10 460 .5 .927 1 1 0\n";

fn edgewalk(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_edgewalk")).current_dir(folder).args(arguments).output().unwrap()
}

/// Renders a triangle file with settings; returns the exit code, the report as JSON, and as text.
fn render(text: &str, settings: &[&str]) -> (Option<i32>, Value, String) {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path().join("a.tri"), text).unwrap();
    let size: Vec<&str> = text.split_whitespace().skip(1).take(2).collect();
    let screen = [format!("screen.width={}", size[0]), format!("screen.height={}", size[1])];
    let mut arguments = vec!["render", "a.tri", "--json", "--out", "out"];
    for setting in screen.iter().map(String::as_str).chain(settings.iter().copied()) {
        arguments.extend(["--set", setting]);
    }
    let output = edgewalk(folder.path(), &arguments);
    let json = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&output.stderr)));
    (output.status.code(), json, std::fs::read_to_string(folder.path().join("out/report.txt")).unwrap())
}

#[test]
fn a_wide_triangle_wraps_with_four_fraction_bits_and_not_with_fourteen() {
    let (code, report, text) = render(WIDE, &["formats.color_fraction=4"]);
    let c = &report["comparison"];
    assert_eq!(code, Some(1), "{text}");
    assert!(c["wrapped"].as_u64() > Some(20_000), "{c}");
    assert!(c["color_error"].as_f64() > Some(200.0), "{c}");
    assert_eq!(c["color_bound"], Value::Null, "{c}");
    assert!(c["color_no_bound"].as_str().unwrap().contains("9309 additions may err by 290.9375 LSB"), "{c}");
    assert!(c["z_bound"].as_f64() < Some(1.0) && c.get("z_no_bound").is_none(), "{c}");
    let wrapped = format!("pixels with a value that wrapped {}\n", c["wrapped"]);
    assert!(text.contains("no bound: 9309 additions") && text.contains(&wrapped), "{text}");

    let (code, report, text) = render(WIDE, &[]);
    let c = &report["comparison"];
    assert_eq!((code, &c["wrapped"]), (Some(0), &0.into()), "{text}");
    assert_eq!((&c["covered"], &c["compared"]), (&132_750.into(), &132_750.into()));
    let bound = c["color_bound"].as_f64().unwrap();
    assert!(c["color_error"].as_f64() > Some(0.5) && c["color_error"].as_f64() < Some(bound), "{c}");
    assert!(!text.contains("no bound"), "{text}");
}

/// Slope edges err: the report says by how much beside the mismatches, and the verdict counts these.
#[test]
fn mismatches_of_slope_edges_are_explained() {
    let lines = |settings: &[&str]| {
        let (code, report, text) =
            render("size 64 48\nT 3 2 0 1 0 0 0  60 9 0 0 1 0 0  11 47 1 0 0 1 0\n", settings);
        let mismatches = report["comparison"]["coverage_mismatches"].as_u64().unwrap();
        let told = text
            .contains("slope edges of 2 fraction bits err by at most 1/8 px a line: a centre within that");
        (code, mismatches > 0, told)
    };
    assert_eq!(lines(&["edge.kind=slope", "edge.fraction_bits=2"]), (Some(1), true, true));
    assert_eq!(lines(&["edge.kind=slope", "edge.fraction_bits=30"]), (Some(0), false, false));
    assert_eq!(lines(&["edge.fraction_bits=2"]), (Some(0), false, false));
}

#[test]
fn an_error_over_one_lsb_without_a_bound_is_a_mismatch() {
    let folder = tempfile::tempdir().unwrap();
    let settings =
        ["color_fraction", "color_vertex", "z_fraction", "z_vertex"].map(|key| format!("formats.{key}=0"));
    let mut arguments = vec!["render", "torus-knot", "--json", "--out", "out"];
    for setting in &settings {
        arguments.extend(["--set", setting]);
    }
    let output = edgewalk(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(1));
    let c = &serde_json::from_slice::<Value>(&output.stdout).unwrap()["comparison"];
    assert_eq!((&c["z_bound"], &c["color_bound"], &c["wrapped"]), (&Value::Null, &Value::Null, &0.into()));
    assert!(c["color_error"].as_f64() > Some(8.0), "{c}");
}

/// Two triangles over each other, so that fragments, writes and covered pixels are three numbers.
const TWO: &str = "size 16 12\nmode flat\nclear .25 .5 .75\n\
                   T 0 0 .5 1 0 0 0  16 0 .5 0 1 0 0  0 12 .5 0 0 1 0\n\
                   T 0 0 .75 .2 .4 .6 0  8 0 .75 1 1 1 0  0 6 .75 0 0 0 0\n";

#[test]
fn a_flat_frame_on_a_coloured_ground_is_counted_right() {
    let (code, report, text) = render(TWO, &[]);
    assert_eq!(code, Some(0), "{text}");
    // Half of 16 x 12, and half of 8 x 6 that is hidden: no centre lies on the slanted edges.
    assert_eq!((&report["fragments"], &report["writes"]), (&120.into(), &96.into()));
    assert_eq!(report["odd_pixels"], 96 - 24, "where both lie the count is even");
    let cycles = report["cycles"]["total"].as_f64().unwrap();
    let rate = report["cycles"]["pixels_per_clock"].as_f64().unwrap();
    assert!((rate - 120.0 / cycles).abs() < 1e-12, "{rate}");
    assert!(text.contains("fragments 120, writes 96\ncompared 96 / 96 covered pixels\n"), "{text}");
}

/// The nearer triangle comes last, so a depth buffer writes twice where scan lines write once.
#[test]
fn scan_lines_pass_however_often_a_buffer_writes() {
    let folder = tempfile::tempdir().unwrap();
    let over = TWO.replace(" .75 ", " .25 ");
    write(folder.path().join("a.tri"), over).unwrap();
    let mut writes = Vec::new();
    for engine in ["scanline", "fast"] {
        let output = edgewalk(
            folder.path(),
            &["render", "a.tri", "--engine", engine, "--adapt", "--json", "--out", "o"],
        );
        assert_eq!(output.status.code(), Some(0), "{engine}: {}", String::from_utf8_lossy(&output.stdout));
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(report["comparison"]["compared"], 96, "{engine}");
        writes.push(report["writes"].as_u64().unwrap());
    }
    assert_eq!(writes, [96, 120]);
}

#[test]
fn nothing_drawn_is_exit_code_2_with_its_reason_even_if_quiet() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path().join("empty.tri"), "size 8 8\n").unwrap();
    write(
        folder.path().join("beside.tri"),
        "size 8 8\nT 20 20 0 1 1 1 0  30 20 0 1 1 1 0  20 30 0 1 1 1 0\n",
    )
    .unwrap();
    // The camera looks away.
    let away = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 9]\n\n[[object]]\nbuiltin = \"sphere\"\n";
    write(folder.path().join("away.toml"), away).unwrap();
    let mut checked = 0;
    for (file, why) in [
        ("empty.tri", "it has no triangle in view"),
        ("beside.tri", "none of its 1 triangles or polygons covers a pixel of the 8x8 screen"),
        ("away.toml", "it has no triangle in view"),
    ] {
        let small = ["--set", "screen.width=8", "--set", "screen.height=8", "-q"];
        let mut commands: Vec<Vec<&str>> = vec![
            vec!["render", file, "--out", "out"],
            vec!["render", file, "--engine", "model", "--out", "out"],
            vec!["render", file, "--engine", "golden", "--out", "out"],
            vec!["render", file, "--engine", "golden", "--shading", "wireframe", "--out", "out"],
            vec!["demo", file, "--out", "out"],
            vec!["explain", file, "3", "3"],
            vec!["bench", file, "--engine", "fast"],
        ];
        if file.ends_with(".tri") {
            for engine in ["golden", "fast", "model", "rtl"] {
                commands.push(vec!["raster", file, "--engine", engine, "--out", "out"]);
            }
        }
        for command in commands {
            let output = edgewalk(folder.path(), &[&command[..], &small[..]].concat());
            let message = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{command:?}: {message}");
            let expected = format!("{file}: nothing was drawn: {why}");
            assert!(message.contains(&expected), "{command:?}: {message}");
            assert!(output.stdout.is_empty(), "{command:?}");
            checked += 1;
        }
    }
    println!("checked {checked} / 29 commands");
    assert_eq!(checked, 3 * 7 + 2 * 4);
}

/// A pass without colours stores depths, which are compared; the colours stay those of the empty screen.
#[test]
fn depths_without_colours_are_compared() {
    let text = "size 8 8\ncolour_write 0\nT 0 0 0.5 1 0 0 0  8 0 0.5 1 0 0 0  0 8 0.3 1 0 0 0\n";
    let depths = "formats.z_fraction=14";
    let (code, report, text) = render(text, &["blend.kind=constant", depths]);
    let c = &report["comparison"];
    assert_eq!((code, &c["background_wrong"]), (Some(0), &0.into()), "{text}");
    // 28 centres lie in it, and none of them has a colour.
    assert_eq!(c["compared"], 28, "{c}");
    assert!(c["z_error"].as_f64() > Some(0.0), "{c}");
}
