//! What is to be seen of the machine in a cycle, for a recording: each unit's registers, queues, conditions and sentences,
//! declared where they are read.
//!
//! ```text
//!  unit/view.rs ──name, shape, value──> View ─┬─ the first cycle: what there is, `Structure`
//!                                             └─ every cycle: a value a register, tokens by number
//! ```
//! A unit names its registers in one function, always all of them and in the same order; so what is declared and what is
//! recorded cannot fall apart. Values are those *during* the cycle, before the clock edge. A machine that nobody looks at
//! pays nothing: no unit keeps anything for it.

mod structure;
mod tokens;
mod walk;
pub(crate) mod fragments;

pub use structure::{
    Field, Id, Item, LinkView, Mark, Moment, Register, Row, Sentence, Shape, Store, Structure, Table,
    UnitView,
};
pub use tokens::{Kind, Tokens};

use edgewalk_machine::{Activity, Channel, Plan};

/// The machine as it stands in one cycle after the other.
#[derive(Clone, Debug, Default)]
pub struct View {
    structure: Structure,
    /// The structure is complete: one cycle has been seen.
    declared: bool,
    values: Vec<u64>,
    tokens: Tokens,
    live: Option<Id>,
    /// The map is drawn in this cycle, not the picture.
    of_map: bool,
}

impl View {
    /// Nothing seen yet.
    #[must_use]
    pub fn new() -> View {
        View::default()
    }

    /// As [`View::new`], but of tokens only the least and greatest value of each field is kept.
    pub(crate) fn of_ranges() -> View {
        View { tokens: Tokens::of_ranges(), ..View::default() }
    }

    /// What there is to be seen; complete after the first cycle.
    #[must_use]
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// The value of every register in the cycle seen last, modulo 2^bits.
    #[must_use]
    pub fn values(&self) -> &[u64] {
        &self.values
    }

    /// Every token met so far.
    #[must_use]
    pub fn tokens(&self) -> &Tokens {
        &self.tokens
    }

    /// A new cycle begins, in which the picture is drawn or, with `of_map`, the map.
    pub(crate) fn begin(&mut self, of_map: bool) {
        self.of_map = of_map;
        self.declared = !self.values.is_empty();
        self.values.clear();
        self.live = None;
    }

    /// The registers that follow are those of the unit of this name.
    pub(crate) fn unit(&mut self, plan: &Plan, name: &str) {
        self.live = None;
        if !self.declared {
            let spec = plan.units().find(|spec| spec.name == name);
            let (title, section) = (name.to_uppercase(), spec.map_or(0, |spec| spec.section));
            let does = spec.map_or_else(String::new, |spec| spec.purpose.to_owned());
            self.structure.units.push(UnitView::new(name, title, section, does));
        }
    }

    fn push(&mut self, value: u64, register: impl FnOnce() -> Register) -> Id {
        let id = self.values.len();
        self.values.push(value);
        if !self.declared {
            self.structure.registers.push(Register { live: self.live, ..register() });
        }
        id
    }

    fn of_unit(&mut self, change: impl FnOnce(&mut UnitView)) {
        if !self.declared
            && let Some(unit) = self.structure.units.last_mut()
        {
            change(unit);
        }
    }

    /// Of a register of any shape; shown on the unit's card where it stands.
    fn item(&mut self, name: &str, doc: &str, shape: impl FnOnce() -> Shape, value: u64) -> Id {
        let id = self.push(value, || Register::new(name, doc, shape()));
        self.of_unit(|unit| unit.items.push(Item::Register(id)));
        id
    }

    /// The registers that follow mean something only while this flag is up; `None`: always.
    pub(crate) fn live(&mut self, flag: Option<Id>) {
        self.live = flag;
    }

    /// The register just named is this signal of the unit's netlist, or, of a token, these signals: name and `_` before
    /// that of each field.
    pub(crate) fn wire(&mut self, name: impl FnOnce() -> String) {
        if !self.declared
            && let (Some(register), Some(unit)) =
                (self.structure.registers.last_mut(), self.structure.units.last())
        {
            register.wire = Some(format!("u_{}.{}", unit.name, name()));
        }
    }

    /// One bit.
    pub(crate) fn flag(&mut self, name: &str, doc: &str, value: bool) -> Id {
        self.item(name, doc, || Shape::Flag, value.into())
    }

    /// A flag that only says whether others mean something; not on the card.
    pub(crate) fn guard(&mut self, name: &str, doc: &str, value: bool) -> Id {
        self.push(value.into(), || Register::new(name, doc, Shape::Flag))
    }

    /// A whole number without sign.
    pub(crate) fn number(&mut self, name: &str, doc: &str, bits: u32, value: impl Into<u64>) -> Id {
        self.item(name, doc, || Shape::whole(bits), value.into())
    }

    /// A whole number in two's complement.
    pub(crate) fn signed(&mut self, name: &str, doc: &str, bits: u32, value: i64) -> Id {
        self.item(name, doc, || Shape::signed(bits), modulo(value, bits))
    }

    /// One of some words.
    pub(crate) fn code(&mut self, name: &str, doc: &str, words: &'static [&'static str], value: usize) -> Id {
        self.item(name, doc, || Shape::Code(words), value as u64)
    }

    /// A token beside the card, for sentences and moments, or none: its triangle and its values, which are kept once in
    /// the table of its kind.
    pub(crate) fn aside(&mut self, name: &str, doc: &str, kind: &str, token: Option<(u32, &[u64])>) -> Id {
        let (number, place) = (self.tokens.number(kind, token, self.of_map), self.tokens.place(kind));
        let id = self.push(number, || Register::new(name, doc, Shape::Token(place)));
        self.of_unit(|unit| unit.aside.push(id));
        id
    }

    /// Declares a kind of token.
    pub(crate) fn kind(&mut self, name: &str, title: &str, fields: impl FnOnce() -> Vec<Field>) {
        self.tokens.declare(name, title, fields);
    }

    /// Not hardware: the triangle that the unit works on.
    pub(crate) fn triangle(&mut self, triangle: Option<u32>) -> Id {
        let number = triangle.map_or(0, |id| u64::from(id) + 1);
        let id = self.push(number, || Register::new("triangle", "that the unit works on", Shape::Triangle));
        self.of_unit(|unit| unit.triangle = Some(id));
        id
    }

    /// A table of registers; [`View::row`] and [`View::cell`] fill it. A folded one opens on demand.
    pub(crate) fn table(&mut self, title: &str, columns: &[&str], folded: bool) {
        self.of_unit(|unit| {
            let columns = columns.iter().map(|column| (*column).to_owned()).collect();
            unit.items.push(Item::Table(Table {
                title: title.to_owned(),
                columns,
                rows: Vec::new(),
                folded,
            }));
        });
    }

    /// The next row of the table.
    pub(crate) fn row(&mut self, name: &str) {
        self.of_unit(|unit| {
            if let Some(Item::Table(table)) = unit.items.last_mut() {
                table.rows.push(Row { name: name.to_owned(), cells: Vec::new() });
            }
        });
    }

    /// The next cell of the row; its register is called `row.column`.
    pub(crate) fn cell(&mut self, doc: &str, shape: impl FnOnce() -> Shape, value: u64) -> Id {
        let name = if self.declared { String::new() } else { self.structure.next_cell() };
        let id = self.push(value, || Register::new(&name, doc, shape()));
        self.of_unit(|unit| unit.add_cell(id));
        id
    }

    /// A cell that holds a token.
    pub(crate) fn token_cell(&mut self, doc: &str, kind: &str, token: Option<(u32, &[u64])>) -> Id {
        let (number, place) = (self.tokens.number(kind, token, self.of_map), self.tokens.place(kind));
        self.cell(doc, || Shape::Token(place), number)
    }

    /// The unit's line among the lanes: a number, and whether the unit has work.
    pub(crate) fn lane(&mut self, number: Id, works: bool) {
        let id = self.push(works.into(), || Register::new("works", "the unit has work", Shape::Flag));
        self.of_unit(|unit| (unit.lane, unit.works) = (Some(number), Some(id)));
    }

    /// A register whose change is worth a look of its own: cycles over which it changes are not folded.
    pub(crate) fn phase(&mut self, id: Id) {
        self.of_unit(|unit| unit.phase = Some(id));
    }

    /// A row of jobs, one after the other: which one it is, while the flag is up.
    pub(crate) fn schedule(&mut self, job: Id, during: Id) {
        self.of_unit(|unit| unit.items.push(Item::Schedule { job, during }));
    }

    /// What the model does not say about the unit.
    pub(crate) fn note(&mut self, text: &str) {
        self.of_unit(|unit| unit.notes.push(text.to_owned()));
    }

    /// A sentence about the cycle, where it holds; `{name}` stands for a register of the unit, `{name.field}` for a field
    /// of a token.
    pub(crate) fn says(&mut self, when: bool, text: &str) {
        let id = self.push(when.into(), || Register::new("says", "a sentence holds", Shape::Flag));
        self.of_unit(|unit| unit.says.push(Sentence { when: id, text: text.to_owned() }));
    }

    /// A link on which the unit gives tokens, to the unit of that name or out of the machine.
    pub(crate) fn gives(&mut self, name: &str, to: Option<&str>, valid: bool, ready: bool) {
        self.link(name, to, valid, ready, true);
    }

    /// A link on which tokens come from outside the machine.
    pub(crate) fn takes(&mut self, name: &str, valid: bool, ready: bool) {
        self.link(name, None, valid, ready, false);
    }

    fn link(&mut self, name: &str, other: Option<&str>, valid: bool, ready: bool, gives: bool) {
        let flag = |end: &str| Register::new(&format!("{name}_{end}"), "", Shape::Flag);
        let valid = self.push(valid.into(), || flag("valid"));
        self.wire(|| format!("{name}_valid"));
        // Whether a token can be taken may depend on the token.
        let live = self.live.replace(valid);
        let ready = self.push(ready.into(), || flag("ready"));
        self.wire(|| format!("{name}_ready"));
        self.live = live;
        if self.declared {
            return;
        }
        let own = self.structure.units.last().map(|unit| unit.name.clone());
        let other = other.map(str::to_owned);
        let (from, to) = if gives { (own, other) } else { (other, own) };
        self.structure.links.push(LinkView { name: name.to_owned(), from, to, valid, ready, step: None });
    }

    /// To go from token to token of the link just named: the word for it, and its key.
    pub(crate) fn step(&mut self, name: &'static str, key: char) {
        if !self.declared
            && let Some(link) = self.structure.links.last_mut()
        {
            link.step = Some((name, key));
        }
    }

    /// Colours are written here.
    pub(crate) fn stores_color(&mut self, when: Id, fragment: Id) {
        self.structure.color = Some(Store { when, fragment, enable: None });
    }

    /// Depths are written here.
    pub(crate) fn stores_depth(&mut self, when: Id, fragment: Id, enable: Option<Id>) {
        self.structure.depth = Some(Store { when, fragment, enable });
    }

    /// A place on the screen at which the unit is, to be marked in the picture.
    pub(crate) fn mark(&mut self, x: Id, y: Id) {
        self.of_unit(|unit| unit.marks.push(Mark { x: Some(x), y }));
    }

    /// A line of the screen at which the unit is.
    pub(crate) fn band(&mut self, y: Id) {
        self.of_unit(|unit| unit.marks.push(Mark { x: None, y }));
    }

    /// Something that happens to a token where `when` holds, for the history of its pixel; what is to be told beside it.
    pub(crate) fn moment(&mut self, title: &str, when: bool, token: Id, tells: &[Id]) -> Id {
        let id = self.push(when.into(), || Register::new("happens", title, Shape::Flag));
        self.of_unit(|unit| {
            let tells = tells.to_vec();
            unit.moments.push(Moment { title: title.to_owned(), when: id, token, tells });
        });
        id
    }

    /// Which of the two pages the machine draws: the picture, or the map.
    pub(crate) fn pages(&mut self) {
        self.live = None;
        let flag = |name, doc| move || Register::new(name, doc, Shape::Flag);
        let picture = self.push((!self.of_map).into(), flag("of_picture", "the picture is drawn"));
        let map = self.push(self.of_map.into(), flag("of_map", "the map of a light is drawn"));
        self.structure.pages = Some([picture, map]);
    }

    /// The cause of the cycle.
    pub(crate) fn cause(&mut self, activity: Activity) {
        self.live = None;
        let names = || Shape::Code(&CAUSES);
        let id = self.push(activity as u64, || Register::new("cause", "of the cycle", names()));
        if !self.declared {
            self.structure.cause = id;
        }
    }
}

const CAUSES: [&str; Activity::ALL.len()] = {
    let mut names = [""; Activity::ALL.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = Activity::ALL[i].name();
        i += 1;
    }
    names
};

/// The low `bits` bits of a signed number.
pub(crate) fn modulo(value: i64, bits: u32) -> u64 {
    value as u64 & (u64::MAX >> (64 - bits))
}

/// The interpolated word of a channel.
pub(crate) fn word(channel: &Channel) -> Shape {
    Shape::Number {
        bits: channel.word(),
        fraction: channel.fraction,
        signed: channel.kind.is_signed(),
        modular: true,
    }
}

/// An increment of a channel: the same word, but read as a signed number.
pub(crate) fn increment(channel: &Channel) -> Shape {
    Shape::Number { bits: channel.word(), fraction: channel.fraction, signed: true, modular: true }
}

/// The output of a channel.
pub(crate) fn output(channel: &Channel) -> Shape {
    Shape::Number { bits: channel.bits, fraction: 0, signed: channel.kind.is_signed(), modular: false }
}
