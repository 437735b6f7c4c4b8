//! Words as a shell takes them.

use std::path::Path;

/// A word, in quotes unless all of its characters are plain.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,@%+".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

/// The name of a file or folder as such a word, which no program takes for an option.
pub fn quoted_path(path: &Path) -> String {
    let name = path.display().to_string();
    quoted(&if name.starts_with('-') { format!("./{name}") } else { name })
}
