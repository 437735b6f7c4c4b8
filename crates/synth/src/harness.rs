//! A module around the design that leaves two data pins: any number of ports fits, and every path inside runs from
//! register to register.
//!
//! ```text
//!  serial_in ─> [in] ─> [in] ─> ...            shift register over all inputs
//!                 └─> design ─> [out] ─┐       a register at every output
//!              ... ─> [chain] ─────── xor ─> [chain] ─> serial_out
//! ```
//! Every output counts in `serial_out`, so none of it can be left out.

use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};
use std::sync::Arc;

/// The module around it.
pub(crate) const MODULE: &str = "harness";
/// The design in it.
pub(crate) const DESIGN: &str = "dut";
/// Registers before the design, by port.
pub(crate) const IN: &str = "harness_in_";
/// Registers behind it, by port.
pub(crate) const OUT: &str = "harness_out_";
const CHAIN: &str = "harness_chain_";

pub(crate) fn harness(design: &Arc<Netlist>) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new(MODULE, "what is measured, between shift registers.");
    let mut bit = m.input("serial_in", 1);
    let inputs: Vec<Signal<'_>> = design
        .inputs
        .iter()
        .map(|input| {
            let register = m.reg(&format!("{IN}{}", input.name), design.width(input.node));
            let value = shifted(&m, register.q(), bit);
            register.set(value);
            bit = register.q().msb();
            register.q()
        })
        .collect();
    let dut = m.instance(DESIGN, design);
    for (input, signal) in design.inputs.iter().zip(inputs) {
        dut.connect(&input.name, signal);
    }
    let mut bit = m.lit(1, 0);
    for output in &design.outputs {
        let width = design.width(output.driver);
        let out = m.reg(&format!("{OUT}{}", output.name), width);
        out.set(dut.output(&output.name));
        let chain = m.reg(&format!("{CHAIN}{}", output.name), width);
        let value = shifted(&m, chain.q(), bit) ^ out.q();
        chain.set(value);
        bit = chain.q().msb();
    }
    m.output("serial_out", bit);
    m.finish()
}

/// One to the left, with this bit at the right.
fn shifted<'m>(m: &'m Module, word: Signal<'m>, bit: Signal<'m>) -> Signal<'m> {
    match word.width() {
        1 => bit,
        width => m.cat(&[word.trunc(width - 1), bit]),
    }
}
