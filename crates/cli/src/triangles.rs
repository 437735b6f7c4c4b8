//! A triangle file that is opened once and read as often as need be, whatever it is: of a pipe, what has been read is kept
//! in a temporary file without a name.

use anyhow::{Context, Result};
use edgewalk_scene::triangle_file::{Reader, open, parse};
use edgewalk_scene::{Frame, InputError};
use indicatif::ProgressBar;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek as _, Write as _};
use std::path::Path;

/// Read a piece at a time: many lines.
const BUFFER: usize = 1 << 16;

/// An open triangle file.
pub struct TriangleFile {
    name: String,
    file: File,
    /// What has been read of a file that cannot be read again.
    kept: Option<File>,
}

impl TriangleFile {
    /// Opens it.
    pub fn open(path: &Path) -> Result<Self> {
        let name = path.display().to_string();
        let unreadable = |source| InputError::Read { file: name.clone(), source };
        let file = open(path)?;
        let kind = file.metadata().map_err(unreadable)?.file_type();
        let again = kind.is_file() || kind.is_dir();
        let kept = if again { None } else { Some(tempfile::tempfile().context("a temporary file")?) };
        Ok(TriangleFile { name, file, kept })
    }

    /// What messages call it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Bytes; 0 where that is not known.
    pub fn length(&self) -> u64 {
        self.file.metadata().map_or(0, |data| data.len())
    }

    /// What it says before its first triangle.
    pub fn header(&self) -> Result<Frame> {
        Ok(self.reader(&ProgressBar::hidden())?.header().clone())
    }

    /// From its first triangle on; the bar follows its bytes.
    pub fn reader(&self, bar: &ProgressBar) -> Result<Reader<impl BufRead>> {
        Ok(Reader::new(&self.name, BufReader::with_capacity(BUFFER, bar.wrap_read(self.start()?)))?)
    }

    /// All of it.
    pub fn whole(&self) -> Result<Frame> {
        Ok(parse(&self.name, BufReader::with_capacity(BUFFER, self.start()?))?)
    }

    /// The bytes of the file, from the first on.
    fn start(&self) -> Result<Bytes<'_>> {
        let rewound = self.kept.as_ref().unwrap_or(&self.file).rewind();
        rewound.with_context(|| self.name.clone())?;
        Ok(Bytes(self))
    }
}

/// The bytes of the file, as far as they were kept from there, and then from the file.
struct Bytes<'a>(&'a TriangleFile);

impl Read for Bytes<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let TriangleFile { file, kept, .. } = self.0;
        let (mut file, Some(mut kept)) = (file, kept.as_ref()) else { return (&self.0.file).read(buffer) };
        match kept.read(buffer)? {
            0 => {
                let count = file.read(buffer)?;
                kept.write_all(&buffer[..count])?;
                Ok(count)
            }
            count => Ok(count),
        }
    }
}
