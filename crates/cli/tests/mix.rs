//! Triangles of the sizes that programs send: what the program says of their sizes is what they were made to be.
#![allow(clippy::unwrap_used)] // a test that unwraps nothing reports it

#[path = "../../model/examples/common/mix.rs"]
mod mix;

use crate::support::run;
use serde_json::Value;

#[test]
fn sizes_and_fates_are_those_it_was_made_of() {
    let (hundreds, seed) = (20, 1);
    let triangles = mix::triangles(hundreds, seed);
    assert_eq!(triangles.len(), 100 * hundreds);
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mix.tri"), mix::file(&triangles)).unwrap();
    let (status, said) = run(folder.path(), &["render", "mix.tri", "--out", "out"]);
    assert_eq!(status, Some(0), "{said}");
    let report = std::fs::read(folder.path().join("out/report.json")).unwrap();
    let report: Value = serde_json::from_slice(&report).unwrap();
    let (sizes, fates) = (&report["setup"]["by_pixels"], &report["setup"]["triangles"]);
    println!("triangles by pixels: {sizes}; by fate: {fates}");
    let shares = [("0", 39), ("1-3", 22), ("4-15", 19), ("16-63", 13), ("64+", 7)];
    for (size, share) in shares {
        assert_eq!(sizes[size], share * hundreds, "{size} pixels");
    }
    let count = |fate: &str| fates[fate].as_u64().unwrap() as usize;
    // Those between the centres may be culled by lines, by columns or not at all.
    let [lines, columns, area, without] =
        ["culled_lines", "culled_columns", "culled_area", "without_pixel"].map(count);
    assert_eq!(lines + columns + area + without, 39 * hundreds);
    assert_eq!(count("drawn"), 61 * hundreds);
    assert!(lines + columns >= 6 * hundreds && area <= 3 * hundreds && without > 0, "{fates}");
}

#[test]
fn a_seed_is_a_frame() {
    let [one, again, other] = [1, 1, 2].map(|seed| mix::file(&mix::triangles(2, seed)));
    assert!(one == again && one != other);
}
