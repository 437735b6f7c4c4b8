//! The lesson as a page of text.

use super::{Lesson, Part};
use std::fmt::Write as _;

/// `docs/lesson.md`, of this lesson. Writing to a string cannot fail.
#[must_use]
pub fn markdown(lesson: &Lesson) -> String {
    let mut text = String::from(
        "# One triangle through the machine\n\n\
         Every number follows from the three corners by the formulae of [the specification](machine.md), computed\n\
         exactly. Beside it stand the value of the machine's register and the cycle. `edgewalk replay --lesson --out\n\
         lesson.html` shows the numbers beside the machine at work. Written by `EDGEWALK_BLESS=1 cargo test --release -p\n\
         edgewalk-replay --test lesson`.\n",
    );
    for (number, step) in lesson.steps.iter().enumerate() {
        let sections: Vec<String> = step.sections.iter().map(|n| format!("§{n}")).collect();
        _ = write!(
            text,
            "\n## {}. {}\n{}, cycle {}\n",
            number + 1,
            step.title,
            sections.join(", "),
            step.cycle
        );
        let mut rows = false;
        for part in &step.parts {
            match part {
                Part::Text(words) => {
                    _ = write!(text, "\n{}\n", wrapped(words));
                    rows = false;
                }
                Part::Number { formula, value, check } => {
                    text += if rows { "" } else { "\n| number | value | the machine |\n|---|---|---|\n" };
                    rows = true;
                    let held = check.as_ref().map_or_else(String::new, |check| {
                        let sign = if check.expected == check.found { "✓" } else { "✗" };
                        format!("{sign} `{}` = {}", check.name, check.shown)
                    });
                    _ = writeln!(text, "| `{formula}` | {value} | {held} |");
                }
            }
        }
    }
    text
}

/// Characters of a line of a page.
const WIDTH: usize = 118;

/// A paragraph in lines of at most 118 characters, for a page in Markdown; a longer word has a line of its own.
#[must_use]
pub fn wrapped(paragraph: &str) -> String {
    let mut lines = vec![String::new()];
    for word in paragraph.split(' ') {
        let (last, characters) = (lines.len() - 1, word.chars().count());
        let length = lines[last].chars().count();
        if length == 0 {
            lines[last] += word;
        } else if length + 1 + characters <= WIDTH {
            lines[last] += &format!(" {word}");
        } else {
            lines.push(word.to_owned());
        }
    }
    lines.join("\n")
}
