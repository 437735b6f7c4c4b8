//! A picture drawn some lines at a time is the picture drawn at once.

use edgewalk_golden::{Drawing, Fill, Picture, draw};
use edgewalk_scene::{Frame, triangle_file};

/// Triangles and polygons that cross every line of 40 x 30 pixels, with ties, a map of shadows and depth without writes.
fn frame(header: &str) -> Frame {
    let mut text = format!(
        "size 40 30\n{header}\nshadow 16 0 0.5  .4 0 0 0  0 .4 0 0  0 0 1 0  0 0 0 1\nL 0 0 0  16 0 0  0 16 0\n"
    );
    for i in 0..25 {
        let (x, z) = (i * 7 % 40, f64::from(i % 4) / 4.0);
        text += &format!(
            "T {x} -3 {z} 1 0 0 0.5  {} 31 {z} 0 1 0 0.5  {}.5 {} 0.5 0 0 1 0\n",
            i * 11 % 40,
            i * 5 % 40,
            i % 30
        );
    }
    text += "P 4  3 1 .2 1 1 1 0  38 9 .2 1 1 1 0  30 29 .7 1 0 1 0  5 25 .7 0 1 1 0\n\
             H 3  10 8 .5 1 0 0 0  25 12 .5 1 0 0 0  15 20 .5 1 0 0 0\n";
    triangle_file::parse("lines.tri", text.as_bytes()).expect("a frame")
}

/// One under the other.
fn joined(parts: Vec<Picture>) -> Picture {
    let mut parts = parts.into_iter();
    let mut whole = parts.next().expect("a part");
    for part in parts {
        whole.height += part.height;
        whole.coverage.extend(part.coverage);
        whole.writes.extend(part.writes);
        whole.id.extend(part.id);
        whole.z.extend(part.z);
        whole.rgb.extend(part.rgb);
        whole.lit.extend(part.lit);
    }
    whole
}

#[test]
fn lines_drawn_apart_are_the_lines_drawn_together() {
    let mut checked = 0;
    for fill in [Fill::Exact { subpixel_bits: 8 }, Fill::Exact { subpixel_bits: 0 }, Fill::Textbook] {
        for header in
            ["depth lequal", "depth less\nblend 1", "depth off\nmode flat", "depth lequal\ndepth_write 0"]
        {
            let frame = frame(header);
            let whole = draw(&frame, fill);
            assert!(whole.writes.iter().filter(|writes| **writes > 0).count() > 400);
            let drawing = Drawing::new(&frame, fill);
            for lines in [1, 7, 29, 30] {
                let bands = (0..30).step_by(lines).map(|top| drawing.lines(top..30.min(top + lines as u32)));
                assert!(joined(bands.collect()) == whole, "{fill:?} {header:?}, {lines} lines at a time");
                checked += 1;
            }
        }
    }
    println!("checked {checked} pictures");
    assert_eq!(checked, 48);
}
