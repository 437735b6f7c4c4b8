//! A polygon as the port takes it: three vertices a token, its plane last (`docs/machine.md`, section 19).
//!
//! ```text
//!  contours ─┬─> v0 v1 v2, edges   v2 v3 v4, edges   ..        two sides a token
//!            └─> three vertices far apart ─> edges and plane   the last token
//! ```

use crate::plan::Plan;
use crate::role::{Role, Sides, Window};
use crate::vertex::PortVertex;

/// Vertices, each with an edge to the next and the last with one to the first.
type Contour = Vec<PortVertex>;

impl Plan {
    /// The tokens of a polygon; none if it has no edge on a line of the window. Contours of fewer than three vertices
    /// draw nothing. The plane is that of [`Plan::far_apart`].
    #[must_use]
    pub fn polygon(&self, contours: &[Contour], window: Window) -> Vec<[PortVertex; 3]> {
        let mut contours: Vec<Contour> =
            contours.iter().filter(|contour| contour.len() > 2).cloned().collect();
        let all: Vec<PortVertex> = contours.iter().flatten().copied().collect();
        let Some(plane) = self.far_apart(&all) else { return Vec::new() };
        // A contour that can be turned so that its last token has a plane as good is the last one.
        let found = contours.iter().enumerate().find_map(|(place, contour)| {
            Some((place, (0..contour.len()).find(|first| area(&last(contour, *first)) >= area(&plane))?))
        });
        if let Some((place, first)) = found {
            let mut contour = contours.remove(place);
            contour.rotate_left(first);
            contours.push(contour);
        }
        let mut tokens: Vec<([PortVertex; 3], Sides)> = Vec::new();
        for contour in &contours {
            tokens.extend(self.edges(contour, window));
        }
        if tokens.is_empty() {
            return Vec::new();
        }
        // The last token's sides may lie outside the window: its plane is wanted all the same.
        let own = found.and_then(|_| contours.last()).map(|contour| last(contour, 0));
        let (plane, sides) = match (own, tokens.last()) {
            (Some(own), Some((vertices, sides))) if *vertices == own => {
                let sides = *sides;
                tokens.pop();
                (own, sides)
            }
            (Some(own), _) => (own, Sides::default()),
            (None, _) => (plane, Sides::default()),
        };
        let role = |vertices, role| self.with_window(self.with_role(vertices, role), window);
        let edges = tokens.into_iter().map(|(vertices, sides)| role(vertices, Role::Edges(sides)));
        edges.chain([role(plane, Role::Plane(sides))]).collect()
    }

    /// The edges of a contour that have a line in the window, two a token or all three of a triangle.
    fn edges(&self, contour: &Contour, window: Window) -> Vec<([PortVertex; 3], Sides)> {
        let has_lines = |edge: usize| {
            let ends = [edge, edge + 1].map(|end| self.first_pixel(contour[end % contour.len()].y()));
            let lines = self.lines_of(ends, window);
            !lines.is_empty()
        };
        let tokens = starts(contour).map(|(first, edges)| {
            let sides = [0, 1, 2].map(|side| side < edges && has_lines(first + side));
            (triple(contour, first), Sides::new(sides))
        });
        tokens.filter(|(_, sides)| sides.bits() > 0).collect()
    }

    /// The lines of an edge between these first lines, within the window and the screen.
    #[must_use]
    pub fn lines_of(&self, [a, b]: [i32; 2], window: Window) -> std::ops::Range<i32> {
        let end = window.y1.min(self.height) as i32; // at most 8192
        a.min(b).max(window.y0 as i32)..a.max(b).min(end)
    }

    /// The first column or line whose centre lies at or behind this coordinate of a vertex, in exact fill.
    #[must_use]
    pub fn first_pixel(&self, at: i32) -> i32 {
        match self.subpixel_bits {
            0 => at,
            s => (at + (1 << (s - 1)) - 1) >> s,
        }
    }

    /// Three vertices with at least half the area of any three: the two that are the farthest from each other, and the
    /// farthest from the line between them. All lie beside that line, not farther from it, and between its ends.
    #[must_use]
    pub fn far_apart(&self, vertices: &[PortVertex]) -> Option<[PortVertex; 3]> {
        let pairs = (0..vertices.len()).flat_map(|i| (0..i).map(move |j| [vertices[j], vertices[i]]));
        let [a, b] = pairs.max_by_key(|[a, b]| distance(a, b))?;
        let c = vertices.iter().max_by_key(|c| area(&[a, b, **c]))?;
        Some([a, b, *c])
    }

    /// All lines of the screen from the first of these vertices on, whose pixel is the start; of vertices above the
    /// screen or beside it a pixel at its border.
    #[must_use]
    pub fn window_from(&self, vertices: &[PortVertex]) -> Window {
        let Some(top) = vertices.iter().min_by_key(|vertex| vertex.y()) else { return Window::default() };
        let on = |at: i32, side: u32| self.first_pixel(at).clamp(0, side as i32 - 1) as u32;
        Window { x0: on(top.x(), self.width), y0: on(top.y(), self.height), ..Window::default() }
    }
}

impl Plan {
    /// A triangle or line with [`Plan::window_from`] its vertices; a flat line has its columns where others have lines. Without
    /// POLY it stays as it is.
    #[must_use]
    pub fn windowed(&self, vertices: [PortVertex; 3]) -> [PortVertex; 3] {
        if !self.polygon.is_there() {
            return vertices;
        }
        let window = match Role::of(&vertices) {
            Role::Line { flat: true } => {
                let first =
                    vertices.map(|vertex| self.first_pixel(vertex.y())).into_iter().min().unwrap_or(0);
                Window { y0: first.clamp(0, self.width as i32 - 1) as u32, ..Window::default() }
            }
            _ => self.window_from(&vertices),
        };
        self.with_window(vertices, window)
    }
}

/// The first vertex and the number of edges of each token of a contour.
fn starts(contour: &Contour) -> impl Iterator<Item = (usize, usize)> {
    let (edges, most) = (contour.len(), if contour.len() == 3 { 3 } else { 2 });
    (0..edges).step_by(most).map(move |first| (first, most.min(edges - first)))
}

fn triple(contour: &Contour, first: usize) -> [PortVertex; 3] {
    [0, 1, 2].map(|place| contour[(first + place) % contour.len()])
}

/// The vertices of the last token of a contour that begins with this vertex.
fn last(contour: &Contour, first: usize) -> [PortVertex; 3] {
    let begin = starts(contour).last().map_or(0, |(begin, _)| begin);
    triple(contour, first + begin)
}

fn distance(a: &PortVertex, b: &PortVertex) -> i64 {
    let [x, y] = [i64::from(b.x()) - i64::from(a.x()), i64::from(b.y()) - i64::from(a.y())];
    x * x + y * y
}

/// Twice the area, without its sign, 2^-2s px².
fn area([a, b, c]: &[PortVertex; 3]) -> i64 {
    let to = |p: &PortVertex| [i64::from(p.x()) - i64::from(a.x()), i64::from(p.y()) - i64::from(a.y())];
    let ([bx, by], [cx, cy]) = (to(b), to(c));
    (bx * cy - by * cx).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Machine;

    fn plan() -> Plan {
        let with = |m: &mut Machine| (m.polygon.edges, m.subpixel_bits) = (16, 1);
        Machine::default().with(with).plan().expect("can be built")
    }

    /// Corners in pixels.
    fn contour(plan: &Plan, corners: &[[i32; 2]]) -> Contour {
        corners.iter().map(|[x, y]| plan.raw_vertex(2 * x, 2 * y, &[])).collect()
    }

    fn shown(tokens: &[[PortVertex; 3]]) -> Vec<([[i32; 2]; 3], u32, u32)> {
        let places = |token: &[PortVertex; 3]| token.map(|v| [v.x() / 2, v.y() / 2]);
        tokens.iter().map(|t| (places(t), Role::of(t).kind(), Role::of(t).sides().bits())).collect()
    }

    #[test]
    fn a_square_is_two_tokens() {
        let plan = plan();
        let square = contour(&plan, &[[1, 1], [5, 1], [5, 4], [1, 4]]);
        let window = plan.window_from(&square);
        assert_eq!((window.x0, window.y0), (1, 1));
        let tokens = plan.polygon(&[square], window);
        // The edges along lines have none.
        let wanted = [([[1, 1], [5, 1], [5, 4]], 1, 0b010), ([[5, 4], [1, 4], [1, 1]], 2, 0b010)];
        assert_eq!(shown(&tokens), wanted);
        assert!(tokens.iter().all(|token| Window::of(token) == window));
    }

    #[test]
    fn a_plane_far_apart_ends_a_polygon() {
        let plan = plan();
        // Each three vertices side by side have a small part of the area.
        let round: Vec<[i32; 2]> = (0..12)
            .map(|k| f64::from(k) * std::f64::consts::TAU / 12.0)
            .map(|angle| [100 + (80.0 * angle.cos()) as i32, 100 + (80.0 * angle.sin()) as i32])
            .collect();
        let contours = [contour(&plan, &round)];
        let tokens = plan.polygon(&contours, Window::default());
        assert_eq!(tokens.len(), 7);
        let plane = tokens[6];
        assert_eq!(Role::of(&plane), Role::Plane(Sides::default()));
        let all = &contours[0];
        let largest = (0..12).flat_map(|i| (0..i).flat_map(move |j| (0..j).map(move |k| [i, j, k])));
        let largest = largest.map(|three| area(&three.map(|k| all[k]))).max().expect("some");
        assert!(2 * area(&plane) >= largest, "{} of {largest}", area(&plane));
        // In a window with the lower half alone fewer sides are left, but for the plane.
        let lower = plan.polygon(&contours, Window { y0: 101, ..Window::default() });
        assert!(lower.len() < 7 && Role::of(&lower[lower.len() - 1]) == Role::Plane(Sides::default()));
        assert!(plan.polygon(&contours, Window { y0: 181, ..Window::default() }).is_empty());
        assert!(plan.polygon(&[contour(&plan, &[[1, 1], [9, 9]])], Window::default()).is_empty());
    }
}
