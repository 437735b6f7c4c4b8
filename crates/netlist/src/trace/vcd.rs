//! VCD: the text format that every viewer reads.

use std::io::{self, Write};

use vcd::{IdCode, ScopeItem, TimescaleUnit, Value, Var, VarType, Writer};

use super::watch::{CYCLE, Labels, Scope, Watch, everything};
use crate::simulate::Simulator;

/// A VCD being written.
pub struct VcdTrace<'w> {
    writer: Writer<Box<dyn Write + 'w>>,
    watch: Watch,
    clk: IdCode,
    ids: Vec<IdCode>,
    text_ids: Vec<IdCode>,
}

impl<'w> VcdTrace<'w> {
    /// Writes the header; `top` is the name of the outermost scope.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(out: Box<dyn Write + 'w>, sim: &Simulator, top: &str, labels: &[Labels]) -> io::Result<Self> {
        let (scope, watch) = everything(sim, top, labels);
        let mut writer = Writer::new(out);
        writer.timescale(1, TimescaleUnit::NS)?;
        let clk = IdCode::FIRST;
        let mut free = std::iter::successors(Some(clk.next()), |id| Some(id.next()));
        let ids: Vec<IdCode> = free.by_ref().take(watch.widths().len()).collect();
        let text_ids: Vec<IdCode> = free.take(watch.text_widths().len()).collect();
        let mut top = vcd_scope(&scope, &ids, watch.widths(), &text_ids);
        top.items.insert(0, ScopeItem::Var(Var::new(VarType::Wire, 1, clk, "clk".into(), None)));
        writer.scope(&top)?;
        writer.enddefinitions()?;
        Ok(VcdTrace { writer, watch, clk, ids, text_ids })
    }

    /// Writes the signals as they are in this cycle; to be called once a cycle, before the tick.
    ///
    /// # Errors
    /// Those of the output.
    pub fn sample(&mut self, sim: &mut Simulator) -> io::Result<()> {
        let now = self.watch.now();
        self.writer.timestamp(now)?;
        self.writer.change_scalar(self.clk, true)?;
        let changes = self.watch.changes(sim);
        for (place, bits) in changes.bits {
            let values: Vec<Value> = bits.bytes().map(|bit| Value::from(bit == b'1')).collect();
            match values[..] {
                [bit] => self.writer.change_scalar(self.ids[place], bit)?,
                _ => self.writer.change_vector(self.ids[place], values)?,
            }
        }
        for (place, text) in changes.texts {
            self.writer.change_string(self.text_ids[place], &text)?;
        }
        self.writer.timestamp(now + CYCLE / 2)?;
        self.writer.change_scalar(self.clk, false)
    }

    /// Lets a cycle pass in place of a sample: nothing is written of it, and the next sample is a cycle later.
    pub fn pass(&mut self) {
        self.watch.pass();
    }

    /// Ends the last cycle.
    ///
    /// # Errors
    /// Those of the output.
    pub fn finish(mut self) -> io::Result<()> {
        self.writer.timestamp(self.watch.now())?;
        self.writer.flush()
    }
}

fn vcd_scope(scope: &Scope, ids: &[IdCode], widths: &[u32], text_ids: &[IdCode]) -> vcd::Scope {
    let variable = |(name, place): &(String, usize)| {
        ScopeItem::Var(Var::new(VarType::Wire, widths[*place], ids[*place], name.clone(), None))
    };
    let text = |(name, place): &(String, usize)| {
        ScopeItem::Var(Var::new(VarType::String, 1, text_ids[*place], name.clone(), None))
    };
    let inner = scope.scopes.iter().map(|inner| ScopeItem::Scope(vcd_scope(inner, ids, widths, text_ids)));
    let mut result = vcd::Scope::new(vcd::ScopeType::Module, scope.name.clone());
    result.items =
        scope.variables.iter().map(variable).chain(scope.texts.iter().map(text)).chain(inner).collect();
    result
}
