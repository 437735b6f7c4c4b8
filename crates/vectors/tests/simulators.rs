//! The printed design replays vectors in Icarus and Verilator, is lint-clean, and synthesises; and a design with a
//! fault, or a directory with nothing in it, does not pass.

use crate::common;
use crate::common::write;
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::DrawState;
use edgewalk_vectors::{
    Files, Outcome, Simulator, StallKind, Suite, Tables, Unit, capture, design, directory, lint, simulate,
    synth_ice40,
};
use std::path::Path;
use std::time::{Duration, Instant};

/// Of one run of a tool: Verilator's compiler takes minutes on a busy machine.
const LIMIT: Duration = Duration::from_secs(1800);

const SUITES: [&str; 4] = ["hazards", "corners", "random", "sphere"];

/// These suites one after the other.
fn joined(machine: &Plan, suites: &[&str]) -> Suite {
    let suites = suites.iter().map(|name| Suite::named(machine, name, 5, 12).expect("listed"));
    Suite::joined("replay", "", suites)
}

/// The directed suites, a few random triangles and a small mesh, with these stalls. A memory that is late for whole triangles
/// makes four times the clocks, which takes Icarus long: with it such a memory is for hazards, and the others are stalled now
/// and then instead.
fn replays(machine: &Plan, simulator: Simulator, stalls: StallKind) -> Vec<(Suite, StallKind)> {
    match (simulator, stalls) {
        (Simulator::Icarus, StallKind::Late) => {
            vec![
                (joined(machine, &SUITES[..1]), StallKind::Late),
                (joined(machine, &SUITES[1..]), StallKind::Mixed),
            ]
        }
        (_, other) => vec![(joined(machine, &SUITES), other)],
    }
}

fn files(machine: &Plan, unit: Unit, suite: &Suite, depth_func: u8, stalls: StallKind) -> Files {
    let trace = capture(machine, unit, suite, DrawState { depth_func, ..DrawState::default() }, stalls);
    let verilog = design::verilog(machine, unit).expect("a checked machine");
    directory(suite, &trace, &verilog, Tables::LeftOut)
}

fn passes(simulator: Simulator, files: &Files) -> u64 {
    let place = tempfile::tempdir().expect("a directory");
    // Tools must cope with a path that has a space in it.
    let vectors = place.path().join("the vectors");
    write(files, &vectors);
    let outcome = simulate(simulator, &vectors, place.path(), LIMIT);
    if simulator == Simulator::Verilator {
        assert_eq!(objects(&place.path().join("obj_dir")), ["Vtb__ALL.o"], "of one file of C++");
    }
    match outcome {
        Ok(Outcome::Pass { checked, .. }) => checked,
        other => panic!("{}: {other:?}", simulator.name()),
    }
}

/// What was compiled of the simulation, without Verilator's own library.
fn objects(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"));
    names.filter(|name| name.starts_with("Vtb") && name.ends_with(".o")).collect()
}

/// What of the tools a machine goes through.
struct Tools {
    simulators: &'static [Simulator],
    synthesis: bool,
}

/// Twelve machines: the directed suites through simulators, lint, and synthesis where asked for, by the machine's number.
fn twelve_machines(tools: impl Fn(usize) -> Tools + Sync) {
    let machines = common::twelve();
    let sequenced = |lanes: u32| {
        let machines = machines.iter().filter(|(_, machine)| machine.is_sequenced());
        machines.filter(|(_, machine)| machine.lanes == lanes).count()
    };
    assert_eq!([1, 2, 4].map(sequenced), [2, 1, 3], "sequenced machines of 1, 2 and 4 lanes");
    let start = Instant::now();
    let done = common::two_at_a_time(&machines, |i, (name, machine)| {
        let Tools { simulators, synthesis } = tools(i);
        // The functions that let fragments pass take turns.
        let depth_func = 1 + (i % 7) as u8;
        let mut line = format!("{name:28}");
        let mut checked = 0;
        for (j, simulator) in simulators.iter().enumerate() {
            for (suite, stalls) in replays(machine, *simulator, StallKind::ALL[(i + j) % 3]) {
                let start = Instant::now();
                let suite = suite.on_half_depth(machine);
                let n = passes(*simulator, &files(machine, Unit::MACHINE, &suite, depth_func, stalls));
                checked += n;
                let (simulator, stalls) = (simulator.name(), stalls.name());
                line += &format!(" {simulator} ({stalls}) {n} / {n} in {:.1?};", start.elapsed());
            }
        }
        let suite = joined(machine, &SUITES);
        let place = tempfile::tempdir().expect("a directory");
        let vectors = place.path().join("the vectors");
        write(&files(machine, Unit::MACHINE, &suite, depth_func, StallKind::None), &vectors);
        lint(&vectors, LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
        line += " lint clean";
        if synthesis {
            let start = Instant::now();
            let cells = synth_ice40(&vectors, LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
            line += &format!("; {cells:?} in {:.1?}", start.elapsed());
        }
        println!("{line}");
        checked
    });
    println!("{} machines, {} checked, {:.1?}", done.len(), done.iter().sum::<u64>(), start.elapsed());
    assert_eq!(done.len(), 12);
    let simulated = |i: &usize| !tools(*i).simulators.is_empty();
    assert!((0..12).filter(simulated).all(|i| done[i] > 4000), "{done:?}");
}

/// Lint for all, Verilator for every other, Icarus and synthesis too for the smallest. Icarus takes several times as long for
/// a whole machine; what it alone shows, unknown bits, the units show in it, and Verilator begins with random bits.
#[test]
fn twelve_machines_replay_and_are_clean() {
    let tiny = common::twelve().iter().position(|(name, _)| *name == "tiny").expect("one of the twelve");
    twelve_machines(|i| Tools {
        simulators: if i == tiny { &Simulator::ALL } else { &Simulator::ALL[1..][..usize::from(i % 2 == 0)] },
        synthesis: i == tiny,
    });
}

/// Both simulators, lint and synthesis for all; not part of the test run:
/// `cargo test --release -p edgewalk-vectors simulators:: -- --ignored --nocapture`
#[test]
#[ignore = "a quarter of an hour"]
fn twelve_machines_in_every_tool() {
    twelve_machines(|_| Tools { simulators: &Simulator::ALL, synthesis: true });
}

/// Machines with BLEND in Verilator; BLEND and DEPTH of both alone in Icarus, mixing and adding.
#[test]
fn machines_with_blend_replay_and_are_clean() {
    let machines: Vec<_> = common::glass().into_iter().skip(2).step_by(3).collect();
    assert_eq!(machines.len(), 2);
    machines_with_blend(&machines, |_| &[Simulator::Verilator]);
}

/// All of them, in both; not part of the test run.
#[test]
#[ignore = "minutes"]
fn machines_with_blend_in_every_tool() {
    machines_with_blend(&common::glass(), |_| &Simulator::ALL);
}

fn machines_with_blend(machines: &[(&str, Plan)], simulators: impl Fn(usize) -> &'static [Simulator] + Sync) {
    let done = common::two_at_a_time(machines, |i, (name, machine)| {
        let mut checked = 0;
        for simulator in simulators(i) {
            for (suite, stalls) in replays(machine, *simulator, StallKind::ALL[i % 3]) {
                checked += passes(*simulator, &files(machine, Unit::MACHINE, &suite, 1, stalls));
            }
        }
        for (suite, unit) in
            [("hazards", common::DEPTH), ("hazards", common::BLEND), ("blend_add", common::BLEND)]
        {
            let suite = Suite::named(machine, suite, 5, 12).expect("listed");
            let trace = capture(machine, unit, &suite, suite.state, StallKind::Late);
            let verilog = design::verilog(machine, unit).expect("a checked machine");
            checked += passes(Simulator::Icarus, &directory(&suite, &trace, &verilog, Tables::LeftOut));
        }
        let place = tempfile::tempdir().expect("a directory");
        let vectors = place.path().join("the vectors");
        let suite = joined(machine, &SUITES);
        write(&files(machine, Unit::MACHINE, &suite, 1, StallKind::None), &vectors);
        lint(&vectors, LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{name:54} {checked} checked, lint clean");
        checked
    });
    assert_eq!(done.len(), machines.len());
    assert!(done.iter().all(|checked| *checked > 4000), "{done:?}");
}

/// Polygons in Verilator, on one machine in Icarus too; SETUP, POLY and SPAN alone in Icarus.
#[test]
fn machines_with_polygons_replay_and_are_clean() {
    let machines = common::polygonal();
    assert_eq!(machines.len(), 4);
    machines_with_polygons(&machines, |i, unit| match (unit == Unit::MACHINE, i) {
        (true, 1) => &Simulator::ALL,
        (true, _) => &[Simulator::Verilator],
        _ => &[Simulator::Icarus],
    });
}

/// These machines and the presets `polygon` and `bilinear` on a small screen, the machine in both simulators and its units
/// in Icarus; not part of the test run:
/// `cargo test --release -p edgewalk-vectors machines_with_polygons_in -- --ignored --nocapture`
#[test]
#[ignore = "minutes"]
fn machines_with_polygons_in_every_tool() {
    let preset = |name| {
        let preset = Machine::preset(name).expect("a preset");
        (name, Machine { width: 48, height: 40, ..preset }.plan().expect("can be built"))
    };
    let machines: Vec<_> =
        common::polygonal().into_iter().chain(["polygon", "bilinear"].map(preset)).collect();
    assert_eq!(machines.len(), 6);
    machines_with_polygons(&machines, |_, unit| &Simulator::ALL[..1 + usize::from(unit == Unit::MACHINE)]);
}

fn machines_with_polygons(
    machines: &[(&str, Plan)],
    simulators: impl Fn(usize, Unit) -> &'static [Simulator] + Sync,
) {
    let done = common::two_at_a_time(machines, |i, (name, machine)| {
        let suite = joined(machine, &["polygon", "polygon_corners"]);
        let mut checked = 0;
        for unit in [Unit::MACHINE, common::SETUP, common::POLY, common::SPAN] {
            let files = files(machine, unit, &suite, 7, StallKind::ALL[i % 3]);
            let simulators = simulators(i, unit);
            checked += simulators.iter().map(|simulator| passes(*simulator, &files)).sum::<u64>();
            if unit == Unit::MACHINE {
                let place = tempfile::tempdir().expect("a directory");
                write(&files, &place.path().join("vectors"));
                lint(&place.path().join("vectors"), LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
            }
        }
        println!("{name:50} {checked} checked, lint clean");
        checked
    });
    println!("{} machines, {} checked", done.len(), done.iter().sum::<u64>());
    assert!(done.len() == machines.len() && done.iter().all(|checked| *checked > 1500), "{done:?}");
}

/// Lines in Verilator; SETUP, EDGE and SPAN alone in Icarus.
#[test]
fn machines_with_lines_replay_and_are_clean() {
    let done = common::two_at_a_time(&common::lined(), |i, (name, machine)| {
        let suite = joined(machine, &["lines", "random"]);
        let mut checked = 0;
        for unit in [Unit::MACHINE, common::SETUP, common::EDGE, common::SPAN] {
            let files = files(machine, unit, &suite, 7, StallKind::ALL[i % 3]);
            let whole = unit == Unit::MACHINE;
            checked += passes(if whole { Simulator::Verilator } else { Simulator::Icarus }, &files);
            if whole {
                let place = tempfile::tempdir().expect("a directory");
                write(&files, &place.path().join("vectors"));
                lint(&place.path().join("vectors"), LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
            }
        }
        println!("{name:50} {checked} checked, lint clean");
        checked
    });
    assert!(done.len() == 3 && done.iter().all(|checked| *checked > 3000), "{done:?}");
}

/// Machines with SHADOW in Verilator; SHADOW and PROJECT of both alone in Icarus.
#[test]
fn machines_with_shadow_replay_and_are_clean() {
    let all = common::lights().into_iter().enumerate();
    // Both gates, k_t and a map that transmits, PROJECT pipelined and serial; parallel lights draw their map, below.
    let machines: Vec<_> = all.filter(|(i, _)| [6, 7].contains(i)).map(|(_, machine)| machine).collect();
    assert_eq!(machines.len(), 2);
    machines_with_shadow(&machines, |_| &[Simulator::Verilator]);
}

/// Both that draw their map: the machine in Verilator and each unit that has the input in Icarus, in the light's pass and in
/// the picture's. The suites of the picture's pass take turns in Verilator, which builds anew for each.
#[test]
fn machines_that_draw_their_map_replay_and_are_clean() {
    let machines: Vec<_> = common::lights().into_iter().filter(|(_, plan)| plan.shadow.draws_map()).collect();
    let done = common::two_at_a_time(&machines, |i, (name, machine)| {
        let mut checked = 0;
        for (j, name) in ["own_map", "own_picture", "light"].into_iter().enumerate() {
            let suite = Suite::named(machine, name, 5, 12).expect("listed");
            for unit in Unit::all(machine).into_iter().filter(|unit| suite.is_for(*unit)) {
                let trace = capture(machine, unit, &suite, suite.state, StallKind::ALL[(i + j) % 3]);
                let verilog = design::verilog(machine, unit).expect("a checked machine");
                let files = directory(&suite, &trace, &verilog, Tables::LeftOut);
                let whole = unit == Unit::MACHINE;
                // The design is the same in each suite.
                if whole && j == 0 {
                    let place = tempfile::tempdir().expect("a directory");
                    write(&files, &place.path().join("vectors"));
                    lint(&place.path().join("vectors"), LIMIT)
                        .unwrap_or_else(|error| panic!("{name}: {error}"));
                }
                if !whole {
                    checked += passes(Simulator::Icarus, &files);
                } else if j != 1 + i {
                    checked += passes(Simulator::Verilator, &files);
                }
            }
        }
        println!("{name:50} {checked} checked, lint clean");
        checked
    });
    assert!(done.len() == 2 && done.iter().all(|checked| *checked > 3000), "{done:?}");
}

/// The two with a relief in both; not part of the test run.
#[test]
#[ignore = "minutes"]
fn machines_with_a_relief_in_every_tool() {
    let mut machines = common::shades();
    let machines = [machines.remove(6), machines.remove(3)];
    machines_with_shade(&machines, |_| &Simulator::ALL, &["hazards", "corners", "random", "shade"]);
}

/// All ten in both; not part of the test run.
#[test]
#[ignore = "minutes"]
fn machines_with_shadow_in_every_tool() {
    machines_with_shadow(&common::lights(), |_| &Simulator::ALL);
}

fn machines_with_shadow(
    machines: &[(&str, Plan)],
    simulators: impl Fn(usize) -> &'static [Simulator] + Sync,
) {
    let done = common::two_at_a_time(machines, |i, (name, machine)| {
        let [suite, light] = [&["hazards", "light"][..], &["light"]].map(|suites| joined(machine, suites));
        let place = tempfile::tempdir().expect("a directory");
        let vectors = place.path().join("the vectors");
        let of = |unit, suite: &Suite, stalls| {
            let trace = capture(machine, unit, suite, suite.state, stalls);
            let verilog = design::verilog(machine, unit).expect("a checked machine");
            directory(suite, &trace, &verilog, Tables::LeftOut)
        };
        let whole = of(Unit::MACHINE, &suite, StallKind::ALL[i % 3]);
        let mut checked: u64 = simulators(i).iter().map(|simulator| passes(*simulator, &whole)).sum();
        for unit in
            [common::PROJECT, common::SHADOW].into_iter().filter(|unit| Unit::all(machine).contains(unit))
        {
            checked += passes(Simulator::Icarus, &of(unit, &light, StallKind::Late));
        }
        write(&whole, &vectors);
        lint(&vectors, LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{name:34} {checked} checked, lint clean");
        checked
    });
    assert_eq!(done.len(), machines.len());
    assert!(done.iter().all(|checked| *checked > 5000), "{done:?}");
}

/// A Phong machine with a texture and a fast-phong machine in Verilator, and their units in Icarus.
#[test]
fn machines_with_shade_replay_and_are_clean() {
    let mut machines = common::shades();
    let machines = [machines.remove(6), machines.remove(1)];
    machines_with_shade(&machines, |_| &[Simulator::Verilator], &["shade"]);
}

/// All eight in both; not part of the test run.
#[test]
#[ignore = "minutes"]
fn machines_with_shade_in_every_tool() {
    machines_with_shade(
        &common::shades(),
        |_| &Simulator::ALL,
        &["hazards", "corners", "random", "sphere", "shade"],
    );
}

fn machines_with_shade(
    machines: &[(&str, Plan)],
    simulators: impl Fn(usize) -> &'static [Simulator] + Sync,
    suites: &[&str],
) {
    let done = common::two_at_a_time(machines, |i, (name, machine)| {
        let suite = joined(machine, suites);
        let of = |unit, stalls| {
            let trace = capture(machine, unit, &suite, suite.state, stalls);
            let verilog = design::verilog(machine, unit).expect("a checked machine");
            directory(&suite, &trace, &verilog, Tables::LeftOut)
        };
        let whole = of(Unit::MACHINE, StallKind::ALL[(i + 1) % 3]);
        let mut checked: u64 = simulators(i).iter().map(|simulator| passes(*simulator, &whole)).sum();
        let own = [
            common::TERM,
            common::PIXEL,
            common::TEXEL,
            common::BUMP,
            common::NORMAL,
            common::LAMP,
            common::SHADE,
        ];
        for (j, unit) in own.into_iter().filter(|unit| Unit::all(machine).contains(unit)).enumerate() {
            checked += passes(Simulator::Icarus, &of(unit, StallKind::ALL[(i + j) % 3]));
        }
        let place = tempfile::tempdir().expect("a directory");
        let vectors = place.path().join("the vectors");
        write(&whole, &vectors);
        lint(&vectors, LIMIT).unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{name:44} {checked} checked, lint clean");
        checked
    });
    assert_eq!(done.len(), machines.len());
    assert!(done.iter().all(|checked| *checked > 5000), "{done:?}");
}

/// Every unit of two machines in Icarus, and, where building takes its time, the first of one and the last of the other in Verilator.
#[test]
fn every_unit_replays() {
    let machines: Vec<_> = common::twelve().into_iter().step_by(6).collect();
    let mut runs = Vec::new();
    for (i, (name, machine)) in machines.iter().enumerate() {
        for (j, unit) in Unit::single(machine).into_iter().enumerate() {
            runs.push((*name, machine, unit, Simulator::Icarus));
            if j == 4 * i {
                runs.push((*name, machine, unit, Simulator::Verilator));
            }
        }
    }
    let checked = common::two_at_a_time(&runs, |_, (name, machine, unit, simulator)| {
        let files = files(machine, *unit, &joined(machine, &SUITES), 1, StallKind::Mixed);
        let checked = passes(*simulator, &files);
        println!("{name:28} {:8} {:10} {checked} / {checked}", unit.name(), simulator.name());
        checked
    });
    assert_eq!(checked.len(), 10 + 2);
    assert!(checked.iter().all(|checked| *checked > 500), "{checked:?}");
}

/// Before a depth of half of full scale each function but never and always passes some fragments and not others.
#[test]
fn every_depth_function_replays() {
    let machine = common::small();
    let suite = Suite::named(&machine, "hazards", 0, 0).expect("listed").on_half_depth(&machine);
    for depth_func in 0..8 {
        let checked =
            passes(Simulator::Icarus, &files(&machine, common::DEPTH, &suite, depth_func, StallKind::Late));
        assert!(checked > 200, "{depth_func}: {checked}");
    }
}

/// DEPTH with one text exchanged, its manifest made anew.
fn faulty(cases: usize, from: &str, to: &str) -> Outcome {
    let machine = common::small();
    let mut suite = Suite::named(&machine, "hazards", 0, 0).expect("listed");
    suite.cases.truncate(cases);
    let trace = capture(&machine, common::DEPTH, &suite, DrawState::default(), StallKind::Mixed);
    let mut design = design::verilog(&machine, common::DEPTH).expect("a checked machine");
    assert!(design[0].1.contains(from), "{from}");
    design[0].1 = design[0].1.replacen(from, to, 1);
    let place = tempfile::tempdir().expect("a directory");
    write(&directory(&suite, &trace, &design, Tables::LeftOut), place.path());
    simulate(Simulator::Icarus, place.path(), place.path(), LIMIT).expect("Icarus runs")
}

#[test]
fn a_fault_is_found_and_said() {
    assert!(matches!(faulty(4, "endmodule", "endmodule"), Outcome::Pass { checked, .. } if checked > 50));
    assert_eq!(faulty(0, "endmodule", "endmodule"), Outcome::Vacuous);
    let cases = [
        ("a wrong value", "rd_addr = frag_addr", "rd_addr = ~frag_addr", ": expected "),
        ("an unknown value", "rd_addr = frag_addr", "rd_addr = frag_addr | 10'bx", ": unknown bits: "),
        ("missing outputs", "rd_valid = frag_valid && clear_to_read", "rd_valid = 1'b0", " never came"),
        ("extra outputs", "rd_valid = frag_valid &&", "rd_valid =", ": expected "),
        ("late outputs", "w_free = !wr_valid || wr_ready", "w_free = !wr_valid", ": expected in cycle "),
        ("no bypass", "place0_fwd_valid ? place0_fwd_z : data_z", "data_z", "wr: token "),
    ];
    for (name, from, to, told) in cases {
        match faulty(4, from, to) {
            Outcome::Mismatch { lines, .. } => {
                assert!(lines.iter().any(|line| line.contains(told)), "{name}: {lines:#?}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

/// A bench that compares all it was told to, but was told less than the manifest expects, has not passed.
#[test]
fn less_than_the_manifest_expects_is_no_pass() {
    let machine = common::small();
    let suite = Suite::named(&machine, "depth_less", 0, 0).expect("listed");
    let mut files = files(&machine, common::DEPTH, &suite, 1, StallKind::Mixed);
    let (name, json) = &mut files[0];
    assert_eq!(name, "manifest.json");
    let mut manifest: serde_json::Value = serde_json::from_slice(json).expect("JSON");
    let expected = manifest["expected"].as_u64().expect("a number");
    manifest["expected"] = (expected + 1).into();
    *json = serde_json::to_vec(&manifest).expect("JSON");
    let place = tempfile::tempdir().expect("a directory");
    write(&files, place.path());
    // A work folder that a signal has removed does not come again.
    let gone = place.path().join("gone");
    assert!(simulate(Simulator::Icarus, place.path(), &gone, LIMIT).is_err() && !gone.exists());
    let outcome = simulate(Simulator::Icarus, place.path(), place.path(), LIMIT);
    match outcome.expect("Icarus runs") {
        Outcome::Mismatch { checked, expected: wanted, .. } => {
            assert_eq!((checked, wanted), (expected, expected + 1))
        }
        other => panic!("{other:?}"),
    }
}
