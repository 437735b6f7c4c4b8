//! `edgewalk raster` with a light's map: the machine beside golden, and what it cannot do.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{HALF, edgewalk, npy, run};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fmt::Write as _;
use std::path::Path;

/// lit, and the colours.
fn raster(folder: &Path, engine: &str, size: u32) -> (Vec<u8>, Vec<f64>) {
    let size = format!("shadow.size={size}");
    let settings = ["shadow.light=parallel", "shadow.gate=scale", &size];
    let mut command = edgewalk(folder, &["raster", "a.tri", "--engine", engine, "--out", engine]);
    settings.iter().for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let file = |name: &str| npy(&folder.join(engine).join(name)).2;
    let rgb =
        file("rgb.npy").chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect();
    (file("lit.npy"), rgb)
}

#[test]
fn a_square_darkens_the_half_under_it_in_every_engine() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), HALF).unwrap();
    let golden = raster(folder.path(), "golden", 4);
    assert_eq!(golden.0, [1, 1, 2, 2].repeat(4));
    for engine in ["model", "fast", "rtl"] {
        let drawn = raster(folder.path(), engine, 4);
        assert_eq!(drawn.0, golden.0, "{engine}");
        let worst = drawn.1.iter().zip(&golden.1).map(|(a, b)| 255.0 * (a - b).abs()).fold(0.0, f64::max);
        assert!(worst <= 1.82, "{engine}: {worst} LSB");
    }
}

/// Tilted triangles under a slanting parallel light, each also in its map: the machine's decisions are golden's but for a few
/// beside the borders of texels and where a surface begins to hide itself, and the colours of the others lie within their bound.
#[test]
fn random_scenes_are_lit_as_golden_lights_them() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let (mut pixels, mut differ, mut dark) = (0, 0, 0);
    for _ in 0..10 {
        // Texel x = 0.7 column + 12 depth, y = 0.6 line + 5 depth; depth from the light 0.2 + 0.5 depth.
        let matrix = "0.7 0 12 1   0 0.6 5 2   0 0 0.5 0.2   0 0 0 1";
        let mut text = format!("size 80 60\nshadow 64 0.01 0.3   {matrix}\n");
        for _ in 0..25 {
            let [x, y, z] = [80.0, 60.0, 1.0].map(|most| random.random_range(0.0..most));
            let corners: [[f64; 3]; 3] = std::array::from_fn(|_| {
                let mut near = |from: f64, by: f64| from + random.random_range(-by..by);
                // On the grid of sub-pixels, so that both see the same vertex.
                let [x, y] = [near(x, 30.0), near(y, 30.0)].map(|c| (c * 256.0).round() / 256.0);
                [x, y, near(z, 0.05).clamp(0.0, 1.0)]
            });
            let light =
                corners.map(|[x, y, z]| [0.7 * x + 12.0 * z + 1.0, 0.6 * y + 5.0 * z + 2.0, 0.2 + 0.5 * z]);
            let _ = write!(text, "T");
            corners.iter().for_each(|[x, y, z]| _ = write!(text, "  {x} {y} {z} 0.9 0.5 1 0"));
            let _ = write!(text, "\nL");
            light.iter().for_each(|[x, y, z]| _ = write!(text, "  {x} {y} {z}"));
            let _ = writeln!(text);
        }
        std::fs::write(folder.path().join("a.tri"), text).unwrap();
        let (golden, drawn) = (raster(folder.path(), "golden", 64), raster(folder.path(), "model", 64));
        for (i, (a, b)) in golden.0.iter().zip(&drawn.0).enumerate() {
            assert_eq!(*a == 0, *b == 0, "pixel {i}");
            pixels += i32::from(*a > 0);
            dark += i32::from(*a == 1);
            differ += i32::from(a != b);
            let off = |c: usize| 255.0 * (golden.1[3 * i + c] - drawn.1[3 * i + c]).abs();
            assert!(a != b || (0..3).all(|c| off(c) <= 1.82), "pixel {i}");
        }
    }
    println!("{pixels} pixels, {dark} in shadow, {differ} decided otherwise");
    assert!(pixels > 20_000 && dark > 2_000 && differ * 100 < pixels);
}

/// A slanting light over triangles that lie anyhow, as a file; `bias` in depths of the map.
fn slanting(random: &mut Pcg64Mcg, bias: f64) -> String {
    let matrix = "0.7 0 12 1   0 0.6 5 2   0 0 0.5 0.2   0 0 0 1";
    let mut text = format!("size 80 60\nshadow 64 {bias} 0.3   {matrix}\n");
    for _ in 0..25 {
        let [x, y, z] = [80.0, 60.0, 1.0].map(|most| random.random_range(0.0..most));
        let corners: [[f64; 3]; 3] = std::array::from_fn(|_| {
            let mut near = |from: f64, by: f64| from + random.random_range(-by..by);
            [near(x, 30.0), near(y, 30.0), near(z, 0.05).clamp(0.0, 1.0)]
        });
        let _ = write!(text, "T");
        corners.iter().for_each(|[x, y, z]| _ = write!(text, "  {x} {y} {z} 0.9 0.5 1 0"));
        let _ = write!(text, "\nL");
        let light =
            corners.map(|[x, y, z]| [0.7 * x + 12.0 * z + 1.0, 0.6 * y + 5.0 * z + 2.0, 0.2 + 0.5 * z]);
        light.iter().for_each(|[x, y, z]| _ = write!(text, "  {x} {y} {z}"));
        let _ = writeln!(text);
    }
    text
}

/// `render` of such files: every decision of the machine is one that its texel and its depth within their bounds allow, where golden
/// decides otherwise too; and colours lie within the gate's bound. The map's own pass is counted.
#[test]
fn every_decision_is_explained() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(2);
    let (mut pixels, mut dark, mut differ) = (0, 0, 0);
    for i in 0..8 {
        std::fs::write(folder.path().join("a.tri"), slanting(&mut random, [0.01, 0.0][i % 2])).unwrap();
        let sizes = ["shadow.light=parallel", "shadow.gate=scale", "shadow.size=64"];
        let screen = ["screen.width=80", "screen.height=60", "shadow.light_fraction=16"];
        let mut command = edgewalk(folder.path(), &["render", "a.tri", "--json", "--engine", "model"]);
        sizes.iter().chain(&screen).for_each(|setting| _ = command.args(["--set", setting]));
        let output = command.output().unwrap();
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(output.status.success(), "{report:#}");
        let lit = &report["comparison"]["lit"];
        let number = |key: &str| lit[key].as_u64().unwrap();
        assert_eq!(number("unexplained"), 0);
        assert!(lit["texel_bound"].as_f64().unwrap() < 0.1, "{lit}");
        assert!(report["cycles"]["maps"][0].as_u64().unwrap() > 1000, "{}", report["cycles"]);
        (pixels, dark, differ) =
            (pixels + number("pixels"), dark + number("shadow"), differ + number("differ"));
    }
    println!("{pixels} pixels, {dark} in shadow, {differ} decided otherwise than golden, 0 unexplained");
    assert!(pixels > 15_000 && dark > 2_000 && differ > 100, "{pixels} {dark} {differ}");
}

#[test]
fn what_the_machine_cannot_do_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let parallel = ["--set", "shadow.light=parallel"];
    let fitting = ["--set", "shadow.light=parallel", "--set", "shadow.size=4", "--set", "shadow.gate=scale"];
    let (four, tilted) = (&["--set", "shadow.light=parallel", "--set", "shadow.size=4"], "0 0 0.1 1\nL");
    let lens = ["--set", "shadow.light=perspective", "--set", "shadow.size=4", "--set", "shadow.gate=scale"];
    let also = |setting: &'static str| [&lens[..], &["--set", setting]].concat();
    let [few, many, narrow] =
        ["shadow.light_bits=3", "shadow.light_bits=29", "shadow.light_bits=12"].map(also);
    let [mixed, own, unknown] =
        ["blend.kind=interpolated", "channels.extra=1", "shadow.project=parallel"].map(also);
    let rows = "1 0 0 0   0 1 0 0   0 0 1 0   0 0 0 1";
    let cases: [(String, &[&str], &[&str]); 18] = [
        (HALF.to_owned(), &[], &["no SHADOW", "shadow.light=parallel", "shadow.size=4"]),
        (HALF.to_owned(), &parallel, &["shadow 4", "512 x 512 texels", "shadow.size=4"]),
        (HALF.to_owned(), four, &["AMBIENT = 0.25", "shadow.gate=scale"]),
        (HALF.replacen("0 0 0 1\nL", tilted, 1), &fitting, &["m30 m31 m32 m33 = 0 0 0.1 1", "parallel"]),
        (HALF.replacen("0 0 0 1\nL", "0 0 0 0\nL", 1), &fitting, &["m30 m31 m32 m33 = 0 0 0 0"]),
        (
            HALF.replacen("   1 0 0 0", "   9 0 0 0", 1),
            &fitting,
            &[
                "a.tri: triangle 0 (counted from 0), vertex 2 (from 1)",
                "lx = 72",
                "-15 to 15 under light 1; give",
            ],
        ),
        (HALF.replacen("L  0 0", "L  -9000 0", 1), &fitting, &["triangle 0 of the map", "guard"]),
        (
            HALF.replacen("0 0 0 1\nL", "0 0 0 0\nL", 1),
            &lens,
            &["m30 m31 m32 m33 = 0 0 0 0", "infinity", "0 0 0 1"],
        ),
        (HALF.replacen(rows, &rows.replace('1', "1e300"), 1), &lens, &["triangle 0", "1e-200 to 1e200"]),
        (HALF.replacen(rows, &rows.replace('1', "1e-300"), 1), &lens, &["triangle 0", "1e-200 to 1e200"]),
        (HALF.replacen("shadow 4", "shadow 8", 1), &lens, &["shadow 8", "4 x 4 texels", "shadow.size=8"]),
        (HALF.to_owned(), &few, &["shadow.light_bits = 3", "4 to 28", "nearest: 4"]),
        (HALF.to_owned(), &many, &["shadow.light_bits = 29", "4 to 28", "nearest: 28"]),
        (HALF.to_owned(), &narrow, &["shadow.light_bits = 12", "16 bits", "try shadow.light_bits = 16"]),
        (HALF.to_owned(), &mixed, &["blend.kind = interpolated", "9 channels", "try blend.kind = constant"]),
        (HALF.to_owned(), &own, &["channels.extra = 1", "9 channels", "try channels.extra = 0"]),
        (HALF.to_owned(), &unknown, &["shadow.project = parallel", "(pipelined, serial)"]),
        (
            HALF.to_owned(),
            &["--set", "shadow.size=5000"],
            &["shadow.size = 5000", "1 to 4096", "nearest: 4096"],
        ),
    ];
    for (text, settings, words) in cases {
        std::fs::write(folder.path().join("a.tri"), &text).unwrap();
        let (code, error) =
            run(folder.path(), &[&["raster", "a.tri", "--out", "out"][..], settings].concat());
        assert_eq!(code, Some(2), "{settings:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{settings:?}: {error} lacks {word}");
        }
    }
}

/// What `explain` says of a pixel under a light: exact place, what is divided, texel, depth, the map's word and the answer.
#[test]
fn explain_shows_what_the_light_makes_of_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), HALF).unwrap();
    let fitting = ["shadow.size=4", "shadow.gate=scale", "screen.width=4", "screen.height=4"];
    for light in ["shadow.light=perspective", "shadow.light=parallel"] {
        for (x, words) in [
            (
                "0",
                [
                    "texel (0.500000, 0.500000), depth 32701.965000 LSB",
                    "texel (0, 0), depth 32702; the map has 16384: in shadow",
                ],
            ),
            (
                "3",
                [
                    "texel (3.500000, 0.500000), depth 32701.965000 LSB",
                    "texel (3, 0), depth 32702; the map has 65535: lit",
                ],
            ),
        ] {
            let mut command = edgewalk(folder.path(), &["explain", "a.tri", x, "0"]);
            fitting.iter().chain([&light]).for_each(|setting| _ = command.args(["--set", setting]));
            let output = command.output().unwrap();
            let page = String::from_utf8_lossy(&output.stdout).into_owned();
            for word in words {
                assert!(
                    page.contains(word),
                    "{light}: {page} lacks {word}; {}",
                    String::from_utf8_lossy(&output.stderr)
                );
            }
            assert_eq!(page.contains("  lw "), light.ends_with("perspective"), "{page}");
        }
    }
    // Of a scene each light, and of one that takes six maps the reason why there is none.
    let amid = "[[object]]\nbuiltin = \"room\"\n[[light]]\nkind = \"positional\"\nposition = [0, 1, 0]\n";
    std::fs::write(folder.path().join("amid.toml"), amid).unwrap();
    let lens = ["--set", "shadow.light=perspective", "--set", "blend.kind=constant"];
    for (scene, word) in [("room", "light 2's map: texel ("), ("amid.toml", "no map on the machine: ")] {
        let output = edgewalk(folder.path(), &["explain", scene, "320", "240"]).args(lens).output().unwrap();
        let page = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(page.contains(word), "{page} lacks {word}; {}", String::from_utf8_lossy(&output.stderr));
    }
}
