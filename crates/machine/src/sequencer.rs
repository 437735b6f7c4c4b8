//! The program of a SETUP of kind `sequenced`: its text, as `docs/machine.md` prints it, and the text's words.
//!
//! It has three readers: the specification, the slow model, which runs the words, and the assembler of the rtl. What a word
//! does is written in the latter two, each on its own.

mod parse;
pub mod word;

use crate::{EdgeKind, Fill, Plan};
use std::collections::BTreeMap;
use word::Word;

/// The text, with the lines of every machine.
pub const LISTING: &str = include_str!("sequencer/listing.txt");

/// Rows that have names; behind them come those of the vertices.
pub const NAMED_ROWS: u8 = 128;

/// The program of one machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// Words of the program; the first one waits for a triangle.
    pub words: Vec<Word>,
    rows: BTreeMap<String, u8>,
    labels: BTreeMap<String, u16>,
}

impl Program {
    /// The program of a machine.
    ///
    /// # Panics
    /// Never: a test reads the listing for each set of features.
    #[must_use]
    pub fn of(plan: &Plan) -> Program {
        let features = [
            ("beside", edges_are_beside(plan)),
            ("lines", plan.polygon.has_lines()),
            ("slope", plan.edge_kind == EdgeKind::Slope),
            ("textbook", plan.fill == Fill::Textbook),
        ];
        let features: Vec<&str> = features.into_iter().filter(|(_, is)| *is).map(|(name, _)| name).collect();
        let parsed = parse::parse(LISTING, &features).expect("the listing has no error");
        Program { words: parsed.words, rows: parsed.rows, labels: parsed.labels }
    }

    /// The first row of that name, which the listing declares.
    ///
    /// # Panics
    /// If it does not: only names that are written in code are asked for.
    #[must_use]
    pub fn row(&self, name: &str) -> u8 {
        self.rows[name]
    }

    /// The labels at their places.
    pub fn labels(&self) -> impl Iterator<Item = (&str, u16)> {
        self.labels.iter().map(|(label, place)| (label.as_str(), *place))
    }
}

/// Four lanes do the three edges side by side; fewer do them one after the other.
#[must_use]
pub fn edges_are_beside(plan: &Plan) -> bool {
    plan.lanes == 4
}

/// Rounds of channels: lane l does the channels l, l + lanes, ….
#[must_use]
pub fn rounds(plan: &Plan) -> usize {
    plan.channels().len().div_ceil(plan.lanes as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Lines, Machine};

    #[test]
    fn listing_has_words_for_each_number_of_lanes() {
        for lanes in [1, 2, 4] {
            let mut machine = Machine { lanes, ..Machine::default() };
            let without = Program::of(&machine.plan().expect("can be built")).words.len();
            machine.polygon.lines = Lines::Yes;
            let program = Program::of(&machine.plan().expect("can be built"));
            assert_eq!(program.words.len(), without + 1);
            assert_eq!([program.row("height"), program.row("width")], [4, 6], "a flat line exchanges them");
            machine.polygon.lines = Lines::No;
            machine.edge_kind = EdgeKind::Slope;
            let slope = Program::of(&machine.plan().expect("can be built")).words.len();
            (machine.fill, machine.subpixel_bits) = (Fill::Textbook, 0);
            let textbook = Program::of(&machine.plan().expect("can be built")).words.len();
            assert!(without != slope && slope != textbook, "{without}, {slope}, {textbook} words");
            assert!(
                (200..=512).contains(&slope) && (200..=512).contains(&textbook),
                "{slope}, {textbook} words"
            );
            assert!((200..=512).contains(&program.words.len()), "{} words", program.words.len());
            assert!(program.rows.values().all(|row| *row <= NAMED_ROWS - 8));
            let places = program.words.iter().filter_map(|word| word.control.place());
            assert!(places.count() > 20, "words that name a place");
        }
    }

    #[test]
    fn specification_prints_the_listing() {
        let printed = include_str!("../../../docs/machine.md");
        assert!(printed.contains(&format!("\n```\n{LISTING}```\n")), "docs/machine.md has another program");
    }

    #[test]
    fn errors_of_listing_name_their_line() {
        for (text, error) in [
            ("rest\nlode one", "line 2: no such operation: lode one"),
            ("rest ; goto nowhere", "line 1: no label nowhere: rest ; goto nowhere"),
            (".row a\n.row a", "line 2: a row twice: .row a"),
            ("add a", "line 1: no row a: add a"),
            (".end", "line 1: no .if: .end"),
            (".row zero\nrest ; raised", "line 2: no step to say more of: rest ; raised"),
        ] {
            assert_eq!(parse::parse(text, &[]).err().as_deref(), Some(error));
        }
    }
}
