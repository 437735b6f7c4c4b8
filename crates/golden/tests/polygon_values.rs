//! Values in polygons: the plane in triangles, l_a, l_b and l_p in exact rationals elsewhere.
#![allow(clippy::unwrap_used)] // finite numbers have rationals

use crate::shapes;
use crate::shapes::SCREEN;
use edgewalk_golden::polygon::{self, EdgeTable, Grid};
use edgewalk_golden::{Fragment, fragments, snap};
use edgewalk_scene::{Polygon, ShadeMode, Triangle, Vertex};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use std::collections::BTreeMap;

fn vertex(rng: &mut Pcg64, [x, y]: [f64; 2]) -> Vertex {
    let [z, r, g, b, kt] = std::array::from_fn(|_| rng.random_range(0.0..=1.0));
    Vertex { x, y, z, r, g, b, kt, ..Vertex::default() }
}

fn one_contour(vertices: &[Vertex]) -> Polygon {
    Polygon { contours: vec![vertices.to_vec()], after: 0 }
}

#[test]
fn a_triangle_drawn_as_a_polygon_is_its_plane() {
    let mut rng = Pcg64::seed_from_u64(20);
    let (mut checked, mut expected, mut worst) = (0, 0, 0.0f64);
    for k in 0..3000 {
        let (reach, bits) = ([12.0, 100.0, 9e5][k % 3], (k % 9) as u32);
        let mode = ShadeMode::ALL[k / 3 % 2];
        let triangle = Triangle(std::array::from_fn(|_| {
            let place = [12.0, 10.0].map(|middle| middle + rng.random_range(-reach..reach));
            vertex(&mut rng, place)
        }));
        let values = |z: f64, [r, g, b]: [f64; 3], kt: f64| [z, r, g, b, kt];
        let mut plane = BTreeMap::new();
        fragments(&triangle, mode, bits, SCREEN, |f| {
            plane.insert((f.x, f.y), values(f.z(), f.rgb(), f.kt()));
        });
        expected += plane.len();
        let table = EdgeTable::new(&one_contour(&triangle.0), mode, Grid::subpixels(bits));
        polygon::fragments(&table, SCREEN, |f| {
            let plane = plane[&(f.x, f.y)];
            for (value, plane) in values(f.z(), f.rgb(), f.kt()).into_iter().zip(plane) {
                worst = worst.max((value - plane).abs());
            }
            checked += 1;
        });
    }
    println!("checked {checked} / {expected} pixels of triangles, largest difference {worst:.2e}");
    assert!(checked == expected && checked > 200_000);
    assert!(worst < 1e-12);
}

fn rational(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap()
}

/// The formulae of the slides as they stand: l_a and x_a on each edge that crosses the line, l_p between those on either side of the pixel.
fn bilinear(
    polygon: &Polygon,
    bits: u32,
    (px, py): (u32, u32),
    attribute: fn(&Vertex) -> f64,
) -> BigRational {
    let place = |c: f64| rational(snap(c, bits) as f64 / f64::from(1u32 << bits));
    let [x, y] = [px, py].map(|pixel| rational(f64::from(pixel) + 0.5));
    let mut crossings = Vec::new();
    for contour in &polygon.contours {
        for (i, v) in contour.iter().enumerate() {
            let w = &contour[(i + 1) % contour.len()];
            let (one, two) = if place(v.y) < place(w.y) { (v, w) } else { (w, v) };
            let (y1, y2) = (place(one.y), place(two.y));
            if y1 <= y && y < y2 {
                let between =
                    |a: BigRational, b: BigRational| (a * (&y2 - &y) + b * (&y - &y1)) / (&y2 - &y1);
                let x = between(place(one.x), place(two.x));
                crossings.push((x, between(rational(attribute(one)), rational(attribute(two)))));
            }
        }
    }
    crossings.sort_by(|a, b| a.0.cmp(&b.0));
    let (xa, la) = crossings.iter().rev().find(|(crossing, _)| *crossing <= x).unwrap();
    let (xb, lb) = crossings.iter().find(|(crossing, _)| *crossing > x).unwrap();
    (la * (xb - &x) + lb * (&x - xa)) / (xb - xa)
}

#[test]
fn values_are_linear_along_edges_then_along_the_line() {
    let mut rng = Pcg64::seed_from_u64(21);
    let (mut checked, mut worst) = (0, 0.0f64);
    for k in 0..1500 {
        let bits = (k % 9) as u32;
        let contours = match k % 3 {
            0 => vec![shapes::convex(&mut rng, bits)],
            1 => vec![shapes::concave(&mut rng, bits)],
            _ => shapes::star_with_hole(&mut rng, bits),
        };
        let mut polygon = shapes::polygon(&contours, bits);
        for v in polygon.contours.iter_mut().flatten() {
            *v = vertex(&mut rng, [v.x, v.y]);
        }
        let table = EdgeTable::new(&polygon, ShadeMode::Gouraud, Grid::subpixels(bits));
        let mut shown = 0;
        polygon::fragments(&table, SCREEN, |f| {
            shown += 1;
            if shown % 16 != 1 {
                return; // rationals are slow, and neighbours are alike
            }
            let exact = bilinear(&polygon, bits, (f.x, f.y), |v| v.z);
            assert_eq!(f.exact(|v| v.z), exact, "{polygon:?} at {} {}", f.x, f.y);
            let error = ((rational(f.z()) - &exact) / &exact).abs().to_f64().unwrap();
            worst = worst.max(error / Fragment::UNCERTAINTY);
            checked += 1;
        });
    }
    println!("{checked} values exact, worst relative error of the f64 {worst:.3} of the bound");
    assert!(checked > 10_000);
    assert!(worst <= 1.0 && worst > 0.1);
}

#[test]
fn what_lies_in_a_plane_stays_in_it() {
    let mut rng = Pcg64::seed_from_u64(22);
    let (mut checked, mut worst) = (0, 0.0f64);
    for k in 0..900 {
        let bits = (k % 9) as u32;
        let contours = vec![shapes::concave(&mut rng, bits)];
        let [a, b] = [0, 1].map(|_| rng.random_range(-0.01..0.01));
        let plane = |x: f64, y: f64| 0.5 + a * (x - 12.0) + b * (y - 10.0);
        let mut polygon = shapes::polygon(&contours, bits);
        polygon.contours.iter_mut().flatten().for_each(|v| v.z = plane(v.x, v.y));
        let table = EdgeTable::new(&polygon, ShadeMode::Gouraud, Grid::subpixels(bits));
        polygon::fragments(&table, SCREEN, |f| {
            worst = worst.max((f.z() - plane(f64::from(f.x) + 0.5, f64::from(f.y) + 0.5)).abs());
            checked += 1;
        });
    }
    println!("{checked} values in planes, largest difference {worst:.2e}");
    assert!(checked > 50_000 && worst < 1e-14);
}

/// The value in the middle of a square whose corners are 1, 0, 0, 0 in turn, upright or standing on its first corner.
fn middle_of_the_square(upright: bool) -> BigRational {
    let places = if upright {
        [[2.5, 2.5], [8.5, 2.5], [8.5, 8.5], [2.5, 8.5]]
    } else {
        [[5.5, 0.5], [10.5, 5.5], [5.5, 10.5], [0.5, 5.5]]
    };
    let corner =
        |k: usize| Vertex { x: places[k][0], y: places[k][1], r: f64::from(k == 0), ..Vertex::default() };
    let square = one_contour(&[0, 1, 2, 3].map(corner));
    let table = EdgeTable::new(&square, ShadeMode::Gouraud, Grid::subpixels(1));
    let mut value = BigRational::zero();
    polygon::fragments(&table, SCREEN, |f| {
        if (f.x, f.y) == (5, 5) {
            value = f.exact(|v| v.r);
        }
    });
    value
}

#[test]
fn a_quad_changes_its_values_when_it_is_turned() {
    // Upright: l_a = 1/2, l_b = 0. On its corner: both corners on the line are 0.
    assert_eq!(middle_of_the_square(true), rational(0.25));
    assert_eq!(middle_of_the_square(false), rational(0.0));
}

#[test]
fn flat_takes_colour_from_the_first_vertex_of_all() {
    let mut rng = Pcg64::seed_from_u64(23);
    let mut polygon = shapes::polygon(&shapes::star_with_hole(&mut rng, 4), 4);
    for v in polygon.contours.iter_mut().flatten() {
        *v = vertex(&mut rng, [v.x, v.y]);
    }
    let first = polygon.contours[0][0];
    let mut depths = Vec::new();
    polygon::fragments(&EdgeTable::new(&polygon, ShadeMode::Flat, Grid::subpixels(4)), SCREEN, |f| {
        assert_eq!((f.rgb(), f.kt()), ([first.r, first.g, first.b], first.kt));
        depths.push(f.z());
    });
    depths.dedup();
    assert!(depths.len() > 5, "depth varies in flat mode too");
}
