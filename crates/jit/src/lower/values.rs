//! Values in the form in which they are asked for. Each is computed when it is asked for first (`demand`),
//! and known from then on where the cursor stands.

use cranelift_codegen::cursor::FuncCursor;
use cranelift_codegen::ir::{InstBuilder, Value, types};

use super::changes::Changes;
use super::cursor::{ODD, StateCursor};
use super::known::Known;
use super::lowered::Lowered;
use super::plan::Plan;
use crate::graph::{Graph, Kind, ValueId};
use crate::layout::Place;
use crate::sink::Sink;

/// Values as far as they are computed where the cursor stands.
pub(super) struct Values<'a> {
    pub plan: &'a Plan,
    pub cursor: StateCursor<'a>,
    pub known: Known,
    pub sink: Sink,
    pub changes: Changes,
}

impl<'a> Values<'a> {
    /// Nothing is known yet; the cursor stands in the function's first block.
    pub fn new(plan: &'a Plan, cursor: FuncCursor<'a>, address: Value, has_vectors: bool) -> Values<'a> {
        let graph = &plan.design.graph;
        Values {
            plan,
            cursor: StateCursor::new(cursor, address, has_vectors),
            known: Known::new(graph),
            sink: Sink::new(graph),
            changes: Changes::new(graph),
        }
    }

    /// The values and where they come from.
    pub fn graph(&self) -> &'a Graph {
        &self.plan.design.graph
    }

    /// A step begins that asks for these values.
    pub fn look(&mut self, asked: Vec<ValueId>) {
        let Values { plan, known, sink, .. } = self;
        sink.look(&plan.design.graph, &plan.tables, asked, |value| known.get(value).is_some());
    }

    /// The value has to be worked out in this step, not looked up or read again.
    pub fn is_worked_out(&self, value: ValueId) -> bool {
        self.known.get(value).is_none()
            && self.plan.tables.get(value).is_none()
            && !self.known.is_shared(value)
    }

    /// The value with zeros above its bits.
    pub fn zero(&mut self, value: ValueId) -> Value {
        let lowered = self.demand(value);
        if let Some(zero) = lowered.zero {
            return zero;
        }
        let width = self.graph().width(value);
        let zero = if lowered.bits <= width { lowered.any } else { self.cursor.masked(lowered.any, width) };
        self.known.set(value, Lowered { zero: Some(zero), ..lowered });
        zero
    }

    /// The value with zeros above its bits, a bit too as a word.
    pub fn word(&mut self, value: ValueId) -> Value {
        if self.graph().width(value) > 1 {
            return self.zero(value);
        }
        match self.demand(value) {
            Lowered { word: Some(word), bits: 0..=1, .. } => word,
            Lowered { word: Some(word), .. } => self.cursor.masked(word, 1),
            _ => {
                let zero = self.zero(value);
                self.cursor.ins().uextend(types::I64, zero)
            }
        }
    }

    /// A bit as a word with anything above, if it is known as one.
    pub fn known_word(&self, bit: ValueId) -> Option<Value> {
        self.known.get(bit).filter(|bit| !bit.is_kept)?.word
    }

    /// Neither looked up nor kept.
    pub fn is_worked_out_here(&self, value: ValueId) -> bool {
        self.plan.tables.get(value).is_none() && !self.known.is_shared(value)
    }

    /// A bit that decides something: not 0 if it is 1. One that lies in the state is tested there, each time
    /// anew.
    pub fn condition(&mut self, bit: ValueId) -> Value {
        match self.tested_in_place(bit) {
            Some(place) => self.cursor.test_bit(place),
            None => self.zero(bit),
        }
    }

    /// Where a bit lies in the state, if it is not in a register of the host already.
    pub fn tested_in_place(&self, bit: ValueId) -> Option<Place> {
        let lies = self.known.get(bit).is_none_or(|known| known.is_kept)
            && matches!(self.graph().kind(bit), Kind::Stored)
            && self.changes.of(bit).is_none();
        self.plan.layout.of(bit).filter(|place| lies && place.width == 1 && ODD == 1)
    }

    /// The value with copies of its sign above its bits.
    pub fn sign(&mut self, value: ValueId) -> Value {
        let lowered = self.demand(value);
        if let Some(sign) = lowered.sign {
            return sign;
        }
        let width = self.graph().width(value);
        let sign = match lowered.range {
            Some(range) if range.is_signed(width.min(64)) => lowered.any,
            _ => self.cursor.sign_extended(lowered.any, width),
        };
        self.known.set(value, Lowered { sign: Some(sign), ..lowered });
        sign
    }

    /// The value is there for the steps that follow, if they share it.
    pub fn work_out(&mut self, value: ValueId) {
        self.demand(value);
    }

    /// The value with anything above its bits.
    pub fn any(&mut self, value: ValueId) -> Lowered {
        self.demand(value)
    }

    /// Stores a value, with zeros above its bits, in a place of its width.
    pub fn store(&mut self, value: ValueId, place: Place) {
        let zero = self.zero(value);
        self.cursor.write(zero, place);
    }
}
