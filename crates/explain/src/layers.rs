//! The layers of a blended pixel: golden's and the machine's, one over the other, with error and bound.

use anyhow::Result;
use edgewalk_golden::Step;
use edgewalk_host::port::{PortFrame, to_port};
use edgewalk_host::raster::golden_drawing;
use edgewalk_judge::compare::{Errors, Lights};
use edgewalk_machine::Plan;
use edgewalk_model::{Drawn, Stalls, render_passes_with};
use edgewalk_scene::{Blending, Frame};
use serde::Serialize;

/// A colour that is stored.
#[derive(Serialize)]
pub struct Layer {
    /// The triangle.
    pub id: i32,
    /// How it is put together with what is behind: `0`, `1` or `add`.
    pub blend: &'static str,
    /// The fragment's colour, its k_t, and the colour behind, in 0 to 1.
    pub front: [f64; 3],
    pub kt: f64,
    pub back: [f64; 3],
    /// What golden stores, LSB of the machine's colour.
    pub golden: [f64; 3],
    /// What the machine stores, LSB; none where it stores another number of colours.
    pub machine: Option<[u32; 3]>,
    /// Largest error of the three, LSB.
    pub error: Option<f64>,
    /// Proved bound of the error, LSB.
    pub bound: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_bound: Option<String>,
}

/// Of a frame that is blended, on a machine that blends: else none.
pub fn layers(frame: &Frame, machine: &Plan, (x, y): (u32, u32)) -> Result<Vec<Layer>> {
    let blended = frame.passes().iter().any(|pass| pass.state.blend != Blending::Off);
    if !blended || !machine.blend.is_there() {
        return Ok(Vec::new());
    }
    let port = to_port(frame, machine)?;
    let mut lights = Lights::of(machine, frame, port.lights.iter().map(|map| &map.words[..]).collect(), None);
    let proof = port.shade.as_ref().map(|feed| &feed.proof);
    let (errors, max, mut bound) = (Errors::of(machine, frame, proof), machine.color.max() as f64, 0.5);
    let mut layers = Vec::new();
    let drawing = golden_drawing(frame, machine);
    let picture = |step| {
        let Step::Stored { at, id, z, own, light, share, kt, back, blend, .. } = step else { return };
        if at != x as usize {
            return;
        }
        let front = own.map(|channel| channel * share);
        let seen = lights.seen([f64::from(x) + 0.5, f64::from(y) + 0.5, z], id, light);
        bound = errors.behind(
            bound,
            errors.front((y as usize * frame.width as usize + at, id), own, share, &seen),
            front,
            kt,
            back,
            blend,
        );
        let golden = std::array::from_fn(|i| match blend {
            Blending::Off => front[i],
            Blending::Mix => (1.0 - kt) * front[i] + kt * back[i],
            Blending::Add => (front[i] + back[i]).min(1.0),
        });
        let golden = golden.map(|c: f64| c * max);
        layers.push(Layer {
            id,
            blend: blend.name(),
            front,
            kt,
            back,
            golden,
            machine: None,
            error: None,
            bound: errors.no_bound.is_none().then_some(bound),
            no_bound: errors.no_bound.map(|why| why.to_string()),
        });
    };
    drawing.watched(y..y + 1, picture);
    let stored = machine_colors(&port, machine, (x, y))?;
    if stored.len() == layers.len() {
        for (layer, stored) in layers.iter_mut().zip(stored) {
            let errors = layer.golden.iter().zip(stored).map(|(golden, own)| (golden - f64::from(own)).abs());
            layer.error = Some(errors.fold(0.0, f64::max));
            layer.machine = Some(stored);
        }
    }
    Ok(layers)
}

/// What the machine writes at the pixel, one after the other.
fn machine_colors(port: &PortFrame, machine: &Plan, (x, y): (u32, u32)) -> Result<Vec<[u32; 3]>> {
    let addr = y << machine.widths().x | x;
    let mut stored = Vec::new();
    let hook = |drawn: Drawn| {
        if let Drawn::Write(sample) = drawn
            && sample.addr == addr
        {
            stored.push([1, 2, 3].map(|i| sample.values[i]));
        }
    };
    let triangles = port.triangles.iter().copied();
    render_passes_with(machine, triangles, &port.passes, &port.maps(), Stalls::NONE, port.words(), hook)?;
    Ok(stored)
}

/// As lines of text.
pub fn text(layers: &[Layer], bits: u32) -> String {
    let three = |c: [f64; 3]| c.map(|c| format!("{c:.3}")).join(" ");
    let mut text = String::new();
    for (place, layer) in layers.iter().enumerate() {
        let Layer { id, kt, bound, no_bound, .. } = layer;
        let formula = match layer.blend {
            "1" => format!("(1 - {kt:.4}) * ({}) + {kt:.4} * ({})", three(layer.front), three(layer.back)),
            "add" => format!("({}) + ({})", three(layer.front), three(layer.back)),
            _ => three(layer.front),
        };
        text += &format!("layer {place}: triangle {id}: {formula}\n");
        let machine = match (layer.machine, layer.error) {
            (Some([r, g, b]), Some(error)) => format!("machine {r} {g} {b}, error {error:.4}"),
            _ => "the machine stores another number of colours here".to_owned(),
        };
        let golden = three(layer.golden);
        let bound = match (bound, no_bound) {
            (Some(bound), _) => format!("bound {bound:.4}"),
            (None, why) => format!("no bound: {}", why.as_deref().unwrap_or_default()),
        };
        text += &format!("    golden {golden} LSB of {bits} bits, {machine}, {bound}\n");
    }
    text
}
