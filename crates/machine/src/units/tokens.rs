//! The fields of the tokens that pass from unit to unit.

mod held;
mod results;
mod stored;

pub use held::*;
use held::{kt, triangle_kt};
pub use results::*;
pub use stored::*;

use crate::channel::Channel;
use crate::field::{Field, Scale};
use crate::machine::EdgeKind;
use crate::plan::{COLOURS, Plan};
use crate::record::GLOSS_BITS;
use crate::term::{COSINES, Term};
use edgewalk_numerics::Format;

/// Bits of an edge's remainder, its step and its modulus.
#[must_use]
pub fn remainder_bits(plan: &Plan) -> u32 {
    match plan.edge_kind {
        EdgeKind::Exact => plan.widths().difference - 1,
        EdgeKind::Slope => plan.edge_fraction,
    }
}

/// The tag, if the machine has one.
fn tag(plan: &Plan) -> Option<Field> {
    (plan.tag_bits > 0).then(|| Field::count("tag", plan.tag_bits, "tag of the triangle"))
}

/// A triangle, line or part of a polygon at the port: three vertices, its k_t, its role, its window and the tag.
#[must_use]
pub fn triangle(plan: &Plan) -> Vec<Field> {
    let position = Format::signed(plan.guard_bits + 1, plan.subpixel_bits);
    let position = position.expect("vertices of a planned machine have 3 to 23 bits");
    let mut fields = Vec::new();
    for place in ["0", "1", "2"] {
        fields.extend(["x", "y"].map(|axis| {
            Field::of(format!("{axis}{place}"), position, "px", format!("{axis} of vertex {place}"))
        }));
        let value = |c: &Channel| {
            let doc = format!("{} of vertex {place}", c.what());
            Field::of(c.at_vertex(place), c.vertex_format(), "LSB", doc)
        };
        fields.extend(plan.channels().iter().map(value));
    }
    fields.extend(triangle_kt(plan));
    if plan.polygon.is_there() {
        fields.extend([
            Field::count("kind", 2, kinds(plan)),
            Field::count("sides", 3, "of kinds 1 and 2: sides 0-1, 1-2 and 2-0 are edges, a bit each"),
        ]);
        fields.extend(start_pixel(plan));
        let [_, bits] = plan.window_bits();
        fields.push(Field::count("end_y", bits + 1, "line behind the last that is drawn"));
        fields.extend(thin(plan).into_iter().filter(|field| field.name == "flat"));
    } else {
        fields.extend(thin(plan));
    }
    fields.extend(tag(plan));
    fields
}

/// The codes of `kind` in words, in a machine with POLY.
#[must_use]
pub fn kinds(plan: &Plan) -> &'static str {
    if plan.polygon.has_lines() {
        "0 triangle, 1 edges, 2 edges and plane, 3 line"
    } else {
        "0 or 3 triangle, 1 edges, 2 edges and plane"
    }
}

/// The pixel at which values start, in a machine with POLY.
fn start_pixel(plan: &Plan) -> [Field; 2] {
    let [x, y] = plan.window_bits();
    [
        Field::count("start_x", x, "column of the pixel at which values start"),
        Field::count("start_y", y, "its line, the first that is drawn"),
    ]
}

/// What tells a line from a triangle, in a machine that takes lines.
fn thin(plan: &Plan) -> Vec<Field> {
    if !plan.polygon.has_lines() {
        return Vec::new();
    }
    vec![
        Field::count("thin", 1, "a line, a pixel wide"),
        Field::count("flat", 1, "of a line: x and y have changed places"),
    ]
}

/// The state and step of one edge: C, R, q, f and, unless it is the constant 2^F, M.
fn edge(plan: &Plan, edge: &str) -> Vec<Field> {
    let (column, remainder) = (plan.widths().column, remainder_bits(plan));
    let unit = match plan.edge_kind {
        EdgeKind::Exact => "1/M column",
        EdgeKind::Slope => "2^-F column",
    };
    let name = |part: &str| format!("{edge}_{part}");
    let mut fields = vec![
        Field::signed(name("c"), column, "first column on or right of the edge"),
        Field::count(name("dist"), remainder, format!("distance from the edge to that column, {unit}")),
        Field::signed(name("q"), column, "whole columns a line, step of c"),
        Field::count(name("f"), remainder, format!("{unit} a line")),
    ];
    if plan.edge_kind == EdgeKind::Exact {
        let units = plan.widths().center_fraction;
        let doc = format!("modulus of dist and f: the edge's height; a line has 2^{units} units");
        fields.push(Field::count(name("m"), remainder, doc));
    }
    fields
}

/// SETUP to EDGE or POLY: a triangle, or three edges of a polygon, ready to be walked.
#[must_use]
pub fn prim(plan: &Plan) -> Vec<Field> {
    let w = plan.widths();
    let mut fields = vec![
        Field::count("jm", w.line, "first line"),
        Field::count("n1", w.line + 1, "lines of the upper part"),
        Field::count("n2", w.line + 1, "lines of the lower part"),
        Field::count("major_right", 1, "the major edge is the right one"),
    ];
    if plan.polygon.is_there() {
        fields.extend([
            Field::count("sides", 3, "major, first and second minor edge count, a bit each"),
            Field::count(
                "ends",
                1,
                "1: a whole triangle or line, or the last edges of a polygon with its plane",
            ),
            Field::count("void", 1, "the plane has no area: nothing is drawn"),
        ]);
        fields.extend(start_pixel(plan));
    }
    fields.extend(thin(plan));
    fields.extend(EDGES.iter().flat_map(|name| edge(plan, name)));
    for (_, channel) in plan.planes() {
        let result =
            |(result, doc): &(&str, &str)| Field::word(format!("{}_{result}", channel.name), channel, *doc);
        fields.extend(results(plan).iter().map(result));
    }
    fields.extend(along_edges(plan));
    fields.extend(triangle_kt(plan));
    fields.extend(record(plan));
    fields.extend(tag(plan));
    fields
}

/// What POLY makes colours along edges of, with `polygon.values = bilinear`.
fn along_edges(plan: &Plan) -> Vec<Field> {
    if !plan.polygon.is_bilinear() {
        return Vec::new();
    }
    let (bits, fraction) = (plan.widths().difference - 1, plan.widths().center_fraction);
    let height = |ends: &str| {
        Field::count(
            format!("height{ends}"),
            bits,
            format!(
                "2^-{fraction} line, from vertex {} down to {} of those sorted by line",
                &ends[..1],
                &ends[1..]
            ),
        )
    };
    let down = |vertex: &str, line: &str| {
        let doc = format!("2^-{fraction} line, from vertex {vertex} down to {line}");
        Field::count(format!("down{vertex}"), bits, doc)
    };
    let mut fields: Vec<Field> = ["02", "01", "12"].map(height).into();
    fields.extend([down("0", "the first line"), down("1", "the first line of the lower part")]);
    for channel in &plan.channels()[COLOURS] {
        let value = |place: usize| {
            let doc = format!("{} at vertex {place} of those sorted by line", channel.what());
            Field::of(format!("{}_at{place}", channel.name), channel.vertex_format(), "LSB", doc)
        };
        fields.extend((0..3).map(value));
    }
    fields
}

/// EDGE to SPAN: one line of a triangle; POLY to SPAN: one span of a polygon.
#[must_use]
pub fn line(plan: &Plan) -> Vec<Field> {
    let w = plan.widths();
    let [cmaj, cmin, fresh] = if plan.polygon.is_there() {
        ["first column of the span", "column behind the span", "first span of the polygon"]
    } else {
        [
            "first column on or right of the major edge",
            "first column on or right of the minor edge",
            "first line of the triangle",
        ]
    };
    let mut fields = vec![
        Field::count("y", w.line, "line"),
        Field::signed("cmaj", w.column, cmaj),
        Field::signed("cmin", w.column, cmin),
        Field::count("major_right", 1, "the major edge is the right one"),
    ];
    fields.extend(thin(plan));
    fields.extend(held::words(plan, |what| format!("{what} at the first pixel of the line")));
    fields.extend([Field::count("fresh", 1, fresh), fence()]);
    fields.extend(tag(plan));
    fields
}

/// SPAN to PIXEL: the pixels of a line.
#[must_use]
pub fn span(plan: &Plan) -> Vec<Field> {
    span_with(plan, Vec::new())
}

/// TERM to PIXEL: the same with the terms at its first pixel; without TERM what SPAN gives.
#[must_use]
pub fn walked(plan: &Plan) -> Vec<Field> {
    let mut fields = Vec::new();
    for term in plan.terms() {
        let word = |part: &str, doc: &str| Field {
            scale: Scale::Modular("LSB"),
            ..Field::of(format!("{}_{part}", term.name), word_format(term), "LSB", doc)
        };
        fields.extend([word("v", "value at the first pixel"), word("g", "step to the next pixel")]);
        fields.extend((term.degree == 2).then(|| word("gg", "change of the step a pixel")));
    }
    fields.extend(material(plan));
    fields.extend(gloss(plan));
    span_with(plan, fields)
}

/// b integer and r fraction bits, signed.
fn word_format(term: &Term) -> Format {
    Format::signed(term.bits, term.fraction).expect("a planned term has at most 64 bits")
}

/// The material, if there is more than one.
fn material(plan: &Plan) -> Option<Field> {
    let bits = plan.shade.material_bits;
    (plan.shade.is_there() && bits > 0)
        .then(|| Field::count("material", bits, "material; selects the tables of SHADE"))
}

/// Of the material's highlights, on the way to NORMAL or LAMP.
fn gloss(plan: &Plan) -> Option<Field> {
    let doc = "gloss: highlights reach down to 2^gloss tables below 0";
    plan.shade.normalises().then(|| Field::count("gloss", GLOSS_BITS, doc))
}

fn span_with(plan: &Plan, terms: Vec<Field>) -> Vec<Field> {
    let w = plan.widths();
    let mut fields = vec![
        Field::signed("x", w.column, "first column"),
        Field::count("y", w.y, "line"),
        Field::count("count", w.column, "pixels of the span, at least 1"),
        Field::count("leftward", 1, "1: the span runs towards smaller columns"),
    ];
    fields.extend(held::words(plan, |what| format!("{what} at the first pixel of the span")));
    fields.extend(terms);
    fields.extend([Field::count("fresh", 1, "first span of the triangle; increments are new"), fence()]);
    fields.extend(tag(plan));
    fields
}

fn outputs(plan: &Plan) -> impl Iterator<Item = Field> {
    plan.channels().iter().map(Field::output)
}

/// Bits, 1 for what the light reaches; only with SHADOW.
fn lit(plan: &Plan) -> Option<Field> {
    plan.shadow.is_there().then(|| Field::count("lit", 1, "the light reaches the fragment"))
}

/// The outputs that go beyond SHADOW.
fn seen(plan: &Plan) -> impl Iterator<Item = Field> {
    plan.seen_channels().map(|(_, channel)| Field::output(channel))
}

/// SHADOW to DEPTH: a fragment, lit or not; without SHADOW what PIXEL gives.
#[must_use]
pub fn shaded(plan: &Plan) -> Vec<Field> {
    let mut fields = vec![address(plan)];
    fields.extend(seen(plan));
    fields.extend(triangle_kt(plan));
    fields.extend(lit(plan));
    fields.push(fence());
    fields.extend(tag(plan));
    fields
}

/// The outputs that DEPTH takes: colours with the bits that DITHER leaves them.
fn stored(plan: &Plan) -> impl Iterator<Item = Field> {
    let color = |field: Field| match field.name.as_str() {
        "r" | "g" | "b" if plan.dither.rounds() => {
            let format = Format::unsigned(plan.dither.bits, 0).expect("4 to 7 bits");
            Field { format, ..field }
        }
        _ => field,
    };
    seen(plan).map(color)
}

/// DITHER to DEPTH: a fragment with the colours that are stored, without k_t if that has dropped others; without DITHER what SHADOW
/// gives.
#[must_use]
pub fn dithered(plan: &Plan) -> Vec<Field> {
    let mut fields = vec![address(plan)];
    fields.extend(stored(plan));
    fields.extend(triangle_kt(plan).filter(|_| !plan.dither.drops()));
    fields.extend(lit(plan));
    fields.push(fence());
    fields.extend(tag(plan));
    fields
}

/// What PIXEL gives: a fragment, with the outputs of the terms.
#[must_use]
pub fn fragment(plan: &Plan) -> Vec<Field> {
    fragment_with(plan, terms(plan, plan.terms().len()))
}

/// The outputs of so many terms, and what goes with them.
fn terms(plan: &Plan, count: usize) -> Vec<Field> {
    let output = |term: &Term| Field::signed(term.name, term.bits, "floor of the term");
    plan.terms().iter().take(count).map(output).chain(material(plan)).chain(gloss(plan)).collect()
}

/// What TEXEL gives: the same without u and v, its colours new, with BUMP slopes; without TEXEL what PIXEL gives.
#[must_use]
pub fn textured(plan: &Plan) -> Vec<Field> {
    let mut fields = fragment_with(plan, terms(plan, plan.bumped_terms()));
    if plan.shade.bumps() {
        let slope = |name| {
            Field::signed(name, plan.shade.slope_bits, "slope of the relief, as a fraction of the largest")
        };
        let fence = fields.iter().position(|field| field.name == "fence").unwrap_or(fields.len());
        fields.splice(fence..fence, ["bu", "bv"].map(slope));
    }
    fields
}

/// What BUMP gives: what NORMAL or LAMP takes, or SHADE; without BUMP what TEXEL gives.
#[must_use]
pub fn bumped(plan: &Plan) -> Vec<Field> {
    if !plan.shade.bumps() {
        textured(plan)
    } else if plan.shade.normalises() {
        fragment_with(plan, terms(plan, plan.cosine_terms()))
    } else {
        cosines(plan)
    }
}

/// What SHADE takes: a fragment with two cosines a light, and of LAMP what is left of the light.
#[must_use]
pub fn cosines(plan: &Plan) -> Vec<Field> {
    let bits = [plan.shade.diffuse_index_bits(), plan.shade.highlight_index_bits()];
    let index = |(name, bits)| Field::signed(name, bits, "entry of SHADE's table");
    let lights = COSINES.into_iter().take(plan.shade.lights as usize);
    let cosines = lights.flat_map(|names| names.into_iter().zip(bits)).map(index);
    let beam =
        plan.shade.is_positional().then(|| Field::count("beam", 17, "share of the light, 2^16 for 1.0"));
    fragment_with(plan, cosines.chain(beam).chain(material(plan)).collect())
}

/// What SHADE gives: a fragment without terms and material, its colours new; without SHADE what PIXEL gives.
#[must_use]
pub fn tinted(plan: &Plan) -> Vec<Field> {
    fragment_with(plan, Vec::new())
}

/// What SHADOW takes: a fragment with its texel and its depth from the light; without PROJECT what SHADE gives.
#[must_use]
pub fn projected(plan: &Plan) -> Vec<Field> {
    let mut fields = tinted(plan);
    if plan.shadow.projects() {
        let (texel, distance) = (plan.shadow.texel_bits(), plan.shadow.distance_bits());
        fields.retain(|field| field.name != "lw");
        for field in &mut fields {
            match field.name.as_str() {
                "lx" => *field = Field::signed("lx", texel, "column of the texel, -1 outside the map"),
                "ly" => *field = Field::signed("ly", texel, "line of the texel, -1 outside the map"),
                "lz" => {
                    let doc = format!("depth from the light in 2^-{}, or -1", plan.shadow.depth_bits);
                    *field = Field::signed("lz", distance, doc);
                }
                _ => {}
            }
        }
    }
    fields
}

fn fragment_with(plan: &Plan, terms: Vec<Field>) -> Vec<Field> {
    let mut fields = vec![address(plan)];
    fields.extend(outputs(plan));
    fields.extend(triangle_kt(plan));
    fields.extend(terms);
    fields.push(fence());
    fields.extend(tag(plan));
    fields
}

fn fence() -> Field {
    Field::count("fence", 1, "older fragments of the same pixel may be in flight")
}

/// What is kept of a fragment while a memory is read for it.
#[must_use]
pub fn entry(plan: &Plan) -> Vec<Field> {
    std::iter::once(address(plan)).chain(seen(plan)).chain(lit(plan)).chain(tag(plan)).collect()
}

/// DEPTH to the memories: one pixel, in a machine without BLEND.
#[must_use]
pub fn write(plan: &Plan) -> Vec<Field> {
    let mut fields = vec![address(plan)];
    for field in stored(plan) {
        let is_depth = field.name == "z";
        fields.push(field);
        if is_depth {
            fields.push(Field::count("z_en", 1, "1: write the depth as well"));
        }
    }
    fields.extend(lit(plan));
    fields.extend(tag(plan));
    fields
}

/// DEPTH to the depth memory, in a machine with BLEND.
#[must_use]
pub fn depth_write(plan: &Plan) -> Vec<Field> {
    vec![address(plan), Field::output(&plan.channels()[0])]
}

/// The user's own channels.
fn own(plan: &Plan) -> impl Iterator<Item = Field> {
    plan.own_channels().map(|(_, channel)| Field::output(channel))
}

/// DEPTH to BLEND: a fragment that passed.
#[must_use]
pub fn passed(plan: &Plan) -> Vec<Field> {
    let colours = plan.channels()[1..4].iter().map(Field::output);
    let mut fields = vec![address(plan)];
    fields.extend(colours);
    fields.extend(own(plan));
    fields.push(kt(plan));
    fields.extend(lit(plan));
    fields.push(fence());
    fields.extend(tag(plan));
    fields
}

/// BLEND to the colour memory: one pixel.
#[must_use]
pub fn color_write(plan: &Plan) -> Vec<Field> {
    let mut fields = vec![address(plan), color_word(plan)];
    fields.extend(own(plan));
    fields.extend(lit(plan));
    fields.extend(tag(plan));
    fields
}
