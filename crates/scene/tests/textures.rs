//! Textures, built in and from files, and the relief they make.
#![allow(clippy::unwrap_used)] // files written here

use edgewalk_scene::{Face, FaceData, Material, Mesh, Texture, WAVE_TEXELS};
use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};

/// Four texels: black and red above, green and white below.
fn four() -> Texture {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("four.png");
    let colors = [[0, 0, 0], [255, 0, 0], [0, 255, 0], [255, 255, 255]];
    RgbImage::from_fn(2, 2, |x, y| Rgb(colors[(2 * y + x) as usize])).save(&path).unwrap();
    Texture::read(&path).unwrap()
}

#[test]
fn v_runs_up_and_texels_mix_between_their_centres() {
    let texture = four();
    for (u, v, expected) in [
        (0.25, 0.75, [0.0, 0.0, 0.0]),
        (0.75, 0.75, [1.0, 0.0, 0.0]),
        (0.25, 0.25, [0.0, 1.0, 0.0]),
        (1.75, -0.75, [1.0, 1.0, 1.0]),
        (0.5, 0.75, [0.5, 0.0, 0.0]),
        (0.5, 0.5, [0.5, 0.5, 0.25]),
        (0.0, 0.75, [0.5, 0.0, 0.0]),
    ] {
        assert!(texture.at(DVec2::new(u, v)).distance(DVec3::from(expected)) < 1e-12, "{u} {v}");
    }
    for strange in [f64::NAN, f64::INFINITY, -1e300, 1e300] {
        let _ = texture.at(DVec2::splat(strange));
    }
}

#[test]
fn nearest_is_the_texel_that_a_place_lies_in() {
    let texture = four().nearest();
    for (u, v, expected) in [
        (0.0, 0.999, [0.0, 0.0, 0.0]),
        (0.499, 0.501, [0.0, 0.0, 0.0]),
        (0.5, 0.75, [1.0, 0.0, 0.0]),
        (0.499, 0.5, [0.0, 1.0, 0.0]),
        (0.999, 0.001, [1.0, 1.0, 1.0]),
        (1.0, 0.75, [0.0, 0.0, 0.0]),
        (-0.001, -0.001, [1.0, 0.0, 0.0]),
        (2.75, 7.25, [1.0, 1.0, 1.0]),
    ] {
        assert_eq!(texture.at(DVec2::new(u, v)), DVec3::from(expected), "{u} {v}");
    }
    for strange in [f64::NAN, f64::INFINITY, -1e300, 1e300] {
        let _ = texture.at(DVec2::splat(strange));
    }
}

#[test]
fn a_checker_alternates_both_ways() {
    let texture = Texture::Checker { squares: 4, colors: [DVec3::ONE, DVec3::ZERO] };
    let red = |u: f64, v: f64| texture.at(DVec2::new(u, v)).x;
    assert_eq!(
        [red(0.1, 0.1), red(0.3, 0.1), red(0.3, 0.3), red(-0.1, 0.1), red(1.1, 0.1)],
        [1.0, 0.0, 1.0, 0.0, 1.0]
    );
}

#[test]
fn the_squares_of_a_checker_may_be_texels() {
    let mut checked = 0;
    for squares in [1, 2, 6, 16] {
        let colors = [DVec3::new(1.0, 0.4, 0.2), DVec3::new(0.0, 0.6, 1.0)];
        let checker = Texture::Checker { squares, colors };
        let texels = checker.clone().nearest();
        assert!(matches!(&texels, Texture::Texels(image) if image.sides() == [squares; 2]));
        for k in 0..400 {
            let place = DVec2::new(f64::from(k % 20) + 0.5, f64::from(k / 20) + 0.5) / 20.3;
            assert!(checker.at(place).distance(texels.at(place)) < 1e-12, "{squares} squares, {place}");
            checked += 1;
        }
    }
    assert_eq!(checked, 1600);
    let many = Texture::Checker { squares: 65536, colors: [DVec3::ONE, DVec3::ZERO] };
    assert_eq!(many.clone().nearest(), many, "more than a picture has");
}

/// A unit square in the x-y plane, u along x and v along y, seen from +z.
fn square(material: Material, textures: Vec<Texture>) -> Mesh {
    let positions = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
    let corners = [[0, 1, 2], [0, 2, 3]];
    let faces = corners.map(|corners| Face { corners, material: 0 });
    let data = corners.map(|corners| FaceData {
        texture: Some(corners.map(|corner: u32| positions[corner as usize].truncate())),
        ..FaceData::default()
    });
    let mesh = Mesh::new("square", positions.to_vec(), faces.to_vec(), vec![material]).unwrap();
    mesh.with_face_data(data.to_vec()).with_textures(textures)
}

#[test]
fn a_texture_multiplies_diffuse_and_ambient() {
    let material = Material { texture: Some(0), ..Material::matte(DVec3::new(0.5, 0.6, 0.7)) };
    let colors = [DVec3::new(1.0, 0.5, 0.0), DVec3::ZERO];
    let mesh = square(material, vec![Texture::Checker { squares: 2, colors }]);
    let at = mesh.material_at(0, DVec2::new(0.2, 0.2));
    assert_eq!((at.diffuse, at.ambient), (DVec3::new(0.5, 0.3, 0.0), DVec3::new(0.5, 0.3, 0.0)));
    let beyond = square(Material { texture: Some(7), ..material }, vec![]);
    assert_eq!(beyond.material_at(0, DVec2::ZERO).diffuse, material.diffuse, "no such texture");
}

#[test]
fn a_gloss_multiplies_specular_and_exponent() {
    let matte = Material::matte(DVec3::splat(0.5));
    let material = Material { gloss: Some(0), specular: DVec3::splat(0.8), exponent: 40.0, ..matte };
    let colors = [DVec3::ONE, DVec3::new(0.5, 0.25, 0.0)];
    let mesh = square(material, vec![Texture::Checker { squares: 2, colors }]);
    let [full, part] = [0.2, 0.7].map(|u| mesh.material_at(0, DVec2::new(u, 0.2)));
    assert_eq!(full, material);
    assert_eq!((part.specular, part.exponent), (DVec3::new(0.4, 0.2, 0.0), 10.0));
    assert_eq!((part.diffuse, part.ambient), (material.diffuse, material.ambient));
}

/// The normal of z = h B(x, y) is (-h B_x, -h B_y, 1), here with B = (1 + sin 2 pi x sin 2 pi y) / 2.
#[test]
fn a_relief_turns_the_normal_as_its_slopes_do() {
    let height = 0.1;
    let material = Material { bump: Some(0), bump_height: height, ..Material::DEFAULT };
    let mesh = square(material, vec![Texture::Waves { count: 1 }]);
    let wave = std::f64::consts::TAU;
    let mut steepest = 0.0f64;
    for k in 0..400 {
        let place = DVec2::new(f64::from(k % 20) / 20.0, f64::from(k / 20) / 20.0);
        let (sin, cos) = ((wave * place.x).sin_cos().0, (wave * place.x).cos());
        let (sin_v, cos_v) = ((wave * place.y).sin(), (wave * place.y).cos());
        let slope = DVec2::new(cos * sin_v, sin * cos_v) * (height * wave / 2.0);
        let expected = DVec3::new(-slope.x, -slope.y, 1.0).normalize();
        for (face, side) in [(0, 1.0), (1, 1.0), (0, -1.0)] {
            let turned = mesh.bumped_normal(face, place, DVec3::Z * side);
            // Differences over 1/64 of a wave are not quite the slope.
            assert!(turned.distance(expected * side) < 1e-3, "{place}: {turned}, not {expected}");
        }
        steepest = steepest.max(slope.length());
    }
    assert!(steepest > 0.25);
    let flat = square(Material { bump: None, ..material }, vec![Texture::Waves { count: 1 }]);
    assert_eq!(flat.bumped_normal(0, DVec2::splat(0.3), DVec3::Z), DVec3::Z);
}

/// Heights at the middles of the texels, and slopes that are those of the waves, nearly, and one in each texel.
#[test]
fn waves_may_be_texels() {
    let waves = Texture::Waves { count: 3 };
    let texels = waves.clone().nearest();
    let Texture::Texels(image) = &texels else { panic!("texels") };
    assert_eq!(image.sides(), [3 * WAVE_TEXELS; 2]);
    let wave = std::f64::consts::TAU * 3.0;
    let mut checked = 0;
    for k in 0..96 * 96 {
        let middle = DVec2::new(f64::from(k % 96) + 0.5, f64::from(k / 96) + 0.5) / 96.0;
        assert!((texels.at(middle) - waves.at(middle)).abs().max_element() < 1e-5);
        let exact = DVec2::new(
            (wave * middle.x).cos() * (wave * middle.y).sin(),
            (wave * middle.x).sin() * (wave * middle.y).cos(),
        ) * wave
            / 2.0;
        let slope = image.slope(middle);
        // Differences over a sixteenth of a wave.
        assert!(slope.distance(exact) < 0.01 * wave, "{middle}: {slope}, not {exact}");
        assert_eq!(image.slope(middle + DVec2::splat(0.4 / 96.0)), slope);
        checked += 1;
    }
    assert_eq!(checked, 96 * 96);
    let many = Texture::Waves { count: 129 };
    assert_eq!(many.clone().nearest(), many, "more than a picture has");
}
