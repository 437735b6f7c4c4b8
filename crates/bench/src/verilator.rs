//! The emitted Verilog under Verilator, driven by `harness.cpp`.

use super::job::{Job, Times, Work};
use super::ports::header;
use super::stopwatch::{Stopwatch, Time};
use anyhow::{Result, anyhow};
use edgewalk_lockstep::{Interface, Triangles, Unit};
use edgewalk_tool::{Stop, first_lines, run};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

const HARNESS: &str = include_str!("harness.cpp");

/// Times it with its files in this folder.
pub fn time(job: &Job, folder: &Path) -> Result<Times> {
    let start = Stopwatch::start();
    build(job, folder)?;
    let built = start.read().wall;
    std::fs::write(folder.join("stimulus.bin"), stimulus(job))?;
    for (i, memory) in Interface::new(job.machine, Unit::MACHINE).memories.iter().enumerate() {
        let bytes = if job.has_wide_words() { 16 } else { 8 };
        let words = job.words(memory.name).into_iter();
        let words = words.flat_map(|word| word.to_le_bytes().into_iter().take(bytes));
        std::fs::write(folder.join(format!("memory{i}.bin")), words.collect::<Vec<u8>>())?;
    }
    let program = folder.join("obj_dir/Vmachine");
    std::fs::metadata(&program).map_err(|error| Stop::unwritten("verilator", &program, &error))?;
    let mut machine = Command::new(program);
    machine.current_dir(folder).arg("stimulus.bin").arg((job.repeat + 1).to_string());
    machine.args(job.constants()?.iter().map(ToString::to_string));
    let text = run(&mut machine, Duration::MAX)?;
    let frames: Option<Vec<(Work, Time)>> = text.lines().map(frame).collect();
    match frames.as_deref() {
        Some(all @ [(_, first), rest @ ..]) if rest.len() == job.repeat as usize => Ok(Times {
            first: built + first.wall,
            frames: rest.iter().map(|(_, time)| *time).collect(),
            work: all.iter().map(|(work, _)| *work).find(|work| *work != job.work).unwrap_or(job.work),
        }),
        _ => {
            let tool = "the verilated machine".to_owned();
            Err(Stop::Broken { tool, lines: first_lines(text.lines()) }.into())
        }
    }
}

fn build(job: &Job, folder: &Path) -> Result<()> {
    let design =
        edgewalk_rtl::machine(job.machine).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    let mut sources = Vec::new();
    for (name, text) in edgewalk_verilog::print(&design) {
        std::fs::write(folder.join(&name), text)?;
        sources.push(name);
    }
    std::fs::write(folder.join("harness.cpp"), HARNESS)?;
    std::fs::write(folder.join("ports.h"), header(job.machine))?;
    let mut build = Command::new("verilator");
    build.current_dir(folder);
    build.args(["--cc", "--exe", "--build", "-O3", "--x-assign", "fast", "--prefix", "Vmachine"]);
    build.args(["--top-module", &design.name, "-MAKEFLAGS", "OPT_FAST=-O3", "-Wno-fatal", "harness.cpp"]);
    if job.has_wide_words() {
        build.args(["-CFLAGS", "-DWIDE_WORDS"]);
    }
    run(build.args(&sources), Duration::MAX)?;
    Ok(())
}

/// A line of the harness: cycles, writes, milliseconds on the processor and on the wall.
fn frame(line: &str) -> Option<(Work, Time)> {
    let words: Vec<&str> = line.split(' ').collect();
    let [cycles, writes, cpu, wall] = words[..] else { return None };
    let work = Work { cycles: cycles.parse().ok()?, writes: writes.parse().ok()? };
    Some((work, Time { cpu: cpu.parse().ok()?, wall: wall.parse().ok()? }))
}

fn stimulus(job: &Job) -> Vec<u8> {
    let port = Triangles::new(job.machine);
    let tokens = job.triangles.iter().flat_map(|triangle| port.offers(triangle, 0));
    tokens.flatten().flat_map(|value| (value as u64).to_le_bytes()).collect() // no port of a triangle is wider
}
