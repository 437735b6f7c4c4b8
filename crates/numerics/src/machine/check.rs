//! Which combinations can be built, and the reason where one cannot.

use super::text::MachineError;
use super::{EdgeKind, Fill, Machine};

/// Longest word a setup lane may need.
pub const LANE_BITS: u32 = 120;
/// Longest interpolated word.
pub const WORD_BITS: u32 = 56;

impl Machine {
    /// Accepts the machine, or names the key that stands in the way, the reason, and a value that would do.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), MachineError> {
        for key in super::keys::KEYS {
            let shown = key.show(self);
            if key.parse(&shown).is_none() {
                return Err(MachineError::value(key, &shown));
            }
        }
        let w = self.widths();
        let side = self.width.max(self.height);
        if side > 1 << self.guard_bits {
            return Err(MachineError::rule(
                self,
                "screen.guard_bits",
                format!("the screen is {side} pixels wide or high and must lie in the guard band"),
                side.next_power_of_two().ilog2().to_string(),
            ));
        }
        if self.fill == Fill::Textbook && self.subpixel_bits != 0 {
            return Err(MachineError::rule(
                self,
                "screen.subpixel_bits",
                "textbook fill takes integer vertices".to_owned(),
                "0".to_owned(),
            ));
        }
        for (name, channel) in [("z", self.z), ("color", self.color)] {
            if channel.vertex_fraction > channel.fraction {
                return Err(MachineError::rule(
                    self,
                    &format!("formats.{name}_vertex"),
                    format!(
                        "a vertex cannot have more fraction bits than the interpolator ({})",
                        channel.fraction
                    ),
                    channel.fraction.to_string(),
                ));
            }
            if channel.word() > WORD_BITS {
                return Err(MachineError::rule(
                    self,
                    &format!("formats.{name}_fraction"),
                    format!("the word would have {} bits, {WORD_BITS} is the most", channel.word()),
                    (WORD_BITS - channel.bits).to_string(),
                ));
            }
            if channel.word() < 2 * self.segments {
                return Err(MachineError::rule(
                    self,
                    "interpolator.segments",
                    format!(
                        "a word of {} bits has no {} segments of two bits",
                        channel.word(),
                        self.segments
                    ),
                    "1".to_owned(),
                ));
            }
        }
        let longest = self.z.word().max(self.color.word());
        let slope = if self.edge_kind == EdgeKind::Slope { self.edge_fraction } else { 0 };
        let lane = (2 * w.difference + longest)
            .max(w.difference + longest + self.guard_bits + 2 + w.center_fraction)
            .max(2 * w.difference + slope);
        if lane > LANE_BITS {
            return Err(MachineError::rule(
                self,
                "formats.z_fraction",
                format!("setup would divide numbers of {lane} bits, {LANE_BITS} is the most"),
                self.z.fraction.saturating_sub(lane - LANE_BITS).to_string(),
            ));
        }
        Ok(())
    }
}
