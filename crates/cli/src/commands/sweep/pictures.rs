//! Pictures of the best machines for the report: the image, and heat maps of its errors.

use anyhow::Result;
use edgewalk_explore::page::Pictures;
use edgewalk_explore::sweep::shared::pixel_key;
use edgewalk_explore::sweep::table::{Candidate, Table};
use edgewalk_explore::sweep::{Point, Sweep};
use edgewalk_files::Png;
use edgewalk_host::draw;
use edgewalk_host::port::to_port;
use edgewalk_judge::beside::{Golden, Proved, beside};
use edgewalk_model::Waits;
use std::collections::BTreeSet;

/// Most machines that are drawn for a report, an input each.
const MOST: usize = 4;

/// Of the best for each objective, then of the front; machines of the same pixels once.
pub fn pictures(table: &Table) -> Result<Vec<Pictures>> {
    let sweep = table.sweep;
    let bests = sweep.objectives.iter().filter_map(|objective| table.best(objective));
    let keys =
        bests.chain(table.first_front()).flat_map(Candidate::all).filter_map(|row| row["key"].as_str());
    let points = sweep.by_key();
    let mut seen = BTreeSet::new();
    let mut list = Vec::new();
    for key in keys {
        let Some(point) = points.get(key) else { continue };
        if list.len() < MOST && seen.insert((point.input, point.way, pixel_key(&point.machine))) {
            list.extend(drawn(sweep, point)?);
        }
    }
    Ok(list)
}

fn drawn(sweep: &Sweep, point: &Point) -> Result<Option<Pictures>> {
    let Ok(plan) = &point.plan else { return Ok(None) };
    let frame = sweep.drawn(point).input.frame(plan)?;
    let (port, size) = (to_port(&frame, plan)?, (plan.width, plan.height));
    let [(mut picture, image), (mut depth, depth_image), (mut color, color_image)] =
        [Png::in_memory(size)?, Png::in_memory(size)?, Png::in_memory(size)?];
    let proved = Proved { reach: None, shading: None };
    let draw = |lines, take: &mut dyn FnMut(_) -> _| draw::in_bands(plan, &port, Waits::Never, lines, take);
    beside(plan, &frame, &Golden::of(&frame, plan), proved, draw, |lines| {
        picture.extend_rgb(&lines.drawn.rgb)?;
        depth.extend_heat(lines.z_error, 1.0)?;
        color.extend_heat(lines.color_error, 1.0)
    })?;
    [picture, depth, color].into_iter().try_for_each(Png::finish)?;
    let images = vec![
        ("picture", image.take()),
        ("depth error", depth_image.take()),
        ("colour error", color_image.take()),
    ];
    Ok(Some(Pictures { key: point.key.clone(), images }))
}
