//! NORMAL's table of 1/√x: chords of 256 pieces, and how far what they give is from the root (`docs/machine.md`, section 13).

use edgewalk_machine::Plan;

/// The first entry that is used: N·N is at least 1/4.
const FIRST: u32 = 64;

/// v and slope of entry k, in 2^-16: the chord over [k, k + 1]/256, lowered by half of what it lies above the root.
fn entry(k: u32) -> [u32; 2] {
    let root = |x: f64| 16.0 / x.sqrt();
    let (low, high) = (root(k.into()), root(f64::from(k) + 1.0));
    // The chord lies farthest above where the root is as steep as it: -8·x^(-3/2) = high - low.
    let steepest = ((low - high) / 8.0).powf(-2.0 / 3.0);
    let gap = low + (high - low) * (steepest - f64::from(k)) - root(steepest);
    let fixed = |value: f64| (value * 65536.0).round() as u32; // below 2^17
    [fixed(low - gap / 2.0), fixed(low - high)]
}

/// The words of the memory of the roots.
pub fn words(machine: &Plan) -> Vec<u128> {
    let list = (0..256).map(|k| if k < FIRST { [0, 0] } else { entry(k) });
    list.map(|[v, slope]| machine.root_word(v, slope)).collect()
}

/// The largest relative error of y for N·N from 1/4 to 1 in steps of 2^-16, which cuts it: every number of them tried.
pub fn relative_error() -> f64 {
    let mut worst = 0f64;
    for k in FIRST..256 {
        let [v, slope] = entry(k);
        for low in 0..256 {
            let y = f64::from(v) - f64::from((slope * low + 128) / 256);
            // The exact N·N is this number or up to one more.
            let s = f64::from(256 * k + low);
            for exact in [s, s + 1.0] {
                worst = worst.max((y / 65536.0 * (exact / 65536.0).sqrt() - 1.0).abs());
            }
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_fit_and_err_as_little_as_a_chord_can() {
        for k in FIRST..256 {
            let [v, slope] = entry(k);
            assert!(v < 1 << 17 && slope < 1 << 10, "{k}: {v} {slope}");
        }
        let error = relative_error();
        println!("1/√x: relative error at most 2^{:.3}", error.log2());
        assert!(error < 2f64.powf(-14.25) && error > 2f64.powf(-14.5));
    }
}
