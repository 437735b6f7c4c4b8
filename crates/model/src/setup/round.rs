//! The division of SETUP.

/// floor(n/d + 1/2), d > 0: RN. Most numbers fit in 64 bits, whose division takes the host a fraction of the time.
pub(super) fn round_div(n: i128, d: i128) -> i128 {
    let n = n + d / 2;
    match (i64::try_from(n), i64::try_from(d)) {
        (Ok(n), Ok(d)) => n.div_euclid(d).into(),
        _ => n.div_euclid(d),
    }
}
