//! Bound 10: how far the polynomials of fast Phong are from the cosine that they stand for. Derivations: `docs/numerics.md`.
//!
//! ```text
//!   N0 \  C  / N1       N(x, y) is linear over the triangle (ch. 7.11) and C its value at the centroid;
//!       \ | /           rho = max |N_i - C| / |C|. If every N_i is a unit vector within an angle phi of C,
//!        \|/ phi        rho <= tan phi.
//! ```
//! The cosine is L·N/|N| with a unit vector L, N·L or N·H of ch. 7.12. Errors are absolute: times 255 they are LSB of an
//! 8-bit colour whose coefficient is 1. Bounds are rounded as any f64 is, a few times 2^-53 of their size.

/// rho = max |N_i - C| / |C| of three vertex normals of any length, C their mean. Infinite if they cancel.
#[must_use]
pub fn normal_spread(normals: &[[f64; 3]; 3]) -> f64 {
    let mean: [f64; 3] = std::array::from_fn(|axis| normals.iter().map(|n| n[axis]).sum::<f64>() / 3.0);
    let distance = |n: &[f64; 3]| length(std::array::from_fn(|axis| n[axis] - mean[axis]));
    let size = length(mean);
    if size > 0.0 { normals.iter().map(distance).fold(0.0, f64::max) / size } else { f64::INFINITY }
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// Bound 10: error of the second-order Taylor polynomial about the centroid, anywhere in the triangle:
/// rho³ / (2 (1 - rho)). Infinite for rho >= 1, where the series need not converge.
#[must_use]
pub fn taylor_error(spread: f64) -> f64 {
    if spread < 1.0 { spread.powi(3) / (2.0 * (1.0 - spread)) } else { f64::INFINITY }
}

/// Bound 10 for the polynomial through the vertices and the edges' midpoints: 8/3 of [`taylor_error`]. Proved, not
/// sharp: measured errors are far below those of the Taylor polynomial.
#[must_use]
pub fn six_point_error(spread: f64) -> f64 {
    8.0 / 3.0 * taylor_error(spread)
}
