//! The `edgewalk` program: a file a command.
//!
//! ```text
//!  scene | mesh | triangle file ──> input ──> engine (golden, model, rtl) ──> compare ──> report, pictures, arrays
//!  machine file, preset, --set  ──> machine_args ──┘
//! ```
//!
//! Its commands are the crates of this workspace, one thin file a command: `edgewalk --help`. A program of one's own
//! depends on the crates, not on this one; `docs/architecture.md` says which does what.

#![deny(clippy::print_stdout, clippy::print_stderr)] // they panic where they cannot write; see talk.rs

mod cell_energy;
mod commands;
mod cost;
mod design;
mod document;
mod engine;
mod estimator;
mod fast;
mod fast_phong;
mod input;
mod jobs;
mod junit;
mod kept;
mod lamps;
mod machine_args;
mod number;
mod own;
mod pictures;
mod progress;
mod shading_report;
mod shadows;
mod shell;
mod suites;
mod talk;
mod triangles;
mod verdict;

use anyhow::{Result, anyhow};
use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
use commands::{
    bench, calibrate, compare, completions, config, demo, emit, energy, estimate, explain, gallery, judge,
    man, mutants, raster, render, replay, size, sweep, synth, trace, vectors, verify,
};
use edgewalk_host::advice::without_engine;
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
    /// Print the report as one JSON document instead of text, and errors as JSON too
    #[arg(long, global = true)]
    json: bool,
    /// Print nothing but errors
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
    Judge(judge::Args),
    Emit(emit::Args),
    Vectors(vectors::Args),
    Verify(verify::Args),
    Mutants(mutants::Args),
    Trace(trace::Args),
    Replay(replay::Args),
    Synth(synth::Args),
    Estimate(estimate::Args),
    Calibrate(calibrate::Args),
    Energy(energy::Args),
    Bench(bench::Args),
    Config(config::Args),
    Completions(completions::Args),
    Man(man::Args),
}

/// Makes the allocator keep freed memory for the next use. glibc gives memory back above a threshold, and raises this
/// threshold to the largest block that was freed. Without that a sweep asks for the same memory again and again.
fn keep_freed_memory() {
    drop(std::hint::black_box(Vec::<u8>::with_capacity(16 << 20)));
}

fn main() -> ExitCode {
    keep_freed_memory();
    let mut has_engine = true;
    let (talk, result) = match parsed() {
        Ok(cli) => {
            has_engine = matches!(cli.command, Command::Render(_) | Command::Raster(_));
            let talk = Talk { json: cli.json, quiet: cli.quiet };
            if talk.quiet {
                progress::be_quiet();
            }
            (talk, edgewalk_files::watch_signals().and_then(|()| run(&cli, talk)))
        }
        Err(page) => {
            let talk = Talk { json: std::env::args_os().any(|word| word == "--json"), quiet: false };
            (talk, page_or_error(&page, talk))
        }
    };
    ExitCode::from(exit_code(result, has_engine, talk))
}

/// The command line. Behind an option or as a value of its own `-1` is a number, which the range of the value refuses.
fn parsed() -> Result<Cli, clap::Error> {
    let matches = with_numbers(Cli::command()).try_get_matches()?;
    Cli::from_arg_matches(&matches).map_err(|error| error.format(&mut Cli::command()))
}

fn with_numbers(command: clap::Command) -> clap::Command {
    command.allow_negative_numbers(true).mut_subcommands(with_numbers)
}

/// Help and version are output like any other; what the command line has wrong is an error.
fn page_or_error(page: &clap::Error, talk: Talk) -> Result<Verdict> {
    if page.use_stderr() && talk.json {
        let text = page.render().to_string();
        return Err(anyhow!("{}", text.trim_start_matches("error: ").trim_end()));
    }
    if page.use_stderr() {
        page.exit();
    }
    talk::printed(page.print().and_then(|()| std::io::stdout().flush()))?;
    Ok(Verdict::Pass)
}

fn run(cli: &Cli, talk: Talk) -> Result<Verdict> {
    match &cli.command {
        Command::Demo(a) => demo::run(a, &cli.machine, talk),
        Command::Render(a) => render::run(a, &cli.machine, talk),
        Command::Gallery(a) => {
            cli.machine.refuse("each exhibit has its own machine").and_then(|()| gallery::run(a, talk))
        }
        Command::Explain(a) => explain::run(a, &cli.machine, talk),
        Command::Raster(a) => raster::run(a, &cli.machine, talk),
        Command::Triangles(a) => commands::triangles::run(a, &cli.machine, talk),
        Command::Size(a) => size::run(a, &cli.machine, talk),
        Command::Sweep(a) => sweep::run(a, &cli.machine, talk),
        Command::Compare(a) => compare::run(a, &cli.machine, talk),
        Command::Judge(a) => judge::run(a, &cli.machine, talk),
        Command::Emit(a) => emit::run(a, &cli.machine, talk),
        Command::Vectors(a) => vectors::run(a, &cli.machine, talk),
        Command::Verify(a) => verify::run(a, &cli.machine, talk),
        Command::Mutants(a) => mutants::run(a, &cli.machine, talk),
        Command::Trace(a) => trace::run(a, &cli.machine, talk),
        Command::Replay(a) => replay::run(a, &cli.machine, talk),
        Command::Synth(a) => synth::run(a, &cli.machine, talk),
        Command::Estimate(a) => estimate::run(a, &cli.machine, talk),
        Command::Calibrate(a) => {
            cli.machine.refuse("--machines lists the machines").and_then(|()| calibrate::run(a, talk))
        }
        Command::Energy(a) => energy::run(a, &cli.machine, talk),
        Command::Bench(a) => bench::run(a, &cli.machine, talk),
        Command::Config(a) => config::run(a, &cli.machine, talk),
        Command::Completions(a) => {
            cli.machine.refuse("no machine is used").and_then(|()| completions::run(a, Cli::command(), talk))
        }
        Command::Man(a) => {
            cli.machine.refuse("no machine is used").and_then(|()| man::run(a, Cli::command(), talk))
        }
    }
}

/// The exit code; where it is not 0, standard error says why, however quiet the command is. A command without --engine advises none.
fn exit_code(result: Result<Verdict>, has_engine: bool, talk: Talk) -> u8 {
    let code = result.as_ref().map_or_else(verdict::of_error, |verdict| verdict::exit_code(*verdict));
    match &result {
        Err(error) => {
            let text = format!("{error:#}");
            talk.fail(&if has_engine { text } else { without_engine(&text) }, code);
        }
        Ok(Verdict::Vacuous) => talk.fail("nothing was compared, so nothing is shown to agree", code),
        Ok(Verdict::Open) => talk.fail(
            "no pixel was compared: at each covered pixel two depths are nearer than their bound; permitted: depths farther \
             apart; move the triangles, or raise formats.z_bits",
            code,
        ),
        Ok(Verdict::Mismatch) if talk.quiet => {
            talk.fail("mismatch: what was compared differs; without --quiet the report says where", code);
        }
        Ok(_) => {}
    }
    code
}
