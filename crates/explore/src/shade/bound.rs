//! What is proved of a shaded colour: bounds 12 and 13 together, and 14, 16 or 17, and the pixels where a light stands at the horizon.

use super::records::IndexErrors;
use super::tables::{LightTables, Surfaces};
use super::texels::Textured;
use edgewalk_machine::{Plan, ShadeColour};
use serde::Serialize;

/// By triangle.
#[derive(Clone, Debug)]
pub struct Proof {
    /// Largest error of a colour against golden's fast Phong, LSB.
    pub bounds: Vec<f64>,
    /// How far a cosine N·L may be from golden's.
    pub doubts: Vec<f64>,
    /// How far the indices may be from those of golden's cosines.
    pub errors: Vec<IndexErrors>,
    /// Its texels, where it has a texture.
    pub textured: Vec<Option<Textured>>,
}

impl Proof {
    /// Of triangles that the surfaces name, with these errors of their indices.
    pub fn new(
        machine: &Plan,
        surfaces: &Surfaces,
        errors: Vec<IndexErrors>,
        textured: Vec<Option<Textured>>,
    ) -> Proof {
        let color = machine.proved_budget(&machine.channels()[1]);
        // Where none is proved an LSB is allowed, as elsewhere.
        let surface_error = color.map_or(1.0, |budget| budget.after_rounding().to_f64());
        let bound = |(triangle, error): (usize, &IndexErrors)| {
            let lights = &surfaces.tables[surfaces.of_triangle[triangle] as usize];
            let plain = (surfaces.brightest[triangle], surface_error);
            let surface = textured[triangle].as_ref().map_or(plain, |own| with_texel(machine, own, plain));
            color_bound(machine, lights, error, surface)
        };
        let one = f64::from(1u32 << machine.shade.table_bits);
        Proof {
            bounds: errors.iter().enumerate().map(bound).collect(),
            doubts: errors.iter().map(|error| error.diffuse / one).collect(),
            errors,
            textured,
        }
    }
}

/// The brightest colour behind TEXEL, and its error.
fn with_texel(machine: &Plan, of: &Textured, (brightest, error): (f64, f64)) -> (f64, f64) {
    let most = brightest * machine.color.max() as f64;
    (brightest * of.texture.brightest, of.product_error(most, error))
}

/// The bound of a colour, LSB, of a triangle with fragments of at most this colour, 0 to 1, and error, LSB.
fn color_bound(
    machine: &Plan,
    lights: &[LightTables],
    error: &IndexErrors,
    (brightest, surface_error): (f64, f64),
) -> f64 {
    let highlights = lights.iter().zip(&error.highlight).map(|(light, e)| light.highlight.error(*e));
    // LAMP weakens a highlight behind its table, and rounds it.
    let weakened = |light: &LightTables| light.highlight.function().top * error.beam + 0.5;
    let weakened = if machine.shade.is_positional() { lights.iter().map(weakened).sum() } else { 0.0 };
    let highlights: f64 = highlights.sum::<f64>() + weakened;
    let diffuse = |k: usize| lights.iter().map(|light| light.diffuse[k].error(error.diffuse)).sum::<f64>();
    match machine.shade.colour {
        // Sums of entries are exact, and a cut moves no two values apart.
        ShadeColour::Tables => (0..3).map(diffuse).fold(0.0, f64::max) + highlights,
        // |c'l' - cl| <= c' |l' - l| + l |c' - c| with l at most 1, and the product is rounded.
        ShadeColour::Multiply => {
            let one = f64::from(1u32 << (machine.color.bits + 2));
            let most = brightest * machine.color.max() as f64 + surface_error;
            most * diffuse(0) / one + surface_error + 0.5 + highlights
        }
    }
}

/// What was found of a picture shaded at each pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Shaded {
    /// Pixels whose colour was compared with the bound of its triangle.
    pub pixels: u64,
    /// Largest error, LSB.
    pub error: f64,
    /// Largest bound of a triangle that is seen, LSB.
    pub bound: f64,
    /// The largest error over the bound of its triangle.
    pub of_bound: f64,
    /// Pixels where a light is so near to the horizon that it may be above or below, or which lie next to the edge of its cone.
    pub at_horizon: u64,
    /// Of them those that show the other of the two.
    pub other_branch: u64,
    /// Pixels beyond.
    pub beyond: u64,
    /// Largest distance of the machine's colours from Phong shading, LSB: measured, no bound.
    pub from_phong: f64,
    /// Its mean.
    pub mean_from_phong: f64,
    /// Where a texture is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texels: Option<Looked>,
}

/// What was found of the texels of a picture: each is the one that the triangle's words name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Looked {
    /// Pixels that show a texture.
    pub pixels: u64,
    /// Largest error of a word, texels.
    pub bound: f64,
    /// Pixels with another texel than the one that their place lies in.
    pub differ: u64,
    /// Those of them that lie farther from that texel than the error of the words.
    pub unexplained: u64,
    /// Pixels of another colour because the picture's sides do not divide 2^`texture.bits`.
    pub resampled: u64,
    /// Pixels of triangles whose relief is steeper than the machine's words can say, and lower there: no bound holds them.
    pub flattened: u64,
}
