//! The checks of the page that mutants have to fail: each gives how much it compared, or what differs first.

use crate::case::{Case, file};
use crate::chromium::Browser;
use crate::text::{sentences, text};
use edgewalk_model::View;
use edgewalk_model::view::Shape;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

pub type Checked = Result<u64, String>;

/// Cycles looked at.
const CYCLES: usize = 30;

/// Every register, token, sentence and link on the page at thirty cycles by seed, against the model run anew.
pub fn shown_text(browser: &mut Browser, case: &Case, html: &str) -> Checked {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let mut length = 0;
    case.watch(|cycle, _, _| length = cycle + 1);
    let mut wanted = BTreeSet::new();
    while wanted.len() < CYCLES {
        wanted.insert(rng.random_range(0..length));
    }
    let mut seen: BTreeMap<u32, View> = BTreeMap::new();
    case.watch(|cycle, view, _| {
        if wanted.contains(&cycle) {
            seen.insert(cycle, view.clone());
        }
    });
    let (_folder, path) = file(html);
    browser.open(&path, "");
    let mut order: Vec<(&u32, &View)> = seen.iter().collect();
    // Forwards and backwards.
    order.sort_by_key(|(cycle, _)| **cycle % 7);
    // In one go: the browser would draw each cycle, which takes longest. Words change to hex and back every eight cycles.
    let cycles: Vec<&u32> = order.iter().map(|(cycle, _)| *cycle).collect();
    let pages = browser.eval(&format!(
        "{cycles:?}.map((cycle, place) => {{
          const hex = (place >> 3) % 2 === 1;
          if (app.hex !== hex) app.setHex(hex);
          app.go(cycle);
          return {READ}; }})"
    ));
    let mut compared = 0;
    for (place, (cycle, view)) in order.into_iter().enumerate() {
        let (page, hex) = (&pages[place], (place >> 3) % 2 == 1);
        compared += registers(page, view, hex).map_err(|why| format!("cycle {cycle}: {why}"))?;
        let says: Vec<&str> = list(&page["says"]).filter(|text| *text != "Nothing happens.").collect();
        let expected = sentences(view, hex);
        if says != expected {
            return Err(format!("cycle {cycle}: says {says:?}, not {expected:?}"));
        }
        compared += expected.len() as u64;
        compared += links(page, view).map_err(|why| format!("cycle {cycle}: {why}"))?;
    }
    Ok(compared)
}

/// All that the page shows of a cycle.
const READ: &str = "({
  values: [...document.querySelectorAll('.value[data-register]')].map((e) => [+e.dataset.register, e.dataset.field === undefined ? -1 : +e.dataset.field, e.textContent]),
  says: [...document.querySelectorAll('#says div span')].map((e) => e.textContent),
  links: [...document.querySelectorAll('[data-link]')].map((e) => [e.dataset.link, e.querySelector('.word').textContent]),
  badge: document.getElementById('badge').textContent,
})";

fn list(value: &Value) -> impl Iterator<Item = &str> {
    value.as_array().into_iter().flatten().filter_map(Value::as_str)
}

fn registers(page: &Value, view: &View, hex: bool) -> Checked {
    let structure = view.structure();
    let mut compared = 0;
    let mut shown = BTreeSet::new();
    for value in page["values"].as_array().into_iter().flatten() {
        let id = value[0].as_u64().unwrap_or_default() as usize;
        let (register, raw) = (&structure.registers[id], view.values()[id]);
        let expected = match (usize::try_from(value[1].as_i64().unwrap_or(-1)), register.shape) {
            (Ok(place), Shape::Token(table)) => {
                let kind = &view.tokens().kinds()[table];
                let token = raw.checked_sub(1).map(|number| kind.met[number as usize][place + 1]);
                token.map_or("–".to_owned(), |raw| text(kind.fields[place].shape, raw, hex))
            }
            _ => text(register.shape, raw, hex),
        };
        if value[2] != expected {
            return Err(format!("{} shows {}, not {expected}", register.name, value[2]));
        }
        shown.insert(id);
        compared += 1;
    }
    let items = structure.units.iter().flat_map(|unit| &unit.items);
    let wanted: usize = items
        .map(|item| match item {
            edgewalk_model::view::Item::Register(_) => 1,
            edgewalk_model::view::Item::Table(table) => table.rows.iter().map(|row| row.cells.len()).sum(),
            edgewalk_model::view::Item::Schedule { .. } => 0,
        })
        .sum();
    let triangles = structure.units.iter().filter(|unit| unit.triangle.is_some()).count();
    if shown.len() != wanted + triangles {
        return Err(format!("{} registers are shown, not {}", shown.len(), wanted + triangles));
    }
    Ok(compared)
}

fn links(page: &Value, view: &View) -> Checked {
    let structure = view.structure();
    let mut compared = 0;
    for shown in page["links"].as_array().into_iter().flatten() {
        let link =
            structure.links.iter().find(|link| shown[0] == link.name).ok_or("a link that is not declared")?;
        let (valid, ready) = (view.values()[link.valid] == 1, view.values()[link.ready] == 1);
        let expected = match (valid, ready) {
            (true, true) => "fires",
            (true, false) => "waits",
            (false, true) => "ready",
            (false, false) => "not ready",
        };
        if shown[1] != expected {
            return Err(format!("{} {}, not {expected}", link.name, shown[1]));
        }
        compared += 1;
    }
    if compared < structure.links.len() as u64 {
        return Err("a link is not shown".to_owned());
    }
    let cause = edgewalk_model::Activity::ALL[view.values()[structure.cause] as usize];
    let expected = format!("{}: {}", cause.name().to_uppercase(), cause.meaning());
    if page["badge"] != expected {
        return Err(format!("the cause is {}, not {expected}", page["badge"]));
    }
    Ok(compared + 1)
}

/// The picture behind the last cycle, colour by colour and depth by depth, and behind ten others seen on the way there and
/// on the way back.
pub fn pictures(browser: &mut Browser, case: &Case, html: &str) -> Checked {
    let (_folder, path) = file(html);
    browser.open(&path, "");
    let cycles = browser.eval("app.doc.cycles").as_u64().unwrap_or_default();
    let mut stops: Vec<u64> = (1..=10).map(|k| k * (cycles - 1) / 10).collect();
    // In one go: the browser would draw each cycle, which takes longest.
    let look = |stops: &[u64]| {
        format!(
            "{stops:?}.map((stop) => {{
              app.go(stop);
              return app.planes.views.map((v) => v.canvas.toDataURL()).join() + document.getElementById('cards').textContent; }})"
        )
    };
    let there = browser.eval(&look(&stops));
    let frame = case.frame();
    let mut compared = picture(browser, case, &frame)?;
    stops.reverse();
    let back = browser.eval(&look(&stops));
    for (place, stop) in stops.iter().enumerate() {
        if !back[place].is_string() || back[place] != there[stops.len() - 1 - place] {
            return Err(format!("cycle {stop} looks otherwise on the way back"));
        }
        compared += 1;
    }
    let empty = browser.eval(
        "app.go(0); [...app.planes.views[0].image.data].every((v, i) => v === (i % 4 === 3 ? 255 : 0))",
    );
    if empty != true {
        return Err("the picture is not empty in cycle 0".to_owned());
    }
    Ok(compared)
}

fn picture(browser: &mut Browser, case: &Case, frame: &edgewalk_model::Frame) -> Checked {
    let shown = browser.eval(
        "(() => { const { width, height } = app.doc.store, [a, b] = app.planes.views; return {
            rgb: [...a.canvas.getContext('2d').getImageData(0, 0, width, height).data].filter((_, i) => i % 4 !== 3),
            z: Array.from(b.top, (write, pixel) => app.planes.valueAt(b, 0, write, pixel)) }; })()",
    );
    let max = case.plan.color.max() as f64;
    let mut compared = 0;
    for (pixel, (rgb, z)) in frame.rgb.iter().zip(&frame.z).enumerate() {
        for (i, word) in rgb.iter().enumerate() {
            let expected = (*word as f64 * 255.0 / max).round();
            if shown["rgb"][3 * pixel + i].as_f64() != Some(expected) {
                return Err(format!("pixel {pixel}: colour {}, not {expected}", shown["rgb"][3 * pixel + i]));
            }
        }
        if shown["z"][pixel].as_u64() != Some(*z) {
            return Err(format!("pixel {pixel}: depth {}, not {z}", shown["z"][pixel]));
        }
        compared += 4;
    }
    Ok(compared)
}
