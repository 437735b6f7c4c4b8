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
