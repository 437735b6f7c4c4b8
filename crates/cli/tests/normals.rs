//! Triangle files with normals through the program: the example of `docs/triangle_file.md` and faults in it.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod support;

use support::{edgewalk, npy, run};

/// The example of the chapter on normals.
fn example() -> String {
    let page = include_str!("../../../docs/triangle_file.md");
    let chapter = page.split_once("\n## Normals\n").unwrap().1;
    chapter.split("```").nth(1).unwrap().trim_start().to_owned()
}

#[test]
fn the_example_of_the_reference_is_the_equation() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), example()).unwrap();
    let (code, error) = run(folder.path(), &["raster", "a.tri", "--engine", "golden", "--out", "g"]);
    assert_eq!(code, Some(0), "{error}");
    let (kind, shape, bytes) = npy(&folder.path().join("g/rgb.npy"));
    assert_eq!((&*kind, &shape[..]), ("<f8", &[32, 32, 3][..]));
    let values: Vec<f64> = bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect();
    let unit = |[x, y, z]: [f64; 3]| {
        let length = (x * x + y * y + z * z).sqrt();
        [x / length, y / length, z / length]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let corners = [[-0.3, -0.3, 0.9055], [0.5, -0.3, 0.8124], [-0.3, 0.5, 0.8124]].map(unit);
    let mut checked = 0;
    for (x, y) in [(1, 1), (5, 9), (15, 14), (28, 1), (2, 27)] {
        let (b, c) = ((f64::from(x) - 0.5) / 30.0, (f64::from(y) - 0.5) / 30.0);
        let n =
            unit([0, 1, 2].map(|k| corners[0][k] * (1.0 - b - c) + corners[1][k] * b + corners[2][k] * c));
        let mut wanted = [0.0, 0.02, 0.1];
        for (l, i) in [([0.3, 0.3, 1.0], 0.7), ([-1.0, 0.0, 0.5], 0.2)] {
            let l = unit(l);
            let (d, h) = (dot(n, l), dot(n, unit([l[0], l[1], l[2] + 1.0])));
            if d > 0.0 {
                let highlight = 0.5 * i * (2.0 * h * h - 1.0f64).max(0.0).powf(40.0);
                for (w, c) in wanted.iter_mut().zip([0.0, 0.2, 1.0]) {
                    *w += c * 0.7 * i * d + highlight;
                }
            }
        }
        for (channel, wanted) in wanted.into_iter().enumerate() {
            let found = values[(y as usize * 32 + x as usize) * 3 + channel];
            assert!((found - wanted).abs() < 1e-12, "pixel {x} {y}, {channel}: {found} {wanted}");
            checked += 1;
        }
    }
    assert_eq!(checked, 15);
}

#[test]
fn faults_end_with_file_line_key_and_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&str, &str, &[&str]); 6] = [
        ("mode phong", "mode phnog", &["bad.tri:2: mode: `phnog`", "did you mean `phong`?"]),
        ("view 0 0 1\n", "", &["bad.tri:6: view", "missing"]),
        (
            "\nN -0.3 -0.3 0.9055",
            "\nN -0.3 -0.3 0.5",
            &["bad.tri:8: N vertex 1: `-0.3 -0.3 0.5`", "the nearest is"],
        ),
        ("sun -1 0 0.5 0.2", "sun -1 0 0.5", &["bad.tri:5: sun: `3 given`", "4 values"]),
        ("material 0.1", "material 1.1", &["bad.tri:6: material ka: `1.1`", "from 0 to 1"]),
        ("mode phong", "mode flat", &["bad.tri:3:", "`view`", "only with `mode phong`"]),
    ];
    for (from, to, words) in cases {
        let text = example();
        assert!(text.contains(from), "{from:?}");
        std::fs::write(folder.path().join("bad.tri"), text.replace(from, to)).unwrap();
        for engine in ["golden", "fast"] {
            let (code, error) = run(folder.path(), &["raster", "bad.tri", "--engine", engine, "--out", "o"]);
            assert_eq!(code, Some(2), "{to}: {error}");
            for word in words {
                assert!(error.contains(word), "{to:?}: {word:?} is not in {error:?}");
            }
        }
    }
    assert!(!folder.path().join("o").exists());
}

#[test]
fn a_file_with_normals_may_be_a_pipe() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.tri");
    std::fs::write(&file, example()).unwrap();
    let mut command = edgewalk(folder.path(), &["raster", "/dev/stdin", "--engine", "golden", "--out", "p"]);
    let output = command.stdin(std::fs::File::open(&file).unwrap()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
