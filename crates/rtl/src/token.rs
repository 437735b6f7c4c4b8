//! What travels on the channels: the fields of each token, said once for both ends of a channel.
//!
//! A channel `line` of fields `y`, `left` … is the ports `line_valid`, `line_ready`, `line_y`, `line_left` ….

use std::ops::Index;

use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};
use edgewalk_netlist::{Instance, Module, Reg, Signal};

/// Names of the four channels, in the order of the adder.
pub(crate) const CHANNELS: [&str; 4] = ["z", "r", "g", "b"];
/// Names of the three edges of a prim: 0–2, 0–1 and 1–2 in the order of the sorted vertices.
pub(crate) const EDGES: [&str; 3] = ["major", "minor1", "minor2"];

/// One field of a token.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub name: String,
    pub width: u32,
    /// Format and unit.
    pub doc: String,
}

fn field(name: impl Into<String>, width: u32, doc: impl Into<String>) -> Field {
    Field { name: name.into(), width, doc: doc.into() }
}

/// `UQ8.14 LSB mod 2^8`: an interpolated word.
pub(crate) fn word_format(channel: &Channel) -> String {
    format!("UQ{}.{} LSB, modular", channel.bits, channel.fraction)
}

/// The names of a channel's results of setup, without the channel's own name.
pub(crate) fn results(machine: &Plan) -> &'static [&'static str] {
    match machine.fill {
        Fill::Exact => &["start", "d0", "d1", "g"],
        Fill::Textbook => &["start_a", "d_a", "start_b", "d_b", "g"],
    }
}

fn result_doc(machine: &Plan, result: &str) -> &'static str {
    match (machine.fill, result) {
        (_, "start") => "at the first pixel of the first line",
        (_, "d0") => "to the next line, edge without carry",
        (_, "d1") => "to the next line, edge with carry",
        (_, "start_a") => "on the left edge, first line of part 1",
        (_, "d_a") => "to the next line, part 1",
        (_, "start_b") => "on the left edge, first line of part 2",
        (_, "d_b") => "to the next line, part 2",
        _ => "to the next pixel of the span",
    }
}

/// A vertex at the port; `place`, its number in the triangle, ends the names.
pub(crate) fn vertex(machine: &Plan, place: &str) -> Vec<Field> {
    let position = format!("Q{}.{} px", machine.guard_bits + 1, machine.subpixel_bits);
    let width = machine.widths().vertex;
    let mut fields =
        vec![field(format!("x{place}"), width, &position), field(format!("y{place}"), width, &position)];
    for (name, channel) in CHANNELS.into_iter().zip(machine.channels()) {
        let doc = format!("UQ{}.{} LSB", channel.bits, channel.vertex_fraction);
        fields.push(field(format!("{name}{place}"), channel.vertex_bits(), doc));
    }
    fields
}

/// The tag, if the machine has one.
pub(crate) fn tag(machine: &Plan) -> Option<Field> {
    (machine.tag_bits > 0).then(|| field("tag", machine.tag_bits, "of the triangle"))
}

/// A triangle at the port.
pub(crate) fn triangle(machine: &Plan) -> Vec<Field> {
    ["0", "1", "2"].into_iter().flat_map(|place| vertex(machine, place)).chain(tag(machine)).collect()
}

/// Bits of an edge's remainder, its step and its modulus.
pub(crate) fn remainder_bits(machine: &Plan) -> u32 {
    match machine.edge_kind {
        EdgeKind::Exact => machine.widths().difference - 1,
        EdgeKind::Slope => machine.edge_fraction,
    }
}

/// The state and step of one edge: C, R, q, f and, unless it is the constant 2^F, M.
pub(crate) fn edge(machine: &Plan) -> Vec<Field> {
    let (column, remainder) = (machine.widths().column, remainder_bits(machine));
    let unit = match machine.edge_kind {
        EdgeKind::Exact => "1/M column",
        EdgeKind::Slope => "2^-F column",
    };
    let mut fields = vec![
        field("c", column, "signed, first column right of the edge"),
        field("r", remainder, format!("distance from the edge to that column, {unit}")),
        field("q", column, "signed, whole columns a line"),
        field("f", remainder, format!("{unit} a line")),
    ];
    if machine.edge_kind == EdgeKind::Exact {
        fields.push(field("m", remainder, "modulus of r and f: the edge's height, 1/P line"));
    }
    fields
}

/// SETUP to EDGE: a triangle ready to be walked.
pub(crate) fn prim(machine: &Plan) -> Vec<Field> {
    let w = machine.widths();
    let mut fields = vec![
        field("jm", w.y, "first line"),
        field("n1", w.y + 1, "lines of the upper part"),
        field("n2", w.y + 1, "lines of the lower part"),
        field("left", 1, "the major edge is the right one"),
    ];
    for name in EDGES {
        fields.extend(edge(machine).into_iter().map(|f| field(format!("{name}_{}", f.name), f.width, f.doc)));
    }
    for (name, channel) in CHANNELS.into_iter().zip(machine.channels()) {
        for result in results(machine) {
            let doc = format!("{}, {}", word_format(channel), result_doc(machine, result));
            fields.push(field(format!("{name}_{result}"), channel.word(), doc));
        }
    }
    fields.extend(tag(machine));
    fields
}

/// The four interpolated words.
pub(crate) fn values(machine: &Plan) -> impl Iterator<Item = Field> {
    CHANNELS
        .into_iter()
        .zip(machine.channels())
        .map(|(name, channel)| field(name, channel.word(), word_format(channel)))
}

/// EDGE to SPAN: one line of a triangle.
pub(crate) fn line(machine: &Plan) -> Vec<Field> {
    let w = machine.widths();
    let mut fields = vec![
        field("y", w.y, "line"),
        field("cmaj", w.column, "signed, first column right of the major edge"),
        field("cmin", w.column, "signed, first column right of the minor edge"),
        field("left", 1, "the major edge is the right one"),
    ];
    fields.extend(values(machine));
    fields.extend([
        field("fresh", 1, "first line of the triangle"),
        field("fence", 1, "what is in flight may be of the same pixels"),
    ]);
    fields.extend(tag(machine));
    fields
}

/// SPAN to PIXEL: the pixels of a line.
pub(crate) fn span(machine: &Plan) -> Vec<Field> {
    let w = machine.widths();
    let mut fields = vec![
        field("x", w.column, "signed, first column"),
        field("y", w.y, "line"),
        field("count", w.column, "pixels, at least 1"),
        field("left", 1, "towards smaller columns"),
    ];
    fields.extend(values(machine));
    fields.extend([
        field("fresh", 1, "first span of the triangle: its increments are new"),
        field("fence", 1, "what is in flight may be of the same pixels"),
    ]);
    fields.extend(tag(machine));
    fields
}

/// The four output values.
pub(crate) fn outputs(machine: &Plan) -> impl Iterator<Item = Field> {
    CHANNELS
        .into_iter()
        .zip(machine.channels())
        .map(|(name, channel)| field(name, channel.bits, format!("unorm{}", channel.bits)))
}

fn address(machine: &Plan) -> Field {
    let w = machine.widths();
    field("addr", w.address, format!("line * 2^{} + column", w.x))
}

/// PIXEL to DEPTH: a fragment.
pub(crate) fn fragment(machine: &Plan) -> Vec<Field> {
    let mut fields = vec![address(machine)];
    fields.extend(outputs(machine));
    fields.push(field("fence", 1, "what is in flight may be of the same pixel"));
    fields.extend(tag(machine));
    fields
}

/// What DEPTH keeps of a fragment while its depth is read.
pub(crate) fn entry(machine: &Plan) -> Vec<Field> {
    std::iter::once(address(machine)).chain(outputs(machine)).chain(tag(machine)).collect()
}

/// DEPTH to the memories: one pixel.
pub(crate) fn write(machine: &Plan) -> Vec<Field> {
    let mut fields = entry(machine);
    fields.insert(2, field("z_en", 1, "the depth is written too"));
    fields
}

/// The signals of one token, by the names of its fields.
#[derive(Clone, Debug)]
pub(crate) struct Token<'m>(Vec<(Field, Signal<'m>)>);

impl<'m> Token<'m> {
    /// Input ports `<prefix>_<field>`.
    pub fn inputs(m: &'m Module, prefix: &str, fields: Vec<Field>) -> Token<'m> {
        let port = |f: Field| {
            let signal = m.input_doc(&format!("{prefix}_{}", f.name), f.width, &f.doc);
            (f, signal)
        };
        Token(fields.into_iter().map(port).collect())
    }

    /// The outputs `<prefix>_<field>` of an instance.
    pub fn of_instance(instance: Instance<'m>, prefix: &str, fields: Vec<Field>) -> Token<'m> {
        let output = |f: Field| {
            let signal = instance.output(&format!("{prefix}_{}", f.name));
            (f, signal)
        };
        Token(fields.into_iter().map(output).collect())
    }

    /// A token of these fields, each with the signal for its name.
    pub fn new(fields: Vec<Field>, signal: impl Fn(&str) -> Signal<'m>) -> Token<'m> {
        let pair = |f: Field| {
            let signal = signal(&f.name);
            (f, signal)
        };
        fields.into_iter().map(pair).collect()
    }

    /// Output ports `<prefix>_<field>`.
    pub fn output(&self, m: &'m Module, prefix: &str) {
        for (f, signal) in &self.0 {
            m.output_doc(&format!("{prefix}_{}", f.name), *signal, &f.doc);
        }
    }

    /// Drives the inputs `<prefix>_<field>` of an instance.
    pub fn connect(&self, instance: Instance<'m>, prefix: &str) {
        for (f, signal) in &self.0 {
            instance.connect(&format!("{prefix}_{}", f.name), *signal);
        }
    }

    /// The signal of a field that not every token has.
    pub fn get(&self, name: &str) -> Option<Signal<'m>> {
        self.0.iter().find(|(f, _)| f.name == name).map(|(_, signal)| *signal)
    }

    /// Its fields.
    pub fn fields(&self) -> Vec<Field> {
        self.0.iter().map(|(f, _)| f.clone()).collect()
    }
}

/// A token of these signals, each with its own width.
impl<'m> FromIterator<(Field, Signal<'m>)> for Token<'m> {
    fn from_iter<I: IntoIterator<Item = (Field, Signal<'m>)>>(pairs: I) -> Token<'m> {
        Token(pairs.into_iter().map(|(f, signal)| (Field { width: signal.width(), ..f }, signal)).collect())
    }
}

/// The signal of a field that the token has; which fields those are does not depend on any input but the functions above.
impl<'m> Index<&str> for Token<'m> {
    type Output = Signal<'m>;
    fn index(&self, name: &str) -> &Signal<'m> {
        let found = self.0.iter().find(|(f, _)| f.name == name);
        #[allow(clippy::expect_used)]
        let (_, signal) = found.expect("units ask only for fields that the functions above list");
        signal
    }
}

/// One register a field, `<prefix>_<field>`.
#[derive(Clone, Debug)]
pub(crate) struct Registers<'m>(Vec<(Field, Reg<'m>)>);

impl<'m> Registers<'m> {
    /// Registers without updates yet.
    pub fn new(m: &'m Module, prefix: &str, fields: Vec<Field>) -> Registers<'m> {
        let register = |f: Field| {
            let reg = m.reg(&format!("{prefix}_{}", f.name), f.width).doc(&f.doc);
            (f, reg)
        };
        Registers(fields.into_iter().map(register).collect())
    }

    /// All of them take the value of the field of their name.
    pub fn load(&self, when: Signal<'m>, value: impl Fn(&str) -> Signal<'m>) {
        for (f, reg) in &self.0 {
            reg.when(when, value(&f.name));
        }
    }

    /// Their values.
    pub fn token(&self) -> Token<'m> {
        Token(self.0.iter().map(|(f, reg)| (f.clone(), reg.q())).collect())
    }

    /// The register of a field that not every machine has.
    pub fn get(&self, name: &str) -> Option<Reg<'m>> {
        self.0.iter().find(|(f, _)| f.name == name).map(|(_, reg)| *reg)
    }
}

/// As for [`Token`].
impl<'m> Index<&str> for Registers<'m> {
    type Output = Reg<'m>;
    fn index(&self, name: &str) -> &Reg<'m> {
        let found = self.0.iter().find(|(f, _)| f.name == name);
        #[allow(clippy::expect_used)]
        let (_, register) = found.expect("units ask only for fields that the functions above list");
        register
    }
}
