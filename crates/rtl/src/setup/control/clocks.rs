//! How many clocks an operation takes, as far as the machine decides it.

use edgewalk_machine::{Channel, Plan};

use crate::setup::steps::{Length, Op, channel_of, most_scale, round_clocks};

/// Clocks of the longest operation, 4 at least: so long the state STORE lasts.
pub(super) fn longest(plan: &Plan) -> u32 {
    Op::all(plan).map(|op| clocks(plan, op)).max().unwrap_or(1).max(4)
}

/// Clocks of an operation that does not depend on the triangle; of one that doubles the most.
fn clocks(plan: &Plan, op: Op) -> u32 {
    match op.doing().length {
        Length::Clocks(clocks) => clocks,
        Length::Digits => 1,
        Length::Doublings(number) => most_clocks(plan, number),
        Length::Scaled(number) => most_clocks(plan, number) + most_scale(plan),
    }
}

/// Clocks in which an operation doubles in a round; 0 of one that does not.
pub(super) fn doubling_clocks(plan: &Plan, op: Op, round: usize) -> u32 {
    match op.doing().length {
        Length::Doublings(doublings) | Length::Scaled(doublings) => {
            round_clocks(plan, doublings, op.is_of_edge(plan), round)
        }
        Length::Clocks(_) | Length::Digits => 0,
    }
}

/// Clocks of the channel that is doubled the most.
fn most_clocks(plan: &Plan, doublings: fn(&Plan, &Channel) -> u32) -> u32 {
    plan.planes().map(|(_, channel)| doublings(plan, channel).div_ceil(2)).max().unwrap_or(1)
}

/// Pairs of digits of the longest vertex value in a round.
pub(super) fn pairs(plan: &Plan, round: usize) -> u32 {
    let channels = (0..plan.lanes as usize).filter_map(|lane| channel_of(plan, lane, round));
    channels.map(|channel| channel.vertex_bits().div_ceil(2)).max().unwrap_or(1)
}

/// Pairs of digits of a difference of coordinates.
pub(super) fn edge_pairs(plan: &Plan) -> u32 {
    (plan.widths().difference - 1).div_ceil(2)
}
