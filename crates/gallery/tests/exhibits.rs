//! What the exhibits show, against what theory says of them.
#![allow(clippy::unwrap_used)] // a test may

use std::sync::OnceLock;

use edgewalk_gallery::{EXHIBITS, Exhibit, Image};

/// Each exhibit is drawn once for all tests.
static DRAWN: [OnceLock<Exhibit>; EXHIBITS.len()] = [const { OnceLock::new() }; EXHIBITS.len()];

fn exhibit(name: &str) -> &'static Exhibit {
    let place = EXHIBITS.iter().position(|(known, _)| *known == name).unwrap();
    DRAWN[place].get_or_init(|| EXHIBITS[place].1().unwrap())
}

/// The figure whose name begins so.
fn figure(exhibit: &Exhibit, quantity: &str) -> f64 {
    let found: Vec<_> = exhibit.figures.iter().filter(|(name, _)| name.starts_with(quantity)).collect();
    assert_eq!(found.len(), 1, "{quantity} in {:?}", exhibit.figures);
    found[0].1.parse().unwrap()
}

/// The pixels of a picture.
fn picture<'a>(exhibit: &'a Exhibit, name: &str) -> &'a [[f64; 3]] {
    let view = exhibit.views.iter().find(|view| view.name == name).unwrap();
    match &view.image {
        Image::Colors { rgb, .. } => rgb,
        Image::Drawing(_) | Image::Text(_) => panic!("{name} is no picture"),
    }
}

#[test]
fn every_exhibit_has_a_picture_and_a_figure() {
    let mut checked = 0;
    for (name, _) in EXHIBITS {
        let exhibit = exhibit(name);
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
                Image::Text(text) => assert!(text.lines().count() > 1, "{name} {}", view.name),
            }
        }
        checked += 1;
    }
    println!("checked {checked} / {}", EXHIBITS.len());
}

#[test]
fn the_slope_jumps_at_edges_alone() {
    let mach = exhibit("mach-bands");
    let [gouraud, phong] = ["Gouraud", "Phong"].map(|of| figure(mach, &format!("{of}: mean jump")));
    assert!(gouraud > 0.5 && phong < gouraud / 2.0, "{gouraud} {phong}");
    assert!(figure(mach, "Gouraud: largest change") < 0.001, "a triangle is a plane");
}

#[test]
fn gouraud_misses_the_highlight_and_phong_does_not() {
    let missed = exhibit("missed-highlight");
    let [gouraud, phong, truth] =
        ["Gouraud", "Phong", "truth"].map(|of| figure(missed, &format!("brightest green, {of}")));
    assert!(truth - gouraud > 100.0 && (truth - phong).abs() < 30.0, "{gouraud} {phong} {truth}");
    let brightest = |name: &str| {
        let (mut place, mut green) = ([0.0; 2], 0.0);
        for (at, rgb) in (0u32..).zip(picture(missed, name)) {
            if rgb[1] > green {
                (place, green) = ([at % 320, at / 320].map(f64::from), rgb[1]);
            }
        }
        place
    };
    let ([x, y], [u, v]) = (brightest("phong"), brightest("truth"));
    // Mirrored by the floor the light is at (0, -0.7, -0.6), and one at (0, 2.2, 2.2) sees it at z = 0.076:
    // 5.8 pixels below the middle of 240 lines, by an opening of 40 degrees.
    assert!((159.0..=160.0).contains(&u) && v == 125.0, "{u} {v}");
    let beside = (x - u).hypot(y - v);
    assert_eq!(figure(missed, "Phong: highlight beside its place"), (10.0 * beside).round() / 10.0);
    assert!(figure(missed, "Phong, 16 x 16: highlight") < beside / 10.0);
}

/// Of the pictures beside them: the worst colour of each pixel, white where it is off by as much as is said.
#[test]
fn maps_of_errors_are_differences_of_the_pictures_shown() {
    for (name, shown, right, white) in [
        ("fast-phong", ["taylor", "six-point"], "phong", 16.0),
        ("systems", ["gouraud", "phong"], "truth", 32.0),
    ] {
        let exhibit = exhibit(name);
        let right = picture(exhibit, right);
        for shown in shown {
            let map = format!("{shown}-error");
            let view = exhibit.views.iter().find(|view| view.name == map).unwrap();
            assert!(view.caption.ends_with(&format!("white at {white} LSB")), "{}", view.caption);
            for ((error, one), other) in picture(exhibit, &map).iter().zip(picture(exhibit, shown)).zip(right)
            {
                let worst = (0..3).map(|k| (one[k] - other[k]).abs()).fold(0.0, f64::max);
                let wanted = (255.0 * worst / white).min(1.0);
                assert!(error.iter().all(|part| (part - wanted).abs() < 1e-12), "{map}: {error:?}, {wanted}");
            }
        }
    }
}

/// Along the line through the middle lie two edges' middles at 0 degrees, and two white corners at 45.
#[test]
fn a_turned_quad_hears_of_other_corners() {
    let turned = exhibit("orientation");
    assert!((figure(turned, "middle of the square") - 127.5).abs() < 1.0);
    let at_45 = figure(turned, "at 45");
    assert!(at_45.min(255.0 - at_45) < 3.0, "{at_45}");
    let of_machine = |of: &str| figure(turned, &format!("machine: {of}"));
    assert!((of_machine("middle of the square") - figure(turned, "middle of the square")).abs() < 1.0);
    assert!((of_machine("at 45") - at_45).abs() < 1.0 && of_machine("range") > 120.0);
    let mut pixels = 0;
    for degrees in [0, 30, 45] {
        let of = |what: &str| figure(turned, &format!("machine at {degrees} degrees: {what}"));
        assert_eq!(of("pixels whose coverage differs"), 0.0);
        let (error, bound) = (of("largest colour error"), of("proved bound"));
        assert!(error > 0.1 && error <= bound && bound < 1.0, "{degrees}: {error} of {bound}");
        // The pictures are what the figures are of.
        let [golden, machine] =
            [degrees.to_string(), format!("machine-{degrees}")].map(|name| picture(turned, &name));
        for (a, b) in golden.iter().zip(machine) {
            assert!((0..3).all(|k| 255.0 * (a[k] - b[k]).abs() <= bound), "{degrees}: {a:?} {b:?}");
            pixels += 1;
        }
    }
    println!("checked {pixels} pixels");
}

/// Half-way between normals that lean towards each other the normal is straight: k_a I_a + k_d + k_s, beyond 1.
#[test]
fn normals_along_edges_depend_on_the_turn() {
    let turned = exhibit("polygon-normals");
    let of = |what: &str| figure(turned, what);
    // k_d 0.5: 0.05 + 0.5 + 0.45. At 45 degrees N leans by atan 0.5: cos 2 / sqrt 5, mirrored 0.6, 0.6^12 = 0.0022.
    assert_eq!(of("saddle: middle of the square at 0"), 255.0);
    let leaning = 255.0 * (0.05 + 0.5 * 2.0 / 5f64.sqrt() + 0.45 * 0.6f64.powi(12));
    assert!((of("saddle: at 45 degrees") - leaning).abs() < 3.0, "{leaning}");
    assert!(of("saddle: range") > 100.0 && of("ball: range") < 0.5);
    assert!(of("saddle, at 0 degrees: largest difference") > 20.0);
}

#[test]
fn constant_shading_is_right_from_far_away() {
    let flat = exhibit("flat-faces");
    for (who, what) in [
        ("light", "largest error of constant shading, LSB"),
        ("viewer", "the truth's range over one face, LSB"),
    ] {
        let all = [1, 2, 4, 8, 64].map(|times| figure(flat, &format!("{who} {times} times as far: {what}")));
        assert!(all.is_sorted_by(|near, far| near > far), "{who}: {all:?}");
        assert!(all[0] > 20.0 && all[4] < all[0] / 30.0, "{who}: {all:?}");
    }
}

#[test]
fn a_gloss_is_lost_between_vertices() {
    let gloss = exhibit("gloss");
    assert!(
        figure(gloss, "pixels that the gloss changes") > 1000.0 && figure(gloss, "largest change") > 20.0
    );
    let mean = |of: &str| figure(gloss, &format!("{of}: mean error"));
    assert!(mean("Gouraud") > 4.0 * mean("Phong"), "{} {}", mean("Gouraud"), mean("Phong"));
}

#[test]
fn the_inverse_transform_finds_the_place() {
    let inverse = exhibit("inverse-transform");
    let of = |way: &str| {
        ["largest distance", "largest error"].map(|what| figure(inverse, &format!("{way}: {what}")))
    };
    let unrounded = of("inverse transform, a depth that is not rounded");
    assert!(unrounded[0] < 1e-4 && unrounded[1] < 0.05, "vertices are snapped: {unrounded:?}");
    let ([place, colour], [near, wrong]) =
        (of("inverse transform, a depth of 24 bits"), of("place interpolated over the screen"));
    assert!(place < 1e-3 * near && colour < 0.5 && wrong > 50.0, "{place} {colour} {near} {wrong}");
    assert!(of("inverse transform, a depth of 16 bits")[0] > 100.0 * place);
}

#[test]
fn cuts_and_columns_divide_their_faults_by_the_square() {
    let perspective = exhibit("perspective");
    assert!(figure(perspective, "largest displacement") > 0.5);
    assert!((3.0..5.0).contains(&figure(perspective, "cut 16 by 16")));
    let silhouette = exhibit("silhouette");
    let ratio = figure(silhouette, "16 by 8") / figure(silhouette, "48 by 24");
    assert!((6.0..12.0).contains(&ratio), "{ratio}, 9 expected");
}

#[test]
fn systems_are_the_better_the_more_they_interpolate() {
    let systems = exhibit("systems");
    let mean = |of: &str| figure(systems, &format!("{of}: mean"));
    let [constant, gouraud, phong] = ["constant, own normal (S5)", "Gouraud (S6)", "Phong (S8)"].map(mean);
    assert!(constant > 1.5 * gouraud && gouraud > 5.0 * phong, "{constant} {gouraud} {phong}");
}

#[test]
fn folds_vanish_under_averages_and_return_with_a_crease() {
    let folds = exhibit("averaged-normals");
    let range = |of: &str| figure(folds, of);
    assert!(range("range of intensity") > 50.0 && range("Gouraud, normals averaged by angle") < 2.0);
    assert!((range("Gouraud, crease") - range("range of intensity")).abs() < 2.0);
    // Folds rise by 0.4 over 0.5, lit from (1, 0, 1.5): k_d 0.8 times (1.5 +- 0.8) / sqrt(1.64 * 3.25).
    assert_eq!((range("angle between two folds"), range("range of intensity")), (77.3, 141.4));
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
    assert!((figure(joint, "step of the intensity") - 127.5).abs() < 3.0);
    assert_eq!(["T-joints of that", "T-joints if"].map(|of| figure(joint, of)), [1.0, 0.0]);
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
        assert_eq!(figure(worked, quantity), value, "{quantity}");
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

/// The pixels of line 62 that are no background, in golden's picture, are those of the pairs that are printed.
#[test]
fn the_machine_walks_polygons_as_golden_fills_them() {
    let walked = exhibit("walked-polygons");
    assert_eq!(figure(walked, "polygons that POLY walks"), 5.0);
    assert_eq!(figure(walked, "triangles that the bent octagon"), 6.0);
    assert_eq!(figure(walked, "pixels whose coverage differs"), 0.0);
    assert!(figure(walked, "pixels covered") > 25_000.0);
    for of in ["depth", "colour"] {
        let error = figure(walked, &format!("largest {of} error"));
        let bound = figure(walked, &format!("proved bound of the {of} error"));
        assert!(error > 0.3 && error <= bound && bound < 80.0, "{of}: {error} of {bound}");
    }
    assert!(walked.figures.iter().any(|(name, value)| name.starts_with("verdict") && value == "pass"));
    let view = walked.views.iter().find(|view| view.name == "active-edges").unwrap();
    let Image::Text(text) = &view.image else { panic!("no text") };
    let mut inside = [false; 320];
    for pairs in text.lines().filter_map(|line| line.strip_prefix("pairs: ")) {
        for pair in pairs.split(", ") {
            let (left, right) = pair.split_once(" to ").unwrap();
            inside[left.parse::<usize>().unwrap()..right.parse::<usize>().unwrap()].fill(true);
        }
    }
    let line = &picture(walked, "golden")[62 * 320..63 * 320];
    let filled: Vec<bool> = line.iter().map(|rgb| *rgb != picture(walked, "golden")[0]).collect();
    assert_eq!(filled, inside);
    assert_eq!(inside.windows(2).filter(|pair| pair[0] != pair[1]).count(), 12, "one, three and two spans");
}

/// 0.4 of a pane's own light, beside half of it.
#[test]
fn plain_coefficients_are_corrected_ones_by_another_scale() {
    let glass = exhibit("glass");
    assert!(figure(glass, "a pane of k_d 0.4") > 20.0);
    assert_eq!(figure(glass, "the same with k_d (1 - k_t)"), 0.0);
}

#[test]
fn an_even_power_lights_a_right_angle_as_printed() {
    let components = exhibit("components");
    let of = |name: &str| {
        figure(components, &format!("highlight of (7.12), n = 20, N at a right angle to H, {name}"))
    };
    assert_eq!((of("as printed"), of("cut first")), (1.0, 0.0));
}

/// C - R/M of the machine's active edges on line 15 are the places of the notes.
#[test]
fn the_machine_walks_the_worked_example() {
    let worked = exhibit("worked-example");
    let view = worked.views.iter().find(|view| view.name == "active-edges").unwrap();
    let Image::Text(text) = &view.image else { panic!("no text") };
    let rows = text
        .lines()
        .map(|line| line.split_whitespace().map(str::parse::<f64>).collect::<Result<Vec<_>, _>>());
    let places: Vec<f64> = rows
        .filter_map(Result::ok)
        .filter(|row| row.len() == 6)
        .map(|row| row[0] - row[1] / row[4])
        .collect();
    assert_eq!(places, [10.5, 20.0]);
}

#[test]
fn shadows_of_glass_are_products_and_finer_maps_are_nearer_to_rays() {
    let glass = exhibit("glass");
    let lit = ["r_l beside", "under the red", "under the blue", "under both"].map(|of| figure(glass, of));
    assert_eq!(lit, [1.0, 0.6, 0.5, 0.3]);
    assert!(figure(glass, "panes bent") >= 1.0);
    let shadows = exhibit("shadows");
    let [coarse, fine] = ["128", "1024"]
        .map(|size| figure(shadows, &format!("of them other than by rays, maps of {size} x {size}")));
    assert!(fine < coarse / 2.0 && fine < 0.02 * figure(shadows, "pixels that show"), "{coarse} {fine}");
}

#[test]
fn light_adds() {
    let lights = exhibit("lights");
    assert!(figure(lights, "pixels where") > 1000.0 && figure(lights, "largest difference") < 1e-9);
    let all = picture(lights, "all");
    // The first pixel is the sky.
    let seen = all.iter().filter(|rgb| **rgb != all[0] && rgb.iter().all(|channel| *channel < 1.0));
    assert_eq!(figure(lights, "pixels where"), seen.count() as f64);
}

#[test]
fn the_machine_shows_the_texels_that_golden_shows() {
    let texture = exhibit("texture");
    let [pixels, differ, unexplained] =
        ["pixels that look up", "of them another texel", "not explained by the error of u"]
            .map(|of| figure(texture, &format!("machine: {of}")));
    assert!(
        pixels > 10_000.0 && differ < pixels / 100.0 && unexplained == 0.0,
        "{pixels} {differ} {unexplained}"
    );
    let [error, bound] =
        ["largest error against fast", "proved bound"].map(|of| figure(texture, &format!("machine: {of}")));
    assert!(error > 0.5 && error <= bound, "{error} {bound}");
}

#[test]
fn the_machine_turns_normals_as_golden_does() {
    let relief = exhibit("relief");
    assert!(
        figure(relief, "pixels that the relief changes") > 5000.0 && figure(relief, "largest change") > 20.0
    );
    for who in ["machine, Phong", "machine"] {
        let of = |quantity: &str| figure(relief, &format!("{who}: {quantity}"));
        let (error, bound) = (of("largest error against"), of("proved bound"));
        assert!(error > 0.5 && error <= bound && bound < 16.0, "{who}: {error} {bound}");
        assert!(of("pixels that look up") > 10_000.0 && of("not explained") == 0.0);
    }
}

#[test]
fn the_machine_shades_under_a_light_at_a_point_as_golden_does() {
    let lamp = exhibit("lamp");
    let of = |quantity: &str| figure(lamp, &format!("machine, Phong: {quantity}"));
    let (error, bound) = (of("largest error against"), of("proved bound"));
    assert!(error > 0.5 && error <= bound && bound < 16.0, "{error} {bound}");
}
