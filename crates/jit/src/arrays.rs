//! Choices among registers by a number. The register that the number names is read where it lies, instead of
//! reading all of them and then choosing.

use edgewalk_netlist::Op;

use crate::graph::{Graph, Kind, ValueId};
use crate::sign_extended::Signs;

/// Registers of the same form, of which a number names one.
#[derive(Clone, Debug)]
pub(crate) struct Array {
    /// The number.
    pub index: ValueId,
    /// The register that each number names.
    pub registers: Vec<ValueId>,
}

impl Array {
    /// By a bit.
    pub fn of_two(graph: &Graph, signs: &Signs, id: ValueId) -> Option<Array> {
        let &[index, one, zero] = graph.as_op(id, Op::Mux)? else { return None };
        let [one, zero] = [one, zero].map(|arm| leaf(graph, signs, arm));
        Array { index, registers: vec![zero?, one?] }.if_alike(graph, signs)
    }

    /// By a number: of a choice by a bit that is this for each number, between registers or arrays of that
    /// number.
    pub fn of_choice(
        graph: &Graph,
        signs: &Signs,
        id: ValueId,
        index: ValueId,
        bits: &[u128],
        array: impl Fn(ValueId) -> Option<Array>,
    ) -> Option<Array> {
        let &[_, one, zero] = graph.as_op(id, Op::Mux)? else { return None };
        let [one, zero] = [one, zero].map(|arm| match leaf(graph, signs, arm) {
            Some(register) => Some(vec![register; bits.len()]),
            None => array(arm).filter(|array| array.index == index).map(|array| array.registers),
        });
        let arms = one?.into_iter().zip(zero?);
        let registers = bits.iter().zip(arms).map(|(bit, (one, zero))| if *bit == 1 { one } else { zero });
        Array { index, registers: registers.collect() }.if_alike(graph, signs)
    }

    /// The array, if all are kept in the same form.
    fn if_alike(self, graph: &Graph, signs: &Signs) -> Option<Array> {
        let first = self.registers[0];
        let is_alike = |register: &ValueId| {
            signs.has(*register) == signs.has(first)
                && (!signs.has(first) || graph.width(*register) == graph.width(first))
        };
        self.registers.iter().all(is_alike).then_some(self)
    }
}

/// A register or an input, of a word or less: as it is, or with zeros above that the state has there anyway.
fn leaf(graph: &Graph, signs: &Signs, value: ValueId) -> Option<ValueId> {
    let register = match graph.kind(value) {
        Kind::Op(Op::ZeroExtend(_), operands) if !signs.has(operands[0]) => operands[0],
        _ => value,
    };
    let are_words = [value, register].iter().all(|value| (2..=64).contains(&graph.width(*value)));
    (are_words && *graph.kind(register) == Kind::Stored).then_some(register)
}
