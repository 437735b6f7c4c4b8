//! What features cost and which machine fits which device: the tables of the page, and that they are the program's.

use super::{docs, table};
use crate::support::edgewalk;
use serde_json::Value;

/// The machines of a table of features that `compare` wrote.
fn machines(name: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(docs().join("study").join(format!("features_{name}.json"))).unwrap();
    let told: Value = serde_json::from_str(&text).unwrap();
    told["machines"].as_array().unwrap().clone()
}

/// The rows of features: what the machine is called, the inputs, and its place in the table.
fn featured() -> Vec<(&'static str, &'static str, Value)> {
    let rows = [
        ("Gouraud", "plain", 0),
        ("shadows", "plain", 1),
        ("glass, a k_t for a triangle", "glass", 0),
        ("glass, a k_t for a pixel", "glass", 1),
        ("fast Phong", "shaded", 0),
        ("Phong", "shaded", 1),
        ("texture at the corners", "texture", 0),
        ("texture, fast Phong", "texture", 1),
    ];
    rows.into_iter().map(|(row, table, place)| (row, table, machines(table)[place].clone())).collect()
}

/// A figure to so many digits behind the point; `-` of what is not known.
fn told(value: Option<&Value>, scale: f64, digits: usize) -> String {
    value
        .and_then(Value::as_f64)
        .map_or_else(|| "-".to_owned(), |value| format!("{:.digits$}", value * scale))
}

/// What each feature costs, whatever is drawn.
pub fn features() -> String {
    let header =
        ["feature", "LUT4", "flip-flops", "RAM", "MHz", "thousand gates", "MHz of these", "memory, kbit"];
    let body = featured().into_iter().map(|(row, _, machine)| {
        let at = |place: &str, scale, digits| told(machine.pointer(place), scale, digits);
        let spread = |figure: &str, digits| {
            let of = |part: &str| at(&format!("/estimate/{figure}/{part}"), 1.0, digits);
            format!("{} ± {}", of("value"), of("error"))
        };
        vec![
            row.to_owned(),
            spread("est_lut4", 0),
            at("/estimate/est_ff", 1.0, 0),
            at("/estimate/est_ram", 1.0, 0),
            spread("est_mhz", 1),
            at("/inputs/0/energy/kge", 1.0, 1),
            at("/inputs/0/energy/mhz", 1.0, 1),
            at("/memory_bits", 1e-3, 0),
        ]
    });
    table(header.map(str::to_owned), body.collect::<Vec<_>>())
}

/// What each feature takes on each mesh, and how far its pictures are from the equation that it draws.
pub fn features_on_meshes() -> String {
    let meshes = ["sphere", "torus", "torus-knot"];
    let header = ["feature".to_owned()].into_iter();
    let header = header.chain(meshes.map(|mesh| format!("{mesh}: cycles, nJ, mean, largest")));
    let body = featured().into_iter().map(|(row, _, machine)| {
        let of = |input: usize| {
            let at =
                |place: &str, scale, digits| told(machine["inputs"][input].pointer(place), scale, digits);
            let [cycles, energy] = [at("/all_cycles", 1.0, 0), at("/energy/energy/frame_pj", 1e-3, 0)];
            format!("{cycles}, {energy}, {}, {}", at("/form_mean", 1.0, 2), at("/form_error", 1.0, 1))
        };
        [row.to_owned()].into_iter().chain((0..3).map(of)).collect()
    });
    table(header, body.collect::<Vec<_>>())
}

/// The estimates that docs/study/run keeps: of iCE40, or of ECP5.
fn kept_fits(file: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(docs().join("study").join(file)).unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["machines"].as_array().unwrap().clone()
}

/// Which machine fits which device, with its frame memories.
pub fn fits() -> String {
    let fits = |device: &str| format!("{device}: fits, memories that do");
    let [up5k, hx8k, ecp5] = ["UP5K", "HX8K", "ECP5-25"].map(fits);
    let header = ["machine", "cells", "RAM", &up5k, &hx8k, "cells of ECP5", &ecp5].map(str::to_owned);
    let both = kept_fits("fits.json").into_iter().zip(kept_fits("fits_ecp5.json"));
    let body = both.map(|(machine, on_ecp5)| {
        assert_eq!(machine["name"], on_ecp5["name"]);
        let cells = |machine: &Value| {
            let part = |part: &str| told(machine.pointer(&format!("/est_cells/{part}")), 1.0, 0);
            format!("{} ± {}", part("value"), part("error"))
        };
        let of = |fits: &Value| {
            let word = fits["text"].as_str().unwrap().split(':').next().unwrap().to_owned();
            let held = |memory: &Value| {
                let name = memory["name"].as_str().unwrap();
                let count = memory["held_by"]["count"].as_u64()?;
                Some(format!("{name} ({count} {})", memory["held_by"]["block"].as_str().unwrap()))
            };
            let held: Vec<String> = fits["memories"].as_array().unwrap().iter().filter_map(held).collect();
            format!("{word}; {}", if held.is_empty() { "none".to_owned() } else { held.join(", ") })
        };
        let figures = [
            format!("`{}`", machine["name"].as_str().unwrap()),
            cells(&machine),
            told(machine.get("est_ram"), 1.0, 0),
            of(&machine["fits"][0]),
            of(&machine["fits"][1]),
            cells(&on_ecp5),
            of(&on_ecp5["fits"][0]),
        ];
        figures.to_vec()
    });
    table(header, body.collect::<Vec<_>>())
}

/// What the page says of the energy of shading is in the kept tables.
#[test]
fn energies_of_shading_are_those_of_the_tables() {
    let page = std::fs::read_to_string(docs().join("study.md")).unwrap();
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let frame = |table: &str, place: usize| machines(table)[place]["inputs"][0]["energy"].clone();
    let [gouraud, fast, phong] = [frame("plain", 0), frame("shaded", 0), frame("shaded", 1)];
    let all = |of: &Value| of["energy"]["frame_pj"].as_f64().unwrap();
    let share = |of: &Value, unit: &str| 100.0 * of["energy"]["units"][unit].as_f64().unwrap() / all(of);
    let shade = fast["units"].as_array().unwrap().iter().find(|unit| unit["unit"] == "shade").unwrap();
    let flip_flops = shade["flip_flops"].as_u64().unwrap();
    for said in [
        format!("fast Phong takes {:.1} times the energy of Gouraud", all(&fast) / all(&gouraud)),
        format!("and Phong {:.1} times.", all(&phong) / all(&gouraud)),
        format!("SHADE takes {:.0} and {:.0} % of it", share(&fast, "shade"), share(&phong, "shade")),
        format!("NORMAL {:.0} %.", share(&phong, "normal")),
        format!("its {},{:03} flip-flops", flip_flops / 1000, flip_flops % 1000),
    ] {
        assert!(page.contains(&said), "docs/study.md does not say: {said}");
    }
}

/// The kept tables of features are those of today's program, but for what takes tools; sphere alone is drawn again.
#[test]
fn features_are_those_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let mut checked = 0;
    for (table, input) in [
        ("plain", "sphere"),
        ("shaded", "sphere"),
        ("glass", "sphere-glass.toml"),
        ("texture", "sphere-texture.toml"),
    ] {
        let kept = machines(table);
        let names: Vec<&str> = kept.iter().map(|machine| machine["machine"].as_str().unwrap()).collect();
        let input = match input.ends_with(".toml") {
            true => docs().join("study").join(input).display().to_string(),
            false => input.to_owned(),
        };
        let mut words = vec!["compare", names[0], names[1], &input, "--table", "--json"];
        names[2..].iter().for_each(|name| words.extend(["--with", *name]));
        let output = edgewalk(folder.path(), &words).output().unwrap();
        assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
        let today: Value = serde_json::from_slice(&output.stdout).unwrap();
        for (kept, today) in kept.iter().zip(today["machines"].as_array().unwrap()) {
            for figure in ["hash", "units", "estimate", "memory_bits"] {
                assert_eq!(
                    kept[figure], today[figure],
                    "{} {figure}: docs/study/run --synth",
                    kept["machine"]
                );
                checked += 1;
            }
            for (figure, value) in today["inputs"][0].as_object().unwrap().iter().filter(|of| of.0 != "input")
            {
                assert_eq!(kept["inputs"][0][figure], *value, "{} {figure}", kept["machine"]);
                checked += 1;
            }
        }
    }
    for (file, devices) in [
        ("fits.json", &["--fits", "ice40-up5k", "--fits", "ice40-hx8k", "--json"][..]),
        ("fits_ecp5.json", &["--family", "ecp5", "--fits", "ecp5-25", "--json"]),
    ] {
        let kept = kept_fits(file);
        let names: Vec<&str> = kept.iter().map(|machine| machine["name"].as_str().unwrap()).collect();
        let output =
            edgewalk(folder.path(), &[&["estimate"][..], &names, devices].concat()).output().unwrap();
        let today: Value = serde_json::from_slice(&output.stdout).unwrap();
        for (kept, today) in kept.iter().zip(today["machines"].as_array().unwrap()) {
            for (figure, value) in today.as_object().unwrap().iter().filter(|of| of.0 != "milliseconds") {
                assert_eq!(kept[figure], *value, "{} {figure}: docs/study/run --features", kept["name"]);
                checked += 1;
            }
        }
    }
    println!("checked {checked} figures");
    assert!(checked > 200, "{checked}");
}
