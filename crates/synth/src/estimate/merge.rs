//! Look-up tables that Yosys' `opt_lut` joins with those of carry chains: a sum's table has an input to spare, and a
//! sum without a carry out may take in the table before it.

use super::build::Built;
use super::cover::Cover;
use super::family::Family;
use super::graph::{Lit, Node};

/// Inputs of a table.
const INPUTS: usize = 4;

/// By node: the table behind a sum that the sum's own table computes, or the table before a sum that lies in it.
pub(super) struct Merges {
    /// By node of a table: the sum before it, whose table does both.
    pub behind: Vec<Option<u32>>,
    /// By node of a table: it lies in the table of the sum behind it.
    pub before: Vec<bool>,
}

/// Finds them.
pub(super) fn merges(built: &Built, cover: &Cover) -> Merges {
    let nodes = &built.graph.nodes;
    let mut found = Merges { behind: vec![None; nodes.len()], before: vec![false; nodes.len()] };
    if built.graph.family == Family::Ecp5 {
        return found; // no tables lie in a carry chain
    }
    let mut taken = vec![false; nodes.len()];
    for (index, table) in cover.tables.iter().enumerate() {
        let Some(table) = table else { continue };
        for leaf in table.leaves() {
            let Node::Sum(place) = nodes[*leaf as usize] else { continue };
            if cover.readers[*leaf as usize] != 1 || taken[*leaf as usize] {
                continue;
            }
            let others = table.leaves().iter().filter(|other| *other != leaf).map(|node| node * 2);
            if together(built.graph.carries[place as usize].inputs, others) <= INPUTS {
                found.behind[index] = Some(*leaf);
                taken[*leaf as usize] = true;
                break;
            }
        }
    }
    for (index, node) in nodes.iter().enumerate() {
        let Node::Sum(place) = node else { continue };
        let carries_on = nodes.get(index + 1) == Some(&Node::Carry(*place)) && cover.live[index + 1];
        if !cover.live[index] || carries_on || taken[index] {
            continue;
        }
        let inputs = built.graph.carries[*place as usize].inputs;
        for input in &inputs[..2] {
            let before = (input >> 1) as usize;
            let Some(table) = &cover.tables[before] else { continue };
            if cover.readers[before] != 1 || found.behind[before].is_some() {
                continue;
            }
            let rest = [inputs[0], inputs[1], inputs[2]].map(|other| if other == *input { 0 } else { other });
            if together(rest, table.leaves().iter().map(|node| node * 2)) <= INPUTS {
                found.before[before] = true;
                break;
            }
        }
    }
    found
}

/// How many different signals these are, constants left out.
fn together(inputs: [Lit; 3], others: impl Iterator<Item = Lit>) -> usize {
    let mut all: Vec<Lit> = inputs.into_iter().chain(others).filter(|lit| *lit > 1).collect();
    all.sort_unstable();
    all.dedup();
    all.len()
}
