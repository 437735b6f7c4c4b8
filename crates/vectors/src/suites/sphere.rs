//! A small shaded ball before a wall: many triangles that share edges, near ones over far ones.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::{Plan, PortVertex};
use std::f64::consts::{PI, TAU};

const RINGS: u32 = 6;
const SECTORS: u32 = 8;
/// Direction to the light, length 1.
const LIGHT: [f64; 3] = [-0.48, -0.6, 0.64];

pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    let pen = Pen::new(machine);
    vec![case("wall", wall(&pen)), case("ball", ball(&pen))]
}

/// The side of the square at the screen's top left that is drawn on, px: a small picture on any screen.
fn side(pen: &Pen) -> f64 {
    let (w, h) = pen.size();
    w.min(h).min(20.0)
}

fn wall(pen: &Pen) -> [Triangle; 2] {
    let s = side(pen);
    let corner = |x: f64, y: f64| pen.vertex((x, y), [0.75 + 0.1 * y / s, 0.2, 0.3 * x / s, 0.5]);
    let (a, b, c, d) = (corner(0.0, 0.0), corner(s, 0.0), corner(s, s), corner(0.0, s));
    [[a, b, c], [a, c, d]]
}

fn ball(pen: &Pen) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let corner = |i, j| on_ball(pen, ring + i, sector + j);
            triangles.push([corner(0, 0), corner(1, 0), corner(1, 1)]);
            triangles.push([corner(0, 0), corner(1, 1), corner(0, 1)]);
        }
    }
    triangles
}

/// A vertex of the ball, shaded by Lambert's law with some ambient light.
fn on_ball(pen: &Pen, ring: u32, sector: u32) -> PortVertex {
    let polar = PI * f64::from(ring) / f64::from(RINGS);
    let around = TAU * f64::from(sector) / f64::from(SECTORS) + 0.2;
    let n = [polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin()];
    let lambert = (0..3).map(|i| n[i] * LIGHT[i]).sum::<f64>().max(0.0);
    let shade = 0.2 + 0.8 * lambert;
    let radius = 0.42 * side(pen);
    let middle = 0.5 * side(pen);
    let at = (middle + radius * n[0], middle + radius * n[1]);
    pen.vertex(at, [0.5 - 0.3 * n[2], shade, 0.7 * shade, 0.3 * shade])
}
