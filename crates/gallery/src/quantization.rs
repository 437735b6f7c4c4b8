//! Fewer bits a colour: bands, and the pattern that takes them away (the slides: "colour quantization error and the resulting Mach
//! banding"; ch. 7.4: pixel level tricks).

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, LSB, View, WIDTH, figure};
use anyhow::Result;
use edgewalk_golden::dither::Dither;
use edgewalk_golden::{Shading, shade};
use edgewalk_host::draw::fast;
use edgewalk_machine::Machine;
use edgewalk_model::Waits;
use edgewalk_scene::{Frame, Scene, Triangle, Vertex};
use std::path::Path;

const SCENE: &str = include_str!("../scenes/mach-bands.toml");

/// Pixels of a side of the squares whose means are compared.
const SQUARE: u32 = 8;

pub(crate) fn quantization() -> Result<Exhibit> {
    let scene = Scene::parse(Path::new("mach-bands.toml"), SCENE)?;
    let surface = scene.surface(WIDTH, HEIGHT, GUARD);
    let [gouraud, phong] =
        [Shading::Gouraud, Shading::Phong].map(|shading| shade(&scene, &surface, shading, FILL).picture.rgb);
    let (mut figures, mut views) = (Vec::new(), Vec::new());
    for (left, captions) in [4, 5, 6, 8].into_iter().zip(NAMES) {
        let dither = Dither { bits: 8, left };
        let jump = LSB * dither.color(1);
        figures.push(figure(format!("{left} bits: jump from a band to the next, LSB of 8 bits"), jump, 2));
        for (rgb, (name, caption)) in [&gouraud, &phong].into_iter().zip(&captions[..2]) {
            let nearest = colors(rgb, |color, _| dither.nearest(color), dither);
            let bands = steps(&nearest);
            figures.push(figure(format!("{caption}: neighbours a band or more apart"), bands as f64, 0));
            views.push(View::colors(name, *caption, nearest));
        }
        if left < 8 {
            let (name, caption) = captions[2];
            let ordered = colors(&phong, |color, [x, y]| dither.ordered(dither.whole(color), x, y), dither);
            views.push(View::colors(name, caption, ordered));
        }
    }
    for left in [4, 5, 6] {
        figures.extend(ramp(left)?);
    }
    Ok(Exhibit {
        name: "quantization",
        title: "Colour quantization and dither",
        cause: "A colour of few bits has few steps: a smooth surface becomes bands, each border a jump that the eye takes for an \
                edge, in Phong shading as in Gouraud. An ordered pattern (DITHER) decides at each pixel between the step \
                below and the one above, so that the mean of neighbours is the colour. It costs no memory and no clock. The \
                ramp of the figures rises by 40 LSB over 256 pixels, drawn by the machine; its means are those of 8 x 8 pixels, \
                against the exact plane.",
        figures,
        views,
    })
}

/// By the bits that are left: Gouraud, Phong, and Phong with the pattern; file names and captions.
const NAMES: [[(&str, &str); 3]; 4] = [
    [
        ("gouraud-4", "Gouraud, 4 bits"),
        ("phong-4", "Phong, 4 bits"),
        ("phong-4-dithered", "Phong, 4 bits, dithered"),
    ],
    [
        ("gouraud-5", "Gouraud, 5 bits"),
        ("phong-5", "Phong, 5 bits"),
        ("phong-5-dithered", "Phong, 5 bits, dithered"),
    ],
    [
        ("gouraud-6", "Gouraud, 6 bits"),
        ("phong-6", "Phong, 6 bits"),
        ("phong-6-dithered", "Phong, 6 bits, dithered"),
    ],
    [("gouraud-8", "Gouraud, 8 bits"), ("phong-8", "Phong, 8 bits"), ("", "")],
];

/// The picture with every colour by its step.
fn colors(rgb: &[[f64; 3]], step: impl Fn(f64, [u32; 2]) -> u64, dither: Dither) -> Vec<[f64; 3]> {
    let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| [x, y]));
    rgb.iter().zip(places).map(|(rgb, place)| rgb.map(|color| dither.color(step(color, place)))).collect()
}

/// Pixels whose right neighbour has another colour.
fn steps(rgb: &[[f64; 3]]) -> usize {
    rgb.chunks(WIDTH as usize).map(|line| line.windows(2).filter(|pair| pair[0] != pair[1]).count()).sum()
}

/// A ramp of 40 LSB over 256 pixels by machines that round to the nearest and by the pattern: mean and largest error of squares.
fn ramp(left: u32) -> Result<Vec<(String, String)>> {
    let (side, lines) = (256, 64);
    let at = |x: f64, y: f64| {
        let grey = (100.0 + 40.0 * x / f64::from(side)) / LSB;
        Vertex { x, y, z: 0.5, r: grey, g: grey, b: grey, ..Vertex::default() }
    };
    let [a, b, c, d] = [at(0.0, 0.0), at(256.0, 0.0), at(256.0, 64.0), at(0.0, 64.0)];
    let frame =
        Frame { triangles: vec![Triangle([a, b, c]), Triangle([a, c, d])], ..Frame::new(side, lines) };
    let exact = |x: u32| (100.0 + 40.0 * (f64::from(x) + 0.5) / f64::from(side)) / LSB;
    let drawn = |change: fn(&mut Machine, u32)| -> Result<Vec<[f64; 3]>> {
        let machine = Machine { width: side, height: lines, ..Machine::default() };
        Ok(fast(&frame, &machine.with(|keys| change(keys, left)).plan()?, Waits::Never)?.rgb)
    };
    let nearest = drawn(|keys, bits| keys.color.bits = bits)?;
    let ordered = drawn(|keys, bits| keys.dither.bits = bits)?;
    let mut figures = Vec::new();
    for (rgb, name) in [(nearest, "nearest"), (ordered, "dithered")] {
        let errors: Vec<f64> = (0..lines / SQUARE)
            .flat_map(|j| (0..side / SQUARE).map(move |i| [i * SQUARE, j * SQUARE]))
            .map(|[left, top]| {
                let pixels = (top..top + SQUARE).flat_map(|y| (left..left + SQUARE).map(move |x| (x, y)));
                let off = pixels.map(|(x, y)| rgb[(y * side + x) as usize][0] - exact(x)).sum::<f64>();
                LSB * (off / f64::from(SQUARE * SQUARE)).abs()
            })
            .collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        figures.push(figure(format!("ramp, {left} bits, {name}: mean error of squares, LSB"), mean, 2));
        let most = errors.into_iter().fold(0.0, f64::max);
        figures.push(figure(format!("ramp, {left} bits, {name}: largest error of squares, LSB"), most, 2));
    }
    Ok(figures)
}
