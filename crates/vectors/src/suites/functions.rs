//! The dots of `suites/functions.toml`, and each bit of a depth: every depth function lets some pass and others not.

use super::pen::{Pen, case};
use super::{Case, ladders};
use edgewalk_machine::Plan;
use serde::Deserialize;

const FILE: &str = include_str!("../../suites/functions.toml");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    case: Vec<Dots>,
}

/// A case of the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Dots {
    name: String,
    /// Column, line, depth in fifteenths of full scale.
    dots: Vec<[f64; 3]>,
}

pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    let pen = Pen::new(machine);
    #[allow(clippy::expect_used)]
    let file: File = toml::from_str(FILE).expect("a part of the program, read by every test of it");
    let dot = |[x, y, z]: &[f64; 3]| pen.dot(*x, *y, z / 15.0);
    let of_file = file.case.iter().map(|dots| case(&dots.name, dots.dots.iter().map(dot)));
    of_file.chain([ladders::down(&pen, 0.0, 4.0), ladders::up(&pen, 2.0, 4.0)]).collect()
}
