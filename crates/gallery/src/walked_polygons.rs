//! Polygons that a machine with POLY walks edge by edge, beside golden.

use crate::exhibit::{Exhibit, HEIGHT, View, WIDTH, figure};
use anyhow::{Result, anyhow};
use edgewalk_explain::active_edges;
use edgewalk_host::draw;
use edgewalk_host::input::in_triangles;
use edgewalk_judge::compare::compare;
use edgewalk_judge::verdict::Verdict;
use edgewalk_machine::Machine;
use edgewalk_model::Waits;
use edgewalk_scene::triangle_file::parse;

/// Concave, star, hole, crossing, convex, and bent.
const SCENE: &str = include_str!("../scenes/polygons.tri");

/// A pixel of the star; its line meets the concave polygon, the star and the hole.
const PIXEL: (u32, u32) = (166, 62);

/// Error shown as white, LSB.
const WHITE: f64 = 1.0;

pub(crate) fn walked_polygons() -> Result<Exhibit> {
    let machine = Machine::preset("polygon").ok_or_else(|| anyhow!("no preset is called polygon"))?;
    let plan = machine.with(|machine| (machine.width, machine.height) = (WIDTH, HEIGHT)).plan()?;
    let frame = in_triangles(parse("polygons.tri", SCENE.as_bytes())?, &plan)?;
    let golden = draw::golden(&frame, &plan);
    let drawn = draw::fast(&frame, &plan, Waits::Never)?;
    let found = compare(&plan, &frame, &golden, &drawn);
    let [z, color] = [&found.errors.z, &found.errors.color];
    let bound = |bound: Option<f64>| bound.ok_or_else(|| anyhow!("a preset has a bound"));
    let verdict = match found.verdict() {
        Verdict::Pass => "pass",
        Verdict::Mismatch => "mismatch",
        Verdict::Vacuous | Verdict::Open => "nothing compared",
    };
    Ok(Exhibit {
        name: "walked-polygons",
        title: "Polygons walked by the machine (S11, S12)",
        cause: "POLY keeps the active edges of a line sorted by column. Each pair of them is a span, and each edge steps to \
                the next line by adding. So concave, crossing, star-shaped and holed polygons need no triangles. One plane holds \
                a polygon's values. The octagon's corners lie in no plane: it is drawn as six triangles. `edgewalk replay \
                docs/scenes/polygons.tri --machine polygon` shows lists, pairs and MOVER in each cycle.",
        figures: vec![
            figure("polygons that POLY walks", frame.polygons.len() as f64, 0),
            figure("triangles that the bent octagon becomes", frame.triangles.len() as f64, 0),
            figure("pixels covered", found.counts.covered as f64, 0),
            figure("pixels whose coverage differs from golden's", found.counts.coverage_mismatches as f64, 0),
            figure("largest depth error, LSB of 24 bits", z.error, 3),
            figure("proved bound of the depth error, LSB", bound(z.bound)?, 3),
            figure("largest colour error, LSB", color.error, 3),
            figure("proved bound of the colour error, LSB", bound(color.bound)?, 3),
            ("verdict of the comparison".to_owned(), verdict.to_owned()),
        ],
        views: vec![
            View::colors("machine", "The machine with POLY", drawn.rgb),
            View::colors("golden", "Golden beside it", golden.rgb),
            View::error("error", format!("Its colour error, white at {WHITE} LSB"), &color.map, WHITE),
            View::text(
                "active-edges",
                format!(
                    "`edgewalk explain docs/scenes/polygons.tri {} {} --machine polygon` prints:",
                    PIXEL.0, PIXEL.1
                ),
                active_edges(&frame, &plan, PIXEL),
            ),
        ],
    })
}
