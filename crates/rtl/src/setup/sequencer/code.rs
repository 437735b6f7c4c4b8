//! The assembler: words of the program as bits of the ROM, and the bits that stand in it, taken apart.

use edgewalk_machine::Plan;
use edgewalk_machine::sequencer::Program;
use edgewalk_machine::sequencer::word::{
    ACTS, Act, Base, Control, Corner, Factor, Give, Only, Operand, Part, Row, Sign, Word,
};
use edgewalk_netlist::{Module, Signal};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Bits of the place of a row.
pub(super) const ROW_BITS: u32 = 8;
/// Bits of the place of a word within its vertex.
pub(super) const PART_BITS: u32 = 4;
/// Bits of the place of a row that a word writes.
const WRITE_BITS: u32 = ROW_BITS - 1;
/// The first row of the vertices.
pub(super) const VERTICES: u128 = 1 << WRITE_BITS;
/// Place of a vertex's first channel.
pub(super) const FIRST_VALUE: u128 = 2;
/// Stands for the place of the value of the round.
const VALUE: u128 = 15;

/// How the place of a row follows from the word.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mode {
    AsIs,
    Digits,
    Edge,
    Number,
    Pass,
    Vertex,
    Upper,
    Lower,
}

/// Which word comes next, as a number.
#[derive(Clone, Copy, Debug)]
pub(super) enum Jump {
    Next,
    Words,
    Room,
    Settle,
    Digits,
    Again,
    Zeros,
    More,
    Negative,
    Unfit,
    NoUpper,
    NoLower,
    Rounds,
    Goto,
    Call,
    Return,
}

/// The results as numbers; 0 is none.
fn number_of(give: Give) -> u128 {
    1 + give as u128
}

/// The parts of a word in the ROM, the most significant first: their names and bits; `target` has those of a place.
const FIELDS: [(&str, u32); 19] = [
    ("act", 5),
    ("give", 4),
    ("target", 0),
    ("jump", 4),
    ("load_g", 1),
    ("load_f", 1),
    ("write_w", 1),
    ("write_a", 1),
    ("write_numbered", 1),
    ("write_row", WRITE_BITS),
    ("steps", 1),
    ("only", 3),
    ("raised", 1),
    ("whole", 1),
    ("by_a", 1),
    ("by_side", 1),
    ("minus", 1),
    ("base", 2),
    ("mode", 3),
];

/// Behind them the row.
fn fields(program: &Program) -> impl Iterator<Item = (&'static str, u32)> {
    let place = place_bits(program);
    let sized = move |(name, bits): (&'static str, u32)| (name, if bits == 0 { place } else { bits });
    FIELDS.into_iter().chain([("row", ROW_BITS)]).map(sized)
}

/// Bits of the place of a word.
pub(super) fn place_bits(program: &Program) -> u32 {
    (program.words.len() - 1).ilog2() + 1
}

/// A word taken apart.
pub(super) struct Decoded<'m> {
    m: &'m Module,
    fields: Vec<(&'static str, Signal<'m>)>,
    /// Codes by their names, as far as something is compared with them.
    codes: RefCell<BTreeMap<String, Signal<'m>>>,
}

impl<'m> Decoded<'m> {
    pub fn get(&self, name: &str) -> Signal<'m> {
        let found = self.fields.iter().find(|(field, _)| *field == name);
        found.expect("only fields of the list are asked for").1
    }

    pub fn jumps(&self, jump: Jump) -> Signal<'m> {
        self.get("jump").eq(self.code("jump", &format!("{jump:?}"), jump as u128))
    }

    pub fn does(&self, act: Act) -> Signal<'m> {
        let (word, code) = (ACTS[act_place(act)].0, act_code(act));
        self.get("act").eq(self.code("act", word, code))
    }

    pub fn is_mode(&self, mode: Mode) -> Signal<'m> {
        self.get("mode").eq(self.code("mode", &format!("{mode:?}"), mode as u128))
    }

    /// Names the codes that stand in the program, all at one place. Code 0 of a part is nothing to be done.
    fn name_codes(&self, program: &Program) {
        let words = || program.words.iter();
        self.m.comment("Codes of the clauses.");
        for (word, act) in ACTS.iter().filter(|(_, act)| words().any(|word| word.act == Some(*act))) {
            self.code("act", word, act_code(*act));
        }
        let jumps: BTreeMap<u128, Jump> =
            words().map(|word| jump(word.control)).map(|jump| (jump as u128, jump)).collect();
        for (code, jump) in jumps.iter().filter(|(code, _)| **code > 0) {
            self.code("jump", &format!("{jump:?}"), *code);
        }
        let gives: BTreeMap<u128, Give> =
            words().filter_map(|word| word.give).map(|give| (number_of(give), give)).collect();
        gives.values().for_each(|give| _ = self.result(*give));
        let modes: BTreeMap<u128, Mode> =
            words().filter_map(row).map(|row| row_code(row).0).map(|mode| (mode as u128, mode)).collect();
        for (code, mode) in modes.iter().filter(|(code, _)| **code > 0) {
            self.code("mode", &format!("{mode:?}"), *code);
        }
    }

    /// The number of a result, as the field `give` of a word has it.
    pub fn result(&self, give: Give) -> Signal<'m> {
        self.code("give", &format!("{give:?}"), number_of(give))
    }

    /// A code of this field, `FIELD_NAME` in the Verilog.
    fn code(&self, field: &str, name: &str, code: u128) -> Signal<'m> {
        let name = constant_name(field, name);
        let width = self.get(field).width();
        *self.codes.borrow_mut().entry(name.clone()).or_insert_with(|| self.m.constant(&name, width, code))
    }
}

/// Of a name with spaces, or in mixed case: `ACT_TIMES_T` of `times t`, `JUMP_NO_UPPER` of `NoUpper`.
fn constant_name(field: &str, name: &str) -> String {
    let mut made = field.to_uppercase();
    for letter in name.chars() {
        if letter.is_uppercase() || made.len() == field.len() {
            made.push('_');
        }
        made.push(if letter == ' ' { '_' } else { letter.to_ascii_uppercase() });
    }
    made
}

/// The ROM; gives the word that was addressed a clock before.
pub(super) fn rom<'m>(m: &'m Module, program: &Program, next: Signal<'m>) -> Decoded<'m> {
    let (fields, words) = coded(program);
    let bits = fields.iter().map(|(_, bits)| bits).sum();
    let rom = m.memory("listing", place_bits(program), program.words.len(), bits).doc("the program");
    for (place, word) in words.iter().enumerate() {
        rom.holds(place, word.code, &word.text);
    }
    let word = rom.read(m.lit(1, 1), next);
    let mut below = bits;
    let mut decoded = Vec::new();
    for (name, bits) in fields {
        below -= bits;
        decoded.push((name, word.slice(below + bits - 1, below).named(name)));
    }
    let decoded = Decoded { m, fields: decoded, codes: RefCell::default() };
    decoded.name_codes(program);
    decoded
}

/// A word of the ROM.
#[derive(Clone, Debug)]
pub struct RomWord {
    /// The word's line of the listing.
    pub text: String,
    /// Bits of the code.
    pub code: u128,
    /// The bits that something depends on; the others do not care.
    pub used: u128,
}

/// The parts of a word in the ROM, the most significant first, and what each word holds.
#[must_use]
pub fn program_rom(plan: &Plan) -> (Vec<(&'static str, u32)>, Vec<RomWord>) {
    coded(&Program::of(plan))
}

fn coded(program: &Program) -> (Vec<(&'static str, u32)>, Vec<RomWord>) {
    let fields: Vec<_> = fields(program).collect();
    let packed = |part: &dyn Fn(&'static str) -> u128| {
        fields.iter().fold(0u128, |code, &(name, bits)| code << bits | part(name) & ((1 << bits) - 1))
    };
    let words = program.words.iter().map(|word| RomWord {
        text: word.text.clone(),
        code: packed(&|name| value(word, name)),
        used: packed(&|name| used(word, name)),
    });
    let words = words.collect();
    (fields, words)
}

/// The row that a word reads.
fn row(word: &Word) -> Option<Row> {
    word.step.map(|step| step.row).or(word.factor.map(|(_, row)| row))
}

/// The bits of a part that something depends on.
fn used(word: &Word, field: &str) -> u128 {
    let all = |is: bool| if is { u128::MAX } else { 0 };
    let row = row(word);
    match field {
        "target" => all(word.control.place().is_some()),
        "write_row" | "write_numbered" => all(word.write.is_some()),
        "only" | "raised" | "whole" | "by_a" | "base" => all(word.step.is_some()),
        "minus" | "by_side" => all(word.step.is_some_and(|step| step.sign != Sign::ByA)),
        "mode" => all(row.is_some()),
        "row" => match row {
            None => 0,
            Some(Row::Named(_) | Row::Number(_)) => u128::MAX,
            Some(Row::Digits(_) | Row::Edge(_)) => !3,
            Some(Row::Pass(_)) => !1,
            Some(Row::OfChannel | Row::Vertex(Corner::Place(_), _)) => VERTICES / 2 - 1,
            Some(Row::Vertex(..)) => (1 << PART_BITS) - 1,
        },
        _ => u128::MAX,
    }
}

/// A part of the word as a number.
fn value(word: &Word, field: &str) -> u128 {
    let (mode, place) = row(word).map_or((Mode::AsIs, 0), row_code);
    let step = word.step;
    let sign = |signs: &[Sign]| step.is_some_and(|step| signs.contains(&step.sign)).into();
    match field {
        "act" => word.act.map_or(0, act_code),
        "give" => word.give.map_or(0, number_of),
        "target" => word.control.place().map_or(0, u128::from),
        "jump" => jump(word.control) as u128,
        "load_g" => matches!(word.factor, Some((Factor::G, _))).into(),
        "load_f" => matches!(word.factor, Some((Factor::F, _))).into(),
        "write_w" => word.write.is_some_and(|write| !write.only_a).into(),
        "write_a" => word.write.is_some().into(),
        "write_numbered" => word.write.is_some_and(|write| write.numbered).into(),
        "write_row" => word.write.map_or(0, |write| write.row.into()),
        "steps" => step.is_some().into(),
        "only" => step.map_or(0, |step| only(step.only)),
        "raised" => step.is_some_and(|step| step.operand == Operand::Raised).into(),
        "whole" => step.is_some_and(|step| step.operand == Operand::Whole).into(),
        "by_a" => sign(&[Sign::ByA]),
        "by_side" => sign(&[Sign::PlusBySide, Sign::MinusBySide]),
        "minus" => sign(&[Sign::Minus, Sign::MinusBySide]),
        "base" => step.map_or(0, |step| base(step.base)),
        "mode" => mode as u128,
        _ => place,
    }
}

fn row_code(row: Row) -> (Mode, u128) {
    let vertex = |place: u128, part: u128| VERTICES | place << PART_BITS | part;
    match row {
        Row::Named(row) => (Mode::AsIs, row.into()),
        Row::Digits(table) => (Mode::Digits, table.into()),
        Row::Edge(table) => (Mode::Edge, table.into()),
        Row::Number(table) => (Mode::Number, table.into()),
        Row::Pass(table) => (Mode::Pass, table.into()),
        Row::OfChannel => (Mode::Vertex, vertex(3, VALUE)),
        Row::Vertex(corner, part) => {
            let part = match part {
                Part::X => 0,
                Part::Y => 1,
                Part::Value => VALUE,
            };
            match corner {
                Corner::Place(place) => (Mode::Vertex, vertex(place.into(), part)),
                Corner::Upper => (Mode::Upper, vertex(0, part)),
                Corner::Lower => (Mode::Lower, vertex(0, part)),
            }
        }
    }
}

fn base(base: Base) -> u128 {
    match base {
        Base::Nothing => 0,
        Base::Same => 1,
        Base::Twice => 2,
        Base::Masked => 3,
    }
}

fn only(only: Only) -> u128 {
    match only {
        Only::Always => 0,
        Only::Negative => 1,
        Only::Positive => 2,
        Only::NoUpper => 3,
        Only::Right => 4,
        Only::Thin => 5,
    }
}

fn jump(control: Control) -> Jump {
    match control {
        Control::Next => Jump::Next,
        Control::Words => Jump::Words,
        Control::Room => Jump::Room,
        Control::Settle => Jump::Settle,
        Control::Digits => Jump::Digits,
        Control::Again => Jump::Again,
        Control::Zeros(_) => Jump::Zeros,
        Control::More(_) => Jump::More,
        Control::Negative(_) => Jump::Negative,
        Control::Unfit(_) => Jump::Unfit,
        Control::NoUpper(_) => Jump::NoUpper,
        Control::NoLower(_) => Jump::NoLower,
        Control::Rounds(_) => Jump::Rounds,
        Control::Goto(_) => Jump::Goto,
        Control::Call(_) => Jump::Call,
        Control::Return => Jump::Return,
    }
}

/// What a word does besides, as a number; 0 does nothing.
fn act_code(act: Act) -> u128 {
    act_place(act) as u128 + 1
}

/// Place of an act in the list, from 0.
fn act_place(act: Act) -> usize {
    ACTS.iter().position(|(_, other)| *other == act).expect("the list has every act")
}
