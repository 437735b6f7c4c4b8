//! The emitted Verilog under Verilator, driven by `harness.cpp`.

use crate::input::PortFrame;
use crate::verdict::ToolError;
use anyhow::{Context, Result, anyhow};
use edgewalk_numerics::Machine;
use std::process::Command;

const HARNESS: &str = include_str!("harness.cpp");

/// Milliseconds of every frame but the first, and the cycles of one; `None` where Verilator is not installed.
pub fn time(machine: &Machine, port: &PortFrame, frames: u32) -> Result<Option<(Vec<f64>, u64)>> {
    if Command::new("verilator").arg("--version").output().is_err() {
        return Ok(None);
    }
    let folder = tempfile::tempdir().context("a folder for Verilator")?;
    let design = edgewalk_rtl::machine(machine).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
    let top = design.name.clone();
    let mut sources = Vec::new();
    for (name, text) in edgewalk_verilog::print(&design) {
        std::fs::write(folder.path().join(&name), text)?;
        sources.push(name);
    }
    std::fs::write(folder.path().join("harness.cpp"), HARNESS)?;
    std::fs::write(folder.path().join("stimulus.bin"), stimulus(port))?;
    let build = Command::new("verilator")
        .current_dir(folder.path())
        .args([
            "--cc",
            "--exe",
            "--build",
            "-O3",
            "--x-assign",
            "fast",
            "--prefix",
            "Vmachine",
            "--top-module",
            &top,
        ])
        .args(["-CFLAGS", "-O3", "-Wno-fatal", "harness.cpp"])
        .args(&sources)
        .output()
        .context("verilator")?;
    if !build.status.success() {
        let text = String::from_utf8_lossy(&build.stderr);
        return Err(ToolError(format!(
            "verilator: {}",
            text.lines().take(5).collect::<Vec<_>>().join(" / ")
        ))
        .into());
    }
    let run = Command::new(folder.path().join("obj_dir/Vmachine"))
        .current_dir(folder.path())
        .arg("stimulus.bin")
        .arg(machine.latency.to_string())
        .arg(machine.widths().address.to_string())
        .arg(port.state.depth_func.to_string())
        .arg(u8::from(port.state.depth_write).to_string())
        .arg(machine.z.max().to_string())
        .arg((frames + 1).to_string())
        .output()
        .context("the verilated machine")?;
    let text = String::from_utf8_lossy(&run.stdout);
    let rows: Option<Vec<(u64, f64)>> = text
        .lines()
        .skip(1)
        .map(|line| {
            let mut words = line.split(' ');
            let cycles = words.next()?.parse().ok()?;
            Some((cycles, words.nth(1)?.parse().ok()?))
        })
        .collect();
    match rows {
        Some(rows) if rows.len() == frames as usize => {
            Ok(Some((rows.iter().map(|r| r.1).collect(), rows[0].0)))
        }
        _ => Err(ToolError(format!("the verilated machine printed `{}`", text.trim())).into()),
    }
}

fn stimulus(port: &PortFrame) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(port.triangles.len() * 144);
    for vertex in port.triangles.iter().flatten() {
        bytes.extend(i64::from(vertex.x).to_le_bytes());
        bytes.extend(i64::from(vertex.y).to_le_bytes());
        for value in vertex.value {
            bytes.extend(value.to_le_bytes());
        }
    }
    bytes
}
