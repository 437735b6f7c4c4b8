//! Memory files for `$readmemh`: a token a line, packed, lower-case hex, LF, a newline at the end (without it
//! Verilator 5.006 drops the last word).

use edgewalk_lockstep::pack::pack;
use edgewalk_lockstep::{Port, Token};

/// The tokens, each packed with its first field on top.
#[must_use]
pub fn tokens(fields: &[Port], tokens: &[Token]) -> String {
    let widths: Vec<u32> = fields.iter().map(|field| field.width()).collect();
    tokens.iter().map(|token| pack(&widths, token) + "\n").collect()
}

/// Cycles, or other plain numbers of `width` bits.
#[must_use]
pub fn numbers(width: u32, values: &[u64]) -> String {
    values.iter().map(|value| pack(&[width], &[u128::from(*value)]) + "\n").collect()
}

/// A bit a line, for `$readmemb`.
#[must_use]
pub fn bits(bits: &[bool]) -> String {
    bits.iter().map(|bit| if *bit { "1\n" } else { "0\n" }).collect()
}
