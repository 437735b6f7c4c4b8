//! Registers that hold states, as Yosys' `fsm_detect` finds them.

use super::graph::QuickMap;
use super::words::{Bit, Cell, Memory, ONE, Register, StateMachine, Words};
use edgewalk_netlist::ops::Op;

/// States that are given a flip-flop each; more are counted in binary.
const ONE_HOT: usize = 32;

/// State machines among the registers.
pub(super) fn state_machines(words: &Words) -> Vec<StateMachine> {
    let cells: QuickMap<Bit, &Cell> = words.cells.iter().map(|cell| (cell.first, cell)).collect();
    let mut found = Vec::new();
    for (register, of) in words.registers.iter().enumerate().filter(|(_, of)| of.width >= 2) {
        let own: Vec<Bit> = (of.first..of.first + of.width as Bit).collect();
        let mut states = Vec::new();
        states.extend(of.reset);
        let mut tree = Vec::new();
        let fits = of
            .updates
            .iter()
            .all(|(_, value)| choice_of_states(words, &cells, words.at(value), &own, &mut states, &mut tree));
        states.sort_unstable();
        states.dedup();
        if fits && (2..=ONE_HOT).contains(&states.len()) && is_only_compared(words, &own, &tree) {
            found.push(StateMachine { register, states });
        }
    }
    found
}

/// Whether a word is a constant, the register itself, or a choice of such; its constants and choices are collected.
fn choice_of_states(
    words: &Words,
    cells: &QuickMap<Bit, &Cell>,
    word: &[Bit],
    own: &[Bit],
    states: &mut Vec<u128>,
    tree: &mut Vec<Bit>,
) -> bool {
    if word.iter().all(|bit| *bit <= ONE) {
        states.push(word.iter().rev().fold(0, |value, bit| value << 1 | u128::from(*bit)));
        return true;
    }
    if word == own || tree.contains(&word[0]) {
        return true;
    }
    let Some(cell) = cells.get(&word[0]).filter(|cell| cell.op == Op::Mux && cell.width == word.len()) else {
        return false;
    };
    if !word.iter().enumerate().all(|(at, bit)| *bit == cell.first + at as Bit) {
        return false;
    }
    tree.push(word[0]);
    cell.operands[1..].iter().all(|place| choice_of_states(words, cells, words.at(place), own, states, tree))
}

/// The register has two kinds of readers only: comparisons of the whole register with constants, and its own choices.
fn is_only_compared(words: &Words, own: &[Bit], tree: &[Bit]) -> bool {
    let (first, width) = (own[0], own.len() as Bit);
    let reads = |bits: &[Bit]| bits.iter().any(|bit| bit.wrapping_sub(first) < width);
    let cell = |cell: &Cell| {
        let [a, b] = match &cell.operands[..] {
            [a, b] => [words.at(a), words.at(b)],
            operands => {
                return tree.contains(&cell.first) || !operands.iter().any(|place| reads(words.at(place)));
            }
        };
        let fixed = |word: &[Bit]| word.iter().all(|bit| *bit <= ONE);
        let compared =
            matches!(cell.op, Op::Eq | Op::Ne) && ((a == own && fixed(b)) || (b == own && fixed(a)));
        compared || !(reads(a) || reads(b))
    };
    let register = |of: &Register| {
        of.first == own[0]
            || !of.updates.iter().any(|(when, value)| reads(when.as_slice()) || reads(words.at(value)))
    };
    let memory = |of: &Memory| {
        let written = of.writes.iter().any(|(enable, address, data)| {
            reads(&[*enable]) || reads(words.at(address)) || reads(words.at(data))
        });
        !written && !of.reads.iter().any(|(enable, address, _)| reads(&[*enable]) || reads(words.at(address)))
    };
    !reads(&words.outputs)
        && words.cells.iter().all(cell)
        && words.registers.iter().all(register)
        && words.memories.iter().all(memory)
}
