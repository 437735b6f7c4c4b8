//! A light on the machine: where each vertex lies in its map, and the map, drawn by the machine with the map for a screen.
//!
//! ```text
//!  L lines ──> machine of SIZE x SIZE, z of bz bits ──> depths ──> words of the map
//!  matrix, BIAS, vertex ──> lx, ly in texels, lz in 2^-bz ──> port
//! ```

use anyhow::{Context as _, Result, anyhow};
use edgewalk_golden::snap;
use edgewalk_machine::{Gate, Machine, Plan, Precision};
use edgewalk_model::{Counters, DrawState, Waits};
use edgewalk_scene::{Blending, Frame, Shadow, Vertex};

/// The largest depth of a map, which stands for 1.
fn farthest(machine: &Plan) -> f64 {
    f64::from((1u32 << machine.shadow.depth_bits) - 1)
}

/// Whether the machine can do the light.
///
/// # Errors
/// That, with what to set instead.
pub fn check(shadow: &Shadow, machine: &Plan) -> Result<()> {
    if !machine.shadow.is_there() {
        return Err(anyhow!(
            "shadow: the machine has no SHADOW; add --set shadow.light=parallel --set shadow.size={}, or draw with --engine golden",
            shadow.size
        ));
    }
    if shadow.size != machine.shadow.size {
        let (given, own) = (shadow.size, machine.shadow.size);
        return Err(anyhow!(
            "shadow {given}: the machine's map has {own} x {own} texels; add --set shadow.size={given}"
        ));
    }
    let [q0, q1, q2, q3] = shadow.matrix[3];
    if [q0, q1, q2] != [0.0; 3] || q3 <= 0.0 {
        return Err(anyhow!(
            "shadow: m30 m31 m32 m33 = {q0} {q1} {q2} {q3}: the machine's light is parallel, which has 0 0 0 and more than 0; draw with --engine golden"
        ));
    }
    if shadow.ambient > 0.0 && machine.shadow.gate == Gate::And {
        return Err(anyhow!(
            "shadow AMBIENT = {}: shadow.gate = and leaves nothing in shadow; add --set shadow.gate=scale",
            shadow.ambient
        ));
    }
    Ok(())
}

/// lx, ly and lz of a vertex as it is snapped; where no light is, zeros.
#[must_use]
pub fn values(shadow: Option<&Shadow>, vertex: &Vertex, machine: &Plan) -> [f64; 3] {
    let Some(shadow) = shadow else { return [0.0; 3] };
    let pixels = |c: f64| snap(c, machine.subpixel_bits) as f64 / f64::from(1u32 << machine.subpixel_bits);
    let point = [pixels(vertex.x), pixels(vertex.y), vertex.z, 1.0];
    let [x, y, z, q] = shadow.matrix.map(|row| (0..4).map(|k| row[k] * point[k]).sum::<f64>());
    [x / q, y / q, (z / q - shadow.bias) * farthest(machine)]
}

/// Whether the frame's picture can be judged beside golden's.
///
/// # Errors
/// Layers under a light's map.
pub fn judged(frame: &Frame) -> Result<()> {
    if frame.shadow.is_some() && (frame.passes().len() > 1 || frame.blend != Blending::Off) {
        return Err(anyhow!(
            "shadow: layers under a light's map are not compared with golden; draw with `edgewalk raster`"
        ));
    }
    Ok(())
}

/// AMBIENT as the gate multiplies by it.
#[must_use]
pub fn ambient(shadow: &Shadow, machine: &Plan) -> u64 {
    (shadow.ambient * machine.color.max() as f64).round_ties_even() as u64
}

/// A light's map, and what drawing it took.
pub struct Map {
    /// Its words, by address.
    pub words: Vec<u32>,
    /// Of the light's own pass.
    pub counters: Counters,
}

/// The machine that draws the map: the same with the map for a screen, depths of its bits, colours off.
///
/// # Errors
/// A map that is no screen.
pub fn mapper(machine: &Plan) -> Result<Plan> {
    let plain = Machine::default();
    let z = Precision { bits: machine.shadow.depth_bits, ..machine.z };
    let own = Machine {
        width: machine.shadow.size,
        height: machine.shadow.size,
        z,
        extra: 0,
        adders: 1,
        tag_bits: 0,
        ..(**machine).clone()
    };
    Ok(Machine { shadow: plain.shadow, blend: plain.blend, ..own }.plan()?)
}

/// The light's own pass: what it sees, on the machine with its map for a screen.
///
/// # Errors
/// A triangle of it that lies outside the guard band.
pub fn map(shadow: &Shadow, machine: &Plan) -> Result<Map> {
    let plan = mapper(machine)?;
    let mut triangles = Vec::with_capacity(shadow.triangles.len());
    for (number, corners) in shadow.triangles.iter().enumerate() {
        let mut port = [Default::default(); 3];
        for (slot, [x, y, z]) in port.iter_mut().zip(corners) {
            let vertex = plan.port_vertex(*x, *y, &[*z, 0.0, 0.0, 0.0]);
            *slot = vertex.with_context(|| format!("shadow: triangle {number} of the map"))?;
        }
        triangles.push(port);
    }
    let drawn = edgewalk_model::render(&plan, triangles, DrawState::default(), Waits::Never)?;
    let (size, side) = (shadow.size as usize, machine.shadow.side_bits());
    let mut map = vec![0; 1 << (2 * side)];
    for (place, depth) in drawn.z.iter().enumerate() {
        map[(place / size) << side | place % size] = *depth as u32; // at most 24 bits
    }
    Ok(Map { words: map, counters: drawn.counters })
}
