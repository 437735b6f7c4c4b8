//! Attributes at a pixel: straight over the screen, and as they are on the surface.
#![allow(clippy::unwrap_used)] // built in

use edgewalk_golden::{Weights, fragments};
use edgewalk_scene::{Scene, ShadeMode};
use glam::DVec3;

/// The ray through a pixel centre meets the plane of the triangle where the perspective weights say.
#[test]
fn perspective_weights_give_the_point_under_the_pixel() {
    let (width, height) = (64, 48);
    let (mut checked, mut worst, mut linear_off) = (0, 0.0f64, 0.0f64);
    for name in ["terrain", "room", "torus"] {
        let scene = Scene::builtin(name).unwrap();
        let to_clip = scene.camera.to_clip(width, height);
        for triangle in &scene.surface(width, height, 8191.0).triangles {
            // 8 sub-pixel bits move the vertices; the weights are of the moved ones.
            fragments(&triangle.on_screen(), ShadeMode::Gouraud, 8, (width, height), |f| {
                let at = |weights: Weights| weights.of(triangle.vertices.map(|v| v.position));
                let pixel = |world: DVec3| {
                    let p = to_clip * world.extend(1.0);
                    let x = (0.5 + 0.5 * p.x / p.w) * f64::from(width);
                    let y = (0.5 - 0.5 * p.y / p.w) * f64::from(height);
                    (x - f64::from(f.x) - 0.5).hypot(y - f64::from(f.y) - 0.5)
                };
                worst = worst.max(pixel(at(Weights::perspective(f, triangle))));
                linear_off = linear_off.max(pixel(at(Weights::linear(f))));
                let sum: f64 = Weights::perspective(f, triangle).0.iter().sum();
                assert!((sum - 1.0).abs() < 1e-12);
                checked += 1;
            });
        }
    }
    println!("{checked} pixels: perspective {worst:.5} px off, linear {linear_off:.2} px off");
    assert!(checked > 3000);
    assert!(worst < 0.003, "half a sub-pixel of 1/256 each way");
    assert!(linear_off > 1.0, "the distortion of the slides is there to be seen");
}
