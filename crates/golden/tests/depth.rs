//! The depth test, write mask, blending and what a picture records.

use edgewalk_golden::{Fill, NO_TRIANGLE, Picture, draw};
use edgewalk_scene::{Blending, DepthFunc, Frame, Triangle, Vertex};

const EXACT: Fill = Fill::Exact { subpixel_bits: 8 };

/// A triangle over a screen of 8 x 8, depth z0, z1, z2 at its corners.
fn over_all([z0, z1, z2]: [f64; 3], shade: f64) -> Triangle {
    let at = |x, y, z| Vertex { x, y, z, r: shade, g: shade, b: shade, kt: 0.25, ..Vertex::default() };
    Triangle([at(-1.0, -1.0, z0), at(30.0, -1.0, z1), at(-1.0, 30.0, z2)])
}

fn frame(depth: Option<DepthFunc>, triangles: Vec<Triangle>) -> Frame {
    Frame { depth, depth_write: depth.is_some(), triangles, ..Frame::new(8, 8) }
}

fn centre(picture: &Picture) -> (u32, u32, i32, f64, f64) {
    let at = 4 * 8 + 4;
    (picture.coverage[at], picture.writes[at], picture.id[at], picture.z[at], picture.rgb[at][0])
}

#[test]
fn each_function_against_the_cleared_depth() {
    let passes = |func, z: f64| centre(&draw(&frame(Some(func), vec![over_all([z; 3], 0.5)]), EXACT)).1 == 1;
    for (func, nearer, as_near) in [
        (DepthFunc::Never, false, false),
        (DepthFunc::Less, true, false),
        (DepthFunc::Equal, false, true),
        (DepthFunc::Lequal, true, true),
        (DepthFunc::Greater, false, false),
        (DepthFunc::Notequal, true, false),
        (DepthFunc::Gequal, false, true),
        (DepthFunc::Always, true, true),
    ] {
        assert_eq!((passes(func, 0.5), passes(func, 1.0)), (nearer, as_near), "{}", func.name());
    }
}

#[test]
fn farther_fragments_against_a_stored_depth() {
    let triangles = vec![over_all([0.5; 3], 0.1), over_all([0.6; 3], 0.9)];
    for (func, last) in [
        (DepthFunc::Less, (2, 1, 0, 0.5, 0.1)),
        (DepthFunc::Lequal, (2, 1, 0, 0.5, 0.1)),
        (DepthFunc::Notequal, (2, 2, 1, 0.6, 0.9)),
        (DepthFunc::Always, (2, 2, 1, 0.6, 0.9)),
    ] {
        assert_eq!(centre(&draw(&frame(Some(func), triangles.clone()), EXACT)), last, "{}", func.name());
    }
}

#[test]
fn the_same_plane_from_other_vertices_ties_exactly() {
    // One plane, z = 0.1 + 0.3 x + 0.6 y over the screen in numbers f64 cannot add without error, given by vertices in
    // different orders: every pixel ties, though the f64 depths differ in their last bits here and there.
    let [a, b, c] = over_all([0.1, 0.3, 0.7], 0.2).0;
    let first = Triangle([a, b, c]);
    let turned = [Triangle([b, c, a]), Triangle([c, a, b]), Triangle([a, c, b])];
    for (func, passed) in [(DepthFunc::Less, 1), (DepthFunc::Lequal, 4), (DepthFunc::Notequal, 1)] {
        let mut triangles = vec![first];
        triangles.extend(turned);
        let picture = draw(&frame(Some(func), triangles), EXACT);
        assert!(
            picture.writes.iter().all(|writes| *writes == passed),
            "{}: {:?}",
            func.name(),
            picture.writes
        );
    }
}

#[test]
fn a_zero_with_a_sign_is_as_near_as_one_without() {
    let triangles = vec![over_all([0.0; 3], 0.1), over_all([-0.0; 3], 0.9)];
    for (func, last) in [
        (DepthFunc::Less, (2, 1, 0, 0.0, 0.1)),
        (DepthFunc::Notequal, (2, 1, 0, 0.0, 0.1)),
        (DepthFunc::Lequal, (2, 2, 1, 0.0, 0.9)),
    ] {
        assert_eq!(centre(&draw(&frame(Some(func), triangles.clone()), EXACT)), last, "{}", func.name());
    }
}

#[test]
fn a_difference_below_the_last_bit_of_f64_decides() {
    // Two planes that differ by 2^-60 at most: f64 sees none of it at a depth near 1/2.
    let tiny = f64::from_bits(1);
    let nearly = over_all([0.5, 0.0, 0.5], 0.1);
    let Triangle([a, b, c]) = nearly;
    let above = Triangle([a, Vertex { z: tiny, ..b }, c]);
    let picture = draw(&frame(Some(DepthFunc::Less), vec![above, nearly]), EXACT);
    assert!(
        picture.writes.iter().all(|writes| *writes == 2),
        "the second is nearer by less than f64 can hold"
    );
    let picture = draw(&frame(Some(DepthFunc::Less), vec![nearly, above]), EXACT);
    assert!(picture.writes.iter().all(|writes| *writes == 1));
}

#[test]
fn without_depth_write_the_cleared_depth_stays() {
    let mut two = frame(Some(DepthFunc::Less), vec![over_all([0.5; 3], 0.1), over_all([0.6; 3], 0.9)]);
    two.depth_write = false;
    assert_eq!(centre(&draw(&two, EXACT)), (2, 2, 1, 1.0, 0.9));
}

#[test]
fn without_depth_write_ties_are_against_the_cleared_depth() {
    let mut two = frame(Some(DepthFunc::Lequal), vec![over_all([0.5; 3], 0.1), over_all([1.0; 3], 0.9)]);
    two.depth_write = false;
    assert_eq!(centre(&draw(&two, EXACT)), (2, 2, 1, 1.0, 0.9));
}

#[test]
fn constant_depths_one_bit_apart_are_told_apart() {
    let near = 0.3;
    let far = f64::from_bits(f64::to_bits(near) + 1);
    for (depths, writes) in [([far, near], 2), ([near, far], 1), ([near, near], 1)] {
        let triangles = depths.map(|z| over_all([z; 3], 0.5)).to_vec();
        assert_eq!(centre(&draw(&frame(Some(DepthFunc::Less), triangles), EXACT)).1, writes, "{depths:?}");
    }
}

#[test]
fn depth_off_draws_everything_in_list_order() {
    let picture = draw(&frame(None, vec![over_all([0.1; 3], 0.1), over_all([1.0; 3], 0.9)]), EXACT);
    assert_eq!(centre(&picture), (2, 2, 1, 1.0, 0.9));
}

#[test]
fn empty_pixels_keep_what_they_were_cleared_to() {
    let empty = Frame { clear: [0.1, 0.2, 0.3], ..frame(Some(DepthFunc::Less), Vec::new()) };
    let picture = draw(&empty, EXACT);
    assert_eq!(
        (picture.coverage[9], picture.writes[9], picture.id[9], picture.z[9]),
        (0, 0, NO_TRIANGLE, 1.0)
    );
    assert_eq!(picture.rgb[9], [0.1, 0.2, 0.3]);
}

#[test]
fn blending_mixes_by_the_transmission_coefficient() {
    // kt = 1/4 over black, then over that.
    let mut two = frame(None, vec![over_all([0.5; 3], 1.0), over_all([0.5; 3], 0.5)]);
    assert_eq!(centre(&draw(&two, EXACT)).4, 0.5, "without blend kt has no effect");
    two.blend = Blending::Mix;
    assert_eq!(centre(&draw(&two, EXACT)).4, 0.75 * 0.5 + 0.25 * 0.75);
}
