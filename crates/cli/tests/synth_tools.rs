//! `edgewalk synth` with tools that print what the test wants: each figure of the report beside the outputs it comes from.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{TRIANGLE, edgewalk, ended};
use serde_json::{Value, json};
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::Output;

/// Clocks of the seeds 1 to 5, MHz. The median is that of seed 4, the slowest that of seed 2.
const CLOCKS: [f64; 5] = [61.0, 40.0, 70.0, 50.0, 45.0];
const MEDIAN: usize = 4;

fn tool(folder: &Path, name: &str, script: &str) {
    let path = folder.join("tools").join(name);
    std::fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
}

/// A critical path of a seed: five segments, each with a delay of its own.
fn path(seed: usize) -> Value {
    let at = |cell: &str, port: &str| json!({ "cell": cell, "loc": [1, 1], "port": port });
    let clock = "posedge clk$SB_IO_IN_$glb_clk";
    let [first, last] = [format!("dut.u_edge.first{seed}_DFFLC"), format!("dut.u_edge.last{seed}_DFFLC")];
    let net = format!("dut.u_edge.first{seed}[0]");
    json!({ "from": clock, "to": clock, "path": [
        { "delay": 0.5, "from": at("a", "CLK"), "to": at(&first, "O"), "type": "clk-to-q" },
        { "delay": 2.0 + seed as f64, "from": at("b", "O"), "net": net, "to": at("c", "I1"), "type": "routing" },
        { "delay": 0.25, "from": at("c", "I1"), "to": at("c", "COUT"), "type": "logic" },
        { "delay": 1.5, "from": at("c", "I1"), "to": at("c", "O"), "type": "logic" },
        { "delay": 4.0, "from": at("c", "O"), "net": "dut.u_span.middle[1]", "to": at(&last, "CEN"), "type": "routing" },
        { "delay": 0.125, "from": at("d", "CEN"), "to": at(&last, "CEN"), "type": "setup" }] })
}

/// Tools that give out files made here, and write down each run.
fn tools(folder: &Path) {
    std::fs::create_dir(folder.join("tools")).unwrap();
    let data = folder.join("data");
    std::fs::create_dir(&data).unwrap();
    let write = |name: &str, value: &Value| std::fs::write(data.join(name), value.to_string()).unwrap();
    let cells = |list: Value| json!({ "num_cells": 0, "num_cells_by_type": list });
    write(
        "stat.json",
        &json!({ "creator": "fed", "modules": {
            "\\edgewalk_span": cells(json!({ "SB_LUT4": 101, "SB_CARRY": 23, "SB_DFF": 31, "SB_DFFE": 6, "SB_RAM40_4K": 5, "SB_MAC16": 2, "edgewalk_span_fifo": 2 })),
            "\\edgewalk_span_fifo": cells(json!({ "SB_LUT4": 1000, "SB_DFFESR": 10 })),
            "\\harness": cells(json!({ "SB_LUT4": 90_000, "SB_DFF": 70_000, "edgewalk_span": 1 })) } }),
    );
    let packed = |of: &str, count: usize, kind: &str| -> serde_json::Map<String, Value> {
        (0..count).map(|k| (format!("{of}{k}"), json!({ "type": kind }))).collect()
    };
    let mut all = packed("dut.u_", 41, "ICESTORM_LC");
    all.extend(packed("harness_in_", 13, "ICESTORM_LC"));
    all.extend(packed("$nextpnr_ICESTORM_LC_", 3, "ICESTORM_LC"));
    all.extend(packed("clk$sb_io", 7, "SB_IO"));
    write("packed.json", &json!({ "modules": { "harness": { "cells": all } } }));
    let utilization =
        json!({ "ICESTORM_LC": { "used": 57, "available": 7680 }, "SB_IO": { "used": 7, "available": 256 } });
    for (place, mhz) in CLOCKS.iter().enumerate() {
        let fmax = json!({ "clk": { "achieved": mhz, "constraint": 12 } });
        let report = json!({ "critical_paths": [path(place + 1)], "fmax": fmax, "utilization": utilization });
        write(&format!("report{}.json", place + 1), &report);
    }
    let (runs, data) = (folder.join("runs").display().to_string(), data.display().to_string());
    tool(
        folder,
        "yosys",
        &format!(
            "if [ \"$1\" = -V ]; then cat {data}/yosys; exit; fi\necho yosys >> {runs}\ncp {data}/stat.json .; echo '{{}}' > netlist.json"
        ),
    );
    tool(
        folder,
        "nextpnr-ice40",
        &format!(
            "if [ \"$1\" = --version ]; then cat {data}/nextpnr; exit; fi\necho nextpnr >> {runs}\n\
             case \"$*\" in\n*--pack-only*) cp {data}/packed.json netlist.json; cp {data}/report1.json report.json;;\n\
             *) seed=$(echo \"$*\" | sed 's/.*--seed \\([0-9]*\\).*/\\1/'); cp {data}/report$seed.json report.json;;\nesac"
        ),
    );
    version(folder, "yosys", "Yosys fed 1");
    version(folder, "nextpnr", "nextpnr fed 1");
}

fn version(folder: &Path, tool: &str, text: &str) {
    std::fs::write(folder.join("data").join(tool), text).unwrap();
}

fn synth(folder: &Path, arguments: &[&str]) -> Output {
    let path = format!("{}:{}", folder.join("tools").display(), std::env::var("PATH").unwrap());
    let fixed = ["synth", "--cache", "cache"];
    edgewalk(folder, &[&fixed, arguments].concat()).env("PATH", path).output().unwrap()
}

fn report(folder: &Path, arguments: &[&str]) -> Value {
    let output = synth(folder, &[arguments, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

const SPAN: [&str; 4] = ["--unit", "span", "--target", "ice40-hx8k"];

#[test]
fn every_figure_comes_from_its_output() {
    let folder = tempfile::tempdir().unwrap();
    tools(folder.path());
    let told = report(folder.path(), &SPAN);
    let of = &told["targets"][0];
    // Modules in the design count, the harness does not.
    let cells = json!({ "lut4": 2101, "carry": 23, "ff": 57, "ram": 5, "dsp": 2, "mux": 0 });
    assert_eq!(of["cells"], cells);
    let packed =
        json!({ "cell": "ICESTORM_LC", "design": 44, "harness": 13, "available": 7680, "lacks": null });
    assert_eq!(of["packed"], packed);
    assert_eq!(of["mhz"], json!({ "median": 50.0, "min": 40.0, "max": 70.0 }));
    let seeds: Vec<Value> =
        CLOCKS.iter().zip(1..).map(|(mhz, seed)| json!({ "seed": seed, "mhz": mhz })).collect();
    assert_eq!(of["seeds"], json!(seeds));
    // The path is that of the seed it names, which is the median.
    let path = &of["critical_path"];
    let routing = 2.0 + MEDIAN as f64 + 4.0;
    assert_eq!((&path["seed"], &path["logic_ns"]), (&json!(MEDIAN), &json!(0.5 + 0.25 + 1.5 + 0.125)));
    assert_eq!((&path["routing_ns"], &path["lut4"], &path["carry"]), (&json!(routing), &json!(1), &json!(1)));
    let points = json!([
        { "name": format!("edge.first{MEDIAN}"), "ns": 0.5 },
        { "name": "span.middle", "ns": 0.5 + 2.0 + MEDIAN as f64 + 1.75 },
        { "name": format!("edge.last{MEDIAN}"), "ns": 2.375 + routing },
    ]);
    assert_eq!(path["points"], points);

    // The text says the same.
    let output = synth(folder.path(), &SPAN);
    let text = String::from_utf8(output.stdout).unwrap();
    for line in [
        format!(
            "machine {}, span; Verilog sha256 {}",
            told["machine"].as_str().unwrap(),
            told["verilog"].as_str().unwrap()
        ),
        "    Yosys fed 1".to_owned(),
        "    nextpnr fed 1".to_owned(),
        "    cells          LUT4  carry     FF   RAM   DSP    mux".to_owned(),
        "    span           2101     23     57     5     2      0".to_owned(),
        "    packed into 44 of 7680 ICESTORM_LC, and 13 for the harness".to_owned(),
        "    50.0 MHz, 40.0 to 70.0 over 5 seeds".to_owned(),
        "    critical path of seed 4: 12.4 ns, 2.4 in cells (1 LUT4, 1 carry), 10.0 in wires".to_owned(),
        "         0.5 edge.first4".to_owned(),
        "         8.2 span.middle".to_owned(),
        "        12.4 edge.last4".to_owned(),
        "results of tools: 7 from the cache, 0 new".to_owned(),
    ] {
        assert!(text.lines().any(|of| of == line), "`{line}` is missing:\n{text}");
    }
}

/// What an older tool said is not taken for what the new one would say.
#[test]
fn another_version_of_a_tool_runs_it_again() {
    let folder = tempfile::tempdir().unwrap();
    tools(folder.path());
    let counts = |told: &Value| [&told["cached"], &told["run"]].map(|count| count.as_u64().unwrap());
    assert_eq!(counts(&report(folder.path(), &SPAN)), [0, 7]);
    assert_eq!(counts(&report(folder.path(), &SPAN)), [7, 0]);
    version(folder.path(), "nextpnr", "nextpnr fed 2");
    assert_eq!(counts(&report(folder.path(), &SPAN)), [1, 6], "Yosys stays");
    version(folder.path(), "yosys", "Yosys fed 2");
    let told = report(folder.path(), &SPAN);
    assert_eq!(counts(&told), [0, 7], "all steps stand on Yosys");
    assert_eq!(told["targets"][0]["yosys"], "Yosys fed 2");
    let runs = std::fs::read_to_string(folder.path().join("runs")).unwrap();
    assert_eq!(runs.lines().filter(|line| *line == "yosys").count(), 2);
    assert_eq!(runs.lines().filter(|line| *line == "nextpnr").count(), 18);
}

/// A tool that prints what cannot be read, or nothing: no figure, and the reason.
#[test]
fn an_output_that_cannot_be_read_gives_no_figure() {
    let folder = tempfile::tempdir().unwrap();
    tools(folder.path());
    let data = folder.path().join("data");
    let whole = std::fs::read_to_string(data.join("report4.json")).unwrap();
    std::fs::write(data.join("report4.json"), r#"{"critical_paths": [], "fmax": {}, "utilization": {}}"#)
        .unwrap();
    let of = &report(folder.path(), &SPAN)["targets"][0];
    assert_eq!(of["mhz"], json!({ "median": (45.0 + 61.0) / 2.0, "min": 40.0, "max": 70.0 }));
    assert_eq!(of["critical_path"]["seed"], 5, "the slower of the two in the middle");
    assert!(of["reasons"][0].as_str().unwrap().starts_with("seed 4: nextpnr-ice40 failed"), "{of}");
    std::fs::write(data.join("report4.json"), whole).unwrap();
    std::fs::write(data.join("stat.json"), "ERROR").unwrap();
    version(folder.path(), "yosys", "Yosys fed 3");
    let output = synth(folder.path(), &SPAN);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("its stat.json cannot be read"), "{said}");
}

/// Where the disk is full a tool cuts its files, or writes none, and ends as if all were well.
#[test]
fn files_that_a_tool_cuts_are_not_kept() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    tools(at);
    let counts = |told: &Value| [&told["cached"], &told["run"]].map(|count| count.as_u64().unwrap());
    let first = report(at, &SPAN);
    // What is in the cache and cannot be read is made anew.
    let kept: Vec<_> = std::fs::read_dir(at.join("cache"))
        .unwrap()
        .flat_map(|step| std::fs::read_dir(step.unwrap().path()).unwrap())
        .collect();
    assert_eq!(kept.len(), 8);
    for file in kept {
        let file = std::fs::OpenOptions::new().write(true).open(file.unwrap().path()).unwrap();
        file.set_len(file.metadata().unwrap().len() - 3).unwrap();
    }
    let again = report(at, &SPAN);
    assert_eq!((counts(&again), &again["targets"]), ([0, 7], &first["targets"]));
    assert_eq!(counts(&report(at, &SPAN)), [7, 0]);

    let yosys = std::fs::read_to_string(at.join("tools/yosys")).unwrap();
    for (cut, said) in [
        ("", "yosys failed:\nit wrote no netlist.json"),
        (": > stat.json", "yosys failed:\nits stat.json cannot be read: EOF"),
        (
            "cp stat.json netlist.json; : > netlist.json",
            "yosys failed:\nits netlist.json cannot be read: EOF",
        ),
    ] {
        let writes = if cut.is_empty() { "exit" } else { "true" };
        let script = yosys.replace("\ncp ", &format!("\n{writes}\ncp ")) + cut;
        tool(at, "yosys", script.trim_start_matches("#!/bin/sh\n"));
        version(at, "yosys", said);
        let (code, error) = ended(&synth(at, &SPAN));
        assert!(code == Some(3) && error.contains(said), "{error}");
    }
    // The gates of standard cells come from Yosys too.
    tool(at, "yosys", "echo yosys");
    std::fs::write(at.join("a.tri"), TRIANGLE).unwrap();
    let path = format!("{}:{}", at.join("tools").display(), std::env::var("PATH").unwrap());
    let words = ["energy", "a.tri", "--machine", "small", "--cache", "cache"];
    let (code, error) = ended(&edgewalk(at, &words).env("PATH", path).output().unwrap());
    assert!(code == Some(3) && error.contains("yosys failed:\nit wrote no gates.json"), "{error}");
    // What was cut is made by the tools that write whole files.
    std::fs::write(at.join("tools/yosys"), yosys).unwrap();
    let whole = report(at, &SPAN);
    assert_eq!(whole["targets"][0]["cells"], first["targets"][0]["cells"]);
}

/// Words x bits, ports and rate of each memory outside the machine, and what of them the devices hold.
#[test]
fn frame_memories_are_counted_and_placed() {
    let folder = tempfile::tempdir().unwrap();
    tools(folder.path());
    // The outputs that are fed name no unit but span, so the cells are not known here; memories need no tool.
    let memories = |arguments: &[&str], target: &str| -> Value {
        let told = report(
            folder.path(),
            &[&["--unit", "depth", "--seeds", "1", "--target", target], arguments].concat(),
        );
        told["targets"][0]["memories"].clone()
    };
    depth_is_known(folder.path());
    let small = memories(&["--machine", "small"], "ice40-up5k");
    assert_eq!(
        small,
        json!([
            { "name": "depth", "words": 160 * 256, "bits": 16, "reads": 1.0, "writes": 1.0, "held_by": null, "reasons": [
                "160 EBR: 27 of 30 are left", "3 SPRAM: 1 access a clock, 2 are needed"] },
            { "name": "color", "words": 160 * 256, "bits": 15, "reads": 0.0, "writes": 1.0,
              "held_by": { "block": "SPRAM", "count": 3 } },
        ])
    );
    // Half the rate: one port is enough, but there are too few blocks for both.
    let half = memories(&["--machine", "small", "--set", "interpolator.adders=2"], "ice40-up5k");
    assert_eq!((&half[0]["reads"], &half[0]["writes"]), (&json!(0.5), &json!(0.5)));
    let held = |list: &Value| list.as_array().unwrap().iter().filter(|of| !of["held_by"].is_null()).count();
    assert_eq!((held(&half), half[1]["writes"].as_f64()), (1, Some(0.5)));
    // A screen that fits: 64 x 32 of 15 + 16 bits, in 8 + 8 blocks of 30.
    let tiny = ["--machine", "small", "--set", "screen.width=64", "--set", "screen.height=32"];
    let fits = memories(&tiny, "ice40-hx8k");
    let ebr = json!({ "block": "EBR", "count": 8 });
    assert_eq!(
        (&fits[0]["held_by"], &fits[1]["held_by"], fits[0]["words"].as_u64()),
        (&ebr, &ebr, Some(2048))
    );
    // With BLEND the colours are read too.
    let blend = memories(&[&tiny[..], &["--set", "blend.kind=constant"]].concat(), "ice40-hx8k");
    assert_eq!(blend.as_array().unwrap().len(), 1, "BLEND reads the colours, not DEPTH");

    let output = synth(
        folder.path(),
        &["--machine", "small", "--unit", "depth", "--seeds", "1", "--target", "ice40-up5k"],
    );
    let text = String::from_utf8(output.stdout).unwrap();
    for line in [
        "    memories        words  bits    reads   writes  held by",
        "      depth         40960    16     1.00     1.00  none (160 EBR: 27 of 30 are left; 3 SPRAM: 1 access a clock, 2 are needed)",
        "      color         40960    15     0.00     1.00  3 SPRAM",
    ] {
        assert!(text.lines().any(|of| of == line), "`{line}` is missing:\n{text}");
    }
}

/// Statistics of DEPTH: three blocks are its own.
fn depth_is_known(folder: &Path) {
    let modules = json!({ "modules": { "\\edgewalk_depth": { "num_cells_by_type": { "SB_LUT4": 1, "SB_RAM40_4K": 3 } } } });
    std::fs::write(folder.join("data/stat.json"), modules.to_string()).unwrap();
}

/// What the program says of a preset is what `synth` finds.
#[test]
fn presets_promise_no_memory_that_does_not_fit() {
    let folder = tempfile::tempdir().unwrap();
    tools(folder.path());
    depth_is_known(folder.path());
    let output = edgewalk(folder.path(), &["config", "explain"]).output().unwrap();
    let presets = String::from_utf8(output.stdout).unwrap();
    for (preset, target) in [("small", "ice40-up5k"), ("ecp5", "ecp5-25")] {
        let mut told = Value::Null;
        if target == "ice40-up5k" {
            let arguments = ["--machine", preset, "--unit", "depth", "--seeds", "1", "--target", target];
            told = report(folder.path(), &arguments)["targets"][0]["memories"].clone();
            assert!(told.as_array().unwrap().iter().any(|of| of["held_by"].is_null()), "{told}");
        }
        let line = presets.lines().find(|line| line.trim().starts_with(&format!("{preset} "))).unwrap();
        assert!(line.contains("its memories do not"), "{line}; {told}");
    }
}
