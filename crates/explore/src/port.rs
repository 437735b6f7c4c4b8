//! A frame's way to the machine's port.

use anyhow::{Context as _, Result, anyhow};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::DrawState;
use edgewalk_scene::{DepthFunc, Frame, ShadeMode, Triangle, Triangulated};

/// A frame as the machine's port takes it.
pub struct PortFrame {
    /// Triangles in drawing order.
    pub triangles: Vec<[PortVertex; 3]>,
    /// For each of them the place of what it is a part of among the frame's triangles and polygons.
    pub ids: Vec<i32>,
    /// Depth function, write mask and clear values.
    pub state: DrawState,
}

/// Snaps a frame to the port, polygons as triangles, or says what of it the machine cannot take.
pub fn to_port(frame: &Frame, machine: &Plan) -> Result<PortFrame> {
    let state = draw_state(frame, machine)?;
    let Triangulated { triangles, ids } = frame.triangulated(machine.subpixel_bits)?;
    let triangles = triangles.iter().zip(&ids);
    let triangles =
        triangles.map(|(triangle, id)| port_triangle(*id as usize, triangle, frame.mode, machine));
    Ok(PortFrame { triangles: triangles.collect::<Result<_>>()?, ids, state })
}

/// What stays the same over a frame, or what of it the machine cannot draw.
pub fn draw_state(frame: &Frame, machine: &Plan) -> Result<DrawState> {
    if frame.blend {
        return Err(anyhow!(
            "blend 1 (transparent surfaces): the machine has no blend unit yet; draw with blend 0 or --engine golden"
        ));
    }
    if frame.shadow.is_some() {
        return Err(anyhow!(
            "shadow: the machine has no shadow maps yet; draw without the line `shadow` or with --engine golden"
        ));
    }
    let max = machine.color.max() as f64;
    Ok(DrawState {
        depth_func: frame.depth.unwrap_or(DepthFunc::Always) as u8,
        depth_write: frame.depth_write && frame.depth.is_some(),
        clear: frame.clear.map(|v| (v * max).round_ties_even() as u64),
        ..DrawState::default()
    })
}

/// Snaps triangle number `index` to the port, or says that the machine cannot take it.
pub fn port_triangle(
    index: usize,
    triangle: &Triangle,
    mode: ShadeMode,
    machine: &Plan,
) -> Result<[PortVertex; 3]> {
    let mut port = [PortVertex::default(); 3];
    for (corner, (slot, v)) in port.iter_mut().zip(&triangle.0).enumerate() {
        let v = if mode == ShadeMode::Flat { v.colored_as(&triangle.0[0]) } else { *v };
        let [e0, e1, e2, e3] = v.extra;
        let values = [v.z, v.r, v.g, v.b, e0, e1, e2, e3];
        *slot = machine
            .port_vertex(v.x, v.y, &values[..machine.channels().len()])
            .with_context(|| format!("triangle {index}, vertex {corner}"))?;
    }
    Ok(port)
}
