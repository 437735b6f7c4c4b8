//! Colours along the edges of polygons, `polygon.values` = bilinear.

use crate::support::{edgewalk, ended, rendered_by_every_engine};
use std::process::Output;

/// A square turned by so many degrees, its four corners red, green, blue and white: no plane holds their colours.
fn square(degrees: f64) -> String {
    let mut file = "size 48 36\nP 4".to_owned();
    for (k, colour) in ["1 0 0", "0 1 0", "0 0 1", "1 1 1"].into_iter().enumerate() {
        let angle = degrees.to_radians() + std::f64::consts::FRAC_PI_2 * (k as f64 + 0.5);
        let [x, y] = [24.0 + 16.0 * angle.cos(), 18.0 + 16.0 * angle.sin()];
        file += &format!("  {x} {y} 0.5 {colour} 0");
    }
    file + "\n"
}

fn folder(file: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.tri"), file).expect("a file");
    folder
}

/// The machine draws the orientation that a square stands in, as golden does: one polygon, and not two triangles.
#[test]
fn a_turned_square_has_goldens_colours() {
    for degrees in [0.0, 30.0, 45.0] {
        let folder = folder(&square(degrees));
        let machine = ["a.tri", "--machine", "bilinear", "--set", "edge.fraction_bits=20"];
        for report in rendered_by_every_engine(folder.path(), &machine) {
            let comparison = &report["comparison"];
            assert_eq!(comparison["coverage_mismatches"], 0, "{degrees}: {comparison}");
            assert_eq!((&report["triangles"], &report["polygons"]), (&0.into(), &1.into()), "{report}");
            let figure = |what: &str| comparison[what].as_f64().expect("a number");
            let (error, bound) = (figure("color_error"), figure("color_bound"));
            println!("{degrees} degrees: colours {error} LSB of {bound}");
            assert!(error <= bound && bound < 0.65, "{degrees}: {error} of {bound}");
        }
    }
}

fn json(output: &Output) -> serde_json::Value {
    let error = String::from_utf8_lossy(&output.stderr);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{error}"))
}

/// Two edges of the upright square are columns: on them colours run from corner to corner.
#[test]
fn explain_shows_colours_from_edge_to_edge() {
    let mut checked = 0;
    for degrees in [0.0, 30.0, 45.0] {
        let folder = folder(&square(degrees));
        for (x, y) in [(24, 18), (16, 14), (30, 22), (20, 25)] {
            let (column, line) = (x.to_string(), y.to_string());
            let options = ["--machine", "bilinear", "--set", "edge.fraction_bits=20"];
            let told = |more: &[&str]| {
                let arguments = [&["explain", "a.tri", &column, &line], &options[..], more].concat();
                edgewalk(folder.path(), &arguments).output().expect("runs")
            };
            let document = json(&told(&["--json"]));
            let span = &document["poly"][0]["between"];
            assert_eq!(span["ambiguous"], false, "{document}");
            for k in 0..3 {
                let of = |what: &str| span["colours"][k][what].as_f64().expect("a number");
                let (value, error, bound) = (of("value"), of("error"), of("bound"));
                assert!(error.abs() <= bound && (0.0001..0.2).contains(&bound), "{error} of {bound}");
                // The machine stores the value, rounded; golden has it less the error.
                assert_eq!(document["stored"]["rgb"][k].as_f64(), Some((value + 0.5).floor()), "{document}");
                let golden = 255.0 * document["rgb"][k].as_f64().expect("a number");
                assert!((value - error - golden).abs() < 0.1, "{value} {error} {golden}");
                let first = span["first"].as_f64().expect("a number");
                let walked = of("start") + (f64::from(x) - first) * of("increment");
                assert!((walked - value).abs() < 1e-9);
                if degrees == 0.0 {
                    // From blue down to green on the left, from white down to red on the right.
                    let half = 16.0 * 0.5f64.sqrt();
                    let down = 255.0 * (f64::from(y) + 0.5 - (18.0 - half)) / (2.0 * half);
                    let [left, right] = [[0.0, down, 255.0 - down], [255.0, 255.0 - down, 255.0 - down]];
                    assert!(
                        (of("left") - left[k]).abs() < 0.1 && (of("right") - right[k]).abs() < 0.1,
                        "{span}"
                    );
                }
                checked += 1;
            }
            let text = String::from_utf8(told(&[]).stdout).expect("text");
            assert!(text.contains("left edge  right edge  first pixel  increment"), "{text}");
        }
    }
    println!("checked {checked} colours");
    let folder = folder(&square(0.0));
    let arguments = ["explain", "a.tri", "24", "18", "--machine", "polygon", "--json"];
    let planes = json(&edgewalk(folder.path(), &arguments).output().expect("runs"));
    assert!(planes["poly"][0].get("between").is_none(), "{planes}");
}

#[test]
fn what_cannot_be_built_is_refused_with_a_remedy() {
    let folder = folder(&square(0.0));
    let refused = |settings: &[&str], parts: &[&str]| {
        let mut arguments = vec!["config", "print", "--machine", "bilinear"];
        arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
        let output = edgewalk(folder.path(), &arguments).output().expect("runs");
        let (code, error) = ended(&output);
        assert_eq!(code, Some(2), "{settings:?}: {error}");
        for part in parts {
            assert!(error.contains(part), "{settings:?}: {error}");
        }
    };
    refused(&["edge.kind=exact"], &["edge.kind = exact cannot be built", "try edge.kind = slope"]);
    refused(
        &["shade.kind=fast-phong"],
        &["polygon.values = bilinear cannot be built", "try polygon.values = plane"],
    );
    refused(
        &["shade.kind=phong"],
        &["polygon.values = bilinear cannot be built", "shading makes the colours"],
    );
    refused(&["setup.kind=sequenced"], &["POLY wants setup.kind = parallel"]);
    refused(&["edge.fill=textbook", "screen.subpixel_bits=0"], &["POLY wants edge.fill = exact"]);
    refused(
        &["polygon.values=biliner"],
        &["polygon.values = biliner is not permitted (plane, bilinear)", "nearest: bilinear"],
    );
    refused(&["polygon.values=2"], &["polygon.values = 2 is not permitted (plane, bilinear)"]);
    refused(&["polygon.values="], &["polygon.values", "is not permitted (plane, bilinear)"]);
    refused(&["polygon.value=plane"], &["unknown key polygon.value", "nearest: polygon.values"]);
    refused(&["polygon.values=Plane"], &["polygon.values = Plane is not permitted", "nearest: plane"]);
}
