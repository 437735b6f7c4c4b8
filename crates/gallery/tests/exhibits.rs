//! What the exhibits show, against what theory says of them.
#![allow(clippy::unwrap_used)] // a test may

use edgewalk_gallery::{EXHIBITS, Exhibit, Image};

fn exhibit(name: &str) -> Exhibit {
    let (_, make) = EXHIBITS.iter().find(|(known, _)| *known == name).unwrap();
    make().unwrap()
}

/// The figure whose name begins so.
fn figure(exhibit: &Exhibit, quantity: &str) -> f64 {
    let found: Vec<_> = exhibit.figures.iter().filter(|(name, _)| name.starts_with(quantity)).collect();
    assert_eq!(found.len(), 1, "{quantity} in {:?}", exhibit.figures);
    found[0].1.parse().unwrap()
}

#[test]
fn every_exhibit_has_a_picture_and_a_figure() {
    let mut checked = 0;
    for (name, make) in EXHIBITS {
        let exhibit = make().unwrap();
        assert_eq!(exhibit.name, name);
        assert!(!exhibit.figures.is_empty() && !exhibit.views.is_empty(), "{name}");
        for (quantity, value) in &exhibit.figures {
            println!("{name}: {quantity}: {value}");
        }
        for view in &exhibit.views {
            match &view.image {
                Image::Colors { width, height, rgb } => {
                    assert_eq!(rgb.len(), (width * height) as usize);
                    assert!(rgb.iter().any(|c| c != &rgb[0]), "{name} {}: one colour", view.name);
                }
                Image::Drawing(svg) => assert!(svg.contains("polyline") && !svg.contains("NaN")),
            }
        }
        checked += 1;
    }
    println!("checked {checked} / {}", EXHIBITS.len());
}

#[test]
fn the_slope_jumps_at_edges_alone() {
    let mach = exhibit("mach-bands");
    let [gouraud, phong] = ["Gouraud", "Phong"].map(|of| figure(&mach, &format!("{of}: mean jump")));
    assert!(gouraud > 0.5 && phong < gouraud / 2.0, "{gouraud} {phong}");
    assert!(figure(&mach, "Gouraud: largest change") < 0.001, "a triangle is a plane");
}

#[test]
fn gouraud_misses_the_highlight_and_phong_does_not() {
    let missed = exhibit("missed-highlight");
    let [gouraud, phong, truth] =
        ["Gouraud", "Phong", "truth"].map(|of| figure(&missed, &format!("brightest green, {of}")));
    assert!(truth - gouraud > 100.0 && (truth - phong).abs() < 30.0, "{gouraud} {phong} {truth}");
}

/// Along the line through the middle lie two edges' middles at 0 degrees, and two white corners at 45.
#[test]
fn a_turned_quad_hears_of_other_corners() {
    let turned = exhibit("orientation");
    assert!((figure(&turned, "middle of the square") - 127.5).abs() < 1.0);
    let at_45 = figure(&turned, "at 45");
    assert!(at_45.min(255.0 - at_45) < 3.0, "{at_45}");
}

#[test]
fn cuts_and_columns_divide_their_faults_by_the_square() {
    let perspective = exhibit("perspective");
    assert!(figure(&perspective, "largest displacement") > 0.5);
    assert!((3.0..5.0).contains(&figure(&perspective, "cut 16 by 16")));
    let silhouette = exhibit("silhouette");
    let ratio = figure(&silhouette, "16 by 8") / figure(&silhouette, "48 by 24");
    assert!((6.0..12.0).contains(&ratio), "{ratio}, 9 expected");
}

#[test]
fn systems_are_the_better_the_more_they_interpolate() {
    let systems = exhibit("systems");
    let mean = |of: &str| figure(&systems, &format!("{of}: mean"));
    let [constant, gouraud, phong] = ["constant, own normal (S5)", "Gouraud (S6)", "Phong (S8)"].map(mean);
    assert!(constant > 1.5 * gouraud && gouraud > 5.0 * phong, "{constant} {gouraud} {phong}");
}

#[test]
fn folds_vanish_under_averages_and_return_with_a_crease() {
    let folds = exhibit("averaged-normals");
    let range = |of: &str| figure(&folds, of);
    assert!(range("range of intensity") > 50.0 && range("Gouraud, normals averaged by angle") < 2.0);
    assert!((range("Gouraud, crease") - range("range of intensity")).abs() < 2.0);
}

#[test]
fn a_finer_grid_leaves_fewer_gaps_at_a_t_joint() {
    let joint = exhibit("t-joint");
    let gaps = |bits: &str| {
        let quantity = format!("100 slanted edges, {bits} sub-pixel bits: pixels missed, drawn twice");
        let (_, counts) = joint.figures.iter().find(|(name, _)| *name == quantity).unwrap();
        counts.split(", ").map(|count| count.parse::<u32>().unwrap()).sum::<u32>()
    };
    let [fine, middling, coarse] = ["8", "4", "0"].map(gaps);
    assert!(fine < middling && middling < coarse && coarse > 100, "{fine} {middling} {coarse}");
    assert!((figure(&joint, "step of the intensity") - 127.5).abs() < 3.0);
}

#[test]
fn the_worked_example_by_its_numbers() {
    let worked = exhibit("worked-example");
    let expected = [
        ("step a line from 10 to 20", -0.07),
        ("step a line from 10 to 30", -0.03),
        ("step a line from 20 to 30", 0.01),
        ("line 15, left", 0.55),
        ("line 15, right", 0.75),
        ("step a pixel, in ten", 0.02),
        ("step a pixel, as drawn", 0.021053),
    ];
    for (quantity, value) in expected {
        assert_eq!(figure(&worked, quantity), value, "{quantity}");
    }
}

/// The border is at most as long as two pixels a line and side.
#[test]
fn polygons_have_their_areas() {
    let polygons = exhibit("polygons");
    let value = |place: usize| polygons.figures[place].1.parse::<f64>().unwrap();
    for (pixels, area) in [(1, 2), (3, 4)] {
        assert!((value(pixels) - value(area)).abs() < 0.005 * value(area), "{:?}", polygons.figures);
    }
    assert_eq!(value(0), 6.0);
}

#[test]
fn shadows_of_glass_are_products_and_finer_maps_are_nearer_to_rays() {
    let glass = exhibit("glass");
    let lit = ["r_l beside", "under the red", "under the blue", "under both"].map(|of| figure(&glass, of));
    assert_eq!(lit, [1.0, 0.6, 0.5, 0.3]);
    assert!(figure(&glass, "panes bent") >= 1.0);
    let shadows = exhibit("shadows");
    let [coarse, fine] = ["128", "1024"]
        .map(|size| figure(&shadows, &format!("of them other than by rays, maps of {size} x {size}")));
    assert!(fine < coarse / 2.0 && fine < 0.02 * figure(&shadows, "pixels that show"), "{coarse} {fine}");
}

#[test]
fn light_adds() {
    let lights = exhibit("lights");
    assert!(figure(&lights, "pixels where") > 1000.0 && figure(&lights, "largest difference") < 1e-9);
}

#[test]
fn the_machine_shows_the_texels_that_golden_shows() {
    let texture = exhibit("texture");
    let [pixels, differ, unexplained] =
        ["pixels that look up", "of them another texel", "not explained by the error of u"]
            .map(|of| figure(&texture, &format!("machine: {of}")));
    assert!(
        pixels > 10_000.0 && differ < pixels / 100.0 && unexplained == 0.0,
        "{pixels} {differ} {unexplained}"
    );
    let [error, bound] =
        ["largest error against fast", "proved bound"].map(|of| figure(&texture, &format!("machine: {of}")));
    assert!(error > 0.5 && error <= bound, "{error} {bound}");
}

#[test]
fn the_machine_turns_normals_as_golden_does() {
    let relief = exhibit("relief");
    assert!(
        figure(&relief, "pixels that the relief changes") > 5000.0
            && figure(&relief, "largest change") > 20.0
    );
    for who in ["machine, Phong", "machine"] {
        let of = |quantity: &str| figure(&relief, &format!("{who}: {quantity}"));
        let (error, bound) = (of("largest error against"), of("proved bound"));
        assert!(error > 0.5 && error <= bound && bound < 16.0, "{who}: {error} {bound}");
        assert!(of("pixels that look up") > 10_000.0 && of("not explained") == 0.0);
    }
}

#[test]
fn the_machine_shades_under_a_light_at_a_point_as_golden_does() {
    let lamp = exhibit("lamp");
    let of = |quantity: &str| figure(&lamp, &format!("machine, Phong: {quantity}"));
    let (error, bound) = (of("largest error against"), of("proved bound"));
    assert!(error > 0.5 && error <= bound && bound < 16.0, "{error} {bound}");
}
