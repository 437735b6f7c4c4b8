//! Registers with the enable that `opt_dff` finds, and state machines with a flip-flop a state.

use super::builder::Builder;
use super::graph::{FALSE, Lit, Node, QuickMap, TRUE};
use super::words::{Bit, ONE, Register};

impl Builder<'_> {
    pub fn register(&mut self, register: &Register) {
        if self.states.contains_key(&register.first) {
            return self.state_machine(register);
        }
        let updates: Vec<(Lit, Vec<Lit>, &[Bit])> = register
            .updates
            .iter()
            .map(|(when, value)| {
                (when.map_or(TRUE, |when| self.lit(when)), self.word(value), self.words.at(value))
            })
            .collect();
        let one_way = updates.len() == 1;
        for at in 0..register.width {
            let bit = register.first + at as Bit;
            if self.known.contains_key(&bit) {
                continue;
            }
            let q = self.lits[bit as usize];
            let (mut d, mut enable) = (q, FALSE);
            let mut chosen = !one_way;
            for (when, value, bits) in &updates {
                let own = self.words.chosen[bits[at] as usize];
                chosen |= own;
                let (when, value) = if own { self.held(*when, value[at], q) } else { (*when, value[at]) };
                d = if enable == FALSE { value } else { self.graph.mux(when, value, d) };
                enable = self.graph.or(enable, when);
            }
            let reset = register.reset.map(|value| value >> at & 1 == 1);
            self.drive(q, d, enable, reset, chosen);
        }
    }

    /// What drives a state machine's flip-flops.
    fn state_machine(&mut self, register: &Register) {
        for (state, q) in self.states[&register.first].clone() {
            if !matches!(self.graph.nodes[(q >> 1) as usize], Node::Register(_)) {
                continue; // found to be constant, or equal to another
            }
            let (mut d, mut enable) = (q, FALSE);
            let mut known = QuickMap::default();
            for (when, value) in &register.updates {
                let when = when.map_or(TRUE, |when| self.lit(when));
                let value = self.becomes(self.words.at(value), state, q, register.first, &mut known);
                let (when, value) = self.held(when, value, q);
                d = if enable == FALSE { value } else { self.graph.mux(when, value, d) };
                enable = self.graph.or(enable, when);
            }
            self.drive(q, d, enable, register.reset.map(|reset| reset == state), true);
        }
    }

    /// Whether a choice of states is this one.
    fn becomes(
        &mut self,
        word: &[Bit],
        state: u128,
        q: Lit,
        first: Bit,
        known: &mut QuickMap<Bit, Lit>,
    ) -> Lit {
        if word[0] == first {
            return q;
        }
        if word.iter().all(|bit| *bit <= ONE) {
            let value = word.iter().rev().fold(0, |value, bit| value << 1 | u128::from(*bit == ONE));
            return Lit::from(value == state);
        }
        if let Some(lit) = known.get(&word[0]) {
            return *lit;
        }
        let Some(cell) = self.choices.get(&word[0]).copied() else { return q };
        let operands = &self.words.cells[cell].operands;
        let [c, t, e] = [0, 1, 2].map(|at| self.words.at(&operands[at]));
        let c = self.lit(c[0]);
        let (t, e) = (self.becomes(t, state, q, first, known), self.becomes(e, state, q, first, known));
        let lit = self.graph.mux(c, t, e);
        known.insert(word[0], lit);
        lit
    }
}
