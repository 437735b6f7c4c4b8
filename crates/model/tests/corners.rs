//! Every event that a unit declares is counted under its name and met by some run here, and the counts add up.

use crate::common::{machine, random_triangle, render};
use edgewalk_model::{Activity, DrawState, Events, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

#[test]
fn nothing_is_missing() {
    let mut rng = StdRng::seed_from_u64(1);
    let mut all = Events::default();
    let mut spent = [0; Activity::ALL.len()];
    let mut can_happen = std::collections::BTreeSet::new();
    for hazard in ["drain", "interlock", "forward"] {
        for (fill, s) in [("exact", "4"), ("textbook", "0")] {
            for stalls in [Stalls::NONE, Stalls { seed: 5, rd: 120, data: 100, wr: 250 }] {
                let machine = machine(&[
                    ("screen.width", "12"),
                    ("screen.height", "12"),
                    ("screen.guard_bits", "6"),
                    ("screen.subpixel_bits", s),
                    ("edge.fill", fill),
                    ("formats.z_bits", "4"),
                    ("formats.z_fraction", "8"),
                    ("memory.hazard", hazard),
                ]);
                let triangles: Vec<_> = (0..2000)
                    .map(|_| {
                        let size = [1.0, 3.0, 30.0][rng.random_range(0..3)];
                        random_triangle(&machine, size, &mut rng)
                    })
                    .collect();
                let frame = render(&machine, &triangles, DrawState::default(), stalls);
                assert!(frame.counters.add_up(), "{:?}", frame.counters);
                assert_eq!(u64::from(frame.coverage.iter().sum::<u32>()), frame.counters.fragments);
                assert_eq!(u64::from(frame.writes.iter().sum::<u32>()), frame.counters.writes);
                let possible: Vec<_> = machine.events().map(|event| event.name).collect();
                can_happen.extend(possible.iter().copied());
                for (name, count) in frame.events.counts() {
                    assert!(count == 0 || possible.contains(&name), "{name} cannot happen with {hazard}");
                }
                all.merge(&frame.events);
                for (sum, cycles) in spent.iter_mut().zip(frame.counters.activity) {
                    *sum += cycles;
                }
            }
        }
    }
    for (name, count) in all.counts() {
        println!("{name:<20} {count}");
    }
    // What BLEND, SHADOW, TERM and SHADE meet has tests of its own.
    for activity in Activity::of(&machine(&[])) {
        println!("{:<20} {} cycles", activity.name(), spent[activity as usize]);
        assert!(spent[activity as usize] > 0, "no cycle was spent on {}", activity.name());
    }
    let missing = all.missing().into_iter().filter(|name| can_happen.contains(name));
    assert_eq!(missing.collect::<Vec<_>>(), Vec::<&str>::new());
    assert!(can_happen.len() > 25);
}

#[test]
fn an_idle_machine_misses_everything() {
    let frame = render(&machine(&[]), &[], DrawState::default(), Stalls::NONE);
    assert_eq!(frame.events.missing().len(), frame.events.counts().len());
    assert_eq!((frame.counters.cycles, frame.counters.spent(Activity::Idle)), (1, 1));
}
