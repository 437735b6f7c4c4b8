//! `edgewalk size`: the word lengths that a frame asks for.

use crate::Talk;
use crate::document::document;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::number::real;
use crate::verdict::Verdict;
use anyhow::{Context, Result};
use edgewalk_explore::size::{Answer, Breaker, ChannelSize, Size, size};
use edgewalk_files::Staging;
use edgewalk_host::input::counted;
use edgewalk_judge::verdict::{EVERY_PIXEL, holds};
use edgewalk_machine::{Counted, Plan};
use edgewalk_scene::triangle_file;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Prove how many fraction bits each channel needs: for every triangle in the guard band, and for those of the
/// input.
///
/// The error is at most --error LSB of the stored value: a light's gate, DITHER, and polygons beside their planes count. Colours
/// that are shaded, blended or bilinear have no bound for every triangle. N additions behind a pixel err by (N + 1)/2 units of the last
/// fraction bit. The report also gives the fewest guard bits. For each answer, a witness triangle exceeds the error
/// with one bit fewer; it is drawn to show that. Witnesses are witness_z_every.tri, witness_color_these.tri and so
/// on; size.json has the whole report.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk size teapot.obj
  edgewalk size torus-knot --error 0.75 --json
  edgewalk size triangles.tri --out out/size
  edgewalk render out/size/witness_z_every.tri --set formats.z_fraction=13")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Largest error of an output, LSB; above 0.5, the share of its rounding
    #[arg(long, default_value_t = 1.0, value_name = "LSB", value_parser = real(f64::NEG_INFINITY..=f64::INFINITY, "LSB"))]
    error: f64,
    /// Folder of the witness triangles
    #[arg(long, value_name = "DIR", default_value = "out/size")]
    out: PathBuf,
}

/// What is told, as JSON.
const REPORT: &str = "size.json";

/// The answers, and what their files are called.
type Answers<'s> = [(&'static str, &'s Answer); 2];

fn answers(channel: &ChannelSize) -> Answers<'_> {
    [("every", &channel.every), ("these", &channel.these)]
}

fn file(channel: &str, answer: &str) -> String {
    format!("witness_{channel}_{answer}.tri")
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let (machine, frame) = args.source.on_its_screen(machine)?;
    let port = args.source.to_port(&frame, &machine)?;
    let found = size(&machine, &frame, &port, args.error).with_context(|| args.source.input.clone())?;
    let out = Staging::new(&args.out)?;
    let mut own = Vec::new();
    for channel in &found.channels {
        for (name, answer) in answers(channel) {
            let name = file(channel.name, name);
            if let Some(Breaker { frame, .. }) = &answer.one_bit_fewer {
                let mut file = out.create(&name)?;
                triangle_file::write(frame, &mut file).with_context(|| out.name(&name))?;
            }
            own.push(name);
        }
    }
    let of = Page { args, machine: &machine, counted: counted(&frame), found: &found };
    let json = document("size", of.value()?)?;
    out.write(REPORT, &json)?;
    own.push(REPORT.to_owned());
    out.publish(&own)?;
    talk.say(|| Ok(json), || of.text())?;
    Ok(Verdict::Pass)
}

struct Page<'p> {
    args: &'p Args,
    machine: &'p Plan,
    counted: Counted,
    found: &'p Size,
}

impl Page<'_> {
    fn value(&self) -> Result<Value> {
        let mut value = json!({
            "input": self.args.source.input,
            "machine": self.machine.hash(),
            "width": self.machine.width,
            "height": self.machine.height,
            "holds": holds(self.machine),
            "triangles": self.counted.triangles,
            "polygons": self.counted.polygons,
        });
        let found = serde_json::to_value(self.found)?;
        for (key, found) in found.as_object().into_iter().flatten() {
            value[key] = found.clone();
        }
        Ok(value)
    }

    /// Writing to a string cannot fail.
    fn text(&self) -> String {
        let mut t = String::new();
        let Page { machine, found, .. } = self;
        _ = writeln!(
            t,
            "{}: {} on {}x{}, machine {}, errors of at most {} LSB",
            self.args.source.input,
            self.counted,
            machine.width,
            machine.height,
            machine.hash(),
            found.error
        );
        let holds = holds(machine);
        if holds != EVERY_PIXEL {
            _ = writeln!(t, "bounds hold at {holds}: a slope edge also draws others");
        }
        let bits = found.guard_bits;
        _ = writeln!(
            t,
            "guard bits: {}; these triangles and the screen lie in {}",
            bits.machine, bits.needed
        );
        for channel in &found.channels {
            _ = writeln!(t, "{} ({} = {})", channel.name, channel.key, channel.fraction_bits);
            let fewest = format!("every triangle, {} guard bits", bits.needed);
            for (what, answer) in [
                ("every triangle in the guard band", &channel.every),
                (&fewest, &channel.every_in_fewest_guard_bits),
                ("these triangles", &channel.these),
            ] {
                _ = writeln!(t, "    {what:<34}{}", answered(answer));
            }
            for (name, answer) in answers(channel) {
                match (&answer.one_bit_fewer, &answer.no_breaker) {
                    (Some(breaker), _) => {
                        let at = self.args.out.join(file(channel.name, name));
                        let ((x, y), bits) = (breaker.pixel, breaker.fraction_bits);
                        let how = match breaker.wraps {
                            true => format!(
                                "wraps at {x},{y}, as N + 1 < 2^r does not hold for N = {} and r = {bits}",
                                answer.additions
                            ),
                            false => format!("errs by {:.4} LSB at {x},{y}", breaker.error),
                        };
                        _ = writeln!(
                            t,
                            "    with {bits} bits {} {how}: --set {}={bits}",
                            at.display(),
                            channel.key
                        );
                    }
                    (None, Some(why)) => {
                        _ = writeln!(t, "    no triangle with one bit fewer ({name}): {why}")
                    }
                    (None, None) => {}
                }
            }
        }
        t
    }
}

fn answered(answer: &Answer) -> String {
    let ((lines, columns), n) = (answer.steps, answer.additions);
    let needed = answer
        .needed_by
        .map_or_else(String::new, |(triangle, (x, y))| format!(", to pixel {x},{y} of triangle {triangle}"));
    let additions = format!("N = {n}: {lines} lines + {columns} columns{needed}");
    match (answer.fraction_bits, answer.bound, &answer.out_of_reach) {
        (Some(bits), Some(bound), _) => format!("{bits:>2} bits, bound {bound:.4} LSB; {additions}"),
        (_, _, why) => {
            format!("no number of bits will do: {}; {additions}", why.as_deref().unwrap_or_default())
        }
    }
}
