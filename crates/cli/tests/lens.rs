//! `edgewalk render` of triangle files with a light's map through perspective cameras: the machine with PROJECT beside golden.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::edgewalk;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fmt::Write as _;

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn scaled(a: Vector, by: f64) -> Vector {
    a.map(|c| c * by)
}

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn unit(a: Vector) -> Vector {
    scaled(a, 1.0 / dot(a, a).sqrt())
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A frame seen through a camera that looks in perspective from the origin along z, under a parallel light or one that looks in
/// perspective, as a file: world to screen x = 40 + 50 X/Z, y = 30 + 50 Y/Z, depth A - B/Z between Z = 2 and Z = 12.
fn through_a_lens(random: &mut Pcg64Mcg, size: f64, bias: f64, parallel: bool) -> String {
    const A: f64 = 12.0 / 10.0;
    const B: f64 = 2.0 * A;
    // Where the light is, and how it is turned; it looks at the middle of the scene or so.
    let mut any = |from: Vector, by: f64| from.map(|c| c + random.random_range(-by..by));
    let (eye, target) = (any([0.0, -3.0, 4.0], 2.5), any([0.0, 0.0, 6.0], 1.0));
    let axis = unit(minus(target, eye));
    let right = unit(cross(axis, any([0.0, 0.0, 0.0], 1.0)));
    let up = cross(axis, right);
    let turned = |p: Vector| [right, up, axis].map(|way| dot(way, minus(p, eye)));
    // Column, line, depth and weight of a point, homogeneous; the light sees from 0.5 to 14 away.
    let (near, far) = (0.5, 14.0);
    let seen = |p: Vector| {
        let [x, y, z] = turned(p);
        let half = size / 2.0;
        if parallel {
            [half * (1.0 + x / 5.0), half * (1.0 + y / 5.0), (z - near) / (far - near), 1.0]
        } else {
            let a = far / (far - near);
            [half * (z + x / 0.8), half * (z + y / 0.8), a * (z - near), z]
        }
    };
    // The same of a point at infinity, (X, Y, Z, 0): what is left of the difference to the origin's.
    let origin = seen([0.0; 3]);
    let way = |p: Vector| -> [f64; 4] { std::array::from_fn(|k| seen(p)[k] - origin[k]) };
    // From the screen to the world, homogeneous: ((x - 40)/50, (y - 30)/50, 1, (A - z)/B).
    let column = |x: Vector, w: f64| -> [f64; 4] { std::array::from_fn(|k| way(x)[k] + w * origin[k]) };
    let columns = [
        column([1.0 / 50.0, 0.0, 0.0], 0.0),
        column([0.0, 1.0 / 50.0, 0.0], 0.0),
        column([0.0; 3], -1.0 / B),
        column([-40.0 / 50.0, -30.0 / 50.0, 1.0], A / B),
    ];
    let mut text = format!("size 80 60\nshadow {size} {bias} 0.3 ");
    (0..4).for_each(|row| columns.iter().for_each(|column| _ = write!(text, " {:e}", column[row])));
    text.push('\n');
    for _ in 0..25 {
        let middle = [0, 1, 2].map(|k| random.random_range([-3.0..3.0, -2.5..2.5, 3.0..10.0][k].clone()));
        let corners = [(); 3].map(|()| {
            let at = middle.map(|c: f64| c + random.random_range(-2.0..2.0));
            [at[0], at[1], at[2].clamp(2.1, 11.9)]
        });
        let _ = write!(text, "T");
        for [x, y, z] in corners {
            let _ =
                write!(text, "  {} {} {} 0.9 0.5 1 0", 40.0 + 50.0 * x / z, 30.0 + 50.0 * y / z, A - B / z);
        }
        let _ = writeln!(text);
        let light = corners.map(seen);
        // What lies before the light's near plane anywhere stands in no map.
        if corners.iter().all(|corner| turned(*corner)[2] > near) {
            let _ = write!(text, "L");
            light.iter().for_each(|[x, y, z, w]| {
                _ = write!(text, "  {} {} {}", x / w, y / w, (z / w).clamp(0.0, 1.0));
            });
            let _ = writeln!(text);
        }
    }
    text
}

/// Perspective views, parallel lights and such as look in perspective, some with a part of the scene behind them.
#[test]
fn every_decision_through_a_lens_is_explained() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let (mut pixels, mut dark, mut differ, mut open) = (0, 0, 0, 0);
    for i in 0..24 {
        let (size, bias) = ([64.0, 100.0][i % 2], [0.002, 0.0][i / 2 % 2]);
        std::fs::write(folder.path().join("a.tri"), through_a_lens(&mut random, size, bias, i % 3 == 0))
            .unwrap();
        let size = format!("shadow.size={size}");
        let settings = ["shadow.light=perspective", "shadow.gate=scale", &size, "shadow.light_fraction=16"];
        let screen = ["screen.width=80", "screen.height=60", "screen.guard_bits=10"];
        let bits = ["shadow.light_bits=20", "shadow.light_bits=16"][i / 4 % 2];
        let project = ["shadow.project=pipelined", "shadow.project=serial"][i % 2];
        let mut command = edgewalk(folder.path(), &["render", "a.tri", "--json", "--engine", "model"]);
        settings
            .iter()
            .chain(&screen)
            .chain([&project, &bits])
            .for_each(|setting| _ = command.args(["--set", setting]));
        let output = command.output().unwrap();
        assert!(!output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(output.status.success(), "{report:#}");
        let lit = &report["comparison"]["lit"];
        let number = |key: &str| lit[key].as_u64().unwrap();
        assert_eq!(number("unexplained"), 0, "{lit}");
        assert!(lit["texel_bound"].as_f64().unwrap() > 0.0, "{lit}");
        let divides = report["cycles"]["by_cause"]["project"].as_u64().unwrap_or(0);
        assert_eq!(divides > 1000, project.ends_with("serial"), "{}", report["cycles"]);
        (pixels, dark) = (pixels + number("pixels"), dark + number("shadow"));
        (differ, open) = (differ + number("differ"), open + number("open"));
    }
    println!(
        "{pixels} pixels, {dark} in shadow, {differ} decided otherwise than golden, {open} open, 0 unexplained"
    );
    assert!(
        pixels > 40_000 && dark > 10_000 && differ > 25 && open * 1000 < pixels,
        "{pixels} {dark} {differ} {open}"
    );
}

/// Where the weight is so small that a texel may be off by one or more nothing is proved: such pixels are counted, not passed over.
#[test]
fn decisions_without_a_bound_count_as_open() {
    let folder = tempfile::tempdir().unwrap();
    let matrix = "0.5 0 0 0   0 0.5 0 0   0 0 0.5 0   0.02 0 0 -0.005";
    let triangle = "T  0 0 0.5 1 1 1 0   160 0 0.5 1 1 1 0   0 120 0.5 1 1 1 0";
    let text = format!("size 80 60\nshadow 64 0 0.3   {matrix}\nL 0 0 0.3  64 0 0.3  0 64 0.3\n{triangle}\n");
    std::fs::write(folder.path().join("a.tri"), text).unwrap();
    let open = |bits: &str| {
        let sizes =
            ["shadow.light=perspective", "shadow.gate=scale", "shadow.size=64", "shadow.depth_bits=8"];
        let screen = ["screen.width=80", "screen.height=60", bits];
        let mut command = edgewalk(folder.path(), &["render", "a.tri", "--json"]);
        sizes.iter().chain(&screen).for_each(|setting| _ = command.args(["--set", setting]));
        let output = command.output().unwrap();
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(output.status.success(), "{report:#}");
        let lit = &report["comparison"]["lit"];
        assert_eq!((lit["pixels"].as_u64(), lit["unexplained"].as_u64()), (Some(4800), Some(0)), "{lit}");
        lit["open"].as_u64().unwrap()
    };
    let (few, many) = (open("shadow.light_bits=8"), open("shadow.light_bits=24"));
    assert!(few > 1000 && many == 0, "{few} open with 8 bits, {many} with 24");
}
