//! Triangle files with normals through the program: the example of `docs/triangle_file.md` and faults in it.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support;
use crate::support::{edgewalk, npy, run};

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
        let machine = ["--set", "shade.kind=phong", "--set", "shade.lights=2"];
        for (engine, settings) in [("golden", &[][..]), ("fast", &machine)] {
            let raster = ["raster", "bad.tri", "--engine", engine, "--out", "o"];
            let (code, error) = run(folder.path(), &[&raster, settings].concat());
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

/// An array of f64, as numbers.
fn numbers(folder: &std::path::Path, file: &str) -> Vec<f64> {
    let (kind, _, bytes) = npy(&folder.join(file));
    assert_eq!(kind, "<f8");
    bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
}

const SHADES: [&str; 4] = ["--set", "shade.kind=fast-phong", "--set", "shade.gloss_bits=8"];

#[test]
fn a_file_with_normals_goes_through_the_machine() {
    let folder = tempfile::tempdir().unwrap();
    let text = example().replace("mode phong", "mode fast-phong");
    let exact = text.replace("mode fast-phong", "mode phong");
    // A second surface, coloured by the vertices where the machine multiplies.
    let more = "material 0.2 0.8 0 1\nT 20 31 0.4 1 0.5 0 0  31 31 0.4 1 0.5 0 0  31 12 0.4 1 0.5 0 0\nN 0 0 1 0 0 1 0.6 0 0.8\n";
    std::fs::write(folder.path().join("a.tri"), text.clone() + more).unwrap();
    std::fs::write(folder.path().join("c.tri"), exact + more).unwrap();
    std::fs::write(folder.path().join("b.tri"), text + &more.replace("31 12 0.4 1", "31 12 0.4 0.2"))
        .unwrap();
    let mut checked = 0;
    for (file, more) in [
        ("a.tri", &["--set", "shade.lights=2"][..]),
        ("a.tri", &["--set", "shade.lights=2", "--set", "term.walk=memory", "--set", "shade.table_bits=10"]),
        ("b.tri", &["--set", "shade.lights=2", "--set", "shade.colour=multiply"]),
        ("c.tri", &["--set", "shade.lights=2", "--set", "shade.kind=phong"]),
    ] {
        let golden = ["raster", file, "--engine", "golden", "--out", "g"];
        assert_eq!(run(folder.path(), &golden).0, Some(0));
        for engine in ["fast", "model"] {
            let arguments =
                [&["raster", file, "--engine", engine, "--out", engine], &SHADES[..], more].concat();
            let (code, error) = run(folder.path(), &arguments);
            assert_eq!(code, Some(0), "{error}");
        }
        let read = |engine: &str, array: &str| std::fs::read(folder.path().join(engine).join(array)).unwrap();
        for array in ["coverage.npy", "writes.npy", "id.npy"] {
            assert!(
                read("g", array) == read("fast", array) && read("fast", array) == read("model", array),
                "{array}"
            );
        }
        let [g, fast, model] =
            ["g", "fast", "model"].map(|engine| numbers(&folder.path().join(engine), "rgb.npy"));
        assert!(fast == model, "the same machine");
        let worst = g.iter().zip(&fast).map(|(a, b)| (a - b).abs() * 255.0).fold(0.0, f64::max);
        println!("{file} {more:?}: {worst:.3} LSB from golden");
        // Two lights: twice 2.1 at 9 bits; that the bound holds is said by render below.
        assert!(worst > 0.2 && worst < 4.5, "{worst}");
        checked += g.len();
    }
    assert_eq!(checked, 4 * 32 * 32 * 3);
}

#[test]
fn render_holds_the_bound_and_says_how_near_it_came() {
    let folder = tempfile::tempdir().unwrap();
    let small = ["--set", "screen.width=160", "--set", "screen.height=120"];
    for (scene, more, engine) in [
        ("sphere", &[][..], "fast"),
        ("sphere", &["--set", "shade.colour=multiply"], "model"),
        ("room", &["--set", "shade.lights=2"], "fast"),
        ("sphere", &["--set", "shade.kind=phong"], "fast"),
    ] {
        let shading = if more.contains(&"shade.kind=phong") { "phong" } else { "fast-phong" };
        let render = ["render", scene, "--shading", shading, "--engine", engine, "--json", "--out", "r"];
        let output =
            edgewalk(folder.path(), &[&render, &SHADES[..], &small, more].concat()).output().unwrap();
        assert!(output.status.success(), "{scene}: {}", String::from_utf8_lossy(&output.stderr));
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let shaded = &report["comparison"]["shaded"];
        let number = |key: &str| shaded[key].as_f64().unwrap();
        println!("{scene}: {shaded}");
        assert!(number("pixels") > 3000.0 && number("beyond") == 0.0, "{shaded}");
        assert!(
            number("error") > 0.3 && number("error") <= number("bound") && number("bound") < 9.0,
            "{shaded}"
        );
        assert!(number("of_bound") > 0.2 && number("of_bound") <= 1.0, "{shaded}");
        assert!(report["cycles"]["by_cause"]["term"].as_u64().unwrap() > 0);
        assert!(folder.path().join("r/image.png").exists() && folder.path().join("r/golden.png").exists());
    }
}

#[test]
fn a_machine_and_an_input_that_do_not_fit_say_so() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), example().replace("mode phong", "mode fast-phong")).unwrap();
    std::fs::write(folder.path().join("p.tri"), example()).unwrap();
    std::fs::write(folder.path().join("t.tri"), support::TRIANGLE).unwrap();
    let shades = ["--set", "shade.kind=fast-phong"];
    let cases: [(&[&str], &[&str]); 6] = [
        (
            &["raster", "a.tri", "--out", "o"],
            &["mode fast-phong", "--set shade.kind=fast-phong", "--engine golden"],
        ),
        (&["raster", "p.tri", "--out", "o"], &["mode phong", "shade.kind=phong", "--engine golden"]),
        (&[&["raster", "a.tri", "--out", "o"], &shades[..]].concat(), &["2 lights", "shade.lights=2"]),
        (
            &[&["raster", "t.tri", "--out", "o"], &shades[..]].concat(),
            &["the input has none", "shade.kind=none"],
        ),
        (
            &[&["render", "sphere", "--out", "o"], &shades[..]].concat(),
            &["--shading fast-phong", "shade.kind=none"],
        ),
        (
            &["render", "sphere", "--shading", "fast-phong", "--out", "o"],
            &["--shading fast-phong", "shade.kind=fast-phong"],
        ),
    ];
    for (arguments, words) in cases {
        let (code, error) = run(folder.path(), arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {word:?} is not in {error:?}");
        }
    }
}

#[test]
fn explain_walks_the_terms_of_a_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let explain = ["explain", "sphere", "80", "60", "--shading", "fast-phong", "--set", "screen.width=160"];
    let more = ["--set", "screen.height=120"];
    let output = edgewalk(folder.path(), &[&explain[..], &more, &SHADES].concat()).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    for word in ["nl0, Q11.17", "nh0, Q19.17", "golden's", "entry", "record", "highlight", "red"] {
        assert!(text.contains(word), "{word:?} is not in {text}");
    }
    // Each error within its bound.
    let mut checked = 0;
    for line in text.lines().filter(|line| line.contains("golden's") && line.contains("bound")) {
        let number = |behind: &str| -> f64 {
            let rest = line.split_once(behind).unwrap().1;
            rest.split([';', ',']).next().unwrap().trim().parse().unwrap()
        };
        assert!(number("error ").abs() <= number("bound "), "{line}");
        checked += 1;
    }
    assert_eq!(checked, 2, "{text}");
}

/// With NORMAL between terms and tables: the root of N·N by f64, and both indices within their bounds of golden's.
#[test]
fn explain_walks_the_root_of_a_normal() {
    let folder = tempfile::tempdir().unwrap();
    let more = ["--set", "screen.width=160", "--set", "screen.height=120", "--set", "shade.table_bits=10"];
    let mut checked = 0;
    for [x, y] in [["80", "60"], ["70", "50"], ["90", "66"], ["60", "61"], ["100", "62"], ["77", "40"]] {
        let explain =
            ["explain", "sphere", x, y, "--shading", "phong", "--set", "shade.kind=phong", "--json"];
        let output = edgewalk(folder.path(), &[&explain[..], &more].concat()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let normal = &told["shaded"][0]["normal"];
        let [square, y] = ["square", "y"].map(|key| normal[key].as_f64().unwrap());
        assert!((y / 65536.0 - (65536.0 / square).sqrt()).abs() < 1e-4, "{normal}");
        for (place, index) in normal["indices"].as_array().unwrap().iter().enumerate() {
            let product = told["shaded"][0]["terms"][place]["output"].as_f64().unwrap();
            let cosine = normal["cosines"][place].as_f64().unwrap();
            assert!((cosine - product * y / 65536.0).abs() <= 0.5, "{normal}");
            let read = &index["read"];
            let [index, golden, bound] =
                [&index["index"], &read["golden"], &read["bound"]].map(|number| number.as_f64().unwrap());
            assert!(index - bound <= golden && golden <= index + 1.0 + bound, "{normal}");
            checked += 1;
        }
    }
    assert_eq!(checked, 12);
}
