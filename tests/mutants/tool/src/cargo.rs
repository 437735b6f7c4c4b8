//! Checking and building the tree with the switches.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use serde_json::Value;

/// The tree, where its builds go, and the packages that are built.
pub struct Build {
    pub tree: PathBuf,
    pub target: PathBuf,
    pub crates: Vec<String>,
}

/// An error of the compiler: file and bytes of its places, the main ones first.
pub struct Refused {
    pub message: String,
    pub places: Vec<(String, Range<usize>)>,
}

/// A program of tests.
pub struct Program {
    pub owner: String,
    pub path: PathBuf,
}

impl Build {
    /// Errors of the crates and their tests; none: it builds.
    pub fn check(&self) -> Result<Vec<Refused>> {
        let (passed, messages, said) = self.cargo(&["check", "--tests", "--keep-going"], "1")?;
        let mut refused = Vec::new();
        for message in messages.iter().filter(|message| message["reason"] == "compiler-message") {
            let message = &message["message"];
            if message["level"] != "error" {
                continue;
            }
            let Some(spans) = message["spans"].as_array().filter(|spans| !spans.is_empty()) else { continue };
            let (main, other): (Vec<_>, Vec<_>) = spans.iter().partition(|span| span["is_primary"] == true);
            let places = main.into_iter().chain(other).flat_map(places_of).collect();
            refused.push(Refused {
                message: message["rendered"].as_str().unwrap_or_default().to_owned(),
                places,
            });
        }
        if !passed && refused.is_empty() {
            bail!("cargo check fails, and no error has a place: {said}");
        }
        Ok(refused)
    }

    /// Builds the programs of the crates' tests.
    pub fn programs(&self) -> Result<Vec<Program>> {
        // Without what would build a part again, as nothing changes.
        let (passed, messages, said) = self.cargo(&["test", "--tests", "--no-run"], "0")?;
        if !passed {
            bail!("what passes cargo check does not build: {said}");
        }
        let mut programs = Vec::new();
        for message in &messages {
            if message["reason"] != "compiler-artifact" || message["profile"]["test"] != true {
                continue;
            }
            let Some(path) = message["executable"].as_str() else { continue };
            let manifest = message["manifest_path"].as_str().context("an artifact without a manifest")?;
            let folder = Path::new(manifest)
                .parent()
                .and_then(Path::file_name)
                .context("a manifest without a folder")?;
            programs.push(Program { owner: folder.to_string_lossy().into_owned(), path: path.into() });
        }
        Ok(programs)
    }

    /// Whether it passes, its messages, and what else it says.
    fn cargo(&self, arguments: &[&str], incremental: &str) -> Result<(bool, Vec<Value>, String)> {
        let mut command = Command::new("cargo");
        command.args(arguments).args([
            "--release",
            "--quiet",
            "--message-format=json",
            "--features",
            "edgewalk-cli/jit",
        ]);
        for owner in &self.crates {
            command.args(["--package", &format!("edgewalk-{owner}")]);
        }
        command
            .current_dir(&self.tree)
            .env("CARGO_TARGET_DIR", &self.target)
            .env("CARGO_INCREMENTAL", incremental);
        // A fault may be what a lint forbids.
        command.env("RUSTFLAGS", "--cap-lints=allow");
        let output = command.output().context("cargo")?;
        let lines = String::from_utf8_lossy(&output.stdout).into_owned();
        let messages = lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        Ok((output.status.success(), messages, String::from_utf8_lossy(&output.stderr).into_owned()))
    }
}

/// The place of a span, and those of the macros that it was written by.
fn places_of(span: &Value) -> Vec<(String, Range<usize>)> {
    let mut places = Vec::new();
    let mut next = Some(span);
    while let Some(span) = next.filter(|span| span.is_object()) {
        let byte = |name: &str| span[name].as_u64().unwrap_or(0) as usize;
        let file = span["file_name"].as_str().unwrap_or_default().to_owned();
        places.push((file, byte("byte_start")..byte("byte_end")));
        next = span.pointer("/expansion/span");
    }
    places
}
