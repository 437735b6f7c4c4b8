//! What the host sends to TERM, TEXEL and SHADE for a frame with normals: records of terms, tables and textures of materials, and what is proved
//! of the colours that come of them.
//!
//! ```text
//!  normals, lights, viewer ─six cosines a light─> exact fit ─RN in the middle of the box─> words ─moved─> Record
//!  materials, colours, intensities ─────────────────────────> tables of bins ─────────────> words of the tables
//!  pictures ────────────────────────────────────────────────> 2^τ x 2^τ texels ───────────> words of the textures
//! ```
//! Bounds 12 and 13 (`docs/numerics.md`) give the bound of a colour against golden's fast Phong, with bound 14 or 17 against its Phong.

mod apart;
mod bound;
mod lamp;
mod lights;
mod place;
mod records;
mod roots;
mod texels;
mod tables;
mod turns;

pub use apart::apart;
pub use bound::Proof;
pub use place::Place;
pub use records::IndexErrors;
pub use texels::Textured;

use anyhow::{Context as _, Result, anyhow};
use edgewalk_machine::{Fill, Plan, PortVertex, ShadeColour};
use edgewalk_model::Shading;
use edgewalk_scene::{Frame, PixelShading};
use glam::DVec3;
use lights::Lamp;
use tables::Surfaces;
use turns::Turns;

/// What the memories behind the machine hold, and what follows from it.
#[derive(Clone, Debug)]
pub struct Feed {
    /// The words.
    pub words: Shading,
    /// What is proved of the colours.
    pub proof: Proof,
    /// I_l of each light; of one for LAMP where it is brightest.
    pub intensities: Vec<DVec3>,
    surfaces: Surfaces,
}

impl Feed {
    /// m' of each light's table of highlights for a triangle.
    pub fn glosses(&self, triangle: usize) -> Vec<u32> {
        self.surfaces.glosses(self.surfaces.of_triangle[triangle])
    }
}

/// What a frame needs whose triangles are at the port, each with the place in the frame of what it is a part of; `None` where neither frame nor machine shades pixels.
///
/// # Errors
/// Only one of them does, or the machine cannot take the frame's lights or materials.
pub fn feed(
    frame: &Frame,
    (triangles, ids): (&[[PortVertex; 3]], &[i32]),
    machine: &Plan,
) -> Result<Option<Feed>> {
    let Some(shading) = shading_for(frame, machine)? else { return Ok(None) };
    let lamps = Lamp::all(shading, machine)?;
    let surfaces = Surfaces::of(frame, shading, &lamps, machine)?;
    let root_error = if machine.shade.normalises() { roots::relative_error() } else { 0.0 };
    let mut records = Vec::with_capacity(triangles.len());
    let mut errors = Vec::with_capacity(triangles.len());
    let mut textured = Vec::with_capacity(triangles.len());
    for (index, triangle) in triangles.iter().enumerate() {
        let own = &shading.triangles[ids[index] as usize];
        let surface = surfaces.of_triangle[ids[index] as usize];
        let glosses = surfaces.glosses(surface);
        let place = Place::of(machine, triangle);
        let texture = surfaces.textures[surface as usize].as_ref();
        let relief = texture.and_then(|texture| texture.relief.as_ref());
        let turns = relief.map(|relief| Turns::of(own, relief, shading, &lamps));
        let errors_of = (root_error, turns.as_ref());
        let (record, error) =
            records::record(place.as_ref(), own, shading, &lamps, (surface, &glosses), errors_of, machine)
                .with_context(|| format!("triangle {index}"))?;
        let flattened = turns.is_some_and(|turns| turns.flattened);
        let of = |place: Place| Textured::new(&place, own, (texture, flattened), &record.terms, machine);
        textured.push(place.and_then(of));
        records.push(record);
        errors.push(error);
    }
    let roots = match lamps.first().and_then(|lamp| lamp.point.as_ref()) {
        Some(point) => point.words(machine),
        None if machine.shade.has_normal() => roots::words(machine),
        None => Vec::new(),
    };
    let textures = texels::words(&surfaces.textures, machine)?;
    let proof = Proof::new(machine, &surfaces, errors, textured);
    Ok(Some(Feed {
        words: Shading { records, tables: surfaces.words(machine), roots, textures },
        proof,
        intensities: lamps.iter().map(|lamp| lamp.intensity).collect(),
        surfaces,
    }))
}

/// How the frame is shaded at each pixel, if it is.
///
/// # Errors
/// The machine, which meets the [needs](crate::needs) of the frame, cannot do so.
pub(crate) fn shading_for<'a>(frame: &'a Frame, machine: &Plan) -> Result<Option<&'a PixelShading>> {
    let Some(shading) = &frame.shading else { return Ok(None) };
    if machine.fill == Fill::Textbook {
        let name = shading.method.name();
        return Err(anyhow!("mode {name}: edge.fill = textbook starts spans between pixels; use exact"));
    }
    Ok(Some(shading))
}

/// Whether the surface's colour is multiplied in at each pixel.
fn multiplies(machine: &Plan) -> bool {
    machine.shade.colour == ShadeColour::Multiply
}
