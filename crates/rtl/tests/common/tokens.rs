//! The model's tokens as the ports of the netlist: names and values.

use edgewalk_machine::{EdgeKind, Fill, Plan, PortVertex};
use edgewalk_model::Write;
use edgewalk_model::tokens::{EdgeWalk, Fragment, Line, Prim, Rgb, Span, Words};

/// A port's name, after the channel's, and what the model has there.
pub type Field = (&'static str, i128);

const CHANNELS: [&str; 4] = ["z", "r", "g", "b"];
const EDGES: [[&str; 5]; 3] = [
    ["major_c", "major_r", "major_q", "major_f", "major_m"],
    ["minor1_c", "minor1_r", "minor1_q", "minor1_f", "minor1_m"],
    ["minor2_c", "minor2_r", "minor2_q", "minor2_f", "minor2_m"],
];
const EXACT: [[&str; 4]; 4] = [
    ["z_start", "z_d0", "z_d1", "z_g"],
    ["r_start", "r_d0", "r_d1", "r_g"],
    ["g_start", "g_d0", "g_d1", "g_g"],
    ["b_start", "b_d0", "b_d1", "b_g"],
];
const TEXTBOOK: [[&str; 5]; 4] = [
    ["z_start_a", "z_d_a", "z_start_b", "z_d_b", "z_g"],
    ["r_start_a", "r_d_a", "r_start_b", "r_d_b", "r_g"],
    ["g_start_a", "g_d_a", "g_start_b", "g_d_b", "g_g"],
    ["b_start_a", "b_d_a", "b_start_b", "b_d_b", "b_g"],
];
const VERTICES: [[&str; 6]; 3] = [
    ["x0", "y0", "z0", "r0", "g0", "b0"],
    ["x1", "y1", "z1", "r1", "g1", "b1"],
    ["x2", "y2", "z2", "r2", "g2", "b2"],
];

/// Z, R, G and B of a pixel.
fn outputs(z: u32, rgb: Rgb) -> impl Iterator<Item = Field> {
    let [r, g, b] = rgb.channels();
    CHANNELS.into_iter().zip([z.into(), r.into(), g.into(), b.into()])
}

fn words(values: &Words) -> impl Iterator<Item = Field> {
    CHANNELS.into_iter().zip(values.map(i128::from))
}

fn tag(machine: &Plan, tag: u32) -> Option<Field> {
    (machine.tag_bits > 0).then_some(("tag", tag.into()))
}

/// A triangle at the machine's port.
pub fn triangle(machine: &Plan, vertices: &[PortVertex; 3], number: u32) -> Vec<Field> {
    let vertex = |(names, v): ([&'static str; 6], &PortVertex)| {
        let values = [v.x.into(), v.y.into()].into_iter().chain(v.value.map(i128::from));
        names.into_iter().zip(values).collect::<Vec<Field>>()
    };
    VERTICES.into_iter().zip(vertices).flat_map(vertex).chain(tag(machine, number)).collect()
}

/// What setup found. The modulus of a slope edge is the constant 2^F, no port.
pub fn prim(machine: &Plan, prim: &Prim) -> Vec<Field> {
    let mut fields: Vec<Field> = vec![
        ("jm", prim.line.into()),
        ("n1", prim.lines[0].into()),
        ("n2", prim.lines[1].into()),
        ("left", prim.left.into()),
    ];
    for (names, edge) in EDGES.into_iter().zip([prim.major, prim.minor[0], prim.minor[1]]) {
        let EdgeWalk { c, r, q, f, m } = edge;
        let ports = if machine.edge_kind == EdgeKind::Exact { 5 } else { 4 };
        fields.extend(names.into_iter().zip([c, r, q, f, m].map(i128::from)).take(ports));
    }
    let Prim { start, delta, gradient, .. } = prim;
    for c in 0..4 {
        let exact = [start[0][c], delta[0][c], delta[1][c], gradient[c]].map(i128::from);
        let textbook = [start[0][c], delta[0][c], start[1][c], delta[1][c], gradient[c]].map(i128::from);
        match machine.fill {
            Fill::Exact => fields.extend(EXACT[c].into_iter().zip(exact)),
            Fill::Textbook => fields.extend(TEXTBOOK[c].into_iter().zip(textbook)),
        }
    }
    fields.extend(tag(machine, prim.source.tag));
    fields
}

/// A line between two edges.
pub fn line(machine: &Plan, line: &Line) -> Vec<Field> {
    let own = [
        ("y", line.y.into()),
        ("cmaj", line.major.into()),
        ("cmin", line.minor.into()),
        ("left", line.left.into()),
        ("fresh", line.fresh.into()),
        ("fence", line.fence.into()),
    ];
    own.into_iter().chain(words(&line.values)).chain(tag(machine, line.source.tag)).collect()
}

/// The pixels of a line.
pub fn span(machine: &Plan, span: &Span) -> Vec<Field> {
    let own = [
        ("x", span.x.into()),
        ("y", span.y.into()),
        ("count", span.count.into()),
        ("left", span.left.into()),
        ("fresh", span.fresh.into()),
        ("fence", span.fence.into()),
    ];
    own.into_iter().chain(words(&span.values)).chain(tag(machine, span.source.tag)).collect()
}

/// The increments of a pixel.
pub fn increments(gradient: &Words) -> Vec<Field> {
    words(gradient).collect()
}

/// One pixel of a triangle.
pub fn fragment(machine: &Plan, fragment: &Fragment) -> Vec<Field> {
    let own = [("addr", fragment.addr.into()), ("fence", fragment.fence.into())];
    own.into_iter()
        .chain(outputs(fragment.z, fragment.rgb))
        .chain(tag(machine, fragment.source.tag))
        .collect()
}

/// A pixel written.
pub fn write(machine: &Plan, write: &Write) -> Vec<Field> {
    let own = [("addr", write.addr.into()), ("z_en", write.z_en.into())];
    own.into_iter().chain(outputs(write.z, write.rgb)).chain(tag(machine, write.source.tag)).collect()
}
