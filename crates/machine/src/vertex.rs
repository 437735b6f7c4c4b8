//! Vertices as they stand at the machine's port.

use crate::channel::{Channel, Kind, MAX_CHANNELS};
use crate::plan::Plan;
use crate::stamp::PortStamp;

/// A vertex at the port of one machine: snapped and quantised. Only a [`Plan`] makes one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PortVertex {
    x: i32,
    y: i32,
    values: [i64; MAX_CHANNELS],
    kt: u16,
    /// A part of what all three are: kind, `flat` and the window's column at the first, the window's line and `sides`
    /// at the second, the line behind the window at the third.
    pub(crate) own: u16,
    stamp: PortStamp,
}

impl PortVertex {
    /// x, signed, `s` fraction bits, px to the right.
    #[must_use]
    pub fn x(&self) -> i32 {
        self.x
    }

    /// y, signed, `s` fraction bits, px down.
    #[must_use]
    pub fn y(&self) -> i32 {
        self.y
    }

    /// The same at another place.
    pub(crate) fn at(self, x: i32, y: i32) -> PortVertex {
        PortVertex { x, y, ..self }
    }

    /// The channels' values in their order, `e` fraction bits below the output's LSB; behind the last channel
    /// 0.
    #[must_use]
    pub fn values(&self) -> &[i64; MAX_CHANNELS] {
        &self.values
    }

    /// Of a machine with `blend.kind = constant`: k_t in 2^-kt_bits, 0 to 2^kt_bits. The triangle's is that
    /// of its first vertex. Else 0.
    #[must_use]
    pub fn kt(&self) -> u32 {
        self.kt.into()
    }
}

/// A vertex was made for the port of a machine with other formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "triangle {triangle} was made for a machine with another vertex port; make its vertices by this machine's plan"
)]
pub struct ForeignVertex {
    /// Number of the triangle, in the order of arrival.
    pub triangle: u64,
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
    /// A value outside what its channel holds, or not a number.
    #[error("{channel} = {value} lies outside {low} to {high}")]
    Channel {
        /// Name of the channel.
        channel: &'static str,
        /// The value.
        value: f64,
        /// Least permitted.
        low: f64,
        /// Largest permitted.
        high: f64,
    },
    /// More or fewer values than the machine has channels.
    #[error("a vertex of this machine has {expected} values, not {found}")]
    Count {
        /// Channels of the machine.
        expected: usize,
        /// Values given.
        found: usize,
    },
}

impl Channel {
    /// What the host may give at a vertex: 0 to 1 for `unorm` and `weight`, else LSB of the output up to the
    /// limit.
    #[must_use]
    pub fn host_range(&self) -> (f64, f64) {
        match self.kind {
            Kind::Unorm | Kind::Weight => (0.0, 1.0),
            Kind::Signed | Kind::Floor => (-(self.limit() as f64), self.limit() as f64),
        }
    }

    /// LSB of the output that the host's 1 stands for.
    #[must_use]
    pub fn host_unit(&self) -> f64 {
        match self.kind {
            Kind::Unorm | Kind::Weight => self.limit() as f64,
            Kind::Signed | Kind::Floor => 1.0,
        }
    }
}

impl Plan {
    /// Snaps a vertex (px; z, r, g, b in 0 to 1; extra channels as their kind wants; last k_t in 0 to 1, if
    /// the machine blends) to the port's formats, each rounded half to even.
    ///
    /// Errors of the result: 2^-(s+1) px in x and y, 2^-(e+1) LSB in a channel, 2^-(kt_bits+1) in a
    /// triangle's k_t.
    ///
    /// # Errors
    /// What lies outside the guard band or a channel's range, and a number of values that is not that of the
    /// channels.
    pub fn port_vertex(&self, x: f64, y: f64, values: &[f64]) -> Result<PortVertex, VertexError> {
        let limit = f64::from((1u32 << self.guard_bits) - 1);
        let snap = |axis: &'static str, value: f64| {
            let snapped = (value * f64::from(1u32 << self.subpixel_bits)).round_ties_even();
            if snapped.abs() <= limit * f64::from(1u32 << self.subpixel_bits) {
                Ok(snapped as i32)
            } else {
                Err(VertexError::Guard { axis, value, limit })
            }
        };
        let (x, y) = (snap("x", x)?, snap("y", y)?);
        let channels = self.channels().len();
        let expected = channels + usize::from(self.has_triangle_kt());
        if values.len() != expected {
            return Err(VertexError::Count { expected, found: values.len() });
        }
        let mut port = [0; MAX_CHANNELS];
        for ((channel, value), port) in self.channels().iter().zip(values).zip(&mut port) {
            let (low, high) = channel.host_range();
            if !(low..=high).contains(value) {
                return Err(VertexError::Channel { channel: channel.name, value: *value, low, high });
            }
            let scale = channel.host_unit() * f64::from(1u32 << channel.vertex_fraction);
            *port = (value * scale).round_ties_even() as i64;
        }
        let kt = match values.get(channels) {
            None => 0,
            Some(value) if (0.0..=1.0).contains(value) => {
                (value * f64::from(1u32 << self.blend.kt_bits)).round_ties_even() as u16
            }
            Some(value) => {
                return Err(VertexError::Channel { channel: "kt", value: *value, low: 0.0, high: 1.0 });
            }
        };
        Ok(PortVertex { x, y, values: port, kt, own: 0, stamp: self.port })
    }

    /// A vertex of these numbers as the port has them: x and y with `s`, values with `e` fraction bits,
    /// behind the last channel the triangle's k_t if it has one. What has more bits than the port is not seen
    /// by the machine; values that are not given are 0.
    #[must_use]
    pub fn raw_vertex(&self, x: i32, y: i32, values: &[i64]) -> PortVertex {
        let channels = self.channels().len();
        let mut port = [0; MAX_CHANNELS];
        for (port, value) in port.iter_mut().zip(values).take(channels) {
            *port = *value;
        }
        let kt = if self.has_triangle_kt() { values.get(channels).map_or(0, |kt| *kt as u16) } else { 0 };
        PortVertex { x, y, values: port, kt, own: 0, stamp: self.port }
    }

    /// Takes the triangle with this number if its vertices were made for this machine's port.
    ///
    /// # Errors
    /// Vertices of another machine.
    #[inline]
    pub fn accept(&self, triangle: &[PortVertex; 3], number: u64) -> Result<(), ForeignVertex> {
        if triangle.iter().all(|vertex| vertex.stamp == self.port) {
            return Ok(());
        }
        Err(ForeignVertex { triangle: number })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Machine;

    fn with_extra(kind: &str) -> Plan {
        let mut machine = Machine::default();
        for (key, value) in [("channels.extra", "1"), ("channels.e0_kind", kind)] {
            machine.set(key, value).expect("a key");
        }
        machine.plan().expect("can be built")
    }

    #[test]
    fn values_are_rounded_to_even_in_their_own_unit() {
        let plan = with_extra("signed");
        let vertex = plan.port_vertex(-0.5, 2.0, &[1.0, 0.0, 0.5, 1.0, -7.5]).expect("inside");
        assert_eq!((vertex.x(), vertex.y()), (-128, 512));
        assert_eq!(vertex.values()[..5], [((1 << 24) - 1) << 4, 0, 2040, 4080, -120]);
        assert_eq!(vertex.values()[5..], [0; 3]);
    }

    #[test]
    fn what_a_channel_cannot_hold_is_refused() {
        let plan = with_extra("floor");
        let with = |value: f64| plan.port_vertex(0.0, 0.0, &[0.0, 0.0, 0.0, 0.0, value]);
        assert!(with(2047.0).is_ok() && with(-2047.0).is_ok());
        for value in [2047.1, -2048.0, f64::NAN, f64::INFINITY] {
            let error = with(value).expect_err("outside").to_string();
            assert_eq!(error, format!("e0 = {value} lies outside -2047 to 2047"));
        }
        assert_eq!(
            plan.port_vertex(0.0, 0.0, &[0.0; 4]).expect_err("too few").to_string(),
            "a vertex of this machine has 5 values, not 4"
        );
    }

    #[test]
    fn vertices_of_another_port_are_refused() {
        let (plan, other) = (Plan::default(), with_extra("signed"));
        let own = [plan.raw_vertex(1, 2, &[3, 4, 5, 6]); 3];
        assert_eq!(plan.accept(&own, 0), Ok(()));
        assert_eq!(other.accept(&own, 7), Err(ForeignVertex { triangle: 7 }));
        assert_eq!(plan.accept(&[PortVertex::default(); 3], 1), Err(ForeignVertex { triangle: 1 }));
        // What changes nothing at the port changes nothing for its vertices.
        let slow = Machine { adders: 1, ..Machine::default() }.plan().expect("can be built");
        assert_eq!(slow.accept(&own, 0), Ok(()));
    }
}
