//! Vertices snapped to the machine's port.

use crate::advice::OR_GOLDEN;
use crate::light;
use anyhow::{Context as _, Error, Result, anyhow};
use edgewalk_machine::{Plan, PortVertex, VertexError};
use edgewalk_scene::{Blending, Frame, ShadeMode, State, Triangle};

/// Half a side of the machine's guard band, pixels.
#[must_use]
pub fn guard_band(machine: &Plan) -> f64 {
    f64::from((1u32 << machine.guard_bits) - 1)
}

/// What messages call the primitive of this kind at a place, or its corner. Places count as in `id.npy`, corners as in a triangle file.
pub(crate) fn named(kind: &str, place: usize, corner: Option<(&str, usize)>) -> String {
    let of = format!("{kind} {place} (counted from 0)");
    match corner {
        Some((corner, number)) => format!("{of}, {corner} {} (from 1)", number + 1),
        None => of,
    }
}

/// Snaps triangle number `index`, drawn by these rules, to the port, or says that the machine cannot take it.
pub fn port_triangle(
    index: usize,
    triangle: &Triangle,
    frame: &Frame,
    state: &State,
    machine: &Plan,
) -> Result<[PortVertex; 3]> {
    let name = |corner: Option<usize>| named("triangle", index, corner.map(|corner| ("vertex", corner)));
    Ok(machine.windowed(port_vertices(index, triangle, frame, state, machine, &name)?))
}

/// Snaps the vertices of the primitive at place `index` to the port; `name`: what errors call it, or one of its corners.
pub(crate) fn port_vertices(
    index: usize,
    triangle: &Triangle,
    frame: &Frame,
    state: &State,
    machine: &Plan,
    name: &dyn Fn(Option<usize>) -> String,
) -> Result<[PortVertex; 3]> {
    let (mixes, mode) = (state.blend == Blending::Mix, frame.mode);
    let mut port = [PortVertex::default(); 3];
    let light =
        light::values(frame.shadow(state.light), index, &triangle.0, machine).with_context(|| name(None))?;
    for (corner, (slot, v)) in port.iter_mut().zip(&triangle.0).enumerate() {
        let v = if mode == ShadeMode::Flat { v.colored_as(&triangle.0[0]) } else { *v };
        let here = || name(Some(corner));
        let mut values = vec![v.z, v.r, v.g, v.b];
        values.extend_from_slice(&v.extra[..machine.extra as usize]);
        if machine.shadow.is_there() {
            values.extend_from_slice(&light[corner]);
        }
        if machine.blend.is_there() || machine.has_triangle_kt() {
            values.push(if mixes { v.kt } else { 0.0 });
        }
        if mixes && machine.has_triangle_kt() && mode == ShadeMode::Gouraud && v.kt != triangle.0[0].kt {
            return Err(anyhow!(
                "kt = {} after {}: blend.kind = constant, as dither.screen_door = yes, has one for a triangle; add --set blend.kind=interpolated, or draw with mode flat",
                v.kt,
                triangle.0[0].kt
            ))
            .with_context(here);
        }
        *slot = machine.port_vertex(v.x, v.y, &values).map_err(|e| under(e, state)).with_context(here)?;
    }
    Ok(port)
}

/// An error of a vertex, with the light that it is of.
fn under(error: VertexError, state: &State) -> Error {
    match error {
        VertexError::Channel { channel: "lx" | "ly" | "lz", .. } => anyhow!(
            "{error} under light {}; give its `shadow` line a larger SIZE or other numbers{OR_GOLDEN}",
            state.light
        ),
        error => error.into(),
    }
}
