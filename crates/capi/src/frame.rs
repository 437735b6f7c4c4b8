//! What is to be drawn.

use crate::code::{EdgewalkCode, Failure, guarded};
use crate::machine::EdgewalkMachine;
use crate::pointer::{exclusive, free, give, shared, text};
use edgewalk_host::input::fitting;
use edgewalk_host::port::{PortFrame, to_port};
use edgewalk_machine::Plan;
use edgewalk_scene::triangle_file::parse;
use std::ffi::c_char;
use std::fmt::Write as _;

/// Numbers of a triangle.
const TRIANGLE: usize = 3 * 7;

/// Triangles and rules for a machine, as the lines of a triangle file.
pub struct EdgewalkFrame {
    pub plan: Plan,
    text: String,
}

impl EdgewalkFrame {
    /// The frame at the machine's port. Values are checked by the reader of triangle files, so that there is one place
    /// for limits and their messages.
    pub fn at_port(&self) -> Result<PortFrame, Failure> {
        const NAME: &str = "frame";
        let read = || {
            let frame = fitting(NAME, parse(NAME, self.text.as_bytes())?, &self.plan)?;
            to_port(&frame, &self.plan)
        };
        read().map_err(|error: anyhow::Error| Failure::of(EdgewalkCode::Frame, error))
    }
}

/// An empty frame on the machine's screen.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_frame_new(
    machine: *const EdgewalkMachine,
    frame: *mut *mut EdgewalkFrame,
) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *object*.
        let plan = unsafe { shared("machine", machine) }?.0.clone();
        let text = format!("size {} {}\n", plan.width, plan.height);
        // SAFETY: the caller's *object*, to be written.
        unsafe { give("frame", frame, EdgewalkFrame { plan, text }) }
    })
}

/// Appends lines of a triangle file (docs/triangle_file.md), such as "depth lequal": rules, triangles, lines, polygons.
/// The file's first line, size, is there already. Mistakes are found when the frame is drawn.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_frame_lines(
    frame: *mut EdgewalkFrame,
    lines: *const c_char,
) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *object* and *text*.
        let (frame, lines) = unsafe { (exclusive("frame", frame)?, text("lines", lines)?) };
        frame.text.push_str(lines);
        frame.text.push('\n');
        Ok(())
    })
}

/// Appends a triangle: of each vertex x and y in pixels, y down; z, r, g, b and k_t, its transparency, in 0 to 1. These
/// are 21 numbers. Mistakes are found when the frame is drawn.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_frame_triangle(
    frame: *mut EdgewalkFrame,
    vertices: *const f64,
) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *object*, and his *array* of 21 numbers, which has no other alignment than they.
        let (frame, vertices) =
            unsafe { (exclusive("frame", frame)?, shared("vertices", vertices.cast::<[f64; TRIANGLE]>())?) };
        frame.text.push('T');
        // Writing to a string cannot fail.
        vertices.iter().for_each(|value| _ = write!(frame.text, " {value}"));
        frame.text.push('\n');
        Ok(())
    })
}

/// Frees a frame; NULL is permitted. Runs of the frame are not touched.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_frame_free(frame: *mut EdgewalkFrame) {
    // SAFETY: the caller's *object*, which he uses no more.
    unsafe { free(frame) }
}
