//! SHADOW: looks up a light's depth map for every fragment, and darkens each fragment behind it.

use std::sync::Arc;

use edgewalk_machine::units::shadow::SPEC;
use edgewalk_machine::{Gate, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::fifo::fifo;
use crate::light_pass::LightPass;
use crate::ports::Interface;
use crate::share::share;
use crate::wires::{Part, Token};

const DOC: &str = "SHADOW looks up a light's depth map for every fragment, and darkens each fragment behind it.

           ┌───── mrd (address) ──> map memory
  frag ────┴─> [queue] ─┬─ compare ─> gate ─> shaded
    map memory ─ mdata ─┘

Formats: lx and ly are signed, the texel. lz is signed, the depth from the light less the bias. lz has two bits more than
the words of the map, so it can lie outside their range. lit is 1 where lz is at most the texel's word.
Timing: the read leaves in the cycle in which a fragment enters. The fragment leaves in the cycle in which the word arrives.
Rules: a fragment outside the map, or in front of its range, is lit. A fragment behind the range is in shadow. Neither is
read. Words arrive in the order of the reads. shadow_on is stable while the machine is busy.";

/// Behind that, where a word says more than a depth.
const TRANSMITS: &str = "

A word is {depth, share}. The share is the part of the light behind all glass in front of the surface. A lit fragment
keeps that share of each colour.";

/// And where the machine draws its map.
const OWN_PASS: &str = "

With light_pass the fragments belong to the map itself: no fragment is looked up, each is lit.";

/// Light-space values, which end here.
const LIGHT: [&str; 3] = ["lx", "ly", "lz"];
const COLORS: [&str; 3] = ["r", "g", "b"];

/// The netlist of SHADOW.
///
/// # Errors
/// None for a machine with SHADOW that [`edgewalk_machine::Machine::plan`] accepts.
pub fn shadow(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let mut doc = DOC.to_owned();
    for (has, more) in [(plan.shadow.transmits(), TRANSMITS), (plan.shadow.draws_map(), OWN_PASS)] {
        doc += if has { more } else { "" };
    }
    let m = Module::new("edgewalk_shadow", &doc);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let shadow_on = ports.constant("shadow_on");
    let light_pass = LightPass::of(plan, &ports);
    let gate = match plan.shadow.gate {
        Gate::And => None,
        Gate::Scale => Some(ports.constant("ambient")),
    };
    let (frag_valid, frag) = ports.takes();
    let memory = ports.memory("map");
    let shaded_ready = ports.gives_ready();

    let [tx, ty, d] = LIGHT.map(|name| frag[name]);
    let found = find(plan, light_pass.in_picture(shadow_on), tx, ty, d);

    m.comment("A fragment enters when the queue has room, in the cycle of its texel's read. A known fragment needs no read.");
    let queue = m
        .instance("queue", &fifo("edgewalk_shadow_fifo", plan.shadow.queue, &entry_parts(plan, &frag), &[])?);
    let room = queue.output("in_ready");
    let mrd_valid = (frag_valid & room & !found.known).named("mrd_valid");
    let read_done = (found.known | memory.read_ready)
        .named_doc("read_done", "the texel's read is accepted, or not needed");
    let frag_ready = (room & read_done).named("frag_ready");
    let address = m.cat(&[ty, tx].map(|t| t.trunc(plan.shadow.side_bits())));
    let entry = Token::new(entry_parts(plan, &frag), |f| match f {
        "known" => found.known,
        "value" => found.value,
        "d" => d.trunc(plan.shadow.depth_bits),
        same => frag[same],
    });
    entry.connect(queue.connect("in_valid", frag_valid & read_done), "in", &entry_parts(plan, &frag));

    m.comment("The head leaves when its word arrives, or at once if it is known.");
    let head = Token::of_instance(queue, "out", entry_parts(plan, &frag));
    let waiting = queue.output("out_valid");
    let decided = (head["known"] | memory.data_valid).named("decided");
    let shaded_valid = (waiting & decided).named("shaded_valid");
    let mdata_ready = (waiting & !head["known"] & shaded_ready).named("mdata_ready");
    queue.connect("out_ready", shaded_ready & decided);
    let texel = Texel::of(plan, &memory.data);
    let lit = head["known"].mux(head["value"], head["d"].le(texel.depth)).named("lit");

    m.comment("The gate darkens colours in shadow.");
    let left = texel.left.map(|left| {
        let bits = plan.color.bits;
        let all = m.lit(bits, u128::MAX >> (128 - bits));
        let dark = gate.unwrap_or_else(|| m.lit(bits, 0));
        let reached = head["known"]
            .mux(all, left)
            .named_doc("reached", "share of the light that reaches a lit fragment");
        lit.mux(reached, dark).named_doc("left", "share of each colour that remains")
    });
    let gated = |c: &str| match (left, gate) {
        (Some(left), _) => share(&m, c, head[c], left),
        (None, None) => lit.mux(head[c], 0),
        (None, Some(ambient)) => lit.mux(head[c], share(&m, c, head[c], ambient)),
    };

    ports.take_ready(frag_ready);
    ports.read("map", mrd_valid, address, mdata_ready);
    ports.give(shaded_valid, |f| match f {
        "lit" => lit,
        color if COLORS.contains(&color) => gated(color).named(&format!("gated_{color}")),
        same => head[same],
    });
    ports.status("shadow_full", !room);
    ports.status("occupied", waiting);
    m.finish()
}

/// What the queue keeps of a fragment.
fn entry_parts(plan: &Plan, frag: &Token<'_>) -> Vec<Part> {
    let mut entry = frag.parts();
    entry.retain(|part| !LIGHT.contains(&part.name.as_str()));
    let part = |name: &str, width, doc: &str| Part { name: name.to_owned(), width, doc: doc.to_owned() };
    entry.push(part("known", 1, "the result needs no texel"));
    entry.push(part("value", 1, "lit, valid if known"));
    entry.push(part("d", plan.shadow.depth_bits, "depth from the light, valid if not known"));
    entry
}

/// What a word of the map says.
struct Texel<'m> {
    /// Depth of what is nearest to the light.
    depth: Signal<'m>,
    /// With `shadow.transmits`, what is left of the light before it.
    left: Option<Signal<'m>>,
}

impl<'m> Texel<'m> {
    fn of(plan: &Plan, data: &Token<'m>) -> Self {
        if !plan.shadow.transmits() {
            return Texel { depth: data["depth"], left: None };
        }
        let (word, bits) = (data["texel"], plan.color.bits);
        let depth = word.slice(word.width() - 1, bits).named_doc("texel_depth", "depth part of the map word");
        Texel { depth, left: Some(word.trunc(bits)) }
    }
}

/// What is said of a fragment without a look at the map.
struct Found<'m> {
    /// The fragment needs no texel.
    known: Signal<'m>,
    /// The fragment is lit, if that is known.
    value: Signal<'m>,
}

fn find<'m>(plan: &Plan, shadow_on: Signal<'m>, tx: Signal<'m>, ty: Signal<'m>, d: Signal<'m>) -> Found<'m> {
    let m = tx.module();
    let (side, size, depth) = (plan.shadow.side_bits(), plan.shadow.size, plan.shadow.depth_bits);
    m.comment("A coordinate is on the map if its sign and its bits above the map's side are 0.");
    let on_axis = |t: Signal<'m>, name: &str| {
        let on_side = !t.slice(t.width() - 1, side).any();
        // A side that is no power of two ends before its bits do.
        let on = if size == 1 << side { on_side } else { on_side & t.trunc(side).lt(size as i32) };
        on.named(name)
    };
    let in_map = on_axis(tx, "column_in_map") & on_axis(ty, "line_in_map");
    let looked_up = (shadow_on & in_map).named_doc("looked_up", "the map is on and covers the fragment");
    let nearer = d.msb().named_doc("nearer", "nearer to the light than the map's range");
    let off_range =
        d.slice(depth + 1, depth).any().named_doc("off_range", "outside the map's range of depths");
    Found {
        known: (!looked_up | off_range).named("known"),
        value: (!looked_up | nearer).named_doc("value", "lit, valid if known"),
    }
}
