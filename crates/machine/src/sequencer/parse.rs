//! The listing as words.
//!
//! ```text
//!  .constant NAME  .row NAME  .pass NAME (2 rows)  .table NAME (4 rows)  .rounds NAME (8 rows)     rows, in their order from 0
//!  .if FEATURE … .else … .end                                            lines of machines that have it
//!  label:  operation row -> row ; clause ; clause  # comment
//! ```

use super::word::{
    ACTS, Act, Base, Control, Corner, Factor, Give, Only, Operand, Part, Row, Sign, Step, Word, Write,
};
use std::collections::BTreeMap;

/// The listing as a machine with these features has it: words, the first rows of names, and the places of labels.
pub(super) struct Parsed {
    pub words: Vec<Word>,
    pub rows: BTreeMap<String, u8>,
    pub labels: BTreeMap<String, u16>,
}

/// Reads the listing.
///
/// # Errors
/// The number of the first line that is not understood, and what is wrong with it.
pub(super) fn parse(text: &str, features: &[&str]) -> Result<Parsed, String> {
    let mut reader = Reader::default();
    let mut branches = Vec::new();
    let mut lines = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        let at = |message: &str| format!("line {}: {message}: {line}", number + 1);
        let (head, rest) = line.split_once(' ').unwrap_or((line, ""));
        match head {
            "" => {}
            ".if" => branches.push(features.contains(&rest.trim())),
            ".else" => {
                let branch = branches.last_mut().ok_or_else(|| at("no .if"))?;
                *branch = !*branch;
            }
            ".end" => {
                branches.pop().ok_or_else(|| at("no .if"))?;
            }
            _ if branches.contains(&false) => {}
            _ if head.starts_with('.') => reader.declare(head, rest.trim()).map_err(|error| at(&error))?,
            _ => lines.push((number, reader.place(line, lines.len() as u16).to_owned())),
        }
    }
    let mut words = Vec::new();
    for (number, line) in lines {
        words.push(reader.word(&line).map_err(|error| format!("line {}: {error}: {line}", number + 1))?);
    }
    Ok(Parsed { words, rows: reader.rows, labels: reader.labels })
}

#[derive(Default)]
struct Reader {
    rows: BTreeMap<String, u8>,
    next_row: u8,
    labels: BTreeMap<String, u16>,
}

impl Reader {
    fn declare(&mut self, kind: &str, name: &str) -> Result<(), String> {
        let count = match kind {
            ".constant" | ".row" => 1,
            ".pass" => 2,
            ".table" => 4,
            ".rounds" => 8,
            _ => return Err("no such directive".to_owned()),
        };
        let first = self.next_row.next_multiple_of(count);
        self.next_row = first + count;
        match self.rows.insert(name.to_owned(), first) {
            None => Ok(()),
            Some(_) => Err("a row twice".to_owned()),
        }
    }

    /// The line without its label.
    fn place<'a>(&mut self, line: &'a str, place: u16) -> &'a str {
        match line.split_once(':') {
            Some((label, rest)) => {
                self.labels.insert(label.to_owned(), place);
                rest.trim()
            }
            None => line,
        }
    }

    fn word(&self, line: &str) -> Result<Word, String> {
        let mut clauses = line.split(';').map(str::trim);
        let operation = clauses.next().unwrap_or("");
        let text = line.split_whitespace().collect::<Vec<_>>().join(" ");
        let (step, factor, write) = self.operation(operation)?;
        let mut word = Word { text, step, factor, write, give: None, control: Control::Next, act: None };
        for clause in clauses {
            self.clause(clause, &mut word)?;
        }
        Ok(word)
    }

    #[allow(clippy::type_complexity, reason = "the three parts of one text")]
    fn operation(&self, text: &str) -> Result<(Option<Step>, Option<(Factor, Row)>, Option<Write>), String> {
        let (text, write) = match text.split_once("->") {
            Some((text, to)) => (text.trim(), Some(self.write(to.trim())?)),
            None => (text, None),
        };
        let (name, row) = text.split_once(' ').unwrap_or((text, "zero"));
        let step = |base, sign| -> Result<_, String> {
            let whole = row == "whole";
            let operand = if whole { Operand::Whole } else { Operand::Row };
            let row = self.row(if whole { "zero" } else { row })?;
            Ok((Some(Step { base, row, operand, sign, only: Only::Always }), None, write))
        };
        match name {
            "rest" => Ok((None, None, write)),
            "load" => step(Base::Nothing, Sign::Plus),
            "negate" => step(Base::Nothing, Sign::Minus),
            "add" => step(Base::Same, Sign::Plus),
            "sub" => step(Base::Same, Sign::Minus),
            "double" => step(Base::Twice, Sign::Plus),
            "mask" => step(Base::Masked, Sign::Plus),
            "D" => step(Base::Twice, Sign::ByA),
            "R" => step(Base::Same, Sign::ByA),
            "factor" => {
                let (factor, row) = row.split_once(' ').ok_or("no row")?;
                let factor = if factor == "f" { Factor::F } else { Factor::G };
                Ok((None, Some((factor, self.row(row)?)), write))
            }
            _ => Err("no such operation".to_owned()),
        }
    }

    fn named(&self, name: &str) -> Result<u8, String> {
        self.rows.get(name).copied().ok_or_else(|| format!("no row {name}"))
    }

    fn write(&self, text: &str) -> Result<Write, String> {
        match text.strip_suffix(".a") {
            Some(name) => Ok(Write { row: self.named(name)?, only_a: true, numbered: false }),
            None => match self.row(text)? {
                Row::Named(row) => Ok(Write { row, only_a: false, numbered: false }),
                Row::Number(row) => Ok(Write { row, only_a: false, numbered: true }),
                _ => Err("not a row to write".to_owned()),
            },
        }
    }

    fn row(&self, text: &str) -> Result<Row, String> {
        if let Some((table, index)) = text.split_once('[') {
            let table = self.named(table)?;
            return match index {
                "digits]" => Ok(Row::Digits(table)),
                "edge]" => Ok(Row::Edge(table)),
                "number]" => Ok(Row::Number(table)),
                "pass]" => Ok(Row::Pass(table)),
                _ => Err("no such index".to_owned()),
            };
        }
        let Some((name, part)) = text.split_once('.') else { return Ok(Row::Named(self.named(text)?)) };
        if let Ok(index) = part.parse::<u8>() {
            return Ok(Row::Named(self.named(name)? + index));
        }
        let corner = match name {
            "k" => return Ok(Row::OfChannel),
            "v0" => Corner::Place(0),
            "v1" => Corner::Place(1),
            "v2" => Corner::Place(2),
            "a" => Corner::Upper,
            "b" => Corner::Lower,
            _ => return Err("no such vertex".to_owned()),
        };
        match part {
            "x" => Ok(Row::Vertex(corner, Part::X)),
            "y" => Ok(Row::Vertex(corner, Part::Y)),
            "c" => Ok(Row::Vertex(corner, Part::Value)),
            _ => Err("no such part".to_owned()),
        }
    }

    fn clause(&self, clause: &str, word: &mut Word) -> Result<(), String> {
        if let Some(act) = act(clause) {
            word.act = Some(act);
        } else if let Some(control) = self.control(clause)? {
            word.control = control;
        } else if let Some(give) = clause.strip_prefix("give ") {
            word.give = Some(self::give(give).ok_or("no such result")?);
        } else {
            let step = word.step.as_mut().ok_or("no step to say more of")?;
            match clause {
                "if negative" => step.only = Only::Negative,
                "if positive" => step.only = Only::Positive,
                "if no upper" => step.only = Only::NoUpper,
                "if right" => step.only = Only::Right,
                "if thin" => step.only = Only::Thin,
                "raised" => step.operand = Operand::Raised,
                "by side" if step.sign == Sign::Plus => step.sign = Sign::PlusBySide,
                "by side" if step.sign == Sign::Minus => step.sign = Sign::MinusBySide,
                _ => return Err(format!("no such clause: {clause}")),
            }
        }
        Ok(())
    }

    fn control(&self, clause: &str) -> Result<Option<Control>, String> {
        let alone = match clause {
            "words" => Control::Words,
            "room" => Control::Room,
            "settle" => Control::Settle,
            "digits" => Control::Digits,
            "again" => Control::Again,
            "return" => Control::Return,
            _ => Control::Next,
        };
        if alone != Control::Next {
            return Ok(Some(alone));
        }
        let Some((name, label)) = clause.rsplit_once(' ') else { return Ok(None) };
        let to: fn(u16) -> Control = match name {
            "zeros" => Control::Zeros,
            "more" => Control::More,
            "negative" => Control::Negative,
            "unfit" => Control::Unfit,
            "no upper" => Control::NoUpper,
            "no lower" => Control::NoLower,
            "rounds" => Control::Rounds,
            "goto" => Control::Goto,
            "call" => Control::Call,
            _ => return Ok(None),
        };
        self.labels.get(label).map(|place| Some(to(*place))).ok_or_else(|| format!("no label {label}"))
    }
}

fn give(name: &str) -> Option<Give> {
    Some(match name {
        "jm" => Give::Jm,
        "n1" => Give::N1,
        "n2" => Give::N2,
        "m" => Give::M,
        "qf" => Give::Qf,
        "r" => Give::R,
        "c" => Give::C,
        "start" => Give::Start,
        "startb" => Give::StartB,
        "d0" => Give::D0,
        "d1" => Give::D1,
        "g" => Give::G,
        _ => return None,
    })
}

fn act(name: &str) -> Option<Act> {
    ACTS.iter().find(|(own, _)| *own == name).map(|(_, act)| *act)
}
