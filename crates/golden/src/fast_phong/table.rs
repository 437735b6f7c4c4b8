//! The one table of fast Phong: what stands for cos^n, by N·H.

use edgewalk_scene::Specular;

/// A power of the cosine for evenly spaced N·H from 0 to 1; the index is rounded and saturates.
///
/// It has to saturate: the quadratic overshoots 1 around a highlight. Half a step of the index errs by about n / (2 (size - 1)) at
/// the peak, four times that for the form of ch. 7.12.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerTable {
    entries: Vec<f64>,
}

impl PowerTable {
    /// Fewest entries: those for 0 and 1.
    pub const LEAST_SIZE: usize = 2;

    /// The form of the specular part that stands for another: R·V is no function of N·H, so ch. 7.12 does for ch. 7.1.
    pub fn tabulated(form: Specular) -> Specular {
        if form == Specular::Mirror { Specular::Halfway } else { form }
    }

    /// Of `size` entries, at least [`Self::LEAST_SIZE`]: the power `exponent` of N·H or of 2 (N·H)² - 1, as the
    /// tabulated form has it.
    pub fn new(size: usize, form: Specular, exponent: f64) -> Self {
        let last = size.max(Self::LEAST_SIZE) - 1;
        let entry = |index: usize| Self::exact(form, exponent, index as f64 / last as f64);
        Self { entries: (0..=last).map(entry).collect() }
    }

    /// What is tabulated, for N·H in [0, 1].
    pub fn exact(form: Specular, exponent: f64, halfway: f64) -> f64 {
        let cosine = match form {
            Specular::Mirror | Specular::Halfway => 2.0 * halfway * halfway - 1.0,
            Specular::Blinn => halfway,
        };
        cosine.max(0.0).powf(exponent)
    }

    /// The entry nearest to N·H; below 0 the first one, above 1 the last one.
    pub fn read(&self, halfway: f64) -> f64 {
        let last = self.entries.len() - 1;
        self.entries[(halfway.clamp(0.0, 1.0) * last as f64).round() as usize]
    }
}
