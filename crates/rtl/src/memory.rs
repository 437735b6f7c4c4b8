//! MEMORY: depth and frame behind the channels of DEPTH, for benches and for a first synthesis.

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::tokens;
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::wires::{Token, parts};

const DOC: &str = "MEMORY holds the depths and the picture, a word a pixel, behind the channels of DEPTH.

  rd (address) ─> [depths] ─> [1] ─> … ─> [latency] ─> data
  wr ──┬────────────┘
       └────────> [frame] ─> scan (address in, colour and extra channels in the next cycle)

Timing: a depth is at data `latency` cycles after its read, and waits there until it is taken.
Rules: a read in the cycle of a write sees the old word. Writes are always taken.
Not modelled: banks, bursts, refresh.";

/// The netlist of a memory of 2^(xb+yb) pixels. At the start every depth is `clear_z` and every other channel 0.
///
/// # Errors
/// A `clear_z` that is no depth of this machine.
pub fn memory(plan: &Plan, clear_z: u64) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_memory", DOC);
    let mut written = parts(&tokens::write(plan));
    written.retain(|f| f.name != "tag");
    let rd_valid = m.input("rd_valid", 1);
    let rd_addr = m.input("rd_addr", plan.widths().address);
    let data_ready = m.input("data_ready", 1);
    let wr_valid = m.input("wr_valid", 1);
    let wr = Token::inputs(&m, "wr", written);
    let scan_addr = m.input_doc("scan_addr", plan.widths().address, "of the pixel to show");

    m.comment("The way of a depth: each stage moves on when the next is free or moves on itself.");
    let valid: Vec<_> = (1..=plan.latency)
        .map(|i| m.reg(&format!("valid{i}"), 1).doc(&format!("stage {i} holds a depth")).reset(0))
        .collect();
    let mut moves = Vec::new();
    let mut next_moves = data_ready;
    for (i, valid) in valid.iter().enumerate().rev() {
        next_moves = (!valid.q() | next_moves).named(&format!("moves{}", i + 1));
        moves.push(next_moves);
    }
    moves.reverse();
    let rd_ready = moves[0];

    let (address, words) = (plan.widths().address, 1 << plan.widths().address);
    let depths = m.memory("depths", address, words, plan.z.bits, clear_z.into()).doc("depth of each pixel");
    let depths = depths.write((wr_valid & wr["z_en"]).named("write_z"), wr["addr"], wr["z"]);
    let mut depth = depths.read((rd_valid & rd_ready).named("read"), rd_addr);
    valid[0].when(moves[0], rd_valid);
    for i in 1..valid.len() {
        valid[i].when(moves[i], valid[i - 1]);
        depth = m.reg(&format!("depth{}", i + 1), plan.z.bits).when(moves[i], depth).q();
    }

    m.comment("The picture.");
    let always = m.lit(1, 1);
    let color = m.cat(&[wr["r"], wr["g"], wr["b"]]);
    let frame = m.memory("frame", address, words, color.width(), 0).doc("red, green and blue of each pixel");
    let shown = frame.write(wr_valid, wr["addr"], color).read(always, scan_addr);
    let extras = plan.channels().iter().filter(|channel| !["z", "r", "g", "b"].contains(&channel.name));
    let extras = extras.map(|channel| {
        let words = m.memory(&format!("frame_{}", channel.name), address, words, channel.bits, 0);
        let words = words.doc(&format!("{} of each pixel", channel.name));
        (channel.name, words.write(wr_valid, wr["addr"], wr[channel.name]).read(always, scan_addr))
    });
    let extras: Vec<_> = extras.collect();

    m.output("rd_ready", rd_ready);
    m.output("data_valid", valid[valid.len() - 1]);
    m.output("data_z", depth);
    m.output("wr_ready", m.lit(1, 1));
    let bits = plan.color.bits;
    for (i, name) in ["b", "g", "r"].into_iter().enumerate() {
        let low = i as u32 * bits;
        m.output(&format!("scan_{name}"), shown.slice(low + bits - 1, low));
    }
    for (name, shown) in extras {
        m.output(&format!("scan_{name}"), shown);
    }
    m.finish()
}
