//! The lecture's sample polygon (the slides): its edge table, its active edges line by line, its pixels.

use edgewalk_golden::polygon::{EdgeTable, Grid, fragments};
use edgewalk_scene::{Polygon, ShadeMode, Vertex};
use std::fmt::Write as _;

/// A(2,3) B(7,1) C(13,5) D(13,11) E(7,7) F(2,9).
fn sample() -> Polygon {
    let points = [(2, 3), (7, 1), (13, 5), (13, 11), (7, 7), (2, 9)];
    let vertex = |(x, y)| Vertex { x: f64::from(x), y: f64::from(y), ..Vertex::default() };
    Polygon { contours: vec![points.map(vertex).to_vec()], after: 0 }
}

fn table(grid: Grid) -> EdgeTable {
    EdgeTable::new(&sample(), ShadeMode::Gouraud, grid)
}

#[test]
fn edge_table_of_the_lecture() {
    let expected = "\
bucket  edge       Ymin       Ymax  x at Ymin        1/m
     1  B-A           1          3          7       -5/2
        B-C           1          5          7        6/4
     3  A-F           3          9          2          0
     5  C-D           5         11         13          0
     7  E-F           7          9          7       -5/2
        E-D           7         11          7        6/4
";
    assert_eq!(table(Grid::whole()).to_string(), expected);
    // The page shows what this test holds.
    assert!(include_str!("../../../docs/polygons.md").contains(expected));
}

/// As the page shows them.
fn active_edges() -> String {
    let mut text = String::new();
    table(Grid::whole()).scan(0..20, |line, active| {
        let crossings: Vec<_> =
            active.iter().map(|a| format!("{} {}", a.edge().ends().join("-"), a.x())).collect();
        let spans: Vec<_> =
            active.chunks(2).map(|pair| format!("{}..{}", pair[0].column(), pair[1].column())).collect();
        let _ = writeln!(text, "{line:>4}  {:<38}{}", crossings.join("  "), spans.join("  "));
    });
    text
}

#[test]
fn active_edges_of_every_line() {
    let expected = "   1  B-A 7  B-C 7                          7..7
   2  B-A 4.5  B-C 8.5                      5..9
   3  A-F 2  B-C 10                         2..10
   4  A-F 2  B-C 11.5                       2..12
   5  A-F 2  C-D 13                         2..13
   6  A-F 2  C-D 13                         2..13
   7  A-F 2  E-F 7  E-D 7  C-D 13           2..7  7..13
   8  A-F 2  E-F 4.5  E-D 8.5  C-D 13       2..5  9..13
   9  E-D 10  C-D 13                        10..13
  10  E-D 11.5  C-D 13                      12..13
";
    assert_eq!(active_edges(), expected);
    assert!(include_str!("../../../docs/polygons.md").contains(expected));
}

#[test]
fn pixels_at_whole_coordinates_and_at_centres() {
    let drawn = |grid| {
        let mut lines = vec![[b'.'; 16]; 12];
        fragments(&table(grid), (16, 12), |f| lines[f.y as usize][f.x as usize] = b'#');
        lines.into_iter().map(|line| String::from_utf8_lossy(&line).into_owned()).collect::<Vec<_>>()
    };
    let whole = [
        "................",
        "................",
        ".....####.......",
        "..########......",
        "..##########....",
        "..###########...",
        "..###########...",
        "..###########...",
        "..###....####...",
        "..........###...",
        "............#...",
        "................",
    ];
    assert_eq!(drawn(Grid::whole()), whole);
    // Half a pixel on: line 1 is crossed at 1.5, from 5.75 to 7.75.
    let centres = [
        "................",
        "......##........",
        "...######.......",
        "..#########.....",
        "..##########....",
        "..###########...",
        "..###########...",
        "..####..#####...",
        "..#......####...",
        "...........##...",
        "............#...",
        "................",
    ];
    assert_eq!(drawn(Grid::subpixels(0)), centres);
}

#[test]
fn horizontal_edges_are_not_in_the_table() {
    let points = [(2.0, 3.0), (9.0, 3.0), (9.0, 8.0), (5.0, 8.25), (2.0, 8.0)];
    let vertex = |(x, y)| Vertex { x, y, ..Vertex::default() };
    let square = Polygon { contours: vec![points.map(vertex).to_vec()], after: 0 };
    let ends = |grid| {
        let table = EdgeTable::new(&square, ShadeMode::Gouraud, grid);
        table.edges().iter().map(|edge| edge.ends().concat()).collect::<Vec<_>>()
    };
    // C-D and D-E are not quite horizontal, but cross no centre; rounded to whole pixels they are.
    assert_eq!(ends(Grid::subpixels(8)), ["AE", "BC"]);
    assert_eq!(ends(Grid::whole()), ["AE", "BC"]);
}

#[test]
fn edges_that_begin_above_the_screen_enter_on_its_first_line() {
    let points = [(-1e6, -1e6), (1e6, -1e6), (3.0, 9.0)];
    let vertex = |(x, y)| Vertex { x, y, ..Vertex::default() };
    let giant = Polygon { contours: vec![points.map(vertex).to_vec()], after: 0 };
    let table = EdgeTable::new(&giant, ShadeMode::Gouraud, Grid::subpixels(8));
    let mut lines = Vec::new();
    table.scan(0..12, |line, active| lines.push((line, active[0].column(), active[1].column())));
    // A little less than 1 px a line either way, towards (3, 9).
    let expected: Vec<_> = (0..9).map(|y| (y, 3 - (8 - y), 3 + (8 - y))).collect();
    assert_eq!(lines, expected);
}
