//! Word lengths of the lanes, and the rows that are there from the start.

use edgewalk_machine::sequencer::{Program, rounds};
use edgewalk_machine::{Channel, EdgeKind, Plan};

use super::code::{FIRST_VALUE, PART_BITS, VERTICES};
use super::lane::Shape;

/// Bits of a factor: what is sheared may be twice as long as a difference.
pub(super) fn factor_bits(plan: &Plan) -> u32 {
    plan.widths().difference + 1
}

/// Bits of W below a whole column: F + 1 of a slope edge, which is rounded as twice its value, else 0.
pub(super) fn below_column(plan: &Plan) -> u32 {
    match plan.edge_kind {
        EdgeKind::Exact => 0,
        EdgeKind::Slope => plan.edge_fraction + 1,
    }
}

/// Doublings of a channel: t + r - e.
pub(super) fn doublings(plan: &Plan, channel: &Channel) -> u32 {
    plan.widths().center_fraction + channel.fraction - channel.vertex_fraction
}

/// The channels of a lane, each with its round.
pub(super) fn channels(plan: &Plan, lane: usize) -> impl Iterator<Item = (usize, &Channel)> {
    plan.channels().iter().skip(lane).step_by(plan.lanes as usize).enumerate()
}

/// The most doublings of a channel of each round.
pub(super) fn most_doublings(plan: &Plan) -> Vec<u32> {
    let of_round = |round: usize| {
        let lanes = (0..plan.lanes as usize).filter_map(|lane| channels(plan, lane).nth(round));
        lanes.map(|(_, channel)| doublings(plan, channel)).max().unwrap_or(0)
    };
    (0..rounds(plan)).map(of_round).collect()
}

/// The shape of a lane.
pub(super) fn shape(plan: &Plan, program: &Program, lane: usize) -> Shape {
    let t = plan.widths().center_fraction;
    let of_values = plan.channels().iter().map(|channel| channel.vertex_bits() + 5).max().unwrap_or(0);
    let rest = (2 * plan.widths().difference).max(of_values);
    let word = channels(plan, lane).map(|(_, channel)| channel.word() + t).max().unwrap_or(1);
    // The fourth lane has no edge: the program takes columns from its W, and nothing reads them.
    let below_column = if lane < 3 { below_column(plan) } else { 0 };
    let whole = word.max(factor_bits(plan) + below_column);
    let mut raises: Vec<u32> = channels(plan, lane).map(|(_, channel)| doublings(plan, channel)).collect();
    raises.sort_unstable();
    raises.dedup();
    Shape {
        rest,
        whole,
        factor: factor_bits(plan),
        center_fraction: t,
        below_column,
        raises,
        constants_a: constants(plan, program),
        constants_w: firsts(plan, lane, whole),
    }
}

/// Whole numbers.
fn constants(plan: &Plan, program: &Program) -> Vec<(usize, u128, String)> {
    let p = 1u128 << plan.widths().center_fraction;
    let mut found: Vec<(usize, u128, String)> = Vec::new();
    let mut hold = |name: &str, index: u8, value: u128| {
        let pass = if index > 0 { " of the map" } else { "" };
        found.push((usize::from(program.row(name) + index), value, format!("{name}{pass}")));
    };
    hold("one", 0, 1);
    hold("half", 0, p / 2);
    hold("up", 0, p / 2 - 1);
    hold("pixel", 0, p);
    hold("height", 0, u128::from(plan.height) * p);
    hold("width", 0, u128::from(plan.width) * p);
    if plan.shadow.draws_map() {
        hold("height", 1, u128::from(plan.shadow.size) * p);
        hold("width", 1, u128::from(plan.shadow.size) * p);
    }
    found
}

/// What each channel of the lane adds to its first value: P/2, and half P.
fn firsts(plan: &Plan, lane: usize, bits: u32) -> Vec<(usize, u128, String)> {
    let p = 1u128 << plan.widths().center_fraction;
    let first = |(round, channel): (usize, &Channel)| {
        let rounds = channel.kind.is_rounded() && channel.fraction > 0;
        let half = if rounds { 1u128 << (channel.fraction - 1) } else { 0 };
        let place = (VERTICES | 3 << PART_BITS | FIRST_VALUE) as usize + round;
        (place, (p / 2 + half * p) & ((1 << bits) - 1), format!("k.{}", channel.name))
    };
    channels(plan, lane).map(first).collect()
}
