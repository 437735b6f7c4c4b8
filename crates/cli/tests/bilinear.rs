//! Colours along the edges of polygons, `polygon.values` = bilinear.

use crate::support::{edgewalk, ended, rendered_by_every_engine};

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
