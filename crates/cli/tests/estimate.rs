//! `edgewalk estimate`: its counts beside the measured ones, the table of errors in the page, and its error messages.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{edgewalk, ended, run};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../synth/data").join(name)
}

/// What `estimate --json` says of these machines, in their order.
fn estimates(words: &[&str]) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let output = edgewalk(folder.path(), &[&["estimate", "--json"][..], words].concat()).output().unwrap();
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["format"], "edgewalk-estimate");
    document["machines"].as_array().unwrap().clone()
}

/// A row of the table of a family beside the estimate of the same machine today.
struct Beside {
    held_out: bool,
    lut4: f64,
    exact: [u64; 4],
    packed: Option<f64>,
    mhz: Option<f64>,
    sequenced: bool,
    estimate: Value,
}

/// The whole machines of the table whose netlists are as they were.
fn beside(family: &str) -> (Vec<Beside>, usize) {
    let table = std::fs::read_to_string(data(&format!("{family}.csv"))).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let rows: Vec<Vec<&str>> = rows.into_iter().filter(|row| row[1] == "machine").collect();
    let names: Vec<String> = rows.iter().map(|row| row[0].replace(' ', ",")).collect();
    let words = ["--family", family].into_iter().chain(names.iter().map(String::as_str));
    let found = estimates(&words.collect::<Vec<_>>());
    let all = rows.len();
    let beside: Vec<Beside> = rows
        .iter()
        .zip(found)
        .filter(|(row, estimate)| estimate["shape"] == row[2])
        .map(|(row, estimate)| Beside {
            held_out: row[3] == "yes",
            lut4: row[4].parse().unwrap(),
            exact: [5, 6, 7, 8].map(|field: usize| row[field].parse().unwrap()),
            packed: row[9].parse().ok(),
            mhz: row[10].parse().ok(),
            sequenced: row[0].contains("sequenced") || row[0].contains("hx8k") || row[0].contains("up5k"),
            estimate,
        })
        .collect();
    let stale = all - beside.len();
    (beside, stale)
}

fn exact(estimate: &Value) -> [u64; 4] {
    ["est_carry", "est_ff", "est_ram", "est_dsp"].map(|figure| estimate[figure].as_u64().unwrap())
}

fn off(estimate: &Value, figure: &str, measured: f64) -> f64 {
    (estimate[figure]["value"].as_f64().unwrap() / measured - 1.0).abs()
}

/// The lines of docs/estimate.md that tell how far the estimates of the measured machines are off.
fn lines(family: &str, beside: &[Beside]) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, held_out) in [("held out", true), ("fitted to", false)] {
        let rows: Vec<&Beside> = beside.iter().filter(|row| row.held_out == held_out).collect();
        let equal = |at: usize| rows.iter().filter(|row| exact(&row.estimate)[at] == row.exact[at]).count();
        let spread = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            match values.last() {
                Some(most) => {
                    format!("{:.1}, {:.1} ({})", 100.0 * values[values.len() / 2], 100.0 * most, values.len())
                }
                None => "none".to_owned(),
            }
        };
        let lut4 = rows.iter().map(|row| off(&row.estimate, "est_lut4", row.lut4)).collect();
        let cells =
            rows.iter().filter_map(|row| Some(off(&row.estimate, "est_cells", row.packed?))).collect();
        let mhz = rows.iter().filter_map(|row| Some(off(&row.estimate, "est_mhz", row.mhz?))).collect();
        let of = rows.len();
        lines.push(format!(
            "| {family}, {name} | {of} | {} | {} | {} | {} | {} | {} | {} |",
            equal(1),
            equal(0),
            equal(2),
            equal(3),
            spread(lut4),
            spread(cells),
            spread(mhz)
        ));
    }
    lines
}

#[test]
fn the_page_tells_the_errors_of_measured_machines() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/estimate.md");
    let page = std::fs::read_to_string(page).unwrap();
    let page = page.replace('\n', " ");
    // Family, its name in the page, the largest error of LUT4, the words before the largest error of carry cells.
    for (family, name, most_lut4, words) in [
        ("ice40", "iCE40", 0.05, "an iCE40 are not equal, they are off by at most "),
        ("ecp5", "ECP5", 0.18, "Those of an ECP5 are off by at most "),
    ] {
        let (beside, stale) = beside(family);
        println!("checked {} machines of {family}", beside.len());
        assert!(beside.len() > 20, "{family}: {} machines", beside.len());
        assert_eq!(
            stale, 0,
            "{family}: rows of netlists that have changed: take them out, then run `edgewalk calibrate --count N`"
        );
        for line in lines(name, &beside) {
            assert!(page.contains(&line), "docs/estimate.md has no line\n{line}");
        }
        let mut most = 0;
        for row in &beside {
            let estimate = &row.estimate;
            let of_lut4 = off(estimate, "est_lut4", row.lut4);
            // The page: with a parallel SETUP all tables of an ECP5 are within 9 %.
            let most_lut4 = if row.sequenced { most_lut4 } else { f64::min(most_lut4, 0.09) };
            assert!(of_lut4 < most_lut4, "{}: LUT4 off by {of_lut4:.3}", estimate["name"]);
            let [carry, ff, ram, dsp] = [0, 1, 2, 3].map(|at| exact(estimate)[at].abs_diff(row.exact[at]));
            assert_eq!([ff, ram, dsp], [0; 3], "{}: off by {ff} FF, {ram} RAM, {dsp} DSP", estimate["name"]);
            most = most.max(carry);
        }
        let (_, told) = page.split_once(words).expect("the page tells how far carry cells are off");
        let told: u64 = told[..told.find('.').unwrap()].parse().unwrap();
        assert_eq!(most, told, "{family}: carry cells off, and what the page tells");
    }
}

/// By machine of the table of standard cells: whether it is held out, its flip-flops and its area, um2.
fn in_standard_cells() -> BTreeMap<String, (bool, u64, f64)> {
    let table = std::fs::read_to_string(data("osu018.csv")).unwrap();
    let mut machines = BTreeMap::new();
    for row in table.lines().skip(1) {
        let fields: Vec<&str> = row.split(',').collect();
        let of: &mut (bool, u64, f64) =
            machines.entry(fields[0].replace(' ', ",")).or_insert((fields[2] == "yes", 0, 0.0));
        of.1 += fields[4].parse::<u64>().unwrap();
        of.2 += fields[5].parse::<f64>().unwrap();
    }
    machines
}

#[test]
fn the_page_tells_the_errors_in_standard_cells() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/estimate.md");
    let page = std::fs::read_to_string(page).unwrap();
    let measured = in_standard_cells();
    let names = ["--family", "osu018"].into_iter().chain(measured.keys().map(String::as_str));
    let estimates = estimates(&names.collect::<Vec<_>>());
    for (name, held_out) in [("held out", true), ("fitted to", false)] {
        let rows = measured.values().zip(&estimates).filter(|(of, _)| of.0 == held_out);
        let (mut equal, mut off) = (0, Vec::new());
        for ((_, ff, area), estimate) in rows {
            equal += usize::from(estimate["est_ff"] == *ff);
            off.push((estimate["est_kge"]["value"].as_f64().unwrap() * 24_000.0 / area - 1.0).abs());
        }
        off.sort_by(f64::total_cmp);
        let (count, most) = (off.len(), off.last().unwrap());
        println!("checked {count} machines, {name}");
        assert!(count > 10 && *most < 0.15, "{name}: {count} machines, area off by {most}");
        let line =
            format!("| {name} | {count} | {equal} | {:.1}, {:.1} |", 100.0 * off[count / 2], 100.0 * most);
        assert!(page.contains(&line), "docs/estimate.md has no line\n{line}");
    }
}

#[test]
fn the_fit_follows_from_the_table() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(data("machines.txt"), folder.path().join("machines.txt")).unwrap();
    for family in ["ice40", "ecp5", "osu018"] {
        let table = format!("{family}.csv");
        std::fs::copy(data(&table), folder.path().join(&table)).unwrap();
        let words = ["calibrate", "--family", family, "--machines", "machines.txt", "--data", &table];
        let words = [&words[..], &["--fit", "fit.json", "--json"]].concat();
        // A fit alone takes no cache, and so no home.
        let output =
            edgewalk(folder.path(), &words).env_remove("HOME").env_remove("XDG_CACHE_HOME").output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(report["stale"], 0, "rows of netlists that have changed");
        let [own, kept] = [folder.path().join("fit.json"), data(&format!("{family}.json"))]
            .map(|path| std::fs::read_to_string(path).unwrap());
        assert_eq!(own, kept, "run `edgewalk calibrate --family {family}`");
        assert!(report["rows"].as_u64() > Some(10));
    }
    // A table that is none is refused, and nothing is written.
    for (table, why) in
        [("nonsense", "line 1: found `nonsense`"), ("machine,part\n", "line 1: found `machine,part`")]
    {
        std::fs::write(folder.path().join("bad.csv"), table).unwrap();
        let (code, said) = run(
            folder.path(),
            &["calibrate", "--machines", "machines.txt", "--data", "bad.csv", "--fit", "none.json"],
        );
        assert!(code == Some(2) && said.contains(why), "{said}");
    }
    assert!(!folder.path().join("none.json").exists());
}

/// A fit takes rows of one family, of which some are held out, and replaces no file that it is made of.
#[test]
fn a_fit_of_another_table_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("machines.txt"), "default\n").unwrap();
    std::fs::copy(data("ice40.csv"), at("ice40.csv")).unwrap();
    std::fs::copy(data("ecp5.csv"), at("ecp5.csv")).unwrap();
    let part = |from: &str, to: &str, wanted: &dyn Fn(&str) -> bool| {
        let table = std::fs::read_to_string(data(from)).unwrap();
        let rows = table.lines().enumerate().filter(|(at, row)| *at == 0 || wanted(row)).take(5);
        std::fs::write(at(to), rows.map(|(_, row)| format!("{row}\n")).collect::<String>()).unwrap();
    };
    part("ice40.csv", "fitted.csv", &|row| row.contains(",no,"));
    part("ice40.csv", "held.csv", &|row| row.contains(",yes,"));
    part("osu018.csv", "cells.csv", &|row| row.contains(",no,"));
    std::fs::write(at("fit.json"), "the fit of another family").unwrap();
    let cases: [(&str, &str, &str, &str); 8] = [
        ("ice40", "ecp5.csv", "fit.json", "ecp5.csv: the row of default, machine, is of the family ecp5: "),
        ("ecp5", "ice40.csv", "fit.json", "ice40.csv: the row of default, machine, is of the family ice40: "),
        (
            "ice40",
            "fitted.csv",
            "fit.json",
            "fitted.csv: no machine is held out, so no fit would be checked; permitted: ",
        ),
        (
            "osu018",
            "cells.csv",
            "fit.json",
            "cells.csv: no machine is held out, so no fit would be checked; permitted: ",
        ),
        (
            "ice40",
            "held.csv",
            "fit.json",
            "held.csv: all rows are held out, so nothing can be fitted; permitted: ",
        ),
        (
            "ice40",
            "ice40.csv",
            "./ice40.csv",
            "--fit ./ice40.csv: --data ice40.csv is the same file; permitted: ",
        ),
        (
            "ice40",
            "ice40.csv",
            "machines.txt",
            "--fit machines.txt: --machines machines.txt is the same file; permitted: ",
        ),
        ("ice40", "new.csv", "./new.csv", "--fit ./new.csv: --data new.csv is the same file; permitted: "),
    ];
    for (family, table, fit, why) in cases {
        let before = std::fs::read(at(fit)).ok();
        let words =
            ["calibrate", "--family", family, "--machines", "machines.txt", "--data", table, "--fit", fit];
        let (code, said) = run(folder.path(), &words);
        assert!(code == Some(2) && said.contains(why), "{why}: {said}");
        assert!(!said.contains('%'), "{said}");
        assert_eq!(std::fs::read(at(fit)).ok(), before, "{words:?}");
    }
    // Rows of single units are all held out, which is said before a tool runs.
    let unit =
        ["calibrate", "--machines", "machines.txt", "--unit", "depth", "--count", "1", "--fit", "f.json"];
    for (words, why) in [
        (&["--data", "new.csv"][..], "new.csv: all rows are held out, so nothing can be fitted; permitted: "),
        (
            &["--data", "new.csv", "--family", "osu018"],
            "--unit: the family osu018 has rows of whole machines; ",
        ),
    ] {
        let mut command = edgewalk(folder.path(), &[&unit[..], words].concat());
        let (code, said) = ended(&command.env("PATH", "nowhere").output().unwrap());
        assert!(code == Some(2) && said.contains(why), "{why}: {said}");
        assert!(said.ends_with("leave --unit out\n") || said.contains("--count N without --unit"), "{said}");
    }
    assert!(!at("new.csv").exists());
}

#[test]
fn the_text_tells_the_figures_of_the_json() {
    let folder = tempfile::tempdir().unwrap();
    let machines = ["small", "up5k", "default,setup.lanes=1", "--fits", "ice40-up5k"];
    let output = edgewalk(folder.path(), &[&["estimate"][..], &machines].concat()).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let rows = estimates(&machines);
    assert_eq!(rows.len(), 3);
    for row in &rows {
        let line = text.lines().find(|line| line.starts_with(row["name"].as_str().unwrap())).unwrap();
        let fields: Vec<&str> = line.split_whitespace().collect();
        let whole = |figure: &str| format!("{:.0}", row[figure]["value"].as_f64().unwrap());
        assert_eq!([fields[1], fields[8]], [whole("est_lut4"), whole("est_cells")], "{line}");
        assert_eq!([4, 5, 6, 7].map(|at: usize| fields[at].parse::<u64>().unwrap()), exact(row), "{line}");
        assert_eq!(fields[11], format!("{:.1}", row["est_mhz"]["value"].as_f64().unwrap()), "{line}");
        let by_unit: f64 =
            row["est_lut4_by_unit"].as_object().unwrap().values().map(|of| of.as_f64().unwrap()).sum();
        assert!((by_unit - row["est_lut4"]["value"].as_f64().unwrap()).abs() <= 1.0);
    }
    let fits: Vec<Option<bool>> = rows.iter().map(|row| row["fits"][0]["fits"].as_bool()).collect();
    assert_eq!(fits, [Some(true), Some(true), Some(false)], "{text}");
    assert!(text.contains("ice40-up5k: does not fit: "), "{text}");
    // The preset's frame memories take all single-port blocks of its device: 160 x 256 words of 16 and 15 bits.
    let held = |row: &Value| {
        let memories = row["fits"][0]["memories"].as_array().unwrap().iter();
        memories.map(|of| (of["words"].clone(), of["held_by"].clone())).collect::<Vec<_>>()
    };
    let two = serde_json::json!({ "block": "SPRAM", "count": 2 });
    assert_eq!(held(&rows[1]), vec![(Value::from(120 * 256), two.clone()), (Value::from(120 * 256), two)]);
    assert!(text.contains("; depth in 2 SPRAM; color in 2 SPRAM"), "{text}");
    assert!(text.contains("; depth in none; color in none"), "{text}");
}

#[test]
fn gates_of_the_text_are_those_of_the_json() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["small", "hx8k,setup.lanes=1", "--family", "osu018"];
    let output = edgewalk(folder.path(), &[&["estimate"][..], &words].concat()).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let rows = estimates(&words);
    assert_eq!(rows.len(), 2);
    for row in &rows {
        let line = text.lines().find(|line| line.starts_with(row["name"].as_str().unwrap())).unwrap();
        let kge = |part: &str| format!("{:.1}", row["est_kge"][part].as_f64().unwrap());
        let told = format!("{} ± {}", kge("value"), kge("error"));
        assert!(line.contains(&told) && line.contains(&row["est_ff"].to_string()), "{line}: {told}");
        let by_unit = row["est_kge_by_unit"].as_object().unwrap().values().map(|of| of.as_f64().unwrap());
        assert!((by_unit.sum::<f64>() - row["est_kge"]["value"].as_f64().unwrap()).abs() < 1e-9);
    }
    // A unit by itself costs what it costs in the machine: modules stay apart.
    let unit = &estimates(&["small", "--family", "osu018", "--unit", "pixel"])[0];
    assert_eq!(unit["est_kge"]["value"], rows[0]["est_kge_by_unit"]["pixel"]);
}

/// What Yosys 0.23 gives: TERM's memory of 64 words of 49 bits lies in four blocks, as the choice among look-up tables of 16
/// words would cost more; of a comparison with a constant that ends in ones the lowest bits need no carry.
#[test]
fn memories_and_carries_of_parts_are_those_of_yosys() {
    let phong = "default,shade.kind=phong,shade.light=positional,shade.colour=multiply,term.walk=memory,texture.kind=nearest";
    let machines = ["--family", "ecp5"];
    let term = &estimates(&[&[phong][..], &machines, &["--unit", "term"]].concat())[0];
    assert_eq!((term["est_ram"].as_u64(), term["est_ff"].as_u64()), (Some(4), Some(825)), "{term}");
    let spans: Vec<String> = [9, 17].map(|places| format!("small,fifo.span={places}")).to_vec();
    let words: Vec<&str> =
        spans.iter().map(String::as_str).chain(machines).chain(["--unit", "span"]).collect();
    let carries: Vec<_> = estimates(&words).iter().map(|of| of["est_carry"].as_u64()).collect();
    assert_eq!(carries, [Some(26), Some(50)]);
}

/// LAMP keeps its program in a memory of flip-flops, of which some never change or are alike.
#[test]
fn gates_of_lamp_are_estimated() {
    let words = ["small,shade.kind=phong,shade.light=positional", "--family", "osu018", "--unit", "lamp"];
    let found = &estimates(&words)[0];
    assert!(found["est_ff"].as_u64() > Some(10_000), "{found}");
}

/// A sequenced SETUP has its memories in blocks; what lies in look-up tables is none of them.
#[test]
fn blocks_of_the_machine_are_left_to_no_memory() {
    let screen = "screen.width=256,screen.height=112,formats.z_bits=16,formats.color_bits=5";
    let machines = [format!("hx8k,{screen}"), format!("small,{screen}")];
    let words = [&machines[0], &machines[1], "--family", "ecp5", "--fits", "ecp5-25"];
    let found = estimates(&words);
    let mut held = Vec::new();
    for machine in &found {
        let fits = &machine["fits"][0];
        let text = fits["text"].as_str().unwrap();
        let own: u64 =
            text.split(" cells of 24288, ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        assert!(text.contains(&format!("{own} blocks of 56")), "{text}");
        assert!(own <= machine["est_ram"].as_u64().unwrap(), "{machine}");
        let memories = fits["memories"].as_array().unwrap().iter();
        let by: u64 = memories.filter_map(|memory| memory["held_by"]["count"].as_u64()).sum();
        assert!(own + by <= 56, "{text}");
        held.push((own, by));
    }
    // Depth and colour take 28 blocks each: beside the 15 of the sequenced machine one of them.
    assert_eq!(held, [(15, 28), (0, 56)]);
}

#[test]
fn malformed_estimates_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (words, why) in [
        (&["estimate", "smal"][..], "nearest: small"),
        (&["estimate", "small,setup.lane=2"], "setup.lanes"),
        (&["estimate", "--unit", "sapn"], "nearest: span"),
        (&["estimate", "--fits", "up5k"], "nearest: ice40-up5k"),
        (
            &["estimate", "--fits", "ecp5-25"],
            "found a device of the family ecp5, the estimate is of ice40; use --family ecp5",
        ),
        (&["estimate", "--family", "ecp"], "nearest: ecp5"),
        (&["estimate", "--family", "osu018", "--fits", "ecp5-25"], "standard cells have no device"),
        (&["estimate", "--family", "osu018", "--unit", "sapn"], "nearest: span"),
        (&["calibrate", "--family", "ice4"], "nearest: ice40"),
        (&["calibrate", "--machines", "none.txt"], "none.txt"),
        (&["calibrate", "--count", "0"], "or give --machines FILE --data FILE --fit FILE"),
    ] {
        let (code, said) = run(folder.path(), words);
        assert!(code == Some(2) && said.contains(why), "{words:?}: {said}");
    }
}
