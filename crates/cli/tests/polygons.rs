//! Polygons of triangle files, drawn by the machine's POLY.

use crate::support::{edgewalk, ended, npy, rendered_by_every_engine};
use std::fmt::Write as _;

/// In planes: convex, concave, crossing, with a hole; between triangles and over the sides of the screen.
const FILE: &str = "size 48 36
clear 0.1 0.1 0.2
T  4 4 0.5 1 0 0 0   44 8 0.5 0 1 1 0   10 33 0.5 1 0 1 0
P 5  10 2 0.4 1 0 0 0   30 6 0.4 1 0 0 0   36 20 0.4 1 0 0 0   20 30 0.4 1 0 0 0   6 18 0.4 1 0 0 0
P 4  4 4 0.2 0.2 0.2 0.2 0   44 4 0.6 0.6 0.6 0.6 0   44 32 0.74 0.74 0.74 0.74 0   4 32 0.34 0.34 0.34 0.34 0
P 4  -20 6 0.3 0 1 0 0   70 30 0.3 0 1 0 0   70 6 0.3 0 1 0 0   -20 30 0.3 0 1 0 0
P 6  2 20 0.1 0 0 1 0   46 20 0.1 0 0 1 0   46 34 0.1 0 0 1 0   24 26 0.1 0 0 1 0   13 34 0.1 0 0 1 0   2 34 0.1 0 0 1 0
H 3  8 22 0.1 0 0 1 0   16 22 0.1 0 0 1 0   12 27 0.1 0 0 1 0
T  0 0 0.05 1 1 1 0   9 0 0.05 1 1 1 0   0 9 0.05 1 1 1 0
";

fn folder(file: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.tri"), file).expect("a file");
    folder
}

fn report(folder: &tempfile::TempDir, more: &[&str]) -> serde_json::Value {
    let arguments = [&["render", "a.tri", "--json"], more].concat();
    let output = edgewalk(folder.path(), &arguments).output().expect("runs");
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{arguments:?}: {error}"))
}

#[test]
fn polygons_in_planes_are_drawn_by_every_engine() {
    let folder = folder(FILE);
    for more in [&["--machine", "polygon"][..], &["--set", "polygon.edges=16", "--set", "polygon.lines=yes"]]
    {
        for report in rendered_by_every_engine(folder.path(), &[&["a.tri"], more].concat()) {
            let comparison = &report["comparison"];
            assert_eq!(comparison["coverage_mismatches"], 0, "{comparison}");
            assert_eq!(comparison["order_wrong"], 0, "{comparison}");
            for channel in ["z", "color"] {
                let figure = |what: &str| comparison[format!("{channel}_{what}")].as_f64().expect("a number");
                let (error, bound) = (figure("error"), figure("bound"));
                assert!(error <= bound && bound < 1.5, "{channel}: {error} of {bound}");
            }
            assert_eq!((&report["triangles"], &report["polygons"]), (&2.into(), &4.into()), "{report}");
        }
    }
}

/// A wheel of many corners: more edges than POLY has places, but few on a line.
fn wheel(corners: u32) -> String {
    let mut file = format!("size 48 36\nP {corners}");
    for k in 0..corners {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(corners) + 0.05;
        _ = write!(file, "  {} {} 0.5 1 0.5 0 0", 24.0 + 16.0 * angle.cos(), 18.0 + 16.0 * angle.sin());
    }
    file + "\n"
}

#[test]
fn a_polygon_of_many_edges_is_drawn_in_bands() {
    let folder = folder(&wheel(40));
    let bands = report(&folder, &["--set", "polygon.edges=8"]);
    let whole = report(&folder, &["--set", "polygon.edges=64"]);
    for report in [&bands, &whole] {
        assert_eq!(report["comparison"]["coverage_mismatches"], 0, "{report}");
        assert_eq!(report["comparison"]["order_wrong"], 0, "{report}");
    }
    assert_eq!(bands["fragments"], whole["fragments"]);
    assert!(whole["fragments"].as_u64() > Some(700));
    // Each band is a polygon of its own for SETUP.
    let drawn = |report: &serde_json::Value| report["setup"]["triangles"]["drawn"].as_u64();
    assert!(drawn(&bands) > Some(1) && drawn(&whole) == Some(1), "{bands}");
}

#[test]
fn a_polygon_that_no_plane_holds_becomes_triangles() {
    let bent = "size 48 36\nP 4  4 4 0 1 0 0 0   44 4 1 0 0 0 0   44 32 0 0 0 1 0   4 32 1 0 0 0 0\n";
    let folder = folder(bent);
    let with_poly = report(&folder, &["--set", "polygon.edges=8"]);
    let without = report(&folder, &[]);
    for report in [&with_poly, &without] {
        assert_eq!(report["comparison"]["coverage_mismatches"], 0);
        assert_eq!(report["triangles"], 2, "{report}");
    }
    assert_eq!(with_poly["fragments"], without["fragments"]);
}

#[test]
fn what_poly_cannot_draw_names_place_and_remedy() {
    let teeth: String =
        (0..12).map(|k| format!("  {} {} 0.5 1 0 0 0", 2 + 4 * k, if k % 2 == 0 { 2 } else { 34 })).collect();
    let comb = format!("size 48 36\nT 0 0 0 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\nP 12{teeth}\n");
    let bow = "size 48 36\nP 4  4 4 0 1 0 0 0   44 32 0 1 0 0 0   44 4 1 1 0 0 0   4 32 0.5 1 0 0 0\n";
    let said = |folder: &tempfile::TempDir, more: &[&str]| {
        let arguments = [&["render", "a.tri"], more].concat();
        ended(&edgewalk(folder.path(), &arguments).output().expect("runs"))
    };
    let combed = folder(&comb);
    let (code, error) = said(&combed, &["--set", "polygon.edges=8"]);
    assert_eq!(code, Some(2), "{error}");
    for part in
        ["line 2 of polygon 1 has 12 active edges", "polygon.edges = 8 is the most", "set polygon.edges = 16"]
    {
        assert!(error.contains(part), "{error}");
    }
    assert_eq!(said(&combed, &["--set", "polygon.edges=16"]).0, Some(0));
    let (code, error) = said(&folder(bow), &["--set", "polygon.edges=8"]);
    assert_eq!(code, Some(2), "{error}");
    for part in
        ["polygon at vertex 44 4", "its edges cross and no plane holds its z", "largest defect", "permitted"]
    {
        assert!(error.contains(part), "{error}");
    }
    // Keys that clash.
    for (key, reason) in [
        ("edge.fill=textbook", "POLY wants edge.fill = exact"),
        ("setup.kind=sequenced", "POLY wants setup.kind = parallel"),
    ] {
        let arguments =
            ["config", "print", "--set", "screen.subpixel_bits=0", "--set", "polygon.edges=8", "--set", key];
        let output = edgewalk(combed.path(), &arguments).output().expect("runs");
        let (code, error) = ended(&output);
        assert_eq!(code, Some(2), "{key}: {error}");
        assert!(error.contains(reason) && error.contains("try polygon.edges = 0"), "{key}: {error}");
    }
    for value in ["7", "256", "-1", "many"] {
        let setting = format!("polygon.edges={value}");
        let output = edgewalk(combed.path(), &["config", "print", "--set", &setting]).output().expect("runs");
        let (code, error) = ended(&output);
        assert!(code == Some(2) && error.contains("0, 8, 16, 32, 64, 128"), "{value}: {error}");
    }
}

/// Each triangle of the built-in scenes has the same pixels by POLY as by EDGE.
#[test]
fn built_in_scenes_have_the_same_coverage() {
    let folder = tempfile::tempdir().expect("a folder");
    let coverage = |file: &str, edges: &str| {
        let arguments = ["raster", file, "--engine", "fast", "--out", "o", "--set", edges];
        let (code, error) = ended(&edgewalk(folder.path(), &arguments).output().expect("runs"));
        assert_eq!(code, Some(0), "{file}: {error}");
        npy(&folder.path().join("o/coverage.npy")).2
    };
    let mut covered = 0;
    for scene in ["sphere", "torus", "torus-knot", "terrain", "room"] {
        let file = format!("{scene}.tri");
        let arguments = ["triangles", scene, "--out", &file];
        assert_eq!(ended(&edgewalk(folder.path(), &arguments).output().expect("runs")).0, Some(0));
        let by_edge = coverage(&file, "polygon.edges=0");
        assert!(
            coverage(&file, "polygon.edges=8") == by_edge,
            "{scene}: a pixel has other triangles by POLY"
        );
        covered += by_edge.chunks(4).filter(|count| **count != [0; 4]).count();
    }
    println!("5 scenes, {covered} pixels with the same triangles over them");
    assert!(covered > 300_000, "{covered}");
}

/// Malformed polygons: the error of each names the line, the value and the permitted values.
#[test]
fn malformed_polygons_name_place_and_remedy() {
    let v = "1 1 0.5 1 0 0 0  8 1 0.5 1 0 0 0  8 8 0.5 1 0 0 0";
    let first = |from: &str, to: &str| format!("P 3 {}", v.replacen(from, to, 1));
    let cases: [(String, &[&str]); 25] = [
        ("P".into(), &["a.tri:2: P n: ``", "an integer from 3 to 65536"]),
        ("P 2 1 1 0.5 1 0 0 0  8 1 0.5 1 0 0 0".into(), &["a.tri:2: P n: `2`", "from 3 to 65536"]),
        (format!("P 65537 {v}"), &["P n: `65537`", "from 3 to 65536"]),
        (format!("P 3.5 {v}"), &["P n: `3.5`", "an integer"]),
        (format!("P -3 {v}"), &["P n: `-3`", "an integer"]),
        (format!("P 4 {v}"), &["a.tri:2: P: `21 given`", "28 values after n", "4 vertices"]),
        (format!("P 3 {v} 4"), &["P: `22 given`", "21 values after n", "3 vertices"]),
        (first("0.5", "1.5"), &["P vertex 1 z: `1.5`", "from -0.00001 to 1.00001"]),
        (first("0.5", "nan"), &["P vertex 1 z: `nan`", "a number"]),
        (first("8 1", "inf 1"), &["P vertex 2 x: `inf`", "-1000000 to 1000000"]),
        (first("8 1", "8 2e6"), &["P vertex 2 y: `2e6`", "-1000000 to 1000000"]),
        (first("1 0 0 0", "255 0 0 0"), &["P vertex 1 r: `255`", "from 0 to 1", "divide"]),
        (first("1 0 0 0", "1 0 0 -1"), &["P vertex 1 kt: `-1`", "from 0 to 1"]),
        (format!("H 3 {v}"), &["a.tri:2:", "`H`", "only on the lines after a polygon"]),
        (format!("P 3 {v}\nT {v}\nH 3 {v}"), &["a.tri:4:", "`H`", "only on the lines after a polygon"]),
        (format!("P 3 {v}\ndepth off\nH 3 {v}"), &["a.tri:4:", "`H`", "only on the lines after a polygon"]),
        (format!("P 3 {v}\nH 2 {v}"), &["a.tri:3: H n: `2`", "from 3 to 65536"]),
        (format!("P 3 {v}\nH 4 {v}"), &["a.tri:3: H: `21 given`", "28 values after n"]),
        (format!("P 3 {v}\nH 3 {}", v.replacen("8 8", "8 y", 1)), &["a.tri:3: H vertex 3 y: `y`"]),
        (format!("P 3 {v}\nmode flat"), &["a.tri:3: mode", "before the first triangle or polygon"]),
        (format!("p 3 {v}"), &["a.tri:2: line starts with: `p`", "did you mean `P`"]),
        (format!("extra 1\nP 3 {v}"), &["a.tri:3:", "polygons have no `X`", "only triangles"]),
        (
            format!("mode phong\nview 0 0 1\nsun 0 0 1 1\nP 3 {v}"),
            &["a.tri:5:", "polygons have no `N`", "only triangles"],
        ),
        (
            format!("blend 1\n{}", first("1 0 0 0", "1 0 0 0.5")),
            &["polygon 0 (counted from 0): kt within a polygon", "blend.kind=interpolated", "mode flat"],
        ),
        (
            "P 4 1 1 0 1 0 0 0 8 8 0 1 0 0 0 8 1 1 1 0 0 0 1 8 .5 1 0 0 0".into(),
            &["polygon at vertex 8 1", "its edges cross and no plane holds its z", "permitted"],
        ),
    ];
    for (lines, parts) in &cases {
        let folder = folder(&format!("size 9 9\n{lines}\n"));
        let keys = ["--set", "polygon.edges=8", "--set", "blend.kind=constant", "--out", "o"];
        let arguments = [&["render", "a.tri"], &keys[..]].concat();
        let (code, error) = ended(&edgewalk(folder.path(), &arguments).output().expect("runs"));
        assert_eq!(code, Some(2), "{lines}: {error}");
        assert!(parts.iter().all(|part| error.contains(part)), "{lines}: {error}");
        assert!(!folder.path().join("o").exists(), "{lines}: something was written");
    }
    let sound = folder(&format!("size 9 9\nP 3 {v}\n"));
    let output = edgewalk(sound.path(), &["render", "a.tri", "--set", "polygon.edges=8"]).output();
    assert_eq!(ended(&output.expect("runs")).0, Some(0), "what all of them are made from");
}

#[test]
fn a_polygon_beyond_the_guard_band_is_cut() {
    let far = "size 48 36\nP 4  -900 -700 0.2 1 0 0 0   900 -700 0.2 1 0 0 0   900 700 0.2 1 0 0 0   -900 700 0.2 1 0 0 0\n";
    let report = report(&folder(far), &["--set", "polygon.edges=8", "--set", "screen.guard_bits=8"]);
    assert_eq!(report["comparison"]["coverage_mismatches"], 0, "{report}");
    assert_eq!(report["fragments"], 48 * 36);
}

#[test]
fn explain_shows_the_registers_of_active_edges() {
    let folder = folder(FILE);
    let arguments = ["explain", "a.tri", "24", "12", "--machine", "polygon"];
    let output = edgewalk(folder.path(), &arguments).output().expect("runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for part in ["polygon 1: POLY's active edges on line 12", "lines left", "pixel 24 lies in the pair"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let output = edgewalk(folder.path(), &[&arguments[..], &["--json"]].concat()).output().expect("runs");
    let page: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a page");
    let (machine, golden) = (&page["poly"][0], &page["polygons"][0]);
    let columns = |list: &serde_json::Value, name: &str| -> Vec<i64> {
        let edges = list["active"].as_array().expect("a list");
        edges.iter().map(|edge| edge[name].as_i64().expect("a column")).collect()
    };
    assert_eq!(columns(machine, "c"), columns(golden, "column"), "{page}");
    assert_eq!(machine["pair"], golden["span"], "{page}");
}

#[test]
fn polygons_are_drawn_without_ticking() {
    let folder = folder(FILE);
    let poly = ["--set", "polygon.edges=16"];
    let json = |arguments: &[&str]| -> serde_json::Value {
        let output = edgewalk(folder.path(), &[arguments, &["--json"]].concat()).output().expect("runs");
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {error}");
        let line = output.stdout.split(|byte| *byte == b'\n').next().unwrap_or_default();
        serde_json::from_slice(&output.stdout).or_else(|_| serde_json::from_slice(line)).expect("a document")
    };
    let fast = "without ticking";
    let rendered = json(&[&["render", "a.tri"], &poly[..]].concat());
    assert_eq!(rendered["cycles"]["path"], fast, "{rendered}");
    let rastered = json(&[&["raster", "a.tri", "--out", "o"], &poly[..]].concat());
    assert_eq!(rastered["cycles"]["path"], fast, "{rastered}");
    let compared = json(&[
        "compare",
        "default,polygon.edges=16",
        "default,polygon.edges=64,interpolator.adders=1",
        "a.tri",
    ]);
    for side in ["a", "b"] {
        assert_eq!(compared[side]["report"]["cycles"]["path"], fast, "{compared}");
    }
    let timed = json(&[&["bench", "a.tri", "--engine", "fast,tick", "--repeat", "1"], &poly[..]].concat());
    assert_eq!(timed["engines"][0]["engine"], "fast", "{timed}");
    assert!(timed["engines"][0]["absent"].is_null() && timed["engines"][0]["differs"].is_null(), "{timed}");
    let sized = json(&[&["size", "a.tri"], &poly[..]].concat());
    // The second polygon starts at (4, 4) and ends at (43, 31).
    let farthest = &sized["channels"][0]["these"];
    assert_eq!(farthest["needed_by"], serde_json::json!([2, [43, 31]]), "{farthest}");
    assert_eq!(farthest["steps"], serde_json::json!([27, 39]), "{farthest}");
    let vary =
        ["sweep", "a.tri", "--vary", "fifo.span=1,2,8", "--vary", "setup.lanes=1,4", "--out", "s", "--quiet"];
    json(&[&vary, &poly[..]].concat());
    let rows = std::fs::read_to_string(folder.path().join("s/runs.jsonl")).expect("rows");
    let each: Vec<serde_json::Value> =
        rows.lines().map(|row| serde_json::from_str(row).expect("a row")).collect();
    assert_eq!(each.len(), 6);
    for row in &each {
        assert_eq!((&row["status"], &row["report"]["cycles"]["path"]), (&"ok".into(), &fast.into()), "{row}");
        assert_eq!(row["report"]["setup"]["by_pixels"], rendered["setup"]["by_pixels"], "{row}");
    }
}
