//! Closed lines cut into triangles between their vertices.
//!
//! A constrained Delaunay triangulation of the vertices has every edge of the lines among its own; of its triangles those
//! are taken that have an odd number of edges on the way out. Its decisions are exact for the coordinates as they are.

use spade::handles::FixedVertexHandle;
use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, Intersection, LineIntersectionIterator, Point2,
    Triangulation,
};

/// The places, counted through all contours, of the corners of each triangle; they run counter-clockwise where y points
/// up. Edges may touch and lie in one another; of vertices in one place the last is taken.
///
/// # Errors
/// The vertex where an edge begins that crosses another, or that is no finite number or too small a one.
pub(crate) fn cut(contours: &[Vec<[f64; 2]>]) -> Result<Vec<[usize; 3]>, usize> {
    let mut mesh = Mesh::new();
    let mut edges = Vec::new();
    let mut before = 0;
    for contour in contours {
        let insert = |(i, place): (usize, &[f64; 2])| {
            let corner = Corner { vertex: before + i, place: Point2::new(place[0], place[1]) };
            mesh.insert(corner).map_err(|_| before + i)
        };
        let corners = contour.iter().enumerate().map(insert).collect::<Result<Vec<_>, _>>()?;
        for (i, from) in corners.iter().enumerate() {
            let to = corners[(i + 1) % corners.len()];
            if *from == to {
                continue;
            }
            if !mesh.can_add_constraint(*from, to) {
                return Err(before + i);
            }
            mesh.add_constraint(*from, to);
            edges.push([*from, to]);
        }
        before += contour.len();
    }
    let inside = inside(&mesh, &edges);
    let faces = mesh.inner_faces().filter(|face| inside[face.fix().index()] == Some(true));
    Ok(faces.map(|face| face.vertices().map(|corner| corner.data().vertex)).collect())
}

type Mesh = ConstrainedDelaunayTriangulation<Corner>;

struct Corner {
    vertex: usize,
    place: Point2<f64>,
}

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.place
    }
}

/// For each face whether it is inside: from the outer face inwards, every edge of the polygon changes sides.
fn inside(mesh: &Mesh, edges: &[[FixedVertexHandle; 2]]) -> Vec<Option<bool>> {
    // Edges of the polygon may lie in one another: what counts is how many lie here.
    let mut odd = vec![false; mesh.num_undirected_edges()];
    for [from, to] in edges {
        for hit in LineIntersectionIterator::new_from_handles(mesh, *from, *to) {
            if let Intersection::EdgeOverlap(edge) = hit {
                odd[edge.as_undirected().fix().index()] ^= true;
            }
        }
    }
    let mut inside = vec![None; mesh.num_all_faces()];
    inside[mesh.outer_face().fix().index()] = Some(false);
    let hull = mesh.convex_hull().flat_map(|edge| [edge, edge.rev()]);
    let mut border: Vec<_> = hull.filter(|edge| edge.is_outer_edge()).collect();
    while let Some(edge) = border.pop() {
        let here = inside[edge.face().fix().index()] == Some(true);
        let next = edge.rev().face();
        let slot = &mut inside[next.fix().index()];
        if slot.is_none() {
            *slot = Some(here ^ odd[edge.as_undirected().fix().index()]);
            border.extend(next.as_inner().into_iter().flat_map(|face| face.adjacent_edges()));
        }
    }
    inside
}
