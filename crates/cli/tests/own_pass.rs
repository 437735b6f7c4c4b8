//! The light's own pass through the program: with `shadow.own_pass = yes` every engine draws map and picture on one machine, and the picture is the
//! one of the machine whose map a second one draws.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::recording::Recording;
use crate::support::{edgewalk, npy, run};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fmt::Write as _;
use std::path::Path;

const OWN: &str = "shadow.own_pass=yes";

/// Triangles anyhow over the screen, each also in the maps of two lights, one in three of these as a pane where `glass`; the second half of
/// them looks up the second map.
fn two_lights(random: &mut Pcg64Mcg, [width, height, size]: [u32; 3], matrix: &str, glass: bool) -> String {
    let mut lights = [(); 2].map(|()| format!("shadow {size} 0.004 0.3   {matrix}\n"));
    let mut drawn = [String::new(), String::new()];
    for place in 0..16 {
        let [x, y, z] = [f64::from(width), f64::from(height), 1.0].map(|most| random.random_range(0.0..most));
        let mut near = |middle: f64, reach: f64| middle + reach * random.random_range(-1.0..1.0);
        let corners: [[f64; 3]; 3] =
            std::array::from_fn(|_| [near(x, 20.0), near(y, 20.0), near(z, 0.05).clamp(0.0, 1.0)]);
        let text = &mut drawn[place / 8];
        *text += "T";
        corners.iter().for_each(|[x, y, z]| _ = write!(text, "  {x} {y} {z} 0.9 0.5 1 0"));
        *text += "\n";
        let light = &mut lights[place % 2];
        *light += "L";
        for [x, y, z] in corners {
            let _ = write!(light, "  {} {} {}", 0.7 * x + 12.0 * z, 0.6 * y + 5.0 * z, 0.2 + 0.5 * z);
        }
        let _ = if glass && place % 3 == 0 { writeln!(light, "  0.5") } else { writeln!(light) };
    }
    let [first, second] = drawn;
    format!("size {width} {height}\n{}{}light 1\n{first}light 2\n{second}", lights[0], lights[1])
}

/// Draws into a folder of that name, and returns its report's cycles.
fn raster(folder: &Path, out: &str, engine: &str, settings: &[&str]) -> serde_json::Value {
    let mut command = edgewalk(folder, &["raster", "a.tri", "--engine", engine, "--out", out]);
    settings.iter().for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().unwrap();
    assert!(output.status.success(), "{out}: {}", String::from_utf8_lossy(&output.stderr));
    let report = std::fs::read(folder.join(out).join("report.json")).unwrap();
    serde_json::from_slice::<serde_json::Value>(&report).unwrap()["cycles"].clone()
}

/// All planes, the same bytes.
fn same_planes(folder: &Path, a: &str, b: &str) -> usize {
    let planes = ["z.npy", "rgb.npy", "lit.npy", "id.npy", "coverage.npy", "writes.npy"];
    for plane in planes {
        let read = |of: &str| std::fs::read(folder.join(of).join(plane)).unwrap();
        assert!(read(a) == read(b), "{plane} of {a} and {b}");
    }
    planes.len()
}

#[test]
fn every_engine_draws_map_and_picture_on_one_machine() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(9);
    let parallel = "0.7 0 12 1   0 0.6 5 2   0 0 0.5 0.2   0 0 0 1";
    let tilted = "0.7 0 12 1   0 0.6 5 2   0 0 0.5 0.2   0.001 0.0005 0.1 1";
    let (mut compared, mut dark) = (0, 0);
    // A map larger than the screen and one smaller; with panes, BLEND draws what is left of the light.
    for (sides, light, matrix, glass) in [
        ([40, 30, 64], "parallel", parallel, false),
        ([60, 50, 24], "perspective", tilted, true),
        ([40, 30, 64], "parallel", parallel, true),
    ] {
        std::fs::write(folder.path().join("a.tri"), two_lights(&mut random, sides, matrix, glass)).unwrap();
        let (light, size) = (format!("shadow.light={light}"), format!("shadow.size={}", sides[2]));
        let mut settings = vec![light.as_str(), &size, "shadow.gate=scale", "screen.guard_bits=8"];
        if glass {
            settings.extend(["shadow.transmits=yes", "blend.kind=constant"]);
        }
        let without = raster(folder.path(), "without", "model", &settings);
        settings.push(OWN);
        let mut cycles = Vec::new();
        for engine in ["fast", "model", "rtl"] {
            let own = raster(folder.path(), engine, engine, &settings);
            compared += same_planes(folder.path(), "without", engine);
            assert_eq!(own["total"], without["total"], "the picture takes its time, whoever draws the map");
            assert_eq!(own["passes"], without["passes"]);
            let maps = own["maps"].as_array().unwrap();
            assert!(maps.len() == 2 && maps.iter().all(|cycles| cycles.as_u64() > Some(100)), "{own}");
            cycles.push(own["maps"].clone());
        }
        assert!(cycles.windows(2).all(|pair| pair[0] == pair[1]), "{cycles:?}");
        let (_, _, lit) = crate::support::npy(&folder.path().join("rtl/lit.npy"));
        dark += lit.iter().filter(|lit| **lit == 1).count();
    }
    println!("{compared} of 54 planes the same, {dark} pixels in shadow");
    assert!(compared == 54 && dark > 100);
}

/// Triangles over the map and the screen, one light; its second triangle is a pane where `glass`.
fn one_light(size: u32, glass: bool) -> String {
    let pane = if glass { "  0.5" } else { "" };
    format!(
        "size 24 18\nshadow {size} 0.004 0.3   0.7 0 2 1   0 0.6 1 2   0 0 0.5 0.2   0 0 0 1\n\
         L  1 1 0.3   14 2 0.4   3 12 0.5\nL  4 3 0.25   16 9 0.25   2 14 0.6{pane}\n\
         T  1 1 0.4 0.9 0.5 1 0   22 2 0.5 0.9 0.5 1 0   3 16 0.6 0.9 0.5 1 0\n\
         T  5 3 0.2 0.1 0.5 0.3 0   23 9 0.2 0.9 0.8 1 0   2 17 0.7 0.2 0.5 1 0\n"
    )
}

#[test]
fn replay_shows_the_pass_of_the_light() {
    let folder = tempfile::tempdir().unwrap();
    let (mut texels, mut pixels) = (0, 0);
    for (size, glass) in [(16, false), (40, true)] {
        std::fs::write(folder.path().join("a.tri"), one_light(size, glass)).unwrap();
        let size = format!("shadow.size={size}");
        let mut settings = vec!["shadow.light=parallel", &size, "shadow.gate=scale", OWN];
        settings.extend(["blend.kind=constant", "shadow.transmits=yes"].iter().filter(|_| glass));
        let cycles = raster(folder.path(), "r", "model", &settings);
        let mut command = edgewalk(folder.path(), &["replay", "a.tri", "--out", "a.json", "-q"]);
        settings.iter().for_each(|setting| _ = command.args(["--set", setting]));
        let output = command.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let json = std::fs::read(folder.path().join("a.json")).unwrap();
        let shown = Recording::read(serde_json::from_slice(&json).unwrap());

        let [of_map, of_picture] = [&cycles["maps"][0], &cycles["total"]].map(|n| n.as_u64().unwrap());
        assert!(of_map > 100 && of_picture > 100, "{cycles}");
        assert_eq!(
            shown.json["cycles"],
            of_map + of_picture,
            "the light's pass is recorded before the picture's"
        );
        let during = &shown.json["store"]["map"]["during"];
        let light = (0..of_map + of_picture).filter(|cycle| shown.value(during, *cycle) == 1).count();
        assert_eq!(light as u64, of_map);

        let (depths, written) = shown.plane("Map of the light", 0);
        let farthest = *depths.iter().max().unwrap();
        let nearer = depths.iter().filter(|depth| **depth < farthest).count();
        assert!(written > 20 && nearer > 20, "{written} texels written, {nearer} nearer than the end");
        if glass {
            let (left, _) = shown.plane("Light that is left", 1);
            assert!(left.iter().any(|left| *left < 255), "a pane takes light away");
        }
        texels += depths.len();

        // The planes of raster are numbers from 0 to 1.
        let array = |name: &str| -> Vec<f64> {
            let (kind, _, bytes) = npy(&folder.path().join("r").join(name));
            assert_eq!(kind, "<f8");
            bytes.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect()
        };
        let (z, rgb) = (array("z.npy"), array("rgb.npy"));
        let shown_z: Vec<f64> =
            shown.plane("Depth memory", 0).0.iter().map(|z| *z as f64 / f64::from((1 << 24) - 1)).collect();
        assert_eq!(shown_z, z);
        for channel in 0..3 {
            let (words, _) = shown.plane("Picture", channel + 1);
            let words: Vec<f64> = words.iter().map(|word| *word as f64 / 255.0).collect();
            let drawn: Vec<f64> = rgb.chunks_exact(3).map(|pixel| pixel[channel]).collect();
            assert_eq!(words, drawn, "channel {channel}");
            pixels += words.len();
        }
    }
    println!("{texels} texels of two maps, {pixels} colours compared");
    assert_eq!((texels, pixels), (16 * 16 + 40 * 40, 2 * 3 * 24 * 18));
}

/// A scene in all passes: its report, and the pixels of its picture (what stands before them names the machine).
fn render(folder: &Path, out: &str, engine: &str, settings: &[&str]) -> (serde_json::Value, Vec<u8>) {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scenes/glass-and-shadows.toml");
    let mut command =
        edgewalk(folder, &["render", scene, "--shadows", "map", "--engine", engine, "--out", out, "--json"]);
    let usual = [
        "screen.width=60",
        "screen.height=45",
        "shadow.light=perspective",
        "shadow.size=96",
        "shadow.depth_bits=20",
        "shadow.light_bits=24",
        "shadow.transmits=yes",
        "blend.kind=constant",
    ];
    usual.iter().chain(settings).for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().unwrap();
    let report = serde_json::from_slice(&output.stdout);
    let report: serde_json::Value =
        report.unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)));
    assert!(output.status.success(), "{}", report["comparison"]);
    let image = std::fs::read(folder.join(out).join("image.png")).unwrap();
    let pixels = image.windows(4).position(|four| four == b"IDAT").unwrap();
    (report, image[pixels..].to_vec())
}

#[test]
fn a_scene_has_the_same_shadows() {
    let folder = tempfile::tempdir().unwrap();
    let (found, without) = render(folder.path(), "without", "fast", &[]);
    for engine in ["fast", "rtl"] {
        let (report, own) = render(folder.path(), engine, engine, &[OWN]);
        assert!(own == without, "image.png of {engine}");
        assert_eq!(report["parts"]["parts"].as_array().map(Vec::len), Some(3));
        assert_eq!(report["parts"], found["parts"], "every decision, error and bound");
        let maps = report["cycles"]["maps"].as_array().unwrap();
        assert!(!maps.is_empty() && maps.iter().all(|cycles| cycles.as_u64() > Some(100)), "{maps:?}");
    }
}

#[test]
fn what_one_machine_cannot_do_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let light = "shadow.light=parallel";
    let cases: [(&[&str], &[&str]); 5] = [
        (&[light, "shadow.own_pass=maybe"], &["shadow.own_pass = maybe", "no, yes"]),
        (
            &[light, OWN, "shadow.depth_bits=24", "formats.z_bits=16"],
            &["shadow.depth_bits = 24", "shadow.own_pass = yes", "16 bits", "try shadow.depth_bits = 16"],
        ),
        (
            &[light, OWN, "screen.guard_bits=8", "screen.width=64", "screen.height=48"],
            &["screen.guard_bits = 8", "shadow.own_pass = yes", "512 texels", "try screen.guard_bits = 9"],
        ),
        (
            &[light, OWN, "shadow.transmits=yes"],
            &["blend.kind = none", "shadow.own_pass", "BLEND", "try blend.kind = constant"],
        ),
        (&[OWN, "shadow.owm_pass=yes"], &["shadow.owm_pass", "nearest: shadow.own_pass"]),
    ];
    for (settings, words) in cases {
        let mut arguments = vec!["emit", "--out", "out"];
        settings.iter().for_each(|setting| arguments.extend(["--set", setting]));
        let (code, error) = run(folder.path(), &arguments);
        assert_eq!(code, Some(2), "{settings:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{settings:?}: {error} lacks {word}");
        }
    }
    println!("checked {0} / {0} machines", cases.len());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// The cycles of the maps in docs/shadows.md, by the command above them.
#[test]
fn the_page_has_the_cycles_of_the_maps() {
    let page = include_str!("../../../docs/shadows.md");
    let (before, table) = page.split_once("| scene | second machine | one machine").expect("the table");
    let command =
        before.rsplit("```").nth(1).expect("its command").trim_start_matches("sh").replace('\\', " ");
    let words: Vec<&str> = command.split_whitespace().skip(1).collect();
    let mut checked = 0;
    for row in table.lines().skip(2).take_while(|line| line.starts_with('|')) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        for (told, own_pass) in [(cells[2], "shadow.own_pass=no"), (cells[3], "shadow.own_pass=yes")] {
            let words = words.iter().map(|word| match *word {
                "docs/scenes/glass-and-shadows.toml" => cells[1].trim_matches('`'),
                "shadow.own_pass=yes" => own_pass,
                word => word,
            });
            let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_edgewalk"));
            let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
            let output =
                command.args(words).arg("--json").current_dir(root).output().expect("the program runs");
            let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
            let own: Vec<u64> = serde_json::from_value(report["cycles"]["maps"].clone()).expect("maps");
            let told = told.replace(',', "").replace("and", "");
            let thousands = told.split_whitespace().map(|cycles| cycles.parse::<u64>().expect("cycles"));
            assert_eq!(thousands.collect::<Vec<_>>(), own, "{row}");
            checked += own.len();
        }
    }
    assert_eq!(checked, 10);
}

/// A map with shares is drawn by BLEND, in an opaque frame too.
#[test]
fn a_pane_brings_blend_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let opaque = "T 1 1 0.5 1 1 1 0  5 1 0.5 1 1 1 0  1 5 0.5 1 1 1 0\n";
    let light = "shadow 4 0 0.25  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\nL 0 0 0.25 4 0 0.25 0 4 0.25 0.5\n";
    let render = |file: &str, arguments: &[&str]| {
        std::fs::write(folder.path().join("a.tri"), file).unwrap();
        run(folder.path(), &[&["render", "a.tri", "--out", "o", "--set", OWN], arguments].concat())
    };
    let file = format!("size 8 8\n{light}{opaque}");
    let (code, error) = render(&file, &["--set", "shadow.light=parallel"]);
    assert!(code == Some(2) && error.contains(" --set blend.kind=constant "), "{error}");
    for rules in ["", "blend 1\n"] {
        let (code, error) = render(&format!("size 8 8\n{light}{rules}{opaque}"), &["--adapt"]);
        assert_eq!((code, error.as_str()), (Some(0), ""), "{rules}");
    }
}
