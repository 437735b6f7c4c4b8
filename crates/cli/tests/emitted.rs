//! Comments of emitted Verilog say what the machine does: they are compared with its code, its trace and its vectors.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::run;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

fn edgewalk(folder: &Path, arguments: &[&str]) {
    let (code, told) = run(folder, arguments);
    assert_eq!(code, Some(0), "{arguments:?}: {told}");
}

fn text(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

/// Emits a machine into the folder `hdl`.
fn emit(folder: &Path, machine: &[&str]) {
    edgewalk(folder, &[&["emit", "--quiet", "--out", "hdl"][..], machine].concat());
}

/// The comment behind the declaration of a port or register.
fn comment<'a>(verilog: &'a str, name: &str) -> &'a str {
    let declares = |line: &&str| {
        let code = line.split("//").next().unwrap().trim().trim_end_matches([',', ';']);
        code.ends_with(&format!(" {name}"))
    };
    let line = verilog.lines().find(declares).unwrap_or_else(|| panic!("no {name}"));
    line.split_once("// ").unwrap_or_else(|| panic!("no comment: {line}")).1
}

/// The comment of `kind` names a line where SETUP compares it with the code of a line, and nowhere else.
#[test]
fn comments_of_kind_name_the_codes_compared() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (machine, lines) in [
        (&["--machine", "polygon"][..], false),
        (&["--machine", "bilinear"], false),
        (&["--machine", "polygon", "--set", "polygon.lines=yes"], true),
    ] {
        emit(folder, machine);
        let [top, setup] = ["edgewalk", "edgewalk_setup"].map(|name| text(folder, &format!("hdl/{name}.v")));
        assert_eq!(setup.contains("== 2'd3"), lines, "{machine:?}");
        for told in [comment(&top, "tri_kind"), comment(&setup, "tri_kind"), comment(&setup, "kind")] {
            assert_eq!(told.contains("3 line"), lines, "{machine:?}: {told}");
            assert_eq!(told.contains("0 or 3 triangle"), !lines, "{machine:?}: {told}");
        }
    }
}

/// On 48 x 40 pixels, one over the other and over a side of the screen.
const TRIANGLES: &str = "size 48 40\n\
    T 2 2 0.2 1 0 0 0  40 12 0.5 0 1 0 0  4 35 0.8 0 0 1 0\n\
    T 3 3 0.1 1 0 0 0  60 14 0.4 0 1 0 0  5 36 0.7 0 0 1 0\n\
    T 40 3 0.9 1 0 0 0  47 20 0.4 0 1 0 0  -15 36 0.7 0 0 1 0\n";

/// The names of causes in a part of a sentence, in any list.
fn causes(part: &str) -> BTreeSet<&str> {
    part.split([',', ' ']).filter(|word| !["", "and"].contains(word)).collect()
}

/// In a trace PIXEL's `advance` is 0 in the causes that the comment calls stalls, and in no other. It is `active` in the
/// causes in which the comment has PIXEL step, and in no other cause that is no stall.
#[test]
fn comments_of_causes_tell_when_pixel_stalls() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("in.tri"), TRIANGLES).unwrap();
    let small = ["screen.width=48", "screen.height=40", "screen.guard_bits=7"];
    let small: Vec<&str> = small.iter().flat_map(|key| ["--set", key]).collect();
    let (mut cycles, mut met) = (0, BTreeSet::new());
    for (input, keys) in [
        (&["in.tri"][..], &["--set", "shadow.light=parallel"][..]),
        (
            &["in.tri"],
            &["--machine", "textbook", "--set", "memory.hazard=drain", "--set", "memory.latency=8"],
        ),
        (&["in.tri"], &["--set", "fifo.inflight=1", "--set", "memory.latency=8"]),
        (&["sphere", "--shading", "phong", "--triangles", "20"], &["--set", "shade.kind=phong"]),
    ] {
        let keys = [&small[..], keys].concat();
        emit(folder, &keys);
        let top = text(folder, "hdl/edgewalk.v");
        let told = top.split_once("// PIXEL steps in ").expect("a comment").1.split_once('.').unwrap().0;
        let (steps, stalls) = told.split_once(", and stalls in ").unwrap();
        let (steps, stalls) = (causes(steps), causes(stalls));
        let all = top.split_once("the single cause of the cycle: ").unwrap().1.split_once(".\n").unwrap().0;
        let all: Vec<&str> = all.split(' ').collect();
        let name: BTreeMap<u64, &str> =
            all.chunks(2).map(|code| (code[0].parse().unwrap(), code[1])).collect();
        assert!(steps.iter().chain(&stalls).all(|cause| name.values().any(|name| name == cause)), "{told}");

        edgewalk(folder, &[&["trace", "--quiet", "--out", "t.vcd"], input, &keys].concat());
        for values in cycles_of(&text(folder, "t.vcd"), &["activity", "u_pixel_advance", "u_pixel_active"]) {
            let [activity, advance, active] = values[..] else { panic!("three signals") };
            let cause = name[&activity];
            assert_eq!(advance == 0, stalls.contains(cause), "{keys:?}: {cause}: {told}");
            if advance == 1 {
                assert_eq!(active == 1, steps.contains(cause), "{keys:?}: {cause}: {told}");
            }
            met.insert(cause.to_owned());
            cycles += 1;
        }
    }
    println!("{cycles} cycles, causes {met:?}");
    let needed = ["draw", "offscreen", "hazard", "queue", "edge", "setup", "flush", "idle"];
    assert!(cycles > 1000 && needed.iter().all(|cause| met.contains(*cause)), "{cycles} cycles, {met:?}");
}

/// For each clock of a waveform the values of these signals of the machine, at the end of the clock.
fn cycles_of(vcd: &str, names: &[&str]) -> Vec<Vec<u64>> {
    let (header, changes) = vcd.split_once("$enddefinitions $end").unwrap();
    let id = |name: &&str| {
        // The machine's own signal is the first of that name.
        let line = header.lines().find(|line| line.contains(&format!(" {name} $end")));
        line.unwrap_or_else(|| panic!("no {name}")).split_whitespace().nth(3).unwrap().to_owned()
    };
    let ids: Vec<String> = names.iter().map(id).collect();
    let (mut values, mut found, mut known) = (vec![0; names.len()], Vec::new(), false);
    for line in changes.lines() {
        if let Some(time) = line.strip_prefix('#') {
            // A clock lasts 10 ns and begins with its rising edge; its values stand until the next one.
            if known && time.parse::<u64>().unwrap() % 10 == 0 {
                found.push(values.clone());
            }
            known = true;
            continue;
        }
        let (value, id) = match line.strip_prefix('b') {
            Some(word) => word.split_once(' ').unwrap(),
            None => line.split_at_checked(1).unwrap_or_default(),
        };
        if let Some(place) = ids.iter().position(|known| known == id) {
            values[place] = u64::from_str_radix(value, 2).unwrap_or(0);
        }
    }
    found
}

/// EDGE's header tells when a triangle is taken: before its first line, or behind its last. Its vectors show which.
#[test]
fn comments_of_edge_tell_when_triangles_are_taken() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut checked = 0;
    for (machine, stays) in [("default", false), ("hx8k", true), ("up5k", true)] {
        emit(folder, &["--machine", machine]);
        let edge = text(folder, "hdl/edgewalk_edge.v");
        let before = "the first line is valid in the cycle after the triangle was taken";
        let behind = "The triangle is taken behind its last line";
        assert_eq!((edge.contains(before), edge.contains(behind)), (!stays, stays), "{machine}");
        // An increment is a register of EDGE, or a wire from the port.
        assert_eq!(edge.contains("assign inc_z = prim_z_g;"), stays, "{machine}");
        assert_eq!(edge.contains("inc, held for PIXEL"), !stays, "{machine}");

        let out = format!("{machine}_v");
        let vectors = ["vectors", "--machine", machine, "--suite", "corners", "--unit", "edge", "--quiet"];
        edgewalk(folder, &[&vectors[..], &["--out", &out]].concat());
        let cycles = |file: &str| -> BTreeMap<u64, Vec<u64>> {
            let mut of_triangle: BTreeMap<u64, Vec<u64>> = BTreeMap::new();
            for row in text(folder, &format!("{out}/corners_edge/{file}.csv")).lines().skip(1) {
                let number = |column: usize| row.split(',').nth(column).unwrap().parse().unwrap();
                of_triangle.entry(number(2)).or_default().push(number(1));
            }
            of_triangle
        };
        let (prims, lines) = (cycles("prim"), cycles("line"));
        for (triangle, lines) in &lines {
            let taken = prims[triangle][0];
            let (first, last) = (lines[0], lines[lines.len() - 1]);
            assert!(if stays { taken > last } else { taken < first }, "{machine}: triangle {triangle}");
            checked += 1;
        }
    }
    println!("{checked} triangles");
    assert!(checked > 30, "{checked}");
}

/// The comment of the word port tells the number of words, and of each the format that the port for whole triangles has.
#[test]
fn comments_of_words_tell_number_and_formats() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut checked = 0;
    for keys in [&[][..], &["blend.kind=constant"], &["channels.extra=2", "channels.e0_kind=signed"]] {
        let keys: Vec<&str> = keys.iter().flat_map(|key| ["--set", key]).collect();
        emit(folder, &keys);
        // A port `tri_z0 // UQ24.4 LSB, depth of vertex 0` is a word.
        let whole = text(folder, "hdl/edgewalk.v");
        let ports = whole.lines().filter_map(|line| line.split_once(" tri_")?.1.split_once(','));
        let ports: Vec<(&str, &str)> = ports.filter(|(name, _)| !["valid", "ready"].contains(name)).collect();
        let formats = |part: &mut dyn Iterator<Item = &(&str, &str)>| -> Vec<String> {
            let word = |(name, told): &(&str, &str)| {
                let format = told.split_once("// ").unwrap().1.split(',').next().unwrap();
                format!("{}: {format}", name[..name.len() - 1].trim_end_matches('_'))
            };
            part.map(word).collect()
        };
        let of_vertex = formats(&mut ports.iter().filter(|(name, _)| name.ends_with('0')));

        emit(folder, &[&["--set", "setup.kind=sequenced"][..], &keys].concat());
        let [top, setup] = ["edgewalk", "edgewalk_setup"].map(|name| text(folder, &format!("hdl/{name}.v")));
        let told = comment(&top, "in_data");
        assert_eq!(told, comment(&setup, "in_data"));
        assert!(told.starts_with(&format!("{} words a triangle", ports.len())), "{told}");
        let runs = told.split_once("in turn: ").unwrap().1.split(". ").next().unwrap();
        let mut words = Vec::new();
        for run in runs.split("), ") {
            let (names, format) = run.trim_end_matches(')').split_once(" (").unwrap();
            words.extend(names.split(' ').map(|name| format!("{name}: {format}")));
        }
        assert_eq!(words, of_vertex, "{told}");
        assert_eq!(told.contains("Then kt"), ports.iter().any(|(name, _)| *name == "kt"), "{told}");
        checked += words.len();
    }
    println!("{checked} words");
    assert!(checked >= 20, "{checked}");

    // The bench's manifest says the same, and rounds to the formats of a link that the machine has.
    let vectors = ["vectors", "--machine", "hx8k", "--suite", "corners", "--unit", "setup"];
    edgewalk(folder, &[&vectors[..], &["--quiet", "--no-csv", "--out", "v"]].concat());
    let manifest = text(folder, "v/corners_setup/manifest.json");
    assert!(
        manifest
            .contains("18 words a triangle, each in the low bits. Of vertex 0, 1, 2 in turn: x y (Q14.8 px)")
    );
    assert!(manifest.contains("to the formats of the words of in_data,"), "{manifest:.3000}");
}

/// In a sequenced SETUP no part of a word is compared with a bare number, and each name has the value of its clause: the one
/// that stands in the ROM's words with this clause, and in no others.
#[test]
fn codes_of_the_program_have_names() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut checked = 0;
    for machine in ["hx8k", "up5k"] {
        emit(folder, &["--machine", machine]);
        let setup = text(folder, "hdl/edgewalk_setup.v");
        for part in ["act", "jump", "mode", "result_given"] {
            let bare = setup.lines().find(|line| {
                line.match_indices(&format!("({part} == ")).any(|(at, found)| {
                    line[at + found.len()..].starts_with(|first: char| first.is_ascii_digit())
                })
            });
            assert_eq!(bare, None, "{machine}");
        }
        let words: Vec<(u128, Vec<&str>)> = setup.lines().filter_map(word_of_listing).collect();
        for constant in setup.lines().filter_map(|line| line.trim().strip_prefix("localparam ")) {
            let (name, value) = constant.split_once(" = ").unwrap();
            let name = name.rsplit(' ').next().unwrap();
            let Some((part @ ("ACT" | "JUMP"), clause)) = name.split_once('_') else { continue };
            let value: u128 = value.split_once("'d").unwrap().1.trim_end_matches(';').parse().unwrap();
            // The part's place in a word: `act = listing_q[54:50];`.
            let place = setup.split_once(&format!(" {} = listing_q[", part.to_lowercase())).unwrap().1;
            let (high, low) = place.split_once(']').unwrap().0.split_once(':').unwrap();
            let (high, low): (u32, u32) = (high.parse().unwrap(), low.parse().unwrap());
            // A jump's clause has a label behind it.
            let clause = clause.to_lowercase().replace('_', " ");
            let is =
                |told: &&str| *told == clause || part == "JUMP" && told.starts_with(&format!("{clause} "));
            for (code, clauses) in &words {
                let part = code >> low & ((1 << (high - low + 1)) - 1);
                assert_eq!(part == value, clauses.iter().any(is), "{machine}: {name} in {clauses:?}");
            }
            checked += 1;
        }
    }
    println!("{checked} names");
    assert!(checked >= 60, "{checked}");
}

/// Code and clauses of a word: `listing[0] = 55'h4000400000000;     // rest ; words ; unsorted`.
fn word_of_listing(line: &str) -> Option<(u128, Vec<&str>)> {
    let (code, told) = line.trim().strip_prefix("listing[")?.split_once("// ")?;
    let code = code.split_once("'h")?.1.split(';').next()?;
    Some((u128::from_str_radix(code, 16).ok()?, told.split(" ; ").map(str::trim).collect()))
}
