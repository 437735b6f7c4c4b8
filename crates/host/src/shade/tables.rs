//! The materials of a frame as the machine's tables hold them: one for each surface that is shaded differently.

use super::lights::Lamp;
use super::multiplies;
use super::texels::Texture;
use crate::advice::OR_GOLDEN;
use anyhow::{Result, anyhow};
use edgewalk_machine::{Entry, Plan};
use edgewalk_numerics::index_table::{Diffuse, Highlight, IndexTable};
use edgewalk_scene::{Frame, Material, PixelShading, Specular, Triangle};
use glam::DVec3;
use std::collections::HashMap;

/// The most that `shade.material_bits` may be.
const MAX_MATERIAL_BITS: u32 = 8;

/// The tables of a light for a surface.
#[derive(Clone, Debug)]
pub struct LightTables {
    /// Of red, green and blue; with `multiply` of the light alone, one.
    pub diffuse: Vec<IndexTable<Diffuse>>,
    /// Of the highlight.
    pub highlight: IndexTable<Highlight>,
}

/// The surfaces of a frame.
#[derive(Clone, Debug)]
pub struct Surfaces {
    /// By triangle the number of its surface.
    pub of_triangle: Vec<u32>,
    /// The largest of its colours at a vertex, 0 to 1.
    pub brightest: Vec<f64>,
    /// By surface and light.
    pub tables: Vec<Vec<LightTables>>,
    /// By surface.
    pub textures: Vec<Option<Texture>>,
}

impl Surfaces {
    /// The surfaces of the frame, in the order in which they first appear.
    ///
    /// # Errors
    /// What the machine's tables cannot hold.
    pub fn of(frame: &Frame, shading: &PixelShading, lamps: &[Lamp], machine: &Plan) -> Result<Surfaces> {
        let mut numbers = HashMap::new();
        let mut surfaces = Surfaces {
            of_triangle: Vec::new(),
            brightest: Vec::new(),
            tables: Vec::new(),
            textures: Vec::new(),
        };
        for (triangle, own) in frame.triangles.iter().zip(&shading.triangles) {
            let color = if multiplies(machine) { DVec3::ONE } else { one_color(triangle) };
            let key = (own.material, color.to_array().map(f64::to_bits));
            let next = numbers.len() as u32;
            let number = *numbers.entry(key).or_insert(next);
            if number == next {
                let material = shading.material(own, color);
                surfaces.tables.push(light_tables(&material, shading, lamps, machine)?);
                let pictures = [shading.texture(own), shading.relief(own)];
                surfaces.textures.push(Texture::new(pictures, machine));
            }
            surfaces.of_triangle.push(number);
            surfaces.brightest.push(triangle.0.iter().fold(0.0, |most, v| v.r.max(v.g).max(v.b).max(most)));
        }
        let most = 1usize << machine.shade.material_bits;
        if surfaces.tables.len() > most {
            let bits = surfaces.tables.len().next_power_of_two().ilog2();
            let larger = match bits <= MAX_MATERIAL_BITS {
                true => format!("--set shade.material_bits={bits} or "),
                false => String::new(),
            };
            return Err(anyhow!(
                "{} surfaces that differ in material or colour: the machine has tables for {most}, with \
                 shade.material_bits={MAX_MATERIAL_BITS} for {}; add {larger}--set shade.colour=multiply",
                surfaces.tables.len(),
                1u32 << MAX_MATERIAL_BITS
            ));
        }
        Ok(surfaces)
    }

    /// m' of each light's table of highlights.
    pub fn glosses(&self, surface: u32) -> Vec<u32> {
        self.tables[surface as usize].iter().map(|light| light.highlight.function().gloss).collect()
    }

    /// The words of the memory of the tables.
    pub fn words(&self, machine: &Plan) -> Vec<u128> {
        let mut words = vec![0; 1usize << (machine.shade.material_bits + machine.shade.entry_bits())];
        for (material, lights) in (0..).zip(&self.tables) {
            for (light, tables) in (0..).zip(lights) {
                for (at, highlight) in (0..).zip(tables.highlight.entries()) {
                    let part = |k: usize| tables.diffuse[k].entries()[at as usize];
                    let entry = match multiplies(machine) {
                        true => Entry::Light(part(0), *highlight),
                        false => Entry::Colours([part(0), part(1), part(2)], *highlight),
                    };
                    words[machine.table_place(material, light, at)] = machine.table_word(entry);
                }
            }
        }
        words
    }
}

/// The colour that a table can hold: that of all vertices.
fn one_color(Triangle([v, ..]): &Triangle) -> DVec3 {
    DVec3::new(v.r, v.g, v.b)
}

/// The tables of a material already multiplied with its colour; ambient light is in those of the first light.
fn light_tables(
    material: &Material,
    shading: &PixelShading,
    lamps: &[Lamp],
    machine: &Plan,
) -> Result<Vec<LightTables>> {
    let (bits, max) = (machine.shade.table_bits, machine.color.max() as f64);
    let multiply = multiplies(machine);
    let ambient = material.emission + material.ambient * shading.ambient;
    if multiply && material.emission != DVec3::ZERO {
        return Err(anyhow!(
            "emission: shade.colour = multiply has no light that colour does not multiply; take tables"
        ));
    }
    let brightest =
        lamps.iter().fold(ambient, |sum, lamp| sum + material.diffuse * lamp.intensity).max_element();
    if multiply && brightest > 1.0 {
        return Err(anyhow!(
            "ambient and diffuse light come to {brightest} together: with shade.colour = multiply it is at most 1, the colour itself; \
             take weaker lights or shade.colour = tables"
        ));
    }
    let one = if multiply { f64::from(1u32 << (machine.color.bits + 2)) } else { max };
    let table = |light: usize| {
        let lamp = lamps.get(light);
        let intensity = lamp.map_or(DVec3::ZERO, |lamp| lamp.intensity);
        let base = if light == 0 { ambient } else { DVec3::ZERO };
        let slope = material.diffuse * intensity;
        let channels = if multiply { 1 } else { 3 };
        if multiply {
            grey(base, "ambient light", "; take shade.colour = tables")?;
            grey(slope, "diffuse light", "; take shade.colour = tables")?;
        }
        let diffuse = |k: usize| {
            IndexTable::from_least(
                bits,
                Diffuse { bits, base: base[k] * one, slope: slope[k] * one, most: one },
            )
        };
        let top = grey(material.specular * intensity, "highlight", OR_GOLDEN)? * max;
        if machine.shade.is_positional() && top > max * (1.0 + 1e-12) {
            return Err(anyhow!(
                "a highlight of {} where the light is brightest: with shade.light = positional it is at most 1, for it is weakened behind its \
                 table; take a weaker light, or a material that shines less",
                top / max
            ));
        }
        let highlight = Highlight {
            bits,
            gloss: 0,
            exponent: material.exponent,
            doubled: shading.specular != Specular::Blinn,
            top,
            most: max,
        };
        Ok(LightTables {
            diffuse: (0..channels).map(diffuse).collect(),
            highlight: highlight.sharpest(machine.shade.gloss_bits),
        })
    };
    let mut lights: Vec<LightTables> =
        (0..machine.shade.lights as usize).map(table).collect::<Result<_>>()?;
    if machine.shade.normalises() && lights.len() == 2 {
        // A record has one m' for both: the one with which the worse of them is least.
        let at = |gloss: u32| {
            let of = |light: &LightTables| {
                IndexTable::new(bits, Highlight { gloss, ..*light.highlight.function() })
            };
            [of(&lights[0]), of(&lights[1])]
        };
        let error = |tables: &[IndexTable<Highlight>; 2]| tables[0].error(0.0).max(tables[1].error(0.0));
        let best = (1..=machine.shade.gloss_bits)
            .map(at)
            .fold(at(0), |best, next| if error(&next) < error(&best) { next } else { best });
        for (light, highlight) in lights.iter_mut().zip(best) {
            light.highlight = highlight;
        }
    }
    Ok(lights)
}

/// The one number of a light that the machine has one table for.
fn grey(light: DVec3, what: &str, remedy: &str) -> Result<f64> {
    if light.max_element() - light.min_element() > 1e-12 {
        let [r, g, b] = light.to_array();
        return Err(anyhow!(
            "{what} {r} {g} {b}: the machine has one table for all colours, so it must be grey{remedy}"
        ));
    }
    Ok(light.x)
}
