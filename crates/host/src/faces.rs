//! Faces of many corners, which meshes keep as triangles, as polygons for POLY.
//!
//! ```text
//!  triangles of a face ─> sides that two of them share cancel ─> outline ─┬─ a plane holds its values ─> polygon
//!                                                                         └─ none does ─> the triangles, as they are
//! ```

use crate::polygon::{bends, on_port, tokens};
use crate::vertices::guard_band;
use edgewalk_machine::Plan;
use edgewalk_scene::{Blending, Frame, Polygon, Primitive, Scene, Surface, Triangle, Vertex, fits};
use std::collections::HashMap;

/// Colours at a corner that two triangles of a face share differ by no more, unless the face is shaded triangle by triangle: both
/// are made by the same equation of the same place, in f64.
const SAME_COLOUR: f64 = 1e-9;

/// The frame of a scene's surface with its faces as polygons, where the machine has POLY and a plane holds their values; other
/// faces stay the triangles that they are. So do all faces of a transparent frame, which is sorted triangle by triangle, and of a
/// machine with SHADOW.
#[must_use]
pub fn joined(frame: Frame, scene: &Scene, surface: &Surface, machine: &Plan) -> Frame {
    if !machine.polygon.is_there() || machine.shadow.is_there() || frame.blend != Blending::Off {
        return frame;
    }
    let (mut triangles, mut polygons) = (Vec::new(), Vec::new());
    let whole = scene.mesh.polygons();
    let face = |place: usize| whole[surface.triangles[place].face as usize];
    let mut first = 0;
    while first < frame.triangles.len() {
        let count = (first..frame.triangles.len()).take_while(|place| face(*place) == face(first)).count();
        let parts = &frame.triangles[first..first + count];
        match polygon(first, parts, &frame, machine) {
            Some(contour) => polygons.push(Polygon { contours: vec![contour], after: triangles.len() }),
            None => triangles.extend_from_slice(parts),
        }
        first += count;
    }
    Frame { triangles, polygons, ..frame }
}

/// How many triangles of the surface this polygon of a joined frame is made of: it has all their corners, and no other.
#[must_use]
pub fn parts(polygon: &Polygon) -> usize {
    polygon.contours.iter().map(|contour| contour.len().saturating_sub(2)).sum()
}

/// Of each primitive of a surface's frame, joined or not, the number of the mesh's face that it is or is a part of.
#[must_use]
pub fn faces(frame: &Frame, scene: &Scene, surface: &Surface) -> Vec<i32> {
    let (whole, mut first) = (scene.mesh.polygons(), 0);
    let face = |primitive: Primitive| {
        let face = whole[surface.triangles[first].face as usize] as i32; // a mesh has fewer
        first += match primitive {
            Primitive::Polygon(polygon) => parts(polygon),
            Primitive::Triangle(_) | Primitive::Line(_) => 1,
        };
        face
    };
    frame.primitives().into_iter().map(face).collect()
}

/// The outline of these triangles, if POLY draws it as one polygon.
fn polygon(place: usize, parts: &[Triangle], frame: &Frame, machine: &Plan) -> Option<Vec<Vertex>> {
    if parts.len() < 2 || !parts.iter().all(|part| fits(part, guard_band(machine))) {
        return None;
    }
    let contour = outline(parts)?;
    let outlined = Polygon { contours: vec![contour], after: 0 };
    let port = on_port(place, &outlined, frame, &frame.state(), machine).ok()?;
    let is_held =
        bends(&port, machine).iter().all(|bend| bend.is_held) && tokens(place, &port, machine).is_ok();
    outlined.contours.into_iter().next().filter(|_| is_held)
}

/// The one contour around the triangles, through all their corners; none if they hang together in another way, or differ in a
/// corner's colour.
fn outline(parts: &[Triangle]) -> Option<Vec<Vertex>> {
    let (mut corners, mut places) = (Vec::new(), HashMap::new());
    // From each corner the next one round; a side that runs the other way too is inside.
    let mut sides: Vec<[usize; 2]> = Vec::new();
    for Triangle(vertices) in parts {
        let mut place = [0; 3];
        for (place, vertex) in place.iter_mut().zip(vertices) {
            let at = [vertex.x, vertex.y, vertex.z, vertex.kt].map(f64::to_bits);
            *place = *places.entry(at).or_insert_with(|| {
                corners.push(*vertex);
                corners.len() - 1
            });
            let [own, first] = [vertex, &corners[*place]].map(|v| [v.r, v.g, v.b]);
            if own.iter().zip(first).any(|(own, first)| (own - first).abs() > SAME_COLOUR) {
                return None;
            }
        }
        sides.extend([0, 1, 2].map(|k| [place[k], place[(k + 1) % 3]]));
    }
    let all: HashMap<[usize; 2], usize> = sides.iter().fold(HashMap::new(), |mut all, side| {
        *all.entry(*side).or_default() += 1;
        all
    });
    if all.values().any(|count| *count > 1) {
        return None;
    }
    let outer = sides.iter().filter(|[from, to]| !all.contains_key(&[*to, *from]));
    let mut next: HashMap<usize, usize> = HashMap::new();
    for [from, to] in outer {
        if next.insert(*from, *to).is_some() {
            return None;
        }
    }
    let (mut contour, mut at) = (Vec::new(), 0);
    while let Some(to) = next.remove(&at) {
        contour.push(corners[at]);
        at = to;
    }
    (contour.len() == corners.len() && corners.len() == parts.len() + 2).then_some(contour)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f64; 2]; 3]) -> Triangle {
        Triangle(corners.map(|[x, y]| Vertex { x, y, ..Vertex::default() }))
    }

    const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]];

    fn square() -> [Triangle; 2] {
        let [a, b, c, d] = CORNERS;
        [triangle([a, b, c]), triangle([a, c, d])]
    }

    #[test]
    fn the_outline_of_two_triangles_is_a_square() {
        let contour = outline(&square()).expect("one contour");
        assert_eq!(contour.iter().map(|v| [v.x, v.y]).collect::<Vec<_>>(), CORNERS);
        assert_eq!(parts(&Polygon { contours: vec![contour], after: 0 }), 2);
    }

    #[test]
    fn triangles_that_are_no_face_have_no_outline() {
        let [upper, lower] = square();
        let apart = triangle([[9.0, 0.0], [9.0, 9.0], [8.0, 8.0]]);
        assert_eq!(outline(&[upper, apart]), None);
        assert_eq!(outline(&[upper, upper]), None);
        let mut turned = lower;
        turned.0.swap(0, 1);
        assert_eq!(outline(&[upper, turned]), None);
        let mut coloured = lower;
        coloured.0[0].r = 1e-8;
        assert_eq!(outline(&[upper, coloured]), None);
        coloured.0[0].r = 1e-10;
        assert!(outline(&[upper, coloured]).is_some());
    }
}
