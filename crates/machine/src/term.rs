//! The terms of a machine: what TERM walks from line to line and PIXEL steps from pixel to pixel.

use crate::machine::Machine;
use crate::shade::ShadeKind;

/// A polynomial in the place of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Term {
    /// Name in ports and reports.
    pub name: &'static str,
    /// 1 or 2.
    pub degree: u32,
    /// Output bits b, the sign included.
    pub bits: u32,
    /// Fraction bits r below the output's last bit.
    pub fraction: u32,
}

impl Term {
    /// Bits of the word, w = b + r, at most [`WORD_BITS`].
    #[must_use]
    pub fn word(&self) -> u32 {
        self.bits + self.fraction
    }

    /// Words of a record that are its own: V, X, Y, and of degree 2 XX, XY, YY.
    #[must_use]
    pub fn words(&self) -> u32 {
        3 * self.degree
    }
}

/// Longest word of a term.
pub const WORD_BITS: u32 = 64;

/// Bits of the unnormalised cosines and of N·N, 2^16 for 1.0.
const UNIT_BITS: u32 = 18;

/// Bits of l·l, 2^30 for 1.0, and of the products with l and V, 2^23 for 1.0.
const DISTANCE_BITS: u32 = 32;
const REACH_BITS: u32 = 25;

/// What SHADE takes, light by light: N·L and N·H in entries of a table.
pub(crate) const COSINES: [[&str; 2]; 2] = [["nl0", "nh0"], ["nl1", "nh1"]];

/// Like `COSINES`, of a normal of any length.
const PRODUCTS: [[&str; 2]; 2] = [["pl0", "ph0"], ["pl1", "ph1"]];

/// What LAMP takes: l·l, N·l, l·V, the light's axis times -l, N·V.
pub(crate) const OF_LAMP: [(&str, u32, u32); 5] = [
    ("dd", 2, DISTANCE_BITS),
    ("pl", 2, REACH_BITS),
    ("dv", 1, REACH_BITS),
    ("da", 1, REACH_BITS),
    ("pv", 1, REACH_BITS),
];

/// What a cosine and a product grow by with a slope along u, and along v: by light and cosine.
const COSINE_TURNS: [[[&str; 2]; 2]; 2] =
    [[["nl0u", "nl0v"], ["nh0u", "nh0v"]], [["nl1u", "nl1v"], ["nh1u", "nh1v"]]];
const PRODUCT_TURNS: [[[&str; 2]; 2]; 2] =
    [[["pl0u", "pl0v"], ["ph0u", "ph0v"]], [["pl1u", "pl1v"], ["ph1u", "ph1v"]]];

/// What N·N grows by with the square of a slope along u, the product of both slopes, the square of that along
/// v.
const SQUARES: [&str; 3] = ["tuu", "tuv", "tvv"];

/// The terms of a machine, in the order of their words.
pub(crate) fn terms(machine: &Machine) -> Vec<Term> {
    let shade = &machine.shade;
    let lights = shade.lights as usize;
    let quadratic = |name, bits| Term { name, degree: 2, bits, fraction: shade.fraction };
    let linear = |name, bits| Term { name, degree: 1, bits, fraction: shade.linear_fraction };
    let bits = match shade.kind {
        ShadeKind::Phong => [UNIT_BITS; 2],
        _ => [shade.diffuse_index_bits(), shade.highlight_index_bits()].map(|b| b + shade.cosine_fraction()),
    };
    let of_light = |[diffuse, highlight]: [&'static str; 2]| {
        [quadratic(diffuse, bits[0]), quadratic(highlight, bits[1])]
    };
    let (mut terms, turns): (Vec<Term>, _) = match shade.kind {
        ShadeKind::None => (Vec::new(), COSINE_TURNS),
        ShadeKind::FastPhong => (COSINES.into_iter().take(lights).flat_map(of_light).collect(), COSINE_TURNS),
        ShadeKind::Phong if shade.is_positional() => {
            let of_lamp = OF_LAMP.map(|(name, degree, bits)| match degree {
                2 => quadratic(name, bits),
                _ => linear(name, bits),
            });
            (of_lamp.into_iter().chain([quadratic("nn", UNIT_BITS)]).collect(), PRODUCT_TURNS)
        }
        ShadeKind::Phong => {
            let products = PRODUCTS.into_iter().take(lights).flatten().map(|name| linear(name, UNIT_BITS));
            (products.chain([quadratic("nn", UNIT_BITS)]).collect(), PRODUCT_TURNS)
        }
    };
    if shade.bumps() {
        for (turns, bits) in
            turns.into_iter().take(lights).flat_map(|of_light| of_light.into_iter().zip(bits))
        {
            terms.extend(turns.map(|name| linear(name, bits)));
        }
        if shade.normalises() {
            terms.extend(SQUARES.map(|name| linear(name, UNIT_BITS)));
        }
    }
    if shade.textures() {
        terms.extend(["u", "v"].map(|name| linear(name, shade.texture_bits)));
    }
    terms
}
