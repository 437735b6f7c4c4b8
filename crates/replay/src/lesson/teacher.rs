//! Takes blocks of the text: evaluates their formulae, and looks up what the machine holds.

use super::expression::{Values, evaluate, printed, with_numbers};
use super::source::{Block, Held, Kind, blocks};
use super::{Check, Lesson, Part, Step};
use crate::recording::Recording;
use edgewalk_machine::Activity;
use edgewalk_model::view::{Item, Shape, Structure, UnitView};
use std::collections::BTreeMap;

/// The lesson while it is written.
pub struct Teacher<'a> {
    blocks: Vec<Block>,
    recording: &'a Recording,
    /// What has a value so far.
    pub values: Values,
    /// Moments by name: cycles of the recording.
    pub moments: BTreeMap<&'static str, u32>,
    /// What is written.
    pub lesson: Lesson,
}

impl<'a> Teacher<'a> {
    pub fn new(recording: &'a Recording) -> Self {
        Teacher {
            blocks: blocks(),
            recording,
            values: Values::new(),
            moments: BTreeMap::new(),
            lesson: Lesson::default(),
        }
    }

    pub fn set(&mut self, name: &str, value: impl Into<i128>) {
        self.values.insert(name.to_owned(), value.into());
    }

    pub fn value(&self, name: &str) -> i128 {
        self.values.get(name).copied().unwrap_or(0)
    }

    /// A step begins with this block.
    pub fn step(&mut self, block: &str, put: &[(&str, &str)], shown: bool) -> Result<(), String> {
        if shown {
            let (title, sections) =
                self.of(block).map(|block| (block.title.clone(), block.sections.clone()))?;
            let title = self.words(&put_in(&title, put))?;
            self.lesson.steps.push(Step { title, sections, cycle: u32::MAX, parts: Vec::new() });
        }
        self.block(block, put, shown)
    }

    /// The lines of a block; `put` stands for its `$` names.
    pub fn block(&mut self, name: &str, put: &[(&str, &str)], shown: bool) -> Result<(), String> {
        for line in self.of(name)?.lines.clone() {
            if let Some(test) = line.test
                && evaluate(&put_in(&test, put), &self.values)? == 0
            {
                continue;
            }
            let part = match line.kind {
                Kind::Text(text) => Part::Text(self.words(&put_in(&text, put))?),
                Kind::Number { name, formula, held } => {
                    self.number(&put_in(&name, put), &put_in(&formula, put), held.as_ref(), put)?
                }
            };
            if !shown {
                continue;
            }
            if let Some(step) = self.lesson.steps.last_mut() {
                if let Part::Number { check: Some(check), .. } = &part
                    && step.cycle == u32::MAX
                {
                    step.cycle = check.cycle;
                }
                step.parts.push(part);
            }
        }
        Ok(())
    }

    fn of(&self, name: &str) -> Result<&Block, String> {
        let block = self.blocks.iter().find(|block| block.name == name);
        block.ok_or_else(|| format!("the lesson has no block {name}"))
    }

    /// Text with its `{formula}`s as numbers.
    fn words(&self, text: &str) -> Result<String, String> {
        let mut words = String::new();
        for (place, part) in text.split(['{', '}']).enumerate() {
            match place % 2 {
                0 => words += part,
                _ => words += &evaluate(part, &self.values)?.to_string(),
            }
        }
        Ok(words)
    }

    fn number(
        &mut self,
        name: &str,
        formula: &str,
        held: Option<&Held>,
        put: &[(&str, &str)],
    ) -> Result<Part, String> {
        let value = evaluate(formula, &self.values)?;
        let (plain, numbers) = (printed(formula), with_numbers(formula, &self.values));
        let shown = if plain == numbers || numbers == value.to_string() || plain == name {
            format!("{name} = {plain}")
        } else {
            format!("{name} = {plain} = {numbers}")
        };
        self.set(name, value);
        let check = held.map(|held| self.check(held, value, put)).transpose()?;
        self.lesson.checks.extend(check.clone());
        Ok(Part::Number { formula: shown, value, check })
    }

    fn moment(&self, name: &str) -> Result<u32, String> {
        self.moments.get(name).copied().ok_or_else(|| format!("there is no moment {name}"))
    }

    fn check(&self, held: &Held, value: i128, put: &[(&str, &str)]) -> Result<Check, String> {
        let (owner, register) = (put_in(&held.unit, put), put_in(&held.register, put));
        let name = format!("{owner} {register}");
        let outside = |cycle: u32, found: u64| Check {
            name: name.clone(),
            register: None,
            field: None,
            cycle,
            expected: value as u64,
            found,
            shown: found.into(),
        };
        match owner.as_str() {
            "cycle" => {
                let cycle = self.moment(&register)?;
                return Ok(outside(cycle, cycle.into()));
            }
            "count" => return Ok(outside(0, self.cycles_of(&register))),
            _ => {}
        }
        let structure = self.recording.view.structure();
        let id = structure.unit(&owner).and_then(|unit| register_of(structure, unit, &register));
        let id = id.ok_or_else(|| format!("there is no register {name}"))?;
        let cycle = match (&held.moment, owner.as_str()) {
            (Some(moment), _) => self.moment(moment)?,
            (None, "edge") => self.moment("line")?,
            (None, "poly") => self.moment("enter")?,
            (None, _) => self.first_live(id)?,
        };
        let raw = self.recording.columns[id].in_cycle(cycle);
        let shape = structure.registers[id].shape;
        let (field, raw, shape) = match (&held.field, shape) {
            (Some(field), Shape::Token(table)) => {
                let field = put_in(field, put);
                let kind = &self.recording.view.tokens().kinds()[table];
                let place = kind.fields.iter().position(|own| own.name == field);
                let place = place.ok_or_else(|| format!("{name} has no field {field}"))?;
                let token = raw.checked_sub(1).and_then(|number| kind.met.get(number as usize));
                let token = token.ok_or_else(|| format!("{name} holds nothing in cycle {cycle}"))?;
                (Some(place), token[place + 1], kind.fields[place].shape)
            }
            _ => (None, raw, shape),
        };
        let bits = shape.bits();
        let signed = matches!(shape, Shape::Number { signed: true, .. });
        let negative = signed && raw >> (bits - 1) & 1 == 1;
        let name =
            held.field.as_ref().map_or(name.clone(), |field| format!("{name}, {}", put_in(field, put)));
        Ok(Check {
            name,
            register: Some(id),
            field,
            cycle,
            expected: value as u64 & (u64::MAX >> (64 - bits)),
            found: raw,
            shown: if negative { i128::from(raw) - (1 << bits) } else { raw.into() },
        })
    }

    /// The first cycle in which the register means something.
    fn first_live(&self, id: usize) -> Result<u32, String> {
        let Some(live) = self.recording.view.structure().registers[id].live else { return Ok(0) };
        let column = &self.recording.columns[live];
        let up = column.at.iter().zip(&column.value).find(|(_, value)| **value == 1);
        up.map(|(at, _)| *at).ok_or_else(|| "the triangle is culled".to_owned())
    }

    fn cycles_of(&self, cause: &str) -> u64 {
        let column = &self.recording.columns[self.recording.view.structure().cause];
        let ends = column.at.iter().skip(1).copied().chain([self.recording.cycles]);
        let code = Activity::ALL.iter().position(|activity| activity.name() == cause).map(|code| code as u64);
        let runs = column.at.iter().zip(ends).zip(&column.value);
        runs.filter(|(_, value)| Some(**value) == code).map(|((from, to), _)| u64::from(to - from)).sum()
    }
}

/// The register of that name on a unit's card, or beside it.
pub fn register_of(structure: &Structure, unit: &UnitView, name: &str) -> Option<usize> {
    let of_items = unit.items.iter().flat_map(|item| match item {
        Item::Register(id) => vec![*id],
        Item::Table(table) => table.rows.iter().flat_map(|row| row.cells.clone()).collect(),
        Item::Schedule { .. } => Vec::new(),
    });
    of_items.chain(unit.aside.iter().copied()).find(|id| structure.registers[*id].name == name)
}

fn put_in(text: &str, put: &[(&str, &str)]) -> String {
    put.iter().fold(text.to_owned(), |text, (name, value)| text.replace(&format!("${name}"), value))
}
