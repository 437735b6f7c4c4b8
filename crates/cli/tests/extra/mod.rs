//! Channels of the user's own, end to end: a triangle file with `X` lines through every engine, explained, compared, refused.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

mod drawn;
mod refused;
mod shapes;

use drawn::{Drawn, all, program, told};
use serde_json::Value;
use shapes::{Drawing, Own, Shape, random};

const OWN: [Own; 4] = [
    Own { kind: "unorm", bits: 10, fraction: 14, vertex: 4 },
    Own { kind: "signed", bits: 9, fraction: 14, vertex: 2 },
    Own { kind: "floor", bits: 12, fraction: 16, vertex: 6 },
    Own { kind: "signed", bits: 32, fraction: 14, vertex: 0 },
];

/// A triangle from limit to limit, one of negative values, one at both ends.
fn four_channels() -> Drawing {
    let shape =
        |corners: [[f64; 2]; 3], z: f64, values: [[f64; 3]; 4]| Shape { corners, z, values: values.to_vec() };
    let large = OWN[3].limit();
    let triangles = vec![
        shape(
            [[1.0, 1.0], [60.5, 3.0], [7.25, 46.0]],
            0.75,
            [[0.0, 1.0, 0.5], [-255.0, 255.0, -0.25], [-2047.0, 2047.0, -3.5], [-large, large, -7.0]],
        ),
        shape(
            [[40.0, 44.0], [62.0, 20.0], [20.0, 30.0]],
            0.5,
            [
                [0.25, 0.26, 0.27],
                [-3.0, -1.5, -0.5],
                [-4.0, -2.5, -0.125],
                [-100_000.0, -99_990.0, -99_995.0],
            ],
        ),
        shape(
            [[-20.0, 50.0], [30.0, 47.0], [10.0, 30.0]],
            0.25,
            [[1.0; 3], [-255.0, -255.0, -254.0], [2047.0, 2046.0, 2047.0], [large, -large, large]],
        ),
    ];
    Drawing { width: 64, height: 48, mode: "gouraud", own: OWN.to_vec(), triangles }
}

/// Counts of what was compared.
#[derive(Default)]
struct Seen {
    values: u32,
    negative: u32,
    /// Negative floors that rounding to nearest would have put higher.
    floored: u32,
    near_limit: u32,
    empty: u32,
}

/// Golden is the plane; the machine lies within the report's bound of it, and below it where it takes the floor.
fn compare(drawing: &Drawing, [golden, model]: &[Drawn; 2], seen: &mut Seen) {
    assert_eq!(golden.id, model.id);
    for (channel, own) in drawing.own.iter().enumerate() {
        let report = &model.report["channels"][channel];
        let name = format!("e{channel}");
        assert_eq!((&report["name"], &report["kind"]), (&Value::from(name), &own.kind.into()));
        assert_eq!((&report["bits"], &report["unit"]), (&own.bits.into(), &"LSB".into()));
        // An output is rounded by half an LSB, a floor by one, downwards.
        let rounding = if own.kind == "floor" { 1.0 } else { 0.5 };
        let bound = report["bound"].as_f64().unwrap();
        let before = bound - rounding;
        assert!(before > 0.0 && before < 1.0, "{report}");
        for (at, id) in golden.id.iter().enumerate() {
            let (exact, output) = (golden.own[channel][at], model.own[channel][at]);
            let Ok(triangle) = usize::try_from(*id) else {
                assert_eq!((exact, output), (0.0, 0.0));
                seen.empty += 1;
                continue;
            };
            let width = drawing.width as usize;
            let plane = drawing.plane(triangle, channel, (at % width, at / width));
            assert!(
                (exact - plane).abs() <= 1e-9 * own.limit(),
                "golden e{channel} at {at}: {exact}, not {plane}"
            );
            let off = output - exact;
            let slack = 1e-9 * own.limit(); // golden's own rounding
            let (least, most) = if own.kind == "floor" { (-bound, before) } else { (-bound, bound) };
            assert!(off >= least - slack && off <= most + slack, "e{channel} at {at}: {output} for {exact}");
            seen.values += 1;
            seen.negative += u32::from(output < 0.0);
            seen.floored += u32::from(own.kind == "floor" && exact < 0.0 && off < -0.5 - before);
            seen.near_limit += u32::from(own.limit() - output.abs() <= 1.0);
        }
    }
}

#[test]
fn four_channels_of_all_kinds_through_every_engine() {
    let (folder, drawing) = (tempfile::tempdir().unwrap(), four_channels());
    std::fs::write(folder.path().join("in.tri"), drawing.file()).unwrap();
    let drawn = all(folder.path(), &drawing);
    let seen = &mut Seen::default();
    compare(&drawing, &drawn, seen);
    let Seen { values, negative, floored, near_limit, empty } = *seen;
    println!(
        "checked {values} values: {negative} negative, {floored} negative floors, {near_limit} near a limit"
    );
    assert!(values > 6000 && negative > 2000 && floored > 200 && near_limit > 300 && empty > 1000);
    explained(folder.path(), &drawing, &drawn);
}

/// `explain` ends at what the arrays hold.
fn explained(folder: &std::path::Path, drawing: &Drawing, [golden, model]: &[Drawn; 2]) {
    let mut pixels = 0;
    for (x, y) in [(5, 5), (30, 3), (10, 20), (40, 35), (45, 30), (5, 45), (15, 38)] {
        let at = y * drawing.width as usize + x;
        assert!(golden.id[at] >= 0, "({x}, {y}) shows a triangle");
        let place = [x.to_string(), y.to_string()];
        let told = told(folder, &["explain", "in.tri", &place[0], &place[1]], &drawing.settings());
        let numbers = |value: &Value| -> Vec<f64> {
            value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
        };
        let (walk, exact) = (&told["machine"], numbers(&told["extra"]));
        let last = walk["additions"].as_array().unwrap().last().unwrap();
        let (outputs, values, bounds) =
            (numbers(&walk["output"]), numbers(&last["value"]), numbers(&last["bound"]));
        for (i, own) in drawing.own.iter().enumerate() {
            let label = &walk["channels"][4 + i];
            assert_eq!((&label["kind"], &label["unit"]), (&own.kind.into(), &"LSB".into()));
            // Numbers of many digits are read to the last but one.
            assert!((exact[i] - golden.own[i][at]).abs() <= 1e-12 * own.limit(), "e{i} ({x}, {y})");
            assert_eq!(outputs[4 + i], model.own[i][at], "e{i} ({x}, {y})");
            let vertex = 0.5f64.powi(own.vertex as i32 + 1);
            let off = (values[4 + i] - exact[i]).abs();
            assert!(off <= vertex + bounds[4 + i] + 1e-9 * own.limit(), "e{i} ({x}, {y}): {off}");
        }
        for addition in walk["additions"].as_array().unwrap() {
            let [error, bound] = ["error", "bound"].map(|key| numbers(&addition[key]));
            assert_eq!((error.len(), bound.len()), (8, 8));
            assert!(error.iter().zip(&bound).all(|(e, b)| e.abs() <= b + 1e-5), "{addition}");
        }
        pixels += 1;
    }
    println!("checked {pixels} / 7 pixels explained");
    let page = program(folder, &["explain", "in.tri", "40", "35"], &drawing.settings()).output().unwrap();
    let page = String::from_utf8(page.stdout).unwrap();
    for title in ["e0: unorm, LSB of 10 bits; output", "e2: floor, LSB of 12 bits; output -"] {
        assert!(page.contains(title), "{page}");
    }
}

#[test]
fn thirty_random_files_by_seed() {
    let seen = &mut Seen::default();
    let mut files = 0;
    for seed in 0..30 {
        let (folder, drawing) = (tempfile::tempdir().unwrap(), random(seed));
        std::fs::write(folder.path().join("in.tri"), drawing.file()).unwrap();
        compare(&drawing, &all(folder.path(), &drawing), seen);
        files += 1;
    }
    let Seen { values, negative, floored, near_limit, .. } = *seen;
    println!(
        "checked {files} / 30 files, {values} values: {negative} negative, {floored} negative floors, {near_limit} near a limit"
    );
    assert!(values > 20_000 && negative > 5_000 && floored > 1_000 && near_limit > 400);
}

#[test]
fn a_comparison_tells_each_channels_error_beside_its_bound() {
    let (folder, drawing) = (tempfile::tempdir().unwrap(), four_channels());
    std::fs::write(folder.path().join("in.tri"), drawing.file()).unwrap();
    let mut settings = drawing.settings();
    let render = ["render", "in.tri", "--out", "r"];
    let report = told(folder.path(), &render, &settings);
    let channels = report["comparison"]["extra"].as_array().unwrap();
    assert_eq!(channels.len(), 4);
    for (i, of) in channels.iter().enumerate() {
        let [error, bound] = ["error", "bound"].map(|key| of[key].as_f64().unwrap());
        assert!(error > 0.4 && error <= bound, "{of}");
        assert_eq!(of["bound"], report["channels"][i]["bound"]);
    }
    let text =
        String::from_utf8(program(folder.path(), &render, &settings).output().unwrap().stdout).unwrap();
    assert!(text.contains("LSB of 12 bits, floor, proved bound 1.0"), "{text}");
    // So few fraction bits that sums may wrap: an error, but no bound of it.
    settings.extend(["channels.e1_fraction=8".to_owned(), "channels.e1_vertex=8".to_owned()]);
    let report = told(folder.path(), &render, &settings);
    let of = &report["comparison"]["extra"][1];
    assert!(of["bound"].is_null() && of["error"].as_f64().unwrap() > 0.0, "{of}");
    assert!(of["no_bound"].as_str().unwrap().contains("additions may err by"), "{of}");
    assert!(report["channels"][1]["bound"].is_null() && report["channels"][0]["bound"].is_f64());
}

/// `raster` and `config explain` say of each channel what is proved, `raster` of the machine's engines alone.
#[test]
fn what_is_proved_of_each_channel_is_listed() {
    let (folder, drawing) = (tempfile::tempdir().unwrap(), four_channels());
    std::fs::write(folder.path().join("in.tri"), drawing.file()).unwrap();
    let settings = drawing.settings();
    let page = |arguments: &[&str]| {
        let output = program(folder.path(), arguments, &settings).output().unwrap();
        assert!(output.status.success(), "{arguments:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let raster = page(&["raster", "in.tri", "--out", "f"]);
    let explain = page(&["config", "explain"]);
    let golden = page(&["raster", "in.tri", "--engine", "golden", "--out", "g"]);
    let channels = told(folder.path(), &["config", "explain"], &settings)["channels"].clone();
    let report = told(folder.path(), &["raster", "in.tri", "--out", "f"], &settings);
    assert_eq!((channels.as_array().unwrap().len(), &channels), (4, &report["channels"]));
    for (i, own) in OWN.iter().enumerate() {
        let bound = channels[i]["bound"].as_f64().unwrap();
        let line = format!("e{i} error, LSB of {} bits, {}: proved bound {bound:.4}\n", own.bits, own.kind);
        assert!(raster.contains(&line) && explain.contains(&line) && !golden.contains(&line), "{line}");
        let word = format!("Q{}.{}, {} bits, modular\n", own.bits, own.fraction, own.bits + own.fraction);
        let words = explain.lines().find(|line| line.contains(&format!("    e{i}     words ")));
        assert!(words.is_some_and(|words| format!("{words}\n").ends_with(&word)), "{words:?} {word}");
    }
}

#[test]
fn the_example_of_the_format_gives_the_texels_it_says() {
    let page = include_str!("../../../../docs/triangle_file.md");
    let example = page.split("```").find(|part| part.contains("\nextra 2\n")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.tri"), example).unwrap();
    for engine in ["fast", "model", "rtl"] {
        let arguments = ["raster", "in.tri", "--engine", engine, "--out", engine];
        told(folder.path(), &arguments, &["channels.extra=2".to_owned()]);
        let line = |name: &str| -> Vec<i64> {
            let (_, shape, bytes) = crate::support::npy(&folder.path().join(engine).join(name));
            assert_eq!(shape, [32, 32]);
            let line = bytes.chunks_exact(8).skip(32).take(32);
            line.map(|b| i64::from_le_bytes(b.try_into().unwrap())).collect()
        };
        let inside = |x: i64| (1..30).contains(&x);
        assert_eq!(
            line("e0.npy"),
            (0..32).map(|x| if inside(x) { 2 * x - 1 } else { 0 }).collect::<Vec<_>>()
        );
        assert_eq!(line("e1.npy"), (0..32).map(|x| i64::from(inside(x))).collect::<Vec<_>>());
    }
}
