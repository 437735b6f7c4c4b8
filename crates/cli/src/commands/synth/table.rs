//! The report of `synth`, for machines and for people.

use edgewalk_machine::Plan;
use edgewalk_synth::{Blocks, Cache, Cells, CriticalPath, Design, Memory, Outcome};
use serde::Serialize;
use std::fmt::Write as _;

/// The report, as text and as JSON.
#[derive(Serialize)]
pub struct Report {
    /// Hash of the machine.
    machine: String,
    unit: &'static str,
    /// SHA-256 of the Verilog, harness included.
    verilog: String,
    /// Results of tools that were in the cache, and that were not.
    cached: u64,
    run: u64,
    targets: Vec<Outcome>,
}

impl Report {
    /// Of a finished run.
    pub fn new(machine: &Plan, design: &Design, cache: &Cache, targets: Vec<Outcome>) -> Report {
        let (cached, run) = cache.counts();
        let (unit, verilog) = (design.part.name(), design.hash.clone());
        Report { machine: machine.hash(), unit, verilog, cached, run, targets }
    }

    /// As a table a target. Writing to a string cannot fail.
    pub fn text(&self) -> String {
        let Report { machine, unit, verilog, cached, run, targets } = self;
        let mut text = format!("machine {machine}, {unit}; Verilog sha256 {verilog}\n");
        for target in targets {
            text.push('\n');
            outcome(&mut text, unit, target);
        }
        _ = writeln!(text, "\nresults of tools: {cached} from the cache, {run} new");
        text
    }
}

fn outcome(text: &mut String, unit: &str, of: &Outcome) {
    _ = writeln!(text, "{}: {}", of.target, of.device);
    for tool in of.yosys.iter().chain(&of.nextpnr) {
        _ = writeln!(text, "    {tool}");
    }
    if let Some(whole) = &of.cells {
        _ = writeln!(
            text,
            "    {:<12}{:>7}{:>7}{:>7}{:>6}{:>6}{:>7}",
            "cells", "LUT4", "carry", "FF", "RAM", "DSP", "mux"
        );
        row(text, unit, whole);
        for unit in of.units.iter().flatten() {
            row(text, &format!("  {}", unit.unit), &unit.cells);
        }
    }
    memories(text, &of.memories);
    if let Some(packed) = &of.packed {
        _ = writeln!(
            text,
            "    packed into {} of {} {}, and {} for the harness",
            packed.design, packed.available, packed.cell, packed.harness
        );
    }
    if let Some(mhz) = &of.mhz {
        let seeds = of.seeds.len();
        _ = writeln!(text, "    {:.1} MHz, {:.1} to {:.1} over {seeds} seeds", mhz.median, mhz.min, mhz.max);
    }
    if let Some(path) = &of.critical_path {
        critical_path(text, path);
    }
    for reason in &of.reasons {
        _ = writeln!(text, "    {}", reason.replace('\n', "\n      "));
    }
}

fn row(text: &mut String, name: &str, cells: &Cells) {
    let Cells { lut4, carry, ff, ram, dsp, mux, .. } = cells;
    _ = writeln!(text, "    {name:<12}{lut4:>7}{carry:>7}{ff:>7}{ram:>6}{dsp:>6}{mux:>7}");
}

/// The memories outside the design, and what holds them.
fn memories(text: &mut String, memories: &[Memory]) {
    if memories.is_empty() {
        return;
    }
    _ = writeln!(
        text,
        "    {:<12}{:>9}{:>6}{:>9}{:>9}  held by",
        "memories", "words", "bits", "reads", "writes"
    );
    for Memory { name, words, bits, reads, writes, held_by, reasons } in memories {
        let by = match held_by {
            Some(Blocks { block, count }) => format!("{count} {block}"),
            None => format!("none ({})", reasons.join("; ")),
        };
        _ = writeln!(text, "      {name:<10}{words:>9}{bits:>6}{reads:>9.2}{writes:>9.2}  {by}");
    }
}

fn critical_path(text: &mut String, path: &CriticalPath) {
    let CriticalPath { seed, logic_ns, routing_ns, lut4, carry, points } = path;
    _ = writeln!(
        text,
        "    critical path of seed {seed}: {:.1} ns, {logic_ns:.1} in cells ({lut4} LUT4, {carry} carry), {routing_ns:.1} in wires",
        logic_ns + routing_ns
    );
    for point in points {
        _ = writeln!(text, "      {:>6.1} {}", point.ns, point.name);
    }
}
