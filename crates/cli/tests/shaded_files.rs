//! `edgewalk triangles --shading phong`: the file draws the picture of its scene, or there is no file.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, ended, report, run};

const SMALL: [&str; 5] = ["--adapt", "--set", "screen.width=61", "--set", "screen.height=47"];

/// A material of one triangle under one light; a case adds what a file may not be able to say.
fn scene(top: &str, material: &str, light: &str) -> String {
    format!(
        "{top}\n[[material]]\nname = \"m\"\n{material}\n[[object]]\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n\
         faces = [[0, 1, 2]]\nmaterial = \"m\"\n[[light]]\n{light}\n"
    )
}

const LIGHT: &str = "kind = \"directional\"\ntoward = [0.2, 0.3, 1]\nintensity = 0.6";

#[test]
fn files_of_shaded_scenes_draw_their_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // Ambient light that is not 1, a highlight in grey, a colour; an exponent that says nothing.
    let own = scene("ambient = 0.3", "diffuse = [0.2, 0.5, 0.9]\nspecular = 0.4\nexponent = 9", LIGHT);
    std::fs::write(folder.join("a.toml"), own).unwrap();
    let matte = scene("ambient = 0", "diffuse = 0.9\nexponent = 0", LIGHT);
    std::fs::write(folder.join("b.toml"), matte).unwrap();
    let mut checked = 0;
    // The terrain's four materials take turns 900 times.
    for input in ["a.toml", "b.toml", "sphere", "room", "terrain"] {
        let of = |command: &[&str]| {
            let all = [command, &SMALL, &["-q"]].concat();
            assert_eq!(run(folder, &all), (Some(0), String::new()), "{all:?}");
        };
        of(&["triangles", input, "--shading", "phong", "--out", "k.tri"]);
        of(&["render", input, "--shading", "phong", "--out", "scene"]);
        of(&["render", "k.tri", "--out", "file"]);
        for picture in ["image.png", "golden.png"] {
            let of = |out: &str| std::fs::read(folder.join(out).join(picture)).unwrap();
            assert!(of("scene") == of("file"), "{input}: {picture}");
            checked += 1;
        }
    }
    println!("{checked} / 10 pictures of files are those of their scenes");
    assert_eq!(checked, 10);
}

#[test]
fn scenes_that_files_cannot_say_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let matte = "diffuse = 0.8";
    let point = "kind = \"positional\"\nposition = [0, 0, 2]";
    let tinted = "kind = \"directional\"\ntoward = [0, 0, 1]\nintensity = [0.6, 0.5, 0.4]";
    let colors = "one number for red, green and blue";
    let far = "infinitely far away";
    let cases = [
        ("phong", scene("ambient = [0.2, 0.1, 0.1]", matte, LIGHT), "ambient light is 0.2 0.1 0.1", colors),
        ("phong", scene("ambient = 200", matte, LIGHT), "ambient light is 200 200 200", "0 to 100"),
        ("phong", scene("", matte, tinted), "a light's intensity is 0.6 0.5 0.4", colors),
        ("phong", scene("", matte, point), "a light stands at 0 0 2", far),
        ("phong", scene("", "emission = 0.25", LIGHT), "the emission 0.25 0.25 0.25", "has none"),
        (
            "phong",
            scene("", "diffuse = 0.5\nambient = [0.1, 0, 0]", LIGHT),
            "ambient coefficient is 0.1 0 0",
            colors,
        ),
        (
            "phong",
            scene("", "specular = [0.5, 0.4, 0.3]", LIGHT),
            "specular coefficient is 0.5 0.4 0.3",
            colors,
        ),
        ("phong", scene("", "specular = 0.5\nexponent = 2000", LIGHT), "exponent is 2000", "1 to 1024"),
        ("phong", scene("", "waves = 4\ntexels = \"nearest\"", LIGHT), "a relief", "has none"),
        ("fast-phong", scene("", matte, LIGHT), "the viewer stands at ", far),
    ];
    for (shading, text, found, permitted) in &cases {
        std::fs::write(folder.join("a.toml"), text).unwrap();
        let arguments =
            [&["triangles", "a.toml", "--shading", shading, "--out", "k.tri"][..], &SMALL].concat();
        let (code, error) = run(folder, &arguments);
        assert_eq!(code, Some(2), "{text}{error}");
        let instead = format!("edgewalk render a.toml --shading {shading} --engine golden");
        for words in [found, permitted, "take --shading", instead.as_str()] {
            assert!(error.contains(words), "{words:?} is not in {error:?}");
        }
        assert!(!folder.join("k.tri").exists(), "{text}");
    }
    println!("{} / 10 scenes refused", cases.len());
    assert_eq!(cases.len(), 10);
}

#[test]
fn too_many_surfaces_name_what_is_possible() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut text = "size 61 47\nmode phong\nview 0 0 1\nmaterial 0 0.5 0 1\n".to_owned();
    for color in 0..300 {
        let vertex = |x, y| format!("{x} {y} 0.5 {0} 0 0 0", f64::from(color) / 300.0);
        text += &format!("T {} {} {}\nN 0 0 1 0 0 1 0 0 1\n", vertex(1, 1), vertex(60, 1), vertex(1, 46));
    }
    let error = |text: &str| {
        std::fs::write(folder.join("k.tri"), text).unwrap();
        let (code, error) = run(folder, &["raster", "k.tri", "--adapt", "--out", "out"]);
        assert_eq!(code, Some(2), "{error}");
        error
    };
    let many = error(&text);
    assert!(many.contains("300 surfaces") && many.contains("shade.material_bits=8 for 256;"), "{many}");
    assert!(many.contains("add --set shade.colour=multiply") && !many.contains("material_bits=9"), "{many}");
    let line = text.match_indices("\nT").nth(100).unwrap().0;
    let few = error(&text[..=line]);
    assert!(few.contains("add --set shade.material_bits=7 or --set shade.colour=multiply"), "{few}");
}

/// A colour without light is its table's entry and no more: its error is its bound, to the last bits of f64.
#[test]
fn errors_that_reach_their_bound_are_not_beyond() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let colour = "0.13 0.85 0.76 0";
    let flat = format!(
        "size 16 16\nmode phong\nview 0 0 1\nmaterial 0.2 0.6 0.3 20\n\
         T 1 1 0.5 {colour}  14 2 0.5 {colour}  2 14 0.5 {colour}\nN 0 0 1  0 0 1  0 0 1\n"
    );
    std::fs::write(folder.join("a.tri"), flat).unwrap();
    let output = edgewalk(folder, &["render", "a.tri", "--adapt", "--json", "--out", "r"]).output().unwrap();
    assert_eq!(ended(&output), (Some(0), String::new()));
    let shaded = &report(&output)["comparison"]["shaded"];
    println!("{shaded}");
    let of_bound = shaded["of_bound"].as_f64().unwrap();
    assert!((of_bound - 1.0).abs() < 1e-9, "{shaded}");
    assert_eq!((&shaded["pixels"], &shaded["beyond"]), (&78.into(), &0.into()), "{shaded}");
}

/// SHADE multiplies a colour without a proved bound. The product has none either, alone or in layers.
#[test]
fn colours_of_sums_that_may_wrap_have_no_bound_behind_shade() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for blend in ["", "blend 1\n"] {
        let wide = format!(
            "size 640 4\n{blend}mode phong\nview 0 0 1\nsun 0 0 1 0.5\nmaterial 0.2 0.6 0.3 20\n\
             T 0 0 0.5 1 0 0 0  640 0 0.5 0 1 0.3 0  0 4 0.5 0 0.2 1 0\nN 0 0 1  0 0 1  0 0 1\n"
        );
        std::fs::write(folder.join("a.tri"), wide).unwrap();
        let of = |arguments: &[&str]| {
            let all = [arguments, &["--adapt", "--set", "formats.color_fraction=5"]].concat();
            edgewalk(folder, &all).output().unwrap()
        };
        let why = "additions may err by 138.03125 LSB";
        let output = of(&["render", "a.tri", "--json", "--out", "r"]);
        assert_eq!(ended(&output).0, Some(1), "{blend}");
        let found = &report(&output)["comparison"][if blend.is_empty() { "shaded" } else { "blended" }];
        assert!(found["bound"].is_null() && found["no_bound"].as_str().unwrap().contains(why), "{found}");
        let told = of(&["explain", "a.tri", "500", "0"]).stdout;
        let told = String::from_utf8(told).unwrap();
        let material = told.lines().find(|line| line.starts_with("material 0: ")).unwrap();
        assert!(material.starts_with("material 0: no bound of the colour: ") && material.contains(why));
    }
}

/// A surface of two triangles, one over the other; `between` stands between them.
fn two_shaded(mode: &str, between: &str) -> String {
    format!(
        "size 32 32\nmode {mode}\nview 0 0 1\nsun 0.3 0.3 1 0.7\nsun -1 0 0.5 0.2\nmaterial 0.1 0.7 0.5 40\n\
         T 1 1 0.5 0 0.2 1 0   31 1 0.5 0 0.2 1 0   1 31 0.5 0 0.2 1 0\n\
         N -0.3 -0.3 0.9055  0.5 -0.3 0.8124  -0.3 0.5 0.8124\n{between}\n\
         T 31 31 0.4 0 0.2 1 0.5   31 4 0.3 0 0.2 1 0.5   4 31 0.3 0 0.2 1 0.5\n\
         N 0.3 0.3 0.9055  0.5 -0.3 0.8124  -0.3 0.5 0.8124\n"
    )
}

/// Layers of shaded colours have the bound of shading, not that of the interpolator.
#[test]
fn layers_of_shaded_colours_have_their_own_bound() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut checked = 0;
    for mode in ["phong", "fast-phong"] {
        for between in ["depth lequal", "clear_depth", "blend 1", "blend add"] {
            std::fs::write(folder.join("x.tri"), two_shaded(mode, between)).unwrap();
            let output = edgewalk(folder, &["render", "x.tri", "--adapt", "--json", "--out", "r"]).output();
            let output = output.unwrap();
            assert_eq!(ended(&output), (Some(0), String::new()), "{mode}, {between}");
            let blended = &report(&output)["comparison"]["blended"];
            println!("{mode}, {between}: {blended}");
            // The bound says something: more than the interpolator's, and a part of the range of 255.
            let bound = blended["bound"].as_f64().unwrap();
            assert!((1.0..20.0).contains(&bound) && blended["of_bound"].as_f64() > Some(0.1), "{blended}");
            assert!(blended["pixels"].as_u64() > Some(500), "{blended}");
            checked += 1;
        }
    }
    assert_eq!(checked, 8);
}

/// A file is drawn in its own mode or as a wireframe; another method is refused by every command, never left aside.
#[test]
fn a_file_names_its_own_mode() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let triangle = "T 2 1 0.5 1 0 0 0   30 3 0.5 1 0 0 0   5 22 0.5 1 0 0 0\n";
    let lit = "view 0 0 1\nsun 0 0 1 0.9\nmaterial 0.1 0.8 0 1\n";
    let normals = "N 0 0 1  0 0 1  0 0 1\n";
    let all = ["constant", "constant-averaged", "gouraud", "phong", "fast-phong"];
    let (mut refused, mut drawn) = (0, 0);
    for (mode, own) in
        [("gouraud", "gouraud"), ("flat", "constant"), ("phong", "phong"), ("fast-phong", "fast-phong")]
    {
        let shaded = mode.contains("phong");
        let (lit, normals) = if shaded { (lit, normals) } else { ("", "") };
        std::fs::write(folder.join("a.tri"), format!("size 32 24\nmode {mode}\n{lit}{triangle}{normals}"))
            .unwrap();
        let commands: [&[&str]; 5] = [
            &["explain", "a.tri", "12", "10"],
            &["render", "a.tri", "--out", "o"],
            &["replay", "a.tri", "--out", "r.json"],
            &["demo", "a.tri", "--out", "d"],
            &["judge", "a.tri", "none.npy"],
        ];
        for other in all.into_iter().filter(|other| *other != own) {
            for command in commands {
                let (code, error) = run(folder, &[command, &["--adapt", "--shading", other]].concat());
                let permitted = format!("permitted: {own} or wireframe; leave --shading out");
                let found = format!("--shading {other}: the mode of a.tri is {mode}");
                assert!(code == Some(2) && error.contains(&found) && error.contains(&permitted), "{error}");
                refused += 1;
            }
        }
        // Of several machines, too; beside a scene a sweep shades the scene.
        let machines = format!("default,shade.kind={}", if shaded { mode } else { "none" });
        let vary = format!("shade.kind={}", if shaded { mode } else { "none" });
        let sweep = ["sweep", "a.tri", "--vary", &vary, "--out", "s", "-q", "--shading"];
        let compare = ["compare", &machines, &machines, "a.tri", "--out", "c", "-q", "--shading"];
        for (command, other) in [&sweep[..], &compare].into_iter().flat_map(|of| all.map(|other| (of, other)))
        {
            let (code, error) = run(folder, &[command, &[other]].concat());
            assert_eq!(code, Some(if other == own { 0 } else { 2 }), "{mode} {other}: {error}");
            let found = format!("--shading {other}: ");
            assert!(
                other == own || error.contains(&found) && error.contains("leave --shading out"),
                "{error}"
            );
        }
        for way in [own, "wireframe"] {
            let (code, error) = run(folder, &[commands[0], &["--adapt", "--shading", way]].concat());
            assert_eq!(code, Some(0), "{mode} {way}: {error}");
            drawn += 1;
        }
    }
    assert_eq!((refused, drawn), (80, 8));
    // What a machine for normals says of a file without them holds for files, too.
    std::fs::write(folder.join("a.tri"), format!("size 32 24\n{triangle}")).unwrap();
    let (code, error) = run(folder, &["render", "a.tri", "--out", "o", "--set", "shade.kind=phong"]);
    assert!(code == Some(2) && error.contains("a triangle file with such a mode"), "{error}");
    assert!(!folder.join("o").exists() && !folder.join("d").exists() && !folder.join("r.json").exists());
}
