//! Every key of a machine file: its name, permitted values, meaning, and where it lives in [`Machine`].
//!
//! To add a parameter: a field in `Machine`, a line here, a rule in `check.rs` if it can clash with another.

use crate::channel::{Kind, MAX_CHANNELS};
use crate::machine::{BlendKind, EdgeKind, Fill, Gate, Hazard, Machine, ShadowLight};
use crate::shading::{ShadeColour, ShadeKind, Texture, Walk};

/// What a key may be set to.
#[derive(Clone, Copy, Debug)]
pub enum Domain {
    /// Whole numbers from the first to the second, both included.
    Range(u32, u32),
    /// One of these whole numbers.
    OneOf(&'static [u32]),
    /// One of these words; the number in [`Key::get`] is its place.
    Word(&'static [&'static str]),
}

/// One key of the machine file.
pub struct Key {
    /// Dotted name, `section.key`.
    pub name: &'static str,
    /// What it means, with its unit.
    pub doc: &'static str,
    /// Permitted values.
    pub domain: Domain,
    /// Reads the value (for words: the place in the domain).
    pub get: fn(&Machine) -> u32,
    /// Writes a value that lies in the domain.
    pub set: fn(&mut Machine, u32),
    /// The key means something in this machine: those of channels and units that it has not stay out of its file and its hash.
    pub used: fn(&Machine) -> bool,
    /// The value that says that a unit is not there. It stays out of the hash: so machines keep theirs when a unit is added
    /// to the program.
    pub absent: Option<u32>,
}

macro_rules! number {
    ($name:literal, $domain:expr, $doc:literal, $($field:ident).+) => {
        Key { name: $name, doc: $doc, domain: $domain, get: |m| m.$($field).+, set: |m, v| m.$($field).+ = v, used: |_| true, absent: None }
    };
}

/// A key of SHADOW, for machines that have it.
macro_rules! shadow {
    ($name:literal, $domain:expr, $doc:literal, $field:ident) => {
        Key {
            name: $name,
            doc: $doc,
            domain: $domain,
            get: |m| m.shadow.$field,
            set: |m, v| m.shadow.$field = v,
            used: |m| m.shadow.is_there(),
            absent: None,
        }
    };
}

/// A key of TERM or SHADE, for machines that have them.
macro_rules! shade {
    ($name:literal, $domain:expr, $doc:literal, $field:ident) => {
        Key {
            name: $name,
            doc: $doc,
            domain: $domain,
            get: |m| m.shade.$field,
            set: |m, v| m.shade.$field = v,
            used: |m| m.shade.is_there(),
            absent: None,
        }
    };
    ($name:literal, $words:expr, $doc:literal, $field:ident, $values:ident) => {
        Key {
            name: $name,
            doc: $doc,
            domain: Word($words),
            get: |m| m.shade.$field as u32,
            set: |m, v| m.shade.$field = $values[v as usize],
            used: |m| m.shade.is_there(),
            absent: None,
        }
    };
}

/// A key of BLEND, for machines that have it.
macro_rules! blend {
    ($name:literal, $domain:expr, $doc:literal, $field:ident) => {
        Key {
            name: $name,
            doc: $doc,
            domain: $domain,
            get: |m| m.blend.$field,
            set: |m, v| m.blend.$field = v,
            used: |m| m.blend.is_there(),
            absent: None,
        }
    };
}

/// A key of extra channel `$i`.
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

const FILLS: [Fill; 2] = [Fill::Exact, Fill::Textbook];
const KINDS: [EdgeKind; 2] = [EdgeKind::Exact, EdgeKind::Slope];
const BLENDS: [BlendKind; 3] = [BlendKind::None, BlendKind::Constant, BlendKind::Interpolated];
const LIGHTS: [ShadowLight; 2] = [ShadowLight::None, ShadowLight::Parallel];
const GATES: [Gate; 2] = [Gate::And, Gate::Scale];
const SHADES: [ShadeKind; 3] = [ShadeKind::None, ShadeKind::FastPhong, ShadeKind::Phong];
const COLOURS: [ShadeColour; 2] = [ShadeColour::Tables, ShadeColour::Multiply];
const TEXTURES: [Texture; 2] = [Texture::None, Texture::Nearest];
const WALKS: [Walk; 2] = [Walk::Register, Walk::Memory];
const HAZARDS: [Hazard; 3] = [Hazard::Drain, Hazard::Interlock, Hazard::Forward];

use Domain::{OneOf, Range, Word};

/// All keys, by section, in the order the data flows.
pub const KEYS: &[Key] = &[
    number!("screen.width", Range(1, 8192), "visible columns, pixels", width),
    number!("screen.height", Range(1, 8192), "visible lines, pixels", height),
    number!(
        "screen.guard_bits",
        Range(2, 14),
        "vertices lie in |x|,|y| <= 2^guard_bits - 1 pixels; nothing inside is clipped",
        guard_bits
    ),
    number!("screen.subpixel_bits", Range(0, 8), "fraction bits of vertex coordinates", subpixel_bits),
    number!(
        "setup.lanes",
        OneOf(&[1, 2, 4]),
        "lanes that work side by side, each on a quotient with its exact remainder",
        lanes
    ),
    Key {
        name: "edge.fill",
        doc: "fill rule: exact (half-open, top-left) or textbook (inclusive, integer vertices)",
        domain: Word(&["exact", "textbook"]),
        get: |m| m.fill as u32,
        set: |m, v| m.fill = FILLS[v as usize],
        used: |_| true,
        absent: None,
    },
    Key {
        name: "edge.kind",
        doc: "edge walk: exact (quotient and remainder) or slope (fixed point)",
        domain: Word(&["exact", "slope"]),
        get: |m| m.edge_kind as u32,
        set: |m, v| m.edge_kind = KINDS[v as usize],
        used: |_| true,
        absent: None,
    },
    number!(
        "edge.fraction_bits",
        Range(1, 30),
        "fraction bits of a slope edge; unused by exact edges",
        edge_fraction
    ),
    number!("fifo.span", Range(1, 64), "depth of the span FIFO, spans", span_fifo),
    number!("formats.z_bits", Range(4, 32), "depth: output bits", z.bits),
    number!("formats.z_fraction", Range(0, 24), "depth: interpolator fraction bits", z.fraction),
    number!("formats.z_vertex", Range(0, 16), "depth: fraction bits of the vertex value", z.vertex_fraction),
    number!("formats.color_bits", Range(2, 16), "colour: output bits", color.bits),
    number!("formats.color_fraction", Range(0, 24), "colour: interpolator fraction bits", color.fraction),
    number!(
        "formats.color_vertex",
        Range(0, 16),
        "colour: fraction bits of the vertex value",
        color.vertex_fraction
    ),
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
    number!(
        "interpolator.adders",
        Range(1, MAX_CHANNELS as u32),
        "adders shared by the N channels: ceil(N/adders) clocks a pixel",
        adders
    ),
    number!(
        "interpolator.segments",
        OneOf(&[1, 2, 4]),
        "pipeline segments of each adder; the carry moves a segment a clock",
        segments
    ),
    Key {
        used: |_| true,
        absent: Some(ShadeKind::None as u32),
        ..shade!(
            "shade.kind",
            &["none", "fast-phong", "phong"],
            "what is shaded at each pixel: nothing, by fast-phong (both cosines quadratics), or by phong (unit normals)",
            kind,
            SHADES
        )
    },
    shade!(
        "shade.colour",
        &["tables", "multiply"],
        "colours from tables, or light from a table times the fragment's colour",
        colour,
        COLOURS
    ),
    shade!("shade.table_bits", Range(8, 10), "a table has 2^table_bits entries", table_bits),
    shade!("shade.gloss_bits", Range(0, 8), "N.H reaches down to 2^gloss_bits tables below 0", gloss_bits),
    shade!("shade.lights", Range(1, 2), "lights at once", lights),
    shade!("shade.material_bits", Range(0, 8), "there are 2^material_bits materials", material_bits),
    shade!(
        "memory.table_latency",
        Range(1, 8),
        "clocks from a read of a material's table to its data, at the least",
        table_latency
    ),
    Key {
        absent: Some(Texture::None as u32),
        ..shade!(
            "texture.kind",
            &["none", "nearest"],
            "texture of the colour: none, or the nearest texel",
            texture,
            TEXTURES
        )
    },
    Key {
        used: |m| m.shade.textures(),
        ..shade!("texture.bits", Range(1, 11), "a texture has 2^bits columns and lines", texture_bits)
    },
    Key {
        used: |m| m.shade.textures(),
        ..shade!("fifo.texel", Range(1, 16), "fragments in TEXEL's queue", texel_queue)
    },
    Key {
        used: |m| m.shade.textures(),
        ..shade!(
            "memory.texel_latency",
            Range(1, 8),
            "clocks from a read of a texel to its data, at the least",
            texel_latency
        )
    },
    shade!(
        "term.walk",
        &["register", "memory"],
        "words of the walk from span to span: in registers, or in a memory with one adder",
        walk,
        WALKS
    ),
    shade!("term.fraction", Range(0, 44), "fraction bits of a term of degree 2", fraction),
    Key {
        used: |m| m.shade.has_linear_terms(),
        ..shade!("term.linear_fraction", Range(0, 46), "fraction bits of a term of degree 1", linear_fraction)
    },
    Key {
        used: |m| m.shade.normalises(),
        ..shade!(
            "memory.root_latency",
            Range(1, 8),
            "clocks from a read of a root to its data, at the least",
            root_latency
        )
    },
    shade!(
        "term.record_bits",
        Range(1, 20),
        "the memory of the terms has 2^record_bits records",
        record_bits
    ),
    shade!(
        "memory.term_latency",
        Range(1, 8),
        "clocks from a read of a term's word to its data, at the least",
        term_latency
    ),
    Key {
        name: "memory.hazard",
        doc: "a pixel still in flight: drain, interlock or forward",
        domain: Word(&["drain", "interlock", "forward"]),
        get: |m| m.hazard as u32,
        set: |m, v| m.hazard = HAZARDS[v as usize],
        used: |_| true,
        absent: None,
    },
    number!("memory.latency", Range(1, 8), "clocks from a depth read to its data, at the least", latency),
    number!("fifo.inflight", Range(1, 16), "fragments in flight between read and compare", inflight),
    Key {
        name: "shadow.light",
        doc: "the light whose depth map is looked up: none, parallel",
        domain: Word(&["none", "parallel"]),
        get: |m| m.shadow.light as u32,
        set: |m, v| m.shadow.light = LIGHTS[v as usize],
        used: |_| true,
        absent: Some(ShadowLight::None as u32),
    },
    shadow!("shadow.size", Range(1, 4096), "side of the map, texels", size),
    shadow!("shadow.guard_bits", Range(0, 6), "vertices lie within 2^guard_bits maps", guard_bits),
    shadow!("shadow.depth_bits", Range(4, 24), "bits of a depth in the map", depth_bits),
    shadow!(
        "shadow.light_fraction",
        Range(0, 24),
        "light-space values: interpolator fraction bits",
        fraction
    ),
    shadow!(
        "shadow.light_vertex",
        Range(0, 16),
        "light-space values: fraction bits of the vertex value",
        vertex_fraction
    ),
    Key {
        name: "shadow.gate",
        doc: "a colour in shadow: and (0), or scale (the share `ambient` of it)",
        domain: Word(&["and", "scale"]),
        get: |m| m.shadow.gate as u32,
        set: |m, v| m.shadow.gate = GATES[v as usize],
        used: |m| m.shadow.is_there(),
        absent: None,
    },
    shadow!("fifo.shadow", Range(1, 16), "fragments in SHADOW's queue", queue),
    shadow!(
        "memory.map_latency",
        Range(1, 8),
        "clocks from a read of the map to its data, at the least",
        latency
    ),
    Key {
        name: "blend.kind",
        doc: "blending with the pixel: none, by a k_t of the triangle (constant) or of the pixel (interpolated)",
        domain: Word(&["none", "constant", "interpolated"]),
        get: |m| m.blend.kind as u32,
        set: |m, v| m.blend.kind = BLENDS[v as usize],
        used: |_| true,
        absent: Some(BlendKind::None as u32),
    },
    blend!("blend.kt_bits", Range(4, 12), "bits of k_t below 1; 1 is exact", kt_bits),
    Key {
        used: |m| m.blend.kind == BlendKind::Interpolated,
        ..blend!(
            "blend.kt_fraction",
            Range(0, 24),
            "k_t as a channel: interpolator fraction bits",
            kt_fraction
        )
    },
    Key {
        used: |m| m.blend.kind == BlendKind::Interpolated,
        ..blend!(
            "blend.kt_vertex",
            Range(0, 16),
            "k_t as a channel: fraction bits of the vertex value",
            kt_vertex
        )
    },
    blend!(
        "blend.multipliers",
        OneOf(&[0, 1, 3]),
        "3: the colours side by side; 1: one after the other, 3 clocks; 0: bit by bit, kt_bits/2 clocks",
        multipliers
    ),
    blend!("blend.stages", Range(1, 2), "stages between BLEND's queue and its write", stages),
    blend!("fifo.blend", Range(1, 16), "fragments in BLEND's queue", queue),
    Key {
        name: "memory.color_hazard",
        doc: "BLEND: a pixel still in flight: drain, interlock or forward",
        domain: Word(&["drain", "interlock", "forward"]),
        get: |m| m.blend.hazard as u32,
        set: |m, v| m.blend.hazard = HAZARDS[v as usize],
        used: |m| m.blend.is_there(),
        absent: None,
    },
    blend!(
        "memory.color_latency",
        Range(1, 8),
        "clocks from a colour read to its data, at the least",
        latency
    ),
    number!(
        "memory.tag_bits",
        Range(0, 32),
        "bits of a tag that travels with a triangle to its writes; 0: none",
        tag_bits
    ),
];

impl Key {
    /// The value tells this machine from others.
    #[must_use]
    pub fn tells(&self, machine: &Machine) -> bool {
        (self.used)(machine) && self.absent != Some((self.get)(machine))
    }

    /// The value as written in a file, words without quotes.
    #[must_use]
    pub fn show(&self, machine: &Machine) -> String {
        let value = (self.get)(machine);
        match self.domain {
            Word(words) => words[value as usize].to_owned(),
            _ => value.to_string(),
        }
    }

    /// The permitted values in words: `4 to 32`, `1, 2 or 4`.
    #[must_use]
    pub fn permitted(&self) -> String {
        match self.domain {
            Range(low, high) => format!("{low} to {high}"),
            OneOf(list) => list.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
            Word(words) => words.join(", "),
        }
    }

    /// Reads a value; `None` if it is not in the domain.
    #[must_use]
    pub fn parse(&self, text: &str) -> Option<u32> {
        match self.domain {
            Word(words) => words.iter().position(|w| *w == text).map(|place| place as u32),
            Range(low, high) => text.parse().ok().filter(|v| (low..=high).contains(v)),
            OneOf(list) => text.parse().ok().filter(|v| list.contains(v)),
        }
    }

    /// The nearest permitted value to a refused one, for the error's hint.
    #[must_use]
    pub fn nearest(&self, text: &str) -> String {
        match self.domain {
            Word(words) => crate::nearest::nearest(text, words.iter().copied()).to_owned(),
            Range(low, high) => match text.parse::<f64>() {
                Ok(v) => (v.round().clamp(f64::from(low), f64::from(high)) as u32).to_string(),
                Err(_) => low.to_string(),
            },
            OneOf(list) => {
                let wanted = text.parse::<f64>().unwrap_or(f64::from(list[0]));
                let distance = |v: &&u32| (f64::from(**v) - wanted).abs();
                list.iter()
                    .min_by(|a, b| distance(a).total_cmp(&distance(b)))
                    .map_or_else(String::new, ToString::to_string)
            }
        }
    }
}
