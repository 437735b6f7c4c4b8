//! Why a pixel looks as it does: the triangles over it, its light, and every addition, table and bound of the machine on the way to it.
//!
//! ```
//! use edgewalk_explain::{Input, explain};
//! use edgewalk_machine::Machine;
//! use edgewalk_scene::triangle_file;
//! let text = "size 16 12\nT 3 1.5 .25 1 0 0 0  13 4.75 .5 0 1 0 0  5.5 10 .5 0 0 1 0\n";
//! let frame = triangle_file::parse("stdin", text.as_bytes())?;
//! let machine = Machine { width: 16, height: 12, ..Machine::default() }.plan()?;
//! let input = Input { machine: &machine, frame: &frame, scene: None, order: None, outlined: None, places: &[] };
//! let told = explain(&input, (6, 5))?.text(8);
//! assert!(told.contains("additions to here: 6"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! Next: `edgewalk explain` prints this text; the bounds in it are proved in `docs/numerics.md`.

pub mod accumulators;
mod additions;
mod dithered;
mod edges;
mod between;
mod active;
mod layers;
mod table_read;
mod turned;
mod normal;
mod lamp;
mod shaded;
mod shadowed;
mod texel;
mod terms;
mod page;

use active::{InPoly, in_poly};
use additions::{Walk, walk};
use anyhow::{Result, anyhow};
use dithered::{Dithered, dithered};
use edges::{OnLine, on_line};
use edgewalk_golden::polygon::{EdgeTable, fragments as polygon_fragments};
use edgewalk_golden::{Drawing, Order, ShadowMaps, line_fragments};
use edgewalk_host::draw::{Pixel, bands, draw_frame};
use edgewalk_host::extra;
use edgewalk_host::faces::parts;
use edgewalk_host::port::{PortFrame, to_port};
use edgewalk_host::raster::{golden_drawing, golden_fill};
use edgewalk_host::shade::apart;
use edgewalk_host::vertices::port_triangle;
use edgewalk_machine::{EdgeKind, Fill, Plan};
use edgewalk_model::Waits;
use edgewalk_scene::{Frame, Primitive, Scene, State, Surface};
use layers::{Layer, layers};
use serde::Serialize;
use shaded::{ShadedPixel, leftward, shaded};
use shadowed::{ShadowedPixel, shadowed};
use std::ops::Range;
use std::slice;
use terms::{LitPoint, lit_point};

/// Side of the shadow maps, texels.
const SHADOW_MAP: u32 = 1024;

/// Everything about the pixel.
#[derive(Serialize)]
pub struct Explanation {
    /// Pixels of the whole picture that a triangle covers.
    #[serde(skip)]
    pub covered: u64,
    x: u32,
    y: u32,
    /// In drawing order.
    fragments: Vec<Over>,
    /// The last triangle that passed the depth test, -1 for none.
    id: i32,
    /// Golden picture there, [0, 1].
    z: f64,
    rgb: [f64; 3],
    /// Channels of the user's own, LSB.
    extra: Vec<f64>,
    /// What the machine has there in the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    stored: Option<Stored>,
    /// Why that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_stored: Option<String>,
    /// Where the scene has a surface.
    light: Option<LitPoint>,
    /// Of a blended frame the colours stored here, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    layers: Vec<Layer>,
    /// Where the frame is shaded at each pixel, and the machine does so: of each picture that the host adds, mostly one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    shaded: Vec<ShadedPixel>,
    /// Under lights whose maps the machine looks up.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    shadows: Vec<ShadowedPixel>,
    /// Why there are none of a scene, though the machine could look up maps.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_shadows: Option<String>,
    /// Of a frame with polygons, those whose edges cross the pixel's line.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    polygons: Vec<OnLine>,
    /// Of those that POLY draws, the registers of their edges on that line.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    poly: Vec<InPoly>,
    /// With DITHER, where the machine's own colours are known: as `machine`, of a frame whose colours nothing changes on their way.
    #[serde(skip_serializing_if = "Option::is_none")]
    dithered: Option<Dithered>,
    /// Where the machine has exact fill and exact edges, and draws the triangle.
    machine: Option<Walk>,
    /// Why there is none of the triangle that is seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_additions: Option<&'static str>,
}

/// The words of the machine's memories at the pixel, behind the last triangle.
#[derive(Serialize)]
struct Stored {
    /// The triangle that wrote the pixel last, -1 for none.
    id: i32,
    /// Depth, LSB.
    z: u64,
    /// Colours, LSB.
    rgb: [u64; 3],
}

/// A triangle over the pixel.
#[derive(Serialize)]
struct Over {
    id: i32,
    z: f64,
    rgb: [f64; 3],
    /// Channels of the user's own, LSB.
    extra: Vec<f64>,
}

/// What is drawn, and the scene it is made of, if it is one.
pub struct Input<'a> {
    /// On this machine.
    pub machine: &'a Plan,
    /// As the machine draws it.
    pub frame: &'a Frame,
    /// The scene, and its surface on the machine's screen.
    pub scene: Option<(&'a Scene, &'a Surface)>,
    /// The order in which its triangles are drawn, where that is another.
    pub order: Option<&'a Order>,
    /// Of a triangle file the frame with its polygons as they are; the machine draws them as triangles.
    pub outlined: Option<&'a Frame>,
    /// Of a triangle file the place among its triangles, polygons and lines of what each primitive is or is a part of.
    pub places: &'a [i32],
}

impl Input<'_> {
    /// The number by which a primitive of the frame is known: its place in the file, or its own.
    fn place(&self, id: i32) -> i32 {
        usize::try_from(id).ok().and_then(|id| self.places.get(id)).copied().unwrap_or(id)
    }
}

/// Explains pixel (x, y), which lies on the machine's screen.
///
/// # Errors
/// What of the frame the machine cannot take.
pub fn explain(input: &Input, (x, y): (u32, u32)) -> Result<Explanation> {
    let Input { machine, frame, scene, order, outlined, .. } = *input;
    let drawing = golden_drawing(frame, machine);
    // Of the picture one line is enough, however large the screen is.
    let picture = drawing.lines(y..y + 1);
    let parts = match frame.shading {
        Some(_) => apart(frame, machine)?.unwrap_or_else(|| vec![frame.clone()]),
        None => Vec::new(),
    };
    let ports: Vec<PortFrame> = parts.iter().map(|part| to_port(part, machine)).collect::<Result<_>>()?;
    let at = x as usize;
    let id = picture.id[at];
    let seen = usize::try_from(id).ok().and_then(|id| frame.triangle_at(id));
    let (shadows, no_shadows) = match (usize::try_from(id), &scene) {
        (Ok(id), None) => (shadowed(frame, machine, id, (x, y), picture.z[at])?.into_iter().collect(), None),
        (Ok(id), Some((scene, surface))) if machine.shadow.projects() => {
            match lights(scene, surface, machine, id, (x, y), picture.z[at]) {
                Ok(shadows) => (shadows, None),
                Err(reason) => (Vec::new(), Some(reason.to_string())),
            }
        }
        _ => (Vec::new(), None),
    };
    let (walked, no_additions) = match (seen, unseen_way(machine)) {
        (Some(triangle), None) => {
            let state = state_of(frame, id as usize);
            (walk(machine, &port_triangle(id as usize, triangle, frame, &state, machine)?, x, y), None)
        }
        (Some(_), reason) => (None, reason),
        (None, _) => (None, None),
    };
    let drawn = if parts.is_empty() { slice::from_ref(frame) } else { &parts };
    let (stored, not_stored) = match stored(drawn, machine, (x, y)) {
        Ok(stored) => (Some(Stored { id: input.place(stored.id), ..stored }), None),
        Err(why) => (None, Some(format!("{why:#}"))),
    };
    Ok(Explanation {
        covered: covered(&drawing, machine),
        x,
        y,
        fragments: over(frame, machine, (x, y))
            .into_iter()
            .map(|over| Over { id: input.place(over.id), ..over })
            .collect(),
        id: input.place(id),
        z: picture.z[at],
        rgb: picture.rgb[at],
        extra: own(machine, |channel| picture.extra[channel][at]),
        stored,
        not_stored,
        light: match (usize::try_from(id), &scene) {
            (Ok(id), Some((scene, surface))) => {
                let places =
                    order.map_or_else(|| on_surface(frame, id), |order| order.order[id]..order.order[id] + 1);
                places.into_iter().find_map(|place| light(scene, surface, place, machine, (x, y)))
            }
            _ => None,
        },
        layers: layers(frame, machine, (x, y))?
            .into_iter()
            .map(|layer| Layer { id: input.place(layer.id), ..layer })
            .collect(),
        shaded: match usize::try_from(id) {
            Ok(id) => parts
                .iter()
                .zip(&ports)
                .filter_map(|(part, port)| {
                    let walk = (leftward(machine, &port.triangles[id]), walked.as_ref());
                    shaded(machine, part, port.shade.as_ref()?, id, (x, y), walk)
                })
                .collect(),
            Err(_) => Vec::new(),
        },
        shadows,
        no_shadows,
        polygons: on_line(outlined.unwrap_or(frame), machine, (x, y)),
        poly: in_poly(frame, machine, (x, y)),
        dithered: walked.as_ref().and_then(|walk| dithered(machine, frame, &walk.output, (x, y))),
        machine: walked,
        no_additions,
    })
}

impl Explanation {
    /// As a page of text; the machine's colours have so many bits.
    #[must_use]
    pub fn text(&self, color_bits: u32) -> String {
        page::text(self, color_bits)
    }
}

/// The active edges that POLY has on the pixel's line, of each polygon that it draws, as text.
#[must_use]
pub fn active_edges(frame: &Frame, machine: &Plan, pixel: (u32, u32)) -> String {
    in_poly(frame, machine, pixel).iter().map(|polygon| active::text(polygon, pixel)).collect()
}

/// Fragments of the whole picture.
fn covered(drawing: &Drawing, machine: &Plan) -> u64 {
    let pictures = bands(machine.height, (BAND / machine.width).max(1)).map(|lines| drawing.lines(lines));
    pictures.map(|picture| picture.coverage.iter().map(|count| u64::from(*count)).sum::<u64>()).sum()
}

/// Pixels of a band, about: each takes 49 bytes.
const BAND: u32 = 1 << 19;

/// Why the additions on the way to a triangle's pixel are not shown; none where they are: it is the way of exact edges.
fn unseen_way(machine: &Plan) -> Option<&'static str> {
    if machine.polygon.is_there() {
        Some("POLY walks the edges of this machine; the additions are shown with polygon.edges = 0")
    } else if machine.fill != Fill::Exact {
        Some(
            "the spans of edge.fill = textbook begin and end by its own rule; they are shown with edge.fill = exact",
        )
    } else if machine.edge_kind != EdgeKind::Exact {
        Some(
            "the edges of edge.kind = slope round on their way; the additions are shown with edge.kind = exact",
        )
    } else {
        None
    }
}

/// What the machine stores at a pixel, all triangles drawn. Colours of pictures of the same triangles are added, and cut at the largest.
fn stored(pictures: &[Frame], machine: &Plan, pixel: (u32, u32)) -> Result<Stored> {
    let mut sum: Option<Stored> = None;
    for frame in pictures {
        let port = to_port(frame, machine)?;
        let Pixel { id, z, rgb } = draw_frame(machine, &port, Waits::Never)?.pixel(machine, pixel);
        let id = usize::try_from(id).map_or(-1, |number| port.ids[number]);
        let before = sum.map_or([0; 3], |sum| sum.rgb);
        let rgb = [0, 1, 2].map(|k| (before[k] + rgb[k]).min(machine.stored_color().max()));
        sum = Some(Stored { id, z, rgb });
    }
    sum.ok_or_else(|| anyhow!("no picture"))
}

/// The rules of a triangle.
fn state_of(frame: &Frame, id: usize) -> State {
    let passes = frame.passes();
    passes.iter().find(|pass| pass.primitives.contains(&id)).map_or(frame.state(), |pass| pass.state)
}

/// The primitives over a pixel, by the machine's fill rule, in drawing order.
fn over(frame: &Frame, machine: &Plan, pixel: (u32, u32)) -> Vec<Over> {
    let mut list: Vec<Over> = Vec::new();
    let (screen, fill) = ((machine.width, machine.height), golden_fill(machine));
    for (id, primitive) in (0..).zip(frame.primitives()) {
        // The textbook draws a pixel of the knee line twice.
        let mut add = |at, z, rgb, extra: &dyn Fn(usize) -> f64| {
            if at == pixel && list.last().is_none_or(|over| over.id != id) {
                list.push(Over { id, z, rgb, extra: own(machine, extra) });
            }
        };
        match primitive {
            Primitive::Triangle(triangle) => {
                fill.fragments(triangle, frame.mode, screen, |f| {
                    add((f.x, f.y), f.z(), f.rgb(), &|i| f.extra(i))
                });
            }
            Primitive::Line(line) => line_fragments(line, frame.mode, machine.subpixel_bits, screen, |f| {
                add((f.x, f.y), f.z(), f.rgb(), &|i| f.extra(i));
            }),
            // With POLY; elsewhere the frame that is explained has triangles in its place.
            Primitive::Polygon(polygon) => {
                let table = EdgeTable::new(polygon, frame.mode, fill.grid());
                polygon_fragments(&table, screen, |f| add((f.x, f.y), f.z(), f.rgb(), &|i| f.extra(i)));
            }
        }
    }
    list
}

/// Golden's values of the user's own channels, LSB, from those in the unit of the file.
fn own(machine: &Plan, value: impl Fn(usize) -> f64) -> Vec<f64> {
    let channels = extra::channels(machine).iter().enumerate();
    channels.map(|(place, channel)| value(place) * channel.host_unit()).collect()
}

/// The pixel under each light of a scene that is drawn with shadows.
fn lights(
    scene: &Scene,
    surface: &Surface,
    machine: &Plan,
    id: usize,
    pixel: (u32, u32),
    z: f64,
) -> Result<Vec<ShadowedPixel>> {
    let frames = edgewalk_host::lights::frames(scene, surface, machine)?;
    let mut all = Vec::new();
    // The first frame is that of no light.
    for (light, frame) in frames.iter().enumerate().skip(1) {
        let pixel = shadowed(frame, machine, id, pixel, z)?;
        all.extend(pixel.map(|pixel| ShadowedPixel { light, ..pixel }));
    }
    Ok(all)
}

/// The triangles of a scene's surface that this primitive of its frame is made of.
fn on_surface(frame: &Frame, id: usize) -> Range<usize> {
    let sizes: Vec<usize> = frame
        .primitives()
        .iter()
        .take(id + 1)
        .map(|primitive| match primitive {
            Primitive::Polygon(polygon) => parts(polygon),
            Primitive::Triangle(_) => 1,
            Primitive::Line(_) => 0, // along its sides
        })
        .collect();
    let end: usize = sizes.iter().sum();
    end - sizes.last().copied().unwrap_or(0)..end
}

fn light(scene: &Scene, surface: &Surface, id: usize, machine: &Plan, pixel: (u32, u32)) -> Option<LitPoint> {
    let triangle = surface.triangles.get(id)?;
    let maps = ShadowMaps::draw(scene, SHADOW_MAP);
    let mut point = None;
    let screen = (machine.width, machine.height);
    let mode = edgewalk_scene::ShadeMode::Gouraud;
    golden_fill(machine).fragments(&triangle.on_screen(), mode, screen, |fragment| {
        if (fragment.x, fragment.y) == pixel {
            point = Some(lit_point(scene, triangle, fragment, &maps));
        }
    });
    point
}
