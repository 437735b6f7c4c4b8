//! Sums with a lowest bit more, out of which a carry comes.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist};

/// Sums of so many bits.
pub fn module(width: u32) -> Arc<Netlist> {
    let m = Module::new("carry", "");
    let (a, b, carry) = (m.input("a", width), m.input("b", width), m.input("carry", 1));
    let (ones, other) = (m.cat(&[a, m.lit(1, 1)]), m.cat(&[b, carry]));
    m.output("sum", (ones + other).slice(width, 1));
    m.output("turned", (other + ones).slice(width, 1));
    m.output("low", (ones + other).slice(width.div_ceil(2), 1));
    m.output("high", (ones + other).slice(width, width));
    // No carry comes out of these in the same way.
    let zero = m.cat(&[a, m.lit(1, 0)]);
    m.output("none", (zero + other).slice(width, 1));
    m.output("all", ones + other);
    m.finish().unwrap()
}
