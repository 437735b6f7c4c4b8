//! Pictures of the best machines for the report: the image, and heat maps of its errors.

use crate::picture::{bytes, heat, png};
use anyhow::Result;
use edgewalk_explore::page::Pictures;
use edgewalk_explore::sweep::shared::pixel_key;
use edgewalk_explore::sweep::table::{Candidate, Table};
use edgewalk_explore::sweep::{Point, Sweep};
use edgewalk_host::draw;
use edgewalk_judge::compare::compare;
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
    let [golden, drawn] = [draw::golden(&frame, plan), draw::fast(&frame, plan, Waits::Never)?];
    let found = compare(plan, &frame, &golden, &drawn);
    let size = (drawn.width, drawn.height);
    let images = vec![
        ("picture", png(size, |i| bytes(drawn.rgb[i]))?),
        ("depth error", png(size, |i| heat(found.errors.z.map[i]))?),
        ("colour error", png(size, |i| heat(found.errors.color.map[i]))?),
    ];
    Ok(Some(Pictures { key: point.key.clone(), images }))
}
