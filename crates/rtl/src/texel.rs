//! TEXEL: multiplies the colour of a fragment by the colour of the nearest texel.

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{texel::SPEC, tokens};
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::fifo::fifo;
use crate::ports::Interface;
use crate::share::share;
use crate::wires::{Token, parts};

const DOC: &str = "TEXEL multiplies the colour of a fragment by the colour of the nearest texel.

           ┌────── xrd (address) ──> texture memory
  frag ────┴─> [queue] ─┬─ multiply ─> textured
  texture memory ─ xdata ┘

Formats: u and v are the column and line of the texel, unsigned; the texture repeats. xdata is {red, green, blue}. A colour c
and the texel's colour x make c * x / (2^b - 1), to nearest. With BUMP xdata holds two slopes below the colours.
Timing: the read leaves in the cycle in which a fragment enters. The fragment leaves in the cycle in which the word arrives.
Rules: words arrive in the order of the reads.";

/// The colours, in the order of a word: red, the most significant, first.
const COLOURS: [&str; 3] = ["r", "g", "b"];

/// The netlist of TEXEL.
///
/// # Errors
/// None for a machine with TEXEL that [`edgewalk_machine::Machine::plan`] accepts.
pub fn texel(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_texel", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (frag_valid, frag) = ports.takes();
    let memory = ports.memory("textures");
    let textured_ready = ports.gives_ready();

    m.comment("A fragment enters when the queue has room, in the cycle of its texel's read.");
    let comes = |name: &str| ["bu", "bv"].contains(&name);
    let mut kept = parts(&tokens::textured(plan));
    kept.retain(|part| !comes(&part.name));
    let queue = m.instance("queue", &fifo("edgewalk_texel_fifo", plan.shade.texel_queue, &kept, &[])?);
    let room = queue.output("in_ready");
    let address: Vec<_> = frag.get("material").into_iter().chain([frag["v"], frag["u"]]).collect();
    frag.connect(queue.connect("in_valid", frag_valid & memory.read_ready), "in", &kept);

    m.comment("The head leaves when its word arrives.");
    let head = Token::of_instance(queue, "out", kept);
    let waiting = queue.output("out_valid");
    let textured_valid = (waiting & memory.data_valid).named("textured_valid");
    queue.connect("out_ready", textured_ready & memory.data_valid);

    m.comment("Colour of the head times colour of the texel.");
    let (name, b) = (tokens::texture_word(plan).name, plan.color.bits);
    let (word, slope_bits) = (memory.data[name.as_str()], plan.shade.slope_bits);
    let below = plan.texel_word_bits() - 3 * b;
    let colour = |i: usize| {
        let low = below + (2 - i as u32) * b;
        share(&m, COLOURS[i], head[COLOURS[i]], word.slice(low + b - 1, low))
    };
    let colours = [0, 1, 2].map(colour);

    ports.take_ready(room & memory.read_ready);
    ports.read("textures", frag_valid & room, m.cat(&address), waiting & textured_ready);
    ports.give(textured_valid, |f| match COLOURS.iter().position(|colour| *colour == f) {
        Some(i) => colours[i],
        None if f == "bu" => word.slice(2 * slope_bits - 1, slope_bits),
        None if f == "bv" => word.slice(slope_bits - 1, 0),
        None => head[f],
    });
    ports.status("texel_full", !room);
    ports.status("occupied", waiting);
    m.finish()
}
