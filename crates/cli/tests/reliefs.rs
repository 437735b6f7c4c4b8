//! Reliefs through the program: scenes with pictures of heights and with waves in every engine, what `explain` shows, and faults.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, find, rendered_by_every_engine, run};
use std::path::Path;

/// A square of two triangles whose normals differ, with a picture of 8 x 8 heights, or waves.
const SCENE: &str = "ambient = 0.1
[camera]
eye = [0, 0, 3]
target = [0, 0, 0]
[[material]]
name = \"hammered\"
diffuse = [0.8, 0.7, 0.5]
specular = 0.3
exponent = 20
RELIEF
texels = \"nearest\"
bump_height = 0.02
[[object]]
positions = [[-1, -1, 0], [1, -1, 0.1], [1, 1, 0], [-1, 1, 0.2]]
faces = [[0, 1, 2], [0, 2, 3]]
uv = [[0, 0], [2, 0], [2, 2], [0, 2]]
material = \"hammered\"
[[light]]
kind = \"directional\"
toward = [0.2, 0.3, 1]
";

const WAVES: &str = "waves = 1\nchecker = 2";

fn scene(folder: &Path, relief: &str) {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 8, 8);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&(0..64u32).map(|k| (k * 89 % 256) as u8).collect::<Vec<_>>()).unwrap();
    writer.finish().unwrap();
    std::fs::write(folder.join("heights.png"), bytes).unwrap();
    std::fs::write(folder.join("s.toml"), SCENE.replace("RELIEF", relief)).unwrap();
}

const SMALL: [&str; 4] = ["--set", "screen.width=96", "--set", "screen.height=72"];
const BUMP: [&str; 8] = [
    "--set",
    "shade.colour=multiply",
    "--set",
    "texture.kind=nearest",
    "--set",
    "texture.bump=yes",
    "--set",
    "shade.material_bits=0",
];

#[test]
fn render_holds_the_relief_of_a_scene_in_every_engine() {
    let folder = tempfile::tempdir().unwrap();
    let heights = "bump = \"heights.png\"";
    let cases: [(&str, &str, &str, bool); 5] = [
        ("fast-phong", heights, "texture.bits=3", false),
        ("phong", heights, "texture.bits=3", false),
        ("fast-phong", WAVES, "texture.bits=5", false),
        ("phong", WAVES, "texture.bits=5", false),
        ("phong", WAVES, "texture.bits=4", true),
    ];
    let mut checked = 0;
    for (shading, relief, bits, resampled) in cases {
        scene(folder.path(), relief);
        let kind = format!("shade.kind={shading}");
        let all = [&["s.toml", "--shading", shading], &SMALL[..], &BUMP, &["--set", &kind, "--set", bits]];
        for report in rendered_by_every_engine(folder.path(), &all.concat()) {
            let shaded = &report["comparison"]["shaded"];
            let (number, texels) = (|key: &str| shaded[key].as_f64().unwrap(), &shaded["texels"]);
            println!("{shading} {bits}: {shaded}");
            assert!(
                number("pixels") > 1000.0 && number("beyond") == 0.0 && number("error") <= number("bound")
            );
            assert!(number("error") > 0.2 && number("bound") < 10.0, "{shaded}");
            assert_eq!((texels["unexplained"].as_u64(), texels["flattened"].as_u64()), (Some(0), Some(0)));
            assert_eq!(texels["resampled"].as_u64().unwrap() > 0, resampled, "{texels}");
            checked += 1;
        }
    }
    assert_eq!(checked, 15);
}

#[test]
fn explain_shows_slopes_products_and_sums() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), WAVES);
    let mut checked = 0;
    for (shading, kind) in [("fast-phong", "shade.kind=fast-phong"), ("phong", "shade.kind=phong")] {
        let explain = ["explain", "s.toml", "40", "30", "--shading", shading, "--set", kind, "--json"];
        let output = edgewalk(folder.path(), &[&explain[..], &SMALL, &BUMP].concat()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let shaded = find(&told, "turned").unwrap();
        let slopes: Vec<i64> = numbers(find(&told, "slopes").unwrap());
        let outputs: Vec<(String, i64)> = find(&told, "terms")
            .unwrap()
            .as_array()
            .unwrap()
            .iter()
            .map(|term| (term["name"].as_str().unwrap().to_owned(), term["output"].as_i64().unwrap()))
            .collect();
        let output = |name: &str| outputs.iter().find(|(own, _)| own == name).unwrap().1;
        for turned in shaded.as_array().unwrap() {
            let (name, after) = (turned["name"].as_str().unwrap(), turned["after"].as_i64().unwrap());
            let wanted = match (name, shading) {
                ("nn", _) => {
                    let [u, v] = [slopes[0], slopes[1]];
                    let grown = u * u * output("tuu") + u * v * output("tuv") + v * v * output("tvv");
                    ((output("nn") << 22) + grown) >> 22
                }
                (_, shading) => {
                    let products: i64 = ["u", "v"]
                        .iter()
                        .zip(&slopes)
                        .map(|(way, b)| b * output(&format!("{name}{way}")))
                        .sum();
                    let sum = (output(name) << 11) + products;
                    if shading == "phong" { (sum + (1 << 10)) >> 11 } else { sum >> 15 }
                }
            };
            assert_eq!(after, wanted, "{turned}");
            if let Some(read) = turned.get("read") {
                let [golden, bound] = ["golden", "bound"].map(|key| read[key].as_f64().unwrap());
                let index = after as f64;
                assert!(index - bound <= golden && golden <= index + 1.0 + bound, "{turned}");
            }
            checked += 1;
        }
        let text = edgewalk(folder.path(), &[&explain[..8], &SMALL, &BUMP].concat()).output().unwrap();
        let text = String::from_utf8(text.stdout).unwrap();
        for word in ["relief: B_u", "turned: (", "/ 2^"] {
            assert!(text.contains(word), "{word:?} is not in {text}");
        }
    }
    assert_eq!(checked, 2 + 3);
}

/// A cosine that slopes have made larger than its word is the word's end.
#[test]
fn explain_ends_a_sum_where_its_word_ends() {
    let folder = tempfile::tempdir().unwrap();
    let steep = SCENE.replace("= 0.02", "= 1").replace("[0.2, 0.3, 1]", "[1, 1, 1]");
    std::fs::write(folder.path().join("s.toml"), steep.replace("RELIEF", WAVES)).unwrap();
    let fast = ["--shading", "fast-phong", "--set", "shade.kind=fast-phong"];
    let explain = [&["explain", "s.toml", "26", "22", "--json"], &fast[..]].concat();
    let output = edgewalk(folder.path(), &[&explain[..], &SMALL, &BUMP].concat()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let cosine = &find(&told, "turned").unwrap()[0];
    let products = cosine["products"].as_array().unwrap().iter().map(numbers);
    let added: i64 = products.map(|product| product[0] * product[1]).sum();
    let shift = cosine["shift"].as_u64().unwrap();
    let sum = (cosine["before"].as_i64().unwrap() << 11) + added;
    assert!(sum >> shift > 1023, "{cosine}");
    assert_eq!((cosine["name"].as_str(), cosine["after"].as_i64()), (Some("nl0"), Some(1023)), "{cosine}");
}

fn numbers(list: &serde_json::Value) -> Vec<i64> {
    list.as_array().unwrap().iter().map(|value| value.as_i64().unwrap()).collect()
}

#[test]
fn faults_end_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), WAVES);
    let render = ["render", "s.toml", "--shading", "phong", "--set", "shade.kind=phong", "--out", "o"];
    let without = [&render[..], &BUMP[..4]].concat();
    let long = [&render[..], &BUMP, &["--set", "term.linear_fraction=46", "--set", "shade.kind=fast-phong"]]
        .concat();
    let wide = [&render[..], &BUMP, &["--set", "texture.slope_bits=17"]].concat();
    let cases: [(Vec<&str>, &[&str]); 4] = [
        (render.to_vec(), &["texture.kind=nearest", "shade.colour=multiply"]),
        (without, &["relief", "texture.bump=yes", "--adapt", "--engine golden"]),
        (long, &["term.linear_fraction", "nh0v", "65 bits, 64 is the most", "45"]),
        (wide, &["texture.slope_bits", "17", "4", "16"]),
    ];
    for (arguments, words) in cases {
        let (code, error) = run(folder.path(), &arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {word:?} is not in {error:?}");
        }
    }
    for (relief, words) in [
        ("waves = 129", ["waves", "129", "at most 128"]),
        ("emission = 0", ["texels", "only beside", "`bump` or `waves`"]),
    ] {
        scene(folder.path(), relief);
        let (code, error) = run(folder.path(), &["render", "s.toml", "--engine", "golden", "--out", "o"]);
        assert_eq!(code, Some(2), "{error}");
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
    assert!(!folder.path().join("o").exists());
}
