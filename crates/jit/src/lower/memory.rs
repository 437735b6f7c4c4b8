//! Reads and writes of memories.

use cranelift_codegen::cursor::Cursor;
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Type, Value, types};

use super::lowered::lane;
use super::program::Lowering;
use crate::design::Write;
use crate::graph::ValueId;
use crate::layout::Area;

impl Lowering<'_> {
    /// What a port's output takes: the word at the address, or 0 where there is none.
    pub(super) fn read(&mut self, memory: usize, port: usize) -> (ValueId, Value) {
        let (read, area) = (self.design.memories[memory].reads[port], self.v.plan.layout.memories[memory]);
        let (index, is_there) = self.index(read.addr, area);
        let ty = lane(area.width);
        let zero = self.v.cursor.constant(types::I64, 0);
        let index = is_there.map_or(index, |is_there| self.v.cursor.ins().select(is_there, index, zero));
        let address = self.address(index, area);
        let (flags, offset, ins) = (memory_flags(), area.offset, self.v.cursor.ins());
        let word = match (ty, area.word) {
            (types::I64, 1) => ins.uload8(ty, flags, address, offset),
            (types::I64, 2) => ins.uload16(ty, flags, address, offset),
            (types::I64, 4) => ins.uload32(flags, address, offset),
            _ => ins.load(ty, flags, address, offset),
        };
        let zero = self.v.cursor.constant(ty, 0);
        let word = is_there.map_or(word, |is_there| self.v.cursor.ins().select(is_there, word, zero));
        (read.q, word)
    }

    /// The word at the address, if there is one, becomes the data if the port is enabled.
    pub(super) fn write(&mut self, port: Write, area: Area, wakes: u64) {
        self.only_if(port.en, |lowering| {
            let (index, is_there) = lowering.index(port.addr, area);
            let next = lowering.v.cursor.func.dfg.make_block();
            if let Some(is_there) = is_there {
                let block = lowering.v.cursor.func.dfg.make_block();
                lowering.v.cursor.ins().brif(is_there, block, &[], next, &[]);
                lowering.v.cursor.insert_block(block);
            }
            let data = lowering.v.zero(port.data);
            let data = lowering.v.cursor.resized(data, stored_as(area));
            let address = lowering.address(index, area);
            lowering.v.cursor.ins().store(memory_flags(), data, address, area.offset);
            lowering.v.wake(wakes);
            lowering.v.cursor.ins().jump(next, &[]);
            lowering.v.cursor.insert_block(next);
        });
    }

    /// The number of a word, and whether there is such a word, if that is a question.
    fn index(&mut self, addr: ValueId, area: Area) -> (Value, Option<Value>) {
        let bits = self.v.graph().width(addr);
        let addr = self.v.zero(addr);
        // An address has no more bits than the words need.
        let is_there = (area.words != 1 << bits).then(|| {
            let limit = self.v.cursor.constant(lane(bits), area.words as u128);
            self.v.cursor.ins().icmp(IntCC::UnsignedLessThan, addr, limit)
        });
        (self.v.cursor.resized(addr, types::I64), is_there)
    }

    /// Where a word lies, short of the area's offset.
    fn address(&mut self, index: Value, area: Area) -> Value {
        let shift = self.v.cursor.constant(types::I64, area.word.ilog2().into());
        let bytes = self.v.cursor.ins().ishl(index, shift);
        let state = self.v.cursor.state;
        self.v.cursor.ins().iadd(state, bytes)
    }
}

/// The type of a word in the state.
fn stored_as(area: Area) -> Type {
    match area.word {
        1 => types::I8,
        2 => types::I16,
        4 => types::I32,
        8 => types::I64,
        _ => types::I128,
    }
}

/// No access traps: an index is below the number of words.
fn memory_flags() -> MemFlagsData {
    MemFlagsData::new().with_notrap()
}
