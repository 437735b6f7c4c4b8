//! `edgewalk judge`: pixels with several layers, their shadows and their open depth tests.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use crate::support::judging::{SHADE, folder, judged, raster};
use crate::support::{edgewalk, ended};
use serde_json::Value;

/// A picture without its shadows is wrong, where layers lie over one another too.
#[test]
fn blended_pixels_must_be_in_shadow() {
    let glass = SHADE.replace("0.1 0  64", "0.1 .25  64").replace("0.6 0  64", "0.6 .25  64");
    let glass = glass.replace("1 0  0 64", "1 .25  0 64").replace("0.7 0\n", "0.7 .25\n");
    for text in [SHADE.to_owned(), glass.replacen('\n', "\nblend 1\n", 1)] {
        let folder = folder(&text);
        let lit: Vec<&str> =
            text.lines().filter(|line| !line.starts_with(['s', 'L']) || line.starts_with("size")).collect();
        std::fs::write(folder.path().join("lit.tri"), lit.join("\n")).unwrap();
        raster(folder.path(), &["--adapt"], "m");
        assert_eq!(judged(folder.path(), &["m", "--adapt"]).0, Some(0), "{text}");
        let words = ["raster", "lit.tri", "--adapt", "--out", "lit"];
        assert_eq!(ended(&edgewalk(folder.path(), &words).output().unwrap()).0, Some(0));
        let (code, report, error) = judged(folder.path(), &["lit/rgb.npy", "--adapt"]);
        assert_eq!(code, Some(1), "{text}{error}");
        assert!(report["wrong"].as_u64().unwrap() > 1000, "{report}");
    }
}

/// Two panes whose depths are nearer than the bound, and a third one apart from them.
fn panes(order: [usize; 3]) -> String {
    let pane =
        |z: &str, [a, b, c]: [&str; 3]| format!("T 5 5 {z} {a} .5  50 8 {z} {b} .5  20 40 {z} {c} .5\n");
    let near = [
        pane("0.5", ["1 0 0", "0 1 0", "0 0 1"]),
        pane("0.50000003", ["0 0 1", "1 0 0", "0 1 0"]),
        "T 40 40 .3 1 0 0 .5  60 40 .3 0 1 0 .5  60 45 .3 0 0 1 .5\n".to_owned(),
    ];
    "size 64 48\nblend 1\n".to_owned() + &order.map(|place| near[place].clone()).concat()
}

/// Where depths are nearer than the tolerance, any pane may be in front; elsewhere a wrong colour is wrong.
#[test]
fn open_depth_tests_among_layers_are_counted() {
    let glass = ["--set", "blend.kind=constant"];
    for (order, places) in [([0, 1, 2], 0), ([1, 0, 2], 1)] {
        let folder = folder(&panes(order));
        raster(folder.path(), &glass, "m");
        let (code, report, error) = judged(folder.path(), &[&["m"], &glass[..]].concat());
        assert_eq!((code, &report["wrong"]), (Some(0), &0.into()), "{error}");
        let open = |report: &Value| {
            let causes = report["causes"].as_array().unwrap();
            causes.iter().find(|count| count["cause"] == "open").unwrap()["pixels"].as_u64().unwrap()
        };
        assert_eq!(open(&report) > 500, places == 1, "{report}");
        // The machine's picture has one way alone.
        let against = [&["m", "--against", "machine"], &glass[..]].concat();
        let (code, report, error) = judged(folder.path(), &against);
        assert_eq!((code, open(&report)), (Some(0), 0), "{error}");
        // The panes in the other order are allowed in the first two's pixels, not when the third is dark.
        std::fs::write(
            folder.path().join("in.tri"),
            panes(order).replace("0 1 0 .5  60 45", "0 0 0 .5  60 45"),
        )
        .unwrap();
        let (code, report, error) = judged(folder.path(), &[&["m"], &glass[..]].concat());
        assert_eq!(code, Some(1), "{error}");
        assert!((1..60).contains(&report["wrong"].as_u64().unwrap()), "{report}");
    }
    // Nothing but open pixels, none of which agrees: nothing was compared.
    let folder =
        folder(&panes([0, 1, 2]).lines().take(4).map(|line| line.to_owned() + "\n").collect::<String>());
    raster(folder.path(), &glass, "m");
    let dark = |text: String| {
        text.replace("1 0 0 .5", "0 0 0 .5").replace("0 1 0 .5", "0 0 0 .5").replace("0 0 1 .5", "0 0 0 .5")
    };
    let text = std::fs::read_to_string(folder.path().join("in.tri")).unwrap();
    std::fs::write(folder.path().join("in.tri"), dark(text)).unwrap();
    let (code, _, error) = judged(folder.path(), &[&["m/rgb.npy"], &glass[..]].concat());
    assert_eq!(code, Some(2), "{error}");
    assert!(error.contains("two depths are nearer than their bound"), "{error}");
}

/// A machine with a screen door drops fragments of glass by its pattern, and golden too.
#[test]
fn screen_doors_are_judged() {
    let folder = folder(&panes([0, 2, 1]).replace("0.50000003", "0.7"));
    let door = ["--set", "dither.screen_door=yes"];
    for engine in [&[][..], &["--engine", "golden"]] {
        raster(folder.path(), &[engine, &door[..]].concat(), "m");
        let (code, report, error) = judged(folder.path(), &[&["m"], &door[..]].concat());
        assert_eq!((code, &report["wrong"]), (Some(0), &0.into()), "{error}{report}");
    }
    let (code, _, error) = judged(folder.path(), &[&["m", "--rule", "bottom-left"], &door[..]].concat());
    assert!(code == Some(2) && error.contains("the frame has glass of a screen door"), "{error}");
    // A fragment where the pattern has a hole is wrong.
    raster(folder.path(), &["--set", "blend.kind=constant"], "full");
    let (code, report, error) = judged(folder.path(), &[&["full"], &door[..]].concat());
    assert_eq!(code, Some(1), "{error}");
    assert!(report["wrong"].as_u64().unwrap() > 300, "{report}");
}
