//! Every permitted machine becomes a netlist.

use crate::random;
use std::collections::BTreeSet;

use edgewalk_machine::key::Domain;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{BlendKind, MAX_CHANNELS, Machine, Plan, ShadeKind, ShadowLight};
use edgewalk_rtl as rtl;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

const RANDOM: usize = 1000;

#[test]
fn every_machine_elaborates() {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let presets = ["default", "textbook"].into_iter().filter_map(Plan::preset);
    let (mut choices, mut schedules) = (BTreeSet::new(), BTreeSet::new());
    let mut checked = 0;
    for plan in presets.chain((0..RANDOM).map(|_| random::random_plan(&mut rng))) {
        for netlist in [rtl::machine(&plan), rtl::memory(&plan, plan.z.max())] {
            match netlist {
                Ok(netlist) => assert!(netlist.outputs.len() > 4),
                Err(errors) => panic!("{plan:?}\n{errors}"),
            }
        }
        choices.extend(KEYS.iter().filter(|key| (key.used)(&plan)).map(|key| (key.name, key.show(&plan))));
        schedules.insert((plan.channels().len(), plan.adders));
        checked += 1;
    }
    println!("{checked} of {} machines elaborate", RANDOM + 2);
    assert_eq!(checked, RANDOM + 2);

    // All that can be chosen from a list was chosen, and every number of channels and adders met.
    let mut most = Machine { extra: 4, ..Machine::default() };
    (most.blend.kind, most.shadow.light) = (BlendKind::Interpolated, ShadowLight::Parallel);
    most.shade.kind = ShadeKind::FastPhong;
    for key in KEYS.iter().filter(|key| (key.used)(&most)) {
        let all = match key.domain {
            Domain::OneOf(list) => list.len(),
            Domain::Word(words) => words.len(),
            Domain::Range(..) => continue,
        };
        assert_eq!(choices.iter().filter(|(name, _)| *name == key.name).count(), all, "{}", key.name);
    }
    let all: usize = (4..=MAX_CHANNELS).sum();
    assert_eq!(schedules.len(), all, "{schedules:?}");
}
