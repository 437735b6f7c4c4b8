//! A failure with the smallest case that shows it, to be kept in `cases`.

use edgewalk_lockstep::{Case, Checked, LockstepError};

/// What was checked, or the test's failure: the difference, and a file that shows it again.
pub fn checked(case: &Case) -> Checked {
    case.run().unwrap_or_else(|error| {
        let small = shrunk(case.clone());
        let told = small.run().err().unwrap_or(error);
        panic!("{told}\nKeep this in crates/lockstep/cases:\n{}", small.to_toml())
    })
}

/// Without the tokens that it fails without.
fn shrunk(mut case: Case) -> Case {
    let fails = |case: &Case| matches!(case.run(), Err(LockstepError::Differs { .. }));
    let mut step = case.tokens.len().div_ceil(2);
    while step > 0 {
        let mut from = 0;
        while from < case.tokens.len() {
            let mut less = case.clone();
            less.tokens.drain(from..(from + step).min(less.tokens.len()));
            if fails(&less) { case = less } else { from += step }
        }
        step /= 2;
    }
    case
}
