//! The page that `edgewalk replay` writes: its figures beside those of `explain`, through the command that the page prints.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::browser::used;
use crate::support::{edgewalk, run};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};

/// At the end of the run: ten pixels that were written, with all that the page says of them.
const TEN: &str = r##"
while (!document.body.classList.contains("ready")) await new Promise((done) => setTimeout(done, 20));
app.go(app.doc.cycles - 1);
const [picture, depth] = app.planes.views, { width } = app.doc.store;
const written = [...picture.top.keys()].filter((pixel) => picture.top[pixel] >= 0);
const numbers = (text) => Object.fromEntries(text.split(": ")[1].split(", ").map((part) => part.split(" ")));
return Array.from({ length: 10 }, (_, k) => written[Math.floor(((k + 0.5) * written.length) / 10)]).map((pixel) => {
  app.choose([pixel % width, Math.floor(pixel / width)]);
  const past = document.getElementById("past"), table = past.querySelectorAll("table")[1];
  return {
    command: past.querySelector("code").textContent,
    stored: { ...numbers(picture.under.textContent), ...numbers(depth.under.textContent) },
    title: past.querySelector("h3").textContent,
    heads: [...table.tHead.rows[0].cells].map((cell) => cell.textContent),
    rows: [...table.tBodies[0].rows].map((row) => [...row.cells].map((cell) => cell.textContent.replace("\u2212", "-"))),
  };
});
"##;

/// Blended, three triangles, one over the other at places.
const GLASS: &str = "size 64 48
T  2 2 0.5 1 0.25 0 0   60 4 0.6 0 1 0.125 0   4 44 0.7 0 0 1 0
blend 1
T  0 0 0.3 0.5 0 1 0.5   62 9 0.5 1 0.75 0 0.5   9 46 0.6 0 0.5 1 0.5
T  0 0 0.1 1 1 1 0.5   64 0 0.1 1 1 1 0.5   0 48 0.1 1 1 1 0.5
";

/// What a command prints, run by a shell that finds the program by its name.
fn shell(folder: &Path, command: &str) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_edgewalk")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(["-c", command]).current_dir(folder).env("PATH", path).stdin(Stdio::null());
    let output = shell.output().unwrap();
    assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().or_else(|| value.as_str()?.parse().ok()).unwrap_or_else(|| panic!("{value}: no number"))
}

/// On three machines with unlike formats: what the page shows of a pixel is what its command prints, and in the table of the
/// chosen pixel machine, exact value, error and bound are those of the JSON.
#[test]
fn the_command_of_the_page_shows_its_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("it's glass.tri"), GLASS).unwrap();
    std::fs::write(at.join("my machine.toml"), "[blend]\nkind = \"interpolated\"\n").unwrap();
    let screen = ["--set", "screen.width=64", "--set", "screen.height=48"];
    let sphere = [&["sphere", "--triangles", "300"][..], &screen].concat();
    let small = ["--machine", "small", "--shading", "constant", "--set", "interpolator.adders=2"];
    let small = [&["torus", "--triangles", "900"][..], &small, &screen].concat();
    // Without its last triangle, which would change every pixel.
    let glass = ["it's glass.tri", "--triangles", "2", "--machine", "my machine.toml"];
    let (mut pixels, mut errors) = (0, 0);
    for arguments in [&sphere[..], &small, &glass] {
        assert_eq!(
            run(at, &[&["replay", "-q", "--out", "page.html"], arguments].concat()),
            (Some(0), String::new())
        );
        let machine: Vec<&str> =
            arguments.iter().copied().skip_while(|word| !["--machine", "--set"].contains(word)).collect();
        let machine: Vec<&str> =
            machine.into_iter().filter(|word| !["--shading", "constant"].contains(word)).collect();
        let precision = edgewalk(at, &[&["config", "explain", "--json"], &machine[..], &screen].concat());
        let precision: Value = serde_json::from_slice(&{ precision }.output().unwrap().stdout).unwrap();
        for seen in used(&at.join("page.html"), TEN).as_array().unwrap() {
            let command = seen["command"].as_str().unwrap();
            let [r, g, b, z] = ["r", "g", "b", "z"].map(|name| number(&seen["stored"][name]));
            let page = shell(at, command);
            let line = format!("\nthe machine stores: z {z}, rgb {r} {g} {b}, by triangle ");
            assert!(page.contains(&line), "{seen}: {page}");

            let told: Value = serde_json::from_str(&shell(at, &format!("{command} --json"))).unwrap();
            assert_eq!(seen["heads"], serde_json::json!(["", "machine", "exact", "error", "bound"]));
            let title = seen["title"].as_str().unwrap().strip_prefix("Triangle T").unwrap();
            let id: u64 = title.split(' ').next().unwrap().parse().unwrap();
            let fragments = told["fragments"].as_array().unwrap();
            let fragment = fragments.iter().find(|fragment| fragment["id"] == id).unwrap();
            let [z_max, max] = ["formats.z_bits", "formats.color_bits"].map(|key| {
                let keys = precision["keys"].as_array().unwrap().iter();
                let bits = number(&keys.into_iter().find(|of| of["key"] == key).unwrap()["value"]);
                bits.exp2() - 1.0
            });
            for row in seen["rows"].as_array().unwrap() {
                let name = row[0].as_str().unwrap();
                let [own, exact, error, bound] = [1, 2, 3, 4].map(|i| number(&row[i]));
                let place = ["r", "g", "b"].iter().position(|of| *of == name);
                let golden = match place {
                    Some(place) => number(&fragment["rgb"][place]) * max,
                    None => number(&fragment["z"]) * z_max,
                };
                // The page knows the error to 2^-10, and prints three digits.
                assert!((exact - golden).abs() < 0.0011, "{name}: {exact} for {golden}: {seen}");
                assert!((own - exact - error).abs() < 0.0011, "{name}: {seen}");
                let proved = &precision["precision"][if place.is_some() { "color" } else { "z" }]["bound"];
                assert!((bound - number(proved)).abs() < 0.0006, "{name}: {bound} for {proved}");
                assert!(error.abs() <= bound + 0.001, "{name}: {seen}");
                errors += u64::from(error.abs() > 0.1);
            }
            if id == number(&told["id"]) as u64 && seen["rows"].as_array().unwrap().len() == 4 {
                let output: Vec<f64> =
                    told["machine"]["output"].as_array().unwrap().iter().map(number).collect();
                let own: Vec<f64> =
                    seen["rows"].as_array().unwrap().iter().map(|row| number(&row[1])).collect();
                assert_eq!(own, output, "{seen}");
            }
            pixels += 1;
        }
    }
    println!("checked {pixels} / 30 pixels, {errors} errors above 0.1 LSB");
    assert!(pixels == 30 && errors > 30);
}

/// A name is text on the page, whatever stands in it.
#[test]
fn a_name_with_marks_of_html_is_shown_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let name = "a<!--<script>b\"&.tri";
    std::fs::write(folder.path().join(name), GLASS.split("blend").next().unwrap()).unwrap();
    assert_eq!(run(folder.path(), &["replay", name, "-q", "--out", "page.html"]), (Some(0), String::new()));
    let ready = r#"while (!document.body.classList.contains("ready")) await new Promise((done) => setTimeout(done, 20));
        return [document.title, document.getElementById("about").textContent];"#;
    let seen = used(&folder.path().join("page.html"), ready);
    assert!(seen[0] == format!("{name}, edgewalk replay"), "{seen}");
    assert!(seen[1].as_str().unwrap().starts_with(&format!("{name} \u{b7} 1 triangle ")), "{seen}");
}

/// The polygon of the slides, a pixel to one of theirs; with a hole behind it.
const POLYGONS: &str = "size 16 12
P 6  2 3 0.5 1 0 0 0  7 1 0.5 1 0 0 0  13 5 0.5 1 0 0 0  13 11 0.5 1 0 0 0  7 7 0.5 1 0 0 0  2 9 0.5 1 0 0 0
P 4  1 1 0.4 0 1 0 0  15 1 0.4 0 1 0 0  15 11 0.4 0 1 0 0  1 11 0.4 0 1 0 0
H 3  4 4 0.4 0 1 0 0  12 4 0.4 0 1 0 0  8 9 0.4 0 1 0 0
";

/// Of each polygon the pairs that wait for MOVER, by line; and what the page says of one of them.
const PAIRS: &str = r##"
while (!document.body.classList.contains("ready")) await new Promise((done) => setTimeout(done, 20));
const poly = app.doc.units.find((unit) => unit.name === "poly");
const registers = poly.items.map((item) => app.doc.registers[item.register]).filter((register) => register);
const at = (name, cycle) => rawAt(registers.find((register) => register.name === name), cycle);
const polygons = [];
let before = 0, said = null;
for (let cycle = 0; cycle < app.doc.cycles; cycle++) {
  const run = at("run", cycle);
  if (run && !before) polygons.push({});
  before = run;
  if (!at("pair", cycle)) continue;
  const [line, left, right] = ["pair_y", "pair_left", "pair_right"].map((name) => at(name, cycle));
  if (left >= right) continue;
  const pairs = (polygons.at(-1)[line] ??= []);
  if (!pairs.some((pair) => pair[0] === left)) pairs.push([left, right]);
  if (line === 8 && said === null) {
    app.go(cycle);
    said = [left, right, document.getElementById("says").textContent, document.getElementById("cards").textContent];
  }
}
return { polygons, said };
"##;

#[test]
fn pairs_of_the_page_are_those_explained() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("p.tri"), POLYGONS).unwrap();
    let machine = ["--machine", "polygon"];
    let arguments = [&["replay", "p.tri", "-q", "--out", "page.html"], &machine[..]].concat();
    assert_eq!(run(at, &arguments), (Some(0), String::new()));
    let seen = used(&at.join("page.html"), PAIRS);
    let mut compared = 0;
    for line in (0..12).map(|line: u32| line.to_string()) {
        let explain = [&["explain", "p.tri", "0", &line, "--json"], &machine[..]].concat();
        let page: Value = serde_json::from_slice(&edgewalk(at, &explain).output().unwrap().stdout).unwrap();
        for polygon in page["poly"].as_array().into_iter().flatten() {
            let id = number(&polygon["id"]) as usize;
            let shown = &seen["polygons"][id][&line];
            let pairs = polygon["pairs"].as_array().unwrap();
            assert_eq!(shown.as_array().map_or(&[][..], Vec::as_slice), pairs, "polygon {id}, line {line}");
            compared += pairs.len();
        }
    }
    assert_eq!(compared, (10 + 2) + (10 + 5), "spans of both polygons");
    let [left, right] = [0, 1].map(|place| number(&seen["said"][place]));
    let [says, cards] = [2, 3].map(|place| seen["said"][place].as_str().unwrap());
    assert!(says.contains(&format!("pair {left} to {right} of line 8 waits for MOVER")), "{says}");
    for part in ["active edges of line y", "edges that enter next", "pair left", "values, LSBVDd0"] {
        assert!(cards.contains(part), "{part}: {cards}");
    }
}
