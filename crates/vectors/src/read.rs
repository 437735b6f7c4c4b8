//! Reads a directory of vectors back, and trusts nothing in it.

use crate::manifest::{self, Manifest};
use crate::write::file;
use edgewalk_lockstep::{Token, pack};

/// The vectors of a directory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Vectors {
    /// The manifest.
    pub manifest: Manifest,
    /// Tokens and cycles of every channel, in the order of the manifest; none of a memory's words, which have no file.
    pub channels: Vec<Vec<(Token, u64)>>,
    /// Changes of the status.
    pub status: Vec<(Token, u64)>,
}

/// Why a directory is refused.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// A file cannot be had.
    #[error("{file}: {source}")]
    Io {
        /// Name of the file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// The manifest is not what it should be.
    #[error("{}: {source}", manifest::FILE)]
    Manifest {
        /// Place and reason.
        source: serde_json::Error,
    },
    /// The directory holds something else.
    #[error("{}: format is {found:?}, not {:?}", manifest::FILE, manifest::FORMAT)]
    Format {
        /// What it says it is.
        found: String,
    },
    /// The program of another version wrote it.
    #[error(
        "{}: format_version {found}: this program reads {} only; write the directory again with `edgewalk vectors`",
        manifest::FILE,
        manifest::VERSION
    )]
    Version {
        /// Version of the file.
        found: u64,
    },
    /// The module is no name.
    #[error("{}: module {found:?} is no Verilog name", manifest::FILE)]
    Module {
        /// What stands there.
        found: String,
    },
    /// A file is not the one that was written.
    #[error("{file}: {found}, the manifest says {wanted}")]
    Changed {
        /// Name of the file.
        file: String,
        /// Length or hash.
        found: String,
        /// As the manifest has it.
        wanted: String,
    },
    /// A memory file does not hold what the manifest says.
    #[error("{file} line {line}: {reason}")]
    Token {
        /// Name of the file.
        file: String,
        /// From 1.
        line: usize,
        /// What is wrong.
        reason: String,
    },
}

/// Only what every version of the format has.
#[derive(serde::Deserialize)]
struct Head {
    format: String,
    format_version: u64,
}

/// Reads a directory; `load` gives the contents of a file by its name in the directory.
///
/// # Errors
/// A file that is missing, changed or malformed, another format or a newer one.
pub fn read(mut load: impl FnMut(&str) -> std::io::Result<Vec<u8>>) -> Result<Vectors, ReadError> {
    let mut get = |name: &str| load(name).map_err(|source| ReadError::Io { file: name.to_owned(), source });
    let json = get(manifest::FILE)?;
    let head: Head = serde_json::from_slice(&json).map_err(|source| ReadError::Manifest { source })?;
    if head.format != manifest::FORMAT {
        return Err(ReadError::Format { found: head.format });
    }
    if head.format_version != u64::from(manifest::VERSION) {
        return Err(ReadError::Version { found: head.format_version });
    }
    let manifest: Manifest =
        serde_json::from_slice(&json).map_err(|source| ReadError::Manifest { source })?;
    // The name goes into commands of tools.
    let plain = |name: &str| name.chars().all(|c| c.is_ascii_alphanumeric() || "_$".contains(c));
    let top = manifest.dut.as_ref().map(|dut| dut.top.as_str());
    if let Some(name) = [Some(manifest.module.as_str()), top].into_iter().flatten().find(|name| !plain(name))
    {
        return Err(ReadError::Module { found: name.to_owned() });
    }
    for wanted in &manifest.files {
        let found = file(&wanted.name, &get(&wanted.name)?);
        let changed = |found: String, wanted_text: String| {
            Err(ReadError::Changed { file: wanted.name.clone(), found, wanted: wanted_text })
        };
        if found.bytes != wanted.bytes {
            return changed(format!("{} bytes", found.bytes), wanted.bytes.to_string());
        }
        if found.sha256 != wanted.sha256 {
            return changed(format!("SHA-256 {}", found.sha256), wanted.sha256.clone());
        }
    }
    let mut tokens = |fields: &[manifest::Field], count: u64, tokens: &str, cycles: &str| {
        let widths: Vec<u32> = fields.iter().map(|field| field.width).collect();
        let values = parse(tokens, &get(tokens)?, &widths, count)?;
        let steps = parse(cycles, &get(cycles)?, &[32], count)?;
        let cycles = steps.into_iter().scan(0u32, |cycle, step| {
            *cycle = cycle.wrapping_add(step[0] as u32); // 32 bits
            Some(u64::from(*cycle))
        });
        Ok(values.into_iter().zip(cycles).collect::<Vec<_>>())
    };
    let channels = manifest.channels.iter().map(|c| match (&c.tokens, &c.moved) {
        (Some(values), Some(cycles)) => tokens(&c.fields, c.count, values, cycles),
        _ => Ok(Vec::new()),
    });
    let channels = channels.collect::<Result<_, ReadError>>()?;
    let status = &manifest.status;
    let status = tokens(&status.fields, status.count, &status.tokens, &status.moved)?;
    Ok(Vectors { channels, status, manifest })
}

fn parse(file: &str, bytes: &[u8], widths: &[u32], count: u64) -> Result<Vec<Token>, ReadError> {
    let error = |line: usize, reason: String| ReadError::Token { file: file.to_owned(), line, reason };
    let text = std::str::from_utf8(bytes).map_err(|e| error(1, e.to_string()))?;
    let mut tokens = Vec::new();
    for (line, word) in text.lines().enumerate() {
        let bits: u32 = widths.iter().sum();
        let token = pack::unpack(widths, word);
        tokens.push(
            token.ok_or_else(|| error(line + 1, format!("{word:?} is no word of {bits} bits in hex")))?,
        );
    }
    if tokens.len() as u64 != count {
        return Err(error(tokens.len(), format!("{} words, the manifest says {count}", tokens.len())));
    }
    Ok(tokens)
}
