//! What passes at the machine's ports: accesses, bits, bytes, and with dynamic memories their pages.

use super::display::Display;
use crate::occupancy::ratio;
use edgewalk_host::raster::Cycles;
use edgewalk_machine::{Field, Plan};
use edgewalk_model::{PageCounts, Waits};
use serde::{Serialize, Serializer};
use std::fmt::Write as _;

/// The traffic of a picture.
#[derive(Clone, Serialize)]
pub struct Traffic {
    /// The clock at which megabytes a second are told, MHz.
    #[serde(skip_serializing_if = "Option::is_none")]
    clock_mhz: Option<f64>,
    ports: Vec<Port>,
    /// Of all ports of memories.
    bytes: f64,
    /// Of all ports of memories.
    bytes_per_cycle: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    mb_per_s: Option<f64>,
    /// By memory; only with `--stalls dram`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pages: Vec<Pages>,
    /// Clearing and a display, where this was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    display: Option<Display>,
}

/// A port of the machine.
#[derive(Clone, Serialize)]
struct Port {
    /// The memory; `triangles` for the port at which triangles come.
    memory: &'static str,
    #[serde(serialize_with = "in_a_word")]
    direction: Direction,
    /// The link of the machine.
    link: &'static str,
    accesses: u64,
    /// Of the words of an access, without the address.
    bits: u32,
    bytes: f64,
    bytes_per_cycle: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    mb_per_s: Option<f64>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Direction {
    In,
    Read,
    Write,
}

impl Direction {
    fn word(self) -> &'static str {
        match self {
            Direction::In => "in",
            Direction::Read => "read",
            Direction::Write => "write",
        }
    }
}

fn in_a_word<S: Serializer>(direction: &Direction, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(direction.word())
}

/// What the pages of a memory did.
#[derive(Clone, Serialize)]
struct Pages {
    memory: &'static str,
    hits: u64,
    misses: u64,
    turns: u64,
    refreshes: u64,
    in_line: u64,
}

impl Traffic {
    /// Of a picture that took these cycles.
    #[must_use]
    pub fn new(machine: &Plan, cycles: &Cycles, waits: Waits) -> Self {
        let ports: Vec<Port> = ports(machine, cycles).collect();
        let bytes = ports.iter().filter(|port| port.direction != Direction::In).map(|port| port.bytes).sum();
        let pages = if matches!(waits, Waits::Dram(_)) { pages(machine, cycles) } else { Vec::new() };
        let bytes_per_cycle = per_cycle(bytes, cycles.total);
        Traffic { clock_mhz: None, ports, bytes, bytes_per_cycle, mb_per_s: None, pages, display: None }
    }

    /// With megabytes a second at a clock of so many MHz.
    #[must_use]
    pub fn at_clock(mut self, mhz: f64) -> Self {
        self.clock_mhz = Some(mhz);
        self.mb_per_s = Some(self.bytes_per_cycle * mhz);
        for port in &mut self.ports {
            port.mb_per_s = Some(port.bytes_per_cycle * mhz);
        }
        self
    }

    /// With the loads of clearing and of a display.
    #[must_use]
    pub fn with_display(self, display: Display) -> Self {
        Traffic { display: Some(display), ..self }
    }

    /// As lines of text.
    pub(super) fn lines(&self) -> String {
        let mut t = match self.clock_mhz {
            Some(mhz) => format!("traffic at {mhz} MHz\n"),
            None => "traffic\n".to_owned(),
        };
        let rate = |mb_per_s: Option<f64>, per_cycle: f64| match mb_per_s {
            Some(rate) => format!("{rate:>9.1} MB/s"),
            None => format!("{per_cycle:>9.3} bytes a cycle"),
        };
        // Writing to a string cannot fail.
        for Port { memory, direction, accesses, bits, bytes, bytes_per_cycle, mb_per_s, .. } in &self.ports {
            let (name, rate) = (format!("{memory} {}", direction.word()), rate(*mb_per_s, *bytes_per_cycle));
            _ = writeln!(t, "    {name:<16} {accesses:>10} of {bits:>3} bits {bytes:>13.0} bytes {rate}");
        }
        let rate = rate(self.mb_per_s, self.bytes_per_cycle);
        _ = writeln!(t, "    {:<16} {:>24} {:>13.0} bytes {rate}", "memories", "", self.bytes);
        for Pages { memory, hits, misses, turns, refreshes, in_line } in &self.pages {
            let hit = 100.0 * ratio(*hits, hits + misses);
            let lines = if *in_line == 0 { String::new() } else { format!(", {in_line} accesses in lines") };
            _ = writeln!(
                t,
                "    pages of {memory}: {hits} hits ({hit:.1} %), {misses} misses, {turns} turns, {refreshes} refreshes{lines}"
            );
        }
        self.display.iter().for_each(|display| t += &display.lines());
        t
    }
}

fn per_cycle(bytes: f64, cycles: u64) -> f64 {
    if cycles == 0 { 0.0 } else { bytes / cycles as f64 }
}

/// The ports in the order of the data.
fn ports<'a>(machine: &'a Plan, cycles: &'a Cycles) -> impl Iterator<Item = Port> + 'a {
    let (counted, declared) = (&cycles.counters, machine.ports());
    let mut found = Vec::new();
    let mut port = |memory, direction, link, accesses: u64, bits: u32| {
        let bytes = accesses as f64 * f64::from(bits) / 8.0;
        let bytes_per_cycle = per_cycle(bytes, cycles.total);
        found.push(Port { memory, direction, link, accesses, bits, bytes, bytes_per_cycle, mb_per_s: None });
    };
    if let Some(triangles) = &declared.takes {
        let words = triangles.words.len().max(1) as u64;
        port("triangles", Direction::In, triangles.name, counted.triangles * words, triangles.width());
    }
    let writes = |name: &str| declared.writes.iter().chain(&declared.gives).find(|link| link.name == name);
    let width = |fields: &[Field], counts: &dyn Fn(&str) -> bool| -> u32 {
        fields.iter().filter(|field| counts(&field.name)).map(Field::width).sum()
    };
    let mut words = counted.word_reads.iter();
    for memory in &declared.memory {
        let read = match memory.name {
            "depth" => counted.fragments,
            "color" => counted.color_reads,
            _ => words.next().copied().unwrap_or(0),
        };
        port(memory.name, Direction::Read, memory.read.name, read, memory.data.width());
        let Some(write) = writes(memory.write) else { continue };
        let is_word = |name: &str| name == memory.word;
        let is_color = |name: &str| !["addr", "z", "z_en", "lit", "tag"].contains(&name);
        if memory.name == "depth" {
            port("depth", Direction::Write, write.name, counted.depth_writes, width(&write.fields, &is_word));
        }
        if memory.name == "color" || !machine.blend.is_there() {
            port("color", Direction::Write, write.name, counted.writes, width(&write.fields, &is_color));
        }
    }
    found.into_iter()
}

/// What the pages of each memory did.
fn pages(machine: &Plan, cycles: &Cycles) -> Vec<Pages> {
    let words = machine.word_memories().into_iter().map(|(_, memory)| memory.name);
    let color = if machine.blend.is_there() { "color" } else { "" };
    let depth = if machine.blend.is_there() { "depth" } else { "depth and color" };
    let names = [depth, color].into_iter().chain(words);
    let all = names.zip(cycles.counters.pages).filter(|(name, _)| !name.is_empty());
    let of = |(memory, PageCounts { hits, misses, turns, refreshes, in_line })| Pages {
        memory,
        hits,
        misses,
        turns,
        refreshes,
        in_line,
    };
    all.map(of).collect()
}
