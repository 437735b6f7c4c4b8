//! What the host does to triangles before a machine sees them, in numbers.

/// What a host did to a program's triangles before the machine saw them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Host {
    /// Triangles that reach beyond the guard band and lie off the screen: not sent.
    pub off_screen: u64,
    /// Triangles that were cut at the border of the guard band.
    pub clipped: u64,
    /// The triangles they were cut into.
    pub pieces: u64,
    /// Depths that lay outside of [0, 1] by rounding and were clamped.
    pub clamped_depths: u64,
}
