//! The gates of a small design beside Icarus, which runs the same gates, and beside OpenSTA.

use super::flat::Flat;
use super::power::{Joules, spent};
use super::{GateRun, Gates, Library, gates, power};
use crate::cache::Cache;
use crate::design::Design;
use crate::part::Part;
use edgewalk_tool::run;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

const LIMIT: Duration = Duration::from_secs(60);

/// A state machine that Yosys gives other codes, an instance with a constant output and a port that goes straight through, and
/// counters.
const DESIGN: &str = "
module fold(input clk, input [7:0] total, input [3:0] a, output [7:0] next, output [3:0] same, output none, output all);
    reg [3:0] kept;
    always @(posedge clk) kept <= a;
    assign next = total + {kept, a};
    assign same = a;
    assign none = 1'b0;
    assign all = 1'b1;
endmodule

module top(input clk, input rst, input [3:0] a, input go, output [7:0] sum, output odd, output [3:0] seen);
    reg [1:0] state;
    reg [7:0] total;
    reg [2:0] count;
    wire [7:0] next;
    wire [3:0] same;
    wire none, all;
    fold u_fold(.clk(clk), .total(total), .a(a), .next(next), .same(same), .none(none), .all(all));
    always @(posedge clk) begin
        if (rst) state <= 0;
        else begin
            if (go && state == 0) state <= 1;
            if (same[0] && state == 1) state <= 2;
            if (state == 2) state <= a[1] ? 3 : 0;
            if (state == 3) state <= 0;
        end
        if (rst) total <= 0;
        else if (state == 1) total <= next;
        else if (state == 2) total <= total ^ {same, a};
        if (rst) count <= 0;
        else if (state == 2 || state == 3) count <= count + 1;
    end
    assign sum = total;
    assign odd = ^total & all;
    assign seen = {count[2], state == 3, count[0] & go, none | (state == 1)};
endmodule
";

/// The design's inputs, outputs and registers, as a netlist would name them. `count` is left out: its values come from the gates.
const NAMES: [&str; 25] = [
    "rst",
    "a[0]",
    "a[1]",
    "a[2]",
    "a[3]",
    "go",
    "state[0]",
    "state[1]",
    "sum[0]",
    "sum[1]",
    "sum[2]",
    "sum[3]",
    "sum[4]",
    "sum[5]",
    "sum[6]",
    "sum[7]",
    "u_fold.kept[0]",
    "u_fold.kept[1]",
    "u_fold.kept[2]",
    "u_fold.kept[3]",
    "odd",
    "seen[0]",
    "seen[1]",
    "seen[2]",
    "seen[3]",
];

/// Outputs among [`NAMES`].
const OUTPUTS: u64 = 13;
/// Cycles that are run: three blocks and a part of one.
const CYCLES: usize = 200;

struct Mapped {
    folder: tempfile::TempDir,
    library: Library,
    gates: Gates,
    verilog: String,
}

fn mapped() -> Mapped {
    let folder = tempfile::tempdir().expect("a folder");
    let design = Design {
        part: Part::MACHINE,
        files: vec![("top.v".to_owned(), DESIGN.to_owned())],
        hash: "small".to_owned(),
        memories: Vec::new(),
        module: "top".to_owned(),
        units: Vec::new(),
    };
    let installed = Library::installed().expect("tests/run installs the library").text;
    // A NAND takes its energy by A where B is 1 alone.
    let nand = installed.find("cell (NAND2X1)").expect("a NAND");
    let (before, nand) = installed.split_at(nand);
    let power = nand.find("internal_power").expect("energies");
    let (delays, energies) = nand.split_at(power);
    let energies = energies.replacen("related_pin : \"A\";", "related_pin : \"A\"; when : \"B\";", 1);
    let library = Library::of([before, delays, &energies].concat(), "cells.lib").expect("a library");
    let [root, scratch] = ["kept", "scratch"].map(|name| folder.path().join(name));
    let gates = gates(&design, &library, &Cache::new(root.clone(), scratch), LIMIT).expect("gates");
    let steps = std::fs::read_dir(root).expect("the cache");
    let verilog = steps.filter_map(|step| std::fs::read_to_string(step.ok()?.path().join("gates.v")).ok());
    let verilog = verilog.last().expect("the cache has the gates");
    Mapped { folder, library, gates, verilog }
}

/// What Icarus says of these signals, cycle by cycle: the gates with their cells' models, the design with its text.
fn simulated(mapped: &Mapped, signals: &[String]) -> Vec<Vec<bool>> {
    let path = |name: &str| mapped.folder.path().join(name);
    let ports: Vec<String> =
        ["a[0]", "a[1]", "a[2]", "a[3]"].map(|port| format!(".\\{port} ({port})")).into();
    let shown = signals.join(", ");
    let bench = format!(
        "module bench;
    reg clk = 0, rst = 1, go = 0;
    reg [3:0] a = 0;
    integer seed = 7;
    top rtl(.clk(clk), .rst(rst), .a(a), .go(go));
    gates dut(.clk(clk), .rst(rst), {}, .go(go));
    always #50 clk = !clk;
    always @(negedge clk) begin
        a = $random(seed);
        go = $random(seed);
        rst = $time < 400;
        #49 $display(\"values %b\", {{{shown}}});
    end
    initial #{} $finish;
endmodule
",
        ports.join(", "),
        (CYCLES + 10) * 100
    );
    let gates =
        mapped.verilog.replace("module top(", "module gates(").replace("module fold(", "module gates_fold(");
    let gates = gates.replace("  fold u_fold", "  gates_fold u_fold");
    for (name, text) in [("bench.v", bench.as_str()), ("gates.v", &gates), ("top.v", DESIGN)] {
        std::fs::write(path(name), text).expect("a file");
    }
    let cells = Path::new("/usr/share/qflow/tech/osu018/osu018_stdcells.v");
    let mut icarus = Command::new("iverilog");
    icarus
        .args(["-g2012", "-o", "sim", "bench.v", "gates.v", "top.v"])
        .arg(cells)
        .current_dir(mapped.folder.path());
    run(&mut icarus, LIMIT).expect("iverilog");
    let printed = run(Command::new("vvp").arg("sim").current_dir(mapped.folder.path()), LIMIT).expect("vvp");
    let rows = printed.lines().filter_map(|line| line.strip_prefix("values "));
    // After the reset.
    let rows = rows.skip(6).take(CYCLES).map(|row| {
        assert!(!row.contains(['x', 'z']), "{row}");
        row.bytes().map(|byte| byte == b'1').collect()
    });
    let rows: Vec<Vec<bool>> = rows.collect();
    assert_eq!(rows.len(), CYCLES);
    rows
}

/// A run of the gates on what Icarus says of the design's registers; then what it says of each net, by its place.
fn ran(mapped: &Mapped) -> (GateRun<'_>, BTreeMap<usize, Vec<bool>>) {
    let flat = Flat::new(&mapped.gates, &mapped.library).expect("cells");
    let outputs = || {
        flat.cells.iter().flat_map(|of| {
            let pins = of.cell.pins.iter().zip(&of.nets).skip(of.cell.inputs);
            pins.map(|(pin, net)| (format!("dut.{}.{}", of.path.replace('/', "."), pin.name), *net))
        })
    };
    let known = NAMES.iter();
    let own = known.clone().map(|name| format!("rtl.{name}"));
    let signals: Vec<String> = own.chain(outputs().map(|(name, _)| name)).collect();
    let rows = simulated(mapped, &signals);
    let column = |place: usize| rows.iter().map(|row| row[place]).collect::<Vec<bool>>();
    let first = known.clone().count();
    let mut waves: BTreeMap<usize, Vec<bool>> =
        outputs().enumerate().map(|(place, (_, net))| (net, column(first + place))).collect();
    let places: BTreeMap<String, usize> =
        known.clone().enumerate().map(|(place, name)| ((*name).to_owned(), place)).collect();
    for (name, net) in &flat.inputs {
        waves.insert(*net, column(places[name]));
    }
    let mut run = GateRun::new(&mapped.gates, &mapped.library, &places).expect("cells");
    for block in rows.chunks(64) {
        let word = |place: usize| {
            let last = block.len() - 1;
            (0..64).fold(0, |word, cycle: usize| word | u64::from(block[cycle.min(last)][place]) << cycle)
        };
        run.block(&(0..first).map(word).collect::<Vec<u64>>(), block.len() as u32);
    }
    (run, waves)
}

fn moves(wave: &[bool]) -> Vec<bool> {
    wave.windows(2).map(|pair| pair[0] != pair[1]).collect()
}

#[test]
fn every_net_moves_as_often_as_in_icarus() {
    let mapped = mapped();
    let (run, waves) = ran(&mapped);
    let (flat, counts) = run.counted();
    assert_eq!(counts.differs, None);
    assert_eq!(counts.cycles, CYCLES as u64);
    let registers = (flat.cells.len() - flat.gates) as u64;
    // All but two bits of `count`; the third is an output too.
    assert_eq!(counts.known + 2, registers);
    assert_eq!(counts.compared, (counts.known + OUTPUTS) * (CYCLES as u64 - 16));
    assert!(
        flat.cells.iter().any(|of| of.seen.as_ref().is_some_and(|seen| !seen.states.is_empty())),
        "other codes"
    );
    for (unit, still) in &counts.still {
        let registers = flat.cells[flat.gates..].iter().filter(|of| of.unit == *unit);
        let waves: Vec<Vec<bool>> = registers.map(|of| moves(&waves[&of.nets[of.cell.inputs]])).collect();
        let expected =
            (0..CYCLES - 1).filter(|cycle| waves.iter().all(|moves| !moves[*cycle])).count() as u64;
        assert_eq!(*still, expected, "unit {unit:?}");
        assert!((1..150).contains(&expected), "{expected} cycles of {unit:?} are still");
    }
    assert_eq!(counts.still.len(), 2);
    let (mut sums, mut conditions) = ([0, 0], 0);
    for (of, causes) in flat.cells.iter().zip(&counts.causes) {
        let mut causes = causes.iter();
        for (place, (pin, net)) in of.cell.pins.iter().zip(&of.nets).enumerate() {
            let clock = of.cell.register.as_ref().map(|register| register.clock);
            let wave = |net: usize| waves.get(&net).map_or_else(|| vec![false; CYCLES], Clone::clone);
            let moved = moves(&wave(*net));
            if place >= of.cell.inputs {
                let expected = moved.iter().filter(|moved| **moved).count() as u64;
                assert_eq!(counts.transitions[*net], expected, "{}/{}", of.path, pin.name);
                sums[0] += expected;
            }
            for energy in &pin.energies {
                let cause = energy.cause.filter(|cause| Some(*cause) != clock);
                let other = cause.map_or_else(|| moved.clone(), |cause| moves(&wave(of.nets[cause])));
                let inputs: Vec<Vec<bool>> = of.nets[..of.cell.inputs].iter().map(|net| wave(*net)).collect();
                let holds = |cycle: usize| {
                    let state =
                        inputs.iter().rev().fold(0, |state, wave| state << 1 | u32::from(wave[cycle]));
                    energy.when.is_none_or(|when| when >> state & 1 == 1)
                };
                conditions += u64::from(energy.when.is_some());
                let both = (0..CYCLES - 1).filter(|cycle| moved[*cycle] && other[*cycle] && holds(cycle + 1));
                let expected = both.count() as u64;
                assert_eq!(causes.next(), Some(&expected), "{}/{} of {cause:?}", of.path, pin.name);
                sums[1] += expected;
            }
        }
    }
    println!("{} cells, {} transitions, {} with a cause", flat.cells.len(), sums[0], sums[1]);
    assert!(conditions > 3, "{conditions} NANDs");
    assert!(
        flat.cells.len() > 60 && sums[0] > 2000 && sums[1] > 2000,
        "{} cells, {sums:?}",
        flat.cells.len()
    );
}

#[test]
fn a_wrong_gate_is_found() {
    let mut mapped = mapped();
    let top = mapped.gates.modules.get_mut("top").expect("the top module");
    let gate = top.cells.iter_mut().find(|cell| cell.of == "NAND2X1").expect("a NAND");
    gate.of = "NOR2X1".to_owned();
    let (run, _) = ran(&mapped);
    let (register, cycle) = run.counted().1.differs.clone().expect("a difference");
    let error = power(&mapped.gates, &mapped.library, &run, 10.0).expect_err("a wrong gate").to_string();
    let expected = format!("its gates give {register} another value than the netlist in cycle {cycle}");
    assert!(error.contains(&expected), "{error}");
}

/// Where every pin moves once a cycle, OpenSTA's switching power is ours. Its internal power is as well, but for what version
/// 2.0.17 does otherwise: it adds rise and fall where a transition is one of them.
#[test]
fn power_is_that_of_opensta() {
    let mapped = mapped();
    let path = |name: &str| mapped.folder.path().join(name);
    std::fs::write(path("sta.v"), &mapped.verilog).expect("a file");
    let script = "read_liberty /usr/share/qflow/tech/osu018/osu018_stdcells.lib\nset_cmd_units -time ns -power W\n\
                  read_verilog sta.v\nlink_design top\ncreate_clock -name clk -period 10 [get_ports clk]\n\
                  set_input_delay 0 -clock clk [all_inputs]\nset_power_activity -global -activity 1 -duty 0.5\n\
                  report_power -digits 9 -instances [get_cells -hierarchical *]\n";
    std::fs::write(path("run.tcl"), script).expect("a file");
    let mut sta = Command::new("sta");
    sta.args(["-no_splash", "-no_init", "-exit", "run.tcl"]).current_dir(mapped.folder.path());
    let printed = run(&mut sta, LIMIT).expect("sta");
    let told: BTreeMap<&str, [f64; 3]> = printed
        .lines()
        .filter_map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let [internal, switching, leakage, _, cell] = words[..] else { return None };
            let numbers = [internal, switching, leakage].map(str::parse::<f64>);
            let [Ok(internal), Ok(switching), Ok(leakage)] = numbers else { return None };
            Some((cell, [internal, switching, leakage]))
        })
        .collect();
    let flat = Flat::new(&mapped.gates, &mapped.library).expect("cells");
    let (loads, slews) = flat.surroundings(&mapped.gates, &mapped.library);
    let seconds = 10e-9;
    // Pins differ a little between rise and fall: OpenSTA takes the greater sum of a net, we the sum of the greater.
    let near = |ours: f64, theirs: f64| (ours - theirs).abs() <= 0.01 * theirs.abs();
    let mut checked = BTreeMap::new();
    for of in &flat.cells {
        let [internal, switching, leakage] = told[of.path.as_str()];
        // A transition of each pin in one cycle, with each input as the cause.
        let causes = vec![1; of.cell.pins.iter().map(|pin| pin.energies.len()).sum()];
        let once = vec![1; flat.nets];
        let mut cell = of.cell.clone();
        // 2.0.17 takes the rise of the output with the rise of the input, whatever the gate.
        cell.pins.iter_mut().flat_map(|pin| &mut pin.energies).for_each(|energy| energy.along = Some(true));
        let watts = |joules: Joules| (joules.clock + joules.flip_flops + joules.gates) / seconds;
        let ours = |cell: &_| {
            watts(spent(cell, &of.nets, &once, &causes, 1.0, (&loads, &slews), mapped.library.units))
        };
        let all = ours(&cell);
        let charged = {
            let mut empty = cell.clone();
            empty.pins.iter_mut().for_each(|pin| pin.energies.clear());
            let none =
                watts(spent(&empty, &of.nets, &once, &[], 1.0, (&loads, &slews), mapped.library.units));
            // OpenSTA does not charge the clock's net.
            let clock = cell.register.as_ref().map_or(0.0, |register| cell.pins[register.clock].capacitance);
            none - clock * 1e-12 * 1.8 * 1.8 / seconds
        };
        assert!(near(charged, switching), "{}: {charged} W, {switching} by OpenSTA", of.path);
        assert!(near(cell.leakage * 1e-9, leakage), "{}: leakage", of.path);
        if cell.inputs == 1 {
            let within = 2.0 * (all - charged);
            assert!(near(within, internal), "{}: {within} W, {internal} by OpenSTA", of.path);
            *checked.entry("gates of one input").or_insert(0) += 1;
        } else if let Some(register) = &cell.register {
            // It halves what an input takes, as if it moved every other time.
            let of_inputs: f64 = (0..cell.inputs)
                .filter(|place| *place != register.clock)
                .map(|place| {
                    let energy = &cell.pins[place].energies[0];
                    let [rise, fall] = slews[of.nets[place]];
                    (energy.rise.at(0.0, rise) + energy.fall.at(0.0, fall)) / 2.0 * 1e-12 / seconds
                })
                .sum();
            let clock = cell.pins[register.clock].capacitance * 1e-12 * 1.8 * 1.8 / seconds;
            let within = 2.0 * (all - charged - clock) - of_inputs;
            assert!(near(within, internal), "{}: {within} W, {internal} by OpenSTA", of.path);
            *checked.entry("flip-flops").or_insert(0) += 1;
        }
    }
    println!("{} cells; {checked:?}", flat.cells.len());
    assert!(checked["flip-flops"] >= 15 && checked["gates of one input"] >= 5, "{checked:?}");
}

/// Each cause has its share; a gate that inverts has its rise with the fall of the cause.
#[test]
fn causes_share_the_energy_of_a_transition() {
    let text = "library (l) { nom_voltage : 2; capacitive_load_unit (1, pf);
        power_lut_template (scalar) { }
        power_lut_template (t) { variable_1 : input_transition_time; index_1 (\"0, 1\"); }
        cell (FF) { area : 1; ff (I, N) { next_state : \"D\"; clocked_on : \"C\"; } pin (D) { direction : input; }
            pin (C) { direction : input; } pin (Q) { direction : output; function : \"I\"; } }
        cell (IV) { area : 1; pin (A) { direction : input; } pin (Y) { direction : output; function : \"!A\"; } }
        cell (ND) { area : 1; pin (A) { direction : input; internal_power () { power (t) { values (\"7, 8\"); } } }
            pin (B) { direction : input; }
            pin (Y) { direction : output; function : \"!(A B)\";
                internal_power () { related_pin : \"A\"; rise_power (t) { values (\"0, 1\"); }
                    fall_power (t) { values (\"0, 10\"); } }
                internal_power () { related_pin : \"B\"; rise_power (scalar) { values (\"100\"); }
                    fall_power (scalar) { values (\"200\"); } } } } }";
    let library = Library::of(text.to_owned(), "l.lib").expect("a library");
    let cell = library.cell("ND").expect("a NAND");
    let slews = [[2.0, 5.0], [3.0, 3.0], [0.0, 0.0]];
    let joules =
        spent(cell, &[0, 1, 2], &[11, 9, 8], &[6, 3, 1], 100.0, (&[0.0, 0.0, 0.5], &slews), library.units);
    // Of A: a rise at 2 and a fall at 5. Of Y: three of four with A, whose fall at 5 makes it rise; and its load at 2 V.
    let of_a = 6.0 * ((7.0 + 2.0) + (7.0 + 5.0)) / 2.0;
    let of_y = 8.0 * (0.75 * (5.0 + 20.0) / 2.0 + 0.25 * (100.0 + 200.0) / 2.0 + 0.5 * 0.5 * 4.0);
    let told = joules.gates * 1e12;
    assert!((told - of_a - of_y).abs() < 1e-9, "{told} pJ, {} by hand", of_a + of_y);
    assert_eq!((joules.clock, joules.flip_flops), (0.0, 0.0));
}
