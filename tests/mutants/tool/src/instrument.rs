//! Writes the switches of all faults of a file into its text.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;

use crate::fault::Fault;
use crate::place::Place;

/// Added to the root of every crate with faults: the module that the switches ask. It stays out of the crate's folder, as a test
/// of the repository reads what is in there.
pub const SWITCHES: &str = "\n#[allow(missing_docs, clippy::all)]\n\
    #[path = \"../../../tests/mutants/tool/switches.rs\"]\npub(crate) mod edgewalk_faults;\n";

/// A part of the new text, and the faults for which it was written.
pub struct Written {
    pub range: Range<usize>,
    pub faults: Vec<u32>,
}

/// The text with the switches, and what was written for which fault.
pub fn instrumented(text: &str, faults: &[(&Fault, Place)]) -> (String, Vec<Written>) {
    // By start; what is inserted before an expression goes first, then what holds others.
    let mut edits: BTreeMap<(usize, bool, Reverse<usize>), Edit> = BTreeMap::new();
    for (fault, place) in faults {
        let (key, kind) = match place {
            Place::Body(at) => ((*at, false, Reverse(*at)), Kind::Return),
            Place::Arm(at) => ((*at, false, Reverse(*at)), Kind::Guard),
            Place::Expression(range) => ((range.start, true, Reverse(range.end)), Kind::Choice),
        };
        let edit = edits.entry(key).or_insert(Edit { range: key.0..key.2.0, kind, faults: Vec::new() });
        edit.faults.push(fault);
    }
    let edits: Vec<Edit> = edits.into_values().collect();
    let mut writer = Writer { text, new: String::new(), written: Vec::new() };
    writer.write(0..text.len(), &edits);
    (writer.new, writer.written)
}

enum Kind {
    Return,
    Guard,
    Choice,
}

struct Edit<'a> {
    range: Range<usize>,
    kind: Kind,
    faults: Vec<&'a Fault>,
}

struct Writer<'a> {
    text: &'a str,
    new: String,
    written: Vec<Written>,
}

impl Writer<'_> {
    /// A part of the text with its edits, which are in order; those within others follow them.
    fn write(&mut self, part: Range<usize>, edits: &[Edit]) {
        let (mut at, mut left) = (part.start, edits);
        while let Some((edit, others)) = left.split_first() {
            self.new.push_str(&self.text[at..edit.range.start]);
            let within = others.iter().take_while(|other| other.range.start < edit.range.end).count();
            let start = self.new.len();
            match edit.kind {
                Kind::Return => {
                    for fault in &edit.faults {
                        self.switch(fault, |fault| {
                            format!(" if {} {{ return {}; }} ", asked(fault), fault.replacement)
                        });
                    }
                }
                Kind::Guard => {
                    for (place, fault) in edit.faults.iter().enumerate() {
                        let joined = if place == 0 { "if" } else { "&&" };
                        self.switch(fault, |fault| format!(" {joined} !{}", asked(fault)));
                    }
                }
                Kind::Choice => {
                    self.new.push('(');
                    for fault in &edit.faults {
                        let changed = fault.changed(self.text, edit.range.clone());
                        self.switch(fault, |fault| format!("if {} {{ {changed} }} else ", asked(fault)));
                    }
                    // With this fault those within are off: they are written only where the text is as it was.
                    self.new.push_str("{ ");
                    self.write(edit.range.clone(), &others[..within]);
                    self.new.push_str(" })");
                    let faults = edit.faults.iter().map(|fault| fault.number).collect();
                    self.written.push(Written { range: start..self.new.len(), faults });
                }
            }
            (at, left) = (edit.range.end, &others[within..]);
        }
        self.new.push_str(&self.text[at..part.end]);
    }

    fn switch(&mut self, fault: &Fault, text: impl Fn(&Fault) -> String) {
        let start = self.new.len();
        self.new.push_str(&text(fault));
        self.written.push(Written { range: start..self.new.len(), faults: vec![fault.number] });
    }
}

fn asked(fault: &Fault) -> String {
    format!("crate::edgewalk_faults::at({})", fault.number)
}

#[cfg(test)]
mod tests;
