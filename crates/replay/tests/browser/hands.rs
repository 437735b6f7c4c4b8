//! What hands do: clicks on pixels, every key, the legend, and the state in the address.

use crate::case::{file, seven};
use crate::chromium::Browser;
use std::collections::BTreeMap;

/// The middle of a pixel on the page.
fn on_page(browser: &mut Browser, plane: usize, (x, y): (u32, u32)) -> (f64, f64) {
    let place = browser.eval(&format!(
        "(() => {{ const view = app.planes.views[{plane}]; view.marks.scrollIntoView({{ block: 'center' }});
          const box = view.marks.getBoundingClientRect(), {{ width, height }} = app.doc.store;
          return [box.left + ({x} + 0.5) * box.width / width, box.top + ({y} + 0.5) * box.height / height]; }})()"
    ));
    (place[0].as_f64().expect("a place"), place[1].as_f64().expect("a place"))
}

#[test]
fn a_click_on_a_pixel_lands_on_its_write() {
    let mut browser = Browser::start();
    let (mut clicks, mut twice) = (0, 0);
    for case in [&seven()[0], &seven()[3]] {
        let mut writes: BTreeMap<u32, Vec<(u32, u32)>> = BTreeMap::new();
        case.watch(|cycle, _, write| {
            if let Some((addr, triangle)) = write {
                writes.entry(addr).or_default().push((cycle, triangle));
            }
        });
        let (_folder, path) = file(&case.html());
        browser.size(1400, 900);
        browser.open(&path, "");
        // Some that were written once, some more often.
        let mut chosen: Vec<_> =
            writes.iter().filter(|(_, all)| all.len() > 1).step_by(97).take(10).collect();
        chosen.extend(writes.iter().filter(|(_, all)| all.len() == 1).step_by(41).take(10));
        for (addr, all) in chosen {
            let pixel = case.place(*addr);
            browser.eval("app.go(app.doc.cycles - 1)");
            for (cycle, triangle) in all.iter().rev() {
                let (x, y) = on_page(&mut browser, clicks % 2, pixel);
                browser.click(x, y);
                let now = browser.eval("[app.cycle, ...app.chosen]");
                assert_eq!(
                    now,
                    serde_json::json!([cycle, pixel.0, pixel.1]),
                    "{}: pixel {pixel:?}",
                    case.name
                );
                // The write of this very cycle stands in the history, in the row of its triangle.
                let row = browser.eval(
                    "document.querySelector('.jump[aria-current=true]').closest('tr').cells[0].textContent",
                );
                assert_eq!(row, format!("T{triangle}"));
                clicks += 1;
            }
            let written = browser.eval(
                "(() => { const place = [...document.querySelectorAll('#past thead th')].findIndex((th) => th.textContent === 'written');
                  return [...document.querySelectorAll('#past table:first-of-type tbody tr')].filter((row) => row.cells[place].textContent !== '\u{2013}').length; })()",
            );
            assert_eq!(written, all.len(), "{}: pixel {pixel:?}: the history lists every write", case.name);
            twice += usize::from(all.len() > 1);
        }
    }
    browser.is_quiet();
    println!("checked {clicks} clicks, {twice} pixels written more than once");
    assert!(clicks >= 20 && twice >= 5);
}

#[test]
fn every_key_does_what_the_help_says() {
    let mut browser = Browser::start();
    let case = &seven()[0];
    let (_folder, path) = file(&case.html());
    browser.open(&path, "");
    // Where a token moves on a link, from the model.
    let mut fires: BTreeMap<String, Vec<u64>> = BTreeMap::new();
    let mut causes: Vec<u64> = Vec::new();
    let mut keys: BTreeMap<String, char> = BTreeMap::new();
    case.watch(|cycle, view, _| {
        for link in &view.structure().links {
            let Some((step, key)) = link.step else { continue };
            keys.insert(step.to_owned(), key);
            if view.values()[link.valid] & view.values()[link.ready] == 1 {
                fires.entry(step.to_owned()).or_default().push(cycle.into());
            }
        }
        causes.push(view.values()[view.structure().cause]);
    });
    let last = causes.len() as u64 - 1;
    let help = browser.eval("[...document.querySelectorAll('#keys th')].map((th) => th.textContent)");
    let help: Vec<String> = serde_json::from_value(help).expect("a list");
    let mut tried: Vec<String> = Vec::new();
    let at = |browser: &mut Browser| browser.eval("app.cycle").as_u64().expect("a cycle");
    let from = |browser: &mut Browser, cycle: u64| {
        browser.eval(&format!("document.activeElement.blur(); app.go({cycle})"));
    };
    for (step, cycles) in &fires {
        let key = keys[step].to_string();
        for start in [0, last / 3, last / 2, last] {
            let next = cycles.iter().find(|cycle| **cycle > start).copied().unwrap_or(start);
            let before = cycles.iter().rev().find(|cycle| **cycle < start).copied().unwrap_or(start);
            from(&mut browser, start);
            browser.key(&key, false);
            assert_eq!(at(&mut browser), next, "{key} from {start}");
            from(&mut browser, start);
            browser.key(&key.to_uppercase(), true);
            assert_eq!(at(&mut browser), before, "Shift {key} from {start}");
        }
        tried.push(key);
    }
    let changes: Vec<u64> = (1..=last).filter(|c| causes[*c as usize] != causes[*c as usize - 1]).collect();
    let middle = last / 2;
    from(&mut browser, middle);
    browser.key("c", false);
    assert_eq!(Some(at(&mut browser)), changes.iter().find(|c| **c > middle).copied());
    browser.key("C", true);
    assert_eq!(Some(at(&mut browser)), changes.iter().rev().find(|c| **c <= middle).copied());
    for (key, shift, from_cycle, to) in [
        ("ArrowRight", true, 5, 6),
        ("ArrowLeft", true, 5, 4),
        ("ArrowLeft", false, 0, 0),
        ("Home", false, 77, 0),
        ("End", false, 77, last),
    ] {
        from(&mut browser, from_cycle);
        browser.key(key, shift);
        assert_eq!(at(&mut browser), to, "{key}");
    }
    // A fold is one step: all of it is of one cause, and no token moves in it.
    from(&mut browser, 1);
    browser.key("ArrowRight", false);
    let behind = at(&mut browser);
    assert!(behind > 8 && fires.values().flatten().all(|cycle| !(1..behind).contains(cycle)), "{behind}");
    browser.key("ArrowLeft", false);
    assert_eq!(at(&mut browser), 1);
    browser.key("Enter", false);
    browser.key("ArrowRight", false);
    assert!(at(&mut browser) < behind, "Enter opens the fold");
    browser.key("f", false);
    assert_eq!(browser.eval("app.cells.length"), last + 1, "f: every cycle is a cell");
    browser.key("f", false);
    browser.key("x", false);
    assert_eq!(
        browser.eval("[app.hex, document.getElementById('words').textContent]"),
        serde_json::json!([true, "words: hex"])
    );
    browser.key("x", false);
    for (key, speed) in [("+", 32), ("-", 16)] {
        browser.key(key, false);
        assert_eq!(browser.eval("app.speed"), speed);
    }
    browser.key("?", false);
    assert_eq!(browser.eval("document.getElementById('help').open"), true);
    browser.key("?", false);
    assert_eq!(browser.eval("document.getElementById('help').open"), false);
    browser.key("g", false);
    assert_eq!(browser.eval("document.activeElement.id"), "input");
    from(&mut browser, 0);
    browser.key(" ", false);
    let begun = std::time::Instant::now();
    while at(&mut browser) == 0 && begun.elapsed().as_secs() < 20 {
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    browser.key(" ", false);
    let played = at(&mut browser);
    std::thread::sleep(std::time::Duration::from_millis(300));
    assert!(played > 0 && at(&mut browser) == played, "Space plays and pauses: {played}");
    tried.extend(
        ["Space", "→", "←", "Home", "End", "c", "Enter", "f", "x", "+", "-", "g", "?"].map(str::to_owned),
    );
    let missing: Vec<_> = help.iter().filter(|key| !tried.contains(key)).collect();
    assert!(missing.is_empty() && help.len() == tried.len(), "not tried: {missing:?}");
    browser.is_quiet();
    println!("checked {} keys", tried.len());
}

#[test]
fn the_legend_is_the_reports_counters_and_the_address_keeps_the_state() {
    let mut browser = Browser::start();
    let mut checked = 0;
    for case in seven() {
        let counters = case.frame().counters;
        let (_folder, path) = file(&case.html());
        browser.open(&path, "");
        let legend =
            browser.eval("[...document.querySelectorAll('#legend button span')].map((e) => e.textContent)");
        let expected: Vec<String> = edgewalk_model::Activity::ALL
            .into_iter()
            .filter(|cause| counters.spent(*cause) > 0)
            .map(|cause| {
                let spent = counters.spent(cause);
                let share = (spent * 2000 + counters.cycles) / (2 * counters.cycles);
                format!("{} {spent} ({}.{} %)", cause.name(), share / 10, share % 10)
            })
            .collect();
        assert_eq!(legend, serde_json::json!(expected), "{}", case.name);
        checked += expected.len();
        browser.eval("app.go(321); app.choose([31, 20]); app.setHex(true)");
        let hash = browser.eval("new Promise((done) => setTimeout(() => done(location.hash), 400))");
        assert_eq!(hash, "#c=321&px=31,20&hex");
        let before = browser.eval("document.body.innerText");
        browser.open(&path, "#c=321&px=31,20&hex");
        let after = browser.eval("document.body.innerText");
        let lines = |text: &serde_json::Value| {
            text.as_str().map(|text| text.lines().map(str::to_owned).collect::<Vec<_>>())
        };
        let (before, after) = (lines(&before).expect("text"), lines(&after).expect("text"));
        let differs = before.iter().zip(&after).find(|(a, b)| a != b);
        assert!(
            differs.is_none() && before.len() == after.len(),
            "{}: the address opens another state: {differs:?}",
            case.name
        );
        let spoken = browser.eval("document.getElementById('live').textContent");
        let says = browser.eval("[...document.querySelectorAll('#says div span')].map((e) => e.textContent)");
        for sentence in says.as_array().into_iter().flatten().filter_map(|text| text.as_str()) {
            assert!(spoken.as_str().is_some_and(|spoken| spoken.contains(sentence)), "{spoken}: {sentence}");
        }
    }
    browser.is_quiet();
    println!("checked {checked} causes");
    assert!(checked >= 16);
}
