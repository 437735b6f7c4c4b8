//! A triangle that breaks one fraction bit fewer, drawn to see that it does.

use super::with_fraction;
use anyhow::Result;
use edgewalk_host::draw;
use edgewalk_host::port::to_port;
use edgewalk_judge::beside::{Golden, Proved, beside};
use edgewalk_machine::{Channel, Kind, MachineError, Plan};
use edgewalk_model::Waits;
use edgewalk_numerics::solver::solve;
use edgewalk_numerics::{ChannelBits, Rounding, Screen, Target, Witness};
use edgewalk_scene::{DepthFunc, Frame, Triangle, Vertex};
use serde::Serialize;

/// A triangle, and what a machine with too few bits makes of it.
#[derive(Clone, Serialize)]
pub struct Breaker {
    /// The fraction bits that do not suffice.
    pub fraction_bits: u32,
    /// The pixel that is wrong: column and line.
    pub pixel: (u32, u32),
    /// Largest error of the channel, drawn with these bits, LSB.
    pub error: f64,
    /// The output leaves its range and wraps: its error is that of the other end of the range.
    pub wraps: bool,
    /// In words.
    pub text: String,
    /// The triangle on the machine's screen.
    #[serde(skip)]
    pub frame: Frame,
}

/// Vertices of the solver's triangles are in 2^-8 px.
const SUBPIXEL_BITS: u32 = 8;

impl Breaker {
    /// One for the channel in that place, which `bits` suffice for; or why there is none.
    ///
    /// # Errors
    /// None for a machine that was planned.
    pub(super) fn search(
        machine: &Plan,
        place: usize,
        screen: Screen,
        bits: u32,
        target: Target,
        error: f64,
    ) -> Result<Result<Breaker, String>> {
        let channel = machine.channels()[place];
        let none = |why: &str| Ok(Err(why.to_owned()));
        if channel.kind != Kind::Unorm || place > 1 {
            return none("none is searched for channels of the user's own");
        }
        if machine.subpixel_bits != SUBPIXEL_BITS {
            return none("none is searched for screen.subpixel_bits other than 8");
        }
        if bits <= channel.vertex_fraction {
            return none("the vertex's fraction bits stand in the way of fewer");
        }
        let format = ChannelBits { output: channel.bits, vertex: channel.vertex_fraction };
        let Ok(solution) = solve(screen, format, Rounding::NearestHalfUp, target) else {
            return none("the solver's limits do not reach that far");
        };
        let Some(witness) = solution.one_bit_fewer.filter(|witness| witness.fraction_bits + 1 == bits) else {
            return none("none was found");
        };
        let fewer = match with_bits(machine, place, bits - 1) {
            Ok(fewer) => fewer,
            Err(why) => return none(&format!("no machine has one bit fewer: {why}")),
        };
        let frame = frame(&fewer, place, &witness);
        let port = to_port(&frame, &fewer)?;
        let proved = Proved { reach: None, shading: None };
        let drawn =
            |lines, take: &mut dyn FnMut(_) -> _| draw::in_bands(&fewer, &port, Waits::Never, lines, take);
        let comparison = beside(&fewer, &frame, &Golden::of(&frame, &fewer), proved, drawn, |_| Ok(()))?;
        let found = [comparison.errors.z.error, comparison.errors.color.error][place];
        if found <= error {
            return none("none was found that shows in a rounded output");
        }
        let (pixel, text, wraps) = (witness.pixel, witness.to_string(), wraps(&channel, &witness));
        Ok(Ok(Breaker { fraction_bits: bits - 1, pixel, error: found, wraps, text, frame }))
    }
}

/// The machine with other fraction bits of depth or colour.
fn with_bits(machine: &Plan, place: usize, bits: u32) -> Result<Plan, MachineError> {
    let precision = with_fraction(machine.channels()[place], bits).precision;
    let machine = machine.with(|keys| {
        keys.segments = 1;
        match place {
            0 => keys.z = precision,
            _ => keys.color = precision,
        }
    });
    machine.plan()
}

/// The witness's output leaves the range of the channel.
fn wraps(channel: &Channel, witness: &Witness) -> bool {
    !(0..=i128::from(channel.max())).contains(&witness.output())
}

/// The witness on the machine's screen, with all values moved alike to where its error shows most in the rounded output.
fn frame(machine: &Plan, place: usize, witness: &Witness) -> Frame {
    let channel = machine.channels()[place];
    let (lsb, one) = ((-f64::from(channel.vertex_fraction)).exp2(), f64::from(1u32 << SUBPIXEL_BITS));
    let values = witness.vertices.map(|vertex| vertex.2);
    let top = channel.max() << channel.vertex_fraction;
    let least = values.into_iter().min().unwrap_or(0) as i64;
    let most = values.into_iter().max().unwrap_or(0);
    let room = -least..=(top - most) as i64;
    let turn = 1i64 << channel.vertex_fraction;
    let (sum, exact) = (witness.sum.to_f64(), witness.exact.0 as f64 / witness.exact.1 as f64);
    // The host's own value may lie almost half a vertex LSB on the other side of what the port gets.
    let beside = 0.49 * lsb * (exact - sum).signum();
    let shown = |moved: &i64| {
        let by = *moved as f64 * lsb;
        ((sum + by + 0.5).floor() - (exact + by + beside)).abs()
    };
    let moves = (-turn..=turn).filter(|moved| room.contains(moved));
    // An output that wraps is where it is.
    let wraps = wraps(&channel, witness);
    let moved = if wraps { None } else { moves.max_by(|a, b| shown(a).total_cmp(&shown(b))) };
    let beside = if wraps { 0.0 } else { beside };
    let vertex = |(x, y, value): (i32, i32, u64)| {
        let lsbs = (value as i64 + moved.unwrap_or(0)) as f64 * lsb + beside;
        let value = (lsbs / channel.max() as f64).clamp(0.0, 1.0);
        let (z, color) = if place == 0 { (value, 0.5) } else { (0.5, value) };
        let [x, y] = [x, y].map(|place| f64::from(place) / one);
        Vertex { x, y, z, r: color, g: color, b: color, ..Vertex::default() }
    };
    let triangles = vec![Triangle(witness.vertices.map(vertex))];
    let depth = Some(DepthFunc::Always);
    let extra = machine.extra as usize;
    Frame { depth, triangles, extra, ..Frame::new(machine.width, machine.height) }
}
