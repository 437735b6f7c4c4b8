//! Triangles at the machine's port, as tokens of the link by which they come: at once, or word by word.

use crate::Token;
use crate::interface::{Interface, Link};
use crate::unit::Unit;
use edgewalk_machine::{MAX_CHANNELS, Plan, PortVertex, Role, Sides, Window};

/// A triangle at the port.
pub type Triangle = [PortVertex; 3];

/// Makes tokens of triangles and triangles of tokens.
#[derive(Clone, Debug)]
pub struct Triangles {
    plan: Plan,
    link: Link,
    /// What stands in each field, with its bits.
    fields: Vec<(Part, u32)>,
}

/// A part of a triangle: of which vertex, and of which channel; or of the whole.
#[derive(Clone, Copy, Debug)]
enum Part {
    X(usize),
    Y(usize),
    Value(usize, usize),
    /// k_t of the triangle, that of its first vertex.
    Kt,
    /// A line, not a triangle.
    Thin,
    /// And has x and y exchanged.
    Flat,
    /// With POLY: triangle, edges, edges and plane, or line.
    Kind,
    /// The sides that are edges.
    Sides,
    StartX,
    StartY,
    EndY,
    Tag,
}

impl Triangles {
    /// For the triangles of this machine.
    #[must_use]
    pub fn new(plan: &Plan) -> Triangles {
        let machine = Interface::new(plan, Unit::MACHINE);
        let link = machine.links.first().expect("a machine takes triangles");
        Triangles::of(plan, link).expect("a declared field of a triangle is that of a vertex or the tag")
    }

    /// Finds the fields by name; `None` if one of them is no part of a triangle.
    pub(super) fn of(plan: &Plan, link: &Link) -> Option<Triangles> {
        let fields = link.whole().map(|field| Some((Part::named(plan, &field.name)?, field.width())));
        Some(Triangles { plan: plan.clone(), link: link.clone(), fields: fields.collect::<Option<_>>()? })
    }

    /// The triangle as a token; of the tag the low bits.
    #[must_use]
    pub fn pack(&self, triangle: &Triangle, tag: u32) -> Token {
        let (role, window) = (Role::of(triangle), Window::of(triangle));
        let value = |(part, width): &(Part, u32)| {
            let number = match *part {
                Part::X(vertex) => triangle[vertex].x().into(),
                Part::Y(vertex) => triangle[vertex].y().into(),
                Part::Value(vertex, channel) => triangle[vertex].values()[channel].into(),
                Part::Kt => triangle[0].kt().into(),
                Part::Thin => role.is_line().into(),
                Part::Flat => role.is_flat().into(),
                Part::Kind => role.kind().into(),
                Part::Sides => role.sides().bits().into(),
                Part::StartX => window.x0.into(),
                Part::StartY => window.y0.into(),
                Part::EndY => window.y1.into(),
                Part::Tag => i128::from(tag),
            };
            number as u128 & (u128::MAX >> (128 - width))
        };
        self.fields.iter().map(value).collect()
    }

    /// What is offered at the port, one after the other, to bring in a triangle: a token, or all its words.
    #[must_use]
    pub fn offers(&self, triangle: &Triangle, tag: u32) -> Vec<Token> {
        let whole = self.pack(triangle, tag);
        match self.link.words.len() {
            0 => vec![whole],
            words => (0..words).map(|place| self.link.word(&whole, place).collect()).collect(),
        }
    }

    /// The triangle and the tag of a token.
    #[must_use]
    pub fn unpack(&self, token: &[u128]) -> (Triangle, u32) {
        let (mut x, mut y, mut values, mut tag) = ([0; 3], [0; 3], [[0; MAX_CHANNELS + 1]; 3], 0);
        let (mut kind, mut flat, mut sides, mut window) = (0, false, Sides::default(), Window::default());
        let channels = self.plan.channels().len();
        for ((part, width), bits) in self.fields.iter().zip(token) {
            let signed = ((bits << (128 - width)) as i128 >> (128 - width)) as i64; // values have at most 48 bits
            match *part {
                Part::X(vertex) => x[vertex] = signed as i32,
                Part::Y(vertex) => y[vertex] = signed as i32,
                Part::Value(vertex, channel) => {
                    let signed_kind = self.plan.channels()[channel].kind.is_signed();
                    values[vertex][channel] = if signed_kind { signed } else { *bits as i64 };
                }
                Part::Kt => values[0][channels] = *bits as i64,
                Part::Thin => kind = 3 * *bits,
                Part::Flat => flat = *bits == 1,
                Part::Kind => kind = *bits,
                Part::Sides => sides = Sides::of_bits(*bits as u32),
                Part::StartX => window.x0 = *bits as u32,
                Part::StartY => window.y0 = *bits as u32,
                Part::EndY => window.y1 = *bits as u32,
                Part::Tag => tag = *bits as u32,
            }
        }
        let role = match kind {
            1 => Role::Edges(sides),
            2 => Role::Plane(sides),
            3 => Role::Line { flat },
            _ => Role::Triangle,
        };
        let vertices = std::array::from_fn(|i| self.plan.raw_vertex(x[i], y[i], &values[i]));
        (self.plan.with_window(self.plan.with_role(vertices, role), window), tag)
    }
}

impl Part {
    fn named(plan: &Plan, name: &str) -> Option<Part> {
        match name {
            "kt" => return Some(Part::Kt),
            "thin" => return Some(Part::Thin),
            "flat" => return Some(Part::Flat),
            "kind" => return Some(Part::Kind),
            "sides" => return Some(Part::Sides),
            "start_x" => return Some(Part::StartX),
            "start_y" => return Some(Part::StartY),
            "end_y" => return Some(Part::EndY),
            "tag" => return Some(Part::Tag),
            _ => {}
        }
        (0..3).find_map(|vertex| {
            let place = vertex.to_string();
            if name == format!("x{place}") {
                return Some(Part::X(vertex));
            }
            if name == format!("y{place}") {
                return Some(Part::Y(vertex));
            }
            let channel = plan.channels().iter().position(|channel| channel.at_vertex(&place) == name);
            channel.map(|channel| Part::Value(vertex, channel))
        })
    }
}
