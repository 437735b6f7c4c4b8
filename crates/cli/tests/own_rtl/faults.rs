//! Faults of both designs: each fails, with the words for it.

use super::{FUNCTIONS, LONG, edgewalk, edit, folder, told};
use std::fs;
use std::process::Command;

/// A fault of one of the designs.
struct Fault {
    file: &'static str,
    from: &'static str,
    to: &'static str,
    /// A case that shows it.
    case: &'static str,
    /// What the report says of it.
    said: &'static str,
}

const fn fault(
    file: &'static str,
    from: &'static str,
    to: &'static str,
    case: &'static str,
    said: &'static str,
) -> Fault {
    Fault { file, from, to, case, said }
}

const FAULTS: [Fault; 15] = [
    fault(
        "my_pixel.v",
        "always @(posedge aclk or negedge aresetn)\n    if (!aresetn) begin",
        "initial {busy, stage_valid, m_valid} = 0;\n  always @(posedge aclk)\n    if (1'b0) begin",
        "flat_top",
        "frag: token ",
    ),
    fault("my_pixel.v", "column < 640", "column < 639", LONG, "case guard_band_to_guard_band_on_a_line"),
    fault("my_pixel.v", "left ? column - 1", "left ? column + 1", "flat_top", "frag_addr: expected "),
    fault("my_pixel.v", "dr <= step_r", "dr <= step_g", "flat_top", "frag_r: expected "),
    fault(
        "my_pixel.v",
        "fence <= 1'b0;",
        "fence <= fence;",
        "flat_top",
        "frag_fence: expected 0 (0), found 1 (1)",
    ),
    fault("my_pixel.v", "z[ZW-1-:24]", "z[ZW-2-:24]", "flat_top", "frag_z: expected "),
    fault(
        "my_pixel.v",
        "stage_valid <= 1'b1;",
        "stage_valid <= pixels != 1;",
        "flat_top",
        "frag_addr: expected 00407 (1031), found 00801 (2049)",
    ),
    fault("my_pixel.v", "if (!m_valid || m_ready) begin", "begin", "flat_top", "frag: cycle "),
    fault("my_depth.v", "less ? func[0]", "less ? func[1]", "flat_top", "wr: "),
    fault(
        "my_depth.v",
        "new_z < data_z",
        "new_z[23:1] < data_z[23:1]",
        "nearer_by_each_bit_and_one_lsb_farther",
        "wr: ",
    ),
    fault(
        "my_depth.v",
        "addr[(first + i) & 15] == f_addr",
        "1'b0",
        "one_pixel_again_nearer_and_farther",
        "wr: ",
    ),
    fault(
        "my_depth.v",
        "w_z_en <= z_write",
        "w_z_en <= 1'b1",
        FUNCTIONS,
        "wr_z_en: expected 0 (0), found 1 (1)",
    ),
    fault(
        "my_depth.v",
        "{8'b0, new_z}",
        "{8'b1, new_z}",
        "flat_top",
        "a wider port holds more than its value extended",
    ),
    fault("my_depth.v", "rgb[free] <= f_rgb", "rgb[free] <= f_rgb | 1", "flat_top", "wr_b: expected "),
    fault(
        "my_depth.v",
        "w_addr <= addr[first]",
        "w_addr <= addr[first] ^ 1",
        "flat_top",
        "wr_addr: expected ",
    ),
];

/// Each fault under this simulator: exit code 1, and in Icarus the words for it.
fn faults_fail(simulator: &str, faults: impl Iterator<Item = &'static Fault>) {
    for Fault { file, from, to, case, said } in faults {
        let folder = folder();
        edit(folder.path(), file, from, to);
        let dut = file.replace("my_", "").replace(".v", ".toml");
        let arguments = ["verify", "--dut", &dut, "--simulator", simulator, "--only", case];
        let (code, text) = told(&edgewalk(folder.path(), &arguments));
        assert_eq!(code, Some(1), "{to}: {text}");
        assert!(text.contains("FAIL  "), "{to}: {text}");
        assert!(simulator != "icarus" || text.contains(said), "{to} without `{said}`: {text}");
    }
}

#[test]
fn faults_of_both_designs_fail_in_icarus() {
    faults_fail("icarus", FAULTS.iter());
}

/// What a design prints is not the bench's: it decides nothing, hides nothing, and sends a terminal nothing.
#[test]
fn prints_of_the_design_are_not_the_benchs() {
    let passes = "if (pass) $display(\"%c[31mPASS\\nPASS\\nchecked 1 / 1\", 8'd27);";
    let fails = "$write(\"FAIL: \"); if (pass) $display(\"ports\\nchecked %0d / 1\", w_addr);";
    for (prints, colour, code_of_verify, code_of_make) in [(passes, "^ 1", 1, 2), (fails, "", 0, 0)] {
        let folder = folder();
        edit(folder.path(), "my_depth.v", "w_valid <= pass;", &format!("w_valid <= pass; {prints}"));
        edit(folder.path(), "my_depth.v", "w_rgb <= rgb[first];", &format!("w_rgb <= rgb[first] {colour};"));
        let design = ["--dut", "depth.toml", "--only", "flat_top"];
        let verify = [&["verify", "--simulator", "icarus"][..], &design].concat();
        let (code, text) = told(&edgewalk(folder.path(), &verify));
        assert_eq!(code, Some(code_of_verify), "{text}");
        assert_eq!(text.contains("wr_b: expected "), code_of_verify == 1, "{text}");
        assert!(!text.contains("PASS") && !text.contains('\x1b'), "{text}");
        let vectors = ["vectors", "--suite", "corners", "--no-csv", "--quiet", "--out", "v"];
        assert_eq!(told(&edgewalk(folder.path(), &[&vectors[..], &design].concat())).0, Some(0));
        let mut make = Command::new("make");
        make.env_remove("MAKEFLAGS").args(["-C", "v/corners_depth", "icarus"]).current_dir(folder.path());
        let (code, text) = told(&make.output().expect("make is installed"));
        assert_eq!(code, Some(code_of_make), "{text}");
        assert!(text.contains("\nwrong ") && !text.contains('\x1b'), "{text}");
        assert_eq!(text.contains("\nPASS\n"), code == Some(0), "{text}");
        assert_eq!(text.contains("\n| PASS\n"), code != Some(0), "{text}");
    }
    // Without an end of the bench all lines are shown.
    let folder = folder();
    edit(folder.path(), "pixel.toml", "compare", "widths = \"unchecked\"\ncompare");
    let ends = "stage_valid <= 1'b1; $display(\"%cPASS\", 8'd7); $finish;";
    edit(folder.path(), "my_pixel.v", "stage_valid <= 1'b1;", ends);
    let verify = ["verify", "--simulator", "icarus", "--dut", "pixel.toml", "--only", "flat_top"];
    let (code, text) = told(&edgewalk(folder.path(), &verify));
    assert!(code == Some(2) && text.contains("icarus does not run the design"), "{text}");
    assert!(text.contains("\n\\u{7}PASS"), "{text}");
}

/// A design that never gives a token is wrong, and its description fits.
#[test]
fn a_silent_design_fails_with_code_1() {
    let folder = folder();
    edit(folder.path(), "my_pixel.v", "stage_valid <= 1'b1;", "stage_valid <= 1'b0;");
    let arguments =
        ["verify", "--dut", "pixel.toml", "--simulator", "icarus", "--only", "flat_top", "--junit", "r.xml"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("no token came: expected "), "{text}");
    let xml = fs::read_to_string(folder.path().join("r.xml")).expect("written");
    assert!(xml.contains("tests=\"1\" failures=\"1\"") && xml.contains(">no token came: expected "), "{xml}");
}

/// Verilator has no unknown bits: a register that is never reset begins with random ones.
#[test]
fn a_register_without_a_reset_fails_in_verilator() {
    let folder = folder();
    edit(folder.path(), "my_pixel.v", "z[ZW-1-:24]", "z[ZW-1-:24] ^ never");
    let never = "reg [23:0] never;\n  always @(posedge aclk) never <= never;\n  always @(posedge aclk or";
    edit(folder.path(), "my_pixel.v", "always @(posedge aclk or", never);
    let arguments = ["verify", "--dut", "pixel.toml", "--simulator", "verilator", "--only", "flat_top"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert!(code == Some(1) && text.contains("frag_z: expected "), "{text}");
}

/// An output whose valid no reset reaches: its token of before the reset counts. Where the valid begins with 0, only a reset
/// with a waiting token shows it.
#[test]
fn a_valid_that_no_reset_reaches_fails() {
    for (starts, simulator, said) in [
        ("", "icarus", "wr: wr_valid was unknown in the first run: does the reset reach wr_valid?"),
        (" = 1'b0", "icarus", "wr: "),
        (" = 1'b0", "verilator", "wr: "),
        (" = 1'b1", "verilator", "wr: a token of the first run is not the next one"),
    ] {
        let folder = folder();
        edit(folder.path(), "my_depth.v", "      w_valid <= 1'b0;\n    end", "    end");
        let declared = format!("output reg         w_valid{starts},");
        edit(folder.path(), "my_depth.v", "output reg         w_valid,", &declared);
        let arguments = ["verify", "--dut", "depth.toml", "--simulator", simulator, "--only", "flat_top"];
        let (code, text) = told(&edgewalk(folder.path(), &arguments));
        assert!(code == Some(1) && text.contains(said), "{simulator}, `{starts}`: {text}");
    }
}

/// Not part of the test run: a dozen builds. `cargo test --release -p edgewalk-cli own_rtl:: -- --ignored`
#[test]
#[ignore = "three minutes"]
fn faults_of_both_designs_fail_in_verilator() {
    let folder = folder();
    let arguments = ["verify", "--dut", "depth.toml", "--simulator", "verilator"];
    let (code, text) = told(&edgewalk(folder.path(), &arguments));
    assert_eq!(code, Some(0), "{text}");
    // Verilator runs the directed suites alone, and these are drawn with depth writes.
    faults_fail("verilator", FAULTS.iter().filter(|fault| fault.case != FUNCTIONS));
}
