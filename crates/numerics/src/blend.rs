//! Bound 11: what blending layer by layer may err by. Derivation: `docs/numerics.md`.

/// The error of a pixel behind one more layer, LSB, where golden mixes I over B with k_t and the machine rounds: `back` is the
/// error of the pixel before, `front` of the fragment's colour, `far` |I - B| of golden's colours, LSB, `kt` the machine's
/// k_t, 0 to 1, and `kt_error` by how much it differs from golden's at the most:
/// `kt·back + (1 - kt)·front + far·kt_error + 1/2`.
#[must_use]
pub fn blend_error(back: f64, front: f64, far: f64, kt: f64, kt_error: f64) -> f64 {
    kt * back + (1.0 - kt) * front + far * kt_error + 0.5
}

/// Like `blend_error`, with golden's k_t instead of the machine's, which lies within `kt_error` of it and of 0 to 1.
#[must_use]
pub fn blend_error_of_golden(back: f64, front: f64, far: f64, kt: f64, kt_error: f64) -> f64 {
    blend_error(back, front, far, kt, kt_error) + kt_error * (back - front).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_1_it_grows_by_a_half_a_layer_and_else_stays() {
        let stack = |kt: f64| (0..30).fold(0.0, |error, _| blend_error(error, 0.5, 0.0, kt, 0.0));
        assert!((stack(1.0) - 15.0).abs() < 1e-12);
        assert!((stack(0.5) - 1.5).abs() < 1e-6);
        assert_eq!(stack(0.0), 1.0);
        assert_eq!(blend_error(0.0, 0.5, 255.0, 0.5, 0.5 / 256.0), 0.25 + 255.0 / 512.0 + 0.5);
        let (own, golden) =
            (blend_error(3.0, 1.0, 9.0, 0.4, 0.1), blend_error_of_golden(3.0, 1.0, 9.0, 0.5, 0.1));
        assert!(own <= golden, "k_t 0.4 lies within 0.1 of 0.5");
    }
}
