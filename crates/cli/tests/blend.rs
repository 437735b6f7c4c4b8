//! Blending and rules that change, through the program: beside golden within the running bound, every engine alike, and
//! what is refused with which words.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{PASSES, edgewalk, npy, run};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;

/// A machine with a k_t for every pixel, one pixel a clock.
const INTERPOLATED: [&str; 4] = ["--set", "blend.kind=interpolated", "--set", "interpolator.adders=5"];

/// Runs a command that has to succeed, and gives its report.
fn report(folder: &Path, arguments: &[&str]) -> Value {
    let output = edgewalk(folder, arguments).arg("--json").output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Two triangles over a screen, random colours and k_t at the corners.
fn layer(text: &mut String, [w, h]: [u32; 2], kt: impl Fn(&mut Pcg64Mcg) -> f64, random: &mut Pcg64Mcg) {
    let corner = |x: u32, y: u32, random: &mut Pcg64Mcg| {
        let [r, g, b]: [f64; 3] = random.random();
        format!("{x} {y} 0.5 {r} {g} {b} {}", kt(random))
    };
    let [a, b, c, d] = [(0, 0), (w, 0), (0, h), (w, h)].map(|(x, y)| corner(x, y, random));
    let _ = writeln!(text, "T {a} {b} {c}\nT {b} {d} {c}");
}

/// 100,000 pixels under 30 layers each, colours and k_t interpolated: within the bound of its layers at every pixel.
#[test]
fn thirty_layers_over_100_000_pixels_lie_within_the_running_bound() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut reached = 0.0f64;
    for (name, least) in [("any", 0.0), ("near", 0.9)] {
        let mut text = "size 400 250\ndepth off\nblend 1\nclear 0.2 0.4 0.6\n".to_owned();
        for _ in 0..30 {
            layer(&mut text, [400, 250], |random| random.random_range(least..=1.0), &mut random);
        }
        std::fs::write(folder.path().join("stack.tri"), text).unwrap();
        let arguments = ["render", "stack.tri", "--engine", "model", "--out", "out"];
        let screen = ["--set", "screen.width=400", "--set", "screen.height=250"];
        let report = report(folder.path(), &[&arguments[..], &screen, &INTERPOLATED].concat());
        let blended = &report["comparison"]["blended"];
        println!("{name}: {blended}");
        assert_eq!((&blended["pixels"], &blended["layers"]), (&100_000.into(), &30.into()));
        assert_eq!((&blended["beyond"], &report["comparison"]["order_wrong"]), (&0.into(), &0.into()));
        reached = reached.max(blended["of_bound"].as_f64().unwrap());
    }
    assert!(reached > 0.4, "the bound is far from what happens: {reached}");
}

/// The example of `docs/triangle_file.md`, and the same with everything that may change.
#[test]
fn a_frame_of_passes_is_the_same_in_every_engine() {
    let folder = tempfile::tempdir().unwrap();
    let more = format!(
        "{PASSES}clear_depth\nblend add\ndepth_write 1\nT 0 0 0.9 0.5 0.25 0 1  40 0 0.9 0.5 0.25 0 1  0 40 0.9 0.5 0.25 0 1\n\
         depth greater\nblend 0\nP 4 2 2 0.95 0 1 0 0  9 2 0.95 0 1 0 0  9 9 0.95 0 1 0 0  2 9 0.95 0 1 0 0\n"
    );
    std::fs::write(folder.path().join("passes.tri"), &more).unwrap();
    let set = ["--set", "blend.kind=constant"];
    let mut pictures = Vec::new();
    for engine in ["golden", "model", "fast"] {
        let arguments = ["raster", "passes.tri", "--engine", engine, "--out", engine];
        let report = report(folder.path(), &[&arguments[..], &set].concat());
        let file = |name: &str| npy(&folder.path().join(engine).join(name)).2;
        let rgb: Vec<f64> = file("rgb.npy")
            .chunks_exact(8)
            .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()))
            .collect();
        pictures.push((rgb, ["coverage.npy", "writes.npy", "id.npy"].map(file)));
        if engine != "golden" {
            let passes: Vec<u64> =
                report["cycles"]["passes"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
            assert_eq!((passes.len(), passes.iter().sum()), (5, report["cycles"]["total"].as_u64().unwrap()));
        }
        if engine == "fast" {
            let why = "ticked: the rules change between triangles";
            assert_eq!(report["cycles"]["path"], why);
        }
    }
    let [(golden, rest), (model, own), (fast, same)] = &pictures[..] else { panic!("three") };
    assert_eq!((model, own), (fast, same));
    assert_eq!(rest, own, "coverage, writes, ids");
    let at = |x: usize, y: usize| [0, 1, 2].map(|c| golden[3 * (64 * y + x) + c]);
    // Glass over red, light added; the polygon, which is farther than what was cleared anew; glass over red alone.
    assert_eq!((at(20, 2), at(5, 5), at(50, 2)), ([1.0, 0.25, 0.5], [0.0, 1.0, 0.0], [0.5, 0.0, 0.5]));
    let worst = golden.iter().zip(model).map(|(a, b)| 255.0 * (a - b).abs()).fold(0.0, f64::max);
    assert!(worst <= 1.5, "{worst} LSB");
    // And beside golden, with its bound.
    let screen = ["--set", "screen.width=64", "--set", "screen.height=64"];
    let arguments = ["render", "passes.tri", "--out", "r"];
    let report = report(folder.path(), &[&arguments[..], &set, &screen].concat());
    assert_eq!(report["comparison"]["blended"]["beyond"], 0);
    assert!(report["comparison"]["blended"]["pixels"].as_u64().unwrap() > 1000);
}

/// Every layer of a pixel, beside the machine's.
#[test]
fn explain_shows_the_layers_of_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("passes.tri"), PASSES).unwrap();
    let screen = ["--set", "screen.width=64", "--set", "screen.height=64", "--set", "blend.kind=constant"];
    let arguments = [&["explain", "passes.tri", "9", "7"][..], &screen].concat();
    let output = edgewalk(folder.path(), &arguments).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    for line in [
        "layer 0: triangle 1: 1.000 0.000 0.000",
        "    golden 255.000 0.000 0.000 LSB of 8 bits, machine 255 0 0, error 0.0000, bound 0.7851",
        "layer 1: triangle 2: (1 - 0.5000) * (0.000 0.000 1.000) + 0.5000 * (1.000 0.000 0.000)",
        "    golden 127.500 0.000 127.500 LSB of 8 bits, machine 128 0 128, error 0.5000, bound 1.7831",
    ] {
        assert!(text.contains(line), "{text}\nlacks {line}");
    }
}

/// A layer whose sums may wrap has no bound. A fragment may err by 1 LSB, as without layers.
#[test]
fn layers_of_sums_that_may_wrap_have_no_bound() {
    let folder = tempfile::tempdir().unwrap();
    let text = "size 640 4\nblend 1\nT 0 0 0.5 1 0 0 0   640 0 0.5 0 1 0.3 0   0 4 0.5 0 0.2 1 0\n";
    std::fs::write(folder.path().join("a.tri"), text).unwrap();
    let of = |arguments: &[&str]| {
        let all = [arguments, &["--adapt", "--set", "formats.color_fraction=5"]].concat();
        let output = edgewalk(folder.path(), &all).output().unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    let why = "no bound: 8833 additions may err by 138.03125 LSB";
    let (code, told) = of(&["explain", "a.tri", "500", "0"]);
    let layer = told.lines().find(|line| line.starts_with("    golden ")).unwrap();
    assert_eq!((code, layer.contains(&format!("error 4.2070, {why}"))), (Some(0), true), "{layer}");
    let (code, told) = of(&["render", "a.tri", "--out", "r"]);
    let line = told.lines().find(|line| line.starts_with("blended: ")).unwrap();
    assert!(
        line.contains(why) && line.contains("; with 1 LSB a fragment up to 1.9553 LSB are allowed"),
        "{line}"
    );
    let (same, told) = of(&["render", "a.tri", "--out", "r", "--json"]);
    let report: Value = serde_json::from_str(&told).unwrap();
    let blended = &report["comparison"]["blended"];
    assert_eq!((&blended["bound"], &blended["beyond"]), (&Value::Null, &604.into()), "{blended}");
    assert!(blended["no_bound"].as_str().unwrap().starts_with(&why[10..]), "{blended}");
    // As without layers.
    std::fs::write(folder.path().join("a.tri"), text.replace("blend 1\n", "")).unwrap();
    let (plain, _) = of(&["render", "a.tri", "--out", "r"]);
    assert_eq!([code, same, plain], [Some(1); 3]);
}

#[test]
fn a_scene_of_glass_is_sorted_and_blended_by_the_machine() {
    let folder = tempfile::tempdir().unwrap();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scenes/glass.toml");
    let small = ["--set", "screen.width=320", "--set", "screen.height=240", "--set", "blend.kind=constant"];
    let report = report(folder.path(), &[&["render", scene, "--out", "o"][..], &small].concat());
    let comparison = &report["comparison"];
    println!("{comparison}");
    assert_eq!(comparison["coverage_mismatches"], 0);
    assert_eq!(comparison["blended"]["beyond"], 0);
    assert!(comparison["blended"]["layers"].as_u64() >= Some(3), "a pane over a pane over the floor");
    let text = std::fs::read_to_string(folder.path().join("o/report.txt")).unwrap();
    assert!(text.contains("transparent triangles, drawn last, from back to front: 4"), "{text}");
    // A machine without the unit says so.
    let (code, error) = run(folder.path(), &["render", scene, "--out", "o"]);
    assert_eq!(code, Some(2), "{error}");
    assert!(error.contains("the machine has no BLEND; give --set blend.kind="), "{error}");
}

#[test]
fn what_the_machine_cannot_do_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let triangle = "T 0 0 0.5 1 0 0 0.5  60 0 0.5 0 1 0 0.25  0 60 0.5 0 0 1 0.5\n";
    let file = |rules: &str| format!("size 64 64\n{rules}\n{triangle}");
    let two = format!("{}depth equal\n{triangle}", file(""));
    let constant = ["--set", "blend.kind=constant"];
    let cases: [(&str, &str, &[&str], &[&str]); 14] = [
        (&file("blend 1"), "raster", &[], &["blend 1", "no BLEND", "blend.kind=interpolated"]),
        (&file("blend add"), "raster", &[], &["blend add", "no BLEND"]),
        (&file("colour_write 0"), "raster", &[], &["colour_write 0", "blend.kind=constant"]),
        (
            &file("blend 1"),
            "raster",
            &constant,
            &["triangle 0 (counted from 0), vertex 2 (from 1)", "kt = 0.25", "blend.kind=interpolated"],
        ),
        (&file("blend 2"), "raster", &constant, &["blend: `2`", "0 1 add"]),
        (&file("blend 1").replace("0.25", "1.25"), "raster", &constant, &["vertex 2 kt", "`1.25`"]),
        (
            &two,
            "trace",
            &[],
            &["2 passes", "raster, render, explain, replay, sweep, compare, size, judge and triangles"],
        ),
        (
            &file(""),
            "raster",
            &["--set", "blend.kind=constnat"],
            &["blend.kind = constnat", "nearest: constant"],
        ),
        (
            &file(""),
            "raster",
            &["--set", "blend.kt_bits=13"],
            &["blend.kt_bits = 13", "4 to 12", "nearest: 12"],
        ),
        (&file(""), "raster", &["--set", "blend.multipliers=2"], &["blend.multipliers = 2", "0, 1, 3"]),
        (&file(""), "raster", &["--set", "blend.stages=3"], &["blend.stages = 3", "nearest: 2"]),
        (&file(""), "raster", &["--set", "fifo.blend=0"], &["fifo.blend = 0", "nearest: 1"]),
        (
            &file(""),
            "raster",
            &["--set", "blend.kind=interpolated", "--set", "channels.extra=4"],
            &["channels.extra = 4 cannot be built", "9 channels, 8 is the most", "try channels.extra = 3"],
        ),
        (
            &file(""),
            "raster",
            &["--set", "blend.kind=interpolated", "--set", "blend.kt_fraction=2"],
            &["blend.kt_vertex = 4 cannot be built", "try blend.kt_vertex = 2"],
        ),
    ];
    for (text, command, settings, words) in cases {
        std::fs::write(folder.path().join("a.tri"), text).unwrap();
        let screen = ["--set", "screen.width=64", "--set", "screen.height=64"];
        let (screen, out) = if command == "raster" { (&[][..], "out") } else { (&screen[..], "out.vcd") };
        let arguments = [&[command, "a.tri", "--out", out][..], settings, screen].concat();
        let (code, error) = run(folder.path(), &arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {error} lacks {word}");
        }
    }
}

/// A triangle's place is counted among all primitives: behind a polygon its own k_t's ask for BLEND by pixel.
#[test]
fn uneven_kt_behind_a_polygon_wants_blend_by_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let polygon = "P 3 1 1 0.5 1 0 0 0   20 1 0.5 1 0 0 0   1 14 0.5 1 0 0 0";
    let triangle = "T 1 1 0.5 0 0 1 0   20 1 0.5 0 0 1 1   1 14 0.5 0 0 1 0";
    std::fs::write(folder.path().join("a.tri"), format!("size 24 16\n{polygon}\nblend 1\n{triangle}\n"))
        .unwrap();
    let (code, error) = run(folder.path(), &["render", "a.tri", "--machine", "polygon"]);
    assert_eq!(code, Some(2), "{error}");
    assert!(error.contains("--set blend.kind=interpolated"), "{error}");
}

/// Renders a file; the exit code, what the report says of the comparison, and standard error.
fn compared(text: &str, settings: &[&str]) -> (Option<i32>, Value, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), text).unwrap();
    let mut command = edgewalk(folder.path(), &["render", "a.tri", "--adapt", "--out", "r", "--json"]);
    settings.iter().for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
    (output.status.code(), report["comparison"].clone(), String::from_utf8(output.stderr).unwrap())
}

/// Without a bound of the depths no depth test is open: every pixel is compared, and colours far off are told.
#[test]
fn layers_without_a_bound_are_compared() {
    let text = "size 64 48\n\
        T 1 1 0.2 0.1 0.9 0.2 0  60 9 0.5 0.9 0.1 0.5 0  5 45 0.9 0.5 0.5 0.9 0\ndepth lequal\n\
        T 2 40 0.3 0.6 0.3 0.2 0  50 2 0.6 0.2 0.7 0.5 0  60 45 0.1 0.8 0.1 0.4 0\n";
    let coarse =
        ["color_fraction", "color_vertex", "z_fraction", "z_vertex"].map(|key| format!("formats.{key}=0"));
    let (code, c, error) = compared(text, &coarse.each_ref().map(String::as_str));
    assert_eq!((code, &c["order_undecided"]), (Some(1), &0.into()), "{c} {error}");
    assert!(c["z_bound"].is_null() && c["color_error"].as_f64() > Some(2.0), "{c}");
    let wrong = c["order_wrong"].as_u64().unwrap();
    assert_eq!(c["blended"]["pixels"].as_u64().unwrap() + wrong, c["covered"].as_u64().unwrap(), "{c}");
}

/// A triangle at the cleared depth: every depth test is open, and what is open counts as nothing compared.
#[test]
fn open_layers_alone_are_nothing_compared() {
    let open = "depth lequal\nblend 1\nT 1 1 1 1 0 0 0.5  60 9 1 0 1 0 0.5  5 45 1 0 0 1 0.5\n";
    let (code, c, error) = compared(&format!("size 64 48\n{open}"), &[]);
    assert_eq!((code, &c["compared"], &c["order_undecided"]), (Some(2), &0.into(), &c["covered"]), "{c}");
    assert!(
        error.contains("no pixel was compared: at each covered pixel two depths are nearer than their bound"),
        "{error}"
    );
    // Beside one that is sure the open pixels are left out.
    let sure = "T 40 30 0.5 1 0 0 0.5  60 30 0.5 0 1 0 0.5  40 45 0.5 0 0 1 0.5\n";
    let (code, c, error) = compared(&format!("size 64 48\n{open}{sure}"), &[]);
    let number = |name: &str| c[name].as_u64().unwrap();
    assert_eq!((code, number("compared") > 0), (Some(0), true), "{c} {error}");
    assert_eq!(number("compared") + number("order_undecided"), number("covered"), "{c}");
}

/// The bound of one fragment is no bound of layers: none is printed of them, and a sweep calls no machine beyond it.
#[test]
fn layers_have_no_bound_of_a_single_fragment() {
    let folder = tempfile::tempdir().unwrap();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/study/sphere-glass.toml");
    let small = ["--set", "screen.width=80", "--set", "screen.height=60"];
    let layers = ["render", scene, "--set", "blend.kind=interpolated", "--out", "r"];
    let c = &report(folder.path(), &[&layers[..], &small].concat())["comparison"];
    assert!(c["color_bound_for_input"].is_null() && c["z_bound_for_input"].is_number(), "{c}");
    assert!(c["color_error"].as_f64() > Some(1.0), "{c}");
    let points = ["sweep", scene, "--vary", "blend.kind=constant,interpolated", "--out", "s"];
    let (code, error) = run(folder.path(), &[&points[..], &small].concat());
    assert_eq!(code, Some(0), "{error}");
    // A bound that is asked for rules them out.
    let points = ["sweep", scene, "--vary", "blend.kind=constant,interpolated", "--bound", "1", "--out", "b"];
    _ = run(folder.path(), &[&points[..], &small].concat());
    let rows = std::fs::read_to_string(folder.path().join("b/runs.jsonl")).unwrap();
    assert_eq!(rows.matches("no bound is proved").count(), 2, "{rows}");
}
