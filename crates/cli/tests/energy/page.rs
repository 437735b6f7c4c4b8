//! The figures of docs/energy.md are those of the program.

use super::number;
use crate::support::edgewalk;
use serde_json::Value;
use std::path::Path;

/// The rows of docs/energy.md for libraries of the system.
#[test]
#[ignore = "needs qflow-tech-osu035 and qflow-tech-osu050: two minutes"]
fn libraries_of_the_page_give_its_figures() {
    let folder = tempfile::tempdir().unwrap();
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/energy.md")).unwrap();
    let rows = page.lines().skip_while(|line| !line.starts_with("| `--library` |")).skip(2);
    let mut checked = 0;
    for row in rows.take_while(|line| line.starts_with('|')) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let file = cells[1].trim_matches('`');
        let library = if file.starts_with('/') { vec!["--library", file] } else { vec![] };
        let words = [&["energy", "sphere", "--triangles", "100", "--json", "--cache", "cache"][..], &library];
        let output = edgewalk(folder.path(), &words.concat()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let of: Value = serde_json::from_slice(&output.stdout).unwrap();
        let figures = [
            format!("{:.1}", number(&of["kge"])),
            format!("{:.3}", number(&of["area_um2"]) / 1e6),
            format!("{:.3}", number(&of["ns"])),
            format!("{:.1}", number(&of["energy"]["cycle_pj"])),
        ];
        assert_eq!(figures, cells[2..6], "{row}");
        checked += figures.len();
    }
    println!("{checked} figures");
    assert_eq!(checked, 12);
}

/// A whole number with a comma before each three digits: `2,907,335,882`.
fn grouped(number: &Value) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// The page's machines beside the default one: their order was stated before the first run. The rows of docs/energy.md have the
/// program's figures, and say truly whether the stated order holds.
#[test]
#[ignore = "synthesis of seven machines: eight minutes"]
fn pairs_of_machines_are_ordered_as_expected() {
    // Gates are kept, so that a second run takes seconds.
    let cache = concat!(env!("CARGO_TARGET_TMPDIR"), "/pairs");
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/energy.md")).unwrap();
    let rows = page.lines().skip_while(|line| !line.starts_with("| machine | thousand gates |")).skip(2);
    let prose = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut said = Vec::new();
    let mut clock = (f64::MAX, 0.0_f64);
    let (mut default, mut checked, mut hold) = (None, 0, 0);
    for row in rows.take_while(|line| line.starts_with('|')) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let sets = match cells[1] {
            "default" => vec![],
            text if text.starts_with("6 fraction bits") => {
                vec!["--set", "formats.z_fraction=6", "--set", "formats.color_fraction=6"]
            }
            key => vec!["--set", key.trim_matches('`')],
        };
        let words = [&["energy", "sphere", "--triangles", "100", "--json", "--cache", cache][..], &sets];
        let output = edgewalk(Path::new("."), &words.concat()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        let [frame, cycle] = ["frame_pj", "cycle_pj"].map(|key| number(&report["energy"][key]));
        let figures = [
            format!("{:.1}", number(&report["kge"])),
            report["flip_flops"].to_string(),
            report["frame"]["cycles"].to_string(),
            format!("{cycle:.1}"),
            format!("{:.0}", frame / 1e3),
        ];
        assert_eq!(figures, cells[2..7], "{row}");
        checked += figures.len();
        let share = 100.0 * number(&report["power"]["clock_watts"]) / number(&report["power"]["watts"]);
        clock = (clock.0.min(share), clock.1.max(share));
        let Some((of_frame, of_cycle)) = default else {
            default = Some((frame, cycle));
            said.push(format!("these take {:.0} pJ a pixel", number(&report["energy"]["pixel_pj"])));
            let still = |place: usize| 100.0 * number(&report["power"]["units"][place]["still"]);
            said.push(format!("EDGE is still in {:.0} % of the default machine's cycles", still(1)));
            said.push(format!("SPAN in {:.0} %, SETUP in none", still(2)));
            assert!(still(0) < 0.05, "{}", still(0));
            continue;
        };
        if cells[1] == "`interpolator.adders=1`" {
            said.push(format!("but {:.1} times as much a frame", frame / of_frame));
        }
        let holds = match cells[7] {
            "less a frame" => frame < of_frame,
            "less a cycle" => cycle < of_cycle,
            "more a cycle" => cycle > of_cycle,
            stated => panic!("{stated} in {row}"),
        };
        assert_eq!(if holds { "yes" } else { "no" }, cells[8], "{row}");
        hold += u32::from(holds);
    }
    said.push(format!("The clock takes {:.0} to {:.0} % of the energy", clock.0, clock.1));
    let output =
        edgewalk(Path::new("."), &["energy", "sphere", "--json", "--cache", cache]).output().unwrap();
    let whole: Value = serde_json::from_slice(&output.stdout).unwrap();
    said.push(format!("the whole sphere {:.0}.", number(&whole["energy"]["pixel_pj"])));
    let [cycles, compared] = [&whole["frame"]["cycles"], &whole["power"]["compared"]].map(grouped);
    said.push(format!("{cycles} cycles, 0 of {compared} values"));
    for said in &said {
        assert!(prose.contains(said), "docs/energy.md does not say: {said}");
    }
    println!("{checked} figures, {} sentences; {hold} of 6 orders hold", said.len());
    assert_eq!((checked, said.len()), (35, 7));
    assert!(page.contains("Five of six expectations hold.") && hold == 5, "{hold} hold");
}
