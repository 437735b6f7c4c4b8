//! Lights at a point through the program: a scene in every engine, what `explain` shows, and faults.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{colors, edgewalk, find, rendered_by_every_engine, run};
use std::path::Path;

/// A floor of two triangles and one that leans, close under a light.
const SCENE: &str = "ambient = 0.1
background = [0.2, 0.1, 0]
[camera]
eye = [0, 0, 3]
target = [0, 0, 0]
[[material]]
name = \"board\"
diffuse = [0.8, 0.7, 0.5]
specular = 0.3
exponent = 20
[[object]]
positions = [[-1, -1, 0], [1, -1, 0.1], [1, 1, 0], [-1, 1, 0.2]]
faces = [[0, 1, 2], [0, 2, 3]]
material = \"board\"
LIGHT
";

pub const BULB: &str = "[[light]]
kind = \"positional\"
position = [0.3, 0.2, 0.8]
attenuation = [0.5, 0.2, 0.6]
intensity = 0.7
";
pub const FLOOD: &str = "[[light]]
kind = \"flood\"
position = [0.3, 0.2, 0.9]
axis = [-0.2, 0, -1]
cone = 30
exponent = 6
attenuation = [1, 0, 0.4]
";
const SUN: &str = "[[light]]
kind = \"directional\"
toward = [0, 0, 1]
";

pub const SMALL: [&str; 4] = ["--set", "screen.width=96", "--set", "screen.height=72"];
pub const LAMP: [&str; 4] = ["--set", "shade.kind=phong", "--set", "shade.light=positional"];

pub fn scene(folder: &Path, light: &str) {
    std::fs::write(folder.join("s.toml"), SCENE.replace("LIGHT", light)).unwrap();
}

#[test]
fn render_holds_a_light_at_a_point_in_every_engine() {
    let folder = tempfile::tempdir().unwrap();
    let multiply: &[&str] = &["--set", "shade.colour=multiply"];
    let fine: &[&str] = &["--set", "shade.table_bits=10", "--set", "term.walk=memory"];
    let mut checked = 0;
    for (light, more) in [(BULB, &[][..]), (FLOOD, multiply), (FLOOD, fine)] {
        scene(folder.path(), light);
        let all = [&["s.toml", "--shading", "phong"], &SMALL[..], &LAMP, more].concat();
        for report in rendered_by_every_engine(folder.path(), &all) {
            let shaded = &report["comparison"]["shaded"];
            let number = |key: &str| shaded[key].as_f64().unwrap();
            println!("{more:?}: {shaded}");
            assert!(
                number("pixels") > 1000.0 && number("beyond") == 0.0 && number("error") <= number("bound")
            );
            assert!(number("error") > 0.2 && number("bound") < 12.0, "{shaded}");
            checked += 1;
        }
    }
    assert_eq!(checked, 9);
}

/// Three lights: a picture for each, the sum of which is that of all of them together.
#[test]
fn several_lights_are_drawn_one_after_the_other_and_added() {
    let folder = tempfile::tempdir().unwrap();
    let red = BULB.replace("0.3, 0.2, 0.8", "-0.5, 0.1, 0.7").replace("= 0.7", "= [0.9, 0.9, 0.9]");
    let lights = [BULB, FLOOD, &red];
    let render = [&["s.toml", "--shading", "phong"], &SMALL[..], &LAMP].concat();
    let mut alone = Vec::new();
    for (place, light) in lights.into_iter().enumerate() {
        scene(folder.path(), light);
        if place > 0 {
            let dark = SCENE.replace("ambient = 0.1", "ambient = 0").replace("[0.2, 0.1, 0]", "[0, 0, 0]");
            let dark = dark.replace("LIGHT", light);
            std::fs::write(folder.path().join("s.toml"), dark).unwrap();
        }
        let (status, said) = run(folder.path(), &[&["render"], &render[..], &["--out", "r"]].concat());
        assert_eq!(status, Some(0), "{said}");
        alone.push(colors(&folder.path().join("r/image.png")));
    }
    scene(folder.path(), &lights.concat());
    for report in rendered_by_every_engine(folder.path(), &render) {
        let parts = report["lights"].as_array().unwrap();
        let shaded = |of: &serde_json::Value| of["shaded"].clone();
        println!("all: {}", shaded(&report["comparison"]));
        assert_eq!((parts.len(), report["cycles"]["passes"].as_array().unwrap().len()), (3, 3));
        for part in parts.iter().chain([&report["comparison"]]) {
            let shaded = shaded(part);
            assert!(shaded["pixels"].as_u64().unwrap() > 1000 && shaded["beyond"] == 0, "{shaded}");
            assert!(shaded["error"].as_f64().unwrap() > 0.2, "{shaded}");
        }
        let bound = |of: &serde_json::Value| shaded(of)["bound"].as_f64().unwrap();
        // Every triangle's own bounds are added.
        let sum: f64 = parts.iter().map(bound).sum();
        let all = bound(&report["comparison"]);
        assert!(all <= sum + 1e-9 && all > 0.7 * sum, "{all} of {sum}");
    }
    let (mut checked, mut cut, mut brightest) = (0, 0, 0);
    for (at, color) in colors(&folder.path().join("r/image.png")).into_iter().enumerate() {
        for channel in 0..3 {
            let sum: u32 = alone.iter().map(|picture| u32::from(picture[at][channel])).sum();
            assert_eq!(u32::from(color[channel]), sum.min(255), "pixel {at}");
            (checked, cut) = (checked + 1, cut + u32::from(sum > 255));
            brightest = if sum > 255 { at } else { brightest };
        }
    }
    println!("{checked} colours, {cut} of them cut");
    assert!(checked == 96 * 72 * 3 && cut > 50);
    // `explain` has each of them, and their sum as the machine stores it.
    for at in [30 * 96 + 40, brightest] {
        let [x, y] = [at % 96, at / 96].map(|number| number.to_string());
        let explain = [&["explain", "s.toml", &x, &y, "--shading", "phong", "--json"], &SMALL[..], &LAMP];
        let output = edgewalk(folder.path(), &explain.concat()).output().unwrap();
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(told["shaded"].as_array().unwrap().len(), 3);
        let drawn = colors(&folder.path().join("r/image.png"))[at];
        assert_eq!(told["stored"]["rgb"], serde_json::json!(drawn), "{}", told["not_stored"]);
    }
}

/// DITHER rounds the picture of each light by itself, so the bound of the sum has a step for each.
#[test]
fn dithered_pictures_of_several_lights_are_within_their_bounds() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), &[BULB, FLOOD].concat());
    let dithered =
        [&["s.toml", "--shading", "phong"], &SMALL[..], &LAMP, &["--set", "dither.bits=4"]].concat();
    let render = [&["render"], &dithered[..], &["--out", "r", "--json"]].concat();
    let output = edgewalk(folder.path(), &render).output().unwrap();
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let shaded = &report["comparison"]["shaded"];
    let number = |key: &str| shaded[key].as_f64().unwrap();
    assert!(output.status.success() && number("beyond") == 0.0 && number("pixels") > 1000.0, "{shaded}");
    // A step is 17 LSB. One for both pictures would not do.
    assert!(number("error") > number("bound") - 17.0, "{shaded}");
    // `explain` has the bound of each light at the pixel with the largest.
    let [x, y] = [0, 1].map(|k| shaded["bound_at"][k].to_string());
    let explain = [&["explain", "s.toml", &x, &y, "--json"], &dithered[1..]].concat();
    let output = edgewalk(folder.path(), &explain).output().unwrap();
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let lights = told["shaded"].as_array().unwrap();
    let sum: f64 = lights.iter().map(|light| light["bound"].as_f64().unwrap()).sum();
    assert!(lights.len() == 2 && (sum - number("bound")).abs() < 1e-9, "{sum}: {shaded}");
}

/// What an error advises draws the picture, or the error says that no machine does.
#[test]
fn what_is_advised_for_several_lights_works() {
    let folder = tempfile::tempdir().unwrap();
    let render = [&["render", "s.toml", "--shading", "phong", "--out", "r"], &SMALL[..]].concat();
    let at_point = ["--set", "shade.light=positional"];
    scene(folder.path(), &format!("{BULB}{FLOOD}"));
    let mut advised = 0;
    for more in [&["--adapt"][..], &["--set", "shade.kind=phong"]] {
        let (code, error) = run(folder.path(), &[&render[..], more].concat());
        assert!(code == Some(2) && error.contains(&at_point.join(" ")), "{more:?}: {error}");
        assert!(!error.contains("shade.lights"), "{more:?}: {error}");
        let (code, error) = run(folder.path(), &[&render[..], more, &at_point].concat());
        assert_eq!(code, Some(0), "{more:?}: {error}");
        advised += 1;
    }
    scene(folder.path(), &format!("{SUN}{BULB}"));
    for more in [
        &["--adapt"][..],
        &[&["--adapt"][..], &at_point].concat(),
        &["--set", "shade.kind=phong"],
        &["--set", "shade.kind=phong", "--set", "shade.lights=2"],
        &LAMP,
    ] {
        let (code, error) = run(folder.path(), &[&render[..], more].concat());
        let said = "no machine with shade.kind = phong draws both kinds in one picture";
        assert!(code == Some(2) && error.contains(said) && !error.contains("--set"), "{more:?}: {error}");
        advised += 1;
    }
    let (code, error) = run(folder.path(), &[&render[..], &["--engine", "golden"]].concat());
    assert_eq!((code, advised), (Some(0), 7), "{error}");
}

/// Every step by the numbers of the one before, in f64, and at the end the very colour of the picture.
#[test]
fn explain_walks_the_steps_of_the_light() {
    let folder = tempfile::tempdir().unwrap();
    let (mut checked, mut dark, mut edge, mut cut) = (0, 0, 0, 0);
    // So narrow that in the machine's numbers its edge lies on its axis: what is on the edge is lit.
    let narrow = FLOOD.replace("cone = 30", "cone = 0.1").replace("-0.2, 0, -1", "0, 0, -1");
    let narrow = narrow.replace("0.2, 0.9]", "0.2, 60]").replace("0, 0.4]", "0, 0]");
    let gloss: &[&str] = &["--set", "shade.gloss_bits=2"];
    let cases = [
        (BULB, [40, 30], &[][..]),
        (FLOOD, [46, 33], &[]),
        (FLOOD, [58, 28], &[]),
        (FLOOD, [20, 60], &[]),
        (&narrow, [55, 31], &[]),
        (BULB, [55, 31], gloss),
    ];
    for (light, [x, y], more) in cases {
        scene(folder.path(), light);
        let machine = [&SMALL[..], &LAMP, more].concat();
        let render = [&["render", "s.toml", "--shading", "phong", "--out", "r"], &machine[..]].concat();
        assert_eq!(run(folder.path(), &render).0, Some(0));
        let drawn = colors(&folder.path().join("r/image.png"))[y * 96 + x];
        let [x, y] = [x, y].map(|number: usize| number.to_string());
        let explain = [&["explain", "s.toml", &x, &y, "--shading", "phong"], &machine[..]].concat();
        let output = edgewalk(folder.path(), &[&explain[..], &["--json"]].concat()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let terms = find(&told, "terms").unwrap().as_array().unwrap();
        let term =
            |name: &str| terms.iter().find(|term| term["name"] == name).unwrap()["output"].as_f64().unwrap();
        let lamp = find(&told, "lamp").unwrap();
        let roots = lamp["roots"].as_array().unwrap();
        let products = lamp["products"].as_array().unwrap();
        let value = |place: usize| products[place]["value"].as_f64().unwrap() / 65536.0;
        let near = |name: &str, found: f64, wanted: f64, within: f64| {
            assert!((found - wanted).abs() <= within, "{name} at {x} {y}: {found}, not {wanted}: {lamp}");
        };
        let (l, n) = ((term("dd") / 2f64.powi(30)).sqrt(), (term("nn") / 65536.0).sqrt());
        let unit = |name: &str| term(name) / 2f64.powi(23);
        let numbers = [
            unit("pl") / l,
            unit("dv") / l,
            unit("da") / l,
            unit("pl") / l / n,
            unit("pv") / n,
            (value(3) + value(4)) / 2.0 / ((1.0 + value(1)) / 2.0).sqrt(),
        ];
        for (place, wanted) in numbers.into_iter().enumerate() {
            near(products[place]["name"].as_str().unwrap(), value(place), wanted, 2e-4);
        }
        for root in roots {
            let [x, m, y] = ["x", "m", "y"].map(|key| root[key].as_f64().unwrap());
            let k = root["k"].as_i64().unwrap() as i32;
            near("m", m, x * 4f64.powi(k) / 16384.0, 1.0);
            near("1/root", y / 65536.0, (65536.0 / m).sqrt(), 1e-4);
        }
        let [beam, golden, bound] =
            ["beam", "golden_beam", "beam_bound"].map(|key| lamp[key].as_f64().unwrap());
        near("beam", beam / 65536.0, golden, bound);
        // A product is rounded to 16 bits.
        let through = lamp.get("cone").map_or(0, |cone| cone["value"].as_i64().unwrap());
        let left = lamp["attenuation"]["value"].as_i64().unwrap() * through;
        assert_eq!(lamp["beam"].as_i64().unwrap(), (left + (1 << 15)) >> 16, "{lamp}");
        dark += u32::from(lamp.get("cone").is_none());
        edge += u32::from(lamp["beside"] == lamp["edge"] && lamp["beam"].as_u64() > Some(60_000));
        let reads: Vec<_> = lamp["indices"].as_array().unwrap().iter().map(|index| &index["read"]).collect();
        for (index, read) in lamp["indices"].as_array().unwrap().iter().zip(&reads) {
            let [index, golden, bound] =
                [&index["index"], &read["golden"], &read["bound"]].map(|number| number.as_f64().unwrap());
            assert!(index - bound <= golden && golden <= index + 1.0 + bound, "{lamp}");
        }
        // The entries make the colour.
        let words: Vec<u32> =
            reads[0]["table"].as_str().unwrap().split(' ').filter_map(|word| word.parse().ok()).collect();
        let lit = lamp["indices"][0]["index"].as_i64().unwrap() >= 0;
        let highlight = if lit { lamp["highlight"].as_u64().unwrap() as u32 } else { 0 };
        for channel in 0..3 {
            assert_eq!((words[channel] + highlight).min(255), u32::from(drawn[channel]), "{lamp}");
            checked += 1;
        }
        let text = edgewalk(folder.path(), &explain).output().unwrap();
        let text = String::from_utf8(text.stdout).unwrap();
        // The first and the last steps of each walk, and how many are between.
        let walks = terms.iter().map(|term| term["steps"].as_array().unwrap().len());
        let lines = text.lines().filter(|line| line.contains("  V ") && line.contains("  X ")).count();
        assert_eq!(lines, walks.clone().map(|steps| steps.min(8)).sum::<usize>(), "{text}");
        for steps in walks.clone().filter(|steps| *steps > 8) {
            let more = format!("  ... {} more; all of them with --json", steps - 8);
            let of = walks.clone().filter(|other| *other == steps).count();
            assert_eq!(text.lines().filter(|line| *line == more).count(), of, "{text}");
            cut += 1;
        }
        for word in [
            "dd, Q32.17",
            "pl, Q25.17",
            "dv, Q25.10",
            "da, Q25.10",
            "pv, Q25.10",
            "nn, Q18.17",
            "root of l.l",
            "N.H: ",
            "attenuation: entry",
            "cone: ",
            "beam: ",
            "nl0: index",
            "highlight, weakened",
        ] {
            assert!(text.contains(word), "{word:?} is not in {text}");
        }
    }
    assert!((checked, dark, edge) == (18, 1, 1) && cut > 4, "{checked} {dark} {edge} {cut}");
}

#[test]
fn faults_end_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let render = ["render", "s.toml", "--shading", "phong", "--set", "shade.kind=phong", "--out", "o"];
    let lamp = [&render[..], &["--set", "shade.light=positional"]].concat();
    let two = [&lamp[..], &["--set", "shade.lights=2"]].concat();
    let relief = [
        &lamp[..],
        &["--set", "shade.colour=multiply", "--set", "texture.kind=nearest", "--set", "texture.bump=yes"],
    ]
    .concat();
    let long = [&lamp[..], &["--set", "term.fraction=33"]].concat();
    let word = [&render[..], &["--set", "shade.light=positionl"]].concat();
    let bright = BULB.replace("intensity = 0.7", "intensity = 9");
    let soft = FLOOD.replace("exponent = 6", "exponent = 0.5");
    let (both, sunny) = (format!("{BULB}{FLOOD}"), format!("{BULB}{SUN}"));
    let verify = [&["trace"], &lamp[1..]].concat();
    let cases: [(&str, &[&str], &[&str]); 10] = [
        (BULB, &render, &["light 1", "shade.light=positional", "--engine golden"]),
        (SUN, &lamp, &["a directional light", "shade.light=directional"]),
        (&sunny, &lamp, &["light 2 is a directional light", "light 1 stands at a point", "--engine golden"]),
        (&both, &verify, &["2 lights", "permitted: 1", "render and explain draw one after the other"]),
        (&bright, &lamp, &["highlight of", "shade.light = positional", "at most 1", "weaker light"]),
        (&soft, &lamp, &["exponent 0.5", "take 1"]),
        (BULB, &two, &["shade.lights", "one light at a time", "1"]),
        (BULB, &relief, &["texture.bump", "shade.light = directional", "no"]),
        (BULB, &long, &["term.fraction", "dd", "65 bits, 64 is the most", "32"]),
        (BULB, &word, &["shade.light", "positionl", "positional"]),
    ];
    let mut checked = 0;
    for (light, arguments, words) in cases {
        scene(folder.path(), light);
        let (code, error) = run(folder.path(), arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {word:?} is not in {error:?}");
        }
        checked += 1;
    }
    assert_eq!(checked, 10);
    assert!(!folder.path().join("o").exists());
}
