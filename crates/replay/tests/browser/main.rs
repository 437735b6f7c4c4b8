//! The page in a browser, headless Chromium off the network: what it shows is what the model does, every control does what
//! it says, nothing overlaps, and faults put into the page are found.

mod case;
mod checks;
mod chromium;
mod made_up;
mod names;
mod text;

use case::{Case, Triangle, file, five, icosahedron, machine};
use checks::{Checked, pictures, shown_text};
use chromium::Browser;
use edgewalk_machine::Machine;
use edgewalk_model::{DrawState, Stalls};
use edgewalk_replay::lesson::{SCREEN, triangle};
use edgewalk_replay::{LIMIT, RecordError, Replay, Window, lesson, page, record};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[test]
fn the_page_shows_the_model_at_thirty_cycles_of_five_machines() {
    let mut browser = Browser::start();
    for case in five() {
        let compared = shown_text(&mut browser, &case, &case.html())
            .unwrap_or_else(|why| panic!("{}: {why}", case.name));
        println!("{}: {compared} texts", case.name);
        assert!(compared > 3000, "{compared}");
    }
    browser.is_quiet();
}

#[test]
fn the_last_picture_is_the_models_and_time_runs_back() {
    let mut browser = Browser::start();
    for case in five() {
        let compared =
            pictures(&mut browser, &case, &case.html()).unwrap_or_else(|why| panic!("{}: {why}", case.name));
        println!("{}: {compared} values", case.name);
        assert!(compared > 12_000);
    }
    browser.is_quiet();
}

/// Faults of the page: what is replaced, and by what.
const MUTANTS: [(&str, &str, &str); 4] = [
    (
        "two columns exchanged",
        "for (const id of row.cells) {\n        if (this.kindOf(id))",
        "for (const id of row.cells.length === 5 ? [row.cells[1], row.cells[0], ...row.cells.slice(2)] : row.cells) {\n        if (this.kindOf(id))",
    ),
    (
        "a cycle late",
        "const own = rawAt(register, cycle);\n      const live",
        "const own = rawAt(register, Math.max(0, cycle - 1));\n      const live",
    ),
    (
        "writes are not undone",
        "this.paint(view, this.pixelOf(list.numbers[i]), list.before[i])",
        "this.paint(view, this.pixelOf(list.numbers[i]), i)",
    ),
    ("signed read as unsigned", "if (!shape.signed) return raw;", "return raw;"),
];

#[test]
fn faults_of_the_page_are_found() {
    let mut browser = Browser::start();
    let case = &five()[0];
    let html = case.html();
    let check = |browser: &mut Browser, html: &str| -> Checked {
        Ok(shown_text(browser, case, html)? + pictures(browser, case, html)?)
    };
    for (name, from, to) in MUTANTS {
        assert_eq!(html.matches(from).count(), 1, "{name}: the page has changed");
        let mutant = html.replace(from, to);
        // Exchanged columns show every value once more, in the wrong place.
        let found = check(&mut browser, &mutant).and_then(|_| columns(&mut browser, &mutant));
        println!("{name}: {found:?}");
        assert!(found.is_err(), "{name} is not found");
    }
    columns(&mut browser, &html).expect("the columns of the page itself");
}

/// Every cell of a table stands below its name.
fn columns(browser: &mut Browser, html: &str) -> Checked {
    let (_folder, path) = file(html);
    browser.open(&path, "");
    let wrong = browser.eval(
        "[...document.querySelectorAll('.card td.value[data-register]:not([data-field])')].filter((cell) => {
            const head = cell.closest('table').tHead.rows[0].cells[cell.cellIndex].textContent;
            const row = cell.parentElement.cells[0].textContent;
            return app.doc.registers[cell.dataset.register].name !== `${row}.${head}`;
        }).length",
    );
    match wrong.as_u64() {
        Some(0) => Ok(1),
        other => Err(format!("{other:?} cells stand below another name")),
    }
}

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
    for case in [&five()[0], &five()[3]] {
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
    let case = &five()[0];
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
    std::thread::sleep(std::time::Duration::from_millis(700));
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
    for case in five() {
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

/// The faults of the layout: what is cut off, what lies over another, what sticks out.
const LAYOUT: &str = "(() => {
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
    if (!e.offsetParent || e.closest('#cards') === e || e.closest('#past') === e || e.id === 'live' || hidden(e) || e.tagName === 'INPUT' || e.tagName === 'CANVAS') continue;
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
    for case in five() {
        let (_folder, path) = file(&case.html());
        for (width, height) in [(900, 700), (1400, 900)] {
            browser.size(width, height);
            browser.open(&path, "#px=31,20");
            for dark in ["light", "dark"] {
                let scheme =
                    serde_json::json!({ "features": [{ "name": "prefers-color-scheme", "value": dark }] });
                browser.ask("Emulation.setEmulatedMedia", scheme);
                let cycles = browser.eval("app.doc.cycles").as_u64().expect("cycles");
                let mut places: Option<serde_json::Value> = None;
                for k in 0..50 {
                    let cycle = k * (cycles - 1) / 49;
                    let now = browser.eval(&format!(
                        "app.go({cycle}); [...document.querySelectorAll('.card, .gutter, #cards, #planes .panel')].map((e) => {{
                          const box = e.getBoundingClientRect(); return [box.left, box.top, box.width, box.height].map(Math.round); }})"
                    ));
                    if let Some(places) = &places {
                        assert_eq!(
                            *places, now,
                            "{}, {width} wide: a card moves in cycle {cycle}",
                            case.name
                        );
                    }
                    places = Some(now);
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
    assert!(checked == 5 * 2 * 2 * 50);
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
    let case = &five()[0];
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

/// Milliseconds until the first state stands, and of a step, median; bytes of the page.
fn measure(browser: &mut Browser, html: &str) -> (f64, f64) {
    let (_folder, path) = file(html);
    let open = browser.open(&path, "").as_secs_f64() * 1e3;
    let step = browser.eval(
        "(() => { const times = []; const middle = Math.floor(app.doc.cycles / 2);
          for (let k = 0; k < 101; k++) { const begun = performance.now(); app.go(middle + k); times.push(performance.now() - begun); }
          return times.sort((a, b) => a - b)[50]; })()",
    );
    (open, step.as_f64().expect("a time"))
}

/// What is promised, with room for a busy machine; the figures are printed.
#[test]
fn small_and_quick() {
    let mut browser = Browser::start();
    let case = &five()[0];
    let html = case.html();
    measure(&mut browser, &html);
    let (open, step) = measure(&mut browser, &html);
    println!("20 triangles on 64x48: {} bytes, first state {open:.0} ms, step {step:.1} ms", html.len());
    assert!(
        html.len() <= 300_000 && open < 4000.0 && step < 64.0,
        "{} bytes, {open} ms, {step} ms",
        html.len()
    );
    let plan = machine(
        Machine::default(),
        &[("screen.width", "320"), ("screen.height", "240"), ("interpolator.adders", "1")],
    );
    let triangles: Vec<Triangle> = [0, 1, 2].into_iter().flat_map(|_| icosahedron(&plan)).collect();
    let large = Case { name: "large", plan, triangles, stalls: Stalls::NONE };
    let all = record(&large.plan, &large.triangles, DrawState::default(), Stalls::NONE, Window::default());
    assert!(matches!(all, Err(RecordError::TooLong { .. })), "too small to try the limit");
    let recording = large.recording(Window { from: 0, to: Some(LIMIT - 1) });
    let html = page::html(&large.replay(&recording).json());
    let (open, step) = measure(&mut browser, &html);
    println!("{LIMIT} cycles on 320x240: {} bytes, first state {open:.0} ms, step {step:.1} ms", html.len());
    assert_eq!(browser.eval("app.doc.cycles").as_u64(), Some(LIMIT));
    assert!(html.len() <= 5_000_000, "{} bytes", html.len());
    browser.is_quiet();
}

#[test]
fn the_lesson_has_its_check_marks() {
    let mut browser = Browser::start();
    let mut checked = 0;
    for (name, machine) in
        [("lesson", Machine::default()), ("textbook", Machine::preset("textbook").expect("a preset"))]
    {
        let html = lesson_page(machine);
        let (_folder, path) = file(&html);
        browser.size(1400, 900);
        browser.open(&path, "");
        let count = browser.eval("app.doc.lesson.length").as_u64().expect("steps");
        for step in 0..count {
            let marks = browser.eval(&format!(
                "app.lesson.step({step}); [document.querySelectorAll('#lesson .same').length, document.querySelectorAll('#lesson .other').length]"
            ));
            assert_eq!(marks[1], 0, "{name}, step {step}");
            checked += marks[0].as_u64().unwrap_or_default();
        }
        let faults = browser.eval(LAYOUT);
        assert_eq!(faults, serde_json::json!([]), "{name}");
        browser.eval("app.lesson.step(0)");
        browser.key("]", false);
        assert_eq!(browser.eval("app.lesson.at"), 1);
        browser.key("[", false);
        assert_eq!(browser.eval("app.lesson.at"), 0);
    }
    browser.is_quiet();
    println!("checked {checked} check marks");
    assert!(checked > 150);
}

fn lesson_page(machine: Machine) -> String {
    let plan = Machine { width: SCREEN.0, height: SCREEN.1, ..machine }.plan().expect("can be built");
    let corners = [triangle(&plan).expect("on the screen")];
    let recording =
        record(&plan, &corners, DrawState::default(), Stalls::NONE, Window::default()).expect("recorded");
    let lesson = lesson(&plan, &corners[0], &recording, 1).expect("it is drawn");
    let replay = Replay {
        plan: &plan,
        scene: "lesson",
        triangles: &corners,
        of: 1,
        recording: &recording,
        truth: &[],
        command: None,
        difference: None,
        lesson: Some(&lesson),
    };
    page::html(&replay.json())
}

#[test]
fn a_replay_of_another_version_is_refused_in_words() {
    let mut browser = Browser::start();
    let case = &five()[0];
    let html = case.html();
    for (from, to, word) in [
        ("\"version\":[1,0]", "\"version\":[2,0]", "version 2.0; this page shows version 1"),
        ("\"format\":\"edgewalk-replay\"", "\"format\":\"other\"", "This is no replay: its format is other"),
    ] {
        assert_eq!(html.matches(from).count(), 1);
        let (_folder, path) = file(&html.replace(from, to));
        browser.open(&path, "");
        let said = browser.eval("document.getElementById('difference').textContent");
        assert!(said.as_str().is_some_and(|said| said.contains(word)), "{said}");
    }
    let (_folder, path) = file(&html.replace("\"version\":[1,0]", "\"version\":[1,7],\"later\":{}"));
    browser.open(&path, "");
    assert_eq!(browser.eval("app.cycle"), 0, "a later minor version is shown");
}

/// The pictures of `docs/replay.md`: with EDGEWALK_BLESS=1 they are drawn anew. Fonts differ from system to system, so
/// they are not compared.
#[test]
fn pictures_for_the_documentation() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let wanted: [PathBuf; 4] =
        ["replay", "replay-drain", "replay-dark", "lesson"].map(|name| docs.join(format!("{name}.png")));
    if std::env::var_os("EDGEWALK_BLESS").is_some() {
        let mut browser = Browser::start();
        let cases = five();
        for (place, (html, hash, scheme)) in [
            (cases[0].html(), "#c=1503&px=31,20", "light"),
            (cases[2].html(), "#c=1200&px=31,20", "light"),
            (cases[3].html(), "#c=4003&px=31,20", "dark"),
            (lesson_page(Machine::default()), "", "light"),
        ]
        .into_iter()
        .enumerate()
        {
            let (_folder, path) = file(&html);
            browser.size(1400, 1060);
            let scheme =
                serde_json::json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
            browser.ask("Emulation.setEmulatedMedia", scheme);
            browser.open(&path, hash);
            if hash.is_empty() {
                browser.eval("app.lesson.step(9)");
            }
            std::fs::write(&wanted[place], browser.screenshot()).expect("written");
        }
    }
    for path in wanted {
        let start = std::fs::read(&path).map(|bytes| bytes[..8].to_vec()).unwrap_or_default();
        assert_eq!(start, b"\x89PNG\r\n\x1a\n", "{}", path.display());
    }
}
