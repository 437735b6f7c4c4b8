//! VCD: the text format that every viewer reads.

use std::io::{self, Write};

use vcd::{IdCode, ScopeItem, TimescaleUnit, Value, Var, VarType, Writer};

use super::watch::{CYCLE, Scope, Watch, everything};
use crate::simulate::Simulator;

/// A VCD being written.
pub struct VcdTrace<W: Write> {
    writer: Writer<W>,
    watch: Watch,
    clk: IdCode,
    ids: Vec<IdCode>,
}

impl<W: Write> VcdTrace<W> {
    /// Writes the header; `top` is the name of the outermost scope.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(out: W, sim: &Simulator, top: &str) -> io::Result<Self> {
        let (scope, watch) = everything(sim, top);
        let mut writer = Writer::new(out);
        writer.timescale(1, TimescaleUnit::NS)?;
        let clk = IdCode::FIRST;
        let ids: Vec<IdCode> = std::iter::successors(Some(clk.next()), |id| Some(id.next()))
            .take(watch.widths().len())
            .collect();
        let mut top = vcd_scope(&scope, &ids, watch.widths());
        top.items.insert(0, ScopeItem::Var(Var::new(VarType::Wire, 1, clk, "clk".into(), None)));
        writer.scope(&top)?;
        writer.enddefinitions()?;
        Ok(VcdTrace { writer, watch, clk, ids })
    }

    /// Writes the signals as they are in this cycle; to be called once a cycle, before the tick.
    ///
    /// # Errors
    /// Those of the output.
    pub fn sample(&mut self, sim: &mut Simulator) -> io::Result<()> {
        let now = self.watch.now();
        self.writer.timestamp(now)?;
        self.writer.change_scalar(self.clk, true)?;
        for (place, bits) in self.watch.changes(sim) {
            let values: Vec<Value> = bits.bytes().map(|bit| Value::from(bit == b'1')).collect();
            match values[..] {
                [bit] => self.writer.change_scalar(self.ids[place], bit)?,
                _ => self.writer.change_vector(self.ids[place], values)?,
            }
        }
        self.writer.timestamp(now + CYCLE / 2)?;
        self.writer.change_scalar(self.clk, false)
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

fn vcd_scope(scope: &Scope, ids: &[IdCode], widths: &[u32]) -> vcd::Scope {
    let variable = |(name, place): &(String, usize)| {
        ScopeItem::Var(Var::new(VarType::Wire, widths[*place], ids[*place], name.clone(), None))
    };
    let inner = scope.scopes.iter().map(|inner| ScopeItem::Scope(vcd_scope(inner, ids, widths)));
    let mut result = vcd::Scope::new(vcd::ScopeType::Module, scope.name.clone());
    result.items = scope.variables.iter().map(variable).chain(inner).collect();
    result
}
