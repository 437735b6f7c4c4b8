//! Triangles for SETUP: small ones, far ones, quotients that are ties, resets in every state of its work.

use crate::common;
use edgewalk_machine::{Channel, Plan};
use edgewalk_model::DrawState;
use edgewalk_vectors::{StallKind, Suite, Trace, capture};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
/// Triangles of a few sub-pixels around a pixel's centre: their areas are the small divisors that meet halves. Values of half of
/// them differ by as little or not at all, so that the area itself is the modulus, even or odd.
pub fn specks(machine: &Plan) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let scale = f64::from(1 << machine.subpixel_bits);
    let vertex = |random: &mut Pcg64Mcg, n: usize| {
        let mut at = || 2.5 + f64::from(random.random_range(-3..=3)) / scale;
        let at = (at(), at());
        let value = |channel: &Channel| {
            let few =
                |bits: u32| f64::from(bits) / f64::from(1 << channel.vertex_fraction) / channel.host_unit();
            match n % 4 {
                0 => few(random.random_range(0..=3)),
                2 => few(1),
                _ => channel.host_range().1 * random.random::<f64>(),
            }
        };
        let values: Vec<f64> = machine.channels().iter().map(value).collect();
        machine.port_vertex(at.0, at.1, &values).expect("inside")
    };
    let triangle = |n| std::array::from_fn(|_| vertex(&mut random, n));
    let triangles = (0..300).map(triangle).collect();
    let suite = Suite::of_triangles("specks", "areas of few sub-pixels", triangles);
    capture(machine, common::SETUP, &suite, DrawState::default(), StallKind::None)
}

/// Triangles with corners at the ends of the guard band, half of them only there, and values at their ends or anywhere: the widest differences,
/// areas and steps that the words of SETUP have to hold.
pub fn far(machine: &Plan) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(2);
    let limit = f64::from((1u32 << machine.guard_bits) - 1);
    let vertex = |random: &mut Pcg64Mcg, kinds: u32, ends: bool| {
        let mut at = || match random.random_range(0..kinds) {
            0 => -limit,
            1 => limit,
            _ => random.random_range(-limit..=limit),
        };
        let at = (at(), at());
        let channels = machine.channels().len();
        let values: Vec<f64> = if ends {
            (0..channels).map(|_| f64::from(random.random_range(0..=1u8))).collect()
        } else {
            (0..channels).map(|_| random.random()).collect()
        };
        machine.port_vertex(at.0, at.1, &values).expect("inside")
    };
    let triangle =
        |n| std::array::from_fn(|_| vertex(&mut random, if n % 2 == 0 { 2 } else { 4 }, n / 2 % 2 == 0));
    let triangles = (0..400).map(triangle).collect();
    let suite = Suite::of_triangles("far", "as far and as steep as can be", triangles);
    capture(machine, common::SETUP, &suite, DrawState::default(), StallKind::None)
}

/// Edges that fall less than a line from one side of the guard band to the other, whose DX does not fit, and triangles whose knee lies
/// twice as far off the sheared major edge as any difference is long.
pub fn steep(machine: &Plan) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let limit = f64::from((1u32 << machine.guard_bits) - 1);
    let step = 1.0 / f64::from(1 << machine.subpixel_bits);
    let triangle = |n| {
        let x = if n % 4 < 2 { -limit } else { limit };
        let corners = match n % 2 {
            0 => [(x, 0.5), (-x, 2.5 - step * f64::from(random.random_range(0..6))), (x, 4.5)],
            _ => [(x + step * x.signum() * -1.0, -limit), (-x, limit - step), (x, limit)],
        };
        corners.map(|(x, y)| {
            let values: Vec<f64> = machine.channels().iter().map(|_| random.random()).collect();
            machine.port_vertex(x, y, &values).expect("inside")
        })
    };
    let triangles = (0..120).map(triangle).collect();
    let suite = Suite::of_triangles("steep", "numbers that do not fit, the widest shears", triangles);
    capture(machine, common::SETUP, &suite, DrawState::default(), StallKind::None)
}

/// The same, with a reset in so many cycles or so: one comes in every state of the work.
pub fn cut_often(of: &Trace, each: u64) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(4);
    let mut trace = of.clone();
    trace.setting.resets = (0..of.cycles).filter(|_| random.random_range(0..each) == 0).collect();
    trace
}

/// Triangles whose area is a power of two: their quotients are ties as often as can be.
pub fn halves(machine: &Plan) -> Trace {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let scale = 1 << machine.subpixel_bits;
    let triangle = |_| {
        let at = loop {
            let at: [[i64; 2]; 3] =
                std::array::from_fn(|_| [0; 2].map(|_| random.random_range(0..32 * scale)));
            let [u, v] = [1, 2].map(|i| [0, 1].map(|axis| at[i][axis] - at[0][axis]));
            let area = (u[0] * v[1] - u[1] * v[0]).unsigned_abs();
            if area.is_power_of_two() && area >= 1 << (machine.z.fraction - 2) {
                break at;
            }
        };
        at.map(|at| {
            let [x, y] = at.map(|at| at as f64 / scale as f64);
            let values: Vec<f64> = machine.channels().iter().map(|_| random.random()).collect();
            machine.port_vertex(x, y, &values).expect("inside")
        })
    };
    let triangles = (0..100).map(triangle).collect();
    let suite = Suite::of_triangles("halves", "areas that are powers of two", triangles);
    capture(machine, common::SETUP, &suite, DrawState::default(), StallKind::None)
}
