//! Random triangles. Number k depends only on (seed, suite, k): a longer run begins with the shorter one.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::Plan;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sha2::{Digest, Sha256};

type Draw = fn(&Pen, &mut Pcg64Mcg) -> Triangle;

pub(super) fn cases(machine: &Plan, seed: u64, count: u64) -> Vec<Case> {
    let pen = Pen::new(machine);
    let kinds: [(&str, Draw); 4] =
        [("near_the_screen", near), ("tiny", tiny), ("long_and_thin", long), ("upright", upright)];
    (0..count)
        .map(|k| {
            let (name, draw) = kinds[(k % 4) as usize];
            case(&format!("{name}_{k}"), [draw(&pen, &mut stream(seed, "random", k))])
        })
        .collect()
}

/// The random numbers of one vector.
fn stream(seed: u64, suite: &str, k: u64) -> Pcg64Mcg {
    let digest = Sha256::digest(format!("{seed}/{suite}/{k}"));
    let mut state = [0; 16];
    state.copy_from_slice(&digest[..16]);
    Pcg64Mcg::from_seed(state)
}

fn values(random: &mut Pcg64Mcg) -> [f64; 4] {
    std::array::from_fn(|_| random.random::<f64>())
}

/// About the size of the screen, up to 16 px a side, and a little off it.
fn near(pen: &Pen, random: &mut Pcg64Mcg) -> Triangle {
    let (w, h) = pen.size();
    let corner = (random.random_range(-4.0..w), random.random_range(-4.0..h));
    let side = 16.0;
    std::array::from_fn(|_| {
        let at = (corner.0 + random.random_range(0.0..side), corner.1 + random.random_range(0.0..side));
        pen.vertex(at, values(random))
    })
}

/// Less than two pixels wide, on the first few pixels of the screen, so that pixels are met again.
fn tiny(pen: &Pen, random: &mut Pcg64Mcg) -> Triangle {
    let corner = (random.random_range(0.0..2.0), random.random_range(0.0..2.0));
    std::array::from_fn(|_| {
        let at = (corner.0 + random.random_range(0.0..2.0), corner.1 + random.random_range(0.0..2.0));
        pen.vertex(at, values(random))
    })
}

/// Anywhere in the guard band (up to 256 px from the screen's corner) and about two lines high.
fn long(pen: &Pen, random: &mut Pcg64Mcg) -> Triangle {
    let (_, h) = pen.size();
    let reach = pen.limit().min(256.0);
    let y = random.random_range(-1.0..h);
    std::array::from_fn(|_| {
        let at = (random.random_range(-reach..reach), y + random.random_range(0.0..2.0));
        pen.vertex(at, values(random))
    })
}

/// From far above to far below the screen, in the columns of the screen and a little beside them.
fn upright(pen: &Pen, random: &mut Pcg64Mcg) -> Triangle {
    let (w, _) = pen.size();
    let ends = [-pen.limit(), pen.limit()];
    std::array::from_fn(|i| {
        let y = ends[(i + random.random_range(0..2)) % 2] * random.random_range(0.3..1.0);
        pen.vertex((random.random_range(-8.0..w.min(64.0) + 8.0), y), values(random))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vector_depends_only_on_seed_suite_and_number() {
        let machine = Plan::default();
        let (long, short) = (cases(&machine, 7, 30), cases(&machine, 7, 9));
        assert_eq!(short[..], long[..9]);
        let other = cases(&machine, 8, 9);
        assert!(short.iter().zip(&other).all(|(a, b)| a.triangles != b.triangles));
    }
}
