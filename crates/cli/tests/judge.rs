//! `edgewalk judge`: a rasterizer of another architecture, written here, passes; each of its faults is found and named.
//!
//! The rasterizer goes by half-planes over tiles of 8 x 8 pixels, from the last tile to the first. It snaps vertices to 1/256 px and
//! keeps the nearest fragment of each tile before it writes.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod verilog;

use crate::support::{edgewalk, ended};
use serde_json::Value;
use std::path::Path;

/// A fault of the rasterizer.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    None,
    /// Centres on right and bottom edges are inside, in place of left and top ones.
    FillRule,
    /// The farthest fragment wins.
    DepthFunction,
    /// Depths have 20 bits for 24.
    FewerBits,
    /// A covered pixel is not written.
    PixelDropped,
    /// One triangle is drawn where nothing should be.
    PixelAdded,
    /// Green is 3 LSB too large in one pixel.
    Colour,
}

/// x, y, z, r, g, b.
type Vertex = [f64; 6];

struct Drawn {
    coverage: Vec<u32>,
    id: Vec<i32>,
    z: Vec<f64>,
    rgb: Vec<[f64; 3]>,
}

const SIZE: (usize, usize) = (64, 48);
const TILE: usize = 8;

/// Random triangles, some of which share edges through pixel centres.
fn triangles(seed: u64) -> Vec<[Vertex; 3]> {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / f64::from(1u32 << 31)
    };
    let mut list = Vec::new();
    for _ in 0..12 {
        let corner = |random: &mut dyn FnMut() -> f64| {
            let (x, y) = (random() * 64.0, random() * 48.0);
            [x, y, random(), random(), random(), random()]
        };
        list.push([corner(&mut random), corner(&mut random), corner(&mut random)]);
    }
    // A square of two triangles whose corners and diagonal lie on centres.
    let at = |x: f64, y: f64| [x + 0.5, y + 0.5, 0.25, 1.0, 0.5, 0.0];
    list.push([at(10.0, 10.0), at(30.0, 10.0), at(10.0, 30.0)]);
    list.push([at(30.0, 10.0), at(30.0, 30.0), at(10.0, 30.0)]);
    list
}

fn text(list: &[[Vertex; 3]]) -> String {
    let vertex = |v: &Vertex| format!("{} {} {} {} {} {} 0", v[0], v[1], v[2], v[3], v[4], v[5]);
    let line = |t: &[Vertex; 3]| format!("T {}  {}  {}\n", vertex(&t[0]), vertex(&t[1]), vertex(&t[2]));
    format!("size {} {}\n", SIZE.0, SIZE.1) + &list.iter().map(line).collect::<String>()
}

fn draw(list: &[[Vertex; 3]], fault: Fault) -> Drawn {
    let pixels = SIZE.0 * SIZE.1;
    let mut drawn = Drawn {
        coverage: vec![0; pixels],
        id: vec![-1; pixels],
        z: vec![1.0; pixels],
        rgb: vec![[0.0; 3]; pixels],
    };
    let tiles = (SIZE.0 / TILE, SIZE.1 / TILE);
    for tile in (0..tiles.0 * tiles.1).rev() {
        let (left, top) = (tile % tiles.0 * TILE, tile / tiles.0 * TILE);
        for (id, triangle) in list.iter().enumerate() {
            for (x, y) in (0..TILE * TILE).map(|i| (left + i % TILE, top + i / TILE)) {
                let Some(weights) = inside(triangle, (x, y), fault) else { continue };
                let of = |field: usize| (0..3).map(|k| weights[k] * triangle[k][field]).sum::<f64>();
                let at = y * SIZE.0 + x;
                drawn.coverage[at] += 1;
                let near = of(2);
                let wins = match (drawn.id[at], fault) {
                    (-1, _) => true,
                    (_, Fault::DepthFunction) => near > drawn.z[at],
                    _ => near < drawn.z[at],
                };
                if wins {
                    (drawn.id[at], drawn.z[at], drawn.rgb[at]) = (id as i32, near, [of(3), of(4), of(5)]);
                }
            }
        }
    }
    let rounded = |value: f64, bits: u32| {
        let one = ((1u64 << bits) - 1) as f64;
        (value * one).round() / one
    };
    for at in 0..pixels {
        drawn.z[at] = rounded(drawn.z[at], if fault == Fault::FewerBits { 20 } else { 24 });
        drawn.rgb[at] = drawn.rgb[at].map(|value| rounded(value, 8));
    }
    let covered = drawn.id.iter().rposition(|id| *id >= 0).unwrap();
    match fault {
        Fault::PixelDropped => {
            (drawn.id[covered], drawn.z[covered], drawn.rgb[covered]) = (-1, 1.0, [0.0; 3]);
            drawn.coverage[covered] = 0;
        }
        Fault::PixelAdded => {
            let free = drawn.id.iter().position(|id| *id < 0).unwrap();
            (drawn.id[free], drawn.z[free], drawn.coverage[free]) = (0, 0.5, 1);
        }
        Fault::Colour => {
            drawn.rgb[covered][1] += if drawn.rgb[covered][1] > 0.5 { -3.0 } else { 3.0 } / 255.0
        }
        _ => {}
    }
    drawn
}

/// What each vertex weighs at the centre of a pixel, if it lies inside.
fn inside(triangle: &[Vertex; 3], (x, y): (usize, usize), fault: Fault) -> Option<[f64; 3]> {
    let snap = |v: f64| (v * 256.0).round_ties_even() as i64;
    let p = triangle.map(|v| (snap(v[0]), snap(v[1])));
    let c = (x as i64 * 256 + 128, y as i64 * 256 + 128);
    let cross =
        |a: (i64, i64), b: (i64, i64), c: (i64, i64)| (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0);
    let area = cross(p[0], p[1], p[2]);
    if area == 0 {
        return None;
    }
    let mut weights = [0.0; 3];
    for k in 0..3 {
        let (mut a, mut b) = (p[(k + 1) % 3], p[(k + 2) % 3]);
        if area < 0 {
            (a, b) = (b, a);
        }
        let w = cross(a, b, c);
        // The inside lies to the right of a -> b, as y runs down.
        let left_or_top = b.1 < a.1 || (b.1 == a.1 && b.0 > a.0);
        let on_edge = if fault == Fault::FillRule { !left_or_top } else { left_or_top };
        if w < 0 || w == 0 && !on_edge {
            return None;
        }
        weights[k] = w as f64 / area.abs() as f64;
    }
    Some(weights)
}

/// Writes an array as numpy's format says.
fn npy(path: &Path, descr: &str, shape: &str, bytes: &[u8]) {
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
    let padded = format!("{header:<117}\n");
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((padded.len() as u16).to_le_bytes());
    file.extend(padded.as_bytes());
    file.extend(bytes);
    std::fs::write(path, file).unwrap();
}

fn write(folder: &Path, drawn: &Drawn) {
    let shape = format!("({}, {})", SIZE.1, SIZE.0);
    let bytes = |values: &[f64]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    npy(&folder.join("z.npy"), "<f8", &shape, &bytes(&drawn.z));
    npy(
        &folder.join("rgb.npy"),
        "<f8",
        &format!("({}, {}, 3)", SIZE.1, SIZE.0),
        &bytes(drawn.rgb.as_flattened()),
    );
    let counts: Vec<u8> = drawn.coverage.iter().flat_map(|v| v.to_le_bytes()).collect();
    npy(&folder.join("coverage.npy"), "<u4", &shape, &counts);
}

/// Judges: exit code, report.
fn judged(folder: &Path, arguments: &[&str]) -> (Option<i32>, Value) {
    let output = edgewalk(folder, &[&["judge", "in.tri"], arguments, &["--json"]].concat()).output().unwrap();
    let (code, error) = ended(&output);
    (code, serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {error}")))
}

fn count(report: &Value, cause: &str) -> u64 {
    let of = |count: &&Value| count["cause"] == cause;
    report["causes"].as_array().unwrap().iter().find(of).unwrap()["pixels"].as_u64().unwrap()
}

#[test]
fn rasterizer_of_tiles_passes_on_three_inputs() {
    for seed in [1, 2, 3] {
        let folder = tempfile::tempdir().unwrap();
        let list = triangles(seed);
        std::fs::write(folder.path().join("in.tri"), text(&list)).unwrap();
        write(folder.path(), &draw(&list, Fault::None));
        let (code, report) = judged(folder.path(), &["."]);
        assert_eq!((code, &report["pass"], &report["wrong"]), (Some(0), &true.into(), &0.into()), "{report}");
        assert_eq!(report["pixels"], 64 * 48);
        assert!(report["covered"].as_u64().unwrap() > 1000, "{report}");
        assert_eq!(report["compared"], serde_json::json!(["coverage", "z", "rgb"]));
        let [z, _] = [0, 1].map(|place| report["largest_error_lsb"][place].as_f64().unwrap());
        assert!(z > 0.4 && z <= 0.5 + 1e-6, "rounded to the nearest: {z}");
    }
}

#[test]
fn each_fault_fails_with_its_cause() {
    let faults = [
        (Fault::FillRule, "missing"),
        (Fault::FillRule, "extra"),
        (Fault::DepthFunction, "wrong-winner"),
        (Fault::FewerBits, "depth"),
        (Fault::PixelDropped, "missing"),
        (Fault::PixelAdded, "extra"),
        (Fault::Colour, "color"),
    ];
    for seed in [1, 2, 3] {
        for (fault, cause) in faults {
            let folder = tempfile::tempdir().unwrap();
            let list = triangles(seed);
            std::fs::write(folder.path().join("in.tri"), text(&list)).unwrap();
            let drawn = draw(&list, fault);
            write(folder.path(), &drawn);
            let (code, report) = judged(folder.path(), &[".", "--out", "judged"]);
            assert_eq!((code, &report["pass"]), (Some(1), &false.into()), "{cause}: {report}");
            assert!(count(&report, cause) > 0, "{cause}: {report}");
            let named = report["examples"].as_array().unwrap();
            let found = named.iter().find(|found| found["cause"] == cause).unwrap();
            let at = (found["y"].as_u64().unwrap() * 64 + found["x"].as_u64().unwrap()) as usize;
            let right = draw(&list, Fault::None);
            assert!(
                (drawn.coverage[at], drawn.z[at], drawn.rgb[at])
                    != (right.coverage[at], right.z[at], right.rgb[at]),
                "the pixel named is one that was drawn otherwise: {found}"
            );
            if matches!(fault, Fault::PixelDropped | Fault::PixelAdded | Fault::Colour) {
                assert_eq!(report["wrong"], 1, "{cause}: {report}");
            }
            if fault == Fault::FillRule {
                assert_eq!(found["edge"]["distance"], 0.0, "the centre lies on the edge: {found}");
            }
            let folder = folder.path().join("judged");
            let kept: Value =
                serde_json::from_slice(&std::fs::read(folder.join("judge.json")).unwrap()).unwrap();
            assert_eq!(kept, report);
            let colored = crate::support::colors(&folder.join("differences.png"));
            let differ = colored.iter().filter(|color| **color != [0; 3]).count() as u64;
            assert_eq!(differ, report["pixels"].as_u64().unwrap() - report["agree"].as_u64().unwrap());
            assert!(colored[at] != [0; 3]);
            let junit = std::fs::read_to_string(folder.join("judge.xml")).unwrap();
            let wrong = report["causes"].as_array().unwrap().iter();
            let wrong = wrong.filter(|count| count["wrong"] == true && count["pixels"] != 0).count();
            assert!(junit.contains(&format!("failures=\"{wrong}\"")), "{junit}");
        }
    }
}

#[test]
fn flipped_rule_passes_by_its_own_name() {
    let folder = tempfile::tempdir().unwrap();
    let list = triangles(1);
    std::fs::write(folder.path().join("in.tri"), text(&list)).unwrap();
    write(folder.path(), &draw(&list, Fault::FillRule));
    let codes = ["top-left", "top-right", "bottom-left", "bottom-right"];
    let codes = codes.map(|rule| judged(folder.path(), &[".", "--rule", rule]).0);
    assert_eq!(codes, [Some(1), Some(1), Some(1), Some(0)]);
}

#[test]
fn picture_of_any_program_is_judged_by_colour() {
    let folder = tempfile::tempdir().unwrap();
    let list = triangles(2);
    std::fs::write(folder.path().join("in.tri"), text(&list)).unwrap();
    for (fault, code) in [(Fault::None, 0), (Fault::Colour, 1)] {
        let drawn = draw(&list, fault);
        let bytes: Vec<u8> = drawn.rgb.as_flattened().iter().map(|v| (v * 255.0).round() as u8).collect();
        let picture = image::RgbImage::from_raw(64, 48, bytes).unwrap();
        picture.save(folder.path().join("mine.png")).unwrap();
        let (found, report) = judged(folder.path(), &["mine.png"]);
        assert_eq!(found, Some(code), "{report}");
        assert_eq!(report["compared"], serde_json::json!(["rgb"]));
        // What was not compared has no error.
        let [z, color] = [0, 1].map(|place| &report["largest_error_lsb"][place]);
        assert!(z.is_null() && color.is_f64(), "{report}");
        let text = edgewalk(folder.path(), &["judge", "in.tri", "mine.png"]).output().unwrap().stdout;
        let text = String::from_utf8(text).unwrap();
        assert!(!text.contains("depth: ") && text.contains("colour: tolerance"), "{text}");
    }
}

/// A grey picture has its value in all three colours; what a pixel lets through is left aside.
#[test]
fn pictures_of_other_kinds_are_judged() {
    let folder = tempfile::tempdir().unwrap();
    let grey = "T 2 2 0.5 0.6 0.6 0.6 0   60 2 0.5 0.6 0.6 0.6 0   2 40 0.5 0.6 0.6 0.6 0";
    std::fs::write(folder.path().join("in.tri"), format!("size 64 48\n{grey}\n")).unwrap();
    let (code, error) =
        ended(&edgewalk(folder.path(), &["render", "in.tri", "--out", "r", "--quiet"]).output().unwrap());
    assert_eq!(code, Some(0), "{error}");
    let drawn = image::open(folder.path().join("r/image.png")).unwrap();
    drawn.to_luma8().save(folder.path().join("grey.png")).unwrap();
    drawn.to_luma_alpha16().save(folder.path().join("both.png")).unwrap();
    drawn.to_rgba8().save(folder.path().join("alpha.png")).unwrap();
    for name in ["grey.png", "both.png", "alpha.png"] {
        let (found, report) = judged(folder.path(), &[name]);
        assert_eq!((found, &report["compared"]), (Some(0), &serde_json::json!(["rgb"])), "{name}: {report}");
    }
    let mut wrong = drawn.to_rgba8();
    wrong.pixels_mut().for_each(|pixel| pixel.0[2] = 255 - pixel.0[2]);
    wrong.save(folder.path().join("wrong.png")).unwrap();
    assert_eq!(judged(folder.path(), &["wrong.png"]).0, Some(1));
}

#[test]
fn every_engine_of_raster_passes() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.tri"), text(&triangles(3))).unwrap();
    for engine in ["golden", "fast", "model"] {
        let (code, error) = ended(
            &edgewalk(folder.path(), &["raster", "in.tri", "--engine", engine, "--out", engine])
                .output()
                .unwrap(),
        );
        assert_eq!(code, Some(0), "{error}");
        assert_eq!(judged(folder.path(), &[engine]).0, Some(0), "{engine}");
        let machine = judged(folder.path(), &[engine, "--against", "machine"]);
        assert_eq!(machine.0, Some(if engine == "golden" { 1 } else { 0 }), "{engine}: {}", machine.1);
    }
    // The text names what the JSON has.
    let output = edgewalk(folder.path(), &["judge", "in.tri", "golden"]).output().unwrap();
    let (text, report) = (String::from_utf8(output.stdout).unwrap(), judged(folder.path(), &["golden"]).1);
    for figure in [&report["agree"], &report["covered"], &report["pixels"]] {
        assert!(text.contains(&figure.to_string()), "{figure}: {text}");
    }
    let tolerance = report["tolerance"]["z"].as_f64().unwrap();
    assert!(text.contains(&format!("depth: tolerance {tolerance:.4} LSB of 24 bits")), "{text}");
    assert!(text.contains("pass"), "{text}");
}

#[test]
fn tolerance_is_that_of_the_formats_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let list = triangles(1);
    std::fs::write(folder.path().join("in.tri"), text(&list)).unwrap();
    write(folder.path(), &draw(&list, Fault::FewerBits));
    let cases: [(&[&str], i32); 4] =
        [(&[], 1), (&["--depth-bits", "20"], 0), (&["--depth-lsb", "9"], 0), (&["--depth-lsb", "4"], 1)];
    for (options, code) in cases {
        let (found, report) = judged(folder.path(), &[&["."], options].concat());
        assert_eq!(found, Some(code), "{options:?}: {report}");
    }
}

#[test]
fn arrays_that_cannot_be_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("in.tri"), text(&triangles(1))).unwrap();
    let values = |count: usize| vec![0u8; count * 8];
    let pixels = 64 * 48;
    for folder in [
        "short", "turned", "shape", "type", "cut", "header", "many", "empty", "int", "nonsense", "huge",
        "hex", "deep", "five", "four",
    ] {
        std::fs::create_dir(at(folder)).unwrap();
    }
    npy(&at("shape/z.npy"), "<f8", "(48, 65)", &values(48 * 65));
    npy(&at("huge/z.npy"), "<f8", "(4294967296, 4294967296, 0)", &[]);
    npy(&at("deep/z.npy"), "<f8", &("[".repeat(9000) + &"]".repeat(9000)), &[]);
    npy(&at("five/z.npy"), "<f8", "[[[[48]]]]", &[]);
    npy(&at("four/z.npy"), "<f8", "[[[48]]]", &[]);
    npy(&at("hex/z.npy"), "<f8", "(0x100000000, 0x100000000)", &[]);
    npy(&at("turned/rgb.npy"), "<f8", "(3, 48, 64)", &values(3 * pixels));
    npy(&at("type/z.npy"), "<c16", "(48, 64)", &values(2 * pixels));
    npy(&at("cut/z.npy"), "<f8", "(48, 64)", &values(pixels - 1));
    npy(&at("int/id.npy"), "<f8", "(48, 64)", &values(pixels));
    std::fs::create_dir(at("whole")).unwrap();
    npy(&at("whole/coverage.npy"), "<i4", "(48, 64)", &[[0, 0, 0, 0]; 64 * 48].concat());
    npy(&at("many/lit.npy"), "<i4", "(48, 64)", &[[0, 1, 0, 0]; 64 * 48].concat());
    std::fs::write(at("short/z.npy"), b"\x93NUM").unwrap();
    std::fs::write(at("header/z.npy"), b"\x93NUMPY\x02\x00\xff\xff\xff\x7f{}").unwrap();
    std::fs::write(
        at("nonsense/z.npy"),
        [b"\x93NUMPY\x01\x00\x10\x00".to_vec(), b"{'descr': <<<   \n".to_vec()].concat(),
    )
    .unwrap();
    std::fs::write(at("depth.npy"), b"").unwrap();
    std::fs::write(at("not.png"), b"nothing").unwrap();
    image::RgbImage::new(64, 47).save(at("small.png")).unwrap();
    image::RgbImage::new(64, 48).save(at("mine.png")).unwrap();
    let cases: [(&[&str], &str); 26] = [
        (&["huge"], "more values than 64 bits count; permitted: 64 columns, 48 lines"),
        (&["hex"], "a length that is no decimal number"),
        (&["shape"], "its shape is [48, 65]; permitted: [48, 64], lines from the top, columns"),
        (&["turned"], "its shape is [3, 48, 64]; permitted: [48, 64, 3]"),
        (&["type"], "permitted: float32, float64, or unsigned integers in LSB"),
        (&["cut"], "its values end early"),
        (&["int"], "permitted: bool, or integers of 8 to 64 bits"),
        (
            &["many"],
            "lit.npy: 256 in pixel (0, 0); permitted: 0 for nothing written, 1 for in shadow, 2 for lit; write them",
        ),
        (&["short"], "shorter than a header"),
        (&["header"], "permitted: 65536"),
        (&["five"], "its header has brackets 5 deep; permitted: 4; write the array with numpy.save"),
        (&["four"], "its header is none of numpy's ("),
        (&["deep"], "its header has brackets 9001 deep; permitted: 4"),
        (
            &["nonsense"],
            "z.npy: its header is none of numpy's (could not parse Python expression: syntax error:  --> 1:11); permitted: a \
             dictionary of descr",
        ),
        (&["empty"], "no array is there; permitted: one or more of coverage.npy"),
        (&["depth.npy"], "the name says nothing of what the file holds"),
        (&["none"], "the name says nothing of what the file holds"),
        (&["none.png"], "No such file"),
        (&["not.png"], "not.png"),
        (&["small.png"], "the picture has 64x47 pixels; permitted: 64x48"),
        (&["mine.png", "mine.png"], "given twice"),
        (&["whole/coverage.npy", "whole/coverage.npy"], "coverage.npy: given twice"),
        (&["mine.png", "--color-lsb=-1"], "permitted: 0 or more"),
        (&["mine.png", "--depth-bits", "49"], "49 is not in 1..=48"),
        (&["mine.png", "--rule", "left"], "possible values: top-left"),
        (
            &["mine.png", "--rule", "textbook", "--against", "machine"],
            "permitted with --against machine: top-left",
        ),
    ];
    for (arguments, message) in cases {
        let output = edgewalk(folder.path(), &[&["judge", "in.tri"], arguments].concat()).output().unwrap();
        let (code, error) = ended(&output);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        assert!(error.contains(message), "{arguments:?}: {error}");
    }
}

/// Without colours the arrays hold no triangle, and depths tell which one decides.
#[test]
fn depths_alone_name_cause_and_triangle() {
    let folder = tempfile::tempdir().unwrap();
    let far = "T 1 1 .5 1 0 0 0  7 1 .5 1 0 0 0  1 7 .5 0 1 0 0\n";
    let file = format!("size 8 8\ncolour_write 0\n{far}{}", far.replace(" .5 ", " .25 "));
    std::fs::write(folder.path().join("a.tri"), file).unwrap();
    let drawn = ["raster", "a.tri", "--engine", "golden", "--out", "p"];
    assert!(edgewalk(folder.path(), &drawn).status().unwrap().success());
    let bytes = std::fs::read(folder.path().join("p/z.npy")).unwrap();
    let first = bytes.len() - 8 * 64;
    for (pixel, depth, line) in [
        ((2, 2), 0.6, "  (2, 2) depth beyond the tolerance: triangle 1: 5872025.2500 LSB off\n"),
        ((2, 2), 0.5, "  (2, 2) wrong winner: triangle 0 for triangle 1; depth 4194303.7500 LSB off\n"),
        (
            (2, 2),
            1.0,
            "  (2, 2) missing: triangle 1: the centre lies 1.5000 px inside of the edge of vertices",
        ),
        ((7, 7), 0.5, "  (7, 7) extra: triangle "),
    ] {
        let at = first + 8 * (pixel.1 * 8 + pixel.0);
        let mut wrong = bytes.clone();
        wrong[at..at + 8].copy_from_slice(&f64::to_le_bytes(depth));
        std::fs::write(folder.path().join("z.npy"), wrong).unwrap();
        let output = edgewalk(folder.path(), &["judge", "a.tri", "z.npy", "--adapt"]).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "{depth}: {text}");
        assert!(text.contains(line), "{depth}: {text}");
    }
}
