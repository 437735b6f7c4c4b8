//! Vertices as they stand at the machine's port.

use crate::plan::Plan;

/// A vertex at the port: snapped and quantised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PortVertex {
    /// x, signed, `s` fraction bits, px to the right.
    pub x: i32,
    /// y, signed, `s` fraction bits, px down.
    pub y: i32,
    /// Z, R, G, B: unsigned, `e` fraction bits below the output's LSB.
    pub value: [u64; 4],
}

/// Why a vertex cannot enter the machine.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VertexError {
    /// Outside the guard band.
    #[error(
        "{axis} = {value} lies outside the guard band of ±{limit} pixels; clip it, or raise screen.guard_bits"
    )]
    Guard {
        /// `x` or `y`.
        axis: &'static str,
        /// The coordinate, px.
        value: f64,
        /// 2^G - 1, px.
        limit: f64,
    },
    /// A depth or colour outside [0, 1], or not a number.
    #[error("{channel} = {value} lies outside 0 to 1")]
    Channel {
        /// `z`, `r`, `g` or `b`.
        channel: &'static str,
        /// The value.
        value: f64,
    },
}

impl Plan {
    /// Snaps a vertex (px, and Z, R, G, B in 0 to 1) to the port's formats, each rounded half to even.
    ///
    /// Errors of the result: 2^-(s+1) px in x and y, 2^-(e+1) LSB in a channel.
    ///
    /// # Errors
    /// What lies outside the guard band or outside [0,1].
    pub fn port_vertex(&self, x: f64, y: f64, values: [f64; 4]) -> Result<PortVertex, VertexError> {
        let limit = f64::from((1u32 << self.guard_bits) - 1);
        let snap = |axis: &'static str, value: f64| {
            let snapped = (value * f64::from(1u32 << self.subpixel_bits)).round_ties_even();
            if snapped.abs() <= limit * f64::from(1u32 << self.subpixel_bits) {
                Ok(snapped as i32)
            } else {
                Err(VertexError::Guard { axis, value, limit })
            }
        };
        let mut vertex = PortVertex { x: snap("x", x)?, y: snap("y", y)?, value: [0; 4] };
        for (i, (channel, name)) in self.channels().iter().zip(["z", "r", "g", "b"]).enumerate() {
            if !(0.0..=1.0).contains(&values[i]) {
                return Err(VertexError::Channel { channel: name, value: values[i] });
            }
            let scale = channel.max() as f64 * f64::from(1u32 << channel.vertex_fraction);
            vertex.value[i] = (values[i] * scale).round_ties_even() as u64;
        }
        Ok(vertex)
    }
}
