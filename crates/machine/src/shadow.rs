//! SHADOW, and PROJECT before it: their keys.

use crate::channel::{Channel, Kind, Precision};
use crate::key::Domain::Range;
use crate::key::{Domain, Key, number, word};
use crate::machine::Machine;

/// The light whose map SHADOW looks up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShadowLight {
    /// None: the machine has no SHADOW.
    None,
    /// Parallel: light-space values are linear over the screen.
    Parallel,
    /// Perspective: they are quotients of values that are; the machine has PROJECT.
    Perspective,
}

/// How PROJECT divides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Project {
    /// A stage a row: a fragment a clock.
    Pipelined,
    /// The rows of one fragment after the other.
    Serial,
}

/// What becomes of the colour of a fragment in shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gate {
    /// 0.
    And,
    /// The share `ambient` of it.
    Scale,
}

/// Whether the map also says what light is left of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Transmits {
    /// A word is a depth; what transmits light hides nothing, or all.
    No,
    /// Below the depth stands k, the share of the light that what transmits before it lets through.
    Yes,
}

/// The one that draws a light's map: the host, or the machine in a pass of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OwnPass {
    /// Somebody else.
    No,
    /// The machine itself, in a pass before the picture's.
    Yes,
}

/// SHADOW, and the map behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shadow {
    /// Which light.
    pub light: ShadowLight,
    /// Side of the map, texels.
    pub size: u32,
    /// Bits that light-space texels have beyond the map.
    pub guard_bits: u32,
    /// Bits of a depth in the map.
    pub depth_bits: u32,
    /// p: bits of the values that PROJECT divides, without their sign.
    pub light_bits: u32,
    /// How it divides them.
    pub project: Project,
    /// Interpolator fraction bits of light-space values.
    pub fraction: u32,
    /// Fraction bits of their vertex values.
    pub vertex_fraction: u32,
    /// What shadow does.
    pub gate: Gate,
    /// What a word of the map says beside the depth.
    pub transmits: Transmits,
    /// The one that draws the map.
    pub own_pass: OwnPass,
    /// Depth of its queue, fragments.
    pub queue: u32,
    /// Latency of the map, clocks.
    pub latency: u32,
}

impl Shadow {
    /// The unit is there.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.light != ShadowLight::None
    }

    /// SB: bits of a texel's column or line.
    #[must_use]
    pub fn side_bits(&self) -> u32 {
        self.size.next_power_of_two().ilog2().max(1)
    }

    /// The machine has PROJECT.
    #[must_use]
    pub fn projects(&self) -> bool {
        self.light == ShadowLight::Perspective
    }

    /// A word of the map has a share below its depth.
    #[must_use]
    pub fn transmits(&self) -> bool {
        self.is_there() && self.transmits == Transmits::Yes
    }

    /// The machine draws its map: it has the input `light_pass`.
    #[must_use]
    pub fn draws_map(&self) -> bool {
        self.is_there() && self.own_pass == OwnPass::Yes
    }

    /// What SHADOW takes of a texel's column or line, bits with the sign.
    #[must_use]
    pub fn texel_bits(&self) -> u32 {
        let guard = if self.projects() { 0 } else { self.guard_bits };
        self.side_bits() + 1 + guard
    }

    /// What SHADOW takes of a depth from the light, bits with the sign.
    #[must_use]
    pub fn distance_bits(&self) -> u32 {
        self.depth_bits + 2
    }

    /// R: rows of PROJECT's division.
    #[must_use]
    pub fn rows(&self) -> u32 {
        self.side_bits().max(self.depth_bits + 1)
    }

    /// The light-space values, in the order of their words.
    #[must_use]
    pub fn channels(&self) -> Vec<Channel> {
        let channel = |name, kind, bits| Channel { name, kind, precision: self.precision(bits) };
        match self.light {
            ShadowLight::None => Vec::new(),
            ShadowLight::Parallel => vec![
                channel("lx", Kind::Floor, self.texel_bits()),
                channel("ly", Kind::Floor, self.texel_bits()),
                channel("lz", Kind::Signed, self.distance_bits()),
            ],
            ShadowLight::Perspective => {
                LIGHT_SPACE.map(|name| channel(name, Kind::Signed, self.light_bits + 1)).into()
            }
        }
    }

    fn precision(&self, bits: u32) -> Precision {
        Precision { bits, fraction: self.fraction, vertex_fraction: self.vertex_fraction }
    }
}

/// Names of the light-space values; the last is of perspective lights only.
pub const LIGHT_SPACE: [&str; 4] = ["lx", "ly", "lz", "lw"];

/// No SHADOW, and what it is until more is set.
impl Default for Shadow {
    fn default() -> Self {
        Shadow {
            light: ShadowLight::None,
            size: 512,
            guard_bits: 2,
            depth_bits: 16,
            light_bits: 20,
            project: Project::Pipelined,
            fraction: 14,
            vertex_fraction: 4,
            gate: Gate::And,
            transmits: Transmits::No,
            own_pass: OwnPass::No,
            queue: 4,
            latency: 2,
        }
    }
}

fn there(machine: &Machine) -> bool {
    machine.shadow.is_there()
}

fn parallel(machine: &Machine) -> bool {
    machine.shadow.light == ShadowLight::Parallel
}

fn projects(machine: &Machine) -> bool {
    machine.shadow.projects()
}

/// The keys of SHADOW and PROJECT.
pub const KEYS: &[Key] = &[
    Key {
        absent: Some(ShadowLight::None as u32),
        ..word!(
            "shadow.light",
            ShadowLight { "none" => None, "parallel" => Parallel, "perspective" => Perspective },
            "the light whose depth map is looked up: none, parallel (and the view too), perspective",
            shadow.light
        )
    },
    number!("shadow.size", Range(1, 4096), "side of the map, texels", shadow.size, if there),
    number!(
        "shadow.guard_bits",
        Range(0, 6),
        "parallel: vertices lie within 2^guard_bits maps",
        shadow.guard_bits,
        if parallel
    ),
    number!("shadow.depth_bits", Range(4, 24), "bits of a depth in the map", shadow.depth_bits, if there),
    number!(
        "shadow.light_fraction",
        Range(0, 24),
        "light-space values: interpolator fraction bits",
        shadow.fraction,
        if there
    ),
    number!(
        "shadow.light_vertex",
        Range(0, 16),
        "light-space values: fraction bits of the vertex value",
        shadow.vertex_fraction,
        if there
    ),
    number!(
        "shadow.light_bits",
        Range(4, 28),
        "perspective: bits of a light-space value, without its sign",
        shadow.light_bits,
        if projects
    ),
    word!(
        "shadow.project",
        Project { "pipelined" => Pipelined, "serial" => Serial },
        "perspective: pipelined (a fragment a clock), or serial (one after the other, a clock a row)",
        shadow.project,
        if projects
    ),
    word!(
        "shadow.gate",
        Gate { "and" => And, "scale" => Scale },
        "a colour in shadow: and (0), or scale (the share `ambient` of it)",
        shadow.gate,
        if there
    ),
    Key {
        absent: Some(Transmits::No as u32),
        ..word!(
            "shadow.transmits",
            Transmits { "no" => No, "yes" => Yes },
            "a word of the map: a depth (no), or also what is left of light behind what transmits (yes)",
            shadow.transmits,
            if there
        )
    },
    Key {
        absent: Some(OwnPass::No as u32),
        ..word!(
            "shadow.own_pass",
            OwnPass { "no" => No, "yes" => Yes },
            "the map is drawn by somebody else (no), or by the machine itself, in a pass before the picture's (yes)",
            shadow.own_pass,
            if there
        )
    },
    number!("fifo.shadow", Range(1, 16), "fragments in SHADOW's queue", shadow.queue, if there),
    number!(
        "memory.map_latency",
        Range(1, 8),
        "clocks from a read of the map to its data, at the least",
        shadow.latency,
        if there
    ),
];
