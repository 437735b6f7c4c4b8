//! Waveforms of a running simulator as VCD or FST, and counts of its transitions as SAIF, written to whatever the caller opened;
//! the values of every bit, 64 cycles in a word ([`BitBlocks`]).
//!
//! A trace has a scope for the top module and one for each instance in it; every named signal that can change is there, and
//! `clk`. A signal whose values have names ([`Labels`]) has another beside it, `<name>_name`: text in a VCD; in an FST, which
//! its writer gives no text, a character a byte, for a viewer's ASCII format.
//! A cycle lasts 10 ns and begins with the rising edge, so a sample is what the signals are until the next edge.

mod blocks;
mod fst;
mod saif;
mod transitions;
mod vcd;
mod watch;

pub use blocks::BitBlocks;
pub use fst::FstTrace;
pub use transitions::{Transitions, UnitTransitions};
pub use vcd::VcdTrace;
pub use watch::Labels;
