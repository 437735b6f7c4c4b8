//! Coverage equal to the exact rule at every pixel; z and colour within 1 LSB of the exact value.

mod common;

use common::{Check, random_triangle};
use edgewalk_model::Stalls;
use edgewalk_numerics::Machine;
use rand::{Rng, SeedableRng, rngs::StdRng};

fn report(name: &str, check: &Check) {
    println!(
        "{name}: {} wrong of {} pixels, {} fragments, errors {:.4?} LSB",
        check.wrong.len(),
        check.pixels,
        check.fragments,
        check.error
    );
}

#[test]
fn triangles_of_all_sizes() {
    let machine = Machine::default();
    let mut rng = StdRng::seed_from_u64(1);
    let triangles: Vec<_> = (0..3000)
        .map(|_| {
            let size = 2f64.powf(rng.random_range(-6.0..9.0));
            random_triangle(&machine, size, &mut rng)
        })
        .collect();
    let (check, frame) = Check::run(&machine, &triangles, Stalls::NONE);
    report("all sizes", &check);
    check.passes();
    assert!(frame.counters.add_up());
}
