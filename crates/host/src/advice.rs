//! The advice to draw with golden, at the end of messages about frames that the machine does not draw.

/// The end of such a message.
pub const OR_GOLDEN: &str = ", or draw with --engine golden";

/// A message without the advice, for commands that have no --engine.
#[must_use]
pub fn without_engine(message: &str) -> String {
    message.replace(OR_GOLDEN, "")
}
