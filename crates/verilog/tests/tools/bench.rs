//! Netlists beside their Verilog: the same stimuli through the interpreter, Icarus and Verilator, compared cycle by cycle.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use edgewalk_netlist::{Netlist, Simulator};

use super::{lint, run, write};

/// Cycles before the first comparison. In Verilog a register is unknown before its first clock, and a memory's output one
/// clock longer than its address: as many clocks as there may be memories one behind another.
pub const WARM_UP: usize = 16;

/// A netlist and what its inputs get, cycle by cycle, in port order with `rst` (if there is one) first.
pub struct Case {
    pub netlist: Arc<Netlist>,
    pub stimuli: Vec<Vec<u128>>,
}

impl Case {
    /// Names and widths of the inputs.
    fn inputs(&self) -> Vec<(String, u32)> {
        let netlist = &self.netlist;
        let rst = netlist.has_reset.then(|| ("rst".to_string(), 1));
        let ports = netlist.inputs.iter().map(|input| (input.name.clone(), netlist.width(input.node)));
        rst.into_iter().chain(ports).collect()
    }

    fn outputs(&self) -> Vec<(String, u32)> {
        let outputs = self.netlist.outputs.iter();
        outputs.map(|output| (output.name.clone(), self.netlist.width(output.driver))).collect()
    }

    /// What the interpreter shows at the outputs in every cycle.
    pub fn expected(&self) -> Vec<Vec<u128>> {
        let mut sim = Simulator::new(&self.netlist);
        let inputs: Vec<_> = self.inputs().iter().map(|(name, _)| sim.input(name).unwrap()).collect();
        let outputs: Vec<_> = self.outputs().iter().map(|(name, _)| sim.signal(name).unwrap()).collect();
        let cycle = |values: &Vec<u128>| {
            inputs.iter().zip(values).for_each(|(input, value)| sim.set(*input, *value));
            let shown = outputs.iter().map(|output| sim.value(*output)).collect();
            sim.tick();
            shown
        };
        self.stimuli.iter().map(cycle).collect()
    }
}

/// Cases written out: their Verilog, their stimuli and what the interpreter shows, with a bench around.
pub struct Bench<'c> {
    cases: &'c [Case],
    directory: tempfile::TempDir,
    /// The files of each case.
    files: Vec<Vec<(String, String)>>,
}

/// What a simulator found: for each case the first difference, in words.
type Differences = Vec<String>;

impl<'c> Bench<'c> {
    /// The Verilog of each case is that of `printed`, by rights its own netlist.
    pub fn new(cases: &'c [Case], printed: impl Fn(&Case) -> Arc<Netlist>) -> Self {
        let directory = tempfile::tempdir().unwrap();
        let mut all = Vec::new();
        for (index, case) in cases.iter().enumerate() {
            let files = edgewalk_verilog::print(&printed(case));
            write(directory.path(), &files);
            all.push(files);
            let inputs: Vec<u32> = case.inputs().iter().map(|(_, width)| *width).collect();
            let outputs: Vec<u32> = case.outputs().iter().map(|(_, width)| *width).collect();
            let (stimuli, wanted) = (words(&case.stimuli, &inputs), words(&case.expected(), &outputs));
            write(
                directory.path(),
                &[(format!("in{index}.hex"), stimuli), (format!("want{index}.hex"), wanted)],
            );
        }
        write(directory.path(), &[("bench.v".into(), bench(cases))]);
        Bench { cases, directory, files: all }
    }

    /// Every case passes lint with these waivers.
    pub fn lint(&self, waivers: &[&str]) {
        for (case, files) in self.cases.iter().zip(&self.files) {
            lint(self.directory.path(), files, &case.netlist.name, waivers);
        }
    }

    /// Values that each simulator compares.
    pub fn values(&self) -> usize {
        self.cases.iter().map(|case| (case.stimuli.len() - WARM_UP) * case.outputs().len()).sum()
    }

    pub fn icarus(&self) -> Differences {
        self.build("iverilog", &["-Wall", "-s", "bench", "-o", "icarus"]);
        self.differences(&run(self.directory.path(), "./icarus", &[]))
    }

    pub fn verilator(&self) -> Differences {
        // The bench itself is no example of style; the cases have been linted.
        let quiet =
            ["--binary", "--timing", "-Wno-fatal", "-Wno-lint", "-Wno-style", "--top-module", "bench"];
        let options =
            ["-O0", "-MAKEFLAGS", "OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0", "--output-split", "1000000"];
        self.build("verilator", &[&quiet[..], &options].concat());
        self.differences(&run(self.directory.path(), "obj_dir/Vbench", &[]))
    }

    fn build(&self, tool: &str, options: &[&str]) {
        let files: Vec<&str> = self.files.iter().flatten().map(|(name, _)| name.as_str()).collect();
        run(self.directory.path(), tool, &[options, &["bench.v"], &files[..]].concat());
    }

    fn differences(&self, printed: &str) -> Differences {
        let cycles = self.cases[0].stimuli.len();
        assert!(
            printed.contains(&format!("compared {cycles} cycles")),
            "the bench did not finish:\n{printed}"
        );
        let lines = printed.lines().filter(|line| line.starts_with("differs "));
        lines.map(|line| explain(self.cases, line, self.directory.path())).collect()
    }
}

/// A line of hexadecimal digits for each cycle, the first value in the highest bits.
fn words(cycles: &[Vec<u128>], widths: &[u32]) -> String {
    let mut text = String::new();
    for values in cycles {
        let mut bits = String::new();
        for (value, width) in values.iter().zip(widths) {
            write!(bits, "{value:0width$b}", width = *width as usize).unwrap();
        }
        let fill = (4 - bits.len() % 4) % 4;
        let bits = "0".repeat(fill) + &bits;
        for digit in bits.as_bytes().chunks(4) {
            let digit = digit.iter().fold(0, |value, bit| value * 2 + (bit - b'0'));
            write!(text, "{digit:x}").unwrap();
        }
        text.push('\n');
    }
    text
}

/// A plain test bench over all cases.
fn bench(cases: &[Case]) -> String {
    let cycles = cases.iter().map(|case| case.stimuli.len()).max().unwrap();
    let (mut declarations, mut load, mut set, mut check) =
        (String::new(), String::new(), String::new(), String::new());
    for (k, case) in cases.iter().enumerate() {
        assert_eq!(case.stimuli.len(), cycles, "all cases have the same length");
        let [inputs, outputs] = [case.inputs(), case.outputs()];
        let sum = |ports: &[(String, u32)]| ports.iter().map(|(_, width)| width).sum::<u32>();
        let (i, o) = (sum(&inputs), sum(&outputs));
        writeln!(
            declarations,
            "  reg [{}:0] in{k} [0:{}];\n  reg [{}:0] want{k} [0:{}];",
            i - 1,
            cycles - 1,
            o - 1,
            cycles - 1
        )
        .unwrap();
        writeln!(declarations, "  reg [{}:0] now{k};\n  wire [{}:0] got{k};", i - 1, o - 1).unwrap();
        let mut ports = Vec::new();
        if case.netlist.has_clock {
            ports.push(".clk(clk)".to_string());
        }
        for (signal, list, mut top) in [("now", inputs, i), ("got", outputs, o)] {
            for (name, width) in list {
                ports.push(format!(".{name}({signal}{k}[{}:{}])", top - 1, top - width));
                top -= width;
            }
        }
        writeln!(declarations, "  {} u{k} ({});", case.netlist.name, ports.join(", ")).unwrap();
        writeln!(load, "    $readmemh(\"in{k}.hex\", in{k});\n    $readmemh(\"want{k}.hex\", want{k});")
            .unwrap();
        writeln!(set, "      now{k} = in{k}[i];").unwrap();
        writeln!(
            check,
            "      if (i >= {WARM_UP} && got{k} !== want{k}[i]) $display(\"differs {k} %0d %b\", i, got{k});"
        )
        .unwrap();
    }
    format!(
        "module bench;\n  reg clk;\n  integer i;\n{declarations}  initial begin\n{load}    clk = 0;\n    \
         for (i = 0; i < {cycles}; i = i + 1) begin\n{set}      #1;\n{check}      clk = 1;\n      #1;\n      clk = 0;\n    end\n    \
         $display(\"compared %0d cycles\", i);\n    $finish;\n  end\nendmodule\n"
    )
}

/// Which output differs, for which inputs, and the Verilog it comes from.
fn explain(cases: &[Case], line: &str, directory: &Path) -> String {
    let mut fields = line.split_whitespace().skip(1);
    let mut number = || fields.next().unwrap().parse::<usize>().unwrap();
    let (case, cycle) = (&cases[number()], number());
    let found = fields.next().unwrap();
    let expected = &case.expected()[cycle];
    let mut text = format!("{} in cycle {cycle}, inputs:", case.netlist.name);
    for ((name, _), value) in case.inputs().iter().zip(&case.stimuli[cycle]) {
        write!(text, " {name} = {value:#x}").unwrap();
    }
    let mut at = 0;
    for ((name, width), wanted) in case.outputs().iter().zip(expected) {
        let bits = &found[at..at + *width as usize];
        at += *width as usize;
        let wanted = format!("{wanted:0width$b}", width = *width as usize);
        if bits != wanted {
            write!(text, "\n{name}: {bits} instead of {wanted}").unwrap();
        }
    }
    let file = directory.join(format!("{}.v", case.netlist.name));
    text + "\n" + &std::fs::read_to_string(file).unwrap()
}
