//! What is to be drawn: a built-in scene, a mesh, or a file of screen-space triangles; and its way to the port.

use anyhow::{Context, Result, anyhow};
use edgewalk_model::DrawState;
use edgewalk_numerics::{Machine, PortVertex};
use edgewalk_scene::{DepthFunc, Frame, Scene, ShadeMode, Triangle, triangle_file};
use std::path::Path;

/// A frame as the machine's port takes it.
pub struct PortFrame {
    /// Triangles in drawing order.
    pub triangles: Vec<[PortVertex; 3]>,
    /// Depth function, write mask and clear values.
    pub state: DrawState,
}

/// Snaps a frame to the port, or says which triangle the machine cannot take.
pub fn to_port(frame: &Frame, machine: &Machine) -> Result<PortFrame> {
    let state = draw_state(frame, machine)?;
    let triangles = frame.triangles.iter().enumerate();
    let triangles = triangles.map(|(index, triangle)| port_triangle(index, triangle, frame.mode, machine));
    Ok(PortFrame { triangles: triangles.collect::<Result<_>>()?, state })
}

/// What stays the same over a frame, or what of it the machine cannot draw.
pub fn draw_state(frame: &Frame, machine: &Machine) -> Result<DrawState> {
    if frame.blend {
        return Err(anyhow!(
            "blend 1: the machine has no blend unit yet; draw with blend 0 or --engine golden"
        ));
    }
    if frame.shadow.is_some() {
        return Err(anyhow!(
            "shadow: the machine has no shadow maps yet; draw without the line `shadow` or with --engine golden"
        ));
    }
    if !frame.polygons.is_empty() {
        return Err(anyhow!("P: the machine draws triangles; draw polygons with --engine golden"));
    }
    let max = machine.color.max() as f64;
    Ok(DrawState {
        depth_func: frame.depth.unwrap_or(DepthFunc::Always) as u8,
        depth_write: frame.depth_write && frame.depth.is_some(),
        clear: frame.clear.map(|v| (v * max).round_ties_even() as u64),
    })
}

/// Snaps triangle number `index` to the port, or says that the machine cannot take it.
pub fn port_triangle(
    index: usize,
    triangle: &Triangle,
    mode: ShadeMode,
    machine: &Machine,
) -> Result<[PortVertex; 3]> {
    let mut port = [PortVertex::default(); 3];
    for (corner, (slot, v)) in port.iter_mut().zip(&triangle.0).enumerate() {
        let color = if mode == ShadeMode::Flat { &triangle.0[0] } else { v };
        *slot = machine
            .port_vertex(v.x, v.y, [v.z, color.r, color.g, color.b])
            .with_context(|| format!("triangle {index}, vertex {corner}"))?;
    }
    Ok(port)
}

/// A scene, a mesh, or a file of screen-space triangles.
#[derive(clap::Args, Clone, Debug)]
pub struct Source {
    /// A built-in scene, a mesh (.obj, .gltf, .glb) or a triangle file (.tri)
    #[arg(value_name = "SCENE|MESH", default_value = "torus-knot")]
    pub input: String,
    /// One colour a polygon, or linear between its vertices
    #[arg(long, value_enum, default_value_t = Shading::Gouraud)]
    shading: Shading,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Shading {
    Constant,
    Gouraud,
}

impl Source {
    /// The frame on this machine's screen; meshes are clipped to its guard band. A triangle file keeps its own size and mode.
    pub fn frame(&self, machine: &Machine) -> Result<Frame> {
        if Path::new(&self.input).extension().is_some_and(|e| e == "tri") {
            let frame = triangle_file::read(Path::new(&self.input))?;
            if (frame.width, frame.height) != (machine.width, machine.height) {
                return Err(anyhow!(
                    "{}: size {} {}: the machine's screen is {}x{}; add --set screen.width={} --set screen.height={}",
                    self.input,
                    frame.width,
                    frame.height,
                    machine.width,
                    machine.height,
                    frame.width,
                    frame.height
                ));
            }
            return Ok(frame);
        }
        let mode = match self.shading {
            Shading::Constant => ShadeMode::Flat,
            Shading::Gouraud => ShadeMode::Gouraud,
        };
        let guard = f64::from((1u32 << machine.guard_bits) - 1);
        Ok(Scene::open(&self.input)?.frame(machine.width, machine.height, guard, mode))
    }
}
