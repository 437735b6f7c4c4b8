//! What is to be drawn: a built-in scene, a mesh, or a file of screen-space triangles; and its way to the port.

use crate::extra;
use crate::machine_args::MachineArgs;
use anyhow::{Context as _, Result, anyhow};
use edgewalk_golden::Order;
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::{DrawState, Pass};
use edgewalk_scene::{
    Blending, Change, DepthFunc, Frame, Scene, ShadeMode, State, Surface, Triangle, Triangulated,
    triangle_file,
};
use std::path::Path;

/// A frame as the machine's port takes it.
pub struct PortFrame {
    /// Triangles in drawing order.
    pub triangles: Vec<[PortVertex; 3]>,
    /// For each of them the place of what it is a part of among the frame's triangles and polygons.
    pub ids: Vec<i32>,
    /// The rules, and how many triangles are drawn by each, in order; at least one.
    pub passes: Vec<Pass>,
}

impl PortFrame {
    /// The rules of a frame in which they do not change.
    ///
    /// # Errors
    /// They do.
    pub fn state(&self) -> Result<DrawState> {
        match &self.passes[..] {
            [pass] => Ok(pass.state),
            passes => Err(anyhow!(
                "{} passes: the rules change between triangles; permitted for raster, render and explain",
                passes.len()
            )),
        }
    }
}

/// Snaps a frame to the port, polygons as triangles, or says what of it the machine cannot take.
pub fn to_port(frame: &Frame, machine: &Plan) -> Result<PortFrame> {
    let Triangulated { triangles, ids } = frame.triangulated(machine.subpixel_bits)?;
    let (mut port, mut passes) = (Vec::with_capacity(triangles.len()), Vec::new());
    for pass in frame.passes() {
        let parts = ids.iter().take_while(|id| (**id as usize) < pass.primitives.end).count();
        for (triangle, id) in triangles[port.len()..parts].iter().zip(&ids[port.len()..parts]) {
            port.push(port_triangle(*id as usize, triangle, frame.mode, pass.state.blend, machine)?);
        }
        passes.push(Pass {
            triangles: parts - passes.iter().map(|pass: &Pass| pass.triangles).sum::<usize>(),
            state: draw_state(frame, &pass.state, machine)?,
            clear_depth: pass.clear_depth,
        });
    }
    Ok(PortFrame { triangles: port, ids, passes })
}

/// The rules of a pass as the machine has them, or what of them it cannot do.
pub fn draw_state(frame: &Frame, state: &State, machine: &Plan) -> Result<DrawState> {
    let blends = machine.blend.is_there();
    if state.blend != Blending::Off && !blends {
        return Err(anyhow!(
            "blend {} (transparent surfaces): the machine has no BLEND; add --set blend.kind=interpolated, or draw with blend 0 or --engine golden",
            state.blend.name()
        ));
    }
    if !state.color_write && !blends {
        return Err(anyhow!(
            "colour_write 0: a machine without BLEND writes the colour of every fragment that passes; add --set blend.kind=constant"
        ));
    }
    if frame.shadow.is_some() {
        return Err(anyhow!(
            "shadow: the machine has no shadow maps yet; draw without the line `shadow` or with --engine golden"
        ));
    }
    let max = machine.color.max() as f64;
    Ok(DrawState {
        depth_func: state.depth.unwrap_or(DepthFunc::Always) as u8,
        depth_write: state.stores_depth(),
        color_write: state.color_write,
        blend_add: state.blend == Blending::Add,
        shadow_on: false,
        ambient: 0,
        clear: frame.clear.map(|v| (v * max).round_ties_even() as u64),
    })
}

/// Snaps triangle number `index` to the port, or says that the machine cannot take it.
pub fn port_triangle(
    index: usize,
    triangle: &Triangle,
    mode: ShadeMode,
    blend: Blending,
    machine: &Plan,
) -> Result<[PortVertex; 3]> {
    let mixes = blend == Blending::Mix;
    let mut port = [PortVertex::default(); 3];
    for (corner, (slot, v)) in port.iter_mut().zip(&triangle.0).enumerate() {
        let v = if mode == ShadeMode::Flat { v.colored_as(&triangle.0[0]) } else { *v };
        let named = || format!("triangle {index}, vertex {corner}");
        let mut values = vec![v.z, v.r, v.g, v.b];
        values.extend_from_slice(&v.extra[..machine.extra as usize]);
        if machine.shadow.is_there() {
            values.extend([0.0; 3]); // no map is looked up
        }
        if machine.blend.is_there() {
            values.push(if mixes { v.kt } else { 0.0 });
        }
        if mixes && machine.has_triangle_kt() && mode == ShadeMode::Gouraud && v.kt != triangle.0[0].kt {
            return Err(anyhow!(
                "kt = {} after {}: blend.kind = constant has one for a triangle; add --set blend.kind=interpolated, or draw with mode flat",
                v.kt,
                triangle.0[0].kt
            ))
            .with_context(named);
        }
        *slot = machine.port_vertex(v.x, v.y, &values).with_context(named)?;
    }
    Ok(port)
}

/// A scene, a mesh, or a file of screen-space triangles.
#[derive(clap::Args, Clone, Debug)]
pub struct Source {
    /// A built-in scene, a scene file (.toml), a mesh (.obj, .gltf, .glb) or a triangle file (.tri)
    #[arg(value_name = "SCENE|MESH", default_value = "torus-knot")]
    pub input: String,
    /// How the colour of a pixel is come by; phong, fast-phong and wireframe need --engine golden
    #[arg(long, value_enum, default_value_t = Shading::Gouraud)]
    pub shading: Shading,
}

/// A shading system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Shading {
    /// One colour a polygon, by its own normal
    Constant,
    /// One colour a polygon, by the average of its vertex normals
    ConstantAveraged,
    /// Colours of the vertices, linear over the screen
    Gouraud,
    /// Normals of the vertices, linear over the screen; the shading equation at each pixel
    Phong,
    /// Phong by a quadratic for each cosine: five additions and a table read a pixel
    FastPhong,
    /// Edges alone, in the colours of the vertices
    Wireframe,
}

impl Shading {
    /// The same for the golden picture; for fast Phong the system that it approximates.
    pub fn golden(self) -> edgewalk_golden::Shading {
        match self {
            Self::Constant => edgewalk_golden::Shading::Constant,
            Self::ConstantAveraged => edgewalk_golden::Shading::ConstantAveraged,
            // Lines run between the colours of the vertices.
            Self::Gouraud | Self::Wireframe => edgewalk_golden::Shading::Gouraud,
            Self::Phong | Self::FastPhong => edgewalk_golden::Shading::Phong,
        }
    }
}

impl Source {
    /// Whether the input is a triangle file, which has no surface to shade.
    pub fn is_triangle_file(&self) -> bool {
        Path::new(&self.input).extension().is_some_and(|e| e == "tri")
    }

    /// The scene, and its surface on this machine's screen, clipped to its guard band.
    ///
    /// # Errors
    /// The machine has channels of the user's own: a scene has no values for them.
    pub fn surface(&self, machine: &Plan) -> Result<(Scene, Surface)> {
        extra::fitting(0, machine).with_context(|| self.input.clone())?;
        let scene = Scene::open(&self.input)?;
        let guard = f64::from((1u32 << machine.guard_bits) - 1);
        let surface = scene.surface(machine.width, machine.height, guard);
        Ok((scene, surface))
    }

    /// The frame, and the machine with the screen of the triangle file, if it is one.
    pub fn on_its_screen(&self, args: &MachineArgs) -> Result<(Plan, Frame)> {
        if !self.is_triangle_file() {
            let machine = args.machine(None)?;
            let frame = self.frame(&machine)?;
            return Ok((machine, frame));
        }
        let frame = triangle_file::read(Path::new(&self.input))?;
        let machine = args.machine(Some((frame.width, frame.height)))?;
        let frame = in_triangles(self.fitting(frame, &machine)?, &machine)?;
        Ok((machine, frame))
    }

    /// The frame as the machine draws it. A triangle file keeps its own size and mode; its polygons become triangles, so
    /// that machine and golden picture interpolate the same.
    pub fn frame(&self, machine: &Plan) -> Result<Frame> {
        if self.is_triangle_file() {
            return in_triangles(self.outlined(machine)?, machine);
        }
        Ok(self.sorted(machine)?.0)
    }

    /// The same, and of a scene with something transparent the order in which its triangles are drawn.
    pub fn sorted(&self, machine: &Plan) -> Result<(Frame, Option<Order>)> {
        if self.is_triangle_file() {
            return Ok((self.frame(machine)?, None));
        }
        let (scene, surface) = self.surface(machine)?;
        self.frame_of(&scene, &surface, machine)
    }

    /// The same of a scene and its surface on the machine's screen.
    pub fn frame_of(
        &self,
        scene: &Scene,
        surface: &Surface,
        machine: &Plan,
    ) -> Result<(Frame, Option<Order>)> {
        let refused = match self.shading {
            Shading::Phong => Some("phong: the machine has no unit for normals yet"),
            Shading::FastPhong => Some("fast-phong: the machine has no unit for normals yet"),
            Shading::Wireframe => Some("wireframe: the machine draws no lines"),
            Shading::Constant | Shading::ConstantAveraged | Shading::Gouraud => None,
        };
        if let Some(why) = refused {
            return Err(anyhow!("--shading {why}; render with --engine golden"));
        }
        let frame = in_triangles(edgewalk_golden::frame(scene, surface, self.shading.golden()), machine)?;
        if frame.blend == Blending::Off {
            return Ok((frame, None));
        }
        let (frame, order) = edgewalk_golden::sorted(frame, machine.subpixel_bits);
        Ok((frame, Some(order)))
    }

    /// The frame with the polygons it has.
    pub fn outlined(&self, machine: &Plan) -> Result<Frame> {
        if !self.is_triangle_file() {
            let (scene, surface) = self.surface(machine)?;
            return Ok(edgewalk_golden::frame(&scene, &surface, self.shading.golden()));
        }
        self.fitting(triangle_file::read(Path::new(&self.input))?, machine)
    }

    /// The triangle file's frame, if it is as large as the machine's screen.
    fn fitting(&self, frame: Frame, machine: &Plan) -> Result<Frame> {
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
        extra::fitting(frame.extra, machine).with_context(|| self.input.clone())?;
        Ok(frame)
    }
}

/// The frame with its polygons as triangles.
fn in_triangles(frame: Frame, machine: &Plan) -> Result<Frame> {
    let Triangulated { triangles, ids } = frame.triangulated(machine.subpixel_bits)?;
    // So many triangles are made of the primitives before each change.
    let before = |change: &Change| ids.iter().take_while(|id| (**id as usize) < change.after).count();
    let changes = frame.changes.iter().map(|change| Change { after: before(change), ..*change }).collect();
    let triangles = triangles.into_owned();
    Ok(Frame { triangles, changes, polygons: Vec::new(), ..frame })
}
