//! `edgewalk bench`: frames and cycles a second of every engine on the same triangles, in one run.

mod verilator;

use crate::Talk;
use crate::input::{PortFrame, to_port};
use crate::machine_args::MachineArgs;
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_model::{Inputs, Memory, Model, Stalls};
use edgewalk_numerics::Machine;
use edgewalk_scene::triangle_file;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Instant;

/// Times every engine on a triangle file; one frame is clear and draw all, reading the file is outside the clock.
///
/// With --json prints one line. Verilator takes part where it is installed, built from the emitted Verilog of the same machine with
/// -O3 --x-assign fast, with the same stimulus, and must take the same number of cycles.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk bench triangles.tri
  edgewalk bench triangles.tri --frames 9 --json
  edgewalk bench triangles.tri --no-verilator --no-interpreter")]
pub struct Args {
    /// The triangle file
    file: PathBuf,
    /// Frames timed for each engine, after one that is not
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    frames: u32,
    /// Leaves Verilator out
    #[arg(long)]
    no_verilator: bool,
    /// Leaves the netlist's interpreter out
    #[arg(long)]
    no_interpreter: bool,
}

/// One engine's figures.
#[derive(Serialize)]
struct Line {
    engine: &'static str,
    cpu_ms_median: f64,
    ms_min: f64,
    cycles: u64,
    cycles_per_second: f64,
    pixels_per_second: f64,
    /// Simulated cycles a second, Verilator's being 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    ratio_to_verilator: Option<f64>,
}

impl Line {
    fn new(engine: &'static str, mut ms: Vec<f64>, cycles: u64, fragments: u64) -> Line {
        ms.sort_by(f64::total_cmp);
        let median = ms[ms.len() / 2];
        let a_second = |count: u64| count as f64 * 1000.0 / median;
        Line {
            engine,
            cpu_ms_median: median,
            ms_min: ms[0],
            cycles,
            cycles_per_second: a_second(cycles),
            pixels_per_second: a_second(fragments),
            ratio_to_verilator: None,
        }
    }
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let frame = triangle_file::read(&args.file)?;
    let machine = machine.machine(Some((frame.width, frame.height)))?;
    let port = to_port(&frame, &machine)?;
    let (model, cycles, fragments) = time_model(&machine, &port, args.frames);
    let mut lines = vec![model];
    if !args.no_interpreter {
        lines.push(time_interpreter(&machine, &port, cycles, fragments)?);
    }
    if !args.no_verilator {
        match verilator::time(&machine, &port, args.frames)? {
            Some((ms, count)) if count == cycles => lines.push(Line::new("verilator", ms, count, fragments)),
            Some((_, count)) => return Err(anyhow!("Verilator took {count} cycles, the model {cycles}")),
            None if !talk.quiet => eprintln!("edgewalk: verilator is not installed and takes no part"),
            None => {}
        }
    }
    let verilator = lines.iter().find(|l| l.engine == "verilator").map(|l| l.cycles_per_second);
    for line in &mut lines {
        line.ratio_to_verilator = verilator.map(|v| line.cycles_per_second / v);
    }
    if talk.json {
        let first = &lines[0];
        println!(
            "{}",
            serde_json::json!({
                "renderer": "edgewalk",
                "engine": first.engine,
                "cpu_ms_median": first.cpu_ms_median,
                "ms_min": first.ms_min,
                "triangles": port.triangles.len(),
                "fragments": fragments,
                "machine": machine.hash(),
                "engines": lines,
            })
        );
    } else if !talk.quiet {
        println!(
            "{} triangles, {fragments} fragments, {cycles} cycles a frame, machine {}",
            port.triangles.len(),
            machine.hash()
        );
        println!(
            "{:<12} {:>12} {:>12} {:>12} {:>12} {:>10}",
            "engine", "ms median", "ms min", "Mcycle/s", "Mpixel/s", "ratio"
        );
        for l in &lines {
            let ratio = l.ratio_to_verilator.map_or_else(String::new, |r| format!("{r:.2}"));
            println!(
                "{:<12} {:>12.3} {:>12.3} {:>12.3} {:>12.3} {:>10}",
                l.engine,
                l.cpu_ms_median,
                l.ms_min,
                l.cycles_per_second / 1e6,
                l.pixels_per_second / 1e6,
                ratio
            );
        }
    }
    Ok(Verdict::Pass)
}

fn time_model(machine: &Machine, port: &PortFrame, frames: u32) -> (Line, u64, u64) {
    let (cycles, fragments) = frame(machine, port);
    let ms = (0..frames)
        .map(|_| {
            let start = Instant::now();
            std::hint::black_box(frame(machine, port));
            start.elapsed().as_secs_f64() * 1000.0
        })
        .collect();
    (Line::new("model", ms, cycles, fragments), cycles, fragments)
}

/// One frame of the ticking model: clear and draw all, no more than Verilator's harness does.
fn frame(machine: &Machine, port: &PortFrame) -> (u64, u64) {
    let mut model = Model::new(machine);
    let mut memory = Memory::new(machine, port.state.clear, Stalls::NONE);
    let mut triangles = port.triangles.iter();
    let mut next = triangles.next();
    loop {
        let inputs = Inputs {
            rst: false,
            tri: next.map(|t| (t, 0)),
            depth_func: port.state.depth_func,
            depth_write: port.state.depth_write,
            rd_ready: memory.rd_ready(),
            data: memory.data(),
            wr_ready: memory.wr_ready(),
        };
        let outputs = model.cycle(&inputs);
        let data_taken = inputs.data.is_some() && outputs.data_ready;
        memory.step(
            outputs.rd.filter(|_| inputs.rd_ready),
            data_taken,
            outputs.wr.as_ref().filter(|_| inputs.wr_ready),
        );
        if outputs.tri_ready && next.is_some() {
            next = triangles.next();
        } else if outputs.idle && next.is_none() {
            break;
        }
    }
    (model.counters().cycles, model.counters().fragments)
}

/// The interpreter is slow: it is timed once, on as many triangles from the front of the list as take about a second.
fn time_interpreter(machine: &Machine, port: &PortFrame, cycles: u64, fragments: u64) -> Result<Line> {
    const CYCLES: u64 = 200_000;
    let share = (CYCLES as f64 / cycles.max(1) as f64).min(1.0);
    let count = ((port.triangles.len() as f64 * share).ceil() as usize).min(port.triangles.len());
    let start = Instant::now();
    let triangles = port.triangles[..count].iter().copied();
    let drawn = edgewalk_vectors::render_rtl(machine, triangles, port.state, Stalls::NONE)
        .map_err(|e| anyhow!("{e}"))?;
    let ms = start.elapsed().as_secs_f64() * 1000.0 * cycles as f64 / drawn.counters.cycles as f64;
    Ok(Line::new("interpreter", vec![ms], cycles, fragments))
}
