//! `params.vh`: the numbers of a run, for the test bench.

use crate::capture::Trace;
use crate::ports::Direction;
use crate::stalls::Pattern;
use crate::status::status_ports;
use std::fmt::Write as _;

/// The text of `params.vh`, included inside the test bench.
#[must_use]
pub fn params(trace: &Trace) -> String {
    let mut text = format!(
        "// Numbers of this run, for tb.v. Machine {}, stalls {}.\n",
        trace.machine.hash(),
        trace.stalls.name()
    );
    let mut line = |declared: String, meaning: &str| {
        let _ = writeln!(text, "localparam {declared:<32}// {meaning}");
    };
    let mut number = |name: &str, value: u64, meaning: &str| line(format!("{name} = {value};"), meaning);
    let interface = &trace.interface;
    for (channel, moved) in interface.channels.iter().zip(&trace.channels) {
        let name = channel.name.to_uppercase();
        number(&format!("{name}_WIDTH"), channel.width().into(), "bits of a token");
        if channel.direction == Direction::Out || !(interface.memory && channel.name == "data") {
            number(&format!("{name}_COUNT"), moved.tokens.len() as u64, "tokens");
        }
    }
    let status: u32 = status_ports(interface).iter().map(|port| port.width).sum();
    number("STATUS_WIDTH", status.into(), "bits of all outputs that are compared in every cycle");
    number("STATUS_COUNT", trace.status.len() as u64, "changes of these");
    // Twice the longest wait of the model, and some: a design that does nothing for so long has stopped.
    number("IDLE_LIMIT", 2 * trace.longest_gap + 100, "cycles without an event that end the run");
    number("CYCLE_LIMIT", 2 * trace.cycles + 10_000, "cycles that end the run whatever happens");
    if interface.memory {
        number("LATENCY", trace.setting.latency, "cycles from a depth read to its data, at the least");
        line(sized("CLEAR_Z", trace.machine.z.bits, trace.setting.clear_z), "every depth at the start");
    }
    for (constant, value) in interface.constants.iter().zip(&trace.setting.constants) {
        line(sized(&constant.port.to_uppercase(), constant.width, *value), &constant.format);
    }
    let names =
        interface.channels.iter().map(|c| c.name).chain(interface.levels.iter().map(|f| f.port.as_str()));
    for (name, pattern) in names.zip(&trace.setting.patterns) {
        text.push_str(&pattern_lines(&name.to_uppercase(), pattern));
    }
    text
}

fn sized(name: &str, width: u32, value: u128) -> String {
    format!("[{}:0] {name} = {width}'h{value:x};", width - 1)
}

/// Bit n mod PERIOD, counted from the right: willing in cycle n.
fn pattern_lines(name: &str, pattern: &Pattern) -> String {
    let period = pattern.bits().len();
    let bits: String = pattern.bits().iter().rev().map(|willing| if *willing { '1' } else { '0' }).collect();
    format!(
        "localparam {name}_PERIOD = {period};\nlocalparam [{}:0] {name}_PATTERN = {period}'b{bits};\n",
        period - 1
    )
}
