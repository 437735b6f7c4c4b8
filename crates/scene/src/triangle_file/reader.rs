//! Reads a triangle file line by line: as a whole, or triangle by triangle, whatever its length.

use super::extra;
use super::rules;
use super::shading::{self, Header};
use super::shadow::{occluder, shadow};
use super::texture;
use super::vertices::{contour, ends, triangle};
use crate::error::InputError;
use crate::frame::{Frame, Line, MAX_LIGHTS, MAX_SIDE, Polygon};
use crate::inputs;
use crate::kind::InputKind;
use crate::rules::State;
use crate::text::{Lines, Place, words};
use crate::vertex::Triangle;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// Every word a line may start with.
const KEYS: [&str; 25] = [
    "size",
    "mode",
    "view",
    "ambient",
    "sun",
    "specular",
    "clear",
    "extra",
    "shadow",
    "L",
    "depth",
    "depth_write",
    "blend",
    "colour_write",
    "light",
    "clear_depth",
    "material",
    "texture",
    "T",
    "X",
    "N",
    "UV",
    "P",
    "H",
    "S",
];
const SIZE: usize = 0;
/// `depth` to `clear_depth`: also permitted between triangles.
const RULES: Range<usize> = 10..16;
/// `T` to `S`: the header has ended.
const PRIMITIVE: usize = 18;

/// Opens the file at `path`, which may be a pipe; `-` is the standard input.
///
/// # Errors
/// The file cannot be opened.
pub fn open(path: &Path) -> Result<File, InputError> {
    let standard_input = path == Path::new(InputKind::STANDARD_INPUT);
    let place = if standard_input { Path::new("/dev/stdin") } else { path };
    let opened = File::open(place);
    let opened = opened.map_err(|source| InputError::Read { file: path.display().to_string(), source })?;
    inputs::note(place);
    Ok(opened)
}

/// Reads the file at `path`, which may be a pipe; `-` is the standard input.
///
/// # Errors
/// The file cannot be read, or an item of it is not permitted.
pub fn read(path: &Path) -> Result<Frame, InputError> {
    parse(&path.display().to_string(), BufReader::with_capacity(1 << 16, open(path)?))
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
/// An item is a triangle, or an error; there is nothing worth reading after that. A polygon, a line, and `shadow` or
/// other rules behind a triangle, are [`InputError::NeedsWhole`].
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
        let (rules, header) = (frame.state(), Header::default());
        let parser = Parser {
            rules,
            frame,
            header,
            seen: [false; KEYS.len()],
            open: None,
            bare: None,
            unplaced: None,
            light: None,
        };
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
            self.parser.end(self.lines.end())?;
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
            if !self.parser.frame.lines.is_empty() {
                return Some(Err(self.needs_whole("S")));
            }
            if let Some(shading) = &self.parser.frame.shading {
                return Some(Err(self.needs_whole(shading.method.name())));
            }
            if self.parser.open.is_none()
                && let Some(triangle) = self.parser.frame.triangles.pop()
            {
                return Some(Ok(triangle));
            }
            let shadows = self.parser.frame.shadows.len();
            match self.line() {
                Ok(true) if self.parser.frame.shadows.len() > shadows => {
                    return Some(Err(self.needs_whole("shadow")));
                }
                Ok(true) if !self.parser.frame.changes.is_empty() => {
                    return Some(Err(
                        self.needs_whole("depth, depth_write, blend, colour_write, light or clear_depth")
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
    /// Of shading at each pixel, until the first triangle.
    header: Header,
    /// The line of the last triangle, if its values of the user's own are still to come.
    open: Option<usize>,
    /// The line of the last triangle, if its normals are still to come.
    bare: Option<usize>,
    /// The line of the last triangle, if its texture coordinates are still to come.
    unplaced: Option<usize>,
    /// The largest number behind `light`, and its line.
    light: Option<(usize, usize)>,
}

impl Parser {
    fn line(&mut self, place: Place, text: &[u8]) -> Result<(), InputError> {
        let mut words = words(text);
        let Some(word) = words.next() else { return Ok(()) };
        let key = place.choice("line starts with", word, &KEYS)?;
        let name = KEYS[key];
        if !["X", "N", "UV"].contains(&name) {
            self.require_values(place, word)?;
        }
        if name == "L" {
            let Some(shadow) = self.frame.shadows.last_mut() else {
                let why = "permitted only after a line `shadow SIZE BIAS AMBIENT m00 .. m33`";
                return Err(place.fault(name, word, why).into());
            };
            return occluder(place, words, shadow);
        }
        if key >= PRIMITIVE {
            self.require_size(place, word)?;
            if !std::mem::replace(&mut self.seen[PRIMITIVE], true) {
                self.header.end(place, word, &mut self.frame)?;
            }
            return self.primitive(place, name, words);
        }
        if RULES.contains(&key) && self.seen[PRIMITIVE] {
            rules::change(place, name, words, &mut self.rules, &mut self.frame)?;
            self.names_light(place, name);
            return Ok(());
        }
        let behind = self.seen[PRIMITIVE].then_some(&self.frame);
        match name {
            "material" => return self.header.material(place, words, behind),
            "texture" => {
                let slot = self.header.texture(place, behind)?;
                *slot = Some(Arc::new(texture::texels(place, words)?));
                return Ok(());
            }
            _ => {}
        }
        if self.seen[PRIMITIVE] && name != "shadow" {
            let why = "permitted only before the first triangle or polygon";
            return Err(place.fault(name, word, why).into());
        }
        if std::mem::replace(&mut self.seen[key], true) && !["sun", "shadow"].contains(&name) {
            return Err(place.fault(name, word, "permitted once; it was set before").into());
        }
        match name {
            "size" => {
                let [width, height] = place.values(name, "W H", words)?;
                self.frame.width = place.number("size W", width, "an integer", 1..=MAX_SIDE)?;
                self.frame.height = place.number("size H", height, "an integer", 1..=MAX_SIDE)?;
            }
            "mode" => self.header.mode(place, words, &mut self.frame)?,
            "view" | "ambient" | "sun" | "specular" => self.header.line(place, name, words)?,
            _ if RULES.contains(&key) => {
                rules::read(place, name, words, &mut self.rules)?;
                rules::begin(self.rules, &mut self.frame);
                self.names_light(place, name);
            }
            "extra" => self.frame.extra = extra::count(place, words)?,
            "shadow" if self.frame.shadows.len() == MAX_LIGHTS => {
                let why = format!("permitted at most {MAX_LIGHTS} times");
                return Err(place.fault(name, word, why).into());
            }
            "shadow" => self.frame.shadows.push(shadow(place, words)?),
            _ => {
                let clear: [&[u8]; 3] = place.values(name, "r g b", words)?;
                for (channel, word) in clear.into_iter().enumerate() {
                    let key = format_args!("clear {}", ["r", "g", "b"][channel]);
                    self.frame.clear[channel] = place.color(key, word)?;
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
        let surfaces = after + self.frame.polygons.len();
        let changed = self.frame.changes.last().is_some_and(|change| change.after == self.frame.drawn())
            || self.frame.lines.last().is_some_and(|line| line.after == surfaces);
        match name {
            "T" => {
                let triangle = triangle(place, words, &mut self.frame.host)?;
                self.frame.triangles.push(triangle);
                self.open = (self.frame.extra > 0).then_some(place.line);
                if let Some(shading) = &mut self.frame.shading {
                    let textured = self.header.triangle(place, shading)?;
                    (self.bare, self.unplaced) = (Some(place.line), textured.then_some(place.line));
                }
            }
            "N" => {
                let open = self.bare.take().is_some();
                shading::normals(place, words, open, self.frame.shading.as_mut())?;
            }
            "UV" => {
                let open = self.unplaced.take().is_some();
                texture::coordinates(place, words, open, self.frame.shading.as_mut())?;
            }
            "X" => {
                let open = self.open.take().and_then(|_| self.frame.triangles.last_mut());
                extra::values(place, words, self.frame.extra, open)?;
            }
            _ if self.frame.extra > 0 => return Err(extra::polygon(place, name, self.frame.extra)),
            _ if let Some(shading) = &self.frame.shading => {
                return Err(shading::polygon(place, name, shading.method));
            }
            "S" => {
                let ends = ends(place, words, &mut self.frame.host)?;
                self.frame.lines.push(Line { ends, after: surfaces });
            }
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

    /// A line `light` has set the rules: whether there is such a light is known at the end of the file.
    fn names_light(&mut self, place: Place, name: &str) {
        if name == "light" && self.light.is_none_or(|(most, _)| self.rules.light > most) {
            self.light = Some((self.rules.light, place.line));
        }
    }

    /// The file ends; its header too, if nothing is drawn.
    fn end(&mut self, place: Place) -> Result<(), InputError> {
        let before = b"end of file";
        self.require_values(place, before)?;
        let lights = self.frame.shadows.len();
        if let Some((light, line)) = self.light.filter(|(light, _)| *light > lights) {
            let why = match lights {
                0 => "permitted: 0, as the file has no line `shadow`".to_owned(),
                _ => format!("permitted: 0 to {lights}, as many lights as the file has lines `shadow`"),
            };
            return Err(Place { line, ..place }.fault("light", light.to_string().as_bytes(), why).into());
        }
        if self.seen[PRIMITIVE] { Ok(()) } else { self.header.end(place, before, &mut self.frame) }
    }

    /// A triangle has its values and its normals before anything else comes.
    fn require_values(&self, place: Place, before: &[u8]) -> Result<(), InputError> {
        match (self.open, self.bare, self.unplaced) {
            (Some(line), _, _) => Err(extra::missing(place, before, self.frame.extra, line)),
            (None, Some(line), _) => Err(shading::missing(place, before, line)),
            (None, None, Some(line)) => Err(texture::missing(place, before, line)),
            (None, None, None) => Ok(()),
        }
    }

    fn require_size(&self, place: Place, before: &[u8]) -> Result<(), InputError> {
        if self.seen[SIZE] {
            return Ok(());
        }
        let why = format!(
            "`size W H` is missing; it stands before the first triangle, W and H from 1 to {MAX_SIDE}"
        );
        Err(place.fault("size", before, why).into())
    }
}
