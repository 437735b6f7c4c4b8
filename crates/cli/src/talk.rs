//! How a command talks: the one way to standard output, and the one to standard error.
//!
//! A reader that closes the pipe early (`| head`) has all it wants: that is no error, and the command ends as it would
//! have. Output that cannot be written for another reason is one.

use crate::document::line;
use anyhow::{Context, Result};
use serde_json::json;
use std::io::{self, ErrorKind, Write as _};

/// What of a command's report is wanted.
#[derive(Clone, Copy)]
pub struct Talk {
    /// As one JSON value instead of text.
    pub json: bool,
    /// Nothing but errors; JSON that was asked for comes all the same.
    pub quiet: bool,
}

impl Talk {
    /// Prints the report as asked.
    pub fn say(self, json: impl FnOnce() -> Result<String>, text: impl FnOnce() -> String) -> Result<()> {
        match self {
            Talk { json: true, .. } => print(&json()?),
            Talk { quiet: true, .. } => Ok(()),
            _ => print(&plain(&text())),
        }
    }

    /// Says on standard error why the command fails, and with which code it ends. Where standard error cannot be written
    /// either, the exit code is all there is.
    pub fn fail(self, why: &str, exit_code: u8) {
        let text = || format!("error: {why}");
        let json =
            || line("error", json!({ "error": why, "exit_code": exit_code })).unwrap_or_else(|_| text());
        _ = writeln!(io::stderr(), "{}", if self.json { json() } else { plain(&text()) });
    }

    /// Says on standard error what may not be as wanted, though nothing is wrong.
    pub fn warn(self, what: &str) {
        let text = || format!("warning: {what}");
        let json = || line("warning", json!({ "warning": what })).unwrap_or_else(|_| text());
        _ = writeln!(io::stderr(), "{}", if self.json { json() } else { plain(&text()) });
    }
}

/// A text of which no character steers the terminal: control characters, which a file of the user may hold, become escapes.
fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for letter in text.chars() {
        if letter.is_control() && !matches!(letter, '\n' | '\t') {
            plain.extend(letter.escape_default());
        } else {
            plain.push(letter);
        }
    }
    plain
}

/// Writes lines to standard output; the last one is ended if it is not.
pub fn print(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    let end = if text.ends_with('\n') { "" } else { "\n" };
    let written = out.write_all(text.as_bytes()).and_then(|()| out.write_all(end.as_bytes()));
    printed(written.and_then(|()| out.flush()))
}

/// What has become of a write to standard output.
pub fn printed(written: io::Result<()>) -> Result<()> {
    match written {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => other.context("standard output"),
    }
}
