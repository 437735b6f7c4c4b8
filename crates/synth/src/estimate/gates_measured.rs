//! Units that were mapped onto standard cells, as lines of a table.

use std::fmt::Write as _;

/// A unit that was mapped onto standard cells.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredUnit {
    /// A preset, and settings behind spaces.
    pub machine: String,
    /// A number for what the machine's netlist computes.
    pub shape: u64,
    /// The fit leaves this row out.
    pub held_out: bool,
    /// Name of the unit.
    pub unit: String,
    /// Flip-flops.
    pub ff: u64,
    /// Area of its cells, um2.
    pub area_um2: f64,
    /// Version of Yosys.
    pub yosys: String,
}

const HEAD: &str = "machine,shape,held_out,unit,ff,area_um2,yosys";

impl MeasuredUnit {
    /// The table with its head.
    #[must_use]
    pub fn table(rows: &[MeasuredUnit]) -> String {
        let mut text = format!("{HEAD}\n");
        for row in rows {
            let held_out = if row.held_out { "yes" } else { "no" };
            let _ = writeln!(
                text,
                "{},{:016x},{held_out},{},{},{:.1},{}",
                row.machine, row.shape, row.unit, row.ff, row.area_um2, row.yosys
            );
        }
        text
    }

    /// The rows of such a table.
    ///
    /// # Errors
    /// The line that is none, and why.
    pub fn rows(table: &str) -> Result<Vec<MeasuredUnit>, String> {
        let mut lines = table.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        match lines.next() {
            None => return Ok(Vec::new()),
            Some((_, HEAD)) => {}
            Some((_, head)) => return Err(format!("line 1: found `{head}`, the head is `{HEAD}`")),
        }
        let row = |(number, line): (usize, &str)| {
            MeasuredUnit::row(line)
                .ok_or_else(|| format!("line {}: `{line}` is no row of `{HEAD}`", number + 1))
        };
        lines.map(row).collect()
    }

    fn row(line: &str) -> Option<MeasuredUnit> {
        let fields: Vec<&str> = line.split(',').collect();
        let [machine, shape, held_out, unit, ff, area, yosys] = fields[..] else { return None };
        Some(MeasuredUnit {
            machine: machine.to_owned(),
            shape: u64::from_str_radix(shape, 16).ok()?,
            held_out: match held_out {
                "yes" => true,
                "no" => false,
                _ => return None,
            },
            unit: unit.to_owned(),
            ff: ff.parse().ok()?,
            area_um2: area.parse().ok().filter(|area: &f64| *area >= 0.0)?,
            yosys: yosys.to_owned(),
        })
    }
}
