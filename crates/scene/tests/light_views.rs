//! How the depth maps of a light lie around what it lights.

use edgewalk_scene::{Attenuation, Light};
use glam::{DVec2, DVec3};

const SIZE: u32 = 100;

fn directional(toward: DVec3) -> Light {
    Light::Directional { toward, intensity: DVec3::ONE }
}

fn bulb(position: DVec3) -> Light {
    Light::Positional { position, intensity: DVec3::ONE, attenuation: Attenuation::NONE }
}

fn flood(cone: f64) -> Light {
    let (position, axis) = (DVec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z);
    Light::Flood {
        position,
        axis,
        cone,
        exponent: 1.0,
        intensity: DVec3::ONE,
        attenuation: Attenuation::NONE,
    }
}

/// The corners of a box around its middle.
fn corners(middle: DVec3, half: DVec3) -> Vec<DVec3> {
    let sides = [-1.0, 1.0];
    let corner = |x, y, z| middle + DVec3::new(x, y, z) * half;
    sides.into_iter().flat_map(|x| sides.map(|y| sides.map(|z| corner(x, y, z)))).flatten().collect()
}

/// A hundredth of the diagonal is left on every side, before and behind.
#[test]
fn a_parallel_map_is_as_large_as_what_it_holds_and_a_margin() {
    let (middle, half) = (DVec3::new(3.0, -1.0, 2.0), DVec3::new(1.0, 2.0, 3.0));
    let points = corners(middle, half);
    let margin = 0.01 * (2.0 * half).length();
    let light = directional(DVec3::Z);
    let [low, high] = [middle - half, middle + half];
    let views = [light.view(&points, SIZE).expect("one map"), light.views([low, high], SIZE)[0]];
    for view in views {
        let places: Vec<_> = points.iter().map(|point| view.texels(*point)).collect();
        let least = |of: fn(&glam::DVec4) -> f64| places.iter().map(of).fold(f64::INFINITY, f64::min);
        let most = |of: fn(&glam::DVec4) -> f64| places.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        // Which of x and y is to the right in the map is left open.
        let share = |half: f64| half / (half + margin);
        let mut found = [most(|p| p.x) - least(|p| p.x), most(|p| p.y) - least(|p| p.y)];
        found.sort_by(f64::total_cmp);
        let wanted = [half.x, half.y].map(|half| f64::from(SIZE) * share(half));
        assert!(
            found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-9),
            "{found:?}, {wanted:?}"
        );
        let depths = [least(|p| p.z), most(|p| p.z)];
        let wanted = [1.0 - share(half.z), 1.0 + share(half.z)].map(|depth| depth / 2.0);
        assert!(
            depths.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-9),
            "{depths:?}, {wanted:?}"
        );
    }
}

#[test]
fn a_light_at_a_point_has_a_map_for_each_side_of_a_cube_and_a_narrow_cone_one() {
    let bounds = [DVec3::NEG_ONE, DVec3::ONE];
    let lights = [(directional(DVec3::Y), 1), (bulb(DVec3::ZERO), 6)];
    let cones = [(flood(0.5), 1), (flood(59f64.to_radians()), 1), (flood(61f64.to_radians()), 6)];
    for (light, views) in lights.into_iter().chain(cones) {
        assert_eq!(light.views(bounds, SIZE).len(), views, "{light:?}");
    }
}

/// Of the axes that it may have the one map has that on which the points spread least: here that towards their middle.
#[test]
fn the_one_map_of_a_bulb_is_filled_by_what_it_lights() {
    let position = DVec3::new(1.0, 2.0, 3.0);
    let points = corners(position + DVec3::new(3.0, 4.0, 5.0), DVec3::splat(0.5));
    let view = bulb(position).view(&points, SIZE).expect("one map");
    let places: Vec<DVec2> =
        points.iter().map(|point| view.texels(*point)).map(|p| DVec2::new(p.x, p.y) / p.w).collect();
    let low = places.iter().copied().reduce(DVec2::min).expect("corners");
    let high = places.iter().copied().reduce(DVec2::max).expect("corners");
    assert!(low.min_element() > 0.0 && high.max_element() < f64::from(SIZE), "{low} to {high}");
    assert!((high - low).max_element() > 0.9 * f64::from(SIZE), "{low} to {high}");
}
