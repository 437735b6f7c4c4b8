//! Machines that were synthesised and placed, as lines of a table.

use super::structure::Structure;
use std::fmt::Write as _;

/// What the tools said of a machine or a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// A preset, and settings behind spaces.
    pub machine: String,
    /// `machine`, or the unit that was synthesised by itself.
    pub part: String,
    /// [`Structure::shape`] of what was synthesised.
    pub shape: u64,
    /// The fit leaves this row out; the printed errors are those of such rows.
    pub held_out: bool,
    /// Look-up tables, carry cells, flip-flops, memories and multipliers by Yosys.
    pub cells: [u64; 5],
    /// Logic cells after packing, without the harness.
    pub packed: Option<u64>,
    /// Clock by nextpnr, seed 1; none where the design does not fit.
    pub mhz: Option<f64>,
    /// Version of Yosys.
    pub yosys: String,
    /// Version of nextpnr.
    pub nextpnr: String,
}

/// What was measured beside what the netlist comes to.
#[derive(Clone, Debug)]
pub struct Sample {
    /// What the tools said.
    pub measured: Measured,
    /// What the netlist comes to.
    pub structure: Structure,
}

const HEAD: &str = "machine,part,shape,held_out,lut4,carry,ff,ram,dsp,packed,mhz,yosys,nextpnr";

impl Measured {
    /// The table with its head.
    #[must_use]
    pub fn table(rows: &[Measured]) -> String {
        let mut text = format!("{HEAD}\n");
        for row in rows {
            let [lut4, carry, ff, ram, dsp] = row.cells;
            let packed = row.packed.map(|cells| cells.to_string()).unwrap_or_default();
            let mhz = row.mhz.map(|mhz| format!("{mhz:.2}")).unwrap_or_default();
            let held_out = if row.held_out { "yes" } else { "no" };
            let _ = writeln!(
                text,
                "{},{},{:016x},{held_out},{lut4},{carry},{ff},{ram},{dsp},{packed},{mhz},{},{}",
                row.machine, row.part, row.shape, row.yosys, row.nextpnr
            );
        }
        text
    }

    /// The rows of such a table.
    ///
    /// # Errors
    /// The line that is none, and why.
    pub fn rows(table: &str) -> Result<Vec<Measured>, String> {
        let mut lines = table.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        match lines.next() {
            None => return Ok(Vec::new()),
            Some((_, HEAD)) => {}
            Some((_, head)) => return Err(format!("line 1: found `{head}`, the head is `{HEAD}`")),
        }
        lines.map(|(number, line)| row(line).map_err(|why| format!("line {}: {why}", number + 1))).collect()
    }
}

fn row(line: &str) -> Result<Measured, String> {
    let fields: Vec<&str> = line.split(',').collect();
    let [machine, part, shape, held_out, lut4, carry, ff, ram, dsp, packed, mhz, yosys, nextpnr] = fields[..]
    else {
        return Err(format!("{} fields, a row has {}", fields.len(), HEAD.split(',').count()));
    };
    let count =
        |name: &str, text: &str| text.parse().map_err(|_| format!("{name}: `{text}` is no whole number"));
    let mhz = match mhz {
        "" => None,
        text => Some(
            text.parse().ok().filter(|mhz: &f64| *mhz > 0.0).ok_or(format!("mhz: `{text}` is no clock"))?,
        ),
    };
    Ok(Measured {
        machine: machine.to_owned(),
        part: part.to_owned(),
        shape: u64::from_str_radix(shape, 16)
            .map_err(|_| format!("shape: `{shape}` is no hexadecimal number"))?,
        held_out: match held_out {
            "yes" => true,
            "no" => false,
            _ => return Err(format!("held_out: `{held_out}`, permitted: yes, no")),
        },
        cells: [
            count("lut4", lut4)?,
            count("carry", carry)?,
            count("ff", ff)?,
            count("ram", ram)?,
            count("dsp", dsp)?,
        ],
        packed: if packed.is_empty() { None } else { Some(count("packed", packed)?) },
        mhz,
        yosys: yosys.to_owned(),
        nextpnr: nextpnr.to_owned(),
    })
}
