//! What is written reads back, says what it is, and is refused when it is not that.

use crate::common;
use edgewalk_machine::Plan;
use edgewalk_model::{DrawState, Drawn, Stalls, render_with};
use edgewalk_vectors::{
    Files, ReadError, Runs, SUITES, StallKind, Suite, Tables, Unit, capture, directory, manifest,
    not_covered, reached, read,
};
use serde_json::Value;
use std::collections::BTreeSet;

fn suite(machine: &Plan, name: &str) -> Suite {
    Suite::named(machine, name, 5, 12).expect("listed")
}

/// What moved to the memories.
fn wr(trace: &edgewalk_vectors::Trace) -> &edgewalk_vectors::LinkTrace {
    trace.link("wr").expect("it writes")
}

fn small_directory() -> Files {
    let machine = common::small();
    let suite = suite(&machine, "hazards");
    let trace = capture(&machine, Unit::MACHINE, &suite, DrawState::default(), StallKind::Mixed);
    directory(&suite, &trace, &[], Tables::Written)
}

fn read_files(files: &Files) -> Result<edgewalk_vectors::Vectors, ReadError> {
    read(|name| {
        let found = files.iter().find(|(n, _)| n == name);
        found.map(|(_, bytes)| bytes.clone()).ok_or_else(|| std::io::Error::other("no such file"))
    })
}

fn replace(files: &Files, name: &str, from: &str, to: &str) -> Files {
    let mut files = files.clone();
    let (_, bytes) = files.iter_mut().find(|(n, _)| n == name).expect("written");
    let text = String::from_utf8(bytes.clone()).expect("text");
    assert!(text.contains(from), "{name} has no {from}");
    *bytes = text.replacen(from, to, 1).into_bytes();
    files
}

#[test]
fn the_trace_is_that_of_the_model_drawing_alone() {
    let mut compared = 0;
    for (name, machine) in common::twelve() {
        for entry in SUITES.iter().filter(|entry| entry.is_for(&machine)) {
            let suite = suite(&machine, entry.name);
            // The model draws on the farthest depth.
            if suite.clear_z.is_some() {
                continue;
            }
            let trace = capture(&machine, Unit::MACHINE, &suite, DrawState::default(), StallKind::None);
            let mut writes = Vec::new();
            let triangles = suite.triangles().copied();
            let drawn = render_with(&machine, triangles, DrawState::default(), Stalls::NONE, |event| {
                if let Drawn::Write(w) = event {
                    let values = w.values.iter().map(|value| u128::from(*value));
                    writes.push([u128::from(w.addr)].into_iter().chain(values).collect::<Vec<u128>>());
                }
            });
            drawn.expect("triangles of this machine");
            let link = trace.interface.link("wr").expect("the machine writes");
            let channels = machine.channels().iter().map(|channel| channel.name);
            let places: Vec<usize> = ["addr"]
                .into_iter()
                .chain(channels)
                .map(|field| link.place(field).expect("a write has it"))
                .collect();
            let cut = |token: &Vec<u128>| places.iter().map(|place| token[*place]).collect::<Vec<u128>>();
            let traced: Vec<_> = wr(&trace).tokens.iter().map(cut).collect();
            assert!(!writes.is_empty());
            assert_eq!(traced, writes, "{name}, {}", entry.name);
            let stalled = capture(&machine, Unit::MACHINE, &suite, DrawState::default(), StallKind::Late);
            assert_eq!(wr(&stalled).tokens, wr(&trace).tokens, "{name}, {}", entry.name);
            compared += 1;
        }
    }
    assert_eq!(compared, 12 * 4);
}

/// The units, each alone under stalls, one behind the other, draw what the machine draws.
#[test]
fn the_units_one_behind_the_other_are_the_machine() {
    for (name, machine) in common::twelve() {
        let suite = suite(&machine, "corners");
        let whole = capture(&machine, Unit::MACHINE, &suite, DrawState::default(), StallKind::Mixed);
        let depth = capture(&machine, common::DEPTH, &suite, DrawState::default(), StallKind::Mixed);
        assert!(wr(&whole).tokens.len() > 100);
        assert_eq!(wr(&whole).tokens, wr(&depth).tokens, "{name}");
        assert_eq!(wr(&whole).triangles, wr(&depth).triangles, "{name}");
    }
}

/// A corner that no suite reaches is a corner that is not tested.
#[test]
fn directed_suites_reach_every_hazard_and_corner() {
    let mut reached = edgewalk_model::Events::default();
    let machines = all().chain(common::lined()).chain(common::polygonal());
    for (i, (_, machine)) in machines.enumerate() {
        let lines = machine.polygon.has_lines().then_some("lines");
        let light = machine.shadow.is_there().then_some(["light", "light_off"]);
        let own = machine.shadow.draws_map().then_some(["own_map", "own_picture"]);
        let shade = machine.shade.is_there().then_some("shade");
        let of_light = light.into_iter().chain(own).flatten();
        let dither = machine.dither.is_there().then_some("dither");
        let polygons = machine.polygon.is_there().then_some(["polygon", "polygon_corners"]);
        let own = of_light.chain(shade).chain(dither).chain(lines).chain(polygons.into_iter().flatten());
        for (j, name) in ["hazards", "corners", "sphere"].into_iter().chain(own).enumerate() {
            let (suite, stalls) = (suite(&machine, name), [StallKind::Mixed, StallKind::Late][(i + j) % 2]);
            reached.merge(&capture(&machine, Unit::MACHINE, &suite, suite.state, stalls).events);
        }
    }
    println!("{:#?}", reached.counts());
    assert_eq!(reached.missing(), Vec::<&str>::new());
}

/// Every machine there is here, but of those with SHADE, whose tables take long to come, one with each kind of it.
fn all() -> impl Iterator<Item = (&'static str, Plan)> {
    let shades = common::shades().into_iter().enumerate();
    let shades = shades.filter(|(i, _)| [3, 5, 6, 8].contains(i)).map(|(_, machine)| machine).collect();
    let units = [common::glass(), common::lights(), shades, common::dithers()];
    common::twelve().into_iter().chain(units.into_iter().flatten())
}

/// What is shipped for every third machine, under the stalls it is shipped with, leaves nothing unmet that its unit of its machine can meet; and
/// what cannot be met there is not asked for.
#[test]
fn the_shipped_suites_leave_nothing_uncovered() {
    let (mut lists, mut expected) = (0, 0);
    for (name, machine) in all().step_by(3) {
        let units = Unit::all(&machine);
        expected += units.len();
        let mut reached_by: Vec<Vec<_>> = vec![Vec::new(); units.len()];
        for entry in SUITES.iter().filter(|entry| entry.is_for(&machine)) {
            let suite = suite(&machine, entry.name);
            let runs = Runs::new(&machine, &suite, suite.state);
            for (unit, list) in units.iter().zip(&mut reached_by).filter(|(unit, _)| suite.is_for(**unit)) {
                list.push(reached(&runs.capture(*unit, suite.stalls)));
            }
        }
        for (unit, runs) in units.iter().zip(&reached_by) {
            assert_eq!(not_covered(runs), Vec::<&str>::new(), "{name}, {}", unit.name());
            lists += 1;
        }
    }
    assert_eq!(lists, expected);
    // Without stalls there is something to miss, and it is named.
    let machine = common::small();
    let hazards = suite(&machine, "hazards");
    let smooth = reached(&capture(&machine, common::DEPTH, &hazards, hazards.state, StallKind::None));
    assert_eq!(not_covered([&smooth]), ["memory_stall", "queue_full", "write_stall"]);
    let pixel = reached(&capture(&machine, common::PIXEL, &hazards, hazards.state, StallKind::None));
    assert_eq!(pixel.keys().copied().collect::<Vec<_>>(), ["fence", "off_screen"]);
}

/// A hazard that draws nothing is none.
#[test]
fn every_triangle_of_the_hazards_is_drawn() {
    for (name, machine) in common::twelve().into_iter().filter(|(name, _)| *name != "tiny") {
        let suite = suite(&machine, "hazards");
        let trace = capture(&machine, common::PIXEL, &suite, DrawState::default(), StallKind::None);
        let drawn: BTreeSet<u32> =
            trace.link("frag").expect("PIXEL gives it").triangles.iter().copied().collect();
        let missing = (0u32..).zip(suite.triangles()).filter(|(k, _)| !drawn.contains(k));
        let missing: Vec<&str> =
            missing.filter_map(|(k, _)| suite.case_of(k as usize)).map(|case| &*case.name).collect();
        assert_eq!(missing, Vec::<&str>::new(), "{name}");
        assert!(drawn.len() > 80);
    }
}

#[test]
fn what_is_written_reads_back() {
    for unit in Unit::all(&common::small()) {
        let machine = common::small();
        let suite = suite(&machine, "corners");
        let trace = capture(&machine, unit, &suite, DrawState::default(), StallKind::Mixed);
        let files = directory(&suite, &trace, &[], Tables::Written);
        let vectors = read_files(&files).expect("just written");
        assert!(vectors.manifest.expected > 0);
        assert_eq!(vectors.manifest.expected, trace.expected());
        // A difference is told by its case, so each says which triangles are its own.
        let mut first = 0;
        for (told, case) in vectors.manifest.suite.cases.iter().zip(&suite.cases) {
            let count = case.triangles.len() as u64;
            assert_eq!((&told.name, told.first, told.count), (&case.name, first, count));
            first += count;
        }
        assert_eq!(
            (vectors.manifest.suite.cases.len(), vectors.manifest.suite.triangles),
            (suite.cases.len(), first)
        );
        let served: Vec<&str> =
            trace.interface.memories.iter().map(|m| trace.interface.links[m.data].name).collect();
        for ((read, moved), link) in vectors.channels.iter().zip(&trace.links).zip(&trace.interface.links) {
            let written: Vec<_> = moved.tokens.iter().cloned().zip(moved.cycles.iter().copied()).collect();
            // The words of a memory follow from what is read and written.
            assert_eq!(read, if served.contains(&link.name) { &[][..] } else { &written });
        }
        let status: Vec<_> = trace.status.iter().map(|(cycle, token)| (token.clone(), *cycle)).collect();
        assert_eq!(vectors.status, status);
        for (name, bytes) in &files {
            assert!(bytes.is_empty() || bytes.ends_with(b"\n"), "{name} has no newline at the end");
            assert!(!bytes.contains(&b'\r'), "{name}");
        }
    }
}

#[test]
fn what_is_not_as_written_is_refused() {
    let files = small_directory();
    let newer = replace(&files, manifest::FILE, "\"format_version\": 5", "\"format_version\": 6");
    let older = replace(&files, manifest::FILE, "\"format_version\": 5", "\"format_version\": 4");
    let other = replace(&files, manifest::FILE, "\"edgewalk-vectors\"", "\"something\"");
    let unknown = replace(&files, manifest::FILE, "\"unit\":", "\"colour\": 1, \"unit\":");
    let module = replace(&files, manifest::FILE, "\"module\": \"edgewalk\"", "\"module\": \"a; b\"");
    let flipped = replace(&files, "wr.cyc.mem", "1\n", "2\n");
    let mut shorter = files.clone();
    shorter.iter_mut().find(|(n, _)| n == "tri.in.mem").expect("written").1.pop();
    let length = shorter.iter().find(|(n, _)| n == "tri.in.mem").expect("written").1.len();
    let length = format!("tri.in.mem: {length} bytes");
    let mut value: Value = serde_json::from_slice(&files[0].1).expect("JSON");
    value["channels"][0]["count"] = 1.into();
    let mut fewer = files.clone();
    fewer[0].1 = value.to_string().into_bytes();
    let mut missing = files.clone();
    missing.retain(|(n, _)| n != "tb.v");
    let cases = [
        (newer, "manifest.json: format_version 6: this program reads 5 only; write the directory again"),
        (older, "manifest.json: format_version 4: this program reads 5 only; write the directory again"),
        (other, "manifest.json: format is \"something\", not \"edgewalk-vectors\""),
        (unknown, "manifest.json: unknown field `colour`"),
        (module, "manifest.json: module \"a; b\" is no Verilog name"),
        (flipped, "wr.cyc.mem: SHA-256 "),
        (shorter, &length),
        (fewer, "tri.in.mem line "),
        (missing, "tb.v: no such file"),
    ];
    for (files, message) in cases {
        let error = read_files(&files).expect_err(message).to_string();
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn the_manifest_keeps_to_its_schema() {
    let schema: Value = serde_json::from_str(manifest::SCHEMA).expect("JSON");
    let (_, with_all) = common::shades().remove(6);
    let machines = [common::small(), with_all];
    let units =
        machines.iter().flat_map(|machine| Unit::all(machine).into_iter().map(move |unit| (machine, unit)));
    for (machine, unit) in units {
        let suite = suite(machine, "hazards");
        let trace = capture(machine, unit, &suite, suite.state, StallKind::Late);
        let files = directory(&suite, &trace, &[], Tables::Written);
        let value: Value = serde_json::from_slice(&files[0].1).expect("JSON");
        let mut checked = 0;
        validate(&schema, &schema, &value, "manifest", &mut checked);
        assert!(checked > 100, "{checked} values");
    }
}

#[test]
#[should_panic(expected = "manifest has no format_version")]
fn a_manifest_without_its_keys_is_found_out() {
    let schema: Value = serde_json::from_str(manifest::SCHEMA).expect("JSON");
    validate(&schema, &schema, &serde_json::json!({"format": "edgewalk-vectors"}), "manifest", &mut 0);
}

/// The part of JSON Schema that the schema uses.
fn validate(root: &Value, schema: &Value, value: &Value, path: &str, checked: &mut u32) {
    *checked += 1;
    for (keyword, rule) in schema.as_object().expect("a schema is an object") {
        match keyword.as_str() {
            "$schema" | "title" | "$defs" | "additionalProperties" => {}
            "$ref" => {
                let pointer = rule.as_str().expect("text").trim_start_matches('#');
                validate(root, root.pointer(pointer).expect("defined"), value, path, checked);
            }
            "const" => assert_eq!(value, rule, "{path}"),
            "enum" => assert!(rule.as_array().expect("a list").contains(value), "{path}: {value}"),
            "anyOf" => {
                let null = rule.as_array().expect("a list");
                if !(value.is_null() && null.iter().any(|s| s["type"] == "null")) {
                    validate(root, &null[0], value, path, checked);
                }
            }
            "type" => {
                let found = match value {
                    Value::String(_) => "string",
                    Value::Number(n) if n.is_u64() || n.is_i64() => "integer",
                    Value::Number(_) => "number",
                    Value::Object(_) => "object",
                    Value::Array(_) => "array",
                    Value::Bool(_) => "boolean",
                    Value::Null => "null",
                };
                assert_eq!(found, rule, "{path}");
            }
            "minimum" => assert!(value.as_u64() >= rule.as_u64(), "{path}"),
            "maximum" => assert!(value.as_u64() <= rule.as_u64(), "{path}"),
            "minItems" => {
                assert!(value.as_array().map(Vec::len) >= rule.as_u64().map(|n| n as usize), "{path}")
            }
            "maxItems" => {
                assert!(value.as_array().map(Vec::len) <= rule.as_u64().map(|n| n as usize), "{path}")
            }
            "pattern" => {
                // ^[set]{n}$ or ^[set]+$
                let rule = rule.as_str().expect("text");
                let text = value.as_str().expect("text");
                let set = if rule.contains("0-9a-f") { "0123456789abcdef" } else { "01" };
                assert!(!text.is_empty() && text.chars().all(|c| set.contains(c)), "{path}: {text}");
                let length = rule.split(['{', '}']).nth(1).map(|n| n.parse::<usize>().expect("a number"));
                assert!(length.is_none_or(|n| n == text.len()), "{path}: {text}");
            }
            "items" => {
                for (i, item) in value.as_array().expect("a list").iter().enumerate() {
                    validate(root, rule, item, &format!("{path}[{i}]"), checked);
                }
            }
            "required" => {
                for key in rule.as_array().expect("a list") {
                    let key = key.as_str().expect("text");
                    assert!(value.get(key).is_some(), "{path} has no {key}");
                }
            }
            "properties" => {
                for (key, item) in value.as_object().expect("an object") {
                    let rule = rule.get(key).unwrap_or_else(|| panic!("{path}.{key} is not in the schema"));
                    validate(root, rule, item, &format!("{path}.{key}"), checked);
                }
            }
            other => panic!("the schema uses {other}, which this test does not know"),
        }
        if keyword == "additionalProperties" && rule.is_object() {
            for (key, item) in value.as_object().expect("an object") {
                validate(root, rule, item, &format!("{path}.{key}"), checked);
            }
        }
    }
}
