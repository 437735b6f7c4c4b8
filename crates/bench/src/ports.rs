//! `ports.h` for the harness of Verilator: what it drives and reads, from the ports that the machine declares.

use edgewalk_lockstep::{Direction, Interface, Link, MemoryWrite, Unit};
use edgewalk_machine::Plan;
use std::fmt::Write as _;
use std::iter;

/// The functions that the harness calls, a line a port.
pub fn header(plan: &Plan) -> String {
    let interface = Interface::new(plan, Unit::MACHINE);
    let mut text = String::from("// The ports of the machine, written from what it declares.\n");
    let source = interface.links.first().map_or("", |link| link.name);
    let fields = interface.links.first().map_or(&[][..], |link| &link.fields);
    let _ = writeln!(text, "static const size_t TOKEN = {};", fields.len());
    let memories = &interface.memories;
    let list = |of: fn(&edgewalk_lockstep::Memory) -> u64| {
        memories.iter().map(|memory| of(memory).to_string()).collect::<Vec<_>>().join(", ")
    };
    let _ = writeln!(text, "static const size_t MEMORIES = {};", memories.len());
    let _ = writeln!(text, "static const size_t WORDS[] = {{{}}};", list(|memory| 1 << memory.address_bits));
    // As many as its first memory has that is written: those that the host fills may stand before.
    let picture = memories.iter().find(|memory| memory.write.is_some());
    let picture = picture.map_or(0, |memory| 1u64 << memory.address_bits);
    let _ = writeln!(text, "static const size_t PICTURE = {picture};");
    let written = list(|memory| memory.write.is_some().into());
    let _ = writeln!(text, "static const bool WRITTEN[] = {{{written}}};");
    // Of a memory that the machine writes; the others have words of their own, and are not cleared.
    let clear = list(|memory| memory.write.map_or(0, |_| u64::MAX >> (64 - memory.word_bits)));
    let clear = clear.replace(',', "ULL,");
    let _ = writeln!(text, "static const uint64_t CLEAR[] = {{{clear}ULL}};");
    let mut function = |head: &str, lines: Vec<String>| {
        let _ = writeln!(text, "static inline {head} {{");
        lines.iter().for_each(|line| _ = writeln!(text, "    {line}"));
        text.push_str("}\n");
    };
    let ready = interface.links_of(Direction::Out).map(|link| format!("m.{}_ready = 1;", link.name));
    function("void always_ready(Vmachine &m)", ready.collect());
    let constants = interface.constants.iter().enumerate();
    let constants =
        constants.map(|(i, port)| format!("m.{} = std::strtoull(value[{i}], nullptr, 10);", port.name));
    function("void set_constants(Vmachine &m, char **value)", constants.collect());
    let mut offer = vec![format!("m.{source}_valid = w != nullptr;"), "if (!w) return;".to_owned()];
    offer.extend(fields.iter().enumerate().map(|(i, port)| format!("m.{} = w[{i}];", port.name)));
    function("void offer(Vmachine &m, const uint64_t *w)", offer);
    function("bool takes(Vmachine &m)", vec![format!("return m.{source}_ready;")]);
    let (mut words, mut served) = (Vec::new(), Vec::new());
    let pitch = 1u64 << plan.widths().x; // to the pixel below
    for (i, memory) in memories.iter().enumerate() {
        let (read, data) = (&interface.links[memory.read], &interface.links[memory.data]);
        let (valid, word) = (format!("m.{}_valid", data.name), &data.fields[0].name);
        words.push(format!("{valid} = memory[{i}].due(cycle);"));
        words.push(format!("put(m.{word}, {valid} ? memory[{i}].front() : 0);"));
        served.push(format!("if ({valid} && m.{}_ready) memory[{i}].pop();", data.name));
        let (read, address) = (read.name, &read.fields[0].name);
        served
            .push(format!("if (m.{read}_valid) memory[{i}].read(m.{address}, cycle + {});", memory.latency));
        if let Some(write) = memory.write {
            served.push(format!("if (m.{read}_valid) memory[{i}].near(m.{address} + {pitch}, frame);"));
            let link = &interface.links[write.link];
            let port = |place: usize| &link.fields[place].name;
            let (address, word) = (port(write.address), port(write.word));
            let enable = write.enable.map_or_else(String::new, |enable| format!(" && m.{}", port(enable)));
            let condition = format!("m.{}_valid{enable}", link.name);
            served.push(format!("if ({condition}) memory[{i}].words[m.{address}] = m.{word};"));
        }
    }
    function("void offer_words(Vmachine &m, Memory *memory, uint64_t cycle)", words);
    let serve = "void serve(Vmachine &m, Memory *memory, const std::vector<uint64_t> &frame, uint64_t cycle)";
    function(serve, served);
    function("bool store(Vmachine &m, std::vector<uint64_t> &frame)", store(&interface));
    text
}

/// The picture: what is written beside the words of the memories.
fn store(interface: &Interface) -> Vec<String> {
    let Some(link) = interface.links.last() else { return Vec::new() };
    let (address, kept) = frame_fields(interface, link);
    let words = kept
        .iter()
        .enumerate()
        .map(|(i, place)| format!("uint64_t(m.{}) << {}", link.fields[*place].name, 16 * i % 64));
    // With BLEND its memory is the picture, and nothing is beside it.
    let words = iter::once("0".to_owned()).chain(words);
    vec![
        format!("if (!m.{}_valid) return false;", link.name),
        format!("frame[m.{}] = {};", link.fields[address].name, words.collect::<Vec<_>>().join(" ^ ")),
        "return true;".to_owned(),
    ]
}

/// Of a write the address, and the fields that no memory of the machine stores or looks at: those of the frame.
pub fn frame_fields(interface: &Interface, link: &Link) -> (usize, Vec<usize>) {
    let writes: Vec<_> = interface.memories.iter().filter_map(|memory| memory.write).collect();
    let taken = |place: &usize| {
        let places = |write: &MemoryWrite| [Some(write.address), Some(write.word), write.enable];
        writes.iter().any(|write| places(write).contains(&Some(*place)))
    };
    let address = writes.first().map_or(0, |write| write.address);
    (address, (0..link.fields.len()).filter(|place| !taken(place)).collect())
}
