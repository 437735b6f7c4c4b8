//! A table of SHADE, LAMP or NORMAL read at an index.

use serde::Serialize;

/// A table read at an index.
#[derive(Debug, Serialize)]
pub(super) struct TableRead {
    /// Golden's index, and how far the machine's may be from it.
    pub golden: f64,
    pub bound: f64,
    /// The entry, and what stands there.
    pub entry: u32,
    pub table: String,
    /// The highlight there, LSB.
    #[serde(skip)]
    pub highlight: i64,
}

impl TableRead {
    /// As words behind an index.
    pub fn text(&self, index: i64) -> String {
        let TableRead { golden, bound, entry, table, .. } = self;
        // A floor lies up to 1 below.
        let error = (index as f64 - golden).max((golden - index as f64 - 1.0).max(0.0));
        format!(
            "; golden's {golden:.4}, outside of it by {error:.4}, bound {bound:.4}; entry {entry}: {table}"
        )
    }
}
