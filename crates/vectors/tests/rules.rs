//! `rules.v` beside a design: ours keeps the rules of every channel, and a design that breaks one is found out, bound in Verilator
//! and looked at from outside in Icarus.

use crate::common::{self, made, two_at_a_time, write};
use edgewalk_machine::Plan;
use edgewalk_vectors::{StallKind, Suite, Tables, Unit, capture, design, directory};
use std::collections::BTreeMap;
use std::path::Path;

/// A directory of the first cases of the hazards, and the links that move a token there.
fn place(machine: &Plan, unit: Unit) -> (tempfile::TempDir, Vec<&'static str>) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut suite = Suite::named(machine, "hazards", 1, 0).expect("listed");
    suite.cases.truncate(4);
    let trace = capture(machine, unit, &suite, suite.state, StallKind::Mixed);
    let verilog = design::verilog(machine, unit).expect("a checked machine");
    write(&directory(&suite, &trace, &verilog, Tables::LeftOut), folder.path());
    let links = trace.interface.links.iter().zip(&trace.links);
    (folder, links.filter(|(_, moved)| !moved.tokens.is_empty()).map(|(link, _)| link.name).collect())
}

/// The links whose rules say that they are at work.
fn at_work(said: &str) -> Vec<&str> {
    let lines = said.lines().filter_map(|line| line.split_once("rules of ")?.1.strip_suffix(": at work"));
    let mut links: Vec<&str> = lines.collect();
    links.sort_unstable();
    links
}

/// All units of the machines, a unit of one name once.
fn units(machines: &[(&'static str, Plan)]) -> Vec<(Plan, Unit)> {
    let mut all = BTreeMap::new();
    for (_, machine) in machines {
        for unit in Unit::all(machine) {
            all.entry(unit.name()).or_insert_with(|| (machine.clone(), unit));
        }
    }
    all.into_values().collect()
}

/// Whatever the unit, bench, rules and design fit together; the design passes the bench, lint and all rules.
#[test]
fn every_unit_keeps_rules_of_its_channels() {
    let machines =
        [common::shades(), common::glass(), common::lights(), common::dithers(), common::polygonal()];
    let units = units(&machines.concat());
    let done = two_at_a_time(&units, |_, (machine, unit)| {
        let (folder, mut moved) = place(machine, *unit);
        let (passed, said) = made(folder.path(), &["icarus", "RULES=1"]);
        assert!(passed && !said.contains("rule broken"), "{}: {said}", unit.name());
        moved.sort_unstable();
        assert_eq!(at_work(&said), moved, "{}: {said}", unit.name());
        let (passed, said) = made(folder.path(), &["lint"]);
        assert!(passed, "{}: {said}", unit.name());
        moved.len()
    });
    assert!(units.len() >= 16, "{} units", units.len());
    assert!(done.iter().sum::<usize>() > 50, "{done:?} links");
}

fn exchange(folder: &Path, from: &str, to: &str) {
    let file = folder.join("hdl/edgewalk_pixel.v");
    let text = std::fs::read_to_string(&file).expect("a file of the directory");
    assert!(text.contains(from), "no `{from}`");
    std::fs::write(file, text.replacen(from, to, 1)).expect("written");
}

/// Text of the Verilog, what stands in its place, the rule that it breaks.
const FAULTS: [(&str, &str, &str); 4] = [
    (
        "      frag_valid <= emit;\n    end",
        "      frag_valid <= emit;\n    end else frag_valid <= 1'b0;",
        "frag: time N: valid fell before the token was taken",
    ),
    (
        "assign advance = !frag_valid || frag_ready;",
        "assign advance = 1'b1;",
        "frag: time N: the token changed before it was taken",
    ),
    (
        "frag_r <= r_value[",
        "frag_r <= {8{1'bx}} ^ r_value[",
        "frag: time N: unknown bits in a token that moves: N",
    ),
    (
        "assign span_ready = ",
        "assign span_ready = span_x[0] ? 1'bx : ",
        "span: time N: valid or ready is unknown",
    ),
];

/// The broken rules that were told, without times and values.
fn broken(said: &str) -> Vec<String> {
    let told = said.lines().filter_map(|line| line.split_once("rule broken: "));
    let told = told.map(|(_, line)| {
        let words = line.split(' ').map(|word| {
            let number = word.trim_end_matches(':');
            let is_number = number.chars().all(|c| c.is_ascii_hexdigit() || "xX".contains(c));
            if is_number && number.len() > 2 { word.replace(number, "N") } else { word.to_owned() }
        });
        words.collect::<Vec<_>>().join(" ")
    });
    told.collect()
}

#[test]
fn broken_rules_fail_in_icarus() {
    for (from, to, rule) in FAULTS {
        let (folder, _) = place(&common::small(), common::PIXEL);
        exchange(folder.path(), from, to);
        let (passed, said) = made(folder.path(), &["icarus", "RULES=1"]);
        assert!(!passed && broken(&said).iter().any(|told| told == rule), "{to}: {said}");
    }
}

#[test]
fn rules_bound_in_verilator_find_what_they_should() {
    let (folder, moved) = place(&common::small(), common::PIXEL);
    let (passed, said) = made(folder.path(), &["verilator", "RULES=1"]);
    assert!(passed && at_work(&said).len() == moved.len(), "{said}");
    // Verilator has no unknown bits.
    for (from, to, rule) in &FAULTS[..2] {
        let (folder, _) = place(&common::small(), common::PIXEL);
        exchange(folder.path(), from, to);
        let (passed, said) = made(folder.path(), &["verilator", "RULES=1"]);
        assert!(!passed && broken(&said).iter().any(|told| told == rule), "{to}: {said}");
    }
}

/// A token that waits shows another colour, and the right one in the clock in which it is taken: only the rule sees it.
#[test]
fn broken_rule_fails_where_tokens_are_right() {
    let (folder, _) = place(&common::small(), common::PIXEL);
    let file = folder.path().join("hdl/edgewalk_pixel.v");
    let text = std::fs::read_to_string(&file).expect("a file of the directory");
    let line = |line: &str| match line.trim_start().starts_with("output reg") && line.contains(" frag_r,") {
        true => line.replace("output reg ", "output wire"),
        false => line.replace("frag_r <= ", "kept <= "),
    };
    let kept = "\n  reg [3:0] kept;\n  assign frag_r = frag_ready ? kept : ~kept;\nendmodule";
    let edited = text.lines().map(line).collect::<Vec<_>>().join("\n").replacen("\nendmodule", kept, 1);
    std::fs::write(file, edited).expect("written");
    let (passed, said) = made(folder.path(), &["icarus"]);
    assert!(passed && said.lines().any(|line| line == "PASS"), "{said}");
    let (passed, said) = made(folder.path(), &["icarus", "RULES=1"]);
    let rule = "frag: time N: the token changed before it was taken";
    assert!(!passed && broken(&said).iter().any(|told| told == rule), "{said}");
}

/// A bench of somebody else's, which withdraws a span before it is taken. Each span has one pixel, on the screen.
const MY_BENCH: &str = "`timescale 1ns / 1ps
module my_bench;
    reg clk = 0, rst = 1, valid = 0;
    wire ready;
    always #5 clk = !clk;
    edgewalk_pixel my_instance (.clk(clk), .rst(rst), .span_valid(valid), .span_ready(ready), 
        {fields}, .frag_ready(1'b0));
    initial begin
        #22 rst = 0; valid = 1;
        #40 valid = 0;
        #40 $finish;
    end
endmodule
";

/// The commands of the page, with a bench of another name.
#[test]
fn rules_look_at_design_in_any_bench() {
    let (folder, _) = place(&common::small(), common::PIXEL);
    let interface = edgewalk_vectors::Interface::new(&common::small(), common::PIXEL);
    let fields = interface.links[0].fields.iter().map(|port| {
        let value = u32::from(port.name == "span_count");
        format!(".{}({}'d{value})", port.name, port.width())
    });
    let bench = MY_BENCH.replace("{fields}", &fields.collect::<Vec<_>>().join(", "));
    std::fs::write(folder.path().join("my_bench.v"), bench).expect("written");
    let page = include_str!("../../../docs/own_rtl.md");
    let top = "-DDESIGN=my_bench.my_instance -s my_bench -s edgewalk_pixel_rules";
    assert!(page.contains(&format!("iverilog {top} ... rules.v rules_icarus.v")));
    assert!(page.contains("verilator --binary ... rules.v rules_bind.sv"));
    let design = "hdl/edgewalk_pixel.v my_bench.v rules.v";
    let icarus = format!("iverilog {top} -o t {design} rules_icarus.v && vvp -n t");
    let verilator = format!(
        "verilator --binary --timing -Wno-fatal --top-module my_bench {design} rules_bind.sv >log && ./obj_dir/Vmy_bench"
    );
    for command in [icarus, verilator] {
        let output =
            std::process::Command::new("sh").args(["-c", &command]).current_dir(folder.path()).output();
        let output = output.expect("a shell");
        let said = String::from_utf8_lossy(&output.stdout);
        // PIXEL takes a span, and waits with the fragment of it that nobody takes.
        assert_eq!(
            broken(&said),
            ["span: time N: valid fell before the token was taken"],
            "{command}: {said}"
        );
        assert!(at_work(&said).contains(&"span"), "{said}");
    }
}
