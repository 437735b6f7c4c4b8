//! `edgewalk render --engine golden`: every shading system from the command line, and what the machine refuses.

use std::path::Path;
use std::process::{Command, Output};

fn render(out: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .arg("render")
        .args(arguments)
        .args(["--json", "--out"])
        .arg(out)
        .output()
        .expect("the program runs")
}

fn report(out: &Path, arguments: &[&str]) -> serde_json::Value {
    let output = render(out, arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("a report")
}

#[test]
fn each_system_is_drawn_beside_the_truth() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut means = Vec::new();
    for shading in ["constant", "constant-averaged", "gouraud", "phong"] {
        let out = folder.path().join(shading);
        let report = report(&out, &["sphere", "--engine", "golden", "--shading", shading]);
        assert_eq!((&report["shading"], &report["specular"]), (&shading.into(), &"mirror".into()));
        assert!(report["pixels"].as_u64() > Some(100_000));
        for file in ["image.png", "truth.png", "shading_error.png", "report.json", "report.txt"] {
            assert!(out.join(file).is_file(), "{shading}: {file}");
        }
        println!("{shading}: largest {}, mean {} LSB", report["largest_error"], report["mean_error"]);
        means.push(report["mean_error"].as_f64().expect("a number"));
    }
    let [constant, averaged, gouraud, phong] = means[..] else { panic!("four systems") };
    assert!(constant > 2.0 * gouraud && averaged > 2.0 * gouraud && gouraud > 2.0 * phong && phong > 0.0);
    let read =
        |shading: &str, file: &str| std::fs::read(folder.path().join(shading).join(file)).expect("a picture");
    assert!(read("constant", "truth.png") == read("phong", "truth.png"), "one truth for all");
    assert!(read("constant", "image.png") != read("constant-averaged", "image.png"));
}

#[test]
fn a_wireframe_shows_fewer_lines_without_the_hidden_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    let writes = |name: &str, more: &[&str]| {
        let arguments = [&["torus", "--engine", "golden", "--shading", "wireframe"], more].concat();
        let report = report(&folder.path().join(name), &arguments);
        assert!(folder.path().join(name).join("image.png").is_file());
        (report["triangles"].as_u64(), report["fragments"].as_u64(), report["writes"].as_u64())
    };
    let (all, seen) = (writes("all", &["--hidden-lines"]), writes("seen", &[]));
    assert_eq!((all.0, all.1), (seen.0, seen.1), "the same lines");
    assert!(seen.2 > Some(10_000) && seen.2 < all.2, "{all:?} {seen:?}");
    for (refused, why) in [
        (&["torus", "--shading", "wireframe"][..], "--engine golden"),
        (&["torus", "--engine", "golden", "--shading", "phong", "--hidden-lines"], "--shading wireframe"),
    ] {
        let output = render(&folder.path().join("refused"), refused);
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&output.stderr).contains(why), "{refused:?}");
    }
}

#[test]
fn the_machine_draws_constant_and_refuses_phong() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    for shading in ["constant", "constant-averaged"] {
        assert_eq!(report(&out, &["sphere", "--shading", shading])["comparison"]["coverage_mismatches"], 0);
    }
    let refused = folder.path().join("refused");
    for engine in ["fast", "model", "rtl"] {
        let output = render(&refused, &["sphere", "--engine", engine, "--shading", "phong"]);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("--shading phong") && message.contains("--engine golden"), "{message}");
    }
    assert!(!refused.exists(), "nothing is left behind");
}

#[test]
fn texture_and_relief_need_phong() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scenes/texture-and-relief.toml");
    let mean = |shading: &str| {
        let name = scene.to_str().expect("a name of letters");
        let report = report(&folder.path().join("out"), &[name, "--engine", "golden", "--shading", shading]);
        report["mean_error"].as_f64().expect("a number")
    };
    let [gouraud, phong] = ["gouraud", "phong"].map(mean);
    println!("mean error of gouraud {gouraud:.3}, of phong {phong:.3} LSB");
    assert!(gouraud > 5.0 && phong < gouraud / 5.0, "what changes between vertices is lost on Gouraud");
}
