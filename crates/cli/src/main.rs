//! The `edgewalk` program: a file a command.
//!
//! ```text
//!  scene | mesh | triangle file ──> input ──> engine (golden, model, rtl) ──> compare ──> report, pictures, arrays
//!  machine file, preset, --set  ──> machine_args ──┘
//! ```

#![deny(clippy::print_stdout, clippy::print_stderr)] // they panic where they cannot write; see talk.rs

mod arrays;
mod commands;
mod cost;
mod engine;
mod fast;
mod fast_phong;
mod input;
mod jobs;
mod machine_args;
mod picture;
mod progress;
mod scratch;
mod shading_report;
mod shadows;
mod staging;
mod talk;
mod triangles;
mod verdict;

use anyhow::Result;
use clap::{Parser, Subcommand};
use commands::{
    bench, compare, config, demo, emit, explain, gallery, raster, render, replay, size, sweep, synth, trace,
    vectors, verify,
};
use machine_args::MachineArgs;
use std::io::Write as _;
use std::process::ExitCode;
use talk::Talk;
use verdict::Verdict;

/// Fixed-point incremental triangle hardware: model, netlist, Verilog and the proof that they agree.
///
/// Exit codes: 0 pass, 1 mismatch, 2 bad input or nothing checked, 3 tool missing or broken, 4 time limit.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  edgewalk demo
  edgewalk render torus-knot --out out/knot
  edgewalk raster triangles.tri --engine model --out out/r
  edgewalk explain torus-knot 320 240
  edgewalk verify sphere --set interpolator.adders=1
  edgewalk config explain"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    machine: MachineArgs,
    /// Prints the report as one JSON value instead of text
    #[arg(long, global = true)]
    json: bool,
    /// Prints nothing but errors
    #[arg(long, short, global = true)]
    quiet: bool,
}

#[derive(Subcommand)]
enum Command {
    Demo(demo::Args),
    Render(render::Args),
    Gallery(gallery::Args),
    Explain(explain::Args),
    Raster(raster::Args),
    Triangles(commands::triangles::Args),
    Size(size::Args),
    Sweep(Box<sweep::Args>),
    Compare(compare::Args),
    Emit(emit::Args),
    Vectors(vectors::Args),
    Verify(verify::Args),
    Trace(trace::Args),
    Replay(replay::Args),
    Synth(synth::Args),
    Bench(bench::Args),
    Config(config::Args),
}

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(wrong) if wrong.use_stderr() => wrong.exit(),
        // Help and version are output like any other.
        Err(page) => {
            let printed = page.print().and_then(|()| std::io::stdout().flush());
            return exit_code(talk::printed(printed).map(|()| Verdict::Pass), false);
        }
    };
    exit_code(scratch::watch_signals().and_then(|()| run(&cli)), cli.quiet)
}

fn run(cli: &Cli) -> Result<Verdict> {
    let talk = Talk { json: cli.json, quiet: cli.quiet };
    match &cli.command {
        Command::Demo(a) => demo::run(a, &cli.machine, talk),
        Command::Render(a) => render::run(a, &cli.machine, talk),
        Command::Gallery(a) => gallery::run(a, talk),
        Command::Explain(a) => explain::run(a, &cli.machine, talk),
        Command::Raster(a) => raster::run(a, &cli.machine, talk),
        Command::Triangles(a) => commands::triangles::run(a, &cli.machine, talk),
        Command::Size(a) => size::run(a, &cli.machine, talk),
        Command::Sweep(a) => sweep::run(a, &cli.machine, talk),
        Command::Compare(a) => compare::run(a, &cli.machine, talk),
        Command::Emit(a) => emit::run(a, &cli.machine, talk),
        Command::Vectors(a) => vectors::run(a, &cli.machine, talk),
        Command::Verify(a) => verify::run(a, &cli.machine, talk),
        Command::Trace(a) => trace::run(a, &cli.machine, talk),
        Command::Replay(a) => replay::run(a, &cli.machine, talk),
        Command::Synth(a) => synth::run(a, &cli.machine, talk),
        Command::Bench(a) => bench::run(a, &cli.machine, talk),
        Command::Config(a) => config::run(a, &cli.machine, talk.json),
    }
}

/// The exit code; where it is not 0, standard error says why, however quiet the command is.
fn exit_code(result: Result<Verdict>, quiet: bool) -> ExitCode {
    match &result {
        Ok(Verdict::Mismatch) if quiet => {
            talk::complain("mismatch: what was compared differs; without --quiet the report says where");
        }
        Ok(_) => {}
        Err(error) => talk::complain(&format!("{error:#}")),
    }
    result.map_or_else(|error| verdict::of_error(&error), verdict::exit_code)
}
