//! The inputs of a lane.

use edgewalk_netlist::{Module, Signal};

use super::Shape;
use crate::setup::steps::Step;

/// The inputs of a lane, by their names.
pub(super) struct Inputs<'m> {
    pub read_at: Signal<'m>,
    pub step: Signal<'m>,
    pub number: Signal<'m>,
    pub digits: Signal<'m>,
    pub write: Signal<'m>,
    pub write_at: Signal<'m>,
    pub whole_in: Signal<'m>,
    pub take_modulus: Signal<'m>,
    pub modulus_in: Signal<'m>,
    pub modulus_short: Signal<'m>,
    pub give: Signal<'m>,
    pub nearest: Signal<'m>,
    pub upwards: Signal<'m>,
    pub negate: Signal<'m>,
}

impl<'m> Inputs<'m> {
    /// The ports.
    pub fn new(m: &'m Module, shape: Shape) -> Inputs<'m> {
        Inputs {
            read_at: m.input_doc("read_at", 3, "slot of the addend, two clocks before its step"),
            step: m.input_doc("step", Step::BITS, "valid a clock before the step"),
            number: m.input_doc("number", shape.number, "to take in, signed; with its step"),
            digits: m.input_doc(
                "digits",
                2,
                "digits of a number outside ±M, or its sign twice; valid with their step",
            ),
            write: m.input_doc("write", 1, "the result of the step goes to a slot"),
            write_at: m.input("write_at", 3),
            whole_in: m.input_doc(
                "whole_in",
                shape.whole,
                "whole number to add to a result, a clock before value",
            ),
            take_modulus: m.input_doc("take_modulus", 1, "two clocks before the first step with it"),
            modulus_in: m.input_doc("modulus_in", shape.modulus, "-M, or -M - 1 if modulus_short; signed"),
            modulus_short: m.input("modulus_short", 1),
            give: m.input_doc("give", 1, "an operation has ended; a clock later value is its result"),
            nearest: m.input_doc(
                "nearest",
                1,
                "value is rounded to nearest, halves up; a clock before it, with rest_out",
            ),
            upwards: m.input_doc("upwards", 1, "1: round up; 0: cut"),
            negate: m.input_doc("negate", 1, "value is negated, once it is rounded"),
        }
    }
}
