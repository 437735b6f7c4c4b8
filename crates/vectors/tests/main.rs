//! The suites of this crate as one program, a file a suite: built once, and none waits for the one before.

mod common;

mod bench;
mod directory;
mod edits;
mod lockstep;
mod mutants;
mod power_up;
mod reach;
mod replay;
mod rules;
mod simulators;
mod stimuli;
