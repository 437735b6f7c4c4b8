//! The reference pictures: exact coverage, depth and colour in f64
