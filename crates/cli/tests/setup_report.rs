//! What `render` says of SETUP: clocks, and what became of the triangles; eight of them, worked by hand.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

use serde_json::{Value, json};
use std::process::Command;

/// Above the screen; left of it; without area; between the centres; of 3, 6, 45 and 780 pixels.
const CORNERS: [[[f64; 2]; 3]; 8] = [
    [[2.0, -9.0], [4.0, -9.0], [2.0, -2.0]],
    [[-9.0, 2.0], [-2.0, 2.0], [-9.0, 4.0]],
    [[2.0, 2.0], [4.0, 4.0], [6.0, 6.0]],
    [[2.1, 2.0], [2.3, 2.0], [4.1, 4.0]],
    [[2.0, 2.0], [5.0, 2.0], [2.0, 5.0]],
    [[10.0, 10.0], [14.0, 10.0], [10.0, 14.0]],
    [[20.0, 10.0], [30.0, 10.0], [20.0, 20.0]],
    [[0.0, 0.0], [40.0, 0.0], [0.0, 40.0]],
];

/// Renders such triangles; the report as JSON, and as text.
fn render(triangles: &[[[f64; 2]; 3]], settings: &[&str]) -> (Value, String) {
    let folder = tempfile::tempdir().unwrap();
    let mut text = "size 64 48\n".to_owned();
    for corners in triangles {
        text += "T";
        for [x, y] in corners {
            text += &format!(" {x} {y} .5 .5 .5 .5 0");
        }
        text += "\n";
    }
    std::fs::write(folder.path().join("a.tri"), text).unwrap();
    let mut arguments = vec!["render", "a.tri", "--json", "--out", "out"];
    for setting in ["screen.width=64", "screen.height=48"].iter().chain(settings) {
        arguments.extend(["--set", setting]);
    }
    let program = env!("CARGO_BIN_EXE_edgewalk");
    let output = Command::new(program).current_dir(folder.path()).args(arguments).output().unwrap();
    let report = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&output.stderr)));
    (report, std::fs::read_to_string(folder.path().join("out/report.txt")).unwrap())
}

#[test]
fn clocks_fates_and_sizes_by_hand() {
    let (report, text) = render(&CORNERS, &[]);
    let expected = json!({
        // S1 is 18; 2 + 2 + 18 for those that are culled. S2 is 28 and the bits of gx, d0 and start; the first goes a column a
        // line, q = 1: of 0.2 px the edges stand apart, s(0, -51) = 7.
        "clocks": {
            "mean": f64::from(72 + 76 + 77 + 80 + 84) / 5.0,
            "p95": 84,
            "most": 84,
            "bound": 45 + 127,
            "mean_with_culled": f64::from(72 + 76 + 77 + 80 + 84 + 2 + 2 + 18) / 8.0,
        },
        "triangles": { "culled_lines": 1, "culled_columns": 1, "culled_area": 1, "without_pixel": 1, "drawn": 4 },
        "by_pixels": { "0": 4, "1-3": 1, "4-15": 1, "16-63": 1, "64+": 1 },
    });
    assert_eq!(report["setup"], expected);
    assert_eq!(report["fragments"], 3 + 6 + 45 + 780);
    for line in [
        "setup clocks of a triangle that is not culled: mean 77.8, 95 % at most 84, most 84, bound 172\n",
        "triangles: culled by lines 1, culled by columns 1, culled by area 1, without a pixel 1, drawn 4\n",
        "triangles by pixels: 0 4, 1-3 1, 4-15 1, 16-63 1, 64+ 1\n",
    ] {
        assert!(text.contains(line), "{line}{text}");
    }
}

#[test]
fn the_machine_makes_the_clocks_and_nothing_drawn_has_none() {
    let (report, _) = render(&CORNERS, &["setup.lanes=1"]);
    assert!(report["setup"]["clocks"]["mean"].as_f64().unwrap() > 250.0, "{report}");
    let (report, _) = render(&CORNERS[..3], &[]);
    let clocks = json!({ "mean": 0.0, "p95": 0, "most": 0, "bound": 172, "mean_with_culled": 22.0 / 3.0 });
    assert_eq!(report["setup"]["clocks"], clocks);
}

/// From 20 px left of the screen, in both directions: only what is on the screen counts.
#[test]
fn pixels_off_the_screen_do_not_count() {
    // The left one ends before the centres on its slope, the right one begins with them: 2 + 1 and 3 + 2 + 1 pixels.
    let left = ([[-20.0, 2.0], [3.0, 2.0], [-20.0, 25.0]], 3, "1-3");
    let right = ([[61.0, 25.0], [84.0, 2.0], [84.0, 25.0]], 6, "4-15");
    for (corners, pixels, class) in [left, right] {
        let (report, _) = render(&[corners], &[]);
        assert_eq!(report["fragments"], pixels);
        assert_eq!(report["setup"]["by_pixels"][class], 1, "{report}");
    }
}
