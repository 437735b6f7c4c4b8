//! What is on the screen after a frame.

use edgewalk_scene::Frame;

/// In [`Picture::id`]: no triangle or polygon wrote here.
pub const NO_TRIANGLE: i32 = -1;

/// What a light does to a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Lit {
    /// No fragment was written.
    Nothing = 0,
    /// The last fragment written is in shadow.
    Shadow = 1,
    /// The last fragment written is lit, or no light casts shadows.
    Lit = 2,
}

/// A drawn frame; every list runs line by line from the top, pixel by pixel from the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Pixels a line.
    pub width: u32,
    /// Lines.
    pub height: u32,
    /// Fragments over the pixel, whether they pass the depth test or not.
    pub coverage: Vec<u32>,
    /// Fragments that passed the depth test and whose colour is stored.
    pub writes: Vec<u32>,
    /// Place among the frame's primitives of the last of these, or [`NO_TRIANGLE`].
    pub id: Vec<i32>,
    /// Depth, cleared to 1.
    pub z: Vec<f64>,
    /// Red, green, blue.
    pub rgb: Vec<[f64; 3]>,
    /// Values of the user's own, by channel, exact like depth: those of the last fragment that passed, 0 for none.
    pub extra: Vec<Vec<f64>>,
    /// What the light does.
    pub lit: Vec<Lit>,
}

impl Picture {
    /// Nothing drawn yet.
    pub(crate) fn cleared(frame: &Frame, lines: usize) -> Self {
        let size = frame.width as usize * lines;
        Self {
            width: frame.width,
            height: lines as u32,
            coverage: vec![0; size],
            writes: vec![0; size],
            id: vec![NO_TRIANGLE; size],
            z: vec![1.0; size],
            rgb: vec![frame.clear; size],
            extra: vec![vec![0.0; size]; frame.extra],
            lit: vec![Lit::Nothing; size],
        }
    }
}
