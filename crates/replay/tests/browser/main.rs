//! The page in a browser, headless Chromium off the network: what it shows is what the model does, every control does what
//! it says, nothing overlaps, and faults put into the page are found.

mod case;
mod checks;
mod chromium;
mod hands;
mod layout;
mod lesson;
mod made_up;
mod names;
mod text;

use case::{Case, Triangle, file, icosahedron, machine, seven};
use checks::{Checked, pictures, shown_text};
use chromium::Browser;
use edgewalk_machine::Machine;
use edgewalk_model::{DrawState, Stalls};
use edgewalk_replay::{LIMIT, RecordError, Window, page, record};
use lesson::lesson_page;
use std::path::{Path, PathBuf};

#[test]
fn the_page_shows_the_model_at_thirty_cycles_of_seven_machines() {
    let mut browser = Browser::start();
    for case in seven() {
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
    for case in seven() {
        let compared =
            pictures(&mut browser, &case, &case.html()).unwrap_or_else(|why| panic!("{}: {why}", case.name));
        println!("{}: {compared} values", case.name);
        assert!(compared > 12_000);
    }
    browser.is_quiet();
}

#[test]
fn a_map_that_the_machine_draws_is_shown() {
    let mut browser = Browser::start();
    let case = Case::own_map();
    let html = case.html();
    let (texts, values) = (shown_text(&mut browser, &case, &html), pictures(&mut browser, &case, &html));
    let texels = map_shown(&mut browser, &case).unwrap_or_else(|why| panic!("{why}"));
    println!("{texts:?} texts, {values:?} values, {texels} texels");
    assert!(texts.is_ok_and(|texts| texts > 3000) && values.is_ok_and(|values| values > 12_000));
    assert_eq!(texels, 16 * 16);
    browser.is_quiet();
}

/// The map behind the last cycle, texel by texel.
fn map_shown(browser: &mut Browser, case: &Case) -> Checked {
    let shown = browser.eval(
        "app.go(app.doc.cycles - 1); (() => { const v = app.planes.views.find((v) => v.plane.map);
          return Array.from(v.top, (write, pixel) => [app.planes.valueAt(v, 0, write, pixel), write]); })()",
    );
    let (mut compared, mut written) = (0, 0);
    for (texel, depth) in case.frame().maps[0].iter().enumerate() {
        if shown[texel][0].as_u64() != Some(u64::from(*depth)) {
            return Err(format!("texel {texel} is {}, not {depth}", shown[texel][0]));
        }
        written += u64::from(shown[texel][1].as_i64() >= Some(0));
        compared += 1;
    }
    if written < 20 { Err(format!("{written} texels were drawn")) } else { Ok(compared) }
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
        "this.paint(view, this.pixelOf(list.numbers[i], list.page), list.before[i])",
        "this.paint(view, this.pixelOf(list.numbers[i], list.page), i)",
    ),
    ("signed read as unsigned", "if (!shape.signed) return raw;", "return raw;"),
];

#[test]
fn faults_of_the_page_are_found() {
    let mut browser = Browser::start();
    let case = &seven()[0];
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
    let case = &seven()[0];
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
    let large = Case { triangles, ..Case::of("large", plan) };
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
fn a_replay_of_another_version_is_refused_in_words() {
    let mut browser = Browser::start();
    let case = &seven()[0];
    let html = case.html();
    for (from, to, word) in [
        ("\"version\":[1,2]", "\"version\":[2,0]", "version 2.0; this page shows version 1"),
        ("\"format\":\"edgewalk-replay\"", "\"format\":\"other\"", "This is no replay: its format is other"),
    ] {
        assert_eq!(html.matches(from).count(), 1);
        let (_folder, path) = file(&html.replace(from, to));
        browser.open(&path, "");
        let said = browser.eval("document.getElementById('difference').textContent");
        assert!(said.as_str().is_some_and(|said| said.contains(word)), "{said}");
    }
    let (_folder, path) = file(&html.replace("\"version\":[1,2]", "\"version\":[1,7],\"later\":{}"));
    browser.open(&path, "");
    assert_eq!(browser.eval("app.cycle"), 0, "a later minor version is shown");
}

/// The pictures of `docs/replay.md`: with EDGEWALK_BLESS=1 they are drawn anew. Fonts differ from system to system, so
/// they are not compared.
#[test]
fn pictures_for_the_documentation() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let wanted: [PathBuf; 5] = ["replay", "replay-drain", "replay-dark", "replay-poly", "lesson"]
        .map(|name| docs.join(format!("{name}.png")));
    if std::env::var_os("EDGEWALK_BLESS").is_some() {
        let mut browser = Browser::start();
        let cases = seven();
        for (place, (html, hash, scheme)) in [
            (cases[0].html(), "#c=1503&px=31,20", "light"),
            (cases[2].html(), "#c=1200&px=31,20", "light"),
            (cases[3].html(), "#c=4003&px=31,20", "dark"),
            (Case::polygon().html(), "#c=720&px=20,30", "light"),
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
