//! The lesson's page.

use crate::case::file;
use crate::chromium::Browser;
use crate::layout::LAYOUT;
use edgewalk_machine::{Counted, Machine};
use edgewalk_model::{DrawState, Stalls};
use edgewalk_replay::lesson::polygon::{polygon, polygon_lesson};
use edgewalk_replay::lesson::{SCREEN, triangle};
use edgewalk_replay::{Replay, Window, lesson, page, record};

#[test]
fn the_lesson_has_its_check_marks() {
    let mut browser = Browser::start();
    let mut checked = 0;
    let preset = |name: &str| Machine::preset(name).expect("a preset");
    for (name, machine) in
        [("lesson", Machine::default()), ("textbook", preset("textbook")), ("polygon", preset("polygon"))]
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

pub fn lesson_page(machine: Machine) -> String {
    let plan = Machine { width: SCREEN.0, height: SCREEN.1, ..machine }.plan().expect("can be built");
    let corners = match plan.polygon.is_there() {
        true => polygon(&plan).expect("on the screen"),
        false => vec![triangle(&plan).expect("on the screen")],
    };
    let recording =
        record(&plan, &corners, DrawState::default(), Stalls::NONE, Window::default()).expect("recorded");
    let lesson = match plan.polygon.is_there() {
        true => polygon_lesson(&plan, &corners, &recording, 1),
        false => lesson(&plan, &corners[0], &recording, 1),
    };
    let lesson = lesson.expect("it is drawn");
    let replay = Replay {
        plan: &plan,
        scene: "lesson",
        triangles: &corners,
        drawn: Counted::of(&corners),
        of: Counted::of(&corners),
        recording: &recording,
        truth: &[],
        command: None,
        difference: None,
        lesson: Some(&lesson),
    };
    page::html(&replay.json())
}
