//! The fields of every token, in their order.

use super::Field;
use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};

const CHANNELS: [&str; 4] = ["z", "r", "g", "b"];

fn field(port: impl Into<String>, width: u32, format: impl Into<String>) -> Field {
    Field { port: port.into(), width, signed: false, format: format.into() }
}

fn signed(port: impl Into<String>, width: u32, format: impl Into<String>) -> Field {
    Field { signed: true, ..field(port, width, format) }
}

fn tag_field(machine: &Plan, channel: &str) -> Option<Field> {
    (machine.tag_bits > 0).then(|| field(format!("{channel}_tag"), machine.tag_bits, "tag of the triangle"))
}

fn word_format(channel: &Channel) -> String {
    format!("UQ{}.{} LSB, modular", channel.bits, channel.fraction)
}

/// Z, R, G, B words as ports `<prefix>_<channel><suffix>`.
fn word_fields<'a>(machine: &'a Plan, prefix: &'a str, suffix: &'a str) -> impl Iterator<Item = Field> + 'a {
    let channels = machine.channels();
    CHANNELS.into_iter().zip(channels).map(move |(name, channel)| {
        field(format!("{prefix}_{name}{suffix}"), channel.word(), word_format(channel))
    })
}

/// The fields of `tri`: three vertices, then the tag.
pub(super) fn triangle_fields(machine: &Plan) -> Vec<Field> {
    let position = format!("Q{}.{} px", machine.guard_bits + 1, machine.subpixel_bits);
    let mut fields = Vec::new();
    for i in 0..3 {
        for axis in ["x", "y"] {
            fields.push(signed(format!("tri_{axis}{i}"), machine.widths().vertex, position.clone()));
        }
        for (name, channel) in CHANNELS.into_iter().zip(machine.channels()) {
            let format = format!("UQ{}.{} LSB", channel.bits, channel.vertex_fraction);
            fields.push(field(format!("tri_{name}{i}"), channel.vertex_bits(), format));
        }
    }
    fields.extend(tag_field(machine, "tri"));
    fields
}

/// Bits of an edge's R, f and M.
fn remainder_bits(machine: &Plan) -> u32 {
    match machine.edge_kind {
        EdgeKind::Exact => machine.widths().difference - 1,
        EdgeKind::Slope => machine.edge_fraction,
    }
}

/// The names of the channel results that SETUP gives.
fn results(machine: &Plan) -> &'static [&'static str] {
    match machine.fill {
        Fill::Exact => &["start", "d0", "d1", "g"],
        Fill::Textbook => &["start_a", "d_a", "start_b", "d_b", "g"],
    }
}

/// The fields of `prim`.
pub(super) fn prim_fields(machine: &Plan) -> Vec<Field> {
    let w = machine.widths();
    let mut fields = vec![
        field("prim_jm", w.y, "first drawn line"),
        field("prim_n1", w.y + 1, "lines of the upper part"),
        field("prim_n2", w.y + 1, "lines of the lower part"),
        field("prim_left", 1, "the major edge lies right"),
    ];
    for edge in ["major", "minor1", "minor2"] {
        let port = |name: &str| format!("prim_{edge}_{name}");
        let r = remainder_bits(machine);
        fields.push(signed(port("c"), w.column, "C, px"));
        fields.push(field(port("r"), r, "R, 1/M px"));
        fields.push(signed(port("q"), w.column, "q, px/line"));
        fields.push(field(port("f"), r, "f, 1/M px/line"));
        if machine.edge_kind == EdgeKind::Exact {
            fields.push(field(port("m"), r, "M"));
        }
    }
    for (name, channel) in CHANNELS.into_iter().zip(machine.channels()) {
        for result in results(machine) {
            fields.push(field(format!("prim_{name}_{result}"), channel.word(), word_format(channel)));
        }
    }
    fields.extend(tag_field(machine, "prim"));
    fields
}

/// The fields of `line`.
pub(super) fn line_fields(machine: &Plan) -> Vec<Field> {
    let w = machine.widths();
    let mut fields = vec![
        field("line_y", w.y, "line"),
        signed("line_cmaj", w.column, "column of the major edge, px"),
        signed("line_cmin", w.column, "column of the minor edge, px"),
        field("line_left", 1, "the major edge lies right"),
    ];
    fields.extend(word_fields(machine, "line", ""));
    fields.push(field("line_fresh", 1, "first line of the triangle"));
    fields.push(field("line_fence", 1, "first line of the triangle or of its lower part"));
    fields.extend(tag_field(machine, "line"));
    fields
}

/// The fields of `span`.
pub(super) fn span_fields(machine: &Plan) -> Vec<Field> {
    let w = machine.widths();
    let mut fields = vec![
        signed("span_x", w.column, "first column, px"),
        field("span_y", w.y, "line"),
        field("span_count", w.column, "pixels, at least 1"),
        field("span_left", 1, "runs to the left"),
    ];
    fields.extend(word_fields(machine, "span", ""));
    fields.push(field("span_fresh", 1, "first span of the triangle"));
    fields.push(field("span_fence", 1, "first span of the triangle or of its lower part"));
    fields.extend(tag_field(machine, "span"));
    fields
}

/// The gradients `inc_z` to `inc_b`, which stand beside a channel.
pub(super) fn gradient_fields(machine: &Plan) -> impl Iterator<Item = Field> + '_ {
    word_fields(machine, "inc", "")
}

/// The fields of the outputs z, r, g, b.
fn output_fields<'a>(machine: &'a Plan, prefix: &'a str) -> impl Iterator<Item = Field> + 'a {
    CHANNELS.into_iter().zip(machine.channels()).map(move |(name, channel)| {
        field(format!("{prefix}_{name}"), channel.bits, format!("unorm{}", channel.bits))
    })
}

fn address_field(machine: &Plan, prefix: &str) -> Field {
    let w = machine.widths();
    field(format!("{prefix}_addr"), w.address, format!("line * 2^{} + column", w.x))
}

/// The fields of `frag`.
pub(super) fn fragment_fields(machine: &Plan) -> Vec<Field> {
    let mut fields = vec![address_field(machine, "frag")];
    fields.extend(output_fields(machine, "frag"));
    fields.push(field("frag_fence", 1, "first fragment of the triangle or of its lower part"));
    fields.extend(tag_field(machine, "frag"));
    fields
}

/// The fields of `rd`.
pub(super) fn read_fields(machine: &Plan) -> Vec<Field> {
    vec![address_field(machine, "rd")]
}

/// The fields of `data`.
pub(super) fn data_fields(machine: &Plan) -> Vec<Field> {
    vec![field("data_z", machine.z.bits, format!("unorm{}", machine.z.bits))]
}

/// The fields of `wr`.
pub(super) fn write_fields(machine: &Plan) -> Vec<Field> {
    let mut fields = vec![address_field(machine, "wr")];
    fields.extend(output_fields(machine, "wr"));
    fields.insert(2, field("wr_z_en", 1, "the depth is stored"));
    fields.extend(tag_field(machine, "wr"));
    fields
}
