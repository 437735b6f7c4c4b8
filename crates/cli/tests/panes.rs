//! Maps that say what is left of a light behind what transmits it, and files with several lights: every engine beside golden.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, npy, run};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fmt::Write as _;
use std::path::Path;

const TRANSMITS: [&str; 4] =
    ["shadow.light=parallel", "shadow.gate=scale", "shadow.size=4", "shadow.transmits=yes"];

/// A pane of k_t 1/2 over the left half of the map, one of 1/4 over its upper half, behind the first; something opaque behind both over the
/// last column; and a pane behind all, which nobody sees the light through.
const PANES: &str = "size 4 4
depth lequal
shadow 4 0.001 0.2   1 0 0 0   0 1 0 0   0 0 1 0   0 0 0 1
L  0 0 0.2   2 0 0.2   0 4 0.2   0.5
L  2 0 0.2   2 4 0.2   0 4 0.2   0.5
L  0 0 0.3   8 0 0.3   0 2 0.3   0.25
L  8 0 0.3   8 2 0.3   0 2 0.3   0.25
L  3 0 0.4   4 0 0.4   3 4 0.4
L  4 0 0.4   4 4 0.4   3 4 0.4   0
L  3 0 0.45  4 0 0.45  3 4 0.45  0.1
L  4 0 0.45  4 4 0.45  3 4 0.45  0.1
T  0 0 0.5 1 1 1 0   8 0 0.5 1 1 1 0   0 8 0.5 1 1 1 0
";

fn floats(path: &Path) -> Vec<f64> {
    npy(path).2.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect()
}

/// lit, and the colours.
fn raster(folder: &Path, engine: &str, settings: &[&str]) -> (Vec<u8>, Vec<f64>) {
    let mut command = edgewalk(folder, &["raster", "a.tri", "--engine", engine, "--out", engine]);
    settings.iter().for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().unwrap();
    assert!(output.status.success(), "{engine}: {}", String::from_utf8_lossy(&output.stderr));
    (npy(&folder.join(engine).join("lit.npy")).2, floats(&folder.join(engine).join("rgb.npy")))
}

#[test]
fn panes_leave_the_product_of_their_k_t_in_every_engine() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), PANES).unwrap();
    let golden = raster(folder.path(), "golden", &TRANSMITS);
    let (ambient, upper) = (0.2, [0.125, 0.125, 0.25]);
    let lower = [0.5, 0.5, 1.0];
    let share = |k: f64| ambient + (1.0 - ambient) * k;
    for line in 0..4 {
        let left = if line < 2 { upper } else { lower };
        for column in 0..4 {
            let at = 4 * line + column;
            let wanted = left.get(column).map_or(ambient, |k| share(*k));
            assert_eq!(golden.0[at], if column < 3 { 2 } else { 1 });
            assert!((golden.1[3 * at] - wanted).abs() < 1e-12, "{line} {column}: {}", golden.1[3 * at]);
        }
    }
    for engine in ["fast", "model", "rtl"] {
        let drawn = raster(folder.path(), engine, &TRANSMITS);
        assert_eq!(drawn.0, golden.0, "{engine}");
        let worst = drawn.1.iter().zip(&golden.1).map(|(a, b)| 255.0 * (a - b).abs()).fold(0.0, f64::max);
        // Two panes, AMBIENT, k_t exact: a half each; then the colour and the product.
        assert!(worst <= 3.0 && worst > 0.0, "{engine}: {worst} LSB");
    }
}

/// Triangles that lie anyhow over the screen, each also in the map, some as panes; `rules` between the first and the second half of them.
fn slanting(random: &mut Pcg64Mcg, size: u32, matrix: &str, rules: &str) -> String {
    let mut text = format!("size 80 60\nshadow {size} 0.004 0.3   {matrix}\n");
    for place in 0..24 {
        if place == 12 {
            text += rules;
        }
        let [x, y, z] = [80.0, 60.0, 1.0].map(|most| random.random_range(0.0..most));
        let corners: [[f64; 3]; 3] = std::array::from_fn(|_| {
            let mut near = |from: f64, by: f64| from + random.random_range(-by..by);
            [near(x, 30.0), near(y, 30.0), near(z, 0.05).clamp(0.0, 1.0)]
        });
        let kt = if rules.contains("blend 1") && place >= 12 { random.random_range(0.0..1.0) } else { 0.0 };
        let _ = write!(text, "T");
        corners.iter().for_each(|[x, y, z]| _ = write!(text, "  {x} {y} {z} 0.9 0.5 1 {kt}"));
        let _ = write!(text, "\nL");
        for [x, y, z] in corners {
            let (x, y, z) = (0.7 * x + 12.0 * z + 1.0, 0.6 * y + 5.0 * z + 2.0, 0.2 + 0.5 * z);
            let _ = write!(text, "  {x} {y} {z}");
        }
        match random.random_range(0..5) {
            0 | 1 => _ = writeln!(text),
            2 => _ = writeln!(text, "  1"),
            _ => _ = writeln!(text, "  {}", random.random::<f64>()),
        }
    }
    text
}

/// `render` of such files, with layers or without: every decision is one that its texels allow, every colour within the bound of its layers and of
/// the shares that those texels have.
#[test]
fn every_decision_and_colour_under_panes_is_explained() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let parallel = "0.7 0 12 1   0 0.6 5 2   0 0 0.5 0.2   0 0 0 1";
    let tilted = "0.7 0 12 1   0 0.6 5 2   0 0 0.5 0.2   0.001 0.0005 0.1 1";
    let (mut pixels, mut dark, mut differ, mut loose, mut open, mut reached) = (0, 0, 0, 0, 0, 0.0f64);
    for (i, engine) in
        ["model", "fast", "fast", "fast", "fast", "fast", "fast", "rtl"].into_iter().enumerate()
    {
        let rules = ["", "blend 1\ndepth_write 0\n", "blend add\n", "depth lequal\nlight 0\n"][i % 4];
        let (light, matrix) = [("parallel", parallel), ("perspective", tilted)][i / 2 % 2];
        std::fs::write(folder.path().join("a.tri"), slanting(&mut random, 64, matrix, rules)).unwrap();
        let light = format!("shadow.light={light}");
        let sizes =
            ["shadow.gate=scale", "shadow.size=64", "shadow.transmits=yes", "blend.kind=constant", &light];
        let screen = ["screen.width=80", "screen.height=60", "shadow.light_fraction=16"];
        let mut command = edgewalk(folder.path(), &["render", "a.tri", "--json", "--engine", engine]);
        sizes.iter().chain(&screen).for_each(|setting| _ = command.args(["--set", setting]));
        let output = command.output().unwrap();
        assert!(!output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let (lit, blended) = (&report["comparison"]["lit"], &report["comparison"]["blended"]);
        assert!(output.status.success(), "{engine}, {light}, {rules}: {lit} {blended}");
        let number = |key: &str| lit[key].as_u64().unwrap();
        assert_eq!((number("unexplained"), blended["beyond"].as_u64()), (0, Some(0)));
        (pixels, dark, differ) =
            (pixels + number("pixels"), dark + number("shadow"), differ + number("differ"));
        if i == 1 {
            // The text tells of them where there are any.
            let mut command = edgewalk(folder.path(), &["render", "a.tri", "--engine", engine]);
            sizes.iter().chain(&screen).for_each(|setting| _ = command.args(["--set", setting]));
            let text = String::from_utf8(command.output().unwrap().stdout).unwrap();
            let told = format!("    {} pixels between texels of several shares: ", number("loose"));
            assert!(number("loose") > 0 && text.contains(&told), "{told}\n{text}");
        }
        (loose, open) = (loose + number("loose"), open + number("open"));
        reached = reached.max(blended["of_bound"].as_f64().unwrap());
    }
    println!(
        "{pixels} pixels, {dark} in shadow, {differ} decided otherwise than golden, {loose} between shares, {open} open, 0 unexplained, 0 beyond; {reached:.3} of a bound reached"
    );
    assert!(pixels > 15_000 && dark > 1_000 && loose * 10 < pixels && open * 100 < pixels && reached > 0.7);
}

/// One pixel under three layers, near a pane's end in the map, where the bound follows from the texels that the place allows: `explain`'s is
/// that by which `render` judges.
#[test]
fn explain_has_the_bound_of_the_layers() {
    let folder = tempfile::tempdir().unwrap();
    let mut text =
        "size 80 60\nshadow 64 0.004 0.3   0.7 0 12 1   0 0.6 5 2   0 0 0.5 0.2   0.001 0.0005 0.1 1\n\
                    L 0 31 0.2  64 31 0.2  0 95 0.2  0.5\n"
            .to_owned();
    for (z, kt) in [(0.5, 0.0), (0.4, 0.0), (0.3, 0.5)] {
        let rules = if kt > 0.0 { "blend 1\ndepth_write 0\n" } else { "" };
        let corner = |x, y| format!("  {x} {y} {z} 0.9 0.5 {z} {kt}");
        writeln!(text, "{rules}T{}{}{}", corner(40.0, 50.0), corner(41.2, 50.0), corner(40.0, 51.2)).unwrap();
    }
    std::fs::write(folder.path().join("a.tri"), text).unwrap();
    let run = |command: &[&str]| -> serde_json::Value {
        let mut command = edgewalk(folder.path(), command);
        let sizes = ["shadow.size=64", "shadow.light_fraction=16", "screen.width=80", "screen.height=60"];
        let kinds = ["shadow.light=perspective", "shadow.gate=scale", "shadow.transmits=yes"];
        let settings = sizes.iter().chain(&kinds).chain(&["blend.kind=constant"]);
        settings.for_each(|setting| _ = command.args(["--set", setting]));
        let output = command.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let judged = &run(&["render", "a.tri", "--json"])["comparison"]["blended"];
    assert_eq!((&judged["pixels"], &judged["layers"]), (&1.into(), &3.into()));
    let told = run(&["explain", "a.tri", "40", "50", "--json"]);
    let layers = told["layers"].as_array().unwrap();
    assert_eq!((layers.len(), &layers[2]["bound"]), (3, &judged["bound"]), "{told}");
}

/// lit.npy and rgb.npy under a light that looks in perspective: the same in every engine, golden's but for a few.
#[test]
fn a_perspective_light_is_the_same_in_every_engine() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(6);
    let matrix = "0.7 0 12 1   0 0.6 5 2   0 0 0.5 0.2   0.001 0.0005 0.1 1";
    let (mut pixels, mut differ) = (0, 0);
    for (transmits, project) in [("yes", "serial"), ("yes", "pipelined"), ("no", "serial")] {
        let mut text = slanting(&mut random, 64, matrix, "");
        if transmits == "no" {
            // Without a k_t behind them all hide the light.
            let bare = |line: &str| match line.strip_prefix('L') {
                Some(rest) => {
                    format!("L {}\n", rest.split_whitespace().take(9).collect::<Vec<_>>().join(" "))
                }
                None => format!("{line}\n"),
            };
            text = text.lines().map(bare).collect();
        }
        std::fs::write(folder.path().join("a.tri"), text).unwrap();
        let [transmits, project] =
            [format!("shadow.transmits={transmits}"), format!("shadow.project={project}")];
        let settings =
            ["shadow.light=perspective", "shadow.gate=scale", "shadow.size=64", &transmits, &project];
        let [golden, fast, model, rtl] =
            ["golden", "fast", "model", "rtl"].map(|engine| raster(folder.path(), engine, &settings));
        assert!(fast == model && model == rtl, "{settings:?}");
        pixels += golden.0.iter().filter(|lit| **lit > 0).count();
        differ += golden.0.iter().zip(&rtl.0).filter(|(a, b)| a != b).count();
    }
    println!("{pixels} pixels, the same in three engines; {differ} decided otherwise than golden");
    assert!(pixels > 8_000 && differ * 50 < pixels, "{differ} of {pixels}");
}

/// Two lights, a pass each over what the first pass left dark: golden's sum in every engine, each light with its own map and share.
#[test]
fn a_file_has_as_many_lights_as_passes_name() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "1 0 0 0   0 1 0 0   0 0 1 0   0 0 0 1";
    let text = format!(
        "size 4 4
light 0
T  0 0 0.5 0.1 0.1 0.1 0   8 0 0.5 0.1 0.1 0.1 0   0 8 0.5 0.1 0.1 0.1 0
depth equal
depth_write 0
blend add
light 1
T  0 0 0.5 0.4 0 0 0   8 0 0.5 0.4 0 0 0   0 8 0.5 0.4 0 0 0
light 2
T  0 0 0.5 0 0.6 0 0   8 0 0.5 0 0.6 0 0   0 8 0.5 0 0.6 0 0
shadow 4 0.001 0   {rows}
L  0 0 0.25   2 0 0.25   0 4 0.25
L  2 0 0.25   2 4 0.25   0 4 0.25
shadow 4 0.001 0.5   {rows}
L  0 0 0.25   4 0 0.25   0 2 0.25   0.5
L  4 0 0.25   4 2 0.25   0 2 0.25   0.5
"
    );
    std::fs::write(folder.path().join("a.tri"), text).unwrap();
    let settings = [&TRANSMITS[..], &["blend.kind=constant"]].concat();
    let golden = raster(folder.path(), "golden", &settings);
    for (at, color) in golden.1.chunks_exact(3).enumerate() {
        let red = if at % 4 < 2 { 0.1 } else { 0.5 };
        let green = 0.1 + if at < 8 { 0.6 * 0.75 } else { 0.6 };
        assert!((color[0] - red).abs() < 1e-12 && (color[1] - green).abs() < 1e-12, "{at}: {color:?}");
    }
    for engine in ["fast", "model", "rtl"] {
        let drawn = raster(folder.path(), engine, &settings);
        assert_eq!(drawn.0, golden.0, "{engine}");
        let worst = drawn.1.iter().zip(&golden.1).map(|(a, b)| 255.0 * (a - b).abs()).fold(0.0, f64::max);
        assert!(worst <= 3.5, "{engine}: {worst} LSB");
    }
    // Judged, too; and the second map takes its own pass.
    let screen = ["screen.width=4", "screen.height=4"];
    let mut command = edgewalk(folder.path(), &["render", "a.tri", "--json"]);
    settings.iter().chain(&screen).for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().unwrap();
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(output.status.success(), "{report:#}");
    assert_eq!(report["cycles"]["maps"].as_array().map(Vec::len), Some(2));
}

const LENS: [&str; 9] = [
    "shadow.light=perspective",
    "shadow.transmits=yes",
    "blend.kind=constant",
    "screen.width=64",
    "screen.height=48",
    "shadow.size=128",
    "shadow.light_fraction=16",
    "screen.guard_bits=11",
    "shadow.project=serial",
];

fn scene(name: &str) -> String {
    format!("{}/../../docs/scenes/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Scenes with glass, in every engine: each light's part judged, panes that are seen and panes that the light comes through.
#[test]
fn scenes_with_glass_have_their_shadows_on_the_machine() {
    let folder = tempfile::tempdir().unwrap();
    let (mut pixels, mut layers) = (0, 0);
    for (name, lights) in [("glass.toml", 1), ("glass-and-shadows.toml", 2)] {
        let mut pictures = Vec::new();
        for engine in ["fast", "model", "rtl"] {
            let arguments =
                ["render", &scene(name), "--shadows", "map", "--json", "--engine", engine, "--out", engine];
            let mut command = edgewalk(folder.path(), &arguments);
            LENS.iter().for_each(|setting| _ = command.args(["--set", setting]));
            let output = command.output().unwrap();
            assert!(!output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
            let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
            assert!(output.status.success(), "{name} {engine}: {:#}", report["parts"]);
            let parts = report["parts"]["parts"].as_array().unwrap();
            assert_eq!(
                (parts.len(), report["parts"]["by_host"].as_bool()),
                (1 + lights, Some(true)),
                "{name}"
            );
            // Of the pixels that are drawn those are left out where a light decides otherwise than golden, once each at most.
            let drawn = parts[0]["covered"].as_u64().unwrap();
            let otherwise =
                parts[1..].iter().map(|part| part["lit"]["differ"].as_u64().unwrap()).sum::<u64>();
            let alike = report["parts"]["alike"].as_u64().unwrap();
            assert!(alike <= drawn && alike + otherwise >= drawn, "{alike} of {drawn}, {otherwise}");
            for (place, part) in parts.iter().enumerate() {
                let (lit, blended) = (&part["lit"], &part["blended"]);
                assert_eq!(blended["beyond"].as_u64(), Some(0), "{name} {engine}: {part}");
                layers = layers.max(blended["layers"].as_u64().unwrap());
                if place == 0 {
                    continue;
                }
                let number = |key: &str| lit[key].as_u64().unwrap();
                assert_eq!(number("unexplained"), 0, "{name} {engine}: {lit}");
                assert!(number("loose") * 5 < number("pixels"), "{name} {engine}: {lit}");
                pixels += number("pixels");
            }
            pictures.push(std::fs::read(folder.path().join(engine).join("image.png")).unwrap());
        }
        assert!(pictures[1..].iter().all(|picture| *picture == pictures[0]), "{name}");
    }
    println!("{pixels} pixels under lights, up to {layers} layers, 0 unexplained, 0 beyond");
    assert!(pixels > 10_000 && layers == 3);
}

#[test]
fn explain_shows_what_is_left_of_the_light() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), PANES).unwrap();
    let screen = ["screen.width=4", "screen.height=4"];
    for (x, words) in [
        (
            "0",
            "texel (0, 0), depth 32702; the map has 65535, and 77 is left of the light there: lit, share 77",
        ),
        (
            "3",
            "texel (3, 0), depth 32702; the map has 26214, and 102 is left of the light there: in shadow, share 51",
        ),
    ] {
        let mut command = edgewalk(folder.path(), &["explain", "a.tri", x, "0"]);
        TRANSMITS.iter().chain(&screen).for_each(|setting| _ = command.args(["--set", setting]));
        let output = command.output().unwrap();
        let page = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(page.contains(words), "{page} lacks {words}; {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn what_a_map_cannot_hold_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let without = &TRANSMITS[..3];
    let with = |more: &[&'static str]| [&TRANSMITS[..], more].concat();
    let cases: [(String, Vec<&str>, &[&str]); 12] = [
        (PANES.to_owned(), without.to_vec(), &["L with kt = 0.5", "shadow.transmits=yes", "--engine golden"]),
        (PANES.to_owned(), with(&["shadow.transmits=maybe"]), &["shadow.transmits = maybe", "no, yes"]),
        (
            PANES.to_owned(),
            with(&["formats.color_bits=12", "shadow.depth_bits=21"]),
            &["shadow.depth_bits = 21", "33 bits", "permitted: at most 32", "try shadow.depth_bits = 20"],
        ),
        (PANES.replacen("0.5\n", "1.5\n", 1), with(&[]), &["a.tri:4: L kt: `1.5`", "0 to 1"]),
        (PANES.replacen("0.5\n", "-0.1\n", 1), with(&[]), &["a.tri:4: L kt: `-0.1`", "0 to 1"]),
        (PANES.replacen("0.5\n", "0.5 0.5 0.5\n", 1), with(&[]), &["a.tri:4: L: `11 given`"]),
        (
            PANES.replacen("shadow 4", "shadow 8192", 1),
            with(&[]),
            &["shadow 8192", "1 to 4096 texels", "--engine golden"],
        ),
        (
            PANES.replacen("shadow 4", "shadow 16385", 1),
            with(&[]),
            &["a.tri:3: shadow SIZE: `16385`", "16384"],
        ),
        (
            PANES.replacen("1 1 1 0   8", "1 1 1 1.5   8", 1),
            with(&[]),
            &["a.tri:12: T vertex 1 kt: `1.5`", "0 to 1"],
        ),
        (
            PANES.replacen("   1 0 0 0", "   99 0 0 0", 1),
            with(&["shadow.guard_bits=6"]),
            &["triangle 0 (counted from 0), vertex 2 (from 1)", "lx = 792", "-255 to 255"],
        ),
        (PANES.replacen("T ", "light 2\nT ", 1), with(&[]), &["a.tri:12: light: `2`", "0 to 1"]),
        (PANES.replacen("L  0 0 0.2 ", "L  -9000 0 0.2 ", 1), with(&[]), &["triangle 2 of the map", "guard"]),
    ];
    for (text, settings, words) in cases {
        std::fs::write(folder.path().join("a.tri"), &text).unwrap();
        let settings: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
        let (code, error) =
            run(folder.path(), &[&["raster", "a.tri", "--out", "out"][..], &settings].concat());
        assert_eq!(code, Some(2), "{settings:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{settings:?}: {error} lacks {word}");
        }
    }
}
