//! The triangle file: defaults, every item, round trip, and what is refused with which words.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use edgewalk_scene::{
    Blending, Change, DepthFunc, Frame, Host, Line, MAX_COORDINATE, MAX_EXTRA, MAX_EXTRA_VALUE, MAX_LIGHTS,
    MAX_SIDE, Pane, Polygon, Primitive, ShadeMode, Shadow, State, Triangle, Vertex, triangle_file,
};
use proptest::prelude::*;

const T: &str = "T 0 0 0 1 1 1 0  9 0 0.5 1 1 1 0  0 9 1 1 1 1 0";

fn parse(text: &str) -> Frame {
    triangle_file::parse("a.tri", text.as_bytes()).unwrap()
}

#[test]
fn defaults_when_only_the_size_is_given() {
    assert_eq!(parse("size 640 480"), Frame::new(640, 480));
}

#[test]
fn every_item_is_taken() {
    let frame = parse(
        "# a comment\r\n\r\n  size 3 4 # trailing\r\nmode flat\ndepth gequal\ndepth_write 0\nblend 1\n\
         clear 0 0.5 1e0\nT 1 2 0.25 .5 0.5 0.5 1\t-1e6 +1 0 0 0 0 0 1 1 1 1 1 1 1#end",
    );
    assert_eq!((frame.width, frame.height, frame.mode), (3, 4, ShadeMode::Flat));
    assert_eq!(
        (frame.depth, frame.depth_write, frame.blend),
        (Some(DepthFunc::Gequal), false, Blending::Mix)
    );
    assert_eq!(frame.clear, [0.0, 0.5, 1.0]);
    let first = Vertex { x: 1.0, y: 2.0, z: 0.25, r: 0.5, g: 0.5, b: 0.5, kt: 1.0, ..Vertex::default() };
    assert_eq!(frame.triangles.len(), 1);
    assert_eq!(frame.triangles[0].0[0], first);
    assert_eq!(frame.triangles[0].0[1].x, -MAX_COORDINATE);
}

#[test]
fn polygons_keep_their_place_among_the_triangles() {
    let frame = parse(&format!(
        "size 9 9\n{}\n\n{} # hole\n{T}\n{T}\n{}",
        T.replace('T', "P 3"),
        T.replace('T', "H 3"),
        T.replace('T', "P 3")
    ));
    let contours: Vec<_> = frame.polygons.iter().map(|p| (p.contours.len(), p.after)).collect();
    assert_eq!(contours, [(2, 0), (1, 2)]);
    let order: Vec<_> = frame.primitives().iter().map(|p| matches!(p, Primitive::Polygon(_))).collect();
    assert_eq!(order, [true, false, false, true]);
    assert_eq!(frame.polygons[0].contours[1], frame.triangles[0].0);
}

#[test]
fn depth_off_never_writes_whatever_the_order() {
    for text in ["size 1 1\ndepth off\ndepth_write 1", "size 1 1\ndepth_write 1\ndepth off"] {
        let frame = parse(text);
        assert_eq!((frame.depth, frame.depth_write), (None, false));
    }
}

const SHADOW: &str = "shadow 8 0.01 0.25  1 2 3 4  5 6 7 8  9 10 11 12  13 14 15 -1e300";

#[test]
fn the_shadow_and_its_triangles_stand_apart_from_the_picture() {
    let frame =
        parse(&format!("size 9 9\n{SHADOW}\nL 1 2 0 -4 5 1 7 8 0.5\nmode flat\n{T}\nL 0 0 0 1 1 1 2 2 1"));
    let shadow = &frame.shadows[0];
    assert_eq!((shadow.size, shadow.bias, shadow.ambient), (8, 0.01, 0.25));
    assert_eq!(shadow.matrix[0], [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(shadow.matrix[3], [13.0, 14.0, 15.0, -1e300]);
    assert_eq!(shadow.triangles.len(), 2);
    assert_eq!(shadow.triangles[0], [[1.0, 2.0, 0.0], [-4.0, 5.0, 1.0], [7.0, 8.0, 0.5]]);
    assert_eq!((frame.mode, frame.triangles.len()), (ShadeMode::Flat, 1));
    assert_eq!(
        parse(&format!("size 9 9\n{T}\n{SHADOW}")).shadows[0].size,
        8,
        "behind the picture's triangles"
    );
}

#[test]
fn malformed_shadows_name_place_and_remedy() {
    let with = |from: &str, to: &str| format!("size 9 9\n{}", SHADOW.replacen(from, to, 1));
    let l = "L 1 2 0 4 5 1 7 8 0.5";
    let sized = with("", "");
    let cases: [(String, &[&str]); 28] = [
        (with("8", "0"), &["a.tri:2: shadow SIZE: `0`", "an integer from 1 to 16384"]),
        (with("8", "16385"), &["shadow SIZE: `16385`"]),
        (with("8", "8.5"), &["shadow SIZE: `8.5`", "an integer"]),
        (with("0.01", "1.01"), &["shadow BIAS: `1.01`", "a number from -1 to 1"]),
        (with("0.01", "nan"), &["shadow BIAS: `nan`"]),
        (with("0.25", "-0.25"), &["shadow AMBIENT: `-0.25`", "a number from 0 to 1"]),
        (with("0.25", "bright"), &["shadow AMBIENT: `bright`"]),
        (with("  1 ", "  inf "), &["shadow m00: `inf`", "a finite number"]),
        (with("-1e300", "-1e309"), &["shadow m33: `-1e309`", "a finite number"]),
        (with(" 7 ", " seven "), &["shadow m12: `seven`", "a finite number"]),
        (with("-1e300", ""), &["a.tri:2: shadow: `18 given`", "19 values"]),
        (format!("{sized}{}", format!("\n{SHADOW}").repeat(16)), &["a.tri:18: shadow", "at most 16 times"]),
        (format!("{sized}\n{l} 1.5"), &["a.tri:3: L kt: `1.5`", "a number from 0 to 1"]),
        (format!("{sized}\n{l} -0.5"), &["a.tri:3: L kt: `-0.5`", "a number from 0 to 1"]),
        (format!("{sized}\n{l} nan"), &["a.tri:3: L kt: `nan`"]),
        (format!("{sized}\n{l} glass"), &["a.tri:3: L kt: `glass`"]),
        (format!("{sized}\nlight 2\n{T}"), &["a.tri:3: light: `2`", "0 to 1, as many lights"]),
        (format!("{sized}\nlight 1\n{T}\nlight 3\n{T}"), &["a.tri:5: light: `3`", "0 to 1"]),
        (format!("{sized}\nlight 2\n{T}\nlight 2\n{T}"), &["a.tri:3: light: `2`", "0 to 1"]),
        (
            format!("size 9 9\nlight 1\n{T}"),
            &["a.tri:2: light: `1`", "permitted: 0, as the file has no line `shadow`"],
        ),
        (format!("{sized}\nlight 17"), &["a.tri:3: light: `17`", "an integer from 0 to 16"]),
        (format!("{sized}\nlight on"), &["a.tri:3: light: `on`", "an integer"]),
        (with("shadow", "shadwo"), &["did you mean `shadow`"]),
        (format!("size 9 9\n{l}"), &["a.tri:2: L", "only after a line `shadow"]),
        (format!("size 9 9\n{T}\n{l}\n{SHADOW}"), &["a.tri:3: L", "only after a line `shadow"]),
        (format!("{sized}\n{l} 1 1"), &["a.tri:3: L: `11 given`", "9 values"]),
        (format!("{}\n{}", with("", ""), l.replace("0.5", "1.5")), &["L vertex 3 z: `1.5`", "0 to 1"]),
        (format!("{}\n{}", with("", ""), l.replace("L 1", "L -1e7")), &["L vertex 1 x: `-1e7`", "1000000"]),
    ];
    for (text, words) in &cases {
        let error = triangle_file::parse("a.tri", text.as_bytes()).unwrap_err().to_string();
        for word in *words {
            assert!(error.contains(word), "{text:?}: {word:?} is not in {error:?}");
        }
    }
}

#[test]
fn each_triangle_has_its_own_values_behind_it() {
    let text = format!(
        "extra 2\nsize 9 9\n{T}\n# between\n\nX 1 -2  3.5 4  -2147483647 6\n{T}\nX 7 8 9 10 11 12 # end"
    );
    let frame = parse(&text);
    assert_eq!(frame.extra, 2);
    let values: Vec<_> = frame.triangles.iter().flat_map(|t| t.0).map(|v| [v.extra[0], v.extra[1]]).collect();
    assert_eq!(
        values,
        [[1.0, -2.0], [3.5, 4.0], [-MAX_EXTRA_VALUE, 6.0], [7.0, 8.0], [9.0, 10.0], [11.0, 12.0]]
    );
    assert!(frame.triangles.iter().flat_map(|t| t.0).all(|v| v.extra[2..] == [0.0; 2]));
    let streamed: Vec<Triangle> =
        triangle_file::Reader::new("a.tri", text.as_bytes()).unwrap().map(Result::unwrap).collect();
    assert_eq!(streamed, frame.triangles);
}

#[test]
fn malformed_values_name_place_and_remedy() {
    let with = |n: usize, x: &str| format!("size 9 9\nextra {n}\n{T}\n{x}\n");
    let cases: [(String, &[&str]); 20] = [
        ("extra 5".into(), &["a.tri:1: extra N: `5`", "an integer from 0 to 4"]),
        ("extra two".into(), &["extra N: `two`", "0 to 4"]),
        ("extra".into(), &["extra: `0 given`", "1 value"]),
        ("extra 1\nextra 1".into(), &["a.tri:2: extra", "once"]),
        ("extar 1".into(), &["`extar`", "did you mean `extra`?"]),
        (format!("size 9 9\n{T}\nextra 1"), &["a.tri:3: extra", "only before the first triangle"]),
        (format!("size 9 9\n{T}\nX 1 2 3 4 5 6"), &["a.tri:3: X: `6 given`", "here `extra 2`"]),
        (format!("size 9 9\n{T}\nX 1 2 3 4"), &["X: `4 given`", "here `extra 2`"]),
        (format!("size 9 9\n{T}\nX"), &["X: `0 given`", "here `extra 1`"]),
        ("size 9 9\nextra 1\nX 1 2 3".into(), &["a.tri:3:", "`X`", "once, behind a triangle `T`"]),
        (with(1, "X 1 2 3\nX 1 2 3"), &["a.tri:5:", "`X`", "once, behind a triangle `T`"]),
        (
            with(2, "X 1 2 3 4 5"),
            &["a.tri:4: X: `5 given`", "6 values, e0 e1 of vertex 1, then of 2, then of 3"],
        ),
        (with(2, "X 1 2 3 4 5 6 7"), &["a.tri:4: X: `7 given`", "6 values"]),
        (with(2, "X 1 2 3 nan 5 6"), &["a.tri:4: X vertex 2 e1: `nan`", "-2147483647 to 2147483647"]),
        (with(1, "X 1 2 -inf"), &["X vertex 3 e0: `-inf`"]),
        (with(1, "X 1 2147483648 2"), &["X vertex 2 e0: `2147483648`", "to 2147483647"]),
        (with(2, T), &["a.tri:4: X: `T`", "of the triangle in line 3 is missing", "6 values, e0 e1"]),
        (with(1, ""), &["a.tri:5: X: `end of file`", "line 3 is missing"]),
        (with(1, &T.replace('T', "L")), &["a.tri:4: X: `L`", "missing"]),
        (
            format!("size 9 9\nextra 2\n{}", T.replace('T', "P 3")),
            &["a.tri:3:", "`P`", "no `X`", "with `extra 2`: only triangles"],
        ),
    ];
    for (text, words) in &cases {
        let whole = triangle_file::parse("a.tri", text.as_bytes()).unwrap_err().to_string();
        let streamed = match triangle_file::Reader::new("a.tri", text.as_bytes()) {
            Ok(mut reader) => reader.find_map(Result::err).unwrap(),
            Err(error) => error,
        };
        assert_eq!(streamed.to_string(), whole);
        for word in *words {
            assert!(whole.contains(word), "{text:?}: {word:?} is not in {whole:?}");
        }
    }
}

#[test]
fn malformed_files_name_place_and_remedy() {
    let t = |bad: &str| format!("size 9 9\n{}", T.replacen("0.5", bad, 1));
    let p = |n: &str, z: &str| t(z).replacen("T ", &format!("P {n} "), 1);
    let cases: [(String, &[&str]); 42] = [
        ("".into(), &["a.tri:1: size", "`size W H` is missing", "16384"]),
        (T.into(), &["a.tri:1: size", "missing"]),
        ("size 0 9".into(), &["a.tri:1: size W: `0`", "an integer from 1 to 16384"]),
        ("size 9 16385".into(), &["size H: `16385`", "16384"]),
        ("size 9.5 9".into(), &["size W: `9.5`", "an integer"]),
        ("size -1 9".into(), &["size W: `-1`"]),
        ("size 9".into(), &["a.tri:1: size: `1 given`", "2 values"]),
        ("size 9 9 9".into(), &["size: `3 given`", "2 values"]),
        ("size 9 9\nsize 9 9".into(), &["a.tri:2: size", "once"]),
        ("\nsiez 9 9".into(), &["a.tri:2: line starts with: `siez`", "did you mean `size`"]),
        ("size 9 9\nt 0 0".into(), &["a.tri:2:", "did you mean `T`"]),
        ("size 9 9\nSIZE 9 9".into(), &["did you mean `size`"]),
        ("size 9 9\nmode phong".into(), &["a.tri:3: view: `end of file`", "missing"]),
        ("size 9 9\nmode gourad".into(), &["did you mean `gouraud`"]),
        ("size 9 9\ndepth lesss".into(), &["depth: `lesss`", "did you mean `less`"]),
        ("size 9 9\ndepth of".into(), &["depth: `of`", "did you mean `off`"]),
        ("size 9 9\ndepth_write yes".into(), &["depth_write: `yes`", "0 1"]),
        ("size 9 9\nblend 2".into(), &["blend: `2`", "0 1 add"]),
        (format!("size 9 9\n{T}\nblend ad"), &["a.tri:3: blend: `ad`", "did you mean `add`"]),
        ("size 9 9\ncolour_write 2".into(), &["colour_write: `2`", "0 1"]),
        (format!("size 9 9\n{T}\ncolor_write 0"), &["a.tri:3:", "did you mean `colour_write`"]),
        (format!("size 9 9\n{T}\nclear_depth 1"), &["a.tri:3: clear_depth: `1 given`", "no value"]),
        (format!("size 9 9\n{T}\nclear 0 0 0"), &["a.tri:3: clear", "before the first triangle"]),
        (p("3", "0.5") + "\ndepth off\nH 3", &["a.tri:4:", "`H`", "only on the lines after a polygon"]),
        ("size 9 9\nclear 0 0 1.5".into(), &["a.tri:2: clear b: `1.5`", "a number from 0 to 1"]),
        ("size 9 9\nclear 0 0".into(), &["clear: `2 given`", "3 values"]),
        (format!("size 9 9\n{T}\nmode flat"), &["a.tri:3: mode", "before the first triangle"]),
        (p("3", "0.5") + "\nmode flat", &["a.tri:3: mode", "before the first triangle or polygon"]),
        (p("3", "0.5").replace("size 9 9", ""), &["a.tri:2: size: `P`", "missing"]),
        (p("2", "0.5"), &["a.tri:2: P n: `2`", "an integer from 3 to 65536"]),
        ("size 9 9\nP".into(), &["a.tri:2: P n: ``", "an integer"]),
        (p("4", "0.5"), &["a.tri:2: P: `21 given`", "28 values after n", "4 vertices"]),
        (p("3", "1.5"), &["a.tri:2: P vertex 2 z: `1.5`", "from -0.00001 to 1.00001"]),
        (p("3", "0.5").replace('P', "H"), &["a.tri:2:", "`H`", "only on the lines after a polygon"]),
        (format!("{}\n{T}\nH 3", p("3", "0.5")), &["a.tri:4:", "`H`", "only on the lines after a polygon"]),
        (t("nan"), &["a.tri:2: T vertex 2 z: `nan`", "from -0.00001 to 1.00001"]),
        (t("inf"), &["T vertex 2 z: `inf`"]),
        (t("-0.001"), &["T vertex 2 z: `-0.001`"]),
        (t("0,5"), &["T vertex 2 z: `0,5`"]),
        (format!("size 9 9\n{T} 1"), &["a.tri:2: T: `22 given`", "21 values"]),
        (
            format!("size 9 9\n{}", T.replacen("9 0", "1e7 0", 1)),
            &["T vertex 2 x: `1e7`", "-1000000 to 1000000"],
        ),
        (format!("size 9 9\n# ok\n{}", "x".repeat(500)), &["a.tri:3:", "xxx...`", "size mode view"]),
    ];
    for (text, fragments) in cases {
        let message = match triangle_file::parse("a.tri", text.as_bytes()) {
            Ok(_) => panic!("accepted: {text:?}"),
            Err(error) => error.to_string(),
        };
        for fragment in fragments {
            assert!(message.contains(fragment), "{text:?}: {message:?} lacks {fragment:?}");
        }
    }
}

/// Rules that change before the first triangle are those of the header.
#[test]
fn rules_before_all_triangles_are_written_once() {
    let mut frame = parse(&format!("size 9 9\n{T}\n{T}"));
    let add = State { blend: Blending::Add, depth: Some(DepthFunc::Equal), ..frame.state() };
    let off = State { depth: None, depth_write: false, ..add };
    frame.changes = vec![
        Change { after: 0, state: add, clear_depth: true },
        Change { after: 1, state: off, clear_depth: false },
    ];
    let mut text = Vec::new();
    triangle_file::write(&frame, &mut text).unwrap();
    let read = triangle_file::parse("a.tri", &text[..]).unwrap();
    assert_eq!((read.state(), read.passes()[0].state), (add, add));
    assert_eq!((read.passes()[1].state, read.passes()[1].primitives.clone()), (off, 1..2));
}

#[test]
fn a_reader_gives_the_header_first_and_then_triangles_down_to_a_fault() {
    let text = format!("size 9 7\nmode flat\n{T}\n# two\n{}\nT 0\n", T.replacen("0.5", "0.25", 1));
    let mut reader = triangle_file::Reader::new("a.tri", text.as_bytes()).unwrap();
    assert_eq!((reader.header().width, reader.header().mode), (9, ShadeMode::Flat));
    let depths: Vec<f64> = reader.by_ref().map_while(Result::ok).map(|triangle| triangle.0[1].z).collect();
    assert_eq!(depths, [0.5, 0.25]);
    let Err(error) = triangle_file::parse("a.tri", text.as_bytes()) else { panic!("accepted") };
    assert!(error.to_string().starts_with("a.tri:6: T: `1 given`"), "{error}");
}

#[test]
fn triangle_by_triangle_a_late_shadow_is_refused() {
    let text = format!("size 9 9\n{T}\n{SHADOW}");
    let mut reader = triangle_file::Reader::new("a.tri", text.as_bytes()).unwrap();
    assert!(reader.next().is_some_and(|triangle| triangle.is_ok()));
    let error = reader.next().unwrap().unwrap_err().to_string();
    assert!(
        error.contains("a.tri:3: line starts with: `shadow`")
            && error.contains("only triangles from here on"),
        "{error}"
    );
}

#[test]
fn rules_change_between_triangles() {
    let text = format!(
        "size 9 9\nblend 1\n{SHADOW}\n{T}\ndepth equal\ndepth_write 0\nlight 2\n{T}\n{T}\nclear_depth\nblend add\ncolour_write 0\nlight 0\ndepth off\n{T}\n{SHADOW}"
    );
    let frame = triangle_file::parse("a.tri", text.as_bytes()).unwrap();
    let passes: Vec<_> = frame
        .passes()
        .into_iter()
        .map(|pass| {
            let State { depth, depth_write, blend, color_write, light } = pass.state;
            (pass.primitives, depth, depth_write, blend, (color_write, light), pass.clear_depth)
        })
        .collect();
    let wanted = [
        (0..1, Some(DepthFunc::Less), true, Blending::Mix, (true, 1), false),
        (1..3, Some(DepthFunc::Equal), false, Blending::Mix, (true, 2), false),
        (3..4, None, false, Blending::Add, (false, 0), true),
    ];
    assert_eq!(passes, wanted);
    // What is drawn while it is read has one list of rules.
    let mut reader = triangle_file::Reader::new("a.tri", text.as_bytes()).unwrap();
    assert!(reader.next().is_some_and(|triangle| triangle.is_ok()));
    let error = reader.next().unwrap().unwrap_err().to_string();
    assert!(error.contains("a.tri:5:") && error.contains("only triangles from here on"), "{error}");
}

#[test]
fn a_reader_refuses_polygons() {
    for before in ["".to_owned(), format!("{T}\n")] {
        let text = format!("size 9 9\n{before}P 3 {}\n{T}", &T[1..]);
        let mut reader = triangle_file::Reader::new("a.tri", text.as_bytes()).unwrap();
        let error = reader.find_map(Result::err).unwrap().to_string();
        let line = text.lines().count() - 1;
        assert!(error.starts_with(&format!("a.tri:{line}: line starts with: `P`")), "{error}");
    }
}

#[test]
fn bytes_that_are_no_text_are_refused() {
    let message = triangle_file::parse("a.tri", &b"size 9 9\nmode \xff\xfe\0"[..]).unwrap_err().to_string();
    assert!(message.contains("a.tri:2: mode"), "{message}");
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let message = triangle_file::read("no/such.tri".as_ref()).unwrap_err().to_string();
    assert!(message.starts_with("no/such.tri: cannot be read"), "{message}");
}

fn vertex() -> impl Strategy<Value = Vertex> {
    let place = || prop_oneof![-MAX_COORDINATE..=MAX_COORDINATE, -4.0..700.0f64];
    let unit = || prop_oneof![0.0..=1.0f64, Just(0.0), Just(1.0), Just(f64::MIN_POSITIVE)];
    (place(), place(), unit(), unit(), unit(), unit(), unit()).prop_map(|(x, y, z, r, g, b, kt)| Vertex {
        x,
        y,
        z,
        r,
        g,
        b,
        kt,
        ..Vertex::default()
    })
}

fn own_value() -> impl Strategy<Value = f64> {
    prop_oneof![-MAX_EXTRA_VALUE..=MAX_EXTRA_VALUE, -1.0..=1.0f64, Just(-MAX_EXTRA_VALUE), Just(-0.5)]
}

fn contours() -> impl Strategy<Value = Vec<Vec<Vertex>>> {
    prop::collection::vec(prop::collection::vec(vertex(), 3..8), 1..4)
}

prop_compose! {
    fn shadow()(
        size in 1..=MAX_SIDE,
        bias in -1.0..=1.0f64,
        ambient in 0.0..=1.0f64,
        matrix in prop::array::uniform4(prop::array::uniform4(-1e9..=1e9f64)),
        triangles in prop::collection::vec(
            prop::array::uniform3([-MAX_COORDINATE..=MAX_COORDINATE, -9.0..=9.0, 0.0..=1.0]), 0..9),
        kts in prop::collection::vec(prop_oneof![1e-300..=1.0f64, Just(1.0)], 0..9),
    ) -> Shadow {
        let panes = kts.into_iter().zip(triangles.iter().rev()).map(|(kt, corners)| Pane { corners: *corners, kt });
        let panes = panes.collect();
        Shadow { size, bias, slopes: Vec::new(), ambient, matrix, triangles, panes }
    }
}

prop_compose! {
    fn state()(
        depth in prop::option::of(prop::sample::select(DepthFunc::ALL.to_vec())),
        write in any::<bool>(),
        blend in prop::sample::select(Blending::ALL.to_vec()),
        color_write in any::<bool>(),
        light in 0..=MAX_LIGHTS,
    ) -> State {
        State { depth, depth_write: write && depth.is_some(), blend, color_write, light }
    }
}

/// A light that the frame has, or none; the usual one where it has none.
fn light_of(frame: &Frame, light: usize) -> usize {
    if frame.shadows.is_empty() { 1 } else { light % (frame.shadows.len() + 1) }
}

/// Those between primitives that change something, one at a place.
fn changes_of(frame: &Frame, rules: Vec<(prop::sample::Index, State, bool)>) -> Vec<Change> {
    let count = frame.drawn();
    let mut rules: Vec<_> =
        rules.into_iter().map(|(at, state, clear)| (at.index(count + 1), state, clear)).collect();
    rules.sort_by_key(|(after, ..)| *after);
    let mut changes: Vec<Change> = Vec::new();
    for (after, state, clear_depth) in rules {
        let state = State { light: light_of(frame, state.light), ..state };
        let last = changes.last().map_or((0, frame.state()), |change| (change.after, change.state));
        if after > last.0 && after < count && (state != last.1 || clear_depth) {
            changes.push(Change { after, state, clear_depth });
        }
    }
    changes
}

prop_compose! {
    fn frame()(
        width in 1..=MAX_SIDE,
        height in 1..=MAX_SIDE,
        mode in prop::sample::select(ShadeMode::ALL.to_vec()),
        depth in prop::option::of(prop::sample::select(DepthFunc::ALL.to_vec())),
        write in any::<bool>(),
        blend in prop::sample::select(Blending::ALL.to_vec()),
        color_write in any::<bool>(),
        rules in prop::collection::vec((any::<prop::sample::Index>(), state(), any::<bool>()), 0..6),
        clear in prop::array::uniform3(0.0..=1.0f64),
        shadows in prop::collection::vec(shadow(), 0..4),
        light in 0..=MAX_LIGHTS,
        extra in 0..=MAX_EXTRA,
        mut triangles in prop::collection::vec(prop::array::uniform3(vertex()).prop_map(Triangle), 0..20),
        values in prop::collection::vec(own_value(), 20 * 3 * MAX_EXTRA),
        shapes in prop::collection::vec((contours(), any::<prop::sample::Index>()), 0..4),
        segments in prop::collection::vec((prop::array::uniform2(vertex()), any::<prop::sample::Index>()), 0..4),
    ) -> Frame {
        let mut polygons: Vec<_> = shapes
            .into_iter()
            .map(|(contours, after)| Polygon { contours, after: after.index(triangles.len() + 1) })
            .collect();
        polygons.sort_by_key(|polygon| polygon.after);
        if extra > 0 {
            polygons.clear();
        }
        let surfaces = triangles.len() + polygons.len();
        let line = |(ends, after): ([Vertex; 2], prop::sample::Index)| Line { ends, after: after.index(surfaces + 1) };
        let mut lines: Vec<Line> = segments.into_iter().filter(|_| extra == 0).map(line).collect();
        lines.sort_by_key(|line| line.after);
        let vertices = triangles.iter_mut().flat_map(|triangle| &mut triangle.0);
        for (vertex, values) in vertices.zip(values.chunks(MAX_EXTRA)) {
            vertex.extra[..extra].copy_from_slice(&values[..extra]);
        }
        let depth_write = write && depth.is_some();
        let changes = Vec::new();
        let mut frame = Frame {
            width, height, mode, depth, depth_write, blend, color_write, clear, extra, shadows, light, triangles, changes, polygons, lines,
            shading: None,
            host: Host::default(),
        };
        frame.light = light_of(&frame, light);
        frame.changes = changes_of(&frame, rules);
        frame
    }
}

proptest! {
    #[test]
    fn what_is_written_is_read_back(frame in frame()) {
        let mut text = Vec::new();
        triangle_file::write(&frame, &mut text).unwrap();
        let streamed: Result<Vec<Triangle>, _> =
            triangle_file::Reader::new("a.tri", &text[..]).unwrap().collect();
        prop_assert_eq!(streamed.is_ok(), frame.drawn() == frame.triangles.len() && frame.changes.is_empty());
        prop_assert!(streamed.map_or(true, |triangles| triangles == frame.triangles));
        prop_assert_eq!(triangle_file::parse("a.tri", &text[..]).unwrap(), frame);
    }

    #[test]
    fn no_text_panics(text in "(size|mode|depth|extra|shadow|L|T|X|P 3|H|#|[0-9 .e-]|\\PC|\n){0,80}") {
        let _ = triangle_file::parse("a.tri", text.as_bytes());
    }
}
