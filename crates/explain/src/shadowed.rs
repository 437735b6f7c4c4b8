//! What SHADOW makes of a pixel: where it lies in each light's view, exactly and on the machine, and what its texel says.

use super::additions::walk;
use super::state_of;
use anyhow::Result;
use edgewalk_host::light;
use edgewalk_host::vertices::port_triangle;
use edgewalk_machine::{EdgeKind, Fill, LIGHT_SPACE, Plan};
use edgewalk_model::project::quotients;
use edgewalk_scene::Frame;
use serde::Serialize;
use std::fmt::Write as _;

/// A pixel under a light.
#[derive(Debug, Serialize)]
pub struct ShadowedPixel {
    /// Number of the light, from 1.
    pub light: usize,
    /// Exact column and line, texels, and depth less the bias, LSB of the map; of what lies behind the light they mean nothing.
    pub exact: [f64; 3],
    /// q: not above 0 behind the light.
    pub weight: f64,
    /// lx, ly, lz and, of a perspective light, lw as PIXEL hands them on, LSB.
    pub values: Vec<i64>,
    /// Column and line of the texel, and the depth, as SHADOW takes them.
    pub found: [i64; 3],
    /// The depth that the map has there; none where no texel decides.
    pub word: Option<u32>,
    /// What is left there of the light, LSB of a colour, where the map says that.
    pub left: Option<u32>,
    /// Lit.
    pub lit: bool,
    /// What its colours are multiplied by, LSB of a colour.
    pub share: u64,
}

/// Pixel (x, y) of depth z, of triangle `id` of the frame, drawn by these rules; none without a light, and where the machine's way there is not
/// shown.
pub fn shadowed(
    frame: &Frame,
    machine: &Plan,
    id: usize,
    (x, y): (u32, u32),
    z: f64,
) -> Result<Option<ShadowedPixel>> {
    let state = state_of(frame, id);
    let (Some(shadow), Some(triangle)) = (frame.shadow(state.light), frame.triangle_at(id)) else {
        return Ok(None);
    };
    if !machine.shadow.is_there() || machine.fill != Fill::Exact || machine.edge_kind != EdgeKind::Exact {
        return Ok(None);
    }
    light::check(shadow, machine)?;
    let port = port_triangle(id, triangle, frame, &state, machine)?;
    let Some(walk) = walk(machine, &port, x, y) else { return Ok(None) };
    let light_space = |(channel, _): &(&edgewalk_machine::Channel, &i64)| LIGHT_SPACE.contains(&channel.name);
    let values = machine.channels().iter().zip(&walk.output).filter(light_space);
    let values: Vec<i64> = values.map(|(_, output)| *output).collect();
    let found = match values[..] {
        [x, y, z, w] => quotients(machine, [x, y, z, w]),
        [tx, ty, d] => [tx, ty, d],
        _ => return Ok(None),
    };
    let point = [f64::from(x) + 0.5, f64::from(y) + 0.5, z, 1.0];
    let [column, line, depth, q] = shadow.matrix.map(|row| (0..4).map(|k| row[k] * point[k]).sum::<f64>());
    let far = f64::from((1u32 << machine.shadow.depth_bits) - 1);
    let side = 0..i64::from(shadow.size);
    let [tx, ty, d] = found;
    let on_map = side.contains(&tx) && side.contains(&ty);
    let decides = on_map && (0..1i64 << machine.shadow.depth_bits).contains(&d);
    let word = match decides {
        true => {
            let words = light::map(shadow, machine)?.words;
            words.get((ty << machine.shadow.side_bits() | tx) as usize).copied()
        }
        false => None,
    };
    let (bits, all) = (machine.color.bits, machine.color.max());
    let (word, left) = match machine.shadow.transmits() {
        true => (word.map(|word| word >> bits), word.map(|word| word & all as u32)), // b <= 16 bits
        false => (word, None),
    };
    let lit = word.map_or(!on_map || d < 0, |word| d <= i64::from(word));
    let share = if lit { left.map_or(all, u64::from) } else { light::ambient(shadow, machine) };
    Ok(Some(ShadowedPixel {
        light: state.light,
        exact: [column / q, line / q, (depth / q - shadow.bias_of(id)) * far],
        weight: q,
        values,
        found,
        word,
        left,
        lit,
        share,
    }))
}

/// Like `shadowed`, in words.
pub fn text(pixel: &ShadowedPixel) -> String {
    let ShadowedPixel { light, exact: [x, y, z], weight, values, found: [tx, ty, d], word, left, lit, share } =
        pixel;
    let mut t = format!("\nlight {light}'s map: texel ({x:.6}, {y:.6}), depth {z:.6} LSB; q {weight:.6}\n");
    let named = LIGHT_SPACE.iter().zip(values).map(|(name, value)| format!("{name} {value}"));
    _ = writeln!(t, "  the machine: {}", named.collect::<Vec<_>>().join("  "));
    let stored = match word {
        Some(word) => format!("the map has {word}"),
        None => "no texel decides".to_owned(),
    };
    let answer = if *lit { "lit" } else { "in shadow" };
    let left = left.map_or_else(String::new, |left| format!(", and {left} is left of the light there"));
    _ = writeln!(t, "  texel ({tx}, {ty}), depth {d}; {stored}{left}: {answer}, share {share}");
    t
}
