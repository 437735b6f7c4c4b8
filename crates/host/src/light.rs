//! A light on the machine: where each vertex lies in its map, and the map, drawn by a machine with the map for a screen, or by the machine itself
//! in the light's own pass.
//!
//! ```text
//!  L lines ──> machine of SIZE x SIZE, z of bz bits ──> depths ───────────────────────┬──> words of the map
//!  those with k_t ──> the same behind those depths, BLEND of AMBIENT over white ──> k ┘
//!  matrix, BIAS, vertex ──> parallel: lx, ly in texels, lz in 2^-bz ──────────────────> port
//!                      └──> perspective: (X/2^SB, Y/2^SB, Z - BIAS W, W) times 2^k ──> port
//! ```
//! 2^k is of the triangle, so that its numbers fill their words; what PROJECT divides does not see it.

use crate::advice::OR_GOLDEN;
use anyhow::{Context as _, Result, anyhow};
use edgewalk_golden::snap;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{Blend, BlendKind, Machine, Plan, PortVertex, Precision};
use edgewalk_model::{Counters, DrawState, Pass, Shading, Waits, render_passes};
use edgewalk_scene::{Blending, Change, Frame, Shadow, State, Triangle, Vertex};

/// The largest depth of a map, which stands for 1.
fn farthest(machine: &Plan) -> f64 {
    f64::from((1u32 << machine.shadow.depth_bits) - 1)
}

/// Whether a map of the machine, which meets the [needs](crate::needs) of its frame, can be that of the light.
///
/// # Errors
/// What no key can mend.
pub fn check(shadow: &Shadow, machine: &Plan) -> Result<()> {
    let (given, own) = (shadow.size, machine.shadow.size);
    let side = KEYS.iter().find(|key| key.name == "shadow.size" && key.parse(&given.to_string()).is_none());
    if let Some(key) = side {
        return Err(anyhow!(
            "shadow {given}: a machine's map has {} texels a side; give the shadow such a size{OR_GOLDEN}",
            key.permitted()
        ));
    }
    if given != own {
        return Err(anyhow!(
            "shadow {given}: another light's map has {own} x {own} texels, and the machine's maps are alike; give all lights one SIZE{OR_GOLDEN}"
        ));
    }
    if shadow.matrix[3] == [0.0; 4] {
        return Err(anyhow!(
            "shadow: m30 m31 m32 m33 = 0 0 0 0: every point lies at infinity; a parallel light has 0 0 0 1"
        ));
    }
    Ok(())
}

/// The light-space values of the vertices of the triangle at this place as they are snapped, by vertex, in the order of their channels; where no
/// light is, zeros.
///
/// # Errors
/// Of a perspective light, numbers beyond all scale.
pub fn values(
    shadow: Option<&Shadow>,
    place: usize,
    vertices: &[Vertex; 3],
    machine: &Plan,
) -> Result<[Vec<f64>; 3]> {
    let channels = machine.shadow.channels().len();
    let Some(shadow) = shadow else { return Ok([(); 3].map(|()| vec![0.0; channels])) };
    let (seen, bias) =
        (vertices.each_ref().map(|vertex| seen(shadow, vertex, machine)), shadow.bias_of(place));
    if !machine.shadow.projects() {
        let far = farthest(machine);
        return Ok(seen.map(|[x, y, z, q]| vec![x / q, y / q, (z / q - bias) * far]));
    }
    let divided = seen.map(|seen| divided(bias, seen, machine));
    let scale = scale_of(&divided, machine)?;
    Ok(divided.map(|values| values.map(|value| value * scale).to_vec()))
}

/// 2^k of the triangle at this place under a perspective light: with it the largest magnitude of its twelve values comes to more
/// than half of what a vertex may have.
///
/// # Errors
/// There is none, as numbers are too large or too small.
pub fn scale(shadow: &Shadow, place: usize, vertices: &[Vertex; 3], machine: &Plan) -> Result<f64> {
    let bias = shadow.bias_of(place);
    scale_of(
        &vertices.each_ref().map(|vertex| divided(bias, seen(shadow, vertex, machine), machine)),
        machine,
    )
}

fn scale_of(values: &[[f64; 4]; 3], machine: &Plan) -> Result<f64> {
    let largest = values.iter().flatten().fold(0.0f64, |most, value| most.max(value.abs()));
    let most = f64::from((1u32 << machine.shadow.light_bits) - 1);
    // Beyond, 2^k and what it scales would lose bits.
    if !(1e-200..1e200).contains(&largest) {
        return Err(anyhow!(
            "shadow: the matrix takes a vertex to numbers of {largest:e}; permitted: 1e-200 to 1e200; scale the matrix"
        ));
    }
    let guess = 2f64.powi((most / largest).log2().floor() as i32);
    Ok(if guess * largest > most { guess / 2.0 } else { guess })
}

/// (X, Y, Z, q) of a vertex as it is snapped.
fn seen(shadow: &Shadow, vertex: &Vertex, machine: &Plan) -> [f64; 4] {
    let pixels = |c: f64| snap(c, machine.subpixel_bits) as f64 / f64::from(1u32 << machine.subpixel_bits);
    let point = [pixels(vertex.x), pixels(vertex.y), vertex.z, 1.0];
    shadow.matrix.map(|row| (0..4).map(|k| row[k] * point[k]).sum())
}

/// What PROJECT divides, before its scale: quotients below 1 lie on the map.
fn divided(bias: f64, [x, y, z, q]: [f64; 4], machine: &Plan) -> [f64; 4] {
    let side = f64::from(1u32 << machine.shadow.side_bits());
    let depth = (z - bias * q) * farthest(machine) / (farthest(machine) + 1.0);
    [x / side, y / side, depth, q]
}

/// AMBIENT as the gate multiplies by it.
#[must_use]
pub fn ambient(shadow: &Shadow, machine: &Plan) -> u64 {
    (shadow.ambient * machine.color.max() as f64).round_ties_even() as u64
}

/// Bound 15: what the share that so many panes leave of a light may be off, LSB of `bits` bits, with k_t of `kt_bits` bits, where the
/// machine's grey of AMBIENT is off by `grey`.
#[must_use]
pub fn left_error(panes: u32, bits: u32, kt_bits: u32, grey: f64) -> f64 {
    let each = 0.5 + (f64::from(bits).exp2() - 1.0) * (-1.0 - f64::from(kt_bits)).exp2();
    grey + f64::from(panes) * each
}

/// A light's map, and what drawing it took.
pub struct Map {
    /// Words of the map, by address.
    pub words: Vec<u32>,
    /// Of the light's own pass.
    pub counters: Counters,
    /// Where the machine draws the map itself, what it is sent.
    pub own: Option<Sent>,
}

/// What is sent for a map to be drawn: what hides the light, and in a map with shares what transmits it.
pub struct Sent {
    /// The triangles at the port.
    pub triangles: Vec<[PortVertex; 3]>,
    /// One after the other; the map is cleared before the first.
    pub passes: Vec<Pass>,
}

/// The machine that draws the map: the same with the map for a screen, depths of its bits; with BLEND where it draws shares too.
///
/// # Errors
/// A map that is no screen.
pub fn mapper(machine: &Plan) -> Result<Plan> {
    let plain = Machine::default();
    let z = Precision { bits: machine.shadow.depth_bits, ..machine.z };
    let blend = match machine.shadow.transmits() {
        true => Blend { kind: BlendKind::Constant, ..machine.blend },
        false => plain.blend,
    };
    // What the machine draws itself needs the formats only.
    let segments = if machine.shadow.draws_map() { 1 } else { machine.segments };
    let mapper = machine.with(|keys| {
        (keys.width, keys.height) = (machine.shadow.size, machine.shadow.size);
        (keys.z, keys.dither, keys.blend, keys.shadow) = (z, plain.dither, blend, plain.shadow);
        (keys.extra, keys.adders, keys.segments, keys.tag_bits) = (0, 1, segments, 0);
    });
    Ok(mapper.plan()?)
}

/// The light's own passes as a frame: what hides the light, then, in a machine whose map has shares, the panes, of which each leaves k_t of
/// what is there and (1 - k_t) of AMBIENT as the gate has it.
#[must_use]
pub fn own_frame(shadow: &Shadow, machine: &Plan) -> Frame {
    let grey = ambient(shadow, machine) as f64 / machine.color.max() as f64;
    let triangle = |corners: [[f64; 3]; 3], kt: f64| {
        Triangle(corners.map(|[x, y, z]| Vertex {
            x,
            y,
            z,
            r: grey,
            g: grey,
            b: grey,
            kt,
            ..Vertex::default()
        }))
    };
    let opaque = shadow.triangles.iter().map(|corners| triangle(*corners, 0.0));
    let panes = shadow.panes.iter().map(|pane| triangle(pane.corners, pane.kt));
    let plain = Frame::new(shadow.size, shadow.size);
    if !machine.shadow.transmits() {
        return Frame { triangles: opaque.collect(), ..plain };
    }
    let state = State { depth_write: false, blend: Blending::Mix, ..plain.state() };
    let changes = vec![Change { after: shadow.triangles.len(), state, clear_depth: false }];
    Frame { triangles: opaque.chain(panes).collect(), clear: [1.0; 3], color_write: false, changes, ..plain }
}

/// The light's own passes: what it sees, on the machine with its map for a screen, or on the machine itself.
///
/// # Errors
/// A triangle of it that lies outside the guard band.
pub fn map(shadow: &Shadow, machine: &Plan) -> Result<Map> {
    let plan = mapper(machine)?;
    let sent = sent(shadow, machine, &plan)?;
    let drawn = |plan| {
        let triangles = sent.triangles.iter().copied();
        render_passes(plan, triangles, &sent.passes, &[], Waits::Never, &Shading::default())
    };
    if machine.shadow.draws_map() {
        let mut drawn = drawn(machine)?;
        let words = drawn.maps.pop().context("the light's own pass draws a map")?;
        return Ok(Map { words, counters: drawn.counters, own: Some(sent) });
    }
    let drawn = drawn(&plan)?;
    let (size, side) = (shadow.size as usize, machine.shadow.side_bits());
    let mut map = vec![0; 1 << (2 * side)];
    for (place, (depth, [left, ..])) in drawn.z.iter().zip(&drawn.rgb).enumerate() {
        let transmits = machine.shadow.transmits();
        let word = if transmits { (depth << machine.color.bits) | left } else { *depth };
        map[((place / size) << side) | (place % size)] = word as u32; // at most 32 bits
    }
    Ok(Map { words: map, counters: drawn.counters, own: None })
}

/// Triangles and passes for the second machine, or for the machine that draws its map.
fn sent(shadow: &Shadow, machine: &Plan, second: &Plan) -> Result<Sent> {
    let frame = own_frame(shadow, machine);
    let own = machine.shadow.draws_map();
    let mut triangles = Vec::with_capacity(frame.triangles.len());
    for (number, Triangle(corners)) in frame.triangles.iter().enumerate() {
        let mut port = [PortVertex::default(); 3];
        for (slot, v) in port.iter_mut().zip(corners) {
            let mut values = vec![v.z, v.r, v.g, v.b];
            values.extend(second.has_triangle_kt().then_some(v.kt));
            let vertex = second.port_vertex(v.x, v.y, &values);
            let vertex = vertex.with_context(|| format!("shadow: triangle {number} of the map"))?;
            *slot = if own { own_vertex(&vertex, machine) } else { vertex };
        }
        triangles.push(if own { machine.windowed(port) } else { port });
    }
    let (transmits, opaque) = (machine.shadow.transmits(), shadow.triangles.len());
    let hides = DrawState {
        light_pass: own,
        // A map that the machine draws has a page of colours only as the plane of k.
        color_write: !transmits && !own,
        clear: frame.clear.map(|share| (share * second.stored_color().max() as f64) as u64),
        ..DrawState::default()
    };
    let panes = DrawState { depth_write: false, color_write: true, ..hides };
    let pass = |triangles, state| Pass { triangles, map: own.then_some(0), ..Pass::all(state) };
    let mut passes = vec![Pass { clear_depth: own, ..pass(opaque, hides) }];
    passes.extend(transmits.then(|| pass(triangles.len() - opaque, panes)));
    Ok(Sent { triangles, passes })
}

/// A vertex of the second machine at the port of the machine that draws its map: its depth has more bits, and there are more channels,
/// all 0, and k_t.
fn own_vertex(vertex: &PortVertex, machine: &Plan) -> PortVertex {
    let mut values = vec![0; machine.channels().len() + usize::from(machine.has_triangle_kt())];
    values[..4].copy_from_slice(&vertex.values()[..4]);
    if let Some(kt) = values.last_mut().filter(|_| machine.blend.is_there()) {
        let fraction = if machine.has_triangle_kt() { 0 } else { machine.blend.kt_vertex };
        *kt = i64::from(vertex.kt()) << fraction;
    }
    machine.raw_vertex(vertex.x(), vertex.y(), &values)
}
