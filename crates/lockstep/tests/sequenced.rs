//! A sequenced SETUP: the model, whose results are those of the closed formulae, against the netlist that runs the program.

use crate::common::fail::checked;
use crate::common::tokens::random_tokens;
use edgewalk_lockstep::{Case, Checked, Unit};
use edgewalk_machine::{Machine, Plan};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

fn machine(keys: &[(&str, &str)], lanes: u32) -> Plan {
    let mut machine = Machine { lanes, ..Machine::default() };
    for (key, value) in [("setup.kind", "sequenced")].iter().chain(keys) {
        machine.set(key, value).expect("a key of the machine");
    }
    machine.plan().expect("can be built")
}

/// Every port in every cycle of SETUP, and of EDGE behind it, with 1, 2 and 4 lanes: default formats, a small screen without sub-pixels, channels of several
/// lengths in several rounds, a machine that draws its map, one that takes lines, slope edges, and textbook fill.
#[test]
fn sequenced_setup_and_edge_equal_their_models() {
    const CYCLES: u64 = 60_000;
    let several = [
        ("channels.extra", "3"),
        ("channels.e0_kind", "floor"),
        ("channels.e1_kind", "signed"),
        ("channels.e1_vertex", "0"),
        ("blend.kind", "constant"),
        ("memory.tag_bits", "5"),
    ];
    let small = [
        ("screen.width", "20"),
        ("screen.height", "20"),
        ("screen.subpixel_bits", "0"),
        ("screen.guard_bits", "5"),
    ];
    let lines =
        [("polygon.lines", "yes"), ("screen.width", "40"), ("screen.height", "30"), ("memory.tag_bits", "3")];
    let slope = [("edge.kind", "slope"), ("edge.fraction_bits", "13")];
    let textbook = [("edge.fill", "textbook"), ("screen.subpixel_bits", "0")];
    let both = [slope, textbook].concat();
    let map = [("shadow.light", "parallel"), ("shadow.own_pass", "yes"), ("shadow.size", "40")];
    let mut rng = Pcg64Mcg::seed_from_u64(31);
    let mut all = Checked::default();
    let mut machines = 0;
    for lanes in [1, 2, 4] {
        for keys in [&[][..], &small, &several, &map, &lines, &slope, &textbook, &both] {
            let plan = machine(keys, lanes);
            for unit in Unit::known().filter(|unit| ["setup", "edge"].contains(&unit.name())) {
                let mut case = Case { seed: 5, cycles: CYCLES, disturbed: 10, ..Case::new(&plan, unit) };
                case.tokens = random_tokens(&plan, unit, 100, &mut rng);
                case.state.light_pass = plan.shadow.draws_map();
                case.resets = vec![CYCLES / 3];
                all.merge(&checked(&case));
            }
            machines += 1;
        }
    }
    println!("{machines} machines, {} tokens, {} values of ports compared", all.tokens, all.compared);
    assert!(machines == 24 && all.tokens > 1200);
}

/// The whole machine, its units compared inside, with stalls at the word port and behind, and resets in the midst of a triangle.
#[test]
fn sequenced_machine_equals_its_model() {
    let screen = [
        ("screen.width", "20"),
        ("screen.height", "20"),
        ("screen.guard_bits", "5"),
        ("memory.tag_bits", "5"),
    ];
    let mut rng = Pcg64Mcg::seed_from_u64(32);
    let mut all = Checked::default();
    for lanes in [1, 2, 4] {
        let plan = machine(&screen, lanes);
        let mut case =
            Case { seed: 6, disturbed: 10, resets: vec![700, 701, 5000], ..Case::new(&plan, Unit::MACHINE) };
        case.tokens = random_tokens(&plan, Unit::MACHINE, 30, &mut rng);
        case.unwilling = ["in", "rd", "data", "wr"].map(|link| (link.to_owned(), 90)).into_iter().collect();
        all.merge(&checked(&case));
    }
    println!("{} triangles, {} cycles, {} values of ports compared", all.tokens, all.cycles, all.compared);
    assert!(
        all.tokens == 3 * 30 && all.moved["in"] >= 18 * all.tokens && all.moved["wr"] > 300,
        "{:?}",
        all.moved
    );
}
