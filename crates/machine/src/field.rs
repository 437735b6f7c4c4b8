//! The fields of a token: what a wire is called, how wide it is, and what its bits mean.

use crate::channel::{Channel, Kind};
use edgewalk_numerics::Format;
use std::fmt;

/// What the bits of a field stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// A flag, a code, a number of lines, columns or pixels: the documentation says which.
    Count,
    /// A quantity of this unit.
    Of(&'static str),
    /// A quantity of this unit, modulo the range of its format.
    Modular(&'static str),
    /// All ones stand for 1.0.
    Unorm,
}

/// One field of a token, or a single port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name of the field. The port is called by the link's name, a `_` and this name.
    pub name: String,
    /// Bits before and behind the point, and whether they are two's complement.
    pub format: Format,
    /// What they stand for.
    pub scale: Scale,
    /// Meaning of the field.
    pub doc: String,
}

impl Field {
    /// Whole numbers, flags and codes without sign.
    #[must_use]
    pub fn count(name: impl Into<String>, bits: u32, doc: impl Into<String>) -> Field {
        Field { name: name.into(), format: whole(false, bits), scale: Scale::Count, doc: doc.into() }
    }

    /// Whole numbers in two's complement.
    pub(crate) fn signed(name: impl Into<String>, bits: u32, doc: impl Into<String>) -> Field {
        Field { format: whole(true, bits), ..Field::count(name, bits, doc) }
    }

    /// A quantity.
    pub(crate) fn of(
        name: impl Into<String>,
        format: Format,
        unit: &'static str,
        doc: impl Into<String>,
    ) -> Field {
        Field { name: name.into(), format, scale: Scale::Of(unit), doc: doc.into() }
    }

    /// An interpolated word of a channel.
    pub(crate) fn word(name: impl Into<String>, channel: &Channel, doc: impl Into<String>) -> Field {
        let (format, scale) = (channel.word_format(), Scale::Modular("LSB"));
        Field { name: name.into(), format, scale, doc: doc.into() }
    }

    /// The output of a channel.
    pub(crate) fn output(channel: &Channel) -> Field {
        let scale = match channel.kind {
            Kind::Unorm => Scale::Unorm,
            Kind::Signed | Kind::Floor => Scale::Of("LSB"),
            Kind::Weight => Scale::Count,
        };
        let what = channel.what();
        let doc = match channel.kind {
            Kind::Weight => format!("{what} of the pixel, 2^{} stands for 1.0", channel.bits - 1),
            _ => format!("{what} of the pixel"),
        };
        Field { name: channel.name.to_owned(), format: channel.output_format(), scale, doc }
    }

    /// Bits.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.format.width()
    }

    /// Format and unit; nothing for whole numbers without sign.
    pub(crate) fn bits(&self) -> String {
        match self.scale {
            Scale::Count if self.format.is_signed() => "signed".to_owned(),
            Scale::Count => String::new(),
            Scale::Of(unit) => format!("{} {unit}", self.format),
            Scale::Modular(unit) => format!("{} {unit}, modular", self.format),
            Scale::Unorm => format!("unorm{}", self.width()),
        }
    }
}

/// Whole numbers of so many bits; widths follow from checked keys and are 1 to 120.
fn whole(signed: bool, bits: u32) -> Format {
    Format::new(signed, bits, 0).expect("widths of a planned machine are 1 to 120 bits")
}

/// Format and unit, then the meaning: `UQ8.14 LSB, modular, to the next pixel of the span`.
impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let format = self.bits();
        let gap = if format.is_empty() || self.doc.is_empty() { "" } else { ", " };
        write!(f, "{format}{gap}{}", self.doc)
    }
}
