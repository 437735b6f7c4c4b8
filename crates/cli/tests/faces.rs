//! Faces of scenes and meshes on a machine with POLY.

use crate::support::{colors, edgewalk, rendered_by_every_engine};
use serde_json::Value;
use std::path::Path;

const SCREEN: [&str; 4] = ["--set", "screen.width=96", "--set", "screen.height=72"];

const POLYGON: [&str; 2] = ["--machine", "polygon"];

/// A light far away, which makes one colour of a flat face; the camera looks down on a floor.
const VIEW: &str = "ambient = 0.2
[camera]
eye = [0, 1, 4]
target = [0, 0, 0]
angle = 50
[[light]]
kind = \"directional\"
toward = [0.5, 1, 1]
";

fn report(folder: &Path, arguments: &[&str]) -> Value {
    let output =
        edgewalk(folder, &[&["render"], arguments, &SCREEN, &["--json"]].concat()).output().expect("runs");
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{arguments:?}: {error}"))
}

/// Triangles and polygons of a report.
fn counts(report: &Value) -> [u64; 2] {
    ["triangles", "polygons"].map(|what| report[what].as_u64().unwrap_or_default())
}

/// What the machine draws is golden's picture of the same frame.
fn is_goldens(report: &Value) {
    let comparison = &report["comparison"];
    assert_eq!(comparison["coverage_mismatches"], 0, "{comparison}");
    for channel in ["z", "color"] {
        let figure = |what: &str| comparison[format!("{channel}_{what}")].as_f64().expect("a number");
        assert!(figure("error") <= figure("bound_for_input"), "{channel}: {comparison}");
        assert!(figure("bound_for_input") <= figure("bound"), "{channel}: {comparison}");
    }
}

fn folder(name: &str, file: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join(name), file).expect("a file");
    folder
}

#[test]
fn flat_faces_of_scenes_are_polygons() {
    let scene = include_str!("../../../docs/scenes/averaged-normals.toml");
    let folder = folder("folds.toml", scene);
    let constant = ["folds.toml", "--shading", "constant"];
    let arguments = [&constant, &POLYGON[..], &SCREEN].concat();
    let reports = rendered_by_every_engine(folder.path(), &arguments);
    for report in &reports {
        assert_eq!(counts(report), [0, 8], "{report}");
        is_goldens(report);
    }
    let without = report(folder.path(), &constant);
    assert_eq!(counts(&without), [16, 0]);
    assert_eq!(reports[0]["fragments"], without["fragments"]);
    let setup = |report: &Value| {
        let mean = report["setup"]["clocks"]["mean"].as_f64().expect("a number");
        mean * counts(report).map(|count| count as f64).iter().sum::<f64>()
    };
    assert!(setup(&reports[0]) < 0.8 * setup(&without), "{} {}", setup(&reports[0]), setup(&without));
}

/// A hexagon, an arrow head, and a triangle; all in one plane.
const MESH: &str = "v 0 0 0\nv 1 0 0\nv 1.5 0.8 0\nv 1 1.6 0\nv 0 1.6 0\nv -0.5 0.8 0
v -1 1 0\nv -2 -1 0\nv -1 -0.4 0\nv 0 -1 0\nv 1 -1 0\nv 0.6 -0.3 0
f 1 2 3 4 5 6\nf 7 8 9 10\nf 10 11 12\n";

#[test]
fn faces_of_meshes_are_polygons_in_constant_shading() {
    let folder = folder("a.obj", MESH);
    let drawn = |more: &[&str]| report(folder.path(), &[&["a.obj", "--shading", "constant"], more].concat());
    let (with_poly, without) = (drawn(&POLYGON), drawn(&[]));
    assert_eq!((counts(&with_poly), counts(&without)), ([1, 2], [7, 0]));
    assert_eq!(with_poly["fragments"], without["fragments"]);
    is_goldens(&with_poly);
}

/// Flat faces of a smooth barrel: their corners have normals of their own, so no plane holds their colours.
#[test]
fn smooth_faces_are_polygons_of_bilinear_colours() {
    let ring = |k: i32, y: f64| {
        let angle = std::f64::consts::TAU * f64::from(k) / 12.0;
        format!("v {} {y} {}\n", angle.sin(), angle.cos())
    };
    let points: String = (0..12).map(|k| ring(k, -0.8) + &ring(k, 0.8)).collect();
    let place = |k: i32, up: i32| 2 * (k % 12) + up + 1;
    let face =
        |k: i32| format!("f {} {} {} {}\n", place(k, 0), place(k + 1, 0), place(k + 1, 1), place(k, 1));
    let faces: String = (0..12).map(face).collect();
    let folder = folder("a.obj", &(points + &faces));
    let drawn = |machine: &str| {
        let arguments = ["a.obj", "--shading", "gouraud", "--machine", machine, "--out", "o"];
        (report(folder.path(), &arguments), colors(&folder.path().join("o/image.png")).concat())
    };
    let ((planes, in_triangles), (bilinear, in_faces)) = (drawn("polygon"), drawn("bilinear"));
    // A face away from the light has one colour.
    let [triangles, polygons] = counts(&planes);
    assert!(triangles + 2 * polygons == 24 && polygons < 3, "{triangles} {polygons}");
    assert_eq!(counts(&bilinear), [0, 12]);
    assert_eq!(planes["fragments"], bilinear["fragments"]);
    is_goldens(&bilinear);
    // Both have the corners' colours, and differ a little between them.
    let apart = in_triangles.iter().zip(&in_faces).map(|(a, b)| a.abs_diff(*b));
    let (most, pixels) = (apart.clone().max(), apart.filter(|apart| *apart > 0).count() / 3);
    println!("{pixels} pixels differ, by {most:?} LSB at most");
    assert!(pixels > 100 && most < Some(12), "{pixels} pixels, {most:?} LSB");
}

#[test]
fn a_face_of_too_many_edges_on_a_line_stays_triangles() {
    let height = |k: i32| if k % 2 == 1 { 1.0 } else { [-0.5, -1.0][usize::from(k % 12 == 0)] };
    let point = |k: i32| format!("v {} {} 0\n", 0.5 * f64::from(k) - 3.0, height(k));
    let points: String = (0..13).map(point).collect();
    let corners: String = (1..14).rev().map(|k| format!(" {k}")).collect();
    let folder = folder("a.obj", &format!("{points}f{corners}\n"));
    let drawn = |edges: &str| report(folder.path(), &["a.obj", "--shading", "constant", "--set", edges]);
    let (few, enough) = (drawn("polygon.edges=8"), drawn("polygon.edges=16"));
    assert_eq!((counts(&few), counts(&enough)), ([11, 0], [0, 1]));
    assert_eq!(few["fragments"], enough["fragments"]);
}

#[test]
fn faces_that_no_plane_holds_stay_triangles() {
    let twisted = "[[object]]\npositions = [[-1, -1, 0], [1, -1, 0.5], [1, 1, 0], [-1, 1, 0.5]]\nfaces = [[0, 1, 2, 3]]\n";
    let flat =
        "[[object]]\npositions = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\nfaces = [[0, 1, 2, 3]]\n";
    let lamp = "[[light]]\nkind = \"positional\"\nposition = [0.8, 0.9, 0.4]\n";
    for (scene, shading, expected) in [
        (format!("{VIEW}{flat}"), "gouraud", [0, 1]),
        (format!("{VIEW}{twisted}"), "gouraud", [2, 0]),
        // Its light is near one corner: the two triangles have colours of their own.
        (format!("{VIEW}{lamp}{flat}"), "gouraud", [2, 0]),
        (format!("{VIEW}{lamp}{flat}"), "constant", [2, 0]),
        // Transparent frames are sorted triangle by triangle.
        (
            format!(
                "{VIEW}[[material]]\nname = \"glass\"\ndiffuse = 0.4\ntransmission = 0.5\n{flat}material = \"glass\"\n"
            ),
            "gouraud",
            [2, 0],
        ),
    ] {
        let folder = folder("a.toml", &scene);
        let report =
            report(folder.path(), &[&["a.toml", "--adapt", "--shading", shading], &POLYGON[..]].concat());
        assert_eq!(counts(&report), expected, "{scene}");
        assert_eq!(report["comparison"]["coverage_mismatches"], 0, "{report}");
    }
}

/// The fan from the first corner goes along the long way of this diamond, triangles by Delaunay's rule across.
#[test]
fn a_bent_face_keeps_the_triangles_of_its_mesh() {
    let diamond = "[[object]]\npositions = [[-2, 0, 0], [0, -0.8, 0.2], [2, 0, 0], [0, 0.8, 0.2]]\nfaces = [[0, 1, 2, 3]]\n";
    let lamp = "[[light]]\nkind = \"positional\"\nposition = [1.8, 0.1, 0.4]\n";
    let folder = folder("a.toml", &format!("{VIEW}{lamp}{diamond}"));
    let picture = |more: &[&str]| {
        let drawn = report(folder.path(), &[&["a.toml", "--out", "o"], more].concat());
        assert_eq!(counts(&drawn), [2, 0]);
        colors(&folder.path().join("o/image.png")).concat()
    };
    let (with_poly, without) = (picture(&POLYGON), picture(&[]));
    let apart = with_poly.iter().zip(&without).map(|(a, b)| a.abs_diff(*b)).max();
    // Both are rounded on their own ways.
    assert!(apart <= Some(1) && without.iter().max() > Some(&100), "{apart:?}");
}

/// A floor reaches far beyond both sides of the guard band.
#[test]
fn a_face_is_cut_as_one_polygon() {
    let floor = "[[object]]\npositions = [[-2000, -1, 2], [2000, -1, 2], [2000, -1, -6], [-2000, -1, -6]]\nfaces = [[0, 1, 2, 3]]\n";
    let folder = folder("a.toml", &format!("{VIEW}{floor}"));
    let drawn = |more: &[&str]| report(folder.path(), &[&["a.toml"], more].concat());
    let (with_poly, without) = (drawn(&POLYGON), drawn(&[]));
    assert_eq!(counts(&with_poly), [0, 1], "{with_poly}");
    assert!(counts(&without)[0] > 2, "{without}");
    assert_eq!(with_poly["fragments"], without["fragments"]);
    is_goldens(&with_poly);
}

/// The triangles behind a polygon have other places in the frame than on the surface.
#[test]
fn explain_finds_the_light_on_faces() {
    let folder = folder("a.obj", MESH);
    let lit = |more: &[&str], [x, y]: [&str; 2]| {
        let arguments =
            [&["explain", "a.obj", x, y, "--shading", "constant", "--json"], &SCREEN[..], more].concat();
        let output = edgewalk(folder.path(), &arguments).output().expect("runs");
        serde_json::from_slice::<Value>(&output.stdout).expect("a document")["light"].clone()
    };
    // On each of the three faces.
    for at in [["60", "24"], ["32", "38"], ["60", "55"]] {
        let (with_poly, without) = (lit(&POLYGON, at), lit(&[], at));
        assert!(with_poly.is_object(), "{at:?}: {with_poly}");
        assert_eq!(with_poly["position"], without["position"], "{at:?}");
    }
}
