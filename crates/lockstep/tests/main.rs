//! The suites of this crate as one program, a file a suite: built once, and none waits for the one before.

mod common;

mod cases;
mod draw;
mod faults;
mod interface;
mod kept;
mod lights;
mod memory;
mod own_pass;
mod rom;
mod sequenced;
mod stalls;
mod tables;
mod units;
mod whole;
