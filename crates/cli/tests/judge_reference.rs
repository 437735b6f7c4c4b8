//! `edgewalk judge`: what it compares with what, and by how much a picture may be off.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, ended};
use serde_json::Value;
use std::path::Path;

/// Two triangles over most of the screen.
const TWO: &str = "size 32 32
T 1 1 .3 1 0 0 0  31 2 .5 0 1 0 0  2 30 .7 0 0 1 0
T 31 31 .4 1 1 0 0  31 2 .5 0 1 1 0  2 30 .6 1 0 1 0
";

/// A folder with this file.
fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.tri"), text).unwrap();
    folder
}

/// Draws into the folder `out`.
fn raster(folder: &Path, options: &[&str], out: &str) {
    let words = [&["raster", "in.tri", "--out", out], options].concat();
    let (code, error) = ended(&edgewalk(folder, &words).output().unwrap());
    assert_eq!(code, Some(0), "{words:?}: {error}");
}

/// Judges: exit code, report, message.
fn judged(folder: &Path, options: &[&str]) -> (Option<i32>, Value, String) {
    let words = [&["judge", "in.tri", "--json"], options].concat();
    let output = edgewalk(folder, &words).output().unwrap();
    let (code, error) = ended(&output);
    (code, serde_json::from_slice(&output.stdout).unwrap_or_default(), error)
}

/// A picture of `lit` alone has nothing in common with that of a machine without SHADOW.
#[test]
fn judge_that_compares_nothing_ends_with_2() {
    let folder = folder(TWO);
    raster(folder.path(), &["--engine", "golden"], "g");
    let (code, _, error) = judged(folder.path(), &["g/lit.npy", "--against", "machine"]);
    assert_eq!(code, Some(2), "{error}");
    for part in
        ["a machine without SHADOW has none", "permitted: one or more of coverage, id, z and rgb", "add"]
    {
        assert!(error.contains(part), "{error}");
    }
    let (code, report, error) = judged(folder.path(), &["g/lit.npy"]);
    assert_eq!((code, &report["compared"]), (Some(0), &serde_json::json!(["lit"])), "{error}");
}

/// Six layers of glass over half of the screen.
fn glass() -> String {
    let layer = |n: u32| {
        let (z, c) = (f64::from(6 - n) / 10.0, f64::from(n % 4) / 3.0);
        format!("T 0 0 {z} 1 {c} 0.3 .5  32 0 {z} {c} 1 0.1 .5  0 32 {z} 0.2 {c} 1 .5\n")
    };
    "size 32 32\nblend 1\n".to_owned() + &(0..6).map(layer).collect::<String>()
}

/// Bits that are the machine's own are no other format: the bound of the layers holds. Other bits have 1 LSB.
#[test]
fn bits_of_the_machine_leave_its_bounds() {
    let glass = glass();
    for (text, set) in [(TWO, "blend.kind=none"), (&glass[..], "blend.kind=constant")] {
        let (folder, set) = (folder(text), ["--set", set]);
        raster(folder.path(), &set, "m");
        let judged = |options: &[&str]| judged(folder.path(), &[&["m"], &set[..], options].concat());
        let (code, report, error) = judged(&[]);
        let (own, other) = (["--color-bits", "8", "--depth-bits", "24"], ["--color-bits", "7"]);
        assert_eq!(code, Some(0), "{error}{report}");
        let (code, with_bits, error) = judged(&own);
        assert_eq!((code, &with_bits), (Some(0), &report), "{error}");
        assert_eq!(judged(&other).1["tolerance"]["color"], 1.0);
        let is_glass = text != TWO;
        let layers = &report["tolerance"]["layers"];
        assert_eq!(layers.as_f64().is_some_and(|most| most > 1.0), is_glass, "{layers}");
        assert!(judged(&other).1["tolerance"]["layers"].is_null());
        let text =
            edgewalk(folder.path(), &["judge", "in.tri", "m", set[0], set[1]]).output().unwrap().stdout;
        assert_eq!(String::from_utf8(text).unwrap().contains("behind the layers of a pixel"), is_glass);
    }
}

/// Where sums may wrap nothing is proved. The report says so, what holds instead, and how to ask for something else.
#[test]
fn tolerance_without_a_proof_is_told() {
    let glass = "size 640 4\nblend 1\nT 0 0 .5 1 0 0 .5  640 0 .6 0 1 .3 .5  0 4 .7 0 .2 1 .5\n";
    let plain = glass.replace("blend 1\n", "");
    let narrow = ["--adapt", "--set", "formats.color_fraction=5"];
    let shallow = ["--adapt", "--set", "formats.z_fraction=5"];
    let kt = ["--adapt", "--set", "blend.kind=interpolated", "--set", "blend.kt_fraction=5"];
    let why = "8833 additions may err by 138.03125 LSB";
    let mut checked = 0;
    for (text, set, key, name, option) in [
        (glass, &narrow[..], "color_no_bound", "colour", "--color-lsb"),
        (&plain, &narrow, "color_no_bound", "colour", "--color-lsb"),
        (glass, &kt, "color_no_bound", "colour", "--color-lsb"),
        (&plain, &shallow, "z_no_bound", "depth", "--depth-lsb"),
    ] {
        let folder = folder(text);
        raster(folder.path(), set, "m");
        let (_, report, error) = judged(folder.path(), &[&["m"], set].concat());
        let tolerance = &report["tolerance"];
        assert!(tolerance[key].as_str().is_some_and(|told| told.starts_with(why)), "{error}{tolerance}");
        let told = ["z_no_bound", "color_no_bound"].iter().filter(|key| !tolerance[key].is_null()).count();
        assert_eq!(told, 1, "{tolerance}");
        let said = |options: &[&str]| {
            let words = [&["judge", "in.tri", "m"], set, options].concat();
            String::from_utf8(edgewalk(folder.path(), &words).output().unwrap().stdout).unwrap()
        };
        let line = said(&[]);
        let line = line.lines().find(|line| line.contains("no bound is proved")).unwrap();
        assert!(line.starts_with(&format!("{name}: no bound is proved: {why}")), "{line}");
        let end = format!("; the tolerance takes 1 LSB for such a value; {option} sets another tolerance");
        assert!(line.ends_with(&end), "{line}");
        // What is asked for is no bound.
        for options in [&[option, "999"][..], &["--against", "machine"]] {
            let (code, report, error) = judged(folder.path(), &[&["m"], set, options].concat());
            assert_eq!((code, &report["tolerance"][key]), (Some(0), &Value::Null), "{error}{report}");
            assert!(!said(options).contains("no bound"), "{options:?}");
        }
        checked += 1;
    }
    assert_eq!(checked, 4);
}

/// Slivers of 1 to 2 pixels, whose colour runs across them.
fn slivers() -> String {
    let sliver = |n: u32| {
        let x = 1.03 + 1.9 * f64::from(n) + 0.01 * f64::from(n * n % 7);
        let (right, low) = (x + 1.37, x + 0.31);
        let ends = format!("P 4  {x} 0 .5 0 0 0 0  {right} 0 .5 1 1 1 0");
        format!("{ends}  {} 480 .5 1 1 1 0  {low} 480 .5 0 0 0 0\n", low + 1.37)
    };
    "size 64 480\n".to_owned() + &(0..30).map(sliver).collect::<String>()
}

/// A light whose map hides the left half of the screen, over a surface of running colours.
const SHADE: &str = "size 64 64
shadow 4 0.001 0.3   0.0625 0 0 0   0 0.0625 0 0   0 0 1 0   0 0 0 1
L  0 0 0.25   2 0 0.25   0 4 0.25
L  2 0 0.25   2 4 0.25   0 4 0.25
T 0 0 .5 1 0.9 0.1 0  64 0 .5 0 0.5 1 0  0 64 .5 0.3 1 0.7 0
T 64 64 .5 0.2 0.4 0.6 0  64 0 .5 0 0.5 1 0  0 64 .5 0.3 1 0.7 0
";

/// A polygon in a steep plane: its corners lie in it before they are snapped.
fn steep() -> String {
    let corners = [(3.137, 4.259), (50.713, 9.441), (60.377, 33.519), (33.9, 58.3), (5.3, 30.77)];
    let corner = |(x, y): (f64, f64)| {
        let (z, c) = (0.1 + x * 0.0077 + y * 0.0061, 0.05 + x * 0.006 + y * 0.007);
        format!("  {x} {y} {z} {c} {} {} 0", 1.0 - c, 0.5 * c)
    };
    "size 64 64\nP 5".to_owned() + &corners.map(corner).concat() + "\n"
}

/// What `render` takes for right passes, and the tolerance is the bound that `render` proves of the machine.
#[test]
fn tolerance_has_dither_lights_and_polygons() {
    let (slivers, steep) = (slivers(), steep());
    let cases: [(&str, &[&str], f64); 6] = [
        (TWO, &["--set", "dither.bits=4"], 17.0),
        (SHADE, &["--adapt"], 1.2),
        (&slivers, &["--machine", "bilinear"], 1.0),
        (&steep, &["--machine", "polygon"], 0.5),
        (&steep, &["--machine", "bilinear"], 0.5),
        (SHADE, &["--adapt", "--set", "dither.bits=4"], 17.0),
    ];
    for (text, options, least) in cases {
        let folder = folder(text);
        raster(folder.path(), options, "m");
        let words = [&["render", "in.tri", "--json", "--out", "r"], options].concat();
        let rendered = edgewalk(folder.path(), &words).output().unwrap().stdout;
        let rendered: Value = serde_json::from_slice(&rendered).unwrap();
        // Coverage by slope edges is golden's but for single pixels, which are no matter of the tolerance.
        std::fs::remove_file(folder.path().join("m/coverage.npy")).unwrap();
        std::fs::remove_file(folder.path().join("m/id.npy")).unwrap();
        let (code, report, error) = judged(folder.path(), &[&["m"], options].concat());
        let causes = report["causes"].as_array().unwrap().iter();
        let beyond = causes.filter(|count| ["depth", "color"].contains(&count["cause"].as_str().unwrap()));
        let beyond: u64 = beyond.map(|count| count["pixels"].as_u64().unwrap()).sum();
        assert_eq!(beyond, 0, "{options:?}: {error}{report}");
        assert!(code == Some(0) || options.contains(&"bilinear"), "{options:?}: {report}");
        let of = |value: &Value| value.as_f64().unwrap();
        let tolerance = of(&report["tolerance"]["color"]);
        assert_eq!(tolerance, of(&rendered["comparison"]["color_bound"]), "{options:?}");
        assert_eq!(of(&report["tolerance"]["z"]), of(&rendered["comparison"]["z_bound"]), "{options:?}");
        assert!(tolerance > least, "{options:?}: {tolerance}");
    }
}

/// A square of one colour under a triangle.
const SQUARE: &str = "size 32 32
P 4  2 2 .5 1 0 0 0  30 2 .5 1 0 0 0  30 30 .5 1 0 0 0  2 30 .5 1 0 0 0
T 4 4 .3 0 1 0 0  28 5 .3 0 1 0 0  5 28 .3 0 1 0 0
";

/// What `raster` writes is right by every machine: ids are places in the file, golden's values run along edges.
#[test]
fn pictures_of_polygons_are_judged_whole() {
    let scene = |name: &str| {
        let path = format!("{}/../../docs/scenes/{name}.tri", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).unwrap()
    };
    let mut polygons = 0;
    for text in
        [scene("quad"), scene("depth"), scene("polygon"), scene("polygons"), SQUARE.to_owned(), steep()]
    {
        polygons += text.lines().filter(|line| line.starts_with('P')).count();
        let folder = folder(&text);
        raster(folder.path(), &["--engine", "golden"], "g");
        // Golden draws edges that cross; only POLY does.
        let crosses = text.contains("crossing");
        for preset in ["default", "polygon", "bilinear"] {
            let machine = ["--machine", preset];
            let (code, report, error) = judged(folder.path(), &[&["g"], &machine[..]].concat());
            assert_eq!(code, Some(0), "{preset}: {text}{error}{report}");
            if preset == "default" && crosses {
                continue;
            }
            raster(folder.path(), &machine, preset);
            let against = [&[preset, "--against", "machine"], &machine[..]].concat();
            let (code, report, error) = judged(folder.path(), &against);
            assert_eq!(code, Some(0), "{preset}: {text}{error}{report}");
        }
    }
    assert!(polygons > 10, "{polygons}");
}

/// A flat polygon drawn as triangles is within the tolerance; of a bent one depths and colours are others, its pixels are not.
#[test]
fn triangles_of_flat_polygon_are_within_tolerance() {
    let bent = steep().replace("0.1", "0.9");
    for (text, wrong) in [(steep(), false), (bent, true)] {
        let folder = folder(&text);
        raster(folder.path(), &[], "m");
        let (code, report, error) = judged(folder.path(), &["m"]);
        assert_eq!(code, Some(i32::from(wrong)), "{error}{report}");
        for count in report["causes"].as_array().unwrap() {
            let is_value = ["depth", "color"].contains(&count["cause"].as_str().unwrap());
            assert!(is_value || count["pixels"] == 0, "{report}");
        }
    }
}

/// A finding names polygons, and the edge of one that decides.
#[test]
fn findings_name_polygons_and_their_edges() {
    let folder = folder(SQUARE);
    let less = SQUARE.replace("30 30", "30 29").replace("2 30 .5", "2 29 .5").replace("28 5 .3", "28 5 .7");
    let less = less.replace("4 4 .3", "4 4 .7").replace("5 28 .3", "5 28 .7");
    std::fs::write(folder.path().join("less.tri"), less).unwrap();
    let words = ["raster", "less.tri", "--engine", "golden", "--out", "less"];
    assert_eq!(ended(&edgewalk(folder.path(), &words).output().unwrap()).0, Some(0));
    let text = edgewalk(folder.path(), &["judge", "in.tri", "less"]).output().unwrap().stdout;
    let text = String::from_utf8(text).unwrap();
    let missing = ": polygon 0: the centre lies 0.5000 px inside of the edge of vertices 3 and 4";
    for part in [missing, ": polygon 0 for triangle 1; depth"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// Two machines that draw the same things show the same things, whatever parts they draw them as.
#[test]
fn compared_machines_show_places_in_the_input() {
    let depth =
        std::fs::read_to_string(format!("{}/../../docs/scenes/depth.tri", env!("CARGO_MANIFEST_DIR")));
    // It reaches beyond a guard band of 8 bits, and is cut there.
    let wide = "size 160 120
T -300 -300 .5 1 0 0 0  500 -10 .5 0 1 0 0  -10 600 .5 0 0 1 0
T 10 10 .2 1 0 0 0  100 10 .2 1 0 0 0  10 100 .2 1 0 0 0
";
    // Two squares: POLY draws a face, another machine two triangles.
    let faces = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\n";
    let folder = folder(SQUARE);
    for (name, text) in [("depth.tri", &depth.unwrap()[..]), ("wide.tri", wide), ("faces.obj", faces)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let screen = ["--set", "screen.width=160", "--set", "screen.height=120"];
    let cases: [(&str, &str, &[&str]); 4] = [
        ("in.tri", "polygon", &[]),
        ("depth.tri", "polygon", &[]),
        ("wide.tri", "default,screen.guard_bits=8", &[]),
        ("faces.obj", "polygon", &screen),
    ];
    for (input, other, options) in cases {
        let words =
            [&["compare", "default", other, input, "--shading", "constant", "--json"], options].concat();
        let words: Vec<&str> = match input.ends_with(".tri") {
            true => words.into_iter().filter(|word| !["--shading", "constant"].contains(word)).collect(),
            false => words,
        };
        let output = edgewalk(folder.path(), &words).output().unwrap();
        assert_eq!(ended(&output).0, Some(0), "{input}: {}", ended(&output).1);
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        let pixels = &report["pixels"];
        assert_eq!((&pixels["triangle"], &pixels["coverage"]), (&0.into(), &0.into()), "{input}: {pixels}");
    }
    // Another thing that shows is counted.
    let near = "size 32 32\nT 1 1 .5 1 0 0 0  31 1 .5 1 0 0 0  1 31 .5 1 0 0 0
P 3 1 1 .4999 0 1 0 0  31 1 .4999 0 1 0 0  1 31 .4999 0 1 0 0\n";
    std::fs::write(folder.path().join("near.tri"), near).unwrap();
    let words = ["compare", "default", "polygon,formats.z_bits=8", "near.tri", "--json"];
    let report: Value =
        serde_json::from_slice(&edgewalk(folder.path(), &words).output().unwrap().stdout).unwrap();
    assert!(report["pixels"]["triangle"].as_u64().unwrap() > 300, "{}", report["pixels"]);
}

/// Lines have a rule of their own, which no rule of edges turns round.
#[test]
fn rules_of_edges_refuse_lines() {
    let triangle = "size 48 48\nT 4.1 4.3 .3 0 1 0 0  20.2 5.4 .3 0 1 0 0  5.7 28.8 .3 0 1 0 0\n";
    let with_line = triangle.to_owned() + "S 24 2 .5 1 0 0 0  40 46 .5 0 0 1 0\n";
    for (text, code) in [(triangle, 0), (&with_line, 2)] {
        let folder = folder(text);
        raster(folder.path(), &["--adapt"], "m");
        for rule in ["top-right", "bottom-left", "bottom-right"] {
            let (found, _, error) = judged(folder.path(), &["m", "--adapt", "--rule", rule]);
            assert_eq!(found, Some(code), "{rule}: {error}");
            if code == 2 {
                for part in
                    [rule, "the frame has lines; permitted with this rule: triangles", "judge it by top-left"]
                {
                    assert!(error.contains(part), "{error}");
                }
            }
        }
        assert_eq!(judged(folder.path(), &["m", "--adapt", "--rule", "top-left"]).0, Some(0));
    }
}

/// An array of numpy with 32 x 32 values, or colours.
fn npy(path: &Path, descr: &str, each: usize, value: &[u8]) {
    let colors = if each == 3 { ", 3" } else { "" };
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': (32, 32{colors}), }}");
    let padded = format!("{header:<117}\n");
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((padded.len() as u16).to_le_bytes());
    file.extend(padded.as_bytes());
    file.extend(value.repeat(32 * 32 * each));
    std::fs::write(path, file).unwrap();
}

/// `judge` refuses values outside the permitted range. The error names the pixel and the range.
#[test]
fn values_out_of_range_are_refused() {
    let folder = folder(TWO);
    let float = |value: f64| value.to_le_bytes().to_vec();
    let floats =
        "permitted: floats in 0 to 1, or unsigned integers in LSB; divide by the value that stands for 1";
    let cases: [(&str, &str, Vec<u8>, [&str; 2]); 10] = [
        ("z", "<f8", float(5.0), ["5 in pixel (0, 0)", floats]),
        ("z", "<f8", float(-3.0), ["-3 in pixel (0, 0)", floats]),
        ("z", "<f8", float(f64::INFINITY), ["inf in pixel (0, 0)", floats]),
        ("z", "<f8", float(f64::NAN), ["NaN in pixel (0, 0)", floats]),
        ("rgb", "<f4", 255f32.to_le_bytes().to_vec(), ["255 in pixel (0, 0)", floats]),
        (
            "id",
            "<u4",
            vec![0xff; 4],
            ["4294967295 in pixel (0, 0)", "permitted: -1 for none, or a place in the input"],
        ),
        (
            "id",
            "<i4",
            (-2i32).to_le_bytes().to_vec(),
            ["-2 in pixel", "0 to 2147483647; write them as int32"],
        ),
        ("id", "<u8", vec![0xff; 8], ["18446744073709551615 in pixel", "permitted: -1 for none"]),
        (
            "coverage",
            "<i4",
            vec![0xff; 4],
            ["-1 in pixel (0, 0)", "permitted: 0 to 4294967295, the number of"],
        ),
        (
            "lit",
            "|u1",
            vec![3],
            ["3 in pixel (0, 0)", "permitted: 0 for nothing written, 1 for in shadow, 2 for lit"],
        ),
    ];
    for (name, descr, value, parts) in cases {
        let file = folder.path().join(format!("{name}.npy"));
        npy(&file, descr, if name == "rgb" { 3 } else { 1 }, &value);
        let (code, _, error) = judged(folder.path(), &[&format!("{name}.npy")]);
        assert_eq!(code, Some(2), "{name} {value:?}: {error}");
        for part in parts {
            assert!(error.contains(part), "{name} {value:?}: {error}");
        }
        std::fs::remove_file(file).unwrap();
    }
    // Single precision may be a little outside.
    npy(&folder.path().join("z.npy"), "<f4", 1, &1.000_001f32.to_le_bytes());
    assert_eq!(judged(folder.path(), &["z.npy"]).0, Some(1));
}

/// A picture without its shadows is wrong, where layers lie over one another too.
#[test]
fn blended_pixels_must_be_in_shadow() {
    let glass = SHADE.replace("0.1 0  64", "0.1 .25  64").replace("0.6 0  64", "0.6 .25  64");
    let glass = glass.replace("1 0  0 64", "1 .25  0 64").replace("0.7 0\n", "0.7 .25\n");
    for text in [SHADE.to_owned(), glass.replacen('\n', "\nblend 1\n", 1)] {
        let folder = folder(&text);
        let lit: Vec<&str> =
            text.lines().filter(|line| !line.starts_with(['s', 'L']) || line.starts_with("size")).collect();
        std::fs::write(folder.path().join("lit.tri"), lit.join("\n")).unwrap();
        raster(folder.path(), &["--adapt"], "m");
        assert_eq!(judged(folder.path(), &["m", "--adapt"]).0, Some(0), "{text}");
        let words = ["raster", "lit.tri", "--adapt", "--out", "lit"];
        assert_eq!(ended(&edgewalk(folder.path(), &words).output().unwrap()).0, Some(0));
        let (code, report, error) = judged(folder.path(), &["lit/rgb.npy", "--adapt"]);
        assert_eq!(code, Some(1), "{text}{error}");
        assert!(report["wrong"].as_u64().unwrap() > 1000, "{report}");
    }
}

/// By the textbook rule a triangle covers centres beside it, where its plane leaves 0 to 1.
#[test]
fn goldens_textbook_arrays_are_judged() {
    let folder = folder(
        "size 33 17
T 2.3 2.4 0 1 0 0 0  30.2 3.7 1 0 1 0 0  12.6 14.3 0.5 0 0 1 0
T 20.1 3 1 0 1 0 0  22.2 15.7 0 0 1 0 0  31.6 9.3 0 0 0 1 0
",
    );
    let textbook = ["--machine", "textbook"];
    raster(folder.path(), &["--engine", "golden", "--machine", "textbook"], "g");
    let (code, report, error) = judged(folder.path(), &[&["g"], &textbook[..]].concat());
    assert_eq!((code, &report["wrong"]), (Some(0), &0.into()), "{error}");
    // By another rule such floats are wrong values.
    let (code, _, error) = judged(folder.path(), &["g"]);
    assert!(code == Some(2) && error.contains("permitted: floats in 0 to 1"), "{error}");
    // What is no number is refused by every rule.
    let mut bytes = std::fs::read(folder.path().join("g/z.npy")).unwrap();
    let end = bytes.len() - 8;
    bytes[end..].copy_from_slice(&f64::NAN.to_le_bytes());
    std::fs::write(folder.path().join("g/z.npy"), bytes).unwrap();
    let (code, _, error) = judged(folder.path(), &[&["g"], &textbook[..]].concat());
    assert!(code == Some(2) && error.contains("NaN in pixel (32, 16); permitted: finite floats"), "{error}");
}

/// Two panes whose depths are nearer than the bound, and a third one apart from them.
fn panes(order: [usize; 3]) -> String {
    let pane =
        |z: &str, [a, b, c]: [&str; 3]| format!("T 5 5 {z} {a} .5  50 8 {z} {b} .5  20 40 {z} {c} .5\n");
    let near = [
        pane("0.5", ["1 0 0", "0 1 0", "0 0 1"]),
        pane("0.50000003", ["0 0 1", "1 0 0", "0 1 0"]),
        "T 40 40 .3 1 0 0 .5  60 40 .3 0 1 0 .5  60 45 .3 0 0 1 .5\n".to_owned(),
    ];
    "size 64 48\nblend 1\n".to_owned() + &order.map(|place| near[place].clone()).concat()
}

/// Where depths are nearer than the tolerance, any pane may be in front; elsewhere a wrong colour is wrong.
#[test]
fn open_depth_tests_among_layers_are_counted() {
    let glass = ["--set", "blend.kind=constant"];
    for (order, places) in [([0, 1, 2], 0), ([1, 0, 2], 1)] {
        let folder = folder(&panes(order));
        raster(folder.path(), &glass, "m");
        let (code, report, error) = judged(folder.path(), &[&["m"], &glass[..]].concat());
        assert_eq!((code, &report["wrong"]), (Some(0), &0.into()), "{error}");
        let open = |report: &Value| {
            let causes = report["causes"].as_array().unwrap();
            causes.iter().find(|count| count["cause"] == "open").unwrap()["pixels"].as_u64().unwrap()
        };
        assert_eq!(open(&report) > 500, places == 1, "{report}");
        // The machine's picture has one way alone.
        let against = [&["m", "--against", "machine"], &glass[..]].concat();
        let (code, report, error) = judged(folder.path(), &against);
        assert_eq!((code, open(&report)), (Some(0), 0), "{error}");
        // The panes in the other order are allowed in the first two's pixels, not when the third is dark.
        std::fs::write(
            folder.path().join("in.tri"),
            panes(order).replace("0 1 0 .5  60 45", "0 0 0 .5  60 45"),
        )
        .unwrap();
        let (code, report, error) = judged(folder.path(), &[&["m"], &glass[..]].concat());
        assert_eq!(code, Some(1), "{error}");
        assert!((1..60).contains(&report["wrong"].as_u64().unwrap()), "{report}");
    }
    // Nothing but open pixels, none of which agrees: nothing was compared.
    let folder =
        folder(&panes([0, 1, 2]).lines().take(4).map(|line| line.to_owned() + "\n").collect::<String>());
    raster(folder.path(), &glass, "m");
    let dark = |text: String| {
        text.replace("1 0 0 .5", "0 0 0 .5").replace("0 1 0 .5", "0 0 0 .5").replace("0 0 1 .5", "0 0 0 .5")
    };
    let text = std::fs::read_to_string(folder.path().join("in.tri")).unwrap();
    std::fs::write(folder.path().join("in.tri"), dark(text)).unwrap();
    let (code, _, error) = judged(folder.path(), &[&["m/rgb.npy"], &glass[..]].concat());
    assert_eq!(code, Some(2), "{error}");
    assert!(error.contains("two depths are nearer than their bound"), "{error}");
}

/// A machine with a screen door drops fragments of glass by its pattern, and golden too.
#[test]
fn screen_doors_are_judged() {
    let folder = folder(&panes([0, 2, 1]).replace("0.50000003", "0.7"));
    let door = ["--set", "dither.screen_door=yes"];
    for engine in [&[][..], &["--engine", "golden"]] {
        raster(folder.path(), &[engine, &door[..]].concat(), "m");
        let (code, report, error) = judged(folder.path(), &[&["m"], &door[..]].concat());
        assert_eq!((code, &report["wrong"]), (Some(0), &0.into()), "{error}{report}");
    }
    let (code, _, error) = judged(folder.path(), &[&["m", "--rule", "bottom-left"], &door[..]].concat());
    assert!(code == Some(2) && error.contains("the frame has glass of a screen door"), "{error}");
    // A fragment where the pattern has a hole is wrong.
    raster(folder.path(), &["--set", "blend.kind=constant"], "full");
    let (code, report, error) = judged(folder.path(), &[&["full"], &door[..]].concat());
    assert_eq!(code, Some(1), "{error}");
    assert!(report["wrong"].as_u64().unwrap() > 300, "{report}");
}

/// A PNG has bits of its own, to which it rounds the machine's colours.
#[test]
fn pngs_of_machines_of_other_bits_are_right() {
    let folder = folder(TWO);
    for (bits, others) in [("6", "7"), ("4", "5"), ("12", "5")] {
        let with = |bits: &str| ["--set".to_owned(), format!("formats.color_bits={bits}")];
        for (out, bits) in [("own", bits), ("other", others)] {
            let [set, key] = with(bits);
            let words = ["render", "in.tri", "--out", out, &set, &key];
            assert_eq!(ended(&edgewalk(folder.path(), &words).output().unwrap()).0, Some(0), "{words:?}");
        }
        let [set, key] = with(bits);
        for (picture, code) in [("own/image.png", Some(0)), ("other/image.png", Some(1))] {
            let (found, report, error) =
                judged(folder.path(), &[picture, "--against", "machine", &set, &key]);
            assert_eq!(found, code, "{bits}: {error}{report}");
            assert_eq!(report["wrong"].as_u64().unwrap() > 100, code == Some(1), "{bits}: {report}");
        }
        let (found, report, error) = judged(folder.path(), &["own/image.png", &set, &key]);
        assert_eq!((found, &report["wrong"]), (Some(0), &0.into()), "{bits}: {error}");
        // What the user asks for holds as it is.
        let asked = ["own/image.png", "--color-lsb", "0.5", &set, &key];
        let (_, report, _) = judged(folder.path(), &asked);
        assert_eq!(report["tolerance"]["color"], 0.5, "{bits}");
    }
}
