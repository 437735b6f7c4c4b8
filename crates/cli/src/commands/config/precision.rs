//! How right the outputs of a machine are, and how many fraction bits its screen needs.

use edgewalk_judge::verdict::{EVERY_PIXEL, holds};
use edgewalk_machine::{Channel, Fill, NoBound, Plan};
use edgewalk_numerics::solver::solve;
use edgewalk_numerics::{ChannelBits, Dyadic, Rounding, Solution, Target, Witness};
use serde::Serialize;
use std::fmt::Write as _;

/// Depth and colour.
#[derive(Serialize)]
pub struct Precision {
    /// Where the additions behind a fragment come from, and how many there are at most.
    additions: String,
    /// The pixels for which bounds hold.
    holds: &'static str,
    z: Proof,
    color: Proof,
}

/// What is proved of a channel.
#[derive(Serialize)]
struct Proof {
    /// Largest error of the stored value in every frame, LSB.
    bound: Option<f64>,
    /// Why there is none.
    no_bound: Option<String>,
    /// Fraction bits of the interpolator.
    fraction_bits: u32,
    /// The least of them with a bound of at most 1 LSB, on this screen with this guard band and these vertices.
    needed_fraction_bits: Option<u32>,
    /// Why no number of them will do.
    out_of_reach: Option<String>,
    /// A triangle that breaks one bit fewer, and how; none where the vertex bits stand in the way, where none was found, or
    /// where the machine takes no such vertices.
    one_bit_fewer: Option<String>,
}

impl Precision {
    /// Of this machine.
    pub fn of(machine: &Plan) -> Self {
        Precision {
            additions: machine.screen().to_string(),
            holds: holds(machine),
            z: Proof::of(machine, 0, "z"),
            color: Proof::of(machine, 1, "color"),
        }
    }

    /// Largest errors of stored depth and colour, LSB, and why there is none.
    pub fn bounds(&self) -> [(Option<f64>, Option<&str>); 2] {
        [&self.z, &self.color].map(|proof| (proof.bound, proof.no_bound.as_deref()))
    }

    /// As lines of text. Writing to a string cannot fail.
    pub fn text(&self) -> String {
        let mut t = String::new();
        let holds = match self.holds {
            EVERY_PIXEL => String::new(),
            some => format!(" at {some}"),
        };
        _ = writeln!(t, "    additions to a pixel   {}", self.additions);
        for (name, proof) in [("z", &self.z), ("colour", &self.color)] {
            _ = match (proof.bound, &proof.no_bound) {
                (Some(bound), _) => {
                    writeln!(t, "    {name:<6} error           at most {bound:.4} LSB, proved{holds}")
                }
                (None, why) => {
                    writeln!(
                        t,
                        "    {name:<6} error           no bound: {}",
                        why.as_deref().unwrap_or_default()
                    )
                }
            };
            _ = match (proof.needed_fraction_bits, &proof.out_of_reach) {
                (Some(bits), _) => writeln!(t, "    {name:<6} fraction bits   {bits} are needed for 1 LSB"),
                (None, why) => {
                    writeln!(
                        t,
                        "    {name:<6} fraction bits   no number will do: {}",
                        why.as_deref().unwrap_or_default()
                    )
                }
            };
            if let Some(witness) = &proof.one_bit_fewer {
                _ = writeln!(t, "                           {witness}");
            }
        }
        t
    }
}

impl Proof {
    fn of(machine: &Plan, place: usize, name: &str) -> Self {
        let (channel, bound) = (machine.channels()[place], machine.proved_output(place));
        let own = channel.error_budget(machine.max_steps()).after_rounding().to_f64();
        let solved = match bound {
            Err(
                why @ (NoBound::Shaded
                | NoBound::Bilinear
                | NoBound::Layered { .. }
                | NoBound::Polygons { .. }),
            ) => Err(why.to_string()),
            Ok(bound) if bound >= own + 0.5 => Err(format!(
                "the units behind the interpolator may err by {:.4} LSB; `edgewalk size --error` takes more than 1 LSB",
                bound - own
            )),
            // More bits may give the bound that is missing.
            Ok(_) | Err(NoBound::Wraps { .. } | NoBound::Textbook) => needed(machine, channel, name),
        };
        // A vertex has no more fraction bits than the interpolator.
        let bits = solved.as_ref().ok().map(|solution| solution.fraction_bits.max(channel.vertex_fraction));
        let witness = solved.as_ref().ok().filter(|solution| Some(solution.fraction_bits) == bits);
        Proof {
            bound: bound.ok(),
            no_bound: bound.err().map(|why| why.to_string()),
            fraction_bits: channel.fraction,
            needed_fraction_bits: bits,
            one_bit_fewer: witness
                .and_then(|solution| solution.one_bit_fewer.as_ref())
                .filter(|witness| takes(machine, witness))
                .map(ToString::to_string),
            out_of_reach: solved.err(),
        }
    }
}

/// Whether the vertices of the triangle are some of the machine: theirs are in 2^-8 px.
fn takes(machine: &Plan, witness: &Witness) -> bool {
    let limit = ((1i32 << machine.guard_bits) - 1) << 8;
    let inside = |(x, y, _): &(i32, i32, u64)| x.abs() <= limit && y.abs() <= limit;
    machine.subpixel_bits == 8 && witness.vertices.iter().all(inside)
}

/// The least fraction bits with which nothing wraps and the output is within 1 LSB of the plane through the host's values.
fn needed(machine: &Plan, channel: Channel, name: &str) -> Result<Solution, String> {
    if machine.fill == Fill::Textbook {
        return Err(
            "with edge.fill = textbook outputs wrap outside the triangle, whatever its bits".to_owned()
        );
    }
    // 1 LSB less what the output rounding and the vertices may err by.
    let vertex = channel.error_budget(machine.max_steps()).vertex;
    let left = Dyadic::HALF.checked_sub(vertex).filter(|left| *left > Dyadic::ZERO);
    let left = left.ok_or_else(|| {
        format!(
            "vertices and outputs rounded to whole LSB may err by 1 LSB already; raise formats.{name}_vertex"
        )
    })?;
    let bits = ChannelBits { output: channel.bits, vertex: channel.vertex_fraction };
    let solve =
        |target| solve(machine.screen(), bits, Rounding::NearestHalfUp, target).map_err(|e| e.to_string());
    let (in_range, near) = (solve(Target::InRange)?, solve(Target::AtMost(left))?);
    // Where both ask for the same bits, an output that wraps is the better witness.
    Ok(if near.fraction_bits > in_range.fraction_bits { near } else { in_range })
}
