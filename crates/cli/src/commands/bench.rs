//! `edgewalk bench`: frames and cycles a second of every engine on the same triangles, in one run.

use crate::document::line;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::number::whole;
use crate::verdict::Verdict;
use crate::{Talk, progress};
use anyhow::{Result, anyhow};
use edgewalk_bench::{Engine, Job, Row, Table};
use edgewalk_files::Scratch;
use edgewalk_model::Waits;
use edgewalk_tool::Stop;

/// Time every engine on a triangle file, scene or mesh.
///
/// One frame clears and draws all triangles; reading the file does not count. Slow engines draw the first triangles
/// only, as the output says. Every engine must take the machine's cycles and make its writes, or the exit code is 1.
/// Rates are of processor time, the median frame. Verilator takes part where it is installed; named by
/// --engine it must be, or the exit code is 3. Where no engine is timed, the exit code is 2. Verilator gets the emitted
/// Verilog of the same machine and -O3 --x-assign fast.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk bench triangles.tri
  edgewalk bench teapot.obj --set screen.width=1280 --set screen.height=960 --repeat 21 --json
  edgewalk bench sphere --stalls dram
  taskset -c 0 edgewalk bench triangles.tri --engine fast,tick --set interpolator.adders=1")]
pub struct Args {
    #[command(flatten)]
    source: Source,
    /// Engines to time; all of them if left out
    #[arg(long, value_enum, value_delimiter = ',', value_name = "ENGINE,...")]
    engine: Vec<Engine>,
    /// Stalls of the memory: none, fixed, random, dram, with parameters as fixed:rd=2; only tick runs with stalls
    #[arg(long, value_name = "KIND", default_value = "none")]
    stalls: Waits,
    /// Frames timed for each engine, after one untimed frame
    #[arg(long, default_value_t = 5, value_name = "N", value_parser = whole::<u32>(1..=1000))]
    repeat: u32,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    if let Some(engine) = args.engine.iter().find(|engine| !Engine::ALL.contains(engine)) {
        return Err(engine.not_built());
    }
    let (machine, frame) = args.source.on_its_screen(machine)?;
    let port = args.source.to_port(&frame, &machine)?;
    let whole = Job::new(&machine, &port.triangles, port.words(), (port.state()?, args.stalls), args.repeat)?;
    let size = (machine.width, machine.height);
    Verdict::drew(whole.fragments).or_nothing(&args.source.input, whole.triangles.len() as u64, size)?;
    let asked = Engine::ALL.iter().filter(|e| args.engine.is_empty() || args.engine.contains(e));
    let folder = Scratch::temporary()?;
    let bar = progress::bar(asked.clone().count() as u64, "engines", talk.quiet);
    let mut rows = Vec::new();
    for engine in asked {
        let job = whole.part(engine.budget())?;
        let row = match engine.time(&job, folder.path()) {
            Ok(Ok(times)) => Row::new(engine.name(), &job, &times),
            Ok(Err(absent)) => Row::absent(engine.name(), absent),
            Err(error) => match error.downcast_ref() {
                // Whoever names an engine wants its figures.
                Some(Stop::Missing { tool, .. }) if args.engine.is_empty() => {
                    Row::absent(engine.name(), format!("{tool} is not installed"))
                }
                _ => return Err(error),
            },
        };
        rows.push(row);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let table = Table::new(&whole, rows);
    talk.say(|| line("bench", table.json()), || table.text())?;
    if let Some(why) = table.nothing_timed() {
        return Err(anyhow!(
            "no engine was timed: {why}; permitted: an engine that takes part, as --engine tick does with any machine and any \
             --stalls; name it, or leave --engine out"
        ));
    }
    Ok(if table.agrees() { Verdict::Pass } else { Verdict::Mismatch })
}
