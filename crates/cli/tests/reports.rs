//! The text of a report says what its JSON does, figure by figure.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::lamps::{BULB, FLOOD, LAMP, SMALL, scene};
use crate::replay::NORMALS;
use crate::support::{edgewalk, npy, run};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

fn number(of: &Value, key: &str) -> f64 {
    of[key].as_f64().unwrap_or_else(|| panic!("{key}: {of}"))
}

/// Text and JSON of one render.
fn rendered(folder: &Path, arguments: &[&str]) -> (String, Value) {
    let (code, said) = run(folder, &[&["render", "--quiet", "--out", "r"], arguments].concat());
    assert_eq!(code, Some(0), "{said}");
    let read = |name: &str| std::fs::read_to_string(folder.join("r").join(name)).unwrap();
    (read("report.txt"), serde_json::from_str(&read("report.json")).unwrap())
}

/// What the text has to say of bounds: the largest, where, and how many are above 1 LSB.
fn bounds(shaded: &Value) -> String {
    let [x, y] = [0, 1].map(|i| shaded["bound_at"][i].as_u64().unwrap());
    let above = shaded["bound_above_1"].as_u64().unwrap();
    format!("bounds up to {:.4} at pixel {x},{y}, {above} above 1", number(shaded, "bound"))
}

fn shaded_lines(report: &Value) -> Vec<String> {
    let of = |of: &Value| of["shaded"].clone();
    let all = of(&report["comparison"]);
    let mut lines = vec![
        format!(
            "shaded: {} pixels, largest error {:.4} LSB from golden, {}, {:.4} of one reached, {} beyond",
            all["pixels"],
            number(&all, "error"),
            bounds(&all),
            number(&all, "of_bound"),
            all["beyond"]
        ),
        format!(
            "a light at the horizon in {} of them, on its other side in {}; from Phong shading at most {:.4}, {:.4} in the mean",
            all["at_horizon"],
            all["other_branch"],
            number(&all, "from_phong"),
            number(&all, "mean_from_phong")
        ),
    ];
    for (light, place) in report["lights"].as_array().into_iter().flatten().map(of).zip(1..) {
        lines.push(format!(
            "light {place} by itself: {} pixels, largest error {:.4} LSB, {}, {} beyond",
            light["pixels"],
            number(&light, "error"),
            bounds(&light),
            light["beyond"]
        ));
    }
    lines
}

/// The lines that every picture of a machine has.
fn lines(report: &Value) -> Vec<String> {
    let (of, cycles) = (&report["comparison"], &report["cycles"]);
    let total = cycles["total"].as_u64().unwrap();
    let mut lines = vec![
        format!("fragments {}, writes {}", report["fragments"], report["writes"]),
        format!("compared {} / {} covered pixels", of["compared"], of["covered"]),
        format!("coverage mismatches {} / {}", of["coverage_mismatches"], of["pixels"]),
        format!(
            "cycles {total} ({}), {:.4} pixels a clock",
            cycles["path"].as_str().unwrap(),
            number(report, "fragments") / total as f64
        ),
    ];
    let mut sum = 0;
    for (cause, count) in cycles["by_cause"].as_object().unwrap() {
        let count = count.as_u64().unwrap();
        lines.push(format!("    {cause:<10} {count:>12}  {:>5.1} %", 100.0 * count as f64 / total as f64));
        sum += count;
    }
    lines.push(format!("    {:<10} {sum:>12}  of {total} cycles", "sum"));
    lines
}

fn found(text: &str, wanted: &[String]) -> usize {
    for line in wanted {
        assert!(text.lines().any(|of| of == line), "`{line}` is missing:\n{text}");
    }
    wanted.len()
}

#[test]
fn the_text_of_a_picture_says_what_its_json_does() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let mut checked = 0;
    let small = ["--set", "screen.width=96", "--set", "screen.height=72"];
    let (text, report) = rendered(
        at,
        &[&["sphere", "--set", "formats.z_bits=16", "--set", "formats.z_fraction=14"], &small[..]].concat(),
    );
    checked += found(&text, &lines(&report));
    let of = &report["comparison"];
    let line = |what: &str, error: &str, bits: u32, bound: &str| {
        format!(
            "{what:<21} {:.4} LSB of {bits} bits, proved bound {:.4}",
            number(of, error),
            number(of, bound)
        )
    };
    checked += found(
        &text,
        &[
            line("largest z error", "z_error", 16, "z_bound"),
            line("largest colour error", "color_error", 8, "color_bound"),
            format!(
                "bounds for these triangles, at most {} additions: z {:.4}, colour {:.4}",
                of["additions"],
                number(of, "z_bound_for_input"),
                number(of, "color_bound_for_input")
            ),
        ],
    );
    // Three lights, each drawn by itself and added: each has an error and a bound of its own.
    scene(at, &[BULB, FLOOD, &BULB.replace("= 0.7", "= 0.2")].concat());
    let (text, report) = rendered(at, &[&["s.toml", "--shading", "phong"], &SMALL[..], &LAMP].concat());
    assert_eq!(report["lights"].as_array().unwrap().len(), 3);
    checked += found(&text, &[lines(&report), shaded_lines(&report)].concat());
    println!("checked {checked} lines");
    assert!(checked > 30);
}

/// The pixel with the largest bound has it, and as many pixels have one above 1 LSB as are counted: by `explain` for each triangle.
#[test]
fn the_largest_bound_has_its_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    // The first pixel of each triangle lies in unlike columns and lines.
    let triangles = NORMALS.replace("T 1 1 ", "T 5 1 ").replace("  1 31 0.5", "  5 31 0.5");
    std::fs::write(at.join("n.tri"), triangles).unwrap();
    let machine = ["--set", "shade.kind=fast-phong", "--set", "shade.table_bits=9"];
    let (text, report) = rendered(
        at,
        &[&["n.tri", "--set", "screen.width=32", "--set", "screen.height=32"], &machine[..]].concat(),
    );
    let shaded = &report["comparison"]["shaded"];
    assert_eq!(found(&text, &shaded_lines(&report)), 2);
    assert_eq!(
        run(at, &[&["raster", "n.tri", "--quiet", "--out", "g"], &machine[..]].concat()),
        (Some(0), String::new())
    );
    let (_, _, ids) = npy(&at.join("g/id.npy"));
    let ids: Vec<i32> = ids.chunks_exact(4).map(|of| i32::from_le_bytes(of.try_into().unwrap())).collect();
    let bound_at = |pixel: usize| {
        let [x, y] = [pixel % 32, pixel / 32].map(|place| place.to_string());
        let arguments = [&["explain", "n.tri", &x, &y, "--json"], &machine[..]].concat();
        let output = edgewalk(at, &arguments).output().unwrap();
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        number(&told["shaded"][0], "bound")
    };
    let mut of_triangle = BTreeMap::new();
    for (pixel, id) in ids.iter().enumerate().filter(|(_, id)| **id >= 0) {
        of_triangle.entry(*id).or_insert_with(|| bound_at(pixel));
    }
    let above = ids.iter().filter(|id| of_triangle.get(id).is_some_and(|bound| *bound > 1.0)).count();
    assert_eq!(shaded["bound_above_1"].as_u64(), Some(above as u64), "{of_triangle:?}");
    let largest = of_triangle.values().copied().fold(0.0, f64::max);
    assert_eq!(number(shaded, "bound"), largest);
    let first = ids.iter().position(|id| of_triangle.get(id) == Some(&largest)).unwrap();
    assert_eq!(shaded["bound_at"], serde_json::json!([first % 32, first / 32]));
    println!("checked {} triangles, {above} of {} pixels above 1", of_triangle.len(), ids.len());
    assert!(of_triangle.len() == 3 && first > 32 && first % 32 != first / 32 && above > 0);
}
