//! The emitted directory, its Makefile run as a user runs it: it compares what it is told to compare, all of it, and nothing
//! else passes. For each line of the bench that keeps a wrong design out there is one that only this line keeps out:
//! without the line it passes.

use crate::common;
use crate::common::{made, write};
use edgewalk_vectors::{Files, StallKind, Suite, Tables, Unit, capture, design, directory};
use std::path::{Path, PathBuf};

/// Cases of the hazards, small; more of the bench would only take longer.
fn files(unit: Unit) -> Files {
    let machine = common::small();
    let mut suite = Suite::named(&machine, "hazards", 1, 0).expect("listed");
    suite.cases.truncate(4);
    let trace = capture(&machine, unit, &suite, suite.state, StallKind::Mixed);
    let verilog = design::verilog(&machine, unit).expect("a checked machine");
    directory(&suite, &trace, &verilog, Tables::LeftOut)
}

/// A directory on disk, and the name in it of the unit's own file.
struct Place {
    folder: tempfile::TempDir,
    own: String,
}

fn place(unit: Unit) -> Place {
    let folder = tempfile::tempdir().expect("a folder");
    write(&files(unit), folder.path());
    Place { folder, own: format!("hdl/{}.v", unit.module()) }
}

impl Place {
    fn path(&self) -> &Path {
        self.folder.path()
    }

    fn file(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.file(name)).expect("a file of the directory")
    }

    fn exchange(&self, name: &str, from: &str, to: &str) {
        let text = self.text(name);
        assert!(text.contains(from), "{name} has no `{from}`");
        std::fs::write(self.file(name), text.replacen(from, to, 1)).expect("written");
    }

    /// The design's other files, and this one in place of the unit's own.
    fn hdl(&self, mine: &str) -> String {
        let all = std::fs::read_dir(self.file("hdl")).expect("a folder");
        let mut names: Vec<String> = all
            .map(|entry| format!("hdl/{}", entry.expect("a file").file_name().to_string_lossy()))
            .collect();
        names.retain(|name| *name != self.own);
        names.push(mine.to_owned());
        format!("HDL={}", names.join(" "))
    }

    /// Drops the last line of a file.
    fn shorten(&self, name: &str) {
        let text = self.text(name);
        let (rest, _) = text.trim_end().rsplit_once('\n').expect("two lines at least");
        std::fs::write(self.file(name), format!("{rest}\n")).expect("written");
    }

    /// Makes the sums fit the files again, as the writer of other vectors would.
    fn sum_again(&self) {
        let names = self.text("SHA256SUMS");
        let names: Vec<&str> =
            names.lines().filter_map(|line| line.split_once("  ").map(|(_, name)| name)).collect();
        let output = std::process::Command::new("sha256sum").args(names).current_dir(self.path()).output();
        std::fs::write(self.file("SHA256SUMS"), output.expect("sha256sum is installed").stdout)
            .expect("written");
    }
}

/// A copy of ours under another name passes; after it a broken file fails, and a fault: what was compiled before is not run.
fn foreign_designs(unit: Unit, simulator: &str, from: &str, to: &str) {
    let place = place(unit);
    let design = place.text(&place.own);
    assert!(design.contains(from));
    std::fs::write(place.file("broken.v"), "module nonsense (;\n").expect("written");
    std::fs::write(place.file("faulty.v"), design.replacen(from, to, 1)).expect("written");
    // A file of someone else has no `timescale.
    std::fs::write(place.file("mine.v"), design.replacen("`timescale 1ns / 1ps\n", "", 1)).expect("written");
    let (passed, said) = made(place.path(), &[simulator, &place.hdl("mine.v")]);
    assert!(passed && said.lines().any(|line| line == "PASS"), "{simulator} {}: {said}", unit.name());
    let (passed, said) = made(place.path(), &[simulator, &place.hdl("broken.v")]);
    assert!(!passed, "{simulator} {}: a file that does not compile passes: {said}", unit.name());
    let (passed, said) = made(place.path(), &[simulator, &place.hdl("faulty.v")]);
    assert!(!passed && said.lines().any(|line| line == "FAIL"), "{simulator} {}: {said}", unit.name());
    let (passed, _) = made(place.path(), &[simulator, "HDL="]);
    assert!(!passed, "no design at all passes");
}

#[test]
fn hdl_names_what_is_compiled_and_nothing_else_is_icarus() {
    foreign_designs(common::DEPTH, "icarus", "rd_addr = frag_addr", "rd_addr = ~frag_addr");
    foreign_designs(Unit::MACHINE, "icarus", "assign wr_r = u_depth_wr_r", "assign wr_r = ~u_depth_wr_r");
}

#[test]
fn hdl_names_what_is_compiled_and_nothing_else_is_verilator() {
    foreign_designs(common::DEPTH, "verilator", "rd_addr = frag_addr", "rd_addr = ~frag_addr");
}

/// PIXEL with a register more at its output, and without the ports that tell of its state.
const LATER: &str = r"
module edgewalk_pixel (clk, rst, span_valid, span_ready, {in_ports}, frag_valid, frag_ready, {out_ports});
  input clk, rst, span_valid, frag_ready;
{inputs}
{outputs}
  output span_ready;
  output reg frag_valid;
  wire inner_valid;
{wires}
  wire inner_ready = !frag_valid || frag_ready;
  inner_pixel inner (.clk(clk), .rst(rst), .span_valid(span_valid), .span_ready(span_ready), {in_connections},
                     .frag_valid(inner_valid), .frag_ready(inner_ready), {out_connections});
  always @(posedge clk) begin
    if (rst) frag_valid <= 1'b0;
    else if (inner_ready) frag_valid <= inner_valid;
    if (inner_ready) begin
{loads}
    end
  end
endmodule
";

/// The same PIXEL a clock later.
fn later_pixel(place: &Place) -> String {
    let machine = common::small();
    let interface = edgewalk_vectors::Interface::new(&machine, common::PIXEL);
    let (span, frag) = (&interface.links[0].fields, &interface.links[1].fields);
    let lines = |fields: &[edgewalk_lockstep::Port], line: &dyn Fn(&str, u32) -> String, by: &str| {
        fields.iter().map(|f| line(&f.name, f.width())).collect::<Vec<_>>().join(by)
    };
    let text = LATER
        .replace("{in_ports}", &lines(span, &|port, _| port.to_owned(), ", "))
        .replace("{out_ports}", &lines(frag, &|port, _| port.to_owned(), ", "))
        .replace("{inputs}", &lines(span, &|port, w| format!("  input [{}:0] {port};", w - 1), "\n"))
        .replace("{outputs}", &lines(frag, &|port, w| format!("  output reg [{}:0] {port};", w - 1), "\n"))
        .replace("{wires}", &lines(frag, &|port, w| format!("  wire [{}:0] inner_{port};", w - 1), "\n"))
        .replace("{in_connections}", &lines(span, &|port, _| format!(".{port}({port})"), ", "))
        .replace("{out_connections}", &lines(frag, &|port, _| format!(".{port}(inner_{port})"), ", "))
        .replace("{loads}", &lines(frag, &|port, _| format!("      {port} <= inner_{port};"), "\n"));
    text + &place.text(&place.own).replace("module edgewalk_pixel", "module inner_pixel")
}

/// A design with other timing and without status ports: its cycles fail, its order and values pass, its wrong values do not.
#[test]
fn a_design_with_other_timing_is_judged_by_order_and_value() {
    let place = place(common::PIXEL);
    let design = later_pixel(&place);
    std::fs::write(place.file("later.v"), &design).expect("written");
    std::fs::write(place.file("wrong.v"), design.replacen("<= inner_frag_z;", "<= ~inner_frag_z;", 1))
        .expect("written");
    for simulator in ["icarus", "verilator"] {
        let (passed, said) = made(place.path(), &[simulator, "HDL=later.v", "CHECK_CYCLES=0"]);
        assert!(passed, "{simulator}: {said}");
        let (passed, said) = made(place.path(), &[simulator, "HDL=wrong.v", "CHECK_CYCLES=0"]);
        assert!(!passed && said.contains("frag_z: expected "), "{simulator}: {said}");
    }
    let (passed, said) = made(place.path(), &["icarus", "CHECK_CYCLES=no"]);
    assert!(!passed && said.contains("CHECK_CYCLES=no: 0 or 1"), "{said}");
    // With the cycles it fails: here the status ports are asked for, which it has not.
    assert!(!made(place.path(), &["icarus", "HDL=later.v"]).0);
}

/// A port of another width is named with the width found and the width needed, and nothing is compared; in either simulator.
#[test]
fn a_port_of_another_width_is_refused() {
    let place = place(common::PIXEL);
    let design = place.text(&place.own);
    // Each port but clock and reset is asked for its width.
    let bench = place.text("tb.v");
    let (mut asked, ports) = (0, design.split_once("\n);").expect("a list of ports").0);
    let ports =
        ports.lines().map(|line| line.split("//").next().unwrap_or_default().trim().trim_end_matches(','));
    for port in ports.filter(|line| ["input ", "output "].iter().any(|way| line.starts_with(way))) {
        let name = port.rsplit(' ').next().expect("a name");
        let high = port.split_once('[').and_then(|(_, range)| range.split_once(':'));
        let width = high.map_or(1, |(high, _)| high.parse::<u32>().expect("a number") + 1);
        if !["clk", "rst"].contains(&name) {
            assert!(
                bench.contains(&format!("port_has(\"{name}\", $bits(dut.{name}), {width});")),
                "{name}: {bench}"
            );
            asked += 1;
        }
    }
    assert!(asked > 20 && bench.matches("port_has(").count() == asked, "{asked} ports");
    // One port is narrower than its values, one wider.
    let declared = |line: &str| match line.split_once("//").map_or(line, |(port, _)| port).trim() {
        port if port.ends_with(" frag_z,") => line.replace("[7:0]", "[5:0]") + "\n",
        port if port.ends_with(" span_y,") => line.replace("[4:0]", "[8:0]") + "\n",
        _ => format!("{line}\n"),
    };
    let unfit: String = design.lines().map(declared).collect();
    assert!(unfit.contains("[5:0] frag_z,") && unfit.contains("[8:0] span_y,"), "{design}");
    std::fs::write(place.file("unfit.v"), unfit).expect("written");
    for simulator in ["icarus", "verilator"] {
        for cycles in ["CHECK_CYCLES=1", "CHECK_CYCLES=0"] {
            let (passed, said) = made(place.path(), &[simulator, "HDL=unfit.v", cycles]);
            assert!(!passed, "{simulator}: {said}");
            for told in [
                "port frag_z of edgewalk_pixel: found 6 bits, needed 8\n",
                "port span_y of edgewalk_pixel: found 9 bits, needed 5\n",
                "checked 0 / ",
                "FAIL: ports of another width; nothing was compared\n",
            ] {
                assert!(said.contains(told), "{simulator} {cycles}: {told}: {said}");
            }
            assert_eq!(said.matches("found ").count(), 2, "{simulator}: {said}");
            assert!(!said.contains("wrong ") && !said.contains("PASS"), "{simulator}: {said}");
        }
    }
}

/// Whoever reads what a run prints may stop reading: the verdict is that of the run.
#[test]
fn a_closed_pipe_does_not_end_a_run() {
    let place = place(common::DEPTH);
    let status = |target: &str| {
        let mut make = std::process::Command::new("make");
        // With -C make itself would write about folders.
        make.env_remove("MAKEFLAGS").env_remove("MAKELEVEL").current_dir(place.path()).arg(target);
        let mut make = make.stdout(std::process::Stdio::piped()).spawn().expect("make is installed");
        drop(make.stdout.take());
        make.wait().expect("it ends")
    };
    assert!(status("icarus").success());
    let log = place.text("icarus.log");
    assert!(log.lines().any(|line| line.starts_with("edgewalk ") && line.ends_with(": PASS")), "{log}");
    silent(&place);
    assert!(!status("icarus").success());
}

/// A program that is not there is named, with what installs it, before anything is judged.
#[test]
fn a_missing_tool_is_named_with_what_installs_it() {
    let place = place(common::DEPTH);
    let tools = place.file("tools");
    std::fs::create_dir(&tools).expect("a folder");
    for tool in ["sh", "cat", "grep", "sha256sum"] {
        let found = std::process::Command::new("sh").args(["-c", &format!("command -v {tool}")]).output();
        let found = String::from_utf8(found.expect("sh").stdout).expect("a path");
        std::os::unix::fs::symlink(found.trim(), tools.join(tool)).expect("a link");
    }
    let said = |arguments: &[&str]| {
        let mut make = std::process::Command::new("sh");
        make.args(["-c", "make=$(command -v make); PATH=$0; exec \"$make\" -C \"$@\" 2>&1"]);
        let output = make.arg(&tools).arg(place.path()).args(arguments).output().expect("make is installed");
        assert!(!output.status.success());
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    for (arguments, told) in [
        (
            &["icarus"][..],
            "iverilog is not installed; try: apt-get install -y --no-install-recommends iverilog\n",
        ),
        (
            &["verilator"],
            "verilator is not installed; try: apt-get install -y --no-install-recommends verilator make g++\n",
        ),
        (&["lint"], "verilator is not installed; try: apt-get install"),
        (
            &["icarus", "SHA256SUM=sha256 -x"],
            "sha256 is not installed; name another program: make SHA256SUM=",
        ),
    ] {
        let said = said(arguments);
        assert!(said.contains(told), "{arguments:?}: {said}");
    }
}

/// Something wrong that one line of the bench keeps out.
struct Guard {
    name: &'static str,
    unit: Unit,
    arguments: &'static [&'static str],
    /// Makes it wrong.
    wrong: fn(&Place),
    /// File, text and replacement: the bench without its line.
    line: (&'static str, &'static str, &'static str),
}

const GUARDS: [Guard; 9] = [
    Guard {
        name: "outputs are missing",
        unit: common::DEPTH,
        arguments: &[],
        wrong: silent,
        line: ("tb.v", "|| checked != EXPECTED ", ""),
    },
    Guard {
        name: "outputs are missing, the bench says FAIL",
        unit: common::DEPTH,
        arguments: &[],
        wrong: silent,
        line: ("Makefile", "grep -q \"$(MARK) PASS$$\" $(1) && ", ""),
    },
    Guard {
        name: "the file of expected tokens ends early",
        unit: common::DEPTH,
        arguments: &[],
        wrong: |place| {
            place.shorten("wr.exp.mem");
            place.sum_again();
        },
        line: ("bench_sink.v", "data !== want", "data != want"),
    },
    Guard {
        name: "the design gives a token more than there are vectors",
        unit: common::DEPTH,
        arguments: &[],
        wrong: |place| {
            for file in ["wr.exp.mem", "wr.cyc.mem", "wr.triangle.mem"] {
                place.shorten(file);
            }
            let count = place.text("wr.exp.mem").lines().count();
            place.exchange(
                "params.vh",
                &format!("WR_COUNT = {};", count + 1),
                &format!("WR_COUNT = {count};"),
            );
            place.sum_again();
        },
        line: ("bench_sink.v", ": extra                                 ? 3'd1", ": extra ? 3'd0"),
    },
    Guard {
        name: "a valid is unknown",
        unit: common::PIXEL,
        arguments: &["CHECK_CYCLES=0"],
        wrong: |place| unsure(place, "tb.compared"),
        line: ("bench_sink.v", "(fire === 1'bx || ^data === 1'bx)", "(^data === 1'bx)"),
    },
    Guard {
        name: "data are unknown, and so are those expected",
        unit: common::PIXEL,
        arguments: &["CHECK_CYCLES=0"],
        wrong: |place| {
            let design = place.text(&place.own);
            let unknown = |line: &str| match line.trim_start().split_once(" <= ") {
                Some((port, _)) if port.starts_with("frag_") && port != "frag_valid" => {
                    format!("{port} <= 'bx;\n")
                }
                _ => format!("{line}\n"),
            };
            std::fs::write(place.file(&place.own), design.lines().map(unknown).collect::<String>())
                .expect("written");
            let params = place.text("params.vh");
            let (_, width) = params.split_once("FRAG_WIDTH = ").expect("the bits of a token");
            let width: usize = width.split_once(';').expect("a number").0.parse().expect("a number");
            let unknown = "x".repeat(width.div_ceil(4)) + "\n";
            let tokens = unknown.repeat(place.text("frag.exp.mem").lines().count());
            std::fs::write(place.file("frag.exp.mem"), tokens).expect("written");
            place.sum_again();
        },
        line: ("bench_sink.v", "(fire === 1'bx || ^data === 1'bx)", "(fire === 1'bx)"),
    },
    Guard {
        name: "a valid is unknown in the first run",
        unit: common::PIXEL,
        arguments: &[],
        wrong: |place| unsure(place, "!tb.compared"),
        line: ("tb.v", " + (frag_early != 0 ? 1 : 0)", ""),
    },
    Guard {
        name: "a valid keeps its token in the second reset",
        unit: common::DEPTH,
        arguments: &[],
        wrong: |place| keeps_its_write(place),
        line: ("bench_taker.v", " && !rst && !keep", " && !keep"),
    },
    Guard {
        name: "a file of vectors is not the one that was written",
        unit: common::DEPTH,
        arguments: &[],
        wrong: |place| place.exchange("wr.triangle.mem", "1\n", "2\n"),
        line: ("Makefile", "icarus: check", "icarus:"),
    },
];

/// PIXEL whose valid is unknown for half of its tokens while a condition holds.
fn unsure(place: &Place, when: &str) {
    let sure = place.text(&place.own).replace("frag_valid", "sure");
    let port = "output reg         sure,";
    assert!(sure.contains(port));
    let valid = format!("sure && (frag_addr[0] && {when} ? 1'bx : 1'b1)");
    let own = format!(");\n  reg sure;\n  assign frag_valid = {valid};\n");
    let sure = sure.replace(port, "output wire frag_valid,").replacen(");\n", &own, 1);
    std::fs::write(place.file(&place.own), sure).expect("written");
}

/// DEPTH whose output register no reset reaches.
fn keeps_its_write(place: &Place) {
    place.exchange(
        &place.own,
        "    if (rst) begin\n      wr_valid <= 1'b0;\n    end else begin\n",
        "    begin\n",
    );
    place.exchange(&place.own, "wr_valid, ", "wr_valid = 1'b0, ");
}

/// DEPTH that never reads.
fn silent(place: &Place) {
    place.exchange(&place.own, "rd_valid = frag_valid && clear_to_read", "rd_valid = 1'b0");
}

#[test]
fn each_line_of_the_bench_keeps_something_out() {
    for guard in &GUARDS {
        let place = place(guard.unit);
        let arguments = [&["icarus"], guard.arguments].concat();
        let (passed, said) = made(place.path(), &arguments);
        assert!(passed, "{}: before: {said}", guard.name);
        (guard.wrong)(&place);
        let (passed, said) = made(place.path(), &arguments);
        assert!(!passed, "{} passes: {said}", guard.name);
        let (file, text, replacement) = guard.line;
        place.exchange(file, text, replacement);
        let (passed, said) = made(place.path(), &arguments);
        assert!(passed, "{}: another line finds it too, so this one is not tested: {said}", guard.name);
    }
    println!("checked {0} / {0} lines of the bench", GUARDS.len());
}

/// One digit below what rounding leaves: only the sums can see it.
#[test]
fn a_flipped_digit_of_the_input_is_found_before_anything_runs() {
    let place = place(Unit::MACHINE);
    let tokens = place.text("tri.in.mem");
    let last = tokens.lines().nth(2).expect("three triangles");
    let flipped = format!("{}{}", &last[..last.len() - 1], if last.ends_with('0') { '1' } else { '0' });
    place.exchange("tri.in.mem", last, &flipped);
    for target in ["icarus", "verilator"] {
        let (passed, said) = made(place.path(), &[target]);
        assert!(!passed && said.contains("tri.in.mem: FAILED"), "{target}: {said}");
        assert!(!said.contains("checked "), "{target}: {said}");
    }
}

/// What is wrong is said in full: channel, token, triangle, case, the whole token, and each field that differs.
#[test]
fn a_fault_is_told_by_channel_token_triangle_case_and_field() {
    let place = place(common::DEPTH);
    place.exchange(&place.own, "place0_fwd_valid ? place0_fwd_z : data_z", "data_z");
    let (passed, said) = made(place.path(), &["icarus"]);
    assert!(!passed);
    let token = said.lines().find(|line| line.starts_with("wr: token ")).expect(&said);
    for word in [", triangle ", ", case one_pixel_again_", ", cycle ", ": expected ", ", found "] {
        assert!(token.contains(word), "{token}");
    }
    assert!(said.lines().any(|line| line.starts_with("    wr_z: expected ") && line.contains("(")), "{said}");
    // A write that never comes names what it belongs to.
    place.exchange(&place.own, "wr_valid <= pass;", "wr_valid <= 1'b0;");
    let (_, said) = made(place.path(), &["icarus"]);
    let missing = "wr: token 0, triangle 0, case one_pixel_again_and_again_nearer never came, the first of ";
    assert!(said.contains(missing), "{said}");
    // The status by its ports.
    let place = self::place(common::DEPTH);
    place.exchange(&place.own, "occupied = (|count) || wr_valid", "occupied = (|count)");
    let (passed, said) = made(place.path(), &["icarus"]);
    assert!(
        !passed
            && said.contains("status: change ")
            && said.contains("    occupied: expected 1 (1), found 0 (0)"),
        "{said}"
    );
}
