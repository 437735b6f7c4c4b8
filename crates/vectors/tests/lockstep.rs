//! The model and the netlist, as native code, are the same machine: every port, every cycle.

use crate::common;
use edgewalk_model::DrawState;
use edgewalk_vectors::{Runs, StallKind, Suite, Unit, capture, design};

/// Prints how many port values were compared of all machines; each has more than `least`.
fn more_than(least: u64, compared: &[u64]) {
    println!("{} machines, {} port values compared", compared.len(), compared.iter().sum::<u64>());
    assert!(!compared.is_empty() && compared.iter().all(|compared| *compared > least), "{compared:?}");
}

/// Stalls take turns over machines, suites and units, so that each meets each.
#[test]
fn every_unit_and_the_machine() {
    let machines: Vec<_> = common::twelve().into_iter().chain(common::glass()).collect();
    let suites = ["hazards", "corners", "random", "sphere"];
    let totals = common::two_at_a_time(&machines, |i, (name, machine)| {
        let (mut runs, mut compared, mut natives) = (0, 0, common::Natives::new(machine));
        for (j, suite) in suites.iter().enumerate() {
            let suite = Suite::named(machine, suite, 3, 30).expect("listed");
            let of_suite = Runs::new(machine, &suite, DrawState::default());
            for (k, unit) in Unit::all(machine).into_iter().enumerate() {
                let trace = of_suite.capture(unit, StallKind::ALL[(i + j + k) % 3]);
                compared += natives.compared(name, &trace);
                runs += 1;
            }
        }
        (runs, compared)
    });
    let runs: usize = totals.iter().map(|total| total.0).sum();
    let compared: u64 = totals.iter().map(|total| total.1).sum();
    let units: usize = machines.iter().map(|(_, machine)| Unit::all(machine).len()).sum();
    let expected = suites.len() * units;
    println!("{runs} of {expected} runs agree, {compared} port values compared");
    assert_eq!(runs, expected);
    assert!(compared > 1_000_000);
}

/// Colours added, and colours not written; the whole machine, whose lock-step takes the longest, once each.
#[test]
fn every_suite_of_blend() {
    let machines = common::glass();
    let compared: Vec<u64> = common::two_at_a_time(&machines, |i, (name, machine)| {
        let (mut compared, mut natives) = (0, common::Natives::new(machine));
        for (j, suite) in ["blend_add", "color_unwritten"].into_iter().enumerate() {
            let suite = Suite::named(machine, suite, 3, 30).expect("listed");
            let runs = Runs::new(machine, &suite, suite.state);
            let in_turn = |unit: &Unit| suite.is_for(*unit) && (*unit != Unit::MACHINE || i % 2 == j);
            for unit in Unit::all(machine).into_iter().filter(in_turn) {
                let trace = runs.capture(unit, suite.stalls);
                compared += natives.compared(name, &trace);
            }
        }
        compared
    });
    more_than(100_000, &compared);
}

/// Lines and triangles in turn, in each pass of the machine that draws its map; the events of lines are met.
#[test]
fn every_suite_of_lines() {
    let machines = common::lined();
    let compared: Vec<u64> = common::two_at_a_time(&machines, |i, (name, machine)| {
        let (mut compared, mut natives) = (0, common::Natives::new(machine));
        let mut met = edgewalk_machine::Events::default();
        for (j, suite) in ["lines", "random"].into_iter().enumerate() {
            let suite = Suite::named(machine, suite, 3, 30).expect("listed");
            for light_pass in [false, true].into_iter().take(1 + usize::from(machine.shadow.draws_map())) {
                let runs = Runs::new(machine, &suite, DrawState { light_pass, ..suite.state });
                for unit in Unit::all(machine) {
                    let trace = runs.capture(unit, StallKind::ALL[(i + j) % 3]);
                    compared += natives.compared(name, &trace);
                    met.merge(&trace.events);
                }
            }
        }
        for (event, count) in met.counts().into_iter().filter(|(event, _)| event.starts_with("line_")) {
            assert!(count > 0, "{name}: {event} is not met");
        }
        compared
    });
    more_than(100_000, &compared);
}

/// Polygons in each unit; every event of POLY is met by the directed suites.
#[test]
fn every_suite_of_polygons() {
    let machines = common::polygonal();
    let all: Vec<(u64, edgewalk_machine::Events)> = common::two_at_a_time(&machines, |i, (name, machine)| {
        let (mut compared, mut natives) = (0, common::Natives::new(machine));
        let mut met = edgewalk_machine::Events::default();
        for (j, suite) in ["polygon", "polygon_corners"].into_iter().enumerate() {
            let suite = Suite::named(machine, suite, 3, 30).expect("listed");
            for light_pass in [false, true].into_iter().take(1 + usize::from(machine.shadow.draws_map())) {
                let runs = Runs::new(machine, &suite, DrawState { light_pass, ..suite.state });
                for unit in Unit::all(machine) {
                    let trace = runs.capture(unit, StallKind::ALL[(i + j) % 3]);
                    compared += natives.compared(name, &trace);
                    met.merge(&trace.events);
                }
            }
        }
        (compared, met)
    });
    let mut met = edgewalk_machine::Events::default();
    all.iter().for_each(|(_, events)| met.merge(events));
    for (event, count) in met.counts() {
        let of_poly = ["polygon_", "load_", "window_"].iter().any(|name| event.starts_with(name));
        assert!(!of_poly || count > 0, "{event} is not met");
    }
    more_than(100_000, &all.iter().map(|(compared, _)| *compared).collect::<Vec<u64>>());
}

/// SHADOW, its directed suites and those of hazards; the whole machine, whose lock-step takes the longest, once each.
#[test]
fn every_suite_of_shadow() {
    let machines = common::lights();
    let suites = ["light", "light_off", "hazards", "random"];
    let compared: Vec<u64> = common::two_at_a_time(&machines, |i, (name, machine)| {
        let (mut compared, mut natives) = (0, common::Natives::new(machine));
        let own = machine.shadow.draws_map().then_some(["own_map", "own_picture"]);
        for (j, suite) in suites.into_iter().chain(own.into_iter().flatten()).enumerate() {
            let suite = Suite::named(machine, suite, 3, 30).expect("listed");
            let runs = Runs::new(machine, &suite, suite.state);
            let in_turn = |unit: &Unit| {
                suite.is_for(*unit) && (*unit != Unit::MACHINE || j == 0 || j > 3 || i % 3 + 1 == j)
            };
            for unit in Unit::all(machine).into_iter().filter(in_turn) {
                let trace = runs.capture(unit, StallKind::ALL[(i + j) % 3]);
                compared += natives.compared(name, &trace);
            }
        }
        compared
    });
    more_than(100_000, &compared);
}

/// TERM, TEXEL, BUMP, NORMAL, LAMP and SHADE, their directed suite and those of hazards; the whole machine, whose lock-step takes the longest, once each.
#[test]
fn every_suite_of_shade() {
    let machines = common::shades();
    let suites = ["shade", "hazards", "corners", "random"];
    let compared: Vec<u64> = common::two_at_a_time(&machines, |i, (name, machine)| {
        let (mut compared, mut natives) = (0, common::Natives::new(machine));
        for (j, suite) in suites.into_iter().enumerate() {
            let suite = Suite::named(machine, suite, 3, 30).expect("listed");
            let runs = Runs::new(machine, &suite, suite.state);
            let in_turn = |unit: &Unit| match *unit == Unit::MACHINE {
                true => j == 0 || i % 3 + 1 == j,
                false => {
                    let own = [common::TERM, common::PIXEL, common::TEXEL, common::BUMP, common::NORMAL];
                    own.contains(unit) || [common::LAMP, common::SHADE].contains(unit)
                }
            };
            for unit in Unit::all(machine).into_iter().filter(in_turn) {
                let trace = runs.capture(unit, StallKind::ALL[(i + j) % 3]);
                compared += natives.compared(name, &trace);
            }
        }
        compared
    });
    more_than(100_000, &compared);
}

/// DITHER and DEPTH behind it, the directed suite and those of hazards; the whole machine once for each.
#[test]
fn every_suite_of_dither() {
    let machines = common::dithers();
    let compared: Vec<u64> = common::two_at_a_time(&machines, |i, (name, machine)| {
        let (mut compared, mut natives) = (0, common::Natives::new(machine));
        for (j, suite) in ["dither", "hazards", "random"].into_iter().enumerate() {
            let suite = Suite::named(machine, suite, 3, 30).expect("listed");
            let runs = Runs::new(machine, &suite, suite.state);
            let wanted = [common::DITHER, common::DEPTH, Unit::MACHINE];
            for unit in Unit::all(machine).into_iter().filter(|unit| wanted.contains(unit)) {
                let trace = runs.capture(unit, StallKind::ALL[(i + j) % 3]);
                compared += natives.compared(name, &trace);
            }
        }
        compared
    });
    more_than(50_000, &compared);
}

/// Before a depth of half of full scale each function but never and always passes some fragments and not others, under
/// each policy, with and without the write mask.
#[test]
fn every_depth_function_passes_and_fails() {
    let machines = common::twelve();
    let mut compared = 0;
    for name in ["small", "two_adders_drain", "four_segments_interlock"] {
        let (_, machine) = machines.iter().find(|(other, _)| *other == name).expect("one of the twelve");
        let netlist = design::netlist(machine, common::DEPTH).expect("a checked machine");
        let suite = Suite::named(machine, "hazards", 0, 0).expect("listed").on_half_depth(machine);
        for (depth_func, depth_write) in (0..8).flat_map(|function| [(function, true), (function, false)]) {
            let state = DrawState { depth_func, depth_write, ..DrawState::default() };
            let trace = capture(machine, common::DEPTH, &suite, state, StallKind::Mixed);
            let moved = |link: &str| trace.link(link).expect("DEPTH has it").tokens.len();
            let (fragments, passed) = (moved("frag"), moved("wr"));
            println!("{name} function {depth_func} mask {depth_write}: {passed} of {fragments} pass");
            match depth_func {
                0 => assert_eq!(passed, 0),
                7 => assert_eq!(passed, fragments),
                _ => {
                    assert!(passed >= 8 && fragments - passed >= 8, "{name}, function {depth_func}: {passed}")
                }
            }
            let agreement =
                common::lockstep(&trace, &netlist).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(agreement.compared, trace.port_values(), "{name}, function {depth_func}");
            compared += agreement.compared;
        }
    }
    println!("{compared} port values compared");
}
