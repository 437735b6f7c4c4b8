//! A memory of three words with two ports of each kind, and a ROM.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist};

/// Words of so many bits, all but one the same at the start or unknown; one address of four has no word.
pub fn module(width: u32, known: bool) -> Arc<Netlist> {
    let m = Module::new("ram", "");
    let init = 5 & ((1 << width.min(3)) - 1);
    let port = |name: &str| (m.input(&format!("{name}_en"), 1), m.input(&format!("{name}_addr"), 2));
    let ram = m.memory("words", 2, 3, width);
    let ram = if known { ram.starts(init) } else { ram }.holds(1, init - init % 2, "a row of its own");
    let rom = m.memory("rom", 2, 3, width);
    (0..3).for_each(|row| _ = rom.holds(row, (u128::MAX >> (128 - width)) / (row as u128 + 1), ""));
    for name in ["w0", "w1"] {
        let (en, addr) = port(name);
        ram.write(en, addr, m.input(&format!("{name}_data"), width));
    }
    for name in ["r0", "r1"] {
        let (en, addr) = port(name);
        m.output(name, ram.read(en, addr));
        m.output(&format!("{name}_rom"), rom.read(en, addr));
    }
    m.finish().unwrap()
}
