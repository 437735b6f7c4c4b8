//! Textures and reliefs as the memory behind TEXEL holds them, and which texel a triangle's words name at a pixel.
//!
//! ```text
//!  picture of a material ──taken at the middles of 2^τ x 2^τ texels──> words of the memory
//!  slopes of its relief ───the same, 2^(ξ-1) - 1 for the largest─────┘
//!  u, v of the vertices ──planes, in texels, lines from the top──────> terms u, v ──floor──> texel of a pixel
//! ```
//! A picture whose sides divide 2^τ is held as it is.

use super::place::Place;
use anyhow::{Result, anyhow};
use edgewalk_golden::Texel;
use edgewalk_machine::{Plan, Term};
use edgewalk_numerics::term::{Degree, NODE_BITS, TermWords, node, term_roundings_of_box};
use edgewalk_scene::{Image, PixelShading, PixelTriangle};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Most texels of all textures together: 256 MiB in the model's memory.
const MOST: usize = 1 << 24;

/// Largest u or v, either way.
const MAX_PLACE: f64 = 1e6;

/// The texture and the relief of a surface on the machine.
#[derive(Clone, Debug)]
pub struct Texture {
    image: Option<Arc<Image>>,
    pub relief: Option<Relief>,
    /// τ.
    bits: u32,
    /// LSB of the colour in 1.
    max: f64,
    /// How far a stored texel may be from the picture's, of 1.
    pub error: f64,
    /// The largest number of a texel.
    pub brightest: f64,
}

/// A relief on the machine.
#[derive(Clone, Debug)]
pub struct Relief {
    image: Arc<Image>,
    /// What a stored slope of 2^(ξ-1) would be, per unit of u or v.
    pub one: f64,
    /// 2^(ξ-1).
    whole: f64,
    /// How far a stored slope may be from the relief's, of `one`.
    pub error: f64,
    /// The root of the largest B_u² + B_v² as stored, of `one`.
    pub farthest: f64,
}

impl Relief {
    /// Of these heights at the middles of the machine's texels; `None` of a flat one.
    pub(super) fn new(image: &Arc<Image>, machine: &Plan) -> Option<Relief> {
        let whole = 2f64.powi(machine.shade.slope_bits as i32 - 1);
        let mut relief = Relief { image: Arc::clone(image), one: 0.0, whole, error: 0.0, farthest: 0.0 };
        let side = 1u32 << machine.shade.texture_bits;
        let all = (0..side).flat_map(|v| (0..side).map(move |u| [u, v]));
        let slopes: Vec<DVec2> = all.map(|texel| image.slope(middle(texel, f64::from(side)))).collect();
        let steepest = slopes.iter().fold(0f64, |most, slope| most.max(slope.abs().max_element()));
        relief.one = steepest * whole / (whole - 1.0);
        for slope in slopes {
            let stored = DVec2::new(relief.stored(slope.x), relief.stored(slope.y)) / whole;
            relief.error = relief.error.max((stored - slope / relief.one).abs().max_element());
            relief.farthest = relief.farthest.max(stored.length());
        }
        (steepest > 0.0).then_some(relief)
    }

    fn stored(&self, slope: f64) -> f64 {
        (slope / self.one * self.whole).round_ties_even()
    }
}

/// The place of the middle of a texel, `side` of which make a line, u to the right and v up.
fn middle([column, line]: [u32; 2], side: f64) -> DVec2 {
    let place = (DVec2::new(f64::from(column), f64::from(line)) + 0.5) / side;
    DVec2::new(place.x, 1.0 - place.y)
}

impl Texture {
    /// Of a picture and a relief, at least one of which there is; white without a picture.
    pub fn new([image, relief]: [Option<&Arc<Image>>; 2], machine: &Plan) -> Option<Texture> {
        image.or(relief)?;
        let mut texture = Texture {
            image: image.map(Arc::clone),
            relief: relief.and_then(|relief| Relief::new(relief, machine)),
            bits: machine.shade.texture_bits,
            max: machine.color.max() as f64,
            error: 0.0,
            brightest: 0.0,
        };
        let white = [[u16::MAX; 3]];
        for part in image.map_or(&white[..], |image| image.texels()).iter().flatten() {
            let exact = f64::from(*part) / f64::from(u16::MAX);
            texture.error = texture.error.max((texture.stored(exact) / texture.max - exact).abs());
            texture.brightest = texture.brightest.max(exact);
        }
        Some(texture)
    }

    /// LSB of the colour.
    fn stored(&self, exact: f64) -> f64 {
        (exact * self.max).round_ties_even()
    }

    /// What the pictures have in the middle of a texel of the machine's.
    pub fn exact(&self, texel: [u32; 2]) -> Texel {
        let place = middle(texel, self.side());
        Texel {
            color: self.image.as_ref().map_or(DVec3::ONE, |image| image.nearest(place)),
            slopes: self.relief.as_ref().map_or(DVec2::ZERO, |relief| relief.image.slope(place)),
        }
    }

    /// The word that stands for it.
    fn word(&self, texel: [u32; 2], machine: &Plan) -> u128 {
        let Texel { color, slopes } = self.exact(texel);
        let slopes = self.relief.as_ref().map_or([0; 2], |relief| {
            slopes.to_array().map(|slope| relief.stored(slope) as i32) // at most 15 bits and a sign
        });
        machine.texel_word(color.to_array().map(|part| self.stored(part) as u32), slopes)
    }

    /// 2^τ.
    pub fn side(&self) -> f64 {
        f64::from(1u32 << self.bits)
    }

    /// Column and line of a place, texels of the machine, lines from the top.
    pub fn texels_of(&self, place: DVec2) -> [f64; 2] {
        [place.x, 1.0 - place.y].map(|part| part * self.side())
    }
}

/// The words of the memory of the textures; a surface without one is white.
///
/// # Errors
/// More texels than a run holds.
pub fn words(textures: &[Option<Texture>], machine: &Plan) -> Result<Vec<u128>> {
    if !machine.shade.textures() {
        return Ok(Vec::new());
    }
    let side = 1u32 << machine.shade.texture_bits;
    let count = textures.len() << (2 * machine.shade.texture_bits);
    if count > MOST {
        return Err(anyhow!(
            "texture.bits = {}: {} surfaces have {count} texels together; permitted: at most {MOST}; take fewer bits",
            machine.shade.texture_bits,
            textures.len()
        ));
    }
    let white = machine.texel_word([machine.color.max() as u32; 3], [0; 2]);
    let mut words = vec![white; count];
    for (surface, texture) in (0..).zip(textures) {
        let Some(texture) = texture else { continue };
        for (v, u) in (0..side).flat_map(|v| (0..side).map(move |u| (v, u))) {
            words[machine.texel_place(surface, u, v)] = texture.word([u, v], machine);
        }
    }
    Ok(words)
}

/// Which texels a triangle's words name.
#[derive(Clone, Debug)]
pub struct Textured {
    /// The surface's texture.
    pub texture: Texture,
    /// u and v where its walk begins.
    words: [TermWords; 2],
    fraction: u32,
    start: [i64; 2],
    leftward: bool,
    /// How far a word may be from the place, texels.
    pub error: f64,
    /// The relief is lower on the machine than it is.
    pub flattened: bool,
}

/// The words of u and v in the middle of a triangle's box; of one without a texture 0.
///
/// # Errors
/// A coordinate that no word holds.
pub fn terms(
    place: &Place,
    own: &PixelTriangle,
    shading: &PixelShading,
    terms: &[Term],
) -> Result<Vec<Option<TermWords>>> {
    if shading.texture(own).or(shading.relief(own)).is_none() {
        return Ok(vec![None; terms.len()]);
    }
    let far =
        own.texture.iter().flat_map(|at| at.to_array()).find(|part| part.is_nan() || part.abs() > MAX_PLACE);
    if let Some(part) = far {
        return Err(anyhow!(
            "texture coordinate {part}: the machine takes numbers from -{MAX_PLACE} to {MAX_PLACE}"
        ));
    }
    let planes = [own.texture.map(|at| at.x), own.texture.map(|at| 1.0 - at.y)];
    let words = terms
        .iter()
        .zip(planes)
        .map(|(term, plane)| place.shares().plane(plane.map(node), term.word(), 0, term.word()));
    Ok(words.collect())
}

impl Textured {
    /// Of the words of `terms`, once they stand where the walk begins; `None` without a texture.
    pub fn new(
        place: &Place,
        own: &PixelTriangle,
        (texture, flattened): (Option<&Texture>, bool),
        words: &[[u64; 6]],
        machine: &Plan,
    ) -> Option<Textured> {
        let (texture, &[u, v]) = (texture?.clone(), words.last_chunk()?);
        let (width, fraction) = (machine.terms().last()?.word(), machine.shade.linear_fraction);
        let [columns, lines] = place.sides;
        let roundings = term_roundings_of_box(Degree::Linear, columns, lines) as f64;
        let farthest = own.texture.iter().fold(1.0f64, |most, at| most.max(at.abs().max_element()));
        // The nodes' rounding, and that of f64 on either side.
        let off = 1.0 / (1u64 << NODE_BITS) as f64 + 16.0 * f64::EPSILON * farthest;
        Some(Textured {
            error: roundings / 2f64.powi(fraction as i32 + 1) + off * texture.side(),
            words: [TermWords::new(width, u)?, TermWords::new(width, v)?],
            fraction,
            flattened,
            start: place.start,
            leftward: place.leftward,
            texture,
        })
    }

    /// Column and line of the texel that the words name at a pixel.
    pub fn texel(&self, [x, y]: [u32; 2]) -> [u32; 2] {
        let right = i64::from(x) - self.start[0];
        let i = if self.leftward { -right } else { right };
        // At most 11 bits are left.
        self.words.map(|words| (words.at(i, i64::from(y) - self.start[1]) >> self.fraction) as u32)
    }

    /// Whether this texel is the nearest of a place, to within the error of the words.
    pub fn explains(&self, texel: [u32; 2], place: DVec2) -> bool {
        let exact = self.texture.texels_of(place);
        let near = |(texel, at): (u32, f64)| {
            let (first, last) = ((at - self.error).floor(), (at + self.error).floor());
            // Places repeat: the next one at or behind the first that has this texel.
            let ahead = (f64::from(texel) - first).rem_euclid(self.texture.side());
            first + ahead <= last
        };
        texel.into_iter().zip(exact).all(near)
    }

    /// How far a colour times a texel may be from the exact product, LSB, of colours up to `most` that err by `error`, LSB:
    /// |c'x' - cx| <= c' |x' - x| + x |c' - c|, and the product is rounded.
    pub fn product_error(&self, most: f64, error: f64) -> f64 {
        (most + error) * self.texture.error + error * self.texture.brightest + 0.5
    }

    /// The texel that a place lies in.
    pub fn nearest(&self, place: DVec2) -> [u32; 2] {
        // Below 2^11.
        self.texture.texels_of(place).map(|at| at.floor().rem_euclid(self.texture.side()) as u32)
    }
}
