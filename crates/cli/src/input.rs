//! What is to be drawn: a built-in scene, a mesh, or a file of screen-space triangles; and its way to the port.

use crate::extra;
use crate::machine_args::MachineArgs;
use anyhow::{Context as _, Result, anyhow};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::DrawState;
use edgewalk_scene::{DepthFunc, Frame, Scene, ShadeMode, Surface, Triangle, Triangulated, triangle_file};
use std::path::Path;

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
        let (scene, surface) = self.surface(machine)?;
        self.frame_of(&scene, &surface, machine)
    }

    /// The same of a scene and its surface on the machine's screen.
    pub fn frame_of(&self, scene: &Scene, surface: &Surface, machine: &Plan) -> Result<Frame> {
        let refused = match self.shading {
            Shading::Phong => Some("phong: the machine has no unit for normals yet"),
            Shading::FastPhong => Some("fast-phong: the machine has no unit for normals yet"),
            Shading::Wireframe => Some("wireframe: the machine draws no lines"),
            Shading::Constant | Shading::ConstantAveraged | Shading::Gouraud => None,
        };
        if let Some(why) = refused {
            return Err(anyhow!("--shading {why}; render with --engine golden"));
        }
        in_triangles(edgewalk_golden::frame(scene, surface, self.shading.golden()), machine)
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
    let triangles = frame.triangulated(machine.subpixel_bits)?.triangles.into_owned();
    Ok(Frame { triangles, polygons: Vec::new(), ..frame })
}
