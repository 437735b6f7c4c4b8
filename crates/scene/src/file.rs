//! Opens the files that an input is or names, so that reading them ends: no device, and of what a file names no pipe either.

use crate::error::{Fault, InputError};
use crate::inputs;
use std::fs::{File, FileType};
use std::io::{self, Read as _};
use std::os::unix::fs::FileTypeExt as _;
use std::path::Path;

/// Opens a regular file.
///
/// # Errors
/// No file of that name that can be read, or a folder, a pipe, a device or a socket.
pub(crate) fn open(path: &Path) -> Result<File, InputError> {
    checked(path, |kind| kind.is_file(), "permitted: a regular file")
}

/// Opens a regular file, or a pipe that the user named.
///
/// # Errors
/// No file of that name that can be read, or a folder, a device or a socket.
pub(crate) fn open_input(path: &Path) -> Result<File, InputError> {
    checked(path, |kind| kind.is_file() || kind.is_fifo(), "permitted: a regular file or a pipe")
}

/// As [`open`]; `None` where there is no file of that name.
pub(crate) fn open_if_there(path: &Path) -> Result<Option<File>, InputError> {
    match open(path) {
        Ok(opened) => Ok(Some(opened)),
        Err(InputError::Read { source, .. }) if source.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// The bytes of an input of at most `most` bytes.
pub(crate) fn read(path: &Path, most: u64) -> Result<Vec<u8>, InputError> {
    let file = path.display().to_string();
    let mut bytes = Vec::new();
    let ended = open_input(path)?.take(most + 1).read_to_end(&mut bytes);
    ended.map_err(|source| InputError::Read { file: file.clone(), source })?;
    if bytes.len() as u64 > most {
        let permitted = format!("permitted: at most {most} bytes");
        return Err(Fault::new(&file, None, "length", format!("over {most} bytes"), permitted).into());
    }
    Ok(bytes)
}

fn checked(path: &Path, may_be: impl FnOnce(FileType) -> bool, permitted: &str) -> Result<File, InputError> {
    let file = path.display().to_string();
    let unreadable = |source| InputError::Read { file: file.clone(), source };
    // Opening a pipe would wait for its writer.
    let kind = path.metadata().map_err(unreadable)?.file_type();
    if !may_be(kind) {
        let name = if kind.is_dir() {
            "a folder"
        } else if kind.is_fifo() {
            "a pipe"
        } else {
            "a device or a socket"
        };
        return Err(Fault::new(&file, None, "kind of file", name, permitted).into());
    }
    let opened = File::open(path).map_err(unreadable)?;
    inputs::note(path);
    Ok(opened)
}
