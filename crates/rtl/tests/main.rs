//! The suites of this crate as one program, a file a suite: built once, and none waits for the one before.

mod drive;
mod random;

mod channels;
mod elaborate;
mod join;
mod ports;
mod shade;
mod term;
mod timing;
