//! SHADOW: its keys.

use crate::channel::Precision;
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
}

/// What becomes of the colour of a fragment in shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gate {
    /// 0.
    And,
    /// The share `ambient` of it.
    Scale,
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
    /// Interpolator fraction bits of light-space values.
    pub fraction: u32,
    /// Fraction bits of their vertex values.
    pub vertex_fraction: u32,
    /// What shadow does.
    pub gate: Gate,
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

    /// Word lengths of lx and ly.
    #[must_use]
    pub fn texel(&self) -> Precision {
        self.precision(self.side_bits() + 1 + self.guard_bits)
    }

    /// Word lengths of lz.
    #[must_use]
    pub fn light_depth(&self) -> Precision {
        self.precision(self.depth_bits + 2)
    }

    fn precision(&self, bits: u32) -> Precision {
        Precision { bits, fraction: self.fraction, vertex_fraction: self.vertex_fraction }
    }
}

/// No SHADOW, and what it is until more is set.
impl Default for Shadow {
    fn default() -> Self {
        Shadow {
            light: ShadowLight::None,
            size: 512,
            guard_bits: 2,
            depth_bits: 16,
            fraction: 14,
            vertex_fraction: 4,
            gate: Gate::And,
            queue: 4,
            latency: 2,
        }
    }
}

fn there(machine: &Machine) -> bool {
    machine.shadow.is_there()
}

/// The keys of SHADOW.
pub const KEYS: &[Key] = &[
    Key {
        absent: Some(ShadowLight::None as u32),
        ..word!(
            "shadow.light",
            ShadowLight { "none" => None, "parallel" => Parallel },
            "the light whose depth map is looked up: none, parallel",
            shadow.light
        )
    },
    number!("shadow.size", Range(1, 4096), "side of the map, texels", shadow.size, if there),
    number!("shadow.guard_bits", Range(0, 6), "vertices lie within 2^guard_bits maps", shadow.guard_bits, if there),
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
    word!(
        "shadow.gate",
        Gate { "and" => And, "scale" => Scale },
        "a colour in shadow: and (0), or scale (the share `ambient` of it)",
        shadow.gate,
        if there
    ),
    number!("fifo.shadow", Range(1, 16), "fragments in SHADOW's queue", shadow.queue, if there),
    number!(
        "memory.map_latency",
        Range(1, 8),
        "clocks from a read of the map to its data, at the least",
        shadow.latency,
        if there
    ),
];
