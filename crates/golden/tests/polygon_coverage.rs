//! Coverage of polygons by edge tables against an exact point-in-polygon test at pixel centres.

use crate::shapes;
use crate::shapes::{
    Point, SCREEN, concave, convex, covered, doubled, expected, inside, inside_by_a_vertical_ray,
    random_point, random_points, star_with_hole,
};
use edgewalk_golden::polygon::{EdgeTable, Grid, fragments};
use edgewalk_scene::ShadeMode;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Polygons of every kind, by its number.
fn random_polygon(rng: &mut Pcg64, kind: usize, bits: u32) -> Vec<Vec<Point>> {
    match kind {
        0 => vec![convex(rng, bits)],
        1 => vec![concave(rng, bits)],
        // Crosses itself.
        2 => vec![random_points(rng, bits, 12)],
        3 => star_with_hole(rng, bits),
        // Several contours that cross each other.
        4 => (0..3).map(|_| random_points(rng, bits, 6)).collect(),
        // Vertices on corners and centres of pixels, many edges horizontal or in one another.
        5 => {
            let mut points = random_points(rng, 1, 12);
            for k in 1..points.len() {
                let axis = k % 2;
                points[k][axis] = points[k - 1][axis];
            }
            vec![points.into_iter().map(|p| p.map(|c| c << bits >> 1)).collect()]
        }
        // Giants: edges a million pixels long.
        _ => {
            let far = 1_000_000 << bits;
            vec![
                (0..5)
                    .map(|k| {
                        if k % 2 == 0 {
                            [0, 1].map(|_| rng.random_range(-far..=far))
                        } else {
                            random_point(rng, bits)
                        }
                    })
                    .collect(),
            ]
        }
    }
}

#[test]
fn ten_thousand_random_polygons_against_point_in_polygon() {
    let kinds = ["convex", "concave", "crossing itself", "hole", "contours", "horizontal", "giant"];
    let mut rng = Pcg64::seed_from_u64(10);
    let (mut checked, mut mismatches, mut by_two_rays) = ([0u64; 7], 0, 0u64);
    let mut full = [0u64; 7];
    for k in 0..10_003usize {
        let (kind, bits) = (k % 7, (k / 7 % 9) as u32);
        let contours = random_polygon(&mut rng, kind, bits);
        let (seen, wanted) = (covered(&contours, bits), expected(&contours, bits));
        checked[kind] += u64::from(SCREEN.0 * SCREEN.1);
        full[kind] += wanted.len() as u64;
        mismatches += seen.symmetric_difference(&wanted).count();
        // The ray of the test is tested too, by one that meets other edges.
        let (twice, centre) = doubled(&contours, bits);
        for (x, y) in (0..SCREEN.1).flat_map(|y| (0..SCREEN.0).map(move |x| (x, y))).step_by(7) {
            if let Some(odd) = inside_by_a_vertical_ray(&twice, centre(x, y)) {
                assert_eq!(odd, wanted.contains(&(x, y)), "the rays differ at {x} {y} of {contours:?}");
                by_two_rays += 1;
            }
        }
    }
    for (kind, name) in kinds.into_iter().enumerate() {
        println!("{name:<16} {:>8} pixels, {:>8} inside", checked[kind], full[kind]);
        assert!(full[kind] > checked[kind] / 50, "{name}: hardly anything inside");
    }
    let (sum, all) = (checked.iter().sum::<u64>(), 10_003 * u64::from(SCREEN.0 * SCREEN.1));
    println!("checked {sum} / {all} pixels, {by_two_rays} by two rays: {mismatches} mismatches");
    assert_eq!((sum, mismatches), (all, 0));
    assert!(by_two_rays > sum / 10);
}

/// The grid of the textbook fill: pixels at the corners where vertices are.
#[test]
fn whole_vertices_and_pixels_at_them_against_point_in_polygon() {
    let mut rng = Pcg64::seed_from_u64(14);
    let (mut checked, mut filled, mut mismatches) = (0, 0, 0);
    for k in 0..2_000 {
        let contours = random_polygon(&mut rng, k % 7, 0);
        let table = EdgeTable::new(&shapes::polygon(&contours, 0), ShadeMode::Gouraud, Grid::whole());
        let mut seen = shapes::Pixels::new();
        fragments(&table, SCREEN, |f| assert!(seen.insert((f.x, f.y)), "drawn twice"));
        for (x, y) in (0..SCREEN.1).flat_map(|y| (0..SCREEN.0).map(move |x| (x, y))) {
            let wanted = inside(&contours, [x, y].map(i64::from));
            mismatches += u32::from(wanted != seen.contains(&(x, y)));
            filled += u32::from(wanted);
            checked += 1;
        }
    }
    println!(
        "checked {checked} / {} pixels, {filled} inside: {mismatches} mismatches",
        2_000 * SCREEN.0 * SCREEN.1
    );
    assert_eq!((checked, mismatches), (2_000 * SCREEN.0 * SCREEN.1, 0));
    assert!(filled > checked / 20);
}

#[test]
fn two_contours_cover_what_either_covers_but_not_both() {
    let mut rng = Pcg64::seed_from_u64(11);
    let mut pixels = 0;
    for k in 0..2_000 {
        let bits = k % 9;
        let [a, b] = [0, 1].map(|_| random_points(&mut rng, bits, 8));
        let [one, other] = [&a, &b].map(|contour| covered(std::slice::from_ref(contour), bits));
        assert_eq!(covered(&[a.clone(), b.clone()], bits), &one ^ &other);
        assert!(covered(&[a.clone(), a.clone()], bits).is_empty(), "twice the same is nothing");
        pixels += one.len() + other.len();
    }
    assert!(pixels > 100_000);
}

#[test]
fn a_cut_polygon_covers_the_same_pixels_once() {
    let mut rng = Pcg64::seed_from_u64(12);
    let (mut pixels, mut disjoint) = (0, 0);
    for k in 0..4_000usize {
        let bits = (k % 9) as u32;
        let is_convex = k % 2 == 0;
        let whole = if is_convex { convex(&mut rng, bits) } else { random_points(&mut rng, bits, 12) };
        if whole.len() < 4 {
            continue;
        }
        let second = rng.random_range(2..whole.len() - 1);
        let near: Vec<Point> = whole[..=second].to_vec();
        let far: Vec<Point> = [&whole[second..], &whole[..1]].concat();
        let [one, other] = [near, far].map(|part| covered(&[part], bits));
        let all = covered(&[whole], bits);
        // The cut's edge is in both, so it cancels.
        assert_eq!(&one ^ &other, all);
        if is_convex {
            assert!(one.is_disjoint(&other));
            disjoint += 1;
        }
        pixels += all.len();
    }
    println!("{pixels} pixels, {disjoint} convex polygons in two");
    assert!(pixels > 100_000 && disjoint > 1_000);
}

#[test]
fn winding_start_and_whole_pixels_do_not_matter() {
    let mut rng = Pcg64::seed_from_u64(13);
    for k in 0..1_000 {
        let bits = k % 9;
        let points = random_points(&mut rng, bits, 10);
        let pixels = covered(std::slice::from_ref(&points), bits);
        let mut turned = points.clone();
        turned.rotate_left(rng.random_range(0..points.len()));
        assert_eq!(covered(&[turned.clone()], bits), pixels);
        turned.reverse();
        assert_eq!(covered(&[turned], bits), pixels);
        let moved: Vec<Point> = points.iter().map(|[x, y]| [x + (3 << bits), y + (2 << bits)]).collect();
        let back = covered(&[moved], bits)
            .into_iter()
            .filter_map(|(x, y)| Some((x.checked_sub(3)?, y.checked_sub(2)?)));
        let kept = pixels.iter().copied().filter(|(x, y)| x + 3 < SCREEN.0 && y + 2 < SCREEN.1);
        assert!(back.eq(kept));
    }
}

#[test]
fn nothing_is_covered_by_lines_points_and_slots_between_centres() {
    let cases: [&[Point]; 4] = [
        &[[3, 3], [40, 3], [20, 3]],
        &[[9, 9], [9, 9], [9, 9]],
        &[[3, 3], [40, 40], [20, 20]],
        // One sub-pixel below a line of centres to one above the next.
        &[[0, 9], [90, 9], [90, 23], [0, 23]],
    ];
    for points in cases {
        assert!(covered(&[points.to_vec()], 4).is_empty(), "{points:?}");
    }
    assert_eq!(covered(&[vec![[0, 8], [90, 8], [90, 23], [0, 23]]], 4).len(), 6, "8 is a centre: counted");
}
