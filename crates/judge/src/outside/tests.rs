//! The judge is fed pictures that are wrong in one thing each, and some that are right.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use super::{Asked, Cause, Judgement, Picture, Rule, Tolerance, beside_golden, beside_machine};
use crate::verdict::Verdict::{Mismatch, Pass, Vacuous};
use edgewalk_host::draw;
use edgewalk_host::raster::Raster;
use edgewalk_machine::{Blend, BlendKind, Machine, Plan};
use edgewalk_model::Waits;
use edgewalk_scene::{Blending, DepthFunc, Frame, Triangle, Vertex};

/// LSB of the default machine's depth.
const Z: f64 = 1.0 / 16_777_215.0;
/// LSB of its colours.
const C: f64 = 1.0 / 255.0;

const SIZE: (u32, u32) = (16, 12);

fn machine() -> Plan {
    Machine { width: SIZE.0, height: SIZE.1, ..Machine::default() }.plan().unwrap()
}

/// A triangle over the left upper half of the screen, at one depth and in one colour.
fn half(z: f64, [r, g, b]: [f64; 3]) -> Triangle {
    let corners = [(0.0, 0.0), (16.0, 0.0), (0.0, 12.0)];
    Triangle(corners.map(|(x, y)| Vertex { x, y, z, r, g, b, kt: 0.5, ..Vertex::default() }))
}

/// A far red half under a near green one.
fn frame() -> Frame {
    let triangles = vec![half(0.75, [1.0, 0.0, 0.0]), half(0.5, [0.0, 1.0, 0.0])];
    Frame { depth: Some(DepthFunc::Less), depth_write: true, triangles, ..Frame::new(SIZE.0, SIZE.1) }
}

fn picture(of: Raster) -> Picture {
    let Raster { width, height, coverage, id, z, rgb, lit, .. } = of;
    Picture {
        width,
        height,
        coverage: Some(coverage),
        id: Some(id),
        z: Some(z),
        rgb: Some(rgb),
        lit,
        color_step: 0.0,
    }
}

/// A pixel under the triangles, and the last one of the screen.
const UNDER: usize = 16 + 2;
const LAST: usize = 16 * 12 - 1;

fn judged(frame: &Frame, machine: &Plan, asked: Asked, fault: impl FnOnce(&mut Picture)) -> Judgement {
    let mut picture = picture(draw::golden(frame, machine));
    fault(&mut picture);
    let tolerance = Tolerance::of(machine, frame, Asked::default(), asked);
    beside_golden(machine, frame, &picture, &tolerance, Rule::TopLeft).unwrap()
}

fn after(fault: impl FnOnce(&mut Picture)) -> Judgement {
    judged(&frame(), &machine(), Asked::default(), fault)
}

fn count(judgement: &Judgement, cause: Cause) -> u64 {
    judgement.causes[cause as usize].pixels
}

#[test]
fn golden_picture_passes_in_every_array() {
    let judgement = after(|_| ());
    assert_eq!((judgement.verdict(), judgement.agree, judgement.pixels), (Pass, 192, 192));
    assert_eq!(judgement.compared, ["coverage", "id", "z", "rgb", "lit"]);
    assert!(judgement.covered > 80 && judgement.largest_error_lsb == [Some(0.0); 2]);
}

type Fault = fn(&mut Picture);

fn z(picture: &mut Picture, pixel: usize) -> &mut f64 {
    &mut picture.z.as_mut().unwrap()[pixel]
}

fn rgb(picture: &mut Picture, pixel: usize) -> &mut [f64; 3] {
    &mut picture.rgb.as_mut().unwrap()[pixel]
}

#[test]
fn each_array_wrong_alone_is_one_wrong_pixel() {
    let faults: [(Fault, Cause); 18] = [
        (|p| *z(p, UNDER) += 3.0 * Z, Cause::Depth),
        (|p| *z(p, UNDER) -= 3.0 * Z, Cause::Depth),
        (|p| *z(p, UNDER) = f64::NAN, Cause::Depth),
        (|p| rgb(p, UNDER)[0] += 3.0 * C, Cause::Color),
        (|p| rgb(p, UNDER)[1] -= 3.0 * C, Cause::Color),
        (|p| rgb(p, UNDER)[2] += 3.0 * C, Cause::Color),
        (|p| rgb(p, UNDER)[0] = f64::NAN, Cause::Color),
        (|p| rgb(p, UNDER)[1] = f64::NAN, Cause::Color),
        (|p| rgb(p, UNDER)[2] = f64::NAN, Cause::Color),
        (|p| p.coverage.as_mut().unwrap()[UNDER] = 3, Cause::Twice),
        (|p| p.coverage.as_mut().unwrap()[UNDER] = 1, Cause::LayerMissing),
        (|p| p.id.as_mut().unwrap()[UNDER] = 0, Cause::WrongWinner),
        (|p| p.lit.as_mut().unwrap()[UNDER] = 1, Cause::Light),
        (|p| *z(p, LAST) = 0.5, Cause::Depth),
        (|p| rgb(p, LAST)[1] = 0.5, Cause::Color),
        (|p| p.id.as_mut().unwrap()[LAST] = 1, Cause::Extra),
        (|p| (*z(p, LAST), p.id, p.coverage) = (0.5, None, None), Cause::Extra),
        (|p| (*z(p, UNDER), *rgb(p, UNDER)) = (0.75, [1.0, 0.0, 0.0]), Cause::WrongWinner),
    ];
    for (place, (fault, cause)) in faults.into_iter().enumerate() {
        let judgement = after(|picture| {
            fault(picture);
            if place == 17 {
                picture.id = None;
            }
        });
        let found = (judgement.verdict(), judgement.wrong(), judgement.agree, count(&judgement, cause));
        assert_eq!(found, (Mismatch, 1, 191, 1), "fault {place}: {}", judgement.lines());
    }
}

#[test]
fn every_wrong_pixel_is_counted() {
    let judgement = after(|p| (0..12).for_each(|pixel| rgb(p, pixel)[0] = 0.5));
    assert_eq!((judgement.wrong(), judgement.agree, judgement.examples.len()), (12, 180, 10));
    assert!(judgement.lines().contains("and 2 more"));
}

/// As near as the tolerance says another triangle may show; an LSB farther it may not.
#[test]
fn tie_is_as_near_as_the_tolerance_says() {
    let tolerance = Tolerance::of(&machine(), &frame(), Asked::default(), Asked::default());
    let within = (2.0 * tolerance.z + 1.0).floor();
    for (lsb, cause, verdict) in [(within, Cause::Tie, Pass), (within + 1.0, Cause::WrongWinner, Mismatch)] {
        let mut frame = frame();
        frame.triangles[0] = half(0.5 + lsb * Z, [1.0, 0.0, 0.0]);
        let judgement = judged(&frame, &machine(), Asked::default(), |p| {
            (*z(p, UNDER), *rgb(p, UNDER)) = (0.5 + lsb * Z, [1.0, 0.0, 0.0]);
            p.id.as_mut().unwrap()[UNDER] = 0;
        });
        assert_eq!((count(&judgement, cause), judgement.verdict()), (1, verdict), "{}", judgement.lines());
    }
}

/// The bound of a blended pixel's layers holds unless the user gives a tolerance.
#[test]
fn asked_tolerance_holds_for_blended_pixels() {
    let blend = Blend { kind: BlendKind::Constant, ..Machine::default().blend };
    let machine = Machine { blend, ..Machine::clone(&machine()) }.plan().unwrap();
    let frame = Frame { blend: Blending::Mix, ..frame() };
    let asked = Asked { lsb: Some(30.0), ..Asked::default() };
    for (off, asked, verdict) in [
        (20.0, Asked::default(), Mismatch),
        (20.0, asked, Pass),
        (0.5, Asked::default(), Pass),
        (31.0, asked, Mismatch),
    ] {
        let judgement = judged(&frame, &machine, asked, |p| rgb(p, UNDER)[1] -= off * C);
        assert_eq!(judgement.verdict(), verdict, "{off}: {}", judgement.lines());
    }
}

#[test]
fn nothing_covered_is_nothing_judged() {
    let frame = Frame { triangles: Vec::new(), ..frame() };
    assert_eq!(judged(&frame, &machine(), Asked::default(), |_| ()).verdict(), Vacuous);
}

/// Beside the machine nothing is tolerated.
#[test]
fn machines_picture_must_be_equal() {
    let (frame, machine) = (frame(), machine());
    let drawn = draw::fast(&frame, &machine, Waits::Never).unwrap();
    let tolerance = Tolerance::of(&machine, &frame, Asked::default(), Asked::default());
    for (off, verdict) in [(0.0, Pass), (0.25, Mismatch)] {
        let mut picture = picture(drawn.clone());
        *z(&mut picture, UNDER) += off * Z;
        let judgement = beside_machine(&machine, &frame, &drawn, &picture, &tolerance).unwrap();
        assert_eq!(judgement.verdict(), verdict, "{}", judgement.lines());
    }
}

/// Under each fill rule the report gives a wrong pixel its own coordinates.
#[test]
fn findings_lie_where_the_screen_has_them() {
    let (frame, machine) = (frame(), machine());
    let tolerance = Tolerance::of(&machine, &frame, Asked::default(), Asked::default());
    for rule in [Rule::TopLeft, Rule::TopRight, Rule::BottomLeft, Rule::BottomRight] {
        let mut picture = picture(draw::golden(&frame, &machine));
        picture.coverage = None;
        picture.lit = None;
        *z(&mut picture, 3 * 16 + 2) = 0.25;
        rgb(&mut picture, 5 * 16 + 4)[2] = 1.0;
        let judgement = beside_golden(&machine, &frame, &picture, &tolerance, rule).unwrap();
        let places: Vec<_> = judgement.examples.iter().map(|found| (found.x, found.y, found.cause)).collect();
        for (x, y, cause) in [(2, 3, Cause::Depth), (4, 5, Cause::Color)] {
            assert!(places.contains(&(x, y, cause)), "{rule}: {places:?}");
            assert_eq!(judgement.map[(y * 16 + x) as usize], cause as u8, "{rule}");
        }
    }
}
