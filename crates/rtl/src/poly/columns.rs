//! The columns of a pair that lie on the screen.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use crate::light_pass::LightPass;

/// Columns from a first one to before another.
pub(super) struct Columns<'m> {
    pub first: Signal<'m>,
    pub behind: Signal<'m>,
    /// There are some.
    pub some: Signal<'m>,
}

impl<'m> Columns<'m> {
    /// The columns between a left and a right edge. Of the pixel of a line both are its column, which is not cut.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        light_pass: LightPass<'m>,
        [left, right]: [Signal<'m>; 2],
        thin: Option<Signal<'m>>,
    ) -> Columns<'m> {
        let width = light_pass.number(m, left.width(), plan.width.into(), plan.shadow.size.into());
        let beyond = |column: Signal<'m>| !column.msb() & column.ge(width);
        let beyond_right = beyond(right).named_doc("right_cut", "the pair ends beside the screen");
        let before_left = left.msb().named_doc("left_cut", "the pair begins beside the screen");
        let right_of_first = !right.msb() & right.any();
        let some =
            (left.slt(right) & !beyond(left) & right_of_first).named_doc("some_columns", "of the screen");
        let whole = |cut: Signal<'m>| thin.map_or(cut, |thin| cut & !thin);
        Columns {
            first: whole(before_left).mux(0, left).named("first"),
            behind: whole(beyond_right).mux(width, right).named("behind"),
            some: thin.map_or(some, |thin| thin | some),
        }
    }
}
