//! FST: the compressed format of GTKWave and Surfer, for long runs.

use std::io::{Seek, Write};

use fst_writer::{
    FstBodyWriter, FstFileType, FstHeaderWriter, FstInfo, FstScopeType, FstSignalId, FstSignalType,
    FstVarDirection, FstVarType, FstWriteError,
};

use super::watch::{CYCLE, Labels, Scope, Watch, everything};
use crate::simulate::Simulator;

/// Bytes of changes kept in memory before they are written.
const LARGEST_BUFFER: usize = 32 << 20;

/// An FST being written.
pub struct FstTrace<W: Write + Seek> {
    writer: FstBodyWriter<W>,
    watch: Watch,
    clk: FstSignalId,
    ids: Vec<FstSignalId>,
    /// With the bits of each.
    text_ids: Vec<(FstSignalId, usize)>,
}

impl<W: Write + Seek> FstTrace<W> {
    /// Writes the header; `top` is the name of the outermost scope.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(out: W, sim: &Simulator, top: &str, labels: &[Labels]) -> Result<Self, FstWriteError> {
        let (scope, watch) = everything(sim, top, labels);
        let info = FstInfo {
            start_time: 0,
            timescale_exponent: -9,
            version: "edgewalk".into(),
            date: String::new(), // the same run gives the same file
            file_type: FstFileType::Verilog,
        };
        let mut header = FstHeaderWriter::new(out, &info)?;
        let mut ids = vec![None; watch.widths().len()];
        let text_bits: Vec<usize> = watch.text_widths().iter().map(|characters| 8 * characters).collect();
        let mut text_ids = vec![None; text_bits.len()];
        header.scope(&scope.name, "", FstScopeType::Module)?;
        let clk = variable(&mut header, "clk", 1, None)?;
        declare(&mut header, &scope, watch.widths(), &mut ids, &text_bits, &mut text_ids)?;
        header.up_scope()?;
        // Every signal has at least one name, so none is left out.
        let ids = ids.into_iter().flatten().collect();
        let text_ids = text_ids.into_iter().flatten().collect();
        Ok(FstTrace { writer: header.finish()?, watch, clk, ids, text_ids })
    }

    /// Writes the signals as they are in this cycle; to be called once a cycle, before the tick.
    ///
    /// # Errors
    /// Those of the output.
    pub fn sample(&mut self, sim: &mut Simulator) -> Result<(), FstWriteError> {
        let now = self.watch.now();
        self.writer.time_change(now)?;
        self.writer.signal_change(self.clk, b"1")?;
        let changes = self.watch.changes(sim);
        for (place, bits) in changes.bits {
            self.writer.signal_change(self.ids[place], bits.as_bytes())?;
        }
        for (place, text) in changes.texts {
            let (id, width) = self.text_ids[place];
            let bits: String = text.bytes().map(|byte| format!("{byte:08b}")).collect();
            self.writer.signal_change(id, format!("{bits:0>width$}").as_bytes())?;
        }
        self.writer.time_change(now + CYCLE / 2)?;
        self.writer.signal_change(self.clk, b"0")?;
        if self.writer.size() > LARGEST_BUFFER {
            self.writer.flush()?;
        }
        Ok(())
    }

    /// Lets a cycle pass in place of a sample: nothing is written of it, and the next sample is a cycle later.
    pub fn pass(&mut self) {
        self.watch.pass();
    }

    /// Ends the last cycle.
    ///
    /// # Errors
    /// Those of the output.
    pub fn finish(mut self) -> Result<(), FstWriteError> {
        self.writer.time_change(self.watch.now())?;
        self.writer.finish().map(drop)
    }
}

/// The variables of an open scope and all scopes in it.
fn declare<W: Write + Seek>(
    header: &mut FstHeaderWriter<W>,
    scope: &Scope,
    widths: &[u32],
    ids: &mut [Option<FstSignalId>],
    text_bits: &[usize],
    text_ids: &mut [Option<(FstSignalId, usize)>],
) -> Result<(), FstWriteError> {
    for (name, place) in &scope.variables {
        ids[*place] = Some(variable(header, name, widths[*place], ids[*place])?);
    }
    for (name, place) in &scope.texts {
        let bits = text_bits[*place];
        text_ids[*place] = Some((variable(header, name, bits as u32, None)?, bits)); // a short name
    }
    for inner in &scope.scopes {
        header.scope(&inner.name, "", FstScopeType::Module)?;
        declare(header, inner, widths, ids, text_bits, text_ids)?;
        header.up_scope()?;
    }
    Ok(())
}

fn variable<W: Write + Seek>(
    header: &mut FstHeaderWriter<W>,
    name: &str,
    width: u32,
    alias: Option<FstSignalId>,
) -> Result<FstSignalId, FstWriteError> {
    let of = FstSignalType::bit_vec(width);
    header.var(name, of, FstVarType::Wire, FstVarDirection::Implicit, alias)
}
