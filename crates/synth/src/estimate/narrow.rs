//! Top bits of words without a reader, as Yosys' `wreduce` finds them. A bit that is not computed reads nothing.

use super::words::{Bit, Words};
use edgewalk_netlist::ops::Op;
use std::ops::Range;

/// Removes bits without a reader. Each removal may leave other bits without a reader, so it repeats until none is left.
pub(super) fn narrow(words: &mut Words) {
    let mut cells: Vec<usize> = words.cells.iter().map(|cell| cell.width).collect();
    let mut registers: Vec<usize> = words.registers.iter().map(|register| register.width).collect();
    let Words { users, operands, .. } = words;
    loop {
        let mut changed = false;
        for (register, width) in words.registers.iter().zip(&mut registers) {
            let read = top(users, register.first, *width);
            for (when, value) in &register.updates {
                release(users, &operands[value.clone()], read, *width);
                if let (0, 1.., Some(when)) = (read, *width, when) {
                    users[*when as usize] -= 1;
                }
            }
            changed |= read < *width;
            *width = read;
        }
        for (cell, width) in words.cells.iter().zip(&mut cells).rev() {
            let read = top(users, cell.first, *width);
            if read == *width {
                continue;
            }
            for (place, operand) in cell.operands.iter().enumerate() {
                let operand: &Range<usize> = operand;
                let bits = &operands[operand.clone()];
                match cell.op {
                    Op::Add | Op::Sub | Op::Neg | Op::And | Op::Or | Op::Xor | Op::Not => {
                        release(users, bits, read, *width);
                    }
                    Op::Mux if place > 0 => release(users, bits, read, *width),
                    _ if read == 0 => release(users, bits, 0, bits.len()),
                    _ => {}
                }
            }
            changed = true;
            *width = read;
        }
        if !changed {
            return;
        }
    }
}

/// How many of the lowest bits there are up to the last that somebody reads.
fn top(users: &[u32], first: Bit, width: usize) -> usize {
    let own = &users[first as usize..first as usize + width];
    own.iter().rposition(|users| *users > 0).map_or(0, |last| last + 1)
}

/// A reader of the bits from `from` to `to` is gone.
fn release(users: &mut [u32], bits: &[Bit], from: usize, to: usize) {
    for bit in bits.iter().take(to).skip(from) {
        users[*bit as usize] -= 1;
    }
}
