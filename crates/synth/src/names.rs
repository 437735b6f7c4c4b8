//! Names of a flat netlist, back to those of the machine: `dut.u_edge.minor_c_SB_LUT4_I3_2_LC` is `edge.minor_c`.

use crate::harness::{DESIGN, IN, OUT};

/// What the tools append to the name of a wire for a cell or net beside it.
const APPENDED: &[&str] =
    &["_SB_", "_LUT4", "_CCU2C", "_TRELLIS_", "_PFUMX", "_L6MUX21", "_DP16KD", "_DFFLC", "_LC", "$", "["];

/// The wire that a net, cell or pin was named after; `None` where nobody's name is in it.
pub(crate) fn named_after(name: &str) -> Option<String> {
    let name = name.strip_prefix("$gbuf_").unwrap_or(name);
    let end = APPENDED.iter().filter_map(|part| name.find(part)).min().unwrap_or(name.len());
    let name = &name[..end];
    let name = match name.strip_prefix(DESIGN).and_then(|inside| inside.strip_prefix('.')) {
        Some(inside) => inside.strip_prefix("u_").unwrap_or(inside).to_owned(),
        None => match (name.strip_prefix(IN), name.strip_prefix(OUT)) {
            (Some(port), _) => format!("input {port}"),
            (_, Some(port)) => format!("output {port}"),
            _ => name.to_owned(),
        },
    };
    (!name.is_empty()).then_some(name)
}

/// Whether a cell belongs to the design, not to the harness.
pub(crate) fn is_of_design(cell: &str) -> bool {
    // What starts with `$` is made by the tools, for the carry chains of the design: the harness has none.
    cell.starts_with('$') || cell.strip_prefix(DESIGN).is_some_and(|rest| rest.starts_with('.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_machine() {
        for (tool, machine) in [
            ("dut.u_edge.minor_c_SB_LUT4_I3_2_LC", Some("edge.minor_c")),
            ("dut.u_edge.minor_c[3]", Some("edge.minor_c")),
            ("dut.u_setup.lane0.acc_TRELLIS_FF_Q_7", Some("setup.lane0.acc")),
            ("harness_in_line_cmin_SB_DFF_Q_14_DFFLC", Some("input line_cmin")),
            ("harness_out_span_x_SB_DFF_Q_DFFLC", Some("output span_x")),
            ("$gbuf_dut.queue.enters1_$glb_ce", Some("queue.enters1_")),
            ("$nextpnr_ICESTORM_LC_3", None),
        ] {
            assert_eq!(named_after(tool).as_deref(), machine, "{tool}");
        }
    }

    #[test]
    fn the_harness_is_told_from_the_design() {
        for (cell, inside) in [
            ("dut.queue.count_SB_DFFESR_Q_DFFLC", true),
            ("$nextpnr_ICESTORM_LC_3", true),
            ("harness_in_line_y_SB_DFF_Q_1_DFFLC", false),
            ("serial_out$sb_io", false),
        ] {
            assert_eq!(is_of_design(cell), inside, "{cell}");
        }
    }
}
