//! A triangle file to time engines with: `cargo run --release -p edgewalk-model --example random_triangles -- COUNT AREA
//! [WIDTH HEIGHT] > FILE.tri`. Always the same triangles, AREA pixels each, wholly on the screen of the default machine.

mod common;

use edgewalk_machine::{Machine, Plan, PortVertex};
use std::io::{self, Write};
use std::process::ExitCode;

fn write(plan: &Plan, triangles: &[[PortVertex; 3]], mut out: impl Write) -> io::Result<()> {
    writeln!(out, "size {} {}", plan.width, plan.height)?;
    let pixels = |x: i32| f64::from(x) / f64::from(1 << plan.subpixel_bits);
    let channels = plan.channels();
    for triangle in triangles {
        write!(out, "T")?;
        for vertex in triangle {
            write!(out, "  {} {}", pixels(vertex.x()), pixels(vertex.y()))?;
            for (value, channel) in vertex.values().iter().zip(channels) {
                let one = channel.max() << channel.vertex_fraction;
                write!(out, " {}", *value as f64 / one as f64)?;
            }
            write!(out, " 0")?;
        }
        writeln!(out)?;
    }
    out.flush()
}

fn main() -> ExitCode {
    let numbers: Option<Vec<u32>> = std::env::args().skip(1).map(|text| text.parse().ok()).collect();
    let (count, area, machine) = match numbers.as_deref() {
        Some(&[count, area]) => (count, area, Machine::default()),
        Some(&[count, area, width, height]) => (count, area, Machine { width, height, ..Machine::default() }),
        _ => {
            eprintln!("random_triangles COUNT AREA [WIDTH HEIGHT]");
            return ExitCode::from(2);
        }
    };
    let fits = f64::from(area) < f64::from(machine.width) * f64::from(machine.height) / 8.0;
    let Some(plan) = machine.plan().ok().filter(|_| fits) else {
        eprintln!("no such machine, or triangles too large for its screen");
        return ExitCode::from(2);
    };
    let triangles = common::triangles(&plan, count as usize, f64::from(area));
    match write(&plan, &triangles, io::BufWriter::new(io::stdout().lock())) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
