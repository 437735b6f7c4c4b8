//! Every scene in `docs/scenes` is drawn, each as its page says.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// File, and what to draw it with.
const DRAWN: &[(&str, &[&str])] = &[
    ("components.toml", &["--shading", "phong"]),
    ("lights.toml", &["--shading", "phong"]),
    ("shadows.toml", &["--shading", "phong", "--shadows", "map"]),
    ("glass.toml", &["--shading", "phong", "--shadows", "ray"]),
    ("glass-and-shadows.toml", &["--shading", "phong", "--shadows", "map"]),
    ("systems.toml", &["--shading", "wireframe"]),
    ("polyhedron.toml", &["--shading", "constant"]),
    ("mach-bands.toml", &["--shading", "gouraud"]),
    ("fast-phong.toml", &["--shading", "fast-phong", "--fit", "six-point"]),
    ("texture-and-relief.toml", &["--shading", "phong"]),
    ("relief.toml", &["--shading", "phong"]),
    ("lamp.toml", &["--shading", "phong"]),
    ("averaged-normals.toml", &["--shading", "gouraud"]),
    ("silhouette.toml", &["--shading", "constant-averaged"]),
    ("missed-highlight.toml", &["--shading", "constant"]),
    ("polygon.tri", &[]),
    ("polygons.tri", &[]),
    ("quad.tri", &[]),
    ("depth.tri", &[]),
    ("worked-example.tri", &[]),
    ("tour.tri", &[]),
    ("bypass.tri", &[]),
];

#[test]
fn every_scene_of_the_docs_is_drawn() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scenes");
    let page = std::fs::read_to_string(folder.join("README.md")).expect("the page");
    let mut known = BTreeSet::from(["README.md".to_owned()]);
    let mut drawn = 0;
    for (name, arguments) in DRAWN {
        known.insert((*name).to_owned());
        assert!(page.contains(name), "{name} is not on the page");
        let out = tempfile::tempdir().expect("a folder");
        let mut program = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
        program.arg(if name.ends_with(".tri") { "raster" } else { "render" }).arg(folder.join(name));
        program.args(["--engine", "golden", "--quiet", "--out"]).arg(out.path()).args(*arguments);
        let output = program.output().expect("the program runs");
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let picture = image::open(out.path().join("image.png")).expect("a picture").to_rgb8();
        let first = *picture.get_pixel(0, 0);
        assert!(picture.pixels().any(|pixel| *pixel != first), "{name}: one colour");
        drawn += 1;
    }
    let there: BTreeSet<String> = std::fs::read_dir(&folder)
        .expect("the scenes")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(there, known, "a scene is not drawn here, or is gone");
    for row in 1..=17 {
        assert!(page.contains(&format!("| S{row} |")), "S{row} has no scene");
    }
    println!("drawn {drawn} / {}", DRAWN.len());
}
