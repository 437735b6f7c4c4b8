//! The memory behind the machine beside one that is clocked by itself.

use crate::common::{machine, random_triangle};
use edgewalk_model::tokens::FEW;
use edgewalk_model::{DrawState, Memory, Rig, Stalls};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// The same seed stalls in the same cycles: those in which the machine rests count too.
#[test]
fn the_memory_is_clocked_in_every_cycle() {
    let plan = machine(&[("screen.width", "40"), ("screen.height", "24"), ("setup.lanes", "1")]);
    let stalls = Stalls { seed: 7, rd: 100, data: 100, wr: 100 };
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let triangles: Vec<_> = (0..20).map(|_| random_triangle(&plan, 6.0, &mut rng)).collect();
    let mut rig = Rig::<FEW>::new(&plan, DrawState::default(), stalls);
    let mut beside = Memory::<FEW>::new(&plan, [0; 3], stalls);
    let (mut waiting, mut cycles, mut busy) = (&triangles[..], 0, 0);
    loop {
        let offered = waiting.first().map(|triangle| (triangle, 0));
        let inputs = rig.inputs(offered, true);
        assert_eq!(
            (inputs.rd_ready, inputs.data, inputs.wr_ready),
            (beside.rd_ready(), beside.data(), beside.wr_ready()),
            "cycle {cycles}"
        );
        let cycle = rig.cycle(offered, true);
        beside.step(cycle.read, cycle.data_taken, cycle.write());
        cycles += 1;
        busy += u32::from(cycle.read.is_some());
        if cycle.outputs.triangle {
            waiting = &waiting[1..];
        } else if cycle.outputs.idle && waiting.is_empty() {
            break;
        }
    }
    println!("{cycles} cycles, {busy} of them with a read: readies and data as beside");
    assert!(busy > 50 && cycles > 20 * busy, "{cycles} cycles, {busy} reads");
}
