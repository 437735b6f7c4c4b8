//! `params.vh`: the numbers of a run, for the test bench.

use crate::capture::Trace;
use crate::dut::Wiring;
use crate::manifest::Limits;
use edgewalk_lockstep::{Direction, status_ports};
use std::fmt::Write as _;

/// The text of `params.vh`, included inside the test bench.
#[must_use]
pub fn params(trace: &Trace, wiring: Option<&Wiring>) -> String {
    let mut text = format!("// Numbers of this run, for tb.v. Stalls {}.\n", trace.stalls.name());
    let mut line = |declared: String, meaning: &str| {
        let _ = writeln!(text, "localparam {declared:<32}// {meaning}");
    };
    let mut number = |name: &str, value: u64, meaning: &str| line(format!("{name} = {value};"), meaning);
    let interface = &trace.interface;
    for (place, (link, moved)) in interface.links.iter().zip(&trace.links).enumerate() {
        let name = link.name.to_uppercase();
        number(&format!("{name}_WIDTH"), link.width().into(), "bits of a token");
        if link.direction == Direction::Out || interface.memories.iter().all(|memory| memory.data != place) {
            number(&format!("{name}_COUNT"), moved.tokens.len() as u64, "tokens");
        }
    }
    let status: u32 = status_ports(interface).iter().map(|status| status.port.width()).sum();
    number("STATUS_WIDTH", status.into(), "bits of all outputs that are compared in every cycle");
    number("STATUS_COUNT", trace.status.len() as u64, "changes of these");
    let limits = limits(trace, wiring);
    number("IDLE_LIMIT", limits.idle, "cycles without an event that end the run");
    number("CYCLE_LIMIT", limits.cycles, "cycles that end the run whatever happens");
    for (memory, setting) in interface.memories.iter().zip(&trace.setting.memories) {
        let name = memory.name.to_uppercase();
        let latency = format!("{name}_LATENCY = {};", setting.latency);
        line(latency, "cycles from a read to its data, at the least");
        line(sized(&format!("{name}_CLEAR"), memory.word_bits, setting.clear), "every word at the start");
        if memory.write.is_none() {
            line(format!("{name}_START = {};", setting.start.len()), "words of its own before that");
        }
    }
    for (constant, value) in interface.constants.iter().zip(&trace.setting.constants) {
        line(sized(&constant.name.to_uppercase(), constant.width(), *value), &constant.field.to_string());
    }
    for (name, pattern) in super::patterns(trace) {
        let declared = format!("{}_PERIOD = {};", name.to_uppercase(), pattern.bits().len());
        line(declared, "cycles until its willingness repeats");
    }
    text
}

/// When a run of any design ends. Twice the longest wait of the model, and some: a design that does nothing for so long
/// has stopped. A user's design of another latency has more time, or what its description says.
pub(super) fn limits(trace: &Trace, wiring: Option<&Wiring>) -> Limits {
    let (idle, cycles) = (2 * trace.longest_gap + 100, 2 * trace.cycles + 10_000);
    let Some(Wiring { dut, .. }) = wiring else { return Limits { idle, cycles } };
    let idle = dut.patience.map_or(5 * idle + 1000, u64::from);
    Limits { idle, cycles: 10 * cycles + idle }
}

fn sized(name: &str, width: u32, value: u128) -> String {
    format!("[{}:0] {name} = {width}'h{value:x};", width - 1)
}
