//! What is to be drawn: an array of triangles, or a triangle file.

use crate::array::floats;
use crate::error::{Error, raised};
use crate::machine::{Machine, on_screen};
use edgewalk_host::input::fitting;
use edgewalk_machine::Plan;
use edgewalk_scene::triangle_file::{parse, read};
use edgewalk_scene::{Frame, InputError};
use pyo3::prelude::*;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Values of a vertex: x, y in pixels, z, r, g, b and kt in 0 to 1.
const VERTEX: usize = 7;

/// An error in the text that was made of a header and an array, by its place in these: the array begins behind `before` lines.
fn in_array(error: InputError, before: usize) -> PyErr {
    let (InputError::Fault(fault) | InputError::NeedsWhole(fault)) = error else {
        return raised(&error.into());
    };
    let mut fault = *fault;
    match fault.line.take() {
        Some(line) if line > before => {
            fault.file = format!("triangles[{}]", line - before - 1);
            // `T vertex 1 x`: an array's first vertex is its vertex 0.
            let words: Vec<&str> = fault.key.split(' ').collect();
            if let ["T", "vertex", vertex, name] = words[..]
                && let Ok(vertex) = vertex.parse::<usize>()
            {
                fault.key = format!("vertex {}, {name}", vertex - 1);
            }
        }
        // The first line says the size.
        Some(line) if line > 1 => (fault.file, fault.line) = ("header".to_owned(), Some(line - 1)),
        _ => {}
    }
    raised(&InputError::from(Box::new(fault)).into())
}

/// The frame, and the machine with its screen. `header` is more lines before the triangles of an array.
pub fn frame(
    triangles: &Bound<'_, PyAny>,
    machine: Option<&Machine>,
    header: &str,
) -> PyResult<(Plan, Frame)> {
    let (name, plan, frame) = if let Ok(path) = triangles.extract::<PathBuf>() {
        if !header.is_empty() {
            return Err(Error::new_err(format!(
                "header: given with the file {}; permitted: with an array of triangles; write the lines into the file",
                path.display()
            )));
        }
        let frame = read(&path).map_err(|error| raised(&error.into()))?;
        (path.display().to_string(), on_screen(machine, Some((frame.width, frame.height)))?, frame)
    } else {
        let values = floats("triangles", triangles, &[3, VERTEX])?;
        let plan = on_screen(machine, None)?;
        // A file's reader checks the values, so that there is one place for limits and their messages.
        let mut text = format!("size {} {}\n{header}\n", plan.width, plan.height);
        for triangle in values.chunks_exact(3 * VERTEX) {
            text.push('T');
            for value in triangle {
                // Writing into a String does not fail.
                let _ = write!(text, " {value}");
            }
            text.push('\n');
        }
        let name = "triangles".to_owned();
        let before = 1 + header.split('\n').count();
        let frame = parse(&name, text.as_bytes()).map_err(|error| in_array(error, before))?;
        (name, plan, frame)
    };
    let frame = fitting(&name, frame, &plan).map_err(|error| raised(&error))?;
    Ok((plan, frame))
}
