//! Every permitted machine becomes a netlist.

mod common {
    pub mod configurations;
}

use common::configurations::random_machine;
use edgewalk_machine::Plan;
use edgewalk_rtl as rtl;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

#[test]
fn every_machine_elaborates() {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let presets = ["default", "textbook"].into_iter().filter_map(Plan::preset);
    let mut checked = 0;
    for machine in presets.chain((0..1000).map(|_| random_machine(&mut rng))) {
        for netlist in [rtl::machine(&machine), rtl::memory(&machine, machine.z.max())] {
            match netlist {
                Ok(netlist) => assert!(netlist.outputs.len() > 4),
                Err(errors) => panic!("{machine:?}\n{errors}"),
            }
        }
        checked += 1;
    }
    println!("{checked} of 1002 machines elaborate");
    assert_eq!(checked, 1002);
}
