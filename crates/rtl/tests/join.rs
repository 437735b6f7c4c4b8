//! A unit that only declares itself is wired into the machine: here one between PIXEL and DEPTH, with a memory of its own, that
//! lets every fragment pass when its word has come.

use crate::drive;
use std::sync::Arc;

use crate::drive::Memory;
use edgewalk_machine::units::{depth, tokens};
use edgewalk_machine::{Activity, Field, Hazard, Link, Machine, MemoryPort, Plan, Ports, Ready, UnitSpec};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Simulator};
use edgewalk_rtl as rtl;
use edgewalk_rtl::units::Build;

const PASS: UnitSpec = UnitSpec {
    name: "pass",
    purpose: "reads a word for every fragment, and lets it pass",
    section: 0,
    present: |_| true,
    wants: |_| Vec::new(),
    ports,
    events: &[],
};

fn link(name: &'static str, fields: Vec<Field>) -> Link {
    Link { name, fields, ready: Ready::Always, words: Vec::new() }
}

fn ports(plan: &Plan) -> Ports {
    // As DEPTH tells it.
    let of_depth = (depth::SPEC.ports)(plan).status;
    let occupied = of_depth.into_iter().filter(|status| status.field.name == "occupied");
    Ports {
        takes: Some(link("frag", tokens::fragment(plan))),
        gives: Some(link("passed", tokens::fragment(plan))),
        memory: vec![MemoryPort {
            name: "map",
            read: link("map_rd", vec![tokens::address(plan)]),
            data: link("map_data", vec![tokens::depth_word(plan)]),
            write: "wr",
            word: "z",
            enable: Some("z_en"),
            latency: 1,
        }],
        status: occupied.collect(),
        ..Ports::default()
    }
}

fn pass(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_pass", "One fragment at a time.");
    let frag_valid = m.input("frag_valid", 1);
    let fields = tokens::fragment(plan);
    let inputs = fields.iter().map(|f| (f, m.input(&format!("frag_{}", f.name), f.width())));
    let inputs: Vec<_> = inputs.collect();
    let (rd_ready, data_valid) = (m.input("map_rd_ready", 1), m.input("map_data_valid", 1));
    m.input("map_data_z", tokens::depth_word(plan).width());
    let passed_ready = m.input("passed_ready", 1);

    let occupied = m.reg("occupied", 1).reset(0);
    let free = !occupied.q();
    // A cycle late, so that DEPTH sees a fragment of which the valid is low.
    let late = m.reg("late", 1).reset(0);
    let passed_valid = occupied.q() & data_valid & late;
    late.set(occupied.q() & data_valid & !passed_valid);
    occupied.when(frag_valid & rd_ready & free, 1).when(passed_valid & passed_ready, 0);
    m.output("frag_ready", rd_ready & free);
    m.output("map_rd_valid", frag_valid & free);
    m.output("map_rd_addr", inputs[0].1);
    m.output("map_data_ready", occupied.q() & late.q() & passed_ready);
    m.output("passed_valid", passed_valid);
    for (f, input) in inputs {
        let name = format!("passed_{}", f.name);
        m.output(&name, m.reg(&name, f.width()).when(frag_valid & free, input));
    }
    m.output("occupied", occupied);
    m.finish()
}

/// Two triangles over each other, the second with a fence that meets the first.
fn triangles(plan: &Plan) -> Vec<drive::Triangle> {
    let corners = [("0", [0, 0]), ("1", [14, 1]), ("2", [3, 13])];
    let triangle = |shift: i64| {
        let mut ports = Vec::new();
        for (place, [x, y]) in corners {
            let at = |pixels: i64| (pixels + shift) << plan.subpixel_bits;
            ports.extend([(format!("tri_x{place}"), at(x)), (format!("tri_y{place}"), at(y))]);
            let value = |name: &str| (format!("tri_{name}{place}"), 100 * (x + 2 * y));
            ports.extend(["z", "r", "g", "b"].map(value));
        }
        ports
    };
    vec![triangle(0), triangle(1)]
}

#[test]
fn a_unit_between_pixel_and_depth_needs_no_wiring_by_hand() {
    let machine =
        Machine { width: 16, height: 16, guard_bits: 5, hazard: Hazard::Drain, ..Machine::default() };
    let plan = machine.plan().expect("can be built");
    let build = |unit: &UnitSpec| rtl::units::builder(unit.name).expect("a builder");
    let mut units: Vec<(&UnitSpec, Build)> = plan.units().map(|unit| (unit, build(unit))).collect();
    let before_depth = units.iter().position(|(unit, _)| unit.name == "depth").expect("DEPTH");
    units.insert(before_depth, (&PASS, pass));
    let with = rtl::assemble(&plan, &units).unwrap_or_else(|errors| panic!("{errors}"));
    assert!(with.doc.contains("PIXEL ─frag─> PASS ─passed─> DEPTH ─wr─>"), "{}", with.doc);
    assert!(with.doc.contains("map_rd / map_data─ map memory"), "{}", with.doc);

    let (mut hazards, mut spurious) = (0, 0);
    let watch = |sim: &mut Simulator| {
        let mut is = |name: &str, value: u128| sim.get(name).expect("a signal") == value;
        let hazard = is("activity", Activity::Hazard as u128);
        hazards += u32::from(hazard);
        spurious += u32::from(hazard && !is("u_pass_passed_valid", 1));
    };
    // Depths so late that the first triangle is still in flight when the second comes.
    let depths = Memory { read: "rd", data: "data", latency: 30 };
    let memories = [depths, Memory { read: "map_rd", data: "map_data", latency: 1 }];
    let seen = drive::run(&with, &plan, &memories, &triangles(&plan), watch);
    let without = rtl::machine(&plan).unwrap_or_else(|errors| panic!("{errors}"));
    let expected = drive::run(&without, &plan, &memories[..1], &triangles(&plan), |_| {});
    assert!(expected.writes.len() > 100, "only {} writes", expected.writes.len());
    assert_eq!(seen.writes, expected.writes);
    assert_eq!(seen.busy, expected.busy);
    assert!(hazards > 0, "the fence of the second triangle met nothing");
    assert_eq!(spurious, 0, "DEPTH has no hazard without a fragment");
}
