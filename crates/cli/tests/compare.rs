//! `edgewalk compare` as a user runs it.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{TRIANGLE, colors, edgewalk, names, npy, report, run};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;

/// What JSON says; the exit code is 1 where a picture differs from golden's.
fn compare(folder: &Path, arguments: &[&str]) -> Value {
    let output = edgewalk(folder, &[&["compare"], arguments, &["--json"]].concat()).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
    let right = ["a", "b"].iter().all(|side| told[side]["verdict"] == "pass");
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(if right { 0 } else { 1 }), "{error}");
    told
}

/// A picture that errs beyond its bounds, or of which no pixel can be compared, is no pass: `render` ends alike.
#[test]
fn verdicts_are_those_of_render() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), CROSSED).unwrap();
    std::fs::write(at.join("open.tri"), OPEN).unwrap();
    let blend = "default,blend.kind=constant";
    for (machine, changed, input, verdicts) in [
        ("default", "edge.kind=slope,edge.fraction_bits=4", "a.tri", ["pass", "mismatch"]),
        ("default", "interpolator.adders=1", "a.tri", ["pass", "pass"]),
        (blend, "interpolator.adders=1", "open.tri", ["open", "open"]),
    ] {
        let other = format!("{machine},{changed}");
        let [first, second] = [machine, &other].map(|machine| {
            let set = machine.split(',').skip(1).flat_map(|set| ["--set", set]);
            run(at, &["render", input, "-q"].into_iter().chain(set).collect::<Vec<_>>()).0
        });
        let output = edgewalk(at, &["compare", machine, &other, input]).output().unwrap();
        assert_eq!(output.status.code(), first.max(second), "{machine} {input}");
        let told = std::fs::read(at.join("out/compare/compare.json")).unwrap();
        let told: Value = serde_json::from_slice(&told).unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        for ((side, verdict), line) in ["a", "b"].into_iter().zip(verdicts).zip(text.lines().skip(1)) {
            assert_eq!(told[side]["verdict"], verdict, "{machine} {input}");
            assert!(line.starts_with(&format!("{side}: ")), "{line}");
            assert!(line.ends_with(&format!(", beside golden: {verdict}")), "{line}");
        }
    }
}

/// The command ends as `synth` does where the tools count no machine, and says why.
#[test]
fn tools_that_fail_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let words = ["compare", "small", "small,setup.lanes=1", "a.tri", "--synth", "ice40-hx8k"];
    let words =
        [&words[..], &["--synth-unit", "depth", "--limit", "1", "--cache", "c", "--page", "p.html"]].concat();
    for (work, code, said) in
        [("echo boom; exit 1", 3, "yosys failed:\nboom"), ("sleep 9", 4, "yosys was ended after 1 s")]
    {
        for name in ["yosys", "nextpnr-ice40"] {
            let script = format!("#!/bin/sh\ncase $1 in -V|--version) echo made up;; *) {work};; esac\n");
            std::fs::write(at.join(name), script).unwrap();
            std::fs::set_permissions(at.join(name), std::fs::Permissions::from_mode(0o755)).unwrap();
        }
        let path = format!("{}:{}", at.display(), std::env::var("PATH").unwrap());
        for words in [&words[..], &words[..words.len() - 2]] {
            let output = edgewalk(at, words).env("PATH", &path).output().unwrap();
            let [text, error] = [output.stdout, output.stderr].map(|of| String::from_utf8(of).unwrap());
            assert_eq!(output.status.code(), Some(code), "{error}");
            assert!(text.matches(said).count() == 2 && error.contains(said), "{text}{error}");
        }
        let page = std::fs::read_to_string(at.join("p.html")).unwrap();
        assert_eq!(page.matches(said).count(), 2, "{page}");
    }
}

#[test]
fn what_differs_is_told_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let adders = compare(folder.path(), &["default", "default,interpolator.adders=1", "sphere"]);
    assert_eq!(adders["keys"], json!({ "interpolator.adders": [4, 1] }));
    assert_eq!((&adders["pixels"]["color"], &adders["pixels"]["depth"]), (&0.into(), &0.into()));
    let [a, b] = ["a", "b"].map(|side| &adders[side]["report"]);
    assert_eq!(adders["figures"]["cycles"], json!([a["cycles"]["total"], b["cycles"]["total"]]));
    assert!(a["cycles"]["total"].as_u64() < b["cycles"]["total"].as_u64());
    assert!(adders["figures"]["fragments"].is_null() && adders["figures"]["z error, LSB"].is_null());
    let text = std::fs::read_to_string(folder.path().join("out/compare/compare.txt")).unwrap();
    let keys = text.split("keys").nth(1).unwrap().split("figures that differ").next().unwrap();
    assert!(keys.contains("interpolator.adders") && keys.lines().count() == 2, "{text}");
    assert!(text.contains("cycles: draw") && !text.contains("z error"), "{text}");
    // Each side is what `render` says.
    let rendered = edgewalk(folder.path(), &["render", "sphere", "--json", "--set", "interpolator.adders=1"])
        .output()
        .unwrap();
    assert_eq!(*b, report(&rendered));
    assert_eq!(
        names(&folder.path().join("out/compare")),
        ["a.png", "b.png", "compare.json", "compare.txt", "difference.png"]
    );
    // Word lengths change pixels, and settings of --set hold for both.
    let set = ["--set", "screen.width=160", "--set", "screen.height=120"];
    let bits = compare(
        folder.path(),
        &[&["default", "default,formats.color_fraction=4", "sphere"], &set[..]].concat(),
    );
    assert_eq!(bits["keys"], json!({ "formats.color_fraction": [14, 4] }));
    assert_eq!(bits["pixels"]["all"], 160 * 120);
    assert!(
        bits["pixels"]["color"].as_u64() > Some(10) && bits["pixels"]["depth"] == 0,
        "{}",
        bits["pixels"]
    );
    // Pictures are of 8 bits, so their files have the very difference.
    let [a, b] =
        ["a.png", "b.png"].map(|name| colors(&folder.path().join("out/compare").join(name)).concat());
    let apart = a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
    let largest = bits["pixels"]["largest_color_difference"].as_f64().unwrap();
    assert!(apart > 0 && (largest * 255.0 - f64::from(apart)).abs() < 1e-9, "{apart}: {largest}");
    let same = compare(folder.path(), &["default", "default", "sphere", "--stalls", "dram"]);
    assert_eq!((&same["keys"], &same["figures"]), (&json!({}), &json!({})));
    assert!(
        same["a"]["report"]["cycles"]["by_cause"]["memory"].as_u64() > Some(1000),
        "{}",
        same["a"]["report"]["cycles"]
    );
}

#[test]
fn what_cannot_be_compared_is_said() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, said) in [
        (["default", "default,screen.width=320", "sphere"], "the screens differ, 640x480 and 320x480"),
        (["default", "defalt", "sphere"], "nearest: default"),
        (["default", "default,adders=1", "sphere"], "nearest: interpolator.adders"),
        (["default", "textbook", "nosuch.obj"], "nosuch.obj"),
    ] {
        let (code, error) = run(folder.path(), &[&["compare"], &arguments[..]].concat());
        assert!(code == Some(2) && error.contains(said), "{error}");
    }
    assert!(names(folder.path()).is_empty());
}

/// Three triangles in front of each other, sides neither level nor upright.
const CROSSED: &str = "size 64 48
T 2.3 1.7 0.1 1 0.2 0 0  61.2 3.1 0.5 0 1 0 0  5.9 44.3 0.9 0.1 0 1 0
T 60.1 4.2 0.2 0 0.3 0.9 0  58.7 45.9 0.8 0.6 0.1 0 0  9.4 40.6 0.4 1 1 0.2 0
T 10.5 8.25 0.45 0.3 0.7 0.1 0  50.3 20.9 0.47 0.9 0 0 0  20.2 39.7 0.43 0 0.6 1 0
";
/// Two layers whose depths are nearer than their bound.
pub const OPEN: &str = "size 64 48
blend 1
T 5 5 0.5 1 0 0 0.5  50 8 0.5 0 1 0 0.5  20 40 0.5 0 0 1 0.5
T 5 5 0.5 1 0 0 0.5  50 8 0.50000003 0 1 0 0.5  20 40 0.5 0 0 1 0.5
";
const OTHER: &str = "formats.z_fraction=4,formats.color_fraction=5,edge.kind=slope,edge.fraction_bits=4,interpolator.adders=1,formats.z_bits=16";

/// Where the report of a side has a figure.
fn place(name: &str) -> String {
    let known = BTreeMap::from([
        ("cycles", "/cycles/total"),
        ("pixels a clock", "/cycles/pixels_per_clock"),
        ("fragments", "/fragments"),
        ("writes", "/writes"),
        ("z error, LSB", "/comparison/z_error"),
        ("z bound for input, LSB", "/comparison/z_bound_for_input"),
        ("colour error, LSB", "/comparison/color_error"),
        ("colour bound for input, LSB", "/comparison/color_bound_for_input"),
        ("pixels that wrapped", "/comparison/wrapped"),
        ("setup clocks, mean", "/setup/clocks/mean"),
        ("span FIFO, mean", "/occupancy/span_fifo/mean"),
        ("in flight, mean", "/occupancy/inflight/mean"),
        ("setup lanes, mean", "/occupancy/lanes/mean"),
        ("triangles drawn", "/setup/triangles/drawn"),
    ]);
    match name.strip_prefix("cycles: ") {
        Some(cause) => format!("/cycles/by_cause/{cause}"),
        None => (*known.get(name).unwrap_or_else(|| panic!("{name}"))).to_owned(),
    }
}

/// The columns behind a name in the text: values, and the change where the line has one.
fn line<'t>(text: &'t str, name: &str) -> Vec<&'t str> {
    let found = text.lines().find_map(|line| line.strip_prefix("    ")?.strip_prefix(&format!("{name} ")));
    found.unwrap_or_else(|| panic!("{name} is not in {text}")).split_whitespace().collect()
}

#[test]
fn every_figure_follows_from_arrays_and_reports() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("c.tri"), CROSSED).unwrap();
    let other = format!("default,{OTHER}");
    let told = compare(at, &["default", &other, "c.tri"]);
    let text = std::fs::read_to_string(at.join("out/compare/compare.txt")).unwrap();

    // Pixels, from the arrays that `raster` writes of each machine.
    let arrays = |out: &str, set: &str| {
        let set: Vec<&str> =
            set.split(',').filter(|set| !set.is_empty()).flat_map(|set| ["--set", set]).collect();
        let raster = [&["raster", "c.tri", "--engine", "fast", "--quiet", "--out", out], &set[..]].concat();
        assert_eq!(run(at, &raster), (Some(0), String::new()));
        ["rgb", "z", "coverage", "id"].map(|name| npy(&at.join(out).join(format!("{name}.npy"))).2)
    };
    let [a, b] = [arrays("a", ""), arrays("b", OTHER)];
    let differ = |array: usize, bytes: usize| {
        a[array].chunks(bytes).zip(b[array].chunks(bytes)).filter(|(a, b)| a != b).count()
    };
    let numbers = |bytes: &[u8]| -> Vec<f64> {
        bytes.chunks(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect()
    };
    let largest = numbers(&a[0]).iter().zip(numbers(&b[0])).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let pixels = json!({
        "all": 64 * 48,
        "color": differ(0, 24),
        "depth": differ(1, 8),
        "coverage": differ(2, 4),
        "triangle": differ(3, 4),
    });
    let mut counted = told["pixels"].clone();
    let told_largest = counted.as_object_mut().unwrap().remove("largest_color_difference");
    assert_eq!(counted, pixels);
    // The last digit of a number may change when it is written and read.
    assert!((told_largest.unwrap().as_f64().unwrap() - largest).abs() < 1e-12);
    let counts: Vec<u64> =
        ["all", "color", "depth", "coverage", "triangle"].map(|name| pixels[name].as_u64().unwrap()).into();
    assert!(
        (0..5).all(|i| (0..i).all(|j| counts[i] != counts[j])),
        "{counts:?} do not tell each other apart"
    );
    let own = format!(
        "pixels that differ of {}: colour {} (by at most {largest:.4} of full scale), depth {}, coverage {}, triangle {}",
        counts[0], counts[1], counts[2], counts[3], counts[4]
    );
    assert_eq!(text.lines().last(), Some(own.as_str()));

    // Figures, from the report of each side; in the text with the change in per cent of a.
    let figures = told["figures"].as_object().unwrap();
    let (mut checked, mut changes) = (0, 0);
    for (name, pair) in figures {
        let [a, b] =
            ["a", "b"].map(|side| told[side]["report"].pointer(&place(name)).unwrap_or(&Value::Null));
        assert_eq!(*pair, json!([a, b]), "{name}");
        let columns = line(&text, name);
        let shown = |value: &Value| match value {
            Value::Null => "-".to_owned(),
            value if value.is_f64() => format!("{:.4}", value.as_f64().unwrap()),
            value => value.to_string(),
        };
        assert_eq!(columns[..2], [shown(a), shown(b)], "{name}");
        match (a.as_f64(), b.as_f64()) {
            (Some(a), Some(b)) if a != 0.0 => {
                assert_eq!(columns[2..], [&format!("{:+.1}", 100.0 * (b - a) / a), "%"], "{name}");
                changes += 1;
            }
            _ => assert_eq!(columns.len(), 2, "{name}"),
        }
        checked += 1;
    }
    assert!(checked >= 14 && changes >= 11, "{checked} {changes}");
    // What is not among the figures is the same on both sides.
    for name in ["pixels that wrapped", "triangles drawn", "cycles: memory"] {
        let [a, b] = ["a", "b"].map(|side| told[side]["report"].pointer(&place(name)));
        assert_eq!(a == b, !figures.contains_key(name), "{name}");
    }
    // Keys.
    for (key, pair) in told["keys"].as_object().unwrap() {
        let columns = line(&text, key);
        let shown = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        assert_eq!(columns, [shown(&pair[0]), shown(&pair[1])], "{key}");
        assert!(OTHER.contains(&format!("{key}={}", columns[1])));
    }
    assert_eq!(told["keys"].as_object().unwrap().len(), 6);
}

#[test]
fn machines_that_shade_differently_are_compared() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    crate::sweep::shadings::pyramid(at);
    let screen = ["--set", "screen.width=96", "--set", "screen.height=72"];
    let of = |a: &str, b: &str| compare(at, &[&[a, b, "p.obj"], &screen[..]].concat());
    let (plain, fast) = ("default", "default,shade.kind=fast-phong");
    let told = of(plain, fast);
    let text = std::fs::read_to_string(at.join("out/compare/compare.txt")).unwrap();
    // A machine shades as its kind says, and is what `render` says of it with that shading.
    for (side, shading, kind) in [("a", "gouraud", "none"), ("b", "fast-phong", "fast-phong")] {
        let kind = format!("shade.kind={kind}");
        let render =
            [&["render", "p.obj", "--json", "--shading", shading, "--set", &kind], &screen[..]].concat();
        let output = edgewalk(at, &render).output().unwrap();
        assert_eq!(told[side]["shading"], shading);
        assert_eq!(told[side]["report"], report(&output));
    }
    // Both are held against one equation: the same figures as a sweep has of them.
    let vary = ["sweep", "p.obj", "--vary", "shade.kind=none,fast-phong", "--out", "s", "--quiet"];
    assert_eq!(run(at, &[&vary[..], &screen].concat()), (Some(0), String::new()));
    let rows = std::fs::read_to_string(at.join("s/runs.jsonl")).unwrap();
    for row in rows.lines().map(|line| serde_json::from_str::<Value>(line).unwrap()) {
        let side = if row["shading"] == "gouraud" { "a" } else { "b" };
        assert_eq!(told[side]["equation"], row["equation"]);
    }
    for name in ["largest", "mean"] {
        let pair = ["a", "b"].map(|side| told[side]["equation"][name].as_f64().unwrap());
        assert_eq!(told["figures"][format!("shading equation, {name}")], json!(pair));
        let columns = line(&text, &format!("shading equation, {name}"));
        assert_eq!(columns[..2], pair.map(|value| format!("{value:.4}")));
    }
    assert!(
        told["figures"]["cycles: term"][1].as_u64() > Some(0)
            || told["figures"]["cycles"][0] != told["figures"]["cycles"][1]
    );
    // A shading behind a colon is that of one machine, --shading that of those without one.
    assert_eq!(of("default:gouraud", "default,shade.kind=fast-phong:fast-phong")["figures"], told["figures"]);
    let told = of("default:constant", "default");
    assert_eq!(
        (&told["a"]["shading"], &told["b"]["shading"], &told["keys"]),
        (&json!("constant"), &json!("gouraud"), &json!({}))
    );
    let told = compare(
        at,
        &[&["default", "default:constant", "p.obj", "--shading", "constant-averaged"], &screen[..]].concat(),
    );
    assert_eq!(
        (&told["a"]["shading"], &told["b"]["shading"]),
        (&json!("constant-averaged"), &json!("constant"))
    );
    // Shaded alike, there is nothing to hold both against.
    assert!(of(plain, "default,setup.lanes=1")["a"]["equation"].is_null());
    for (a, said) in [
        ("default:guraud", "nearest: gouraud"),
        ("default:phong", "shade.kind"),
        ("defalt:gouraud", "nearest: default"),
    ] {
        let (code, error) = run(at, &[&["compare", a, "default", "p.obj"], &screen[..]].concat());
        assert!(code == Some(2) && error.contains(said), "{error}");
    }
    std::fs::write(at.join("c.tri"), CROSSED).unwrap();
    let (code, error) = run(at, &["compare", "default:constant", "default", "c.tri"]);
    assert!(
        code == Some(2) && error.contains("c.tri says itself how it is shaded: gouraud; leave :constant out"),
        "{error}"
    );
}

/// A triangle file names its mode: two machines draw it as it says.
#[test]
fn the_shading_of_a_file_is_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).expect("written");
    let words = ["compare", "small", "small,setup.lanes=1", "a.tri", "--shading", "phong", "--out", "o"];
    let (code, error) = run(folder.path(), &words);
    assert_eq!(code, Some(2), "{error}");
    assert!(
        error.contains("--shading phong: a.tri says itself how it is shaded: gouraud; leave --shading out"),
        "{error}"
    );
    assert!(!folder.path().join("o").exists());
}
