//! Lights at a point through the program: a scene in every engine, what `explain` shows, and faults.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, run};
use std::path::Path;

/// A floor of two triangles and one that leans, close under a light.
const SCENE: &str = "ambient = 0.1
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

const BULB: &str = "[[light]]
kind = \"positional\"
position = [0.3, 0.2, 0.8]
attenuation = [0.5, 0.2, 0.6]
intensity = 0.7
";
const FLOOD: &str = "[[light]]
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

const SMALL: [&str; 4] = ["--set", "screen.width=96", "--set", "screen.height=72"];
const LAMP: [&str; 4] = ["--set", "shade.kind=phong", "--set", "shade.light=positional"];

fn scene(folder: &Path, light: &str) {
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
        let mut pictures = Vec::new();
        for engine in ["fast", "model", "rtl"] {
            let render =
                ["render", "s.toml", "--shading", "phong", "--engine", engine, "--json", "--out", "r"];
            let all = [&render[..], &SMALL, &LAMP, more].concat();
            let output = edgewalk(folder.path(), &all).output().unwrap();
            assert!(output.status.success(), "{all:?}: {}", String::from_utf8_lossy(&output.stderr));
            let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
            let shaded = &report["comparison"]["shaded"];
            let number = |key: &str| shaded[key].as_f64().unwrap();
            println!("{engine} {more:?}: {shaded}");
            assert!(
                number("pixels") > 1000.0 && number("beyond") == 0.0 && number("error") <= number("bound")
            );
            assert!(number("error") > 0.2 && number("bound") < 12.0, "{shaded}");
            pictures.push(std::fs::read(folder.path().join("r/image.png")).unwrap());
            checked += 1;
        }
        assert!(pictures.iter().all(|picture| *picture == pictures[0]), "the same machine");
    }
    assert_eq!(checked, 9);
}

#[test]
fn explain_shows_the_terms_of_the_light() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), FLOOD);
    let explain = ["explain", "s.toml", "40", "30", "--shading", "phong"];
    let output = edgewalk(folder.path(), &[&explain[..], &SMALL, &LAMP].concat()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    for word in ["dd, Q32.17", "pl, Q25.17", "dv, Q25.10", "da, Q25.10", "pv, Q25.10", "nn, Q18.17"] {
        assert!(text.contains(word), "{word:?} is not in {text}");
    }
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
    let both = format!("{BULB}{FLOOD}");
    let cases: [(&str, &[&str], &[&str]); 9] = [
        (BULB, &render, &["light 1", "shade.light=positional", "--engine golden"]),
        (SUN, &lamp, &["light 1 is directional", "shade.light=directional"]),
        (&both, &lamp, &["2 lights", "take 1", "--engine golden"]),
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
    assert_eq!(checked, 9);
    assert!(!folder.path().join("o").exists());
}
