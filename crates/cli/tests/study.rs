//! The tables of `docs/study.md` are those of the data kept beside it; `EDGEWALK_BLESS=1` writes them.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod features;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

fn docs() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

/// A line of a table by the names of its columns.
type Row = BTreeMap<String, String>;

/// A table that `sweep` wrote; a field in quotes may have commas.
fn rows(name: &str) -> Vec<Row> {
    let text = std::fs::read_to_string(docs().join("study").join(format!("{name}.csv"))).unwrap();
    let mut lines = text.lines().map(|line| {
        let mut fields = vec![String::new()];
        let mut quoted = false;
        for c in line.chars() {
            match c {
                '"' => quoted = !quoted,
                ',' if !quoted => fields.push(String::new()),
                c => fields.last_mut().unwrap().push(c),
            }
        }
        fields
    });
    let header = lines.next().unwrap();
    let rows: Vec<Row> = lines.map(|fields| header.iter().cloned().zip(fields).collect()).collect();
    assert!(
        !rows.is_empty() && rows.iter().all(|row| row["status"] == "ok" && row.len() == header.len()),
        "{name}"
    );
    rows
}

fn number(row: &Row, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name} = {}", row[name]))
}

/// Values of a column in their order, numbers as numbers.
fn values(rows: &[Row], name: &str) -> Vec<String> {
    let seen: BTreeSet<&String> = rows.iter().map(|row| &row[name]).collect();
    let mut list: Vec<String> = seen.into_iter().cloned().collect();
    list.sort_by_key(|value| value.parse::<u32>().unwrap_or(0));
    list
}

/// The sum of a column over the rows that have these values.
fn sum(rows: &[Row], of: &[(&str, &str)], name: &str) -> f64 {
    let rows: Vec<&Row> =
        rows.iter().filter(|row| of.iter().all(|(key, value)| row[*key] == *value)).collect();
    assert!(!rows.is_empty(), "{of:?}");
    rows.iter().map(|row| number(row, name)).sum()
}

fn line(cells: impl IntoIterator<Item = String>) -> String {
    format!("| {} |\n", cells.into_iter().collect::<Vec<_>>().join(" | "))
}

fn table(header: impl IntoIterator<Item = String>, body: impl IntoIterator<Item = Vec<String>>) -> String {
    let header: Vec<String> = header.into_iter().collect();
    let rule = line(header.iter().map(|_| "---".to_owned()));
    line(header) + &rule + &body.into_iter().map(line).collect::<String>()
}

const SCENES: [&str; 3] = ["torus-knot", "sphere", "room"];

/// Largest error and bound of each scene over the fraction bits of a channel.
fn bits(name: &str, key: &str, channel: &str) -> String {
    let rows = rows(name);
    let header = ["bits".to_owned()].into_iter().chain(SCENES.map(|scene| format!("{scene}: error, bound")));
    let body = values(&rows, key).into_iter().map(|bits| {
        let of = |scene: &str| {
            let row = rows.iter().find(|row| row["input"] == scene && row[key] == bits).unwrap();
            let bound = &row[&format!("{channel}_bound_for_input")];
            let bound =
                bound.parse::<f64>().map_or_else(|_| "none".to_owned(), |bound| format!("{bound:.3}"));
            format!("{:.3}, {bound}", number(row, &format!("{channel}_error")))
        };
        [bits.clone()].into_iter().chain(SCENES.map(of)).collect()
    });
    table(header, body.collect::<Vec<_>>())
}

/// Cycles and SETUP's share over adders and lanes.
fn organisation() -> String {
    let rows = rows("organisation");
    let header = ["adders", "lanes"]
        .map(str::to_owned)
        .into_iter()
        .chain(SCENES.map(|scene| format!("{scene}: cycles, setup")));
    let mut body = Vec::new();
    for adders in values(&rows, "interpolator.adders") {
        for lanes in values(&rows, "setup.lanes") {
            let of = |scene: &str| {
                let at = [("input", scene), ("interpolator.adders", &*adders), ("setup.lanes", &*lanes)];
                let cycles = sum(&rows, &at, "cycles");
                format!("{cycles}, {:.0} %", 100.0 * sum(&rows, &at, "cycles_setup") / cycles)
            };
            body.push([adders.clone(), lanes.clone()].into_iter().chain(SCENES.map(of)).collect());
        }
    }
    table(header, body)
}

/// Cycles of all scenes over queue, policy, latency; and over the span FIFO.
fn waiting() -> String {
    let rows = rows("waiting");
    let depths = values(&rows, "fifo.inflight");
    let header = ["latency".to_owned(), "hazard".to_owned()].into_iter();
    let header = header.chain(depths.iter().map(|depth| format!("{depth} in flight")));
    let mut body = Vec::new();
    for latency in values(&rows, "memory.latency") {
        for hazard in ["drain", "interlock", "forward"] {
            let of = |depth: &String| {
                let at = [
                    ("memory.latency", &*latency),
                    ("memory.hazard", hazard),
                    ("fifo.inflight", depth),
                    ("fifo.span", "2"),
                ];
                format!("{:.3} M", sum(&rows, &at, "cycles") / 1e6)
            };
            body.push(
                [latency.clone(), hazard.to_owned()].into_iter().chain(depths.iter().map(of)).collect(),
            );
        }
    }
    let spans = values(&rows, "fifo.span").into_iter().map(|spans| {
        let at = [
            ("memory.latency", "2"),
            ("memory.hazard", "forward"),
            ("fifo.inflight", "4"),
            ("fifo.span", &*spans),
        ];
        vec![spans.clone(), format!("{:.3} M", sum(&rows, &at, "cycles") / 1e6)]
    });
    let spans = table(["spans in the FIFO".to_owned(), "cycles".to_owned()], spans.collect::<Vec<_>>());
    table(header, body) + "\n" + &spans
}

/// Cycles of all scenes and the memory's share over kinds of memories.
fn memories() -> String {
    let rows = rows("memories");
    let depths = values(&rows, "fifo.inflight");
    let header = ["stalls".to_owned(), "adders".to_owned()].into_iter();
    let header = header.chain(depths.iter().map(|depth| format!("{depth} in flight: cycles, memory")));
    let mut body = Vec::new();
    for stalls in values(&rows, "stalls") {
        for adders in values(&rows, "interpolator.adders") {
            let of = |depth: &String| {
                let at = [("stalls", &*stalls), ("interpolator.adders", &*adders), ("fifo.inflight", depth)];
                let cycles = sum(&rows, &at, "cycles");
                format!("{:.3} M, {:.0} %", cycles / 1e6, 100.0 * sum(&rows, &at, "cycles_memory") / cycles)
            };
            body.push(
                [format!("`{stalls}`"), adders.clone()].into_iter().chain(depths.iter().map(of)).collect(),
            );
        }
    }
    table(header, body)
}

/// SETUP's clocks a triangle that is not culled, by lanes: mean, 95 % at most, most.
fn setup() -> String {
    let rows = rows("organisation");
    let header = ["lanes".to_owned()].into_iter();
    let header = header.chain(SCENES.map(|scene| format!("{scene}: mean, 95 %, most")));
    let body = values(&rows, "setup.lanes").into_iter().map(|lanes| {
        let of = |scene: &str| {
            let at = [("input", scene), ("interpolator.adders", "4"), ("setup.lanes", &*lanes)];
            let [mean, p95, most] =
                ["setup_mean", "setup_p95", "setup_most"].map(|name| sum(&rows, &at, name));
            format!("{mean:.1}, {p95}, {most}")
        };
        [lanes.clone()].into_iter().chain(SCENES.map(of)).collect()
    });
    table(header, body.collect::<Vec<_>>())
}

/// Which SETUP for which mesh: clocks a triangle, milliseconds a frame and triangles a second at the placed clock.
fn kinds(name: &str) -> String {
    let rows = rows(name);
    let header = ["kind", "lanes", "LUT4", "MHz, median (range)"].map(str::to_owned).into_iter();
    let header = header
        .chain(SCENES.map(|scene| format!("{scene}: clocks a triangle, ms, million triangles a second")));
    let mut body = Vec::new();
    for kind in values(&rows, "setup.kind") {
        for lanes in values(&rows, "setup.lanes") {
            let at = |scene: &str| {
                let is = |row: &&Row| {
                    (&*row["input"], &row["setup.kind"], &row["setup.lanes"]) == (scene, &kind, &lanes)
                };
                rows.iter().find(is).unwrap_or_else(|| panic!("{scene}, {kind}, {lanes}"))
            };
            let of = |scene: &str| {
                let row = at(scene);
                let mean = format!("{:.1}", number(row, "setup_mean"));
                match row["mhz_median"].parse::<f64>() {
                    Ok(mhz) => {
                        let seconds = number(row, "cycles") / (mhz * 1e6);
                        let rate = number(row, "triangles") / seconds / 1e6;
                        format!("{mean}, {:.2}, {rate:.3}", seconds * 1e3)
                    }
                    Err(_) => mean,
                }
            };
            let first = at(SCENES[0]);
            let figures = [kind.clone(), lanes.clone(), first["lut4"].clone(), placed(first)];
            body.push(figures.into_iter().chain(SCENES.map(of)).collect());
        }
    }
    table(header, body)
}

/// What tells the machines of [`kinds_by_format`] apart.
const KEYS_OF_FRONT: [&str; 3] = ["setup.kind", "setup.lanes", "formats.z_bits"];

/// Kinds and lanes of SETUP by bits of z. The last column names the scenes on whose front of look-up tables and time the
/// machine lies, among the machines of the same bits.
fn kinds_by_format(name: &str) -> String {
    let rows = rows(name);
    let machine = |row: &Row| KEYS_OF_FRONT.map(|key| row[key].clone());
    // None where the device has no place for the machine.
    let us = |row: &Row| row["mhz_median"].parse::<f64>().ok().map(|mhz| number(row, "cycles") / mhz);
    let beats = |other: &Row, row: &Row| {
        let rivals = ["input", "formats.z_bits"].iter().all(|key| row[*key] == other[*key]);
        let (Some(its), Some(own)) = (us(other), us(row)) else { return false };
        let tables = [other, row].map(|row| number(row, "lut4"));
        rivals && its <= own && tables[0] <= tables[1] && (its, tables[0]) != (own, tables[1])
    };
    let on_front = |row: &Row| us(row).is_some() && !rows.iter().any(|other| beats(other, row));
    let figures = ["kind", "lanes", "bits of z", "LUT4", "MHz"].map(str::to_owned).into_iter();
    let header = figures.chain(SCENES.map(|scene| format!("{scene}, us"))).chain(["front of".to_owned()]);
    let body = rows.iter().filter(|row| row["input"] == SCENES[0]).map(|first| {
        let at = |scene: &str| {
            let is = |row: &&Row| row["input"] == scene && machine(row) == machine(first);
            rows.iter().find(is).unwrap_or_else(|| panic!("{scene}, {:?}", machine(first)))
        };
        let clock = first["mhz_median"].parse::<f64>().map_or("-".to_owned(), |mhz| format!("{mhz:.1}"));
        let times = SCENES.map(|scene| us(at(scene)).map_or("-".to_owned(), |us| format!("{us:.0}")));
        let fronts: Vec<&str> = SCENES.into_iter().filter(|scene| on_front(at(scene))).collect();
        let figures = machine(first).into_iter().chain([first["lut4"].clone(), clock]);
        figures.chain(times).chain([fronts.join(", ")]).collect()
    });
    table(header, body.collect::<Vec<_>>())
}

/// The clock over the seeds.
fn placed(row: &Row) -> String {
    match row["mhz_median"].parse::<f64>() {
        Ok(mhz) => format!("{mhz:.1} ({:.1} to {:.1})", number(row, "mhz_min"), number(row, "mhz_max")),
        Err(_) => "null".to_owned(),
    }
}

/// Cells and clock of a unit.
fn cells(name: &str, keys: &[(&str, &str)]) -> String {
    let rows = rows(name);
    let figures = ["LUT4", "carry", "flip-flops", "MHz, median (range)", "why not"].map(str::to_owned);
    let header = keys.iter().map(|key| key.1.to_owned()).chain(figures);
    let body = rows.iter().map(|row| {
        let values = keys.iter().map(|key| row[key.0].clone());
        let counts = ["lut4", "carry", "ff"].map(|name| row[name].clone());
        values.chain(counts).chain([placed(row), row["synth_reasons"].clone()]).collect()
    });
    table(header, body.collect::<Vec<_>>())
}

#[test]
fn the_tables_are_those_of_the_data() {
    let path = docs().join("study.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let tables = [
        ("depth_bits", bits("depth_bits", "formats.z_fraction", "z")),
        ("color_bits", bits("color_bits", "formats.color_fraction", "color")),
        ("organisation", organisation()),
        ("waiting", waiting()),
        ("memories", memories()),
        (
            "pixel_cells",
            cells("pixel_cells", &[("interpolator.adders", "adders"), ("interpolator.segments", "segments")]),
        ),
        ("setup", setup()),
        ("setup_kinds", kinds("setup_kinds")),
        ("setup_front", kinds_by_format("setup_front")),
        (
            "setup_cells",
            cells("setup_cells", &[("setup.lanes", "lanes"), ("cycles", "cycles of torus-knot")]),
        ),
        ("depth_cells", cells("depth_cells", &[("memory.hazard", "hazard"), ("fifo.inflight", "in flight")])),
        ("span_cells", cells("span_cells", &[("fifo.span", "spans in the FIFO")])),
        ("word_cells", cells("word_cells", &[("formats.color_fraction", "bits of a colour")])),
        ("features", features::features()),
        ("features_on_meshes", features::features_on_meshes()),
        ("fits", features::fits()),
    ];
    let mut written = text.clone();
    let mut lines = 0;
    for (name, table) in &tables {
        let (start, end) = (format!("<!-- {name} -->\n"), "<!-- end -->");
        let from = written.find(&start).unwrap_or_else(|| panic!("no {start}")) + start.len();
        let to = from + written[from..].find(end).unwrap();
        written.replace_range(from..to, table);
        lines += table.lines().count();
    }
    if std::env::var_os("EDGEWALK_BLESS").is_some() {
        std::fs::write(&path, &written).unwrap();
    }
    println!("checked {lines} lines in {} tables", tables.len());
    assert!(
        lines > 60 && (written == text || std::env::var_os("EDGEWALK_BLESS").is_some()),
        "docs/study.md is out of date: docs/study/run"
    );
}
