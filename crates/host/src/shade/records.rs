//! The record of a triangle: its terms fitted exactly, rounded in the middle of its box, moved to where its walk begins.

use super::lamp::{LampErrors, WordErrors, shortest};
use super::lights::Lamp;
use super::place::Place;
use super::texels;
use super::turns::Turns;
use anyhow::Result;
use edgewalk_machine::{Plan, Record, Term};
use edgewalk_numerics::term::{Degree, NODE_BITS, TermWords, node, term_roundings_of_box};
use edgewalk_scene::{PixelShading, PixelTriangle};
use glam::DVec3;

/// How far the cosine that a term stands for is from golden's: six values rounded to [`NODE_BITS`] count for at most 5/3·2^-41
/// together, the rest is for f64 on either side.
const COSINE_ERROR: f64 = 1.0 / (1u64 << NODE_BITS) as f64;

/// 1.0 in NORMAL.
const UNIT_BITS: u32 = 16;
const UNIT: f64 = (1u32 << UNIT_BITS) as f64;

/// 1.0 in LAMP's l·l, and in its products.
const DISTANCE_BITS: u32 = 30;
const REACH_BITS: u32 = 23;

/// How far the indices of a triangle may be from those of golden's quadratics.
#[derive(Clone, Debug, Default)]
pub struct IndexErrors {
    /// Of N·L, entries; the same for all lights.
    pub diffuse: f64,
    /// Of N·H, entries, by light.
    pub highlight: Vec<f64>,
    /// Of what is left of a light at a point, of all of it; with LAMP alone.
    pub beam: f64,
    /// Of the cosine to the light's axis.
    pub axis: f64,
}

/// The record of a triangle with this surface; `glosses` has the scale m' of each light's table of highlights, `root_error` is
/// that of NORMAL's table. A triangle that is culled, and so has no place, has an empty one, as nobody reads it.
///
/// # Errors
/// Texture coordinates that no word holds.
pub fn record(
    place: Option<&Place>,
    own: &PixelTriangle,
    shading: &PixelShading,
    lamps: &[Lamp],
    (material, glosses): (u32, &[u32]),
    (root_error, turns): (f64, Option<&Turns>),
    machine: &Plan,
) -> Result<(Record, IndexErrors)> {
    let Some(place) = place else { return Ok(Default::default()) };
    let (of_lights, others) = machine.terms().split_at(machine.cosine_terms());
    let (of_relief, of_texture) = others.split_at(machine.bumped_terms() - of_lights.len());
    let mut words = if machine.shade.is_positional() {
        lamp_terms(place, own, shading, lamps, of_lights)
    } else if machine.shade.normalises() {
        normal_terms(place, own, shading, lamps, turns, of_lights)
    } else {
        cosine_terms(place, own, shading, lamps, glosses, (of_lights, machine))
    };
    words.extend(turn_terms(place, turns, glosses, (of_relief, machine)));
    words.extend(texels::terms(place, own, shading, of_texture)?);
    let start = place.steps_to(place.start);
    // Of a triangle that is drawn the weights do not sum to 0, and a planned word has at most 64 bits.
    let moved =
        |words: Option<TermWords>| words.map_or([0; 6], |words| words.moved(start.0, start.1).words());
    let [width, height] = place.sides;
    let error_of = |degree, fraction: u32| {
        term_roundings_of_box(degree, width, height) as f64 / 2f64.powi(fraction as i32 + 1)
    };
    let quadratic = error_of(Degree::Quadratic, machine.shade.fraction);
    let entries = machine.shade.table_bits;
    let linear = error_of(Degree::Linear, machine.shade.linear_fraction);
    let words_of_lamp = WordErrors { linear, quadratic, node: COSINE_ERROR };
    let point = lamps.first().and_then(|lamp| lamp.point.as_ref());
    let of_lamp = point.map_or_else(LampErrors::default, |point| {
        point.errors(own, shading.viewer_at(DVec3::ZERO), words_of_lamp)
    });
    // By light and cosine; a light that is not there has none.
    let index_error = |cosine: usize, gloss: u32| {
        let one = 2f64.powi((entries + gloss) as i32);
        let turns = turns.filter(|turns| cosine < turns.growths.len());
        if turns.is_some_and(|turns| turns.flattened) {
            return 2.0 * one;
        }
        if machine.shade.is_positional() {
            // N·L is weakened before it is the index.
            let error = if cosine == 0 { of_lamp.diffuse.map(|e| e + of_lamp.beam) } else { of_lamp.halfway };
            if point.is_some() { error.map_or(2.0 * one, |error| error * one / UNIT) } else { 0.0 }
        } else if machine.shade.normalises() {
            let growth = turns.map_or(0.0, |turns| turns.growth_error(cosine) * UNIT);
            normal_error(own, (linear, growth), quadratic, (root_error, turns), machine) * one / UNIT
        } else if machine.shade.bumps() {
            let below = 2f64.powi(machine.shade.cosine_fraction() as i32);
            let turned = turns.map_or(0.0, |turns| {
                2.0 * (linear + 0.5) / below + (turns.growth_error(cosine) + 2.0 * COSINE_ERROR) * one
            });
            (quadratic + 0.5) / below + COSINE_ERROR * one + turned
        } else {
            quadratic + COSINE_ERROR * one
        }
    };
    let highlight = glosses.iter().enumerate().map(|(light, gloss)| index_error(2 * light + 1, *gloss));
    let errors = IndexErrors {
        diffuse: (0..glosses.len()).map(|light| index_error(2 * light, 0)).fold(0.0, f64::max),
        highlight: highlight.collect(),
        beam: of_lamp.beam / UNIT,
        axis: of_lamp.axis / UNIT,
    };
    let [x, y] = place.start;
    let record = Record {
        x: x as i32, // in the guard band
        y: y as u32, // on the screen
        material,
        gloss: glosses.first().copied().unwrap_or(0),
        terms: words.into_iter().map(moved).collect(),
    };
    Ok((record, errors))
}

/// N·L and N·H, quadratics through six cosines: 2^t for 1.0, and index = 2^t - (1 - N·H)·2^(m' + t); for BUMP with bits below, rounded
/// to nearest.
fn cosine_terms(
    place: &Place,
    own: &PixelTriangle,
    shading: &PixelShading,
    lamps: &[Lamp],
    glosses: &[u32],
    (of_lights, machine): (&[Term], &Plan),
) -> Vec<Option<TermWords>> {
    let (shares, entries) = (place.shares(), machine.shade.table_bits);
    let mut terms = Vec::with_capacity(machine.terms().len());
    for (light, of_light) in of_lights.chunks_exact(2).enumerate() {
        let Some(lamp) = lamps.get(light) else {
            terms.extend([None; 2]); // no light: its tables are black
            continue;
        };
        let cosines = lamp.cosines(own, shading).map(|nodes| nodes.map(|list| list.map(node)));
        let lowest = (1i64 << entries) - (1i64 << (entries + glosses[light]));
        let scales = [(entries, 0), (entries + glosses[light], lowest)];
        let below = machine.shade.cosine_fraction();
        for ((term, nodes), (bits, offset)) in of_light.iter().zip(cosines).zip(scales) {
            let fraction = below + term.fraction;
            let offset = (offset << fraction) + if below > 0 { half(term) } else { 0 };
            terms.push(shares.six_point(nodes, bits + fraction, offset, term.word()));
        }
    }
    terms
}

/// Half of an output's last bit: with it a term is rounded to nearest.
fn half(term: &Term) -> i64 {
    if term.fraction > 0 { 1 << (term.fraction - 1) } else { 0 }
}

/// What the cosines grow by with the slopes of a relief, in the unit of each, and with NORMAL what N·N does; without a relief 0.
fn turn_terms(
    place: &Place,
    turns: Option<&Turns>,
    glosses: &[u32],
    (of_relief, machine): (&[Term], &Plan),
) -> Vec<Option<TermWords>> {
    let Some(turns) = turns else { return vec![None; of_relief.len()] };
    let shares = place.shares();
    let plane = |term: &Term, values: [f64; 3], bits: u32| {
        shares.plane(values.map(node), bits + term.fraction, half(term), term.word())
    };
    let normalises = machine.shade.normalises();
    let (of_cosines, of_square) = of_relief.split_at(4 * glosses.len());
    let cosines = of_cosines.chunks_exact(2).enumerate().flat_map(|(cosine, terms)| {
        let unit = machine.shade.table_bits + machine.shade.cosine_fraction();
        let bits = match (normalises, cosine % 2) {
            (true, _) => UNIT_BITS,
            (false, 0) => unit,
            (false, _) => unit + glosses[cosine / 2],
        };
        let growths = turns.growths.get(cosine);
        [0, 1].map(|way| growths.and_then(|growths| plane(&terms[way], growths[way], bits)))
    });
    let squares = of_square.iter().zip(turns.squares).map(|(term, values)| plane(term, values, UNIT_BITS));
    cosines.chain(squares).collect()
}

/// Products with a normal of any length, planes rounded to nearest by half an output's last bit, and N·N: 2^16 for 1.0.
fn normal_terms(
    place: &Place,
    own: &PixelTriangle,
    shading: &PixelShading,
    lamps: &[Lamp],
    turns: Option<&Turns>,
    of_lights: &[Term],
) -> Vec<Option<TermWords>> {
    let shares = place.shares();
    let normals = own.normals.map(|normal| normal * turns.map_or(1.0, |turns| turns.scale));
    let mut terms = Vec::with_capacity(of_lights.len() + 2);
    for (place, term) in of_lights.iter().enumerate() {
        if term.degree == 2 {
            let middle = |k: usize| (normals[(k + 1) % 3] + normals[(k + 2) % 3]) / 2.0;
            let squares = [normals, [0, 1, 2].map(middle)].map(|list| list.map(|n| node(n.length_squared())));
            terms.push(shares.six_point(squares, UNIT_BITS + term.fraction, 0, term.word()));
            continue;
        }
        terms.push(lamps.get(place / 2).and_then(|lamp| {
            let direction = lamp.directions(DVec3::ZERO, shading)[place % 2];
            let products = normals.map(|normal| node(normal.dot(direction)));
            shares.plane(products, UNIT_BITS + term.fraction, half(term), term.word())
        }));
    }
    terms
}

/// Products with the way to a light at a point, planes and quadratics rounded to nearest by half an output's last bit, and the squares
/// of way and normal, which are cut; black without a light.
fn lamp_terms(
    place: &Place,
    own: &PixelTriangle,
    shading: &PixelShading,
    lamps: &[Lamp],
    of_lights: &[Term],
) -> Vec<Option<TermWords>> {
    let Some(point) = lamps.first().and_then(|lamp| lamp.point.as_ref()) else {
        return vec![None; of_lights.len()];
    };
    let (shares, ways) = (place.shares(), point.ways(own));
    let middle = |k: usize| (own.normals[(k + 1) % 3] + own.normals[(k + 2) % 3]) / 2.0;
    let normals = [own.normals, [0, 1, 2].map(middle)];
    let viewer = shading.viewer_at(DVec3::ZERO);
    let products = |a: [[DVec3; 3]; 2], b: [[DVec3; 3]; 2]| {
        [0, 1].map(|i| [0, 1, 2].map(|k: usize| node(a[i][k].dot(b[i][k]))))
    };
    let square =
        |nodes, term: &Term, bits: u32| shares.six_point(nodes, bits + term.fraction, 0, term.word());
    let reach = |term: &Term| (REACH_BITS + term.fraction, half(term), term.word());
    let plane = |values: [f64; 3], term: &Term| {
        let (bits, offset, width) = reach(term);
        shares.plane(values.map(node), bits, offset, width)
    };
    let word = |term: &Term| match term.name {
        "dd" => square(products(ways, ways), term, DISTANCE_BITS),
        "nn" => square(products(normals, normals), term, UNIT_BITS),
        "pl" => {
            let (bits, offset, width) = reach(term);
            shares.six_point(products(normals, ways), bits, offset, width)
        }
        "dv" => plane(ways[0].map(|way| way.dot(viewer)), term),
        "da" => plane(point.along(own), term),
        _ => plane(own.normals.map(|normal| normal.dot(viewer)), term),
    };
    of_lights.iter().map(word).collect()
}

/// Bounds 14 and 16: how far a cosine by NORMAL is from that of a normal of length 1, 2^-16; `linear` and `quadratic` bound the
/// words of the terms, `growth` what the stored slopes of a relief spoil. A normal that may be shorter than half has none but the
/// whole range.
fn normal_error(
    own: &PixelTriangle,
    (linear, growth): (f64, f64),
    quadratic: f64,
    (root_error, turns): (f64, Option<&Turns>),
    machine: &Plan,
) -> f64 {
    let shortest = shortest(own.normals) * turns.map_or(1.0, |turns| turns.scale);
    let (mut product, mut square) = (linear + 0.5 + COSINE_ERROR * UNIT, quadratic + COSINE_ERROR * UNIT);
    if machine.shade.bumps() {
        // BUMP rounds its sum, and takes a square whose word was cut.
        (product, square) = (product + 0.5, square + 1.0);
    }
    if let Some(turns) = turns {
        let plane = linear + 0.5 + COSINE_ERROR * UNIT;
        (product, square) =
            (product + 2.0 * plane + growth, square + 3.0 * plane + turns.square_error() * UNIT);
    }
    let least = shortest * shortest * UNIT - square - 1.0;
    if least < UNIT / 4.0 {
        return 2.0 * UNIT;
    }
    let relative = root_error + 1.01 * square / (2.0 * least);
    let root = (UNIT / least).sqrt() * (1.0 + relative);
    product * root + UNIT * relative + 0.5
}
