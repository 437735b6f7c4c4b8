//! The name that was meant by one that does not exist: for the end of an error message.
//!
//! ```
//! let kinds = ["none", "constant", "interpolated"];
//! assert_eq!(edgewalk_nearest::nearest("constnat", kinds), Some("constant"));
//! assert_eq!(edgewalk_nearest::nearest("glass", kinds), None);
//! ```
//! Next: [`Unknown`] is the error with the list of what is permitted; crate `machine` uses it for keys.

use std::fmt;

/// Longer words are near to no name, bytes: comparing takes as long as both words together.
const LONGEST: usize = 240;

/// The name that is near enough to `word` to be what was meant; `None` where every name is far.
///
/// A name is near if at most a third of its letters, rounded, are wrong: in each part, before and behind a point.
/// A key `section.name` is also near to its bare name.
/// A word that is the beginning or the end of one name alone, up to a `-`, `_` or point, means that name.
#[must_use]
pub fn nearest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > LONGEST {
        return None;
    }
    let word = word.to_lowercase();
    let names: Vec<&str> = names.into_iter().collect();
    let near = names.iter().filter_map(|name| Some((wrong(&word, name)?, *name)));
    near.min_by_key(|(wrong, _)| *wrong).map(|(_, name)| name).or_else(|| {
        let mut whole = names.iter().filter(|name| is_part(&word, name));
        whole.next().filter(|_| whole.next().is_none()).copied()
    })
}

/// How many letters are wrong, if few enough are.
fn wrong(word: &str, name: &str) -> Option<usize> {
    match (word.split_once('.'), name.split_once('.')) {
        (Some((section, key)), Some((of, name))) => Some(letters(section, of)? + letters(key, name)?),
        (None, Some((_, name))) => letters(word, name),
        (_, None) => letters(word, name),
    }
}

fn letters(word: &str, name: &str) -> Option<usize> {
    let wrong = strsim::damerau_levenshtein(word, &name.to_lowercase());
    let few = (name.chars().count() + 1) / 3;
    (wrong == 0 || wrong <= few.min(word.chars().count().saturating_sub(1))).then_some(wrong)
}

/// `up5k` and `ice40` are parts of `ice40-up5k`.
fn is_part(word: &str, name: &str) -> bool {
    let separator = |letter: char| "-_.".contains(letter);
    let name = name.to_lowercase();
    !word.is_empty()
        && (name.strip_suffix(word).is_some_and(|before| before.ends_with(separator))
            || name.strip_prefix(word).is_some_and(|behind| behind.starts_with(separator)))
}

/// A name that does not exist.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// The kind of thing that was named, e.g. `unit`.
    pub what: &'static str,
    /// The name as it was given.
    pub name: String,
    /// The names there are.
    pub permitted: Vec<String>,
}

impl Unknown {
    /// `name` is none of `permitted`.
    #[must_use]
    pub fn new<'a>(what: &'static str, name: &str, permitted: impl IntoIterator<Item = &'a str>) -> Unknown {
        Unknown { what, name: name.to_owned(), permitted: permitted.into_iter().map(str::to_owned).collect() }
    }
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Unknown { what, name, permitted } = self;
        write!(f, "unknown {what} {name}; permitted: {}", permitted.join(", "))?;
        match nearest(name, permitted.iter().map(String::as_str)) {
            Some(near) => write!(f, "; nearest: {near}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Unknown {}

#[cfg(test)]
mod tests {
    use super::*;

    const KEYS: [&str; 6] = [
        "shadow.transmits",
        "memory.hazard",
        "formats.color_bits",
        "formats.z_bits",
        "screen.width",
        "fifo.span",
    ];
    const TARGETS: [&str; 3] = ["ice40-hx8k", "ice40-up5k", "ecp5-25"];
    const WORDS: [&str; 4] = ["less", "lequal", "always", "off"];

    #[test]
    fn a_near_name_is_found() {
        for (word, names, near) in [
            ("hazard", &KEYS[..], "memory.hazard"),
            ("memory.hazrad", &KEYS, "memory.hazard"),
            ("width", &KEYS, "screen.width"),
            ("formats.colour_bits", &KEYS, "formats.color_bits"),
            ("up5k", &TARGETS, "ice40-up5k"),
            ("ecp5", &TARGETS, "ecp5-25"),
            ("ICE40-HX8K", &TARGETS, "ice40-hx8k"),
            ("lesss", &WORDS, "less"),
            ("LEQUAL", &WORDS, "lequal"),
            ("alwyas", &WORDS, "always"),
            ("of", &WORDS, "off"),
        ] {
            assert_eq!(nearest(word, names.iter().copied()), Some(near), "{word}");
        }
    }

    #[test]
    fn a_far_name_is_not_suggested() {
        let long = "less".repeat(100);
        for (word, names) in [
            ("foo", &KEYS[..]),
            ("formats.radix", &KEYS),
            ("ice40", &TARGETS),
            ("nosuch", &["machine", "engine", "setup", "edge", "span", "pixel", "depth", "bump", "shadow"]),
            ("quadratic", &WORDS),
            ("lost", &WORDS),
            ("x", &WORDS),
            ("", &WORDS),
            (&long, &WORDS),
        ] {
            assert_eq!(nearest(word, names.iter().copied()), None, "{word}");
        }
    }

    #[test]
    fn an_unknown_name_says_what_is_permitted() {
        let said = |name| Unknown::new("target", name, TARGETS).to_string();
        let all = "permitted: ice40-hx8k, ice40-up5k, ecp5-25";
        assert_eq!(said("up5k"), format!("unknown target up5k; {all}; nearest: ice40-up5k"));
        assert_eq!(said("foo"), format!("unknown target foo; {all}"));
    }
}
