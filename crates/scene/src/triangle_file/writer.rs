//! Writes a triangle file; every number comes back bit for bit.

use crate::frame::{Frame, Shadow, Triangle, Vertex};
use crate::polygon::Primitive;
use std::io::{self, Write};
use std::iter;

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
    if frame.extra > 0 {
        writeln!(out, "extra {}", frame.extra)?;
    }
    if let Some(shadow) = &frame.shadow {
        write_shadow(shadow, &mut out)?;
    }
    for primitive in frame.primitives() {
        match primitive {
            Primitive::Triangle(triangle) => {
                write!(out, "T")?;
                vertices(&triangle.0, &mut out)?;
                if frame.extra > 0 {
                    extra(triangle, frame.extra, &mut out)?;
                }
            }
            Primitive::Polygon(polygon) => {
                for (contour, key) in polygon.contours.iter().zip(iter::once("P").chain(iter::repeat("H"))) {
                    write!(out, "{key} {}", contour.len())?;
                    vertices(contour, &mut out)?;
                }
            }
        }
    }
    Ok(())
}

/// The rest of a line.
fn vertices(list: &[Vertex], out: &mut impl Write) -> io::Result<()> {
    for v in list {
        write!(out, "  {} {} {} {} {} {} {}", v.x, v.y, v.z, v.r, v.g, v.b, v.kt)?;
    }
    writeln!(out)
}

/// The `X` line of a triangle.
fn extra(triangle: &Triangle, count: usize, out: &mut impl Write) -> io::Result<()> {
    write!(out, "X ")?;
    for vertex in &triangle.0 {
        for value in vertex.extra.iter().take(count) {
            write!(out, " {value}")?;
        }
        write!(out, " ")?;
    }
    writeln!(out)
}

fn write_shadow(shadow: &Shadow, out: &mut impl Write) -> io::Result<()> {
    write!(out, "shadow {} {} {}", shadow.size, shadow.bias, shadow.ambient)?;
    for [m0, m1, m2, m3] in shadow.matrix {
        write!(out, "  {m0} {m1} {m2} {m3}")?;
    }
    writeln!(out)?;
    for [a, b, c] in &shadow.triangles {
        write!(out, "L")?;
        for [x, y, z] in [a, b, c] {
            write!(out, "  {x} {y} {z}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}
