//! The model's tokens as lists of values, in the order of the channels' fields.

use crate::suites::Triangle;
use edgewalk_machine::{EdgeKind, Fill, Plan, PortVertex};
use edgewalk_model::tokens::{EdgeWalk, Fragment, Line, Prim, Rgb, Source, Span, Words, Write};

/// The values of a token's fields, in the order of the channel's fields, each below 2^width.
pub type Token = Vec<u128>;

/// A triangle as a token of `tri`.
#[must_use]
pub fn pack_triangle(machine: &Plan, triangle: &Triangle, tag: u32) -> Token {
    let mut token = Token::new();
    for vertex in triangle {
        token.extend([vertex.x, vertex.y].map(|v| twos(v, machine.widths().vertex)));
        token.extend(vertex.value.map(u128::from));
    }
    push_tag(&mut token, machine, tag);
    token
}

/// A token of `tri` as a triangle and its tag.
#[must_use]
pub fn unpack_triangle(machine: &Plan, token: &[u128]) -> (Triangle, u32) {
    let mut fields = Fields(token.iter());
    let bits = machine.widths().vertex;
    let triangle = std::array::from_fn(|_| PortVertex {
        x: fields.signed(bits),
        y: fields.signed(bits),
        value: std::array::from_fn(|_| fields.unsigned()),
    });
    (triangle, fields.tag())
}

/// The words of SETUP in the order of [`results`].
fn result_words(machine: &Plan, prim: &Prim) -> Vec<Words> {
    match machine.fill {
        Fill::Exact => vec![prim.start[0], prim.delta[0], prim.delta[1], prim.gradient],
        Fill::Textbook => vec![prim.start[0], prim.delta[0], prim.start[1], prim.delta[1], prim.gradient],
    }
}

/// A prim as a token.
pub(crate) fn pack_prim(machine: &Plan, prim: &Prim) -> Token {
    let column = machine.widths().column;
    let mut token: Token =
        [prim.line, prim.lines[0], prim.lines[1], u32::from(prim.left)].map(u128::from).into();
    for edge in [&prim.major, &prim.minor[0], &prim.minor[1]] {
        let parts = [twos(edge.c, column), edge.r as u128, twos(edge.q, column), edge.f as u128];
        token.extend(parts); // R and f are not negative
        if machine.edge_kind == EdgeKind::Exact {
            token.push(edge.m as u128); // M is not negative
        }
    }
    let words = result_words(machine, prim);
    for channel in 0..4 {
        token.extend(words.iter().map(|w| u128::from(w[channel])));
    }
    push_tag(&mut token, machine, prim.source.tag);
    token
}

/// A token as a prim.
pub(crate) fn unpack_prim(machine: &Plan, token: &[u128]) -> Prim {
    let column = machine.widths().column;
    let mut fields = Fields(token.iter());
    let mut prim = Prim {
        line: fields.short(),
        lines: [fields.short(), fields.short()],
        left: fields.bit(),
        ..Prim::default()
    };
    let mut edges = [EdgeWalk::default(); 3];
    for edge in &mut edges {
        edge.c = fields.signed(column);
        edge.r = fields.short() as i32; // below 2^31
        edge.q = fields.signed(column);
        edge.f = fields.short() as i32;
        edge.m = match machine.edge_kind {
            EdgeKind::Exact => fields.short() as i32,
            EdgeKind::Slope => 1 << machine.edge_fraction,
        };
    }
    prim.major = edges[0];
    prim.minor = [edges[1], edges[2]];
    for channel in 0..4 {
        let mut word = || fields.unsigned();
        match machine.fill {
            Fill::Exact => {
                prim.start[0][channel] = word();
                prim.delta[0][channel] = word();
                prim.delta[1][channel] = word();
            }
            Fill::Textbook => {
                for part in 0..2 {
                    prim.start[part][channel] = word();
                    prim.delta[part][channel] = word();
                }
            }
        }
        prim.gradient[channel] = word();
    }
    prim.source = fields.source();
    prim
}

/// A line as a token.
pub(crate) fn pack_line(machine: &Plan, line: &Line) -> Token {
    let column = machine.widths().column;
    let mut token = vec![u128::from(line.y), twos(line.major, column), twos(line.minor, column)];
    token.push(u128::from(line.left));
    token.extend(line.values.map(u128::from));
    token.extend([line.fresh, line.fence].map(u128::from));
    push_tag(&mut token, machine, line.source.tag);
    token
}

/// A token as a line.
pub(crate) fn unpack_line(machine: &Plan, token: &[u128]) -> Line {
    let column = machine.widths().column;
    let mut fields = Fields(token.iter());
    Line {
        y: fields.short(),
        major: fields.signed(column),
        minor: fields.signed(column),
        left: fields.bit(),
        values: fields.words(),
        fresh: fields.bit(),
        fence: fields.bit(),
        source: fields.source(),
    }
}

/// A span as a token.
pub(crate) fn pack_span(machine: &Plan, span: &Span) -> Token {
    let mut token = vec![twos(span.x, machine.widths().column)];
    token.extend([span.y, span.count, u32::from(span.left)].map(u128::from));
    token.extend(span.values.map(u128::from));
    token.extend([span.fresh, span.fence].map(u128::from));
    push_tag(&mut token, machine, span.source.tag);
    token
}

/// A token as a span.
pub(crate) fn unpack_span(machine: &Plan, token: &[u128]) -> Span {
    let mut fields = Fields(token.iter());
    Span {
        x: fields.signed(machine.widths().column),
        y: fields.short(),
        count: fields.short(),
        left: fields.bit(),
        values: fields.words(),
        fresh: fields.bit(),
        fence: fields.bit(),
        source: fields.source(),
    }
}

/// A fragment as a token.
pub(crate) fn pack_fragment(machine: &Plan, fragment: &Fragment) -> Token {
    let mut token = vec![u128::from(fragment.addr), u128::from(fragment.z)];
    token.extend(fragment.rgb.channels().map(u128::from));
    token.push(u128::from(fragment.fence));
    push_tag(&mut token, machine, fragment.source.tag);
    token
}

/// A token as a fragment.
pub(crate) fn unpack_fragment(token: &[u128]) -> Fragment {
    let mut fields = Fields(token.iter());
    Fragment {
        addr: fields.short(),
        z: fields.short(),
        rgb: Rgb::new(std::array::from_fn(|_| fields.short() as u16)), // at most 16 bits
        fence: fields.bit(),
        source: fields.source(),
    }
}

/// A write as a token.
pub(crate) fn pack_write(machine: &Plan, write: &Write) -> Token {
    let mut token = vec![u128::from(write.addr), u128::from(write.z), u128::from(write.z_en)];
    token.extend(write.rgb.channels().map(u128::from));
    push_tag(&mut token, machine, write.source.tag);
    token
}

fn push_tag(token: &mut Token, machine: &Plan, tag: u32) {
    if machine.tag_bits > 0 {
        token.push(u128::from(tag) & ((1 << machine.tag_bits) - 1));
    }
}

/// The low `bits` bits, two's complement.
fn twos(value: i32, bits: u32) -> u128 {
    (i128::from(value) as u128) & ((1 << bits) - 1)
}

/// Takes the fields of a token one by one. A token is as long as its channel's fields; past its end all is 0.
struct Fields<'a>(std::slice::Iter<'a, u128>);

impl Fields<'_> {
    fn next(&mut self) -> u128 {
        self.0.next().copied().unwrap_or(0)
    }

    fn unsigned(&mut self) -> u64 {
        self.next() as u64 // at most 56 bits
    }

    fn short(&mut self) -> u32 {
        self.next() as u32 // at most 32 bits
    }

    fn bit(&mut self) -> bool {
        self.next() == 1
    }

    fn signed(&mut self, bits: u32) -> i32 {
        ((self.next() << (128 - bits)) as i128 >> (128 - bits)) as i32 // at most 32 bits
    }

    fn words(&mut self) -> Words {
        std::array::from_fn(|_| self.unsigned())
    }

    /// The last field, if there is one.
    fn tag(&mut self) -> u32 {
        self.short()
    }

    /// The triangle, as far as hardware knows it.
    fn source(&mut self) -> Source {
        Source { tag: self.tag(), id: 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fields::{
        fragment_fields, line_fields, prim_fields, span_fields, triangle_fields, write_fields,
    };
    use super::*;

    fn walk(i: i32) -> EdgeWalk {
        EdgeWalk { c: -3 - i, r: 5 + i, q: -7 - i, f: 9 + i, m: 100 + i }
    }

    /// A machine with a tag: every field is a different number.
    fn machine() -> Plan {
        Plan::default().tagged()
    }

    #[test]
    fn tokens_read_back_and_have_a_value_for_each_field() {
        let m = machine();
        let vertex = |i: i32| PortVertex { x: -i, y: 40 - i, value: [1, 2, 3, 4].map(|v| v + 10 * i as u64) };
        let triangle = [vertex(1), vertex(2), vertex(3)];
        let token = pack_triangle(&m, &triangle, 77);
        assert_eq!(token.len(), triangle_fields(&m).len());
        assert_eq!(unpack_triangle(&m, &token), (triangle, 77));

        let prim = Prim {
            line: 3,
            lines: [4, 5],
            left: true,
            major: walk(0),
            minor: [walk(1), walk(2)],
            start: [[6, 7, 8, 9], [0; 4]],
            delta: [[10, 11, 12, 13], [14, 15, 16, 17]],
            gradient: [18, 19, 20, 21],
            source: Source { tag: 22, id: 0 },
        };
        let token = pack_prim(&m, &prim);
        assert_eq!(token.len(), prim_fields(&m).len());
        assert_eq!(unpack_prim(&m, &token), prim);

        let textbook = Plan::preset("textbook").expect("listed").tagged();
        let modulus = 1 << textbook.edge_fraction;
        let slope = |i| EdgeWalk { m: modulus, ..walk(i) };
        let prim = Prim {
            major: slope(0),
            minor: [slope(1), slope(2)],
            start: [[6, 7, 8, 9], [1, 2, 3, 4]],
            ..prim
        };
        let token = pack_prim(&textbook, &prim);
        assert_eq!(token.len(), prim_fields(&textbook).len());
        assert_eq!(unpack_prim(&textbook, &token), prim);

        let line = Line {
            y: 1,
            major: -2,
            minor: 3,
            left: true,
            values: [4, 5, 6, 7],
            fresh: true,
            fence: false,
            source: Source { tag: 8, id: 0 },
        };
        let token = pack_line(&m, &line);
        assert_eq!(token.len(), line_fields(&m).len());
        assert_eq!(unpack_line(&m, &token), line);

        let span = Span {
            x: -1,
            y: 2,
            count: 3,
            left: true,
            values: [4, 5, 6, 7],
            fresh: true,
            fence: true,
            source: Source { tag: 8, id: 0 },
        };
        let token = pack_span(&m, &span);
        assert_eq!(token.len(), span_fields(&m).len());
        assert_eq!(unpack_span(&m, &token), span);

        let fragment = Fragment {
            addr: 1,
            z: 2,
            rgb: Rgb::new([3, 4, 5]),
            fence: true,
            source: Source { tag: 6, id: 0 },
        };
        let token = pack_fragment(&m, &fragment);
        assert_eq!(token.len(), fragment_fields(&m).len());
        assert_eq!(unpack_fragment(&token), fragment);

        let write =
            Write { addr: 1, z: 2, z_en: true, rgb: Rgb::new([3, 4, 5]), source: Source { tag: 6, id: 0 } };
        assert_eq!(pack_write(&m, &write), [1, 2, 1, 3, 4, 5, 6]);
        assert_eq!(write_fields(&m).len(), 7);
    }
}
