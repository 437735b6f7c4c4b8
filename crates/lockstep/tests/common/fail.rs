//! A failure with the smallest case that shows it, to be kept in `cases`.

use edgewalk_lockstep::{Case, Checked, LockstepError};

/// What was checked, or the test's failure: the difference, and a file that shows it again.
pub fn checked(case: &Case) -> Checked {
    checked_by(case, Case::run)
}

/// The same for long runs: compiled, the netlist is many times as fast as in the interpreter, which tests of `jit` hold it against.
pub fn checked_compiled(case: &Case) -> Checked {
    checked_by(case, |case| {
        case.run_by(|netlist| edgewalk_jit::Simulator::new(netlist).expect("a code generator for this host"))
    })
}

fn checked_by(case: &Case, run: impl Fn(&Case) -> Result<Checked, LockstepError>) -> Checked {
    run(case).unwrap_or_else(|error| {
        let small = shrunk_with(case.clone(), |case| matches!(run(case), Err(LockstepError::Differs { .. })));
        let told = run(&small).err().map_or_else(String::new, |error| error.to_string());
        panic!("{error}\nKeep this in crates/lockstep/cases, it shows: {told}\n{}", small.to_toml())
    })
}

/// Without the tokens that it fails without, but for the first, which brings increments.
pub fn shrunk_with(mut case: Case, fails: impl Fn(&Case) -> bool) -> Case {
    let mut step = case.tokens.len().div_ceil(2);
    while step > 0 {
        let mut from = 1;
        while from < case.tokens.len() {
            let mut less = case.clone();
            less.tokens.drain(from..(from + step).min(less.tokens.len()));
            if fails(&less) { case = less } else { from += step }
        }
        step /= 2;
    }
    case
}
