//! What was found of each pixel, and what all of it comes to.

use super::{Edge, Picture, Rule, Tolerance};
use crate::verdict::Verdict;
use edgewalk_host::raster::Raster;
use serde::Serialize;

/// Why a pixel differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cause {
    /// A triangle does not cover the pixel in the picture: the background shows, or what lies behind.
    Missing,
    /// A triangle covers the pixel that should not.
    Extra,
    /// The picture shows another triangle over the pixel, whose depth is so near that the tolerance lets either win.
    Tie,
    /// The picture shows another triangle.
    WrongWinner,
    /// The depth is beyond the tolerance.
    Depth,
    /// A colour is beyond the tolerance.
    Color,
    /// Depth and colour are right; the pixel is covered more often than by the reference.
    Twice,
    /// Depth and colour are right; the pixel is covered less often than by the reference.
    LayerMissing,
    /// The light is decided otherwise.
    Light,
    /// The pixel is right for the pieces into which the machine's guard band cuts a triangle.
    Piece,
    /// Of several layers at the pixel two have depths so near that the tolerance lets either win.
    Open,
}

impl Cause {
    /// All causes, in the order of reports.
    pub const ALL: [Cause; 11] = [
        Cause::Missing,
        Cause::Extra,
        Cause::Tie,
        Cause::WrongWinner,
        Cause::Depth,
        Cause::Color,
        Cause::Twice,
        Cause::LayerMissing,
        Cause::Light,
        Cause::Piece,
        Cause::Open,
    ];

    /// In words.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Cause::Missing => "missing",
            Cause::Extra => "extra",
            Cause::Tie => "tie of depth (allowed)",
            Cause::WrongWinner => "wrong winner",
            Cause::Depth => "depth beyond the tolerance",
            Cause::Color => "colour beyond the tolerance",
            Cause::Twice => "covered more often",
            Cause::LayerMissing => "covered less often",
            Cause::Light => "light decided otherwise",
            Cause::Piece => "right for a triangle cut at the guard band (allowed)",
            Cause::Open => "open depth test among layers (allowed)",
        }
    }

    /// Whether the pixel is wrong. A tie is not, nor an open depth test, nor a triangle as the machine cuts it.
    #[must_use]
    pub fn is_wrong(self) -> bool {
        !matches!(self, Cause::Tie | Cause::Piece | Cause::Open)
    }
}

/// A pixel that differs. Pairs are the reference's value, then the picture's.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// Column.
    pub x: u32,
    /// Line.
    pub y: u32,
    /// Why.
    pub cause: Cause,
    /// Place in the input of the triangle, polygon or line that the reference shows, or of a frame without colours the triangle whose
    /// depth it stores; -1 none.
    pub triangle: i32,
    /// Place in the input of the one that the picture shows, where it is known to be another.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shown: Option<i32>,
    /// What these two are called.
    #[serde(skip)]
    pub kinds: [&'static str; 2],
    /// Depths in 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<[f64; 2]>,
    /// Colours in 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rgb: Option<[[f64; 3]; 2]>,
    /// Triangles over the pixel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coverage: Option<[u32; 2]>,
    /// Errors of depth and colour beside what the reference shows, LSB.
    pub error_lsb: [f64; 2],
    /// The edge that decides, of a pixel that is missing or extra.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge: Option<Edge>,
}

impl Finding {
    /// As a line of text.
    fn line(&self) -> String {
        let Finding { x, y, cause, triangle, shown, kinds: [kind, other], error_lsb: [z, color], .. } = self;
        let at = format!("  ({x}, {y}) {}", cause.text());
        let of = if *triangle < 0 { "the background".to_owned() } else { format!("{kind} {triangle}") };
        let values_of = if *triangle < 0 { String::new() } else { format!("{of}: ") };
        let why = match cause {
            Cause::Missing | Cause::Extra => self.edge.map_or_else(String::new, |edge| {
                let Edge { triangle, kind, vertices: [from, to], distance } = edge;
                let place = match distance {
                    0.0 => "on".to_owned(),
                    d if d < 0.0 => format!("{:.4} px outside of", -d),
                    d => format!("{d:.4} px inside of"),
                };
                format!(": {kind} {triangle}: the centre lies {place} the edge of vertices {from} and {to}")
            }),
            Cause::Tie | Cause::WrongWinner => {
                let shown = shown.map_or_else(|| "another".to_owned(), |id| format!("{other} {id}"));
                format!(": {shown} for {of}; depth {z:.4} LSB off")
            }
            Cause::Depth => format!(": {values_of}{z:.4} LSB off"),
            Cause::Color => format!(": {values_of}{color:.4} LSB off"),
            Cause::Twice | Cause::LayerMissing => {
                self.coverage.map_or_else(String::new, |[reference, own]| format!(": {own} for {reference}"))
            }
            Cause::Piece => {
                format!(": {values_of}depth {z:.4} and colour {color:.4} LSB off golden's of all of it")
            }
            Cause::Open => format!(": depth {z:.4} and colour {color:.4} LSB off {of}"),
            Cause::Light => String::new(),
        };
        at + &why
    }
}

/// What all pixels together come to.
#[derive(Clone, Debug, Serialize)]
pub struct Judgement {
    /// Pixels of the screen, all of which were compared.
    pub pixels: u64,
    /// Pixels that the reference covers.
    pub covered: u64,
    /// Arrays compared.
    pub compared: Vec<&'static str>,
    /// Largest permitted errors.
    pub tolerance: Tolerance,
    /// Pixels of which all that was compared agrees.
    pub agree: u64,
    /// Largest errors of depth and colour of these, LSB; none of what was not compared.
    pub largest_error_lsb: [Option<f64>; 2],
    /// Pixels by cause.
    pub causes: Vec<Count>,
    /// The first pixels of each cause.
    pub examples: Vec<Finding>,
    /// The place of each pixel's cause among [`Cause::ALL`], `u8::MAX` where it agrees.
    #[serde(skip)]
    pub map: Vec<u8>,
    #[serde(skip)]
    size: (u32, u32),
}

/// Pixels with a cause.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Count {
    /// Why they differ.
    pub cause: Cause,
    /// Whether that is wrong.
    pub wrong: bool,
    /// How many.
    pub pixels: u64,
}

/// Pixels of a cause that are told one by one.
const EXAMPLES: u64 = 10;

/// In [`Judgement::map`]: the pixel agrees.
pub const AGREES: u8 = u8::MAX;

impl Judgement {
    /// Nothing compared yet.
    pub(super) fn new(reference: &Raster, outside: &Picture, tolerance: Tolerance) -> Self {
        let arrays = [
            ("coverage", outside.coverage.is_some()),
            ("id", outside.id.is_some()),
            ("z", outside.z.is_some()),
            ("rgb", outside.rgb.is_some()),
            ("lit", outside.lit.is_some() && reference.lit.is_some()),
        ];
        Judgement {
            pixels: reference.coverage.len() as u64,
            covered: reference.coverage.iter().filter(|count| **count > 0).count() as u64,
            compared: arrays.into_iter().filter_map(|(name, there)| there.then_some(name)).collect(),
            tolerance,
            agree: 0,
            largest_error_lsb: [outside.z.is_some(), outside.rgb.is_some()].map(|there| there.then_some(0.0)),
            causes: Cause::ALL.map(|cause| Count { cause, wrong: cause.is_wrong(), pixels: 0 }).to_vec(),
            examples: Vec::new(),
            map: vec![AGREES; reference.coverage.len()],
            size: (reference.width, reference.height),
        }
    }

    pub(super) fn agrees(&mut self, errors: [f64; 2]) {
        self.agree += 1;
        for (largest, error) in self.largest_error_lsb.iter_mut().zip(errors) {
            *largest = largest.map(|largest| largest.max(error));
        }
    }

    /// `edge` is asked for the pixels that are told one by one.
    pub(super) fn differs(
        &mut self,
        pixel: usize,
        mut found: Finding,
        edge: impl FnOnce(&Finding) -> Option<Edge>,
    ) {
        let place = found.cause as usize;
        self.map[pixel] = place as u8;
        let count = &mut self.causes[place].pixels;
        *count += 1;
        if *count <= EXAMPLES {
            found.edge = edge(&found);
            self.examples.push(found);
        }
    }

    /// Of a mirrored frame, as the screen has it.
    pub(super) fn turned(mut self, rule: Rule) -> Self {
        rule.turn((self.size.0 as usize, self.size.1 as usize), &mut self.map);
        for found in &mut self.examples {
            (found.x, found.y) = rule.place(self.size, (found.x, found.y));
        }
        self
    }

    /// Pixels that are wrong.
    #[must_use]
    pub fn wrong(&self) -> u64 {
        self.causes.iter().filter(|count| count.wrong).map(|count| count.pixels).sum()
    }

    /// Pass if pixels are covered and none is wrong. Where an open depth test is at each covered pixel, and none agrees, nothing was
    /// compared.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match (self.covered, self.wrong()) {
            (0, 0) => Verdict::Vacuous,
            (covered, 0) if covered == self.causes[Cause::Open as usize].pixels => Verdict::Open,
            (_, wrong) => Verdict::of(self.pixels, self.agree + self.differ(), wrong),
        }
    }

    fn differ(&self) -> u64 {
        self.causes.iter().map(|count| count.pixels).sum()
    }

    /// As lines of text.
    #[must_use]
    pub fn lines(&self) -> String {
        let Judgement { pixels, covered, agree, tolerance, largest_error_lsb, .. } = self;
        let mut t = format!(
            "compared {} of {pixels} pixels, {covered} of them covered\n{agree} agree; {} differ, {} of them wrong\n",
            self.compared.join(", "),
            self.differ(),
            self.wrong()
        );
        let Tolerance { z, color, z_bits, color_bits, layers, z_no_bound, color_no_bound, .. } = *tolerance;
        let kinds = [
            ("depth", z, z_bits, None, z_no_bound, "--depth-lsb"),
            ("colour", color, color_bits, layers, color_no_bound, "--color-lsb"),
        ];
        for ((name, permitted, bits, layers, no_bound, option), largest) in
            kinds.into_iter().zip(largest_error_lsb)
        {
            let Some(largest) = largest else { continue };
            let layers = layers
                .map_or_else(String::new, |most| format!(", at most {most:.4} behind the layers of a pixel"));
            t += &format!(
                "{name}: tolerance {permitted:.4} LSB of {bits} bits{layers}, largest error where pixels agree {largest:.4}\n"
            );
            if let Some(why) = no_bound {
                t += &format!(
                    "{name}: no bound is proved: {why}; the tolerance takes 1 LSB for such a value; {option} sets another tolerance\n"
                );
            }
        }
        for Count { cause, pixels, .. } in self.causes.iter().filter(|count| count.pixels > 0) {
            t += &format!("{pixels} {}\n{}", cause.text(), self.lines_of(*cause));
        }
        t
    }

    /// The pixels of a cause, a line each.
    #[must_use]
    pub fn lines_of(&self, cause: Cause) -> String {
        let of_cause = self.examples.iter().filter(|found| found.cause == cause);
        let lines: String = of_cause.map(|found| found.line() + "\n").collect();
        match self.causes[cause as usize].pixels.saturating_sub(EXAMPLES) {
            0 => lines,
            more => lines + &format!("  and {more} more\n"),
        }
    }
}
