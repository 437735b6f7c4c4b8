//! Triangles beyond the guard band, as real programs send them: left out or cut by the host, counted, and drawn right.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{SCREEN, edgewalk, ended, npy, run};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::Value;
use std::path::Path;

const WIDTH: usize = 64;
const HEIGHT: usize = 48;

/// The guard band of these tests ends at ±255 pixels.
const BAND: [&str; 2] = ["--set", "screen.guard_bits=8"];

/// Two edges meet in a sub-pixel at most, each rounded on its own.
const NEAR: f64 = 1.5 / 256.0;

type Corners = [[f64; 2]; 3];

/// Half of them reach far out, on one side or on all.
fn corners(count: usize, seed: u64) -> Vec<Corners> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut corner = |reach: f64| {
        let at = |random: &mut Pcg64Mcg, side: usize| random.random_range(-reach..side as f64 + reach);
        [at(&mut random, WIDTH), at(&mut random, HEIGHT)]
    };
    let reaches = [2.0, 300.0, 5000.0, 9e5];
    (0..count).map(|i| [reaches[i % 4], reaches[i / 4 % 4], reaches[i / 16 % 4]].map(&mut corner)).collect()
}

fn file(corners: &[Corners]) -> String {
    let triangle = |(number, corners): (usize, &Corners)| {
        let z = |corner: usize| (number * 7 + corner * 3) as f64 % 20.0 / 19.0;
        let vertex = |i: usize| {
            format!(" {} {} {} {} 0.5 {} 0", corners[i][0], corners[i][1], z(i), z(i + 1), z(i + 2))
        };
        format!("T{}{}{}\n", vertex(0), vertex(1), vertex(2))
    };
    format!("size {WIDTH} {HEIGHT}\ndepth off\n")
        + &corners.iter().enumerate().map(triangle).collect::<String>()
}

/// Draws, and gives the report.
fn raster(folder: &Path, name: &str, engine: &str) -> Value {
    let out = format!("{name}_{engine}");
    let output = edgewalk(folder, &["raster", name, "--engine", engine, "--json", "--out", &out])
        .args(BAND)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn words<const N: usize, T>(folder: &Path, name: &str, word: fn([u8; N]) -> T) -> Vec<T> {
    let (_, shape, bytes) = npy(&folder.join(name));
    assert_eq!(shape[..2], [HEIGHT, WIDTH]);
    bytes.chunks_exact(N).map(|bytes| word(bytes.try_into().unwrap())).collect()
}

/// Pixels from the centre of pixel `place` to the nearest edge.
fn to_an_edge(all: &[Corners], place: usize) -> f64 {
    let at = [(place % WIDTH) as f64 + 0.5, (place / WIDTH) as f64 + 0.5];
    let distance = |[a, b]: [[f64; 2]; 2]| {
        let along = [b[0] - a[0], b[1] - a[1]];
        (along[0] * (at[1] - a[1]) - along[1] * (at[0] - a[0])).abs() / along[0].hypot(along[1])
    };
    let edges = all.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    edges.map(distance).fold(f64::INFINITY, f64::min)
}

/// Every triangle alone, so that a wrong pixel cannot hide below another.
#[test]
fn pieces_cover_what_the_triangle_covers() {
    let folder = tempfile::tempdir().unwrap();
    let (mut pixels, mut near, mut cut) = (0, 0, 0);
    for (number, corners) in corners(64, 1).into_iter().enumerate() {
        let name = format!("{number}.tri");
        std::fs::write(folder.path().join(&name), file(&[corners])).unwrap();
        let drawn = |engine| {
            let (status, _) =
                run(folder.path(), &["raster", &name, "--engine", engine, "--out", engine, BAND[0], BAND[1]]);
            // 2 where the triangle has no pixel.
            assert!(matches!(status, Some(0 | 2)));
            let of = |array: &str| format!("{engine}/{array}");
            let report: Value =
                serde_json::from_slice(&std::fs::read(folder.path().join(of("report.json"))).unwrap())
                    .unwrap();
            let host = report["host"].clone();
            (
                words(folder.path(), &of("coverage.npy"), u32::from_le_bytes),
                words(folder.path(), &of("id.npy"), i32::from_le_bytes),
                host,
            )
        };
        let (golden, fast) = (drawn("golden"), drawn("fast"));
        assert_eq!(golden.2["clipped"], 0, "golden needs no band");
        cut += fast.2["clipped"].as_u64().unwrap();
        for place in 0..WIDTH * HEIGHT {
            if to_an_edge(&[corners], place) < NEAR {
                near += 1;
                continue;
            }
            assert_eq!(
                (golden.0[place], golden.1[place]),
                (fast.0[place], fast.1[place]),
                "{number}: pixel {place}"
            );
            pixels += u64::from(golden.0[place]);
        }
    }
    println!("{cut} cut, {pixels} covered pixels compared, {near} left out as near an edge");
    assert!(cut > 20 && pixels > 20_000 && near < 200);
}

#[test]
fn engines_draw_the_same_pieces_and_golden_agrees_with_them() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("far.tri"), file(&corners(64, 2))).unwrap();
    let reports = ["fast", "model", "rtl"].map(|engine| raster(folder.path(), "far.tri", engine));
    for report in &reports {
        assert_eq!(report["host"], reports[0]["host"]);
        let count = |key: &str| report["host"][key].as_u64().unwrap();
        assert!(
            count("off_screen") > 3 && count("clipped") > 20 && count("pieces") > count("clipped"),
            "{report}"
        );
        assert_eq!(count("clamped_depths"), 0);
        // What is cut is still one triangle of the file.
        assert_eq!(report["triangles"], 64);
    }
    for array in ["coverage.npy", "writes.npy", "id.npy", "z.npy", "rgb.npy"] {
        let bytes = ["fast", "model", "rtl"].map(|engine| {
            std::fs::read(folder.path().join(format!("far.tri_{engine}")).join(array)).unwrap()
        });
        assert!(bytes[0] == bytes[1] && bytes[1] == bytes[2], "{array}");
    }
    // The picture against golden's of the pieces: exact coverage, errors within the bound, or the exit code is 1.
    let render = ["render", "far.tri", "--out", "page"];
    let output = edgewalk(folder.path(), &[&render[..], &SCREEN, &BAND].concat()).output().unwrap();
    let (status, said) = ended(&output);
    assert_eq!(status, Some(0), "{said}");
    let report = std::fs::read_to_string(folder.path().join("page/report.json")).unwrap();
    let report: Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["host"], reports[0]["host"]);
    assert!(report["comparison"]["compared"].as_u64().unwrap() > 1000);
}

#[test]
fn depths_beyond_by_rounding_are_clamped_and_counted() {
    let folder = tempfile::tempdir().unwrap();
    let text = |z: &str| format!("size 8 8\nT 0 0 {z} 1 1 1 0  8 0 0.5 1 1 1 0  0 8 -0.000001 1 1 1 0\n");
    for (name, z) in [("over.tri", "1.0000001"), ("one.tri", "1")] {
        std::fs::write(folder.path().join(name), text(z)).unwrap();
    }
    for engine in ["golden", "fast", "model"] {
        let [over, one] = ["over.tri", "one.tri"].map(|name| raster(folder.path(), name, engine));
        assert_eq!(
            (&over["host"]["clamped_depths"], &one["host"]["clamped_depths"]),
            (&2.into(), &1.into()),
            "{engine}"
        );
        let [over, one] = ["over.tri", "one.tri"]
            .map(|name| std::fs::read(folder.path().join(format!("{name}_{engine}/z.npy"))).unwrap());
        assert!(over == one, "{engine}");
    }
    let output = edgewalk(folder.path(), &["raster", "over.tri", "--out", "said"]).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("host: 2 depths beyond 0 or 1 by rounding, clamped"), "{said}");
    std::fs::write(folder.path().join("far.tri"), text("1.0001")).unwrap();
    let (status, said) = run(folder.path(), &["raster", "far.tri", "--out", "refused"]);
    assert_eq!(status, Some(2));
    assert!(said.contains("far.tri:2: T vertex 1 z"), "{said}");
    assert!(!folder.path().join("refused").exists());
}

/// A polygon that the host cuts and a triangle beyond the guard band are one each: for `--triangles`, and by name.
#[test]
fn parts_of_one_count_as_one() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let near = "T 2 2 0.5 1 0 0 0  30 2 0.5 1 0 0 0  2 30 0.5 1 0 0 0\n";
    let first = [
        ("polygon", "P 4  2 2 0.9 1 0 0 0  40 2 0.9 1 0 0 0  50 20 0.9 1 0 0 0  2 40 0.9 1 0 0 0\n"),
        ("beyond", "T -300 -20 0.9 1 0 0 0  70 10 0.9 1 0 0 0  40 400 0.9 1 0 0 0\n"),
    ];
    for (name, item) in first {
        let input = format!("{name}.tri");
        std::fs::write(at(&input), format!("size {WIDTH} {HEIGHT}\n{item}{near}")).unwrap();
        let explained = |count: &str| {
            let words = ["explain", &input, "5", "5", "--json", "--triangles", count];
            let output = edgewalk(folder.path(), &words).args(BAND).output().unwrap();
            serde_json::from_slice::<Value>(&output.stdout).unwrap()
        };
        let (both, one) = (explained("2"), explained("1"));
        assert_eq!(
            [&both["id"], &both["stored"]["id"], &one["id"]].map(Value::as_i64),
            [Some(1), Some(1), Some(0)]
        );
        let over: Vec<_> =
            both["fragments"].as_array().unwrap().iter().map(|over| over["id"].clone()).collect();
        assert_eq!(over, [0, 1], "{name}");
        let shown = ["replay", &input, "--triangles", "1", "--out", "shown.json", "--cycles", "1", "--json"];
        let output = edgewalk(folder.path(), &shown).args(BAND).output().unwrap();
        let replay: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(replay["triangles"], 1, "{replay}");
        // All of the first are sent: as many tokens as of a file with nothing else.
        std::fs::write(at("alone.tri"), format!("size {WIDTH} {HEIGHT}\n{item}")).unwrap();
        let tokens = |words: &[&str], suite: &str| {
            let words = [&["vectors", "--unit", "setup", "--no-csv", "-q", "--out", "v"], words].concat();
            let output = edgewalk(folder.path(), &words).args(BAND).output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            let manifest =
                std::fs::read(at("v").join(format!("{suite}_setup")).join("manifest.json")).unwrap();
            serde_json::from_slice::<Value>(&manifest).unwrap()["suite"]["triangles"].as_u64().unwrap()
        };
        let alone = tokens(&["alone.tri"], "alone");
        assert!(alone > 1, "{name} is sent in parts");
        assert_eq!(tokens(&[&input, "--triangles", "1"], name), alone, "{name}");
        assert_eq!(tokens(&[&input, "--triangles", "2"], name), alone + 1, "{name}");
    }
}

/// The machine's picture of cut triangles and golden's of whole ones are both right, and another is not.
#[test]
fn either_picture_of_a_cut_triangle_is_right() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let plane = "size 100 3\nT -99999.73927017405 2.024609490776312 0.7 0.1 0.569 0.044 0.3 \
        9000.307914715828 1.5 0.1 0.54 0.9 0.3 0.3  -99999.41446926375 0 0 0 0 0.5 0.3\n";
    std::fs::write(at.join("plane.tri"), plane).unwrap();
    let judged = |picture: &str| {
        let output = edgewalk(at, &["judge", "plane.tri", picture, "--json"]).output().unwrap();
        let code = ended(&output).0;
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        let causes = told["causes"].as_array().unwrap();
        let piece = causes.iter().find(|count| count["cause"] == "piece").unwrap();
        (code, told["wrong"].as_u64().unwrap(), piece["pixels"].as_u64().unwrap())
    };
    for (engine, cut) in [("golden", false), ("fast", true)] {
        let (code, error) = run(at, &["raster", "plane.tri", "--engine", engine, "--out", engine]);
        assert_eq!(code, Some(0), "{error}");
        let (code, wrong, piece) = judged(engine);
        println!("{engine}: {piece} pixels of pieces");
        assert_eq!((code, wrong, piece > 90), (Some(0), 0, cut), "{engine}");
    }
    // A depth that is neither golden's nor that of the pieces is wrong.
    let file = at.join("fast/z.npy");
    let mut bytes = std::fs::read(&file).unwrap();
    // The one in the middle of the screen.
    let place = bytes.len() - 8 * 150;
    let depth = f64::from_le_bytes(bytes[place..place + 8].try_into().unwrap());
    bytes[place..place + 8].copy_from_slice(&(depth / 2.0).to_le_bytes());
    std::fs::write(&file, bytes).unwrap();
    let (code, wrong, _) = judged("fast");
    assert_eq!((code, wrong), (Some(1), 1));
}
