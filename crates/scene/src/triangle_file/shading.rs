//! The lines `mode phong`, `mode fast-phong`, `view`, `ambient`, `sun`, `specular`, `material` and `N`:
//! shading at each pixel. Of a material's `texture` what it is a part of.

use crate::error::InputError;
use crate::frame::Frame;
use crate::light::Light;
use crate::mesh::Material;
use crate::pixel_shading::{PixelMethod, PixelShading, PixelTriangle, Viewer, unit};
use crate::rules::ShadeMode;
use crate::shading::Specular;
use crate::text::Place;
use crate::texture::Image;
use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::sync::Arc;

/// Brightest sun, and brightest ambient light.
pub(super) const MAX_INTENSITY: f64 = 100.0;

/// Sharpest highlight.
pub(super) const MAX_EXPONENT: f64 = 1024.0;

/// How far from 1 a normal's length may be; it is then brought to 1.
const LENGTH_SLACK: f64 = 0.01;

/// All that `mode` may say.
const MODES: [&str; 4] =
    [ShadeMode::NAMES[0], ShadeMode::NAMES[1], PixelMethod::NAMES[0], PixelMethod::NAMES[1]];

/// What to write for shading at each pixel to be on.
pub(super) const NEEDS_MODE: &str =
    "permitted only with `mode phong` or `mode fast-phong` before the first triangle";

/// What the header has said so far of shading at each pixel.
#[derive(Default)]
pub(super) struct Header {
    method: Option<PixelMethod>,
    /// The first line that only such a mode has, by its word and place.
    used: Option<(&'static str, usize)>,
    view: Option<DVec3>,
    /// I_a; 1 if the file does not say it.
    ambient: Option<f64>,
    suns: Vec<Light>,
    specular: Option<Specular>,
    /// Of the triangles to come, none of which has come.
    material: Option<Material>,
    /// Texture of the material.
    texture: Option<Arc<Image>>,
    /// Place of each material that a triangle has, by the bits of its numbers and its texture.
    places: HashMap<([u64; 4], Option<Arc<Image>>), u32>,
    /// Place of the material of the triangles to come.
    current: Option<u32>,
}

impl Header {
    /// The word behind `mode`.
    pub fn mode<'a>(
        &mut self,
        place: Place,
        words: impl Iterator<Item = &'a [u8]>,
        frame: &mut Frame,
    ) -> Result<(), InputError> {
        let [mode] = place.values("mode", "M", words)?;
        let mode = place.choice("mode", mode, &MODES)?;
        match mode.checked_sub(ShadeMode::ALL.len()) {
            None => frame.mode = ShadeMode::ALL[mode],
            Some(method) => self.method = Some(PixelMethod::ALL[method]),
        }
        Ok(())
    }

    /// A line `view`, `ambient`, `sun` or `specular`.
    pub fn line<'a>(
        &mut self,
        place: Place,
        name: &'static str,
        words: impl Iterator<Item = &'a [u8]>,
    ) -> Result<(), InputError> {
        self.used.get_or_insert((name, place.line));
        match name {
            "view" => self.view = Some(direction(place, name, place.values(name, "x y z", words)?)?),
            "ambient" => {
                let [i] = place.values(name, "i", words)?;
                self.ambient = Some(place.number(name, i, "a number", 0.0..=MAX_INTENSITY)?);
            }
            "sun" => {
                let [x, y, z, i] = place.values(name, "x y z i", words)?;
                let toward = direction(place, name, [x, y, z])?;
                let intensity = place.number("sun i", i, "a number", 0.0..=MAX_INTENSITY)?;
                self.suns.push(Light::Directional { toward, intensity: DVec3::splat(intensity) });
            }
            _ => {
                let [form] = place.values(name, "F", words)?;
                let form = place.choice(name, form, &PixelShading::FORM_NAMES)?;
                self.specular = Some(PixelShading::FORMS[form]);
            }
        }
        Ok(())
    }

    /// A line `material`, also between triangles.
    pub fn material<'a>(
        &mut self,
        place: Place,
        words: impl Iterator<Item = &'a [u8]>,
        behind: Option<&Frame>,
    ) -> Result<(), InputError> {
        self.used.get_or_insert(("material", place.line));
        if behind.is_some_and(|frame| frame.shading.is_none()) {
            return Err(place.fault("line starts with", b"material", NEEDS_MODE).into());
        }
        let words: [&[u8]; 4] = place.values("material", "ka kd ks n", words)?;
        let mut numbers = [0.0; 4];
        for (at, (number, word)) in numbers.iter_mut().zip(words).enumerate() {
            let (name, range) =
                [("ka", 0.0..=1.0), ("kd", 0.0..=1.0), ("ks", 0.0..=1.0), ("n", 1.0..=MAX_EXPONENT)][at]
                    .clone();
            *number = place.number(format_args!("material {name}"), word, "a number", range)?;
        }
        let [ka, kd, ks, exponent] = numbers;
        let [ambient, specular] = [ka, ks].map(DVec3::splat);
        self.material = Some(Material { ambient, specular, exponent, ..Material::matte(DVec3::splat(kd)) });
        self.texture = None;
        Ok(())
    }

    /// Where the picture of a line `texture` goes: it is that of the material before it.
    pub fn texture(
        &mut self,
        place: Place,
        behind: Option<&Frame>,
    ) -> Result<&mut Option<Arc<Image>>, InputError> {
        self.used.get_or_insert(("texture", place.line));
        if behind.is_some_and(|frame| frame.shading.is_none()) {
            return Err(place.fault("line starts with", b"texture", NEEDS_MODE).into());
        }
        if self.material.is_none() || self.texture.is_some() {
            let why = "permitted once behind a line `material ka kd ks n`, before its first triangle";
            return Err(place.fault("line starts with", b"texture", why).into());
        }
        Ok(&mut self.texture)
    }

    /// The header ends before the word `before`.
    pub fn end(&mut self, place: Place, before: &[u8], frame: &mut Frame) -> Result<(), InputError> {
        let Some(method) = self.method else {
            return match self.used {
                Some((name, line)) => {
                    Err(Place { line, ..place }.fault("line starts with", name.as_bytes(), NEEDS_MODE).into())
                }
                None => Ok(()),
            };
        };
        let Some(view) = self.view else {
            let why =
                format!("`view x y z`, the way to the viewer, is missing; `mode {}` needs it", method.name());
            return Err(place.fault("view", before, why).into());
        };
        frame.shading = Some(PixelShading {
            method,
            viewer: Viewer::Toward(view),
            ambient: DVec3::splat(self.ambient.unwrap_or(1.0)),
            lights: std::mem::take(&mut self.suns),
            specular: self.specular.unwrap_or(Specular::Halfway),
            materials: Vec::new(),
            textures: Vec::new(),
            triangles: Vec::new(),
        });
        Ok(())
    }

    /// A triangle has come; its normals are still to come, and where it lies in its texture if this is true.
    pub fn triangle(&mut self, place: Place, shading: &mut PixelShading) -> Result<bool, InputError> {
        if let Some(material) = self.material.take() {
            // Two lines with the same numbers and the same texture are one material: a machine has tables for few.
            let numbers = [material.ambient.x, material.diffuse.x, material.specular.x, material.exponent];
            let key = (numbers.map(f64::to_bits), self.texture.take());
            let place = self.places.entry(key).or_insert_with_key(|(_, picture)| {
                // A file has fewer lines than 2^32: each takes 32 bytes in memory.
                let texture = picture.is_some().then_some(shading.textures.len() as u32);
                shading.textures.extend(picture.clone());
                shading.materials.push(Material { texture, ..material });
                shading.materials.len() as u32 - 1 // likewise
            });
            self.current = Some(*place);
        }
        let Some(material) = self.current else {
            let why = "`material ka kd ks n` is missing; it must come before the first triangle";
            return Err(place.fault("material", b"T", why).into());
        };
        shading.triangles.push(PixelTriangle {
            normals: [DVec3::ZERO; 3],
            positions: [DVec3::ZERO; 3],
            texture: [DVec2::ZERO; 3],
            turns: [DVec3::ZERO; 2],
            material,
        });
        Ok(shading.materials[material as usize].texture.is_some())
    }
}

/// What stands behind `N`.
const VALUES: &str = "nx ny nz of vertex 1, then of 2, then of 3";

/// The numbers behind `N` into the triangle that is open, if one is.
pub(super) fn normals<'a>(
    place: Place,
    words: impl Iterator<Item = &'a [u8]>,
    open: bool,
    shading: Option<&mut PixelShading>,
) -> Result<(), InputError> {
    let Some(shading) = shading else {
        return Err(place.fault("line starts with", b"N", NEEDS_MODE).into());
    };
    let Some(triangle) = shading.triangles.last_mut().filter(|_| open) else {
        return Err(place.fault("line starts with", b"N", "permitted once, behind a triangle `T`").into());
    };
    let words: [&[u8]; 9] = place.values("N", VALUES, words)?;
    for (vertex, (slot, words)) in triangle.normals.iter_mut().zip(words.chunks_exact(3)).enumerate() {
        let key = format!("N vertex {}", vertex + 1);
        let normal = vector(place, &key, words)?;
        let nearest = unit(normal);
        *slot = nearest.filter(|_| (normal.length() - 1.0).abs() <= LENGTH_SLACK).ok_or_else(|| {
            let nearest =
                nearest.map_or_else(String::new, |n| format!("; the nearest is {} {} {}", n.x, n.y, n.z));
            let why = format!("permitted: a vector of length 1, to within {LENGTH_SLACK}{nearest}");
            place.fault(&key, words.join(&b' ').as_slice(), why)
        })?;
    }
    Ok(())
}

/// The triangle of this line has no normals, and `before` comes.
pub(super) fn missing(place: Place, before: &[u8], line: usize) -> InputError {
    let why = format!("the `N` of the triangle in line {line} is missing; permitted: 9 values, {VALUES}");
    place.fault("N", before, why).into()
}

/// A polygon or line where pixels are shaded.
pub(super) fn polygon(place: Place, key: &str, method: PixelMethod) -> InputError {
    let what = if key == "S" { "lines" } else { "polygons" };
    let why = format!("{what} have no `N`; permitted with `mode {}`: only triangles", method.name());
    place.fault("line starts with", key.as_bytes(), why).into()
}

/// A unit vector from one of any length.
fn direction(place: Place, key: &str, words: [&[u8]; 3]) -> Result<DVec3, InputError> {
    unit(vector(place, key, &words)?).ok_or_else(|| {
        let why = "permitted: a vector with a direction, as `0 0 1`";
        place.fault(key, words.join(&b' ').as_slice(), why).into()
    })
}

fn vector(place: Place, key: &str, words: &[&[u8]]) -> Result<DVec3, InputError> {
    let mut vector = DVec3::ZERO;
    for (axis, word) in words.iter().enumerate() {
        vector[axis] = place.finite(format_args!("{key} {}", ["x", "y", "z"][axis]), word)?;
    }
    Ok(vector)
}
