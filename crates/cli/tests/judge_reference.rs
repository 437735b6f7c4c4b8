//! `edgewalk judge`: by how much a picture may be off, and of what its findings tell.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::judging::{SHADE, TWO, folder, judged, raster};
use crate::support::{edgewalk, ended};
use serde_json::Value;

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
