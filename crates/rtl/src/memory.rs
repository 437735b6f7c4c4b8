//! MEMORY: depth and frame behind the channels of the machine, for benches and for a first synthesis.

use std::sync::Arc;

use edgewalk_machine::units::tokens;
use edgewalk_machine::{Field, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::wires::{Token, parts};

const DOC: &str = "MEMORY holds the depths and the picture, a word a pixel, behind the links of DEPTH.

  rd (address) ─> [depths] ─> [1] ─> … ─> [latency] ─> data
  wr ──┬────────────┘
       └────────> [frame] ─> scan (address in, colour and extra channels in the next cycle)

Timing: a depth reaches data `latency` cycles after its read, and waits there until it is taken.
Rules: a read in the cycle of a write sees the old word. Writes are always taken.
Not modelled: banks, bursts, refresh; a light's map.";

const BLEND_DOC: &str = "MEMORY holds the depths and the picture, a word a pixel, behind the links of DEPTH and BLEND.

  rd (address) ─> [depths] ─> [1] ─> … ─> [latency] ─> data
  zwr ──────────────┘
  crd (address) ─> [frame] ─> [1] ─> … ─> [latency] ─> cdata
  cwr ──────────────┘    └──> scan (address in, colour and extra channels in the next cycle)

Timing: a word reaches data or cdata `latency` cycles after its read, and waits there until it is taken. Each link has a
latency of its own.
Rules: a read in the cycle of a write sees the old word. Writes are always taken.
Not modelled: banks, bursts, refresh; a light's map.";

/// The netlist of a memory of 2^(xb+yb) pixels. At the start every depth is `clear_z` and every other channel 0.
///
/// # Errors
/// A `clear_z` that is no depth of this machine.
pub fn memory(plan: &Plan, clear_z: u64) -> Result<Arc<Netlist>, BuildErrors> {
    let blends = plan.blend.is_there();
    let m = Module::new("edgewalk_memory", if blends { BLEND_DOC } else { DOC });
    let stored = |fields: Vec<Field>| {
        let mut stored = parts(&fields);
        stored.retain(|f| f.name != "tag" && f.name != "lit");
        stored
    };
    let read = ReadPort::new(&m, plan, ["rd", "data"]);
    let color_read = blends.then(|| ReadPort::new(&m, plan, ["crd", "cdata"]));
    let write = |link: &str, fields: Vec<Field>| {
        (m.input(&format!("{link}_valid"), 1), Token::inputs(&m, link, stored(fields)))
    };
    let ((wr_valid, wr), depth_write) = if blends {
        let zwr = write("zwr", tokens::depth_write(plan));
        (write("cwr", tokens::color_write(plan)), Some(zwr))
    } else {
        (write("wr", tokens::write(plan)), None)
    };
    let scan_addr = m.input_doc("scan_addr", plan.widths().address, "address of the pixel to show");

    m.comment("Stages of the read latency: a stage advances when the next one is free or advances.");
    let way = Way::new(&m, plan.latency, read.data_ready, "", "depth");
    let (address, words) = (plan.widths().address, 1 << plan.widths().address);
    let depths =
        m.memory("depths", address, words, plan.z.bits).doc("depth of each pixel").starts(clear_z.into());
    let depths = match &depth_write {
        None => depths.write((wr_valid & wr["z_en"]).named("write_z"), wr["addr"], wr["z"]),
        Some((valid, zwr)) => depths.write(*valid, zwr["addr"], zwr["z"]),
    };
    let depth = depths.read((read.valid & way.ready).named("read"), read.addr);
    let depth = way.word(&m, read.valid, depth);

    m.comment("Frame memory.");
    let always = m.lit(1, 1);
    let color = if blends { wr["rgb"] } else { m.cat(&[wr["r"], wr["g"], wr["b"]]) };
    let frame =
        m.memory("frame", address, words, color.width()).doc("red, green and blue of each pixel").starts(0);
    let frame = frame.write(wr_valid, wr["addr"], color);
    let shown = frame.read(always, scan_addr);
    let color_way = color_read.map(|read| {
        let way = Way::new(&m, plan.blend.latency, read.data_ready, "color_", "color");
        let old = frame.read((read.valid & way.ready).named("read_color"), read.addr);
        let old = way.word(&m, read.valid, old);
        (way, old)
    });
    let extras = plan.own_channels().map(|(_, channel)| {
        let words = m.memory(&format!("frame_{}", channel.name), address, words, channel.bits).starts(0);
        let words = words.doc(&format!("{} of each pixel", channel.name));
        (channel.name, words.write(wr_valid, wr["addr"], wr[channel.name]).read(always, scan_addr))
    });
    let extras: Vec<_> = extras.collect();

    m.output("rd_ready", way.ready);
    m.output("data_valid", way.at_end());
    m.output("data_z", depth);
    for link in if blends { ["zwr", "cwr"].as_slice() } else { &["wr"] } {
        m.output(&format!("{link}_ready"), m.lit(1, 1));
    }
    if let Some((way, old)) = color_way {
        m.output("crd_ready", way.ready);
        m.output("cdata_valid", way.at_end());
        m.output("cdata_rgb", old);
    }
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

/// What asks for words.
struct ReadPort<'m> {
    valid: Signal<'m>,
    addr: Signal<'m>,
    data_ready: Signal<'m>,
}

impl<'m> ReadPort<'m> {
    fn new(m: &'m Module, plan: &Plan, [read, data]: [&str; 2]) -> ReadPort<'m> {
        ReadPort {
            valid: m.input(&format!("{read}_valid"), 1),
            addr: m.input(&format!("{read}_addr"), plan.widths().address),
            data_ready: m.input(&format!("{data}_ready"), 1),
        }
    }
}

/// The stages of a word that was read.
struct Way<'m> {
    valid: Vec<Reg<'m>>,
    moves: Vec<Signal<'m>>,
    /// The first takes a word.
    ready: Signal<'m>,
    word: &'static str,
}

impl<'m> Way<'m> {
    /// Of so many stages; the last gives its word when that is taken.
    fn new(m: &'m Module, stages: u32, data_ready: Signal<'m>, prefix: &str, word: &'static str) -> Way<'m> {
        let stage =
            |i| m.reg(&format!("{prefix}valid{i}"), 1).doc(&format!("stage {i} holds a {word}")).reset(0);
        let valid: Vec<_> = (1..=stages).map(stage).collect();
        let mut moves = Vec::new();
        let mut ready = data_ready;
        for (i, valid) in valid.iter().enumerate().rev() {
            ready = (!valid.q() | ready).named(&format!("{prefix}moves{}", i + 1));
            moves.push(ready);
        }
        moves.reverse();
        Way { valid, moves, ready, word }
    }

    /// The word that came from the memory, at the end.
    fn word(&self, m: &'m Module, read_valid: Signal<'m>, from_memory: Signal<'m>) -> Signal<'m> {
        self.valid[0].when(self.moves[0], read_valid);
        let mut word = from_memory;
        for i in 1..self.valid.len() {
            self.valid[i].when(self.moves[i], self.valid[i - 1]);
            let name = format!("{}{}", self.word, i + 1);
            word = m.reg(&name, word.width()).when(self.moves[i], word).q();
        }
        word
    }

    /// A word is there.
    fn at_end(&self) -> Reg<'m> {
        self.valid[self.valid.len() - 1]
    }
}
