//! What is to be drawn on one machine after another: read once, made into a frame for each screen.

use crate::extra;
use crate::faces::{faces, joined};
use crate::needs::{self, Need};
use crate::polygon::{is_for_poly, of_pieces, pieces};
use crate::port::sent;
use crate::vertices::guard_band;
use anyhow::{Context as _, Result, anyhow};
use edgewalk_golden::Shading;
use edgewalk_machine::{Counted, Plan};
use edgewalk_scene::{
    Blending, Change, Frame, InputKind, Line, PixelMethod, Scene, ShadeMode, Surface, Triangulated,
    triangle_file,
};
use sha2::{Digest, Sha256};
use std::path::Path;
use std::sync::Arc;

/// A scene, a mesh, or a file of screen-space triangles.
#[derive(Clone)]
pub struct Input {
    name: String,
    what: What,
}

/// Where a scene's colours are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shaded {
    /// At the corners, by this system.
    Corners(Shading),
    /// At each pixel, by the machine's SHADE.
    Pixels(PixelMethod),
}

#[derive(Clone)]
enum What {
    Scene(Arc<Scene>, Shaded),
    Triangles(Arc<Frame>),
}

impl Input {
    /// The built-in scene of that name, or the file.
    ///
    /// # Errors
    /// No such scene or file, or a fault in it.
    pub fn open(name: &str, shading: Shaded) -> Result<Input> {
        let what = if InputKind::is_triangles(name) {
            What::Triangles(Arc::new(triangle_file::read(Path::new(name))?))
        } else {
            What::Scene(Arc::new(Scene::open(name)?), shading)
        };
        Ok(Input { name: name.to_owned(), what })
    }

    /// The same input with the colours of a scene made so; a triangle file says itself how it is shaded.
    #[must_use]
    pub fn shaded(&self, shading: Shaded) -> Input {
        match &self.what {
            What::Scene(scene, _) => Input { what: What::Scene(scene.clone(), shading), ..self.clone() },
            What::Triangles(_) => self.clone(),
        }
    }

    /// Every key of the machine that the input asks another value for.
    #[must_use]
    pub fn needs(&self, machine: &Plan) -> Vec<Need> {
        match &self.what {
            What::Scene(scene, shading) => needs::needs(&on_screen(scene, *shading, machine), machine),
            What::Triangles(frame) => needs::needs(frame, machine),
        }
    }

    /// As it was asked for.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The screen that it brings, pixels; scenes are drawn on any.
    #[must_use]
    pub fn size(&self) -> Option<(u32, u32)> {
        match &self.what {
            What::Triangles(frame) => Some((frame.width, frame.height)),
            What::Scene(..) => None,
        }
    }

    /// The name of the shading that a triangle file brings; none of a scene.
    #[must_use]
    pub fn own_shading(&self) -> Option<&'static str> {
        match &self.what {
            What::Triangles(frame) => Some(match (&frame.shading, frame.mode) {
                (Some(shading), _) => shading.method.name(),
                (None, ShadeMode::Flat) => "constant",
                (None, ShadeMode::Gouraud) => "gouraud",
            }),
            What::Scene(..) => None,
        }
    }

    /// Twelve hex digits that stand for the input, whichever machine draws it: those of a scene's frame on the default machine.
    ///
    /// # Errors
    /// None but of memory.
    pub fn hash(&self) -> Result<String> {
        Ok(match &self.what {
            What::Triangles(frame) => hash(frame),
            What::Scene(..) => hash(&self.frame(&Plan::default())?),
        })
    }

    /// The scene, and its surface on the machine's screen, clipped to its guard band; none of a triangle file.
    #[must_use]
    pub fn surface(&self, machine: &Plan) -> Option<(&Scene, Surface)> {
        match &self.what {
            What::Triangles(_) => None,
            What::Scene(scene, _) => {
                Some((scene, scene.surface(machine.width, machine.height, guard_band(machine))))
            }
        }
    }

    /// The frame as the machine draws it, polygons as triangles, clipped to its guard band.
    ///
    /// # Errors
    /// A triangle file of another size, channels of the user's own without values for them.
    pub fn frame(&self, machine: &Plan) -> Result<Frame> {
        Ok(self.placed(machine)?.0)
    }

    /// Like `frame`, of the first triangles, polygons and lines of the input, at most so many. A scene's triangles are counted as they
    /// are drawn.
    ///
    /// # Errors
    /// Those of `frame`.
    pub fn first(&self, machine: &Plan, most: usize) -> Result<Frame> {
        match &self.what {
            What::Triangles(frame) => {
                in_triangles(fitting(&self.name, Frame::clone(frame), machine)?.first(most), machine)
            }
            What::Scene(..) => Ok(self.frame(machine)?.first(most)),
        }
    }

    /// Like `frame`, with the place in the input of what each of its primitives is or is a part of: of a scene the face of the mesh.
    /// It is the same on any machine.
    ///
    /// # Errors
    /// Those of `frame`.
    pub fn placed(&self, machine: &Plan) -> Result<(Frame, Vec<i32>)> {
        let (scene, shading) = match &self.what {
            What::Triangles(frame) => {
                return placed(fitting(&self.name, Frame::clone(frame), machine)?, machine);
            }
            What::Scene(scene, shading) => (scene, *shading),
        };
        extra::none(machine).with_context(|| self.name.clone())?;
        let surface = scene.surface(machine.width, machine.height, guard_band(machine));
        let frame = of_surface(scene, &surface, shading, machine);
        let faces = faces(&frame, scene, &surface);
        let (frame, places) = placed(frame, machine)?;
        let places: Vec<i32> = places.into_iter().map(|place| faces[place as usize]).collect();
        if frame.blend == Blending::Off {
            return Ok((frame, places));
        }
        let (frame, order) = edgewalk_golden::sorted(frame, machine.subpixel_bits);
        let places = order.order.iter().map(|place| places[*place]).collect();
        Ok((frame, places))
    }
}

/// The scene on the machine's screen, clipped to its guard band, its faces as POLY draws them.
fn on_screen(scene: &Scene, shading: Shaded, machine: &Plan) -> Frame {
    let surface = scene.surface(machine.width, machine.height, guard_band(machine));
    of_surface(scene, &surface, shading, machine)
}

fn of_surface(scene: &Scene, surface: &Surface, shading: Shaded, machine: &Plan) -> Frame {
    match shading {
        Shaded::Corners(system) => {
            joined(edgewalk_golden::frame(scene, surface, system), scene, surface, machine)
        }
        Shaded::Pixels(method) => scene.pixel_frame(surface, method),
    }
}

/// The triangle file's frame, if it is as large as the machine's screen and has values for its channels.
///
/// # Errors
/// It is not, or has not.
pub fn fitting(name: &str, frame: Frame, machine: &Plan) -> Result<Frame> {
    as_large(name, &frame, machine)?;
    if frame.extra != extra::channels(machine).len() {
        needs::check(&frame, machine).with_context(|| name.to_owned())?;
    }
    Ok(frame)
}

/// Accepts a frame, or the header of one, that is as large as the machine's screen.
///
/// # Errors
/// It is not: both sizes, and the settings with which it is.
pub fn as_large(name: &str, frame: &Frame, machine: &Plan) -> Result<()> {
    if (frame.width, frame.height) != (machine.width, machine.height) {
        return Err(anyhow!(
            "{name}: size {} {}: the machine's screen is {}x{}; add --set screen.width={} --set screen.height={}",
            frame.width,
            frame.height,
            machine.width,
            machine.height,
            frame.width,
            frame.height
        ));
    }
    Ok(())
}

/// The frame with its polygons as triangles, all in the machine's guard band; on a machine with POLY polygons stay whose values a
/// plane holds.
///
/// # Errors
/// A polygon that cannot be cut into triangles.
pub fn in_triangles(frame: Frame, machine: &Plan) -> Result<Frame> {
    Ok(placed(frame, machine)?.0)
}

/// Like `in_triangles`, with the place of what each primitive is or is a part of among those of the frame that was given.
///
/// # Errors
/// Those of `in_triangles`.
pub fn placed(frame: Frame, machine: &Plan) -> Result<(Frame, Vec<i32>)> {
    if is_for_poly(&frame, machine) {
        let mut host = frame.host;
        let pieces = pieces(&frame, machine, &mut host)?;
        let own = pieces.iter().map(|(place, _)| *place as i32).collect(); // a frame has fewer
        return Ok((of_pieces(frame, pieces, host), own));
    }
    let (Triangulated { triangles, ids }, host) = sent(&frame, machine)?;
    // So many triangles are made of the primitives before this place; lines stay what they are.
    let made = |place: usize| ids.iter().take_while(|id| (**id as usize) < place).count();
    let places = frame.lines.iter().enumerate().map(|(number, line)| line.after + number);
    let lines: Vec<Line> =
        frame.lines.iter().zip(places.clone()).map(|(line, at)| Line { after: made(at), ..*line }).collect();
    let before = |at: usize| made(at) + places.clone().take_while(|place| *place < at).count();
    let changes =
        frame.changes.iter().map(|change| Change { after: before(change.after), ..*change }).collect();
    let mut own: Vec<i32> = ids.iter().copied().chain(places.clone().map(|place| place as i32)).collect();
    // What comes first in the list is drawn first.
    own.sort_unstable();
    let triangles = triangles.into_owned();
    Ok((Frame { triangles, changes, polygons: Vec::new(), lines, host, ..frame }, own))
}

/// The triangles of a frame as the machine's guard band cuts them, with the place of each in the frame; none where nothing is cut. Of a
/// frame with polygons none either, as golden draws these whole.
///
/// # Errors
/// None without polygons.
pub fn cut_at_band(frame: &Frame, machine: &Plan) -> Result<Option<(Frame, Vec<i32>)>> {
    if !frame.polygons.is_empty() {
        return Ok(None);
    }
    let (cut, places) = placed(frame.clone(), machine)?;
    Ok((cut.host.clipped > frame.host.clipped).then_some((cut, places)))
}

/// How many triangles, polygons and lines a frame draws.
#[must_use]
pub fn counted(frame: &Frame) -> Counted {
    Counted { triangles: frame.triangles.len(), polygons: frame.polygons.len(), lines: frame.lines.len() }
}

/// Twelve hex digits that stand for a frame of triangles: every bit of its vertices and of its state.
#[must_use]
pub fn hash(frame: &Frame) -> String {
    let mut digest = Sha256::new();
    let Frame { width, height, mode, depth, depth_write, blend, clear, extra, .. } = frame;
    digest.update(format!(
        "{width} {height} {mode:?} {depth:?} {depth_write} {blend:?} {clear:?} {extra} {:?} {} {:?}\n",
        (&frame.shadows, frame.light),
        frame.color_write,
        frame.changes
    ));
    digest.update(format!("{:?}\n", frame.polygons));
    if !frame.lines.is_empty() {
        digest.update(format!("{:?}\n", frame.lines));
    }
    if let Some(shading) = &frame.shading {
        digest.update(format!("{shading:?}\n"));
    }
    for vertex in frame.triangles.iter().flat_map(|triangle| &triangle.0) {
        let [e0, e1, e2, e3] = vertex.extra;
        let values = [vertex.x, vertex.y, vertex.z, vertex.r, vertex.g, vertex.b, vertex.kt, e0, e1, e2, e3];
        for value in values {
            digest.update(value.to_bits().to_le_bytes());
        }
    }
    hex(&digest.finalize()[..6])
}

/// As hex digits.
#[must_use]
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
