//! Reset in the middle of a picture: the machine starts anew and draws as a new one.

use crate::common::{machine, random_triangle};
use edgewalk_model::tokens::FEW;
use edgewalk_model::{DrawState, Inputs, Memory, Outputs, Rig, Stalls};
use rand::{Rng, SeedableRng, rngs::StdRng};

#[test]
fn a_reset_machine_is_a_new_machine() {
    let mut rng = StdRng::seed_from_u64(1);
    for (fill, s) in [("exact", "8"), ("textbook", "0")] {
        for round in 0..40u32 {
            let machine = machine(&[
                ("screen.width", "32"),
                ("screen.height", "32"),
                ("screen.subpixel_bits", s),
                ("edge.fill", fill),
                ("interpolator.segments", "4"),
            ]);
            let triangles: Vec<_> = (0..20).map(|_| random_triangle(&machine, 40.0, &mut rng)).collect();
            // Drives a machine for some cycles; what it shows in each.
            let run = |rig: &mut Rig<FEW>, cycles: u32| -> Vec<Outputs<FEW>> {
                let mut next = 0;
                let cycle = |_| {
                    let cycle = rig.cycle(triangles.get(next).map(|t| (t, 0)), true);
                    next += usize::from(cycle.outputs.triangle);
                    cycle.outputs
                };
                (0..cycles).map(cycle).collect()
            };
            let fresh = || Rig::new(&machine, DrawState::default(), Stalls::NONE);
            let mut rig = fresh();
            run(&mut rig, rng.random_range(0..1500) + round);
            rig.model.cycle(&Inputs { rst: true, ..Inputs::default() });
            rig.memories.depth = Memory::new(&machine, [0; 3], Stalls::NONE);
            let mut again = run(&mut rig, 1500);
            let expected = run(&mut fresh(), 1500);
            assert!(expected.iter().any(|o| o.wr.is_some()));
            for (outputs, expected) in again.iter_mut().zip(&expected) {
                if let (Some(write), Some(expected)) = (&mut outputs.wr, &expected.wr) {
                    write.source.id = expected.source.id; // counts on over a reset, and is not hardware
                }
            }
            assert!(again == expected, "{fill}, round {round}");
        }
    }
}
