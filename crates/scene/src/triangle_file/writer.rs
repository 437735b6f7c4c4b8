//! Writes a triangle file; every number comes back bit for bit.

use super::shading::MAX_EXPONENT;
use super::{texture, unsaid};
use crate::frame::{Frame, Shadow};
use crate::light::Light;
use crate::mesh::Material;
use crate::pixel_shading::{PixelShading, PixelTriangle, Viewer};
use crate::polygon::Primitive;
use crate::rules::State;
use crate::vertex::{Triangle, Vertex};
use glam::DVec3;
use std::io::{self, Write};
use std::iter;

/// Writes `frame` as a triangle file.
///
/// # Errors
/// `out` fails; or, of the kind `Unsupported`, a file cannot say the frame's shading: the message says what of it.
pub fn write(frame: &Frame, mut out: impl Write) -> io::Result<()> {
    if let Some(shading) = &frame.shading {
        unsaid::check(shading)?;
    }
    writeln!(out, "size {} {}", frame.width, frame.height)?;
    match &frame.shading {
        Some(shading) => header(shading, &mut out)?,
        None => writeln!(out, "mode {}", frame.mode.name())?,
    }
    // What changes before the first primitive stands in the header, which has each rule once.
    let at_once = frame.changes.iter().take_while(|change| change.after == 0).last();
    let mut state = at_once.map_or(frame.state(), |change| change.state);
    rules(None, state, &mut out)?;
    let [r, g, b] = frame.clear;
    writeln!(out, "clear {r} {g} {b}")?;
    if frame.extra > 0 {
        writeln!(out, "extra {}", frame.extra)?;
    }
    for shadow in &frame.shadows {
        write_shadow(shadow, &mut out)?;
    }
    let mut material = None;
    let mut changes = frame.changes.iter().skip_while(|change| change.after == 0).peekable();
    for (place, primitive) in frame.primitives().into_iter().enumerate() {
        while let Some(change) = changes.next_if(|change| change.after <= place) {
            rules(Some(state), change.state, &mut out)?;
            state = change.state;
            if change.clear_depth {
                writeln!(out, "clear_depth")?;
            }
        }
        match primitive {
            Primitive::Triangle(triangle) => {
                // Without polygons the place is that among the triangles.
                let shaded = frame.shading.as_ref().map(|shading| (shading, shading.triangles[place]));
                if let Some((shading, own)) = shaded
                    && material.replace(own.material) != Some(own.material)
                {
                    let Material { ambient, diffuse, specular, exponent, .. } =
                        shading.materials[own.material as usize];
                    // Without a highlight its exponent says nothing.
                    let exponent =
                        if specular.x == 0.0 { exponent.clamp(1.0, MAX_EXPONENT) } else { exponent };
                    writeln!(out, "material {} {} {} {exponent}", ambient.x, diffuse.x, specular.x)?;
                    if let Some(image) = shading.texture(&own) {
                        texture::write(image, &mut out)?;
                    }
                }
                write!(out, "T")?;
                vertices(&triangle.0, &mut out)?;
                if frame.extra > 0 {
                    extra(triangle, frame.extra, &mut out)?;
                }
                if let Some((shading, own)) = shaded {
                    normals(shading, &own, &mut out)?;
                }
            }
            Primitive::Line(line) => {
                write!(out, "S")?;
                vertices(&line.ends, &mut out)?;
            }
            Primitive::Polygon(polygon) => {
                for (contour, key) in polygon.contours.iter().zip(iter::once("P").chain(iter::repeat("H"))) {
                    write!(out, "{key} {}", contour.len())?;
                    vertices(contour, &mut out)?;
                }
            }
        }
    }
    Ok(())
}

/// Mode, viewer and lights.
fn header(shading: &PixelShading, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "mode {}", shading.method.name())?;
    if let Viewer::Toward(view) = shading.viewer {
        writeln!(out, "view {} {} {}", view.x, view.y, view.z)?;
    }
    if shading.ambient != DVec3::ONE {
        writeln!(out, "ambient {}", shading.ambient.x)?;
    }
    for light in &shading.lights {
        if let Light::Directional { toward, intensity } = light {
            writeln!(out, "sun {} {} {} {}", toward.x, toward.y, toward.z, intensity.x)?;
        }
    }
    if let Some(form) = PixelShading::FORMS.iter().position(|form| *form == shading.specular) {
        writeln!(out, "specular {}", PixelShading::FORM_NAMES[form])?;
    }
    Ok(())
}

/// The rules that differ from those before; all that are not as usual if there are none before.
fn rules(before: Option<State>, now: State, out: &mut impl Write) -> io::Result<()> {
    let differs = |same: fn(&State, &State) -> bool| before.is_none_or(|before| !same(&before, &now));
    if differs(|a, b| a.depth == b.depth) {
        writeln!(out, "depth {}", now.depth.map_or("off", |func| func.name()))?;
    }
    if differs(|a, b| a.depth_write == b.depth_write) {
        writeln!(out, "depth_write {}", u8::from(now.depth_write))?;
    }
    if differs(|a, b| a.blend == b.blend) {
        writeln!(out, "blend {}", now.blend.name())?;
    }
    let usual = before.is_none() && now.color_write;
    if !usual && differs(|a, b| a.color_write == b.color_write) {
        writeln!(out, "colour_write {}", u8::from(now.color_write))?;
    }
    let usual = before.is_none() && now.light == 1;
    if !usual && differs(|a, b| a.light == b.light) {
        writeln!(out, "light {}", now.light)?;
    }
    Ok(())
}

/// The rest of a line.
fn vertices(list: &[Vertex], out: &mut impl Write) -> io::Result<()> {
    for v in list {
        write!(out, "  {} {} {} {} {} {} {}", v.x, v.y, v.z, v.r, v.g, v.b, v.kt)?;
    }
    writeln!(out)
}

/// The `X` line of a triangle.
fn extra(triangle: &Triangle, count: usize, out: &mut impl Write) -> io::Result<()> {
    write!(out, "X ")?;
    for vertex in &triangle.0 {
        for value in vertex.extra.iter().take(count) {
            write!(out, " {value}")?;
        }
        write!(out, " ")?;
    }
    writeln!(out)
}

/// The `N` line of a triangle, and with a texture the `UV` line.
fn normals(shading: &PixelShading, own: &PixelTriangle, out: &mut impl Write) -> io::Result<()> {
    write!(out, "N")?;
    for normal in own.normals {
        write!(out, "  {} {} {}", normal.x, normal.y, normal.z)?;
    }
    writeln!(out)?;
    if shading.texture(own).is_some() {
        write!(out, "UV")?;
        for place in own.texture {
            write!(out, "  {} {}", place.x, place.y)?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn write_shadow(shadow: &Shadow, out: &mut impl Write) -> io::Result<()> {
    write!(out, "shadow {} {} {}", shadow.size, shadow.bias, shadow.ambient)?;
    for [m0, m1, m2, m3] in shadow.matrix {
        write!(out, "  {m0} {m1} {m2} {m3}")?;
    }
    writeln!(out)?;
    let panes = shadow.panes.iter().map(|pane| (&pane.corners, Some(pane.kt)));
    for (corners, kt) in shadow.triangles.iter().map(|corners| (corners, None)).chain(panes) {
        write!(out, "L")?;
        for [x, y, z] in corners {
            write!(out, "  {x} {y} {z}")?;
        }
        if let Some(kt) = kt {
            write!(out, "  {kt}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}
