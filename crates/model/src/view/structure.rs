//! What there is to be seen: units with their registers, links between them, what is said and shown of them.

/// Number of a register: its place among the values of a cycle.
pub type Id = usize;

/// How the bits of a register are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One bit.
    Flag,
    /// A number of so many bits, `fraction` of them behind the point.
    Number {
        /// 1 to 64.
        bits: u32,
        /// Behind the point.
        fraction: u32,
        /// Two's complement.
        signed: bool,
        /// Modulo the range of its format.
        modular: bool,
    },
    /// The place of one of these words.
    Code(&'static [&'static str]),
    /// A pixel, `y·2^x_bits + x`.
    Pixel {
        /// Bits of the column.
        x_bits: u32,
        /// Bits of the address.
        bits: u32,
        /// In a machine that draws its map: bits of the column of a pixel of the map. One bit more is recorded above
        /// the address; it is 1 for a pixel of the map.
        of_map: Option<u32>,
    },
    /// Number of a triangle in the order of arrival, and 1 more; 0: none.
    Triangle,
    /// Number of a token in the table of its kind, from 1; 0: none.
    Token(usize),
}

impl Shape {
    /// A whole number.
    #[must_use]
    pub const fn whole(bits: u32) -> Shape {
        Shape::Number { bits, fraction: 0, signed: false, modular: false }
    }

    /// A whole number in two's complement.
    #[must_use]
    pub const fn signed(bits: u32) -> Shape {
        Shape::Number { bits, fraction: 0, signed: true, modular: false }
    }

    /// The number that these bits stand for; one without sign of more than 63 bits as its low 63.
    #[must_use]
    pub(crate) fn value(self, bits_of: u64) -> i64 {
        match self {
            Shape::Number { bits, signed: true, .. } if bits < 64 => {
                let shift = 64 - bits;
                (bits_of << shift) as i64 >> shift
            }
            Shape::Number { signed: true, .. } => bits_of as i64,
            _ => (bits_of & (u64::MAX >> 1)) as i64,
        }
    }

    /// Bits that are recorded.
    #[must_use]
    pub const fn bits(self) -> u32 {
        match self {
            Shape::Flag => 1,
            Shape::Number { bits, .. } => bits,
            Shape::Pixel { bits, of_map, .. } => bits + of_map.is_some() as u32,
            Shape::Code(words) => usize::BITS - words.len().leading_zeros(),
            Shape::Triangle | Shape::Token(_) => 32,
        }
    }
}

/// One register.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Register {
    /// Name in the unit.
    pub name: String,
    /// What it holds.
    pub doc: String,
    /// How it is read.
    pub shape: Shape,
    /// The flag while which it means something; `None`: always.
    pub live: Option<Id>,
    /// The signal of the machine's netlist that is the same; of a token the name before its fields'.
    pub wire: Option<String>,
}

impl Register {
    pub(super) fn new(name: &str, doc: &str, shape: Shape) -> Register {
        Register { name: name.to_owned(), doc: doc.to_owned(), shape, live: None, wire: None }
    }
}

/// A field of a token.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name of the field.
    pub name: &'static str,
    /// How it is read.
    pub shape: Shape,
    /// Shown where there is little room; the others on demand.
    pub brief: bool,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// What stands before it.
    pub name: String,
    /// A register a column.
    pub cells: Vec<Id>,
}

/// Registers in rows and columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// What stands above it.
    pub title: String,
    /// What stands above each column; of one of tokens what it is.
    pub columns: Vec<String>,
    /// In order.
    pub rows: Vec<Row>,
    /// Shown on demand.
    pub folded: bool,
}

/// What stands on a unit's card.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Item {
    /// One register.
    Register(Id),
    /// Some in a table.
    Table(Table),
    /// The jobs of a piece of work in their true proportion.
    Schedule {
        /// Which job it is.
        job: Id,
        /// While this flag is up.
        during: Id,
    },
}

/// A sentence that may hold of a cycle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sentence {
    /// The flag that says whether.
    pub when: Id,
    /// Words of the sentence; `{name}` stands for a register of the unit, `{name.field}` for a field of a token.
    pub text: String,
}

/// Something that happens to a token.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Moment {
    /// In a word.
    pub title: String,
    /// Flag: the moment happens in this cycle.
    pub when: Id,
    /// The token.
    pub token: Id,
    /// What is told beside it.
    pub tells: Vec<Id>,
}

/// Where a unit is on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    /// The column; `None`: the whole line.
    pub x: Option<Id>,
    /// The line.
    pub y: Id,
}

/// A unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitView {
    /// Name in files and modules.
    pub name: String,
    /// What stands on its card.
    pub title: String,
    /// Section of `docs/machine.md`.
    pub section: u32,
    /// What it does.
    pub does: String,
    /// Items of the unit's card.
    pub items: Vec<Item>,
    /// Registers beside the card, that sentences name.
    pub aside: Vec<Id>,
    /// What the model does not say.
    pub notes: Vec<String>,
    /// The triangle it works on.
    pub triangle: Option<Id>,
    /// The number in its lane.
    pub lane: Option<Id>,
    /// Flag: the unit has work.
    pub works: Option<Id>,
    /// A register whose changes are not folded away.
    pub phase: Option<Id>,
    /// Sentences.
    pub says: Vec<Sentence>,
    /// What happens to tokens.
    pub moments: Vec<Moment>,
    /// Where it is on the screen.
    pub marks: Vec<Mark>,
}

impl UnitView {
    pub(super) fn new(name: &str, title: String, section: u32, does: String) -> UnitView {
        UnitView {
            name: name.to_owned(),
            title,
            section,
            does,
            items: Vec::new(),
            aside: Vec::new(),
            notes: Vec::new(),
            triangle: None,
            lane: None,
            works: None,
            phase: None,
            says: Vec::new(),
            moments: Vec::new(),
            marks: Vec::new(),
        }
    }

    pub(super) fn add_cell(&mut self, cell: Id) {
        if let Some(Item::Table(table)) = self.items.last_mut()
            && let Some(row) = table.rows.last_mut()
        {
            row.cells.push(cell);
        }
    }
}

/// A valid/ready link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkView {
    /// Name of the link.
    pub name: String,
    /// The unit that gives; `None`: from outside.
    pub from: Option<String>,
    /// The unit that takes; `None`: out of the machine.
    pub to: Option<String>,
    /// A token is there.
    pub valid: Id,
    /// Flag: the token is taken.
    pub ready: Id,
    /// To go from token to token: the word for it, and its key.
    pub step: Option<(&'static str, char)>,
}

/// How a memory comes to what it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Store {
    /// A fragment is written in this cycle; memory shows it from the next on.
    pub when: Id,
    /// Which.
    pub fragment: Id,
    /// Only if this flag is up; `None`: always.
    pub enable: Option<Id>,
}

/// All there is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Structure {
    /// The units, in the order the data flows.
    pub units: Vec<UnitView>,
    /// Links.
    pub links: Vec<LinkView>,
    /// Registers by [`Id`].
    pub registers: Vec<Register>,
    /// The cause of the cycle.
    pub cause: Id,
    /// What is written to the colour memory.
    pub color: Option<Store>,
    /// What is written to the depth memory.
    pub depth: Option<Store>,
    /// In a machine that draws its map the flags that are up while the picture, and while the map is drawn.
    pub pages: Option<[Id; 2]>,
}

impl Structure {
    /// `row.column` of the cell that comes next.
    pub(super) fn next_cell(&self) -> String {
        let Some(Item::Table(table)) = self.units.last().and_then(|unit| unit.items.last()) else {
            return String::new();
        };
        let Some(row) = table.rows.last() else { return String::new() };
        let column = table.columns.get(row.cells.len()).map_or("", String::as_str);
        format!("{}.{column}", row.name)
    }

    /// The unit of that name.
    #[must_use]
    pub fn unit(&self, name: &str) -> Option<&UnitView> {
        self.units.iter().find(|unit| unit.name == name)
    }
}
