//! The emitted Verilog under Verilator, driven by `harness.cpp`.

use super::job::{Job, Times, Work};
use super::ports::header;
use super::stopwatch::{Stopwatch, Time};
use anyhow::{Context, Result, anyhow};
use edgewalk_lockstep::{Interface, Triangles, Unit};
use std::path::Path;
use std::process::Command;

const HARNESS: &str = include_str!("harness.cpp");

/// Verilator, or the machine that it made, which does not do its work.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ToolError(pub String);

/// Times it with its files in this folder, or says that it is not installed.
pub fn time(job: &Job, folder: &Path) -> Result<Result<Times, String>> {
    if Command::new("verilator").arg("--version").output().is_err() {
        return Ok(Err("verilator is not installed".to_owned()));
    }
    let start = Stopwatch::start();
    build(job, folder)?;
    let built = start.read().wall;
    std::fs::write(folder.join("stimulus.bin"), stimulus(job))?;
    for (i, memory) in Interface::new(job.machine, Unit::MACHINE).memories.iter().enumerate() {
        let words = job.words(memory.name).into_iter().flat_map(u64::to_le_bytes);
        std::fs::write(folder.join(format!("memory{i}.bin")), words.collect::<Vec<u8>>())?;
    }
    let output = Command::new(folder.join("obj_dir/Vmachine"))
        .current_dir(folder)
        .arg("stimulus.bin")
        .arg((job.repeat + 1).to_string())
        .args(job.constants()?.iter().map(ToString::to_string))
        .output()
        .context("the verilated machine")?;
    let text = String::from_utf8_lossy(&output.stdout);
    let frames: Option<Vec<(Work, Time)>> = text.lines().map(frame).collect();
    match frames.as_deref() {
        Some([(work, first), rest @ ..]) if rest.len() == job.repeat as usize => Ok(Ok(Times {
            first: built + first.wall,
            frames: rest.iter().map(|(_, time)| *time).collect(),
            work: *work,
        })),
        _ => Err(ToolError(format!("the verilated machine printed `{}`", text.trim())).into()),
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
    let build = Command::new("verilator")
        .current_dir(folder)
        .args(["--cc", "--exe", "--build", "-O3", "--x-assign", "fast", "--prefix", "Vmachine"])
        .args(["--top-module", &design.name, "-MAKEFLAGS", "OPT_FAST=-O3", "-Wno-fatal", "harness.cpp"])
        .args(&sources)
        .output()
        .context("verilator")?;
    if build.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&build.stderr);
    let start: Vec<&str> = text.lines().take(5).collect();
    Err(ToolError(format!("verilator: {}", start.join(" / "))).into())
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
    let tokens = job.triangles.iter().map(|triangle| port.pack(triangle, 0));
    tokens.flatten().flat_map(|value| (value as u64).to_le_bytes()).collect() // no port of a triangle is wider
}
