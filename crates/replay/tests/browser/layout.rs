//! How it stands on the page: nothing overlaps or is cut, every control has a name.

use crate::case::{Case, file, icosahedron, machine, seven};
use crate::chromium::Browser;
use edgewalk_machine::Machine;

/// The faults of the layout: what is cut off, what lies over another, what sticks out.
pub const LAYOUT: &str = "(() => {
  const faults = [], hidden = (e) => e.closest('details:not([open]) > :not(summary)');
  const boxes = [...document.querySelectorAll('.card, .gutter, .panel, #tools > *, #legend button, .pair, .link')].filter((e) => e.offsetParent);
  const rect = (e) => e.getBoundingClientRect();
  for (let i = 0; i < boxes.length; i++) for (let k = i + 1; k < boxes.length; k++) {
    if (boxes[i].contains(boxes[k]) || boxes[k].contains(boxes[i])) continue;
    const [a, b] = [rect(boxes[i]), rect(boxes[k])];
    const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left), high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    if (wide > 1 && high > 1) faults.push(`${boxes[i].className || boxes[i].id} over ${boxes[k].className || boxes[k].id}`);
  }
  for (const e of document.querySelectorAll('main *, #top *')) {
    if (!e.offsetParent || e.closest('#past') === e || e.id === 'live' || hidden(e) || e.tagName === 'INPUT' || e.tagName === 'CANVAS') continue;
    if (e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0 && getComputedStyle(e).display !== 'inline') faults.push(`cut: ${e.tagName} ${e.className || e.id} ${e.textContent.slice(0, 30)}`);
  }
  for (const e of document.querySelectorAll('.card *')) {
    if (e.offsetParent && !hidden(e) && rect(e).right > rect(e.closest('.card')).right + 1) faults.push(`sticks out: ${e.textContent.slice(0, 30)}`);
  }
  if (document.scrollingElement.scrollWidth > innerWidth) faults.push('the page is wider than the window');
  return faults;
})()";

#[test]
fn nothing_overlaps_is_cut_or_moves() {
    let mut browser = Browser::start();
    let mut checked = 0;
    for case in seven() {
        let (_folder, path) = file(&case.html());
        for (width, height) in [(900, 700), (1400, 900)] {
            browser.size(width, height);
            browser.open(&path, "#px=31,20");
            // Colours move nothing: in the dark the cards lie where they lay in the light.
            let mut first = None;
            for (dark, states) in [("light", 50), ("dark", 1)] {
                let scheme =
                    serde_json::json!({ "features": [{ "name": "prefers-color-scheme", "value": dark }] });
                browser.ask("Emulation.setEmulatedMedia", scheme);
                let cycles = browser.eval("app.doc.cycles").as_u64().expect("cycles");
                // In one go: a picture of each cycle would take longest.
                let places = browser.eval(&format!(
                    "Array.from({{ length: {states} }}, (_, k) => {{
                      app.go(Math.floor(k * {} / 49));
                      return [...document.querySelectorAll('.card, .gutter, #cards, #planes .panel, #words-beside .panel')].map((e) => {{
                        const box = e.getBoundingClientRect(); return [box.left, box.top, box.width, box.height].map(Math.round); }}); }})",
                    cycles - 1
                ));
                let places = places.as_array().expect("a list");
                assert!(places[0].as_array().is_some_and(|places| places.len() > 5), "{places:?}");
                let first = first.get_or_insert_with(|| places[0].clone());
                for (k, now) in places.iter().enumerate() {
                    assert_eq!(now, first, "{}, {width} wide, {dark}: a card moves in state {k}", case.name);
                    checked += 1;
                }
                let faults = browser.eval(LAYOUT);
                assert_eq!(faults, serde_json::json!([]), "{}, {width} wide, {dark}", case.name);
                let contrast = browser.eval(CONTRAST);
                assert_eq!(contrast, serde_json::json!([]), "{}, {dark}", case.name);
            }
        }
    }
    browser.is_quiet();
    println!("checked {checked} states");
    assert!(checked == 7 * 2 * (50 + 1));
}

/// Rows of ink in the line of ticks over the run, columns of the canvas.
const TICKS: &str = "(() => {
  const canvas = app.strip.whole, row = canvas.getContext('2d').getImageData(0, 13, canvas.width, 1).data;
  return Array.from({ length: canvas.width }, (_, x) => x).filter((x) => row[4 * x + 3] > 60 && !(x > 0 && row[4 * x - 1] > 60));
})()";

#[test]
fn every_card_lies_on_the_page() {
    let light = [("shadow.light", "parallel"), ("shadow.size", "16"), ("blend.kind", "interpolated")];
    let case = Case::of("light and blend", machine(Machine::default(), &light));
    let mut browser = Browser::start();
    let (_folder, path) = file(&case.html());
    for width in [900, 1500] {
        browser.size(width, 1000);
        browser.open(&path, "#px=31,20");
        let cards = browser.eval(
            "[...document.querySelectorAll('.card')].map((e) => [e.dataset.unit, e.getBoundingClientRect().right])",
        );
        let cards: Vec<(String, f64)> = serde_json::from_value(cards).expect("cards");
        assert_eq!(cards.len(), 7, "{cards:?}");
        assert!(cards.iter().all(|(_, right)| *right <= f64::from(width)), "{width} wide: {cards:?}");
        assert_eq!(browser.eval(LAYOUT), serde_json::json!([]), "{width} wide");
    }
    browser.is_quiet();
}

#[test]
fn marks_of_300_triangles_keep_apart() {
    let plan = machine(Machine::default(), &[]);
    let triangles = (0..15).flat_map(|_| icosahedron(&plan)).collect::<Vec<_>>();
    assert_eq!(triangles.len(), 300);
    let case = Case { triangles, ..Case::of("many", plan) };
    let mut browser = Browser::start();
    let (_folder, path) = file(&case.html());
    browser.size(1500, 1000);
    browser.open(&path, "");
    let ticks: Vec<u32> = serde_json::from_value(browser.eval(TICKS)).expect("columns");
    assert!(ticks.len() > 50, "{ticks:?}");
    assert!(ticks.windows(2).all(|pair| pair[1] - pair[0] >= 6), "{ticks:?}");
    browser.is_quiet();
    println!("checked {} marks", ticks.len());
}

/// Text with less than 4.5 to 1 on what lies behind it; what is pale on purpose says nothing.
const CONTRAST: &str = "(() => {
  const light = (c) => { const [r, g, b] = c.match(/[\\d.]+/g).slice(0, 3).map((v) => { v /= 255; return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const ground = (e) => { for (; e; e = e.parentElement) { const c = getComputedStyle(e).backgroundColor; if (!/, 0\\)$/.test(c)) return c; } return 'rgb(255, 255, 255)'; };
  const faults = new Set();
  for (const e of document.querySelectorAll('body *')) {
    const own = [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim());
    if (!own || !e.offsetParent || e.closest('.pale, script, .swatch, #live, details:not([open]) > :not(summary)')) continue;
    const [a, b] = [light(getComputedStyle(e).color), light(ground(e))];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) faults.add(`${e.tagName} ${e.className} ${ratio.toFixed(2)} ${e.textContent.slice(0, 20)}`);
  }
  return [...faults];
})()";

#[test]
fn every_control_has_a_name_and_is_reached_by_tab() {
    let mut browser = Browser::start();
    let case = &seven()[0];
    let (_folder, path) = file(&case.html());
    browser.open(&path, "#px=31,20");
    let controls = browser.eval(
        "(() => { const all = [...document.querySelectorAll('button, input, summary, [tabindex]')].filter((e) => e.offsetParent && !e.closest('dialog'));
          all.forEach((e, i) => (e.dataset.control = i));
          return all.map((e) => (e.getAttribute('aria-label') || e.textContent || (e.labels && [...e.labels].map((l) => l.textContent).join())).trim()); })()",
    );
    let names: Vec<String> = serde_json::from_value(controls).expect("a list");
    assert!(names.iter().all(|name| !name.is_empty()), "{names:?}");
    let mut reached = std::collections::BTreeSet::new();
    browser.eval("document.activeElement.blur()");
    for _ in 0..names.len() + 3 {
        browser.key("Tab", false);
        if let Some(control) = browser.eval("document.activeElement.dataset.control").as_str() {
            reached.insert(control.to_owned());
        }
    }
    assert_eq!(reached.len(), names.len(), "reached by Tab");
    // The picture by keys alone.
    browser.eval("app.planes.views[0].marks.focus()");
    browser.key("ArrowRight", false);
    browser.key("ArrowDown", false);
    assert_eq!(browser.eval("app.chosen"), serde_json::json!([32, 21]));
    browser.eval("app.go(app.doc.cycles - 1)");
    browser.key("Enter", false);
    assert!(browser.eval("app.cycle < app.doc.cycles - 1") == true, "Enter goes to the write");
    browser.is_quiet();
    println!("checked {} controls", names.len());
    assert!(names.len() > 20);
}
