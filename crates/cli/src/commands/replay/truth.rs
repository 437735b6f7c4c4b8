//! The exact value of every fragment that was recorded, as golden has it, beside the machine's.

use crate::engine::golden_fill;
use edgewalk_golden::{Fill, fragments};
use edgewalk_host::extra;
use edgewalk_host::polygon::defects;
use edgewalk_machine::Plan;
use edgewalk_model::tokens::output;
use edgewalk_model::view::Tokens;
use edgewalk_replay::Truth;
use edgewalk_scene::Frame;
use std::collections::{HashMap, HashSet};

/// The kinds of token that are fragments from DEPTH on, with DITHER, with SHADOW and without: pixel, then depth and colours.
const FRAGMENTS: [&str; 3] = ["dithered", "shaded", "fragment"];

/// How far each channel of each fragment is off; pixels that only the machine draws have no exact value. With SHADE, SHADOW,
/// DITHER or BLEND the depth alone: a fragment's colour is made on its way.
pub fn truth(machine: &Plan, frame: &Frame, ids: &[i32], tokens: &Tokens) -> Vec<Truth> {
    let of = |name: &'static str| Some((name, tokens.kinds().iter().find(|kind| kind.name == name)?));
    let Some((name, kind)) = FRAGMENTS.into_iter().find_map(of) else { return Vec::new() };
    let exact = exact(machine, frame, ids, &kind.met.iter().map(|token| (token[0], token[1])).collect());
    let colours_change = machine.blend.is_there()
        || machine.shadow.is_there()
        || machine.shade.is_there()
        || machine.dither.rounds();
    let told_of = if colours_change { 1 } else { machine.channels().len() };
    let defects = defects(frame, machine);
    let channels = machine.channels()[..told_of].iter().enumerate();
    let told = channels.map(|(place, channel)| {
        let error = |token: &Vec<u64>| {
            let exact = exact.get(&(token[0], token[1]))?[place];
            let found = output(channel, token[place + 2] as u32) as f64; // b <= 32 bits
            Some(((found - exact) * f64::from(1 << 10)).round() as i32)
        };
        let budget = machine.proved_budget(channel);
        let of_frame = defects[place]; // of bent polygons, and of bilinear colours between misplaced edges
        Truth {
            kind: name,
            field: channel.name,
            bound: budget
                .map(|budget| budget.after_rounding().to_f64() + of_frame)
                .map_err(|why| why.to_string()),
            errors: kind.met.iter().map(error).collect(),
        }
    });
    told.collect()
}

/// A fragment: its triangle and its address.
type Place = (u64, u64);

/// The channels, LSB, of the fragments that are wanted: of all fragments of a large screen they would not fit into memory.
fn exact(machine: &Plan, frame: &Frame, ids: &[i32], wanted: &HashSet<Place>) -> HashMap<Place, Vec<f64>> {
    let mut exact = HashMap::new();
    if !matches!(golden_fill(machine), Fill::Exact { .. }) {
        return exact;
    }
    let triangles: HashSet<u64> = wanted.iter().map(|(triangle, _)| *triangle).collect();
    for (number, id) in ids.iter().enumerate().filter(|(number, _)| triangles.contains(&(*number as u64))) {
        let Some(triangle) = usize::try_from(*id).ok().and_then(|id| frame.triangle_at(id)) else {
            continue;
        };
        let screen = (machine.width, machine.height);
        fragments(triangle, frame.mode, machine.subpixel_bits, screen, |fragment| {
            let addr = u64::from(fragment.y) << machine.widths().x | u64::from(fragment.x);
            if !wanted.contains(&(number as u64, addr)) {
                return;
            }
            let mut values = vec![fragment.z() * machine.z.max() as f64];
            values.extend(fragment.rgb().map(|value| value * machine.color.max() as f64));
            let own = extra::channels(machine).iter().enumerate();
            values.extend(own.map(|(place, channel)| fragment.extra(place) * channel.host_unit()));
            exact.insert((number as u64, addr), values);
        });
    }
    exact
}
