//! Malformed machines, triangle files and meshes: a clear error, exit code 2, nothing left behind.

use std::path::Path;
use std::process::{Command, Output};

/// A file's contents, its extension, and what the error must say.
const FILES: &[(&str, &str, &[&str])] = &[
    ("tri", "", &["size"]),
    ("tri", "T 0 0 0 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\n", &["size"]),
    ("tri", "size 64\n", &[":1:", "size"]),
    ("tri", "size 64 sixty\n", &[":1:", "sixty"]),
    ("tri", "size 0 64\n", &[":1:", "size"]),
    ("tri", "size 64 64\nmode gourad\n", &[":2:", "gourad", "gouraud"]),
    ("tri", "size 64 64\ndepth lees\n", &[":2:", "lees", "less"]),
    ("tri", "size 64 64\ndepht less\n", &[":2:", "depht", "depth"]),
    ("tri", "size 64 64\ndepth_write 2\n", &[":2:", "depth_write"]),
    ("tri", "size 64 64\nblend maybe\n", &[":2:", "blend"]),
    ("tri", "size 64 64\nblend 1\n", &["input.tri", "blend 1", "golden"]),
    ("tri", "size 64 64\nclear 0 0\n", &[":2:", "clear"]),
    ("tri", "size 64 64\nclear 0 0 2\n", &[":2:", "clear"]),
    ("tri", "size 64 64\nsize 64 64\n", &[":2:", "size"]),
    ("tri", "size 64 64\nT 0 0 0 0 0 0 0\n", &[":2:"]),
    ("tri", "size 64 64\nT 0 0 0 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0 9\n", &[":2:"]),
    ("tri", "size 64 64\nT x 0 0 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\n", &[":2:", "x"]),
    ("tri", "size 64 64\nT nan 0 0 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\n", &[":2:", "nan"]),
    ("tri", "size 64 64\nT inf 0 0 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\n", &[":2:", "inf"]),
    ("tri", "size 64 64\nT 0 0 1.5 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\n", &[":2:", "1.5"]),
    ("tri", "size 64 64\nT 0 0 0 -1 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\n", &[":2:", "-1"]),
    ("tri", "size 9999 64\n", &["9999", "8192"]),
    ("tri", "size 64 64\nQ 1 2 3\n", &[":2:", "Q"]),
    ("tri", "size 64 64\nL 0 0 0  1 0 0  0 1 0\n", &[":2:", "L", "only after", "shadow"]),
    ("tri", "size 64 64\nshadow 0 0 1  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n", &[":2:", "SIZE", "16384"]),
    ("tri", "size 64 64\nshadow 8 2 1  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n", &[":2:", "BIAS", "-1 to 1"]),
    ("tri", "size 64 64\nshadow 8 0 2  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n", &[":2:", "AMBIENT", "0 to 1"]),
    (
        "tri",
        "size 64 64\nshadow 8 0 1  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0\n",
        &[":2:", "18 given", "19 values"],
    ),
    (
        "tri",
        "size 64 64\nshadow 8 0 1  1 0 0 0  0 1 0 0  0 0 nan 0  0 0 0 1\n",
        &[":2:", "m22", "nan", "finite"],
    ),
    ("tri", "size 64 64\nshdow 8\n", &[":2:", "shdow", "shadow"]),
    // A good file, but this machine has no SHADOW.
    (
        "tri",
        "size 64 64\nshadow 8 0 1  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n",
        &["input.tri", "shadow", "golden"],
    ),
    // It may come late, so its place is not what is wrong.
    (
        "tri",
        "size 64 64\nT 0 0 0 0 0 0 0  1 0 0 0 0 0 0  0 1 0 0 0 0 0\nshadow 8 0 1  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n",
        &["input.tri", "no SHADOW", "golden"],
    ),
    ("tri", "\u{fffd}\u{0}\u{1}", &[":1:"]),
];

/// Arguments after the subcommand, with what the error must say.
const ARGUMENTS: &[(&[&str], &[&str])] = &[
    (&["raster", "missing.tri", "--out", "OUT"], &["missing.tri"]),
    (&["render", "torus-not", "--out", "OUT"], &["torus-not", "torus-knot"]),
    (&["render", "mesh.ply", "--out", "OUT"], &["mesh.ply"]),
    (&["render", "sphere", "--shading", "phnog", "--out", "OUT"], &["phnog", "phong"]),
    (&["render", "sphere", "--shading", "phong", "--out", "OUT"], &["--shading phong", "--engine golden"]),
    (&["emit", "--machine", "textbok", "--out", "OUT"], &["textbok", "textbook"]),
    (&["emit", "--set", "interpolator.adders=9", "--out", "OUT"], &["interpolator.adders", "9", "nearest"]),
    (
        &["emit", "--set", "interpolator.adder=2", "--out", "OUT"],
        &["interpolator.adder", "interpolator.adders"],
    ),
    (&["emit", "--set", "adders", "--out", "OUT"], &["key=value"]),
    (
        &["gallery", "mach-bands", "--set", "setup.lanes=2", "--out", "OUT"],
        &["--set setup.lanes=2: ", "leave out"],
    ),
    (&["man", "--machine", "small", "--out", "OUT"], &["--machine small: ", "leave out"]),
    (&["completions", "bash", "--machine", "small"], &["--machine small: ", "leave out"]),
    (&["calibrate", "--machine", "small"], &["--machine small: ", "leave out"]),
    (
        &["sweep", "why", "1", "--out", "OUT", "--set", "setup.lanes=2"],
        &["--set setup.lanes=2: sweep.json has"],
    ),
    (
        &["compare", "default", "small", "--machine", "ecp5", "--out", "OUT"],
        &["--machine ecp5: ", "as default"],
    ),
    (
        &["estimate", "small,setup.lanes=2", "--set", "setup.lanes=1"],
        &["small,setup.lanes=2: --set setup.lanes=1 gives setup.lanes another value"],
    ),
    (&["emit", "--set", "edge.fill=textbook", "--out", "OUT"], &["subpixel_bits", "integer vertices"]),
    (&["emit", "--set", "screen.width=-1", "--out", "OUT"], &["screen.width", "nearest"]),
    (&["emit", "--machine", "no-such-file.toml", "--out", "OUT"], &["no-such-file.toml"]),
    (&["config", "explain", "memory.hazzard"], &["memory.hazzard", "memory.hazard"]),
];

/// Contents of a mesh file, its extension, and what the error must say.
const MESHES: &[(&str, &str, &[&str])] = &[
    ("obj", "", &["mesh.obj"]),
    ("obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", &["mesh.obj"]),
    ("obj", "v 0 0 zero\n", &["mesh.obj"]),
    ("obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &["mesh.obj"]),
    ("gltf", "{", &["mesh.gltf"]),
    ("glb", "glTF", &["mesh.glb"]),
];

/// Contents of a machine file and what the error must say.
const MACHINES: &[(&str, &[&str])] = &[
    ("[screen]\nwidth = \n", &["m.toml", "line 2"]),
    ("[screen]\nwidht = 5\n", &["m.toml", "line 2", "screen.widht", "screen.width"]),
    ("[screen]\nwidth = 640.5\n", &["m.toml", "line 2", "640.5"]),
    ("[interpolator]\nadders = 9\n", &["m.toml", "line 2", "adders"]),
    ("[screen]\nwidth = 8192\n[screen]\n", &["m.toml", "line 3"]),
    ("[formats]\nz_bits = 32\nz_fraction = 30\n", &["m.toml", "line 3", "z_fraction"]),
    ("hazard = \"drain\"\n", &["m.toml", "line 1", "memory.hazard"]),
];

fn edgewalk(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program runs")
}

/// The error names all that it must, the exit code is 2, and nothing but `kept` stands in the folder.
fn refused(folder: &Path, arguments: &[&str], must_say: &[&str], kept: usize) {
    let output = edgewalk(folder, arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    for word in must_say {
        assert!(error.contains(word), "{arguments:?}: `{word}` is not said: {error}");
    }
    assert!(!error.contains("panicked"), "{arguments:?}: {error}");
    let left = std::fs::read_dir(folder).expect("the folder").count();
    assert_eq!(left, kept, "{arguments:?} left something behind");
}

#[test]
fn malformed_triangle_files() {
    for (extension, text, must_say) in FILES {
        let folder = tempfile::tempdir().expect("a folder");
        let name = format!("input.{extension}");
        std::fs::write(folder.path().join(&name), text).expect("written");
        refused(folder.path(), &["raster", &name, "--out", "OUT"], must_say, 1);
    }
    println!("checked {0} / {0} triangle files", FILES.len());
}

#[test]
fn malformed_meshes() {
    for (extension, text, must_say) in MESHES {
        let folder = tempfile::tempdir().expect("a folder");
        let name = format!("mesh.{extension}");
        std::fs::write(folder.path().join(&name), text).expect("written");
        refused(folder.path(), &["render", &name, "--out", "OUT"], must_say, 1);
    }
    println!("checked {0} / {0} meshes", MESHES.len());
}

#[test]
fn malformed_machines() {
    for (text, must_say) in MACHINES {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("m.toml"), text).expect("written");
        refused(folder.path(), &["emit", "--machine", "m.toml", "--out", "OUT"], must_say, 1);
    }
    println!("checked {0} / {0} machine files", MACHINES.len());
}

#[test]
fn malformed_arguments() {
    for (arguments, must_say) in ARGUMENTS {
        let folder = tempfile::tempdir().expect("a folder");
        refused(folder.path(), arguments, must_say, 0);
    }
    println!("checked {0} / {0} command lines", ARGUMENTS.len());
}

/// Cutting a face takes time that grows with the square of its corners.
#[test]
fn faces_of_too_many_corners() {
    let corners = |count: usize, first: usize, between: &str| {
        (first..first + count).map(|corner| corner.to_string()).collect::<Vec<_>>().join(between)
    };
    let points = |before: &str, between: &str, behind: &str| -> String {
        (0..16385).map(|i| format!("{before}{}{between}{}{between}{i}{behind}", i % 7, i % 5)).collect()
    };
    let obj = format!("{}f {}\n", points("v ", " ", "\n"), corners(16385, 1, " "));
    let scene = format!(
        "[[object]]\npositions = [{}]\nfaces = [[{}]]\n",
        points("[", ", ", "], "),
        corners(16385, 0, ", ")
    );
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text, said) in [
        ("a.obj", obj, "a.obj:16386: f: `16385 corners`: permitted: 3 to 16384 corners; cut"),
        (
            "a.toml",
            scene,
            "a.toml:3: object 1: faces: `16385 places`: permitted: 3 to 16384 places a face; cut",
        ),
    ] {
        std::fs::write(folder.path().join(name), text).expect("written");
        let output = edgewalk(folder.path(), &["triangles", name, "--out", "o.tri"]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && error.contains(said), "{error}");
    }
}
