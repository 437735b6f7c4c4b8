//! The average at a vertex around which very many faces lie, as at the tip of a fan: without going through all of them for each of them.
//!
//! ```text
//!  normals of the faces ─> halves, halves of halves, .. down to LEAF normals, each with its ball and its sum
//!  one face ─> all of a ball within the angle? its sum : none of it? nothing : ask its halves
//! ```

use super::Crease;
use glam::DVec3;
use std::collections::HashMap;

/// From so many faces on a vertex is crowded. Up to here their sum is built face by face, and so always in the order of the mesh.
pub(super) const CROWDED: usize = 1 << 10;

/// Normals of a part that is not cut any more.
const LEAF: usize = 16;

/// A face at the vertex.
#[derive(Clone, Copy)]
pub(super) struct Member {
    /// Normal of the face; zero for a face without area.
    pub normal: DVec3,
    /// Smoothing group of the face.
    pub group: u32,
    /// What it counts.
    pub weight: f64,
}

/// The faces at the vertex.
pub(super) enum Crowd {
    /// Faces within an angle are one surface: its cosine.
    ByAngle(f64, Tree),
    /// Faces of a group are one surface: the sum of each.
    ByGroup(HashMap<u32, DVec3>),
}

impl Crowd {
    /// All faces at the vertex.
    pub(super) fn new(members: Vec<Member>, crease: Crease) -> Crowd {
        match crease {
            Crease::Angle(angle) => Crowd::ByAngle(angle.cos(), Tree::new(members)),
            Crease::Groups => {
                let mut groups = HashMap::new();
                for Member { normal, group, weight } in members {
                    *groups.entry(group).or_insert(DVec3::ZERO) += normal * weight;
                }
                Crowd::ByGroup(groups)
            }
        }
    }

    /// The sum of the normals that are one surface with this face, each by what it counts.
    pub(super) fn sum(&self, own: Member) -> DVec3 {
        match self {
            Crowd::ByAngle(cosine, tree) => tree.sum(own.normal, *cosine),
            Crowd::ByGroup(groups) if own.group != 0 => groups.get(&own.group).copied().unwrap_or_default(),
            Crowd::ByGroup(_) => own.normal * own.weight, // group 0 smooths nothing
        }
    }
}

/// Normals, cut in halves again and again.
pub(super) struct Tree {
    members: Vec<Member>,
    /// The first is all.
    parts: Vec<Part>,
}

/// Some of the normals.
struct Part {
    first: usize,
    end: usize,
    /// All of them lie in this ball.
    center: DVec3,
    radius: f64,
    sum: DVec3,
    /// Places of its halves; none of a leaf.
    halves: Option<[usize; 2]>,
}

/// What rounding may do to a dot product of two unit vectors, and more.
const ROUNDING: f64 = 1e-12;

impl Tree {
    fn new(mut members: Vec<Member>) -> Tree {
        let mut parts = Vec::new();
        let end = members.len();
        cut(&mut members, 0, end, &mut parts);
        Tree { members, parts }
    }

    fn sum(&self, own: DVec3, cosine: f64) -> DVec3 {
        let (mut sum, mut open) = (DVec3::ZERO, vec![0]);
        while let Some(place) = open.pop() {
            let Part { first, end, center, radius, halves, .. } = self.parts[place];
            let (middle, reach) = (own.dot(center), own.length() * radius + ROUNDING);
            if middle + reach < cosine {
                continue;
            }
            match halves {
                _ if middle - reach >= cosine => sum += self.parts[place].sum,
                Some(halves) => open.extend(halves),
                None => {
                    let within = self.members[first..end].iter().filter(|m| m.normal.dot(own) >= cosine);
                    sum += within.map(|member| member.normal * member.weight).sum::<DVec3>();
                }
            }
        }
        sum
    }
}

/// Cuts these members across the longest side of their box, and adds them and their parts. Returns their place.
fn cut(all: &mut [Member], first: usize, end: usize, parts: &mut Vec<Part>) -> usize {
    let members = &mut all[first..end];
    let start = members.first().map_or(DVec3::ZERO, |member| member.normal);
    let bounds = |[low, high]: [DVec3; 2], member: &Member| [low.min(member.normal), high.max(member.normal)];
    let [low, high] = members.iter().fold([start; 2], bounds);
    let (center, side) = ((low + high) / 2.0, high - low);
    let (radius, count) = (side.length() / 2.0, members.len());
    let sum = members.iter().map(|member| member.normal * member.weight).sum();
    let place = parts.len();
    parts.push(Part { first, end, center, radius, sum, halves: None });
    // Equal normals are a part, however many there are.
    if count > LEAF && side.max_element() > 0.0 {
        let axis = if side.x >= side.max_element() {
            0
        } else if side.y >= side.z {
            1
        } else {
            2
        };
        members.select_nth_unstable_by(count / 2, |a, b| a.normal[axis].total_cmp(&b.normal[axis]));
        let middle = first + count / 2;
        let halves = [cut(all, first, middle, parts), cut(all, middle, end, parts)];
        parts[place].halves = Some(halves);
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crowd_sums_what_face_by_face_does() {
        // A cone, a bundle of equal normals, normals all over the sphere, and faces without area.
        let around = |k: u32| f64::from(k) * 2.399_963; // the golden angle
        let normals = (0..3000u32).map(|k| match k % 4 {
            0 => DVec3::new(around(k).cos(), around(k).sin(), 0.5).normalize(),
            1 => DVec3::Z,
            2 => {
                let z = 1.0 - 2.0 * f64::from(k) / 3000.0;
                let r = (1.0 - z * z).sqrt();
                DVec3::new(r * around(k).cos(), r * around(k).sin(), z)
            }
            _ => DVec3::ZERO,
        });
        let member =
            |(normal, k): (DVec3, u32)| Member { normal, group: k % 3, weight: f64::from(k % 5) + 0.5 };
        let members: Vec<Member> = normals.zip(0..).map(member).collect();
        let mut compared = 0;
        for angle in [0.0, 0.3, 1.0, 1.6, std::f64::consts::PI] {
            let crowd = Crowd::new(members.clone(), Crease::Angle(angle));
            for own in members.iter().step_by(7) {
                let within = members.iter().filter(|other| other.normal.dot(own.normal) >= angle.cos());
                let expected: DVec3 = within.map(|other| other.normal * other.weight).sum();
                let found = crowd.sum(*own);
                assert!(found.distance(expected) < 1e-9, "{angle}: {found}, not {expected}");
                compared += 1;
            }
        }
        let crowd = Crowd::new(members.clone(), Crease::Groups);
        for own in members.iter().step_by(7) {
            let alike = members.iter().filter(|other| other.group == own.group);
            let all: DVec3 = alike.map(|other| other.normal * other.weight).sum();
            let expected = if own.group == 0 { own.normal * own.weight } else { all };
            assert!(crowd.sum(*own).distance(expected) < 1e-9, "group {}", own.group);
            compared += 1;
        }
        println!("compared {compared} sums");
        assert_eq!(compared, 6 * 429);
    }
}
