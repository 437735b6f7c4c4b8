//! A machine that there is not: eight units, two pixel pipes side by side, words of 56 bits in seven channels, all names
//! drawn at random. The page draws what is declared.

use crate::case::file;
use crate::chromium::Browser;
use crate::text::text;
use edgewalk_model::view::Shape;
use edgewalk_replay::encode::Stream;
use edgewalk_replay::{Column, page};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::{Value, json};

const CYCLES: u32 = 300;
const WIDE: Shape = Shape::Number { bits: 56, fraction: 24, signed: true, modular: true };

/// What is declared, and the values behind it.
#[derive(Default)]
struct Made {
    registers: Vec<Value>,
    columns: Vec<(Shape, Column)>,
}

impl Made {
    fn register(&mut self, name: &str, shape: Shape, mut value: impl FnMut(u32) -> u64) -> usize {
        let mut column = Column::default();
        for cycle in 0..CYCLES {
            let now = value(cycle);
            if column.value.last() != Some(&now) {
                column.at.push(cycle);
                column.value.push(now);
            }
        }
        let kind = match shape {
            Shape::Flag => json!({ "kind": "flag", "bits": 1 }),
            Shape::Number { bits, fraction, signed, modular } => {
                json!({ "kind": "number", "bits": bits, "fraction": fraction, "signed": signed, "modular": modular })
            }
            Shape::Code(words) => json!({ "kind": "code", "bits": shape.bits(), "words": words }),
            Shape::Token(table) => json!({ "kind": "token", "bits": 32, "table": table }),
            other => panic!("{other:?}"),
        };
        self.registers.push(json!({ "name": name, "doc": "", "shape": kind, "live": null, "wire": null, "changes": column.at.len() }));
        self.columns.push((shape, column));
        self.columns.len() - 1
    }
}

/// From whom to whom: two pipes between the third unit and the sixth.
const LINKS: [(usize, usize); 9] = [(0, 1), (1, 2), (2, 3), (2, 4), (3, 5), (4, 5), (5, 6), (6, 7), (0, 6)];

fn machine(rng: &mut Pcg64Mcg) -> (Value, Vec<(Shape, Column)>) {
    let mut name = |prefix: &str| {
        format!("{prefix}{}", (0..6).map(|_| rng.random_range(b'a'..=b'z') as char).collect::<String>())
    };
    let names: Vec<String> = (0..8).map(|_| name("u")).collect();
    let (links, channels): (Vec<String>, Vec<String>) =
        ((0..9).map(|_| name("l")).collect(), (0..7).map(|_| name("c")).collect());
    let (fields, single) = ([name("p"), name("f")], name("q"));
    let mut made = Made::default();
    let mut units = Vec::new();
    let mut values = Pcg64Mcg::seed_from_u64(56);
    for (number, own) in names.iter().enumerate() {
        let mut cells = Vec::new();
        for channel in &channels {
            let mut random = Pcg64Mcg::seed_from_u64(values.random());
            cells.push(made.register(&format!("{channel}.w"), WIDE, |_| random.random_range(0..1 << 56)));
        }
        let one =
            made.register(&single, Shape::whole(7), |cycle| u64::from((cycle / 3 + number as u32) % 128));
        let works = made.register("w", Shape::Flag, |cycle| u64::from(cycle % 5 > 0));
        let says = made.register("s", Shape::Flag, |cycle| u64::from(cycle % 2 == 0));
        let token = made.register("t.k", Shape::Token(0), |cycle| u64::from(cycle % 4));
        let rows: Vec<Value> =
            channels.iter().zip(&cells).map(|(name, id)| json!({ "name": name, "cells": [id] })).collect();
        units.push(json!({
            "name": own, "title": own.to_uppercase(), "section": 0, "does": "",
            "items": [{ "register": one }, { "table": { "title": "words", "columns": ["w"], "folded": false, "rows": rows } },
                      { "table": { "title": "tokens", "columns": ["k"], "folded": false, "rows": [{ "name": "t", "cells": [token] }] } }],
            "aside": [], "notes": [], "triangle": null, "lane": one, "works": works, "phase": null,
            "says": [{ "when": says, "text": format!("holds {{{single}}} and {{{}.w}}", channels[0]) }],
            "moments": [], "marks": [],
        }));
    }
    let mut declared = Vec::new();
    for (name, (from, to)) in links.iter().zip(LINKS) {
        let valid = made.register("v", Shape::Flag, |cycle| u64::from(cycle % 3 < 2));
        let ready = made.register("r", Shape::Flag, |cycle| u64::from(cycle % 4 != (from as u32) % 4));
        declared.push(json!({ "name": name, "from": names[from], "to": names[to], "valid": valid, "ready": ready, "step": null }));
    }
    let cause = made.register("cause", Shape::Code(&["one", "two"]), |cycle| u64::from(cycle / 50 % 2));
    let mut stream = Stream::default();
    for (shape, column) in &made.columns {
        stream.column(shape.bits(), column);
    }
    stream.differences(32, [0, 1, 2]);
    stream.differences(8, [9, 8, 7]);
    stream.differences(56, [1 << 55, 3, (1 << 56) - 1]);
    let number = |bits: u32| json!({ "kind": "number", "bits": bits, "fraction": 0, "signed": false, "modular": false });
    let tokens = json!([{ "name": "kind", "title": "tokens", "count": 3, "swatch": null, "truth": [],
        "fields": [{ "name": fields[0], "shape": number(8), "brief": true }, { "name": fields[1], "shape": number(56), "brief": true }] }]);
    let doc = json!({
        "format": "edgewalk-replay", "version": [1, 0], "scene": { "name": "made up", "triangles": 0, "of": 0, "drawn": "0 triangles" },
        "machine": { "hash": "0", "keys": [] }, "from": 0, "cycles": CYCLES,
        "causes": [{ "name": "one", "letter": "O", "means": "first" }, { "name": "two", "letter": "T", "means": "second" }],
        "cause": cause, "units": units, "links": declared, "registers": made.registers, "tokens": tokens, "store": null,
        "triangles": {}, "command": null, "difference": null, "lesson": [], "data": stream.pack(),
    });
    (doc, made.columns)
}

#[test]
fn a_machine_that_there_is_not_is_drawn() {
    let (doc, columns) = machine(&mut Pcg64Mcg::seed_from_u64(1));
    let mut browser = Browser::start();
    let (_folder, path) = file(&page::html(&doc));
    browser.size(1400, 900);
    browser.open(&path, "");
    let cards = browser.eval("[...document.querySelectorAll('.column')].map((c) => c.children.length)");
    assert_eq!(cards, json!([1, 1, 1, 2, 1, 1, 1]), "the pipes stand one above the other");
    let arrows = browser
        .eval("[document.querySelectorAll('.link').length, document.querySelectorAll('.chip').length]");
    assert_eq!(arrows, json!([8, 2]), "links to the next unit between the cards, the long one on both cards");
    let mut compared = 0;
    for cycle in [0, 1, 77, 150, 299] {
        for hex in [false, true] {
            let shown = browser.eval(&format!(
                "app.hex !== {hex} && app.setHex({hex}); app.go({cycle});
                 [...document.querySelectorAll('.value[data-register]:not([data-field])')].map((e) => [+e.dataset.register, e.textContent])"
            ));
            for value in shown.as_array().expect("a list") {
                let id = value[0].as_u64().expect("an id") as usize;
                let (shape, column) = &columns[id];
                assert_eq!(
                    value[1],
                    text(*shape, column.in_cycle(cycle), hex),
                    "register {id}, cycle {cycle}"
                );
                compared += 1;
            }
        }
    }
    let tokens = browser.eval("app.setHex(false); app.go(1); [...document.querySelectorAll('.card:first-child [data-field]')].slice(0, 2).map((e) => e.textContent)");
    assert_eq!(tokens, json!(["9", (1u64 << 55).to_string()]));
    let says = browser.eval("app.go(2); document.querySelectorAll('#says div').length");
    assert_eq!(says, 8);
    assert_eq!(browser.eval("document.querySelector('#says').textContent.includes('{')"), false);
    let faults = browser.eval(crate::layout::LAYOUT);
    assert_eq!(faults, json!([]));
    browser.is_quiet();
    println!("checked {compared} values");
    assert!(compared == 5 * 2 * 64);
}
