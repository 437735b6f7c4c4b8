//! How far a point lies beside the axis of the light.

use edgewalk_netlist::{Module, Signal};

use super::made::Results;
use super::turns::Turns;
use crate::roots::Roots;

/// A point beside the axis.
pub(super) struct Beside<'m> {
    /// Place in table C, 2^-16, of the fragment in `here`.
    pub place: Signal<'m>,
    /// The fragment in `there` lies outside the cone.
    pub dark: Signal<'m>,
}

impl<'m> Beside<'m> {
    /// `word`: the word of the tables that comes.
    pub fn new(
        m: &'m Module,
        roots: &Roots<'m>,
        word: Signal<'m>,
        turns: &Turns<'m>,
        results: &Results<'m>,
    ) -> Beside<'m> {
        m.comment("Place beside the cone's axis.");
        let beside = (m.lit(19, 1 << 16) - results.axis.here().sext(19))
            .named_doc("beside", "1 - cosine to the axis, 2^-16");
        // Set below 0, and from 2.0 on, which no EDGE lights: there any place will do.
        let other = beside.bit(17);
        let place = other.mux(0, beside.bit(16).mux(m.lit(16, 0xffff), beside.trunc(16)));
        let place = place.named_doc("place_beside", "entry of table C");
        let edge = m.reg("cone_edge", 17).doc("the cone's edge: light falls where beside is at most this");
        edge.when(roots.comes & !roots.taken.any(), word.slice(32, 16));
        let dark = !beside.msb() & edge.q().zext(18).lt(beside.trunc(18));
        Beside { place, dark: turns.between("dark", "the fragment in there lies outside the cone", dark) }
    }
}
