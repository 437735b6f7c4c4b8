//! The example for SystemVerilog in Verilator: our Verilog in lock-step with the model, and with a fault.

use crate::support::{command, must, ran, root};
use std::process::Command;

/// A depth whose bits are all wrong, if the simulation is called with `+fault`.
const FAULT: [&str; 2] = ["wr_z <= place0_z;", "wr_z <= $test$plusargs(\"fault\") ? ~place0_z : place0_z;"];

/// One build, as the page says but for its optimisation: the design agrees, and with the fault it does not.
#[test]
fn verilog_and_a_fault_are_told_by_dpi() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().display().to_string();
    for file in std::fs::read_dir(root().join("hdl/small")).expect("a folder") {
        let file = file.expect("an entry");
        let text = std::fs::read_to_string(file.path()).expect("a file");
        let [from, to] = FAULT;
        assert!(file.file_name() != "edgewalk_depth.v" || text.contains(from));
        std::fs::write(folder.path().join(file.file_name()), text.replace(from, to)).expect("written");
    }
    let verilator = command("verilator").replace("hdl/small", &path);
    must(&format!(
        "{verilator} -O0 -MAKEFLAGS 'OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0' --Mdir {path}/obj_dir"
    ));
    let simulate =
        |argument: &[&str]| ran(Command::new(folder.path().join("obj_dir/Vlockstep")).args(argument)).1;

    let said = simulate(&[]);
    assert!(said.lines().any(|line| line == "PASS") && !said.contains("expected"), "{said}");
    let checked = said.lines().find_map(|line| line.strip_prefix("checked ")?.strip_suffix(", 0 differ"));
    assert!(checked.and_then(|count| count.parse::<u32>().ok()) > Some(10_000), "{said}");
    let said = simulate(&["+fault"]);
    assert!(said.lines().any(|line| line == "FAIL") && said.contains(": wr_z: expected "), "{said}");
}
