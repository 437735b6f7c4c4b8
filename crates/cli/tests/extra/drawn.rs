//! What the program drew: its arrays, read by this test's own code.

use super::shapes::Drawing;
use crate::support::npy;
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Arrays that every engine writes; those of the machine's engines are equal byte by byte.
const COMMON: [&str; 5] = ["coverage", "writes", "id", "z", "rgb"];

pub fn program(folder: &Path, arguments: &[&str], settings: &[String]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.current_dir(folder).args(arguments);
    settings.iter().for_each(|setting| _ = command.args(["--set", setting]));
    command
}

/// Runs it; standard output as JSON.
pub fn told(folder: &Path, arguments: &[&str], settings: &[String]) -> Value {
    let output = program(folder, arguments, settings).arg("--json").output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// One engine's picture.
pub struct Drawn {
    pub report: Value,
    pub id: Vec<i32>,
    /// By channel, LSB.
    pub own: Vec<Vec<f64>>,
}

/// Draws the folder's `in.tri` with an engine.
pub fn raster(folder: &Path, drawing: &Drawing, engine: &str) -> Drawn {
    let report =
        told(folder, &["raster", "in.tri", "--engine", engine, "--out", engine], &drawing.settings());
    let shape = [drawing.height as usize, drawing.width as usize];
    let array = |name: &str, expected: &str| {
        let (kind, found, bytes) = npy(&folder.join(engine).join(format!("{name}.npy")));
        assert_eq!((kind.as_str(), &found[..]), (expected, &shape[..]), "{engine} {name}");
        bytes
    };
    let own = (0..drawing.own.len()).map(|i| {
        let name = format!("e{i}");
        if engine == "golden" {
            let bytes = array(&name, "<f8");
            bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
        } else {
            let bytes = array(&name, "<i8");
            bytes.chunks_exact(8).map(|b| i64::from_le_bytes(b.try_into().unwrap()) as f64).collect()
        }
    });
    let own = own.collect();
    let absent = folder.join(engine).join(format!("e{}.npy", drawing.own.len()));
    assert!(!absent.exists(), "{}: the machine has no such channel", absent.display());
    let id = array("id", "<i4").chunks_exact(4).map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect();
    Drawn { report, id, own }
}

/// All engines on the folder's `in.tri`: golden and what the machine drew, which all its engines draw alike.
pub fn all(folder: &Path, drawing: &Drawing) -> [Drawn; 2] {
    let golden = raster(folder, drawing, "golden");
    let model = raster(folder, drawing, "model");
    for engine in ["fast", "rtl"] {
        raster(folder, drawing, engine);
        let names =
            COMMON.map(str::to_owned).into_iter().chain((0..drawing.own.len()).map(|i| format!("e{i}")));
        for name in names {
            let read = |engine: &str| std::fs::read(folder.join(engine).join(format!("{name}.npy"))).unwrap();
            assert!(read(engine) == read("model"), "{engine} {name}");
        }
    }
    [golden, model]
}
