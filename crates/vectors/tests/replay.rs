//! A reader that knows `manifest.json` and nothing else replays every unit: what a program of someone else needs is there.
//!
//! It takes names of ports, files, widths, patterns, side inputs, the memory and the limits from the manifest, drives the
//! netlist by the names of its ports, and shares no code with the writer.

use crate::common;
use crate::common::write;
use edgewalk_machine::Plan;
use edgewalk_netlist::Simulator;
use edgewalk_vectors::{StallKind, Suite, Tables, Unit, capture, design, directory, manifest};
use serde_json::Value;
use std::collections::VecDeque;
use std::path::Path;

/// A directory as a stranger sees it.
struct Stranger<'a> {
    folder: &'a Path,
    manifest: Value,
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_else(|| panic!("{value} is no text"))
}

fn number(value: &Value) -> u64 {
    value.as_u64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("{value} is no list"))
}

impl Stranger<'_> {
    fn lines(&self, file: &Value) -> Vec<String> {
        let text =
            std::fs::read_to_string(self.folder.join(text(file))).expect("a file that the manifest names");
        text.lines().map(str::to_owned).collect()
    }

    /// The numbers of a file in steps.
    fn cycles(&self, file: &Value) -> Vec<u64> {
        let radix = number(&self.manifest["radix"]["mem"]) as u32;
        let steps =
            self.lines(file).into_iter().map(|line| u64::from_str_radix(&line, radix).expect("a number"));
        let mut cycle = 0;
        steps.map(|step| (cycle += step, cycle).1).collect()
    }

    /// The words of a file cut into fields: port and value.
    fn tokens(&self, of: &Value) -> Vec<Vec<(String, u128)>> {
        assert_eq!(number(&self.manifest["radix"]["mem"]), 16);
        let bit = |word: &str, at: u64| {
            // Zeros before the first digit are not written.
            let digit =
                word.chars().rev().nth(at as usize / 4).map_or(0, |c| c.to_digit(16).expect("a digit"));
            u128::from(digit >> (at % 4) & 1)
        };
        let field = |word: &str, field: &Value| {
            let (lsb, width) = (number(&field["lsb"]), number(&field["width"]));
            let value = (lsb..lsb + width).rev().fold(0, |value, at| value << 1 | bit(word, at));
            (text(&field["port"]).to_owned(), value)
        };
        let words = self.lines(&of["tokens"]);
        words.iter().map(|word| list(&of["fields"]).iter().map(|f| field(word, f)).collect()).collect()
    }

    fn pattern(&self, name: &str) -> Vec<bool> {
        assert_eq!(number(&self.manifest["radix"]["patterns"]), 2);
        self.lines(&self.manifest["stalls"]["patterns"][name]).iter().map(|line| line == "1").collect()
    }

    /// Things that came as they should, and the first that did not.
    fn replay(&self, dut: &mut Simulator) -> (u64, Option<String>) {
        let manifest = &self.manifest;
        let mut channels: Vec<Channel> =
            list(&manifest["channels"]).iter().map(|c| Channel::of(self, c)).collect();
        let side: Vec<(String, String, Vec<bool>)> = list(&manifest["side_inputs"])
            .iter()
            .map(|input| {
                let port = text(&input["port"]).to_owned();
                let pattern = self.pattern(&port);
                (port, text(&input["while_tokens_of"]).to_owned(), pattern)
            })
            .collect();
        let status = self.tokens(&manifest["status"]);
        let since = self.cycles(&manifest["status"]["moved"]);
        let mut memories: Vec<Memory> =
            list(&manifest["memories"]).iter().map(|m| Memory::of(self, m)).collect();
        for (port, value) in manifest["constants"].as_object().expect("an object") {
            set(dut, port, u128::from(number(value)));
        }
        reset(dut);
        let (mut checked, mut quiet, mut changes) = (0, 0, 0);
        for cycle in 0..number(&manifest["limits"]["cycles"]) {
            for channel in &mut channels {
                channel.drive(dut, cycle, &memories);
            }
            for (port, of, pattern) in &side {
                let source = channels.iter().find(|c| c.name == *of).expect("a channel");
                let left = source.moved < source.tokens.len();
                set(dut, port, u128::from(left && !pattern[cycle as usize % pattern.len()]));
            }
            let fired: Vec<usize> = (0..channels.len()).filter(|i| channels[*i].fires(dut)).collect();
            let mut happened = !fired.is_empty();
            for i in &fired {
                let channel = &mut channels[*i];
                if channel.out {
                    match channel.judge(dut, cycle) {
                        None => checked += 1,
                        fault => return (checked, fault),
                    }
                }
                channel.moved += 1;
            }
            let holds = since.partition_point(|first| *first <= cycle);
            if holds > changes {
                (changes, happened) = (holds, true);
                checked += 1;
            }
            for (port, value) in &status[holds - 1] {
                let during = status_counts(dut, manifest, port);
                let found = if during { get(dut, port) } else { 0 };
                if found != *value {
                    return (
                        checked,
                        Some(format!("{port}, cycle {cycle}: expected {value:#x}, found {found:#x}")),
                    );
                }
            }
            for memory in &mut memories {
                memory.clock(dut, cycle, &channels, &fired);
            }
            channels.iter_mut().enumerate().for_each(|(i, c)| c.held = c.offered && !fired.contains(&i));
            dut.tick();
            quiet = if happened { 0 } else { quiet + 1 };
            if quiet == number(&manifest["limits"]["idle"]) {
                break;
            }
        }
        (checked, None)
    }
}

/// A flag that means something only while another port is 1 counts as 0 while that is not.
fn status_counts(dut: &mut Simulator, manifest: &Value, port: &str) -> bool {
    manifest["status"]["during"][port].as_str().is_none_or(|other| get(dut, other) == 1)
}

struct Channel {
    name: String,
    out: bool,
    fields: Vec<String>,
    tokens: Vec<Vec<(String, u128)>>,
    cycles: Vec<u64>,
    pattern: Vec<bool>,
    moved: usize,
    offered: bool,
    held: bool,
}

impl Channel {
    fn of(stranger: &Stranger, value: &Value) -> Channel {
        let name = text(&value["name"]).to_owned();
        Channel {
            out: value["direction"] == "out",
            fields: list(&value["fields"]).iter().map(|field| text(&field["port"]).to_owned()).collect(),
            tokens: if value["tokens"].is_null() { Vec::new() } else { stranger.tokens(value) },
            cycles: if value["moved"].is_null() { Vec::new() } else { stranger.cycles(&value["moved"]) },
            pattern: stranger.pattern(&name),
            moved: 0,
            offered: false,
            held: false,
            name,
        }
    }

    fn drive(&mut self, dut: &mut Simulator, cycle: u64, memories: &[Memory]) {
        let willing = self.pattern[cycle as usize % self.pattern.len()];
        if self.out {
            return set(dut, &format!("{}_ready", self.name), u128::from(willing));
        }
        let memory = memories.iter().find(|memory| memory.data == self.name);
        let word = memory.and_then(|memory| memory.due(cycle));
        let there = if memory.is_some() { word.is_some() } else { self.moved < self.tokens.len() };
        self.offered = there && (self.held || willing);
        set(dut, &format!("{}_valid", self.name), u128::from(self.offered));
        if let (true, Some(word)) = (self.offered, word) {
            set(dut, &self.fields[0], word);
        } else if self.offered {
            self.tokens[self.moved].iter().for_each(|(port, value)| set(dut, port, *value));
        }
    }

    fn fires(&self, dut: &mut Simulator) -> bool {
        get(dut, &format!("{}_valid", self.name)) == 1 && get(dut, &format!("{}_ready", self.name)) == 1
    }

    /// What is wrong with the token that moves out.
    fn judge(&self, dut: &mut Simulator, cycle: u64) -> Option<String> {
        let Some(wanted) = self.tokens.get(self.moved) else {
            return Some(format!("{}: one too many in cycle {cycle}", self.name));
        };
        for (port, value) in wanted {
            let found = get(dut, port);
            if found != *value {
                let at = self.moved;
                return Some(format!("{port}, token {at}: expected {value:#x}, found {found:#x}"));
            }
        }
        let due = self.cycles[self.moved];
        (due != cycle).then(|| format!("{}: cycle {cycle} instead of {due}", self.name))
    }
}

/// A memory, from the manifest's names and numbers.
struct Memory {
    read: String,
    data: String,
    write: Value,
    words: Vec<u128>,
    latency: u64,
    waiting: VecDeque<(u64, u128)>,
}

impl Memory {
    fn of(stranger: &Stranger, value: &Value) -> Memory {
        let clear = u128::from_str_radix(text(&value["clear"]), 16).expect("hex");
        let mut words = vec![clear; number(&value["words"]) as usize];
        if !value["start"].is_null() {
            let start = stranger.lines(&value["start"]);
            let start = start.iter().map(|line| u128::from_str_radix(line, 16).expect("a number"));
            words.iter_mut().zip(start).for_each(|(word, start)| *word = start);
        }
        Memory {
            read: text(&value["read"]).to_owned(),
            data: text(&value["data"]).to_owned(),
            write: value["write"].clone(),
            words,
            latency: number(&value["latency"]),
            waiting: VecDeque::new(),
        }
    }

    fn due(&self, cycle: u64) -> Option<u128> {
        self.waiting.front().filter(|(due, _)| *due <= cycle).map(|(_, word)| *word)
    }

    /// The read sees the word before a write of its own cycle.
    fn clock(&mut self, dut: &mut Simulator, cycle: u64, channels: &[Channel], fired: &[usize]) {
        let moved = |name: &str| fired.iter().map(|i| &channels[*i]).find(|channel| channel.name == name);
        if moved(&self.data).is_some() {
            self.waiting.pop_front();
        }
        if let Some(read) = moved(&self.read) {
            let word = self.words[get(dut, &read.fields[0]) as usize];
            self.waiting.push_back((cycle + self.latency, word));
        }
        let write = |key: &str| text(&self.write[key]).to_owned();
        let enabled = |dut: &mut Simulator| match self.write.get("enable") {
            Some(enable) => get(dut, text(enable)) == 1,
            None => true,
        };
        if !self.write.is_null() && moved(&write("channel")).is_some() && enabled(dut) {
            let address = get(dut, &write("address")) as usize;
            self.words[address] = get(dut, &write("word"));
        }
    }
}

fn set(dut: &mut Simulator, port: &str, value: u128) {
    dut.set_input(port, value).unwrap_or_else(|error| panic!("{port}: {error}"));
}

fn get(dut: &mut Simulator, port: &str) -> u128 {
    dut.get(port).unwrap_or_else(|error| panic!("{port}: {error}"))
}

fn reset(dut: &mut Simulator) {
    if dut.set_input("rst", 1).is_ok() {
        (0..3).for_each(|_| dut.tick());
        set(dut, "rst", 0);
    }
}

fn replayed(machine: &Plan, unit: Unit, change: impl Fn(&mut Value)) -> (u64, u64, Option<String>) {
    let suite = Suite::named(machine, "corners", 1, 0).expect("listed");
    let trace = capture(machine, unit, &suite, suite.state, StallKind::Mixed);
    let folder = tempfile::tempdir().expect("a folder");
    write(&directory(&suite, &trace, &[], Tables::LeftOut), folder.path());
    let json = std::fs::read(folder.path().join(manifest::FILE)).expect("written");
    let mut manifest: Value = serde_json::from_slice(&json).expect("JSON");
    change(&mut manifest);
    let netlist = design::netlist(machine, unit).expect("a checked machine");
    let stranger = Stranger { folder: folder.path(), manifest };
    let (checked, fault) = stranger.replay(&mut Simulator::new(&netlist));
    (checked, number(&stranger.manifest["expected"]), fault)
}

#[test]
fn every_unit_replays_from_its_manifest_alone() {
    let (_, with_all) = common::shades().remove(6);
    let machines = [common::small(), with_all];
    let units =
        machines.iter().flat_map(|machine| Unit::all(machine).into_iter().map(move |unit| (machine, unit)));
    for (machine, unit) in units {
        let (checked, expected, fault) = replayed(machine, unit, |_| {});
        println!("{}: checked {checked} / {expected}", unit.name());
        assert_eq!(fault, None, "{}", unit.name());
        assert_eq!(checked, expected, "{}", unit.name());
        assert!(checked > 100, "{}", unit.name());
    }
}

/// What the manifest says is used: without it the replay ends early or differs.
#[test]
fn a_manifest_that_leaves_something_out_is_found() {
    let small = common::small();
    let (_, light) = common::lights().remove(0);
    let without_its_map = replayed(&light, common::SHADOW, |m| {
        m["memories"][0].as_object_mut().expect("an object").remove("start");
    });
    assert!(without_its_map.2.is_some(), "SHADOW without the words of its map");
    let without_side_input = replayed(&small, common::EDGE, |m| m["side_inputs"] = serde_json::json!([]));
    assert!(without_side_input.2.is_some(), "EDGE without fresh_queued");
    let impatient = replayed(&small, common::SETUP, |m| m["limits"]["idle"] = 3.into());
    assert!(impatient.0 < impatient.1, "{impatient:?}");
    let short = replayed(&small, common::PIXEL, |m| m["limits"]["cycles"] = 40.into());
    assert!(short.0 < short.1, "{short:?}");
}
