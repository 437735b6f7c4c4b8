//! The triangle on the screen: its edges, and each pixel in the colour and with the cycle in which it was written.

use super::wave::shows;
use crate::support::recording::Recording;
use std::fmt::Write as _;

const SIDE: f64 = 36.0;

pub fn draw(recording: &Recording) -> String {
    let store = &recording.json["store"];
    let (width, height) = (store["width"].as_f64().unwrap() * SIDE, store["height"].as_f64().unwrap() * SIDE);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-20 -20 {} {}\" width=\"{}\" font-family=\"sans-serif\" \
         font-size=\"11\">\n<rect x=\"-20\" y=\"-20\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        width + 30.0,
        height + 30.0,
        width + 30.0
    );
    for column in 0..=(width / SIDE) as u32 {
        let x = f64::from(column) * SIDE;
        let _ = writeln!(svg, "<line x1=\"{x}\" x2=\"{x}\" y1=\"0\" y2=\"{height}\" stroke=\"#dddddd\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"-6\" text-anchor=\"middle\" fill=\"#666666\">{column}</text>",
            x + SIDE / 2.0
        );
    }
    for row in 0..=(height / SIDE) as u32 {
        let y = f64::from(row) * SIDE;
        let _ = writeln!(svg, "<line x1=\"0\" x2=\"{width}\" y1=\"{y}\" y2=\"{y}\" stroke=\"#dddddd\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"-6\" y=\"{}\" text-anchor=\"end\" fill=\"#666666\">{row}</text>",
            y + SIDE / 2.0 + 4.0
        );
    }
    let fires = |cycle| ["wr_valid", "wr_ready"].iter().all(|end| shows(recording, end, cycle) == "1");
    let mut written = 0;
    for cycle in recording.cycles().filter(|cycle| fires(*cycle)) {
        let of = |field: &str| shows(recording, &format!("depth w.fragment:{field}"), cycle);
        let addr = of("addr");
        let (x, y) = addr.split_once(',').unwrap();
        let (x, y) = (x.parse::<f64>().unwrap() * SIDE, y.parse::<f64>().unwrap() * SIDE);
        let (r, g, b) = (of("r"), of("g"), of("b"));
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{SIDE}\" height=\"{SIDE}\" fill=\"rgb({r},{g},{b})\" fill-opacity=\"0.75\"/>"
        );
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{cycle}</text>",
            x + SIDE / 2.0,
            y + SIDE / 2.0 + 4.0
        );
        written += 1;
    }
    assert!(written > 0, "nothing was written");
    let corners = recording.json["triangles"]["0"].as_array().unwrap().iter();
    let corners = corners.map(|corner| {
        format!("{},{}", corner[0].as_f64().unwrap() * SIDE, corner[1].as_f64().unwrap() * SIDE)
    });
    let corners = corners.collect::<Vec<_>>().join(" ");
    let _ = writeln!(
        svg,
        "<polygon points=\"{corners}\" fill=\"none\" stroke=\"#000000\" stroke-width=\"1.5\"/>"
    );
    svg + "</svg>\n"
}
