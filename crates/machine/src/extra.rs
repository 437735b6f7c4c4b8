//! Channels of the user's own: their keys.

use crate::channel::{Kind, Precision};
use crate::key::Domain::{Range, Word};
use crate::key::{Key, number};

/// A channel that the user adds: it is interpolated and written beside the colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ExtraChannel {
    /// How it is read and rounded.
    pub kind: Kind,
    /// Word lengths of the channel.
    pub precision: Precision,
}

/// A texture coordinate of 12 bits.
impl Default for ExtraChannel {
    fn default() -> Self {
        ExtraChannel {
            kind: Kind::Floor,
            precision: Precision { bits: 12, fraction: 14, vertex_fraction: 4 },
        }
    }
}

/// A key of extra channel `$i`: one of its word lengths, or its kind.
macro_rules! extra {
    ($i:literal, $key:literal, $domain:expr, $doc:literal, $field:ident) => {
        Key {
            name: concat!("channels.e", $i, "_", $key),
            doc: $doc,
            domain: $domain,
            get: |m| m.extras[$i].precision.$field,
            set: |m, v| m.extras[$i].precision.$field = v,
            used: |m| m.extra > $i,
            absent: None,
        }
    };
    ($i:literal, "kind") => {
        Key {
            name: concat!("channels.e", $i, "_kind"),
            doc: "extra channel: unorm (0 to 1), signed or floor (LSB of the output)",
            domain: Word(&Kind::NAMES),
            get: |m| m.extras[$i].kind as u32,
            set: |m, v| m.extras[$i].kind = Kind::ALL[v as usize],
            used: |m| m.extra > $i,
            absent: None,
        }
    };
    ($i:literal, "bits") => {
        extra!($i, "bits", Range(2, 32), "extra channel: output bits, the sign among them", bits)
    };
    ($i:literal, "fraction") => {
        extra!($i, "fraction", Range(0, 24), "extra channel: interpolator fraction bits", fraction)
    };
    ($i:literal, "vertex") => {
        extra!(
            $i,
            "vertex",
            Range(0, 16),
            "extra channel: fraction bits of the vertex value",
            vertex_fraction
        )
    };
}

/// The keys of these channels.
pub const KEYS: &[Key] = &[
    number!(
        "channels.extra",
        Range(0, 4),
        "channels of the user's own, e0 to e3, written beside the colour",
        extra
    ),
    extra!(0, "kind"),
    extra!(0, "bits"),
    extra!(0, "fraction"),
    extra!(0, "vertex"),
    extra!(1, "kind"),
    extra!(1, "bits"),
    extra!(1, "fraction"),
    extra!(1, "vertex"),
    extra!(2, "kind"),
    extra!(2, "bits"),
    extra!(2, "fraction"),
    extra!(2, "vertex"),
    extra!(3, "kind"),
    extra!(3, "bits"),
    extra!(3, "fraction"),
    extra!(3, "vertex"),
];
