//! Reads a triangle file line by line: as a whole, or triangle by triangle, whatever its length.

use super::extra;
use super::rules;
use super::shadow::{occluder, shadow};
use crate::band::Host;
use crate::error::InputError;
use crate::frame::{
    DEPTH_ROUNDING, Frame, MAX_CONTOUR, MAX_COORDINATE, MAX_SIDE, Polygon, ShadeMode, Triangle, Vertex,
};
use crate::pass::State;
use crate::text::{Lines, Place, words};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::path::Path;

/// Every word a line may start with.
const KEYS: [&str; 15] = [
    "size",
    "mode",
    "clear",
    "extra",
    "shadow",
    "L",
    "depth",
    "depth_write",
    "blend",
    "colour_write",
    "clear_depth",
    "T",
    "X",
    "P",
    "H",
];
const SIZE: usize = 0;
/// `depth` to `clear_depth`: also permitted between triangles.
const RULES: Range<usize> = 6..11;
/// `T`, `X`, `P` and `H`: the header has ended.
const PRIMITIVE: usize = 11;

/// The numbers of a vertex, in the order of the file.
const ATTRIBUTES: [&str; 7] = ["x", "y", "z", "r", "g", "b", "kt"];

/// Reads the file at `path`.
///
/// # Errors
/// The file cannot be read, or an item of it is not permitted.
pub fn read(path: &Path) -> Result<Frame, InputError> {
    let file = path.display().to_string();
    match File::open(path) {
        Ok(opened) => parse(&file, BufReader::with_capacity(1 << 16, opened)),
        Err(source) => Err(InputError::Read { file, source }),
    }
}

/// Reads the text of a file that messages call `file`.
///
/// # Errors
/// `input` fails, or an item is not permitted.
pub fn parse(file: &str, input: impl BufRead) -> Result<Frame, InputError> {
    let mut reader = Reader::new(file, input)?;
    while reader.line()? {}
    Ok(reader.parser.frame)
}

/// A file triangle by triangle: takes as much memory as its longest line.
///
/// An item is a triangle, or an error; there is nothing worth reading after that. A polygon, and `shadow` or other rules
/// behind a triangle, are [`InputError::NeedsWhole`].
pub struct Reader<R> {
    lines: Lines<R>,
    parser: Parser,
}

impl<R: BufRead> Reader<R> {
    /// Reads the header of a file that messages call `file`.
    ///
    /// # Errors
    /// `input` fails, or an item down to the first triangle or polygon is not permitted.
    pub fn new(file: &str, input: R) -> Result<Self, InputError> {
        let frame = Frame::new(0, 0);
        let parser = Parser { rules: frame.state(), frame, seen: [false; KEYS.len()], open: None };
        let mut reader = Self { lines: Lines::new(file, input), parser };
        while !reader.parser.seen[PRIMITIVE] && reader.line()? {}
        reader.parser.require_size(reader.lines.end(), b"end of file")?;
        Ok(reader)
    }

    /// The frame without what it draws.
    pub fn header(&self) -> &Frame {
        &self.parser.frame
    }

    /// The last line has what there is no drawing with before the end of the file.
    fn needs_whole(&self, key: &str) -> InputError {
        let why = "permitted: only triangles from here on, where a file is drawn while it is read";
        InputError::NeedsWhole(self.lines.place().fault("line starts with", key.as_bytes(), why))
    }

    /// Reads a line into the frame; false at the end.
    fn line(&mut self) -> Result<bool, InputError> {
        let Some((place, text)) = self.lines.next()? else {
            self.parser.require_values(self.lines.end(), b"end of file")?;
            return Ok(false);
        };
        self.parser.line(place, text)?;
        Ok(true)
    }
}

impl<R: BufRead> Iterator for Reader<R> {
    type Item = Result<Triangle, InputError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if !self.parser.frame.polygons.is_empty() {
                return Some(Err(self.needs_whole("P")));
            }
            if self.parser.open.is_none()
                && let Some(triangle) = self.parser.frame.triangles.pop()
            {
                return Some(Ok(triangle));
            }
            let shadows = self.parser.frame.shadow.is_some();
            match self.line() {
                Ok(true) if !shadows && self.parser.frame.shadow.is_some() => {
                    return Some(Err(self.needs_whole("shadow")));
                }
                Ok(true) if !self.parser.frame.changes.is_empty() => {
                    return Some(Err(
                        self.needs_whole("depth, depth_write, blend, colour_write or clear_depth")
                    ));
                }
                Ok(true) => {}
                Ok(false) => return None,
                Err(error) => return Some(Err(error)),
            }
        }
    }
}

struct Parser {
    frame: Frame,
    /// The rules of the next primitive, as the file has them.
    rules: State,
    /// Which of `KEYS` have come.
    seen: [bool; KEYS.len()],
    /// The line of the last triangle, if its values of the user's own are still to come.
    open: Option<usize>,
}

impl Parser {
    fn line(&mut self, place: Place, text: &[u8]) -> Result<(), InputError> {
        let mut words = words(text);
        let Some(word) = words.next() else { return Ok(()) };
        let key = place.choice("line starts with", word, &KEYS)?;
        let name = KEYS[key];
        if name != "X" {
            self.require_values(place, word)?;
        }
        if name == "L" {
            let Some(shadow) = &mut self.frame.shadow else {
                let why = "permitted only after a line `shadow SIZE BIAS AMBIENT m00 .. m33`";
                return Err(place.fault(name, word, why).into());
            };
            shadow.triangles.push(occluder(place, words)?);
            return Ok(());
        }
        if key >= PRIMITIVE {
            self.require_size(place, word)?;
            self.seen[PRIMITIVE] = true;
            return self.primitive(place, name, words);
        }
        if RULES.contains(&key) && self.seen[PRIMITIVE] {
            return rules::change(place, name, words, &mut self.rules, &mut self.frame);
        }
        if self.seen[PRIMITIVE] && name != "shadow" {
            let why = "permitted only before the first triangle or polygon";
            return Err(place.fault(name, word, why).into());
        }
        if std::mem::replace(&mut self.seen[key], true) {
            return Err(place.fault(name, word, "permitted once; it was set before").into());
        }
        match name {
            "size" => {
                let [width, height] = place.values(name, words)?;
                self.frame.width = place.number("size W", width, "an integer", 1..=MAX_SIDE)?;
                self.frame.height = place.number("size H", height, "an integer", 1..=MAX_SIDE)?;
            }
            "mode" => {
                let [mode] = place.values(name, words)?;
                self.frame.mode = ShadeMode::ALL[place.choice(name, mode, &ShadeMode::NAMES)?];
            }
            _ if RULES.contains(&key) => {
                rules::read(place, name, words, &mut self.rules)?;
                rules::begin(self.rules, &mut self.frame);
            }
            "extra" => self.frame.extra = extra::count(place, words)?,
            "shadow" => self.frame.shadow = Some(shadow(place, words)?),
            _ => {
                let clear: [&[u8]; 3] = place.values(name, words)?;
                for (channel, word) in clear.into_iter().enumerate() {
                    let key = format_args!("clear {}", ["r", "g", "b"][channel]);
                    self.frame.clear[channel] = place.number(key, word, "a number", 0.0..=1.0)?;
                }
            }
        }
        Ok(())
    }

    fn primitive<'a>(
        &mut self,
        place: Place,
        name: &str,
        words: impl Iterator<Item = &'a [u8]>,
    ) -> Result<(), InputError> {
        let after = self.frame.triangles.len();
        let drawn = after + self.frame.polygons.len();
        let changed = self.frame.changes.last().is_some_and(|change| change.after == drawn);
        match name {
            "T" => {
                let triangle = triangle(place, words, &mut self.frame.host)?;
                self.frame.triangles.push(triangle);
                self.open = (self.frame.extra > 0).then_some(place.line);
            }
            "X" => {
                let open = self.open.take().and_then(|_| self.frame.triangles.last_mut());
                extra::values(place, words, self.frame.extra, open)?;
            }
            _ if self.frame.extra > 0 => return Err(extra::polygon(place, name, self.frame.extra)),
            "P" => {
                let contours = vec![contour(place, name, words, &mut self.frame.host)?];
                self.frame.polygons.push(Polygon { contours, after });
            }
            _ => match self.frame.polygons.last_mut().filter(|polygon| polygon.after == after && !changed) {
                Some(polygon) => polygon.contours.push(contour(place, name, words, &mut self.frame.host)?),
                None => {
                    let why = "permitted only on the lines after a polygon `P n x y z r g b kt ...`";
                    return Err(place.fault("line starts with", name.as_bytes(), why).into());
                }
            },
        }
        Ok(())
    }

    /// A triangle has its values before anything else comes.
    fn require_values(&self, place: Place, before: &[u8]) -> Result<(), InputError> {
        self.open.map_or(Ok(()), |line| Err(extra::missing(place, before, self.frame.extra, line)))
    }

    fn require_size(&self, place: Place, before: &[u8]) -> Result<(), InputError> {
        if self.seen[SIZE] {
            return Ok(());
        }
        let why = format!("`size W H` is missing; it must come first, W and H from 1 to {MAX_SIDE}");
        Err(place.fault("size", before, why).into())
    }
}

fn triangle<'a>(
    place: Place,
    words: impl Iterator<Item = &'a [u8]>,
    host: &mut Host,
) -> Result<Triangle, InputError> {
    let words: [&[u8]; 3 * ATTRIBUTES.len()] = place.values("T", words)?;
    let mut triangle = Triangle::default();
    for (index, (slot, words)) in triangle.0.iter_mut().zip(words.chunks_exact(ATTRIBUTES.len())).enumerate()
    {
        *slot = vertex(place, "T", index, words, host)?;
    }
    Ok(triangle)
}

/// The number of vertices and as many vertices.
fn contour<'a>(
    place: Place,
    key: &str,
    mut words: impl Iterator<Item = &'a [u8]>,
    host: &mut Host,
) -> Result<Vec<Vertex>, InputError> {
    let count = words.next().unwrap_or_default();
    let count = place.number(format_args!("{key} n"), count, "an integer", 3..=MAX_CONTOUR)?;
    let words: Vec<&[u8]> = words.collect();
    if words.len() != count * ATTRIBUTES.len() {
        let found = format!("{} given", words.len());
        let permitted = format!(
            "permitted: {} values after n, x y z r g b kt of {count} vertices",
            count * ATTRIBUTES.len()
        );
        return Err(place.fault(key, found.as_bytes(), permitted).into());
    }
    let vertices = words.chunks_exact(ATTRIBUTES.len()).enumerate();
    vertices.map(|(i, words)| vertex(place, key, i, words, host)).collect()
}

fn vertex(
    place: Place,
    key: &str,
    index: usize,
    words: &[&[u8]],
    host: &mut Host,
) -> Result<Vertex, InputError> {
    let mut numbers = [0.0; ATTRIBUTES.len()];
    for (a, (number, word)) in numbers.iter_mut().zip(words).enumerate() {
        let range = match a {
            0 | 1 => -MAX_COORDINATE..=MAX_COORDINATE,
            2 => -DEPTH_ROUNDING..=1.0 + DEPTH_ROUNDING,
            _ => 0.0..=1.0,
        };
        let key = format_args!("{key} vertex {} {}", index + 1, ATTRIBUTES[a]);
        *number = place.number(key, word, "a number", range)?;
    }
    let [x, y, depth, r, g, b, kt] = numbers;
    let z = depth.clamp(0.0, 1.0);
    host.clamped_depths += u64::from(z != depth);
    Ok(Vertex { x, y, z, r, g, b, kt, ..Vertex::default() })
}
