//! The depth test, decided exactly.

use edgewalk_scene::DepthFunc;
use std::cmp::Ordering;

/// Whether a fragment passes whose depth compares so with the stored one.
pub(crate) fn passes(func: DepthFunc, order: Ordering) -> bool {
    match func {
        DepthFunc::Never => false,
        DepthFunc::Less => order.is_lt(),
        DepthFunc::Equal => order.is_eq(),
        DepthFunc::Lequal => order.is_le(),
        DepthFunc::Greater => order.is_gt(),
        DepthFunc::Notequal => order.is_ne(),
        DepthFunc::Gequal => order.is_ge(),
        DepthFunc::Always => true,
    }
}

/// The order of two depths as f64 knows it; `None` where they are no farther apart than their errors together.
pub(crate) fn compare(new: f64, stored: f64, doubt: f64) -> Option<Ordering> {
    if (new - stored).abs() > doubt { new.partial_cmp(&stored) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_functions_by_what_they_let_pass() {
        let nearer_equal_farther =
            |func| [Ordering::Less, Ordering::Equal, Ordering::Greater].map(|o| passes(func, o));
        let seen: Vec<_> = DepthFunc::ALL.map(nearer_equal_farther).to_vec();
        // In the order of the list, bit 0 nearer, bit 1 as near, bit 2 farther.
        let expected: Vec<_> = (0..8).map(|bits| [0, 1, 2].map(|k| bits >> k & 1 == 1)).collect();
        assert_eq!(seen, expected);
    }

    #[test]
    fn near_depths_stay_open() {
        let next = f64::from_bits(0.5f64.to_bits() + 1);
        assert_eq!(compare(0.5, 0.5, 1e-15), None);
        assert_eq!(compare(next, 0.5, 1e-15), None);
        assert_eq!(compare(0.5, 0.5 + 1e-14, 1e-15), Some(Ordering::Less));
        assert_eq!(compare(0.5, 0.25, 1e-15), Some(Ordering::Greater));
    }
}
