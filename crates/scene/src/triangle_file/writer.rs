//! Writes a triangle file; every number comes back bit for bit.

use crate::frame::Frame;
use std::io::{self, Write};

/// Writes `frame` as a triangle file.
///
/// # Errors
/// `out` fails.
pub fn write(frame: &Frame, mut out: impl Write) -> io::Result<()> {
    writeln!(out, "size {} {}", frame.width, frame.height)?;
    writeln!(out, "mode {}", frame.mode.name())?;
    writeln!(out, "depth {}", frame.depth.map_or("off", |func| func.name()))?;
    writeln!(out, "depth_write {}", u8::from(frame.depth_write))?;
    writeln!(out, "blend {}", u8::from(frame.blend))?;
    let [r, g, b] = frame.clear;
    writeln!(out, "clear {r} {g} {b}")?;
    for triangle in &frame.triangles {
        write!(out, "T")?;
        for v in &triangle.0 {
            write!(out, "  {} {} {} {} {} {} {}", v.x, v.y, v.z, v.r, v.g, v.b, v.kt)?;
        }
        writeln!(out)?;
    }
    Ok(())
}
