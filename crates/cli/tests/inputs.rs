//! Which inputs commands take, and what they say of those they do not: standard input, meshes, what a file asks of the machine.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{TRIANGLE, edgewalk, ended, npy, run};
use std::io::Write as _;
use std::path::Path;
use std::process::Stdio;

const MESH: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0.5\nv 0 1 0\nv 1 1 1\nusemtl a\nf 1 2 3\nf 2 4 3\n";

/// Asks for BLEND, SHADOW with a map of 16 x 16 behind glass, and more than nothing in shadow.
const ASKING: &str = "size 64 48\nshadow 16 0.001 0.25  0.25 0 0 0  0 0.25 0 0  0 0 1 0  0 0 0 1\n\
    L 0 0 0.1  16 0 0.1  0 16 0.1  0.5\nblend 1\nT 0 0 0 1 0 0 0.5  60 0 0 0 1 0 0.25  0 40 1 0 0 1 0\n";

/// Asks for a light in perspective, and for one k_t a triangle.
const LENS: &str = "size 64 48\nshadow 32 0.001 0  0.5 0 0 0  0 0.5 0 0  0 0 1 0  0 0 0.5 1\nL 0 0 0.1  32 0 0.1  0 32 0.1\n\
    colour_write 0\nT 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 40 1 0 0 1 0\ncolour_write 1\ndepth equal\n\
    T 0 0 0 1 0 0 0  60 0 0 0 1 0 0  0 40 1 0 0 1 0\n";

/// Asks for a value of the user's own, Phong shading with two lights, and a texture.
const SHADED: &str = "size 64 48\nmode phong\nextra 1\nview 0 0 1\nsun 0.3 0.3 1 0.5\nsun -1 0 0.5 0.2\nmaterial 0.1 0.7 0.1 9\n\
    texture 2 1 ff0000 00ff00\nT 0 0 0.5 0.5 1 1 0   60 0 0.5 1 0.5 1 0   0 40 0.5 1 1 0.5 0\nN 0 0 1 0 0 1 0 0 1\nUV 0 0 1 0 0 1\nX 1 0 1\n";

/// Runs a command with a text on its standard input.
fn with_input(folder: &Path, arguments: &[&str], text: &str) -> (Option<i32>, String) {
    let mut child = edgewalk(folder, arguments)
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // A command that refuses its arguments reads nothing.
    _ = child.stdin.take().unwrap().write_all(text.as_bytes());
    ended(&child.wait_with_output().unwrap())
}

/// What commands leave in `out`, file by file.
fn same_folders(folder: &Path, one: &str, other: &str) -> usize {
    let mut same = 0;
    for name in ["image.png", "z.npy", "rgb.npy", "difference.png", "witness_z_every.tri"] {
        let [a, b] = [one, other].map(|out| std::fs::read(folder.join(out).join(name)).ok());
        assert!(a == b, "{one}, {other}: {name}");
        same += usize::from(a.is_some());
    }
    same
}

#[test]
fn every_command_reads_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("given.tri"), TRIANGLE).unwrap();
    let commands: [&[&str]; 12] = [
        &["raster", "IN"],
        &["render", "IN"],
        &["compare", "default", "default,interpolator.adders=1", "IN"],
        &["sweep", "IN", "--vary", "interpolator.adders=1,2"],
        &["size", "IN"],
        &["vectors", "IN", "--unit", "machine"],
        &["replay", "IN"],
        &["trace", "IN", "--cycles", "9"],
        &["triangles", "IN"],
        &["verify", "IN", "--no-simulators", "--triangles", "1", "--stalls", "none"],
        &["explain", "IN", "10", "10"],
        &["bench", "IN", "--engine", "fast", "--repeat", "1"],
    ];
    let (mut checked, mut same) = (0, 0);
    for command in commands {
        let out = match command[0] {
            "replay" => Some("OUT.html"),
            "trace" => Some("OUT.vcd"),
            "triangles" => Some("OUT.tri"),
            "explain" | "bench" | "verify" => None,
            _ => Some("OUT"),
        };
        let arguments = |input: &str, to: &str| -> Vec<String> {
            let mut all: Vec<String> = command.iter().map(|word| word.replace("IN", input)).collect();
            all.push("-q".into());
            all.extend(out.iter().flat_map(|out| ["--out".into(), out.replace("OUT", to)]));
            all
        };
        for (input, to) in [("-", "dash"), ("/dev/stdin", "device")] {
            let words = arguments(input, to);
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            assert_eq!(with_input(folder, &words, TRIANGLE), (Some(0), String::new()), "{words:?}");
            checked += 1;
        }
        let words = arguments("given.tri", "plain");
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        assert_eq!(run(folder, &words), (Some(0), String::new()), "{words:?}");
        same += same_folders(folder, "plain", "dash") + same_folders(folder, "plain", "device");
        for to in ["plain", "dash", "device"] {
            _ = std::fs::remove_dir_all(folder.join(to));
        }
    }
    println!("{checked} / 24 runs read the standard input, {same} files are those of the plain file");
    assert!(checked == 24 && same >= 12, "{checked} {same}");
}

/// Every setting that a message asks for.
fn settings(error: &str) -> Vec<String> {
    let parts = error.split("--set ").skip(1);
    parts.map(|part| part.split([' ', ',', ';', '\n']).next().unwrap().to_owned()).collect()
}

#[test]
fn needs_of_a_file_are_named_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut checked = 0;
    for (name, text, wanted) in [
        (
            "asking.tri",
            ASKING,
            &[
                "blend.kind=interpolated",
                "shadow.light=parallel",
                "shadow.size=16",
                "shadow.transmits=yes",
                "shadow.gate=scale",
            ][..],
        ),
        ("lens.tri", LENS, &["blend.kind=constant", "shadow.light=perspective", "shadow.size=32"]),
        (
            "shaded.tri",
            SHADED,
            &[
                "channels.extra=1",
                "shade.kind=phong",
                "shade.lights=2",
                "texture.kind=nearest",
                "shade.colour=multiply",
            ],
        ),
    ] {
        std::fs::write(folder.join(name), text).unwrap();
        let commands: [&[&str]; 8] = [
            &["raster", name, "--out", "o"],
            &["raster", name, "--engine", "model", "--out", "o"],
            &["render", name],
            &["explain", name, "10", "10"],
            &["trace", name, "--out", "t.vcd", "--cycles", "9"],
            &["compare", "default", "default", name],
            &["size", name],
            &["replay", name, "--out", "r.html", "--cycles", "9"],
        ];
        for command in commands {
            let output = edgewalk(folder, command).output().unwrap();
            // `explain` explains the golden picture too, and says in its text why the machine draws none; it takes no
            // values of the user's own without their channels.
            let explains = command[0] == "explain" && name != "shaded.tri";
            let error = String::from_utf8(if explains { output.stdout } else { output.stderr }).unwrap();
            assert_eq!(
                (output.status.code(), settings(&error)),
                (Some(if explains { 0 } else { 2 }), wanted.iter().map(|w| w.to_string()).collect()),
                "{command:?}: {error}"
            );
            assert!(error.contains("or --adapt"), "{error}");
            let set: Vec<&str> = wanted.iter().flat_map(|setting| ["--set", setting]).collect();
            // Waveforms are drawn without maps of lights.
            let refused = command[0] == "trace" && name != "shaded.tri";
            for with in [&set[..], &["--adapt"]] {
                let (code, error) = run(folder, &[command, with, &["-q"]].concat());
                if refused {
                    assert!(code == Some(2) && error.starts_with("error: shadow: a light's map"), "{error}");
                } else {
                    assert_eq!((code, error.as_str()), (Some(0), ""), "{command:?} {with:?}");
                }
                checked += 1;
            }
        }
        let arrays: Vec<_> =
            [&["--adapt"][..], &[&wanted.iter().flat_map(|w| ["--set", w]).collect::<Vec<_>>()[..]].concat()]
                .iter()
                .map(|with| {
                    assert_eq!(
                        run(folder, &[&["raster", name, "-q", "--out", "o"], *with].concat()).0,
                        Some(0)
                    );
                    npy(&folder.join("o/rgb.npy"))
                })
                .collect();
        assert_eq!(arrays[0], arrays[1], "{name}");
    }
    println!("{checked} / 48 runs with what was asked for");
    assert_eq!(checked, 48);
}

/// What --set says stands, though the file asks for another value; the error names it.
#[test]
fn adapting_leaves_what_is_set() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("a.tri"), ASKING).unwrap();
    let (code, error) = run(folder, &["render", "a.tri", "--adapt", "--set", "shadow.size=32"]);
    let says = "error: shadow 16: the machine's map has 32 x 32 texels; --set shadow.size=32 stands against --adapt: leave it out\n";
    assert_eq!((code, error.as_str()), (Some(2), says));
}

#[test]
fn screen_is_that_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("a.tri"), TRIANGLE).unwrap();
    for command in [
        &["render", "a.tri"][..],
        &["trace", "a.tri", "--out", "t.vcd", "--cycles", "9"],
        &["explain", "a.tri", "63", "47"],
        &["compare", "default", "default", "a.tri"],
        &["verify", "a.tri", "--no-simulators", "--triangles", "1", "--stalls", "none"],
    ] {
        assert_eq!(run(folder, &[command, &["-q"]].concat()), (Some(0), String::new()), "{command:?}");
    }
    let (code, error) = run(folder, &["explain", "a.tri", "64", "0"]);
    assert!(code == Some(2) && error.contains("X from 0 to 63, Y from 0 to 47"), "{error}");
}

#[test]
fn raster_says_what_draws_a_mesh() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.obj"), MESH).unwrap();
    for (name, kind) in [("a.obj", "a mesh"), ("b.toml", "a scene"), ("sphere", "a scene")] {
        let (code, error) = run(folder.path(), &["raster", name, "--out", "o"]);
        let expected = format!(
            "error: {name}: {kind}: permitted: a triangle file (.tri); draw it with `edgewalk render {name}`, or make a triangle \
             file of it with `edgewalk triangles {name} --out FILE.tri`\n"
        );
        assert_eq!((code, error), (Some(2), expected));
    }
}

/// The file that `triangles` writes is drawn as the mesh is, by every way there is.
#[test]
fn triangles_of_a_mesh_draw_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("a.obj"), MESH).unwrap();
    std::fs::write(folder.join("a.mtl"), "newmtl a\nKd 0.9 0.5 0.1\nd 0.5\n").unwrap();
    let machine =
        ["-q", "--set", "screen.width=61", "--set", "screen.height=47", "--set", "blend.kind=interpolated"];
    let mut checked = 0;
    for (input, shading) in
        [("a.obj", "gouraud"), ("a.obj", "constant"), ("sphere", "gouraud"), ("room", "gouraud")]
    {
        let of = |command: &[&str]| {
            let all = [command, &machine].concat();
            assert_eq!(run(folder, &all), (Some(0), String::new()), "{all:?}");
        };
        of(&["triangles", input, "--shading", shading, "--out", "to/a.tri"]);
        of(&["render", input, "--shading", shading, "--out", "mesh"]);
        of(&["render", "to/a.tri", "--out", "file"]);
        of(&["raster", "to/a.tri", "--out", "raster"]);
        let picture = |out: &str| std::fs::read(folder.join(out).join("image.png")).unwrap();
        assert!(picture("mesh") == picture("file"), "{input} {shading}");
        let colors = |out: &str| crate::support::colors(&folder.join(out).join("image.png"));
        assert!(colors("mesh") == colors("raster"), "{input} {shading}");
        let output = edgewalk(folder, &["triangles", input, "--shading", shading, "--out", "-"])
            .args(machine)
            .output()
            .unwrap();
        assert!(output.status.success() && output.stdout == std::fs::read(folder.join("to/a.tri")).unwrap());
        checked += 3;
    }
    println!("{checked} / 12 pictures of triangle files are those of their inputs");
    assert_eq!(checked, 12);
}

/// A machine takes the screen of the file; another one that is asked for is refused, whatever draws.
#[test]
fn another_screen_than_the_files_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("a.tri"), crate::support::TRIANGLE).unwrap();
    let mut checked = 0;
    for engine in ["fast", "golden", "model"] {
        for adapt in [&[][..], &["--adapt"]] {
            let other = ["raster", "a.tri", "--engine", engine, "--out", "o", "--set", "screen.width=640"];
            let (code, said) = run(folder, &[&other, adapt].concat());
            let expected = "a.tri: size 64 48: the machine's screen is 640x48; add --set screen.width=64 --set screen.height=48";
            assert!(code == Some(2) && said.contains(expected), "{engine}: {said}");
            assert!(!folder.join("o").exists());
            checked += 1;
        }
    }
    assert_eq!(checked, 6);
    assert_eq!(run(folder, &["raster", "a.tri", "-q", "--out", "o", "--set", "screen.width=64"]).0, Some(0));
}

#[test]
fn messages_name_values_in_their_order() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (text, expected) in [
        (
            "size 8 8\nT 1 1 0 255 0 0\n",
            "a.tri:2: T: `6 given`: permitted: 21 values, x y z r g b kt of vertex 1, then of 2, then of 3",
        ),
        (
            "size 8 8\nT 1 1 0 255 0 0 0  7 1 0 0 0 0 0  1 7 0 0 0 0 0\n",
            "a.tri:2: T vertex 1 r: `255`: permitted: a number from 0 to 1; colours are 0 to 1, so divide those of 0 to 255 by 255",
        ),
        (
            "size 8 8\nclear 0 128 0\n",
            "a.tri:2: clear g: `128`: permitted: a number from 0 to 1; colours are 0 to 1",
        ),
        ("size 8\n", "a.tri:1: size: `1 given`: permitted: 2 values, W H"),
        (
            "size 8 8\nshadow 8\n",
            "a.tri:2: shadow: `1 given`: permitted: 19 values, SIZE BIAS AMBIENT, then m00 to m33 row by row",
        ),
    ] {
        std::fs::write(folder.join("a.tri"), text).unwrap();
        let (code, error) = run(folder, &["raster", "a.tri", "--out", "o"]);
        assert!(code == Some(2) && error.starts_with(&format!("error: {expected}")), "{text:?}: {error}");
    }
    let negative = "size 8 8\nT 1 1 0 -1 0 0 0  7 1 0 0 0 0 0  1 7 0 0 0 0 0\n";
    std::fs::write(folder.join("a.tri"), negative).unwrap();
    assert!(
        !run(folder, &["raster", "a.tri", "--out", "o"]).1.contains("divide"),
        "a negative colour is no byte"
    );
    std::fs::write(folder.join("notes.md"), "notes").unwrap();
    let (code, error) = run(folder, &["render", "notes.md"]);
    for part in
        ["notes.md: kind of input: `md`", "built-in scene (sphere", ".tri", ".toml", ".obj", ".gltf", ".glb"]
    {
        assert!(code == Some(2) && error.contains(part), "{error} lacks {part}");
    }
}

/// `lit.npy` is 0 where no colour was stored, though a fragment passed (docs/triangle_file.md).
#[test]
fn unstored_colours_are_not_lit() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let t = "T 0 0 0.5 1 1 1 0  8 0 0.5 1 1 1 0  0 8 0.5 1 1 1 0\n";
    let half = "T 0 0 0.25 1 1 1 0  4 0 0.25 1 1 1 0  0 4 0.25 1 1 1 0\n";
    let text = format!(
        "size 4 4\nshadow 4 0 0  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\ncolour_write 0\n{t}colour_write 1\n{half}"
    );
    std::fs::write(folder.join("a.tri"), text).unwrap();
    let mut found = Vec::new();
    for engine in ["golden", "fast", "model", "rtl"] {
        let (code, error) =
            run(folder, &["raster", "a.tri", "--engine", engine, "--adapt", "-q", "--out", engine]);
        assert_eq!((code, error.as_str()), (Some(0), ""), "{engine}");
        let z = npy(&folder.join(engine).join("z.npy")).2;
        assert!(
            z.chunks_exact(8).all(|z| f64::from_le_bytes(z.try_into().unwrap()) < 1.0),
            "every pixel has a depth"
        );
        found.push(npy(&folder.join(engine).join("lit.npy")).2);
    }
    let expected = [2, 2, 2, 0, 2, 2, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0];
    assert!(found.iter().all(|lit| *lit == expected), "{found:?}");
}

/// Beyond the guard band golden draws a shaded triangle and the machine's engines refuse it (docs/triangle_file.md).
#[test]
fn shaded_triangles_beyond_the_band_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for mode in ["phong", "fast-phong"] {
        let text = format!(
            "size 64 48\nmode {mode}\nview 0 0 1\nsun 0 0 1 0.9\nmaterial 0.1 0.8 0 1\n\
             T 0 0 0.5 1 1 1 0  300 0 0.5 1 1 1 0  0 40 0.5 1 1 1 0\nN 0 0 1 0 0 1 0 0 1\n"
        );
        std::fs::write(folder.join("a.tri"), text).unwrap();
        for engine in ["golden", "fast", "model", "rtl"] {
            let band = ["--adapt", "--set", "screen.guard_bits=8", "-q", "--out", "o"];
            let (code, error) = run(folder, &[&["raster", "a.tri", "--engine", engine], &band[..]].concat());
            match engine {
                "golden" => assert_eq!((code, error.as_str()), (Some(0), ""), "{mode}"),
                _ => assert!(
                    code == Some(2)
                        && error.contains("a.tri: triangle 0 (counted from 0), vertex 2 (from 1): x = 300"),
                    "{mode} {engine}: {error}"
                ),
            }
        }
    }
}
