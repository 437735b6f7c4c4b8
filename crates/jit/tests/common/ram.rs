//! A memory of three words with two ports of each kind.

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist};

/// Words of so many bits, the same at the start or unknown; one address of four has no word.
pub fn module(width: u32, known: bool) -> Arc<Netlist> {
    let m = Module::new("ram", "");
    let init = 5 & ((1 << width.min(3)) - 1);
    let port = |name: &str| (m.input(&format!("{name}_en"), 1), m.input(&format!("{name}_addr"), 2));
    let ram = m.memory("words", 2, 3, width);
    let ram = if known { ram.starts(init) } else { ram };
    for name in ["w0", "w1"] {
        let (en, addr) = port(name);
        ram.write(en, addr, m.input(&format!("{name}_data"), width));
    }
    for name in ["r0", "r1"] {
        let (en, addr) = port(name);
        m.output(name, ram.read(en, addr));
    }
    m.finish().unwrap()
}
