//! Every mesh of the shared folder through golden picture and model, where that folder is.

use std::path::PathBuf;
use std::process::Command;

/// Meshes below the folder, and whether every edge is shared by exactly two faces.
const MESHES: &[(&str, bool)] = &[
    ("teapot_mcguire/teapot.obj", true),
    ("spot/spot_triangulated.obj", true),
    ("cornell/CornellBox-Original.obj", false),
    ("cornell/CornellBox-Sphere.obj", false),
    ("goathead.obj", true),
    ("torus.obj", true),
];

fn folder() -> PathBuf {
    std::env::var_os("EDGEWALK_MODELS").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models"),
        PathBuf::from,
    )
}

#[test]
fn every_mesh_agrees_with_the_golden_picture() {
    let folder = folder();
    if !folder.is_dir() {
        println!("the folder of shared meshes is not here; set EDGEWALK_MODELS to it to run this suite");
        return;
    }
    let mut checked = 0;
    for (name, closed) in MESHES {
        let out = tempfile::tempdir().expect("a folder");
        let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
            .arg("render")
            .arg(folder.join(name))
            .args(["--json", "--set", "screen.width=640", "--set", "screen.height=480", "--out"])
            .arg(out.path().join("out"))
            .output()
            .expect("the program runs");
        assert_eq!(output.status.code(), Some(0), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a report");
        let c = &report["comparison"];
        println!(
            "{name}: coverage mismatches {} / {}, z {:.4} LSB, colour {:.4} LSB, {} fragments, odd pixels {}",
            c["coverage_mismatches"],
            c["pixels"],
            c["z_error"],
            c["color_error"],
            report["fragments"],
            report["odd_pixels"]
        );
        assert_eq!(c["coverage_mismatches"], 0, "{name}");
        assert!(report["fragments"].as_u64() > Some(1000), "{name} draws next to nothing");
        assert!(c["z_error"].as_f64() <= Some(1.0) && c["color_error"].as_f64() <= Some(1.0), "{name}: {c}");
        if *closed {
            assert_eq!(
                report["odd_pixels"], 0,
                "{name} is closed: an even number of triangles covers every pixel"
            );
        }
        checked += 1;
    }
    println!("checked {checked} / {} meshes", MESHES.len());
}
