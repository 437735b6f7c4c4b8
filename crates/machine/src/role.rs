//! What three vertices at the port are: a triangle, or a line.

use crate::plan::Plan;
use crate::vertex::PortVertex;

/// What the three vertices of a token are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Role {
    /// A triangle.
    #[default]
    Triangle,
    /// A line, a pixel wide: the upper end, the same a pixel to the right, the lower end.
    Line {
        /// The vertices have x and y exchanged: the line runs along a row of pixels.
        flat: bool,
    },
}

impl Role {
    /// The role of three vertices, as the port has it.
    #[must_use]
    pub fn of(vertices: &[PortVertex; 3]) -> Role {
        vertices[1].role
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

    /// The vertices in this role; in a machine that takes no lines they are a triangle.
    #[must_use]
    pub fn with_role(&self, mut vertices: [PortVertex; 3], role: Role) -> [PortVertex; 3] {
        vertices[1].role = if self.polygon.has_lines() { role } else { Role::Triangle };
        vertices
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Machine;
    use crate::polygon::Lines;

    #[test]
    fn a_role_is_seen_where_the_port_takes_lines() {
        let line = Role::Line { flat: true };
        for (lines, seen) in [(Lines::No, Role::Triangle), (Lines::Yes, line)] {
            let plan = Machine::default().with(|m| m.polygon.lines = lines).plan().expect("can be built");
            let vertices = [plan.raw_vertex(1, 2, &[3]); 3];
            assert_eq!(Role::of(&vertices), Role::Triangle);
            assert_eq!(Role::of(&plan.with_role(vertices, line)), seen);
        }
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
