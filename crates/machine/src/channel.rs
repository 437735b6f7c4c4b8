//! Interpolated values: their kinds and formats.
//!
//! ```text
//!  vertex value ──SETUP──> word, stepped ──PIXEL──> output
//!    b+e bits              b+r bits, modular        b bits
//! ```

use edgewalk_numerics::Format;
use std::ops::Deref;

/// Most channels a machine has.
pub const MAX_CHANNELS: usize = 8;

/// How the word of a channel is read and rounded (`docs/machine.md`, section 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Unsigned, 2^b - 1 stands for 1.0; the output is rounded to nearest: depth, colours.
    Unorm,
    /// Two's complement, the output is rounded to nearest: depth in a light's view, normals.
    Signed,
    /// Two's complement, the output is the floor: a texel is the floor of its coordinate.
    Floor,
    /// Unsigned, 2^(b-1) stands for 1.0 and is the largest, so that 1 is exact; the output is rounded to nearest:
    /// transmission. Not for channels of the user's own.
    Weight,
}

impl Kind {
    /// The kinds that the user's own channels can have, in the order of the key's words.
    pub const ALL: [Kind; 3] = [Kind::Unorm, Kind::Signed, Kind::Floor];
    /// Words of the kinds in files and reports.
    pub const NAMES: [&'static str; 3] = ["unorm", "signed", "floor"];

    /// The word in files and reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.get(self as usize).copied().unwrap_or("weight")
    }

    /// Words and outputs are two's complement.
    #[must_use]
    pub const fn is_signed(self) -> bool {
        matches!(self, Kind::Signed | Kind::Floor)
    }

    /// The output is rounded to nearest: the first value carries 2^(r-1).
    #[must_use]
    pub const fn is_rounded(self) -> bool {
        !matches!(self, Kind::Floor)
    }
}

/// Word lengths of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Precision {
    /// Output bits b, the sign included where there is one.
    pub bits: u32,
    /// Fraction bits r of the interpolator below the output's last bit.
    pub fraction: u32,
    /// Fraction bits e of the vertex value below the output's last bit, e <= r.
    pub vertex_fraction: u32,
}

impl Precision {
    /// Bits of the interpolated word, b + r.
    #[must_use]
    pub fn word(self) -> u32 {
        self.bits + self.fraction
    }

    /// Bits of the vertex value at the port, b + e.
    #[must_use]
    pub fn vertex_bits(self) -> u32 {
        self.bits + self.vertex_fraction
    }

    /// The largest output of a channel without sign, 2^b - 1, which stands for 1.0.
    #[must_use]
    pub fn max(self) -> u64 {
        (1 << self.bits) - 1
    }
}

/// One interpolated value of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Channel {
    /// Name in ports, files and reports.
    pub name: &'static str,
    /// How it is read and rounded.
    pub kind: Kind,
    /// Word lengths of the channel.
    pub precision: Precision,
}

/// The word lengths of a channel are the channel's own.
impl Deref for Channel {
    type Target = Precision;

    fn deref(&self) -> &Precision {
        &self.precision
    }
}

impl Channel {
    /// Largest magnitude of an output that a vertex may ask for, LSB: 2^b - 1, signed 2^(b-1) - 1, of a weight 2^(b-1). So
    /// no mean of vertices leaves the range, and no word needs a clamp.
    #[must_use]
    pub fn limit(&self) -> u64 {
        match self.kind {
            Kind::Unorm => self.max(),
            Kind::Signed | Kind::Floor => (1 << (self.bits - 1)) - 1,
            Kind::Weight => 1 << (self.bits - 1),
        }
    }

    /// What the value is, in the words of ports and reports.
    #[must_use]
    pub fn what(&self) -> String {
        let what = match self.name {
            "z" => "depth",
            "r" => "red",
            "g" => "green",
            "b" => "blue",
            "lx" => "column in the light's map",
            "ly" => "line in the light's map",
            "lz" => "depth from the light",
            "lw" => "divisor of the light's perspective",
            "kt" => "kt",
            own => return format!("channel {own}"),
        };
        what.to_owned()
    }

    /// The name of a vertex's value at the port, `place` being the vertex's number: `z0`, `e1_0`.
    #[must_use]
    pub fn at_vertex(&self, place: &str) -> String {
        let gap = if self.name.ends_with(|c: char| c.is_ascii_digit()) { "_" } else { "" };
        format!("{}{gap}{place}", self.name)
    }

    /// Format of the vertex value: b integer and e fraction bits, LSB.
    #[must_use]
    pub fn vertex_format(&self) -> Format {
        self.format(self.vertex_fraction)
    }

    /// Format of the interpolated word: b integer and r fraction bits, LSB, modular.
    #[must_use]
    pub fn word_format(&self) -> Format {
        self.format(self.fraction)
    }

    /// Format of the output: b integer bits, LSB.
    #[must_use]
    pub fn output_format(&self) -> Format {
        self.format(0)
    }

    fn format(&self, fraction: u32) -> Format {
        Format::new(self.kind.is_signed(), self.bits, fraction).expect("a planned word has 2 to 56 bits")
    }
}
