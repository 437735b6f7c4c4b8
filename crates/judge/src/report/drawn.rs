//! What was drawn of an input, and what the host did to it before.

use edgewalk_host::raster::Raster;
use edgewalk_machine::{Counted, Plan};
use edgewalk_scene::Host;
use serde::ser::{Serialize, SerializeMap as _, Serializer};
use std::fmt::Write as _;

/// An input on a machine's screen.
#[derive(Clone, serde::Serialize)]
pub struct Drawn {
    /// As it was asked for.
    pub input: String,
    /// The machine's hash.
    pub machine: String,
    /// Columns.
    pub width: u32,
    /// Lines.
    pub height: u32,
    /// Of the input.
    pub triangles: u64,
    /// Of the input.
    pub polygons: u64,
    /// Of the input; left out where there are none.
    #[serde(skip_serializing_if = "is_none")]
    pub lines: u64,
    /// Triangles and polygons over all pixels together.
    pub fragments: u64,
    /// Writes to all pixels together.
    pub writes: u64,
    /// Pixels that an odd number of triangles covers; a closed mesh has none, whatever the view.
    pub odd_pixels: u64,
    /// What was done to the triangles before the machine.
    #[serde(serialize_with = "host_in_json")]
    pub host: Host,
}

impl Drawn {
    /// Of an input with so many triangles, nothing drawn yet.
    #[must_use]
    pub fn new(input: &str, triangles: u64, machine: &Plan, host: Host) -> Self {
        Drawn {
            input: input.to_owned(),
            machine: machine.hash(),
            width: machine.width,
            height: machine.height,
            triangles,
            polygons: 0,
            lines: 0,
            fragments: 0,
            writes: 0,
            odd_pixels: 0,
            host,
        }
    }

    /// Counts the next lines of the picture in.
    pub fn add(&mut self, band: &Raster) {
        self.fragments += band.coverage.iter().map(|c| u64::from(*c)).sum::<u64>();
        self.odd_pixels += band.coverage.iter().map(|c| u64::from(c % 2)).sum::<u64>();
        self.writes += band.writes.iter().map(|c| u64::from(*c)).sum::<u64>();
    }

    /// Triangles, polygons and lines of the input.
    #[must_use]
    pub fn primitives(&self) -> u64 {
        self.triangles + self.polygons + self.lines
    }

    /// As lines of text.
    pub(super) fn in_lines(&self) -> String {
        let Drawn { input, machine, width, height, fragments, writes, .. } = self;
        let [triangles, polygons, lines] =
            [self.triangles, self.polygons, self.lines].map(|count| count as usize);
        let counted = Counted { triangles, polygons, lines };
        let mut t = format!("{input}: {counted} on {width}x{height}, machine {machine}\n");
        t += &host_in_words(&self.host);
        // Writing to a string cannot fail.
        _ = writeln!(t, "fragments {fragments}, writes {writes}");
        t
    }
}

fn is_none(count: &u64) -> bool {
    *count == 0
}

fn host_in_json<S: Serializer>(host: &Host, serializer: S) -> Result<S::Ok, S::Error> {
    let Host { off_screen, clipped, pieces, clamped_depths } = host;
    let mut map = serializer.serialize_map(None)?;
    map.serialize_entry("off_screen", off_screen)?;
    map.serialize_entry("clipped", clipped)?;
    map.serialize_entry("pieces", pieces)?;
    map.serialize_entry("clamped_depths", clamped_depths)?;
    map.end()
}

/// A line where anything was done.
fn host_in_words(host: &Host) -> String {
    let Host { off_screen, clipped, pieces, clamped_depths } = *host;
    let mut done = Vec::new();
    if off_screen > 0 {
        done.push(format!("{off_screen} beyond the guard band and off the screen, left out"));
    }
    if clipped > 0 {
        done.push(format!("{clipped} cut at the guard band into {pieces}"));
    }
    if clamped_depths > 0 {
        done.push(format!("{clamped_depths} depths beyond 0 or 1 by rounding, clamped"));
    }
    if done.is_empty() { String::new() } else { format!("host: {}\n", done.join("; ")) }
}

/// Names with their counts, as an object.
pub(super) fn counts<S: Serializer, T: Serialize>(
    list: &[(&'static str, T)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(list.iter().map(|(name, count)| (name, count)))
}
