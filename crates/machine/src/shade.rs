//! TERM, TEXEL, BUMP, NORMAL, LAMP and SHADE: their keys.

use crate::key::Domain::Range;
use crate::key::{Domain, Key, number, word};
use crate::machine::Machine;

/// What is shaded at each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShadeKind {
    /// Nothing: the machine has neither TERM nor SHADE.
    None,
    /// Both cosines are quadratics over the triangle.
    FastPhong,
    /// The normal is linear over the triangle, and made a unit normal at each pixel: the machine has NORMAL too, or LAMP.
    Phong,
}

/// Where the light of a machine that shades by unit normals stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShadeLight {
    /// Far away: one direction for all pixels.
    Directional,
    /// At a point: the machine has LAMP in the place of NORMAL.
    Positional,
}

/// Where a colour comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShadeColour {
    /// Tables hold it.
    Tables,
    /// A table holds the light; it is multiplied by the fragment's colour.
    Multiply,
}

/// Where TERM keeps the words it walks with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Walk {
    /// In registers: a step is one clock, or two.
    Register,
    /// In a memory, with one adder: a step is a clock for each word that changes.
    Memory,
}

/// What a texture does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Texture {
    /// There is none: the machine has no TEXEL.
    None,
    /// The nearest texel modulates the colour.
    Nearest,
}

/// Whether a relief turns the normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Bump {
    /// A word of the textures is a colour: the machine has no BUMP.
    No,
    /// Beside the colour stand the slopes of a relief.
    Yes,
}

/// TERM, TEXEL, BUMP, NORMAL, LAMP, SHADE and the memories behind them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shade {
    /// What is shaded.
    pub kind: ShadeKind,
    /// Where the light stands.
    pub light: ShadeLight,
    /// Where a colour comes from.
    pub colour: ShadeColour,
    /// t: a table has 2^t entries.
    pub table_bits: u32,
    /// m: N·H reaches down to -2^m tables.
    pub gloss_bits: u32,
    /// Lights at once.
    pub lights: u32,
    /// Bits of the number of a material.
    pub material_bits: u32,
    /// Latency of the memory of the tables, clocks.
    pub table_latency: u32,
    /// Where TERM keeps its words.
    pub walk: Walk,
    /// Fraction bits of a term of degree 2.
    pub fraction: u32,
    /// Fraction bits of a term of degree 1.
    pub linear_fraction: u32,
    /// Latency of the memory of the roots, clocks.
    pub root_latency: u32,
    /// A texture for the colour.
    pub texture: Texture,
    /// A texture has 2^texture_bits columns and lines.
    pub texture_bits: u32,
    /// A relief that turns the normal.
    pub bump: Bump,
    /// ξ: bits of a slope of the relief.
    pub slope_bits: u32,
    /// Depth of TEXEL's queue, fragments.
    pub texel_queue: u32,
    /// Latency of the memory of the textures, clocks.
    pub texel_latency: u32,
    /// Bits of the number of a triangle's record.
    pub record_bits: u32,
    /// Latency of the memory of the terms, clocks.
    pub term_latency: u32,
}

impl Shade {
    /// The units are there.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.kind != ShadeKind::None
    }

    /// Normals are made unit normals: NORMAL is there, or LAMP.
    #[must_use]
    pub fn normalises(&self) -> bool {
        self.kind == ShadeKind::Phong
    }

    /// The light stands at a point: LAMP is there.
    #[must_use]
    pub fn is_positional(&self) -> bool {
        self.normalises() && self.light == ShadeLight::Positional
    }

    /// NORMAL is there.
    #[must_use]
    pub fn has_normal(&self) -> bool {
        self.normalises() && !self.is_positional()
    }

    /// TEXEL is there.
    #[must_use]
    pub fn textures(&self) -> bool {
        self.is_there() && self.texture != Texture::None
    }

    /// BUMP is there.
    #[must_use]
    pub fn bumps(&self) -> bool {
        self.textures() && self.bump == Bump::Yes
    }

    /// φ: bits that BUMP takes of a cosine below what SHADE takes.
    #[must_use]
    pub fn cosine_fraction(&self) -> u32 {
        if self.bumps() && !self.normalises() { 4 } else { 0 }
    }

    /// A term of degree 1 is there.
    #[must_use]
    pub fn has_linear_terms(&self) -> bool {
        self.normalises() || self.textures()
    }

    /// Bits of N·L as SHADE takes it: t + 2.
    #[must_use]
    pub fn diffuse_index_bits(&self) -> u32 {
        self.table_bits + 2
    }

    /// Bits of N·H as SHADE takes it: t + m + 2.
    #[must_use]
    pub fn highlight_index_bits(&self) -> u32 {
        self.table_bits + self.gloss_bits + 2
    }

    /// Bits of an entry of T: three colours of b bits, or the light in 2^-(b+2) with 1 exact.
    #[must_use]
    pub fn diffuse_bits(&self, color_bits: u32) -> u32 {
        match self.colour {
            ShadeColour::Tables => 3 * color_bits,
            ShadeColour::Multiply => color_bits + 3,
        }
    }

    /// Entries of a material, of all its lights: WT.
    #[must_use]
    pub fn entries(&self) -> u32 {
        self.lights << self.table_bits
    }

    /// Bits of the place of an entry among those of its material.
    #[must_use]
    pub fn entry_bits(&self) -> u32 {
        self.lights.next_power_of_two().ilog2() + self.table_bits
    }
}

/// Neither TERM nor SHADE, and what they are until more is set.
impl Default for Shade {
    fn default() -> Self {
        Shade {
            kind: ShadeKind::None,
            light: ShadeLight::Directional,
            colour: ShadeColour::Tables,
            table_bits: 9,
            gloss_bits: 4,
            lights: 1,
            material_bits: 4,
            table_latency: 2,
            walk: Walk::Register,
            fraction: 17,
            linear_fraction: 10,
            root_latency: 2,
            texture: Texture::None,
            texture_bits: 8,
            bump: Bump::No,
            slope_bits: 12,
            texel_queue: 4,
            texel_latency: 2,
            record_bits: 12,
            term_latency: 2,
        }
    }
}

fn there(machine: &Machine) -> bool {
    machine.shade.is_there()
}

fn normalises(machine: &Machine) -> bool {
    machine.shade.normalises()
}

fn textures(machine: &Machine) -> bool {
    machine.shade.textures()
}

fn bumps(machine: &Machine) -> bool {
    machine.shade.bumps()
}

/// The keys of TERM, TEXEL, BUMP, NORMAL, LAMP and SHADE.
pub const KEYS: &[Key] = &[
    Key {
        absent: Some(ShadeKind::None as u32),
        ..word!(
            "shade.kind",
            ShadeKind { "none" => None, "fast-phong" => FastPhong, "phong" => Phong },
            "what is shaded at each pixel: nothing, by fast-phong (both cosines quadratics), or by phong (unit normals)",
            shade.kind
        )
    },
    Key {
        absent: Some(ShadeLight::Directional as u32),
        ..word!(
            "shade.light",
            ShadeLight { "directional" => Directional, "positional" => Positional },
            "where the light of phong stands: far away, or at a point, one light at a time",
            shade.light,
            if normalises
        )
    },
    word!(
        "shade.colour",
        ShadeColour { "tables" => Tables, "multiply" => Multiply },
        "colours from tables, or light from a table times the fragment's colour",
        shade.colour,
        if there
    ),
    number!("shade.table_bits", Range(8, 10), "a table has 2^table_bits entries", shade.table_bits, if there),
    number!("shade.gloss_bits", Range(0, 8), "N.H reaches down to 2^gloss_bits tables below 0", shade.gloss_bits, if there),
    number!("shade.lights", Range(1, 2), "lights at once", shade.lights, if there),
    number!("shade.material_bits", Range(0, 8), "there are 2^material_bits materials", shade.material_bits, if there),
    number!(
        "memory.table_latency",
        Range(1, 8),
        "clocks from a read of a material's table to its data, at the least",
        shade.table_latency,
        if there
    ),
    Key {
        absent: Some(Texture::None as u32),
        ..word!(
            "texture.kind",
            Texture { "none" => None, "nearest" => Nearest },
            "texture of the colour: none, or the nearest texel",
            shade.texture,
            if there
        )
    },
    number!("texture.bits", Range(1, 11), "a texture has 2^bits columns and lines", shade.texture_bits, if textures),
    Key {
        absent: Some(Bump::No as u32),
        ..word!(
            "texture.bump",
            Bump { "no" => No, "yes" => Yes },
            "a relief beside the texture turns the normal: no, or by the slopes in a texel's word",
            shade.bump,
            if textures
        )
    },
    number!("texture.slope_bits", Range(4, 16), "bits of a slope of the relief", shade.slope_bits, if bumps),
    number!("fifo.texel", Range(1, 16), "fragments in TEXEL's queue", shade.texel_queue, if textures),
    number!(
        "memory.texel_latency",
        Range(1, 8),
        "clocks from a read of a texel to its data, at the least",
        shade.texel_latency,
        if textures
    ),
    word!(
        "term.walk",
        Walk { "register" => Register, "memory" => Memory },
        "words of the walk from span to span: in registers, or in a memory with one adder",
        shade.walk,
        if there
    ),
    number!("term.fraction", Range(0, 44), "fraction bits of a term of degree 2", shade.fraction, if there),
    number!(
        "term.linear_fraction",
        Range(0, 46),
        "fraction bits of a term of degree 1",
        shade.linear_fraction,
        if |m| m.shade.has_linear_terms()
    ),
    number!(
        "memory.root_latency",
        Range(1, 8),
        "clocks from a read of a root to its data, at the least",
        shade.root_latency,
        if normalises
    ),
    number!(
        "term.record_bits",
        Range(1, 20),
        "the memory of the terms has 2^record_bits records",
        shade.record_bits,
        if there
    ),
    number!(
        "memory.term_latency",
        Range(1, 8),
        "clocks from a read of a term's word to its data, at the least",
        shade.term_latency,
        if there
    ),
];
