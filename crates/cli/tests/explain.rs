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
    // Whole LSB at whole pixels: the port rounds nothing. Depth begins in the upper half of its range, red in the lower.
    let [z, red] = [[9_000_000.0, 1_000_000.0, 4_000_000.0], [20.0, 250.0, 99.0]];
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

/// Each figure of the page beside its JSON, on a machine whose depth, colours and own channels have unlike formats, so that every
/// bound differs from the others.
#[test]
fn every_figure_of_the_page_is_that_of_the_json() {
    let folder = tempfile::tempdir().expect("a folder");
    let triangle = "size 64 48\nextra 2\n\
        T 2 1 0.25 0.9 0.1 0.3 0  61 5 0.5 0.2 0.8 0.4 0  9 46 0.75 0.4 0.6 1 0\nX -30 0.25 0 1 200.5 0.5\n\
        T 0 0 0.9 0.1 0.2 0.3 0  60 0 0.9 0.1 0.2 0.3 0  0 40 0.9 0.1 0.2 0.3 0\nX 1 1 1 1 1 1\n";
    std::fs::write(folder.path().join("a.tri"), triangle).expect("written");
    let keys = "formats.z_bits=20 formats.z_fraction=11 formats.z_vertex=3 formats.color_bits=6 formats.color_fraction=9 \
        formats.color_vertex=2 screen.guard_bits=6 channels.extra=2 channels.e0_kind=signed channels.e0_bits=9 \
        channels.e0_fraction=13 channels.e1_kind=unorm channels.e1_bits=10 channels.e1_fraction=8";
    let keys: Vec<&str> = keys.split_whitespace().flat_map(|key| ["--set", key]).collect();
    let run = |more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
            .args([&["explain", "a.tri", "28", "14"], &keys[..], more].concat())
            .current_dir(folder.path())
            .output()
            .expect("the program runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    };
    let told: Value = serde_json::from_str(&run(&["--json"])).expect("one JSON value");
    let page = run(&[]);
    let mut lines = page.lines();
    let three =
        |list: &Value| numbers(list).iter().map(|value| format!("{value:8.5}")).collect::<Vec<_>>().join(" ");
    let own = |list: &Value| -> String {
        numbers(list).iter().enumerate().map(|(i, value)| format!(", e{i} {value:.6}")).collect()
    };
    let z = |of: &Value| of["z"].as_f64().expect("z");
    let first =
        format!("pixel (28, 14): z {:.9}, rgb {}{}", z(&told), three(&told["rgb"]), own(&told["extra"]));
    assert_eq!(lines.next(), Some(&*first));
    let stored = &told["stored"];
    let [r, g, b] = [0, 1, 2].map(|i| stored["rgb"][i].as_u64().expect("a colour"));
    let second =
        format!("the machine stores: z {}, rgb {r} {g} {b}, by triangle {}", stored["z"], stored["id"]);
    assert_eq!(lines.next(), Some(&*second));
    let fragments = told["fragments"].as_array().expect("fragments");
    assert_eq!((lines.next(), fragments.len()), (Some("triangles over it: 2"), 2));
    for of in fragments {
        let seen = if of["id"] == told["id"] { "  seen" } else { "" };
        let id = of["id"].as_u64().expect("an id");
        let line = format!("  {id:>6}  z {:.9}  rgb {}{}{seen}", z(of), three(&of["rgb"]), own(&of["extra"]));
        assert_eq!(lines.next(), Some(&*line));
    }
    // The tables of additions: all but the middle, value, addition, error and bound of the channel.
    let additions = told["machine"]["additions"].as_array().expect("additions");
    let (count, mut bounds, mut rows) = (additions.len(), Vec::new(), 0);
    assert!(count > 16, "{count} additions: the middle is left out");
    let mut tables = Vec::new();
    for (channel, name) in ["z", "r", "g", "b", "e0", "e1"].iter().enumerate() {
        let last = numbers(&additions[count - 1]["bound"])[channel];
        if ["z", "r", "e0", "e1"].contains(name) {
            assert!(!bounds.contains(&last), "{name}: bounds that are told apart");
            bounds.push(last);
        }
        let shown = additions[..8].iter().chain(&additions[count - 8..]);
        let cells = shown.map(|of| {
            let [value, added, error, bound] =
                ["value", "added", "error", "bound"].map(|key| numbers(&of[key])[channel]);
            let [x, y] = ["x", "y"].map(|key| of[key].as_i64().expect("a place"));
            let place = format!("({x}, {y})");
            let start = format!("  {:<6}  {place:<13} ", of["step"].as_str().expect("a step"));
            (start, format!("{value:>12.3}  {added:>12.4}"), format!("{error:>10.6}  {bound:>8.6}"))
        });
        tables.push(cells.collect::<Vec<_>>());
    }
    let found: Vec<&str> = lines.collect();
    let mut wanted: Vec<String> = (0..16)
        .map(|i| format!("{}{}  {}  {}", tables[0][i].0, tables[0][i].1, tables[0][i].2, tables[1][i].2))
        .collect();
    for own in [4, 5] {
        wanted.extend(
            (0..16).map(|i| format!("{}{}  {}", tables[own][i].0, tables[own][i].1, tables[own][i].2)),
        );
    }
    let mut place = 0;
    for line in &wanted {
        let at = found[place..].iter().position(|of| of == line);
        place += at.unwrap_or_else(|| panic!("`{line}` is missing or out of order:\n{page}")) + 1;
        rows += 1;
    }
    let heads = found.iter().filter(|line| line.starts_with('e')).count();
    let outputs = told["machine"]["output"].as_array().expect("outputs");
    for (name, place) in [("e0: ", 4), ("e1: ", 5)] {
        let line = found.iter().find(|line| line.starts_with(name)).expect("a table of its own");
        assert!(line.ends_with(&format!("; output {}", outputs[place])), "{line}");
    }
    println!("checked {rows} rows, bounds {bounds:?}");
    assert_eq!((rows, heads), (48, 2));
}

/// Line 100 of the lecture's polygon crosses two edges; line 48 is the Ymax of B-A, where A-F enters.
#[test]
fn polygons_show_their_edge_table_and_active_edges() {
    let on = |y| explain("docs/scenes/polygon.tri", 100, y)["polygons"][0].clone();
    let middle = on(100);
    assert!(middle["table"].as_str().expect("a table").starts_with("bucket  edge"), "{middle}");
    let active = middle["active"].as_array().expect("a list");
    let edges: Vec<_> =
        active.iter().map(|edge| (edge["edge"].as_str().expect("a name"), numbers_of(edge))).collect();
    assert_eq!(edges, [("A-F", [32.0, 32.0, 44.0]), ("C-D", [208.0, 208.0, 76.0])], "{middle}");
    assert_eq!(middle["span"], serde_json::json!([32, 208]));
    let at_a = on(48);
    assert_eq!(
        (&at_a["enters"], &at_a["left"]),
        (&serde_json::json!(["A-F"]), &serde_json::json!(["B-A"])),
        "{at_a}"
    );
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .args(["explain", "docs/scenes/polygon.tri", "100", "100"])
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .output()
        .expect("the program runs");
    let said = String::from_utf8_lossy(&output.stdout);
    for wanted in
        ["polygon 0: its edge table", "active edges on line 100", "pixel 100 lies in the span 32..208"]
    {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
}

/// x, column and lines left of an active edge.
fn numbers_of(edge: &Value) -> [f64; 3] {
    ["x", "column", "lines_left"].map(|key| edge[key].as_f64().expect("a number"))
}

/// The triangle that the machine stores is in the list, whatever the fill rule; where the additions are missing the page says why.
#[test]
fn the_triangle_that_is_seen_is_in_the_list_by_every_fill_rule() {
    let mut checked = 0;
    for (asked, key) in [
        (&["--set", "edge.kind=exact"][..], None),
        (&["--machine", "textbook"], Some("edge.fill = exact")),
        (&["--set", "edge.kind=slope"], Some("edge.kind = exact")),
        (&["--machine", "polygon"], Some("polygon.edges = 0")),
    ] {
        for (x, y) in [("32", "24"), ("20", "30"), ("41", "11")] {
            let run = |more: &[&str]| {
                let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
                    .args(["explain", "torus", x, y, "--set", "screen.width=64", "--set", "screen.height=48"])
                    .args(asked)
                    .args(more)
                    .output()
                    .expect("the program runs");
                assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
                String::from_utf8(output.stdout).expect("text")
            };
            let told: Value = serde_json::from_str(&run(&["--json"])).expect("one JSON value");
            let page = run(&[]);
            let id = told["stored"]["id"].as_i64().expect("an id");
            let listed = told["fragments"].as_array().expect("fragments");
            let seen = listed.iter().filter(|over| over["id"] == id && over["z"] == told["z"]).count();
            assert_eq!(seen, usize::from(id >= 0), "{asked:?} {x} {y}: {told}");
            assert_eq!(page.matches("  seen\n").count(), seen, "{page}");
            assert_eq!(told["light"].is_object(), id >= 0, "{told}");
            let reason = told["no_additions"].as_str();
            assert_eq!(reason.is_some(), id >= 0 && key.is_some(), "{told}");
            assert_eq!(told["machine"].is_object(), id >= 0 && key.is_none(), "{told}");
            if let (Some(reason), Some(key)) = (reason, key) {
                assert!(
                    reason.contains(key) && page.ends_with(&format!("no additions: {reason}\n")),
                    "{page}"
                );
            }
            checked += seen;
        }
    }
    assert!(checked >= 8, "checked {checked} pixels");
}

/// A light's map has the number of the light that the triangle is drawn under, in a file and in a scene.
#[test]
fn maps_have_the_numbers_of_their_lights() {
    let folder = tempfile::tempdir().expect("a folder");
    let shadow =
        "shadow 8 0.001 0.25   1 0 0 0   0 1 0 0   0 0 1 0   0 0 0 1\nL  3 3 0.25   7 0 0.25   0 7 0.25\n";
    let triangle = |x: u32| format!("T  {x} 0 0.5 1 1 1 0   {0} 0 0.5 1 1 1 0   {x} 8 0.5 1 1 1 0\n", x + 8);
    let (first, second) = (triangle(0), triangle(8));
    let text = format!("size 16 12\n{shadow}{shadow}{first}light 2\n{second}");
    std::fs::write(folder.path().join("a.tri"), text).expect("written");
    let run = |x: &str, more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
            .args(["explain", "a.tri", x, "1", "--adapt"])
            .args(more)
            .current_dir(folder.path())
            .output()
            .expect("the program runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    };
    for (x, light) in [("1", 1), ("9", 2)] {
        let told: Value = serde_json::from_str(&run(x, &["--json"])).expect("one JSON value");
        let lights: Vec<_> =
            told["shadows"].as_array().expect("maps").iter().map(|map| &map["light"]).collect();
        assert_eq!((lights, &told["version"]), (vec![&light.into()], &serde_json::json!([1, 2])), "{told}");
        let page = run(x, &[]);
        assert!(page.contains(&format!("\nlight {light}'s map:")), "{page}");
    }
}
