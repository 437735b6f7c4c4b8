//! When rigs make a device wait, by count and checksum: with other stalls everything passes too, so that without this nobody would see
//! that triangles do not meet any more. After a change that is meant: `UPDATE_EXPECT=1 cargo test --release -p edgewalk-lockstep stalls::`.

use edgewalk_lockstep::{Interface, Pattern, StallKind, Unit, patterns};
use edgewalk_machine::{Machine, Plan};
use expect_test::expect_file;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;

/// Machines with everything that a pattern looks at.
const MACHINES: [(&str, &str); 5] = [
    ("default", ""),
    ("blend", "blend.kind=constant"),
    ("a parallel light", "shadow.light=parallel"),
    ("perspective, pipelined", "shadow.light=perspective shadow.project=pipelined blend.kind=constant"),
    ("perspective, serial", "shadow.light=perspective shadow.project=serial"),
];

fn plan(settings: &str) -> Plan {
    let mut machine = Machine::default();
    for setting in settings.split_whitespace() {
        let (key, value) = setting.split_once('=').expect("key=value");
        machine.set(key, value).expect("a key and its value");
    }
    machine.plan().expect("can be built")
}

#[test]
fn every_pattern_waits_as_it_did() {
    let mut waited = String::new();
    for (name, settings) in MACHINES {
        let plan = plan(settings);
        for unit in Unit::all(&plan) {
            let interface = Interface::new(&plan, unit);
            for kind in StallKind::ALL {
                let patterns = patterns(&plan, &interface, kind, 3);
                let digest = Sha256::digest(format!("{patterns:?}"));
                let held = |pattern: &Pattern| pattern.bits().iter().filter(|willing| !**willing).count();
                let of: Vec<String> = patterns
                    .iter()
                    .map(|pattern| format!("{}/{}", held(pattern), pattern.bits().len()))
                    .collect();
                write!(waited, "{name}, {}, {}: {}, ", unit.name(), kind.name(), of.join(" ")).expect("text");
                digest.iter().take(4).for_each(|byte| write!(waited, "{byte:02x}").expect("text"));
                waited.push('\n');
            }
        }
    }
    expect_file!["snapshots/stalls.txt"].assert_eq(&waited);
}

/// Counted from every cycle on, as a pattern begins again where it ends.
#[test]
fn the_longest_wait_may_lie_around_the_end() {
    let mut around = 0;
    for (_, settings) in MACHINES {
        let plan = plan(settings);
        let interface = Interface::new(&plan, Unit::MACHINE);
        for pattern in
            [1, 2, 3, 4].into_iter().flat_map(|seed| patterns(&plan, &interface, StallKind::Mixed, seed))
        {
            let length = pattern.bits().len() as u64;
            let wait =
                |from: u64| (from..from + length).take_while(|cycle| !pattern.at(*cycle)).count() as u64;
            let longest = (0..length).map(wait).max();
            assert_eq!(Some(pattern.longest_wait()), longest, "{:?}", pattern.bits());
            around += u32::from(!pattern.at(0) && !pattern.at(length - 1));
        }
    }
    assert!(around > 5, "{around}");
}
