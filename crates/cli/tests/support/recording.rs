//! A recording of `edgewalk replay` as JSON, read back as `docs/replay.md` says.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use base64::Engine as _;
use serde_json::Value;
use std::io::Read as _;

/// The recording with its data unpacked.
pub struct Recording {
    pub json: Value,
    /// By register: the cycles of its changes, and the values from there on.
    registers: Vec<(Vec<u64>, Vec<u64>)>,
    /// By kind of token and field.
    tokens: Vec<Vec<Vec<u64>>>,
    /// What memory held before: the planes of the picture, then those of the map.
    before: Vec<Vec<u64>>,
}

/// The numbers of the data, one after the other.
struct Stream(std::vec::IntoIter<u8>);

impl Stream {
    fn varint(&mut self) -> u64 {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = self.0.next().unwrap();
            value |= u64::from(byte & 127) << shift;
            shift += 7;
            if byte < 128 {
                return value;
            }
        }
    }

    fn gaps(&mut self, count: u64) -> Vec<u64> {
        let mut at = 0;
        (0..count)
            .map(|_| {
                at += self.varint();
                at
            })
            .collect()
    }

    fn differences(&mut self, bits: u64, count: u64) -> Vec<u64> {
        let mut value = 0u64;
        let mut next = || {
            let folded = self.varint();
            let difference = (folded >> 1) ^ (folded & 1).wrapping_neg();
            value = value.wrapping_add(difference) & (u64::MAX >> (64 - bits));
            value
        };
        (0..count).map(|_| next()).collect()
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn number(value: &Value) -> u64 {
    value.as_u64().unwrap()
}

impl Recording {
    pub fn read(json: Value) -> Recording {
        let packed =
            base64::engine::general_purpose::STANDARD.decode(json["data"].as_str().unwrap()).unwrap();
        let mut bytes = Vec::new();
        flate2::read::DeflateDecoder::new(&packed[..]).read_to_end(&mut bytes).unwrap();
        let mut stream = Stream(bytes.into_iter());
        let bits = |shape: &Value| match shape["kind"].as_str().unwrap() {
            "triangle" | "token" => 32,
            _ => number(&shape["bits"]),
        };
        let registers = list(&json["registers"]).iter().map(|register| {
            let changes = number(&register["changes"]);
            (stream.gaps(changes), stream.differences(bits(&register["shape"]), changes))
        });
        let registers = registers.collect();
        let mut tokens = Vec::new();
        for kind in list(&json["tokens"]) {
            let count = number(&kind["count"]);
            stream.differences(32, count);
            let fields = list(&kind["fields"]).iter();
            tokens.push(
                fields.map(|field| stream.differences(bits(&field["shape"]), count)).collect::<Vec<_>>(),
            );
            list(&kind["truth"]).iter().for_each(|_| _ = stream.differences(32, count));
        }
        let store = &json["store"];
        let area = |page: &Value| number(&page["width"]) * number(&page["height"]);
        let planes = list(&store["planes"]);
        let first = planes[0]["token"].as_u64().unwrap() as usize;
        let table = number(&json["registers"][first]["shape"]["table"]) as usize;
        let mut before: Vec<_> =
            tokens[table][1..].iter().map(|_| stream.differences(32, area(store))).collect();
        let of_map = planes.iter().filter(|plane| plane["map"] == true);
        before.extend(of_map.map(|_| stream.differences(32, area(&store["map"]))));
        assert!(stream.0.next().is_none(), "the data end with the last plane");
        Recording { registers, tokens, before, json }
    }

    /// The cycles, from 0.
    pub fn cycles(&self) -> std::ops::Range<u64> {
        0..number(&self.json["cycles"])
    }

    /// A field of a token of this table, both counted from 0.
    pub fn token(&self, table: usize, field: usize, token: u64) -> u64 {
        self.tokens[table][field][token as usize]
    }

    /// A register in a cycle.
    pub fn value(&self, register: &Value, cycle: u64) -> u64 {
        let (at, values) = &self.registers[number(register) as usize];
        values[at.partition_point(|change| *change <= cycle) - 1]
    }

    /// The words of a channel behind the last cycle in the plane of this title, row by row, and how many were written.
    pub fn plane(&self, title: &str, channel: usize) -> (Vec<u64>, u64) {
        let store = &self.json["store"];
        let planes = list(&store["planes"]);
        let plane = planes.iter().find(|plane| plane["title"] == title).unwrap();
        let of_map = plane["map"] == true;
        let page = if of_map { &store["map"] } else { store };
        let flags = [&plane["when"], &plane["enable"], &page["during"]];
        let maps = planes.iter().filter(|plane| plane["map"] == true);
        let place = maps.clone().position(|map| map["title"] == title);
        let channels = self.before.len() - maps.count();
        let mut words = self.before[place.map_or(channel, |place| channels + place)].clone();
        let shape = &self.json["registers"][number(&plane["token"]) as usize]["shape"];
        let table = number(&shape["table"]) as usize;
        let address = &self.json["tokens"][table]["fields"][0]["shape"];
        let mut written = 0;
        for cycle in self.cycles() {
            if flags.iter().any(|flag| flag.is_u64() && self.value(flag, cycle) == 0) {
                continue;
            }
            let token = self.value(&plane["token"], cycle) as usize - 1;
            let raw = self.tokens[table][0][token];
            let top = number(&address["bits"]) - 1;
            let (raw, low) = if of_map {
                assert_eq!(raw >> top, 1, "a pixel of the map is marked as one");
                (raw & ((1 << top) - 1), number(&address["map"]))
            } else {
                (raw, number(&address["low"]))
            };
            let pixel = (raw >> low) * number(&page["width"]) + (raw & ((1 << low) - 1));
            words[pixel as usize] = self.tokens[table][channel + 1][token];
            written += 1;
        }
        (words, written)
    }
}
