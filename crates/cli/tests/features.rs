//! `edgewalk compare` of several machines on several inputs: the table of what features cost.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{SCREEN, TRIANGLE, edgewalk, run};
use serde_json::{Value, json};
use std::path::Path;

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let output = edgewalk(folder, &[arguments, &["--json"]].concat()).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

const MACHINES: [(&str, &[&str]); 4] = [
    ("default", &[]),
    ("default,blend.kind=constant", &["--set", "blend.kind=constant"]),
    ("default,shade.kind=fast-phong", &["--set", "shade.kind=fast-phong", "--shading", "fast-phong"]),
    ("default,shade.kind=phong", &["--set", "shade.kind=phong", "--shading", "phong"]),
];

#[test]
fn table_has_figures_of_render_and_estimate() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let [a, b, c, d] = MACHINES.map(|machine| machine.0);
    let more = ["--with", c, "--with", d, "--page", "p.html"];
    let told = json(folder.path(), &[&["compare", a, b, "sphere", "a.tri"], &more[..], &SCREEN].concat());
    assert_eq!(
        (&told["format"], &told["inputs"]),
        (&json!("edgewalk-features"), &json!(["sphere", "a.tri"]))
    );
    let mut checked = 0;
    for ((name, settings), machine) in MACHINES.iter().zip(told["machines"].as_array().unwrap()) {
        assert_eq!(machine["machine"], *name);
        for (input, row) in ["sphere", "a.tri"].into_iter().zip(machine["inputs"].as_array().unwrap()) {
            if input == "a.tri" && name.contains("shade") {
                assert!(row["reason"].as_str().unwrap().contains("shades by normals"), "{row}");
                continue;
            }
            let report =
                json(folder.path(), &[&["render", input, "--out", "r"], *settings, &SCREEN].concat());
            for (key, place) in [
                ("cycles", "/cycles/total"),
                ("fragments", "/fragments"),
                ("bytes", "/traffic/bytes"),
                ("z_error", "/comparison/z_error"),
                ("color_error", "/comparison/color_error"),
            ] {
                assert_eq!(
                    row[key],
                    report.pointer(place).cloned().unwrap_or(Value::Null),
                    "{name} {input} {key}"
                );
                checked += 1;
            }
            assert_eq!(row["shading_error"].is_null(), input == "a.tri", "a triangle file has no surface");
        }
        let keys: Vec<&str> = settings.iter().copied().take(2).collect();
        for unit in machine["units"].as_array().unwrap() {
            let one = unit["unit"].as_str().unwrap();
            let told = json(folder.path(), &[&["estimate", "--unit", one], &keys[..], &SCREEN].concat());
            for figure in ["est_lut4", "est_ff", "est_ram", "est_mhz"] {
                assert_eq!(unit["estimate"][figure], told["machines"][0][figure], "{name} {one}");
                checked += 1;
            }
        }
        let fits = ["--fits", "ice40-hx8k", "--fits", "ice40-up5k"];
        let whole = json(folder.path(), &[&["estimate"], &fits[..], &keys, &SCREEN].concat());
        assert_eq!(machine["estimate"]["fits"], whole["machines"][0]["fits"]);
        assert_eq!(machine["estimate"]["est_lut4"], whole["machines"][0]["est_lut4"]);
        checked += 2;
    }
    println!("{checked} figures");
    assert_eq!(checked, 6 * 5 + (5 + 6 + 7 + 8) * 4 + 4 * 2, "units: {}", units(&told));
    // 64 x 48 pixels of 24 bits of depth and 24 of colour; tables and records beside them.
    assert_eq!(told["machines"][0]["memory_bits"], 64 * 48 * (24 + 24));
    assert!(told["machines"][3]["memory_bits"].as_u64() > told["machines"][0]["memory_bits"].as_u64());
    // The distance from the equation is the one that the comparison of two machines tells.
    let pair = json(folder.path(), &[&["compare", a, d, "sphere"], &SCREEN[..]].concat());
    for (machine, side) in [(0, "a"), (3, "b")] {
        let [row, equation] = [&told["machines"][machine]["inputs"][0], &pair[side]["equation"]];
        assert_eq!((&row["shading_mean"], &row["shading_error"]), (&equation["mean"], &equation["largest"]));
        assert!(row["shading_mean"].as_f64() > Some(0.1), "{row}");
    }
    page_is_that_of_the_json(folder.path(), &told);
    let kept = std::fs::read(folder.path().join("out/compare/features.json")).unwrap();
    assert_eq!(serde_json::from_slice::<Value>(&kept).unwrap(), told);
}

fn units(told: &Value) -> String {
    let machines = told["machines"].as_array().unwrap().iter();
    machines
        .map(|machine| machine["units"].as_array().unwrap().len().to_string())
        .collect::<Vec<_>>()
        .join(", ")
}

/// Every figure of the page stands in the JSON where the page says, and no number of the JSON's table is left out.
fn page_is_that_of_the_json(folder: &Path, told: &Value) {
    let page = std::fs::read_to_string(folder.join("p.html")).unwrap();
    assert!(!page.contains("http") && !page.contains("<script") && !page.contains("src="));
    let mut checked = 0;
    for cell in page.split("data-at=\"").skip(1) {
        let (place, rest) = cell.split_once("\">").unwrap();
        let shown = rest.split("</td>").next().unwrap();
        let value = told.pointer(place).unwrap_or_else(|| panic!("{place}"));
        match value.as_f64() {
            Some(number) => {
                let apart = (shown.parse::<f64>().unwrap() - number).abs();
                assert!(
                    apart <= if number.abs() < 1000.0 { 0.005_001 } else { 0.5 },
                    "{place}: {shown}, {number}"
                );
            }
            None => assert_eq!(shown.replace("&amp;", "&"), value.as_str().unwrap()),
        }
        checked += 1;
    }
    let text = std::fs::read_to_string(folder.join("out/compare/features.txt")).unwrap();
    let drawn =
        told["machines"].as_array().unwrap().iter().flat_map(|machine| machine["inputs"].as_array().unwrap());
    for row in drawn.filter(|row| row["reason"].is_null()) {
        let cycles = row["cycles"].to_string();
        assert!(text.contains(&cycles) && page.contains(&format!(">{cycles}</td>")), "{cycles}");
    }
    println!("{checked} figures of the page");
    assert!(checked > 120);
    // In text and page a unit's row has the unit's own cells.
    let machines = told["machines"].as_array().unwrap();
    let mut rows = 0;
    for unit in ["setup", "edge", "span", "term", "pixel", "depth"] {
        let cells: Vec<String> = machines
            .iter()
            .map(|machine| {
                let mut units = machine["units"].as_array().unwrap().iter();
                let found = units.find(|found| found["unit"] == unit);
                found.map_or("-".to_owned(), |found| format!("{}", found["estimate"]["est_ff"]))
            })
            .collect();
        let name = format!("{unit}: est_ff");
        let line = text.lines().find(|line| line.starts_with(&name)).unwrap();
        assert_eq!(line[name.len()..].split_whitespace().collect::<Vec<_>>(), cells, "{line}");
        let row = page.split("<tr><th>").find(|row| row.starts_with(&name)).unwrap();
        let shown = row.split("<td").skip(1).map(|cell| cell.split(['>', '<']).nth(1).unwrap());
        assert_eq!(shown.collect::<Vec<_>>(), cells, "{row}");
        rows += 1;
    }
    assert_eq!(rows, 6);
}

/// A sphere seen from far away, with highlights of N·H: the scene's own equation is the form that Phong draws.
const FAR: &str = "specular = \"halfway\"\n[camera]\neye = [0, 0, 2000]\ntarget = [0, 0, 0]\nangle = 0.07\n\
    [[material]]\nname = \"m\"\ndiffuse = [0.8, 0.4, 0.3]\nspecular = 0.4\nexponent = 24\n\
    [[object]]\nbuiltin = \"sphere\"\nmaterial = \"m\"\n";

#[test]
fn phong_is_judged_by_the_form_it_draws() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("far.toml"), FAR).unwrap();
    let words = ["compare", "default:gouraud", "default,shade.kind=phong", "sphere", "far.toml"];
    let more = [
        "--with",
        "default,shade.kind=fast-phong",
        "--set",
        "screen.width=160",
        "--set",
        "screen.height=120",
    ];
    let told = json(folder.path(), &[&words[..], &more].concat());
    let of = |machine: usize, input: usize, key: &str| -> f64 {
        told["machines"][machine]["inputs"][input][key].as_f64().unwrap()
    };
    for input in [0, 1] {
        for figure in ["error", "mean"] {
            let [form, shading] = ["form", "shading"].map(|of| format!("{of}_{figure}"));
            assert_eq!(
                of(0, input, &form),
                of(0, input, &shading),
                "the corners have the scene's own equation"
            );
        }
        // Nearer than Gouraud shading, whose highlights go through the corners alone.
        for machine in [1, 2] {
            println!(
                "{machine} {input}: {} of {}",
                of(machine, input, "form_mean"),
                of(0, input, "form_mean")
            );
            assert!(of(machine, input, "form_mean") < of(0, input, "form_mean"), "{machine}, {input}");
            assert!(of(machine, input, "form_error") < of(0, input, "form_error"), "{machine}, {input}");
        }
    }
    // Mirror highlights seen from near are far from what Phong draws.
    assert!(of(1, 0, "shading_mean") > 1.5 * of(1, 0, "form_mean"));
    assert!(of(2, 0, "shading_mean") > 1.05 * of(2, 0, "form_mean"));
    // Where the scene is as SHADE has it, both distances are one.
    for machine in [1, 2] {
        assert!((of(machine, 1, "shading_mean") - of(machine, 1, "form_mean")).abs() < 0.02, "{machine}");
    }
}

#[test]
fn shadows_cost_passes_and_maps() {
    let folder = tempfile::tempdir().unwrap();
    let shadows = "default,shadow.light=perspective,blend.kind=constant:shadows";
    let compare = ["compare", "default:gouraud", shadows, "sphere", "--table"];
    let told = json(folder.path(), &[&compare[..], &SCREEN].concat());
    let row = &told["machines"][1]["inputs"][0];
    let settings = ["--set", "shadow.light=perspective", "--set", "blend.kind=constant"];
    let render = [&["render", "sphere", "--shadows", "map", "--out", "r"], &settings[..], &SCREEN].concat();
    let report = json(folder.path(), &render);
    assert_eq!((&row["cycles"], &row["bytes"]), (&report["cycles"]["total"], &report["traffic"]["bytes"]));
    let maps: u64 =
        report["cycles"]["maps"].as_array().unwrap().iter().map(|map| map.as_u64().unwrap()).sum();
    assert_eq!(row["map_cycles"].as_u64(), Some(maps));
    assert_eq!(row["all_cycles"].as_u64(), Some(maps + report["cycles"]["total"].as_u64().unwrap()));
    assert!(maps > 0 && row["cycles"].as_u64() > told["machines"][0]["inputs"][0]["cycles"].as_u64());
}

/// What the note under the table says of the presets.
#[test]
fn presets_are_near_the_sum_of_their_units() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let presets = edgewalk_machine::presets::PRESETS.iter().map(|preset| preset.0).collect::<Vec<_>>();
    let with = presets[2..].iter().flat_map(|name| ["--with", *name]).collect::<Vec<_>>();
    // Textbook differs from golden, as it should, so the exit code is 1.
    let words = [&["compare", presets[0], presets[1], "a.tri", "--json"][..], &with].concat();
    let output = edgewalk(folder.path(), &words).output().unwrap();
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    let lut4 = |of: &Value| of.pointer("/estimate/est_lut4/value").and_then(Value::as_f64).unwrap();
    let machines = told["machines"].as_array().unwrap();
    for machine in machines {
        let (units, whole) =
            (machine["units"].as_array().unwrap().iter().map(lut4).sum::<f64>(), lut4(machine));
        let off = 100.0 * (whole - units) / units;
        println!("{}: {whole} LUT4, units {units}, {off:.2} %", machine["machine"]);
        assert!(whole > 1000.0 && off.abs() < 1.0, "{machine}");
    }
    assert_eq!(machines.len(), 8);
}

#[test]
fn tables_that_cannot_be_made_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    for (arguments, said) in [
        (&["default", "defalt", "sphere", "--table"][..], "nearest: default"),
        (&["default", "default", "sphere", "--with", "default,adders=1"], "nearest: interpolator.adders"),
        (&["default", "default", "sphere", "nosuch.obj"], "nosuch.obj"),
        (&["default", "default", "sphere", "--table", "--adapt"], "--adapt: not permitted for a table"),
        (
            &["default,shade.kind=phong", "default,shade.kind=phong", "a.tri", "--table"],
            "no machine draws any of the inputs",
        ),
        (&["default", "default", "sphere", "--page", "none/p.html"], "--page none/p.html"),
        (
            &["default", "default", "sphere", "--energy", "5", "--stalls", "dram:miss=20"],
            "refresh=780,busy=13: the energy is that of a memory that never makes the machine wait",
        ),
    ] {
        let (code, error) = run(folder.path(), &[&["compare"], arguments, &SCREEN[..]].concat());
        assert!(code == Some(2) && error.contains(said), "{arguments:?}: {error}");
    }
}

/// A picture beyond its bounds is named, and so is what draws nothing.
#[test]
fn pictures_that_fail_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    std::fs::write(at.join("off.tri"), "size 64 48\nT 70 70 0 1 0 0 0  90 70 0 0 1 0 0  70 90 1 0 0 1 0\n")
        .unwrap();
    let told = |words: &[&str]| {
        let output = edgewalk(at, &[&["compare"], words, &["--table"], &SCREEN].concat()).output().unwrap();
        let kept = std::fs::read(at.join("out/compare/features.json")).unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        (output.status.code(), text, serde_json::from_slice::<Value>(&kept).unwrap())
    };
    // The textbook machine differs from golden, as it should.
    let (code, text, json) = told(&["default", "textbook", "a.tri"]);
    let verdicts = [0, 1].map(|place| json["machines"][place]["inputs"][0]["verdict"].as_str().unwrap());
    assert_eq!((code, verdicts), (Some(1), ["pass", "mismatch"]), "{text}");
    assert!(text.contains("M2, a.tri: beside golden: mismatch\n") && !text.contains("M1, a.tri"), "{text}");
    // Of an open picture no error is known.
    std::fs::write(at.join("open.tri"), crate::compare::OPEN).unwrap();
    let blend = "default,blend.kind=constant";
    let (code, text, json) = told(&[blend, blend, "open.tri", "a.tri"]);
    let rows = &json["machines"][1]["inputs"];
    assert_eq!((code, &rows[0]["verdict"], &rows[1]["verdict"]), (Some(2), &json!("open"), &json!("pass")));
    assert!(rows[0]["z_error"].is_null() && rows[1]["z_error"].is_number(), "{rows}");
    assert!(
        text.contains("M2, open.tri: beside golden: open\n") && !text.contains("open.tri: depth"),
        "{text}"
    );
    let (code, text, json) = told(&["default", "default,fifo.span=4", "off.tri", "a.tri"]);
    assert_eq!(code, Some(0), "{text}");
    for machine in [0, 1] {
        let rows = &json["machines"][machine]["inputs"];
        let why = "off.tri: nothing was drawn: none of its 1 triangles or polygons covers a pixel";
        assert!(rows[0]["reason"].as_str().unwrap().starts_with(why), "{rows}");
        assert_eq!(rows[1]["verdict"], "pass");
    }
    assert!(text.contains("M1, off.tri: not drawn: off.tri: nothing was drawn"), "{text}");
    let (code, error) =
        run(at, &[&["compare", "default", "default", "off.tri", "--table"], &SCREEN[..]].concat());
    assert!(code == Some(2) && error.contains("nothing was drawn: none of its 1"), "{error}");
}

/// The page is a file like the others: refused before anything is drawn, and in the place of a link.
#[test]
fn page_is_checked_first_and_replaces_links() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let path = |name: &str| at.join(name);
    std::fs::write(path("a.tri"), TRIANGLE).unwrap();
    std::fs::write(path("kept"), "kept").unwrap();
    std::fs::create_dir(path("d")).unwrap();
    std::os::unix::fs::symlink("kept", path("p.html")).unwrap();
    let with = |page: &str| {
        let words = ["compare", "default", "default", "a.tri", "--page", page, "--out", "o"];
        run(at, &[&words[..], &SCREEN].concat())
    };
    for (page, said) in [
        (
            "o/features.json",
            "the command writes features.json into --out itself; permitted: a name other than",
        ),
        ("d/../o/features.txt", "the command writes features.txt into --out itself"),
        ("none/p.html", "the folder none is not there; permitted: a file in a folder that is there"),
        ("d", "a folder stands there; permitted: a regular file or a new name"),
        ("/dev/null", "a device stands there; permitted: a regular file or a new name"),
        ("..", "the path names no file"),
    ] {
        let (code, error) = with(page);
        let named = error.starts_with(&format!("error: --page {page}: "));
        assert!(code == Some(2) && named && error.contains(said), "{page}: {error}");
        assert!(!path("o").exists(), "{page}");
    }
    for page in ["p.html", "o/p.html"] {
        assert_eq!(with(page).0, Some(0), "{page}");
        assert!(std::fs::read_to_string(path(page)).unwrap().ends_with("</html>\n"));
        assert!(!path(page).is_symlink(), "{page}");
    }
    assert_eq!(std::fs::read_to_string(path("kept")).unwrap(), "kept");
    assert!(path("o/features.json").exists());
}
