//! SAIF: the text format of transitions that power tools read (IEEE 1801, annex I).

use std::io::{self, Write};

use super::transitions::{Net, Transitions};
use super::watch::{CYCLE, Scope};

impl Transitions {
    /// Writes a SAIF file: an entry for each bit with the nanoseconds at 0 and at 1 and the transitions. The clock stands
    /// in the top instance, as in the waveforms.
    ///
    /// # Errors
    /// Those of the output.
    pub fn write_saif(&self, out: &mut impl Write) -> io::Result<()> {
        let cycles = self.cycles();
        writeln!(out, "(SAIFILE\n(SAIFVERSION \"2.0\")\n(DIRECTION \"backward\")\n(DESIGN)")?;
        writeln!(out, "(VENDOR \"edgewalk\")\n(PROGRAM_NAME \"edgewalk\")")?;
        writeln!(out, "(VERSION \"{}\")", env!("CARGO_PKG_VERSION"))?;
        writeln!(out, "(DIVIDER .)\n(TIMESCALE 1 ns)\n(DURATION {})", cycles * CYCLE)?;
        let half = cycles * CYCLE / 2;
        let clk = entry("clk", half, half, (2 * cycles).saturating_sub(1));
        write_scope(out, &self.scope, &self.nets, cycles, 0, Some(&clk))?;
        writeln!(out, ")")?;
        out.flush()
    }
}

/// An instance with its nets and the instances in it; `first` is an entry before those of its signals.
fn write_scope(
    out: &mut impl Write,
    scope: &Scope,
    nets: &[Net],
    cycles: u64,
    depth: usize,
    first: Option<&str>,
) -> io::Result<()> {
    let indent = "  ".repeat(depth);
    writeln!(out, "{indent}(INSTANCE {}", scope.name)?;
    if first.is_some() || !scope.variables.is_empty() {
        writeln!(out, "{indent}  (NET")?;
        if let Some(line) = first {
            writeln!(out, "{indent}    {line}")?;
        }
        for (name, place) in &scope.variables {
            let net = &nets[*place];
            for (bit, (tc, high)) in net.transitions.iter().zip(net.high_until(cycles)).enumerate() {
                let name = if net.high.len() == 1 { name.clone() } else { format!("{name}\\[{bit}\\]") };
                let line = entry(&name, (cycles - high) * CYCLE, high * CYCLE, *tc);
                writeln!(out, "{indent}    {line}")?;
            }
        }
        writeln!(out, "{indent}  )")?;
    }
    for inner in &scope.scopes {
        write_scope(out, inner, nets, cycles, depth + 1, None)?;
    }
    writeln!(out, "{indent})")
}

/// Nanoseconds at 0 and at 1, and transitions, of a bit.
fn entry(name: &str, t0: u64, t1: u64, tc: u64) -> String {
    format!("({name} (T0 {t0}) (T1 {t1}) (TX 0) (TC {tc}) (IG 0))")
}
