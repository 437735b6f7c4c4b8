//! The table of powers.

use super::cases::Case;
use edgewalk_golden::fast_phong::PowerTable;
use edgewalk_scene::Specular;
use glam::{DVec2, DVec3};

#[test]
fn entries_and_saturation() {
    let table = PowerTable::new(5, Specular::Blinn, 2.0);
    let reads = [0.0, 0.124, 0.126, 0.5, 0.75, 1.0].map(|halfway| table.read(halfway));
    assert_eq!(reads, [0.0, 0.0, 0.0625, 0.25, 0.5625, 1.0]);
    let outside = [-3.0, 1.0001, 7.0, f64::INFINITY, f64::NEG_INFINITY].map(|halfway| table.read(halfway));
    assert_eq!(outside, [0.0, 1.0, 1.0, 1.0, 0.0]);
    assert!(table.read(f64::NAN).is_finite());
    // cos 2x of ch. 7.12 is 0 from N·H = 1/sqrt 2 down.
    let halfway = PowerTable::new(101, Specular::Halfway, 2.0);
    assert_eq!((halfway.read(0.7), halfway.read(0.0), halfway.read(1.0)), (0.0, 0.0, 1.0));
    assert!((halfway.read(0.9) - 0.62f64.powi(2)).abs() < 1e-12);
    // Too small a size is the least.
    assert_eq!(PowerTable::new(0, Specular::Blinn, 9.0), PowerTable::new(2, Specular::Blinn, 9.0));
}

/// The table of `docs/fast_phong.md`.
#[test]
fn error_by_size() {
    println!("form       n    entries   error, LSB of 8 bits   n / (2 (size - 1)), or four times that");
    let mut checked = 0;
    for (form, steeper) in [(Specular::Blinn, 1.0), (Specular::Halfway, 4.0)] {
        for exponent in [10.0, 50.0] {
            for size in [256, 1024, 4096, 16384] {
                let table = PowerTable::new(size, form, exponent);
                let error = |k: u32| {
                    let halfway = f64::from(k) / 200_000.0;
                    (table.read(halfway) - PowerTable::exact(form, exponent, halfway)).abs()
                };
                let worst = 255.0 * (0..=200_000).map(error).fold(0.0, f64::max);
                let bound = 255.0 * steeper * exponent / (2.0 * (size - 1) as f64);
                println!("{:<8} {exponent:>3} {size:>10} {worst:>12.4} {bound:>20.4}", form.name());
                assert!(worst <= bound && worst > 0.7 * bound, "{form:?} {exponent} {size}");
                checked += 1;
            }
        }
    }
    assert_eq!(checked, 16);
}

#[test]
fn the_quadratic_overshoots_at_a_highlight() {
    let normals = [DVec3::new(0.6, 0.0, 1.0), DVec3::new(-0.6, 0.2, 1.0), DVec3::new(0.0, -0.2, 1.0)];
    let points = [DVec2::ZERO, DVec2::new(9.0, 2.0), DVec2::new(4.0, 8.0)];
    let mut most = 0f64;
    for tilt in 0..100 {
        let light = DVec3::new(f64::from(tilt) / 100.0, 0.0, 1.0).normalize();
        let case = Case { points, normals: normals.map(DVec3::normalize), light };
        let quadratic = case.taylor();
        let values = super::cases::grid(20).map(|weights| quadratic.at(case.point(weights)));
        most = values.fold(most, f64::max);
    }
    println!("largest value of a cosine's quadratic: {most:.4}");
    assert!(most > 1.01, "{most}");
    let table = PowerTable::new(1024, Specular::Blinn, 20.0);
    assert_eq!(table.read(most), 1.0);
}
