//! What an input is, by its name.

use crate::error::{Fault, InputError};
use edgewalk_nearest::nearest;
use std::path::Path;

/// What a name on the command line stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputKind {
    /// A file of screen-space triangles, or a pipe that gives one.
    Triangles,
    /// A built-in scene, or a scene file.
    Scene,
    /// A mesh file.
    Mesh,
}

/// The names of the built-in scenes.
pub(crate) const BUILTIN: [&str; 5] = ["sphere", "torus", "torus-knot", "terrain", "room"];

/// Every end of a file's name, with what the file is.
const ENDS: [(&str, InputKind); 5] = [
    ("tri", InputKind::Triangles),
    ("toml", InputKind::Scene),
    ("obj", InputKind::Mesh),
    ("gltf", InputKind::Mesh),
    ("glb", InputKind::Mesh),
];

impl InputKind {
    /// The name of the standard input, a triangle file.
    pub const STANDARD_INPUT: &'static str = "-";

    /// The kind of an input; `None` of a name that says none.
    pub fn of(name: &str) -> Option<Self> {
        let path = Path::new(name);
        let piped = || path.metadata().is_ok_and(|data| !data.is_file() && !data.is_dir());
        if BUILTIN.contains(&name) {
            return Some(Self::Scene);
        }
        match path.extension() {
            Some(end) => {
                let known = ENDS.iter().find(|(known, _)| end.eq_ignore_ascii_case(known));
                known.map(|(_, kind)| *kind)
            }
            None if name == Self::STANDARD_INPUT || piped() => Some(Self::Triangles),
            None => None,
        }
    }

    /// Whether a name is that of screen-space triangles.
    pub fn is_triangles(name: &str) -> bool {
        Self::of(name) == Some(Self::Triangles)
    }
}

/// What is wrong with a name that says no kind.
pub(crate) fn unknown(name: &str) -> InputError {
    let builtin = BUILTIN.join(" ");
    let path = Path::new(name);
    let end = path.extension().map(|end| end.to_string_lossy());
    if end.is_none() && !path.exists() {
        let mut fault = Fault::new("built-in scenes", None, "name", name, format!("permitted: {builtin}"));
        fault.nearest = nearest(name, BUILTIN);
        return fault.into();
    }
    let permitted = format!(
        "permitted: the name of a built-in scene ({builtin}), or a file that ends in .tri (screen-space triangles), \
         .toml (a scene), .obj, .gltf or .glb (a mesh); a pipe without such an end gives triangles"
    );
    let mut fault = Fault::new(name, None, "kind of input", end.as_deref().unwrap_or_default(), permitted);
    fault.nearest = end.and_then(|end| nearest(&end, ENDS.map(|(end, _)| end)));
    fault.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn message_names_every_end() {
        let message = unknown("notes.md").to_string();
        for (end, _) in ENDS {
            assert!(message.contains(&format!(".{end}")), "{message}");
        }
    }

    #[test]
    fn end_of_a_name_says_its_kind() {
        for (name, kind) in [
            ("torus-knot", Some(InputKind::Scene)),
            ("a.TOML", Some(InputKind::Scene)),
            ("a.b/c.tri", Some(InputKind::Triangles)),
            ("-", Some(InputKind::Triangles)),
            ("/dev/null", Some(InputKind::Triangles)),
            ("A.Glb", Some(InputKind::Mesh)),
            ("/", None),
            ("a.md", None),
            ("tri", None),
        ] {
            assert_eq!(InputKind::of(name), kind, "{name}");
        }
    }
}
