//! Textures through the program: the example of `docs/triangle_file.md`, a scene, and faults in them.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, npy, run};
use std::path::Path;

/// The example of the chapter on textures.
fn example() -> String {
    let page = include_str!("../../../docs/triangle_file.md");
    let chapter = page.split_once("\n## Textures\n").unwrap().1;
    chapter.split("```").nth(1).unwrap().trim_start().to_owned()
}

const TEXTURED: [&str; 4] = ["--set", "shade.colour=multiply", "--set", "texture.kind=nearest"];

fn colors(folder: &Path, engine: &str) -> Vec<f64> {
    let (kind, shape, bytes) = npy(&folder.join(engine).join("rgb.npy"));
    assert_eq!((&*kind, &shape[..]), ("<f8", &[32, 32, 3][..]));
    bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
}

#[test]
fn the_example_of_the_reference_shows_its_texels() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), example()).unwrap();
    let fast = example().replace("mode phong", "mode fast-phong");
    std::fs::write(folder.path().join("b.tri"), fast).unwrap();
    let texels = [[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0.0, 0.0, 1.0], [1.0; 3]]];
    let (mut checked, mut seen) = (0, [0; 4]);
    for (file, kind) in [("a.tri", "shade.kind=phong"), ("b.tri", "shade.kind=fast-phong")] {
        let golden = ["raster", file, "--engine", "golden", "--out", "golden"];
        assert_eq!(run(folder.path(), &golden).0, Some(0));
        for engine in ["fast", "model", "rtl"] {
            let raster = ["raster", file, "--engine", engine, "--out", engine, "--set", kind];
            let small = ["--set", "texture.bits=3", "--set", "shade.material_bits=1"];
            let (code, error) = run(folder.path(), &[&raster[..], &TEXTURED, &small].concat());
            assert_eq!(code, Some(0), "{error}");
        }
        let [golden, fast, model, rtl] =
            ["golden", "fast", "model", "rtl"].map(|engine| colors(folder.path(), engine));
        assert!(fast == model && model == rtl, "the same machine");
        for (x, y) in (0..32).flat_map(|y| (0..32).map(move |x| (x, y))) {
            let (px, py) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            if px < 1.0 || py < 1.0 || px + py >= 32.0 {
                continue;
            }
            // The picture is twice 2 texels in 40 pixels, its upper left corner at 1, 1 half a picture down.
            let place = [px - 1.0, py - 1.0 + 10.0].map(|p| p / 10.0);
            let [column, line] = place.map(|p| p as usize % 2);
            let at = (y as usize * 32 + x as usize) * 3;
            for k in 0..3 {
                let wanted = texels[line][column][k] * (0.1 + 0.8 * 0.9);
                assert!((golden[at + k] - wanted).abs() < 1e-9, "pixel {x} {y}: {} {wanted}", golden[at + k]);
                assert!(
                    (fast[at + k] - wanted).abs() * 255.0 < 2.5,
                    "pixel {x} {y}: {} {wanted}",
                    fast[at + k]
                );
            }
            seen[2 * line + column] += 1;
            checked += 1;
        }
    }
    println!("{checked} pixels, by texel {seen:?}");
    assert!(checked > 800 && seen.iter().all(|count| *count > 80), "{seen:?}");
}

/// A square of two triangles with a picture of 3 by 2 texels, which no machine has as it is.
const SCENE: &str = "ambient = 0.1
[camera]
eye = [0, 0, 3]
target = [0, 0, 0]
[[material]]
name = \"board\"
diffuse = [0.8, 0.7, 0.5]
specular = 0.3
exponent = 20
texture = \"board.png\"
texels = \"nearest\"
[[object]]
positions = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
faces = [[0, 1, 2, 3]]
uv = [[0, 0], [2.1, 0], [2.1, 1.9], [0, 1.9]]
material = \"board\"
[[light]]
kind = \"directional\"
toward = [0.2, 0.3, 1]
";

/// The scene and its picture of such sides.
fn scene(folder: &Path, (width, height): (u32, u32)) {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    let texels: Vec<u8> = (0..width * height * 3).map(|k| (k * 89 % 256) as u8).collect();
    writer.write_image_data(&texels).unwrap();
    writer.finish().unwrap();
    std::fs::write(folder.join("board.png"), bytes).unwrap();
    std::fs::write(folder.join("s.toml"), SCENE).unwrap();
}

const SMALL: [&str; 4] = ["--set", "screen.width=160", "--set", "screen.height=120"];

#[test]
fn render_counts_and_explains_the_texels_of_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    for (shading, engine, sides, more) in [
        ("fast-phong", "fast", (4, 8), &[][..]),
        ("phong", "model", (4, 8), &["--set", "term.linear_fraction=4"]),
        ("phong", "rtl", (2, 2), &["--set", "texture.bits=2", "--set", "shade.material_bits=0"]),
        ("fast-phong", "fast", (3, 2), &["--set", "texture.bits=2", "--set", "term.walk=memory"]),
    ] {
        scene(folder.path(), sides);
        let kind = format!("shade.kind={shading}");
        let render = ["render", "s.toml", "--shading", shading, "--engine", engine, "--json", "--out", "r"];
        let all = [&render[..], &SMALL, &TEXTURED, &["--set", &kind], more].concat();
        let output = edgewalk(folder.path(), &all).output().unwrap();
        assert!(output.status.success(), "{all:?}: {}", String::from_utf8_lossy(&output.stderr));
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let (shaded, texels) = (&report["comparison"]["shaded"], &report["comparison"]["shaded"]["texels"]);
        let number = |of: &serde_json::Value, key: &str| of[key].as_f64().unwrap();
        println!("{shading} {engine} {sides:?}: {shaded}");
        assert!(number(texels, "pixels") > 3000.0 && number(texels, "pixels") == number(shaded, "pixels"));
        assert!(number(texels, "unexplained") == 0.0 && number(shaded, "beyond") == 0.0);
        assert!(number(shaded, "error") <= number(shaded, "bound") && number(shaded, "bound") < 6.0);
        assert_eq!(number(texels, "resampled") > 0.0, sides.0 == 3, "{texels}");
        if more.contains(&"term.linear_fraction=4") {
            assert!(number(texels, "differ") > 10.0, "{texels}");
        }
    }
}

#[test]
fn explain_shows_place_texel_address_word_and_product() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), (4, 8));
    let mut checked = 0;
    for (shading, kind) in [("fast-phong", "shade.kind=fast-phong"), ("phong", "shade.kind=phong")] {
        let explain = ["explain", "s.toml", "80", "60", "--shading", shading, "--set", kind];
        let output = edgewalk(folder.path(), &[&explain[..], &SMALL, &TEXTURED].concat()).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{text} {}", String::from_utf8_lossy(&output.stderr));
        for word in ["u, Q8.10", "v, Q8.10", "texel column", "golden's place", "address"] {
            assert!(text.contains(word), "{word:?} is not in {text}");
        }
        let behind = |line: &str, word: &str| -> f64 {
            let rest = line.split_once(word).unwrap().1.trim_start();
            rest.split([';', ',', ' ', ':']).next().unwrap().parse().unwrap()
        };
        let line = text.lines().find(|line| line.starts_with("texel column")).unwrap();
        let (column, row, address) = (behind(line, "column"), behind(line, "line"), behind(line, "address"));
        assert_eq!(address, row * 256.0 + column, "{line}");
        // Of 4 x 8 texels each is 64 x 32 of the machine's.
        let texel = (row as u32 / 32 * 4 + column as u32 / 64) * 3;
        for (k, name) in ["red", "green", "blue"].into_iter().enumerate() {
            assert_eq!(behind(line, name), f64::from((texel + k as u32) * 89 % 256), "{line}");
        }
        for line in text.lines().filter(|line| line.contains("/ max")) {
            assert!(behind(line, "error").abs() <= behind(line, "bound"), "{line}");
            checked += 1;
        }
    }
    assert_eq!(checked, 6);
}

/// The bound of a colour holds with the machine's texel: where golden's picture has another, `explain` says so, and why.
#[test]
fn explain_says_where_golden_has_another_texel() {
    let folder = tempfile::tempdir().unwrap();
    let of_three = "3 1  ff0000 00ff00 0000ff";
    let of_four = "2 2  ff0000 00ff00 0000ff ffffff";
    let mut checked = 0;
    for (texture, u, other) in [
        (of_three, "0.3328", Some(("sides", "the sides of its picture do not divide 256"))),
        (of_three, "0.25", None),
        (of_four, "0.3328", None),
        (of_four, "0.4999999", Some(("neighbour", "the terms name a neighbour"))),
    ] {
        let file = format!(
            "size 32 32\nmode phong\nview 0 0 1\nsun 0 0 1 0.9\nmaterial 0.1 0.8 0 1\ntexture {texture}\n\
             T 1 1 0.5 1 1 1 0   31 1 0.5 1 1 1 0   1 31 0.5 1 1 1 0\n\
             N 0 0 1  0 0 1  0 0 1\nUV {u} 0.75 {u} 0.75 {u} 0.75\n"
        );
        std::fs::write(folder.path().join("a.tri"), file).unwrap();
        let told = |more: &[&str]| {
            let explain = [&["explain", "a.tri", "5", "5", "--adapt"], more].concat();
            String::from_utf8(edgewalk(folder.path(), &explain).output().unwrap().stdout).unwrap()
        };
        let json: serde_json::Value = serde_json::from_str(&told(&["--json"])).unwrap();
        let shaded = &json["shaded"][0];
        assert_eq!(shaded["texel"]["other_texel"].as_str(), other.map(|other| other.0), "{shaded}");
        let off = [0, 1, 2].map(|k| {
            let stored = json["stored"]["rgb"][k].as_f64().unwrap();
            (stored - json["rgb"][k].as_f64().unwrap() * 255.0).abs()
        });
        let within = off.into_iter().all(|off| off <= shaded["bound"].as_f64().unwrap());
        assert_eq!(within, other.is_none(), "{off:?}: {shaded}");
        let page = told(&[]);
        assert_eq!(page.contains(" LSB of golden's with the machine's texel\n"), other.is_some(), "{page}");
        assert!(other.is_none_or(|(_, why)| page.contains(why)), "{page}");
        checked += 1;
    }
    assert_eq!(checked, 4);
}

#[test]
fn a_file_with_a_texture_makes_vectors_that_the_netlist_gives() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), example()).unwrap();
    let small = ["--set", "texture.bits=1", "--set", "shade.material_bits=0", "--set", "term.record_bits=1"];
    let vectors = ["vectors", "a.tri", "--unit", "texel", "--out", "v", "--set", "shade.kind=phong"];
    let (code, error) = run(folder.path(), &[&vectors[..], &TEXTURED, &small].concat());
    assert_eq!(code, Some(0), "{error}");
    let manifests: Vec<_> = walk(&folder.path().join("v"), "textures").collect();
    assert!(!manifests.is_empty(), "the words of the textures are there");
}

/// The files below a folder whose names have this in them.
fn walk<'a>(folder: &Path, name: &'a str) -> impl Iterator<Item = std::path::PathBuf> + use<'a> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() { folders.push(path) } else { found.push(path) }
        }
    }
    found.into_iter().filter(move |path| path.file_name().unwrap().to_string_lossy().contains(name))
}

#[test]
fn faults_end_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), (4, 8));
    std::fs::write(folder.path().join("a.tri"), example()).unwrap();
    std::fs::write(folder.path().join("u.tri"), example().replace("UV 0 1.5  1.5 1.5  0 0", "")).unwrap();
    std::fs::write(folder.path().join("w.tri"), example().replace("0000ff ffffff", "0000ff")).unwrap();
    let phong = ["--set", "shade.kind=phong"];
    let remedy: &[&str] = &["texture.kind=nearest", "shade.colour=multiply", "--engine golden"];
    let cases: [(&[&str], &[&str], &[&str]); 5] = [
        (&["raster", "a.tri", "--out", "o"], &phong, remedy),
        (&["render", "s.toml", "--shading", "phong", "--out", "o"], &phong, remedy),
        (
            &["raster", "a.tri", "--out", "o", "--set", "texture.kind=nearest"],
            &phong,
            &["texture.kind", "shade.colour", "multiply"],
        ),
        (&["raster", "u.tri", "--engine", "golden", "--out", "o"], &[], &["u.tri:", "UV", "is missing"]),
        (
            &["raster", "w.tri", "--engine", "golden", "--out", "o"],
            &[],
            &["w.tri:6: texture: `3 given`", "4 texels"],
        ),
    ];
    for (arguments, more, words) in cases {
        let (code, error) = run(folder.path(), &[arguments, more].concat());
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {word:?} is not in {error:?}");
        }
    }
    assert!(!folder.path().join("o").exists());
}
