//! Writes random triangles of so many pixels each, wholly on a screen of 1280x960, as a triangle file:
//! `cargo run --release -p edgewalk-model --example random_tri 5000 100 > small.tri`

mod common;

use edgewalk_numerics::Machine;
use std::io::{BufWriter, Write};

fn main() -> std::io::Result<()> {
    let argument = |n| std::env::args().nth(n).and_then(|text| text.parse::<u32>().ok());
    let (count, area) = (argument(1).unwrap_or(5000), argument(2).unwrap_or(100));
    let machine = Machine { width: 1280, height: 960, ..Machine::default() };
    let one = f64::from(1u32 << machine.subpixel_bits);
    let full = machine.channels().map(|c| (c.max() << c.vertex_fraction) as f64);
    let mut out = BufWriter::new(std::io::stdout().lock());
    writeln!(out, "size {} {}", machine.width, machine.height)?;
    for triangle in common::triangles(&machine, count as usize, f64::from(area)) {
        write!(out, "T")?;
        for vertex in triangle {
            let [z, r, g, b] = std::array::from_fn(|i| vertex.value[i] as f64 / full[i]);
            write!(out, "  {} {} {z} {r} {g} {b} 0", f64::from(vertex.x) / one, f64::from(vertex.y) / one)?;
        }
        writeln!(out)?;
    }
    out.flush()
}
