//! `--engine jit`: the netlist as native code draws what the other engines draw; without the feature the program says how to get it.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod support;

use support::{names, run};

#[cfg(not(feature = "jit"))]
#[test]
fn without_the_feature_it_says_how_to_build_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("one.tri"), support::TRIANGLE).unwrap();
    for command in ["raster", "render"] {
        let arguments = [command, "one.tri", "--engine", "jit", "--out", "out"];
        let (status, said) = run(folder.path(), &[&arguments[..], &support::SCREEN].concat());
        assert_eq!(status, Some(2), "{said}");
        assert!(
            said.contains("--engine jit") && said.contains("`cargo build --release --features jit`"),
            "{said}"
        );
        assert_eq!(names(folder.path()), ["one.tri"], "nothing is written");
    }
}

#[cfg(feature = "jit")]
mod drawn {
    use super::*;
    use serde_json::Value;
    use std::fmt::Write as _;
    use std::path::Path;

    /// Triangles of a few pixels and some large ones, by a fixed walk; `more`: lines of the file before each.
    fn triangles(head: &str, count: u32) -> String {
        let mut text = format!("size 96 64\n{head}");
        let mut state = 1u32;
        let mut next = |below: f64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) * below
        };
        for i in 0..count {
            let (x, y, reach) = (next(96.0), next(64.0), if i % 16 == 0 { 90.0 } else { 9.0 });
            write!(text, "T").unwrap();
            for _ in 0..3 {
                let place = [x + next(reach) - reach / 2.0, y + next(reach) - reach / 2.0];
                write!(
                    text,
                    "  {} {} {} {} {} {} 0.5",
                    place[0],
                    place[1],
                    next(1.0),
                    next(1.0),
                    next(1.0),
                    next(1.0)
                )
                .unwrap();
            }
            text.push('\n');
        }
        text
    }

    /// What the engine writes: every file but the report, and that.
    fn raster(folder: &Path, file: &str, engine: &str, settings: &[&str]) -> (Vec<(String, Vec<u8>)>, Value) {
        let arguments = ["raster", file, "--engine", engine, "--out", engine];
        let (status, said) = run(folder, &[&arguments[..], settings].concat());
        assert_eq!(status, Some(0), "{engine} {file} {settings:?}: {said}");
        let out = folder.join(engine);
        let read = |name: &str| std::fs::read(out.join(name)).unwrap();
        let pictures = names(&out).into_iter().filter(|name| name != "report.json");
        let report = serde_json::from_slice(&read("report.json")).unwrap();
        (pictures.map(|name| (name.clone(), read(&name))).collect(), report)
    }

    #[test]
    fn pictures_reports_and_cycles_are_those_of_the_other_engines() {
        let shadow =
            "shadow 8 0.01 0  0.08 0 0 0  0 0.12 0 0  0 0 1 0  0 0 0 1\nL 0 0 0.3  8 0 0.3  0 8 0.3\n";
        let passes = "depth lequal\n";
        let cases: [(&str, &str, &[&str]); 6] = [
            ("plain", "", &[]),
            ("small", passes, &["--set", "setup.lanes=1", "--set", "interpolator.adders=1"]),
            ("drained", passes, &["--set", "memory.hazard=drain", "--set", "interpolator.segments=4"]),
            ("textbook", "", &["--machine", "textbook"]),
            ("blend", "depth always\nblend 1\n", &["--set", "blend.kind=constant"]),
            ("shadow", shadow, &["--set", "shadow.light=parallel", "--set", "shadow.size=8"]),
        ];
        let (mut files, mut fragments) = (0, 0);
        let folder = tempfile::tempdir().unwrap();
        for (name, head, settings) in cases {
            let file = format!("{name}.tri");
            std::fs::write(folder.path().join(&file), triangles(head, 150)).unwrap();
            let [jit, rtl, fast] =
                ["jit", "rtl", "fast"].map(|engine| raster(folder.path(), &file, engine, settings));
            assert_eq!(jit.1, rtl.1, "{name}: the report of the same netlist in the interpreter");
            for key in ["triangles", "fragments", "writes", "host"] {
                assert_eq!(jit.1[key], fast.1[key], "{name} {key}");
            }
            for key in ["total", "by_cause"] {
                assert!(!jit.1["cycles"][key].is_null(), "{name} {key}");
                assert_eq!(jit.1["cycles"][key], fast.1["cycles"][key], "{name} {key}");
            }
            assert!(jit.0.len() >= 6, "{name}");
            for ((array, found), ((_, wanted), (other, fast))) in jit.0.iter().zip(rtl.0.iter().zip(&fast.0))
            {
                assert_eq!(array, other, "{name}");
                assert!(found == wanted && found == fast, "{name}: {array}");
                files += 1;
            }
            fragments += jit.1["fragments"].as_u64().unwrap();
        }
        println!("{files} files of {} frames compared, {fragments} fragments", cases.len());
        assert!(fragments > 20_000, "{fragments} fragments");
    }

    #[test]
    fn render_judges_it_beside_golden() {
        let folder = tempfile::tempdir().unwrap();
        let screen = ["--set", "screen.width=160", "--set", "screen.height=120"];
        let render = ["render", "sphere", "--engine", "jit", "--out", "out"];
        let (status, said) = run(folder.path(), &[&render[..], &screen].concat());
        assert_eq!(status, Some(0), "{said}");
        let report = std::fs::read(folder.path().join("out/report.json")).unwrap();
        let report: Value = serde_json::from_slice(&report).unwrap();
        let compared = &report["comparison"];
        assert_eq!(compared["coverage_mismatches"], 0);
        assert!(compared["compared"].as_u64().unwrap() > 1000, "{compared}");
    }
}
