//! Searches: as good as the whole grid on a small one, the same by their seed, never called exhaustive.

use super::{keys, rows};
use crate::support::{TRIANGLE, edgewalk, run};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// 1,872 machines.
const VARY: [&str; 10] = [
    "--vary",
    "setup.lanes=1,2,4",
    "--vary",
    "interpolator.adders=1..4",
    "--vary",
    "formats.z_fraction=2..14",
    "--vary",
    "fifo.span=1..4",
    "--vary",
    "memory.hazard=drain,interlock,forward",
];

/// A second triangle, and a third.
const OTHERS: [(&str, &str); 2] = [
    ("b.tri", "size 64 48\nT 3 2 0 1 0 0 0  9 40 0 0 1 0 0  50 30 1 0 0 1 0\n"),
    ("c.tri", "size 64 48\nT 60 2 0 1 0 0 0  9 3 0 0 1 0 0  30 45 1 0 0 1 0\n"),
];

fn swept(folder: &Path, words: &[&str], out: &str) -> Value {
    std::fs::write(folder.join("a.tri"), TRIANGLE).unwrap();
    OTHERS.iter().for_each(|(name, text)| std::fs::write(folder.join(name), text).unwrap());
    let words = [&["sweep", "a.tri", "--json", "--out", out][..], &VARY, words].concat();
    let output = edgewalk(folder, &words).output().unwrap();
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The value of each objective's best machine.
fn bests(report: &Value) -> Vec<(String, f64)> {
    let best = report["best"].as_object().unwrap();
    best.iter().map(|(name, of)| (name.clone(), of["values"][name].as_f64().unwrap())).collect()
}

#[test]
fn a_search_finds_the_bests_of_the_grid() {
    let folder = tempfile::tempdir().unwrap();
    let whole = bests(&swept(folder.path(), &[], "whole"));
    assert_eq!(whole.len(), 4);
    for seed in ["1", "2", "3", "4", "5"] {
        let report = swept(folder.path(), &["--search", "200", "--seed", seed], seed);
        assert_eq!(report["machines"], 200);
        assert_eq!(bests(&report), whole, "seed {seed}");
    }
}

#[test]
fn a_search_goes_on_and_is_the_same_by_its_seed() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["b.tri", "--search", "64", "--seed", "7"];
    let first = swept(folder.path(), &words, "one");
    assert_eq!(
        swept(folder.path(), &words, "two")["best"]["cycles"]["machine"],
        first["best"]["cycles"]["machine"]
    );
    assert_eq!(keys(&folder.path().join("one")), keys(&folder.path().join("two")));
    let other = swept(folder.path(), &["b.tri", "--search", "64", "--seed", "8"], "other");
    assert_ne!(keys(&folder.path().join("one")), keys(&folder.path().join("other")));
    assert_eq!(other["extent"]["seed"], 8);
    // Rows that are there are not made again; those that are lost are.
    assert_eq!(swept(folder.path(), &words, "one")["made"], 0);
    let file = folder.path().join("two/runs.jsonl");
    let text = std::fs::read_to_string(&file).unwrap();
    let half: Vec<&str> = text.lines().take(40).collect();
    std::fs::write(&file, half.join("\n") + "\n").unwrap();
    let again = swept(folder.path(), &words, "two");
    assert_eq!(again["made"].as_u64().unwrap(), first["made"].as_u64().unwrap() - 40);
    assert_eq!((&again["front"], &again["extent"]), (&first["front"], &first["extent"]));
}

#[test]
fn a_search_halves_its_machines_over_the_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["b.tri", "c.tri", "--search", "64", "--seed", "7", "--stalls", "none", "--stalls", "random"];
    let report = swept(folder.path(), &words, "out");
    let rounds = report["extent"]["rounds"].as_array().unwrap().iter();
    let rounds: Vec<[u64; 2]> =
        rounds.map(|of| ["inputs", "machines"].map(|name| of[name].as_u64().unwrap())).collect();
    let first = [[1, 32], [1, 4], [1, 4], [1, 4], [1, 4], [1, 4], [1, 4], [1, 4], [1, 4]];
    assert_eq!(rounds, [&first[..], &[[2, 32], [3, 16]]].concat());
    let rows = rows(&folder.path().join("out"));
    let on = |input: &str| -> BTreeSet<&str> {
        let of = rows.iter().filter(|row| row["input"] == input);
        of.map(|row| row["machine"].as_str().unwrap()).collect()
    };
    assert_eq!([on("a.tri").len(), on("b.tri").len(), on("c.tri").len()], [64, 32, 16]);
    assert!(on("c.tri").is_subset(&on("b.tri")) && on("b.tri").is_subset(&on("a.tri")));
    assert_eq!(rows.len(), 2 * (64 + 32 + 16), "each machine meets both memories");
    let front = report["front"].as_array().unwrap();
    assert!(
        !front.is_empty() && front.iter().all(|of| on("c.tri").contains(of["machine"].as_str().unwrap()))
    );
}

#[test]
fn a_search_is_never_called_exhaustive() {
    let folder = tempfile::tempdir().unwrap();
    let told = |words: &[&str], out: &str| {
        let report = swept(folder.path(), words, out);
        let (_, text) = text(folder.path(), words, out);
        let page = std::fs::read_to_string(folder.path().join(out).join("report.html")).unwrap();
        let best = std::fs::read_to_string(folder.path().join(out).join("best_cycles.toml")).unwrap();
        (report["extent"].clone(), text, page, best)
    };
    let search = "A search, not exhaustive: 64 of 1872 machines, seed 3; machines on inputs: 64 on 1";
    let sample = "A sample, not exhaustive: 20 of 1872 machines, seed 3";
    for (words, out, kind, line) in [
        (&["--search", "64", "--seed", "3"], "search", "search", search),
        (&["--sample", "20", "--seed", "3"], "sample", "sample", sample),
    ] {
        let (extent, text, page, best) = told(words, out);
        assert_eq!((&extent["kind"], &extent["exhaustive"]), (&Value::from(kind), &Value::from(false)));
        assert_eq!(extent["machines_of_space"], 1872);
        assert!(text.contains(line), "{text}");
        assert!(page.contains(&format!("<p>{line}.</p>")), "the page has no line {line}");
        assert!(page.contains(&words.join(" ")), "the page's command is another");
        assert!(best.contains("looked at, not of all,"), "{best}");
    }
    // Combinations beyond 2^20 are not searched for equal machines.
    let wide = [
        "--vary",
        "fifo.inflight=1..16",
        "--vary",
        "formats.color_fraction=4..16",
        "--vary",
        "memory.latency=1..4",
    ];
    let (_, text) = text(folder.path(), &[&wide[..], &["--sample", "2"]].concat(), "wide");
    assert!(text.contains("not exhaustive: 2 of 1557504 combinations, seed 1"), "{text}");
    let (extent, text, page, best) = told(&[], "whole");
    assert_eq!((&extent["kind"], &extent["exhaustive"]), (&Value::from("whole"), &Value::from(true)));
    assert!(![text, page, best].iter().any(|of| of.contains("exhaustive") || of.contains("not of all")));
}

/// The exit code of a sweep, and the text on standard output.
fn text(folder: &Path, words: &[&str], out: &str) -> (Option<i32>, String) {
    let words = [&["sweep", "a.tri", "--out", out][..], &VARY, words].concat();
    let output = edgewalk(folder, &words).output().unwrap();
    (output.status.code(), String::from_utf8(output.stdout).unwrap())
}

#[test]
fn a_search_keeps_what_is_required() {
    let folder = tempfile::tempdir().unwrap();
    // A limit that half of the machines break.
    swept(folder.path(), &[], "all");
    let mut bits: Vec<f64> = rows(&folder.path().join("all"))
        .iter()
        .filter_map(|row| row["derived"]["word_bits"].as_f64())
        .collect();
    bits.sort_by(f64::total_cmp);
    let limit = ["--require", &format!("word_bits>={}", bits[bits.len() / 2])];
    let whole = bests(&swept(folder.path(), &limit, "whole"));
    let report = swept(folder.path(), &[&limit[..], &["--search", "200", "--seed", "1"]].concat(), "search");
    assert!(report["ruled_out"][0]["machines"].as_u64() > Some(0), "the limit rules nothing out");
    assert_eq!(bests(&report), whole);
}

#[test]
fn malformed_searches_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), TRIANGLE).unwrap();
    let wide = [
        "--vary",
        "screen.width=1..1000",
        "--vary",
        "screen.height=1..1000",
        "--vary",
        "fifo.span=1..64",
        "--vary",
        "fifo.inflight=1..16",
        "--vary",
        "formats.z_fraction=0..24",
        "--vary",
        "formats.color_fraction=0..16",
        "--vary",
        "screen.guard_bits=2..14",
        "--vary",
        "memory.tag_bits=0..8",
        "--vary",
        "memory.latency=1..8",
        "--vary",
        "formats.z_bits=4..32",
        "--vary",
        "edge.fraction_bits=8..20",
        "--vary",
        "interpolator.adders=1..8",
        "--vary",
        "formats.color_bits=2..16",
        "--vary",
        "formats.z_vertex=0..8",
    ];
    for (words, why) in [
        (&["--search", "0"][..], "--search 0: permitted: 32 to 200000 machines with 1 points each"),
        (&["--search", "31"], "permitted: 32 to 200000"),
        (&["--search", "-1"], "invalid value '-1' for '--search <N>': -1 is not in 0..="),
        (&["--search", "many"], "'many' for '--search <N>': permitted: whole numbers in 0..=4294967295\n"),
        (&["--search", "1872"], "--search 1872: there are 1872 machines; leave --search out"),
        (&["--search", "64", "--sample", "64"], "cannot be used with"),
        (&["--seed", "3"], "--sample <N>|--search <N>"),
        (&["--search", "64", "--synth", "ice40-hx8k"], "nothing is built in a search"),
        (&["--search", "64", "--seed", "one"], "'one' for '--seed <S>': permitted: whole numbers in 0..\n"),
    ] {
        let words = [&["sweep", "a.tri", "--out", "out"][..], &VARY, words].concat();
        let (code, said) = run(folder.path(), &words);
        assert!(code == Some(2) && said.contains(why), "{words:?}: {said}");
    }
    for (words, why) in [
        (
            [&["sweep", "plan", "a.tri", "--chunks", "2", "--search", "64"][..], &VARY].concat(),
            "not cut into parts",
        ),
        ([&["sweep", "a.tri", "--search", "64"][..], &wide].concat(), "more than 2^63 combinations"),
        ([&["sweep", "a.tri", "--sample", "10"][..], &wide].concat(), "more than 2^63 combinations"),
        (
            [&["sweep", "plan", "a.tri", "--chunks", "2", "--sample", "10"][..], &wide].concat(),
            "more than 2^63 combinations",
        ),
        (
            [
                &["sweep", "a.tri", "--search", "200000", "--stalls", "none", "--stalls", "dram"][..],
                &wide[..18],
            ]
            .concat(),
            "permitted: 32 to 100000 machines with 2 points each",
        ),
    ] {
        let (code, said) = run(folder.path(), &[&words[..], &["--out", "out"]].concat());
        assert!(code == Some(2) && said.contains(why), "{words:?}: {said}");
    }
    assert!(!folder.path().join("out").exists());
}
