//! What is to be drawn: a built-in scene, a mesh, or a file of screen-space triangles; and its way to the port.

use crate::machine_args::MachineArgs;
use crate::progress::reading;
use anyhow::{Context as _, Result, anyhow};
use clap::ValueEnum as _;
use edgewalk_golden::{HiddenLines, Order, wireframe_in_lines};
use edgewalk_host::extra;
use edgewalk_host::faces::joined;
use edgewalk_host::input::{as_large, fitting, in_triangles};
use edgewalk_host::needs::{maps as of_maps, needs};
pub use edgewalk_host::port::{PortFrame, draw_state, to_port};
use edgewalk_host::raster::golden_fill;
use edgewalk_host::vertices::guard_band;
pub use edgewalk_host::vertices::port_triangle;
use edgewalk_machine::Plan;
use edgewalk_scene::{Blending, Frame, InputKind, PixelMethod, Scene, ShadeMode, Surface, triangle_file};
use std::path::Path;
use std::sync::OnceLock;

/// A scene, a mesh, or a file of screen-space triangles.
#[derive(clap::Args, Clone, Debug)]
pub struct Source {
    /// A built-in scene, a scene file (.toml), a mesh (.obj, .gltf, .glb), a triangle file (.tri), or - for triangles from the
    /// standard input
    #[arg(value_name = "SCENE|MESH", default_value = "torus-knot")]
    pub input: String,
    /// Shading method: constant, constant-averaged, gouraud, phong, fast-phong, wireframe (docs/shading.md); gouraud if left out.
    ///
    /// phong and fast-phong need a machine with that shade.kind, or --engine golden; wireframe one with polygon.lines = yes, or
    /// --engine golden. A triangle file has a mode of its own: wireframe is the only other way to draw it.
    #[arg(long, value_enum, hide_possible_values = true)]
    pub shading: Option<Shading>,
    /// Set the keys of the machine that the input asks for, as channels.extra, blend.kind, shadow.size or
    /// shade.kind; --set has the last word
    #[arg(long)]
    pub adapt: bool,
    /// What was read of a triangle file: a pipe can be read only once.
    #[arg(skip)]
    read: OnceLock<Frame>,
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
    /// The shading of the golden picture; for fast Phong the system that it approximates.
    pub fn golden(self) -> edgewalk_golden::Shading {
        match self {
            Self::Constant => edgewalk_golden::Shading::Constant,
            Self::ConstantAveraged => edgewalk_golden::Shading::ConstantAveraged,
            // Lines run between the colours of the vertices.
            Self::Gouraud | Self::Wireframe => edgewalk_golden::Shading::Gouraud,
            Self::Phong | Self::FastPhong => edgewalk_golden::Shading::Phong,
        }
    }

    /// The name on the command line.
    pub fn name(self) -> String {
        // No value is hidden from the command line.
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// The way in which a triangle file says itself that it is drawn.
    fn of(frame: &Frame) -> Self {
        match (&frame.shading, frame.mode) {
            (Some(shading), _) if shading.method == PixelMethod::Phong => Self::Phong,
            (Some(_), _) => Self::FastPhong,
            (None, ShadeMode::Flat) => Self::Constant,
            (None, ShadeMode::Gouraud) => Self::Gouraud,
        }
    }

    /// Method of the cosines, where the equation holds at each pixel.
    fn at_pixels(self) -> Option<PixelMethod> {
        match self {
            Self::Phong => Some(PixelMethod::Phong),
            Self::FastPhong => Some(PixelMethod::FastPhong),
            Self::Constant | Self::ConstantAveraged | Self::Gouraud | Self::Wireframe => None,
        }
    }
}

impl Source {
    /// The input of that name, its colours made at the corners.
    pub fn new(input: &str, adapt: bool) -> Self {
        Self { input: input.to_owned(), shading: None, adapt, read: OnceLock::new() }
    }

    /// The words of a command line that ask for the same input; the input itself comes last.
    pub fn words(&self) -> Vec<String> {
        let shading = self.shading.filter(|shading| *shading != Shading::Gouraud);
        let shading = shading.map(|shading| ["--shading".to_owned(), shading.name()]);
        // A name that begins with a hyphen would be read as an option.
        let named = self.input.starts_with('-') && self.input != InputKind::STANDARD_INPUT;
        let here = if named { "./" } else { "" };
        let adapt = self.adapt.then(|| "--adapt".to_owned());
        shading.into_iter().flatten().chain(adapt).chain([format!("{here}{}", self.input)]).collect()
    }

    /// The shading method asked for.
    pub fn shading(&self) -> Shading {
        self.shading.unwrap_or(Shading::Gouraud)
    }

    /// A frame of the input as the machine's port takes it; errors name the input.
    pub fn to_port(&self, frame: &Frame, machine: &Plan) -> Result<PortFrame> {
        to_port(frame, machine).with_context(|| self.input.clone())
    }

    /// Whether the input is a triangle file, which has no surface to shade.
    pub fn is_triangle_file(&self) -> bool {
        InputKind::is_triangles(&self.input)
    }

    /// The triangle file, if it is one.
    fn triangles(&self) -> Result<Option<&Frame>> {
        if !self.is_triangle_file() {
            return Ok(None);
        }
        if self.read.get().is_none() {
            let _reading = reading();
            let frame = triangle_file::read(Path::new(&self.input))?;
            self.check_shading(&frame)?;
            // Nobody else has set it: commands read on one thread.
            _ = self.read.set(frame);
        }
        Ok(self.read.get())
    }

    /// Accepts a shading method in which a triangle file can be drawn: its own, or wireframe.
    ///
    /// # Errors
    /// The method is another; the error names both, and those permitted.
    fn check_shading(&self, frame: &Frame) -> Result<()> {
        let own = Shading::of(frame);
        let Some(other) = self.shading.filter(|shading| ![own, Shading::Wireframe].contains(shading)) else {
            return Ok(());
        };
        let mode = frame.shading.as_ref().map_or(frame.mode.name(), |shading| shading.method.name());
        Err(anyhow!(
            "--shading {}: the mode of {} is {mode}; permitted: {} or wireframe; leave --shading out",
            other.name(),
            self.input,
            own.name()
        ))
    }

    /// The screen that it brings, pixels; scenes are drawn on any.
    pub fn screen(&self) -> Result<Option<(u32, u32)>> {
        Ok(self.triangles()?.map(|frame| (frame.width, frame.height)))
    }

    /// The machine asked for, with the screen of a triangle file, and with --adapt with all keys that the input asks for.
    pub fn machine(&self, args: &MachineArgs) -> Result<Plan> {
        self.machine_with_maps(args, false)
    }

    /// Likewise; `maps`: each light of a scene has a map.
    pub fn machine_with_maps(&self, args: &MachineArgs, maps: bool) -> Result<Plan> {
        let screen = self.screen()?;
        if !self.adapt {
            return args.machine(screen);
        }
        if let Some(frame) = self.triangles()? {
            return args.adapted(screen, |machine: &Plan| {
                Ok(match self.shading() {
                    Shading::Wireframe => needs(&lines_of(frame, machine, HiddenLines::Removed), machine),
                    _ => needs(frame, machine),
                })
            });
        }
        let mut drawn = None;
        args.adapted(screen, |machine: &Plan| {
            let frame = match drawn.take() {
                Some(frame) => frame,
                None => {
                    let _reading = reading();
                    let scene = Scene::open(&self.input)?;
                    let surface = scene.surface(machine.width, machine.height, guard_band(machine));
                    self.frame_of(&scene, &surface, machine)?.0
                }
            };
            let frame = drawn.insert(frame);
            let mut all = needs(frame, machine);
            if maps {
                let more: Vec<_> = of_maps(frame, machine)
                    .into_iter()
                    .filter(|of| all.iter().all(|need| need.key != of.key))
                    .collect();
                all.extend(more);
            }
            Ok(all)
        })
    }

    /// The scene, and its surface on this machine's screen, clipped to its guard band.
    ///
    /// # Errors
    /// The machine has channels of the user's own: a scene has no values for them.
    pub fn surface(&self, machine: &Plan) -> Result<(Scene, Surface)> {
        extra::none(machine).with_context(|| self.input.clone())?;
        let _reading = reading();
        let scene = Scene::open(&self.input)?;
        let surface = scene.surface(machine.width, machine.height, guard_band(machine));
        Ok((scene, surface))
    }

    /// The machine of [`Source::machine`], and the frame.
    pub fn on_its_screen(&self, args: &MachineArgs) -> Result<(Plan, Frame)> {
        let machine = self.machine(args)?;
        let frame = self.frame(&machine)?;
        Ok((machine, frame))
    }

    /// The frame as the machine draws it. A triangle file keeps its own size and mode; its polygons become triangles, so
    /// that machine and golden picture interpolate the same.
    pub fn frame(&self, machine: &Plan) -> Result<Frame> {
        match (self.is_triangle_file(), self.shading()) {
            (true, Shading::Wireframe) => self.wireframe(machine, HiddenLines::Removed),
            (true, _) => in_triangles(self.outlined(machine)?, machine),
            (false, _) => Ok(self.sorted(machine)?.0),
        }
    }

    /// Like `frame`, of the first triangles, polygons and lines of the input, at most so many. A scene's triangles are counted as
    /// they are drawn.
    pub fn first(&self, machine: &Plan, most: usize) -> Result<Frame> {
        in_triangles(self.whole(machine)?.first(most), machine)
    }

    /// The frame as `raster` draws it: like `frame`, but a triangle file has its polygons, and nothing is cut at the guard band.
    pub fn whole(&self, machine: &Plan) -> Result<Frame> {
        match (self.is_triangle_file(), self.shading()) {
            (true, Shading::Wireframe) | (false, _) => self.frame(machine),
            (true, _) => self.outlined(machine),
        }
    }

    /// Like `frame`, and of a scene with something transparent the order in which its triangles are drawn.
    pub fn sorted(&self, machine: &Plan) -> Result<(Frame, Option<Order>)> {
        if self.is_triangle_file() {
            return Ok((self.frame(machine)?, None));
        }
        let (scene, surface) = self.surface(machine)?;
        self.frame_of(&scene, &surface, machine)
    }

    /// Like `sorted`, of a scene and its surface on the machine's screen.
    pub fn frame_of(
        &self,
        scene: &Scene,
        surface: &Surface,
        machine: &Plan,
    ) -> Result<(Frame, Option<Order>)> {
        let shading = self.shading();
        if shading == Shading::Wireframe {
            let frame = edgewalk_golden::frame(scene, surface, shading.golden());
            return Ok((in_lines(&frame, machine, HiddenLines::Removed)?, None));
        }
        let frame = match shading.at_pixels() {
            Some(method) => scene.pixel_frame(surface, method),
            None => {
                let frame = edgewalk_golden::frame(scene, surface, shading.golden());
                joined(frame, scene, surface, machine)
            }
        };
        let frame = in_triangles(frame, machine)?;
        if frame.blend == Blending::Off {
            return Ok((frame, None));
        }
        let (frame, order) = edgewalk_golden::sorted(frame, machine.subpixel_bits);
        Ok((frame, Some(order)))
    }

    /// The edges of the frame as lines, behind its surfaces or without them.
    pub fn wireframe(&self, machine: &Plan, hidden: HiddenLines) -> Result<Frame> {
        in_lines(&self.outlined(machine)?, machine, hidden)
    }

    /// The frame with the polygons it has.
    pub fn outlined(&self, machine: &Plan) -> Result<Frame> {
        match self.triangles()? {
            // A wireframe has no values for channels of the user's own.
            Some(frame) if self.shading() == Shading::Wireframe => {
                as_large(&self.input, frame, machine)?;
                Ok(frame.clone())
            }
            Some(frame) => fitting(&self.input, frame.clone(), machine),
            None => {
                let (scene, surface) = self.surface(machine)?;
                Ok(edgewalk_golden::frame(&scene, &surface, self.shading().golden()))
            }
        }
    }
}

/// The edges of a frame as lines, its surfaces as triangles.
fn in_lines(frame: &Frame, machine: &Plan, hidden: HiddenLines) -> Result<Frame> {
    in_triangles(lines_of(frame, machine, hidden), machine)
}

/// The edges of a frame as lines, its surfaces with the polygons they have.
fn lines_of(frame: &Frame, machine: &Plan, hidden: HiddenLines) -> Frame {
    let step = 1.0 / machine.z.max() as f64;
    wireframe_in_lines(frame, golden_fill(machine), hidden, step)
}
