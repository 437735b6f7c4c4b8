//! Vertices and triangles on the screen.

/// Most values of the user's own at a vertex.
pub const MAX_EXTRA: usize = 4;

/// Largest magnitude of such a value: no channel of a machine holds more.
pub const MAX_EXTRA_VALUE: f64 = 2_147_483_647.0;

/// A vertex on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vertex {
    /// Pixels to the right of the screen's left side; pixel i has its centre at i + 1/2.
    pub x: f64,
    /// Pixels below the screen's top side.
    pub y: f64,
    /// Depth in [0, 1], 0 at the near plane.
    pub z: f64,
    /// Red in [0, 1].
    pub r: f64,
    /// Green in [0, 1].
    pub g: f64,
    /// Blue in [0, 1].
    pub b: f64,
    /// Transmission coefficient k_t in [0, 1] (ch. 7.1), 0 for an opaque surface.
    pub kt: f64,
    /// Values of the user's own, [`Frame::extra`](crate::Frame::extra) of them, the rest 0. Their unit is
    /// that of the machine's channels e0 to e3: [0, 1] for `unorm`, else LSB of the output; at most
    /// [`MAX_EXTRA_VALUE`] in magnitude.
    pub extra: [f64; MAX_EXTRA],
}

impl Vertex {
    /// The vertex with the colour and k_t of the first one, as flat mode has it.
    #[must_use]
    pub fn colored_as(self, first: &Self) -> Self {
        Self { r: first.r, g: first.g, b: first.b, kt: first.kt, ..self }
    }
}

/// A triangle on the screen; either winding is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Triangle(pub [Vertex; 3]);
