//! No command writes over what it reads.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{TRIANGLE, edgewalk, ended};
use std::fs;
use std::path::Path;

#[test]
fn inputs_stay_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("a.tri"), "size 32 32\nT 1 1 .3 1 0 0 0  31 2 .5 0 1 0 0  2 30 .7 0 0 1 0\n").unwrap();
    fs::write(at("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let machine = edgewalk(folder.path(), &["config", "print"]).output().unwrap().stdout;
    fs::write(at("m.toml"), &machine).unwrap();
    fs::create_dir(at("under")).unwrap();
    fs::copy("/usr/share/qflow/tech/osu018/osu018_stdcells.lib", at("a.lib")).unwrap();
    let cases: [(&[&str], &str, &str); 6] = [
        (
            &[
                "compare",
                "default",
                "small",
                "a.tri",
                "--energy",
                "1",
                "--library",
                "a.lib",
                "--page",
                "a.lib",
            ],
            "a.lib",
            "--page a.lib: ./a.lib",
        ),
        (&["compare", "default", "small", "a.tri", "--page", "a.tri"], "a.tri", "--page a.tri: ./a.tri"),
        (
            &["compare", "default", "small", "a.tri", "--page", "under/../a.tri"],
            "a.tri",
            "--page under/../a.tri: under/../a.tri",
        ),
        (
            &["compare", "default", "m.toml,setup.lanes=1:constant", "a.obj", "--page", "m.toml"],
            "m.toml",
            "--page m.toml: ./m.toml",
        ),
        (&["triangles", "a.obj", "--out", "a.obj"], "a.obj", "./a.obj"),
        (&["triangles", "a.tri", "--out", "./a.tri"], "a.tri", "./a.tri"),
    ];
    for (words, file, shown) in cases {
        let before = fs::read(at(file)).unwrap();
        let (code, error) = ended(&edgewalk(folder.path(), words).output().unwrap());
        assert_eq!(code, Some(2), "{words:?}: {error}");
        let said =
            format!("{shown}: this run reads this file, and would replace or remove it; permitted: a place");
        assert!(error.contains(&said), "{words:?}: {error}");
        assert_eq!(fs::read(at(file)).unwrap(), before, "{words:?}");
    }
    // Another file is written anew.
    fs::write(at("page.html"), "old").unwrap();
    let words = ["compare", "default", "small", "a.tri", "--page", "page.html"];
    assert_eq!(ended(&edgewalk(folder.path(), &words).output().unwrap()).0, Some(0));
    assert!(fs::read(at("page.html")).unwrap().len() > 100);
}

/// A triangle, the material that it names, and the picture that the material names.
fn mesh(folder: &Path) {
    let at = |name: &str| folder.join(name);
    fs::write(at("m.obj"), "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n")
        .unwrap();
    fs::write(at("m.mtl"), "newmtl a\nKd 1 1 1\nmap_Kd image.png\n").unwrap();
    fs::write(at("image.png"), PNG).unwrap();
    let buffer: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes).concat();
    fs::write(at("m.bin"), buffer).unwrap();
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"uri":"m.bin","byteLength":36}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
            "min":[0,0,0],"max":[1,1,0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]}"#;
    fs::write(at("m.gltf"), gltf).unwrap();
}

/// A white pixel.
const PNG: &[u8] = &[
    0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', 0, 0, 0, 13, b'I', b'H', b'D', b'R', 0, 0, 0, 1, 0, 0,
    0, 1, 8, 2, 0, 0, 0, 0x90, 0x77, 0x53, 0xde, 0, 0, 0, 12, b'I', b'D', b'A', b'T', 8, 0xd7, 0x63, 0xf8,
    0xff, 0xff, 0x3f, 0, 5, 0xfe, 2, 0xfe, 0xdc, 0xcc, 0x59, 0xe7, 0, 0, 0, 0, b'I', b'E', b'N', b'D', 0xae,
    0x42, 0x60, 0x82,
];

const SMALL: [&str; 4] = ["--set", "screen.width=16", "--set", "screen.height=16"];

#[test]
fn files_that_inputs_name_stay_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    mesh(folder.path());
    fs::write(at("witness_z_every.tri"), "size 32 32\nT 1 1 .3 1 0 0 0  31 2 .5 0 1 0 0  2 30 .7 0 0 1 0\n")
        .unwrap();
    let emitted = edgewalk(folder.path(), &["emit", "--machine", "small", "--out", "hw"]).output().unwrap();
    assert_eq!(ended(&emitted).0, Some(0));
    let cases: [(&[&str], &str); 6] = [
        (&["render", "m.obj", "--out", "."], "image.png"),
        (&["triangles", "m.obj", "--out", "m.mtl"], "m.mtl"),
        (&["triangles", "m.obj", "--out", "./image.png"], "image.png"),
        (&["triangles", "m.gltf", "--out", "m.bin"], "m.bin"),
        (&["size", "witness_z_every.tri", "--out", "."], "witness_z_every.tri"),
        (
            &["emit", "--machine", "hw/machine.toml", "--set", "setup.lanes=2", "--out", "hw"],
            "hw/machine.toml",
        ),
    ];
    for (words, file) in cases {
        let before = fs::read(at(file)).unwrap();
        let (command, rest) = (words[0], &words[1..]);
        let small: &[&str] = if ["render", "triangles"].contains(&command) { &SMALL } else { &[] };
        let (code, error) =
            ended(&edgewalk(folder.path(), &[&[command], rest, small].concat()).output().unwrap());
        assert_eq!(code, Some(2), "{words:?}: {error}");
        let said = format!("{file}: this run reads this file, and would replace or remove it; permitted: ");
        assert!(error.contains(&said), "{words:?}: {error}");
        assert_eq!(fs::read(at(file)).unwrap(), before, "{words:?}");
    }
    // Files of an earlier run are written anew, and so is an input that would stay the same.
    for words in [["render", "m.obj", "--out", "r"], ["render", "m.obj", "--out", "r"]] {
        let run = edgewalk(folder.path(), &[&words[..], &SMALL].concat()).output().unwrap();
        assert_eq!(ended(&run).0, Some(0), "{words:?}");
    }
    let same = ["emit", "--machine", "hw/machine.toml", "--out", "hw"];
    assert_eq!(ended(&edgewalk(folder.path(), &same).output().unwrap()).0, Some(0));
}

/// A link in --out goes, and what it names stays.
#[test]
fn a_link_to_an_input_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let machine =
        edgewalk(folder.path(), &["config", "print", "--machine", "small"]).output().unwrap().stdout;
    fs::write(folder.path().join("my.toml"), &machine).unwrap();
    fs::create_dir(folder.path().join("hw")).unwrap();
    std::os::unix::fs::symlink("../my.toml", folder.path().join("hw/machine.toml")).unwrap();
    let run = edgewalk(folder.path(), &["emit", "--machine", "my.toml", "--out", "hw"]).output().unwrap();
    assert_eq!(ended(&run).0, Some(0));
    assert_eq!(fs::read(folder.path().join("my.toml")).unwrap(), machine);
    assert!(!fs::symlink_metadata(folder.path().join("hw/machine.toml")).unwrap().is_symlink());
    // So does a link that an option for a single file names.
    let at = |name: &str| folder.path().join(name);
    fs::write(at("a.tri"), TRIANGLE).unwrap();
    for words in
        [&["triangles", "a.tri", "--out", "t"][..], &["compare", "default", "small", "a.tri", "--page", "t"]]
    {
        _ = fs::remove_file(at("t"));
        std::os::unix::fs::symlink("a.tri", at("t")).unwrap();
        let (code, error) = ended(&edgewalk(folder.path(), words).output().unwrap());
        assert_eq!(code, Some(0), "{words:?}: {error}");
        assert!(!fs::symlink_metadata(at("t")).unwrap().is_symlink(), "{words:?}");
        assert_eq!(fs::read_to_string(at("a.tri")).unwrap(), TRIANGLE, "{words:?}");
    }
}

/// A sweep that would replace the machine it begins with says so before it draws anything.
#[test]
fn a_sweep_keeps_its_own_machine() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let sweep = |machine: &str, vary: &str| {
        let words = ["sweep", "a.tri", "--machine", machine, "--vary", vary, "--out", "o", "-q"];
        ended(&edgewalk(folder.path(), &words).output().unwrap())
    };
    assert_eq!(sweep("small", "fifo.span=1,2").0, Some(0));
    let kept = ["sweep.json", "runs.jsonl"].map(|name| fs::read(folder.path().join("o").join(name)).unwrap());
    let (code, error) = sweep("o/best_cycles.toml", "fifo.inflight=1,2");
    assert_eq!(code, Some(2), "{error}");
    assert!(error.contains("o/best_cycles.toml: this run reads this file"), "{error}");
    let now = ["sweep.json", "runs.jsonl"].map(|name| fs::read(folder.path().join("o").join(name)).unwrap());
    assert!(kept == now);
}
