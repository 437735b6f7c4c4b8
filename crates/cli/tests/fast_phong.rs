//! `edgewalk render --engine golden --shading fast-phong`: pictures, figures, and what it refuses.

use std::path::Path;
use std::process::{Command, Output};

fn render(out: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .args(["render", "sphere", "--json", "--out"])
        .arg(out)
        .args(arguments)
        .output()
        .expect("the program runs")
}

const FAST: [&str; 4] = ["--engine", "golden", "--shading", "fast-phong"];

#[test]
fn fits_and_tables_are_drawn_beside_phong_and_the_truth() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut checked, mut largest) = (0, Vec::new());
    for (fit, table) in [("taylor", 4096), ("six-point", 4096), ("six-point", 1 << 20)] {
        let out = folder.path().join(format!("{fit}{table}"));
        let output = render(&out, &[&FAST[..], &["--fit", fit, "--table", &table.to_string()]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a report");
        let fast = &report["fast_phong"];
        assert_eq!((&fast["fit"], &fast["table_entries"]), (&fit.into(), &table.into()));
        assert_eq!((&fast["table_form"], &report["specular"]), (&"halfway".into(), &"mirror".into()));
        let number = |key: &str| fast[key].as_f64().expect("a number");
        assert!(number("mean_error_from_phong") > 0.0 && number("largest_rho") > 0.05, "{fast}");
        assert!(number("cosine_bound_lsb") > 0.1, "{fast}");
        largest.push(number("largest_error_from_phong"));
        for file in
            ["image.png", "truth.png", "shading_error.png", "phong.png", "phong_error.png", "report.txt"]
        {
            assert!(out.join(file).is_file(), "{fit}: {file}");
            checked += 1;
        }
        let text = std::fs::read_to_string(out.join("report.txt")).expect("a page");
        assert!(text.contains(&format!("fit {fit}, table of {table} entries, highlights halfway")), "{text}");
    }
    println!("checked {checked} / 18 files; largest errors from Phong {largest:.3?} LSB");
    let [taylor, six_point, large_table] = largest[..] else { panic!("three pictures") };
    assert!(checked == 18 && taylor > 2.0 * six_point && six_point > 2.0 * large_table && large_table < 0.5);
}

#[test]
fn what_fast_phong_refuses() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let cases: &[(&[&str], &[&str])] = &[
        (&["--shading", "fast-phong"], &["--shading fast-phong", "--engine golden"]),
        (&["--engine", "golden", "--shading", "phong", "--fit", "taylor"], &["--fit", "fast-phong"]),
        (&["--table", "64"], &["--table", "fast-phong"]),
        (&["--engine", "golden", "--shading", "fast-phong", "--fit", "six"], &["six", "six-point"]),
        (&["--engine", "golden", "--shading", "fast-phong", "--table", "1"], &["1", "2..="]),
        (
            &["--engine", "golden", "--shading", "fast-phong", "--machine", "textbook"],
            &["fast-phong", "edge.fill"],
        ),
    ];
    for (arguments, must_say) in cases {
        let output = render(&out, arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(must_say.iter().all(|word| error.contains(word)), "{arguments:?}: {error}");
    }
    println!("checked {0} / {0} refusals", cases.len());
    assert!(!out.exists(), "nothing is left behind");
}
