//! C programs: the example of `docs/c.md` beside the model, and calls that must fail.

use crate::support::{c, must};
use edgewalk_machine::{Machine, Plan};
use edgewalk_model::{DrawState, Stalls, render};

const EXAMPLE: &str = "docs/c/triangle.c";

/// The triangle of the example.
const TRIANGLE: [[f64; 6]; 3] =
    [[20.0, 10.0, 0.5, 1.0, 0.0, 0.0], [90.0, 30.0, 0.4, 0.0, 1.0, 0.0], [40.0, 75.0, 0.3, 0.0, 0.0, 1.0]];

fn small() -> Plan {
    Machine::preset("small").expect("a preset").plan().expect("can be built")
}

#[test]
fn triangle_of_the_example_is_the_models() {
    let folder = tempfile::tempdir().expect("a folder");
    let (code, said) = c(folder.path(), EXAMPLE);
    assert_eq!(code, Some(0), "{said}");
    let plan = small();
    let corner = |[x, y, z, r, g, b]: [f64; 6]| plan.port_vertex(x, y, &[z, r, g, b]).expect("on the screen");
    let drawn =
        render(&plan, [TRIANGLE.map(corner)], DrawState::default(), Stalls::NONE).expect("its vertices");

    let (mut z, mut rgb) = (vec![plan.z.max(); drawn.z.len()], vec![[0; 3]; drawn.z.len()]);
    let (writes, clocks) = said.trim_end().rsplit_once('\n').expect("lines");
    for line in writes.lines() {
        let words: Vec<u64> = line.split(' ').map(|word| word.parse().expect("a number")).collect();
        let (x, y) = (words[0] & ((1 << plan.widths().x) - 1), words[0] >> plan.widths().x);
        let at = (y * u64::from(plan.width) + x) as usize;
        (z[at], rgb[at]) = (words[1], [words[2], words[3], words[4]]);
    }
    let covered = drawn.coverage.iter().filter(|count| **count > 0).count();
    assert_eq!((writes.lines().count(), covered > 1000), (covered, true));
    assert!(z == drawn.z && rgb == drawn.rgb);
    assert_eq!(clocks, format!("{} clocks", drawn.counters.cycles));
}

#[test]
fn calls_that_must_fail_give_code_and_message() {
    let folder = tempfile::tempdir().expect("a folder");
    let (code, said) = c(folder.path(), "crates/capi/tests/calls.c");
    assert_eq!(code, Some(0), "{said}");
    let lines: Vec<&str> = said.lines().collect();
    let wanted = [
        "1 name: NULL; permitted: a pointer",
        "1 machine: NULL; permitted: a pointer",
        "1 name: invalid utf-8 sequence of 1 bytes from index 0; permitted: UTF-8",
        "2 unknown preset smal; permitted: ",
        "2 line 1: unclosed table, expected ",
        "2 line 2: screen.width = 0 is not permitted (1 to 8192)",
        "1 machine: NULL; permitted: a pointer",
        "1 frame: NULL; permitted: a pointer",
        "1 lines: NULL; permitted: a pointer",
        "1 vertices: NULL; permitted: a pointer",
        "1 pixels: 1; permitted: 38400, for a screen of 240x160",
        "3 frame:2: T vertex 1 z: `NaN`: permitted: ",
        "3 frame:2: T vertex 1 z: `NaN`: permitted: ",
        "3 frame:2: depth: `les`: permitted: ",
        "1 run: NULL; permitted: a pointer",
        "4 unknown port wr_adr; permitted: tri_valid, ",
        "4 word: 1; permitted: 0 to 0, as wr_addr has 16 bits",
        "1 value: NULL; permitted: a pointer",
        "1 run: NULL; permitted: a pointer",
        "checked 19",
    ];
    for (line, wanted) in lines.iter().zip(wanted) {
        assert!(line.starts_with(wanted), "wanted {wanted}\n found {line}");
    }
    assert_eq!(lines.len(), wanted.len(), "{said}");
}

/// Pictures, ids and clocks of a frame drawn at once are those of its ticks.
#[test]
fn picture_is_that_of_the_ticks() {
    let folder = tempfile::tempdir().expect("a folder");
    let (code, said) = c(folder.path(), "crates/capi/tests/picture.c");
    assert_eq!(
        (code, &*said),
        (Some(0), "checked 38400 pixels, 0 differ; 2075 written by triangle 1\n"),
        "{said}"
    );
}

#[test]
fn header_is_cpp_too() {
    must("c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -x c++ crates/capi/edgewalk.h");
}

#[test]
fn page_shows_the_example() {
    let page = include_str!("../../../docs/c.md");
    let example = include_str!("../../../docs/c/triangle.c");
    assert!(page.contains(&format!("```c\n{example}```\n")));
}
