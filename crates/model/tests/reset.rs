//! Reset in the middle of a picture: the machine starts anew and draws as a new one.

mod common;

use common::{machine, random_triangle};
use edgewalk_model::{Inputs, Memory, Model, Outputs, Stalls};
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
                ("setup.radix", "16"),
            ]);
            let triangles: Vec<_> = (0..20).map(|_| random_triangle(&machine, 40.0, &mut rng)).collect();
            // Drives a machine for some cycles; what it shows in each.
            let run = |model: &mut Model, cycles: u32| -> Vec<Outputs> {
                let mut memory = Memory::new(&machine, [0; 3], Stalls::NONE);
                let mut next = 0;
                let cycle = |_| {
                    let inputs = Inputs {
                        tri: triangles.get(next).map(|t| (t, 0)),
                        depth_func: 1,
                        depth_write: true,
                        rd_ready: true,
                        data: memory.data(),
                        wr_ready: true,
                        rst: false,
                    };
                    let outputs = model.cycle(&inputs);
                    next += usize::from(outputs.tri_ready);
                    memory.step(outputs.rd, inputs.data.is_some() && outputs.data_ready, outputs.wr.as_ref());
                    outputs
                };
                (0..cycles).map(cycle).collect()
            };
            let mut model = Model::new(&machine);
            run(&mut model, rng.random_range(0..1500) + round);
            model.cycle(&Inputs { rst: true, ..Inputs::default() });
            let mut again = run(&mut model, 1500);
            let expected = run(&mut Model::new(&machine), 1500);
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
