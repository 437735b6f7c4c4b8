//! The rules by which fragments are drawn: shading mode, depth test and blending, and where they change.

/// How colour and k_t vary over a triangle. Depth and the user's own values are linear in both modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ShadeMode {
    /// Linear between the vertices (ch. 7.5).
    Gouraud,
    /// One colour, that of the first vertex (ch. 7.4).
    Flat,
}

impl ShadeMode {
    /// Both modes, in the order of [`Self::NAMES`].
    pub const ALL: [Self; 2] = [Self::Gouraud, Self::Flat];
    /// The names in files.
    pub const NAMES: [&'static str; 2] = ["gouraud", "flat"];

    /// The name in files.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// When a fragment passes the depth test: its depth compared with the stored one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DepthFunc {
    /// Never.
    Never,
    /// Nearer than what is stored.
    Less,
    /// As near.
    Equal,
    /// Nearer or as near.
    Lequal,
    /// Farther.
    Greater,
    /// Not as near.
    Notequal,
    /// Farther or as near.
    Gequal,
    /// Always.
    Always,
}

impl DepthFunc {
    /// All eight, in the order of [`Self::NAMES`].
    pub const ALL: [Self; 8] = [
        Self::Never,
        Self::Less,
        Self::Equal,
        Self::Lequal,
        Self::Greater,
        Self::Notequal,
        Self::Gequal,
        Self::Always,
    ];
    /// The names in files.
    pub const NAMES: [&'static str; 8] =
        ["never", "less", "equal", "lequal", "greater", "notequal", "gequal", "always"];

    /// The name in files.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// How the colour I of a fragment that passes is put together with what its pixel has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Blending {
    /// I alone.
    Off,
    /// (1 - k_t) I + k_t I_back (ch. 7.5).
    Mix,
    /// I + I_back, at most 1.
    Add,
}

impl Blending {
    /// All, in the order of [`Self::NAMES`].
    pub const ALL: [Self; 3] = [Self::Off, Self::Mix, Self::Add];
    /// The names in files.
    pub const NAMES: [&'static str; 3] = ["0", "1", "add"];

    /// The name in files.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// The rules for fragments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct State {
    /// The depth test; `None` lets every fragment pass and leaves the stored depth alone.
    pub depth: Option<DepthFunc>,
    /// Whether a fragment that passes stores its depth; without effect where `depth` is `None`.
    pub depth_write: bool,
    /// What becomes of the colour.
    pub blend: Blending,
    /// Whether a fragment that passes stores its colour and the values of the user's own.
    pub color_write: bool,
    /// The number of the light whose shadows count, from 1; 0, or one that the frame has not: none.
    pub light: usize,
}

impl State {
    /// A fragment that passes stores its depth.
    pub fn stores_depth(&self) -> bool {
        self.depth_write && self.depth.is_some()
    }
}

/// Other rules from a place in the list on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// Primitives drawn before it; at least as many as before the change in front of it.
    pub after: usize,
    /// The rules from there on.
    pub state: State,
    /// The depth is cleared first.
    pub clear_depth: bool,
}
