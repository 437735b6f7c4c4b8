//! Slope edges: a pixel may differ from the exact rule only within (n_y + 1)·2^-(F+1) px of an edge (bound 5).

use crate::common::{Check, Triangle, random_machine, random_triangle};
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::Stalls;
use rand::{Rng, SeedableRng, rngs::StdRng};

/// Horizontal distance of a pixel's centre from the nearest edge that meets its line, and the most that bound 5 allows
/// there; px, as a ratio.
fn of_bound(machine: &Plan, triangle: &Triangle, x: i64, y: i64) -> f64 {
    let one = f64::from(1u32 << machine.subpixel_bits);
    let (cx, cy) = (x as f64 + 0.5, y as f64 + 0.5);
    let edge = |i: usize| {
        let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
        let (a, b) = if a.y() <= b.y() { (a, b) } else { (b, a) };
        let [ax, ay, bx, by] = [a.x(), a.y(), b.x(), b.y()].map(|c| f64::from(c) / one);
        if ay > cy || by <= cy {
            return f64::INFINITY;
        }
        let crossing = ax + (bx - ax) * (cy - ay) / (by - ay);
        let steps = y as f64 - (ay - 0.5).ceil().max(0.0);
        let allowed = (steps + 1.0) * 0.5f64.powi(machine.edge_fraction as i32 + 1);
        (cx - crossing).abs() / allowed
    };
    (0..3).map(edge).fold(f64::INFINITY, f64::min)
}

#[test]
fn pixels_differ_only_near_an_edge() {
    let mut rng = StdRng::seed_from_u64(1);
    for (fraction, differ) in
        [("1", true), ("4", true), ("8", true), ("12", true), ("20", false), ("30", false)]
    {
        let mut machine = Machine::default();
        machine.set("edge.kind", "slope").expect("a key");
        machine.set("edge.fraction_bits", fraction).expect("a key");
        let machine = machine.plan().expect("can be built");
        let triangles: Vec<_> = (0..400)
            .map(|_| {
                let size = 2f64.powf(rng.random_range(-2.0..9.0));
                random_triangle(&machine, size, &mut rng)
            })
            .collect();
        let (check, _) = Check::run(&machine, &triangles, Stalls::NONE);
        let worst = (check.wrong.iter().map(|&(i, x, y)| of_bound(&machine, &triangles[i], x, y)))
            .fold(0.0, f64::max);
        check.report(&format!("F = {fraction}, at most {worst:.3} of bound 5"));
        assert!(check.fragments > 100_000);
        assert!(worst <= 1.0 + 1e-9, "{worst} of the bound"); // distances are f64
        assert_eq!(!check.wrong.is_empty(), differ, "F = {fraction}");
        check.within_bounds(); // of values on covered pixels
    }
}

#[test]
fn random_machines() {
    let mut rng = StdRng::seed_from_u64(2);
    let fixed =
        [("screen.width", "50"), ("screen.height", "40"), ("edge.fill", "exact"), ("edge.kind", "slope")];
    let (mut wrong, mut pixels) = (0, 0);
    for _ in 0..150 {
        let machine = random_machine(&fixed, &mut rng);
        let triangles: Vec<_> = (0..60)
            .map(|_| {
                let size = 2f64.powf(rng.random_range(-2.0..7.0));
                random_triangle(&machine, size, &mut rng)
            })
            .collect();
        let (check, _) = Check::run(&machine, &triangles, Stalls::NONE);
        for &(i, x, y) in &check.wrong {
            let ratio = of_bound(&machine, &triangles[i], x, y);
            assert!(ratio <= 1.0 + 1e-9, "{ratio} of the bound at ({x}, {y}) of {:?}", triangles[i]);
        }
        wrong += check.wrong.len();
        pixels += check.pixels;
    }
    println!("{wrong} of {pixels} pixels differ");
    assert!(wrong > 0 && pixels > 0);
}
