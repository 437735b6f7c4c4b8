//! Scene files: what they say, and what is refused where.
#![allow(clippy::unwrap_used)] // a test may

use edgewalk_scene::{Attenuation, Crease, Light, Scene, ShadeMode, Specular, Texture, Weight};
use glam::DVec3;
use std::fs;

const FULL: &str = r#"
ambient = [0.1, 0.2, 0.3]
background = 0.5
specular = "halfway"

[camera]
eye = [0, 0, 5]
target = [0, 0, 0]
angle = 60
near = 1
far = 9

[normals]
given = false
weight = "angle"
crease = "groups"

[[material]]
name = "board"
diffuse = [0.5, 0.6, 0.7]
ambient = 0.2
specular = 0.3
exponent = 20
transmission = 0.25
emission = [0.01, 0.0, 0.0]
checker = 2
colors = [[1, 1, 1], [0, 0, 0]]

[[object]]
positions = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
faces = [[0, 1, 2, 3]]
material = "board"
scale = [2, 2, 1]
rotate = [0, 0, 90]
translate = [0, 0, 1]

[[object]]
builtin = "sphere"
columns = 6
rows = 3

[[light]]
kind = "directional"
toward = [0, 0, 2]
intensity = 0.5

[[light]]
kind = "positional"
position = [1, 2, 3]
attenuation = [1, 0, 0.5]

[[light]]
kind = "flood"
position = [0, 5, 0]
axis = [0, -1, 0]
cone = 30
exponent = 2
intensity = [1, 0.5, 0]
"#;

fn open(text: &str) -> Result<Scene, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).unwrap();
    Scene::open(path.to_str().unwrap()).map_err(|error| error.to_string())
}

#[test]
fn everything_a_file_can_say() {
    let scene = open(FULL).unwrap();
    assert_eq!(scene.ambient, DVec3::new(0.1, 0.2, 0.3));
    assert_eq!((scene.background, scene.specular), (DVec3::splat(0.5), Specular::Halfway));
    assert_eq!((scene.camera.eye, scene.camera.near, scene.camera.far), (5.0 * DVec3::Z, 1.0, 9.0));
    assert!((scene.camera.angle - 60f64.to_radians()).abs() < 1e-15);
    assert!(!scene.normals.given && scene.normals.weight == Weight::Angle);
    assert_eq!(scene.normals.crease, Crease::Groups);
    // A quad is two triangles; a sphere of 6 by 3 has 6 (1 + 2 + 1).
    assert_eq!(scene.mesh.faces().len(), 2 + 24);
    let corners = scene.mesh.corners(&scene.mesh.faces()[0]);
    let expected = [DVec3::Z, DVec3::new(0.0, 2.0, 1.0), DVec3::new(-2.0, 2.0, 1.0)];
    for (corner, expected) in corners.into_iter().zip(expected) {
        assert!(corner.distance(expected) < 1e-12, "{corner} is not {expected}");
    }
    let board = scene.mesh.materials()[scene.mesh.faces()[0].material as usize];
    assert_eq!((board.ambient, board.exponent, board.transmission), (DVec3::splat(0.2), 20.0, 0.25));
    assert_eq!((board.emission.x, scene.mesh.textures().len()), (0.01, 1));
    assert_eq!(scene.lights[0], Light::Directional { toward: DVec3::Z, intensity: DVec3::splat(0.5) });
    assert_eq!(
        scene.lights[1],
        Light::Positional {
            position: DVec3::new(1.0, 2.0, 3.0),
            intensity: DVec3::ONE,
            attenuation: Attenuation { constant: 1.0, linear: 0.0, quadratic: 0.5 },
        }
    );
    assert!(matches!(scene.lights[2], Light::Flood { axis: DVec3::NEG_Y, exponent: 2.0, .. }));
}

#[test]
fn listed_faces_may_have_texture_coordinates() {
    let square =
        "[[object]]\npositions = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\nfaces = [[0, 1, 2, 3]]\n";
    let scene = open(&format!("{square}uv = [[0, 0], [1, 0], [1, 2], [0, 2]]")).unwrap();
    let uv = scene.mesh.face_data()[1].texture.unwrap();
    assert_eq!(uv.map(|uv| uv.to_array()), [[0.0, 0.0], [1.0, 2.0], [0.0, 2.0]]);
    let error = open(&format!("{square}uv = [[0, 0]]")).map(|_| "read").unwrap_err();
    assert!(error.contains("scene.toml:4: object 1: uv") && error.contains("4 of [u, v]"), "{error}");
}

#[test]
fn the_least_file_is_lit_and_in_view() {
    let scene = open("[[object]]\nbuiltin = \"torus\"").unwrap();
    let frame = scene.frame(64, 48, 100.0, ShadeMode::Gouraud);
    let on_screen = |v: &edgewalk_scene::Vertex| (0.0..=64.0).contains(&v.x) && (0.0..=48.0).contains(&v.y);
    assert!(frame.triangles.len() > 1000);
    assert!(frame.triangles.iter().flat_map(|t| &t.0).all(|v| on_screen(v) && v.r > 0.0));
}

#[test]
fn pictures_and_reliefs_come_with_their_materials() {
    let text = "[[material]]\nname = \"a\"\nchecker = 4\nwaves = 3\nbump_height = -0.2\n[[object]]\nbuiltin = \"sphere\"\nmaterial = \"a\"";
    let mesh = open(text).unwrap().mesh;
    let material = mesh.materials()[0];
    assert_eq!((material.texture, material.bump, material.bump_height), (Some(0), Some(1), -0.2));
    assert!(matches!(mesh.textures()[0], Texture::Checker { squares: 4, .. }));
    assert_eq!(mesh.textures()[1], Texture::Waves { count: 3 });
}

/// Each a change of one line of a good file, the line it is found in, and what the message must say.
#[test]
fn malformed_files_are_refused_by_line_and_key() {
    let cases: &[(&str, &str, usize, &str)] = &[
        ("ambient = [0.1, 0.2, 0.3]", "ambiant = 0.1", 2, "did you mean `ambient`?"),
        ("ambient = [0.1, 0.2, 0.3]", "ambient = [0.1, 0.2]", 2, "ambient: `[0.1, 0.2]`"),
        ("ambient = [0.1, 0.2, 0.3]", "ambient = -1", 2, "each from 0 to"),
        ("ambient = [0.1, 0.2, 0.3]", "ambient = nan", 2, "ambient: `nan`"),
        ("ambient = [0.1, 0.2, 0.3]", "ambient = ", 2, "TOML"),
        ("background = 0.5", "background = 1.5", 3, "each from 0 to 1"),
        ("specular = \"halfway\"", "specular = \"halfwy\"", 4, "did you mean `halfway`?"),
        ("specular = \"halfway\"", "specular = 3", 4, "a text in quotes"),
        ("eye = [0, 0, 5]", "eye = [0, 0, 0]", 8, "another place than the eye"),
        ("target = [0, 0, 0]", "target = [0, 0, 0]\nup = [0, 0, 1]", 9, "not along the line of sight"),
        ("angle = 60", "angle = 180", 9, "camera: angle: `180`: permitted: a number from 0.001 to 179"),
        ("near = 1", "near = 0", 10, "camera: near: `0`"),
        ("far = 9", "far = 1", 11, "beyond the near plane"),
        ("given = false", "given = 0", 14, "true false"),
        ("weight = \"angle\"", "weight = \"angel\"", 15, "did you mean `angle`?"),
        ("crease = \"groups\"", "crease = 200", 16, "permitted: \"groups\", or a number from 0 to 180"),
        ("crease = \"groups\"", "crease = \"group\"", 16, "permitted: \"groups\", or a number from 0 to 180"),
        ("name = \"board\"", "nane = \"board\"", 19, "did you mean `name`?"),
        ("name = \"board\"", "", 18, "material 1: name: `not there`"),
        ("transmission = 0.25", "transmission = 0.25\ncoefficients = \"plane\"", 25, "did you mean `plain`?"),
        (
            "transmission = 0.25",
            "transmission = 0.95\ncoefficients = \"plain\"",
            24,
            "at most 1 - transmission",
        ),
        ("exponent = 20", "exponent = -1", 23, "material 1: exponent: `-1`"),
        ("colors = [[1, 1, 1], [0, 0, 0]]", "colors = [[1, 1, 1]]", 27, "two of [r, g, b]"),
        ("checker = 2", "checker = 2\ntexture = \"a.png\"", 26, "one of texture, checker"),
        ("checker = 2", "checker = 2.5", 26, "checker: `2.5`: permitted: a whole number from 1 to 65536"),
        ("checker = 2", "", 27, "colors: `given`: permitted only beside `checker`"),
        ("checker = 2", "checker = 2\nbump_height = 1", 27, "permitted only beside `bump` or `waves`"),
        ("checker = 2", "checker = 2\nwaves = 2.5", 27, "waves: `2.5`: permitted: a whole number"),
        ("checker = 2", "checker = 2\ngloss_checker = 2.5", 27, "permitted: a whole number from 1 to 65536"),
        ("colors = [[1, 1, 1], [0, 0, 0]]", "texture = \"missing.png\"", 26, "one of texture, checker"),
        (
            "checker = 2",
            "checker = 2\ngloss_checker = 2\ngloss = \"a.png\"",
            27,
            "one of gloss, gloss_checker",
        ),
        ("checker = 2", "checker = 2\ngloss_checker = 0", 27, "gloss_checker: `0`"),
        ("checker = 2", "checker = 2\ngloss = \"missing.png\"", 27, "gloss: `missing.png`: cannot be read: "),
        ("checker = 2", "checker = 2\nbump = \"\"", 27, "bump: ``: permitted: the name of a file"),
        ("checker = 2", "checker = 2\nwaves = 0", 27, "waves: `0`"),
        ("checker = 2", "checker = 2\nwaves = 3\nbump_height = nan", 28, "bump_height: `nan`"),
        ("faces = [[0, 1, 2, 3]]", "faces = [[0, 1, 4]]", 31, "places from 0 to 3"),
        ("faces = [[0, 1, 2, 3]]", "faces = [[0, 1]]", 31, "3 to 16384 places a face"),
        ("faces = [[0, 1, 2, 3]]", "faces = []", 31, "at least one face"),
        (
            "faces = [[0, 1, 2, 3]]",
            "mesh = \"missing.obj\"",
            30,
            "object 1: key: `positions`: permitted in an object",
        ),
        (
            "builtin = \"sphere\"\ncolumns = 6\nrows = 3",
            "mesh = \"no.obj\"",
            38,
            "mesh: `no.obj`: cannot be read: ",
        ),
        (
            "builtin = \"sphere\"",
            "mesh = \"no.obj\"",
            39,
            "object 2: key: `columns`: permitted in an object with mesh: mesh material scale rotate translate",
        ),
        (
            "faces = [[0, 1, 2, 3]]",
            "faces = [[0, 1, 2, 3]]\nrows = 3",
            32,
            "key: `rows`: permitted in an object with faces: faces positions uv material",
        ),
        (
            "rows = 3",
            "rows = 3\nuv = []",
            41,
            "in a sphere: builtin columns rows material scale rotate translate",
        ),
        (
            "builtin = \"sphere\"",
            "builtin = \"terrain\"",
            40,
            "`rows`: permitted in a terrain: builtin columns material",
        ),
        (
            "builtin = \"sphere\"",
            "builtin = \"room\"",
            39,
            "`columns`: permitted in a room: builtin material",
        ),
        ("material = \"board\"", "material = \"bord\"", 32, "did you mean `board`?"),
        (
            "scale = [2, 2, 1]",
            "scale = 0",
            33,
            "scale: `0`: permitted: a number or [x, y, z], each from 0.000001 to 1000000",
        ),
        (
            "scale = [2, 2, 1]",
            "scale = -1",
            33,
            "scale: `-1`: permitted: a number or [x, y, z], each from 0.000001",
        ),
        (
            "scale = [2, 2, 1]",
            "scale = 1e30",
            33,
            "scale: `1e30`: permitted: a number or [x, y, z], each from 0.000001",
        ),
        ("scale = [2, 2, 1]", "scale = \"big\"", 33, "scale: `\"big\"`: permitted: a number or [x, y, z]"),
        (
            "scale = [2, 2, 1]",
            "scale = [1, 1, 0]",
            33,
            "scale: `[1, 1, 0]`: permitted: a number or [x, y, z]",
        ),
        ("builtin = \"sphere\"", "builtin = \"spere\"", 38, "did you mean `sphere`?"),
        ("rows = 3", "rows = 2", 40, "from 3 to 2048"),
        ("rows = 3", "rows = 3.5", 40, "rows: `3.5`: permitted: a whole number from 3 to 2048"),
        ("toward = [0, 0, 2]", "toward = [0, 0, 0]", 44, "not all of them 0"),
        ("attenuation = [1, 0, 0.5]", "cone = 3", 0, "permitted in a positional light"),
    ];
    let (mut refused, mut wrong) = (0, Vec::new());
    for &(line, instead, number, message) in cases {
        assert_eq!(FULL.matches(line).count(), 1, "{line}");
        let error = open(&FULL.replace(line, instead)).map(|_| "read").expect_err(instead);
        let place = format!("scene.toml:{number}:");
        if !error.contains(message) || number != 0 && !error.contains(&place) {
            wrong.push(format!("{instead}: {error}, not {message} in line {number}\n"));
        }
        refused += 1;
    }
    assert!(wrong.is_empty(), "{}", wrong.concat());
    println!("refused {refused} / {}", cases.len());
    assert_eq!(refused, cases.len());
}
