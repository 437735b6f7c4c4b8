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
    fn a_role_makes_no_vertex_longer() {
        assert_eq!(size_of::<PortVertex>(), 80);
    }
}
