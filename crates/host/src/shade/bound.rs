//! What is proved of a shaded colour: bounds 12 and 13 together, and 14, 16 or 17.

use super::records::IndexErrors;
use super::tables::{LightTables, Surfaces};
use super::texels::Textured;
use edgewalk_machine::{NoBound, Plan, ShadeColour};

/// By triangle.
#[derive(Clone, Debug)]
pub struct Proof {
    /// Largest error of a colour against golden's fast Phong, LSB; with `no_bound` that with 1 LSB of the fragment's own colour.
    pub bounds: Vec<f64>,
    /// Why none is proved: nothing is of the fragment's colour, which SHADE multiplies.
    pub no_bound: Option<NoBound>,
    /// How far a cosine N·L may be from golden's.
    pub doubts: Vec<f64>,
    /// How far the indices may be from those of golden's cosines.
    pub errors: Vec<IndexErrors>,
    /// Texels of each surface, where it has a texture.
    pub textured: Vec<Option<Textured>>,
    /// Pictures of the machine that are added: one, or one for each light at a point. DITHER rounds each by itself.
    pub pictures: u32,
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
            no_bound: color.err().filter(|_| machine.shade.colour == ShadeColour::Multiply),
            doubts: errors.iter().map(|error| error.diffuse / one).collect(),
            errors,
            textured,
            pictures: 1,
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
