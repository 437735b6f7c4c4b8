//! Lines over two axes, as SVG.

use std::fmt::Write as _;

/// A line of a plot.
pub(crate) struct Series {
    pub label: &'static str,
    pub points: Vec<(f64, f64)>,
}

/// Told apart by eyes of any kind.
const COLORS: [&str; 4] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];
const SIZE: (f64, f64) = (640.0, 260.0);
const LEFT: f64 = 60.0;
const RIGHT: f64 = 130.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 40.0;

/// A plot; the axes say what they count.
pub(crate) fn plot(x_axis: &str, y_axis: &str, series: &[Series]) -> String {
    let all = || series.iter().flat_map(|line| &line.points);
    let range = |of: fn(&(f64, f64)) -> f64| {
        let (low, high) = all().map(of).fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        if low < high { (low, high) } else { (low - 1.0, low + 1.0) }
    };
    let ((x_low, x_high), (y_low, y_high)) = (range(|p| p.0), range(|p| p.1));
    let (width, height) = (SIZE.0 - LEFT - RIGHT, SIZE.1 - TOP - BOTTOM);
    let x_at = |x: f64| LEFT + (x - x_low) / (x_high - x_low) * width;
    let y_at = |y: f64| TOP + (y_high - y) / (y_high - y_low) * height;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"11\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        SIZE.0, SIZE.1
    );
    // Writing to a string cannot fail.
    let mut line = |text: std::fmt::Arguments| _ = writeln!(svg, "{text}");
    for quarter in 0..=4 {
        let part = f64::from(quarter) / 4.0;
        let (x, y) = (x_low + part * (x_high - x_low), y_low + part * (y_high - y_low));
        let (x_px, y_px, end) = (x_at(x), y_at(y), LEFT + width);
        line(format_args!(
            "<line x1=\"{LEFT}\" x2=\"{end}\" y1=\"{y_px:.1}\" y2=\"{y_px:.1}\" stroke=\"#dddddd\"/>"
        ));
        line(format_args!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            LEFT - 6.0,
            y_px + 4.0,
            short(y)
        ));
        line(format_args!(
            "<text x=\"{x_px:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            TOP + height + 16.0,
            short(x)
        ));
    }
    let (middle, below) = (LEFT + width / 2.0, SIZE.1 - 6.0);
    line(format_args!("<text x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{x_axis}</text>"));
    let half = TOP + height / 2.0;
    line(format_args!(
        "<text x=\"12\" y=\"{half}\" text-anchor=\"middle\" transform=\"rotate(-90 12 {half})\">{y_axis}</text>"
    ));
    for (place, (of, color)) in series.iter().zip(COLORS).enumerate() {
        let points: Vec<String> =
            of.points.iter().map(|(x, y)| format!("{:.1},{:.1}", x_at(*x), y_at(*y))).collect();
        let points = points.join(" ");
        line(format_args!(
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>"
        ));
        let (x, y) = (LEFT + width + 10.0, TOP + 12.0 + 18.0 * place as f64);
        line(format_args!("<text x=\"{x}\" y=\"{y}\" fill=\"{color}\">{}</text>", of.label));
    }
    svg + "</svg>\n"
}

/// Three digits that count.
fn short(value: f64) -> String {
    let decimals = if value.abs() >= 100.0 || value == 0.0 { 0 } else { 2 };
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What stands between two marks, wherever they are.
    fn all<'a>(svg: &'a str, before: &str, after: &str) -> Vec<&'a str> {
        svg.split(before).skip(1).filter_map(|rest| rest.split(after).next()).collect()
    }

    /// 2 to 10 on 450 pixels from 60 to the right, -100 to 300 on 208 from 220 upwards.
    #[test]
    fn lines_and_labels_stand_where_the_axes_say() {
        let svg = plot(
            "across",
            "up",
            &[
                Series { label: "one", points: vec![(2.0, -100.0), (4.0, 0.0), (10.0, 300.0)] },
                Series { label: "two", points: vec![(6.0, 200.0), (9.0, 50.0)] },
            ],
        );
        assert_eq!(
            all(&svg, "<polyline points=\"", "\" fill"),
            ["60.0,220.0 172.5,168.0 510.0,12.0", "285.0,64.0 453.8,142.0"]
        );
        assert_eq!(
            all(&svg, "<line ", " stroke"),
            ["220.0", "168.0", "116.0", "64.0", "12.0"]
                .map(|y| format!("x1=\"60\" x2=\"510\" y1=\"{y}\" y2=\"{y}\""))
        );
        assert_eq!(
            all(&svg, "<text ", "</text>"),
            [
                "x=\"54.0\" y=\"224.0\" text-anchor=\"end\">-100",
                "x=\"60.0\" y=\"236.0\" text-anchor=\"middle\">2.00",
                "x=\"54.0\" y=\"172.0\" text-anchor=\"end\">0",
                "x=\"172.5\" y=\"236.0\" text-anchor=\"middle\">4.00",
                "x=\"54.0\" y=\"120.0\" text-anchor=\"end\">100",
                "x=\"285.0\" y=\"236.0\" text-anchor=\"middle\">6.00",
                "x=\"54.0\" y=\"68.0\" text-anchor=\"end\">200",
                "x=\"397.5\" y=\"236.0\" text-anchor=\"middle\">8.00",
                "x=\"54.0\" y=\"16.0\" text-anchor=\"end\">300",
                "x=\"510.0\" y=\"236.0\" text-anchor=\"middle\">10.00",
                "x=\"285\" y=\"254\" text-anchor=\"middle\">across",
                "x=\"12\" y=\"116\" text-anchor=\"middle\" transform=\"rotate(-90 12 116)\">up",
                "x=\"520\" y=\"24\" fill=\"#0072b2\">one",
                "x=\"520\" y=\"42\" fill=\"#d55e00\">two",
            ]
        );
        assert!(svg.contains("viewBox=\"0 0 640 260\""));
    }

    /// One above and one below are shown.
    #[test]
    fn what_never_changes_runs_through_the_middle() {
        let svg = plot("x", "y", &[Series { label: "flat", points: vec![(0.0, 5.0), (3.0, 5.0)] }]);
        assert_eq!(all(&svg, "<polyline points=\"", "\" fill"), ["60.0,116.0 510.0,116.0"]);
        assert_eq!(all(&svg, "text-anchor=\"end\">", "<"), ["4.00", "4.50", "5.00", "5.50", "6.00"]);
    }
}
