//! An input of a sweep, opened once for each way in which the machines shade it.

use super::shading;
use anyhow::{Context as _, Result};
use edgewalk_host::input::Input;

/// An input.
pub struct Subject {
    /// As it was asked for.
    pub name: String,
    /// A way of shading each; a triangle file, which says itself how it is shaded, has one.
    ways: Vec<Way>,
}

/// An input, shaded in one way.
pub struct Way {
    /// The name of the way; none of a triangle file.
    pub shading: Option<&'static str>,
    /// What is drawn.
    pub input: Input,
    /// Twelve hex digits that stand for it.
    pub hash: String,
}

impl Subject {
    /// The input, shaded in each of these ways.
    ///
    /// # Errors
    /// No such input, or a fault in it.
    pub fn open(name: &str, shadings: &[&'static str]) -> Result<Subject> {
        let way = |shading: &str| -> Result<Way> {
            let (shading, shaded) = shading::named(shading)?;
            let input = Input::open(name, shaded)?;
            let hash = input.hash().with_context(|| name.to_owned())?;
            Ok(Way { shading: input.size().is_none().then_some(shading), input, hash })
        };
        let mut ways = Vec::new();
        for shading in shadings {
            ways.push(way(shading)?);
            if ways[0].shading.is_none() {
                break;
            }
        }
        Ok(Subject { name: name.to_owned(), ways })
    }

    /// The place of the way with this name; a triangle file has one way alone.
    #[must_use]
    pub fn place(&self, shading: &str) -> usize {
        self.ways.iter().position(|way| way.shading == Some(shading)).unwrap_or(0)
    }

    /// The way at that place.
    #[must_use]
    pub fn way(&self, place: usize) -> &Way {
        &self.ways[place]
    }

    /// The screen that the input brings, pixels; scenes are drawn on any.
    #[must_use]
    pub fn size(&self) -> Option<(u32, u32)> {
        self.ways.first().and_then(|way| way.input.size())
    }
}
