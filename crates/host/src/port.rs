//! A frame's way to the machine's port.

use crate::advice::OR_GOLDEN;
use crate::light::{self, Map};
use crate::needs;
use crate::polygon::{self, Piece};
use crate::raster::{Cycles, LightPass, Raster};
use crate::shade::{Feed, feed, shading_for};
use crate::vertices::{guard_band, named, port_triangle, port_vertices};
use anyhow::{Result, anyhow};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::{DrawState, Pass, Shading};
use edgewalk_scene::{
    Blending, CrossingEdges, DepthFunc, Frame, Host, Line, Polygon, State, Triangle, Triangulated, fits,
};
use std::borrow::Cow;

/// The commands that take a frame with rules that change between triangles, and a light's map; an error ends the list.
const TAKE_ALL: &str = "raster, render, explain, replay, sweep, compare, size, judge";
const LAST_OF_THEM: &str = "triangles";

/// A frame as the machine's port takes it.
pub struct PortFrame {
    /// Triangles, lines and parts of polygons in drawing order, each a token.
    pub triangles: Vec<[PortVertex; 3]>,
    /// For each triangle, line and whole polygon or band of one the place of what it is a part of among the frame's triangles,
    /// polygons and lines.
    pub ids: Vec<i32>,
    /// The rules, and how many triangles are drawn by each, in order; at least one.
    pub passes: Vec<Pass>,
    /// What was done to the triangles on the way.
    pub host: Host,
    /// The lights' maps.
    pub lights: Vec<Map>,
    /// For TERM and SHADE, where the frame is shaded at each pixel.
    pub shade: Option<Feed>,
}

/// Of a frame that is not shaded at each pixel.
const UNSHADED: &Shading =
    &Shading { records: Vec::new(), tables: Vec::new(), roots: Vec::new(), textures: Vec::new() };

impl PortFrame {
    /// What the memories behind TERM and SHADE hold.
    #[must_use]
    pub fn words(&self) -> &Shading {
        self.shade.as_ref().map_or(UNSHADED, |feed| &feed.words)
    }

    /// What a machine is sent for all of the frame: where it draws its maps, these before the picture; and the maps that it finds.
    #[must_use]
    pub fn sent(&self) -> (Cow<'_, [[PortVertex; 3]]>, Cow<'_, [Pass]>, Vec<Vec<u32>>) {
        if self.lights.iter().all(|light| light.own.is_none()) {
            return (Cow::Borrowed(&self.triangles), Cow::Borrowed(&self.passes), self.maps());
        }
        let (mut triangles, mut passes) = (Vec::new(), Vec::new());
        for (number, own) in self.lights.iter().map(|light| &light.own).enumerate() {
            let Some(own) = own else { continue };
            triangles.extend_from_slice(&own.triangles);
            passes.extend(own.passes.iter().map(|pass| Pass { map: Some(number), ..*pass }));
        }
        triangles.extend_from_slice(&self.triangles);
        passes.extend_from_slice(&self.passes);
        (Cow::Owned(triangles), Cow::Owned(passes), Vec::new())
    }

    /// The picture of a frame that was drawn as it was [sent](PortFrame::sent), apart from the maps that were drawn before it.
    #[must_use]
    pub fn apart(&self, mut drawn: edgewalk_model::Frame) -> (edgewalk_model::Frame, Vec<LightPass>) {
        let mut lights = Vec::new();
        for (own, words) in self.lights.iter().filter_map(|light| light.own.as_ref()).zip(&drawn.maps) {
            let of_light = drawn.passes.drain(..own.passes.len().min(drawn.passes.len()));
            let spent = of_light.reduce(|spent, pass| spent.and(&pass)).unwrap_or_default();
            lights.push(LightPass { cycles: Cycles::of(&spent, None), words: words.clone() });
            for id in drawn.id.iter_mut().filter(|id| **id >= 0) {
                *id -= own.triangles.len() as i32; // a frame has fewer triangles
            }
        }
        if !lights.is_empty() {
            drawn.counters =
                drawn.passes.iter().cloned().reduce(|all, pass| all.and(&pass)).unwrap_or_default();
        }
        (drawn, lights)
    }

    /// The words of the lights' maps.
    #[must_use]
    pub fn maps(&self) -> Vec<Vec<u32>> {
        self.lights.iter().map(|light| light.words.clone()).collect()
    }

    /// The rules of a frame in which they do not change, for who has no light's map.
    ///
    /// # Errors
    /// They do, or the frame has a light.
    pub fn state(&self) -> Result<DrawState> {
        if !self.lights.is_empty() {
            return Err(anyhow!(
                "shadow: a light's map; permitted for {TAKE_ALL}, {LAST_OF_THEM}, vectors and verify"
            ));
        }
        self.one_state()
    }

    /// The rules of a frame in which they do not change.
    ///
    /// # Errors
    /// They do.
    pub fn one_state(&self) -> Result<DrawState> {
        match &self.passes[..] {
            [pass] => Ok(pass.state),
            passes => Err(anyhow!(
                "{} passes: the rules change between triangles; permitted for {TAKE_ALL} and {LAST_OF_THEM}",
                passes.len()
            )),
        }
    }
}

/// The ids of the frame's triangles and polygons for those of the triangles the machine drew, what the lights' maps took, and what the host did.
#[must_use]
pub fn of_port(mut raster: Raster, port: &PortFrame) -> Raster {
    for id in &mut raster.id {
        // Where nothing was drawn the id is negative.
        *id = usize::try_from(*id).map_or(*id, |triangle| port.ids[triangle]);
    }
    let pass =
        |light: &Map| LightPass { cycles: Cycles::of(&light.counters, None), words: light.words.clone() };
    // Those that the machine drew itself are there already.
    let lights =
        if raster.lights.is_empty() { port.lights.iter().map(pass).collect() } else { raster.lights };
    Raster { lights, host: port.host, ..raster }
}

/// What a frame sends to the machine: its polygons as triangles, and no triangle beyond the guard band.
///
/// # Errors
/// A polygon that cannot be cut into triangles.
pub fn sent<'a>(frame: &'a Frame, machine: &Plan) -> Result<(Triangulated<'a>, Host), CrossingEdges> {
    let Triangulated { triangles, ids } = frame.triangulated(machine.subpixel_bits)?;
    let (limit, mut host) = (guard_band(machine), frame.host);
    // The terms of a shaded triangle are those of all of it.
    if frame.shading.is_some() || triangles.iter().all(|triangle| fits(triangle, limit)) {
        return Ok((Triangulated { triangles, ids }, host));
    }
    let (mut pieces, mut of) = (Vec::with_capacity(triangles.len()), Vec::with_capacity(ids.len()));
    for (triangle, id) in triangles.iter().zip(ids) {
        pieces.extend_from_slice(&host.in_band(triangle, frame, limit));
        of.resize(pieces.len(), id);
    }
    Ok((Triangulated { triangles: Cow::Owned(pieces), ids: of }, host))
}

/// Snaps a frame to the port, polygons as triangles, or says what of it the machine cannot take.
pub fn to_port(frame: &Frame, machine: &Plan) -> Result<PortFrame> {
    needs::check(frame, machine)?;
    for shadow in &frame.shadows {
        light::check(shadow, machine)?;
        if frame.shading.is_some() {
            return Err(anyhow!(
                "shadow: a frame that is shaded at each pixel has no light's map in the machine; permitted: mode gouraud or flat; change the mode{OR_GOLDEN}"
            ));
        }
    }
    let (pieces, mut host) = (pieces(frame, machine)?, frame.host);
    let of_pieces = pieces.as_ref().map(|(pieces, of_pieces)| {
        host = *of_pieces;
        pieces.iter().map(|(place, piece)| (*place, Part::of(piece))).collect::<Vec<_>>()
    });
    let in_triangles;
    let parts = match of_pieces {
        Some(parts) => parts,
        None => {
            in_triangles = sent(frame, machine)?;
            host = in_triangles.1;
            parts(&in_triangles.0.triangles, &in_triangles.0.ids, frame)
        }
    };
    let (mut port, mut ids, mut passes) =
        (Vec::with_capacity(parts.len()), Vec::with_capacity(parts.len()), Vec::new());
    let mut parts = parts.into_iter().peekable();
    for pass in frame.passes() {
        let before = port.len();
        while let Some((id, part)) = parts.next_if(|(id, _)| *id < pass.primitives.end) {
            match part {
                Part::Triangle(triangle) => {
                    port.push(port_triangle(id, triangle, frame, &pass.state, machine)?)
                }
                Part::Line(line) => port.push(port_line(id, line, frame, &pass.state, machine)?),
                Part::Polygon(part) => {
                    let contours = polygon::on_port(id, part, frame, &pass.state, machine)?;
                    let bands = polygon::tokens(id, &contours, machine)?;
                    ids.extend(bands.iter().skip(1).map(|_| id as i32));
                    if bands.is_empty() {
                        continue; // no edge has a line
                    }
                    port.extend(bands.concat());
                }
            }
            ids.push(id as i32); // a frame has fewer
        }
        passes.push(Pass {
            triangles: port.len() - before,
            state: draw_state(frame, &pass.state, machine)?,
            clear_depth: pass.clear_depth,
            map: frame.shadow(pass.state.light).map(|_| pass.state.light - 1),
        });
    }
    let lights = frame.shadows.iter().map(|shadow| light::map(shadow, machine)).collect::<Result<_>>()?;
    let shade = feed(frame, (&port, &ids), machine)?;
    Ok(PortFrame { triangles: port, ids, passes, lights, host, shade })
}

/// What a frame with polygons for POLY sends; none of another one.
type Pieces = Option<(Vec<(usize, Piece)>, Host)>;

fn pieces(frame: &Frame, machine: &Plan) -> Result<Pieces> {
    if !polygon::is_for_poly(frame, machine) {
        return Ok(None);
    }
    let mut host = frame.host;
    let pieces = polygon::pieces(frame, machine, &mut host)?;
    Ok(Some((pieces, host)))
}

/// What the port takes one after another.
enum Part<'a> {
    Triangle(&'a Triangle),
    Polygon(&'a Polygon),
    Line(&'a Line),
}

impl Part<'_> {
    fn of(piece: &Piece) -> Part<'_> {
        match piece {
            Piece::Triangle(triangle) => Part::Triangle(triangle),
            Piece::Polygon(polygon) => Part::Polygon(polygon),
            Piece::Line(line) => Part::Line(line),
        }
    }
}

/// Triangles and lines in drawing order, with their places among the frame's primitives.
fn parts<'a>(triangles: &'a [Triangle], ids: &[i32], frame: &'a Frame) -> Vec<(usize, Part<'a>)> {
    let triangles = ids.iter().zip(triangles).map(|(id, triangle)| (*id as usize, Part::Triangle(triangle)));
    let lines = frame.lines.iter().enumerate().map(|(number, line)| (line.after + number, Part::Line(line)));
    let mut parts: Vec<_> = triangles.chain(lines).collect();
    if !frame.lines.is_empty() {
        parts.sort_by_key(|(place, _)| *place); // stable
    }
    parts
}

/// Snaps line number `index` among the frame's primitives to the port, as [`port_triangle`] does a triangle.
fn port_line(
    index: usize,
    line: &Line,
    frame: &Frame,
    state: &State,
    machine: &Plan,
) -> Result<[PortVertex; 3]> {
    let [a, b] = line.ends;
    let name = |corner: Option<usize>| named("line", index, corner.map(|corner| ("end", corner.min(1))));
    let [a, _, b] = port_vertices(index, &Triangle([a, a, b]), frame, state, machine, &name)?;
    Ok(machine.windowed(machine.line([a, b])))
}

/// The rules of a pass as a machine has them that meets the [`needs`] of the frame.
///
/// # Errors
/// The frame is shaded at each pixel, and the machine cannot do so.
pub fn draw_state(frame: &Frame, state: &State, machine: &Plan) -> Result<DrawState> {
    shading_for(frame, machine)?;
    let max = machine.stored_color().max() as f64;
    Ok(DrawState {
        depth_func: state.depth.unwrap_or(DepthFunc::Always) as u8,
        depth_write: state.stores_depth(),
        color_write: state.color_write,
        blend_add: state.blend == Blending::Add,
        shadow_on: frame.shadow(state.light).is_some(),
        light_pass: false,
        ambient: frame.shadow(state.light).map_or(0, |shadow| light::ambient(shadow, machine)),
        clear: frame.clear.map(|v| (v * max).round_ties_even() as u64),
    })
}
