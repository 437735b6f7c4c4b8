//! Hidden surfaces by scan lines and by a depth buffer (the notes: "steps 4 and 5 fit neatly into the scan-line hidden surface removal
//! algorithm").

use crate::exhibit::{Exhibit, FILL, GUARD, HEIGHT, View, WIDTH, figure};
use anyhow::{Result, anyhow};
use edgewalk_golden::{draw, scan_lines};
use edgewalk_scene::{Scene, ShadeMode};

pub(crate) fn hidden_surfaces() -> Result<Exhibit> {
    let (mut figures, mut views) = (Vec::new(), Vec::new());
    for (name, view, depth) in
        [("torus-knot", "torus-knot", "depth-torus-knot"), ("terrain", "terrain", "depth-terrain")]
    {
        let frame = Scene::builtin(name)?.frame(WIDTH, HEIGHT, GUARD, ShadeMode::Gouraud);
        let buffer = draw(&frame, FILL);
        let (lines, work) = scan_lines(&frame, 8).map_err(|why| anyhow!("{name}: {why}"))?;
        let differ = lines.rgb.iter().zip(&buffer.rgb).filter(|(a, b)| a != b).count();
        let written: u64 = buffer.writes.iter().map(|writes| u64::from(*writes)).sum();
        figures.extend([
            figure(format!("{name}: pixels that differ between the two"), differ as f64, 0),
            figure(format!("{name}: fragments shaded before a depth buffer"), work.fragments as f64, 0),
            figure(format!("{name}: of them stored, in the order of the list"), written as f64, 0),
            figure(format!("{name}: pixels shaded by scan lines"), work.shaded as f64, 0),
            figure(
                format!("{name}: depth complexity, fragments a covered pixel"),
                work.fragments as f64 / work.shaded as f64,
                3,
            ),
            figure(format!("{name}: surfaces over one pixel at most"), work.deepest as f64, 0),
            figure(format!("{name}: depths that scan lines asked for"), work.depths as f64, 0),
            figure(format!("{name}: edges in the active list at most"), work.active as f64, 0),
        ]);
        let most = work.deepest as f64;
        let map = lines.coverage.iter().map(|count| [f64::from(*count) / most; 3]).collect();
        views.push(View::colors(view, format!("{name}, by scan lines"), lines.rgb));
        views.push(View::colors(depth, format!("{name}: surfaces over each pixel, white {most}"), map));
    }
    Ok(Exhibit {
        name: "hidden-surfaces",
        title: "Hidden surfaces by scan lines",
        cause: "One active list holds the edges of all polygons; on a line a flag says of each whether it is inside, and \
                between two crossings the nearest is shown. Each pixel is shaded once, no depth is stored and no picture \
                is needed beside the line. A depth buffer shades every fragment, and needs no list of all edges. Where no two \
                depths are equal both draw the same picture; here they do to the last bit, ties too.",
        figures,
        views,
    })
}
