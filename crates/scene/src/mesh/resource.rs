//! The bytes that a glTF file brings: its buffers, in the file, beside it, or as base64 in its text.

use crate::error::{Fault, InputError};
use crate::file;
use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf::Document;
use gltf::buffer::Source;
use std::io::Read as _;
use std::path::Path;

/// Most bytes of a glTF file, and of all its buffers together.
pub(super) const MAX_BYTES: u64 = 1 << 30;

/// The bytes of every buffer: as many as it declares. `blob` is the binary part of the file at `path`.
pub(super) fn buffers(
    path: &Path,
    document: &Document,
    blob: Option<&[u8]>,
) -> Result<Vec<Vec<u8>>, InputError> {
    let name = path.display().to_string();
    let mut buffers = Vec::new();
    let mut room = MAX_BYTES;
    for buffer in document.buffers() {
        let key = format!("buffer {}", buffer.index());
        let fault = |value: String, permitted: String| Fault::new(&name, None, &key, value, permitted);
        let length = buffer.length() as u64;
        room = room.checked_sub(length).ok_or_else(|| {
            let permitted = format!("permitted: at most {MAX_BYTES} bytes in all buffers");
            fault(format!("byteLength {length}"), permitted)
        })?;
        let bytes = match buffer.source() {
            Source::Bin => declared(blob.unwrap_or_default(), length),
            Source::Uri(uri) => match Uri::of(uri).map_err(|why| fault(uri.to_owned(), why.to_owned()))? {
                Uri::Data(bytes) => declared(&bytes[..], length),
                Uri::Beside(beside) => declared(file::open(&path.with_file_name(beside))?, length),
            },
        };
        let bytes = bytes.map_err(|source| InputError::Read { file: format!("{name}: {key}"), source })?;
        if (bytes.len() as u64) < length {
            let permitted = format!("permitted: the {length} bytes that its byteLength declares");
            return Err(fault(format!("{} bytes", bytes.len()), permitted).into());
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

/// No more than the declared bytes.
fn declared(from: impl std::io::Read, length: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(length).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Where the bytes of a buffer or a picture are.
pub(super) enum Uri {
    /// In the text.
    Data(Vec<u8>),
    /// In a file of this name, beside the glTF file.
    Beside(String),
}

impl Uri {
    /// Reads a URI; the error says what is permitted.
    pub fn of(uri: &str) -> Result<Self, &'static str> {
        if let Some(data) = uri.strip_prefix("data:") {
            let lenient =
                GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
            let bytes = data.split_once(";base64,").map(|(_, text)| text);
            let bytes = bytes.and_then(|text| GeneralPurpose::new(&STANDARD, lenient).decode(text).ok());
            return bytes.map(Self::Data).ok_or("permitted: `data:` TYPE `;base64,` and base64");
        }
        if uri.is_empty() || uri.contains(':') {
            return Err("permitted: the name of a file beside this one, or a `data:` URI");
        }
        unescaped(uri).map(Self::Beside).ok_or("permitted: UTF-8, with % only before two hex digits")
    }
}

/// A name with `%20` and the like as the bytes they stand for.
fn unescaped(uri: &str) -> Option<String> {
    let mut parts = uri.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        let digits = part.get(..2).filter(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()))?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        bytes.extend(&part.as_bytes()[2..]);
    }
    String::from_utf8(bytes).ok()
}
