//! What a word of SETUP's program says, as parts with names. What each part does is written in `docs/machine.md`, and
//! twice in code: in the slow model, and in the assembler and the datapath of the rtl.

/// A word of the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// The word's line of the listing, without comment and label.
    pub text: String,
    /// The step of A and W; none: both stay.
    pub step: Option<Step>,
    /// The factor that is loaded from a row's A.
    pub factor: Option<(Factor, Row)>,
    /// The row that A and W are written to.
    pub write: Option<Write>,
    /// The result that leaves.
    pub give: Option<Give>,
    /// Which word comes next.
    pub control: Control,
    /// What else is done.
    pub act: Option<Act>,
}

/// A and W := base, and plus or minus an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// What the operand is added to.
    pub base: Base,
    /// The row that is the operand.
    pub row: Row,
    /// What is made of it.
    pub operand: Operand,
    /// Whether it is added or subtracted.
    pub sign: Sign,
    /// When the step is done.
    pub only: Only,
}

/// What the operand is added to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// 0.
    Nothing,
    /// A and W.
    Same,
    /// Twice A and W.
    Twice,
    /// A with its low t bits 0, and W.
    Masked,
}

/// What is added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// The row: its A to A, its W to W.
    Row,
    /// To A the low bits of W, signed, to W the row's W; with slope edges of W / 2^(F+1), rounded down.
    Whole,
    /// To A the row's A, to W the row's W and 2^(t+r-e) times the row's A.
    Raised,
}

/// Whether the operand is added or subtracted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Added.
    Plus,
    /// Subtracted.
    Minus,
    /// A modulus: A - M and W + 1 if A >= 0, else A + M and W - 1; A is that before the step.
    ByA,
    /// Added, but subtracted if `major_right`.
    PlusBySide,
    /// Subtracted, but added if `major_right`.
    MinusBySide,
}

/// When a step is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Only {
    /// Always.
    Always,
    /// If A < 0 before it.
    Negative,
    /// If A >= 0 before it.
    Positive,
    /// If the upper part has no line.
    NoUpper,
    /// If `major_right`.
    Right,
    /// If it is a line.
    Thin,
}

/// Which row is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// The row of this number.
    Named(u8),
    /// Of the table that begins here: the row of the digits of f and g, 2 f + g.
    Digits(u8),
    /// Of the table that begins here: the row of the lane's edge.
    Edge(u8),
    /// Of the table that begins here: the row of the number of the round, or of the edge.
    Number(u8),
    /// Of the two that begin here: that of the picture, or of the map. Height and width change places for a flat line.
    Pass(u8),
    /// A word of a vertex.
    Vertex(Corner, Part),
    /// What the channel adds to its first value: in W P/2 + half P.
    OfChannel,
}

/// Which vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// The vertex at this place of the order so far.
    Place(u8),
    /// The upper end of the edge.
    Upper,
    /// The lower end of the edge.
    Lower,
}

/// Which word of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// x of the port, as a centre coordinate: 1/2^t px, with t fraction bits.
    X,
    /// y of the port, as a centre coordinate: 1/2^t px, with t fraction bits.
    Y,
    /// The value of the lane's channel of the round.
    Value,
}

/// A factor of a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// The factor of the table's third row.
    F,
    /// The factor of the table's second row; behind it the leading digits of both are skipped.
    G,
}

/// Where A and W are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Write {
    /// The row, or the first of a table.
    pub row: u8,
    /// A only.
    pub only_a: bool,
    /// Of the table the row of the number.
    pub numbered: bool,
}

/// The results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Give {
    /// First line: A / P.
    Jm,
    /// Lines of the upper part: A / P.
    N1,
    /// Lines of the lower part: A / P.
    N2,
    /// M of the edge: A.
    M,
    /// q and f of the edge: W, and A / P; of a slope edge W / 2^(F+1), and W / 2 mod 2^F.
    Qf,
    /// R of the edge: A / P; of a slope edge W / 2 mod 2^F.
    R,
    /// C of the edge: A / P.
    C,
    /// First value of the channel: W / P; in textbook fill that of the upper part.
    Start,
    /// W / 2; in textbook fill the upper part's step.
    D0,
    /// W / 2; in textbook fill the lower part's step.
    D1,
    /// W / 2.
    G,
    /// First value of the channel in the lower part, in textbook fill: W / P.
    StartB,
}

/// Which word comes next: the one behind, or the one at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// The one behind.
    Next,
    /// The same until a triangle is there.
    Words,
    /// The same until no prim waits any more.
    Room,
    /// The same until no leading digit is left to skip.
    Settle,
    /// The same for each digit that is left.
    Digits,
    /// The same as often as the counter says.
    Again,
    /// While both digits are 0 the same with the next digits; behind the last of them that place.
    Zeros(u16),
    /// The digits are done; that place while there are more.
    More(u16),
    /// The named place if A < 0.
    Negative(u16),
    /// The named place if a checked number does not fit.
    Unfit(u16),
    /// The named place if the upper part has no line.
    NoUpper(u16),
    /// The named place if the lower part has no line.
    NoLower(u16),
    /// The named place for the number before, if there is one.
    Rounds(u16),
    /// The named place.
    Goto(u16),
    /// The named place, until `Return`.
    Call(u16),
    /// The one behind the call.
    Return,
}

impl Control {
    /// The place that it names.
    #[must_use]
    pub fn place(self) -> Option<u16> {
        use Control::*;
        match self {
            Zeros(at) | More(at) | Negative(at) | Unfit(at) | NoUpper(at) | NoLower(at) | Rounds(at)
            | Goto(at) | Call(at) => Some(at),
            Next | Words | Room | Settle | Digits | Again | Return => None,
        }
    }
}

/// All that a word can do besides, by the names of the listing. The place of an act is its number in the ROM, less one.
pub const ACTS: [(&str, Act); 24] = [
    ("unsorted", Act::Unsorted),
    ("swap01", Act::Swap01),
    ("swap12", Act::Swap12),
    ("side", Act::Side),
    ("upper", Act::Upper),
    ("lower", Act::Lower),
    ("shift", Act::Shift),
    ("judge", Act::Judge),
    ("check", Act::Check),
    ("times t", Act::TimesT),
    ("times k", Act::TimesK),
    ("scale", Act::Scale),
    ("last round", Act::LastRound),
    ("edge0", Act::Edge(0)),
    ("edge1", Act::Edge(1)),
    ("edge2", Act::Edge(2)),
    ("beside", Act::Beside),
    ("alone", Act::Alone),
    ("drop lines", Act::Drop(Drop::Lines)),
    ("drop columns", Act::Drop(Drop::Columns)),
    ("drop area", Act::Drop(Drop::Area)),
    ("done", Act::Done),
    ("times f", Act::TimesF),
    ("times tf", Act::TimesTf),
];

/// What else is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Act {
    /// The order of the vertices is that of the port.
    Unsorted,
    /// The vertices at places 0 and 1 change places if A < 0.
    Swap01,
    /// The vertices at places 1 and 2 change places if A < 0.
    Swap12,
    /// `major_right` := A < 0.
    Side,
    /// The upper part has lines unless A < 0.
    Upper,
    /// The lower part has lines unless A < 0.
    Lower,
    /// The digits of f and g are the next ones.
    Shift,
    /// No number has been found not to fit.
    Judge,
    /// If the step, by M, leaves the sign of A, the number before it does not fit.
    Check,
    /// The counter := t.
    TimesT,
    /// The counter := F.
    TimesF,
    /// The counter := t + F.
    TimesTf,
    /// The counter := t + r - e of the round, and i.
    TimesK,
    /// i := i + 3.
    Scale,
    /// The last round begins, and i := 0.
    LastRound,
    /// The edge is this one of major, first and second minor edge.
    Edge(u8),
    /// Each of the first three lanes has an edge of its own; the number is 0.
    Beside,
    /// All lanes have the same rows and digits again.
    Alone,
    /// The triangle is culled.
    Drop(Drop),
    /// The prim is there.
    Done,
}

/// Why a triangle is culled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drop {
    /// No line.
    Lines,
    /// No column.
    Columns,
    /// No area.
    Area,
}
