//! The text of the lesson, cut into blocks.

/// A line of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Only where this formula is not 0.
    pub test: Option<String>,
    /// What it is.
    pub kind: Kind,
}

/// What a line is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Words; `{formula}` stands for its value.
    Text(String),
    /// A number.
    Number {
        /// What it is called from here on.
        name: String,
        /// Where it comes from.
        formula: String,
        /// Unit, register and field that must hold it, and the moment.
        held: Option<Held>,
    },
}

/// Where a number must be found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Held {
    /// A unit; `cycle` and `count`: the moment's cycle, and the cycles of a cause.
    pub unit: String,
    /// A register of it.
    pub register: String,
    /// A field of the token in it.
    pub field: Option<String>,
    /// When; where it is left out, as soon as the register means something.
    pub moment: Option<String>,
}

/// A part of the lesson.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// What it is called here.
    pub name: String,
    /// What the step is called, if it begins one.
    pub title: String,
    /// Sections of `docs/machine.md`.
    pub sections: Vec<u32>,
    /// Lines of the block.
    pub lines: Vec<Line>,
}

const SOURCE: &str = include_str!("lesson.txt");

/// All blocks. The source is part of the program, and a test reads all of it.
#[must_use]
pub fn blocks() -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    for line in SOURCE.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some((name, rest)) = line.strip_prefix('[').and_then(|line| line.split_once(']')) {
            let (title, sections) = rest.split_once('|').unwrap_or((rest, ""));
            let sections = sections.split_whitespace().filter_map(|n| n.parse().ok()).collect();
            let (name, title) = (name.to_owned(), title.trim().to_owned());
            blocks.push(Block { name, title, sections, lines: Vec::new() });
        } else if let Some(block) = blocks.last_mut() {
            block.lines.push(read(line));
        }
    }
    blocks
}

fn read(line: &str) -> Line {
    let tested = line.strip_prefix("if ").and_then(|rest| rest.split_once(": "));
    let (test, rest) = tested.map_or((None, line), |(test, rest)| (Some(test.to_owned()), rest));
    let number = rest.strip_prefix("= ").and_then(|rest| rest.split_once(" = "));
    let kind = match number {
        None => Kind::Text(rest.to_owned()),
        Some((name, rest)) => {
            let (formula, held) = rest.split_once(" => ").map_or((rest, None), |(f, held)| (f, Some(held)));
            Kind::Number { name: name.to_owned(), formula: formula.to_owned(), held: held.map(of_held) }
        }
    };
    Line { test, kind }
}

fn of_held(text: &str) -> Held {
    let (place, moment) =
        text.split_once(" @").map_or((text, None), |(place, m)| (place, Some(m.to_owned())));
    let (unit, register) = place.split_once(' ').unwrap_or((place, ""));
    let (register, field) =
        register.split_once(':').map_or((register, None), |(r, f)| (r, Some(f.to_owned())));
    Held { unit: unit.to_owned(), register: register.to_owned(), field, moment }
}
