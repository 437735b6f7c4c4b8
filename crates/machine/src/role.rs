//! What three vertices at the port are: a triangle, a part of a polygon, or a line; and which lines are drawn of it.

use crate::plan::Plan;
use crate::vertex::PortVertex;

/// What the three vertices of a token are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Role {
    /// A triangle.
    #[default]
    Triangle,
    /// Edges of a polygon.
    Edges(Sides),
    /// The polygon's last edges, and its plane: that of the three vertices.
    Plane(Sides),
    /// A line, a pixel wide: the upper end, the same a pixel to the right, the lower end.
    Line {
        /// The vertices have x and y exchanged: the line runs along a row of pixels.
        flat: bool,
    },
}

/// The sides between three vertices that are edges of a polygon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sides(u8);

impl Sides {
    /// All three.
    pub const ALL: Sides = Sides(7);

    /// The side from vertex 0 to 1 counts, from 1 to 2, from 2 to 0.
    #[must_use]
    pub fn new(count: [bool; 3]) -> Sides {
        Sides(count.iter().enumerate().map(|(side, count)| u8::from(*count) << side).sum())
    }

    /// The field of the port; what has more bits is cut.
    #[must_use]
    pub fn of_bits(bits: u32) -> Sides {
        Sides(bits as u8 & 7)
    }

    /// As the port has them: bit 0 for the side from vertex 0 to 1, bit 1 from 1 to 2, bit 2 from 2 to 0.
    #[must_use]
    pub fn bits(self) -> u32 {
        self.0.into()
    }

    /// The side from the vertex with this place to the next one counts.
    #[inline]
    #[must_use]
    pub fn has(self, side: usize) -> bool {
        self.0 >> side & 1 == 1
    }
}

impl Role {
    /// The role of three vertices, as the port has it.
    #[inline]
    #[must_use]
    pub fn of(vertices: &[PortVertex; 3]) -> Role {
        let (kind, sides) = (vertices[0].own & 3, Sides((vertices[1].own >> 13) as u8));
        match kind {
            1 => Role::Edges(sides),
            2 => Role::Plane(sides),
            3 => Role::Line { flat: vertices[0].own & 4 != 0 },
            _ => Role::Triangle,
        }
    }

    /// The field `kind` of the port.
    #[must_use]
    pub fn kind(self) -> u32 {
        match self {
            Role::Triangle => 0,
            Role::Edges(_) => 1,
            Role::Plane(_) => 2,
            Role::Line { .. } => 3,
        }
    }

    /// The field `sides` of the port: 0 of triangles and lines.
    #[must_use]
    pub fn sides(self) -> Sides {
        match self {
            Role::Edges(sides) | Role::Plane(sides) => sides,
            Role::Triangle | Role::Line { .. } => Sides::default(),
        }
    }

    /// Whether the primitive is a line.
    #[must_use]
    pub fn is_line(self) -> bool {
        matches!(self, Role::Line { .. })
    }

    /// Whether the primitive is a line with x and y exchanged.
    #[must_use]
    pub fn is_flat(self) -> bool {
        self == Role::Line { flat: true }
    }

    /// The last token of what is drawn together: all but [`Role::Edges`].
    #[inline]
    #[must_use]
    pub fn ends(self) -> bool {
        !matches!(self, Role::Edges(_))
    }
}

/// The tokens of each triangle, line and polygon: of a polygon all up to the one that ends it.
pub fn wholes(tokens: &[[PortVertex; 3]]) -> impl Iterator<Item = &[[PortVertex; 3]]> {
    tokens.split_inclusive(|token| Role::of(token).ends())
}

/// The lines that are drawn of a token, and the pixel at which its values start; of a flat line x and y are exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Window {
    /// Column of the pixel.
    pub x0: u32,
    /// Line at which values start, the first that is drawn.
    pub y0: u32,
    /// The line behind the last; what lies beyond the screen counts as its height.
    pub y1: u32,
}

/// All lines of any screen; values start at the first pixel.
impl Default for Window {
    fn default() -> Self {
        Window { x0: 0, y0: 0, y1: LINES }
    }
}

/// More lines than a screen has, in the 14 bits that a vertex keeps of `y1`.
const LINES: u32 = (1 << 14) - 1;

impl Window {
    /// The window of three vertices, as the port has it.
    #[inline]
    #[must_use]
    pub fn of(vertices: &[PortVertex; 3]) -> Window {
        let [a, b, c] = vertices.each_ref().map(|vertex| u32::from(vertex.own));
        Window { x0: a >> 3, y0: b & ((1 << 13) - 1), y1: c ^ LINES }
    }
}

impl Plan {
    /// The line between two ends as the port takes it (`docs/machine.md`, section 2): flat or steep, from the end
    /// that comes first, half a pixel to the left.
    #[must_use]
    pub fn line(&self, [a, b]: [PortVertex; 2]) -> [PortVertex; 3] {
        let flat = (b.x() - a.x()).abs() >= (b.y() - a.y()).abs();
        // Across, along.
        let turned = |v: PortVertex| if flat { v.at(v.y(), v.x()) } else { v };
        let [a, b] = [a, b].map(turned);
        let [from, to] = if a.y() <= b.y() { [a, b] } else { [b, a] };
        let (one, half) = (1 << self.subpixel_bits, 1 << self.subpixel_bits >> 1);
        let moved = |v: PortVertex, right: i32| v.at(v.x() - half + right, v.y());
        self.with_role([moved(from, 0), moved(from, one), moved(to, 0)], Role::Line { flat })
    }

    /// The vertices in this role; what the machine does not take, as it has no lines or no POLY, is a triangle.
    #[must_use]
    pub fn with_role(&self, mut vertices: [PortVertex; 3], role: Role) -> [PortVertex; 3] {
        let taken = match role {
            Role::Triangle => true,
            Role::Edges(_) | Role::Plane(_) => self.polygon.is_there(),
            Role::Line { .. } => self.polygon.has_lines(),
        };
        let role = if taken { role } else { Role::Triangle };
        let [a, b, _] = &mut vertices;
        a.own = a.own & !7 | role.kind() as u16 | u16::from(role.is_flat()) << 2;
        b.own = b.own & 0x1fff | (role.sides().bits() as u16) << 13;
        vertices
    }

    /// The vertices with this window; a machine without POLY takes none. Of what has more bits than the port the low
    /// ones count.
    #[must_use]
    pub fn with_window(&self, mut vertices: [PortVertex; 3], window: Window) -> [PortVertex; 3] {
        if self.polygon.is_there() {
            let [a, b, c] = &mut vertices;
            let [x, y] = self.window_bits();
            let low = |value: u32, bits: u32| (value & (u32::MAX >> (32 - bits))) as u16;
            a.own = a.own & 7 | low(window.x0, x) << 3;
            b.own = b.own & 0xe000 | low(window.y0, y);
            // All ones stand for all lines, however many bits there are.
            let (all, end) = (low(u32::MAX, y + 1), low(window.y1, y + 1));
            c.own = if end == all { 0 } else { end ^ LINES as u16 };
        }
        vertices
    }

    /// Bits of a window's column and of its line: at most 13.
    #[must_use]
    pub fn window_bits(&self) -> [u32; 2] {
        let w = self.widths();
        if self.polygon.has_lines() { [w.line; 2] } else { [w.x, w.y] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Machine;
    use crate::polygon::Lines;

    #[test]
    fn a_role_is_seen_where_the_port_takes_it() {
        let (line, sides) = (Role::Line { flat: true }, Sides::new([false, true, true]));
        for (lines, edges) in [(Lines::No, 0), (Lines::Yes, 0), (Lines::No, 8), (Lines::Yes, 128)] {
            let with = |m: &mut Machine| (m.polygon.lines, m.polygon.edges) = (lines, edges);
            let plan = Machine::default().with(with).plan().expect("can be built");
            let vertices = [plan.raw_vertex(1, 2, &[3]); 3];
            assert_eq!(Role::of(&vertices), Role::Triangle);
            let seen = |role: Role, is: bool| {
                let seen = Role::of(&plan.with_role(vertices, role));
                assert_eq!(seen, if is { role } else { Role::Triangle });
            };
            seen(line, lines == Lines::Yes);
            seen(Role::Edges(sides), edges > 0);
            seen(Role::Plane(sides), edges > 0);
        }
        assert_eq!([0, 1, 2].map(|side| sides.has(side)), [false, true, true]);
    }

    #[test]
    fn a_window_is_kept_beside_the_role() {
        let plan = Machine::default().with(|m| m.polygon.edges = 8).plan().expect("can be built");
        let (window, role) =
            (Window { x0: 639, y0: 479, y1: 480 }, Role::Plane(Sides::new([true, false, true])));
        let vertices = [plan.raw_vertex(1, 2, &[3]); 3];
        assert_eq!(Window::of(&vertices), Window::default());
        for vertices in [
            plan.with_role(plan.with_window(vertices, window), role),
            plan.with_window(plan.with_role(vertices, role), window),
        ] {
            assert_eq!((Window::of(&vertices), Role::of(&vertices)), (window, role));
        }
        // Columns have 10 bits, lines 9 and their end 10.
        let cut = Window::of(&plan.with_window(vertices, Window { x0: 1024 + 5, y0: 512 + 6, y1: 1024 + 7 }));
        assert_eq!(cut, Window { x0: 5, y0: 6, y1: 7 });
        let none = Plan::default();
        assert_eq!(Window::of(&none.with_window(vertices, window)), Window::default());
    }

    #[test]
    fn a_line_begins_half_a_pixel_beside_its_first_end() {
        let plan = Machine::default().with(|m| m.polygon.lines = Lines::Yes).plan().expect("can be built");
        let end = |x: i32, y: i32| plan.raw_vertex(256 * x, 256 * y, &[7, 8]);
        let places = |line: [PortVertex; 3]| (line.map(|v| [v.x(), v.y()]), Role::of(&line));
        let flat = ([[384, 256], [640, 256], [896, 1024]], Role::Line { flat: true });
        assert_eq!(places(plan.line([end(1, 2), end(4, 4)])), flat);
        assert_eq!(places(plan.line([end(4, 4), end(1, 2)])), flat);
        let steep = ([[384, 256], [640, 256], [896, 1024]], Role::Line { flat: false });
        assert_eq!(places(plan.line([end(2, 1), end(4, 4)])), steep);
    }

    #[test]
    fn a_role_makes_no_vertex_longer() {
        assert_eq!(size_of::<PortVertex>(), 80);
    }
}
