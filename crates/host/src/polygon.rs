//! Polygons on their way to POLY: which of them a plane holds, what is sent of each, and triangles for the others.
//!
//! ```text
//!  polygon ─> cut at the guard band ─> snapped ─┬─ a plane holds its values ─> tokens, in bands of at most N edges
//!                                               └─ none does ─> triangles, where its edges do not cross
//! ```

use crate::misplaced::misplaced;
use crate::vertices::{guard_band, named, port_vertices};
use anyhow::{Result, anyhow};
use edgewalk_machine::key::Domain;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{COLOURS, Channel, Kind, Plan, PortVertex, Window};
use edgewalk_scene::{
    Blending, Frame, Host, Line, Polygon, Primitive, ShadeMode, State, Triangle, Vertex, contour_in_band,
};

/// What a machine with POLY is sent of a primitive.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// A triangle, or a piece of one or of a polygon.
    Triangle(Triangle),
    /// A polygon whose values a plane holds, in the guard band.
    Polygon(Polygon),
    /// A line.
    Line(Line),
}

/// POLY draws the polygons of this frame, as far as planes hold their values: those of lights, of shading at each pixel and of
/// the user's own channels have no values at their vertices.
#[must_use]
pub fn is_for_poly(frame: &Frame, machine: &Plan) -> bool {
    let plain = frame.shadows.is_empty() && frame.shading.is_none() && frame.extra == 0;
    machine.polygon.is_there() && plain && !frame.polygons.is_empty()
}

/// What is sent of a frame, in drawing order, each with the place of what it was among the frame's primitives.
///
/// # Errors
/// A polygon that neither a plane holds nor triangles cover, or that cannot enter the machine.
pub fn pieces(frame: &Frame, machine: &Plan, host: &mut Host) -> Result<Vec<(usize, Piece)>> {
    let (limit, mut pieces) = (guard_band(machine), Vec::new());
    let primitives = frame.primitives();
    for pass in frame.passes() {
        for place in pass.primitives.clone().take_while(|place| *place < primitives.len()) {
            match primitives[place] {
                Primitive::Triangle(triangle) => {
                    let parts = host.in_band(triangle, frame, limit);
                    pieces.extend(parts.iter().map(|part| (place, Piece::Triangle(*part))));
                }
                Primitive::Polygon(polygon) => {
                    let parts = of_polygon(place, polygon, frame, &pass.state, machine, host)?;
                    pieces.extend(parts.into_iter().map(|part| (place, part)));
                }
                Primitive::Line(line) => pieces.push((place, Piece::Line(*line))),
            }
        }
    }
    Ok(pieces)
}

/// The frame with these pieces in the place of its primitives.
#[must_use]
pub fn of_pieces(frame: Frame, pieces: Vec<(usize, Piece)>, host: Host) -> Frame {
    let before = |at: usize| pieces.iter().take_while(|(place, _)| *place < at).count();
    let changes = frame.changes.iter();
    let changes =
        changes.map(|change| edgewalk_scene::Change { after: before(change.after), ..*change }).collect();
    let (mut triangles, mut polygons, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    for (_, piece) in pieces {
        match piece {
            Piece::Triangle(triangle) => triangles.push(triangle),
            Piece::Polygon(polygon) => polygons.push(Polygon { after: triangles.len(), ..polygon }),
            Piece::Line(line) => lines.push(Line { after: triangles.len() + polygons.len(), ..line }),
        }
    }
    Frame { triangles, polygons, lines, changes, host, ..frame }
}

/// The polygon in the guard band, or triangles for it.
fn of_polygon(
    place: usize,
    polygon: &Polygon,
    frame: &Frame,
    state: &State,
    machine: &Plan,
    host: &mut Host,
) -> Result<Vec<Piece>> {
    let inside = in_band(polygon, frame, guard_band(machine), host);
    if inside.contours.is_empty() {
        return Ok(Vec::new());
    }
    let contours = on_port(place, &inside, frame, state, machine)?;
    let bends = bends(&contours, machine);
    if bends.iter().all(|bend| bend.is_held) {
        return Ok(vec![Piece::Polygon(inside)]);
    }
    let parts = inside.triangles(machine.subpixel_bits).map_err(|crossing| {
        let (name, most) = machine
            .channels()
            .iter()
            .zip(&bends)
            .find(|(_, bend)| !bend.is_held)
            .map_or(("z", 0.0), |(channel, bend)| (channel.name, bend.defect));
        anyhow!(
            "polygon at vertex {} {}: its edges cross and no plane holds its {name} (largest defect {most:.3} LSB); \
             permitted: values in a plane{}, or edges that do not cross",
            crossing.x,
            crossing.y,
            if ["r", "g", "b"].contains(&name) { ", polygon.values = bilinear" } else { "" }
        )
    })?;
    Ok(parts.into_iter().map(Piece::Triangle).collect())
}

/// The polygon cut at the guard band, its colours those of its first vertex in flat mode.
fn in_band(polygon: &Polygon, frame: &Frame, limit: f64, host: &mut Host) -> Polygon {
    let first = polygon.contours.first().and_then(|contour| contour.first());
    let colored = |v: &Vertex| match (frame.mode, first) {
        (ShadeMode::Flat, Some(first)) => v.colored_as(first),
        _ => *v,
    };
    let colored: Vec<Vec<Vertex>> =
        polygon.contours.iter().map(|c| c.iter().map(colored).collect()).collect();
    let fits = |v: &Vertex| v.x.abs() <= limit && v.y.abs() <= limit;
    if colored.iter().flatten().all(fits) {
        return Polygon { contours: colored, ..*polygon };
    }
    let contours = colored.iter().map(|contour| contour_in_band(contour, limit));
    let contours: Vec<Vec<Vertex>> = contours.filter(|contour| contour.len() > 2).collect();
    if contours.is_empty() {
        host.off_screen += 1;
    } else {
        (host.clipped, host.pieces) = (host.clipped + 1, host.pieces + 1);
    }
    Polygon { contours, ..*polygon }
}

/// The vertices of a polygon snapped to the port.
///
/// # Errors
/// A vertex that the machine cannot take; k_t of several vertices where a primitive has one.
pub fn on_port(
    place: usize,
    polygon: &Polygon,
    frame: &Frame,
    state: &State,
    machine: &Plan,
) -> Result<Vec<Vec<PortVertex>>> {
    let mut vertices = polygon.contours.iter().flatten();
    let first = vertices.next().map_or(0.0, |v| v.kt);
    let uneven = vertices.any(|v| v.kt != first);
    if state.blend == Blending::Mix && machine.has_triangle_kt() && frame.mode == ShadeMode::Gouraud && uneven
    {
        return Err(anyhow!(
            "{}: kt within a polygon: blend.kind = constant, as dither.screen_door = yes, has one for a polygon; \
             add --set blend.kind=interpolated, or draw with mode flat",
            named("polygon", place, None)
        ));
    }
    let snap = |v: &Vertex| -> Result<PortVertex> {
        let name = |_| format!("{}, vertex {} {}", named("polygon", place, None), v.x, v.y);
        let vertices = port_vertices(place, &Triangle([*v; 3]), frame, state, machine, &name)?;
        let [vertex, ..] = machine.windowed(vertices);
        Ok(vertex)
    };
    polygon.contours.iter().map(|contour| contour.iter().map(snap).collect()).collect()
}

/// How far the values of a polygon's vertices lie from the plane that POLY takes of it, in a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The largest distance, LSB.
    pub defect: f64,
    /// The defect is no more than snapping and rounding make of a plane.
    pub is_flat: bool,
    /// POLY may draw it: it is flat, and no output leaves its range.
    pub is_held: bool,
}

/// Of each channel; bilinear colours are of no plane; nothing is far from a plane of a polygon without area, which draws nothing.
#[must_use]
pub fn bends(contours: &[Vec<PortVertex>], machine: &Plan) -> Vec<Bend> {
    let vertices: Vec<PortVertex> = contours.concat();
    let flat = Bend { defect: 0.0, is_flat: true, is_held: true };
    let Some(plane) = machine.far_apart(&vertices) else { return vec![flat; machine.channels().len()] };
    let mut bends = vec![flat; machine.channels().len()];
    for (i, channel) in machine.planes() {
        bends[i] = bend(i, channel, &plane, &vertices, machine).unwrap_or(flat);
    }
    bends
}

/// In one channel; none of a plane without area.
fn bend(
    i: usize,
    channel: &Channel,
    [a, b, c]: &[PortVertex; 3],
    vertices: &[PortVertex],
    machine: &Plan,
) -> Option<Bend> {
    // Places in 2^-s px, values in 2^-e LSB: all exact.
    let to = |p: &PortVertex| [i128::from(p.x() - a.x()), i128::from(p.y() - a.y())];
    let value = |p: &PortVertex| i128::from(p.values()[i]);
    let ([bx, by], [cx, cy]) = (to(b), to(c));
    let area = bx * cy - by * cx;
    if area == 0 {
        return None;
    }
    let [db, dc] = [b, c].map(|p| value(p) - value(a));
    let [nx, ny] = [db * cy - dc * by, bx * dc - cx * db];
    // How far a vertex lies from the plane, times the area.
    let off = |p: &PortVertex| {
        let [x, y] = to(p);
        (nx * x + ny * y + (value(a) - value(p)) * area) * area.signum()
    };
    let area = area.abs();
    // Rounding of values may make half an LSB of a defect, snapping half a sub-pixel for each of three vertices, twice.
    let permitted = (area << channel.vertex_fraction) + 6 * (nx.abs() + ny.abs());
    let most = vertices.iter().map(|p| off(p).abs()).max().unwrap_or(0);
    let one = (area << channel.vertex_fraction) as f64;
    let steps = channel.error_budget(machine.max_steps()).steps.to_f64();
    let (low, high) = match channel.kind {
        Kind::Unorm | Kind::Weight => (0.0, channel.limit() as f64),
        Kind::Signed | Kind::Floor => (-(channel.limit() as f64), channel.limit() as f64),
    };
    let scale = f64::from(1u32 << channel.vertex_fraction);
    let in_range = vertices.iter().all(|p| {
        let plane = value(p) as f64 / scale + off(p) as f64 / one;
        // An output is rounded: half an LSB less what steps may add.
        plane > low - 0.5 + steps && plane < high + 0.5 - steps || off(p) == 0
    });
    let is_flat = 2 * most <= permitted;
    Some(Bend { defect: most as f64 / one, is_flat, is_held: is_flat && in_range })
}

/// How far pictures of planes may be from values along the edges of a frame's polygons, LSB, a channel of the machine, of each colour
/// that of all three: the largest defect. Of bilinear colours what edges beside their places make of them.
///
/// A polygon of which the port takes triangles counts twice its defect: each of two planes may be off by it. One that no plane holds
/// counts nothing there, as nothing bounds it.
#[must_use]
pub fn defects(frame: &Frame, machine: &Plan) -> Vec<f64> {
    let mut most = vec![0.0f64; machine.channels().len()];
    let (planes, bilinear) = (is_for_poly(frame, machine), machine.polygon.is_bilinear());
    if frame.polygons.is_empty() && !bilinear {
        return most;
    }
    let beside = |most: &mut Vec<f64>, contours: &[Vec<Vertex>]| {
        if bilinear {
            most[COLOURS.start] = most[COLOURS.start].max(misplaced(contours, machine));
        }
    };
    let primitives = frame.primitives();
    for pass in frame.passes() {
        for place in pass.primitives.clone().take_while(|place| *place < primitives.len()) {
            let polygon = match primitives[place] {
                Primitive::Polygon(polygon) => polygon,
                Primitive::Triangle(Triangle(vertices)) if frame.mode == ShadeMode::Gouraud => {
                    beside(&mut most, &[vertices.to_vec()]);
                    continue;
                }
                // One colour, or a line, whose colours are those of its one edge.
                _ => continue,
            };
            let inside = in_band(polygon, frame, guard_band(machine), &mut Host::default());
            let Ok(contours) = on_port(place, &inside, frame, &pass.state, machine) else { continue };
            let bends = bends(&contours, machine);
            let is_whole = planes && bends.iter().all(|bend| bend.is_held);
            if is_whole {
                beside(&mut most, &inside.contours);
            }
            for (most, bend) in most.iter_mut().zip(bends) {
                let planes = if is_whole { 1.0 } else { 2.0 };
                if bend.is_flat {
                    *most = most.max(planes * bend.defect);
                }
            }
        }
    }
    let of_colours = most[COLOURS].iter().copied().fold(0.0, f64::max);
    most[COLOURS].fill(of_colours);
    most
}

/// What the port takes of a polygon, in bands of no more edges than the table of POLY holds: each ends with its plane.
///
/// # Errors
/// A line with more edges.
pub fn tokens(
    place: usize,
    contours: &[Vec<PortVertex>],
    machine: &Plan,
) -> Result<Vec<Vec<[PortVertex; 3]>>> {
    let windows = bands(place, contours, machine)?;
    let tokens = windows.into_iter().map(|window| machine.polygon(contours, window));
    Ok(tokens.filter(|tokens| !tokens.is_empty()).collect())
}

/// The windows of these bands.
fn bands(place: usize, contours: &[Vec<PortVertex>], machine: &Plan) -> Result<Vec<Window>> {
    let places = machine.polygon.edges as usize;
    let edge = |contour: &[PortVertex], i: usize| {
        let ends = [i, (i + 1) % contour.len()].map(|end| machine.first_pixel(contour[end].y()));
        machine.lines_of(ends, Window::default())
    };
    let edges = contours.iter().flat_map(|contour| (0..contour.len()).map(move |i| edge(contour, i)));
    let edges: Vec<_> = edges.filter(|lines| !lines.is_empty()).collect();
    let mut starts: Vec<i32> = edges.iter().map(|lines| lines.start).collect();
    let mut ends: Vec<i32> = edges.iter().map(|lines| lines.end).collect();
    starts.sort_unstable();
    ends.sort_unstable();
    let (Some(first), Some(last)) = (starts.first(), ends.last()) else { return Ok(Vec::new()) };
    let x0 = machine.window_from(&contours.concat()).x0;
    let (mut y0, mut windows) = (*first, Vec::new());
    while y0 < *last {
        // The edges of lines y0 to y1: begun before y1, and not over at y0.
        let over = ends.partition_point(|end| *end <= y0);
        let y1 = starts.get(places + over).map_or(*last, |start| *start);
        if y1 <= y0 {
            let active = starts.partition_point(|start| *start <= y0) - over;
            return Err(too_many(place, y0, active, machine));
        }
        windows.push(Window { x0, y0: y0 as u32, y1: y1 as u32 });
        y0 = y1;
    }
    Ok(windows)
}

fn too_many(place: usize, line: i32, active: usize, machine: &Plan) -> anyhow::Error {
    let places = KEYS.iter().find(|key| key.name == "polygon.edges").map(|key| key.domain);
    let enough = match places {
        Some(Domain::OneOf(list)) => list.iter().copied().find(|places| *places as usize >= active),
        _ => None,
    };
    let remedy = enough.map_or("with polygon.edges = 0 triangles are drawn".to_owned(), |places| {
        format!("set polygon.edges = {places}")
    });
    anyhow!(
        "line {line} of polygon {place} has {active} active edges, polygon.edges = {} is the most; {remedy}",
        machine.polygon.edges
    )
}
