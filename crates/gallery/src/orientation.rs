//! Orientation dependence of a quad (slides): bilinear interpolation along edges, then along the line, turns with the screen. Golden draws it,
//! and a machine with bilinear colours.

use crate::exhibit::{Exhibit, HEIGHT, LSB, View, WIDTH, figure};
use crate::plot::{Series, plot};
use anyhow::{Result, anyhow};
use edgewalk_host::draw;
use edgewalk_judge::compare::compare;
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::Waits;
use edgewalk_scene::{Frame, Polygon, Vertex};

/// Side of the square, px.
const SIDE: f64 = 150.0;

/// Angles of the pictures, degrees, and the names of golden's and of the machine's.
const SHOWN: [(u32, [&str; 2]); 3] =
    [(0, ["0", "machine-0"]), (30, ["30", "machine-30"]), (45, ["45", "machine-45"])];

pub(crate) fn orientation() -> Result<Exhibit> {
    let machine = Machine::preset("bilinear").ok_or_else(|| anyhow!("no preset is called bilinear"))?;
    let plan = machine.with(|machine| (machine.width, machine.height) = (WIDTH, HEIGHT)).plan()?;
    let points = |drawn: &dyn Fn(&Frame) -> Result<Vec<[f64; 3]>>| -> Result<Vec<(f64, f64)>> {
        let angles = (0..=90).map(f64::from);
        angles.map(|angle| Ok((angle, middle(&drawn(&square(angle))?)))).collect()
    };
    let golden = points(&|frame| Ok(draw::golden(frame, &plan).rgb))?;
    let walked = points(&|frame| Ok(draw::fast(frame, &plan, Waits::Never)?.rgb))?;
    let range = |points: &[(f64, f64)]| {
        let (low, high) = points.iter().fold((f64::MAX, f64::MIN), |(l, h), (_, v)| (l.min(*v), h.max(*v)));
        high - low
    };
    let mut figures = vec![
        figure("middle of the square at 0 degrees, LSB", golden[0].1, 1),
        figure("at 45 degrees, LSB", golden[45].1, 1),
        figure("range while it turns, LSB", range(&golden), 1),
        figure("machine: middle of the square at 0 degrees, LSB", walked[0].1, 1),
        figure("machine: at 45 degrees, LSB", walked[45].1, 1),
        figure("machine: range while it turns, LSB", range(&walked), 1),
    ];
    let mut views = Vec::new();
    for (degrees, [name, name_of_machine]) in SHOWN {
        let (of_golden, of_machine, mut told) = beside(degrees, &plan)?;
        figures.append(&mut told);
        views.push(View::colors(name, format!("At {degrees} degrees"), of_golden));
        views.push(View::colors(name_of_machine, format!("The machine, at {degrees} degrees"), of_machine));
    }
    // Golden's in one row, the machine's in the next.
    views.sort_by_key(|view| view.name.starts_with("machine"));
    views.push(View::drawing(
        "turning",
        "The pixel in the middle while the square turns",
        plot(
            "degrees",
            "LSB of 8 bits",
            &[Series { label: "golden", points: golden }, Series { label: "machine", points: walked }],
        ),
    ));
    Ok(Exhibit {
        name: "orientation",
        title: "Orientation dependence of a quad (S15, S16)",
        cause: "A square with corners white, black, white, black. Values run linearly along the edges, then along the scan \
                line (l_a, l_b, l_p of B), so which corners a pixel hears of depends on how the square is turned. A machine with POLY \
                and `polygon.values = bilinear` walks the square as one polygon and shows the same. Cut into \
                triangles the picture turns with the square, but shows the diagonal.",
        figures,
        views,
    })
}

/// Golden's picture, the machine's picture, and the errors between both.
type Beside = (Vec<[f64; 3]>, Vec<[f64; 3]>, Vec<(String, String)>);

fn beside(degrees: u32, plan: &Plan) -> Result<Beside> {
    let frame = square(f64::from(degrees));
    let (golden, drawn) = (draw::golden(&frame, plan), draw::fast(&frame, plan, Waits::Never)?);
    let found = compare(plan, &frame, &golden, &drawn);
    let color = &found.errors.color;
    let bound = color.bound.ok_or_else(|| anyhow!("a preset has a bound"))?;
    let told = vec![
        figure(
            format!("machine at {degrees} degrees: pixels whose coverage differs from golden's"),
            found.counts.coverage_mismatches as f64,
            0,
        ),
        figure(format!("machine at {degrees} degrees: largest colour error, LSB"), color.error, 3),
        figure(format!("machine at {degrees} degrees: proved bound of it, LSB"), bound, 3),
    ];
    Ok((golden.rgb, drawn.rgb, told))
}

/// The corners of the square, px.
pub(crate) fn corners(degrees: f64) -> [[f64; 2]; 4] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]: [f64; 2]| {
        [
            f64::from(WIDTH / 2) + 0.5 + SIDE / 2.0 * (x * cos - y * sin),
            f64::from(HEIGHT / 2) + 0.5 + SIDE / 2.0 * (x * sin + y * cos),
        ]
    })
}

fn square(degrees: f64) -> Frame {
    let corner =
        |([x, y], v): ([f64; 2], f64)| Vertex { x, y, z: 0.5, r: v, g: v, b: v, ..Vertex::default() };
    let contour = corners(degrees).into_iter().zip([1.0, 0.0, 1.0, 0.0]).map(corner).collect();
    Frame {
        clear: [0.2, 0.25, 0.4],
        polygons: vec![Polygon { contours: vec![contour], after: 0 }],
        ..Frame::new(WIDTH, HEIGHT)
    }
}

/// The pixel in the middle of the square, LSB.
pub(crate) fn middle(rgb: &[[f64; 3]]) -> f64 {
    LSB * rgb[(HEIGHT / 2 * WIDTH + WIDTH / 2) as usize][0]
}
