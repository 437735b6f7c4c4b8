//! Pictures of the best machines for the report: the image, and heat maps of its errors.

use anyhow::Result;
use edgewalk_explore::page::Pictures;
use edgewalk_explore::sweep::shared::pixel_key;
use edgewalk_explore::sweep::table::{Candidate, Table};
use edgewalk_explore::sweep::{Point, Sweep};
use edgewalk_files::picture;
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
    let [mut colors, mut z_error, mut color_error] = [Vec::new(), Vec::new(), Vec::new()];
    let proved = Proved { reach: None, shading: None };
    let draw = |lines, take: &mut dyn FnMut(_) -> _| draw::in_bands(plan, &port, Waits::Never, lines, take);
    beside(plan, &frame, &Golden::of(&frame, plan), proved, draw, |lines| {
        colors.extend(picture::rgb_bytes(&lines.drawn.rgb));
        z_error.extend(picture::heat_bytes(lines.z_error, 1.0));
        color_error.extend(picture::heat_bytes(lines.color_error, 1.0));
        Ok(())
    })?;
    let images = vec![
        ("picture", picture::in_memory(size, &colors)?),
        ("depth error", picture::in_memory(size, &z_error)?),
        ("colour error", picture::in_memory(size, &color_error)?),
    ];
    Ok(Some(Pictures { key: point.key.clone(), images }))
}
