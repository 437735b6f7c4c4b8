//! DITHER as a user meets it: pictures beside golden, a screen door, errors, explain, the scan-line engine.

use std::path::Path;
use std::process::{Command, Output};

fn edgewalk(folder: &Path, args: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_edgewalk");
    Command::new(program).args(args).current_dir(folder).output().expect("it runs")
}

fn text(output: &Output) -> String {
    [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat()
}

const SMALL: [&str; 4] = ["--set", "screen.width=160", "--set", "screen.height=120"];

/// The verdict passes with each number of bits, by every engine that ticks and by the one that does not.
#[test]
fn dithered_pictures_pass_beside_golden() {
    let folder = tempfile::tempdir().expect("a folder");
    for (bits, engine) in [("4", "fast"), ("5", "model"), ("6", "rtl"), ("7", "fast")] {
        let bits = format!("dither.bits={bits}");
        let args = [&["render", "torus", "--engine", engine, "--set", &bits][..], &SMALL].concat();
        let output = edgewalk(folder.path(), &args);
        let said = text(&output);
        assert!(output.status.success(), "{said}");
        assert!(said.contains("colours off the pattern of DITHER 0"), "{said}");
    }
}

/// The light's map has as many bits a colour as the channels: DITHER rounds the picture, not the light.
#[test]
fn panes_under_a_light_let_as_much_through_with_dither() {
    let folder = tempfile::tempdir().expect("a folder");
    let white = "1 1 1 0";
    let file = format!(
        "size 4 4\nshadow 4 0 0  1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\nL 0 0 0.2  1 0 0.2  0 1 0.2 0.5\n\
         T 0 0 0.5 {white}  8 0 0.5 {white}  0 8 0.5 {white}\n"
    );
    std::fs::write(folder.path().join("pane.tri"), file).expect("written");
    for engine in ["fast", "model", "rtl"] {
        let args =
            ["raster", "pane.tri", "--engine", engine, "--adapt", "--set", "dither.bits=5", "--out", engine];
        let output = edgewalk(folder.path(), &args);
        assert!(output.status.success(), "{}", text(&output));
        let (_, _, bytes) = crate::support::npy(&folder.path().join(engine).join("rgb.npy"));
        let rgb: Vec<f64> =
            bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("8"))).collect();
        // Beside the pane, whose texel is that of pixel (0, 0), white is white.
        assert!(rgb.len() == 48 && rgb[3..].iter().all(|v| *v == 1.0), "{engine}: {rgb:?}");
    }
    let args = ["render", "pane.tri", "--adapt", "--set", "dither.bits=5", "--out", "judged"];
    let output = edgewalk(folder.path(), &args);
    assert!(output.status.success(), "{}", text(&output));
}

#[test]
fn machines_that_clash_with_dither_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for (keys, wanted) in [
        (
            &["dither.bits=5", "blend.kind=constant"][..],
            &["blend.kind = constant", "read back", "try blend.kind = none"][..],
        ),
        (&["dither.screen_door=yes", "blend.kind=interpolated"], &["blend.kind", "none"]),
        (&["dither.bits=5", "formats.color_bits=5"], &["dither.bits = 5", "5 bits", "try dither.bits = 4"]),
        (&["dither.bits=4", "formats.color_bits=4"], &["dither.bits = 4", "try dither.bits = 0"]),
        (
            &["dither.screen_door=yes", "shadow.light=parallel", "shadow.own_pass=yes"],
            &["dither.screen_door = yes", "shadow.own_pass", "try dither.screen_door = no"],
        ),
        (&["dither.bits=3"], &["dither.bits = 3", "0, 4, 5, 6, 7", "nearest: 4"]),
        (&["dither.screen_door=maybe"], &["no, yes"]),
    ] {
        let set = keys.iter().flat_map(|key| ["--set", key]);
        let output = edgewalk(folder.path(), &["config", "print"].into_iter().chain(set).collect::<Vec<_>>());
        let said = text(&output);
        assert!(!output.status.success(), "{keys:?}: {said}");
        assert!(wanted.iter().all(|part| said.contains(part)), "{keys:?}: {said}");
    }
}

const SCENE: &str = "size 32 24\nblend 1\n\
    T 0 0 .5 1 1 1 .5  32 0 .5 1 1 1 .5  0 24 .5 1 1 1 .5\n\
    T 32 0 .5 0 1 0 .25  32 24 .5 0 1 0 .25  0 24 .5 0 1 0 .25\n";

/// k_t of 1/2 leaves out 8 of 16 pixels, of 1/4 4 of 16; the picture of the model and of the netlist is the same.
#[test]
fn a_screen_door_draws_a_share_of_the_pixels() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("door.tri"), SCENE).expect("written");
    let mut pictures = Vec::new();
    for engine in ["fast", "model", "rtl"] {
        let args =
            ["raster", "door.tri", "--engine", engine, "--set", "dither.screen_door=yes", "--out", engine];
        let output = edgewalk(folder.path(), &args);
        assert!(output.status.success(), "{}", text(&output));
        let file = std::fs::read(folder.path().join(engine).join("writes.npy")).expect("written");
        pictures.push(file[file.len() - 32 * 24 * 4..].chunks(4).map(|word| word[0]).collect::<Vec<u8>>());
    }
    assert!(pictures[0] == pictures[1] && pictures[1] == pictures[2]);
    let shown = |at: [usize; 2]| {
        let of = |place: usize| pictures[0][(at[1] + place / 4) * 32 + at[0] + place % 4];
        (0..16).map(of).map(u32::from).sum::<u32>()
    };
    assert_eq!([shown([0, 0]), shown([4, 8]), shown([28, 20])], [8, 8, 12]);
    let args = [
        "render",
        "door.tri",
        "--set",
        "dither.screen_door=yes",
        "--set",
        "dither.bits=6",
        "--out",
        "beside",
    ];
    let verdict = edgewalk(folder.path(), &args);
    assert!(verdict.status.success(), "{}", text(&verdict));
}

#[test]
fn explain_says_what_the_pattern_does() {
    let folder = tempfile::tempdir().expect("a folder");
    let args =
        [&["explain", "torus", "60", "60", "--triangles", "400", "--set", "dither.bits=5"][..], &SMALL]
            .concat();
    let output = edgewalk(folder.path(), &args);
    let said = text(&output);
    assert!(output.status.success(), "{said}");
    let line = said.lines().find(|line| line.starts_with("DITHER:")).unwrap_or_else(|| panic!("{said}"));
    let stored = said.lines().find(|line| line.starts_with("the machine stores")).expect("stored");
    let after = line.split(" -> ").nth(1).and_then(|rest| rest.split(" of 31").next()).expect("steps");
    assert!(
        line.contains("pattern 0 of 16") && stored.contains(&format!("rgb {after},")),
        "{line}\n{stored}"
    );
}

/// Golden by scan lines draws golden's depths, colours and ids; what it cannot draw it refuses.
#[test]
fn the_scan_line_engine_draws_what_golden_draws() {
    let folder = tempfile::tempdir().expect("a folder");
    let made = edgewalk(
        folder.path(),
        &["triangles", "torus", "--out", "t.tri", SMALL[0], SMALL[1], SMALL[2], SMALL[3]],
    );
    assert!(made.status.success(), "{}", text(&made));
    for engine in ["golden", "scanline"] {
        let output = edgewalk(folder.path(), &["raster", "t.tri", "--engine", engine, "--out", engine]);
        assert!(output.status.success(), "{}", text(&output));
    }
    let mut checked = 0;
    for file in ["coverage.npy", "id.npy", "z.npy", "rgb.npy", "image.png"] {
        let [one, other] = ["golden", "scanline"]
            .map(|engine| std::fs::read(folder.path().join(engine).join(file)).expect(file));
        assert!(one == other, "{file}");
        checked += 1;
    }
    assert_eq!(checked, 5);
    for (text_of, wanted) in [("depth off\n", "depth function"), ("blend 1\n", "blends")] {
        std::fs::write(folder.path().join("b.tri"), SCENE.replace("blend 1\n", text_of)).expect("written");
        let output = edgewalk(folder.path(), &["raster", "b.tri", "--engine", "scanline", "--out", "b"]);
        let said = text(&output);
        assert!(
            !output.status.success() && said.contains(wanted) && said.contains("--engine golden"),
            "{said}"
        );
    }
}
