//! Meshes from files, end to end: those written here, or those of the folder that `tests/meshes DIR` is given.
//!
//! ```text
//!  shapes ─> files (OBJ, glTF, GLB, MTL, PNG) ─┐
//!                          EDGEWALK_MESHES=DIR ┴─> edgewalk render ─> coverage, depth, colour, evenness, shading
//! ```
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod files;
mod shapes;

use edgewalk_scene::Scene;
use serde_json::Value;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use tempfile::TempDir;

/// Meshes that are there while the tests run.
struct Meshes {
    list: Vec<PathBuf>,
    /// Where they were written; `None` for a folder of the user's.
    written: Option<TempDir>,
}

impl Meshes {
    /// Those of the user's folder if one is named, else those written here. Panics where there are none.
    fn new() -> Self {
        let (folder, written) = match std::env::var_os("EDGEWALK_MESHES") {
            Some(folder) => (PathBuf::from(folder), None),
            None => {
                let folder = tempfile::tempdir().unwrap();
                files::write_all(folder.path());
                (folder.path().to_owned(), Some(folder))
            }
        };
        let mut list = Vec::new();
        collect(&folder, &mut list);
        list.sort();
        assert!(!list.is_empty(), "{}: no mesh in it", folder.display());
        Meshes { list, written }
    }

    /// All of them were checked, and there are as many as were written.
    fn done(&self, checked: usize) {
        println!("checked {checked} / {} meshes", self.list.len());
        assert_eq!(checked, self.list.len());
        if self.written.is_some() {
            assert_eq!(checked, files::FILES);
        }
    }
}

fn collect(folder: &Path, list: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    for path in entries.map(|entry| entry.unwrap().path()) {
        let kind = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        if path.is_dir() {
            collect(&path, list);
        } else if ["obj", "gltf", "glb"].contains(&kind.as_str()) {
            list.push(path);
        }
    }
}

fn name(mesh: &Path) -> String {
    mesh.file_name().unwrap().to_string_lossy().into_owned()
}

/// Renders and returns the report, which must be that of a pass.
fn render(mesh: &Path, settings: &[&str], more: &[&str]) -> Value {
    let out = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.arg("render").arg(mesh).args(["--json", "--out"]).arg(out.path().join("out")).args(more);
    for setting in settings {
        command.args(["--set", setting]);
    }
    let output = command.output().unwrap();
    let said =
        String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{} {settings:?} {more:?}: {said}", name(mesh));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Whether every edge is shared by an even number of faces: then an even number covers every pixel from any side.
fn is_closed(mesh: &Path) -> bool {
    let scene = Scene::open(mesh.to_str().unwrap()).unwrap();
    let mut faces_at: HashMap<[[u64; 3]; 2], u32> = HashMap::new();
    for face in scene.mesh.faces() {
        let corners = scene.mesh.corners(face).map(|p| [p.x, p.y, p.z].map(|c| (c + 0.0).to_bits()));
        for k in 0..3 {
            let mut edge = [corners[k], corners[(k + 1) % 3]];
            edge.sort();
            *faces_at.entry(edge).or_default() += 1;
        }
    }
    faces_at.values().all(|faces| faces % 2 == 0)
}

#[test]
fn every_mesh_agrees_with_the_golden_picture() {
    let meshes = Meshes::new();
    let (mut checked, mut closed, mut triangles) = (0, 0, 0);
    let mut worst = [0f64; 2];
    for mesh in &meshes.list {
        let mut evenly = "open";
        if is_closed(mesh) {
            (evenly, closed) = ("evenly covered on three screens", closed + 1);
        }
        for (screen, most) in
            [(["640", "480", "8"], 1000), (["160", "120", "4"], 100), (["61", "97", "0"], 50)]
        {
            let keys = ["screen.width", "screen.height", "screen.subpixel_bits"];
            let settings: Vec<String> =
                keys.iter().zip(screen).map(|(key, value)| format!("{key}={value}")).collect();
            let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
            let report = render(mesh, &settings, &[]);
            let c = &report["comparison"];
            let pixels = screen[0].parse::<u64>().unwrap() * screen[1].parse::<u64>().unwrap();
            assert_eq!(
                (&c["coverage_mismatches"], &c["pixels"]),
                (&0.into(), &pixels.into()),
                "{}",
                name(mesh)
            );
            assert_eq!((&c["order_wrong"], &c["compared"]), (&0.into(), &c["covered"]), "{}", name(mesh));
            assert!(c["compared"].as_u64() > Some(most), "{} draws next to nothing: {c}", name(mesh));
            let errors = ["z_error", "color_error"].map(|key| c[key].as_f64().unwrap());
            assert!(errors.iter().all(|error| *error < 1.0), "{}: {c}", name(mesh));
            if evenly != "open" {
                assert_eq!(report["odd_pixels"], 0, "{} is closed, {screen:?}", name(mesh));
            }
            if screen[0] == "640" {
                println!(
                    "{}: {} triangles, {} fragments, coverage mismatches {} / {}, z {:.4} LSB, colour {:.4} LSB, order undecided {}, {evenly}",
                    name(mesh),
                    report["triangles"],
                    report["fragments"],
                    c["coverage_mismatches"],
                    c["pixels"],
                    errors[0],
                    errors[1],
                    c["order_undecided"],
                );
                worst = [worst[0].max(errors[0]), worst[1].max(errors[1])];
                triangles += report["triangles"].as_u64().unwrap() as usize;
            }
        }
        checked += 1;
    }
    meshes.done(checked);
    println!(
        "{triangles} triangles, {closed} meshes closed; largest z error {:.3}, colour {:.3} LSB",
        worst[0], worst[1]
    );
    if meshes.written.is_some() {
        assert_eq!((triangles, closed), (files::TRIANGLES, files::CLOSED));
        let results = include_str!("../../../../docs/results.md");
        let row = format!("at most {:.3} LSB of 24 and {:.3} of 8 bits", worst[0], worst[1]);
        assert!(results.contains(&row), "docs/results.md does not say: {row}");
    }
}

/// The seconds are for reading, not for judging: other work may be going on.
#[test]
fn every_mesh_is_shaded_at_1280_by_960() {
    let meshes = Meshes::new();
    let mut checked = 0;
    for mesh in &meshes.list {
        let started = Instant::now();
        let screen = ["screen.width=1280", "screen.height=960"];
        let report = render(mesh, &screen, &["--engine", "golden", "--shading", "phong"]);
        let seconds = started.elapsed().as_secs_f64();
        println!(
            "{}: {seconds:.2} s, {} pixels, largest error {:.3}, mean {:.3} LSB",
            name(mesh),
            report["pixels"],
            report["largest_error"].as_f64().unwrap(),
            report["mean_error"].as_f64().unwrap()
        );
        assert!(report["pixels"].as_u64() > Some(10_000), "{}", name(mesh));
        if meshes.written.is_some() {
            assert_eq!(report["missing_textures"], Value::Array(Vec::new()), "{}", name(mesh));
        }
        checked += 1;
    }
    meshes.done(checked);
}

#[test]
fn a_folder_that_is_missing_or_holds_no_mesh_fails() {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/meshes");
    let empty = tempfile::tempdir().unwrap();
    std::fs::write(empty.path().join("notes.txt"), "no mesh").unwrap();
    let missing = empty.path().join("missing");
    for (arguments, expected) in [
        (vec![missing.to_str().unwrap()], "is no folder"),
        (vec![empty.path().to_str().unwrap()], "no mesh"),
        (vec![], "tests/meshes DIR"),
    ] {
        let output = Command::new(script).args(&arguments).output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(expected), "{arguments:?}: {message}");
    }
}
