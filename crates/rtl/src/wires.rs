//! Tokens and registers: a signal for every field of a list, found by the field's name.
//!
//! The lists are those of [`edgewalk_machine::units::tokens`]. A token `line` of fields `y`, `major_right` …
//! is the ports or registers `line_y`, `line_major_right` ….

use std::ops::Index;

use edgewalk_machine::Field;
use edgewalk_netlist::{Instance, Module, Reg, Signal};

/// One part of a token: a declared field, or some bits of one.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub name: String,
    pub width: u32,
    /// Format and unit.
    pub doc: String,
}

impl From<&Field> for Part {
    fn from(field: &Field) -> Part {
        Part { name: field.name.clone(), width: field.width(), doc: field.to_string() }
    }
}

/// The fields as parts.
pub(crate) fn parts<'a>(fields: impl IntoIterator<Item = &'a Field>) -> Vec<Part> {
    fields.into_iter().map(Part::from).collect()
}

/// The signals of one token, by the names of its parts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Token<'m>(Vec<(Part, Signal<'m>)>);

impl<'m> Token<'m> {
    /// Input ports `<prefix>_<part>`.
    pub fn inputs(m: &'m Module, prefix: &str, parts: Vec<Part>) -> Token<'m> {
        let port = |part: Part| {
            let signal = m.input_doc(&format!("{prefix}_{}", part.name), part.width, &part.doc);
            (part, signal)
        };
        Token(parts.into_iter().map(port).collect())
    }

    /// The outputs `<prefix>_<part>` of an instance.
    pub fn of_instance(instance: Instance<'m>, prefix: &str, parts: Vec<Part>) -> Token<'m> {
        let output = |part: Part| {
            let signal = instance.output(&format!("{prefix}_{}", part.name));
            (part, signal)
        };
        Token(parts.into_iter().map(output).collect())
    }

    /// A token of these parts, each with the signal for its name.
    pub fn new(parts: Vec<Part>, signal: impl Fn(&str) -> Signal<'m>) -> Token<'m> {
        let pair = |part: Part| {
            let signal = signal(&part.name);
            (part, signal)
        };
        parts.into_iter().map(pair).collect()
    }

    /// Output ports `<prefix>_<part>`.
    pub fn output(&self, m: &'m Module, prefix: &str) {
        for (part, signal) in &self.0 {
            m.output_doc(&format!("{prefix}_{}", part.name), *signal, &part.doc);
        }
    }

    /// Drives the inputs `<prefix>_<part>` of an instance, for these parts of the token.
    pub fn connect(&self, instance: Instance<'m>, prefix: &str, parts: &[Part]) {
        for part in parts {
            instance.connect(&format!("{prefix}_{}", part.name), self[part.name.as_str()]);
        }
    }

    /// The signal of a part that not every token has.
    pub fn get(&self, name: &str) -> Option<Signal<'m>> {
        self.0.iter().find(|(part, _)| part.name == name).map(|(_, signal)| *signal)
    }

    /// Parts of the token.
    pub fn parts(&self) -> Vec<Part> {
        self.0.iter().map(|(part, _)| part.clone()).collect()
    }
}

/// A token of these signals, each with its own width.
impl<'m> FromIterator<(Part, Signal<'m>)> for Token<'m> {
    fn from_iter<I: IntoIterator<Item = (Part, Signal<'m>)>>(pairs: I) -> Token<'m> {
        Token(
            pairs
                .into_iter()
                .map(|(part, signal)| (Part { width: signal.width(), ..part }, signal))
                .collect(),
        )
    }
}

/// The signal of a part that the token has; which parts those are depends on no input but the declarations.
impl<'m> Index<&str> for Token<'m> {
    type Output = Signal<'m>;
    fn index(&self, name: &str) -> &Signal<'m> {
        let found = self.0.iter().find(|(part, _)| part.name == name);
        let (_, signal) = found.expect("units ask only for fields that the declarations list");
        signal
    }
}

/// A register of a stage.
pub(crate) fn moved<'m>(
    m: &'m Module,
    advance: Signal<'m>,
    name: &str,
    doc: &str,
    value: Signal<'m>,
) -> Signal<'m> {
    m.reg(name, value.width()).doc(doc).when(advance, value).q()
}

/// One register a part, `<prefix>_<part>`.
#[derive(Clone, Debug)]
pub(crate) struct Registers<'m>(Vec<(Part, Reg<'m>)>);

impl<'m> Registers<'m> {
    /// Registers without updates yet.
    pub fn new(m: &'m Module, prefix: &str, parts: Vec<Part>) -> Registers<'m> {
        let register = |part: Part| {
            let reg = m.reg(&format!("{prefix}_{}", part.name), part.width).doc(&part.doc);
            (part, reg)
        };
        Registers(parts.into_iter().map(register).collect())
    }

    /// All of them take the value of the part of their name.
    pub fn load(&self, when: Signal<'m>, value: impl Fn(&str) -> Signal<'m>) {
        for (part, reg) in &self.0 {
            reg.when(when, value(&part.name));
        }
    }

    /// The registers' values as a token.
    pub fn token(&self) -> Token<'m> {
        Token(self.0.iter().map(|(part, reg)| (part.clone(), reg.q())).collect())
    }

    /// The register of a part that not every machine has.
    pub fn get(&self, name: &str) -> Option<Reg<'m>> {
        self.0.iter().find(|(part, _)| part.name == name).map(|(_, reg)| *reg)
    }
}

/// As for [`Token`].
impl<'m> Index<&str> for Registers<'m> {
    type Output = Reg<'m>;
    fn index(&self, name: &str) -> &Reg<'m> {
        let found = self.0.iter().find(|(part, _)| part.name == name);
        let (_, register) = found.expect("units ask only for fields that the declarations list");
        register
    }
}
