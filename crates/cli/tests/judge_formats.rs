//! `edgewalk judge`: which arrays and pictures it reads, and what their bits leave of a tolerance.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::judging::{TWO, folder, judged, raster};
use crate::support::{edgewalk, ended};
use std::path::Path;

/// A picture of `lit` alone has nothing in common with that of a machine without SHADOW.
#[test]
fn judge_that_compares_nothing_ends_with_2() {
    let folder = folder(TWO);
    raster(folder.path(), &["--engine", "golden"], "g");
    let (code, _, error) = judged(folder.path(), &["g/lit.npy", "--against", "machine"]);
    assert_eq!(code, Some(2), "{error}");
    for part in
        ["a machine without SHADOW has none", "permitted: one or more of coverage, id, z and rgb", "add"]
    {
        assert!(error.contains(part), "{error}");
    }
    let (code, report, error) = judged(folder.path(), &["g/lit.npy"]);
    assert_eq!((code, &report["compared"]), (Some(0), &serde_json::json!(["lit"])), "{error}");
}

/// Six layers of glass over half of the screen.
fn glass() -> String {
    let layer = |n: u32| {
        let (z, c) = (f64::from(6 - n) / 10.0, f64::from(n % 4) / 3.0);
        format!("T 0 0 {z} 1 {c} 0.3 .5  32 0 {z} {c} 1 0.1 .5  0 32 {z} 0.2 {c} 1 .5\n")
    };
    "size 32 32\nblend 1\n".to_owned() + &(0..6).map(layer).collect::<String>()
}

/// Bits that are the machine's own are no other format: the bound of the layers holds. Other bits have 1 LSB.
#[test]
fn bits_of_the_machine_leave_its_bounds() {
    let glass = glass();
    for (text, set) in [(TWO, "blend.kind=none"), (&glass[..], "blend.kind=constant")] {
        let (folder, set) = (folder(text), ["--set", set]);
        raster(folder.path(), &set, "m");
        let judged = |options: &[&str]| judged(folder.path(), &[&["m"], &set[..], options].concat());
        let (code, report, error) = judged(&[]);
        let (own, other) = (["--color-bits", "8", "--depth-bits", "24"], ["--color-bits", "7"]);
        assert_eq!(code, Some(0), "{error}{report}");
        let (code, with_bits, error) = judged(&own);
        assert_eq!((code, &with_bits), (Some(0), &report), "{error}");
        assert_eq!(judged(&other).1["tolerance"]["color"], 1.0);
        let is_glass = text != TWO;
        let layers = &report["tolerance"]["layers"];
        assert_eq!(layers.as_f64().is_some_and(|most| most > 1.0), is_glass, "{layers}");
        assert!(judged(&other).1["tolerance"]["layers"].is_null());
        let text =
            edgewalk(folder.path(), &["judge", "in.tri", "m", set[0], set[1]]).output().unwrap().stdout;
        assert_eq!(String::from_utf8(text).unwrap().contains("behind the layers of a pixel"), is_glass);
    }
}

/// An array of numpy with 32 x 32 values, or colours (`each` = 3).
fn npy(path: &Path, descr: &str, each: usize, values: &[u8]) {
    let colors = if each == 3 { ", 3" } else { "" };
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': (32, 32{colors}), }}");
    let padded = format!("{header:<117}\n");
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((padded.len() as u16).to_le_bytes());
    file.extend(padded.as_bytes());
    file.extend(values);
    std::fs::write(path, file).unwrap();
}

/// `judge` refuses values outside the permitted range. The error names the pixel and the range.
#[test]
fn values_out_of_range_are_refused() {
    let folder = folder(TWO);
    let float = |value: f64| value.to_le_bytes().to_vec();
    let floats =
        "permitted: floats in 0 to 1, or unsigned integers in LSB; divide by the value that stands for 1";
    let cases: [(&str, &str, Vec<u8>, [&str; 2]); 10] = [
        ("z", "<f8", float(5.0), ["5 in pixel (0, 0)", floats]),
        ("z", "<f8", float(-3.0), ["-3 in pixel (0, 0)", floats]),
        ("z", "<f8", float(f64::INFINITY), ["inf in pixel (0, 0)", floats]),
        ("z", "<f8", float(f64::NAN), ["NaN in pixel (0, 0)", floats]),
        ("rgb", "<f4", 255f32.to_le_bytes().to_vec(), ["255 in pixel (0, 0)", floats]),
        (
            "id",
            "<u4",
            vec![0xff; 4],
            ["4294967295 in pixel (0, 0)", "permitted: -1 for none, or a place in the input"],
        ),
        (
            "id",
            "<i4",
            (-2i32).to_le_bytes().to_vec(),
            ["-2 in pixel", "0 to 2147483647; write them as int32"],
        ),
        ("id", "<u8", vec![0xff; 8], ["18446744073709551615 in pixel", "permitted: -1 for none"]),
        (
            "coverage",
            "<i4",
            vec![0xff; 4],
            ["-1 in pixel (0, 0)", "permitted: 0 to 4294967295, the number of"],
        ),
        (
            "lit",
            "|u1",
            vec![3],
            ["3 in pixel (0, 0)", "permitted: 0 for nothing written, 1 for in shadow, 2 for lit"],
        ),
    ];
    for (name, descr, value, parts) in cases {
        let file = folder.path().join(format!("{name}.npy"));
        let each = if name == "rgb" { 3 } else { 1 };
        npy(&file, descr, each, &value.repeat(32 * 32 * each));
        let (code, _, error) = judged(folder.path(), &[&format!("{name}.npy")]);
        assert_eq!(code, Some(2), "{name} {value:?}: {error}");
        for part in parts {
            assert!(error.contains(part), "{name} {value:?}: {error}");
        }
        std::fs::remove_file(file).unwrap();
    }
    // Single precision may be a little outside.
    npy(&folder.path().join("z.npy"), "<f4", 1, &1.000_001f32.to_le_bytes().repeat(32 * 32));
    assert_eq!(judged(folder.path(), &["z.npy"]).0, Some(1));
}

/// By the textbook rule a triangle covers centres beside it, where its plane leaves 0 to 1.
#[test]
fn goldens_textbook_arrays_are_judged() {
    let folder = folder(
        "size 33 17
T 2.3 2.4 0 1 0 0 0  30.2 3.7 1 0 1 0 0  12.6 14.3 0.5 0 0 1 0
T 20.1 3 1 0 1 0 0  22.2 15.7 0 0 1 0 0  31.6 9.3 0 0 0 1 0
",
    );
    let textbook = ["--machine", "textbook"];
    raster(folder.path(), &["--engine", "golden", "--machine", "textbook"], "g");
    let (code, report, error) = judged(folder.path(), &[&["g"], &textbook[..]].concat());
    assert_eq!((code, &report["wrong"]), (Some(0), &0.into()), "{error}");
    // By another rule such floats are wrong values.
    let (code, _, error) = judged(folder.path(), &["g"]);
    assert!(code == Some(2) && error.contains("permitted: floats in 0 to 1"), "{error}");
    // What is no number is refused by every rule.
    let mut bytes = std::fs::read(folder.path().join("g/z.npy")).unwrap();
    let end = bytes.len() - 8;
    bytes[end..].copy_from_slice(&f64::NAN.to_le_bytes());
    std::fs::write(folder.path().join("g/z.npy"), bytes).unwrap();
    let (code, _, error) = judged(folder.path(), &[&["g"], &textbook[..]].concat());
    assert!(code == Some(2) && error.contains("NaN in pixel (32, 16); permitted: finite floats"), "{error}");
}

/// A PNG has bits of its own, to which it rounds the machine's colours.
#[test]
fn pngs_of_machines_of_other_bits_are_right() {
    let folder = folder(TWO);
    for (bits, others) in [("6", "7"), ("4", "5"), ("12", "5")] {
        let with = |bits: &str| ["--set".to_owned(), format!("formats.color_bits={bits}")];
        for (out, bits) in [("own", bits), ("other", others)] {
            let [set, key] = with(bits);
            let words = ["render", "in.tri", "--out", out, &set, &key];
            assert_eq!(ended(&edgewalk(folder.path(), &words).output().unwrap()).0, Some(0), "{words:?}");
        }
        let [set, key] = with(bits);
        for (picture, code) in [("own/image.png", Some(0)), ("other/image.png", Some(1))] {
            let (found, report, error) =
                judged(folder.path(), &[picture, "--against", "machine", &set, &key]);
            assert_eq!(found, code, "{bits}: {error}{report}");
            assert_eq!(report["wrong"].as_u64().unwrap() > 100, code == Some(1), "{bits}: {report}");
        }
        let (found, report, error) = judged(folder.path(), &["own/image.png", &set, &key]);
        assert_eq!((found, &report["wrong"]), (Some(0), &0.into()), "{bits}: {error}");
        // What the user asks for holds as it is.
        let asked = ["own/image.png", "--color-lsb", "0.5", &set, &key];
        let (_, report, _) = judged(folder.path(), &asked);
        assert_eq!(report["tolerance"]["color"], 0.5, "{bits}");
    }
}

/// Integers have the bits that DITHER stores, not those before it.
#[test]
fn integers_of_dither_are_what_it_stores() {
    let (folder, dither) = (folder(TWO), ["--set", "dither.bits=4"]);
    raster(folder.path(), &dither, "m");
    let (_, _, bytes) = crate::support::npy(&folder.path().join("m/rgb.npy"));
    let stored = |value: &[u8]| (f64::from_le_bytes(value.try_into().unwrap()) * 15.0).round() as u8;
    let stored: Vec<u8> = bytes.chunks_exact(8).map(stored).collect();
    assert!(stored.len() == 32 * 32 * 3 && stored.contains(&15) && stored.contains(&7), "{stored:?}");
    npy(&folder.path().join("rgb.npy"), "|u1", 3, &stored);
    let judged = |options: &[&str]| judged(folder.path(), &[&["rgb.npy"], &dither[..], options].concat());
    let (code, report, error) = judged(&[]);
    assert_eq!((code, &report["wrong"]), (Some(0), &0.into()), "{error}{report}");
    assert_eq!(judged(&["--color-bits", "8"]).0, Some(1), "bits before DITHER");
}
