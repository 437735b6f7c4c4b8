//! A replay as JSON: what is described in `docs/replay.md`.

use crate::encode::Stream;
use crate::lesson::{Lesson, Part, Step};
use crate::record::map_channels;
use crate::recording::Recording;
use edgewalk_machine::{Activity, Counted, Plan, PortVertex};
use edgewalk_model::view::{Item, Register, Shape, Store, Structure, Table, UnitView};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// The format's name, and its version: another major number is another format.
pub const FORMAT: (&str, [u32; 2]) = ("edgewalk-replay", [1, 2]);

/// All that a page shows.
pub struct Replay<'a> {
    /// The machine.
    pub plan: &'a Plan,
    /// What was drawn.
    pub scene: &'a str,
    /// The tokens of what was drawn: triangles, lines, parts of polygons.
    pub triangles: &'a [[PortVertex; 3]],
    /// How many triangles, polygons and lines they are.
    pub drawn: Counted,
    /// How many there would have been.
    pub of: Counted,
    /// The run.
    pub recording: &'a Recording,
    /// What ought to be, for tokens: more columns of a kind of token.
    pub truth: &'a [Truth],
    /// The command that explains a pixel; it ends with `{x} {y}`, which stand for the pixel.
    pub command: Option<String>,
    /// Where model and another description differ first.
    pub difference: Option<Difference>,
    /// What is taught beside it.
    pub lesson: Option<&'a Lesson>,
}

/// Where two descriptions of the machine differ first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The cycle of the recording.
    pub cycle: u32,
    /// Where, in words.
    pub text: String,
    /// What the model says.
    pub expected: String,
    /// What the other says.
    pub found: String,
}

/// How far a field of a token is off, and how far it may be.
pub struct Truth {
    /// The kind.
    pub kind: &'static str,
    /// The field.
    pub field: &'static str,
    /// The proved bound, LSB, or why there is none.
    pub bound: Result<f64, String>,
    /// A token's value less the exact one, 2^-10 LSB, rounded; `None` where it is not known.
    pub errors: Vec<Option<i32>>,
}

impl Replay<'_> {
    /// As JSON.
    #[must_use]
    pub fn json(&self) -> Value {
        let (view, plan) = (&self.recording.view, self.plan);
        let structure = view.structure();
        let kinds = view.tokens().kinds();
        let tokens = kinds.iter().map(|kind| {
            let field = |field: &edgewalk_model::view::Field| json!({ "name": field.name, "shape": shape(field.shape), "brief": field.brief });
            json!({
                "name": kind.name,
                "title": kind.title,
                "fields": kind.fields.iter().map(field).collect::<Vec<_>>(),
                "swatch": swatch(kind.fields.iter().map(|field| field.name)),
                "count": kind.met.len(),
                "truth": self.truth_of(&kind.name),
            })
        });
        let causes = Activity::ALL.iter().zip(letters()).map(
            |(cause, letter)| json!({ "name": cause.name(), "letter": letter, "means": cause.meaning() }),
        );
        json!({
            "format": FORMAT.0,
            "version": FORMAT.1,
            "scene": {
                "name": self.scene, "triangles": self.drawn.total(), "of": self.of.total(), "drawn": self.drawn_in_words(),
            },
            "machine": { "hash": plan.hash(), "keys": keys(plan) },
            "from": self.recording.from,
            "cycles": self.recording.cycles,
            "causes": causes.collect::<Vec<_>>(),
            "cause": structure.cause,
            "units": structure.units.iter().map(unit).collect::<Vec<_>>(),
            "links": structure.links.iter().map(|link| json!({
                "name": link.name, "from": link.from, "to": link.to, "valid": link.valid, "ready": link.ready,
                "step": link.step.map(|(name, key)| json!({ "name": name, "key": key })),
            })).collect::<Vec<_>>(),
            "registers": structure.registers.iter().zip(&self.recording.columns).map(|(register, column)| {
                of_register(register, column.at.len())
            }).collect::<Vec<_>>(),
            "tokens": tokens.collect::<Vec<_>>(),
            "store": (!self.recording.before.is_empty()).then(|| json!({
                "width": plan.width, "height": plan.height, "planes": planes(plan, structure),
                "during": structure.pages.map(|[picture, _]| picture),
                "map": structure.pages.map(|[_, map]| json!({
                    "width": plan.shadow.size, "height": plan.shadow.size, "during": map,
                })),
            })),
            "triangles": self.seen().into_iter().map(|number| (number.to_string(), self.corners(number))).collect::<Map<_, _>>(),
            "command": self.command,
            "difference": self.difference.as_ref().map(|difference| json!({
                "cycle": difference.cycle, "text": difference.text,
                "expected": difference.expected, "found": difference.found,
            })),
            "lesson": self.lesson.map_or_else(Vec::new, |lesson| lesson.steps.iter().map(step).collect()),
            "data": self.data(),
        })
    }

    /// What was drawn of how much: `the first 20 of 300 triangles`.
    fn drawn_in_words(&self) -> String {
        let Replay { drawn, of, .. } = *self;
        if drawn == of { of.to_string() } else { format!("the first {}", drawn.part_of(of)) }
    }

    /// Numbers of the triangles that any unit works on.
    fn seen(&self) -> BTreeSet<u64> {
        let registers = self.recording.view.structure().registers.iter().zip(&self.recording.columns);
        let of = registers.filter(|(register, _)| register.shape == Shape::Triangle);
        of.flat_map(|(_, column)| &column.value).filter_map(|number| number.checked_sub(1)).collect()
    }

    /// Corners of a triangle, pixels.
    fn corners(&self, number: u64) -> Value {
        let scale = f64::from(1u32 << self.plan.subpixel_bits);
        let corners = self.triangles.get(number as usize);
        json!(corners.map(|corners| corners.map(|v| [v.x(), v.y()].map(|place| f64::from(place) / scale))))
    }

    fn truth_of(&self, kind: &str) -> Vec<Value> {
        let of_kind = self.truth.iter().filter(|truth| truth.kind == kind);
        let told = of_kind.map(|truth| {
            let (bound, why) = (truth.bound.as_ref().ok(), truth.bound.as_ref().err());
            let largest = truth.errors.iter().flatten().map(|error| f64::from(error.unsigned_abs()) / 1024.0);
            let largest = largest.reduce(f64::max);
            json!({ "field": truth.field, "fraction": 10, "bound": bound, "why": why, "largest": largest })
        });
        told.collect()
    }

    /// Registers, then tokens, then what is known of their truth, then the picture before.
    fn data(&self) -> String {
        let (recording, view) = (self.recording, &self.recording.view);
        let mut stream = Stream::default();
        for (register, column) in view.structure().registers.iter().zip(&recording.columns) {
            stream.column(register.shape.bits(), column);
        }
        for kind in view.tokens().kinds() {
            stream.differences(32, kind.met.iter().map(|token| token[0]));
            for (place, field) in kind.fields.iter().enumerate() {
                stream.differences(field.shape.bits(), kind.met.iter().map(|token| token[place + 1]));
            }
            for truth in self.truth.iter().filter(|truth| truth.kind == kind.name) {
                // The least number there is stands for what is not known.
                let errors = truth.errors.iter().map(|error| error.unwrap_or(i32::MIN) as u32);
                stream.differences(32, errors.map(u64::from));
            }
        }
        for plane in &recording.before {
            stream.differences(32, plane.words().map(u64::from));
        }
        stream.pack()
    }
}

/// A letter a cause, no two alike: of its name the first that is free; a dot for the cause of nothing to do.
fn letters() -> Vec<char> {
    let mut letters = Vec::new();
    for cause in Activity::ALL {
        let own = cause.name().chars().map(|c| c.to_ascii_uppercase()).find(|c| !letters.contains(c));
        letters.push(if cause == Activity::Idle { '\u{b7}' } else { own.unwrap_or('?') });
    }
    letters
}

/// Keys and values of the machine.
fn keys(plan: &Plan) -> Vec<[String; 2]> {
    let keys = edgewalk_machine::keys::KEYS.iter().filter(|key| (key.used)(plan));
    keys.map(|key| [key.name.to_owned(), key.show(plan)]).collect()
}

/// The fields that are a colour.
fn swatch<'a>(fields: impl Iterator<Item = &'a str>) -> Option<[usize; 3]> {
    let names: Vec<&str> = fields.collect();
    let place = |name| names.iter().position(|field| *field == name);
    Some([place("r")?, place("g")?, place("b")?]).filter(|_| names.first() == Some(&"addr"))
}

/// The pictures: colours in one, depth, every channel of the user's own and the light's answer in one each.
fn planes(plan: &Plan, structure: &Structure) -> Vec<Value> {
    let channels = plan.channels();
    let plane = |store: Option<Store>, more: Value| {
        let store = store?;
        let mut plane = json!({ "when": store.when, "token": store.fragment, "enable": store.enable });
        let more = more.as_object().cloned().unwrap_or_default();
        plane.as_object_mut()?.extend(more);
        Some(plane)
    };
    let picture = json!({ "title": "Picture", "colour": [1, 2, 3], "bits": plan.stored_color().bits });
    let mut planes = vec![plane(structure.color, picture)];
    planes.push(plane(
        structure.depth,
        json!({ "title": "Depth memory", "scalar": 0, "bits": channels[0].bits }),
    ));
    for (place, channel) in plan.own_channels() {
        let own = json!({ "title": channel.name, "scalar": place, "bits": channel.bits });
        planes.push(plane(structure.color, own));
    }
    if plan.shadow.is_there() {
        let lit =
            json!({ "title": "Lit", "scalar": plan.seen_channels().count(), "bits": 1, "bright": true });
        planes.push(plane(structure.color, lit));
    }
    if structure.pages.is_some() {
        // With BLEND what is left of the light goes to the colour memory's page.
        for (place, title) in map_channels(plan).zip(["Map of the light", "Light that is left"]) {
            let (store, bits) = match place {
                0 => (structure.depth, plan.shadow.depth_bits),
                _ => (structure.color, plan.color.bits),
            };
            planes.push(plane(store, json!({ "title": title, "scalar": place, "bits": bits, "map": true })));
        }
    }
    planes.into_iter().flatten().collect()
}

fn shape(shape: Shape) -> Value {
    match shape {
        Shape::Flag => json!({ "kind": "flag", "bits": 1 }),
        Shape::Number { bits, fraction, signed, modular } => {
            json!({ "kind": "number", "bits": bits, "fraction": fraction, "signed": signed, "modular": modular })
        }
        Shape::Code(words) => json!({ "kind": "code", "bits": shape.bits(), "words": words }),
        Shape::Pixel { x_bits, of_map, .. } => {
            json!({ "kind": "place", "bits": shape.bits(), "low": x_bits, "map": of_map })
        }
        Shape::Triangle => json!({ "kind": "triangle", "bits": shape.bits() }),
        Shape::Token(table) => json!({ "kind": "token", "bits": shape.bits(), "table": table }),
    }
}

fn of_register(register: &Register, changes: usize) -> Value {
    json!({
        "name": register.name,
        "doc": register.doc,
        "shape": shape(register.shape),
        "live": register.live,
        "wire": register.wire,
        "changes": changes,
    })
}

fn unit(unit: &UnitView) -> Value {
    let item = |item: &Item| match item {
        Item::Register(id) => json!({ "register": id }),
        Item::Table(table) => json!({ "table": of_table(table) }),
        Item::Schedule { job, during } => json!({ "schedule": { "job": job, "during": during } }),
    };
    json!({
        "name": unit.name,
        "title": unit.title,
        "section": unit.section,
        "does": unit.does,
        "items": unit.items.iter().map(item).collect::<Vec<_>>(),
        "aside": unit.aside,
        "notes": unit.notes,
        "triangle": unit.triangle,
        "lane": unit.lane,
        "works": unit.works,
        "phase": unit.phase,
        "says": unit.says.iter().map(|s| json!({ "when": s.when, "text": s.text })).collect::<Vec<_>>(),
        "moments": unit.moments.iter().map(|m| json!({
            "title": m.title, "when": m.when, "token": m.token, "tells": m.tells,
        })).collect::<Vec<_>>(),
        "marks": unit.marks.iter().map(|m| json!({ "x": m.x, "y": m.y })).collect::<Vec<_>>(),
    })
}

fn of_table(table: &Table) -> Value {
    let rows = table.rows.iter().map(|row| json!({ "name": row.name, "cells": row.cells }));
    json!({
        "title": table.title, "columns": table.columns, "folded": table.folded,
        "rows": rows.collect::<Vec<_>>(),
    })
}

fn step(step: &Step) -> Value {
    let part = |part: &Part| match part {
        Part::Text(text) => json!({ "text": text }),
        Part::Number { formula, value, check } => json!({
            "formula": formula,
            "value": value.to_string(),
            "check": check.as_ref().map(|check| json!({
                "name": check.name, "register": check.register, "field": check.field, "cycle": check.cycle,
                "raw": check.expected.to_string(), "found": check.shown.to_string(), "same": check.expected == check.found,
            })),
        }),
    };
    json!({
        "title": step.title, "sections": step.sections, "cycle": step.cycle,
        "parts": step.parts.iter().map(part).collect::<Vec<_>>(),
    })
}
