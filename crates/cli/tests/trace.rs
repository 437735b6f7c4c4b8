//! What a waveform shows: what can change, causes by name, tags only where the machine has them.

mod views;

use crate::support::edgewalk;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

fn vcd(settings: &[&str]) -> String {
    traced("vcd", settings).0
}

/// The file of a short run, and what the program printed.
fn traced(kind: &str, settings: &[&str]) -> (String, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join(format!("t.{kind}"));
    let small = ["screen.width=24", "screen.height=20", "screen.guard_bits=6"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.args(["trace", "sphere", "--json", "--triangles", "2", "--cycles", "900", "--out"]).arg(&out);
    small.iter().chain(settings).for_each(|setting| _ = command.args(["--set", setting]));
    let output = command.output().expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = String::from_utf8(output.stdout).expect("text");
    (std::fs::read_to_string(out).expect("written"), printed)
}

#[test]
fn a_waveform_holds_causes_by_name_and_no_constants_and_no_tags() {
    let text = vcd(&[]);
    let (header, changes) = text.split_once("$enddefinitions").expect("a header");
    let declared = |name: &str| header.lines().any(|line| line.contains(&format!(" {name} $end")));
    for name in ["clk", "activity", "activity_name", "tri_valid", "wr_z"] {
        assert!(declared(name), "{name} is not there");
    }
    for name in ["DRAW", "EDGE", "IDLE", "EDGE_STEP", "tri_tag", "wr_tag"] {
        assert!(!declared(name), "{name} is there");
    }
    assert!(!header.contains("_tag"), "a machine without tags is traced with tags");
    let line = header.lines().find(|line| line.contains(" activity_name $end")).expect("declared");
    let id = line.split_whitespace().nth(3).expect("an identifier");
    for name in ["idle", "setup"] {
        assert!(
            changes.lines().any(|line| line == format!("s{name} {id}")),
            "the cause {name} is never shown"
        );
    }
}

#[test]
fn a_waveform_ends_after_as_many_cycles_as_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    command.current_dir(folder.path());
    let output =
        command.args(["trace", "sphere", "--cycles", "70", "--out", "t.vcd"]).output().expect("runs");
    assert_eq!(String::from_utf8_lossy(&output.stdout), "70 cycles -> t.vcd\n");
    let text = std::fs::read_to_string(folder.path().join("t.vcd")).expect("written");
    let times = text.lines().filter_map(|line| line.strip_prefix('#')?.parse::<u64>().ok());
    let times: Vec<u64> = times.collect();
    assert!(times.len() >= 70 && times.len() <= 2 * 70 + 1, "{} times", times.len());
}

/// As every command that has nothing to do; and no file is left.
#[test]
fn nothing_to_trace_is_exit_code_2_with_its_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("empty.tri"), "size 8 8\n").expect("written");
    let away = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 9]\n\n[[object]]\nbuiltin = \"sphere\"\n";
    std::fs::write(folder.path().join("away.toml"), away).expect("written");
    for source in [&["empty.tri"][..], &["away.toml"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
        command.current_dir(folder.path()).arg("trace").args(source);
        command.args(["--set", "screen.width=8", "--set", "screen.height=8", "-q", "--out", "t.vcd"]);
        let output = command.output().expect("the program runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{source:?}: {message}");
        assert!(
            message.contains(&format!("{}: nothing was drawn: it has no triangle", source[0])),
            "{message}"
        );
        assert!(!folder.path().join("t.vcd").exists(), "{source:?}");
    }
}

#[test]
fn tags_that_the_machine_has_are_traced() {
    assert!(vcd(&["memory.tag_bits=4"]).contains(" tri_tag $end"));
}

/// Of each bit by its path: transitions, and nanoseconds at 1.
type Bits = BTreeMap<String, [u64; 2]>;

/// Reads a VCD; also the transitions of all signals, each counted once whatever names it has.
fn bits_of_vcd(text: &str, nanoseconds: u64) -> (Bits, u64) {
    let (header, changes) = text.split_once("$enddefinitions $end").expect("a header");
    let mut scopes: Vec<&str> = Vec::new();
    let mut names: Vec<(String, &str, usize)> = Vec::new();
    for line in header.lines() {
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["$scope", "module", name, "$end"] => scopes.push(name),
            ["$upscope", "$end"] => _ = scopes.pop(),
            ["$var", "wire", width, id, name, "$end"] => {
                names.push((format!("{}.{name}", scopes.join(".")), id, width.parse().expect("bits")));
            }
            _ => (),
        }
    }
    let widths: BTreeMap<&str, usize> = names.iter().map(|(_, id, width)| (*id, *width)).collect();
    let mut last: BTreeMap<&str, (u64, Vec<u8>)> = BTreeMap::new();
    let mut counts: BTreeMap<&str, Vec<[u64; 2]>> = BTreeMap::new();
    let mut now = 0;
    let mut take = |id, now, bits: Option<Vec<u8>>| {
        let counted = counts.entry(id).or_insert_with(|| vec![[0; 2]; widths[id]]);
        if let Some((since, before)) = last.get(id) {
            for (bit, count) in counted.iter_mut().enumerate() {
                count[0] += u64::from(bits.as_ref().is_some_and(|bits| bits[bit] != before[bit]));
                count[1] += u64::from(before[bit]) * (now - since);
            }
        }
        bits.map(|bits| last.insert(id, (now, bits)));
    };
    for line in changes.lines() {
        let digits = |text: &str, width: usize| -> Vec<u8> {
            format!("{text:0>width$}").bytes().rev().map(|digit| digit - b'0').collect()
        };
        match line.split_at_checked(1) {
            Some(("#", time)) => now = time.parse().expect("a time"),
            Some(("b", rest)) => {
                let (value, id) = rest.split_once(' ').expect("an identifier");
                take(id, now, Some(digits(value, widths[id])));
            }
            Some((bit @ ("0" | "1"), id)) => take(id, now, Some(digits(bit, 1))),
            _ => (),
        }
    }
    widths.keys().for_each(|id| take(id, nanoseconds, None));
    let clk = names.iter().find(|(path, ..)| path == "edgewalk.clk").expect("a clock").1;
    let of_signals = counts.iter().filter(|(id, _)| **id != clk).flat_map(|(_, bits)| bits);
    let all = of_signals.map(|count| count[0]).sum();
    let bit_name = |path: &str, width, bit| match width {
        1 => path.to_owned(),
        _ => format!("{path}[{bit}]"),
    };
    let named = names.iter().flat_map(|(path, id, width)| {
        let counted = counts[id].iter().enumerate();
        counted.map(move |(bit, count)| (bit_name(path, *width, bit), *count))
    });
    (named.collect(), all)
}

/// Reads a SAIF file by the grammar of its standard: nested lists of words.
fn bits_of_saif(text: &str, nanoseconds: u64) -> Bits {
    let spaced = text.replace('(', " ( ").replace(')', " ) ");
    let mut bits = Bits::new();
    // Of each open list: its words so far.
    let mut open: Vec<Vec<&str>> = vec![Vec::new()];
    for word in spaced.split_whitespace() {
        match word {
            "(" => open.push(Vec::new()),
            ")" => {
                let list = open.pop().expect("as many closed as opened");
                let values: Vec<&str> = open.last().expect("within the file").clone();
                if let [key @ ("T0" | "T1" | "TX" | "TC" | "IG"), value] = list[..] {
                    open.last_mut().expect("within a net").extend([key, value]);
                } else if let [name, "T0", t0, "T1", t1, "TX", "0", "TC", tc, "IG", "0"] = list[..] {
                    let [t0, t1, tc] = [t0, t1, tc].map(|value| value.parse::<u64>().expect("a number"));
                    assert_eq!(t0 + t1, nanoseconds, "{name}");
                    assert_eq!(values[..], ["NET"], "{name}");
                    let scopes = open.iter().filter_map(|list| match list[..] {
                        ["INSTANCE", scope, ..] => Some(scope),
                        _ => None,
                    });
                    let path: Vec<&str> = scopes.chain([name]).collect();
                    bits.insert(path.join(".").replace('\\', ""), [tc, t1]);
                }
            }
            word => open.last_mut().expect("within the file").push(word),
        }
    }
    assert_eq!(open.len(), 1, "as many closed as opened");
    bits
}

#[test]
fn transitions_are_those_of_the_waveform() {
    let mut compared = 0;
    for settings in [
        &[][..],
        &["interpolator.adders=1"],
        &["blend.kind=constant", "memory.color_latency=2"],
        &["setup.kind=sequenced", "setup.lanes=1"],
        &["memory.latency=4"],
    ] {
        let (saif, report) = traced("saif", settings);
        let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
        let cycles = report["cycles"].as_u64().expect("a number");
        let (wave, all) = bits_of_vcd(&vcd(settings), cycles * 10);
        let counted = bits_of_saif(&saif, cycles * 10);
        let differ: BTreeSet<_> =
            wave.iter().filter(|(bit, count)| counted.get(*bit) != Some(count)).collect();
        assert!(differ.is_empty(), "{settings:?}: {differ:?}");
        assert_eq!(wave.len(), counted.len(), "{settings:?}");
        assert!(wave.len() > 1000, "{settings:?}: {}", wave.len());
        let units = report["units"].as_array().expect("units");
        let sum: u64 = units.iter().map(|unit| unit["transitions"].as_u64().expect("a number")).sum();
        assert_eq!(sum, all, "{settings:?}: the units' sums are all transitions");
        compared += counted.len();
    }
    println!("{compared} bits compared");
}

/// For each cycle of a waveform the values of these signals of the machine; in a VCD a cycle lasts 10 ns.
fn cycles(text: &str, names: &[&str]) -> BTreeMap<u64, Vec<String>> {
    let (header, changes) = text.split_once("$enddefinitions $end").expect("a header");
    let id = |name: &&str| {
        // The machine's own port is the first of that name.
        let line = header.lines().find(|line| line.contains(&format!(" {name} $end")));
        line.and_then(|line| line.split_whitespace().nth(3)).expect("declared").to_owned()
    };
    let ids: Vec<String> = names.iter().map(id).collect();
    let (mut now, mut values, mut found) = (None, vec![String::new(); names.len()], BTreeMap::new());
    for line in changes.lines() {
        if let Some(time) = line.strip_prefix('#') {
            if let Some(before) = now.filter(|before| before % 10 == 0) {
                found.insert(before / 10, values.clone());
            }
            now = time.parse::<u64>().ok();
        } else if let Some((value, id)) = line.strip_prefix('b').and_then(|rest| rest.split_once(' ')) {
            ids.iter()
                .position(|known| known == id)
                .into_iter()
                .for_each(|place| values[place] = value.to_owned());
        } else if let Some((value, id)) = line.split_at_checked(1) {
            ids.iter()
                .position(|known| known == id)
                .into_iter()
                .for_each(|place| values[place] = value.to_owned());
        }
    }
    found
}

const WATCHED: [&str; 5] = ["tri_valid", "tri_ready", "wr_valid", "wr_addr", "wr_z"];

/// The waveform of a run of two triangles, and what is said of it.
fn part(arguments: &[&str]) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_edgewalk"));
    let triangles = "size 24 20\nT 2 2 0.2 1 0 0 0  12 3 0.5 0 1 0 0  4 15 0.8 0 0 1 0\n\
        T 3 3 0.1 1 0 0 0  14 4 0.4 0 1 0 0  5 16 0.7 0 0 1 0\n";
    std::fs::write(folder.path().join("in.tri"), triangles).expect("written");
    command.args(["trace", "in.tri", "--out", "t.vcd"]).args(arguments);
    for setting in ["screen.width=24", "screen.height=20", "screen.guard_bits=6"] {
        command.args(["--set", setting]);
    }
    let output = command.current_dir(&folder).output().expect("the program runs");
    let said = [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat();
    (output.status.code(), said, std::fs::read_to_string(folder.path().join("t.vcd")).unwrap_or_default())
}

#[test]
fn a_part_of_a_waveform_is_that_of_the_whole() {
    let (_, _, whole) = part(&[]);
    let whole = cycles(&whole, &WATCHED);
    let of = |name: &str| WATCHED.iter().position(|watched| *watched == name).expect("watched");
    let is = |values: &[String], name: &str| values[of(name)] == "1";
    let check = |arguments: &[&str]| {
        let (code, said, text) = part(arguments);
        assert_eq!(code, Some(0), "{said}");
        let part = cycles(&text, &WATCHED);
        assert!(said.starts_with(&format!("{} cycles -> ", part.len())), "{} {said}", part.len());
        part.iter()
            .for_each(|(cycle, values)| assert_eq!(values, &whole[cycle], "{arguments:?}: cycle {cycle}"));
        part
    };
    let part = check(&["--from", "100", "--to", "149"]);
    assert_eq!((part.len(), part.keys().next(), part.keys().last()), (50, Some(&100), Some(&149)));
    let part = check(&["--from", "100", "--cycles", "20"]);
    assert_eq!((part.len(), part.keys().next()), (20, Some(&100)));

    let writes = |cycles: &BTreeMap<u64, Vec<String>>, address: &str| {
        let all =
            cycles.iter().filter(|(_, values)| is(values, "wr_valid") && values[of("wr_addr")] == address);
        all.map(|(cycle, _)| *cycle).collect::<Vec<u64>>()
    };
    let written = whole.values().find(|values| is(values, "wr_valid")).expect("a write");
    let address = written[of("wr_addr")].clone();
    let number = u32::from_str_radix(&address, 2).expect("a number");
    let (x, y) = ((number % 32).to_string(), (number / 32).to_string());
    let part = check(&["--pixel", &x, &y]);
    let at = writes(&whole, &address);
    assert_eq!(writes(&part, &address), at);
    assert_eq!(
        (part.keys().next(), part.keys().last()),
        (Some(&(at[0] - 40)), Some(&(at[at.len() - 1] + 1)))
    );

    let enters: Vec<u64> = whole
        .iter()
        .filter(|(_, v)| is(v, "tri_valid") && is(v, "tri_ready"))
        .map(|(cycle, _)| *cycle)
        .collect();
    assert_eq!(enters.len(), 2);
    let part = check(&["--triangle", "1"]);
    assert_eq!(part.keys().next(), Some(&enters[1]));
    let last = whole.iter().rfind(|(_, values)| is(values, "wr_valid")).map(|(cycle, _)| cycle + 1);
    assert_eq!(part.keys().last().copied(), last);
}

#[test]
fn a_part_that_is_not_there_is_refused() {
    for (arguments, said) in [
        (
            &["--from", "9", "--to", "8"][..],
            "--from 9 --to 8: the last cycle is before the first; permitted: --to 9 or more",
        ),
        (&["--from", "99999999"], "--from 99999999: the run ends after "),
        (&["--pixel", "24", "0"], "--pixel 24 0: is off the screen; permitted: 0 0 to 23 19"),
        (&["--pixel", "0", "0"], "--pixel 0 0: nothing of 2 triangles writes it"),
        (&["--triangle", "2"], "--triangle 2: permitted: 0 to 1"),
        (&["--triangles", "0"], "invalid value '0' for '--triangles <TRIANGLES>': 0 is not in 1.."),
        (&["--cycles", "0"], "invalid value '0' for '--cycles <CYCLES>': 0 is not in 1.."),
        (&["--triangle", "0", "--from", "3"], "cannot be used with"),
    ] {
        let (code, text, file) = part(arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {text}");
        assert!(text.contains(said), "{arguments:?}: {text}");
        assert!(file.is_empty(), "{arguments:?}");
    }
}

/// The netlist of a machine that shades at each pixel has the records of its triangles: it takes the cycles that the model takes.
#[test]
fn a_shaded_frame_takes_the_models_cycles() {
    let folder = tempfile::tempdir().expect("a folder");
    let cycles = |command: &[&str]| {
        let mesh =
            ["sphere", "--triangles", "40", "--shading", "fast-phong", "--set", "shade.kind=fast-phong"];
        let screen = ["--set", "screen.width=160", "--set", "screen.height=120", "--json"];
        let output = edgewalk(folder.path(), &[command, &mesh, &screen].concat()).output().expect("runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a document");
        told["cycles"].as_u64().expect("a number")
    };
    let [traced, recorded] = [&["trace", "--out", "a.saif"][..], &["replay", "--out", "a.json"]].map(cycles);
    assert_eq!(traced, recorded);
    assert!(recorded > 1000, "{recorded}");
}
