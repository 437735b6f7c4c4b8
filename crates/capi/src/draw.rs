//! A frame as a picture.

use crate::code::{EdgewalkCode, Failure, guarded};
use crate::frame::EdgewalkFrame;
use crate::pointer::{exclusive, shared};
use edgewalk_host::draw::{Drawn, draw_frame};
use edgewalk_model::Waits;
use std::slice;

/// Draws a frame with a memory that never makes the machine wait. Arrays have an element for each pixel, line by line
/// from the top: `z` the stored depth in LSB; `rgb` three stored colours in LSB; `id` the place in the frame of the
/// triangle that was written last, or -1. `pixels` is width times height. `cycles` is what the machine needs. What is
/// not wanted may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_draw(
    frame: *const EdgewalkFrame,
    z: *mut u32,
    rgb: *mut u32,
    id: *mut i32,
    pixels: usize,
    cycles: *mut u64,
) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *object*.
        let frame = unsafe { shared("frame", frame) }?;
        let (width, height) = (frame.plan.width, frame.plan.height);
        let needed = width as usize * height as usize;
        if pixels != needed {
            let found = format!("pixels: {pixels}; permitted: {needed}, for a screen of {width}x{height}");
            return Err(Failure(EdgewalkCode::Argument, found));
        }
        let port = frame.at_port()?;
        let drawn = draw_frame(&frame.plan, &port, Waits::Never)
            .map_err(|error| Failure::of(EdgewalkCode::Frame, error))?;
        let picture = match drawn {
            Drawn::Fast(renderer) => renderer.frame(),
            Drawn::Ticked(picture, ..) => picture,
        };
        // Of what was drawn by a part of a primitive the whole's place; a pixel that nothing wrote has -1.
        let place = |id: i32| usize::try_from(id).map_or(id, |drawn| port.ids[drawn]);
        // Stored words have at most 32 bits.
        // SAFETY: the caller's *arrays*: one element for each pixel, of colours three.
        unsafe {
            fill(z, pixels, picture.z.iter().map(|depth| *depth as u32));
            fill(rgb, 3 * pixels, picture.rgb.as_flattened().iter().map(|color| *color as u32));
            fill(id, pixels, picture.id.iter().map(|id| place(*id)));
        }
        // SAFETY: the caller's *object*, to be written.
        if let Ok(to) = unsafe { exclusive("cycles", cycles) } {
            *to = picture.counters.cycles;
        }
        Ok(())
    })
}

/// Fills an array of the caller's; nothing where it is NULL.
///
/// # Safety
/// It is NULL, or has so many elements, which nothing else reads or changes meanwhile.
unsafe fn fill<T: Copy>(to: *mut T, length: usize, values: impl Iterator<Item = T>) {
    if !to.is_null() {
        // SAFETY: it is not NULL; the rest as asked for above.
        unsafe { slice::from_raw_parts_mut(to, length) }
            .iter_mut()
            .zip(values)
            .for_each(|(to, value)| *to = value);
    }
}
