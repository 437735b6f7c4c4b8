//! The record of a triangle: its terms fitted exactly, rounded in the middle of its box, moved to where its walk begins.

use super::lights::Lamp;
use super::place::Place;
use edgewalk_machine::{Plan, PortVertex, Record};
use edgewalk_numerics::term::{Degree, NODE_BITS, node, term_roundings_of_box};
use edgewalk_scene::{PixelShading, PixelTriangle};

/// How far the cosine that a term stands for is from golden's: six values rounded to [`NODE_BITS`] count for at most 5/3·2^-41
/// together, the rest is for f64 on either side.
const COSINE_ERROR: f64 = 1.0 / (1u64 << NODE_BITS) as f64;

/// How far the indices of a triangle may be from those of golden's quadratics.
#[derive(Clone, Debug, Default)]
pub struct IndexErrors {
    /// Of N·L, entries; the same for all lights.
    pub diffuse: f64,
    /// Of N·H, entries, by light.
    pub highlight: Vec<f64>,
}

/// The record of a triangle with this surface; `glosses` has the scale m' of each light's table of highlights. A triangle
/// that is culled has an empty one, as nobody reads it.
pub fn record(
    triangle: &[PortVertex; 3],
    own: &PixelTriangle,
    shading: &PixelShading,
    lamps: &[Lamp],
    (material, glosses): (u32, &[u32]),
    machine: &Plan,
) -> (Record, IndexErrors) {
    let Some(place) = Place::of(machine, triangle) else { return Default::default() };
    let (shares, start) = (place.shares(), place.steps_to(place.start));
    let entries = machine.shade.table_bits;
    let mut terms = Vec::with_capacity(machine.terms().len());
    for (light, of_light) in machine.terms().chunks_exact(2).enumerate() {
        let Some(lamp) = lamps.get(light) else {
            terms.extend([[0; 6]; 2]); // no light: its tables are black
            continue;
        };
        let cosines = lamp.cosines(own, shading).map(|nodes| nodes.map(|list| list.map(node)));
        // index = 2^t - (1 - N·H)·2^(m' + t)
        let lowest = (1i64 << entries) - (1i64 << (entries + glosses[light]));
        let scales = [(entries, 0), (entries + glosses[light], lowest)];
        for ((term, nodes), (bits, offset)) in of_light.iter().zip(cosines).zip(scales) {
            let offset = offset << term.fraction;
            let words = shares.six_point(nodes, bits + term.fraction, offset, term.word());
            // Of a triangle that is drawn the weights do not sum to 0, and a planned word has at most 64 bits.
            terms.push(words.map_or([0; 6], |words| words.moved(start.0, start.1).words()));
        }
    }
    let [x, y] = place.start;
    let [width, height] = place.sides;
    let rounding = term_roundings_of_box(Degree::Quadratic, width, height) as f64
        / 2f64.powi(machine.shade.fraction as i32 + 1);
    let index_error = |bits: u32| rounding + COSINE_ERROR * f64::from(1u32 << bits);
    let errors = IndexErrors {
        diffuse: index_error(entries),
        highlight: glosses.iter().map(|gloss| index_error(entries + gloss)).collect(),
    };
    // x lies in the guard band, y on the screen.
    (Record { x: x as i32, y: y as u32, material, terms }, errors)
}
