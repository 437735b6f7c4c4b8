//! A frame as a list of passes: triangles that are drawn by the same rules, one list after the other.

use crate::run::DrawState;

/// Some triangles and their rules. The machine is idle before a pass begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// How many, those behind the pass before.
    pub triangles: usize,
    /// The rules; `clear` is that of the picture's first pass.
    pub state: DrawState,
    /// The depth memory is cleared first; of the light's own pass the map, with what is left of the light.
    pub clear_depth: bool,
    /// With SHADOW the map that is looked up, or drawn, by its place among those that come with the passes or are drawn by them; none: that of the
    /// pass before.
    pub map: Option<usize>,
}

/// The rules that the picture begins with: those of its first pass, whatever map is drawn before.
#[must_use]
pub fn first_of_picture(passes: &[Pass]) -> DrawState {
    let of_picture = passes.iter().find(|pass| !pass.state.light_pass);
    of_picture.map_or_else(DrawState::default, |pass| pass.state)
}

impl Pass {
    /// All triangles by the same rules.
    #[must_use]
    pub fn all(state: DrawState) -> Pass {
        Pass { triangles: usize::MAX, state, clear_depth: false, map: None }
    }
}
