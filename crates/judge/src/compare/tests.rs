//! The comparison is fed pictures that are wrong in one thing each.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use super::{Bands, Blended, Comparison, Lit, compare};
use crate::shaded::{Looked, Shaded};
use crate::verdict::Verdict::{self, Mismatch, Pass, Vacuous};
use edgewalk_host::draw;
use edgewalk_host::extra::Values;
use edgewalk_host::raster::Raster;
use edgewalk_machine::{Dither, Machine, Plan, ScreenDoor};
use edgewalk_model::Waits;
use edgewalk_scene::{DepthFunc, Frame, Triangle, Vertex};

/// LSB of the default machine's depth.
const Z: f64 = 1.0 / 16_777_215.0;
/// LSB of its colours.
const C: f64 = 1.0 / 255.0;

fn machine() -> Plan {
    Machine { width: 16, height: 12, ..Machine::default() }.plan().unwrap()
}

/// A triangle over the left upper half of the screen, at one depth and in one colour.
fn half(z: f64, [r, g, b]: [f64; 3]) -> Triangle {
    Triangle([(0.0, 0.0), (16.0, 0.0), (0.0, 12.0)].map(|(x, y)| Vertex {
        x,
        y,
        z,
        r,
        g,
        b,
        ..Vertex::default()
    }))
}

/// Depths and colours on a screen that they cover half of.
fn frame(depth: Option<DepthFunc>, list: &[(f64, [f64; 3])]) -> Frame {
    let triangles = list.iter().map(|(z, rgb)| half(*z, *rgb)).collect();
    let depth_write = depth.is_some();
    Frame { depth, depth_write, clear: [0.25, 0.5, 0.75], triangles, ..Frame::new(16, 12) }
}

fn drawn(frame: &Frame) -> [Raster; 2] {
    [draw::golden(frame, &machine()), draw::fast(frame, &machine(), Waits::Never).unwrap()]
}

/// A pixel under the triangles, and one beside them.
const UNDER: usize = 16 + 2;
const BESIDE: usize = 11 * 16 + 15;

const FAR_RED: (f64, [f64; 3]) = (0.75, [1.0, 0.0, 0.0]);
const NEAR_GREEN: (f64, [f64; 3]) = (0.5, [0.0, 1.0, 0.0]);

/// What the comparison says of the true picture after `fault` has been at it.
fn after(frame: &Frame, fault: impl FnOnce(&mut Raster)) -> Comparison {
    let [golden, mut wrong] = drawn(frame);
    fault(&mut wrong);
    compare(&machine(), frame, &golden, &wrong)
}

#[test]
fn the_true_picture_passes_and_every_pixel_was_compared() {
    let c = after(&frame(Some(DepthFunc::Less), &[FAR_RED, NEAR_GREEN]), |_| {});
    assert_eq!(c.verdict(), Pass, "{}", said(&c));
    let half_and_diagonal = (16 * 12) / 2;
    assert_eq!(
        (c.counts.pixels, c.counts.screen, c.counts.covered, c.counts.compared),
        (192, 192, half_and_diagonal, half_and_diagonal)
    );
    assert!(
        c.errors.z.error > 0.0 && c.errors.color.error < 1e-9 && c.errors.z.bound < Some(1.0),
        "{}",
        said(&c)
    );
}

/// Without the maps.
fn said(c: &Comparison) -> String {
    serde_json::to_string(c).unwrap()
}

/// A fault at the picture, and what must be found of it.
type Case = (&'static str, fn(&mut Raster), fn(&Comparison) -> bool);

#[test]
fn each_field_wrong_alone_is_a_mismatch() {
    let cases: [Case; 19] = [
        ("coverage", |r| r.coverage[UNDER] += 1, |c| c.counts.coverage_mismatches == 1),
        ("coverage beside", |r| r.coverage[BESIDE] = 1, |c| c.counts.coverage_mismatches == 1),
        ("depth up", |r| r.z[UNDER] += 2.0 * Z, |c| (1.4..2.6).contains(&c.errors.z.error)),
        ("depth down", |r| r.z[UNDER] -= 2.0 * Z, |c| (1.4..2.6).contains(&c.errors.z.error)),
        ("red", |r| r.rgb[UNDER][0] += 3.0 * C, |c| (2.4..3.6).contains(&c.errors.color.error)),
        ("green", |r| r.rgb[UNDER][1] -= 3.0 * C, |c| (2.4..3.6).contains(&c.errors.color.error)),
        ("blue", |r| r.rgb[UNDER][2] += 3.0 * C, |c| (2.4..3.6).contains(&c.errors.color.error)),
        ("red wraps", |r| r.rgb[UNDER][0] = 1.0, |c| c.counts.wrapped == 1 && c.errors.color.error > 254.0),
        ("depth wraps", |r| r.z[UNDER] = 1.0, |c| c.counts.wrapped == 1),
        ("depth is no number", |r| r.z[UNDER] = f64::NAN, |c| c.errors.z.error.is_nan()),
        ("blue is no number", |r| r.rgb[UNDER][2] = f64::NAN, |c| c.errors.color.error.is_nan()),
        ("writes", |r| r.writes[UNDER] += 1, |c| c.counts.order_wrong == 1),
        ("winner", |r| r.id[UNDER] = 0, |c| c.counts.order_wrong == 1),
        ("no winner", |r| r.id[UNDER] = -1, |c| c.counts.order_wrong == 1),
        ("a winner beside", |r| r.id[BESIDE] = 1, |c| c.counts.order_wrong == 1),
        ("depth beside", |r| r.z[BESIDE] = 1.0 - Z, |c| c.counts.background_wrong == 1),
        ("clear colour beside", |r| r.rgb[BESIDE][2] -= C, |c| c.counts.background_wrong == 1),
        ("a pixel missing", |r| _ = r.coverage.pop(), |c| c.counts.pixels + 1 == c.counts.screen),
        ("cycles", |r| r.cycles.as_mut().unwrap().total += 1, |c| c.counts.cycles_unexplained == 1),
    ];
    let frame = frame(Some(DepthFunc::Less), &[(0.4, [0.5; 3]), (0.3, [0.0, 0.5, 0.5])]);
    let mut caught = 0;
    for (name, fault, found) in cases {
        let c = after(&frame, fault);
        assert!(found(&c), "{name}: {}", said(&c));
        assert_eq!(c.verdict(), Mismatch, "{name}: {}", said(&c));
        caught += 1;
    }
    assert_eq!(caught, cases.len());
}

#[test]
fn each_map_shows_the_pixel_that_is_off() {
    let frame = frame(Some(DepthFunc::Less), &[NEAR_GREEN]);
    let lit =
        |map: &[f64]| map.iter().enumerate().filter(|(_, e)| **e > 1.0).map(|(i, _)| i).collect::<Vec<_>>();
    let c = after(&frame, |r| r.z[UNDER] += 3.0 * Z);
    assert_eq!((lit(&c.errors.z.map), lit(&c.errors.color.map)), (vec![UNDER], vec![]));
    for channel in 0..3 {
        let c = after(&frame, |r| r.rgb[UNDER][channel] = 0.5);
        assert_eq!((lit(&c.errors.z.map), lit(&c.errors.color.map)), (vec![], vec![UNDER]), "{channel}");
        assert!((127.0..128.0).contains(&c.errors.color.map[UNDER]), "{}", c.errors.color.map[UNDER]);
    }
}

/// Shows `id` at the pixel, with its depth and colour, after so many writes.
fn show(raster: &mut Raster, frame: &Frame, id: i32, writes: u32) {
    let v = frame.triangles[id as usize].0[0];
    raster.id[UNDER] = id;
    raster.writes[UNDER] = writes;
    raster.rgb[UNDER] = [v.r, v.g, v.b];
    if frame.depth_write {
        raster.z[UNDER] = v.z;
    }
}

#[test]
fn an_order_is_open_only_as_near_as_the_bound_says() {
    // E1 + E2 + 1 with E = 8218 / 2^15 + 1/32 LSB.
    let apart = 1.0 + 2.0 * (8218.0 / 32768.0 + 1.0 / 32.0);
    let with =
        |lsb: f64, func| frame(Some(func), &[(0.5, [1.0, 0.0, 0.0]), (0.5 - lsb * Z, [0.0, 0.0, 1.0])]);
    let judge = |frame: &Frame, id: i32, writes: u32| {
        let c = after(frame, |r| show(r, frame, id, writes));
        (c.counts.order_undecided, c.counts.order_wrong, c.verdict())
    };
    for func in [DepthFunc::Less, DepthFunc::Lequal, DepthFunc::Notequal] {
        // Golden shows 1 after two writes; the machine may have rejected it.
        assert_eq!(judge(&with(apart - 0.01, func), 0, 1), (1, 0, Pass), "{func:?}");
        assert_eq!(judge(&with(apart + 0.01, func), 0, 1), (0, 1, Mismatch), "{func:?}");
        assert_eq!(
            judge(&with(apart - 0.01, func), 1, 1),
            (0, 1, Mismatch),
            "{func:?}: only with both writes"
        );
        assert_eq!(judge(&with(apart - 0.01, func), 1, 3), (0, 1, Mismatch), "{func:?}: a write too many");
    }
    // Against the cleared depth one error alone counts.
    let cleared = 1.0 + 8218.0 / 32768.0 + 1.0 / 32.0;
    for (lsb, expected) in [(cleared - 0.01, (1, 0, Pass)), (cleared + 0.01, (0, 1, Mismatch))] {
        let frame = frame(Some(DepthFunc::Less), &[(1.0 - lsb * Z, [1.0; 3])]);
        let c = after(&frame, |r| {
            (r.id[UNDER], r.writes[UNDER], r.z[UNDER]) = (-1, 0, 1.0);
            r.rgb[UNDER] = [64.0 * C, 128.0 * C, 191.0 * C];
        });
        assert_eq!((c.counts.order_undecided, c.counts.order_wrong, c.verdict()), expected, "{lsb}");
    }
}

#[test]
fn what_an_open_order_shows_is_compared_all_the_same() {
    let frame = frame(Some(DepthFunc::Less), &[(0.5, [1.0, 0.0, 0.0]), (0.5 - Z, [0.0, 0.0, 1.0])]);
    let faults: [fn(&mut Raster); 3] =
        [|r| r.rgb[UNDER] = [0.0, 0.0, 1.0], |r| r.z[UNDER] += 3.0 * Z, |r| r.rgb[UNDER][1] = f64::NAN];
    for fault in faults {
        let c = after(&frame, |r| {
            show(r, &frame, 0, 1);
            fault(r);
        });
        assert_eq!(
            (c.counts.order_undecided, c.counts.order_wrong, c.verdict()),
            (1, 0, Mismatch),
            "{}",
            said(&c)
        );
    }
}

/// Some lines of a picture.
fn lines(of: &Raster, lines: std::ops::Range<usize>) -> Raster {
    let at = lines.start * 16..lines.end * 16;
    Raster {
        height: lines.len() as u32,
        coverage: of.coverage[at.clone()].to_vec(),
        writes: of.writes[at.clone()].to_vec(),
        id: of.id[at.clone()].to_vec(),
        z: of.z[at.clone()].to_vec(),
        rgb: of.rgb[at].to_vec(),
        ..of.clone()
    }
}

/// However a picture is cut into bands, as much is found as in the whole, and at the same pixels.
#[test]
fn bands_find_what_the_whole_has() {
    let frame = frame(Some(DepthFunc::Less), &[(0.5, [1.0, 0.0, 0.0]), (0.5 - Z, [0.0, 0.0, 1.0])]);
    assert!(Bands::suit(&frame));
    let faults: [fn(&mut Raster, &Frame); 5] = [
        |_, _| (),
        |r, f| show(r, f, 0, 1), // undecided, in the second line
        |r, f| show(r, f, 0, 3), // wrong there
        |r, _| r.z[5 * 16 + 3] += 3.0 * Z,
        |r, _| r.rgb[BESIDE][1] = 0.0,
    ];
    let mut checked = 0;
    for fault in faults {
        let [golden, mut wrong] = drawn(&frame);
        fault(&mut wrong, &frame);
        let whole = compare(&machine(), &frame, &golden, &wrong);
        for height in [1, 5, 12] {
            let machine = machine();
            let mut bands = Bands::new(&machine, &frame, wrong.cycles.as_ref(), None);
            let mut maps = [Vec::new(), Vec::new()];
            for top in (0..12).step_by(height) {
                let band = top..12.min(top + height);
                let found = bands.add(&lines(&golden, band.clone()), &lines(&wrong, band));
                maps.iter_mut().zip(found).for_each(|(map, found)| map.extend(found));
            }
            let mut found = bands.found();
            assert!(maps == [whole.errors.z.map.clone(), whole.errors.color.map.clone()], "{height}");
            // The order of a sum may be another.
            for (a, b) in [
                (&mut found.errors.z.spread, whole.errors.z.spread),
                (&mut found.errors.color.spread, whole.errors.color.spread),
            ] {
                assert!((a.mean - b.mean).abs() < 1e-12 && (a.bias - b.bias).abs() < 1e-12, "{a:?} {b:?}");
                (a.mean, a.bias) = (b.mean, b.bias);
            }
            assert_eq!(said(&found), said(&whole), "bands of {height} lines");
            checked += 1;
        }
    }
    println!("{checked} / 15 comparisons in bands find what the whole has");
    assert_eq!(checked, 15);
}

#[test]
fn without_a_depth_test_no_order_is_open() {
    // At the cleared depth every test that there is would be open.
    for z in [0.5, 1.0] {
        for depth in [None, Some(DepthFunc::Always), Some(DepthFunc::Never)] {
            let frame = frame(depth, &[(z, [1.0, 0.0, 0.0]), (z, [0.0, 0.0, 1.0])]);
            assert_eq!(after(&frame, |_| {}).verdict(), Pass, "{depth:?}");
            let c = after(&frame, |r| show(r, &frame, 0, 1));
            assert_eq!(
                (c.counts.order_undecided, c.counts.order_wrong, c.verdict()),
                (0, 1, Mismatch),
                "{depth:?} {z}"
            );
        }
    }
}

#[test]
fn without_a_bound_no_order_is_open_and_one_lsb_is_allowed() {
    let list = [(0.5, [1.0, 0.0, 0.0]), (0.5 - Z, [0.0, 0.0, 1.0])];
    let frame = frame(Some(DepthFunc::Less), &list);
    let [golden, mut wrong] = drawn(&frame);
    let mut machine = Machine::clone(&machine());
    (machine.z.fraction, machine.color.fraction) = (4, 4);
    let machine = machine.plan().unwrap();
    let c = compare(&machine, &frame, &golden, &wrong);
    assert_eq!((c.errors.z.bound, c.errors.color.bound, c.verdict()), (None, None, Pass));
    assert!(c.errors.z.no_bound.unwrap().contains("8217 additions") && c.errors.color.no_bound.is_some());
    show(&mut wrong, &frame, 0, 1);
    let c = compare(&machine, &frame, &golden, &wrong);
    assert_eq!((c.counts.order_undecided, c.counts.order_wrong, c.verdict()), (0, 1, Mismatch));
    for (lsb, verdict) in [(0.9, Pass), (1.1, Mismatch)] {
        let [golden, mut wrong] = drawn(&frame);
        wrong.rgb[UNDER][0] += lsb * C;
        assert_eq!(compare(&machine, &frame, &golden, &wrong).verdict(), verdict, "{lsb}");
    }
}

#[test]
fn nothing_drawn_is_nothing_compared() {
    let frame = frame(Some(DepthFunc::Less), &[]);
    assert_eq!(after(&frame, |_| {}).verdict(), Vacuous);
    let something: Verdict = after(&frame, |r| r.coverage[UNDER] = 1).verdict();
    assert_eq!(something, Mismatch, "but a machine that draws where golden does not is wrong");
}

/// A fault at the values of two channels, and what must be found of it.
type Fault<'a> = &'a dyn Fn(&mut [Vec<i64>; 2]);
type Found<'a> = &'a dyn Fn(&Comparison) -> bool;

/// Two channels of the user's own: signed, and floor.
fn own_machine() -> Plan {
    let mut machine = Machine { width: 16, height: 12, extra: 2, ..Machine::default() };
    machine.set("channels.e0_kind", "signed").unwrap();
    machine.plan().unwrap()
}

#[test]
fn each_value_of_the_users_own_wrong_alone_is_a_mismatch() {
    let mut frame = frame(Some(DepthFunc::Less), &[NEAR_GREEN]);
    frame.extra = 2;
    for (vertex, own) in frame.triangles[0].0.iter_mut().zip([-700.25, 3.0, 12.5]) {
        vertex.extra = [own, own - 0.5, 0.0, 0.0];
    }
    let machine = own_machine();
    let [golden, right] =
        [draw::golden(&frame, &machine), draw::fast(&frame, &machine, Waits::Never).unwrap()];
    let after = |fault: Fault| {
        let mut wrong = right.clone();
        let mut values = [0, 1].map(|i| match &wrong.extra[i] {
            Values::Stored(values) => values.clone(),
            Values::Exact(_) => panic!("the machine stores whole numbers"),
        });
        fault(&mut values);
        wrong.extra = values.map(Values::Stored).into();
        compare(&machine, &frame, &golden, &wrong)
    };
    let c = after(&|_| {});
    assert_eq!(c.verdict(), Pass, "{}", said(&c));
    let errors = [0, 1].map(|i| c.extra[i].error);
    assert!(errors.iter().all(|error| *error > 0.3), "{errors:?}");
    let bounds = [0, 1].map(|i| c.extra[i].channel.bound.unwrap());
    assert!(bounds[0] < 1.0 && bounds[1] > 1.0 && bounds[1] < 1.5, "{bounds:?}");
    let cases: [(Fault, Found); 5] = [
        (&|own| own[0][UNDER] += 2, &|c| c.extra[0].error > 1.4 && c.extra[1].error == errors[1]),
        (&|own| own[1][UNDER] -= 2, &|c| c.extra[1].error > 1.9 && c.extra[0].error == errors[0]),
        (&|own| own[0][UNDER] += 4096, &|c| c.counts.wrapped == 1),
        (&|own| own[1][BESIDE] = 1, &|c| c.counts.background_wrong == 1),
        (&|own| own.swap(0, 1), &|c| c.extra[0].error > bounds[0]),
    ];
    let mut caught = 0;
    for (fault, found) in cases {
        let c = after(fault);
        assert!(found(&c), "{}", said(&c));
        assert_eq!(c.verdict(), Mismatch, "{}", said(&c));
        caught += 1;
    }
    assert_eq!(caught, cases.len());
}

/// A colour that is within the bound, and that the pattern of DITHER does not make there.
#[test]
fn colour_off_the_pattern_alone_is_a_mismatch() {
    let dither = Dither { bits: 5, screen_door: ScreenDoor::No };
    let machine = Machine { dither, ..Machine::clone(&machine()) }.plan().unwrap();
    let frame = frame(Some(DepthFunc::Less), &[(0.5, [0.5; 3])]);
    let golden = draw::golden(&frame, &machine);
    let mut drawn = draw::fast(&frame, &machine, Waits::Never).unwrap();
    let c = compare(&machine, &frame, &golden, &drawn);
    assert_eq!((c.verdict(), c.counts.off_pattern), (Pass, Some(0)));
    // Of the neighbours 15/31 and 16/31 the other.
    drawn.rgb[UNDER][0] = 1.0 - drawn.rgb[UNDER][0];
    let c = compare(&machine, &frame, &golden, &drawn);
    assert_eq!((c.verdict(), c.counts.off_pattern, c.errors.color.beyond()), (Mismatch, Some(1), 0));
    assert_eq!(c.counts.wrong(), 1);
}

/// What the parts of a comparison found counts in its verdict, each alone.
#[test]
fn each_part_wrong_alone_is_a_mismatch() {
    let frame = frame(Some(DepthFunc::Less), &[FAR_RED, NEAR_GREEN]);
    let looked = |unexplained| Some(Looked { unexplained, ..Looked::default() });
    let parts: [(&str, fn(&mut Comparison, u64)); 4] = [
        ("blended", |c, beyond| c.blended = Some(Blended { beyond, ..Blended::default() })),
        ("lit", |c, unexplained| c.lit = Some(Lit { unexplained, ..Lit::default() })),
        ("shaded", |c, beyond| c.shaded = Some(Shaded { beyond, ..Shaded::default() })),
        ("texels", |_, _| ()),
    ];
    for (part, put) in parts {
        for (wrong, verdict) in [(0, Pass), (1, Mismatch)] {
            let mut c = after(&frame, |_| ());
            put(&mut c, wrong);
            if part == "texels" {
                c.shaded = Some(Shaded { texels: looked(wrong), ..Shaded::default() });
            }
            assert_eq!(c.verdict(), verdict, "{part}");
        }
    }
}
