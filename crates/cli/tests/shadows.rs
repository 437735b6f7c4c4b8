//! Shadows through the program: lit.npy of the page of the format, and who has none.

use crate::support::ended;
use std::path::Path;
use std::process::{Command, Output};

fn edgewalk(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program runs")
}

#[test]
fn the_example_of_the_format_gives_lit_npy() {
    let page = include_str!("../../../docs/triangle_file.md");
    let example = page.rsplit("```").nth(1).expect("an example at the end");
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.tri"), example).expect("written");
    let output = edgewalk(folder.path(), &["raster", "a.tri", "--engine", "golden", "--out", "OUT"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let lit = std::fs::read(folder.path().join("OUT/lit.npy")).expect("lit.npy");
    assert!(lit.starts_with(b"\x93NUMPY") && String::from_utf8_lossy(&lit[..128]).contains("u1"));
    assert_eq!(lit[lit.len() - 16..], [1, 1, 2, 2].repeat(4));
    let z = std::fs::read(folder.path().join("OUT/z.npy")).expect("z.npy");
    assert_eq!(z[z.len() - 16 * 8..], 0.5f64.to_le_bytes().repeat(16));
}

const LENS: [&str; 8] = [
    "shadow.light=perspective",
    "blend.kind=constant",
    "screen.width=100",
    "screen.height=76",
    "shadow.size=256",
    "shadow.light_fraction=16",
    "screen.guard_bits=11",
    "shadow.depth_bits=20",
];

/// `render SCENE --shadows map` on the machine, with these settings; what the report says of its parts.
fn parts(folder: &Path, scene: &str, settings: &[&str]) -> serde_json::Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.current_dir(folder).args(["render", scene, "--shadows", "map", "--json", "--out", "OUT"]);
    LENS.iter().chain(settings).for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().expect("the program runs");
    assert!(!output.stdout.is_empty(), "{scene}: {}", String::from_utf8_lossy(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(output.status.success(), "{scene}: {report:#}");
    assert_eq!(
        report["cycles"]["passes"].as_array().map(Vec::len),
        report["parts"]["parts"].as_array().map(Vec::len)
    );
    report["parts"].clone()
}

/// Scenes with one light and with three, of every kind: all decisions explained, the passes' picture the sum of its parts.
#[test]
fn scenes_have_their_shadows_on_the_machine() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scenes/shadows.toml");
    let (mut pixels, mut dark, mut differ) = (0, 0, 0);
    for (scene, lights, settings) in [
        (scenes, 3, &["shadow.project=serial"][..]),
        ("terrain", 1, &["memory.hazard=interlock", "shadow.light_bits=24", "shadow.depth_bits=16"]),
        ("torus-knot", 1, &["interpolator.adders=2", "shadow.gate=scale"]),
    ] {
        let found = parts(folder.path(), scene, settings);
        assert_eq!((found["added"].as_u64(), found["wrong"].as_u64()), (Some(7600), Some(0)), "{scene}");
        let list = found["parts"].as_array().expect("a list");
        assert_eq!(list.len(), 1 + lights, "{scene}");
        assert!(list[0]["lit"].is_null() && found["alike"].as_u64() > Some(1000), "{scene}");
        let bound = list.iter().map(|part| part["color_bound"].as_f64().expect("proved")).sum::<f64>();
        assert!(found["color_error"].as_f64().is_some_and(|error| error > 0.3 && error <= bound), "{scene}");
        for part in &list[1..] {
            let number = |key: &str| part["lit"][key].as_u64().expect("counted");
            assert_eq!(
                (number("unexplained"), part["coverage_mismatches"].as_u64()),
                (0, Some(0)),
                "{scene}"
            );
            assert!(number("open") * 100 <= number("pixels"), "{scene}: {part}");
            (pixels, dark, differ) =
                (pixels + number("pixels"), dark + number("shadow"), differ + number("differ"));
        }
    }
    println!("{pixels} pixels, {dark} in shadow, {differ} decided otherwise than golden, 0 unexplained");
    assert!(pixels > 15_000 && dark > 1_000 && differ < pixels / 50, "{pixels} {dark} {differ}");
}

/// `--adapt` gives a machine the units that maps of a scene's lights need; what `--set` says stands.
#[test]
fn adapt_brings_the_units_of_maps() {
    let folder = tempfile::tempdir().expect("a folder");
    let glass = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scenes/glass-and-shadows.toml");
    let small = ["--set", "screen.width=40", "--set", "screen.height=30", "--set", "shadow.size=32"];
    for scene in ["sphere", glass] {
        let words = [&["render", scene, "--shadows", "map", "--adapt", "--json"], &small[..]].concat();
        let (code, error) = ended(&edgewalk(folder.path(), &words));
        assert_eq!(code, Some(0), "{scene}: {error}");
        let (code, error) =
            ended(&edgewalk(folder.path(), &[&words[..], &["--set", "blend.kind=none"]].concat()));
        assert!(code == Some(2) && error.contains("BLEND"), "{scene}: {error}");
    }
}

/// A light amid the mesh takes six maps, and what is transparent no passes.
#[test]
fn scenes_that_the_machine_cannot_light_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let amid = "[[object]]\nbuiltin = \"room\"\n[[light]]\nkind = \"positional\"\nposition = [0, 1, 0]\n";
    let glass = "[[material]]\nname = \"glass\"\ntransmission = 0.5\n[[object]]\nbuiltin = \"sphere\"\nmaterial = \"glass\"\n";
    std::fs::write(folder.path().join("amid.toml"), amid).expect("written");
    std::fs::write(folder.path().join("glass.toml"), glass).expect("written");
    let lens = ["--set", "shadow.light=perspective"];
    let both = [&lens[..], &["--set", "blend.kind=constant"]].concat();
    let near = [&both[..], &["--set", "formats.z_bits=4", "--set", "formats.z_fraction=12"]].concat();
    let cases: [(&[&str], &[&str], &[&str]); 8] = [
        (&["sphere"], &[], &["no PROJECT", "shadow.light=perspective", "--engine golden"]),
        (&["sphere"], &["--set", "shadow.light=parallel"], &["no PROJECT", "shadow.light=perspective"]),
        (&["sphere"], &lens, &["no BLEND", "blend.kind=constant"]),
        (&["amid.toml"], &both, &["amid.toml", "light 1 (positional)", "six maps", "--engine golden"]),
        (
            &["glass.toml"],
            &both,
            &["glass.toml", "transmits light", "shadow.transmits=yes", "--engine golden"],
        ),
        (&["sphere", "--shading", "constant"], &both, &["--shading gouraud"]),
        (&["sphere", "--shadows", "ray"], &both, &["--shadows", "maps"]),
        (&["sphere"], &near, &["sphere", "triangle", "farthest", "far plane"]),
    ];
    for (scene, settings, words) in cases {
        let shadows: &[&str] = if scene.contains(&"--shadows") { &[] } else { &["--shadows", "map"] };
        let output = edgewalk(folder.path(), &[&["render"], scene, shadows, settings].concat());
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{scene:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{scene:?}: {error} lacks {word}");
        }
    }
}

#[test]
fn only_the_golden_picture_has_shadows() {
    let folder = tempfile::tempdir().expect("a folder");
    for (arguments, word) in [
        (["render", "sphere", "--shadows", "map"], "--engine golden"),
        (["render", "sphere", "--shadows", "rays"], "ray"),
    ] {
        let output = edgewalk(folder.path(), &arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(word), "{error}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 0);
}

/// In shadow a colour may err by an LSB more, as the gate rounds: where nothing is proved of all triangles, the bound of the frame's
/// own has it.
#[test]
fn bound_of_lit_triangles_has_the_gate() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.tri"), LIT).expect("written");
    let settings =
        ["shadow.light=parallel", "shadow.size=16", "shadow.gate=scale", "formats.color_fraction=9"];
    let set = settings.iter().flat_map(|setting| ["--set", *setting]);
    let arguments: Vec<&str> =
        ["render", "a.tri", "--adapt", "--json", "--out", "r"].into_iter().chain(set).collect();
    let output = edgewalk(folder.path(), &arguments);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a report");
    let c = &report["comparison"];
    assert_eq!(output.status.code(), Some(0), "{c}");
    let figure = |name: &str| c[name].as_f64();
    assert!(c["color_bound"].is_null() && figure("color_error") > Some(1.0), "{c}");
    assert!(figure("color_error") <= figure("color_bound_for_input"), "{c}");
    assert!(figure("color_bound_for_input") < Some(2.05), "{c}");
}

/// A triangle in the shadow of another, of which the light leaves 0.97.
const LIT: &str = "size 64 48
shadow 16 0 0.97   0.25 0 0 0  0 0.3333333 0 0  0 0 1 0  0 0 0 1
L  -20 -20 0  60 -20 0  -20 60 0
T 6.5571 20.2376 0.461132 0.803304 0.865309 0.592470 0 \
    50.2069 19.8716 0.982400 0.716794 0.890631 0.164108 0 \
    44.4545 32.1248 0.756049 0.893807 0.227908 0.119332 0
";
