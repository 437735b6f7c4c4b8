//! A triangle that comes word by word.

use edgewalk_machine::Channel;
use edgewalk_netlist::Signal;

use super::Parts;
use super::code::{FIRST_VALUE, PART_BITS, ROW_BITS, VERTICES};
use super::control::Control;

/// What the words do.
pub(super) struct Input<'m> {
    /// The row that a word goes to.
    pub row: Signal<'m>,
    /// A word is taken.
    pub fires: Signal<'m>,
    /// A word of this lane is taken.
    pub takes: Vec<Signal<'m>>,
    /// The word as its row has it.
    pub taken: Vec<Signal<'m>>,
    /// The last word of a triangle is taken.
    pub last: Signal<'m>,
    /// k_t, if the triangle has one: its last word.
    pub kt: Option<Signal<'m>>,
}

/// Counts the words of a triangle.
pub(super) fn words<'m>(
    parts: &Parts<'_, 'm>,
    control: &Control<'m>,
    valid: Signal<'m>,
    data: Signal<'m>,
) -> Input<'m> {
    let Parts { m, plan, .. } = *parts;
    m.comment("The words of a triangle.");
    let vertex = m.reg("vertex", 2).doc("of the word that comes; 3: behind the vertices").reset(0);
    let part = m.reg("part", PART_BITS).doc("of the vertex: x, y, the channels").reset(0);
    let fires = (valid & control.idle).named("fires");
    let channels = plan.channels().len() as u128;
    let closes = part.q().eq(FIRST_VALUE + channels - 1).named_doc("closes", "the last word of a vertex");
    let last = match plan.has_triangle_kt() {
        true => fires & vertex.q().eq(3),
        false => fires & vertex.q().eq(2) & closes,
    };
    let last = last.named_doc("last", "the last word of a triangle");
    part.when(fires, closes.mux(0, part.q() + 1)).when(last, 0);
    vertex.when(fires & closes, vertex.q() + 1).when(last, 0);
    control.full.when(last, 1);

    let lanes = plan.lanes as usize;
    let coordinate = part.q().lt(FIRST_VALUE).named("coordinate");
    let channel = (part.q() - FIRST_VALUE).named("channel");
    let lane_bits = plan.lanes.ilog2();
    // Lane l has the channels l, l + lanes, …: the first of them at its first place.
    let round = channel.shr(lane_bits) + FIRST_VALUE;
    let place = coordinate.mux(part.q(), round);
    let row = m.cat(&[m.lit(2, 2), vertex.q(), place]);
    debug_assert_eq!((row.width(), 2 << (ROW_BITS - 2)), (ROW_BITS, VERTICES));
    let takes = (0..lanes).map(|lane| {
        if lanes == 1 {
            return fires;
        }
        fires & (coordinate | channel.trunc(lane_bits).eq(lane as u128))
    });
    let taken = (0..lanes).map(|lane| taken(parts, lane, data, coordinate, channel));
    Input {
        row,
        fires,
        takes: takes.collect(),
        taken: taken.collect(),
        last,
        kt: plan.has_triangle_kt().then_some(data),
    }
}

/// A word with its sign, of coordinates in units of their last bit.
fn taken<'m>(
    parts: &Parts<'_, 'm>,
    lane: usize,
    data: Signal<'m>,
    coordinate: Signal<'m>,
    channel: Signal<'m>,
) -> Signal<'m> {
    let plan = parts.plan;
    let bits = super::shape::shape(plan, parts.program, lane).rest;
    let xy = data.trunc(plan.widths().vertex).sext(bits);
    let xy = if plan.subpixel_bits == 0 { xy.shl(1) } else { xy };
    let extended = |channel: &Channel| {
        let value = data.trunc(channel.vertex_bits());
        if channel.kind.is_signed() { value.sext(bits) } else { value.zext(bits) }
    };
    let format = |channel: &Channel| (channel.vertex_bits(), channel.kind.is_signed());
    let own: Vec<_> = plan.channels().iter().enumerate().skip(lane).step_by(plan.lanes as usize).collect();
    let Some(((_, first), others)) = own.split_first() else { return xy };
    let mut value = extended(first);
    for (number, other) in others.iter().filter(|(_, other)| format(other) != format(first)) {
        value = channel.eq(*number as u128).mux(extended(other), value);
    }
    coordinate.mux(xy, value)
}
