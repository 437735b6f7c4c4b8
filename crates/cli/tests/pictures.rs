//! Arrays and pictures read by other code than that which wrote them: a picture that is no mirror image of itself, every
//! pixel known.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::{colors, npy};
use std::path::Path;
use std::process::{Command, Output};
use zune_png::PngDecoder;

const WIDTH: usize = 5;
const HEIGHT: usize = 3;

/// Pixels of one colour each, drawn in this order as two triangles; the last lies behind the first.
const PIXELS: [(usize, usize, f64, [f64; 3]); 5] = [
    (1, 0, 0.25, [1.0, 0.0, 0.0]),
    (4, 0, 0.5, [0.0, 1.0, 0.0]),
    (0, 2, 0.75, [0.0, 0.0, 1.0]),
    (3, 1, 0.125, [0.2, 0.6, 0.8]),
    (1, 0, 0.5, [1.0, 1.0, 1.0]),
];
const CLEAR: [f64; 3] = [0.25, 0.5, 0.75];
/// The cleared colour in 8 bits: 63.75, 127.5 and 191.25 rounded.
const CLEAR_BYTES: [u8; 3] = [64, 128, 191];

fn triangles() -> String {
    let mut text = format!("size {WIDTH} {HEIGHT}\nclear {} {} {}\n", CLEAR[0], CLEAR[1], CLEAR[2]);
    for (x, y, z, [r, g, b]) in PIXELS {
        let corner = |dx: usize, dy: usize| format!("{} {} {z} {r} {g} {b} 0", x + dx, y + dy);
        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        text += &format!("T {a} {b} {c}\nT {a} {c} {d}\n");
    }
    text
}

/// What a pixel shows, if anything: its place in the list.
fn seen(x: usize, y: usize) -> Option<usize> {
    PIXELS.iter().position(|pixel| (pixel.0, pixel.1) == (x, y))
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let output =
        Command::new(env!("CARGO_BIN_EXE_edgewalk")).current_dir(folder).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output
}

fn png(path: &Path) -> Vec<[u8; 3]> {
    let bytes = std::fs::read(path).unwrap();
    let mut decoder = PngDecoder::new(&bytes);
    let raw = decoder.decode_raw().unwrap();
    assert_eq!(decoder.get_dimensions(), Some((WIDTH, HEIGHT)), "{}", path.display());
    assert_eq!(raw.len(), 3 * WIDTH * HEIGHT);
    raw.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect()
}

fn byte(value: f64) -> u8 {
    (value * 255.0).round() as u8
}

#[test]
fn every_pixel_is_where_numpy_and_png_say() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), triangles()).unwrap();
    let mut checked = 0;
    for engine in ["golden", "fast", "model", "rtl"] {
        run(folder.path(), &["raster", "a.tri", "--engine", engine, "--out", engine, "-q"]);
        let at = folder.path().join(engine);
        let integers = |name: &str, kind: &str| -> Vec<i64> {
            let (descr, shape, data) = npy(&at.join(name));
            assert_eq!((descr.as_str(), &shape[..]), (kind, &[HEIGHT, WIDTH][..]), "{name}");
            data.chunks_exact(4).map(|b| i32::from_le_bytes([b[0], b[1], b[2], b[3]]).into()).collect()
        };
        let floats = |name: &str, expected: &[usize]| -> Vec<f64> {
            let (descr, shape, data) = npy(&at.join(name));
            assert_eq!((descr.as_str(), &shape[..]), ("<f8", expected), "{name}");
            data.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
        };
        let (coverage, writes, id) =
            (integers("coverage.npy", "<u4"), integers("writes.npy", "<u4"), integers("id.npy", "<i4"));
        let (z, rgb) = (floats("z.npy", &[HEIGHT, WIDTH]), floats("rgb.npy", &[HEIGHT, WIDTH, 3]));
        let picture = png(&at.join("image.png"));
        for (y, x) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (y, x))) {
            let i = y * WIDTH + x;
            let place = format!("{engine} ({x}, {y})");
            let over = PIXELS.iter().filter(|pixel| (pixel.0, pixel.1) == (x, y)).count() as i64;
            let (depth, color, bytes) = match seen(x, y) {
                Some(k) => (PIXELS[k].2, PIXELS[k].3, PIXELS[k].3.map(byte)),
                None => (1.0, CLEAR, CLEAR_BYTES),
            };
            assert_eq!((coverage[i], writes[i]), (over, over.min(1)), "{place}");
            // The centre lies on the diagonal, which belongs to the triangle on its right.
            assert_eq!(id[i], seen(x, y).map_or(-1, |k| 2 * k as i64), "{place}");
            assert!((z[i] - depth).abs() * 16_777_215.0 <= 0.5 + 1e-6, "{place}: z {}", z[i]);
            for k in 0..3 {
                let value = rgb[3 * i + k];
                assert!((value - color[k]).abs() * 255.0 <= 0.5 + 1e-6, "{place}: channel {k} {value}");
                if engine != "golden" {
                    assert_eq!(value, f64::from(bytes[k]) / 255.0, "{place}: channel {k}");
                }
            }
            assert_eq!(picture[i], bytes, "{place}");
            checked += 1;
        }
    }
    println!("checked {checked} / {} pixels", 4 * WIDTH * HEIGHT);
    assert_eq!(checked, 4 * WIDTH * HEIGHT);
}

#[test]
fn pictures_of_render_lie_the_same_way_and_errors_have_their_colour() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.tri"), triangles()).unwrap();
    let screen = ["--set", "screen.width=5", "--set", "screen.height=3", "-q", "--out", "out"];
    run(folder.path(), &[&["render", "a.tri"][..], &screen].concat());
    let read = |name: &str| png(&folder.path().join("out").join(name));
    let (golden, image, heat) = (read("golden.png"), read("image.png"), read("color_error.png"));
    for (y, x) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (y, x))) {
        let i = y * WIDTH + x;
        let expected = seen(x, y).map_or(CLEAR_BYTES, |k| PIXELS[k].3.map(byte));
        assert_eq!((golden[i], image[i]), (expected, expected), "({x}, {y})");
        // Every colour here is a whole number of LSB, so no error is more than what f64 leaves: black or darkest blue.
        assert!(heat[i] == [0, 0, 0] || heat[i] == [0, 0, 159], "({x}, {y}): {:?}", heat[i]);
    }
}

/// Red grows by 2.6 LSB a pixel and the machine, without fraction bits, adds 3: the further right, the hotter.
#[test]
fn the_heat_map_runs_from_blue_over_yellow_to_red() {
    let folder = tempfile::tempdir().unwrap();
    let (low, high) = (5.0 / 255.0, 239.0 / 255.0);
    let text = format!("size 5 3\nT 0 0 .5 {low} 0 0 0  90 0 .5 {high} 0 0 0  0 90 .5 {low} 0 0 0\n");
    std::fs::write(folder.path().join("a.tri"), text).unwrap();
    let mut arguments = vec!["render", "a.tri", "-q", "--out", "out"];
    for setting in ["screen.width=5", "screen.height=3", "formats.color_fraction=0", "formats.color_vertex=0"]
    {
        arguments.extend(["--set", setting]);
    }
    let output = Command::new(env!("CARGO_BIN_EXE_edgewalk"))
        .current_dir(folder.path())
        .args(arguments)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    let map = png(&folder.path().join("out/color_error.png"));
    let (mut blue, mut red) = (0, 0);
    for (x, shown) in map[..WIDTH].iter().enumerate() {
        // 6.3 at the first centre, of which the machine keeps 6.
        let error = (0.4 * x as f64 - 0.3).abs();
        let expected = if error > 1.0 {
            [255.0, 0.0, 0.0]
        } else {
            [error * 255.0, error * 220.0, (1.0 - error) * 160.0]
        };
        for (k, value) in expected.into_iter().enumerate() {
            assert!((f64::from(shown[k]) - value).abs() <= 1.01, "{x}: {shown:?} for {error}");
        }
        if error > 1.0 { red += 1 } else { blue += 1 }
    }
    assert!(red > 0 && blue > 0, "{red} red, {blue} blue");
}

/// A heat map whose scale is its own largest error: some pixel is yellow, none is red, and others lie between.
#[test]
fn the_largest_error_is_yellow_where_a_picture_has_a_scale_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let screen = ["--set", "screen.width=80", "--set", "screen.height=60", "-q", "--out", "out"];
    run(
        folder.path(),
        &[&["render", "sphere", "--shading", "gouraud", "--engine", "golden"][..], &screen].concat(),
    );
    run(
        folder.path(),
        &[&["compare", "default", "default,shade.kind=fast-phong", "sphere"][..], &screen].concat(),
    );
    for name in ["shading_error.png", "difference.png"] {
        let map = colors(&folder.path().join("out").join(name));
        let count = |color: [u8; 3]| map.iter().filter(|pixel| **pixel == color).count();
        let (none, yellow, red) = (count([0, 0, 0]), count([255, 220, 0]), count([255, 0, 0]));
        println!("{name}: {none} without an error, {yellow} yellow, {red} red of {}", map.len());
        assert_eq!(map.len(), 80 * 60, "{name}");
        assert!(none > 0 && yellow > 0 && red == 0 && none + yellow < map.len(), "{name}");
    }
}
