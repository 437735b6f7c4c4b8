//! Every failure that is kept, as a file in `cases`, run again; and each still finds the fault that it is kept for.
//!
//! `EDGEWALK_BLESS=1 cargo test --release -p edgewalk-lockstep kept:: -- --ignored` looks for the cases of `FAULTS` anew.

use crate::common::fail::shrunk_with;
use crate::common::tokens::{few, random_tokens};
use edgewalk_lockstep::{Case, Checked, Interface, LockstepError, NetlistDevice, Unit, model, netlist};
use edgewalk_machine::{Fill, Hazard, Machine, Plan};
use edgewalk_netlist::Netlist;
use edgewalk_netlist::mutate::{Mutant, mutants};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// Name of the file, unit, machine, and words of the fault that it is to find.
struct Kept {
    name: &'static str,
    unit: &'static str,
    machine: fn(&mut Machine),
    words: &'static [&'static str],
}

const FAULTS: &[Kept] = &[
    Kept {
        name: "depth_two_writes_meet_a_third",
        unit: "depth",
        machine: |_| {},
        words: &["becomes `Xor(place1_fwd_valid, place1_after_w)`"],
    },
    Kept {
        name: "depth_forwarded_is_not_used",
        unit: "depth",
        machine: |_| {},
        words: &["becomes `Mux(place0_fwd_valid, data_z, place0_fwd_z)`"],
    },
    Kept {
        name: "depth_write_not_seen_by_the_next",
        unit: "depth",
        machine: |_| {},
        words: &["`Mux(place0_after_w, passes_w, "],
    },
    Kept {
        name: "depth_write_not_passed_to_those_queued",
        unit: "depth",
        machine: |_| {},
        words: &["becomes `And(place1_fwd_valid, place1_after_w)`"],
    },
    Kept {
        name: "depth_interlock_of_what_is_written",
        unit: "depth",
        machine: |machine| machine.hazard = Hazard::Interlock,
        words: &["(wr_addr, frag_addr)), same0)` becomes"],
    },
    Kept {
        name: "depth_drain_without_a_fence",
        unit: "depth",
        machine: |machine| machine.hazard = Hazard::Drain,
        words: &["becomes `Or(frag_fence, "],
    },
    Kept {
        name: "span_mark_of_a_dropped_line",
        unit: "span",
        machine: |_| {},
        words: &["becomes `And(held_fence, pend_fence)`"],
    },
    Kept {
        name: "edge_waits_for_increments",
        unit: "edge",
        machine: |_| {},
        words: &["becomes `Or(Not(running), Not(fresh_queued))`"],
    },
    Kept {
        name: "edge_knee_line_drawn_twice",
        unit: "edge",
        machine: |machine| (machine.fill, machine.subpixel_bits) = (Fill::Textbook, 0),
        words: &["becomes `Or(And(step, exchanges), line_major_right)`"],
    },
    Kept {
        name: "pixel_increment_of_another_triangle",
        unit: "pixel",
        machine: |_| {},
        words: &["becomes `Or(span_valid, span_fresh)`"],
    },
    Kept {
        name: "setup_equal_heights_sorted",
        unit: "setup",
        machine: |_| {},
        words: &["LtSigned(tri_y1, tri_y0)` becomes"],
    },
    Kept {
        name: "setup_culled_goes_on",
        unit: "setup",
        machine: |_| {},
        words: &["`state` is never updated when `And(gives_up, advance)`"],
    },
];

fn plan(kept: &Kept) -> Plan {
    let mut machine = Machine { width: 6, height: 6, guard_bits: 3, subpixel_bits: 2, ..Machine::default() };
    machine.z.bits = 8;
    (kept.machine)(&mut machine);
    machine.plan().expect("can be built")
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("cases")
}

/// Every fault of the netlist with the words for it: module, change, and, where several read the same, the number among
/// them.
fn faults(whole: &Arc<Netlist>) -> Vec<(String, Mutant)> {
    let mut seen: HashMap<String, u32> = HashMap::new();
    let named = |mutant: Mutant| {
        let text = format!("{}: {}", mutant.module, mutant.description);
        let number = seen.entry(text.clone()).and_modify(|number| *number += 1).or_insert(1);
        (if *number == 1 { text } else { format!("{text}, number {number}") }, mutant)
    };
    mutants(whole).into_iter().map(named).collect()
}

/// The netlist with the fault of that description.
fn faulty(whole: &Arc<Netlist>, fault: &str) -> Option<Arc<Netlist>> {
    let (_, mutant) = faults(whole).into_iter().find(|(text, _)| text == fault)?;
    Some(mutant.apply(whole))
}

fn run_on(case: &Case, netlist: &Netlist) -> Result<Checked, LockstepError> {
    let interface = case.interface();
    let mut device = NetlistDevice::new(netlist, &interface)?;
    device.disturb(case.disturbed);
    device.reset();
    let mut reference = model(&case.plan, &interface)?;
    case.run_devices(&interface, &mut *reference, &mut device)
}

#[test]
fn kept_cases_agree_and_find_their_faults() {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder())
        .expect("the cases")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    let (mut all, mut found) = (Checked::default(), 0);
    for file in &files {
        let name = file.file_name().expect("a file").to_string_lossy().into_owned();
        let text = std::fs::read_to_string(file).expect("a case");
        let case = Case::from_toml(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(!case.about.is_empty(), "{name} does not say what it is for");
        let checked = case.run().unwrap_or_else(|error| panic!("{name}: {error}\n{}", case.about));
        assert!(checked.compared > 0 && checked.tokens > 0, "{name} compares nothing");
        all.merge(&checked);
        let Some(fault) = &case.fault else { continue };
        let whole = netlist(&case.plan, case.unit).expect("can be built");
        let faulty = faulty(&whole, fault)
            .unwrap_or_else(|| panic!("{name}: no fault {fault} in the netlist any more"));
        match run_on(&case, &faulty) {
            Err(LockstepError::Differs { difference, .. }) => println!("{name}: {difference}"),
            other => panic!("{name}: {fault} is not found: {other:?}"),
        }
        found += 1;
    }
    println!(
        "{} cases, {found} of them find a fault, {} values of ports compared",
        files.len(),
        all.compared
    );
    assert!(found >= 8 && files.len() >= found);
}

/// A case for the unit, at random.
fn random_case(plan: &Plan, unit: Unit, rng: &mut Pcg64Mcg) -> Case {
    let interface = Interface::new(plan, unit);
    let mut case = Case::new(plan, unit);
    case.tokens = random_tokens(plan, unit, 60, rng);
    let mut share = || if rng.random() { rng.random_range(0..180) } else { 0 };
    case.unwilling = interface.waits().map(|wait| (wait.to_owned(), share())).collect();
    case.clear_z = Some(rng.random_range(0..=few(plan)));
    case.seed = rng.random_range(0..1 << 32);
    case.cycles = 600;
    case
}

#[test]
#[ignore = "writes cases"]
fn look_for_cases() {
    for kept in FAULTS {
        let (plan, unit) = (plan(kept), Unit::named(kept.unit).expect("declared"));
        let whole = netlist(&plan, unit).expect("can be built");
        let mut rng = Pcg64Mcg::seed_from_u64(1);
        let of_words =
            faults(&whole).into_iter().filter(|(text, _)| kept.words.iter().all(|word| text.contains(word)));
        let found = of_words.into_iter().find_map(|(fault, mutant)| {
            let faulty = mutant.apply(&whole);
            let fails = |case: &Case| matches!(run_on(case, &faulty), Err(LockstepError::Differs { .. }));
            let case = (0..400).map(|_| random_case(&plan, unit, &mut rng)).find(|case| fails(case))?;
            let mut case = shrunk_with(case, fails);
            case.cycles = case.cycles.min(case.tokens.len() as u64 * 200 + 60);
            let about = kept.name.replace('_', " ");
            fails(&case).then_some(Case { about, fault: Some(fault), ..case })
        });
        match found {
            Some(case) => {
                println!("{}: {} tokens find {:?}", kept.name, case.tokens.len(), case.fault);
                std::fs::write(folder().join(format!("{}.toml", kept.name)), case.to_toml())
                    .expect("written");
            }
            None => println!("{}: none", kept.name),
        }
    }
}
