//! `edgewalk explain`: every addition on the way to a pixel lies within its bound, and the terms add up to the colour.

use serde_json::Value;
use std::process::Command;

fn explain(scene: &str, x: u32, y: u32) -> Value {
    let at = [x.to_string(), y.to_string()];
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .args(["explain", scene, &at[0], &at[1], "--json"])
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .output()
        .expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON value")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|v| v.as_f64().expect("a number")).collect()
}

#[test]
fn additions_stay_within_their_bounds_and_end_at_the_golden_value() {
    let max = [16_777_215.0, 255.0, 255.0, 255.0];
    let (mut pixels, mut checked) = (0, 0);
    for (scene, x, y) in
        [("torus-knot", 320, 240), ("torus-knot", 330, 250), ("sphere", 300, 300), ("room", 10, 470)]
    {
        let told = explain(scene, x, y);
        assert!(told["id"].as_i64().expect("an id") >= 0, "{scene} ({x}, {y})");
        let additions = told["machine"]["additions"].as_array().expect("the machine's way");
        for addition in additions {
            let [error, bound] = ["error", "bound"].map(|key| numbers(&addition[key]));
            for (error, bound) in error.iter().zip(&bound) {
                assert!(*bound > 0.0 && error.abs() <= *bound, "{addition}");
                checked += 1;
            }
        }
        let last = additions.last().expect("a start");
        assert_eq!((last["x"].as_u64(), last["y"].as_u64()), (Some(x.into()), Some(y.into())));
        let rgb = numbers(&told["rgb"]);
        let golden = [told["z"].as_f64().expect("z"), rgb[0], rgb[1], rgb[2]];
        let values = numbers(&last["value"]);
        for i in 0..4 {
            // The vertices are rounded to 4 bits below the LSB at the port.
            let off = (values[i] - golden[i] * max[i]).abs();
            assert!(off <= 1.0 / 32.0 + numbers(&last["bound"])[i] + 1e-6, "{scene} channel {i}: {off}");
        }
        pixels += 1;
    }
    println!("checked {checked} additions on the way to {pixels} / 4 pixels");
    assert!(pixels == 4 && checked > 100);
}

#[test]
fn terms_add_up() {
    let told = explain("docs/scenes/lights.toml", 320, 240);
    let light = &told["light"];
    let mut sum = numbers(&light["emission"]);
    for part in [&light["ambient"]].into_iter().chain(
        light["lights"].as_array().expect("lights").iter().flat_map(|l| [&l["diffuse"], &l["specular"]]),
    ) {
        sum = sum.iter().zip(numbers(part)).map(|(a, b)| a + b).collect();
    }
    let total = numbers(&light["total"]);
    assert_eq!(light["lights"].as_array().map(Vec::len), Some(3));
    assert!(sum.iter().zip(&total).all(|(a, b)| (a - b).abs() < 1e-12), "{sum:?} {total:?}");
}

/// The error that is told is that of the sum that is told, against a plane worked out here.
#[test]
fn errors_are_those_of_the_sums_in_json_and_in_text() {
    let folder = tempfile::tempdir().expect("a folder");
    // Whole LSB at whole pixels: the port rounds nothing.
    let [z, red] = [[1_000_000.0, 9_000_000.0, 4_000_000.0], [20.0, 250.0, 99.0]];
    let at = [(1.0, 1.0), (62.0, 4.0), (9.0, 46.0)];
    let vertex = |i: usize| {
        let (x, y) = at[i];
        format!("{x} {y} {} {} 0 0 0", z[i] / 16_777_215.0, red[i] / 255.0)
    };
    let text = format!("size 64 48\nT {} {} {}\n", vertex(0), vertex(1), vertex(2));
    std::fs::write(folder.path().join("a.tri"), text).expect("written");
    let run = |more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
            .args(["explain", "a.tri", "28", "14", "--set", "screen.width=64", "--set", "screen.height=48"])
            .args(more)
            .current_dir(folder.path())
            .output()
            .expect("the program runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    };
    let plane = |values: [f64; 3], x: f64, y: f64| {
        let cross = |i: usize, j: usize, (x, y): (f64, f64)| {
            (at[j].0 - at[i].0) * (y - at[i].1) - (at[j].1 - at[i].1) * (x - at[i].0)
        };
        let p = (x + 0.5, y + 0.5);
        let sum = cross(1, 2, p) * values[0] + cross(2, 0, p) * values[1] + cross(0, 1, p) * values[2];
        sum / cross(0, 1, at[2])
    };
    let told: Value = serde_json::from_str(&run(&["--json"])).expect("one JSON value");
    let additions = told["machine"]["additions"].as_array().expect("additions");
    let page = run(&[]);
    let rows: Vec<&str> = page.lines().skip_while(|line| !line.starts_with("  start")).collect();
    let (mut sums, mut largest) = ([0.0; 2], 0f64);
    for addition in additions {
        let [added, value, error] = ["added", "value", "error"].map(|key| numbers(&addition[key]));
        let (x, y) = (addition["x"].as_f64().expect("x"), addition["y"].as_f64().expect("y"));
        for (channel, values) in [z, red].into_iter().enumerate() {
            sums[channel] += added[channel];
            assert!((value[channel] - sums[channel]).abs() < 1e-6, "{addition}");
            let off = sums[channel] - plane(values, x, y);
            assert!((error[channel] - off).abs() < 1e-6, "{addition}: {off}");
            largest = largest.max(off.abs());
        }
        let printed = format!("{:>10.6}", error[0]);
        if addition["step"] == "start" {
            assert!(rows[0].contains(&printed), "{} {printed}", rows[0]);
        }
    }
    let last = numbers(&additions.last().expect("the last")["error"]);
    let row = rows.last().expect("a row");
    let printed: Vec<f64> =
        row.split_whitespace().rev().take(4).map(|n| n.parse().expect("a number")).collect();
    assert!((printed[3] - last[0]).abs() < 1e-6 && (printed[1] - last[1]).abs() < 1e-6, "{row}: {last:?}");
    println!("{} additions, largest error {largest:.6} LSB", additions.len());
    assert!(additions.len() > 20 && largest > 2e-5, "{largest}");
    assert!(
        last.iter().take(2).all(|error| error.abs() > 1e-6),
        "{last:?}: an error that shows in six digits"
    );
}
