//! Channels of the user's own: whether an input has their values, and what was drawn of them.
//!
//! ```text
//!  X lines ──unit of the kind──> vertex ──> engine ──> Values, LSB of the output ──> arrays, comparison
//!            [0,1] or LSB                   golden exact, the machine whole numbers
//! ```

use anyhow::{Result, anyhow};
use edgewalk_machine::{Channel, Plan};
use serde::Serialize;

/// Channels that every machine has before them: z, r, g, b.
pub const BEFORE: usize = 4;

/// The user's own channels of the machine.
pub fn channels(machine: &Plan) -> &[Channel] {
    &machine.channels()[BEFORE..BEFORE + machine.extra as usize]
}

/// Checks that the machine has no channels of the user's own, as a scene has no values for them.
///
/// # Errors
/// It has.
pub fn none(machine: &Plan) -> Result<()> {
    match channels(machine).len() {
        0 => Ok(()),
        wanted => Err(anyhow!(
            "extra 0: the machine has channels.extra = {wanted}; give --set channels.extra=0, or draw a triangle file with a line `extra {wanted}`"
        )),
    }
}

/// A channel as reports name it.
#[derive(Clone, Debug, Serialize)]
pub struct Label {
    /// `e0` to `e3`.
    pub name: &'static str,
    /// `unorm`, `signed` or `floor`.
    pub kind: &'static str,
    /// Output bits, the sign among them.
    pub bits: u32,
    /// Of values and errors: always LSB of the output.
    pub unit: &'static str,
}

impl Label {
    /// Of this channel.
    pub fn of(channel: &Channel) -> Self {
        Label { name: channel.name, kind: channel.kind.name(), bits: channel.bits, unit: "LSB" }
    }
}

/// A channel with what is proved of it.
#[derive(Clone, Debug, Serialize)]
pub struct OwnChannel {
    /// Which.
    #[serde(flatten)]
    pub label: Label,
    /// No output errs by more, LSB; none where outputs may wrap.
    pub bound: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_bound: Option<String>,
}

impl OwnChannel {
    /// Of this channel of the machine.
    pub fn of(channel: &Channel, machine: &Plan) -> Self {
        let budget = machine.proved_budget(channel);
        OwnChannel {
            label: Label::of(channel),
            bound: budget.ok().map(|budget| budget.after_rounding().to_f64()),
            no_bound: budget.err().map(|why| why.to_string()),
        }
    }

    /// As a line of text.
    pub fn line(&self) -> String {
        let Label { name, kind, bits, unit } = &self.label;
        format!("{name} error, {unit} of {bits} bits, {kind}: {}\n", bound(self.bound, &self.no_bound))
    }
}

/// What is proved of an error, in words.
pub fn bound(bound: Option<f64>, why_not: &Option<String>) -> String {
    match bound {
        Some(bound) => format!("proved bound {bound:.4}"),
        None => format!("no bound: {}", why_not.as_deref().unwrap_or_default()),
    }
}

/// What a picture has of one channel, LSB of its output, row 0 on top; 0 where nothing was drawn.
#[derive(Clone, Debug)]
pub enum Values {
    /// Golden's plane.
    Exact(Vec<f64>),
    /// The machine's outputs.
    Stored(Vec<i64>),
}

impl Values {
    /// Of golden's channel in the unit of its file.
    pub fn exact(channel: &Channel, values: Vec<f64>) -> Self {
        let unit = channel.host_unit();
        Values::Exact(values.into_iter().map(|value| value * unit).collect())
    }

    /// At a pixel. Outputs have at most 32 bits, so none is rounded.
    pub fn at(&self, pixel: usize) -> f64 {
        match self {
            Values::Exact(values) => values[pixel],
            Values::Stored(values) => values[pixel] as f64,
        }
    }
}
