//! The lights of a scene on the machine: what no light makes is drawn first, then the part of each light is added where its map says
//! lit, i = i_a + sum of r_l i_l.
//!
//! ```text
//!  scene ─┬─ ambient colours ──────────────> frame 0 ─┐
//!         └─ light l: its part, view, map ─> frame l ─┴─> passes of one picture, z of pass l nearer by an LSB than of l - 1
//! ```
//! Each frame is a picture of its own, for golden and for the machine, and is judged by itself; the picture of all passes must then
//! be the sum of theirs, bit by bit.
//!
//! A surface that transmits light is mixed over what lies behind it, over each light's part by itself: a sum that is mixed is the sum of what is
//! mixed. In one colour memory it would weaken the parts before it once more with every pass; so each frame then has its own, and the host adds them.

use crate::needs::{maps, met};
use crate::port::{PortFrame, to_port};
use crate::raster::{Cycles, Raster};
use anyhow::{Context as _, Result, anyhow};
use edgewalk_golden::{Gated, Shading};
use edgewalk_machine::{Plan, PortVertex};
use edgewalk_model::{DrawState, Pass};
use edgewalk_scene::{
    Blending, Frame, Light, LightView, Pane, Scene, Shadow, Surface, SurfaceTriangle, Triangle, Vertex,
};
use glam::DVec3;

/// Taken off every depth from a light beside the slope of its polygon: LSB of the map, for what rounding may hide; and a part of the
/// diagonal of the box around the mesh, as golden does, for sub-pixels, which move points off their planes.
const BIAS: f64 = 2.0;
const BIAS_OF_BOX: f64 = 1e-4;

/// The ambient frame, and one for each light of the scene, on this machine's screen.
///
/// # Errors
/// Units or a light that the machine has not, surfaces that are seen through.
pub fn frames(scene: &Scene, surface: &Surface, machine: &Plan) -> Result<Vec<Frame>> {
    let mut plain = edgewalk_golden::frame(scene, surface, Shading::Gouraud);
    met(&maps(&plain, machine)).context("--shadows map")?;
    let mut drawn: Vec<&SurfaceTriangle> = surface.triangles.iter().collect();
    if plain.blend != Blending::Off {
        let (sorted, order) = edgewalk_golden::sorted(plain, machine.subpixel_bits);
        plain = sorted;
        drawn = order.order.iter().map(|place| &surface.triangles[*place]).collect();
    }
    let parts: Vec<Gated> = drawn.iter().map(|triangle| Gated::new(scene, triangle)).collect();
    let colored = |part: &dyn Fn(&Gated) -> [DVec3; 3]| {
        let triangles = plain.triangles.iter().zip(&parts).map(|(triangle, gated)| {
            let mut corners = triangle.0;
            for (vertex, color) in corners.iter_mut().zip(part(gated)) {
                let [r, g, b] = color.clamp(DVec3::ZERO, DVec3::ONE).to_array();
                *vertex = Vertex { r, g, b, ..*vertex };
            }
            Triangle(corners)
        });
        triangles.collect::<Vec<_>>()
    };
    let mut frames = vec![Frame { triangles: colored(&|gated| gated.always), ..plain.clone() }];
    for (l, light) in scene.lights.iter().enumerate() {
        let (name, size) = (named(l, light), machine.shadow.size);
        let view = light.view(scene.mesh.positions(), size).ok_or_else(|| {
            anyhow!(
                "--shadows map: {name} needs six maps, and the machine looks up one; permitted: directional, flood with a cone of at most 60 degrees, or a light that sees the whole mesh within 70 degrees of an axis or of the mesh's middle; or draw with --engine golden"
            )
        })?;
        let shadow = shadow(scene, (surface, &drawn), &view, machine).with_context(|| name)?;
        let (shadows, triangles) = (vec![shadow], colored(&|gated| gated.lights[l]));
        frames.push(Frame { shadows, triangles, clear: [0.0; 3], ..plain.clone() });
    }
    Ok(frames)
}

/// The light in words, as it is counted.
fn named(place: usize, light: &Light) -> String {
    let kind = match light {
        Light::Directional { .. } => "directional",
        Light::Positional { .. } => "positional",
        Light::Flood { .. } => "flood",
    };
    format!("light {} ({kind})", place + 1)
}

/// The map of a light, and the way into it from each triangle in the order in which they are drawn.
fn shadow(
    scene: &Scene,
    (surface, drawn): (&Surface, &[&SurfaceTriangle]),
    view: &LightView,
    machine: &Plan,
) -> Result<Shadow> {
    let matrix = view
        .from_screen(&scene.camera, surface.width, surface.height)
        .ok_or_else(|| anyhow!("the camera's matrix is singular"))?;
    let points = |triangle: &Triangle| triangle.0.each_ref().map(|vertex| [vertex.x, vertex.y, vertex.z]);
    let [low, high] = scene.mesh.bounds();
    let slope = |triangle: &&SurfaceTriangle| {
        let face = &scene.mesh.faces()[triangle.face as usize];
        let corners = scene.mesh.corners(face);
        let rate = corners.into_iter().map(|corner| view.depth_rate(corner)).fold(0.0, f64::max);
        (view.depth_slope(corners) + BIAS_OF_BOX * (high - low).length() * rate).min(1.0)
    };
    let [opaque, panes] = view.triangles(&scene.mesh);
    Ok(Shadow {
        size: view.size(),
        bias: BIAS / f64::from((1u32 << machine.shadow.depth_bits) - 1),
        slopes: drawn.iter().map(slope).collect(),
        ambient: 0.0,
        matrix,
        triangles: opaque.iter().map(points).collect(),
        panes: panes.iter().map(|pane| Pane { corners: points(pane), kt: pane.0[0].kt }).collect(),
    })
}

/// The host adds the frames: in one colour memory what transmits would weaken the parts before it once more.
#[must_use]
pub fn are_added(frames: &[Frame]) -> bool {
    frames.iter().any(|frame| frame.passes().iter().any(|pass| pass.state.blend == Blending::Mix))
}

/// The frames as passes of one picture, of which nothing transmits light. All triangles of pass l lie as many LSB farther than those of the last as passes are to come, so
/// under `less` a pixel takes in each pass exactly the fragment that the first pass has left there.
///
/// # Errors
/// What of a frame the machine cannot take, and a depth for which these LSB leave no room.
pub fn in_passes(frames: &[Frame], machine: &Plan) -> Result<PortFrame> {
    let mut together: Option<PortFrame> = None;
    for (l, frame) in frames.iter().enumerate() {
        let mut port = to_port(frame, machine)?;
        let farther = (frames.len() - 1 - l) as i64;
        for (number, triangle) in port.triangles.iter_mut().enumerate() {
            for vertex in triangle {
                *vertex = moved(vertex, farther, machine).with_context(|| format!("triangle {number}"))?;
            }
        }
        let (lit, triangles) = (l > 0, port.triangles.len());
        let first = port.passes.first().map_or_else(DrawState::default, |pass| pass.state);
        let state = DrawState { blend_add: lit, shadow_on: lit, ..first };
        let pass = Pass { triangles, state, clear_depth: false, map: lit.then(|| l - 1) };
        match &mut together {
            None => together = Some(PortFrame { passes: vec![pass], ..port }),
            Some(all) => {
                all.triangles.append(&mut port.triangles);
                all.ids.append(&mut port.ids);
                all.lights.append(&mut port.lights);
                all.passes.push(pass);
            }
        }
    }
    together.ok_or_else(|| anyhow!("no frame"))
}

/// The vertex, so many LSB farther away.
fn moved(vertex: &PortVertex, farther: i64, machine: &Plan) -> Result<PortVertex> {
    let z = machine.channels()[0];
    let most = (z.limit() << z.vertex_fraction) as i64; // at most 48 bits
    let mut values = vertex.values()[..machine.channels().len()].to_vec();
    values[0] += farther << z.vertex_fraction;
    if values[0] > most {
        return Err(anyhow!(
            "a depth of {} LSB, at most {} of the farthest: passes of {farther} more lights want as many LSB; bring the camera's far plane farther away",
            (values[0] >> z.vertex_fraction) - farther,
            z.limit()
        ));
    }
    values.extend(machine.has_triangle_kt().then(|| i64::from(vertex.kt())));
    Ok(machine.raw_vertex(vertex.x(), vertex.y(), &values))
}

/// The sum of pictures, cut to 1, in the place of the first; their cycles are its passes.
#[must_use]
pub fn sum(pictures: &[Raster]) -> Option<Raster> {
    let (first, others) = pictures.split_first()?;
    let mut sum = first.clone();
    sum.passes = pictures.iter().filter_map(|picture| picture.cycles.clone()).collect();
    sum.cycles = sum.passes.iter().cloned().reduce(Cycles::and);
    sum.lights = pictures.iter().flat_map(|picture| picture.lights.iter().cloned()).collect();
    sum.corners = None;
    for picture in others {
        for (color, part) in sum.rgb.iter_mut().zip(&picture.rgb) {
            *color = std::array::from_fn(|channel| (color[channel] + part[channel]).min(1.0));
        }
    }
    Some(sum)
}
