//! What another rasterizer left, as arrays: row 0 on top.

/// The arrays that there are. Each has `width * height` entries.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Lines.
    pub height: u32,
    /// Triangles over each pixel, depth test off.
    pub coverage: Option<Vec<u32>>,
    /// Place in the input of the triangle that each pixel shows, -1 none.
    pub id: Option<Vec<i32>>,
    /// Depth in 0 to 1.
    pub z: Option<Vec<f64>>,
    /// Colour in 0 to 1.
    pub rgb: Option<Vec<[f64; 3]>>,
    /// 0 nothing written, 1 in shadow, 2 lit.
    pub lit: Option<Vec<u8>>,
}
