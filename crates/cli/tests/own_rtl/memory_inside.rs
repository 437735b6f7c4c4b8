//! A DEPTH that has its memory inside it.

use super::{FUNCTIONS, edgewalk, edit, folder, told};
use std::fs;

/// Changes of `my_depth.v` that put the depth memory inside it.
const INSIDE: [(&str, &str); 3] = [
    (
        "  output wire        rd_valid,
  input  wire        rd_ready,
  output wire [18:0] rd_addr,
  input  wire        data_valid,
  output wire        data_ready,
  input  wire [23:0] data_z,
",
        "",
    ),
    (
        "  reg [18:0] addr [0:15];",
        "  reg [23:0] stored [0:524287];
  wire rd_valid, data_ready;
  wire rd_ready = 1'b1;
  wire [18:0] rd_addr;
  reg [18:0] addr [0:15];",
    ),
    (
        "  wire may = count",
        "  wire data_valid = count != 0;
  wire [23:0] data_z = stored[addr[first]];
  always @(posedge clk) if (w_valid && w_ready && w_z_en) stored[w_addr] <= w_z[23:0];
  wire may = count",
    ),
];

/// A DEPTH with its memory inside passes, also where the memory is cleared to another depth; one that stores nothing fails.
#[test]
fn memories_inside_the_design_are_filled() {
    let folder = folder();
    INSIDE.iter().for_each(|(from, to)| edit(folder.path(), "my_depth.v", from, to));
    edit(folder.path(), "depth.toml", "[in.frag]", "[memories]\ndepth = \"stored\"\n\n[in.frag]");
    let again = ["--only", "one_pixel_again_nearer_and_farther"];
    let verify = |cases: &[&str]| {
        let arguments = [&["verify", "--dut", "depth.toml", "--simulator", "icarus"], cases].concat();
        told(&edgewalk(folder.path(), &arguments))
    };
    let (code, text) = verify(&[again, ["--only", FUNCTIONS]].concat());
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("pass  depth_greater ") && text.contains("not compared: rd_addr, "), "{text}");
    assert!(text.contains("memory_stall (no port for rd_ready)"), "{text}");
    assert!(text.contains("warning: depth_never: left out, as nothing is to be compared: "), "{text}");
    for (from, to, said) in [
        (
            "depth = \"stored\"",
            "depht = \"stored\"",
            "memories.depht: depth has no memory depht; permitted: depth; nearest: depth",
        ),
        (
            "depth = \"stored\"",
            "depth = \"1stored\"",
            "memories.depth: \"1stored\"; permitted: names of Verilog with points between",
        ),
        (
            "[out.wr]\n",
            "[out.rd]\nprefix = \"rd_\"\n\n[out.wr]\n",
            "out.rd: a channel of the memory depth, which is inside; permitted: channels of other memories",
        ),
    ] {
        let right = fs::read_to_string(folder.path().join("depth.toml")).expect("a file");
        edit(folder.path(), "depth.toml", from, to);
        let (code, text) = verify(&again);
        assert!(code == Some(2) && text.contains(said), "{to}: {text}");
        fs::write(folder.path().join("depth.toml"), right).expect("written");
    }
    let arguments = ["mutants", "--dut", "depth.toml", "--bench", "true", "--sample", "1"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert!(code == Some(2) && text.contains("memories: depth is inside the design"), "{text}");
    edit(folder.path(), "my_depth.v", "stored[w_addr] <= w_z[23:0]", "stored[w_addr] <= 0");
    let (code, text) = verify(&again);
    assert!(code == Some(1) && text.contains("wr: "), "{text}");
}

/// Verilator fills it too; not part of the test run, as it is a build.
#[test]
#[ignore = "a build with Verilator"]
fn a_memory_inside_the_design_passes_in_verilator() {
    let folder = folder();
    INSIDE.iter().for_each(|(from, to)| edit(folder.path(), "my_depth.v", from, to));
    edit(folder.path(), "depth.toml", "[in.frag]", "[memories]\ndepth = \"stored\"\n\n[in.frag]");
    let (code, text) =
        told(&edgewalk(folder.path(), &["verify", "--dut", "depth.toml", "--simulator", "verilator"]));
    assert_eq!(code, Some(0), "{text}");
}
