//! The least fraction bits: for every triangle in the guard band, and for the triangles of a frame.
//!
//! ```text
//!  guard band, screen ──> N ─┐                            ┌─> bits, bound
//!  frame ─> reach ──────> N ─┴─> bounds 2 and 4, target ─>┴─> a triangle that breaks one bit fewer, drawn
//! ```

mod behind;
mod breaker;

use anyhow::{Result, anyhow};
use behind::Behind;
pub use breaker::Breaker;
use edgewalk_host::port::PortFrame;
use edgewalk_host::reach::{Reach, walked as reached};
use edgewalk_machine::{Channel, Fill, Machine, Plan};
use edgewalk_numerics::solver::least_fraction_bits;
use edgewalk_numerics::{Dyadic, Rounding, Screen, Steps, Target};
use edgewalk_scene::Frame;
use serde::Serialize;

/// Least and largest error that may be asked for, LSB.
pub const ERRORS: (f64, f64) = (0.5, 1024.0);

/// What a frame asks of a machine's word lengths.
#[derive(Serialize)]
pub struct Size {
    /// Largest error that is allowed, LSB of the output.
    pub error: f64,
    /// Guard bits of the machine, and the fewest in which these triangles lie.
    pub guard_bits: GuardBits,
    /// Depth, colour, and the channels of the user's own.
    pub channels: Vec<ChannelSize>,
}

/// Guard bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct GuardBits {
    /// Of the machine.
    pub machine: u32,
    /// The fewest in which these triangles and the screen lie.
    pub needed: u32,
}

/// What is asked of a channel's word.
#[derive(Serialize)]
pub struct ChannelSize {
    /// `z`, `color`, `e0` to `e3`.
    pub name: &'static str,
    /// The key of its fraction bits.
    pub key: String,
    /// Fraction bits that the machine has.
    pub fraction_bits: u32,
    /// For every triangle in the guard band.
    pub every: Answer,
    /// Like `every`, with the fewest guard bits.
    pub every_in_fewest_guard_bits: Answer,
    /// For these triangles.
    pub these: Answer,
}

/// The least fraction bits for some number of additions.
#[derive(Clone, Serialize)]
pub struct Answer {
    /// N: the most additions behind a pixel.
    pub additions: u64,
    /// The pixel that needs them, where it is one of a frame: its triangle's place and its column and line.
    pub needed_by: Option<(i32, (u32, u32))>,
    /// How N comes about: lines and columns.
    pub steps: (u32, u32),
    /// The least bits; none if no number of them will do.
    pub fraction_bits: Option<u32>,
    /// Proved bound of the error with these bits, LSB.
    pub bound: Option<f64>,
    /// Why no number of bits will do.
    pub out_of_reach: Option<String>,
    /// A triangle behind as many additions that breaks one bit fewer.
    pub one_bit_fewer: Option<Breaker>,
    /// Why there is none.
    pub no_breaker: Option<String>,
}

/// The sizes that the frame asks for, with an error of at most so many LSB. `port`: what the machine is sent of it.
///
/// # Errors
/// An error outside the range, or a frame that the machine cannot take or that draws nothing.
pub fn size(machine: &Plan, frame: &Frame, port: &PortFrame, error: f64) -> Result<Size> {
    let (low, high) = ERRORS;
    if !(error > low && error <= high) {
        return Err(anyhow!(
            "--error {error}: permitted: above {low}, which the output's rounding takes, to {high} LSB"
        ));
    }
    let reach = reached(machine, port)?
        .ok_or_else(|| anyhow!("no triangle covers a pixel of the screen: nothing to size; check the input, screen.width and screen.height"))?;
    let guard_bits = GuardBits { machine: machine.guard_bits, needed: needed_guard_bits(machine, port) };
    // POLY moves from one pixel of the screen to another.
    let guard_columns = if machine.polygon.is_there() { 0 } else { (1 << guard_bits.needed) - 1 };
    let fewest = Screen { guard_columns, ..machine.screen() };
    // Neither what is made of the values on their way to memory nor the segments of an adder change their words.
    let (whole, machine) = (machine, &plain(machine)?);
    // Red, green and blue are of one format.
    let all = machine.channels().iter().enumerate().filter(|(place, _)| !(2..4).contains(place));
    let of = |(place, channel): (usize, &Channel)| {
        let (name, key) = match place {
            0 => ("z", "formats.z_fraction".to_owned()),
            1 => ("color", "formats.color_fraction".to_owned()),
            _ => (channel.name, format!("channels.{}_fraction", channel.name)),
        };
        let of_any = Behind::of_any(whole, place);
        let of_these = Behind::of_frame(whole, frame, place);
        let answer = |screen, reach, behind: &_| Answer::of(machine, place, screen, reach, behind, error);
        Ok(ChannelSize {
            name,
            key,
            fraction_bits: channel.fraction,
            every: answer(machine.screen(), None, &of_any)?,
            every_in_fewest_guard_bits: answer(fewest, None, &of_any)?.without_breaker(),
            these: answer(walked(machine, reach.steps), Some(&reach), &of_these)?,
        })
    };
    Ok(Size { error, guard_bits, channels: all.map(of).collect::<Result<_>>()? })
}

/// The machine without SHADE, SHADOW, BLEND and DITHER, and with adders of one segment, which a word of any length has.
fn plain(machine: &Plan) -> Result<Plan> {
    let bare = Machine::default();
    let adders = machine.adders.min(bare.adders + machine.extra);
    let plain = machine.with(|keys| {
        (keys.shade, keys.shadow) = (bare.shade, bare.shadow);
        (keys.blend, keys.dither) = (bare.blend, bare.dither);
        (keys.adders, keys.segments) = (adders, bare.segments);
    });
    Ok(plain.plan()?)
}

/// The fewest guard bits in which the screen and all vertices lie.
fn needed_guard_bits(machine: &Plan, port: &PortFrame) -> u32 {
    let vertices = port.triangles.iter().flatten();
    let farthest = vertices.map(|v| v.x().unsigned_abs().max(v.y().unsigned_abs())).max().unwrap_or_default();
    let pixels = (u64::from(farthest)).div_ceil(1 << machine.subpixel_bits);
    let side = u64::from(machine.width.max(machine.height));
    (2..machine.guard_bits).find(|g| (1 << g) > pixels && (1 << g) >= side).unwrap_or(machine.guard_bits)
}

/// A screen with so many steps to its last pixel, on the machine's.
fn walked(machine: &Plan, steps: Steps) -> Screen {
    let columns = steps.columns + 1;
    let width = columns.min(machine.width);
    Screen { width, height: steps.lines + 1, guard_columns: columns - width }
}

impl Answer {
    fn of(
        machine: &Plan,
        place: usize,
        screen: Screen,
        reach: Option<&Reach>,
        behind: &Result<Behind, String>,
        error: f64,
    ) -> Result<Answer> {
        let steps = screen.max_steps();
        let mut answer = Answer {
            additions: steps.total(),
            needed_by: reach.map(|reach| (reach.triangle, reach.pixel)),
            steps: (steps.lines, steps.columns),
            fraction_bits: None,
            bound: None,
            out_of_reach: None,
            one_bit_fewer: None,
            no_breaker: None,
        };
        let channel = machine.channels()[place];
        let left = behind.clone().and_then(|behind| Ok((behind, behind.left(error)?)));
        match left.and_then(|(behind, left)| Ok((behind, left, least(machine, &channel, steps, left)?))) {
            Ok((behind, error, (bits, target))) => {
                let budget = with_fraction(channel, bits).error_budget(steps);
                answer.fraction_bits = Some(bits);
                answer.bound = Some(behind.stored(budget.after_rounding().to_f64()));
                match Breaker::search(machine, place, screen, bits, target, error)? {
                    Ok(breaker) => answer.one_bit_fewer = Some(breaker),
                    Err(why) => answer.no_breaker = Some(why),
                }
            }
            Err(why) => answer.out_of_reach = Some(why),
        }
        Ok(answer)
    }

    fn without_breaker(self) -> Self {
        Answer { one_bit_fewer: None, no_breaker: None, ..self }
    }
}

/// The channel with other fraction bits; it has no more of the vertex.
fn with_fraction(mut channel: Channel, fraction: u32) -> Channel {
    channel.precision.fraction = fraction;
    channel.precision.vertex_fraction = channel.vertex_fraction.min(fraction);
    channel
}

/// The least fraction bits, and which of bounds 2 and 4 asks for them.
fn least(machine: &Plan, channel: &Channel, steps: Steps, error: f64) -> Result<(u32, Target), String> {
    if machine.fill == Fill::Textbook {
        return Err(
            "with edge.fill = textbook outputs wrap outside the triangle, whatever its bits".to_owned()
        );
    }
    // What is left for the additions.
    let budget = channel.error_budget(steps);
    let allowed = Dyadic::new((error * f64::from(1u32 << 31)).floor() as i128, 31);
    let left = allowed.and_then(|all| all.checked_sub(budget.output)?.checked_sub(budget.vertex));
    let left = left.filter(|left| *left > Dyadic::ZERO).ok_or_else(|| {
        let parts = budget.output.to_f64() + budget.vertex.to_f64();
        format!(
            "the roundings of the vertices and of the output may err by {parts} LSB already; raise the vertex's fraction bits ({}), or allow more with --error",
            channel.vertex_fraction
        )
    })?;
    let bits = |target| {
        least_fraction_bits(steps, Rounding::NearestHalfUp, target).map_err(|error| error.to_string())
    };
    let (in_range, near) = (bits(Target::InRange)?, bits(Target::AtMost(left))?);
    // Where both ask for the same bits, an output that wraps is the better witness.
    let target = if near > in_range { Target::AtMost(left) } else { Target::InRange };
    let most = edgewalk_machine::keys::KEYS.iter().find(|key| key.name == "formats.z_fraction");
    let bits = in_range.max(near).max(channel.vertex_fraction);
    match most.map(|key| key.domain) {
        Some(edgewalk_machine::key::Domain::Range(_, most)) if bits > most => {
            Err(format!("{bits} fraction bits would be needed, a channel has at most {most}"))
        }
        _ => Ok((bits, target)),
    }
}
